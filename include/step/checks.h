/* Checks of stability: when a run that diverges is stopped, and with which remedy. */
#ifndef CLEAVE_CHECKS
#define CLEAVE_CHECKS

#include "base/rise.h"
#include "run/run.h"

/* Notes the largest speed of particles, at the start. */
void stability_make(struct stability *s, const struct particles *p);
/* After every step: FAILED with place, step, cause and remedy where something moves faster than waves. */
status stability_check(struct run *e);
/* The divergence check alone; peridynamic particles and points of a mesh only if their flags are set. */
status divergence_check(const struct run *e, bool peridynamic, bool meshed);
/* After a sample: FAILED if energy appears from nowhere. */
status energy_check(struct run *e);
/* Energy that bonds released as they broke and had not held [J]. */
real energy_released(const struct diagnostics *w);
/* True if all energy so far is below what round-off makes. mass: of the body [kg]; wave_speed: the fastest [m/s]. */
bool energy_is_round_off(const struct diagnostics *w, real mass, real wave_speed);
/* What to change, from how `value` has grown and what the loads have done, into `text`. */
enum { REMEDY_LENGTH = 640 };
void stability_remedy(const struct run *e, const struct rise *rise, real value, char *text, size_t room);

#endif
