/* Energies, momentum and stress of the particles of a run. */
#ifndef CLEAVE_ENERGIES
#define CLEAVE_ENERGIES

#include "run/run.h"

/* Returns the fraction 1 - tr M/n [1] of the strain energy density of the material point with index i that is not
 * carried by bonds across its grid cell. M: matrix by which the partial stress (part of the stress that bonds carry)
 * follows from the stress of the point; n: number of components of a symmetric tensor in `dim` dimensions. The fraction
 * is exact if M is a multiple of the identity, as in 1D. partial: partial stresses of all points; NULL returns 1. */
real point_energy_fraction_not_carried_by_bonds(const struct partial_stress *partial, int dim, int64_t i);

/* Returns the kinetic energy 1/2 sum m v^2 of all particles p [J], with mass m and velocity v of each. Material points
 * of a mesh are left out, since their kinetic energy is that of the mesh nodes (lagrangian_mesh_kinetic_energy). */
real particles_kinetic_energy(const struct particles *p);

/* Returns the elastic strain energy of the material points of p on the background grid [J]: 1/2 sum sigma : C^-1 :
 * sigma V, without the part of the stress that bonds carry. In plane strain the energy of the change of sigma_zz by
 * plastic flow is included. m: array of the materials; partial: stress carried by bonds (partial stress), NULL for
 * none. */
real points_strain_energy(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* Returns the elastic strain energy [J] of those material points that are among the particles of p in
 * point_list[point_count] (indices): 1/2 sum sigma : C^-1 : sigma V with stress sigma, elastic stiffness C and volume V
 * of each point, without the part of the stress that bonds carry. m: array of the materials; partial: that part
 * (partial stress), NULL for none. */
real points_strain_energy_of_listed_points(const struct particles *p, const struct material *m,
                                           const struct partial_stress *partial, const int32_t *point_list,
                                           int64_t point_count);

/* Returns the plastic work of the material points of p [J]: sum V (sigma_y a + H a^2/2) with the yield stress sigma_y,
 * the hardening modulus H and the accumulated plastic strain a. For materials with a flow law it is the plastic work
 * stored with the points. m: array of the materials; partial: stress carried by bonds (partial stress), NULL for
 * none. */
real points_plastic_work(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* Returns the difference between two kinetic energies of a leap-frog velocity update [J]: the mean of 1/2 m v^2 at the
 * old and the new velocity, minus 1/2 m v_old . v_new, which leap-frog conserves. It equals 1/4 sum m (v - v_old)^2;
 * particles with prescribed motion and material points of a mesh are excluded. old_velocity: velocities v_old before
 * the update [m/s], dim arrays of n; NULL, allowed if no particles are on the background grid, takes v - v_old = dt f/m
 * from the forces p->f. dt: time step [s]. */
real particles_mean_minus_leapfrog_kinetic_energy(const struct particles *p, real *const *old_velocity, real dt);

/* Computes the linear momentum of all particles p and all mesh nodes. nodes: `grid_count` pointers to the grids of the
 * meshes; momentum: receives dim components [kg m/s]; momentum_scale: receives the sum of the magnitudes |m v| of all
 * contributions [kg m/s], to which round-off errors of the momentum can be compared; NULL: not computed. */
void particles_linear_momentum(const struct particles *p, const struct grid *const *nodes, int grid_count,
                               real *momentum, real *momentum_scale);

/* Computes the state of each neighbourhood of the bonds b at the current positions of p, before forces, stresses or
 * energies of state-based peridynamics are computed: pressure (force by dilatation), spring stiffness (force by
 * extension) and rotation. Does nothing for bond-based models. source: bond law, which determines the model. */
static inline void families_compute_pressure_rotation_and_stiffness(struct bonds *b, struct particles *p,
                                                                    const struct bond_source *source)
{
    if (source->modulus) state_precompute_table[p->dim][source->rotates ? PD_MOSPD : PD_OSPD](b, p);
}

/* Computes the stress [Pa] of all peridynamic particles from their bonds in b at the present positions, and stores it
 * in the stress arrays of p. Time steps do not need this stress. Call the function before stresses are written to
 * files, and before they determine which particles revert to material points. source: bond law; kernels: compiled loops
 * for the vector instructions of this machine. */
void bonds_compute_particle_stress(struct bonds *b, struct particles *p, const struct bond_source *source,
                                   const struct kernels *kernels);

#endif
