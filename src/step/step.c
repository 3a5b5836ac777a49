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

/* Records the bonds of the run broken in this step and converts material points near them to peridynamic particles.
 * now->broken: number of these bonds; now->converted: receives the number of points. */
static void conversion(struct run *run, struct step *now)
{
    const bool marked = conversion_flag_points_near_contact(run);
    run_record_first_break_and_update_break_probes(run, now->broken);
    now->converted = run_convert_flagged_points_to_peridynamic(
        run, now->broken, marked, any_growing_crack_weakens_bonds_gradually(run->fracture));
    timer_add_elapsed_to_section(&run->timers, TIMER_CONVERT);
}

/* Updates the pairs of particles of the run that may be in contact, and sets in now->motion how peridynamic particles
 * move in this step. */
static void motion_begin(struct run *run, struct step *now)
{
    contact_update_pair_list_if_outdated(run->contact, &run->part, &run->bonds, &run->loads, &run->source.family,
                                         run->clock.step, run->diagnostics->bonds_broken,
                                         run->coupling->conversion.converted + run->coupling->conversion.reverted);
    now->motion = (struct pd_motion){run->clock.dt, now->dt_velocity, run->tables.wave_speed, run->loads.loaded, false};
    run->grid->transfer.bonded = run->coupling->bonded; /* reversion may have reallocated the list */
    timer_add_elapsed_to_section(&run->timers, TIMER_CONVERT);
}

/* Sorts the points of the run on the grid into cells. Returns FAILED, with a message, if positions of points are not
 * finite or if a grid would need too many nodes. */
static status sort(struct run *run)
{
    bool lost;
    TRY(grid_sort_points_into_cells(run, &lost));
    return lost ? run_check_particles_for_divergence(run, true, false) : OK;
}

/* Damps the velocities of points of the run in the interface zone (material points near peridynamic particles), before
 * the forces of the step are computed. Adds the first half of the energy that this removes to run->damped; the second
 * half is added when the velocities after the step are known. Sets now->damps to true if the input file (scene) has
 * such damping. */
static void zone_damp(struct run *run, struct step *now)
{
    now->damps = run->coupling->zone.points > 0 && run->coupling->damping_share > 0;
    if (!now->damps) return;
    run->damped +=
        interface_zone_damp_and_return_first_half_loss(&run->coupling->zone, &run->part, run->coupling->damping_share);
    loads_update_mirror_images_of_particles(&run->loads,
                                            &run->part); /* breaking bonds read the velocities of mirror images */
}

/* Stores the velocities of the run before the forces of this step, from which the energy loss by bulk damping is
 * computed. In the first step it also damps them over half a time step, because velocities are half a step behind
 * positions from then on. Does nothing without bulk damping. now->decay: product of damping rate and time step [1]. */
static void damping_begin(struct run *run, const struct step *now)
{
    real *const *before = run->report->sampling.before;
    run->loads.damped = damping_relative_excess_of_undamped_velocities(now->decay, run->clock.step == 0);
    if (!(now->decay > 0)) return;
    if (run->clock.step == 0) {
        run->damped +=
            damping_apply_first_half_step_and_sum_loss(&run->part, &run->frame->mesh, &run->loads, now->decay);
        for (int d = 0; d < run->part.dim && before[d]; d++)
            for (int64_t i = 0; i < run->part.n; i++) before[d][i] *= now->share;
    }
    damping_store_velocities(run->damping, &run->part, &run->frame->mesh);
}

/* Returns true if the loop over bonds may also move the particles, because nothing reads positions between forces and
 * motion, as samples (report), growing cracks and viscosity (scene s) would. The loop moves each particle when it no
 * longer reads its position (kernels/pd/sweep.h), with bit-identical results. This saves 38 % of a step with 1.7
 * million particles, which exceed the cache. */
static bool sweep_moves(const struct scene *s, const struct run_report *report)
{
    return !report->sampling.due && s->growths == 0 && !scene_any_material_has_bulk_viscosity(s);
}

/* Returns the number of time steps between two tests of the stresses of particles against strength surfaces: the steps
 * in which a wave crosses half a horizon, at least 1. horizon [m]; wave_speed [m/s]; dt: time step [s]. */
static int64_t surface_interval(real horizon, real wave_speed, real dt)
{
    return 1 + (int64_t)(0.5 * horizon / (wave_speed * dt));
}

