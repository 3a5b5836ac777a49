/* `cleave bench stability=lasting`: observes the energy of unbreakable bodies over 1e5 automatic time steps.
 * Declarations shared by its files. */
#ifndef CLEAVE_BENCH_ENERGY_DRIFT
#define CLEAVE_BENCH_ENERGY_DRIFT

#include "stability.h"

/* Groups of cases whose energy is observed over many steps, by what the body consists of or how it moves. */
enum drift_group {
    LASTING_NAMED,  /* scenes in which the energy grew in an earlier version (energy_drift_named.c) */
    LASTING_BODIES, /* only bonds, only states, or only cells of the reference frame */
    LASTING_REFERENCE,
    LASTING_CURRENT, /* coupled, in the current frame; LASTING_REFERENCE: in the reference frame */
    LASTING_POINTS,  /* only material points in the current frame */
    LASTING_SUPPORTS,
    LASTING_PUBLISHED, /* couplings from the literature, drawn for comparison */
    LASTING_GROUP
};
extern const char *const drift_group_name[LASTING_GROUP];

/* A case: an unbreakable body whose energy is observed over many steps. It starts with random velocities unless `moves`
 * is true. */
struct drift_case {
    enum drift_group group;
    const char *name; /* label; NULL: composed by drift_label */
    struct stability_case c;
    bool moves;    /* moved by the scene's own initial state or load */
    bool converts; /* the case tests that nothing converts */
};

/* Result of a case. Energies are those of the energy balance minus the work of loads, relative to the initial energy
 * or, if loads did the work, to the largest. */
struct lasting {
    bool keeps; /* the energy must be constant, not only bounded: no points in the current frame */
    bool free;  /* no supports: the angular momentum must be constant */
    int64_t particles, steps, stopped; /* stopped: step at which the run stopped as unstable, 0: never */
    double end, largest, least;        /* energy minus initial energy: at the end, largest, least [1] */
    double loudest;                    /* largest energy computed with the velocities after the step [1] */
    double rate;                       /* growth rate of the energy per step, fitted to its logarithm over the second
                                        * half */
    /* largest change of angular momentum, divided by the initial sum of m |x| |v| [1]; NAN: not measured */
    double turn;
    double converted;          /* share of particles converted to peridynamics */
    bool inverted;             /* the energy was negative at times: inverted points */
    char why[NAME_MAX_LENGTH]; /* reason of a stop or a refusal */
    bool refused;
};

#define LASTING_ENERGY 0.005 /* allowed change or excess of the energy */
/* Allowed peak of the energy. With a stable step of s times the critical one, the conserved quantity allows motions of
 * up to 1/(1 - s^2) times their energy, 2.8 at s = 0.8. Above the critical step the conserved quantity bounds nothing:
 * it stays constant while both its parts grow. */
#define LASTING_LOUDEST 4.0
/* allowed change of angular momentum, where forces derive from one energy and positions are exact */
#define LASTING_TURN 1e-6
enum { LASTING_STEPS = 100000, LASTING_STEPS_QUICK = 10000 };

/* Growth rate that changes the energy by 0.5 % over the steps of the map. */
#define LASTING_RATE (LASTING_ENERGY / LASTING_STEPS)

/* Runs the case `drift_case` for `steps` steps on one thread and stores energy, growth rate and angular momentum in
 * *result. Returns FAILED if the bench itself fails; a run that stops as unstable or is refused is a result. */
status drift_run(const struct drift_case *drift_case, int64_t steps, struct lasting *result);

/* Returns true if `result` meets the requirements of the case `drift_case` on energy, growth rate and angular momentum.
 */
bool drift_holds(const struct drift_case *drift_case, const struct lasting *result);

/* Writes the label of the case `drift_case`, its name or its settings in words, to text[capacity]. */
void drift_label(const struct drift_case *drift_case, char *text, size_t capacity);

/* Type of a function that drift_call_for_all_cases calls for each case l. context: the argument `context` of
 * drift_call_for_all_cases. A returned status that is not OK ends the calls. */
typedef status drift_take(void *context, const struct drift_case *l);

/* Calls callback(context, case) for all cases in which the drift of the energy is measured (energy_drift_cases.c).
 * quick: true for every fourth case only. Returns the first status that is not OK; OK if there is none. */
status drift_call_for_all_cases(bool quick, drift_take *callback, void *context);

/* Cases of the group LASTING_NAMED, scenes in which the energy grew in an earlier version (energy_drift_named.c). */
extern const struct drift_case drift_named[];
extern const int drift_named_count;

/* Runs all cases of the drift of the energy, or those whose name contains `case_name_part` if it is not NULL, prints
 * their results, and fills `table`, the contents of results/bench/stability_lasting.csv (energy_drift.c). quick: fewer
 * cases and steps. Returns FAILED if the bench itself fails. */
status drift_run_all_cases(struct bench_table *table, const char *case_name_part, bool quick);

/* Draws the picture of the results in `table`, which drift_run_all_cases has filled, to results/bench
 * (energy_drift_draw.c). Returns FAILED if it cannot be drawn. */
status drift_draw(const struct bench_table *table);

#endif
