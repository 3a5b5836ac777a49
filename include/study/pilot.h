/* Pilot runs: runs at coarse spacings that choose method and spacing of a scene with `method: auto`. */
#ifndef CLEAVE_PILOT
#define CLEAVE_PILOT

#include <stdio.h>

#include "study/study.h"

/* Most chosen keys; capacity of a key or value [byte]. */
enum { CHOSEN_MOST = 8, CHOSEN_ROOM = 64 };

/* Overrides with which a scene is read: those of the user, then the chosen ones. */
struct pilot {
    struct scene_override *override; /* [overrides] strings of the chosen ones are in key and value */
    int overrides;
    char key[CHOSEN_MOST][CHOSEN_ROOM], value[CHOSEN_MOST][CHOSEN_ROOM];
};

/* Prints which figure the pilot runs of a scene evaluate, which methods and spacings they vary and how much time they
 * take. REFUSED if no pilot runs are possible. w: request in the scene; scene: path of its file. */
struct pilot_wish;
status pilot_plan_print(const struct pilot_wish *w, const char *scene, FILE *out);

/* Reads a scene with the overrides override[overrides]. If it has `method: auto`, makes pilot runs in FOLDER_pilot and
 * stores the choice there; later calls with the same scene use the stored choice without runs.
 * folder: folder of the run, NULL: results/NAME. options: only `quiet` and `stop` are used. REFUSED if the scene is
 * invalid, or if no method reaches the requested accuracy; the message then states the accuracy of each. INTERRUPTED by
 * options.stop. Release p with pilot_free. */
status pilot_scene_read(struct scene *s, struct pilot *p, const char *scene, const struct scene_override *override,
                        int overrides, const char *folder, struct study_options options);

/* Releases the memory of p. */
void pilot_free(struct pilot *p);

#endif
