/* Finds the active cells of the background grid, those that motion can reach within the next few steps. Transfers
 * between points and grid skip all other cells (active_points.h). */
#include "grid/active_points.h"

#include <string.h>

#include "base/memory.h"

/* Returns true if load number `load` of l may move a particle at rest. All loads but planes of symmetry may. */
static bool moves(const struct loads *l, int load) { return l->load[load].boundary->kind != BOUNDARY_MIRROR; }

/* Returns true if material point i of p is at rest and nothing moves it: it has no load of l, bond of b, velocity,
 * force or stress. has_gradient: true if velocity gradients (APIC) must be zero, too. */
static bool active_points_is_inactive(const struct loads *l, const struct particles *p, const struct bonds *b,
                                      int32_t i, bool has_gradient)
{
    const int dim = p->dim;
    bool inactive = !particle_is_loaded(l, i) && (!b->row_of || b->row_of[i] < 0);
    for (int d = 0; d < dim && inactive; d++) inactive = reals_are_bitwise_equal(p->v[d][i], 0) && p->f[d][i] == 0;
    for (int c = 0; c < dim * (dim + 1) / 2 && inactive; c++) inactive = reals_are_bitwise_equal(p->stress[c][i], 0);
    for (int c = 0; has_gradient && c < dim * dim && inactive; c++)
        inactive = reals_are_bitwise_equal(p->gradient[c][i], 0);
    return inactive;
}

/* Returns the index of the cell of grid g that contains particle i of p, by its lowest node. The particle must be
 * inside the box of nodes. */
static int64_t active_points_cell_of(const struct grid *g, const struct particles *p, int32_t i)
{
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) I += (grid_cell_index_at(g, d, p->x[d][i]) - g->first[d]) * g->stride[d];
    return I;
}

/* Sets to[c] = 1 for every cell c that is within `reach` cells along `axis` of a cell marked in `from`, else 0. from,
 * to: [g->n], one byte per cell, different arrays. */
static void widen(const struct grid *g, const uint8_t *from, uint8_t *to, int axis, int64_t reach)
{
    const int64_t stride = g->stride[axis], count = g->count[axis], lines = g->n / count;
#pragma omp parallel for schedule(static)
    for (int64_t line = 0; line < lines; line++) {
        const int64_t start = line / stride * stride * count + line % stride;
        int64_t last = -reach - 1; /* last marked cell so far */
        for (int64_t k = 0; k < count; k++) {
            if (from[start + k * stride]) last = k;
            to[start + k * stride] = k - last <= reach;
        }
        last = count + reach;
        for (int64_t k = count - 1; k >= 0; k--) {
            if (from[start + k * stride]) last = k;
            to[start + k * stride] |= last - k <= reach;
        }
    }
}

/* Returns the number of cells of g by which motion can spread in the ACTIVE_POINTS_STEPS steps between two searches. In
 * a step it spreads by one cell through shared nodes, or by three if the shape functions `shape` reach beyond a cell.
 * The transfer method FLIP doubles this number, because it maps twice. Planes of symmetry, which connect nodes on both
 * sides, add two. */
static int64_t active_points_reach_of(const struct grid *g, enum shape shape, enum transfer transfer)
{
    const int shared = shape == SHAPE_LINEAR ? 1 : 3;
    return ACTIVE_POINTS_STEPS * ((transfer == TRANSFER_FLIP ? 2 : 1) * shared + (g->mirror_nodes > 0 ? 2 : 0));
}

/* Sets active->active_cell to 1 for the active cells of g, else to 0. A cell is active if one of its points in p moves
 * or has a force, stress, a load of l or a bond of b. It is also active if a load other than a plane of symmetry
 * prescribes the velocity of its lowest node. now: sorted points to be examined, since points outside this list are
 * still at rest; has_gradient: true if points have velocity gradients (APIC). */
static void active_points_mark(struct active_points *active, const struct transfer_order *now,
                               const struct particles *p, const struct grid *g, const struct bonds *b,
                               const struct loads *l, bool has_gradient)
{
    array_fill_bytes(active->active_cell, 0, g->n, 1);
#pragma omp parallel for schedule(static)
    for (int32_t c = 0; c < now->cells; c++) {
        bool inactive = true;
        for (int32_t k = now->cell_start[c]; k < now->cell_start[c + 1] && inactive; k++)
            inactive = active_points_is_inactive(l, p, b, now->particle[k], has_gradient);
        if (!inactive) active->active_cell[active_points_cell_of(g, p, now->particle[now->cell_start[c]])] = 1;
    }
    for (int64_t k = 0; k < g->walls; k++)
        if (moves(l, g->wall[k].load)) active->active_cell[g->wall[k].node] = 1;
}

/* Replaces the arrays active_cell and near of `active`, which have one flag per cell, by longer ones if grid g has more
 * nodes than they have entries. All flags of the new arrays are 0. */
static void make_room(struct active_points *active, const struct grid *g)
{
    if (active->nodes >= g->n) return;
    memory_free(active->active_cell), memory_free(active->near);
    active->nodes = g->n;
    active->active_cell = NEW("active_set.active_cell", g->n, uint8_t),
    active->near = NEW("active_set.near", g->n, uint8_t);
}

/* Makes active->active, the list of the points of p in active cells of g sorted by cell, from `all`, the sorted list of
 * all points. Cells and points keep their sequence. */
static void active_points_take(struct active_points *active, const struct transfer_order *all,
                               const struct particles *p, const struct grid *g)
{
    struct transfer_order *a = &active->active;
    transfer_order_reserve_arrays(a, all->n, all->blocks, all->cells);
    memcpy(a->blocks_of, all->blocks_of, sizeof a->blocks_of);
    a->blocks = all->blocks, a->cells = 0, a->n = 0;
    for (int block = 0; block < all->blocks; block++) {
        a->block_start[block] = (int32_t)a->n, a->block_cell[block] = a->cells;
        for (int32_t c = all->block_cell[block]; c < all->block_cell[block + 1]; c++) {
            const int32_t *list = all->particle + all->cell_start[c], n = all->cell_start[c + 1] - all->cell_start[c];
            if (!active->active_cell[active_points_cell_of(g, p, list[0])]) continue;
            a->cell_start[a->cells++] = (int32_t)a->n;
            array_copy(a->particle + a->n, list, n, sizeof *list);
            a->n += n;
        }
    }
    a->block_start[all->blocks] = (int32_t)a->n, a->block_cell[all->blocks] = a->cells;
    a->cell_start[a->cells] = (int32_t)a->n;
}

const struct transfer_order *active_points_update_transfer_order(struct active_points *active,
                                                                 const struct transfer_order *full_order,
                                                                 const struct transfer_order *previous_order,
                                                                 const struct particles *p, const struct grid *grid,
                                                                 const struct bonds *b, const struct loads *l,
                                                                 enum shape shape, enum transfer transfer)
{
    const int64_t reach = active_points_reach_of(grid, shape, transfer);
    make_room(active, grid);
    active_points_mark(active, previous_order, p, grid, b, l, transfer == TRANSFER_APIC);
    for (int d = 0; d < grid->dim; d++) {
        uint8_t *from = active->active_cell;
        widen(grid, from, active->near, d, reach);
        active->active_cell = active->near, active->near = from;
    }
    active_points_take(active, full_order, p, grid);
    active->over = active->active.n == full_order->n;
    return active->over ? full_order : &active->active;
}

void active_points_free(struct active_points *active)
{
    transfer_order_free(&active->active);
    memory_free(active->active_cell);
    memory_free(active->near);
    *active = (struct active_points){0};
}
