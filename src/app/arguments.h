/* Reads the command line of the commands that read a scene. */
#ifndef CLEAVE_ARGUMENTS
#define CLEAVE_ARGUMENTS

#include "plot/gnuplot.h"
#include "scene/scene.h"

enum { THREADS_MOST = 4096 }; /* of a run; and runs at once */

/* Arguments that several commands have. */
struct run_arguments {
    const char *scene, *folder;      /* borrowed from argv; folder NULL: default */
    struct scene_override *override; /* owned; strings point into copies of argv */
    int overrides;
    int threads; /* 0: automatic */
    bool resume, overwrite, quiet;
};

/* Reads the whole number `text`, the word that follows the option `option`, into *count. Returns REFUSED, with a
 * message, unless it is a number from `smallest` to `largest`. */
status option_read_count(int *count, const char *option, const char *text, int smallest, int largest);

/* Reads the size of pictures from `text`, the text that follows the option `option`, into *size: width and height as
 * 1200x800 [pixel] or as 90mmx60mm, or the width alone, as 90mm. The height in *size is then 0: each picture chooses
 * its height. Returns REFUSED, with a message, unless the width is from 300 (53 mm) and the height from 226 (40 mm) to
 * 10000 pixels, since a smaller picture has no space beside its letters. */
status option_read_picture_size(struct picture_size *size, const char *option, const char *text);

/* Reads the resolution of pictures [pixel/inch] from `text`, the text that follows the option `option`, into size->dpi.
 * Returns REFUSED, with a message, unless it is a number from 30 to 1200. */
status option_read_dpi(struct picture_size *size, const char *option, const char *text);

/* Returns true if `option`, a word of the command line, is an option of the pictures of a study: --size, --dpi or
 * --format. */
bool option_is_size_dpi_or_format(const char *option);

/* Reads the value `option_value` of the option `option` of a study, --size, --dpi or --format, into *size.
 * option_value: NULL if the option has no value; usage: usage line for the message. Returns REFUSED, with a message, if
 * the value is missing or is no size, resolution or format of a picture. */
status option_read_size_dpi_or_format(struct picture_size *size, const char *option, const char *option_value,
                                      const char *usage);

/* Checks that the option `option` is followed by a value. Returns OK if has_value is true, else REFUSED, with a message
 * that contains the usage line `cleave USAGE`, USAGE being the text `usage`. */
status option_check_has_value(const char *option, bool has_value, const char *usage);

/* Refuses a surplus word of a command that reads one input file: always returns REFUSED. scene: name of the input file,
 * which was the earlier word; word: the surplus word. The message suggests -s if the word has the form KEY=VALUE, else
 * it names both words. */
status arguments_refuse_second_scene(const char *scene, const char *word);

/* Removes the option `option`, which has no value, from the argument list argv and reduces *argc by one. Returns true
 * if the option was in the list. For options that only one command has. */
bool arguments_remove_option(int *argc, char **argv, const char *option);

/* Reads the `argc` words argv of a command line into *a; argv[0] is the name of the command. Returns REFUSED for
 * malformed words, with a message that shows the usage line `usage`. Release a with arguments_free. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);

/* Appends the override `text` (KEY=VALUE, as after an option -s) to the list a->override. The caller must have
 * allocated memory for one more entry. Returns REFUSED, with a message, if the text is malformed. */
status arguments_add_override(struct run_arguments *a, const char *text);

/* Releases the overrides (-s KEY=VALUE) in *a, which arguments_read has stored. */
void arguments_free(struct run_arguments *a);

#endif
