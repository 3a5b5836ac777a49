/* Runs of a scene at coarse spacings that choose its method and spacing, where `method: auto` has no answer in the
 * cost-accuracy table. */
#ifndef CLEAVE_PILOT
#define CLEAVE_PILOT

#include "study/study.h"

enum { CHOSEN_MOST = 8, CHOSEN_ROOM = 64 };

/* The overrides that a scene is to be read with. */
struct pilot {
    struct scene_override *override; /* the user's, then those chosen */
    int overrides;
    char key[CHOSEN_MOST][CHOSEN_ROOM], value[CHOSEN_MOST][CHOSEN_ROOM];
};

/* Spacing for the first runs [m]: lengths that have to be resolved have a few spacings. 0: the scene has none. */
double pilot_spacing(const struct scene *s);

/* Reads a scene, with the overrides. Where it wants pilot runs, they are made in FOLDER_pilot (`folder` NULL:
 * results/NAME) and the choice is kept there: the same scene has it without runs. `way`: quiet, stop. REFUSED where the
 * scene is not sound, or where no method reaches what is asked, with how far each comes; INTERRUPTED. */
status pilot_scene_read(struct scene *s, struct pilot *p, const char *scene, const struct scene_override *override,
                        int overrides, const char *folder, struct study_way way);
void pilot_free(struct pilot *p);

#endif
