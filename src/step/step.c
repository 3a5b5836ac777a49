/* One step in time. step, the last function, is the algorithm of Zeng et al. 2022. */
#include "step/step.h"

#include "contact/contact.h"
#include "coupling/coupling_part.h"
#include "fracture/fracture_part.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "probes/probes_part.h"
#include "rigid/rigid_part.h"
#include "step/damping.h"
#include "step/report.h"
#include "step/sample.h"
#include "step/stability.h"
#include "step/viscosity.h"
#include "probes/diagnostics.h"
#include "step/checks.h"

/* What the phases of one step share. */
struct step {
    real middle;               /* t + dt/2 [s] */
    real decay, share;         /* c dt of bulk damping; share of a kick that it leaves (step/damping.h) [1] */
    real dt_velocity;          /* dt, half of it in the first step: velocities are half a step behind; damped [s] */
    struct pd_motion motion;   /* of peridynamic particles */
    bool damps;                /* the interface zone is damped in this step */
    int64_t broken, converted; /* directed bonds; particles */
};

static struct step step_begin(struct run *e)
{
    const real dt = e->clock.dt, decay = e->scene->damping * dt, share = damping_share(decay);
    const real dt_velocity = (e->clock.step == 0 ? 0.5 : 1) * dt * share;
    e->grid->transfer.dt_velocity = dt_velocity;
    return (struct step){.middle = e->clock.t + 0.5 * dt, decay, share, dt_velocity};
}

/* Conversion, and the records of bonds that have broken. */
static void conversion(struct run *e, struct step *now)
{
    const bool marked = conversion_mark(e);
    sample_breaks(e, now->broken);
    now->converted = conversion_pass(e, now->broken, marked, cracks_fade(e->fracture));
    timer_book(&e->timers, TIMER_CONVERT);
}

/* Who may touch whom in this step, and how peridynamic particles move in it. */
static void motion_begin(struct run *e, struct step *now)
{
    contact_update(e->contact, &e->part, &e->bonds, &e->loads, &e->source.family, e->clock.step,
                   e->diagnostics->bonds_broken, e->coupling->conversion.converted + e->coupling->conversion.reverted);
    now->motion = (struct pd_motion){e->clock.dt, now->dt_velocity, e->tables.wave_speed, e->loads.loaded, false};
    e->grid->transfer.bonded = e->coupling->bonded; /* reversion may have freed it */
    timer_book(&e->timers, TIMER_CONVERT);
}

/* Points on the grid into cells. FAILED where they have left it. */
static status sort(struct run *e)
{
    bool lost;
    TRY(grid_sort(e, &lost));
    return lost ? divergence_check(e, true, false) : OK;
}

/* First half of the interface damping. */
static void zone_damp(struct run *e, struct step *now)
{
    now->damps = e->coupling->zone.points > 0 && e->coupling->damping_share > 0;
    if (!now->damps) return;
    e->damped += interface_damp_begin(&e->coupling->zone, &e->part, e->coupling->damping_share);
    loads_mirror(&e->loads, &e->part); /* bonds that break ask images for their velocity */
}

/* Keeps the velocities before bulk damping. At the start it also slows them by half a step, which samples of the start
 * do not show. */
static void damping_begin(struct run *e, const struct step *now)
{
    real *const *before = e->report->sampling.before;
    if (!(now->decay > 0)) return;
    if (e->clock.step == 0) {
        e->damped += damping_start(&e->part, &e->frame->mesh, &e->loads, now->decay);
        for (int d = 0; d < e->part.dim && before[d]; d++)
            for (int64_t i = 0; i < e->part.n; i++) before[d][i] *= now->share;
    }
    damping_keep(e->damping, &e->part, &e->frame->mesh);
}

/* True if nothing reads positions between forces and motion, as samples, growing cracks and viscosity do: then one
 * sweep computes the forces of particles and moves those whose rows it has left behind (kernels/pd/sweep.h), with the
 * bits of forces first, then motion. With 1.7 million particles, which no cache holds, that saves 38 % of a step. */
static bool sweep_moves(const struct scene *s, const struct run_report *report)
{
    return !report->sampling.due && s->growths == 0 && !scene_viscous(s);
}

/* Forces of bonds, of which some break; they may move particles at once. */
static void push_bonds(struct run *e, struct step *now)
{
    loads_clear(&e->loads, &e->part);
    now->broken = bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit,
                              sweep_moves(e->scene, e->report) ? &now->motion : NULL);
}

static void push_contact(struct run *e)
{
    e->contact->recorded =
        e->contact->push[0] && report_frames_due(e->report->out, e->scene, &e->clock, e->clock.step + 1) != 0;
    contact_force(e->contact, &e->part, e->clock.step > 0 ? e->clock.dt : 0);
    contact_clock(e->contact, e->clock.t);
}

/* Moves the peridynamic particles that have not moved in the sweep of forces: the loaded ones, or all. */
static void move_peridynamic(struct run *e, struct pd_motion *motion)
{
    struct particles *p = &e->part;
    const struct loads *l = &e->loads;
    motion->diverged |= sweep_moves(e->scene, e->report)
                            ? e->kernels.pd_move(p, l->list, l->listed, motion)
                            : e->kernels.pd_move(p, p->list[KIND_PD], p->n_of[KIND_PD], motion);
    e->stability->diverged = motion->diverged;
}

