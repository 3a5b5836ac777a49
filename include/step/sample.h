/* Samples: the lines of history.csv. A sample describes the body at t_n. It is taken in three parts within the step
 * from t_n, since the energies are known once forces are, and velocities are half a step before and after t_n. */
#ifndef CLEAVE_SAMPLE
#define CLEAVE_SAMPLE

#include "run/run.h"

/* Opens history.csv and writes its header: columns of all runs, of probes and of the parts of the run. resume:
 * append to the file of an interrupted run. Returns FAILED if the file cannot be written. */
status sample_start(struct run *e, bool resume);

/* Begins a sample, if one is due, before the step moves anything: positions, damage, tips and probes of t_n;
 * velocities of t_n - dt/2 (of t = 0 in the first step). */
void sample_begin(struct run *e);

/* Computes the energies of a sample at the positions of t_n, after the forces and before the motion. */
void sample_energy(struct run *e);

/* Ends a sample after the motion: interpolates velocities to t_n, computes the kinetic energy and the work up to
 * t_n, and writes the line of history.csv. */
void sample_end(struct run *e);

/* Takes a whole sample of a body in equilibrium: at the start, and after a load step. */
void sample_rest(struct run *e);

/* Takes the last sample, after the last step. Synchronises all particles, except for the stress of peridynamic ones
 * (run_stress). */
void sample_last(struct run *e);

/* Returns the elastic energy of bonds, material points and cells at the present positions [J]. */
real sample_strain(struct run *e);

/* Updates probes that observe every step (BREAK, SPALL, REACTION). In a static run, call it at equilibrium only. */
void sample_probes(struct run *e);

/* Records the bonds that broke in this step: the first break, probes, and a warning if driven particles lose bonds.
 * broken: number of directed bonds. */
void sample_breaks(struct run *e, int64_t broken);

#endif
