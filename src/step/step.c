/* Makes one time step. The function `step`, at the end of the file, is the algorithm of Zeng et al. 2022; the functions
 * before it are its phases. */
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
#include "loads/mirrors.h"

/* Quantities that the phases of one time step share. */
struct step {
    real middle;               /* t + dt/2 [s] */
    real decay, share;         /* c dt of bulk damping, its factor exp(-c dt/2) on velocity updates [1] */
    real dt_velocity;          /* duration of the velocity update: dt times share, half of it at first [s] */
    struct pd_motion motion;   /* motion of peridynamic particles */
    bool damps;                /* interface damping acts in this step */
    int64_t broken, converted; /* directed bonds broken, particles converted in this step */
};

/* Returns the quantities that all phases of the next step use: the time in its middle, the factors of bulk damping and
 * the duration of the velocity update. The latter is half as long in the first step and is also stored in *transfer.
 * clock: step number and time step; damping: rate c of bulk damping [1/s]. */
static struct step step_begin(const struct run_clock *clock, real damping, struct transfer_data *transfer)
{
    const real dt = clock->dt, decay = damping * dt, share = damping_velocity_increment_factor(decay);
    const real dt_velocity = (clock->step == 0 ? 0.5 : 1) * dt * share;
    transfer->dt_velocity = dt_velocity;
    return (struct step){.middle = clock->t + 0.5 * dt, decay, share, dt_velocity};
}

/* Records the bonds of run e broken in this step and converts material points near them to peridynamic particles.
 * now->broken: number of these bonds; now->converted: receives the number of points. */
static void conversion(struct run *e, struct step *now)
{
    const bool marked = conversion_flag_points_near_contact(e);
    run_record_broken_bonds_of_step(e, now->broken);
    now->converted = run_convert_flagged_points_to_peridynamic(e, now->broken, marked,
                                                               any_growing_crack_weakens_bonds_gradually(e->fracture));
    timer_add_elapsed_to_section(&e->timers, TIMER_CONVERT);
}

/* Updates the pairs of particles of run e that may be in contact, and sets in now->motion how peridynamic particles
 * move in this step. */
static void motion_begin(struct run *e, struct step *now)
{
    contact_update_pair_list_if_outdated(e->contact, &e->part, &e->bonds, &e->loads, &e->source.family, e->clock.step,
                                         e->diagnostics->bonds_broken,
                                         e->coupling->conversion.converted + e->coupling->conversion.reverted);
    now->motion = (struct pd_motion){e->clock.dt, now->dt_velocity, e->tables.wave_speed, e->loads.loaded, false};
    e->grid->transfer.bonded = e->coupling->bonded; /* reversion may have reallocated the list */
    timer_add_elapsed_to_section(&e->timers, TIMER_CONVERT);
}

/* Sorts the points of run e on the grid into cells. Returns FAILED, with a message, if positions of points are not
 * finite or if a grid would need too many nodes. */
static status sort(struct run *e)
{
    bool lost;
    TRY(grid_sort_points_into_cells(e, &lost));
    return lost ? run_check_particles_for_divergence(e, true, false) : OK;
}

/* Damps the velocities of points of run e in the interface zone (material points near peridynamic particles), before
 * the forces of the step are computed. Adds the first half of the energy that this removes to e->damped; the second
 * half is added when the velocities after the step are known. Sets now->damps to true if the input file (scene) has
 * such damping. */
static void zone_damp(struct run *e, struct step *now)
{
    now->damps = e->coupling->zone.points > 0 && e->coupling->damping_share > 0;
    if (!now->damps) return;
    e->damped +=
        interface_zone_damp_return_loss_by_old_velocity(&e->coupling->zone, &e->part, e->coupling->damping_share);
    loads_update_mirror_images(&e->loads, &e->part); /* breaking bonds read the velocities of mirror images */
}

/* Stores the velocities of run e before the forces of this step, from which the energy loss by bulk damping is
 * computed. In the first step it also damps them over half a time step, because velocities are half a step behind
 * positions from then on. Does nothing without bulk damping. now->decay: product of damping rate and time step [1]. */
static void damping_begin(struct run *e, const struct step *now)
{
    real *const *before = e->report->sampling.before;
    e->loads.damped = damping_undamped_velocity_excess(now->decay, e->clock.step == 0);
    if (!(now->decay > 0)) return;
    if (e->clock.step == 0) {
        e->damped += damping_apply_first_half_return_energy_loss(&e->part, &e->frame->mesh, &e->loads, now->decay);
        for (int d = 0; d < e->part.dim && before[d]; d++)
            for (int64_t i = 0; i < e->part.n; i++) before[d][i] *= now->share;
    }
    damping_store_velocities(e->damping, &e->part, &e->frame->mesh);
}

