/* Computes the forces of all intact bonds of bond-based models on particles (Silling & Askari 2005), and
 * breaks bonds that are stretched beyond their limit.
 *
 *     s = |x_j - x_i| / |X_j - X_i| - 1,   f_i = sum_j stiffness w_ij law(s) (x_j - x_i)/|x_j - x_i|
 *
 * with the stretch s, the weight w_ij of the bond, present and reference positions x and X. A row consists of
 * all bonds of one particle. Eight rows (a block) are computed at a time, column by column (column k: the
 * k-th bonds of the rows). Each row is written by its own vector lane only, so that the result does not
 * depend on the number of threads. Both rows of a bond compute its stretch from equal numbers with equal
 * operations (a difference and its negative), so that they break the bond in one step without communication.
 */
#include <math.h>

#define ROWS_IN_PARTS
#include "bond_laws.h"
#include "bond_column.h"
#include "bond_core.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"
#include "sweep.h"
#include "kernels/simd/variants.h"

#define TINY 1e-300 /* keeps the root finite in lanes without a bond, where the distance is 0 */

/* Sums over the bonds of a block of eight rows (bonds of eight particles, stored column by column). x0, x1, x2:
 * positions of the eight particles [m]; f0, f1, f2: forces on them, divided by the stiffness; stretch, press: largest
 * and smallest stretch of their bonds [1]. Where bonds soften, `stretch` is the largest excess over the end of
 * softening, of bonds beyond `trigger`, the least limit of each row, and `lost` sums what they lose at kinks of their
 * softening curve, divided by the stiffness [m] (bonds_excess_dissipation_at_softening_kinks). */
struct bond_sums {
    lanes x0, x1, x2, f0, f1, f2, stretch, press, trigger, lost;
};

/* Adds the forces of eight bonds to `sum`, the sums of their eight particles, updates the largest and smallest stretch
 * in it, and returns it. s: column of bonds, one of each of the eight particles; model: bond law, a compile-time
 * constant. The force is computed from the stretch. As a difference of inverse lengths it would be cheaper, but a body
 * in free fall would have three times the round-off. p: all particles. */
static ALWAYS_INLINE struct bond_sums bond_force_column(struct bond_sums sum, const struct particles *p,
                                                        const struct bond_column_view s, const int dim,
                                                        const enum pd_model model)
{
    const lanes d0 = bond_column_gather_neighbour_values(s, p->x[0]) - sum.x0;
    const lanes d1 = dim > 1 ? bond_column_gather_neighbour_values(s, p->x[1]) - sum.x1 : d0;
    const lanes d2 = dim > 2 ? bond_column_gather_neighbour_values(s, p->x[2]) - sum.x2 : d0;
    lanes distance2 = d0 * d0 + TINY;
    if (dim > 1) distance2 += d1 * d1;
    if (dim > 2) distance2 += d2 * d2;
    const lanes inverse = lanes_inverse_square_root(distance2), w = bond_column_weights(s);
    const lanes stretch = STRETCH_OF(distance2 * inverse, bond_column_inverse_lengths(s));
    if (model == PD_BOND_SOFT)
        sum.lost += bonds_excess_dissipation_at_softening_kinks(s.b, bond_column_first_bond(s), stretch, w,
                                                                bond_column_inverse_lengths(s));
    const lanes force =
        bonds_update_state_and_get_normalised_force(model, s.b, bond_column_first_bond(s), stretch, w) * (w * inverse);
    if (model != PD_BOND_SOFT)
        sum.stretch = bond_column_max_where_intact(s, sum.stretch, stretch);
    else if (lanes_any_less(sum.trigger, stretch))
        sum.stretch = bond_column_max_where_intact(
            s, sum.stretch, stretch - lanes_load_floats(s.b->soft.end + bond_column_first_bond(s)));
    sum.press = bond_column_min_where_intact(s, sum.press, stretch);
    sum.f0 += force * d0;
    if (dim > 1) sum.f1 += force * d1;
    if (dim > 2) sum.f2 += force * d2;
    return sum;
}

/* Computes the forces of the bonds on the particles of WIDE rows (one per vector lane), from row `first` on, into p->f,
 * without the repulsive cores of bonds (bond_core.h). Returns true if a bond may exceed its breaking limit: if its
 * stretch is above the smallest limit of the bonds of its particle (b->trigger), or, with softening bonds, above 0.
 * *pressed: set to true if a bond is compressed into its core. model: bond law, a compile-time constant. b: all
 * bonds. */
