/* A step of the grids of the current frame: what they take from their points, how nodes move, what points receive. */
#include <math.h>

#include "base/memory.h"
#include "grid/grid_part.h"

/* Widens the box from..to [m] to the positions of the listed particles. */
static void bounds_widen(const struct particles *p, const int32_t *list, int64_t n, real *from, real *to)
{
    for (int d = 0; d < p->dim; d++) {
        real low = from[d], high = to[d];
        const real *x = p->x[d];
#pragma omp parallel for schedule(static) reduction(min : low) reduction(max : high)
        for (int64_t k = 0; k < n; k++) {
            low = real_min(low, x[list[k]]);
            high = real_max(high, x[list[k]]);
        }
        from[d] = low, to[d] = high;
    }
}

/* The points of a field whose body is one of several. */
static void field_list(struct grid_field *f, const struct particles *p)
{
    if (!f->list) f->list = NEW("engine.field", p->n, int32_t);
    f->n = 0;
    for (int64_t k = 0; k < p->n_free; k++)
        if (p->body[p->list_free[k]] + 1 == f->grid.body) f->list[f->n++] = p->list_free[k];
}

/* Extends a grid over its particles and sorts the material points by cells; *lost: their places are not finite. */
static status field_sort(struct grid_field *f, const struct particles *p, enum coupling coupling, bool *lost)
{
    real from[DIM_MAX] = {INFINITY, INFINITY, INFINITY}, to[DIM_MAX] = {-INFINITY, -INFINITY, -INFINITY};
    bool changed;
    if (f->grid.body > 0) field_list(f, p);
    const int32_t *list = f->list ? f->list : p->list_free;
    const int64_t n = f->list ? f->n : p->n_free;
    for (int k = 0; k < KINDS; k++)
        if (k == KIND_MPM)
            bounds_widen(p, list, n, from, to);
        else if (coupling_unified(coupling))
            bounds_widen(p, p->list[k], p->n_of[k], from, to);
    for (int d = 0; d < p->dim && (n > 0 || !f->list); d++)
        if (!isfinite(to[d] - from[d])) {
            *lost = true;
            return OK;
        }
    int64_t most = 64 * p->n + 1000000; /* far more than any sound run needs; an index is 32 bits */
    if (n > 0 || !f->list) TRY(grid_cover(&f->grid, from, to, most < INT32_MAX ? most : INT32_MAX, &changed));
    transfer_order_sort(&f->order, p, list, n, &f->grid);
    return OK;
}

/* Does nothing while no particle has left its cell. */
static status points_sort(struct grid_method *mpm, const struct particles *p, enum coupling coupling, bool *lost)
{
    if (!mpm->sort_needed) return OK;
    for (int k = 0; k < mpm->fields; k++) TRY(field_sort(&mpm->field[k], p, coupling, lost));
    mpm->transfer.order = &mpm->field[0].order;
    mpm->sort_needed = false;
    return OK;
}

/* Leaves cells that no motion has reached out of the transfers. */
static void update_active_points(struct run *e)
{
    const struct grid_method *mpm = e->grid;
    if (!e->scene->active_set || mpm->active.over || mpm->fields > 1 || mpm->turning.groups > 0 ||
        coupling_moves_by_grid(e->coupling_kind) || !scene_moves(e->scene))
        return;
    e->grid->transfer.order =
        active_points_update(&e->grid->active, &e->grid->field[0].order, e->grid->transfer.order, &e->part,
                             &e->grid->field[0].grid, &e->bonds, &e->loads, e->scene->shape, e->scene->transfer);
}

status grid_sort(struct run *e, bool *lost)
{
    *lost = false;
    if (e->part.n_free == 0 && !coupling_unified(e->coupling_kind)) {
        grid_coupled_none(&e->grid->coupled, &e->part);
        return OK;
    }
    if (!e->grid->sort_needed && e->clock.step % ACTIVE_POINTS_STEPS == 0) update_active_points(e);
    TRY(points_sort(e->grid, &e->part, e->coupling_kind, lost));
    if (coupling_moves_by_grid(e->coupling_kind))
        grid_coupled_select(&e->grid->coupled, e->coupling_kind, &e->part, &e->grid->field[0].grid);
    return OK;
}

/* Transfer of the grid-coupled peridynamic particles (coupling pm .. pgg). */
static struct transfer_data grid_coupled_data(const struct grid_method *mpm)
{
    struct transfer_data grid_coupled = mpm->transfer;
    grid_coupled.order = &mpm->coupled.order, grid_coupled.momentum_only = true;
    return grid_coupled;
}

/* Transfer of the points of field k. */
static struct transfer_data field_data(const struct grid_method *mpm, int k)
{
    struct transfer_data own = mpm->transfer;
    if (mpm->fields > 1) own.order = &mpm->field[k].order;
    return own;
}

/* Does anything move on the grid? */
static bool grid_holds(const struct particles *part) { return part->n_free + part->n_grid_coupled > 0; }

/* Maps mass, momentum and force of all particles on the grids to their nodes. */
static void grid_take(struct grid_method *mpm, struct particles *p, const struct kernels *kernels)
{
    const struct transfer_data grid_coupled = grid_coupled_data(mpm);
    if (mpm->turning.groups > 0) turning_begin(&mpm->turning, p, mpm->spacing);
    for (int k = 0; k < mpm->fields; k++) {
        const struct transfer_data own = field_data(mpm, k);
        grid_clear(&mpm->field[k].grid);
        kernels->p2g(&mpm->field[k].grid, p, &own);
    }
    if (p->n_grid_coupled > 0) kernels->p2g(&mpm->field[0].grid, p, &grid_coupled);
}

