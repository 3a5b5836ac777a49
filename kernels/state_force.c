/* floor 2: forces of state-based peridynamics: a sweep over the rows for what particles know of their families, one over
 * their bonds for the forces (state_laws.h). Owner computes in both; the same bits on any number of threads. */
#include <math.h>

#include "kernels.h"
#include "polar.h"
#include "state_laws.h"
#include "variants.h"

/* ---- first sweep: what a particle knows of its family ---------------------------------------------------- */

/* Rotation of the least energy from M = sum w Y (x) xi [dim dim], times g, into the particle's entries. */
static ALWAYS_INLINE void turn_store(struct bonds *b, int32_t i, const real *M, real g, const int dim)
{
    real R[DIM_MAX * DIM_MAX];
    polar_rotation(M, R, dim);
    for (int c = 0; c < dim * dim; c++) b->state.turn[c][i] = g * R[c];
}

/* Rows of peridynamic particles of one group. */
static ALWAYS_INLINE void state_group(struct bonds *b, const struct particles *p, int64_t g, const int dim,
                                      const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    lanes x[DIM_MAX], X[DIM_MAX], sum = lanes_of(0), moment[DIM_MAX * DIM_MAX];
    for (int d = 0; d < dim; d++) {
        x[d] = lanes_at(p->x[d], own, row);
        X[d] = state_turns(model) ? lanes_at(p->X[d], own, row) : x[d];
    }
    for (int c = 0; c < dim * dim; c++) moment[c] = lanes_of(0);
    for (int64_t slot = b->slot[g]; slot < b->slot[g + 1]; slot++) {
        struct state_bond s;
        state_bond_make(&s, b, p, slot, x, X, dim, model);
        sum += s.w * s.r * s.e;
        if (state_turns(model))
            for (int c = 0; c < dim * dim; c++) moment[c] += s.w * s.y[c / dim] * s.xi[c % dim];
    }
    for (int l = 0; l < LANES && g * LANES + l < b->rows; l++) {
        const int32_t i = row[l];
        if (p->kind[i] != KIND_PD) continue;
        const struct state_modulus *m = &b->state.modulus[p->material[i]];
        const real Q = b->state.weighted[g * LANES + l], share = Q > 0 ? p->volume0[i] / Q : 0;
        b->state.pressure[i] = Q > 0 ? m->A * sum[l] / Q * share : 0;
        b->state.spring[i] = m->B * share;
        if (!state_turns(model)) continue;
        real M[DIM_MAX * DIM_MAX];
        for (int c = 0; c < dim * dim; c++) M[c] = moment[c][l];
        turn_store(b, i, M, m->B * share, dim);
    }
}

/* A material point has the mean strain that its stress tells, and the mean rotation of the particles it is bonded to. */
static ALWAYS_INLINE void state_of_point(struct bonds *b, const struct particles *p, int64_t row, const int dim,
                                         const enum pd_model model)
{
    const int32_t i = b->particle[row];
    const struct state_modulus *m = &b->state.modulus[p->material[i]];
    const real share = p->volume0[i] / b->state.weighted[row];
    real trace = 0, M[DIM_MAX * DIM_MAX] = {0};
    for (int d = 0; d < dim; d++) trace += p->stress[d][i];
    b->state.pressure[i] = m->A * trace / (dim * dim * m->bulk) * share;
    b->state.spring[i] = m->B * share;
    if (!state_turns(model)) return;
    for (int64_t k = 0; k < b->slot[row / LANES + 1] - b->slot[row / LANES]; k++) {
        const int64_t q = bond_index(b, row / LANES, k, (int)(row % LANES));
        const int32_t j = b->nbr[q];
        if (b->w[q] == 0) continue;
        for (int c = 0; c < dim * dim; c++) M[c] += b->w[q] * b->state.turn[c][j] / b->state.spring[j];
    }
    turn_store(b, i, M, m->B * share, dim);
}

/* Mirror images know what their source knows; a plane of symmetry turns rotations round. */
static void state_of_images(struct bonds *b, const struct particles *p, int dim, bool turns)
{
    for (int64_t g = p->n; g < p->n_all; g++) {
        const int32_t i = b->state.image[g - p->n].source;
        const int axis = b->state.image[g - p->n].axis;
        b->state.pressure[g] = b->state.pressure[i];
        b->state.spring[g] = b->state.spring[i];
        for (int c = 0; turns && c < dim * dim; c++) {
            const bool odd = axis >= 0 && (c / dim == axis) != (c % dim == axis);
            b->state.turn[c][g] = odd ? -b->state.turn[c][i] : b->state.turn[c][i];
        }
    }
}

