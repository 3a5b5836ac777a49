/* Computes elastic energy, plastic work and stress (virial of the bonds) of bond-based models, for output. A row
 * consists of all bonds of one particle, a block of eight rows of the rows of eight particles, a column of one bond of
 * each row. */
#include <math.h>

#define ROWS_IN_PARTS /* vectors of WIDE rows */
#include "bond_laws.h"
#include "bond_column.h"
#include "bond_core.h"
#include "kernels/kernels.h"
#include "base/team.h"
#include "kernels/simd/variants.h"

#define TINY 1e-300 /* keeps the root finite in lanes without a bond, where the distance is 0 */

/* Computes bond vectors y[dim] [m] and stretches *stretch [1] of the eight bonds of column s, one for each particle of
 * a block of eight rows. x[dim]: positions of these eight particles [m]. Returns the inverse lengths 1/|y| [1/m]. p:
 * all particles. */
static ALWAYS_INLINE lanes bond_measure_store(const struct bond_column_view s, const struct particles *p,
                                              const lanes *x, lanes *y, lanes *stretch, const int dim)
{
    lanes distance2 = lanes_broadcast(TINY);
    for (int d = 0; d < dim; d++) {
        y[d] = bond_column_gather_neighbour_values(s, p->x[d]) - x[d];
        distance2 += y[d] * y[d];
    }
    const lanes inverse = lanes_inverse_square_root(distance2);
    *stretch = STRETCH_OF(distance2 * inverse, bond_column_inverse_lengths(s));
    return inverse;
}

/* Returns the elastic energies, divided by the stiffness, of the eight bonds of column s (one bond of each of eight
 * particles). x[dim]: positions of these particles [m]; *press: lowered to the smallest stretch of the intact bonds
 * [1]. model: bond law, a compile-time constant. p: all particles. */
static ALWAYS_INLINE lanes bond_energy_column(const struct bond_column_view s, const struct particles *p,
                                              const lanes *x, lanes *press, const int dim, const enum pd_model model)
{
    lanes y[DIM_MAX], stretch;
    bond_measure_store(s, p, x, y, &stretch, dim);
    *press = bond_column_min_where_intact(s, *press, stretch);
    const lanes w = bond_column_weights(s), inverse = bond_column_inverse_lengths(s);
    const lanes length = lanes_inverse_square_root(inverse * inverse); /* cheaper than a division */
    const lanes elastic = bonds_elastic_stretch(model, s.b, bond_column_first_bond(s), stretch);
    return lanes_choose(w > 0.0, w * bonds_normalised_energy(model, stretch, elastic) * length, lanes_broadcast(0));
}

/* Returns in the lanes the elastic energies, divided by the stiffness, of the bonds of WIDE rows (of one particle each)
 * from row `first` on, without repulsive cores. *pressed: set to true if a bond is compressed into its core. model:
 * bond law, a compile-time constant. p: all particles. */
static ALWAYS_INLINE lanes bond_energy_rows(const struct bonds *b, const struct particles *p, int64_t first,
                                            bool *pressed, const int dim, const enum pd_model model)
{
    lanes sum = lanes_broadcast(0), press = lanes_broadcast(0), x[DIM_MAX];
    bond_rows_load_positions_of_their_particles(b, p, first, x, dim);
#define VISIT(COLUMN) sum += bond_energy_column(COLUMN, p, x, &press, dim, model)
#define VISIT_BRITTLE(COLUMN) sum += bond_energy_column(COLUMN, p, x, &press, dim, PD_BOND)
    FOR_COLUMNS_BY_LAW(b, first, model, VISIT, VISIT_BRITTLE);
#undef VISIT_BRITTLE
#undef VISIT
    *pressed |= lanes_mask_any(press < CORE_FROM - 1);
    return sum;
}

/* Returns the elastic energy, divided by the stiffness, of the bonds of the eight particles of row block g, repulsive
 * cores included. Half the stiffness times this is the share of these particles in the energy, since each bond belongs
 * to two particles. row_energy[b->rows]: the share of each particle is added to the entry of its row [J]; NULL if not
 * wanted. model: bond law, a compile-time constant. p: all particles. */
