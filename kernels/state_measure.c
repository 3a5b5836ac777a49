/* floor 2: what state-based bonds hold: their elastic energy, and the stress they amount to. Visited at samples and frames
 * only, from what the last sweep over the families left in b->state.
 *     energy of row i   1/2 sum_j (own force state of i) . (effective displacement):  its sum over j is V_i W_i
 *     stress            sigma_i = (1/V_i) sum_j T_ij V_j (x) xi_ij, made symmetric (own force state only) */
#include <math.h>

#include "kernels.h"
#include "state_laws.h"
#include "team.h"
#include "variants.h"

struct row_sum { const struct bonds *b; const struct particles *p; };

static ALWAYS_INLINE real energy_row(const struct row_sum *s, int64_t row, const int dim, const enum pd_model model)
{
    const struct bonds *b = s->b;
    real sum = 0, T[DIM_MAX], xi[DIM_MAX];
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] != 0) sum += state_own_force(b, s->p, q, b->particle[row], T, xi, dim, state_turns(model));
    }
    return sum;
}

static ALWAYS_INLINE void stress_row(const struct bonds *b, struct particles *p, int64_t row, const int dim,
                                     const enum pd_model model)
{
    static const int first[SYM_MAX] = {0, 1, 2, 0, 1, 2}, second[SYM_MAX] = {0, 1, 2, 1, 2, 0};
    const int32_t i = b->particle[row];
    real stress[SYM_MAX] = {0}, T[DIM_MAX], xi[DIM_MAX];
    if (p->kind[i] != KIND_PD) return;
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        if (b->w[q] == 0) continue;
        state_own_force(b, p, q, i, T, xi, dim, state_turns(model));
        for (int s = 0; s < dim * (dim + 1) / 2; s++) {
            const int a = s < dim ? s : first[3 + s - dim], c = s < dim ? s : second[3 + s - dim];
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
