/* Advances material points by one step on the background grid: transfer from points to nodes, motion of the nodes,
 * transfer from nodes to points. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "grid/grid_part.h"

/* Extends the box from[dim] .. to[dim] [m] to the positions of the particles list[n] of p. */
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

/* Lists in f->list the material points of p that belong to the body, or the joined bodies, of the grid f. */
static void field_list(struct grid_field *f, const struct particles *p)
{
    if (!f->list) f->list = NEW("engine.field", p->n, int32_t);
    f->n = 0;
    for (int64_t k = 0; k < p->n_free; k++)
        if (p->body[p->list_free[k]] + 1 == f->grid.body) f->list[f->n++] = p->list_free[k];
}

/* Extends the grid f over its particles (of p) and sorts its material points by cells. coupling: coupling of
 * peridynamic particles and points. *lost: set to true if positions are not finite; nothing is sorted then, and OK is
 * returned. Returns FAILED or REFUSED, with a message, if the grid would need too many nodes. */
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
        else if (coupling_moves_all_particles_by_one_grid(coupling))
            bounds_widen(p, p->list[k], p->n_of[k], from, to);
    for (int d = 0; d < p->dim && (n > 0 || !f->list); d++)
        if (!isfinite(to[d] - from[d])) {
            *lost = true;
            return OK;
        }
    int64_t most = 64 * p->n + 1000000; /* more than any run in sound condition needs; node indices have 32 bits */
    if (n > 0 || !f->list) TRY(grid_extend_box(&f->grid, from, to, most < INT32_MAX ? most : INT32_MAX, &changed));
    transfer_order_sort_points_by_cell(&f->order, p, list, n, &f->grid);
    return OK;
}

/* Reciprocal of the largest fraction of the points of a grid that may have left their cells if only these points are
 * sorted anew; if more have left, all points are sorted. */
enum { LEFT_MOST = 4 };

/* Sorts the material points of p on the grid f by cells. Moves only those points in the order that have left their
 * cells, according to the marks in f->order, if they are at most 1/LEFT_MOST of all points and the box of the grid
 * contains their positions. Else sorts all points by field_sort. coupling: coupling of peridynamic particles and
 * points; *lost: set to true if positions are not finite. Returns FAILED or REFUSED as field_sort does, if the grid
 * would need too many nodes. */
static status field_sort_left(struct grid_field *f, const struct particles *p, enum coupling coupling, bool *lost)
{
    real from[DIM_MAX] = {INFINITY, INFINITY, INFINITY}, to[DIM_MAX] = {-INFINITY, -INFINITY, -INFINITY};
    int32_t *list = BARE("engine.left", f->order.n, int32_t);
    const int64_t n = transfer_order_list_points_that_left_cells(&f->order, list);
    bounds_widen(p, list, n, from, to);
    const bool few = n <= f->order.n / LEFT_MOST && (n == 0 || grid_box_covers(&f->grid, from, to));
    if (few && n > 0) transfer_order_move_points_that_left_cells(&f->order, p, list, n, &f->grid);
    memory_free(list);
    return few ? OK : field_sort(f, p, coupling, lost);
}

/* Sorts the points of p on all grids of mpm into cells; does nothing while no particle has left its cell. coupling:
 * coupling of peridynamic particles and points. *lost: set to true if positions are not finite. Returns FAILED or
 * REFUSED, with a message, if a grid would need too many nodes. */
static status points_sort(struct grid_method *mpm, const struct particles *p, enum coupling coupling, bool *lost)
{
    const bool few = mpm->sort_needed == SORT_LEFT && mpm->transfer.order == &mpm->field[0].order &&
                     !coupling_moves_all_particles_by_one_grid(coupling);
    if (mpm->sort_needed == SORT_NONE) return OK;
    for (int k = 0; k < mpm->fields; k++)
        TRY(few ? field_sort_left(&mpm->field[k], p, coupling, lost) : field_sort(&mpm->field[k], p, coupling, lost));
    mpm->transfer.order = &mpm->field[0].order;
    mpm->sort_needed = SORT_NONE;
    return OK;
}

/* Updates the list of active points of the run (active_points.h), so that transfers skip cells that are still at rest.
 * Does nothing if the scene switches this off, if no point is at rest any more, or with several grids, points that
 * rotate in groups, particles coupled to the grid, or a static solver. */
static void update_active_points(struct run *run)
{
    const struct grid_method *mpm = run->grid;
    if (!run->scene->active_set || mpm->active.over || mpm->fields > 1 || mpm->turning.groups > 0 ||
        coupling_moves_pd_particles_by_grid(run->coupling_kind) || !scene_is_dynamic(run->scene))
        return;
    run->grid->transfer.order = active_points_update_transfer_order(
        &run->grid->active, &run->grid->field[0].order, run->grid->transfer.order, &run->part,
        &run->grid->field[0].grid, &run->bonds, &run->loads, run->scene->shape, run->scene->transfer);
}

