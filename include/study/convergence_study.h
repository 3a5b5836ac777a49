/* Convergence study: runs a scene at several spacings, each several times with variations that have no physical
 * meaning. */
#ifndef CLEAVE_CONVERGENCE_STUDY
#define CLEAVE_CONVERGENCE_STUDY

#include "study/convergence.h"

/* Largest number of particle spacings at which one spacing level of a convergence study is run. */
enum { SPACINGS_MOST = 3 };

/* Spacings of each level [m], level 0 the finest. at[level][0] is the spacing of the level; the others differ from it
 * by a few percent and also fit the lattice to the body. */
struct spacings {
    int levels, n[LEVELS_MOST]; /* number of levels; number of spacings of each */
    double at[LEVELS_MOST][SPACINGS_MOST];
    double misfit[LEVELS_MOST]; /* largest distance between a face or crack and the lattice position that it should
                                 * have, at at[level][0] [spacings] */
};

/* Chooses the particle spacings of a convergence study of the scene s and stores them in *spacings. level_count: number
 * of levels, which differ by factors of about sqrt(2); finest_spacing: approximate spacing of the finest level, level 0
 * [m]. The spacings are chosen such that the lattice fits the bodies and cracks. */
void spacings_choose_for_convergence_study(struct spacings *spacings, const struct scene *s, int level_count,
                                           double finest_spacing);

/* Parameters in which a run of the study differs from the scene. */
struct study_point {
    int level;                     /* index of its level; -1: a run at the spacing of level 1 with a longer horizon */
    double spacing, step, horizon; /* spacing [m]; time step divided by that of the scene [1]; horizon [spacings] */
    int run;                       /* index among the runs of its level, from 0 */
};

/* State of a convergence study: its scene, its runs, and the parameters of each run. */
struct convergence_study {
    struct scene scene; /* the scene as given by the user */
    struct study study;
    struct study_point *point; /* [study.n] parameters of each run of `study` */
    int first;                 /* index of the first run, whose duration predicts those of the others */
    double refused;            /* largest spacing below which the scene is valid; INFINITY: not limited [m] */
    struct spacings spacings;  /* spacings of the levels */
    const struct scene_override *override; /* [overrides] overrides by the user; borrowed */
    int overrides;
    int runs[LEVELS_MOST];    /* number of runs of each level */
    bool fixed_horizon;       /* the horizon keeps its length [m] at all spacings, instead of its number of spacings */
    int own;                  /* level with the spacing of the scene; -1: that spacing exceeds the budget */
    double budget, begun;     /* allowed duration [s]; start time on wall_clock_seconds [s] */
    double spent, expected;   /* duration of the first run [s]; predicted duration of all runs, in parallel [s] */
    struct study_table table; /* results of all runs */
};

/* Convergence of one scalar result, and its sensitivity to parameters of the discretisation. */
struct scalar_result_study {
    const char *name;     /* name of the result; borrowed */
    char unit[UNIT_ROOM]; /* SI unit; "": none */
    struct convergence c; /* means, errors and order of convergence */
    double step_moves;    /* change of the result for a time step 10 % longer; NAN: unknown */
    double spacing_moves; /* change from level 1 to level 0 */
    double horizon_moves; /* change for a horizon one spacing longer, at level 1; NAN: unknown */
};

/* Request for a convergence study (`cleave converge`). */
struct convergence_request {
    const char *words;                     /* text of study_options_compose_from_arguments; NULL: unknown */
    const char *scene, *folder;            /* path of the scene; folder of the study, NULL: default */
    const struct scene_override *override; /* [overrides] values that replace those of the scene file */
    int overrides, levels, runs;           /* number of overrides; of levels; largest number of runs per level */
    double budget;                         /* allowed duration [s] */
    const char *const *wanted; /* [wanteds] names of requested results, with a warning if the first run lacks one;
                                * NULL: none requested */
    int wanteds;
    bool fixed_horizon, finer;    /* fixed_horizon: as in struct convergence_study; finer: also use spacings below that
                                   * of the scene if the budget allows */
    struct study_options options; /* options that all studies have */
};

/* Runs a convergence study as *request requests and stores its runs and results in *s. Scalar results of failed runs
 * are NAN in the table s->table. Returns REFUSED if the scene cannot be refined, if its runs cannot produce a requested
 * result, or if the time budget is too small (the message states the required one). Returns FAILED if the coarsest run
 * fails, INTERRUPTED if request->options.stop is set. Release s with convergence_study_free. */
status convergence_study_run(struct convergence_study *s, const struct convergence_request *request);

/* Frees the scene, runs and table of the convergence study *s, which convergence_study_run has filled. Files remain. */
void convergence_study_free(struct convergence_study *s);

/* Determines the convergence of the scalar results of the study s that describe the body and have values at all spacing
 * levels. wanted_names[wanted_count]: names of the results to be treated; if wanted_count is 0, all are. Stores an
 * allocated array with one entry per result in *figure, which the caller releases with memory_free, and its length in
 * *figure_count. Returns REFUSED if a named result does not exist, FAILED if no result has values at all levels. */
status scalar_results_determine_convergence(const struct convergence_study *s, const char *const *wanted_names,
                                            int wanted_count, struct scalar_result_study **figure, int *figure_count);

/* Checks that the table and the pictures of a convergence study may be written to `folder`. Returns REFUSED if `folder`
 * is that of a study and contains one of these files although Cleave did not write it. Returns OK for any other folder,
 * since study_lock_folder refuses it. */
status convergence_study_check_output_files_replaceable(const char *folder);

/* Writes the table of the scalar results results[result_count] to the file converge.csv in the folder of the study s,
 * and the text of the scene to study.yaml, the file by which the study is recognised. Returns FAILED if a file cannot
 * be written. */
status scalar_results_write(const struct convergence_study *s, const struct scalar_result_study *results,
                            int result_count);

/* Prints to standard output, for the scalar results figure[figures] of the study s: a table, a sentence on the
 * convergence of each result, and the parameter of the discretisation to which each result is most sensitive. */
void scalar_results_print(const struct convergence_study *s, const struct scalar_result_study *figure, int figures);

/* Draws the scalar results results[result_count] against the particle spacing as pictures/convergence.png in the folder
 * of the study s. If the runs have cracks, also draws the crack paths as pictures/path.png. Returns FAILED if a picture
 * cannot be drawn. */
status scalar_results_draw_over_spacing(const struct convergence_study *s, const struct scalar_result_study *results,
                                        int result_count);

#endif
