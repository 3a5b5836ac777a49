/* A study of convergence: the same scene at several spacings, each some times with what changes nothing physical. */
#ifndef CLEAVE_CONVERGENCE_STUDY
#define CLEAVE_CONVERGENCE_STUDY

#include "study/convergence.h"

enum { SPACINGS_MOST = 3 };

/* Spacings of each level, the finest first: the level's own and others within some percent, at which the lattice lies
 * as well [m]. */
struct spacings {
    int levels, n[LEVELS_MOST];
    double at[LEVELS_MOST][SPACINGS_MOST];
    double misfit[LEVELS_MOST]; /* of the level's own: largest distance of a face or crack from where the
                                 * lattice would meet it [spacings] */
};

/* Plans levels a factor sqrt(2) apart, level 0 near `finest`. */
void spacings_plan(struct spacings *to, const struct scene *s, int levels, double finest);

/* What a run of the study differs in. */
struct study_point {
    int level;                     /* -1: a run of level 1 with a longer horizon */
    double spacing, step, horizon; /* [m], share of the scene's own [1], [spacings] */
    int run;                       /* of its level, from 0 */
};

struct convergence_study {
    struct scene scene; /* as the user gave it */
    struct study study;
    struct study_point *point; /* of each run of `study` */
    int first;                 /* run from which the time of the others is known */
    double refused;            /* spacing at which the scene is not sound; INFINITY: none [m] */
    struct spacings spacings;
    const struct scene_override *override; /* of the user; borrowed */
    int overrides;
    int runs[LEVELS_MOST];  /* of each level */
    bool fixed_horizon;     /* its length stays while the spacing shrinks */
    int own;                /* level of the scene's own spacing; -1: it does not fit the budget */
    double budget, begun;   /* [s], on team_clock */
    double spent, expected; /* of the first run [s]; of all, with so many side by side [s] */
    struct study_table table;
};

/* Result of one figure. */
struct figure_study {
    const char *name;
    char unit[UNIT_ROOM]; /* SI; "": none */
    struct convergence c;
    double step_moves;    /* by a step a tenth longer; NAN: not known */
    double spacing_moves; /* from the second to the finest level */
    double horizon_moves; /* by a horizon one spacing longer, at level 1; NAN: not known */
};

struct convergence_request {
    const char *scene, *folder;
    const struct scene_override *override;
    int overrides, levels, runs; /* runs at the most */
    double budget;               /* [s] */
    const char *const *wanted;   /* figures that are asked for: a warning where the first run has none such; NULL */
    int wanteds;
    bool fixed_horizon, finer; /* finer: also spacings below the scene's own, as the budget allows */
    struct study_options options;
};

/* Runs the study. Fails of single runs leave gaps. REFUSED where the scene cannot be refined or the budget is too
 * little, with how much it would take. */
status convergence_study_run(struct convergence_study *s, const struct convergence_request *w);
void convergence_study_free(struct convergence_study *s);

/* The figures that all levels have, physical ones alone; `wanted` (NULL: all) must be among them, or REFUSED. The
 * caller frees *figure. */
status figures_find(const struct convergence_study *s, const char *const *wanted, int wanteds,
                    struct figure_study **figure, int *figures);
/* REFUSED if the folder is that of a study and the table or a picture that a study of convergence leaves there is a
 * file of others. Other folders are refused by study_take. */
status figures_guard(const char *folder);
/* Writes FOLDER/converge.csv. */
status figures_write(const struct convergence_study *s, const struct figure_study *figure, int figures);
/* Prints a table, the sentence for each figure, and what moves it most. */
void figures_print(const struct convergence_study *s, const struct figure_study *figure, int figures);
/* Draws FOLDER/pictures/convergence.png, and path.png where the runs have cracks. */
status figures_draw(const struct convergence_study *s, const struct figure_study *figure, int figures);

#endif