/* Where bodies on grids of their own may meet in this step; [fields] sides, NULL of a single grid. */
static struct grid_side *meeting_find(struct grid_method *mpm, struct particles *part)
{
    if (mpm->fields < 2) return NULL;
    struct grid_side *side = NEW("engine.sides", mpm->fields, struct grid_side);
    for (int k = 0; k < mpm->fields; k++) grid_side_make(&side[k], &mpm->field[k].grid, &mpm->field[k].order, part);
    grid_contact_find(&mpm->contact, side, part);
    return side;
}

/* Nodes move under forces, contact, walls and mirrors; dt: of velocities [s]. */
static void grids_move(struct run *e, const struct grid_side *side, real middle, real dt)
{
    struct grid_method *mpm = e->grid;
    const enum transfer transfer = e->scene->transfer;
    for (int k = 0; k < mpm->fields; k++) {
        struct grid_field *f = &mpm->field[k];
        loads_walls(&e->loads, &f->held, &f->grid, &e->part, &e->kernels, mpm->transfer.half_width, middle,
                    e->clock.dt);
        grid_advance(&f->grid, transfer, dt, mpm->smallest_mass);
    }
    if (side) e->damped += grid_contact_exchange(&mpm->contact, side);
    for (int k = 0; k < mpm->fields; k++)
        grid_constrain(&mpm->field[k].grid, transfer, mpm->smallest_mass, e->loads.impulse, &e->loads.constraint_work);
}

/* Points receive the change of nodal velocities, and give their momentum back to the nodes. */
static void grids_remap(struct run *e, const struct grid_side *side)
{
    const struct transfer_data grid_coupled = grid_coupled_data(e->grid);
    for (int k = 0; k < e->grid->fields; k++) {
        const struct transfer_data own = field_data(e->grid, k);
        if (e->grid->turning.groups == 0)
            e->kernels.remap(&e->grid->field[k].grid, &e->part, &own);
        else
            e->kernels.turn_gather(&e->grid->field[k].grid, &e->part, &own);
    }
    if (e->grid->turning.groups > 0) turning_share(&e->grid->turning, &e->part);
    for (int k = 0; k < e->grid->fields && e->grid->turning.groups > 0; k++) {
        const struct transfer_data own = field_data(e->grid, k);
        e->kernels.turn_scatter(&e->grid->field[k].grid, &e->part, &own);
    }
    if (e->part.n_grid_coupled > 0) e->kernels.remap(&e->grid->field[0].grid, &e->part, &grid_coupled);
    lap(&e->laps, LAP_SCATTER);
    for (int k = 0; k < e->grid->fields; k++) grid_remapped(&e->grid->field[k].grid, e->grid->smallest_mass);
    if (side) e->damped += grid_contact_remapped(&e->grid->contact, side);
    lap(&e->laps, LAP_GRID);
}

void grid_map(struct grid_method *mpm, struct particles *p, const struct kernels *kernels, struct laps *laps)
{
    if (!grid_holds(p)) {
        for (int k = 0; k < mpm->fields; k++) grid_idle(&mpm->field[k].grid);
        return;
    }
    grid_take(mpm, p, kernels);
    lap(laps, LAP_SCATTER);
}

void grid_step(struct run *e, real middle)
{
    struct particles *p = &e->part;
    const struct transfer_data grid_coupled = grid_coupled_data(e->grid);
    int64_t moved = 0;
    if (!grid_holds(&e->part)) return;
    struct grid_side *side = meeting_find(e->grid, &e->part);
    grids_move(e, side, middle, e->grid->transfer.dt_velocity); /* 3: nodes move */
    lap(&e->laps, LAP_GRID);
    if (e->scene->transfer == TRANSFER_FLIP) grids_remap(e, side); /* 4, 6: velocity; momentum back to nodes */
    if (side) grid_contact_clock(&e->grid->contact, e->clock.t);
    for (int k = 0; k < e->grid->fields; k++) { /* 4, 7: position, strain, stress */
        const struct transfer_data own = field_data(e->grid, k);
        moved += e->kernels.g2p(&e->grid->field[k].grid, p, &own);
    }
    if (p->n_grid_coupled > 0) moved += e->kernels.g2p(&e->grid->field[0].grid, p, &grid_coupled);
    memory_free(side);
    e->grid->sort_needed = moved > 0;
}

/* Sum of P . f/m of the nodes before they move, over the change that forces, contact and walls make. */
real grid_power(struct run *e, real middle)
{
    real power = 0;
    bool lost;
    if (!grid_holds(&e->part) || grid_sort(e, &lost) != OK || lost) return 0;
    grid_take(e->grid, &e->part, &e->kernels);
    real **momentum = NEW("engine.momenta", e->grid->fields, real *);
    for (int k = 0; k < e->grid->fields; k++) {
        const struct grid *g = &e->grid->field[k].grid;
        momentum[k] = BARE("engine.momentum", g->n * g->dim, real);
        for (int d = 0; d < g->dim; d++) array_copy(momentum[k] + d * g->n, g->momentum[d], g->n, sizeof(real));
    }
    struct grid_side *side = meeting_find(e->grid, &e->part);
    const real damped = e->damped;
    grids_move(e, side, middle, e->clock.dt);
    e->damped = damped;
    for (int k = 0; k < e->grid->fields; k++) {
        const struct grid *g = &e->grid->field[k].grid;
        for (int d = 0; d < g->dim; d++) /* once per run; serial, so that the sum does not depend on threads */
            for (int64_t I = 0; I < g->n; I++) power += momentum[k][d * g->n + I] * g->force[d][I] / e->clock.dt;
        memory_free(momentum[k]);
    }
    memory_free(momentum);
    memory_free(side);
    return power;
}
