/* Checks of stability: each stops a run that diverges, with a message that names the cause and a remedy. */
#ifndef CLEAVE_CHECKS
#define CLEAVE_CHECKS

#include "base/rise.h"
#include "run/run.h"

/* Stores the largest speed of the particles p at t = 0 in s->start_speed [m/s]. Messages about unstable runs compare
 * later speeds with it. */
void stability_store_largest_initial_speed(struct stability *s, const struct particles *p);

/* Checks after a time step whether the run has become unstable. Returns FAILED if a particle is faster than the
 * fastest wave or its position is not finite, a cell of a mesh is inverted, bodies in contact overlap, a rigid body is
 * too fast, or a formula of a load has no finite value; the message states position, step, cause and remedy. */
status run_check_stability_after_step(struct run *run);

/* Checks whether a particle of the run moves faster than the fastest wave, or has a position or velocity that is not
 * finite. check_peridynamic: check the peridynamic particles too; check_mesh_points: check the material points of a
 * mesh too. Both may be false in a step in which the functions that move these particles detected no divergence.
 * Returns FAILED if there is such a particle; the message names its position, the step, the cause and a remedy. */
status run_check_particles_for_divergence(const struct run *run, bool check_peridynamic, bool check_mesh_points);

/* Checks the energies of the last sample (line of history.csv) of the run, if it was taken in this step; else returns
 * OK. Returns FAILED, with a remedy in the message, in four cases: more than half of the largest energy so far was
 * gained without work of loads or supports; breaking bonds have released more than a quarter of it beyond the energy
 * that they had stored; the velocities change sign in every step; an energy is not finite. */
status run_check_last_sample_for_energy_divergence(struct run *run);

/* Adds a warning to *to and prints it if the fracture energy of the last sample (line of history.csv) is below 0 by
 * more than 1e-3 of the largest energy of the run. s: scene of the run; diagnostics: energies of the last sample.
 * Returns true if there was reason to warn. */
bool fracture_energy_warn_if_negative(const struct scene *s, const struct diagnostics *diagnostics,
                                      struct warnings *warning_list);

/* Capacity of the text of run_describe_remedy_for_divergence [byte]. */
enum { REMEDY_LENGTH = 640 };

/* Writes to text[capacity] what the user should change in the scene of the diverging run run: the loads, if they
 * explain the motion of the body; the time step, if `growing_value` has grown as fast as in a run whose time step
 * exceeds the stability limit (base/rise.h); else the method or model. growing_value: current value of the quantity
 * that grows (square of a speed, or an energy); earlier_samples: its previous values. */
void run_describe_remedy_for_divergence(const struct run *run, const struct quantity_samples *earlier_samples,
                                        real growing_value, char *text, size_t capacity);

#endif
