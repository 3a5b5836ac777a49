/* Energies, momentum and stress of the particles of a run. */
#ifndef CLEAVE_ENERGIES
#define CLEAVE_ENERGIES

#include "run/run.h"

/* Returns the share of its energy density that material point i keeps if bonds carry a part of its stress: 1 - tr M/n
 * [1], with n symmetric components; exact where M is a multiple of the identity, as in 1D. partial: NULL, all of it. */
real point_own_share(const struct partial_stress *partial, int dim, int64_t i);

/* Returns the kinetic energy 1/2 sum m v^2 of all particles but the points of a mesh, whose nodes carry it [J]. */
real diagnostics_kinetic(const struct particles *p);

/* Returns the strain energy of the material points on the grid: 1/2 sum sigma_given : C^-1 sigma V [J], in plane strain
 * with the energy of the change of sigma_zz by plastic flow. m: [materials]; partial: partial stresses, NULL: none. */
real diagnostics_strain(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* Returns the strain energy of the material points among n listed particles, as diagnostics_strain [J]. */
real diagnostics_strain_of(const struct particles *p, const struct material *m, const struct partial_stress *partial,
                           const int32_t *list, int64_t n);

/* Returns the plastic work of the material points, sum V (sigma_y a + H a^2/2) with the accumulated plastic strain a
 * [J]. */
real diagnostics_plastic(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* Returns the excess of the mean of 1/2 m v^2 before and after a leap-frog kick over 1/2 m v_old . v_new, the kinetic
 * energy that leap-frog conserves [J]: 1/4 sum m (v - before)^2 of all particles but the points of a mesh. before:
 * velocities before the kick [dim][n, m/s]; NULL, if no particles are on the grid: 1/4 sum m (dt f/m)^2 with the
 * present forces. */
real diagnostics_kick(const struct particles *p, real *const *before, real dt);

/* Computes the momentum of the particles and of the nodes of `grids` meshes (nodes) by component [dim, kg m/s]. Returns
 * the sum of |m v|, a scale for errors. */
real diagnostics_momentum_of(const struct particles *p, const struct grid *const *nodes, int grids, real *momentum);

/* Computes the states (weighted volumes, dilatations) of all families at the present positions; nothing for bond-based
 * models. */
static inline void states_precompute(struct bonds *b, struct particles *p, const struct bond_source *s)
{
    if (s->modulus) state_precompute_table[p->dim][s->rotates ? PD_MOSPD : PD_OSPD](b, p);
}

/* Computes the stress of peridynamic particles, which steps do not need: for samples, frames and reversion. */
void run_stress(struct bonds *b, struct particles *p, const struct bond_source *s, const struct kernels *kernels);

#endif
