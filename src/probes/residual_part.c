/* Records the largest nodal force of the first step, which PATCH probes report. */
#include <math.h>

#include "probes/probes_part.h"
#include "grid/grid_part.h"

/* Returns true if position x[dim] [m] is in the region of a probe of kind PATCH (patch test) of scene s. */
static bool in_patch(const struct scene *s, const real *x)
{
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_PATCH && region_contains(&s->probe[k].region, x, s->dim, 0)) return true;
    return false;
}

/* Raises *most to the largest absolute force component on node I of grid g [N], if the node is in the region of a
 * probe of kind PATCH (patch test) of scene s. at: index of the node of the regular grid at the same position; it
 * differs from I if I is a second node at the same position, on the other side of a pre-crack. */
static void node_keep(const struct scene *s, const struct grid *g, int64_t I, int64_t at, real *most)
{
    real x[DIM_MAX];
    for (int d = 0; d < g->dim; d++) x[d] = grid_node_position(g, d, at / g->stride[d] % g->count[d]);
    for (int d = 0; d < g->dim; d++)
        if (in_patch(s, x)) *most = real_max(*most, fabs(g->force[d][I]));
}

void patch_test_include_mesh_residual_force(struct probing *probing, const struct scene *s, const struct mesh *mesh)
{
    for (int64_t I = 0; I < mesh->grid.n; I++)
        node_keep(s, &mesh->grid, I, mesh_original_node_of_doubled_node(mesh, I), &probing->residual_step0);
}

void patch_test_store_largest_residual_force(struct probing *probing, const struct scene *s, const struct particles *p,
                                             const struct grid_method *grid)
{
    real x[DIM_MAX], *most = &probing->residual_step0;
    for (int k = 0; k < grid->fields; k++) {
        const struct grid *g = &grid->field[k].grid;
        for (int64_t I = 0; I < g->n; I++) node_keep(s, g, I, I, most);
    }
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        int32_t i = p->list[KIND_PD][k];
        if (particle_is_moved_by_grid_or_mesh_nodes(p, i)) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->X[d][i];
        for (int d = 0; d < p->dim; d++)
            if (in_patch(s, x)) *most = real_max(*most, fabs(p->f[d][i]));
    }
}
