/* floor 2: what state-based bonds hold: their elastic energy, and the stress they amount to. Visited at samples and frames
 * only, from what the last sweep over the families left in b->state.
 *     energy of row i   1/2 sum_j (own force state of i) . (effective displacement):  its sum over j is V_i W_i
 *     stress            sigma_i = (1/V_i) sum_j T_ij V_j (x) xi_ij, made symmetric (own force state only) */
#include <math.h>

#include "kernels.h"
#include "polar.h"
#include "state_laws.h"
#include "team.h"
#include "variants.h"

struct row_sum { const struct bonds *b; const struct particles *p; };

static ALWAYS_INLINE real energy_row(const struct row_sum *s, int64_t row, const int dim, const enum pd_model model)
{
    const struct bonds *b = s->b;
    real sum = 0, T[DIM_MAX], xi[DIM_MAX];
    if (b->rest.level[row / LANES] == 0) return 0;
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] != 0) sum += state_own_force(b, s->p, q, b->particle[row], T, xi, dim, state_turns(model));
    }
    return sum;
}

static ALWAYS_INLINE void stress_row(const struct bonds *b, struct particles *p, int64_t row, const int dim,
                                     const enum pd_model model)
{
    const int32_t i = b->particle[row];
    real stress[SYM_MAX] = {0}, T[DIM_MAX], xi[DIM_MAX];
    if (p->kind[i] != KIND_PD) return;
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] == 0) continue;
        state_own_force(b, p, q, i, T, xi, dim, state_turns(model));
        for (int s = 0; s < dim * (dim + 1) / 2; s++) {
            int a, c;
            symmetric_axes(dim, s, &a, &c);
            stress[s] += 0.5 * (T[a] * xi[c] + T[c] * xi[a]) / p->volume0[i];
        }
    }
    for (int s = 0; s < dim * (dim + 1) / 2; s++) p->stress[s][i] = stress[s];
}

#define INSTANCE(D, M)                                                                                          \
    static real energy_term_##D##d_##M(const void *context, int64_t row)                                        \
    {                                                                                                           \
        return energy_row(context, row, D, PD_##M);                                                             \
    }                                                                                                           \
    static real state_energy_##D##d_##M(const struct bonds *b, const struct particles *p)                       \
    {                                                                                                           \
        return team_sum(b->rows, energy_term_##D##d_##M, &(struct row_sum){b, p});                              \
    }                                                                                                           \
    static void state_stress_##D##d_##M(const struct bonds *b, struct particles *p)                             \
    {                                                                                                           \
        _Pragma("omp parallel for schedule(static)")                                                            \
        for (int64_t row = 0; row < b->rows; row++) stress_row(b, p, row, D, PD_##M);                           \
    }
STATE_VARIANTS(INSTANCE)

#define ENERGY(D, M) [D][PD_##M] = state_energy_##D##d_##M,
bond_energy_fn *const state_energy_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(ENERGY)};
#define STRESS(D, M) [D][PD_##M] = state_stress_##D##d_##M,
bond_stress_fn *const state_stress_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(STRESS)};

/* ---- a row whose weights change ------------------------------------------------------------------------- */

/* w |Y - R xi|^2 over a row, with the rotation that its weights ask for now [m^2]. */
static real row_effective(const struct bonds *b, const struct particles *p, int64_t row)
{
    const int32_t i = b->particle[row];
    const int dim = p->dim;
    real M[DIM_MAX * DIM_MAX] = {0}, R[DIM_MAX * DIM_MAX], sum = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
            const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
            const int32_t j = b->nbr[q];
            if (b->w[q] == 0) continue;
            for (int d = 0; d < dim; d++) {
                real effective = p->x[d][j] - p->x[d][i];
                for (int c = 0; c < dim && pass == 0; c++) M[d * dim + c] += b->w[q] * effective * (p->X[c][j] - p->X[c][i]);
                for (int c = 0; c < dim && pass == 1; c++) effective -= R[d * dim + c] * (p->X[c][j] - p->X[c][i]);
                if (pass == 1) sum += b->w[q] * square(effective);
            }
        }
        if (pass == 0) polar_rotation(M, R, dim);
    }
    return sum;
}

/* A material point's pressure is that of its stress, whatever its bonds weigh: linear in the weights. */
static real point_energy(const struct bonds *b, const struct particles *p, int64_t row)
{
    real sum = 0, T[DIM_MAX], xi[DIM_MAX];
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] != 0) sum += state_own_force(b, p, q, b->particle[row], T, xi, p->dim, b->state.turn[0] != NULL);
    }
    return sum;
}

real state_row_energy(const struct bonds *b, const struct particles *p, int64_t row)
{
    const int32_t i = b->particle[row];
    const struct state_modulus *m = &b->state.modulus[p->material[i]];
    real Q = 0, S = 0, e2 = 0;
    if (p->kind[i] != KIND_PD) return point_energy(b, p, row);
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] == 0) continue;
        real y2 = 0, r = fabs(1 / b->inverse_length[q]);
        for (int d = 0; d < p->dim; d++) y2 += square(p->x[d][b->nbr[q]] - p->x[d][i]);
        const real e = sqrt(y2) - r;
        Q += b->w[q] * r * r, S += b->w[q] * r * e, e2 += b->w[q] * e * e;
    }
    if (!b->state.local || !b->whole[row]) Q = b->state.weighted[row];
    if (!(Q > 0)) return 0;
    if (b->state.turn[0]) e2 = row_effective(b, p, row);
    return 0.5 * p->volume0[i] * (m->A * square(S / Q) + m->B * e2 / Q);
}