status grid_sort_points_into_cells(struct run *run, bool *position_not_finite)
{
    *position_not_finite = false;
    if (run->part.n_free == 0 && !coupling_moves_all_particles_by_one_grid(run->coupling_kind)) {
        grid_coupled_clear_particles_moved_by_grid(&run->grid->coupled, &run->part);
        return OK;
    }
    if (!run->grid->sort_needed && run->clock.step % ACTIVE_POINTS_STEPS == 0) update_active_points(run);
    TRY(points_sort(run->grid, &run->part, run->coupling_kind, position_not_finite));
    if (coupling_moves_pd_particles_by_grid(run->coupling_kind))
        grid_coupled_select_particles_moved_by_grid(&run->grid->coupled, run->coupling_kind, &run->part,
                                                    &run->grid->field[0].grid);
    return OK;
}

/* Returns the transfer parameters for peridynamic particles that the background grid moves (couplings pm, pg, pmg and
 * pgg). They differ from those of material points, mpm->transfer, in the list of particles, and in that no stress is
 * transferred or updated. */
static struct transfer_data grid_coupled_data(const struct grid_method *mpm)
{
    struct transfer_data grid_coupled = mpm->transfer;
    grid_coupled.order = &mpm->coupled.order, grid_coupled.momentum_only = true;
    return grid_coupled;
}

/* Returns the parameters of transfers between background grid number k (mpm->field[k], one for each body in contact,
 * else a single one) and its material points. */
static struct transfer_data field_data(const struct grid_method *mpm, int k)
{
    struct transfer_data own = mpm->transfer;
    if (mpm->fields > 1) own.order = &mpm->field[k].order;
    return own;
}

/* Returns true if at least one of the particles `part` moves with a background grid: as a material point, or as a
 * peridynamic particle that the grid also moves (coupled to the grid). */
static bool grid_holds(const struct particles *part) { return part->n_free + part->n_grid_coupled > 0; }

/* Maps mass, momentum and force of all particles p on the grids of mpm to the nodes, which are cleared first. kernels:
 * transfer functions for the dimension and shape. */
static void grid_receive(struct grid_method *mpm, struct particles *p, const struct kernels *kernels)
{
    const struct transfer_data grid_coupled = grid_coupled_data(mpm);
    if (mpm->turning.groups > 0) corotating_groups_compute_spins(&mpm->turning, p, mpm->spacing);
    for (int k = 0; k < mpm->fields; k++) {
        const struct transfer_data own = field_data(mpm, k);
        grid_clear(&mpm->field[k].grid);
        kernels->p2g(&mpm->field[k].grid, p, &own);
    }
    if (p->n_grid_coupled > 0) kernels->p2g(&mpm->field[0].grid, p, &grid_coupled);
}

/* Lists in mpm->contact the nodes at which bodies of `part` with separate grids may be in contact in this step. Returns
 * an array [mpm->fields] with the data of each grid that contact needs, which the caller frees with memory_free; NULL
 * if there is a single grid. */
static struct grid_contact_side *meeting_find(struct grid_method *mpm, struct particles *part)
{
    if (mpm->fields < 2) return NULL;
    struct grid_contact_side *side = NEW("engine.sides", mpm->fields, struct grid_contact_side);
    for (int k = 0; k < mpm->fields; k++)
        grid_contact_side_make_for_body(&side[k], &mpm->field[k].grid, &mpm->field[k].order, part);
    grid_contact_find_shared_nodes(&mpm->contact, side, part);
    return side;
}

/* Advances the velocities of all grid nodes of the run under forces, contact, prescribed velocities (walls) and
 * mirrors. side: grids of the bodies for contact, from meeting_find; NULL: no contact; middle: time in the middle of
 * the step [s]; dt: duration of the velocity update [s]. */
static void grids_move(struct run *run, const struct grid_contact_side *side, real middle, real dt)
{
    struct grid_method *mpm = run->grid;
    const enum transfer transfer = run->scene->transfer;
    for (int k = 0; k < mpm->fields; k++) {
        struct grid_field *f = &mpm->field[k];
        loads_prescribe_grid_velocities(&run->loads, &f->held, &f->grid, &run->part, &run->kernels,
                                        mpm->transfer.half_width, middle, run->clock.dt);
        grid_advance(&f->grid, transfer, dt, mpm->smallest_mass);
    }
    if (side) run->damped += grid_contact_apply_impulses_return_dissipation(&mpm->contact, side);
    for (int k = 0; k < mpm->fields; k++)
        grid_constrain(&mpm->field[k].grid, transfer, mpm->smallest_mass, run->loads.impulse,
                       &run->loads.constraint_work);
}