/* ---- second sweep: forces -------------------------------------------------------------------------------- */

/* Force of one group, mixed into what f holds by `share`; returns whether a bond may have passed its limit. */
static ALWAYS_INLINE bool force_group(const struct bonds *b, struct particles *p, int64_t g, const real share,
                                      const int dim, const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    const struct state *t = &b->state;
    lanes x[DIM_MAX], X[DIM_MAX], f[DIM_MAX], turn[DIM_MAX * DIM_MAX], largest = lanes_of(-1);
    const lanes pressure = lanes_at(t->pressure, own, row), spring = lanes_at(t->spring, own, row);
    for (int d = 0; d < dim; d++) {
        x[d] = lanes_at(p->x[d], own, row), f[d] = lanes_of(0);
        X[d] = state_turns(model) ? lanes_at(p->X[d], own, row) : x[d];
    }
    for (int c = 0; state_turns(model) && c < dim * dim; c++) turn[c] = lanes_at(t->turn[c], own, row);
    for (int64_t slot = b->slot[g]; slot < b->slot[g + 1]; slot++) {
        const int32_t *nbr = b->nbr + slot * LANES, first = b->first[slot];
        struct state_bond s;
        state_bond_make(&s, b, p, slot, x, X, dim, model);
        largest = lanes_max(largest, s.stretch);
        lanes along = s.r * (pressure + lanes_at(t->pressure, first, nbr));
        const lanes both = spring + lanes_at(t->spring, first, nbr);
        if (!state_turns(model)) along += s.e * both;
        along *= s.w * s.inverse;
        for (int d = 0; d < dim; d++) f[d] += along * s.y[d];
        if (!state_turns(model)) continue;
        for (int d = 0; d < dim; d++) {
            lanes effective = both * s.y[d];
            for (int c = 0; c < dim; c++)
                effective -= (turn[d * dim + c] + lanes_at(t->turn[d * dim + c], first, nbr)) * s.xi[c];
            f[d] += s.w * effective;
        }
    }
    for (int d = 0; d < dim; d++)
        for (int l = 0; l < LANES && g * LANES + l < b->rows; l++)
            p->f[d][row[l]] = share == 1 ? f[d][l] : share * f[d][l] + (1 - share) * p->f[d][row[l]];
    return lanes_any(largest > lanes_load(b->trigger + g * LANES));
}

#define INSTANCE(D, M)                                                                                       \
    static void state_know_##D##d_##M(struct bonds *b, const struct particles *p)                            \
    {                                                                                                        \
        _Pragma("omp parallel for schedule(static)")                                                         \
        for (int64_t g = 0; g < b->groups; g++) state_group(b, p, g, D, PD_##M);                             \
        _Pragma("omp parallel for schedule(static)")                                                         \
        for (int64_t row = 0; row < b->rows; row++)                                                          \
            if (p->kind[b->particle[row]] == KIND_MPM) state_of_point(b, p, row, D, PD_##M);                 \
        state_of_images(b, p, D, state_turns(PD_##M));                                                       \
    }                                                                                                        \
    static int64_t state_force_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit) \
    {                                                                                                        \
        int64_t broken = 0;                                                                                  \
        state_know_##D##d_##M(b, p);                                                                         \
        _Pragma("omp parallel for schedule(static) reduction(+ : broken)")                                   \
        for (int64_t g = 0; g < b->groups; g++) {                                                            \
            if (!force_group(b, p, g, 1, D, PD_##M)) continue;                                               \
            int64_t here = bond_break_group(b, p, limit, g);                                                 \
            if (here > 0) force_group(b, p, g, 0.5, D, PD_##M);                                              \
            broken += here;                                                                                  \
        }                                                                                                    \
        return broken;                                                                                       \
    }
STATE_VARIANTS(INSTANCE)

#define ENTRY(D, M) [D][PD_##M] = state_force_##D##d_##M,
bond_force_fn *const state_force_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(ENTRY)};

#define KNOW(D, M) [D][PD_##M] = state_know_##D##d_##M,
state_know_fn *const state_know_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(KNOW)};
