/* Pilot runs: runs of a scene with `method: auto` at coarse spacings, which choose its method and spacing. */
#ifndef CLEAVE_PILOT
#define CLEAVE_PILOT

#include <stdio.h>

#include "study/study.h"

enum { CHOSEN_MOST = 8, CHOSEN_ROOM = 64 };

/* The overrides that a scene is to be read with. */
struct pilot {
    struct scene_override *override; /* the user's, then those chosen */
    int overrides;
    char key[CHOSEN_MOST][CHOSEN_ROOM], value[CHOSEN_MOST][CHOSEN_ROOM];
};

/* Prints what the pilot runs of a scene judge, what they vary and what they cost. REFUSED where no pilot runs can be
 * made. scene: path of its file. */
struct pilot_wish;
status pilot_plan_print(const struct pilot_wish *w, const char *scene, FILE *out);

/* Reads a scene, with the overrides. Where it has `method: auto`, pilot runs are made in FOLDER_pilot (`folder` NULL:
 * results/NAME) and the choice is kept there: the same scene has it without runs. options: quiet, stop. REFUSED where
 * the scene is not sound, or where no method reaches what is asked, with how far each comes; INTERRUPTED. */
status pilot_scene_read(struct scene *s, struct pilot *p, const char *scene, const struct scene_override *override,
                        int overrides, const char *folder, struct study_options options);
void pilot_free(struct pilot *p);

#endif
