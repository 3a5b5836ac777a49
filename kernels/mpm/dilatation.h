/* Mean dilatation: all points of a grid cell that are of one body and one material get one rate of
 * dilatation, the mean of their rates weighted by volume. Nearly incompressible and plastic materials then
 * have one volume constraint per cell instead of one per point, and do not lock (B-bar: Hughes 1980; of
 * material points: Coombs et al. 2018).
 *
 * With the velocity gradient L_p, stress sigma_p and volume V_p of point p, t_p = tr L_p and s_p = tr
 * sigma_p/dim, the power of the forces on the nodes is
 *     sum_p V_p (sigma_p : L_p + s_p (t - t_p)),   t = sum V_p t_p/sum V_p.
 * The nodal forces that do this work follow from the stress sigma_p + (s - s_p) I with s = sum V_p s_p/sum
 * V_p. So g2p averages the rates of dilatation and p2g the mean stresses by the same mean, and the energy
 * balance is exact.
 *
 * Where points enter other cells, these means change at once. Half of the dilatation of a step therefore uses
 * the mean over the old cell, half the mean over the new one (points_add_mean_dilatation). With the old cell
 * alone, each change of cells causes an error of first order in dt: a stretched block that flies through 30
 * cells at a Poisson's ratio of 0.45 ends with 40 times its elastic energy. */
#ifndef CLEAVE_KERNELS_DILATATION
#define CLEAVE_KERNELS_DILATATION

#include "kernels/kernels.h"

/* Largest number of points over which a mean dilatation extends; a multiple of POINTS. A cell with more points, after
 * large compression, has several means, one for each MEAN_POINTS points in the order of its list. */
enum { MEAN_POINTS = 64 };

/* ONE_LOOP_OVER_CELLS, if a file defines it before it includes the maps: one loop serves points with and without mean
 * dilatation, and the loop calls a function that updates points. Else both kinds have a loop of their own, which
 * contains this function. That is a tenth faster in 2D and for linear shape functions; where points have weights at 27
 * and more nodes it makes no difference, and the compiler takes three times as long. */
#ifdef ONE_LOOP_OVER_CELLS
#define G2P_UPDATE_INLINE NEVER_INLINE
#else
#define G2P_UPDATE_INLINE ALWAYS_INLINE
#endif

/* Returns true if, in the transfer t in `dim` dimensions, material points can have the mean dilatation of their grid
 * cell; false in 1D, if no material requires it, and if the transfer has no stress (momentum only). */
static ALWAYS_INLINE bool transfer_uses_mean_dilatation(const struct transfer_data *t, const int dim)
{
    return dim > 1 && __builtin_expect(t->mean_dilatation, 0) && !t->momentum_only;
}

/* Returns true if the points i and j of p, in a grid cell, share one mean dilatation, because they are of the same body
 * and material. */
static ALWAYS_INLINE bool points_share_mean_dilatation(const struct particles *p, int32_t i, int32_t j)
{
    return p->material[i] == p->material[j] && p->body[i] == p->body[j];
}

/* Returns true if the points list[n] of p, in a grid cell, share one mean dilatation, because they are all of one body
 * and one material. */
static ALWAYS_INLINE bool points_all_share_mean_dilatation(const struct particles *p, const int32_t *list, int n)
{
    bool same = true;
    for (int k = 1; k < n; k++) same &= points_share_mean_dilatation(p, list[0], list[k]);
    return same;
}

/* Replaces value[k] of the n <= MEAN_POINTS points list[k] of p, in a grid cell, by mean - value[k], with the mean,
 * weighted by volume, over the points of the same body and material. t: elastic constants of the materials. value[k]
 * becomes 0 for materials without mean dilatation. Not inlined, so that the code for other materials contains none of
 * it. */
static NEVER_INLINE void points_replace_values_by_cell_mean_minus_value(const struct particles *p,
                                                                        const struct transfer_data *t,
                                                                        const int32_t *list, int n, real *value)
{
    uint64_t left = n < MEAN_POINTS ? ((uint64_t)1 << n) - 1 : UINT64_MAX;
    while (left) {
        const int32_t first = list[__builtin_ctzll(left)];
        uint64_t own = 0;
        real volume = 0, sum = 0;
        for (int k = 0; k < n; k++) {
            if (!(left >> k & 1 && points_share_mean_dilatation(p, first, list[k]))) continue;
            own |= (uint64_t)1 << k;
            volume += p->volume[list[k]], sum += p->volume[list[k]] * value[k];
        }
        const bool averaged = t->elastic[p->material[first]].mean_dilatation;
        for (int k = 0; k < n; k++)
            if (own >> k & 1) value[k] = averaged ? sum / volume - value[k] : 0;
        left &= ~own;
    }
}

#endif