/* Returns true if the loop over bonds may also move the particles, because nothing reads positions between forces and
 * motion, as samples (report), growing cracks and viscosity (scene s) would. The loop moves each particle when it no
 * longer reads its position (kernels/pd/sweep.h), with bit-identical results. This saves 38 % of a step with 1.7
 * million particles, which exceed the cache. */
static bool sweep_moves(const struct scene *s, const struct run_report *report)
{
    return !report->sampling.due && s->growths == 0 && !scene_has_viscosity(s);
}

/* Returns the number of time steps between two tests of the stresses of particles against strength surfaces: the steps
 * in which a wave crosses half a horizon, at least 1. horizon [m]; wave_speed [m/s]; dt: time step [s]. */
static int64_t surface_interval(real horizon, real wave_speed, real dt)
{
    return 1 + (int64_t)(0.5 * horizon / (wave_speed * dt));
}

/* Computes the forces of the bonds of run e and breaks the bonds beyond their limit. now->broken: receives the number
 * of broken bonds, each counted once for each of its two particles. If sweep_moves returns true, the loop over bonds
 * also moves the particles without loads. */
static void push_bonds(struct run *e, struct step *now)
{
    loads_clear_forces_of_loaded_particles(&e->loads, &e->part);
    if (e->clock.step % surface_interval(e->source.family.horizon, e->tables.wave_speed, e->clock.dt) == 0)
        bonds_start_softening_at_strength_surface(&e->bonds, &e->part, &e->source);
    e->source.limit.retries = e->clock.step % SOFTENING_RETRY_STEPS == 0;
    now->broken = bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit,
                              sweep_moves(e->scene, e->report) ? &now->motion : NULL);
}

/* Computes the contact forces of c on particles. Records these forces for output, too, if a frame (a file with the
 * fields of all particles) is due at the end of this step. report, s, clock: determine whether a frame is due. p: all
 * particles. */
static void push_contact(struct contact *c, struct particles *p, const struct run_report *report, const struct scene *s,
                         const struct run_clock *clock)
{
    c->recorded = c->push[0] && report_bitmask_of_frame_series_due(report->out, s, clock, clock->step + 1) != 0;
    contact_compute_forces(c, p, clock->step > 0 ? clock->dt : 0);
    contact_record_first_and_last_contact_time(c, clock->t);
}

/* Moves the peridynamic particles of run e that the loop over bonds has not moved: those with loads, or all if
 * sweep_moves is false. Sets motion->diverged to true if a particle is faster than waves. */
static void move_peridynamic(struct run *e, struct pd_motion *motion)
{
    struct particles *p = &e->part;
    const struct loads *l = &e->loads;
    motion->diverged |= sweep_moves(e->scene, e->report)
                            ? e->kernels.pd_move(p, l->list, l->listed, motion)
                            : e->kernels.pd_move(p, p->list[KIND_PD], p->n_of[KIND_PD], motion);
    e->stability->diverged = motion->diverged;
}

/* Moves the grids of run e and their material points. Numbers in the code are the steps of the algorithm listed at the
 * function `step`. Returns FAILED, with a message, if a grid would need too many nodes. now: quantities of this
 * step. */
static status move_grid(struct run *e, const struct step *now)
{
    const bool any = e->part.n_free + e->part.n_grid_coupled > 0;
    viscosity_subtract_or_restore_pressure(e->viscosity, &e->part, true);
    grid_map_points_to_nodes(e->grid, &e->part, &e->kernels, &e->timers); /* 1, 3: mass, momentum, force to nodes */
    viscosity_subtract_or_restore_pressure(e->viscosity, &e->part, false);
    if (e->clock.step == 0) patch_test_store_largest_residual_force(e->probing, e->scene, &e->part, e->grid);
    TRY(grid_advance_material_points_one_step(e, now->middle)); /* 3, 4, 6, 7 */
    if (any && e->part.end_strain)
        bonded_points_compute_strain_from_stress(&e->coupling->partial, &e->part, e->scene->material);
    if (any) timer_add_elapsed_to_section(&e->timers, TIMER_GATHER);
    if (now->damps) e->damped += interface_zone_damping_loss_by_new_velocity(&e->coupling->zone, &e->part);
    return OK;
}

/* Computes the forces on nodes of the bodies of run e in the reference frame (mesh of the undeformed body) and moves
 * these nodes. Does nothing without such bodies. now: quantities of this step. */
static void move_frame(struct run *e, const struct step *now)
{
    if (e->frame->mesh.points == 0) return;
    lagrangian_mesh_compute_nodal_forces(e->frame, &e->part, e->clock.step);
    viscosity_add_nodal_forces(e);
    if (e->clock.step == 0) patch_test_include_mesh_residual_force(e->probing, e->scene, &e->frame->mesh);
    lagrangian_mesh_move_nodes(e->frame, &e->part, &e->loads, &e->clock, now->middle, now->dt_velocity);
}