/* Computes the forces of the bonds of the run and breaks the bonds beyond their limit. now->broken: receives the number
 * of broken bonds, each counted once for each of its two particles. If sweep_moves returns true, the loop over bonds
 * also moves the particles without loads. */
static void push_bonds(struct run *run, struct step *now)
{
    loads_clear_forces_of_loaded_particles(&run->loads, &run->part);
    if (run->clock.step % surface_interval(run->source.family.horizon, run->tables.wave_speed, run->clock.dt) == 0)
        bonds_start_softening_at_strength_surface(&run->bonds, &run->part, &run->source);
    run->source.limit.retries = run->clock.step % SOFTENING_RETRY_STEPS == 0;
    now->broken = bond_forces(run->kernels.bond_force, &run->bonds, &run->part, &run->source.limit,
                              sweep_moves(run->scene, run->report) ? &now->motion : NULL);
}

/* Computes the contact forces of c on particles. Records these forces for output, too, if a frame (a file with the
 * fields of all particles) is due at the end of this step. report, s, clock: determine whether a frame is due. p: all
 * particles. */
static void push_contact(struct contact *c, struct particles *p, const struct run_report *report, const struct scene *s,
                         const struct run_clock *clock)
{
    c->recorded =
        c->push[0] && report_frame_series_due_after_step_as_bitmask(report->out, s, clock, clock->step + 1) != 0;
    contact_compute_forces(c, p, clock->step > 0 ? clock->dt : 0);
    contact_record_first_and_last_contact_time(c, clock->t);
}

/* Moves the peridynamic particles of the run that the loop over bonds has not moved: those with loads, or all if
 * sweep_moves is false. Sets motion->diverged to true if a particle is faster than waves. */
static void move_peridynamic(struct run *run, struct pd_motion *motion)
{
    struct particles *p = &run->part;
    const struct loads *l = &run->loads;
    motion->diverged |= sweep_moves(run->scene, run->report)
                            ? run->kernels.pd_move(p, l->list, l->listed, motion)
                            : run->kernels.pd_move(p, p->list[KIND_PD], p->n_of[KIND_PD], motion);
    run->stability->diverged = motion->diverged;
}

/* Moves the grids of the run and their material points. Numbers in the code are the steps of the algorithm listed at
 * the function `step`. Returns FAILED, with a message, if a grid would need too many nodes. now: quantities of this
 * step. */
static status move_grid(struct run *run, const struct step *now)
{
    const bool any = run->part.n_free + run->part.n_grid_coupled > 0;
    bulk_viscosity_change_or_restore_point_stress(run->viscosity, &run->part, true);
    grid_transfer_mass_momentum_forces_to_nodes(run->grid, &run->part, &run->kernels,
                                                &run->timers); /* 1, 3: mass, momentum, force to nodes */
    bulk_viscosity_change_or_restore_point_stress(run->viscosity, &run->part, false);
    if (run->clock.step == 0) patch_test_store_largest_residual_force(run->probing, run->scene, &run->part, run->grid);
    TRY(grid_advance_material_points_one_step(run, now->middle)); /* 3, 4, 6, 7 */
    if (any && run->part.end_strain)
        bonded_mpm_points_compute_strain_from_stress(&run->coupling->partial, &run->part, run->scene->material);
    if (any) timer_add_elapsed_to_section(&run->timers, TIMER_GATHER);
    if (now->damps) run->damped += interface_zone_second_half_of_damping_loss(&run->coupling->zone, &run->part);
    return OK;
}

/* Computes the forces on nodes of the bodies of the run in the reference frame (mesh of the undeformed body) and moves
 * these nodes. Does nothing without such bodies. now: quantities of this step. */
static void move_frame(struct run *run, const struct step *now)
{
    if (run->frame->mesh.points == 0) return;
    lagrangian_mesh_compute_nodal_forces(run->frame, &run->part, run->clock.step);
    bulk_viscosity_add_nodal_forces(run);
    if (run->clock.step == 0) patch_test_include_mesh_residual_force(run->probing, run->scene, &run->frame->mesh);
    lagrangian_mesh_move_nodes(run->frame, &run->part, &run->loads, &run->clock, now->middle, now->dt_velocity);
}

