/* Bulk viscosity: a pressure against rapid compression, which spreads a shock over a few spacings so that its
 * front does not oscillate (von Neumann & Richtmyer 1950; linear term: Landshoff 1955). While the rate of
 * dilatation D = tr L of a particle is negative (L: velocity gradient), the pressure is
 *
 *     q = rho h (quadratic h D^2 - linear c D),
 *
 * with density rho, wave speed c, the coefficients `quadratic` and `linear` of the material, and the resolved
 * length h: the edge of a cell, or the length of a bond. A bond exerts the viscous force along its direction,
 * with its stretch rate in place of D. The viscosity only dissipates energy. */
#ifndef CLEAVE_VISCOSITY
#define CLEAVE_VISCOSITY

#include "run/run.h"

/* Viscous forces of the last step; the arrays are NULL if no material is viscous. The work in a step is the mean of the
 * forces of two successive steps times the motion between them, as leap-frog requires. */
struct viscosity {
    real *bonds[DIM_MAX];  /* [n] viscous forces of bonds on particles [N] */
    real *nodes[DIM_MAX];  /* [mesh.grid.n] viscous forces of cells on nodes [N] */
    real *pressure;        /* [n] q of points on the grid [Pa] */
    real *volume;          /* [n] volume of points on the grid when q was computed; 0 before the first time [m^3] */
    real *stress[DIM_MAX]; /* [n] stress of points without q, while their stress includes q [Pa] */
    real *work;            /* [n] energy dissipated in a step [J] */
    real taken;            /* energy dissipated so far [J] */
    const struct material *material; /* [materials] of the scene, kept by reference */
    real cell;                       /* edge of a cell of the grid and of the reference frame [m] */
    bool small_strain;               /* cells of the reference frame have small strains: F = 1 */
};

/* Adds the viscous forces of bonds of the run to the forces of particles, and computes the viscous pressure q of
 * points on the grid. Adds the energy dissipated since the previous step to viscosity.taken of the run. Must be called
 * after the bond forces and before the loads are added. Does nothing if no material is viscous. */
void bulk_viscosity_add_bond_forces_and_pressure(struct run *run);

/* Changes the normal stresses of points of p on the grid by the viscous pressure q of v: subtracts it if
 * `subtract_pressure` is true, before stresses are mapped to nodes; restores the stresses without q if
 * `subtract_pressure` is false. Does nothing if no material is viscous. */
void bulk_viscosity_change_or_restore_point_stress(struct viscosity *v, const struct particles *p,
                                                   bool subtract_pressure);

/* Adds the viscous forces of cells to the nodal forces of the mesh (fixed to the material), and the energy dissipated
 * by these forces since the previous step to viscosity.taken of the run. Does nothing if no material is viscous. */
void bulk_viscosity_add_nodal_forces(struct run *run);

/* Returns the factor by which viscosity reduces the critical time step, sqrt(1 + Q^2) - Q [1]. Q is the largest ratio
 * of viscous pressure to rho c^2 (density rho, wave speed c) to be expected from the speeds of bodies, supports and
 * loads. initial_speed: the largest speed of the particles p at t = 0 [m/s]. */
real bulk_viscosity_time_step_factor(const struct scene *s, const struct loads *loads, const struct particles *p,
                                     real initial_speed);

#endif
