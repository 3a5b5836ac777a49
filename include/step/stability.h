#ifndef CLEAVE_STABILITY
#define CLEAVE_STABILITY

#include "base/rise.h"
#include "run/run.h"

/* What stability checks compare (stability.c). */
struct stability {
    struct rise speed, excess; /* of the largest speed^2 [m^2/s^2]; of energy from nowhere [J] */
    real start_speed;          /* largest at t = 0 [m/s] */
    bool diverged;             /* a peridynamic particle moves faster than waves */
    bool lost;                 /* an energy of the last sample is no finite number */
    bool stretched;            /* the run has said that points are stretched past the reach of the law */
};

/* Notes the state at the start. */
void stability_make(struct run *e);
/* After every step: FAILED with place, step, cause and remedy where something moves faster than waves. */
status stability_check(struct run *e);
/* The divergence check alone; peridynamic particles and points of a mesh only if their flags are set. */
status divergence_check(const struct run *e, bool peridynamic, bool meshed);
/* After a sample: FAILED if energy appears from nowhere. */
status energy_check(struct run *e);
/* Energy that bonds released as they broke and had not held [J]. */
real energy_released(const struct diagnostics *w);
/* Is all energy so far below what round-off makes? */
bool energy_is_round_off(const struct run *e);
/* What to change, from how `value` has grown and what the loads have done, into `text`. */
enum { REMEDY_LENGTH = 640 };
void stability_remedy(const struct run *e, const struct rise *rise, real value, char *text, size_t room);

#endif
