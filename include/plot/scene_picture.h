/* Picture of a scene before it runs: bodies, materials, pre-cracks, loads, supports, probes and levels in their initial
 * state. */
#ifndef CLEAVE_SCENE_PICTURE
#define CLEAVE_SCENE_PICTURE

#include "plot/plot.h"
#include "scene/scene.h"

/* Draws the initial state of the scene in the file `path` with overrides of its keys, override[overrides].
 * Creates the bodies as a run does before its first step. r->out: file, folder, or NULL for results/NAME_scene.png;
 * r->projection: camera for a solid. Prints what was drawn. FAILED or REFUSED as the run would be. */
status scene_picture(const char *path, const struct scene_override *override, int overrides,
                     const struct plot_request *r);

#endif
