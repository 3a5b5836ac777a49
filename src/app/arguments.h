/* Reads the command line of the commands that read a scene. */
#ifndef CLEAVE_ARGUMENTS
#define CLEAVE_ARGUMENTS

#include "scene/scene.h"

enum { THREADS_MOST = 4096 }; /* of a run; and runs at once */

struct run_arguments {
    const char *scene, *folder;      /* borrowed from argv; folder NULL: default */
    struct scene_override *override; /* owned; strings point into copies of argv */
    int overrides;
    int threads; /* 0: automatic */
    bool resume, overwrite, quiet;
};

/* Reads the whole number `text`, the word that follows the option `option`, into *count. Returns REFUSED, with a
 * message, unless it is a number from `least` to `most`. */
status option_read_count(int *count, const char *option, const char *text, int least, int most);

/* Checks that the option `option` is followed by a value. Returns OK if has_value is true, else REFUSED, with a message
 * that contains the usage line `cleave USAGE`, USAGE being the text `usage`. */
status option_has_value(const char *option, bool has_value, const char *usage);

/* Returns REFUSED for a word that follows the scene of a command: the message names -s if the word is KEY=VALUE, else
 * both scenes. */
status arguments_refuse_second_scene(const char *scene, const char *word);

/* Removes the word `option`, an option without a value that only one command has, from argv[*argc] and reduces *argc.
 * Returns true if argv contained it. */
bool arguments_remove_option(int *argc, char **argv, const char *option);

/* Reads the words argv[argc] of a command line into *a; argv[0] is the name of the command. Returns REFUSED, with a
 * message that contains the usage line `usage`, for malformed words. Release with arguments_free. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);

/* Appends the override `text`, KEY=VALUE as after an option -s, to a->override, which must have memory for one more.
 * Returns REFUSED, with a message, if the text is malformed. */
status arguments_add_override(struct run_arguments *a, const char *text);

/* Releases the overrides in *a. */
void arguments_free(struct run_arguments *a);

#endif
