/* Breaking of bonds, one bond at a time and without tolerance. A bond whose stretch exceeds its critical stretch breaks
 * for ever; at equality it stays intact. Each bond is stored in two rows (a row: all bonds of one particle); each row
 * receives half of its energy. */
#include <math.h>

#include "bond_laws.h"
#include "bond_column.h"
#include "bond_last.h"
#include "kernels/kernels.h"
#include "state_last.h"
#include "state_laws.h"

#define LIMIT_MARGIN 1e-9 /* relative tolerance for round-off of the vector test that precedes the exact one */
#define ROUND_OFF 1e-14   /* relative round-off of a squared elongation; matters where limits are close to 0 */

/* Returns true if a boundary condition drives particle i. Flags are written by the thread of the particle's row and
 * read by other threads at the same time. The bit that is read does not change; the atomic access makes this
 * well-defined C. p: all particles. */
static bool is_driven(const struct particles *p, int32_t i)
{
    return __atomic_load_n(&p->flag[i], __ATOMIC_RELAXED) & FLAG_DRIVEN;
}

/* Sets the bits `flag` in the flags of particle i. The store is atomic, because other threads may read these flags at
 * the same time. p: all particles. */
static void set_flag(struct particles *p, int32_t i, int flag)
{
    __atomic_store_n(&p->flag[i], (uint8_t)(p->flag[i] | flag), __ATOMIC_RELAXED);
}

/* Returns half the elastic energy [J] that bond q of row `row` (bonds of one particle) has at the stretch `stretch`
 * [1]; the other half belongs to the row of its other particle. Only for bond-based models. b: all bonds. */
static real half_energy(const struct bonds *b, int64_t row, int64_t q, real stretch)
{
    return 0.5 * b->stiffness * b->w[q] * bond_at_index_normalised_energy(b, row / LANES, q, stretch) /
           fabs(b->inverse_length[q]);
}

void bond_end(struct bonds *b, struct particles *p, int64_t row, int64_t q)
{
    const int32_t i = b->particle[row], j = b->nbr[q];
    b->w[q] = 0;
    b->inverse_length[q] = -b->inverse_length[q];
    bond_update_cached_data_after_modification(b, row, q);
    b->broken[row]++;
    b->broken_volume[row] += (float)p->volume0[j];
    set_flag(p, i, is_driven(p, i) || is_driven(p, j) ? FLAG_LOST_BOND : FLAG_LOST_BOND | FLAG_CRACKED);
    if (p->kind[i] == KIND_PD) p->damage[i] = b->broken_volume[row] / b->family_volume[row];
}

/* Recomputes the weighted volume of row `row` (all bonds of one particle) after weights of its bonds have changed.
 * Does nothing unless the model is state-based and normalises by the present neighbourhood, the bonds are brittle, and
 * the row has bonds to all neighbours, unlike that of a material point. b: all bonds. */
static void row_changed(struct bonds *b, int64_t row)
{
    if (b->state.modulus && b->state.local && !b->soft.whole && b->whole[row])
        b->state.weighted[row] = state_based_weighted_volume_of_intact_bonds(b, row);
}

/* ---- force of a breaking bond ------------------------------------------------------------------------------------ */

/* Corrects the force p->f on particle i for `bond`, one of its bonds, which breaks in this step. Subtracts the force
 * that the force kernel has added for this bond in full, and adds `share` times the force that follows from the states
 * of both neighbourhoods before bonds broke. share: fraction of the force that acts in this step [1]. b: all bonds. */
static void last_force(const struct bonds *b, struct particles *p, const struct bond *bond, int32_t i, real share)
{
    real given[DIM_MAX], f[DIM_MAX];
    bond_force_vector_bond_or_state_based(b, p, bond, i, true, given);
    bond_force_vector_bond_or_state_based(b, p, bond, i, false, f);
    for (int d = 0; d < p->dim; d++) p->f[d][i] += share * f[d] - given[d];
}

/* Returns half the energy [J] that bond q of row `row` (bonds of one particle) dissipates from its onset of softening
 * to the end, which it passes in this step. dt: time step [s]. b, p: all bonds and particles. */
