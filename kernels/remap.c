/* floor 2: the second map of MUSL: points take the change of the nodal velocities (FLIP), then give their new momentum
 * back to the nodes with the same weights:  v_p += sum N dv_I,   P_I = sum m v_p N  (Zeng et al. 2022, eqs. 39, 42). */
#include "kernels.h"
#include "scatter.h"
#include "shape.h"
#include "variants.h"

static ALWAYS_INLINE void remap_particle(struct grid *g, struct particles *p, const struct transfer_data *t, int64_t i,
                                         const int dim, const enum shape shape)
{
    struct stencil s;
    stencil_make(&s, g, p, i, t->half_width, dim, shape);
    row_of_nodes change[DIM_MAX] = {{0}};
    real momentum[DIM_MAX];
    FOR_ROWS(dim, shape) {
        const int64_t I = stencil_row(&s, g, k1, k2, dim);
        const row_of_nodes N = stencil_weight(&s, k1, k2, dim);
        for (int d = 0; d < dim; d++) change[d] += N * row_load(g->force[d] + I);
    }
    for (int d = 0; d < dim; d++) {
        p->v[d][i] += row_sum(change[d]);
        momentum[d] = p->mass[i] * p->v[d][i];
    }
    FOR_ROWS(dim, shape) {
        const int64_t I = stencil_row(&s, g, k1, k2, dim);
        const row_of_nodes N = stencil_weight(&s, k1, k2, dim);
        for (int d = 0; d < dim; d++) row_add(g->momentum[d] + I, momentum[d] * N);
    }
}

#define INSTANCE(D, S)                                                                                              \
    static void remap_##D##d_##S(struct grid *g, struct particles *p, const struct transfer_data *t)                \
    {                                                                                                               \
        SCATTER(D, t->order, g, p, remap_particle(&nodes, &points, t, i, D, SHAPE_##S));                            \
    }
SHAPE_VARIANTS(INSTANCE)

#define ENTRY(D, S) [D][SHAPE_##S] = remap_##D##d_##S,
remap_fn *const remap_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(ENTRY)};