/* Smallest displacement of a body in half a step for which grid.ahead is used (field_set_flight) [node distances]. For
 * slower bodies grid.ahead is 0: their results are bitwise the same as without it, and they gain a few per cent of
 * their strain energy in 1e6 steps. */
#define AHEAD_LEAST 1e-4
/* Largest displacement in half a step for which grid.ahead is used (field_set_flight) [node distances]. The weights of
 * points then extend beyond a cell; up to this value, GIMP weights are still exact. */
#define AHEAD_MOST 0.25

/* Sets f->grid.ahead, a displacement [node distances] that is added to the positions of the points of grid f when
 * weights are computed for the second map of momentum to nodes and for the stress update. Without it, a stretched body
 * that moves through the grid gains energy (kernels/mpm/remap_turn.h). It is the mean displacement in half a step: dt/2
 * [s] times momentum/mass of the groups, which rotate together. It is 0 if walls, mirrors or absorbing faces act on the
 * points, for one grid of several, for linear and cubic shape functions, and unless between AHEAD_LEAST and AHEAD_MOST.
 * If not 0, clears the nodal masses, since the second map adds those at the displaced positions. */
static void field_set_flight(struct grid_field *f, const struct corotating_groups *groups, enum shape shape, real dt)
{
    struct grid *g = &f->grid;
    real mass = 0, momentum[DIM_MAX] = {0}, far = 0;
    const real most = shape == SHAPE_LINEAR || shape == SHAPE_CUBIC ? 0 : AHEAD_MOST;
    bool free = g->body == 0 && g->walls + g->mirror_nodes + g->dashpots == 0;
    for (int32_t k = 0; k < groups->groups && free; k++) {
        const struct turning_group *own = &groups->group[k];
        free = !own->held;
        mass += own->mass;
        for (int d = 0; d < g->dim; d++) momentum[d] += own->momentum[d];
    }
    for (int d = 0; d < g->dim && mass > 0; d++) {
        g->ahead[d] = 0.5 * dt * momentum[d] / (mass * g->h);
        far = real_max(far, fabs(g->ahead[d]));
    }
    if (free && far > AHEAD_LEAST && far < most)
        array_fill_bytes(g->mass, 0, g->n, sizeof *g->mass); /* the second map adds that of the positions ahead */
    else
        memset(g->ahead, 0, sizeof g->ahead);
}

/* Adds the change of the nodal velocities to the points of the run and maps the momentum of the points to the nodes
 * again (modified update stress last, MUSL). side: data of each grid for contact between bodies, from meeting_find;
 * NULL: no contact. */
static void grids_remap(struct run *run, const struct grid_contact_side *side)
{
    const struct transfer_data grid_coupled = grid_coupled_data(run->grid);
    for (int k = 0; k < run->grid->fields; k++) {
        const struct transfer_data own = field_data(run->grid, k);
        if (run->grid->turning.groups == 0)
            run->kernels.remap(&run->grid->field[k].grid, &run->part, &own);
        else
            run->kernels.turn_gather(&run->grid->field[k].grid, &run->part, &own);
    }
    if (run->grid->turning.groups > 0) corotating_groups_restore_angular_momentum(&run->grid->turning, &run->part);
    for (int k = 0; k < run->grid->fields && run->grid->turning.groups > 0; k++) {
        const struct transfer_data own = field_data(run->grid, k);
        field_set_flight(&run->grid->field[k], &run->grid->turning, run->scene->shape, run->clock.dt);
        run->kernels.turn_scatter(&run->grid->field[k].grid, &run->part, &own);
    }
    if (run->part.n_grid_coupled > 0) run->kernels.remap(&run->grid->field[0].grid, &run->part, &grid_coupled);
    timer_add_elapsed_to_section(&run->timers, TIMER_SCATTER);
    for (int k = 0; k < run->grid->fields; k++) grid_remapped(&run->grid->field[k].grid, run->grid->smallest_mass);
    if (side) run->damped += grid_contact_add_second_mapping_dissipation(&run->grid->contact, side);
    timer_add_elapsed_to_section(&run->timers, TIMER_GRID);
}

void grid_transfer_mass_momentum_forces_to_nodes(struct grid_method *mpm, struct particles *p,
                                                 const struct kernels *kernels, struct timers *timers)
{
    if (!grid_holds(p)) {
        for (int k = 0; k < mpm->fields; k++) grid_clear_constraints(&mpm->field[k].grid);
        return;
    }
    grid_receive(mpm, p, kernels);
    timer_add_elapsed_to_section(timers, TIMER_SCATTER);
}

