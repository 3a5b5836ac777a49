/* Critical time step 2/omega_max of any peridynamic law, from the largest frequency of its linearised force. */
#ifndef CLEAVE_CRITICAL_STEP
#define CLEAVE_CRITICAL_STEP

#include "kernels/kernels.h"
#include "loads/loads.h"

/* A body of n particles with bonds, as a linear operator on vectors [dim][n]. */
struct bond_body {
    struct bonds *b; /* rows of all particles of the body */
    struct particles *p;
    bond_force_fn *force;
    const struct loads *loads; /* whose mirror images move with the body; NULL: none */
    real spacing, *root;       /* of particles [m]; [n] square roots of the masses [kg^1/2] */
};

/* Returns the operator for the bonds b of particles p; all arguments are kept by reference. Release with
 * bond_body_free. */
struct bond_body bond_body_make(struct bonds *b, struct particles *p, bond_force_fn *force, const struct loads *loads,
                                real spacing);

/* Releases the masses. */
void bond_body_free(struct bond_body *body);

/* Computes y = M^-1/2 K M^-1/2 u [1/s^2]. K d is the difference of the forces at X + s d over s; s is chosen such that
 * strains are about 1e-7. bond_body: struct bond_body; u, y: [dim][n]. Changes p->x and p->f. */
void bond_body_stiffness(void *bond_body, const real *u, real *y);

/* Returns 2/omega_max [s] for all rows of b, which must cover the whole body: omega_max^2 is the largest eigenvalue of
 * M^-1 K by an iteration from below, therefore the result is reduced by 2 %. loads: whose mirror images move with the
 * body, NULL: none; spacing: of particles [m]. Changes p->f only. */
real critical_step_of(struct bonds *b, struct particles *p, bond_force_fn *force, const struct loads *loads,
                      real spacing);

/* Returns the critical step of a block of full lattice with free surfaces, made by the function [s]: no body that is a
 * part of the lattice has a larger frequency. density [kg/m^3]; longest: extents of the bodies in question [dim, m];
 * bound: NULL, or set to the block-Gershgorin bound of the critical step of the block [s]. */
real critical_step_of_lattice(const struct bond_source *source, bond_force_fn *force, real density, const real *longest,
                              real *bound);

#endif
