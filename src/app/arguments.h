/* The command line of the commands that read a scene. */
#ifndef CLEAVE_ARGUMENTS
#define CLEAVE_ARGUMENTS

#include "scene/scene.h"

struct run_arguments {
    const char *scene, *folder;          /* borrowed from argv; folder NULL: default */
    struct scene_override *override;     /* owned; strings point into copies of argv */
    int overrides;
    int threads;                         /* 0: automatic */
    bool resume, overwrite, quiet;
};

/* argv[0]: the command. REFUSED with the usage line for malformed words. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);
void arguments_free(struct run_arguments *a);

#endif
