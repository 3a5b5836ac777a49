/* floor 5: the step loop. One line for each step of the algorithm of Zeng et al. 2022 (section 4, as corrected: MUSL,
 * leap-frog start); who does the work stands in the kernels and in loads.c, convert.c. */
#include <math.h>
#include <string.h>

#include "engine/engine.h"
#include "engine_report.h"
#include "base/memory.h"

/* ---- one step on the grid ------------------------------------------------------------------------------- */

/* Widens from..to to the listed particles. */
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

/* The grid covers its particles and the points know their cells; nothing to do while none has left its cell. */
static status points_sort(struct engine *e)
{
    const struct particles *p = &e->part;
    real from[DIM_MAX] = {INFINITY, INFINITY, INFINITY}, to[DIM_MAX] = {-INFINITY, -INFINITY, -INFINITY};
    bool changed;
    if (!e->sort_needed) return OK;
    for (int k = 0; k < KINDS; k++)
        if (k == KIND_MPM) bounds_widen(p, p->list_free, p->n_free, from, to);
        else if (coupling_unified(e->coupling)) bounds_widen(p, p->list[k], p->n_of[k], from, to);
    for (int d = 0; d < p->dim; d++)
        if (!isfinite(to[d] - from[d])) return engine_runaway(e, true, false);
    int64_t most = 64 * p->n + 1000000;          /* far more than any sound run needs; an index is 32 bits */
    TRY(grid_cover(&e->grid, from, to, most < INT32_MAX ? most : INT32_MAX, &changed));
    transfer_order_sort(&e->order, p, p->list_free, p->n_free, &e->grid);
    e->transfer.order = &e->order;
    e->sort_needed = false;
    return OK;
}

/* Cells that nothing has reached are left out of the maps. */
static void points_rest(struct engine *e)
{
    if (!e->scene->rest || e->rest_points.over || coupling_carries(e->coupling) || e->scene->solver != SOLVER_EXPLICIT) return;
    e->transfer.order = rest_points_look(&e->rest_points, &e->order, e->transfer.order, &e->part, &e->grid, &e->bonds, &e->loads,
                                         e->scene->shape, e->scene->transfer);
}

/* Who is on the grid in this step, and where. */
static status grid_sort(struct engine *e)
{
    if (e->part.n_free == 0 && !coupling_unified(e->coupling)) {
        carry_none(&e->carried, &e->part);
        return OK;
    }
    if (!e->sort_needed && e->step % REST_LOOKS == 0) points_rest(e);
    TRY(points_sort(e));
    if (coupling_carries(e->coupling)) carry(&e->carried, e->coupling, &e->part, &e->grid);
    return OK;
}

/* Peridynamic particles that the grid moves (coupling pm .. pgg). */
static struct transfer_data carried_by(const struct engine *e)
{
    struct transfer_data carried = e->transfer;
    carried.order = &e->carried.order, carried.bare = true;
    return carried;
}

/* Mass, momentum and force of all that is on the grid, to its nodes. */
static void grid_take(struct engine *e)
{
    const struct transfer_data carried = carried_by(e);
    grid_clear(&e->grid);
    e->kernels.p2g(&e->grid, &e->part, &e->transfer);
    if (e->part.n_carried > 0) e->kernels.p2g(&e->grid, &e->part, &carried);
}

static void step_grid(struct engine *e, real middle)
{
    const struct kernels *k = &e->kernels;
    struct particles *p = &e->part;
    struct grid *g = &e->grid;
    const struct transfer_data *t = &e->transfer, carried = carried_by(e);
    const enum transfer transfer = e->scene->transfer;

    grid_take(e);                                                           /* 1, 3: mass, momentum, force to nodes */
    lap(&e->laps, LAP_SCATTER);
    engine_residual(e);
    loads_walls(&e->loads, g, p, k, t->half_width, middle, e->dt);
    grid_move(g, transfer, t->dt_velocity, e->smallest_mass, e->loads.impulse, &e->loads.held_work);   /* 3: nodes move */
    lap(&e->laps, LAP_GRID);
    if (transfer == TRANSFER_FLIP) {
        k->remap(g, p, t);                                                  /* 4, 6: velocity; momentum back to nodes */
        if (p->n_carried > 0) k->remap(g, p, &carried);
        lap(&e->laps, LAP_SCATTER);
        grid_remapped(g, e->smallest_mass);
        lap(&e->laps, LAP_GRID);
    }
    int64_t moved = k->g2p(g, p, t);                                        /* 4, 7: position, strain, stress */
    if (p->n_carried > 0) moved += k->g2p(g, p, &carried);
    e->sort_needed = moved > 0;
    if (p->end_strain) partial_ends_know(&e->partial, p, e->scene->material);
    lap(&e->laps, LAP_GATHER);
}

real engine_grid_power(struct engine *e, real middle)
{
    struct grid *g = &e->grid;
    real power = 0, *momentum;
    if (e->part.n_free + e->part.n_carried == 0 || grid_sort(e) != OK) return 0;
    grid_take(e);
    momentum = BARE("engine.momentum", g->n * g->dim, real);
    for (int d = 0; d < g->dim; d++) memcpy(momentum + d * g->n, g->momentum[d], (size_t)g->n * sizeof(real));
    loads_walls(&e->loads, g, &e->part, &e->kernels, e->transfer.half_width, middle, e->dt);
    grid_move(g, e->scene->transfer, e->dt, e->smallest_mass, e->loads.impulse, &e->loads.held_work);
    for (int d = 0; d < g->dim; d++)     /* once a run; the sum must not depend on threads */
        for (int64_t I = 0; I < g->n; I++) power += momentum[d * g->n + I] * g->force[d][I] / e->dt;
    memory_free(momentum);
    return power;
}

