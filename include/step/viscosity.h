/* Bulk viscosity: a pressure against rapid compression, which spreads a shock over some spacings so that it does not
 * ring (von Neumann & Richtmyer 1950; the linear term: Landshoff 1955). While a particle is compressed at the rate
 * D = tr L < 0,
 *
 *     q = rho h (quadratic h D^2 - linear c D),
 *
 * c the wave speed, h the length that resolves it: the edge of a cell, the length of a bond. Bonds bear the same along
 * the bond, by their rate of stretch in place of D. It only takes energy. */
#ifndef CLEAVE_VISCOSITY
#define CLEAVE_VISCOSITY

#include "run/run.h"

/* Forces at the last step (NULL: no material is viscous), whose mean with those of now does the work between, by the
 * velocities between (as leap-frog takes it from the motion). */
struct viscosity {
    real *bonds[DIM_MAX];            /* [n] forces of bonds on particles [N] */
    real *nodes[DIM_MAX];            /* [mesh.grid.n] forces of cells on nodes [N] */
    real *pressure;                  /* [n] q of points on the grid [Pa] */
    real *volume;                    /* [n] theirs, when q was taken; 0: there is none yet [m^3] */
    real *stress[DIM_MAX];           /* [n] what their stress is without q, while it is lent [Pa] */
    real *work;                      /* [n] taken in a step [J] */
    real taken;                      /* energy so far [J] */
    const struct material *material; /* [materials] of the scene, borrowed; with the arrays */
    real cell;                       /* edge of a cell of the grid and of the reference frame [m] */
    bool small_strain;               /* of cells of the reference frame: F = 1 */
};

/* Adds the forces of bonds to those on particles, takes q of points on the grid; books what the step before has taken.
 * After the forces of bonds, before loads. */
void viscosity_push(struct run *e);
/* Subtracts q from the stress of points on the grid (`on`), before nodes get their forces; restores the stress after.
 */
void viscosity_lend(struct viscosity *v, const struct particles *p, bool on);
/* Adds the forces of cells to those on the nodes of the reference frame, and books their work. */
void viscosity_push_nodes(struct run *e);
/* Share of the critical step that it leaves, sqrt(1 + q^2) - q with the largest q over rho c^2 to be expected, by the
 * speeds of the start and of supports [1]. */
real viscosity_step_share(const struct scene *s, const struct particles *p);

/* The fastest collision of the bodies of a scene in its duration, by their velocities at the start [m/s]; share: over
 * the speed of a front that breaks or yields them, 0 where viscosity would not help or the collision is slow [1]. */
struct shock {
    real speed, share;
};
struct shock shock_expected(const struct scene *s);

#endif
