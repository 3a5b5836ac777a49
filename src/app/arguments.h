/* The command line of the commands that read a scene. */
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

/* The whole number behind an option; REFUSED unless it is from least to most. */
status option_count(int *count, const char *option, const char *text, int least, int most);
/* Removes an option without value, which this command alone has, from argv wherever it stands. Returns true if it was
 * there. */
bool arguments_take(int *argc, char **argv, const char *option);
/* argv[0]: the command. REFUSED with the usage line for malformed words. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);
/* `key=value` behind -s, into a->override, which has room. */
status arguments_override(struct run_arguments *a, const char *text);
void arguments_free(struct run_arguments *a);

#endif
