/* Computes elastic energy and stress of state-based models, for output, from the states in b->state. A row
 * consists of all bonds of one particle, a block of eight rows of the rows of eight particles, a column of
 * one bond of each row.
 *     energy of row i   1/2 sum_j (force state of i) . (effective displacement); its sum over j is V_i W_i
 *     stress            sigma_i = (1/V_i) sum_j T_ij V_j (x) y_ij, symmetrised, T_ij the force state of i alone;
 *                       deformed vectors y, not xi: the stress rotates with the body */
#include <math.h>

#define ROWS_IN_PARTS /* vectors of WIDE rows */
#include "bond_core.h"
#include "bond_last.h"
#include "kernels/kernels.h"
#include "base/polar.h"
#include "kernels/mpm/stress.h"
#include "state_laws.h"
#include "base/team.h"
#include "kernels/simd/variants.h"

/* Positions x, X [m] (present, reference) and states of the eight particles of a block of eight rows: pressure, spring
 * stiffness and rotation of their neighbourhoods (all bonds of one particle). */
struct own_state {
    lanes x[DIM_MAX], X[DIM_MAX], pressure, spring, rotation[ROTATION];
};

/* Returns positions and states (pressure, spring stiffness, rotation) of the particles of p in WIDE rows (one per
 * vector lane) of b, from row `first` on. rotates: true in models with rotations of particles; otherwise `rotation` is
 * not set. */
static ALWAYS_INLINE struct own_state own_state_of(const struct bonds *b, const struct particles *p, int64_t first,
                                                   const int dim, const bool rotates)
{
    const int32_t *row = b->particle + first, own = b->aligned[first / LANES] ? row[0] : -1;
    const struct state *t = &b->state;
    struct own_state s;
    s.pressure = lanes_load_or_gather(t->pressure, own, row), s.spring = lanes_load_or_gather(t->spring, own, row);
    for (int d = 0; d < dim; d++)
        s.x[d] = lanes_load_or_gather(p->x[d], own, row), s.X[d] = lanes_load_or_gather(p->X[d], own, row);
    for (int c = 0; rotates && c < ROTATION; c++) s.rotation[c] = lanes_load_or_gather(t->rotation[c], own, row);
    return s;
}

/* Computes the forces of eight bonds, one of each of eight particles. column: the bonds; s: positions and states of
 * the eight particles. T[dim]: receives the part of the bond force that follows from the state of that particle alone,
 * not of its neighbour [N], 0 for broken bonds; y[dim]: receives the bond vector [m]. rotates: true in models with
 * rotations. Returns the elastic energies of the bonds in the neighbourhoods of the eight particles [J]. p: all
 * particles. */
static ALWAYS_INLINE lanes own_force_column(const struct own_state *s, const struct bond_column_view column,
                                            const struct particles *p, lanes *T, lanes *y, const int dim,
                                            const bool rotates)
{
    const lanes w = bond_column_weights(column), inverse_length = bond_column_inverse_lengths(column);
    const lanes r =
        lanes_inverse_square_root(lanes_choose(w > 0.0, inverse_length * inverse_length, lanes_broadcast(1)));
    lanes xi[DIM_MAX], effective[DIM_MAX], distance2 = lanes_broadcast(STATE_TINY), effective2 = lanes_broadcast(0);
    for (int d = 0; d < dim; d++) {
        y[d] = bond_column_gather_neighbour_values(column, p->x[d]) - s->x[d],
        xi[d] = bond_column_reference_vector_component(column, p, d, s->X[d]);
        distance2 += y[d] * y[d];
    }
    const lanes inverse = lanes_inverse_square_root(distance2);
    const lanes e = r * STRETCH_OF(distance2 * inverse, lanes_absolute(inverse_length));
    lanes along = r * s->pressure;
    if (!rotates) along += e * s->spring;
    lanes energy = along * e;
    for (int d = 0; d < dim; d++) T[d] = along * y[d] * inverse;
    for (int d = 0; d < dim; d++) effective[d] = s->spring * (y[d] - xi[d]);
    if (rotates) encoded_rotation_subtract_product_with_vector(effective, s->rotation, xi, dim);
    for (int d = 0; rotates && d < dim; d++) T[d] += effective[d], effective2 += effective[d] * effective[d];
    /* w last: a weight of exactly one leaves the sums unchanged */
    for (int d = 0; d < dim; d++) T[d] = w * T[d];
    if (rotates) energy += effective2 / s->spring;
    return lanes_choose(w > 0.0, 0.5 * w * energy, lanes_broadcast(0));
}

