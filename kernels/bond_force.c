/* floor 2: force of all intact bonds on the particles of their rows, and the breaking of what is stretched too far.
 *
 *     s = |x_j - x_i| / |X_j - X_i| - 1,   f_i = sum_j stiffness w_ij law(s) (x_j - x_i)/|x_j - x_i|
 *
 * Eight rows at a time, slot by slot; a row is written by its own lane only, so no second writer exists and the result
 * does not depend on threads. Both ends compute the same stretch from the same numbers with the same operations (a
 * difference and its negative), so both rows break a bond in the same step without talking. */
#include <math.h>

#include "bond_laws.h"
#include "kernels.h"
#include "lanes.h"
#include "variants.h"

#define TINY 1e-300                      /* keeps the root of a padding lane's zero distance finite */

/* f = new share + f (1 - share) */
static ALWAYS_INLINE void rows_store(real *f, const int32_t *row, int rows, bool aligned, lanes value, real share)
{
    if (aligned && share == 1) lanes_store(f + row[0], value);
    else for (int l = 0; l < rows; l++) f[row[l]] = share * value[l] + (share == 1 ? 0 : (1 - share) * f[row[l]]);
}

/* Force of one group, mixed into what f holds by `share`; returns whether a bond may have passed its limit. */
static ALWAYS_INLINE bool bond_force_group(const struct bonds *b, struct particles *p, int64_t g, const real share,
                                           const int dim, const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const bool aligned = b->aligned[g];
    const int rows = b->rows - g * LANES < LANES ? (int)(b->rows - g * LANES) : LANES;
    const int32_t own = aligned ? row[0] : -1;
    const lanes x0 = lanes_at(p->x[0], own, row);
    const lanes x1 = dim > 1 ? lanes_at(p->x[1], own, row) : x0;
    const lanes x2 = dim > 2 ? lanes_at(p->x[2], own, row) : x0;
    lanes f0 = lanes_of(0), f1 = f0, f2 = f0, largest = lanes_of(-1);

    for (int64_t slot = b->slot[g]; slot < b->slot[g + 1]; slot++) {
        const int64_t q = slot * LANES;
        const int32_t *nbr = b->nbr + q;
        const int32_t first = b->first[slot];
        const lanes d0 = lanes_at(p->x[0], first, nbr) - x0;
        const lanes d1 = dim > 1 ? lanes_at(p->x[1], first, nbr) - x1 : d0;
        const lanes d2 = dim > 2 ? lanes_at(p->x[2], first, nbr) - x2 : d0;
        lanes distance2 = d0 * d0 + TINY;
        if (dim > 1) distance2 += d1 * d1;
        if (dim > 2) distance2 += d2 * d2;
        const lanes inverse = lanes_inverse_root(distance2);
        const lanes stretch = distance2 * inverse * lanes_load(b->inverse_length + q) - 1.0;
        const lanes w = lanes_load_float(b->w + q);
        const lanes force = w * bond_law(model, b, q, stretch, w) * inverse;
        largest = lanes_max(largest, stretch);   /* below 0 where w = 0 */
        f0 += force * d0;
        if (dim > 1) f1 += force * d1;
        if (dim > 2) f2 += force * d2;
    }
    rows_store(p->f[0], row, rows, aligned, f0 * b->stiffness, share);
    if (dim > 1) rows_store(p->f[1], row, rows, aligned, f1 * b->stiffness, share);
    if (dim > 2) rows_store(p->f[2], row, rows, aligned, f2 * b->stiffness, share);
    return lanes_any(largest > lanes_load(b->trigger + g * LANES));
}

#define INSTANCE(D, M)                                                                                   \
    static int64_t bond_force_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit) \
    {                                                                                                    \
        int64_t broken = 0;                                                                              \
        _Pragma("omp parallel for schedule(static) reduction(+ : broken)")                               \
        for (int64_t g = 0; g < b->groups; g++) {                                                        \
            if (!bond_force_group(b, p, g, 1, D, PD_##M)) continue;                                      \
            int64_t here = bond_break_group(b, p, limit, g);                                             \
            if (here > 0) bond_force_group(b, p, g, 0.5, D, PD_##M);                                     \
            broken += here;                                                                              \
        }                                                                                                \
        return broken;                                                                                   \
    }
PD_VARIANTS(INSTANCE)

#define ENTRY(D, M) [D][PD_##M] = bond_force_##D##d_##M,
bond_force_fn *const bond_force_table[DIM_MAX + 1][PD_MODELS] = {PD_VARIANTS(ENTRY)};
