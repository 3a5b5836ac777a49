/* The critical time step of any peridynamic law: 2/omega_max of its linearised force. */
#ifndef CLEAVE_CRITICAL_STEP
#define CLEAVE_CRITICAL_STEP

#include "kernels/kernels.h"
#include "loads/loads.h"

/* A body of bonds as an operator on vectors of n numbers along x, then y, then z. */
struct bond_body {
    struct bonds *b; /* of the whole body */
    struct particles *p;
    bond_force_fn *force;
    const struct loads *loads; /* NULL: no mirror images follow */
    real spacing, *root;       /* [m]; [n] of the masses [kg^1/2] */
};

struct bond_body bond_body_make(struct bonds *b, struct particles *p, bond_force_fn *force, const struct loads *loads,
                                real spacing);
void bond_body_free(struct bond_body *body);

/* y = M^-1/2 K M^-1/2 u [1/s^2], K d the force at X + s d over s for strains of 1e-7; moves p->x. */
void bond_body_stiffness(void *bond_body, const real *u, real *y);

/* 2/omega_max [s] of all rows of b, which must be of the whole body: the largest eigenvalue of M^-1 K, where K d is the
 * force at X + s d over s for strains of 1e-7, lowered by 2 % since the iteration comes from below. Mirror images of
 * `loads` (NULL: none) follow. Particles are left as they were but for p->f. */
real critical_step_of(struct bonds *b, struct particles *p, bond_force_fn *force, const struct loads *loads,
                      real spacing);

/* The same of a block of full lattice with free surfaces, made for it: no body that is part of this lattice moves
 * faster. `longest` [m]: the edges of the bodies in question. `bound`: the block's block-Gershgorin bound [s]. */
real critical_step_of_lattice(const struct bond_source *source, bond_force_fn *force, real density, const real *longest,
                              real *bound);

#endif