static real half_energy_of_softening_to_end(const struct bonds *b, const struct particles *p, int64_t row, int64_t q,
                                            real dt)
{
    const int32_t i = b->particle[row], j = b->nbr[q];
    const real before = bond_stretch_at_earlier_time(p, b->inverse_length[q], i, j, dt),
               now = bond_stretch_at_earlier_time(p, b->inverse_length[q], i, j, 0);
    return 0.5 * b->stiffness * b->w[q] / fabs(b->inverse_length[q]) *
           bond_softening_energy_dissipated_at_failure(b->soft.curve, b->soft.onset[q], b->soft.end[q], before, now);
}

/* Ends the softening of bond q of row `row` (bonds of one particle): adds `energy`, half of what the bond has
 * dissipated [J], to the fracture energy of the row, and marks the bond as broken. The bond must be at the end of its
 * softening, where it has no force. b, p: all bonds and particles. */
static void bond_finish(struct bonds *b, struct particles *p, int64_t row, int64_t q, real energy)
{
    b->soft.most[q] = b->soft.end[q];
    b->fracture_energy[row] += energy;
    bond_end(b, p, row, q);
}

int64_t bonds_end_softened(struct bonds *b, struct particles *p)
{
    int64_t ended = 0;
    for (int64_t row = 0; row < b->rows; row++)
        for (int64_t k = 0; bond_row_block_has_begun_softening(b, row / LANES) && k < b->column_count[row / LANES];
             k++) {
            const int64_t q = (b->column[row / LANES] + k) * LANES + row % LANES;
            if (b->w[q] == 0 || !bond_is_softening(b, row / LANES, q) || b->soft.most[q] < b->soft.end[q]) continue;
            b->soft.most[q] = b->soft.end[q];
            bond_finish(b, p, row, q, bond_softening_dissipation_per_particle(b, row / LANES, q));
            ended++;
        }
    return ended;
}

/* Returns the stretch [1] from which the energy that bond q (from particle i to j) loses is computed when it breaks in
 * this step: the stretch at the moment at which it passed its limit. In input files with softening bonds, a breaking
 * bond has no force after this step; a leap-frog step from the stretch s_0 to s_1 then loses s_0 s_1/2 times stiffness,
 * weight and length, so that sqrt(s_0 s_1) is returned. limit: breaking limits and time step. b, p: all bonds and
 * particles. */
static real stretch_at_break(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                             int64_t q, int32_t i, int32_t j)
{
    const real inverse = b->inverse_length[q];
    const real lag = bond_at_index_find_break_time_and_force_fraction(b, p, limit, q, i, j).lag;
    if (!limit->softening || limit->last_force != LAST_FORCE_MOMENT)
        return bond_stretch_at_earlier_time(p, inverse, i, j, lag);
    return sqrt(real_max(0, bond_stretch_at_earlier_time(p, inverse, i, j, limit->dt) *
                                bond_stretch_at_earlier_time(p, inverse, i, j, 0)));
}

/* Breaks bond q of row `row` (bonds of one particle) and marks it as broken. Reduces its force on the row's particle
 * to the share that acts until the bond breaks within the step (bond_last.h). Adds its elastic energy to the fracture
 * energy of the row, and its plastic work to the plastic work of the row. limit: breaking limits and time step. b, p:
 * all bonds and particles. */
static void bond_break(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q)
{
    const int32_t i = b->particle[row], j = b->nbr[q];
    const struct bond_break_moment last = bond_at_index_find_break_time_and_force_fraction(b, p, limit, q, i, j);
    const struct bond bond = {q, j, b->inverse_length[q], b->w[q]};
    const bool state = b->state.modulus != NULL;
    last_force(b, p, &bond, i, last.share);
    b->fracture_energy[row] +=
        state ? state_row_energy(b, p, row, last.lag) : half_energy(b, row, q, stretch_at_break(b, p, limit, q, i, j));
    if (b->plastic_path) b->plastic_work[row] += 0.5 * bond_dissipated_plastic_work(b, &bond);
    bond_end(b, p, row, q);
    row_changed(b, row);
    if (state) b->fracture_energy[row] -= state_row_energy(b, p, row, last.lag);
}

/* ---- rows -------------------------------------------------------------------------------------------------------- */

/* Sets the weight of the bond with index q in row `row` (bonds of one particle) to w [1]; w = 0 breaks the bond. Adds
 * half of the elastic energy that is lost to the fracture energy of the row, and half of the plastic work of the lost
 * weight to the plastic work of the row. The other halves appear in the step to the next positions, because a
 * leap-frog velocity update is centred on the change of weights. b, p: all bonds and particles. */
