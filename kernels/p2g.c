/* floor 2: the first map: mass, momentum and force of material points to the nodes, scattered block by block, colour
 * by colour (struct transfer_order), so that a node has one writer at a time and always the same order of terms.
 *
 *     m_I = sum m N,   P_I = sum m v N   (APIC: m (v + L (x_I - x_p)) N),   f_I = sum (N f - V sigma_given . grad N)
 *
 * Zeng et al. 2022, eqs. 33-36, with sums over all nodes of a point. Reads about 120 bytes a point in
 * 2D; nodes of a block stay in cache. */
#include <string.h>

#include "kernels.h"
#include "scatter.h"
#include "shape.h"
#include "stress.h"
#include "variants.h"

/* sigma . grad, component d. */
static ALWAYS_INLINE row_of_nodes stress_force(const real *s, const row_of_nodes *grad, int d, const int dim)
{
    if (dim == 1) return s[0] * grad[0];
    if (dim == 2) return d == 0 ? s[0] * grad[0] + s[2] * grad[1] : s[2] * grad[0] + s[1] * grad[1];
    if (d == 0) return s[0] * grad[0] + s[3] * grad[1] + s[5] * grad[2];
    if (d == 1) return s[3] * grad[0] + s[1] * grad[1] + s[4] * grad[2];
    return s[5] * grad[0] + s[4] * grad[1] + s[2] * grad[2];
}

/* Force of the skew part of the stress given: f_a = -V sum_b skew_ab grad_b. Few points have one (partial_stress.c). */
static ALWAYS_INLINE void p2g_skew(struct grid *g, const struct particles *p, const struct transfer_data *t,
                                   const struct stencil *s, int64_t i, const int dim, const enum shape shape)
{
    static const int first[DIM_MAX] = {0, 1, 2}, second[DIM_MAX] = {1, 2, 0};
    real skew[DIM_MAX];
    if (dim == 1 || t->bare || !stress_given_skew(p, t->partial, i, skew, dim)) return;
    FOR_ROWS(dim, shape) {
        const int64_t I = stencil_row(s, g, k1, k2, dim);
        row_of_nodes grad[DIM_MAX];
        stencil_gradient(s, k1, k2, grad, dim);
        for (int c = 0; c < dim * (dim - 1) / 2; c++) {
            const real force = skew[c] * p->volume[i];
            row_add(g->force[first[c]] + I, -force * grad[second[c]]);
            row_add(g->force[second[c]] + I, force * grad[first[c]]);
        }
    }
}

static ALWAYS_INLINE void p2g_particle(struct grid *g, const struct particles *p, const struct transfer_data *t,
                                       int64_t i, const int dim, const enum shape shape, const enum transfer transfer)
{
    struct stencil s;
    stencil_make(&s, g, p, i, t->half_width, dim, shape);
    real stress[SYM_MAX], momentum[DIM_MAX], force[DIM_MAX], gradient[DIM_MAX * DIM_MAX];
    if (t->bare) memset(stress, 0, sizeof stress);
    else stress_given(p, t->partial, i, stress, dim);
    const real mass = p->mass[i], volume = p->volume[i];
    const row_of_nodes along = (row_of_nodes){0, 1, 2, 3} * g->h;      /* distance from the lowest node */
    for (int c = 0; c < dim * (dim + 1) / 2; c++) stress[c] *= volume;
    for (int d = 0; d < dim; d++) {
        momentum[d] = mass * p->v[d][i];
        force[d] = p->f[d][i];
        if (transfer == TRANSFER_APIC)
            for (int e = 0; e < dim; e++) {
                gradient[d * dim + e] = mass * p->gradient[d * dim + e][i];
                momentum[d] -= gradient[d * dim + e] * s.r[e];
            }
    }
    FOR_ROWS(dim, shape) {
        const int64_t I = stencil_row(&s, g, k1, k2, dim);
        const row_of_nodes N = stencil_weight(&s, k1, k2, dim);
        row_of_nodes grad[DIM_MAX];
        stencil_gradient(&s, k1, k2, grad, dim);
        row_add(g->mass + I, mass * N);
        for (int d = 0; d < dim; d++) {
            row_of_nodes carried = momentum[d] + (row_of_nodes){0};
            if (transfer == TRANSFER_APIC) {
                carried += gradient[d * dim] * along;
                if (dim > 1) carried += gradient[d * dim + 1] * (g->h * k1);
                if (dim > 2) carried += gradient[d * dim + 2] * (g->h * k2);
            }
            row_add(g->momentum[d] + I, carried * N);
            row_add(g->force[d] + I, force[d] * N - stress_force(stress, grad, d, dim));
        }
    }
    if (t->partial && t->partial->skew) p2g_skew(g, p, t, &s, i, dim, shape);
}

#define INSTANCE(D, S, T)                                                                                           \
    static void p2g_##D##d_##S##_##T(struct grid *g, const struct particles *p, const struct transfer_data *t)      \
    {                                                                                                               \
        SCATTER(D, t->order, g, p, p2g_particle(&nodes, &points, t, i, D, SHAPE_##S, TRANSFER_##T));                \
    }
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
SHAPE_VARIANTS(BOTH)

#define ENTRY(D, S, T) [D][SHAPE_##S][TRANSFER_##T] = p2g_##D##d_##S##_##T,
#define ENTRIES(D, S) TRANSFER_VARIANTS(ENTRY, D, S)
p2g_fn *const p2g_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(ENTRIES)};

/* ---- a single field of few points -------------------------------------------------------------------- */

static ALWAYS_INLINE void spread_particle(const struct grid *g, const struct particles *p, real half_width, int64_t i,
                                          real value, real *field, const int dim, const enum shape shape)
{
    struct stencil s;
    stencil_make(&s, g, p, i, half_width, dim, shape);
    FOR_ROWS(dim, shape) row_add(field + stencil_row(&s, g, k1, k2, dim), value * stencil_weight(&s, k1, k2, dim));
}

#define SPREAD(D, S)                                                                                            \
    static void spread_##D##d_##S(const struct grid *g, const struct particles *p, real half_width,             \
                                  const int32_t *list, int64_t n, const real *value, real *field)               \
    {                                                                                                           \
        for (int64_t k = 0; k < n; k++)                                                                         \
            spread_particle(g, p, half_width, list[k], value[k], field, D, SHAPE_##S);                          \
    }
SHAPE_VARIANTS(SPREAD)

#define SPREAD_ENTRY(D, S) [D][SHAPE_##S] = spread_##D##d_##S,
spread_fn *const spread_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(SPREAD_ENTRY)};
