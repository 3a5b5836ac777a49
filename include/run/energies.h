/* Energies, momentum and stress of the particles of a run. */
#ifndef CLEAVE_ENERGIES
#define CLEAVE_ENERGIES

#include "run/run.h"

/* Share of its energies that point i keeps where it leaves part of its stress to bonds, 1 - tr M/n [1]: exact where
 * that part is equal for all stresses, as in one dimension. */
real point_own_share(const struct partial_stress *partial, int dim, int64_t i);

/* Kinetic energy 1/2 sum m v^2 of the body, without points of a mesh, which has its own [J]. */
real diagnostics_kinetic(const struct particles *p);
/* Strain energy of the material points on the grid: 1/2 sum sigma_given : C^-1 sigma V, and in plane strain what
 * flow has added to sigma_zz [J]. */
real diagnostics_strain(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* The same of the material points among `n` listed particles. */
real diagnostics_strain_of(const struct particles *p, const struct material *m, const struct partial_stress *partial,
                           const int32_t *list, int64_t n);

/* Plastic work of the material points: sum V (sigma_y a + H a^2/2) of the accumulated plastic strain a [J]. */
real diagnostics_plastic(const struct particles *p, const struct material *m, const struct partial_stress *partial);

/* What the mean of 1/2 m v^2 before and after a leap-frog kick has too much over 1/2 m v_before . v_after, the
 * kinetic energy that the scheme conserves: 1/4 sum m (v - before)^2 of the body without points of a mesh; `before`
 * NULL where nothing is on the grid: 1/4 sum m (dt f/m)^2, f as it was [J]. */
real diagnostics_kick(const struct particles *p, real *const *before, real dt);

/* Computes the momentum of p, and of the nodes of a mesh for its points (NULL: none), by component [dim, kg m/s];
 * returns the sum of |m v|, by which errors are measured. */
real diagnostics_momentum_of(const struct particles *p, const struct grid *const *nodes, int grids, real *momentum);

/* States of families at the present positions; nothing for bond-based models. */
static inline void states_precompute(struct bonds *b, struct particles *p, const struct bond_source *s)
{
    if (s->modulus) state_precompute_table[p->dim][s->rotates ? PD_MOSPD : PD_OSPD](b, p);
}

/* Stress of peridynamic particles, which steps do not compute: for samples, frames and reversion. */
void run_stress(struct bonds *b, struct particles *p, const struct bond_source *s, const struct kernels *kernels);

#endif
