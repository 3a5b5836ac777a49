/* Limits the coarsening level of cells by the thickness of the body, since the body is too stiff in bending if few
 * cells are across a part of it. Level L is allowed where a cube of CELLS_ACROSS of its cells fits into the body. These
 * are the cells in the morphological opening of the body, i.e. the body eroded and then dilated by half of this width
 * (Serra 1982). */
#include <string.h>

#include "mesh_parts.h"
#include "mesh/levels.h"

/* Returns true if the middle of cell I of grid g is beyond one of the planes of symmetry mirror[mirrors], where the
 * mirror image of the body continues it. */
static bool beyond_mirror(const struct grid *g, int64_t I, const struct mirror_plane *mirror, int mirrors)
{
    bool beyond = false;
    for (int k = 0; k < mirrors; k++) {
        const int d = mirror[k].axis;
        const real x = grid_node_position(g, d, I / g->stride[d] % g->count[d]) + 0.5 * g->h;
        beyond |= (x - mirror[k].at) * mirror[k].outside > 0;
    }
    return beyond;
}

/* Sets mark[I] to 1 for the cells of `mesh` outside the body and for cells at slits (pre-cracks), which are faces of
 * the body, else to 0. Cells beyond a plane of symmetry, mirror[mirrors], are inside. */
static void outside_mark(const struct mesh *mesh, const struct mirror_plane *mirror, int mirrors, uint8_t *mark)
{
    const int64_t cells = mesh->slits.split ? mesh->slits.first : mesh->grid.n;
    for (int64_t I = 0; I < cells; I++) {
        const bool body = mesh->kind[I] != CELL_EMPTY || (mesh->absent && mesh->absent[I]);
        mark[I] = !body && !beyond_mirror(&mesh->grid, I, mirror, mirrors);
    }
    for (int64_t I = 0; I < cells && mesh->slits.split; I++)
        for (int c = 0; c < 1 << mesh->grid.dim && mesh->slits.split[I]; c++) mark[I - mesh->corner[c]] = 1;
}

int mesh_compute_coarsest_cell_levels_for_thickness(const struct mesh *mesh, const struct mirror_plane *mirror,
                                                    int mirror_count, uint8_t *coarsest_level)
{
    const int64_t n = mesh->grid.n;
    uint8_t *outside = NEW("mesh.outside", 2 * n, uint8_t), *inside = outside + n;
    int most = 0;
    array_fill_bytes(coarsest_level, 0, n, 1);
    for (int level = 1; level <= LEVELS_MAX && most == level - 1; level++) {
        const int half = (CELLS_ACROSS << level) / 2 - 1;
        outside_mark(mesh, mirror, mirror_count, outside);
        grid_mark_cells_near_marked_cells(&mesh->grid, outside, half);
        for (int64_t I = 0; I < n; I++) inside[I] = !outside[I] && !beyond_mirror(&mesh->grid, I, mirror, mirror_count);
        grid_mark_cells_near_marked_cells(&mesh->grid, inside, half);
        for (int64_t I = 0; I < n; I++)
            if (inside[I] && coarsest_level[I] == level - 1) coarsest_level[I] = (uint8_t)level, most = level;
    }
    memory_free(outside);
    return most;
}
