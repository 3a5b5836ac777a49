/* Declares what the files pilot*.c share. Pilot runs are short runs at several particle spacings, by which method and
 * spacing are chosen if the input file has `method: auto`. */
#ifndef CLEAVE_PILOT_PARTS
#define CLEAVE_PILOT_PARTS

#include "output/output_files.h"
#include "scene/scene_read.h"
#include "study/convergence_study.h"
#include "study/pilot.h"

#define PILOT_FIRST_SHARE 0.6 /* of the budget for the first runs of all methods */
#define PILOT_LONGEST 20.0    /* largest expected time of the chosen run over the budget */
enum {
    PILOT_RUNS_FIRST = 3,
    PILOT_LEVELS_FIRST = 3
}; /* runs at each spacing and spacings of the first study of a
    * method */

/* A candidate of the choice by pilot runs (short runs at several spacings): one method, with its peridynamic model if
 * it has one, and the results of its pilot runs. */
struct pilot_candidate {
    const char *name, *method, *model; /* name of its folder; values of the keys `method` and `model`, model NULL if
                                        * there is none */
    double finest, finest_seconds;     /* finest spacing that was run [m]; duration of such a run [s] */
    double reached;          /* half-width of the error bar at the finest spacing, divided by the result [1] */
    double spacing, seconds; /* spacing that the wanted accuracy requires [m]; duration of such a run [s]; 0:
                              * unknown */
    double expected;         /* expected half-width at the required spacing, divided by the result [1] */
    double value, width;     /* result and half-width of its error bar at the finest spacing */
    bool seen;               /* a run at the required spacing exists */
    char failed[300];        /* reason why the method has no results; "": it has */
    bool unknown;            /* the runs have no result of the requested name */
};

/* State of one choice of method and particle spacing by pilot runs (short runs at several spacings): the input file,
 * the required accuracy and time, and the candidate methods with their results. */
struct pilot_search {
    const char *scene;                     /* path of the scene file; borrowed */
    const struct scene_override *override; /* [overrides] of the user; borrowed */
    int overrides;
    struct study_options options;        /* options of the studies */
    struct pilot_requirements wish;      /* wanted accuracy and time */
    char folder[PATH_ROOM], figure[128]; /* folder of the pilot runs; name of the result */
    double begun;                        /* start time on wall_clock_seconds [s] */
    struct pilot_candidate at[4];        /* [n] applicable methods */
    int n;
};

/* Lists the methods (peridynamics, material points, ..) that are applicable to the input file of `search` in
 * search->at[] and stores their number in search->n. Returns REFUSED, with a message, if no method is applicable, if
 * the particle spacing of the input file cannot be varied, or if no run of the input file has the requested result. */
status pilot_runs_list_applicable_methods(struct pilot_search *search);

/* Returns the name of the scalar result whose accuracy the input file requests, or a description of the default result
 * if it names none. The text belongs to *search or is static. */
const char *pilot_runs_get_requested_result_name(const struct pilot_search *search);

/* Allocates the array choice->override, after releasing an earlier one, and fills it. The first entries are the
 * overrides of the user, user_override[user_override_count]. They are followed by `chosen_key_count` keys that pilot
 * runs (short runs before the real one) have chosen, with the texts choice->key[k] and choice->value[k]. */
void pilot_runs_combine_user_and_chosen_overrides(struct pilot_choice *choice,
                                                  const struct scene_override *user_override, int user_override_count,
                                                  int chosen_key_count);

/* Determines, from `study`, the pilot runs (short runs at several spacings) of the method `candidate`, the particle
 * spacing that the method requires for the accuracy requested in `search`, and stores it with its cost in *candidate
 * (pilot_judge.c). Returns REFUSED, with a message, if no accuracy can be attributed to the result (it is missing or
 * zero), FAILED if no result has values at every spacing. */
status pilot_runs_determine_required_spacing(struct pilot_search *search, struct pilot_candidate *candidate,
                                             const struct convergence_study *study);

/* Prints the results of the pilot runs (short runs before the real one) of the method `candidate` to standard output:
 * spacing, accuracy, and expected time of the run. search: the input file and the requested accuracy. */
void pilot_runs_print_results_of_method(const struct pilot_search *search, const struct pilot_candidate *candidate);

/* Stores *choice, the method and spacing that pilot runs (short runs before the real one) have chosen, as files in
 * their folder, with the input file and the overrides for which it was made and the error bars of the chosen method
 * *chosen_method. search: state of the choice. Returns FAILED if the input file cannot be read or a file cannot be
 * written. */
status pilot_runs_store_chosen_method_and_spacing(const struct pilot_choice *choice, const struct pilot_search *search,
                                                  const struct pilot_candidate *chosen_method);

/* Reads the choice of method and spacing that earlier pilot runs (short runs before the real one) of the same input
 * file with the same overrides have stored, into *choice. search: the input file, its overrides and the folder of the
 * pilot runs. Returns false if there is none. */
bool pilot_runs_read_stored_method_and_spacing(struct pilot_choice *choice, const struct pilot_search *search);

#endif