/* Grids and their points; numbers are steps of the algorithm. */
static void move_grid(struct run *e, const struct step *now)
{
    const bool any = e->part.n_free + e->part.n_grid_coupled > 0;
    viscosity_lend(e->viscosity, &e->part, true);
    grid_map(e->grid, &e->part, &e->kernels, &e->timers); /* 1, 3: mass, momentum, force to nodes */
    viscosity_lend(e->viscosity, &e->part, false);
    if (e->clock.step == 0) residual_keep(e->probing, e->scene, &e->part, e->grid);
    grid_step(e, now->middle); /* 3, 4, 6, 7 */
    if (any && e->part.end_strain) partial_points_update(&e->coupling->partial, &e->part, e->scene->material);
    if (any) timer_book(&e->timers, TIMER_GATHER);
    if (now->damps) e->damped += interface_damp_end(&e->coupling->zone, &e->part);
}

/* Nodes of bodies in the reference frame. */
static void move_frame(struct run *e, const struct step *now)
{
    if (e->frame->mesh.points == 0) return;
    frame_force(e->frame, &e->part, e->clock.step);
    viscosity_push_nodes(e);
    if (e->clock.step == 0) residual_keep_mesh(e->probing, e->scene, &e->frame->mesh);
    frame_move(e->frame, &e->part, &e->loads, &e->clock, now->middle, now->dt_velocity);
}

/* Supports bear what the grids have met, and hold their particles. */
static void step_hold(struct run *e, const struct step *now)
{
    for (int k = 0; k < e->grid->fields; k++) loads_react(&e->loads, &e->grid->field[k].grid, now->dt_velocity);
    if (loads_hold(&e->loads, &e->part, now->middle, e->clock.dt)) e->grid->sort_needed = true;
    loads_mirror(&e->loads, &e->part);
    timer_book(&e->timers, TIMER_GRID);
}

/* The line of history.csv of a sample, at t_n; damping; then t and the step advance. */
static void finish(struct run *e, const struct step *now)
{
    const bool damps = now->decay > 0;
    const real loss = damps && e->clock.step > 0 ? damping_loss(e->damping, &e->part, &e->frame->mesh, now->decay) : 0;
    e->damped += loss;
    e->report->sampling.energy.damped += loss;
    sample_end(e);
    if (damps) damping_end(&e->part, &e->frame->mesh, &e->loads, now->decay);
    e->clock.t = (real)(e->clock.step + 1) * e->clock.dt;
    e->clock.step++;
    timer_book(&e->timers, TIMER_SAMPLE);
}

bool step_convert(struct run *e, int64_t broken)
{
    struct step now = {.broken = broken};
    if (e->frame->mesh.points > 0 && e->scene->method == METHOD_ADAPTIVE)
        mesh_points_mark(&e->frame->mesh, &e->part, e->frame->elastic, !e->scene->small_strain);
    conversion(e, &now);
    return now.converted > 0;
}

/* One step of the algorithm of Zeng et al. 2022, section 4, as corrected (MUSL, leap-frog start). Its steps:
 *
 *     1  mass and momentum of material points to the nodes
 *     2  forces of bonds
 *     3  internal and external forces to the nodes; nodal momentum advances
 *     4  velocities and positions of material points and of peridynamic particles
 *     5  bonds break
 *     6  momentum of material points to the nodes again
 *     7  velocity gradients, stresses, volumes
 *     8  conversion
 *
 * Bonds break by the positions that step 4 of the step before has left, which is step 5 of the paper one step later. */
status step(struct run *e)
{
    struct step now = step_begin(e);
    if (e->coupling->approaches && e->clock.step == 0) conversion(e, &now); /* bodies that touch at the start */
    revert(e);
    motion_begin(e, &now);
    sample_begin(e);
    TRY(sort(e));
    zone_damp(e, &now);
    damping_begin(e, &now);

    push_bonds(e, &now); /* 2, 5 */
    viscosity_push(e);
    push_contact(e);
    rigids_book(e->rigid, now.dt_velocity, e->loads.impulse);
    loads_apply(&e->loads, &e->part, now.middle, e->clock.dt, now.dt_velocity);
    timer_book(&e->timers, TIMER_BONDS);
    sample_energy(e);
    now.broken += cracks_grow(e);
    timer_book(&e->timers, TIMER_SAMPLE);

    move_peridynamic(e, &now.motion);                                            /* 4 */
    rigids_move(e->rigid, now.middle, e->clock.dt, now.dt_velocity / now.share); /* rigid bodies are not damped */
    timer_book(&e->timers, TIMER_BONDS);
    move_grid(e, &now);  /* 1, 3, 4, 6, 7 */
    move_frame(e, &now); /* 3, 4, 7 */
    step_hold(e, &now);

    conversion(e, &now); /* 8 */
    finish(e, &now);
    return OK;
}
