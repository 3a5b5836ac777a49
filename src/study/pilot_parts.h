/* Shared by the files pilot*.c. */
#ifndef CLEAVE_PILOT_PARTS
#define CLEAVE_PILOT_PARTS

#include "output/output_files.h"
#include "scene/scene_read.h"
#include "study/convergence_study.h"
#include "study/pilot.h"

#define PILOT_FIRST_SHARE 0.6                          /* of the budget for the first runs of all methods */
#define PILOT_LONGEST 20.0                             /* largest expected time of the chosen run over the budget */
enum { PILOT_RUNS_FIRST = 3, PILOT_LEVELS_FIRST = 3 }; /* runs at each spacing, spacings of a study */

/* A method that can do the scene, and what its runs say. */
struct pilot_candidate {
    const char *name, *method, *model; /* of its folder; keys; model NULL: none */
    double finest, finest_seconds;     /* spacing that was run, time of a run there [m] [s] */
    double reached;                    /* half-width there as a share of the figure [1] */
    double spacing, seconds;           /* that is accurate enough, time of the run; 0: not known [m] [s] */
    double expected;                   /* half-width there [1] */
    double value, width;               /* of the figure and the half-width of its interval, at the finest run */
    bool seen;                         /* it was run at this spacing */
    char failed[300];                  /* why there are no figures; "": there are */
    bool unknown;                      /* the runs have no figure of the name that is wanted */
};

struct pilot_search {
    const char *scene;
    const struct scene_override *override; /* of the user; borrowed */
    int overrides;
    struct study_options options;
    struct pilot_wish wish;
    char folder[PATH_ROOM], figure[128]; /* of the runs; that is judged */
    double begun;                        /* on team_clock */
    struct pilot_candidate at[4];
    int n;
};

/* Lists the methods that can do the scene in at[n] (pilot_plan.c). REFUSED where there is none, where no spacing can be
 * varied, and for a figure that no run of the scene has. */
status pilot_plan(struct pilot_search *p);
/* Returns the name of the figure that is to be accurate, or a description of the figure that is taken without one. */
const char *pilot_figure(const struct pilot_search *p);

/* Makes the overrides from the user's and the n that are chosen (pilot_keep.c). */
void pilot_fill(struct pilot *to, const struct scene_override *override, int overrides, int n);

/* Reads from a study what spacing its method needs (pilot_judge.c). FAILED or REFUSED where it has no such figure. */
status pilot_judge(struct pilot_search *p, struct pilot_candidate *c, const struct convergence_study *s);
void pilot_print(const struct pilot_search *p, const struct pilot_candidate *c);

/* Keeps the choice with what was asked, and with the error bars that belong to it (pilot_keep.c). */
status pilot_keep(const struct pilot *to, const struct pilot_search *p, const struct pilot_candidate *best);
/* The choice kept for the same scene and overrides; false: there is none. */
bool pilot_kept(struct pilot *to, const struct pilot_search *p);

#endif
