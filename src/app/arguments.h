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

/* Reads the whole number that follows an option. REFUSED unless it is from least to most. */
status option_read_count(int *count, const char *option, const char *text, int least, int most);

/* Checks that an option is followed by a value. REFUSED with the usage line, which follows `cleave `, if not. */
status option_has_value(const char *option, bool has_value, const char *usage);

/* Returns REFUSED for a word that follows the scene of a command: the message names -s if the word is KEY=VALUE, else
 * both scenes. */
status arguments_refuse_second_scene(const char *scene, const char *word);

/* Removes an option without a value, specific to one command, from argv. Returns true if argv contained it. */
bool arguments_remove_option(int *argc, char **argv, const char *option);

/* Reads the words of a command; argv[0] is its name. REFUSED with the usage line for malformed words. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);

/* Appends the text `key=value` of an option -s to a->override, which must have memory for it. */
status arguments_add_override(struct run_arguments *a, const char *text);

/* Releases the overrides. */
void arguments_free(struct run_arguments *a);

#endif
