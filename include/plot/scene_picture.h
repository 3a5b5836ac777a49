/* Picture of a scene before it runs: bodies, materials, pre-cracks, loads, supports, probes and levels in their initial
 * state. */
#ifndef CLEAVE_SCENE_PICTURE
#define CLEAVE_SCENE_PICTURE

#include "plot/plot.h"
#include "scene/scene.h"

/* Draws the initial state of the scene in the file `path`, with the values of keys that override[overrides] replaces
 * (option -s), and prints what was drawn. The bodies are created as for the first step of a run. r->out: output file or
 * folder, NULL for results/NAME_scene.png; r->projection: direction of view of a body in three dimensions. Returns
 * REFUSED if the scene is invalid or r does not suit it, FAILED if gnuplot fails. */
status scene_draw_picture(const char *path, const struct scene_override *override, int overrides,
                          const struct plot_request *r);

#endif