/* Returns in the lanes the elastic energies of the neighbourhoods of WIDE particles, those of the rows from `first` on,
 * without repulsive cores [J]. model: state-based model, a compile-time constant. b, p: all bonds and particles. */
static ALWAYS_INLINE lanes energy_rows(const struct bonds *b, const struct particles *p, int64_t first, const int dim,
                                       const enum pd_model model)
{
    const struct own_state s = own_state_of(b, p, first, dim, state_model_has_rotations(model));
    lanes sum = lanes_broadcast(0), T[DIM_MAX], y[DIM_MAX];
#define VISIT(COLUMN) sum += own_force_column(&s, COLUMN, p, T, y, dim, state_model_has_rotations(model))
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    return sum;
}

/* Returns the elastic energy of the neighbourhoods of the eight particles of row block g (their bonds are stored
 * together), repulsive cores included [J]; 0 if the block is inactive (at rest). row_energy: [b->rows] the energy of
 * each neighbourhood is added to it [J]; NULL if it is not wanted. model: state-based model, a compile-time constant.
 */
static ALWAYS_INLINE real energy_row_block(const struct bonds *b, const struct particles *p, int64_t g,
                                           real *row_energy, const int dim, const enum pd_model model)
{
    if (b->active.level[g] == 0) return 0;
    real sum[LANES], total = b->state.pressed[g] ? bond_row_block_repulsive_core_energy(b, p, g, row_energy) : 0;
    for (int part = 0; part < LANES; part += WIDE)
        lanes_store(sum + part, energy_rows(b, p, g * LANES + part, dim, model));
    for (int l = 0; l < LANES && g * LANES + l < b->rows; l++) total += sum[l];
    for (int l = 0; row_energy && l < LANES && g * LANES + l < b->rows; l++) row_energy[g * LANES + l] += sum[l];
    return total;
}

/* Adds the symmetric part of T (x) y of eight bonds to sum[component] (order xx yy xy in 2D, xx yy zz xy yz zx in 3D),
 * one lane for each of their eight particles. T: part of the bond force that follows from the state of that particle
 * alone [N]; y: bond vector [m]. column: the eight bonds, entry k of the bond lists of the eight particles; s:
 * positions and states of the particles; model: state-based model, a compile-time constant. p: all particles. */
static ALWAYS_INLINE void stress_column(lanes *sum, const struct own_state *s, const struct bond_column_view column,
                                        const struct particles *p, const int dim, const enum pd_model model)
{
    lanes T[DIM_MAX], y[DIM_MAX];
    own_force_column(s, column, p, T, y, dim, state_model_has_rotations(model));
    for (int d = 0; d < dim; d++) sum[d] += T[d] * y[d];
    if (dim > 1) sum[dim] += 0.5 * (T[0] * y[1] + T[1] * y[0]);
    if (dim > 2) sum[4] += 0.5 * (T[1] * y[2] + T[2] * y[1]), sum[5] += 0.5 * (T[2] * y[0] + T[0] * y[2]);
}

/* Computes the stress of the peridynamic ones among the particles of WIDE rows (one per vector lane), from row `first`
 * on, into p->stress [Pa], from the states of their neighbourhoods (pressure, spring stiffness and rotation). model:
 * state-based model, a compile-time constant. b: all bonds. */
static ALWAYS_INLINE void stress_rows(const struct bonds *b, struct particles *p, int64_t first, const int dim,
                                      const enum pd_model model)
{
    const struct own_state s = own_state_of(b, p, first, dim, state_model_has_rotations(model));
    const int32_t *row = b->particle + first;
    lanes sum[SYM_MAX];
    for (int c = 0; c < dim * (dim + 1) / 2; c++) sum[c] = lanes_broadcast(0);
#define VISIT(COLUMN) stress_column(sum, &s, COLUMN, p, dim, model)
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    for (int l = 0; l < WIDE && first + l < b->rows; l++)
        for (int c = 0; c < dim * (dim + 1) / 2 && p->kind[row[l]] == KIND_PD; c++)
            p->stress[c][row[l]] = sum[c][l] / p->volume0[row[l]];
}

/* Arguments of the functions that compute the energy of one block of eight rows (bonds of eight particles) for
 * reproducible_sum. */
struct row_block_sum {
    const struct bonds *b;
    const struct particles *p;
    real *row_energy; /* [b->rows] receives the energy of each neighbourhood [J]; NULL if it is not wanted */
};

