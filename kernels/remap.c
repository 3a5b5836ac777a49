/* floor 2: the second map of MUSL: points take the change of the nodal velocities (FLIP), then give their new momentum
 * back to the nodes with the same weights:  v_p += sum N dv_I,   P_I = sum m v_p N  (Zeng et al. 2022, eqs. 39, 42). */
#include "kernels.h"
#include "scatter.h"
#include "shape.h"
#include "variants.h"

/* By rows of a cell's nodes: the change of velocity, and the sums of momentum. */
typedef row_of_nodes cell_rows[DIM_MAX][ROWS_MAX];

static ALWAYS_INLINE void remap_particle(cell_rows change, cell_rows sum, const struct grid *g, const struct cell *c,
                                         struct particles *p, const struct transfer_data *t, int64_t i, const int dim,
                                         const enum shape shape)
{
    struct stencil s;
    stencil_make(&s, g, c, p, i, t->half_width, dim, shape);
    row_of_nodes gain[DIM_MAX], momentum[DIM_MAX];
    for (int d = 0; d < dim; d++) gain[d] = row_of(0);
    FOR_TOUCHED(&s, dim, shape) {
        const real weight = stencil_row(&s, k1, k2, dim, shape);
        for (int d = 0; d < dim; d++) gain[d] += weight * change[d][PATCH(dim, shape)];
    }
    for (int d = 0; d < dim; d++) {
        p->v[d][i] += row_sum(s.N * gain[d]);
        momentum[d] = p->mass[i] * p->v[d][i] * s.N;
    }
    FOR_TOUCHED(&s, dim, shape) {
        const real weight = stencil_row(&s, k1, k2, dim, shape);
        for (int d = 0; d < dim; d++) sum[d][PATCH(dim, shape)] += momentum[d] * weight;
    }
}

static ALWAYS_INLINE void remap_fetch(const struct particles *p, const int32_t *list, int k, const int dim)
{
    int64_t i;
    if (!fetch_now(list, k, &i)) return;
    fetch(p->mass + i);
    for (int d = 0; d < dim; d++) fetch(p->x[d] + i), fetch(p->v[d] + i);
}

static ALWAYS_INLINE void remap_cell(const struct grid *g, struct particles *p, const struct transfer_data *t,
                                     const int32_t *list, int n, const int dim, const enum shape shape)
{
    const struct cell c = cell_make(g, p, list[0], dim, shape);
    cell_rows change, sum;
    FOR_ROWS(dim, shape)
        for (int d = 0; d < dim; d++) {
            change[d][PATCH(dim, shape)] = nodes_load(g, g->force[d] + cell_row(&c, g, k1, k2, dim), dim, shape);
            sum[d][PATCH(dim, shape)] = row_of(0);
        }
    for (int k = 0; k < n; k++) {
        remap_fetch(p, list, k, dim);
        remap_particle(change, sum, g, &c, p, t, list[k], dim, shape);
    }
    FOR_ROWS(dim, shape)
        for (int d = 0; d < dim; d++)
            nodes_add(g, g->momentum[d] + cell_row(&c, g, k1, k2, dim), sum[d][PATCH(dim, shape)], dim, shape);
}

#define INSTANCE(D, S)                                                                                              \
    static void remap_##D##d_##S(struct grid *g, struct particles *p, const struct transfer_data *t)                \
    {                                                                                                               \
        const struct transfer_data data = *t;                                                                       \
        SCATTER(D, t->order, g, p, remap_cell(&nodes, &points, &data, list, n, D, SHAPE_##S));                      \
    }
SHAPE_VARIANTS(INSTANCE)

#define ENTRY(D, S) [D][SHAPE_##S] = remap_##D##d_##S,
remap_fn *const remap_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(ENTRY)};
