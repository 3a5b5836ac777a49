/* floor 5: the command line of the commands that read a scene. */
#ifndef CLEAVE_ARGUMENTS_H
#define CLEAVE_ARGUMENTS_H

#include "scene/scene.h"

struct run_arguments {
    const char *scene, *folder;          /* borrowed from argv; folder NULL: default    */
    struct scene_override *override;     /* owned; strings point into copies of argv    */
    int overrides;
    int threads;                         /* 0: automatic                                */
    bool resume, overwrite, quiet;
};

/* argv[0] is the command. REFUSED with the usage line on anything else. */
status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage);
void arguments_free(struct run_arguments *a);

#endif