#define INSTANCE(D, M)                                                                                                 \
    static real energy_term_##D##d_##M(const void *context, int64_t g)                                                 \
    {                                                                                                                  \
        const struct row_block_sum *s = context;                                                                       \
        return energy_row_block(s->b, s->p, g, s->row_energy, D, PD_##M);                                              \
    }                                                                                                                  \
    static real state_energy_##D##d_##M(const struct bonds *b, const struct particles *p, real *row_energy)            \
    {                                                                                                                  \
        return reproducible_sum(b->row_blocks, energy_term_##D##d_##M, &(struct row_block_sum){b, p, row_energy});     \
    }                                                                                                                  \
    static void state_stress_##D##d_##M(const struct bonds *b, struct particles *p)                                    \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t first = 0; first < b->row_blocks * LANES;            \
                                                          first += WIDE) stress_rows(b, p, first, D, PD_##M);          \
    }
STATE_VARIANTS(INSTANCE)

#define ENERGY(D, M) [D][PD_##M] = state_energy_##D##d_##M,
bond_energy_fn *const state_energy_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(ENERGY)};
#define STRESS(D, M) [D][PD_##M] = state_stress_##D##d_##M,
bond_stress_fn *const state_stress_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(STRESS)};

/* ---- a row whose weights change ---------------------------------------------------------------------------------- */

/* Computes the rotation matrix R (row major) of the cell of material point i, which has bonds, from
 * particles.end_rotation. p: all particles. */
static void end_rotation(const struct particles *p, int32_t i, real *R)
{
    if (p->dim == 2) {
        R[0] = R[3] = 1 + p->end_rotation[0][i], R[2] = p->end_rotation[1][i], R[1] = -R[2];
        return;
    }
    const real q[ROTATION] = {p->end_rotation[0][i], p->end_rotation[1][i], p->end_rotation[2][i],
                              p->end_rotation[3][i]};
    for (int c = 0; c < 3; c++) {
        real column[3] = {c == 0, c == 1, c == 2};
        quaternion_rotate_vector(q, column);
        for (int a = 0; a < 3; a++) R[3 * a + c] = column[a];
    }
}

/* Returns sum w |Y - R xi|^2 over the bonds of one particle [m^2], with weights w, bond vectors Y at the time `lag`
 * [s] before the present and reference vectors xi. R is the rotation that fits these bonds best, or for a material
 * point the rotation of its mesh cell. row: row of b with the bonds of the particle. p: all particles. */
static real row_effective(const struct bonds *b, const struct particles *p, int64_t row, real lag)
{
    const int32_t i = b->particle[row];
    const int dim = p->dim;
    real M[DIM_MAX * DIM_MAX] = {0}, R[DIM_MAX * DIM_MAX], sum = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const int32_t j = it.bond.nbr;
            const real w = it.bond.w;
            if (w == 0) continue;
            for (int d = 0; d < dim; d++) {
                real effective = bond_vector_component_at_earlier_time(p, i, j, d, lag);
                for (int c = 0; c < dim && pass == 0; c++) M[d * dim + c] += w * effective * (p->X[c][j] - p->X[c][i]);
                for (int c = 0; c < dim && pass == 1; c++) effective -= R[d * dim + c] * (p->X[c][j] - p->X[c][i]);
                if (pass == 1) sum += w * square(effective);
            }
        }
        if (pass == 0 && p->kind[i] == KIND_PD) polar_rotation(M, R, dim);
        if (pass == 0 && p->kind[i] != KIND_PD) end_rotation(p, i, R);
    }
    return sum;
}

real state_row_energy(const struct bonds *b, const struct particles *p, int64_t row, real lag)
{
    const int32_t i = b->particle[row];
    const struct state_modulus *m = &b->state.modulus[p->material[i]];
    real Q = 0, S = 0, e2 = 0;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const real w = it.bond.w, r = fabs(1 / it.bond.inverse_length);
        real y2 = 0;
        if (w == 0) continue;
        for (int d = 0; d < p->dim; d++) y2 += square(bond_vector_component_at_earlier_time(p, i, it.bond.nbr, d, lag));
        const real e = sqrt(y2) - r;
        Q += w * r * r, S += w * r * e, e2 += w * e * e;
    }
    if (!b->state.local || !b->whole[row] || b->soft.whole) Q = b->state.weighted[row];
    if (!(Q > 0)) return 0;
    if (b->state.rotation[0]) e2 = row_effective(b, p, row, lag);
    const real mean = S / Q + (p->kind[i] == KIND_PD ? 0 : p->end_strain[i]);
    const real share = b->state.share > 0 ? b->state.share : p->volume0[i] / Q;
    return 0.5 * share * (m->A * Q * square(mean) + m->B * e2);
}
