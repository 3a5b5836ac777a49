/* The step loop: five phases. engine_step, the last function but one, says which step of the algorithm of Zeng et al.
 * 2022 (section 4, as corrected: MUSL, leap-frog start) is in which phase. */
#include <math.h>
#include <string.h>

#include "loads/active_rows.h"
#include "engine/engine.h"
#include "engine_report.h"
#include "base/memory.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "grid/contact_grid.h"
#include "grid/active_points.h"
#include "grid/grid_coupled.h"
#include "data/turning.h"
#include "probes/probes_part.h"
#include "fracture/fracture_part.h"
#include "step/report.h"
#include "rigid/rigid_part.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"
#include "contact/contact.h"
#include "step/stability.h"
#include "probes/probes.h"
#include "fracture/growth.h"

/* ---- one step on the grid ---------------------------------------------------------------------------------------- */

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

/* Extends a grid over its particles and sorts the material points by cells. */
static status field_sort(struct run *e, struct grid_field *f)
{
    const struct particles *p = &e->part;
    real from[DIM_MAX] = {INFINITY, INFINITY, INFINITY}, to[DIM_MAX] = {-INFINITY, -INFINITY, -INFINITY};
    bool changed;
    if (e->grid->fields > 1) field_list(f, p);
    const int32_t *list = f->list ? f->list : p->list_free;
    const int64_t n = f->list ? f->n : p->n_free;
    for (int k = 0; k < KINDS; k++)
        if (k == KIND_MPM) bounds_widen(p, list, n, from, to);
        else if (coupling_unified(e->coupling_kind)) bounds_widen(p, p->list[k], p->n_of[k], from, to);
    for (int d = 0; d < p->dim && (n > 0 || !f->list); d++)
        if (!isfinite(to[d] - from[d])) return engine_divergence_check(e, true, false);
    int64_t most = 64 * p->n + 1000000;          /* far more than any sound run needs; an index is 32 bits */
    if (n > 0 || !f->list) TRY(grid_cover(&f->grid, from, to, most < INT32_MAX ? most : INT32_MAX, &changed));
    transfer_order_sort(&f->order, p, list, n, &f->grid);
    return OK;
}

