/* Samples: the lines of history.csv. A sample describes the body at the start t_n of a time step. It is taken in three
 * parts within this step, since energies are known only once forces are, and velocities only half a step before and
 * after t_n. */
#ifndef CLEAVE_SAMPLE
#define CLEAVE_SAMPLE

#include "run/run.h"

/* Allocates the record of a sample (the values of a line of history.csv) of the run, opens history.csv, and writes
 * the header: the columns common to all runs, those of the probes, and those of contact, cracks and the other parts of
 * the run. resume: append to the file of an interrupted run instead. Returns FAILED if the file cannot be written. */
status history_sample_open_csv_file(struct run *run, bool resume);

/* Begins a sample (line of history.csv) of the run at time t_n, the start of this time step, if this step requires
 * one. Must be called before the step moves particles. Computes momentum, crack tips and the values of probes that
 * depend on positions, and stores the velocities, which are those at t_n - dt/2 (at t = 0 in the first step). */
void history_sample_begin_before_step_if_due(struct run *run);

/* Computes the energies of a sample (line of history.csv) of the run, if this step requires one, at the positions of
 * time t_n, the start of this time step, except the kinetic energy. Must be called after the forces have been computed
 * and before particles move. */
void history_sample_compute_energies(struct run *run);

/* Completes a sample (line of history.csv) of the run, if this step requires one, after particles have moved:
 * interpolates velocities to time t_n, the start of this time step, computes the kinetic energy and the work up to t_n,
 * and writes the line of history.csv. */
void history_sample_complete_after_step_if_due(struct run *run);

/* Takes a complete sample of the run, whose body is in equilibrium, and writes its line of history.csv. Must be
 * called at the start of a static run and after each load step. */
void history_sample_write_in_equilibrium(struct run *run);

/* Takes the sample of the run after its last time step and writes the line of history.csv. Brings positions,
 * velocities and stresses of all particles up to date, except the stress of peridynamic particles
 * (bonds_compute_particle_stress). */
void history_sample_write_after_last_step(struct run *run);

/* Returns the elastic energy of the bonds, material points and mesh cells of the run at the present positions [J]. */
real run_compute_elastic_energy(struct run *run);

/* Updates the probes of the run that observe every step: BREAK (first broken bond), SPALL and REACTION (force of a
 * support) probes. In a static run, must be called in equilibrium states only. */
void run_update_break_and_reaction_probes(struct run *run);

/* Records the bonds of the run that broke in this step: updates the first break of the run and the BREAK probes (first
 * broken bond of a region) and SPALL probes (separated end of a bar), and warns if driven particles (with prescribed
 * motion) lose bonds. broken_bond_count: number of bonds that broke, each counted once for each of its particles. */
void run_record_first_break_and_update_break_probes(struct run *run, int64_t broken_bond_count);

#endif