/* Adds the reactions at nodes of run e with prescribed velocity to their supports. Then sets velocities and positions
 * of particles with prescribed motion to their values at the end of the step. now: quantities of this step. */
static void step_hold(struct run *e, const struct step *now)
{
    for (int k = 0; k < e->grid->fields; k++)
        loads_add_grid_reactions(&e->loads, &e->grid->field[k].grid, now->dt_velocity);
    if (loads_impose_prescribed_motion(&e->loads, &e->part, now->middle, e->clock.dt)) e->grid->sort_needed = SORT_ALL;
    loads_update_mirror_images(&e->loads, &e->part);
    timer_add_elapsed_to_section(&e->timers, TIMER_GRID);
}

/* Completes the sample of the start of the step, applies bulk damping and adds its energy loss to e->damped, and
 * advances time and step number. now: quantities of this step. */
static void finish(struct run *e, const struct step *now)
{
    const bool damps = now->decay > 0;
    const real loss = damps && e->clock.step > 0
                          ? damping_energy_loss_since_previous_step(e->damping, &e->part, &e->frame->mesh, now->decay)
                          : 0;
    e->damped += loss;
    e->report->sampling.energy.damped += loss;
    history_sample_complete_after_step(e);
    if (damps) damping_apply_full_step(&e->part, &e->frame->mesh, &e->loads, now->decay);
    e->clock.t = (real)(e->clock.step + 1) * e->clock.dt;
    e->clock.step++;
    timer_add_elapsed_to_section(&e->timers, TIMER_SAMPLE);
}

bool load_step_flag_points_near_rigid_bodies(struct run *e, real present_pseudo_time, real t)
{
    if (!e->coupling->approaches || e->rigid->n == 0) return false;
    rigids_move_to_prescribed_positions(e->rigid, t);
    conversion_flag_points_near_contact(e);
    rigids_move_to_prescribed_positions(e->rigid, present_pseudo_time);
    return true;
}

bool load_step_convert_points_near_breaks_to_pd(struct run *e, int64_t broken_bond_count)
{
    struct step now = {.broken = broken_bond_count};
    if (e->frame->mesh.points > 0 && e->scene->method == METHOD_ADAPTIVE)
        mesh_points_mark(&e->frame->mesh, &e->part, e->frame->elastic, !e->scene->small_strain);
    conversion(e, &now);
    return now.converted > 0;
}

/* Makes one time step of run e by the algorithm of Zeng et al. 2022, section 4, as corrected (MUSL, leap-frog
 * start). Its steps:
 *
 *     1  mass and momentum of material points to the nodes
 *     2  forces of bonds
 *     3  internal and external forces to the nodes; nodal momentum advances
 *     4  velocities and positions of material points and of peridynamic particles
 *     5  bonds break
 *     6  momentum of material points to the nodes again
 *     7  velocity gradients, stresses, volumes
 *     8  conversion of material points to peridynamic particles
 *
 * Bonds break at the positions after step 4 of the previous time step, so that step 5 of the paper is made
 * one time step later. Returns FAILED, with a message, if positions of points are not finite or a grid needs
 * too many nodes. */
status step(struct run *e)
{
    struct step now = step_begin(&e->clock, e->scene->damping, &e->grid->transfer);
    if (e->coupling->approaches && e->clock.step == 0) conversion(e, &now); /* bodies that touch at the start */
    reversion_convert_relaxed_particles_to_mpm(e);
    motion_begin(e, &now);
    history_sample_begin_before_step(e);
    TRY(sort(e));
    zone_damp(e, &now);
    damping_begin(e, &now);

    push_bonds(e, &now); /* 2, 5 */
    viscosity_add_bond_forces_and_pressure(e);
    push_contact(e->contact, &e->part, e->report, e->scene, &e->clock);
    rigids_update_work_and_particle_impulse(e->rigid, now.dt_velocity, e->loads.impulse);
    loads_apply_forces_and_motion_constraints(&e->loads, &e->part, now.middle, e->clock.dt, now.dt_velocity);
    timer_add_elapsed_to_section(&e->timers, TIMER_BONDS);
    history_sample_compute_energies(e);
    now.broken += cracks_grow_one_step_and_count_cut_bonds(e);
    timer_add_elapsed_to_section(&e->timers, TIMER_SAMPLE);

    move_peridynamic(e, &now.motion); /* 4 */
    rigids_advance_one_step(e->rigid, now.middle, e->clock.dt,
                            now.dt_velocity / now.share); /* bulk damping does not act on rigid bodies */
    timer_add_elapsed_to_section(&e->timers, TIMER_BONDS);
    TRY(move_grid(e, &now)); /* 1, 3, 4, 6, 7 */
    move_frame(e, &now);     /* 3, 4, 7 */
    step_hold(e, &now);

    conversion(e, &now); /* 8 */
    finish(e, &now);
    return OK;
}
