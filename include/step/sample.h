/* Samples: the lines of history.csv. A sample describes t_n, between two phases of a step. */
#ifndef CLEAVE_SAMPLE
#define CLEAVE_SAMPLE

#include "run/run.h"

/* Opens history.csv: the columns of every run, then those of probes and of the parts of the run. */
status sample_start(struct run *e, bool resume);
/* Before the step: positions, damage, and velocities half a step behind (of t = 0 in the first). */
void sample_begin(struct run *e);
/* Between forces and motion: energies at the positions of t_n. */
void sample_energy(struct run *e);
/* After the motion: the kinetic energy between the velocities before and after, the work up to t_n, and the line of
 * history.csv. */
void sample_end(struct run *e);
/* Takes a sample of a body at rest: at the start, and after a load step. */
void sample_rest(struct run *e);
/* The last sample, after the last step. All particles are up to date after it, but for the stress of peridynamic ones
 * (run_stress). */
void sample_last(struct run *e);
/* Elastic energy of all particles and cells where they are [J]. */
real sample_strain(struct run *e);
/* Calls the probes that look at every step. In a static run that is once, at the equilibrium: steps on the way to it
 * are no states of the body. */
void sample_probes(struct run *e);
/* Records so many broken directed bonds; of a run in time it then calls those probes. */
void sample_breaks(struct run *e, int64_t broken);

#endif