static ALWAYS_INLINE real bond_energy_row_block(const struct bonds *b, const struct particles *p, int64_t g,
                                                real *row_energy, const int dim, const enum pd_model model)
{
    real sum[LANES];
    bool pressed = false;
    for (int part = 0; part < LANES; part += WIDE)
        lanes_store(sum + part, bond_energy_rows(b, p, g * LANES + part, &pressed, dim, model));
    real total = pressed ? bond_row_block_repulsive_core_energy(b, p, g, row_energy) / (0.5 * b->stiffness) : 0;
    for (int l = 0; l < LANES && g * LANES + l < b->rows; l++) total += sum[l];
    for (int l = 0; row_energy && l < LANES && g * LANES + l < b->rows; l++)
        row_energy[g * LANES + l] += 0.5 * b->stiffness * sum[l];
    return total;
}

/* Adds F_ij (x) (x_j - x_i) of eight bonds, divided by the stiffness, to sum[component], one lane for each particle
 * (xx, yy, zz, xy, yz, zx in 3D). s: column of bonds, one of each of eight particles; F_ij: force of the bond on the
 * particle of the row; x[dim]: positions of the eight particles [m]. model: bond law, a compile-time constant. p: all
 * particles. */
static ALWAYS_INLINE void bond_stress_column(lanes *sum, const struct bond_column_view s, const struct particles *p,
                                             const lanes *x, const int dim, const enum pd_model model)
{
    lanes y[DIM_MAX], stretch;
    const lanes inverse = bond_measure_store(s, p, x, y, &stretch, dim);
    const lanes share =
        bond_column_weights(s) * bonds_elastic_stretch(model, s.b, bond_column_first_bond(s), stretch) * inverse;
    for (int d = 0; d < dim; d++) sum[d] += share * y[d] * y[d];
    if (dim > 1) sum[dim] += share * y[0] * y[1];
    if (dim > 2) sum[4] += share * y[1] * y[2], sum[5] += share * y[2] * y[0];
}

/* Computes the virial stress sigma_i = (1/2V) sum_j F_ij (x) (x_j - x_i) of the peridynamic ones among the particles of
 * WIDE rows (one per vector lane), from row `first` on, into p->stress [Pa]. F_ij is the force of bond i-j on i
 * (Silling & Askari 2005). model: bond law, a compile-time constant. b: all bonds. */
static ALWAYS_INLINE void bond_stress_rows(const struct bonds *b, struct particles *p, int64_t first, const int dim,
                                           const enum pd_model model)
{
    const int32_t *row = b->particle + first;
    lanes sum[SYM_MAX], x[DIM_MAX];
    for (int s = 0; s < dim * (dim + 1) / 2; s++) sum[s] = lanes_broadcast(0);
    bond_rows_load_positions_of_their_particles(b, p, first, x, dim);
#define VISIT(COLUMN) bond_stress_column(sum, COLUMN, p, x, dim, model)
#define VISIT_BRITTLE(COLUMN) bond_stress_column(sum, COLUMN, p, x, dim, PD_BOND)
    FOR_COLUMNS_BY_LAW(b, first, model, VISIT, VISIT_BRITTLE);
#undef VISIT_BRITTLE
#undef VISIT
    for (int l = 0; l < WIDE && first + l < b->rows; l++)
        for (int s = 0; s < dim * (dim + 1) / 2 && p->kind[row[l]] == KIND_PD; s++)
            p->stress[s][row[l]] = sum[s][l] * b->stiffness / (2 * p->volume0[row[l]]);
}

/* Raises the largest stretches so far of eight softening bonds, column s of a block of eight rows (one bond of each of
 * eight particles), to their present stretches where these are larger. x[dim]: positions of the eight particles [m].
 * p: all particles. Returns what the bonds lose at kinks of their softening curve, divided by the stiffness [m]
 * (bonds_excess_dissipation_at_softening_kinks). */
static ALWAYS_INLINE lanes bond_soften_column(const struct bond_column_view s, const struct particles *p,
                                              const lanes *x, const int dim)
{
    lanes y[DIM_MAX], stretch;
    bond_measure_store(s, p, x, y, &stretch, dim);
    const lanes lost = bonds_excess_dissipation_at_softening_kinks(
        s.b, bond_column_first_bond(s), stretch, bond_column_weights(s), bond_column_inverse_lengths(s));
    bonds_update_softening_and_scale_stretch(s.b, bond_column_first_bond(s), stretch);
    return lost;
}

/* Raises the largest stretches so far of the bonds of WIDE rows (the bonds of one particle each, one row per vector
 * lane), from row `first` on, to the present stretches. Call only if at least one bond of their block has begun to
 * soften. b, p: all bonds and particles. */