static ALWAYS_INLINE bool bond_force_rows(const struct bonds *b, struct particles *p, int64_t first, const int dim,
                                          const enum pd_model model, bool *pressed)
{
    const int64_t g = first / LANES;
    const int32_t *row = b->particle + first;
    const bool aligned = b->aligned[g];
    const int rows = count_of_next_eight_indices_below_limit(first, b->rows);
    const int32_t own = aligned ? row[0] : -1;
    const lanes zero = lanes_broadcast(0), x0 = lanes_load_or_gather(p->x[0], own, row);
    struct bond_sums sum = {x0,
                            dim > 1 ? lanes_load_or_gather(p->x[1], own, row) : x0,
                            dim > 2 ? lanes_load_or_gather(p->x[2], own, row) : x0,
                            zero,
                            zero,
                            zero,
                            lanes_broadcast(-1),
                            zero,
                            lanes_load(b->trigger + first),
                            zero};
#define VISIT(COLUMN) sum = bond_force_column(sum, p, COLUMN, dim, model)
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    bond_rows_store_values_of_their_particles(p->f[0], row, rows, aligned, sum.f0 * b->stiffness);
    if (dim > 1) bond_rows_store_values_of_their_particles(p->f[1], row, rows, aligned, sum.f1 * b->stiffness);
    if (dim > 2) bond_rows_store_values_of_their_particles(p->f[2], row, rows, aligned, sum.f2 * b->stiffness);
    if (model == PD_BOND_SOFT) bond_rows_add_excess_softening_dissipation(b, first, sum.lost);
    *pressed |= lanes_mask_any(sum.press < CORE_FROM - 1);
    if (b->soft.near && model != PD_BOND_SOFT && lanes_mask_any(sum.stretch > b->soft.gate)) b->soft.near[g] = 1;
    return lanes_mask_any(sum.stretch > (model == PD_BOND_SOFT ? zero : sum.trigger));
}

/* Computes the forces of the bonds on the eight particles of row block g as bond_force_rows does for a part of them,
 * and returns its result for all. *pressed: receives true if a bond is compressed into its core, else false. */
static ALWAYS_INLINE bool bond_force_row_block(const struct bonds *b, struct particles *p, int64_t g, const int dim,
                                               const enum pd_model model, bool *pressed)
{
    bool past = false;
    *pressed = false;
    for (int part = 0; part < LANES; part += WIDE) past |= bond_force_rows(b, p, g * LANES + part, dim, model, pressed);
    return past;
}

/* Computes the forces of the bonds on the eight particles of row block g (their bonds are stored together) into p->f,
 * repulsive cores included, and breaks bonds stretched beyond their limit. Returns the number of broken bonds, each
 * counted once for each of its two rows. limit: breaking limits; model: bond law, a compile-time constant. b: all
 * bonds. */
static ALWAYS_INLINE int64_t bond_force_and_break(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                                                  int64_t g, const int dim, const enum pd_model model)
{
    bool pressed;
    const bool past = model == PD_BOND_SOFT && !bond_row_block_has_begun_softening(b, g)
                          ? bond_force_row_block(b, p, g, dim, PD_BOND, &pressed)
                          : bond_force_row_block(b, p, g, dim, model, &pressed);
    if (__builtin_expect(pressed, 0)) bond_row_block_add_repulsive_core_forces(b, p, g);
    if (model == PD_BOND_SOFT && b->soft.settled) return 0; /* bonds end between equilibria (bond_secant.c) */
    return past ? bond_break_row_block(b, p, limit, g) : 0;
}

#define INSTANCE(D, M)                                                                                                 \
    static int64_t bond_force_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit,         \
                                         struct pd_motion *m)                                                          \
    {                                                                                                                  \
        SWEEP(b, p, m, D, bond_force_and_break(b, p, limit, row_block, D, PD_##M));                                    \
    }
PD_VARIANTS(INSTANCE)

#define ENTRY(D, M) [D][PD_##M] = bond_force_##D##d_##M,
bond_force_fn *const bond_force_table[DIM_MAX + 1][PD_MODELS] = {PD_VARIANTS(ENTRY)};
