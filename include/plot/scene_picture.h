/* A scene before it runs: bodies, materials, pre-cracks, loads, supports, probes and levels as a run begins with
 * them. */
#ifndef CLEAVE_SCENE_PICTURE
#define CLEAVE_SCENE_PICTURE

#include "plot/plot.h"
#include "scene/scene.h"

/* Makes all that a run makes before its first step, and draws it into `out` of the request: a file, a folder, or NULL:
 * the file results/NAME_scene.png. A solid is seen by the request's camera. What was drawn is printed. */
status scene_picture(const char *path, const struct scene_override *override, int overrides,
                     const struct plot_request *r);

#endif
