/* floor 3: the critical time step of any peridynamic law, by power iteration on its linearised force. */
#ifndef CLEAVE_CRITICAL_STEP_H
#define CLEAVE_CRITICAL_STEP_H

#include "kernels.h"

/* 2/omega_max [s] of all rows of b, which must be of the whole body: the largest eigenvalue of M^-1 K, where K d is the
 * force at X + s d over s for strains of 1e-7. The iteration comes from below; it ends when stationary to 0.1 %, and the
 * result is lowered by 2 %. Particles are left as they were but for p->f. */
real critical_step_of(struct bonds *b, struct particles *p, bond_force_fn *force, real spacing);

/* The same of a block of full lattice with free surfaces, made for it: where a body is not all peridynamic. */
real critical_step_of_lattice(const struct bond_source *source, bond_force_fn *force, real density);

#endif
