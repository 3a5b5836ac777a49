/* Selects the grid-coupled particles, i.e. peridynamic particles whose velocity and position the background grid
 * updates (couplings of Zeng et al. 2021, see grid_coupled.h). */
#include "grid/grid_coupled.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Returns the index of the cell of grid g that contains particle i of p, by its lowest node, or -1 if the particle is
 * outside the box of nodes. k[dim]: receives the position of the cell in the box along each axis. */
static int64_t grid_coupled_cell_of(const struct particles *p, const struct grid *g, int64_t i, int64_t *k)
{
    int64_t cell = 0;
    for (int d = 0; d < g->dim; d++) {
        k[d] = (int64_t)floor((p->x[d][i] - g->anchor[d]) / g->h) - g->first[d];
        if (k[d] < 0 || k[d] >= g->count[d]) return -1;
        cell += k[d] * g->stride[d];
    }
    return cell;
}

/* Sets c->occupied to 1 for the cells of grid g that contain material points of p, else to 0. */
static void mark_occupied(struct grid_coupled *c, const struct particles *p, const struct grid *g)
{
    int64_t k[DIM_MAX];
    GROW("grid_coupled.occupied", c->occupied, g->n);
    array_fill_bytes(c->occupied, 0, g->n, 1);
    for (int64_t m = 0; m < p->n_of[KIND_MPM]; m++) {
        int64_t cell = grid_coupled_cell_of(p, g, p->list[KIND_MPM][m], k);
        if (cell >= 0) c->occupied[cell] = 1;
    }
}

/* Returns true if the cell of grid g at position k[dim] in the box of nodes, or a cell that shares a node with it,
 * contains a material point (c->occupied). */
static bool grid_coupled_meets_points(const struct grid_coupled *c, const struct grid *g, const int64_t *k)
{
    int64_t low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, stride[DIM_MAX] = {0};
    for (int d = 0; d < g->dim; d++) {
        low[d] = k[d] > 0 ? k[d] - 1 : 0;
        high[d] = k[d] + 1 < g->count[d] ? k[d] + 1 : g->count[d] - 1;
        stride[d] = g->stride[d];
    }
    for (int64_t a = low[2]; a <= high[2]; a++)
        for (int64_t b = low[1]; b <= high[1]; b++)
            for (int64_t m = low[0]; m <= high[0]; m++)
                if (c->occupied[m * stride[0] + b * stride[1] + a * stride[2]]) return true;
    return false;
}

void grid_coupled_clear_particles_moved_by_grid(struct grid_coupled *c, struct particles *p)
{
    for (int64_t k = 0; k < c->n; k++) p->flag[c->list[k]] &= (uint8_t)~FLAG_GRID_COUPLED;
    c->n = p->n_grid_coupled = 0;
}

void grid_coupled_select_particles_moved_by_grid(struct grid_coupled *c, enum coupling coupling, struct particles *p,
                                                 const struct grid *g)
{
    const bool unified = coupling_moves_all_particles_by_one_grid(coupling);
    int64_t k[DIM_MAX] = {0};
    GROW("grid_coupled.list", c->list, p->n);
    c->n = 0;
    if (!unified) mark_occupied(c, p, g);
    for (int64_t m = 0; m < p->n_of[KIND_PD]; m++) {
        int32_t i = p->list[KIND_PD][m];
        bool on = unified || (grid_coupled_cell_of(p, g, i, k) >= 0 && grid_coupled_meets_points(c, g, k));
        p->flag[i] = (uint8_t)(on ? p->flag[i] | FLAG_GRID_COUPLED : p->flag[i] & ~FLAG_GRID_COUPLED);
        if (on) c->list[c->n++] = i;
    }
    p->n_grid_coupled = c->n;
    transfer_order_sort_points_by_cell(&c->order, p, c->list, c->n, g);
}

void grid_coupled_free(struct grid_coupled *c)
{
    transfer_order_free(&c->order);
    memory_free(c->list);
    memory_free(c->occupied);
    memset(c, 0, sizeof *c);
}