static ALWAYS_INLINE void bond_soften_rows(const struct bonds *b, const struct particles *p, int64_t first,
                                           const int dim)
{
    lanes x[DIM_MAX], lost = lanes_broadcast(0);
    bond_rows_load_positions_of_their_particles(b, p, first, x, dim);
#define VISIT(COLUMN) lost += bond_soften_column(COLUMN, p, x, dim)
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    bond_rows_add_excess_softening_dissipation(b, first, lost);
}

void bonds_update_softening(struct bonds *b, const struct particles *p)
{
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < b->row_blocks; g++) {
        if (!bond_row_block_has_begun_softening(b, g)) continue;
        for (int64_t first = g * LANES; first < (g + 1) * LANES; first += WIDE) {
            if (p->dim == 1) bond_soften_rows(b, p, first, 1);
            if (p->dim == 2) bond_soften_rows(b, p, first, 2);
            if (p->dim == 3) bond_soften_rows(b, p, first, 3);
        }
    }
}

real bond_row_plastic_work(const struct bonds *b, int64_t row)
{
    real sum = b->plastic_work[row];
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
        sum += 0.5 * bond_dissipated_plastic_work(b, &it.bond);
    return sum;
}

real bond_row_plastic_path(const struct bonds *b, int64_t row)
{
    real sum = 0, all = 0;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        if (it.bond.w == 0) continue;
        const real weight = it.bond.w / it.bond.inverse_length;
        sum += weight * b->plastic_path[it.bond.entry], all += weight;
    }
    return all > 0 ? sum / all : 0;
}

/* Returns the plastic work of the bonds of row `row` [J] (of one particle), as a term for reproducible_sum. context:
 * the bonds. */
static real bond_measure_plastic_term(const void *context, int64_t row) { return bond_row_plastic_work(context, row); }

real bond_plastic_work(const struct bonds *b)
{
    return b->plastic_path ? reproducible_sum(b->rows, bond_measure_plastic_term, b) : 0;
}

/* Sums of energies: blocks of eight rows (bonds of eight particles) are summed in blocks of ROW_BLOCK_PER_BLOCK,
 * BLOCKS_AT_ONCE of these in parallel, and their sums in order, so that results have equal bits on any number of
 * threads. */
enum { ROW_BLOCK_PER_BLOCK = 64, BLOCKS_AT_ONCE = 256 };

#define INSTANCE(D, M)                                                                                                 \
    static real bond_energy_##D##d_##M(const struct bonds *b, const struct particles *p, real *row_energy)             \
    {                                                                                                                  \
        real total = 0;                                                                                                \
        for (int64_t first = 0; first < b->row_blocks; first += (int64_t)ROW_BLOCK_PER_BLOCK * BLOCKS_AT_ONCE) {       \
            real part[BLOCKS_AT_ONCE] = {0};                                                                           \
            _Pragma("omp parallel for schedule(static)") for (int block = 0; block < BLOCKS_AT_ONCE;                   \
                                                              block++) for (int k = 0; k < ROW_BLOCK_PER_BLOCK; k++)   \
            {                                                                                                          \
                int64_t g = first + (int64_t)block * ROW_BLOCK_PER_BLOCK + k;                                          \
                if (g < b->row_blocks && (PD_##M == PD_BOND_PLASTIC || b->active.level[g] > 0))                        \
                    part[block] += bond_energy_row_block(b, p, g, row_energy, D, PD_##M);                              \
            }                                                                                                          \
            for (int block = 0; block < BLOCKS_AT_ONCE; block++) total += part[block];                                 \
        }                                                                                                              \
        return 0.5 * b->stiffness * total;                                                                             \
    }                                                                                                                  \
    static void bond_stress_##D##d_##M(const struct bonds *b, struct particles *p)                                     \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t first = 0; first < b->row_blocks * LANES;            \
                                                          first += WIDE) bond_stress_rows(b, p, first, D, PD_##M);     \
    }
PD_VARIANTS(INSTANCE)

#define ENERGY(D, M) [D][PD_##M] = bond_energy_##D##d_##M,
bond_energy_fn *const bond_energy_table[DIM_MAX + 1][PD_MODELS] = {PD_VARIANTS(ENERGY)};
#define STRESS(D, M) [D][PD_##M] = bond_stress_##D##d_##M,
bond_stress_fn *const bond_stress_table[DIM_MAX + 1][PD_MODELS] = {PD_VARIANTS(STRESS)};