/* Nothing is left to move on the grid: its walls hold nobody any more, and residuals are those of particles. */
static void step_without_grid(struct engine *e)
{
    grid_idle(&e->grid);
    engine_residual(e);
}

static int64_t grow(struct engine *e)
{
    int64_t released = 0;
    for (int k = 0; k < e->scene->growths; k++) {
        struct ruling r;
        const bool known = probes_ruling(&e->probes, e->scene->growth[k].probe, &r);
        released += growth_step(&e->growth[k], &e->bonds, &e->part, &e->source, known ? &r : NULL, e->t, e->dt);
    }
    return released;
}

/* What material points give the grid hangs on the bonds that fade; convert() has seen to what broke. */
static void renew_partial(struct engine *e, bool changed)
{
    if (!e->uses_partial || e->scene->growths == 0) return;
    for (int k = 0; k < e->scene->growths; k++) changed |= e->growth[k].n > 0;
    if (changed) partial_stress_make(&e->partial, &e->part, &e->bonds, &e->source, NULL, 0);
}

/* ---- the step ------------------------------------------------------------------------------------------- */

/* Where nobody looks at the body between forces and motion, particles that nothing but bonds moves do so as soon as the sweep of
 * forces has passed (kernels/pd/sweep.h). */
static bool moves_at_once(const struct engine *e) { return !e->sampling.due && e->scene->growths == 0; }

/* Those who have not moved: the loaded ones, or all. */
static void move_peridynamic(struct engine *e, struct pd_motion *motion, bool others_have)
{
    struct particles *p = &e->part;
    const struct loads *l = &e->loads;
    motion->wild |= others_have ? e->kernels.pd_move(p, l->list, l->listed, motion)
                                : e->kernels.pd_move(p, p->list[KIND_PD], p->n_of[KIND_PD], motion);
    e->wild = motion->wild;
}

status engine_step(struct engine *e)
{
    const struct kernels *k = &e->kernels;
    struct particles *p = &e->part;
    const struct scene *s = e->scene;
    const real middle = e->t + 0.5 * e->dt;
    const real dt_velocity = e->step == 0 ? 0.5 * e->dt : e->dt;           /* velocities stand half a step behind */
    struct pd_motion motion = {e->dt, dt_velocity, e->wave_speed, e->loads.loaded, false};
    e->transfer.dt_velocity = dt_velocity;

    engine_return(e);                                                       /* peridynamic -> material point */
    e->transfer.bonded = e->bonded;                                         /* what returned may have been the last */
    lap(&e->laps, LAP_CONVERT);
    engine_sample_begin(e);
    struct pd_motion *now = moves_at_once(e) ? &motion : NULL;
    lap(&e->laps, LAP_WATCH);
    TRY(grid_sort(e));
    const bool damps = e->rim.points > 0 && e->rim_share > 0;
    if (damps) e->damped += rim_damp(&e->rim, p, e->rim_share);
    lap(&e->laps, LAP_GRID);
    loads_clear(&e->loads, p);
    int64_t broken = bond_forces(k->bond_force, &e->bonds, p, &e->source.limit, now);    /* 2, 5: bonds; breaking */
    loads_apply(&e->loads, p, middle, e->dt, dt_velocity);
    lap(&e->laps, LAP_BONDS);
    engine_sample_energy(e);
    broken += grow(e);                                                      /* 5: cracks that grow as they are told */
    lap(&e->laps, LAP_WATCH);
    move_peridynamic(e, &motion, now != NULL);                              /* peridynamic particles move */
    lap(&e->laps, LAP_BONDS);
    if (p->n_free + p->n_carried > 0) step_grid(e, middle);                 /* 1, 3, 4, 6, 7: material points move */
    else step_without_grid(e);
    if (damps) e->damped += rim_damped(&e->rim, p);
    engine_mesh_move(e, middle, dt_velocity);                               /* the same in the reference frame */
    loads_hold(&e->loads, &e->grid, p, middle, e->dt, dt_velocity);
    loads_mirror(&e->loads, p);
    lap(&e->laps, LAP_GRID);
    if (s->rest) rest_rows(&e->bonds, p, &e->loads);
    engine_breaks(e, broken);
    const int64_t converted = convert(&e->conversion, &s->conversion, p, &e->bonds, &e->source,
                                      e->uses_partial ? &e->partial : NULL,
                                      &(struct conversion_look){engine_mesh_look, e}, e->t);   /* 8: material point -> peridynamic */
    if (converted > 0) {
        engine_rim_make(e);
        e->sort_needed = true;
    }
    renew_partial(e, broken > 0 || converted > 0);
    engine_mesh_follow(e, converted);
    lap(&e->laps, LAP_CONVERT);
    engine_sample_end(e);
    e->t = (real)(e->step + 1) * e->dt;
    e->step++;
    lap(&e->laps, LAP_WATCH);
    return OK;
}

status engine_run(struct engine *e)
{
    memory_reuse(true);
    if (e->scene->solver != SOLVER_EXPLICIT) return engine_solve(e);
    TRY(engine_report_start(e));
    laps_start(&e->laps);
    while (e->step < e->steps) {
        TRY(engine_step(e));
        TRY(engine_alarm(e));
        TRY(engine_report(e));
    }
    return engine_report_end(e);
}