/* Does nothing while no particle has left its cell. */
static status points_sort(struct run *e)
{
    if (!e->grid->sort_needed) return OK;
    for (int k = 0; k < e->grid->fields; k++) TRY(field_sort(e, &e->grid->field[k]));
    e->grid->transfer.order = &e->grid->field[0].order;
    e->grid->sort_needed = false;
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

/* Sorts the points on the grid in this step into cells. */
static status grid_sort(struct run *e)
{
    if (e->part.n_free == 0 && !coupling_unified(e->coupling_kind)) {
        grid_coupled_none(&e->grid->coupled, &e->part);
        return OK;
    }
    if (!e->grid->sort_needed && e->clock.step % ACTIVE_POINTS_STEPS == 0) update_active_points(e);
    TRY(points_sort(e));
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

/* Maps mass, momentum and force of all particles on the grids to their nodes. */
static void grid_take(struct run *e)
{
    const struct transfer_data grid_coupled = grid_coupled_data(e->grid);
    if (e->grid->turning.groups > 0) turning_begin(&e->grid->turning, &e->part, e->scene->spacing);
    for (int k = 0; k < e->grid->fields; k++) {
        const struct transfer_data own = field_data(e->grid, k);
        grid_clear(&e->grid->field[k].grid);
        e->kernels.p2g(&e->grid->field[k].grid, &e->part, &own);
    }
    if (e->part.n_grid_coupled > 0) e->kernels.p2g(&e->grid->field[0].grid, &e->part, &grid_coupled);
}

/* Where bodies on grids of their own may meet in this step; [fields] sides, NULL of a single grid. */
static struct grid_side *meeting_find(struct run *e)
{
    struct grid_method *mpm = e->grid;
    if (mpm->fields < 2) return NULL;
    struct grid_side *side = NEW("engine.sides", mpm->fields, struct grid_side);
    for (int k = 0; k < mpm->fields; k++)
        grid_side_make(&side[k], &mpm->field[k].grid, &mpm->field[k].order, &e->part);
    grid_contact_find(&mpm->contact, side, &e->part);
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
        if (e->grid->turning.groups == 0) e->kernels.remap(&e->grid->field[k].grid, &e->part, &own);
        else e->kernels.turn_gather(&e->grid->field[k].grid, &e->part, &own);
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

/* One step of the grids and of all particles on them. middle: time in the middle of the step [s]. Numbers are steps of
 * the algorithm. */
static void step_grid(struct run *e, real middle)
{
    struct particles *p = &e->part;
    const struct transfer_data grid_coupled = grid_coupled_data(e->grid);
    int64_t moved = 0;

    grid_take(e);                                                           /* 1, 3: mass, momentum, force to nodes */
    lap(&e->laps, LAP_SCATTER);
    engine_residual(e);
    struct grid_side *side = meeting_find(e);
    grids_move(e, side, middle, e->grid->transfer.dt_velocity);               /* 3: nodes move */
    lap(&e->laps, LAP_GRID);
    if (e->scene->transfer == TRANSFER_FLIP) grids_remap(e, side);          /* 4, 6: velocity; momentum back to nodes */
    if (side) grid_contact_clock(&e->grid->contact, e->clock.t);
    for (int k = 0; k < e->grid->fields; k++) {                               /* 4, 7: position, strain, stress */
        const struct transfer_data own = field_data(e->grid, k);
        moved += e->kernels.g2p(&e->grid->field[k].grid, p, &own);
    }
    if (p->n_grid_coupled > 0) moved += e->kernels.g2p(&e->grid->field[0].grid, p, &grid_coupled);
    memory_free(side);
    e->grid->sort_needed = moved > 0;
    if (p->end_strain) partial_ends_update(&e->coupling->partial, p, e->scene->material);
    lap(&e->laps, LAP_GATHER);
}

/* Sum of P . f/m of the nodes before they move, over the change that forces, contact and walls make [W]. */
real engine_grid_power(struct run *e, real middle)
{
    real power = 0;
    if (e->part.n_free + e->part.n_grid_coupled == 0 || grid_sort(e) != OK) return 0;
    grid_take(e);
    real **momentum = NEW("engine.momenta", e->grid->fields, real *);
    for (int k = 0; k < e->grid->fields; k++) {
        const struct grid *g = &e->grid->field[k].grid;
        momentum[k] = BARE("engine.momentum", g->n * g->dim, real);
        for (int d = 0; d < g->dim; d++) array_copy(momentum[k] + d * g->n, g->momentum[d], g->n, sizeof(real));
    }
    struct grid_side *side = meeting_find(e);
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

/* Nothing moves on the grid: its walls constrain no node, and residuals are those of particles. */
static void step_without_grid(struct run *e)
{
    for (int k = 0; k < e->grid->fields; k++) grid_idle(&e->grid->field[k].grid);
    engine_residual(e);
}

/* Advances the growing cracks by one step; returns the number of directed bonds released. */
static int64_t grow(struct run *e)
{
    int64_t released = 0;
    for (int k = 0; k < e->scene->growths; k++) {
        struct control r;
        const bool known = probes_sif_control(&e->probing->probes, e->scene->growth[k].probe, &r);
        released += growth_step(&e->fracture->growth[k], &e->bonds, &e->part, &e->source, known ? &r : NULL, e->clock.t,
                                e->clock.dt);
    }
    return released;
}

/* Updates the stress share of material points where bonds fade; convert() has updated it for broken bonds. */
static void renew_partial(struct run *e, bool changed)
{
    if (!e->coupling->uses_partial || e->scene->growths == 0) return;
    for (int k = 0; k < e->scene->growths; k++) changed |= e->fracture->growth[k].n > 0;
    if (changed) partial_stress_make(&e->coupling->partial, &e->part, &e->bonds, &e->source, NULL, 0);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

/* What the phases of one step share. */
struct step {
    real middle;                         /* t + dt/2 [s]                                                      */
    real dt_velocity;                    /* dt, half of it in the first step: velocities are half a step behind [s] */
    struct pd_motion motion;             /* of peridynamic particles                                          */
    bool damps;                          /* the interface zone is damped in this step                         */
    int64_t broken, converted;           /* directed bonds; particles                                         */
};

/* True if nothing reads positions between forces and motion, as samples and growing cracks do: then one sweep computes
 * the forces of particles and moves those whose rows it has left behind (kernels/pd/sweep.h), with the bits of forces
 * first, then motion. With 1.7 million particles, which no cache holds, that saves 38 % of a step. */
static bool sweep_moves(const struct scene *s, const struct run_report *report)
{
    return !report->sampling.due && s->growths == 0;
}

/* Marks material points that other bodies have come near. */
static void approach(struct run *e)
{
    engine_mesh_sync_points(e, NULL, 0);
    approach_mark(&e->part, e->scene->bodies, e->rigid->body, e->scene->rigids, APPROACH_REACH * e->scene->spacing);
}

/* May a point have been marked for conversion in this step, or a bond have changed? Points on the grid say nothing of
 * it; of the mesh its cells say that their points may be. */
static bool may_convert(const struct run *e, const struct step *now)
{
    return now->broken > 0 || e->coupling->approaches || e->part.n_free > 0 || e->part.n_grid_coupled > 0 ||
           e->scene->growths > 0 || scene_in_steps(e->scene) || e->part.low_since || e->frame->levels.returned ||
           mesh_stressed(&e->frame->mesh);
}

static void meet_others(void *context, const int32_t *list, int64_t n)
{
    struct run *e = context;
    contact_add(e->contact, &e->bonds, &e->source.family, list, n);
}

/* Material points that become peridynamic, and what follows from them and from broken bonds: the active set, partial
 * stresses, the interface zone, partial cells. */
static void convert_points(struct run *e, struct step *now)
{
    if (e->scene->active_set) active_rows_update(&e->bonds, &e->part, &e->loads);
    if (e->coupling->approaches && e->clock.step % APPROACH_STEPS == 0) approach(e);
    const bool looked = engine_notch_approach(e);
    engine_breaks(e, now->broken);
    if (!looked && !may_convert(e, now)) {
        lap(&e->laps, LAP_CONVERT);
        return;
    }
    const struct conversion_sync sync = {engine_mesh_sync_points, e, meet_others};
    engine_levels_guard(e);
    now->converted = convert(&e->coupling->conversion, &e->scene->conversion, &e->part, &e->bonds, &e->source,
                             e->coupling->uses_partial ? &e->coupling->partial : NULL, &sync, e->clock.t);
    if (now->converted > 0) engine_interface_make(e), e->grid->sort_needed = true;
    renew_partial(e, now->broken > 0 || now->converted > 0);
    engine_mesh_follow(e, now->converted);
    lap(&e->laps, LAP_CONVERT);
}

/* Conversion between load steps: a step without motion. True if particles have converted. */
bool engine_convert(struct run *e, int64_t broken)
{
    struct step now = {.broken = broken};
    if (e->frame->mesh.points > 0 && e->scene->method == METHOD_ADAPTIVE)
        mesh_points_mark(&e->frame->mesh, &e->part, e->frame->elastic, !e->scene->small_strain);
    convert_points(e, &now);
    return now.converted > 0;
}

/* Particles that revert, the velocities of a sample, the cells of material points, the first half of the interface
 * damping. */
static status prepare(struct run *e, struct step *now)
{
    TRY(engine_levels_follow(e));
    now->middle = e->clock.t + 0.5 * e->clock.dt;
    now->dt_velocity = (e->clock.step == 0 ? 0.5 : 1) * e->clock.dt * engine_damping_share(e);
    e->grid->transfer.dt_velocity = now->dt_velocity;
    if (e->coupling->approaches && e->clock.step == 0) convert_points(e, now);    /* bodies that touch at the start */
    engine_revert(e);
    contact_update(e->contact, &e->part, &e->bonds, &e->loads, &e->source.family, e->clock.step,
                   e->diagnostics->bonds_broken, e->coupling->conversion.converted + e->coupling->conversion.reverted);
    now->motion = (struct pd_motion){e->clock.dt, now->dt_velocity, e->tables.wave_speed, e->loads.loaded, false};
    e->grid->transfer.bonded = e->coupling->bonded;      /* reversion may have freed it */
    lap(&e->laps, LAP_CONVERT);
    engine_sample_begin(e);
    lap(&e->laps, LAP_SAMPLE);
    TRY(grid_sort(e));
    now->damps = e->coupling->zone.points > 0 && e->coupling->damping_share > 0;
    if (now->damps) {
        e->damped += interface_damp_begin(&e->coupling->zone, &e->part, e->coupling->damping_share);
        loads_mirror(&e->loads, &e->part);       /* bonds that break ask images for their velocity */
    }
    engine_damping_begin(e);
    lap(&e->laps, LAP_GRID);
    return OK;
}

/* Forces of bonds, contact and loads, and bonds that break; the energies of a sample; cracks that grow. */
static void forces(struct run *e, struct step *now)
{
    loads_clear(&e->loads, &e->part);
    now->broken = bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit,
                              sweep_moves(e->scene, e->report) ? &now->motion : NULL);
    e->contact->recorded = e->contact->push[0] && engine_frame_follows(e);
    contact_force(e->contact, &e->part, e->clock.step > 0 ? e->clock.dt : 0);
    contact_clock(e->contact, e->clock.t);
    engine_rigid_book(e, now->dt_velocity);
    loads_apply(&e->loads, &e->part, now->middle, e->clock.dt, now->dt_velocity);
    lap(&e->laps, LAP_BONDS);
    engine_sample_energy(e);
    now->broken += grow(e);
    lap(&e->laps, LAP_SAMPLE);
}

/* Moves the peridynamic particles that have not moved in the sweep of forces: the loaded ones, or all. */
static void move_peridynamic(struct run *e, struct pd_motion *motion)
{
    struct particles *p = &e->part;
    const struct loads *l = &e->loads;
    motion->diverged |= sweep_moves(e->scene, e->report) ? e->kernels.pd_move(p, l->list, l->listed, motion)
                                         : e->kernels.pd_move(p, p->list[KIND_PD], p->n_of[KIND_PD], motion);
    e->stability->diverged = motion->diverged;
}

/* Motion: peridynamic particles, points on the grid, nodes of the mesh; supports hold their particles. */
static void move(struct run *e, struct step *now)
{
    struct particles *p = &e->part;
    move_peridynamic(e, &now->motion);
    engine_rigid_move(e, now->middle, now->dt_velocity / engine_damping_share(e));      /* these are not damped */
    lap(&e->laps, LAP_BONDS);
    if (p->n_free + p->n_grid_coupled > 0) step_grid(e, now->middle);
    else step_without_grid(e);
    if (now->damps) e->damped += interface_damp_end(&e->coupling->zone, p);
    engine_mesh_move(e, now->middle, now->dt_velocity);
    for (int k = 0; k < e->grid->fields; k++) loads_react(&e->loads, &e->grid->field[k].grid, now->dt_velocity);
    if (loads_hold(&e->loads, p, now->middle, e->clock.dt)) e->grid->sort_needed = true;
    loads_mirror(&e->loads, p);
    lap(&e->laps, LAP_GRID);
}

/* The line of history.csv of a sample, at t_n; damping; then t and the step advance. */
static void finish(struct run *e)
{
    const real loss = engine_damping_loss(e);
    e->damped += loss;
    e->report->sampling.energy.damped += loss;
    engine_sample_end(e);
    engine_damping_end(e);
    e->clock.t = (real)(e->clock.step + 1) * e->clock.dt;
    e->clock.step++;
    lap(&e->laps, LAP_SAMPLE);
}

/* One step of the algorithm of Zeng et al. 2022, section 4, as corrected (MUSL, leap-frog start):
 *
 *     1  mass and momentum of material points to the nodes                     move: step_grid
 *     2  forces of bonds                                                       forces
 *     3  internal and external forces to the nodes; nodal momentum advances    move: step_grid
 *     4  velocities and positions of material points; peridynamic particles    move
 *     5  bonds break                                                           forces, in the sweep of 2
 *     6  momentum of material points to the nodes again                        move: step_grid
 *     7  velocity gradients, stresses, volumes                                 move: step_grid
 *     8  conversion                                                            convert_points
 *
 * Bonds break by the positions that step 4 of the step before has left, which is step 5 of the paper one step later. */
status engine_step(struct run *e)
{
    struct step now = {0};
    TRY(prepare(e, &now));
    forces(e, &now);
    move(e, &now);
    convert_points(e, &now);
    finish(e);
    return OK;
}

status engine_run(struct run *e)
{
    memory_reuse(true);
    if (scene_at_rest(e->scene)) return engine_solve(e);
    if (scene_in_steps(e->scene)) return engine_steps(e);
    TRY(engine_report_start(e));
    laps_start(&e->laps);
    while (e->clock.step < e->clock.steps) {
        TRY(engine_step(e));
        TRY(engine_stability_check(e));
        TRY(engine_report(e));
    }
    return engine_report_end(e);
}
