/* Pilot runs: runs at coarse spacings that choose method and spacing of a scene with `method: auto`. */
#ifndef CLEAVE_PILOT
#define CLEAVE_PILOT

#include <stdio.h>

#include "study/study.h"

/* CHOSEN_MOST: largest number of keys that pilot runs choose; CHOSEN_ROOM: capacity of the text of such a key or value
 * [byte]. */
enum { CHOSEN_MOST = 8, CHOSEN_ROOM = 64 };

/* Overrides of keys with which a scene with `method: auto` is read: first the overrides of the user, then those that
 * pilot runs have chosen. */
struct pilot_choice {
    struct scene_override *override; /* [overrides] strings of the chosen ones are in key and value */
    int overrides;
    char key[CHOSEN_MOST][CHOSEN_ROOM], value[CHOSEN_MOST][CHOSEN_ROOM];
};

struct pilot_requirements;

/* Prints to `out` which scalar result the pilot runs of a scene (runs at coarse spacings that choose method and
 * spacing) evaluate, which methods and spacings they vary and how much time they take. requirements: what the scene
 * requires of its pilot runs; scene: path of the scene file. Returns REFUSED if no pilot runs of the scene are
 * possible. */
status pilot_runs_print_plan(const struct pilot_requirements *requirements, const char *scene, FILE *out);

/* Reads the scene (input file) `scene` into *s, with the values of keys that override[overrides] replaces (option -s).
 * If it has `method: auto`, makes pilot runs at coarse spacings in the folder FOLDER_pilot, with FOLDER = folder, the
 * folder of the run (NULL: results/NAME), and stores the chosen method and spacing in FOLDER_pilot; later calls with
 * the same scene and overrides use the stored choice. options: only its members quiet and stop are used. p: receives
 * all overrides, those of the user and the chosen ones. Returns REFUSED if the scene is invalid, or if no method
 * reaches the requested accuracy (the message states the accuracy of each), INTERRUPTED if options.stop is set; then
 * nothing has to be released. Otherwise release *s with scene_free and *p with pilot_choice_free. */
status scene_read_and_choose_method_by_pilot_runs(struct scene *s, struct pilot_choice *p, const char *scene,
                                                  const struct scene_override *override, int overrides,
                                                  const char *folder, struct study_options options);

/* Frees the overrides (replaced values of keys) in *p, which scene_read_and_choose_method_by_pilot_runs has stored. */
void pilot_choice_free(struct pilot_choice *p);

#endif
