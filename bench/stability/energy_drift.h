/* What the files of the long map share: bodies that nothing breaks, and what becomes of their energy in 1e5
 * steps at the automatic step. */
#ifndef CLEAVE_BENCH_ENERGY_DRIFT
#define CLEAVE_BENCH_ENERGY_DRIFT

#include "stability.h"

enum drift_group {
    LASTING_NAMED,  /* scenes in which something grew once (energy_drift_named.c)              */
    LASTING_BODIES, /* bonds, states or cells of the reference frame alone                     */
    LASTING_REFERENCE,
    LASTING_CURRENT, /* coupled, by frame                                                       */
    LASTING_POINTS,  /* material points of the current frame alone                              */
    LASTING_SUPPORTS,
    LASTING_PUBLISHED, /* couplings published by others, drawn as what they are                   */
    LASTING_GROUP
};
extern const char *const drift_group_name[LASTING_GROUP];

/* A body, started at random unless `moves`. */
struct drift_case {
    enum drift_group group;
    const char *name; /* NULL: what drift_label makes of the rest */
    struct stability_case c;
    bool moves;    /* the scene's own initial state or load moves it */
    bool converts; /* what counts is that nothing converts */
};

/* Energies are what the energy balance has less the work of loads, over the energy at the start, or, where loads
 * gave it, over the largest. */
struct lasting {
    bool keeps; /* energy is to be kept, not only never to be exceeded: no points in the current frame */
    bool free;  /* nothing holds it: angular momentum is to be kept */
    int64_t particles, steps, stopped; /* stopped: the step in which the alarm came, 0: never */
    double end, largest, least;        /* energy - energy at the start [1] */
    double loudest;                    /* largest energy with velocities after the step [1] */
    double rate;                       /* growth of energy per step, fitted to its logarithm over the second half */
    double turn;      /* largest change of angular momentum over sum m |x| |v| of the start [1]; NAN: not measured */
    double converted; /* share that became peridynamic */
    bool inverted;    /* it had a negative energy: of points turned inside out */
    char why[NAME_MAX_LENGTH]; /* of a stop or a refusal */
    bool refused;
};

#define LASTING_ENERGY 0.005 /* what energy may change by, or exceed its start by */
/* A stable step of a share s of the critical one leaves motions 1/(1 - s^2) times their energy at the most, 2.8 at
 * 0.8. Beyond it what steps conserve is no bound any more: it stays while both its parts grow. */
#define LASTING_LOUDEST 4.0
#define LASTING_TURN 1e-6 /* of angular momentum, where forces are those of one energy and places are exact */
enum { LASTING_STEPS = 100000, LASTING_STEPS_QUICK = 10000 };

/* 0.5 % in as many steps as the map takes. */
#define LASTING_RATE (LASTING_ENERGY / LASTING_STEPS)

/* Runs it for so many steps on one thread. FAILED where the bench itself fails. */
status drift_run(const struct drift_case *l, int64_t steps, struct lasting *to);
bool drift_holds(const struct drift_case *l, const struct lasting *r);
void drift_label(const struct drift_case *l, char *text, size_t size);

/* All cases, with `quick` each fourth of them, one after the other (energy_drift_cases.c); those of scenes that once
 * grew (energy_drift_named.c). */
typedef status drift_take(void *context, const struct drift_case *l);
status drift_cases(bool quick, drift_take *take, void *context);
extern const struct drift_case drift_named[];
extern const int drift_named_count;

/* The table, on the screen, in results/bench/stability_lasting.csv and as a picture; `only`: cases in whose name
 * this is, NULL: all (energy_drift.c, energy_drift_draw.c). */
status drift_map(struct bench_table *t, const char *only, bool quick);
status drift_draw(const struct bench_table *t);

#endif
