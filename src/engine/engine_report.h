/* Output of the step loop: samples (engine_sample.c), frames, checkpoints, progress (engine_report.c). */
#ifndef CLEAVE_ENGINE_REPORT
#define CLEAVE_ENGINE_REPORT

#include "engine/engine.h"

/* Does a frame follow the step to come? */
bool engine_frame_follows(const struct run *e);

/* Opens history.csv: the columns of every run, then those of the probes. */
status engine_history_start(struct run *e, bool resume);

/* True if the step to come is one of those that samples are spread over. */
bool engine_sample_due(const struct scene *s, const struct run_clock *clock);

/* A sample describes t_n. `begin`, before the step: positions, damage, and velocities half a step behind (of t = 0 in
 * the first). `energy`, between forces and motion: energies at the positions of t_n. `end`: the kinetic energy between
 * the velocities before and after, the work up to t_n, and the line of history.csv. */
void engine_sample_begin(struct run *e);
void engine_sample_energy(struct run *e);
void engine_sample_end(struct run *e);

/* Sets v to the velocity of the k-th rigid body now, half a kick of the last forces beyond leap-frog's [m/s]. */
void engine_rigid_velocity(const struct run *e, int k, real *v);

/* A sample of a body at rest on which nothing has done work. */
void engine_sample_rest(struct run *e);
/* Elastic energy of all particles and cells where they are [J]. */
real engine_strain_energy(struct run *e);
/* A sample of a body at rest after a load step. */
void engine_sample_equilibrium(struct run *e);
/* The last sample, after the last step. All particles are up to date after it, but for the stress of peridynamic ones
 * (engine_stress). */
void engine_sample_last(struct run *e);

/* Calls the probes that look at every step. In a static run that is once, at the equilibrium: steps on the way to it
 * are no states of the body. */
void engine_probes_step(struct run *e);
/* Records broken bonds (`broken`: their number in this step); of a run in time it then calls those probes. */
void engine_breaks(struct run *e, int64_t broken);

/* Largest nodal force of the first step, for patch probes. Called between the first map and the motion of the nodes; in
 * a body without material points it uses the particles only. */
void engine_residual(struct run *e);
/* Largest force on the nodes of grid g in the first step, for patch probes. */
void engine_residual_of(struct run *e, const struct grid *g);

/* What a frame is asked for that particles do not keep (engine_fields.c): made once all particles are up to date and
 * extra->more is known; freed when the frame has been begun. */
void engine_fields_make(struct run *e, unsigned asked, struct frame_extra *extra);
void engine_fields_free(struct frame_extra *extra);

/* Profiles of probes (engine_profiles.c). write: with the frame just written; check: a warning of profiles that a
 * resumed run lacks; remove: those of an older run, before a run that replaces it. */
status engine_profiles_write(struct run *e);
void engine_profiles_check(struct run *e);
void engine_profiles_remove(struct run *e);

#endif
