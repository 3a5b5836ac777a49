/* Counts the connected pieces of a mesh that would contain all particles. Pieces have no node in common, so that
 * nothing on the mesh would prevent them from passing through each other. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"

bool mesh_cell_contains_material(const struct mesh *mesh, int64_t I) { return mesh->kind[I] != CELL_EMPTY; }

/* Initialises *box as a box of nodes around the particles p, aligned with the nodes of the grid `like`; arrays over the
 * nodes are not allocated. Returns false if the box has too many nodes. */
static bool box_make(struct mesh *box, const struct particles *p, const struct grid *like)
{
    struct grid *g = &box->grid;
    real from[DIM_MAX], to[DIM_MAX];
    memset(box, 0, sizeof *box);
    g->dim = p->dim, g->h = like->h;
    for (int d = 0; d < p->dim; d++) {
        particles_coordinate_range(p, p->n, d, &from[d], &to[d]);
        g->anchor[d] = like->anchor[d];
    }
    if (!grid_set_box_if_not_too_large(g, from, to, INT32_MAX >> p->dim)) return false;
    for (int c = 0; c < 1 << p->dim; c++)
        for (int d = 0; d < p->dim; d++) box->corner[c] += (int32_t)((c >> d & 1) * g->stride[d]);
    return true;
}

/* Returns the root of the set of nodes that contains node I (union-find with path compression). above: 1 + parent of
 * each node, for a root 1 + the node itself; 0: a node without particles. */
static int32_t mesh_pieces_root_of(int32_t *above, int32_t I)
{
    while (above[I] != I + 1) {
        above[I] = above[above[I] - 1];
        I = above[I] - 1;
    }
    return I;
}

/* Joins the sets of nodes that contain the nodes I and J. above: 1 + parent of each node in its set (union-find), 0 for
 * a node without particles. */
static void join(int32_t *above, int32_t I, int32_t J)
{
    if (above[I] == 0) above[I] = I + 1;
    if (above[J] == 0) above[J] = J + 1;
    const int32_t a = mesh_pieces_root_of(above, I), b = mesh_pieces_root_of(above, J);
    above[a > b ? a : b] = (a > b ? b : a) + 1;
}

/* Joins the nodes of each cell whose particles were not created into one set, as if the particles were there. above: 1
 * + parent of each node of `box` in its set (union-find), 0 for a node without particles; hollow: the cells, NULL if
 * all particles were created. */
static void hollow_join(int32_t *above, const struct mesh *box, const struct cells_without_particles *hollow)
{
    for (int64_t I = 0; hollow && hollow->absent && I < hollow->box.n; I++) {
        if (!hollow->absent[I]) continue;
        const int64_t cell = grid_cell_index_in_other_grid(&hollow->box, I, &box->grid);
        for (int c = 0; c < 1 << hollow->box.dim; c++) join(above, (int32_t)cell, (int32_t)cell + box->corner[c]);
    }
}

int64_t mesh_count_connected_parts(const struct particles *p, const struct grid *node_grid,
                                   const struct cells_without_particles *empty_cells)
{
    struct mesh box;
    int64_t pieces = 0, last = -1;
    bool fits = box_make(&box, p, node_grid);
    if (!fits) return 0;
    int32_t *above = NEW("mesh.above", box.grid.n, int32_t);
    for (int64_t i = 0; i < p->n && fits; i++) {
        const int64_t place = mesh_find_quadrature_point_index_of_particle(&box, p, i), cell = place >> p->dim;
        fits = place >= 0;
        for (int c = 0; c < 1 << p->dim && fits && cell != last; c++)
            join(above, (int32_t)cell, (int32_t)cell + box.corner[c]);
        last = cell;
    }
    if (fits) hollow_join(above, &box, empty_cells);
    for (int64_t I = 0; I < box.grid.n && fits; I++) pieces += above[I] == I + 1;
    memory_free(above);
    return pieces;
}
