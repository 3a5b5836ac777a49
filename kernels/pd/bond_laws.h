/* The laws of single bonds. A law maps what a bond measures to the force of a unit weight; how bonds are
 * visited is not its business. To add one: write it here, add its name to enum pd_model, a case below, and one line a
 * dimension in variants.h. */
#ifndef CLEAVE_KERNELS_BOND_LAWS
#define CLEAVE_KERNELS_BOND_LAWS

#include <math.h>

#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Return mapping of eight bonds from entry q on, those with `intact` set; returns what they are stretched elastically.
 * Isotropic linear hardening, with f over the bond's stiffness:
 *     phi = |s - s_p| - (s_y + H alpha),   phi > 0:  g = phi/(1 + H),  s_p += g sign(s - s_p),  alpha += g
 * A plain cap on the force (Zeng et al. 2021, eq. 18) has no unloading; this is the same in monotonic loading. */
static ALWAYS_INLINE lanes bond_yields(const struct bonds *b, int64_t q, lanes stretch, lanes_mask intact)
{
    const lanes yield = lanes_gather(b->yield.stretch, b->pair + q);
    const lanes hardening = lanes_gather(b->yield.hardening, b->pair + q);
    lanes plastic = lanes_load(b->plastic_stretch + q), path = lanes_load(b->plastic_path + q);
    const lanes trial = stretch - plastic, zero = lanes_of(0);
    const lanes size = lanes_choose(trial < zero, -trial, trial);
    lanes step = lanes_max(size - (yield + hardening * path), zero) / (1.0 + hardening);
    step = lanes_choose(intact, step, zero);
    plastic += lanes_choose(trial < zero, -step, step);
    lanes_store(b->plastic_stretch + q, plastic);
    lanes_store(b->plastic_path + q, path + step);
    return stretch - plastic;
}

/* Force over stiffness and weight [1] of eight bonds from entry q on: f = c s n (Silling & Askari 2005; Zeng et al.
 * 2022, eqs. 17, 29), of the elastic part of the stretch where bonds yield. Updates what yielding does to them. */
static ALWAYS_INLINE lanes bond_law(const enum pd_model model, const struct bonds *b, int64_t q, lanes stretch, lanes w)
{
    return model == PD_BOND_PLASTIC ? bond_yields(b, q, stretch, w > 0.0) : stretch;
}

/* The elastic part of the stretch, nothing updated; eight bonds and one. */
static ALWAYS_INLINE lanes bond_elastic(const enum pd_model model, const struct bonds *b, int64_t q, lanes stretch)
{
    return model == PD_BOND_PLASTIC ? stretch - lanes_load(b->plastic_stretch + q) : stretch;
}

static inline real bond_elastic_one(const struct bonds *b, int64_t q, real stretch)
{
    return b->plastic_stretch ? stretch - b->plastic_stretch[q] : stretch;
}

/* Elastic energy over stiffness, weight and reference length [1]. */
static ALWAYS_INLINE lanes bond_law_energy(lanes elastic) { return 0.5 * elastic * elastic; }

/* ---- one bond, for what is visited at samples and frames only --------------------------------------------- */

/* Elastic part of the stretch of entry q of the row of particle i [1]. */
static inline real bond_elastic_of(const struct bonds *b, const struct particles *p, const struct bond *bond, int32_t i)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) distance2 += square(p->x[d][bond->nbr] - p->x[d][i]);
    return bond_elastic_one(b, bond->entry, sqrt(distance2) * bond->inverse_length - 1);
}

/* Its force as the force kernel makes it; tension is positive [N]. */
static inline real bond_force_of(const struct bonds *b, const struct particles *p, const struct bond *bond, int32_t i)
{
    return bond->w == 0 ? 0 : b->stiffness * bond->w * bond_elastic_of(b, p, bond, i);
}

/* The same on i as a vector [N]. */
static inline void bond_pair_force(const struct bonds *b, const struct particles *p, const struct bond *bond, int32_t i,
                                   real *f)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) f[d] = p->x[d][bond->nbr] - p->x[d][i], distance2 += square(f[d]);
    const real force = bond_force_of(b, p, bond, i) / sqrt(distance2);
    for (int d = 0; d < p->dim; d++) f[d] *= force;
}

/* Its elastic energy [J]. */
static inline real bond_energy_of(const struct bonds *b, const struct particles *p, const struct bond *bond, int32_t i)
{
    if (bond->w == 0) return 0;
    return 0.5 * b->stiffness * bond->w * square(bond_elastic_of(b, p, bond, i)) / bond->inverse_length;
}

/* Its plastic work [J]: closed form, since hardening is linear and the path only grows. */
static inline real bond_work_of(const struct bonds *b, const struct bond *bond)
{
    const int64_t q = bond->entry;
    if (bond->w == 0 || b->plastic_path[q] == 0) return 0;
    const int32_t pair = b->pair[q];
    const real path = b->plastic_path[q], yield = b->yield.stretch[pair], hardening = b->yield.hardening[pair];
    return b->stiffness * bond->w * path * (yield + 0.5 * hardening * path) / bond->inverse_length;
}

#endif