void bond_fade(struct bonds *b, struct particles *p, int64_t row, int64_t q, real w)
{
    const int32_t i = b->particle[row], j = b->nbr[q];
    const bool state = b->state.modulus != NULL;
    const real stretch = bond_stretch_at_earlier_time(p, b->inverse_length[q], i, j, 0);
    const real before = state ? state_row_energy(b, p, row, 0) : half_energy(b, row, q, stretch);
    const real spent = bond_softening_dissipation_per_particle(b, row / LANES, q);
    const struct bond lost = {q, j, fabs(b->inverse_length[q]), b->w[q] - w};
    if (b->plastic_path) b->plastic_work[row] += 0.5 * (0.5 * bond_dissipated_plastic_work(b, &lost));
    if (w > 0)
        b->w[q] = w;
    else if (b->inverse_length[q] > 0)
        bond_end(b, p, row, q);
    else
        b->w[q] = 0;
    bond_update_cached_data_after_modification(b, row, q);
    row_changed(b, row);
    b->fracture_energy[row] +=
        0.5 * (before - (state ? state_row_energy(b, p, row, 0) : half_energy(b, row, q, stretch)));
    b->fracture_energy[row] += spent - bond_softening_dissipation_per_particle(b, row / LANES, q);
}

void bond_break_entry(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q)
{
    if (__atomic_load_n(&b->implicit[row / LANES], __ATOMIC_ACQUIRE))
        bond_row_block_copy_bonds_from_stencil(b, row / LANES);
    bond_break(b, p, limit, row, q);
}

void bond_restore_entry(struct bonds *b, struct particles *p, int64_t row, int64_t q, real w)
{
    INVARIANT(b->w[q] == 0 && b->inverse_length[q] < 0);
    b->w[q] = w;
    b->inverse_length[q] = -b->inverse_length[q];
    b->broken[row]--;
    b->broken_volume[row] -= (float)p->volume0[b->nbr[q]];
    bond_update_cached_data_after_modification(b, row, q);
    row_changed(b, row);
}

/* Returns true if bond q of row `row` (bonds of one particle), from particle i to j, is stretched beyond the limit at
 * which it breaks. A bond that can soften but has not begun to never breaks here, since pressure along one axis
 * stretches the bonds across it although nothing pulls at them (bond_begin.c). If such a bond is beyond its onset of
 * softening, its row block is marked instead, to be examined before the next computation of forces
 * (bond_row_block_request_softening_check). limit: critical stretches and softening. b, p: all bonds and particles. */
static bool is_past(struct bonds *b, const struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q,
                    int32_t i, int32_t j)
{
    const real stretch = bond_stretch_at_earlier_time(p, b->inverse_length[q], i, j, 0);
    if (!b->soft.curve) return stretch > bond_breaking_stretch(p, limit, i, j);
    if (bond_is_softening(b, row / LANES, q)) return stretch > b->soft.end[q];
    const struct softening_range range = bond_softening_range(p, limit, i, j);
    if (!(range.onset < range.end)) return stretch > range.end;
    if (stretch > range.onset) bond_row_block_request_softening_check(b, row / LANES);
    return false;
}

/* Breaks the bonds of row `row` (all bonds of one particle) whose stretch exceeds their breaking limit. limit:
 * breaking limits and time step. Returns the number of bonds broken. b, p: all bonds and particles. */
static int64_t break_row(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row)
{
    const int32_t i = b->particle[row];
    int64_t broken = 0;
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const int64_t q = bond_copy_on_write_and_return_array_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] == 0) continue;
        const int32_t j = b->nbr[q];
        if (!is_past(b, p, limit, row, q, i, j)) continue;
        if (bond_is_softening(b, row / LANES, q))
            bond_finish(b, p, row, q, half_energy_of_softening_to_end(b, p, row, q, limit->dt));
        else
            bond_break(b, p, limit, row, q);
        broken++;
    }
    return broken;
}

/* Returns the smallest critical stretch in limit->critical_stretch, i.e. of all pairs of materials, less a tolerance
 * for the round-off of the vectorised test [1]. */
static real least_limit(const struct bond_limit *limit)
{
    real least = limit->critical_stretch[0];
    for (int k = 1; k < limit->materials * limit->materials; k++) least = real_min(least, limit->critical_stretch[k]);
    return least * (1 - LIMIT_MARGIN);
}