/* Adds the reactions at nodes of the run with prescribed velocity to their supports. Then sets velocities and positions
 * of particles with prescribed motion to their values at the end of the step. now: quantities of this step. */
static void step_hold(struct run *run, const struct step *now)
{
    for (int k = 0; k < run->grid->fields; k++)
        loads_add_reactions_at_grid_nodes(&run->loads, &run->grid->field[k].grid, now->dt_velocity);
    if (loads_impose_prescribed_motion_on_particles(&run->loads, &run->part, now->middle, run->clock.dt))
        run->grid->sort_needed = SORT_ALL;
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    timer_add_elapsed_to_section(&run->timers, TIMER_GRID);
}

/* Completes the sample of the start of the step, applies bulk damping and adds its energy loss to run->damped, and
 * advances time and step number. now: quantities of this step. */
static void finish(struct run *run, const struct step *now)
{
    const bool damps = now->decay > 0;
    const real loss =
        damps && run->clock.step > 0
            ? damping_energy_loss_since_previous_step(run->damping, &run->part, &run->frame->mesh, now->decay)
            : 0;
    run->damped += loss;
    run->report->sampling.energy.damped += loss;
    history_sample_complete_after_step_if_due(run);
    if (damps) damping_apply_full_step(&run->part, &run->frame->mesh, &run->loads, now->decay);
    run->clock.t = (real)(run->clock.step + 1) * run->clock.dt;
    run->clock.step++;
    timer_add_elapsed_to_section(&run->timers, TIMER_SAMPLE);
}

bool load_step_flag_points_near_contact_to_convert(struct run *run, real present_pseudo_time,
                                                   real rigid_body_pseudo_time)
{
    if (!run->coupling->approaches || run->rigid->n == 0) return false;
    rigids_move_to_prescribed_positions(run->rigid, rigid_body_pseudo_time);
    conversion_flag_points_near_contact(run);
    rigids_move_to_prescribed_positions(run->rigid, present_pseudo_time);
    return true;
}

bool load_step_convert_points_near_breaks_to_pd(struct run *run, int64_t broken_bond_count)
{
    struct step now = {.broken = broken_bond_count};
    if (run->frame->mesh.points > 0 && run->scene->method == METHOD_ADAPTIVE)
        mesh_points_mark(&run->frame->mesh, &run->part, run->frame->elastic, !run->scene->small_strain);
    conversion(run, &now);
    return now.converted > 0;
}

/* Makes one time step of the run by the algorithm of Zeng et al. 2022, section 4, as corrected (MUSL, leap-frog
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
status run_advance_by_one_time_step(struct run *run)
{
    struct step now = step_begin(&run->clock, run->scene->damping, &run->grid->transfer);
    if (run->coupling->approaches && run->clock.step == 0) conversion(run, &now); /* bodies that touch at the start */
    reversion_convert_relaxed_particles_to_mpm(run);
    motion_begin(run, &now);
    history_sample_begin_before_step_if_due(run);
    TRY(sort(run));
    zone_damp(run, &now);
    damping_begin(run, &now);

    push_bonds(run, &now); /* 2, 5 */
    bulk_viscosity_add_bond_forces_and_pressure(run);
    push_contact(run->contact, &run->part, run->report, run->scene, &run->clock);
    rigids_update_drive_work_and_contact_impulse(run->rigid, now.dt_velocity, run->loads.impulse);
    loads_apply_forces_and_motion_constraints(&run->loads, &run->part, now.middle, run->clock.dt, now.dt_velocity);
    timer_add_elapsed_to_section(&run->timers, TIMER_BONDS);
    history_sample_compute_energies(run);
    now.broken += cracks_grow_one_step_and_count_cut_bonds(run);
    timer_add_elapsed_to_section(&run->timers, TIMER_SAMPLE);

    move_peridynamic(run, &now.motion); /* 4 */
    rigids_advance_one_step(run->rigid, now.middle, run->clock.dt,
                            now.dt_velocity / now.share); /* bulk damping does not act on rigid bodies */
    timer_add_elapsed_to_section(&run->timers, TIMER_BONDS);
    TRY(move_grid(run, &now)); /* 1, 3, 4, 6, 7 */
    move_frame(run, &now);     /* 3, 4, 7 */
    step_hold(run, &now);

    conversion(run, &now); /* 8 */
    finish(run, &now);
    return OK;
}