/* Corrects stress and volume of all points of p on the grids mpm for the mean dilatation of their cells in this step,
 * against volumetric locking: adds `share` [1] times the difference from the changes by the dilatation of each point
 * (points_add_mean_dilatation). */
static void mean_dilatation_add(struct grid_method *mpm, struct particles *p, real share)
{
    for (int k = 0; k < mpm->fields; k++) {
        const struct transfer_data own = field_data(mpm, k);
        points_add_mean_dilatation(p, &own, share);
    }
}

/* Sorts the points of p into the cells of the grids mpm after some points have left their cells. If points have a mean
 * dilatation of their cell, half of it then comes from the old cell and half from the new cell. coupling: coupling of
 * particles and points. Must not be called for materials that yield: a bar that hits a wall loses 0.4 % of its energy
 * with this function, and gains 0.14 % without. Returns FAILED or REFUSED, with a message, if a grid would need too
 * many nodes; positions that are not finite are reported in the next step. */
static status points_enter_cells(struct grid_method *mpm, struct particles *p, enum coupling coupling)
{
    bool lost = false;
    mean_dilatation_add(mpm, p, -0.5);
    TRY(points_sort(mpm, p, coupling, &lost));
    mean_dilatation_add(mpm, p, 0.5);
    if (lost) mpm->sort_needed = SORT_ALL;
    return OK;
}

status grid_advance_material_points_one_step(struct run *run, real t_middle)
{
    struct particles *p = &run->part;
    const struct transfer_data grid_coupled = grid_coupled_data(run->grid);
    int64_t moved = 0;
    if (!grid_holds(&run->part)) return OK;
    struct grid_contact_side *side = meeting_find(run->grid, &run->part);
    grids_move(run, side, t_middle, run->grid->transfer.dt_velocity); /* 3: motion of nodes */
    timer_add_elapsed_to_section(&run->timers, TIMER_GRID);
    if (run->scene->transfer == TRANSFER_FLIP) grids_remap(run, side); /* 4, 6: velocities; momentum to the nodes */
    if (side) grid_contact_record_first_and_last_contact_time(&run->grid->contact, run->clock.t);
    for (int k = 0; k < run->grid->fields; k++) { /* 4, 7: positions, strain, stress */
        const struct transfer_data own = field_data(run->grid, k);
        moved += run->kernels.g2p(&run->grid->field[k].grid, p, &own);
        memset(run->grid->field[k].grid.ahead, 0, sizeof run->grid->field[k].grid.ahead);
    }
    if (p->n_grid_coupled > 0) moved += run->kernels.g2p(&run->grid->field[0].grid, p, &grid_coupled);
    memory_free(side);
    run->grid->sort_needed = moved > 0 ? SORT_LEFT : SORT_NONE;
    if (!run->grid->sort_needed || !run->grid->transfer.dilatation || run->grid->transfer.laws) return OK;
    return points_enter_cells(run->grid, p, run->coupling_kind);
}

/* Returns the power of the forces on the grids of the run at the start of a step [W]: the sum of P . f/m over the nodes
 * before they move, with the nodal momentum P, nodal mass m, and f the change of momentum per time by forces, contact
 * and walls. t_middle: time in the middle of the step [s]. Returns 0 if no particle is on a grid. */
real grid_power_of_forces_on_material_points(struct run *run, real t_middle)
{
    real power = 0;
    bool lost;
    if (!grid_holds(&run->part) || grid_sort_points_into_cells(run, &lost) != OK || lost) return 0;
    grid_receive(run->grid, &run->part, &run->kernels);
    real **momentum = NEW("engine.momenta", run->grid->fields, real *);
    for (int k = 0; k < run->grid->fields; k++) {
        const struct grid *g = &run->grid->field[k].grid;
        momentum[k] = BARE("engine.momentum", g->n * g->dim, real);
        for (int d = 0; d < g->dim; d++) array_copy(momentum[k] + d * g->n, g->momentum[d], g->n, sizeof(real));
    }
    struct grid_contact_side *side = meeting_find(run->grid, &run->part);
    const real damped = run->damped;
    grids_move(run, side, t_middle, run->clock.dt);
    run->damped = damped;
    for (int k = 0; k < run->grid->fields; k++) {
        const struct grid *g = &run->grid->field[k].grid;
        /* once a run; serial, so that the sum does not depend on the number of threads */
        for (int d = 0; d < g->dim; d++)
            for (int64_t I = 0; I < g->n; I++) power += momentum[k][d * g->n + I] * g->force[d][I] / run->clock.dt;
        memory_free(momentum[k]);
    }
    memory_free(momentum);
    memory_free(side);
    return power;
}
