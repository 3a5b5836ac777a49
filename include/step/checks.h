/* Stability checks: stop a run that diverges, and name the cause and a remedy. */
#ifndef CLEAVE_CHECKS
#define CLEAVE_CHECKS

#include "base/rise.h"
#include "run/run.h"

/* Stores the largest speed of particles at the start, with which later speeds are compared. */
void stability_make(struct stability *s, const struct particles *p);

/* Checks a run after every step. FAILED, with position, step, cause and remedy, if a particle is faster than the
 * fastest wave, a cell of a mesh is inverted, bodies in contact overlap, or a formula of a load has no finite
 * value. */
status stability_check(struct run *e);

/* Checks for particles that are faster than the fastest wave or at positions that are not finite; FAILED as in
 * stability_check. peridynamic, meshed: check peridynamic particles, and points of a mesh, too; the kernels that
 * move them report divergence in every step. */
status divergence_check(const struct run *e, bool peridynamic, bool meshed);

/* Checks the energies of the last sample, if one was due in this step. Returns FAILED if the body gained energy that
 * nothing supplied, or an energy is not finite. */
status energy_check(struct run *e);

/* Returns the energy that bonds released when they broke beyond what they had stored [J]. */
real energy_released(const struct diagnostics *w);

/* Returns true if the energies of the run so far are round-off: below 1e-24 of the kinetic energy that the whole
 * body has at its wave speed. mass: of the body [kg]; wave_speed: the fastest [m/s]. */
bool energy_is_round_off(const struct diagnostics *w, real mass, real wave_speed);

enum { REMEDY_LENGTH = 640 };

/* Writes to text [room] what to change in the scene: the loads, if they explain the motion; the time step, if
 * `value` has grown as fast as only an unstable step makes it grow (base/rise.h); else other methods. rise: earlier
 * values; value: the present one. */
void stability_remedy(const struct run *e, const struct rise *rise, real value, char *text, size_t room);

#endif