/* Returns in each lane the larger of `largest` and the squared elongation |y|^2/|xi|^2 [1] of one bond, with bond
 * vectors y at present and xi in the reference configuration. s: column of bonds, one of each of eight particles;
 * x[dim]: positions of these particles [m]. Broken bonds count as negative. p: all particles. */
static ALWAYS_INLINE lanes bond_break_largest_of(lanes largest, const struct particles *p, const lanes *x,
                                                 const struct bond_column_view s, const int dim)
{
    const lanes inverse = bond_column_inverse_lengths(s);
    lanes distance2 = lanes_broadcast(0);
    for (int d = 0; d < dim; d++) {
        const lanes y = bond_column_gather_neighbour_values(s, p->x[d]) - x[d];
        distance2 += y * y;
    }
    return bond_column_max_where_intact(s, largest, distance2 * (inverse * lanes_absolute(inverse)));
}

/* Returns in lane l the largest squared elongation |y|^2/|xi|^2 [1] of the bonds of particle l of row block g, which
 * has the bonds of eight particles. y, xi: bond vector at present and in the reference configuration. b, p: all bonds
 * and particles. */
static ALWAYS_INLINE lanes rows_largest(const struct bonds *b, const struct particles *p, int64_t g, const int dim)
{
    lanes x[DIM_MAX], largest = lanes_broadcast(0);
    bond_rows_load_positions_of_their_particles(b, p, g * LANES, x, dim);
#define VISIT(COLUMN) largest = bond_break_largest_of(largest, p, x, COLUMN, dim)
    FOR_COLUMNS(b, g * LANES, VISIT);
#undef VISIT
    return largest;
}

/* Returns a mask with lane l set if particle l of row block g (the bonds of eight particles) has a bond with a stretch
 * above lane l of `least` [1], up to round-off. b, p: all bonds and particles. */
static ALWAYS_INLINE lanes_mask rows_past(const struct bonds *b, const struct particles *p, int64_t g, lanes least,
                                          const int dim)
{
    return rows_largest(b, p, g, dim) > (1.0 + least) * (1.0 + least) * (1 - ROUND_OFF);
}

real bond_row_block_stretch(const struct bonds *b, const struct particles *p, int64_t row_block)
{
    const lanes largest = p->dim == 1   ? rows_largest(b, p, row_block, 1)
                          : p->dim == 2 ? rows_largest(b, p, row_block, 2)
                                        : rows_largest(b, p, row_block, 3);
    real most = 0;
    for (int l = 0; l < LANES; l++) most = real_max(most, largest[l]);
    return sqrt(most) * (1 + ROUND_OFF) - 1 + LIMIT_MARGIN;
}

/* Returns a mask with lane l set if a bond of particle l of row block g (the bonds of eight particles) may exceed its
 * breaking limit. Compares the largest stretch of each particle's bonds with the limit stored for that particle
 * (b->trigger) if strength is random or bonds soften (times b->soft.least_ratio if none of the block has begun to
 * soften), else with the smallest critical stretch of all pairs of materials in `limit`. b, p: all bonds and particles.
 */
static lanes_mask rows_due(const struct bonds *b, const struct particles *p, const struct bond_limit *limit, int64_t g)
{
    const bool stored = p->strength || b->soft.curve;
    const lanes share = lanes_broadcast(b->soft.curve && !b->soft.begun[g] ? b->soft.least_ratio : 1);
    const lanes least = stored ? lanes_load(b->trigger + g * LANES) * share : lanes_broadcast(least_limit(limit));
    return p->dim == 1   ? rows_past(b, p, g, least, 1)
           : p->dim == 2 ? rows_past(b, p, g, least, 2)
                         : rows_past(b, p, g, least, 3);
}

int64_t bond_break_row_block(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row_block)
{
    if (limit->softening && !b->soft.begun[row_block]) bond_row_block_request_softening_check(b, row_block);
    if (b->soft.whole) return 0; /* bonds of state-based models end where they soften (state_soften.c) */
    const lanes_mask past = rows_due(b, p, limit, row_block);
    int64_t broken = 0;
    for (int l = 0; l < LANES && row_block * LANES + l < b->rows && lanes_mask_any(past); l++)
        if (past[l]) broken += break_row(b, p, limit, row_block * LANES + l);
    return broken;
}
