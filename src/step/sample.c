/* Takes samples, the lines of history.csv. Energies at t_n are known between the forces and the motion of a step,
 * velocities only half a step before and after t_n, so that a sample is taken in three parts (sample.h). */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_archive.h"
#include "run/part.h"
#include "step/sample.h"
#include "step/report.h"
#include "mesh/mesh_part.h"
#include "fracture/fracture_part.h"
#include "probes/probes_part.h"
#include "output/output.h"
#include "coupling/coupling_part.h"
#include "step/stability.h"
#include "grid/grid_part.h"
#include "contact/contact.h"
#include "step/step.h"
#include "rigid/rigid_part.h"
#include "step/damping.h"
#include "step/viscosity.h"
#include "probes/diagnostics.h"

/* ---- columns ----------------------------------------------------------------------------------------------------- */

enum { RECORD_FIXED = 26 }; /* number of columns that all histories have */

/* History columns of all runs: name and unit; gaps are energies (run/ledger.h). */
static const struct column fixed_columns[RECORD_FIXED] = {[0] = {"time", "s"},
                                                          {"step", ""},
                                                          [7] = {"balance_error", ""},
                                                          {"momentum_x", "kg m/s"},
                                                          {"momentum_y", "kg m/s"},
                                                          {"momentum_z", "kg m/s"},
                                                          {"momentum_error", ""},
                                                          {"particles_pd", ""},
                                                          {"pd_share", ""},
                                                          {"bonds", ""},
                                                          {"crack_length", "m"},
                                                          {"tip_x", "m"},
                                                          {"tip_y", "m"},
                                                          {"tip_z", "m"},
                                                          [20] = {"mpm_share", ""},
                                                          {"inactive_share", ""},
                                                          [25] = {"crack_number", ""}};

/* Returns the mean fraction of the bodies that was at rest in the steps since the previous call [1]; 0 if there was no
 * step. clock: step counter; report: sums over the steps. The next call begins a new mean. */
static real inactive_since_sample(const struct run_clock *clock, struct run_report *report)
{
    const int64_t steps = clock->step - report->sampled.step;
    const real share = steps > 0 ? (report->inactive - report->sampled.inactive) / (real)steps : 0;
    report->sampled.inactive = report->inactive, report->sampled.step = clock->step;
    return share;
}

/* Returns true if angular momentum must be conserved: no boundary, rigid body or damping of scene s acts on the bodies.
 * Returns false also in 1D, for a static solver, and with coarse cells in `frame`, which
 * diagnostics_update_angular_momentum does not read. */
static bool is_free(const struct scene *s, const struct lagrangian_mesh *frame)
{
    return s->dim > 1 && scene_is_dynamic(s) && s->boundaries == 0 && s->rigids == 0 && s->damping == 0 &&
           frame->levels.n == 0;
}

/* Stores names and units of the history columns of angular momentum of scene s in column[], unless it is NULL. Returns
 * the number of columns, which is 0 if a load acts on the bodies, so that angular momentum need not be conserved.
 * frame: mesh of the run. */
static int spin_columns(const struct scene *s, const struct lagrangian_mesh *frame, struct column *column)
{
    static const char *const name[] = {"angular_momentum_x", "angular_momentum_y", "angular_momentum_z"};
    int n = 0;
    for (int d = s->dim == 2 ? 2 : 0; d < 3 && is_free(s, frame); d++, n++)
        if (column) column[n] = (struct column){.unit = "kg m^2/s"}, strcpy(column[n].name, name[d]);
    return n;
}

/* Fills run->report->record, one line of history.csv, from the completed sample of the run. */
static void fill_record(struct run *run)
{
    const struct energy_balance *l = &run->diagnostics->now;
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&run->fracture->tips);
    real *r = run->report->record;
    const real *place = tip ? tip->place : (const real[DIM_MAX]){NAN, NAN, NAN};
    const int dim = run->part.dim;
    const real n = (real)run->part.n_body, pd = (real)run->report->sampling.pd;
    const real fixed[RECORD_FIXED] = {[0] = l->time,
                                      (real)run->clock.step,
                                      [7] = l->balance_error,
                                      l->momentum[0],
                                      l->momentum[1],
                                      l->momentum[2],
                                      l->momentum_error,
                                      pd,
                                      pd / n,
                                      (real)run->report->sampling.bonds,
                                      tip ? tip->growth : 0,
                                      place[0],
                                      dim > 1 ? place[1] : NAN,
                                      dim > 2 ? place[2] : NAN,
                                      [20] = 1 - pd / n,
                                      inactive_since_sample(&run->clock, run->report),
                                      [25] = tip ? tip->number : 0};
    memcpy(r, fixed, sizeof fixed);
    for (int k = 0; k < ENERGIES; k++) r[ledger[k].column] = l->energy.of[k];
    r[ledger[LEDGER_WORK].column] = l->external_work;
    for (int c = 0; c < run->probing->probes.columns; c++) r[RECORD_FIXED + c] = run->probing->probes.value[c];
    r += RECORD_FIXED + run->probing->probes.columns;
    for (const struct part *const *p = run->parts; *p; p++) {
        if (!(*p)->columns) continue;
        (*p)->record(run, r);
        r += (*p)->columns(run, NULL);
    }
    for (int c = 0; c < spin_columns(run->scene, run->frame, NULL); c++) r[c] = l->spin[run->part.dim == 2 ? 2 : c];
}

/* Stores names and units of the history columns of probes, of the modules of the engine (struct part) and of angular
 * momentum in column[], unless it is NULL. Returns their number. run: the run. */
static int own_columns(const struct run *run, struct column *column)
{
    const struct probes *probes = &run->probing->probes;
    int n = probes->columns;
    for (int c = 0; c < probes->columns && column; c++) column[c] = probes->column[c];
    for (const struct part *const *p = run->parts; *p; p++)
        if ((*p)->columns) n += (*p)->columns(run, column ? column + n : NULL);
    return n + spin_columns(run->scene, run->frame, column ? column + n : NULL);
}

status history_sample_open_csv_file(struct run *run, bool resume)
{
    struct run_report *report = run->report;
    const int columns = RECORD_FIXED + own_columns(run, NULL);
    report->record = NEW("report.record", columns, real);
    if (!report->out) return OK;
    struct column *column = NEW("report.columns", columns, struct column);
    memcpy(column, fixed_columns, sizeof fixed_columns);
    for (int k = 0; k < LEDGER_ROWS; k++) {
        struct column *energy = &column[ledger[k].column];
        INVARIANT(energy->name[0] == 0);
        snprintf(energy->name, sizeof energy->name, "%s", ledger[k].name), strcpy(energy->unit, "J");
    }
    own_columns(run, column + RECORD_FIXED);
    status s = output_history_open(report->out, column, columns, resume);
    memory_free(column);
    return s;
}

/* ---- samples ----------------------------------------------------------------------------------------------------- */

/* Returns true if a probe of scene s reads stresses of peridynamic particles, which are computed only on demand. */
static bool wants_stress(const struct scene *s)
{
    for (int k = 0; k < s->probes; k++) {
        const struct probe_request *q = &s->probe[k];
        if (q->kind == PROBE_POINT || q->kind == PROBE_RIGID) return true;
        if (q->kind == PROBE_SIF && q->stress == SIF_PARTICLE) return true;
    }
    return false;
}

void run_update_particle_motion_and_stress(struct run *run)
{
    lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
}

/* Returns true if a probe of scene s reads positions or velocities of particles, so that points of a mesh must be
 * updated. */
static bool wants_motion(const struct scene *s)
{
    bool motion = false;
    for (int k = 0; k < s->probes; k++) {
        const enum probe_kind kind = s->probe[k].kind;
        motion |= kind != PROBE_TIP && kind != PROBE_BREAK && kind != PROBE_REACTION && kind != PROBE_GROWTH;
    }
    return motion;
}

/* Returns the present kinetic energy of particles and of mesh nodes of `reference` [J]. p: all particles. */
static real kinetic_now(const struct particles *p, const struct lagrangian_mesh *reference)
{
    return particles_kinetic_energy(p) + lagrangian_mesh_kinetic_energy(reference);
}

/* Stores the meshes of the undeformed body, whose nodes carry momentum, in nodes[]: the grid of the finest cells, then
 * those of the coarse cells. frame: the meshes. Returns the number of grids. */
static int meshes(const struct lagrangian_mesh *frame, const struct grid *nodes[LEVELS_MAX + 1])
{
    const struct mesh_levels *levels = &frame->levels;
    nodes[0] = &frame->mesh.grid;
    for (int level = 1; level <= levels->n; level++) nodes[level] = &levels->at[level].mesh.grid;
    return 1 + levels->n;
}

/* Computes the present momentum of all particles and of mesh nodes of `frame`, momentum[dim] [kg m/s]. p: all
 * particles. */
static void momentum_now(const struct particles *p, const struct lagrangian_mesh *frame, real *momentum)
{
    const struct grid *nodes[LEVELS_MAX + 1];
    const int grids = meshes(frame, nodes);
    particles_linear_momentum(p, nodes, grids, momentum, NULL);
}

/* Replaces momentum[dim], the momentum after the step [kg m/s], by the momentum at the time t [s] of a sample, which
 * is between two velocity updates: interpolates linearly between it and s->momentum, the momentum before the step.
 * now->t: time of the velocities after the step [s]; now->scale: factor on the result. */
static void momentum_at(const struct sampling *s, const struct velocity_time *now, real t, int dim, real *momentum)
{
    const real share = (t - s->t_velocity) / (now->t - s->t_velocity);
    for (int d = 0; d < dim; d++) momentum[d] = now->scale * ((1 - share) * s->momentum[d] + share * momentum[d]);
}

/* Records stress, momentum, crack tips and probes of the run at the present positions: all quantities of a sample (the
 * values that a line of history.csv has) except energies. */
static void sample_state(struct run *run)
{
    const struct grid *nodes[LEVELS_MAX + 1];
    const int grids = meshes(run->frame, nodes);
    if (wants_stress(run->scene)) bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
    rigids_store_motion_before_step(run->rigid, run->clock.t);
    diagnostics_update_momentum(run->diagnostics, &run->part, nodes, grids, run->loads.impulse);
    if (is_free(run->scene, run->frame))
        diagnostics_update_angular_momentum(run->diagnostics, &run->part,
                                            run->frame->mesh.points > 0 ? &run->frame->mesh : NULL, run->scene->bodies);
    tips_update_from_damage(&run->fracture->tips, &run->part, &run->cells, run->clock.t);
    tips_snap_onto_mirror_planes_they_grow_along(&run->fracture->tips, run->source.mirror, run->source.mirrors);
    struct observed_run o = observed_run_make_read_only_view(run);
    probes_sample_position_dependent_values(&run->probing->probes, &o);
}

real run_compute_elastic_energy(struct run *run)
{
    return run->kernels.bond_energy(&run->bonds, &run->part, NULL) +
           points_strain_energy(&run->part, run->scene->material, &run->coupling->partial) +
           lagrangian_mesh_strain_energy(run->frame, &run->part);
}

/* Computes the energies of a sample (a line of history.csv) of the run at the present positions, except the kinetic
 * energy, in run->report->sampling.energy [J]. */
static void sample_energies(struct run *run)
{
    const struct material *m = run->scene->material;
    run->report->sampling.pd = run->part.n_of[KIND_PD], run->report->sampling.bonds = run->bonds.n;
    run->report->sampling.energy = (struct energy){
        .strain = run_compute_elastic_energy(run),
        .plastic = bond_plastic_work(&run->bonds) + points_plastic_work(&run->part, m, &run->coupling->partial),
        .fracture = bonds_fracture_energy(&run->bonds),
        .contact = contact_elastic_energy(run->contact, &run->part),
        .damped = run->damped + contact_friction_dissipated_energy(run->contact),
        .absorbed = run->loads.absorbing.energy,
        .viscous = run->viscosity->taken,
    };
    const struct observed_run o = observed_run_make_read_only_view(run);
    probes_sample_energies(&run->probing->probes, &o);
}

/* Completes a sample of the run with the quantities that require velocities after the step, and writes it as a line of
 * history.csv. The number of peridynamic particles of the first sample is that of the start in the summary. now: time
 * of these velocities and factor on them; kinetic, work: kinetic energy and external work of the sample [J]. If an
 * energy is not finite, writes no line and sets run->stability->lost. */
static void sample_write(struct run *run, const struct velocity_time *now, real kinetic, real work)
{
    struct sampling *sampling = &run->report->sampling;
    if (wants_motion(run->scene)) lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    struct observed_run o = observed_run_make_read_only_view(run);
    probes_sample_velocity_dependent_values(&run->probing->probes, &o, now);
    probes_warn_of_meaningless_sif(&run->probing->probes, scene_is_single_equilibrium(run->scene), o.t, &run->warnings);
    if (!run->diagnostics->started) run->coupling->conversion.start = sampling->pd;
    if (scene_is_dynamic(run->scene)) {
        momentum_now(&run->part, run->frame, run->diagnostics->now.momentum);
        momentum_at(sampling, now, run->clock.t, run->part.dim, run->diagnostics->now.momentum);
    }
    sampling->energy.kinetic = kinetic;
    run->stability->lost = !isfinite(energy_sum(&sampling->energy) + work);
    if (run->stability->lost)
        return; /* no line is written; run_check_last_sample_for_energy_divergence reports the failure */
    diagnostics_update_energy_balance(run->diagnostics, run->clock.t, &sampling->energy, work);
    fill_record(run);
    if (run->report->out && run->report->history_status == OK)
        run->report->history_status = output_write_history(run->report->out, run->report->record);
}

/* Copies the velocities of p at the start of a step to sampling->before if the grid moves particles. The energies of
 * samples need them, since the grid changes velocities without forces on particles. kind: coupling method. */
static void keep_velocities(struct sampling *sampling, const struct particles *p, enum coupling kind)
{
    if (p->n_free == 0 && !coupling_moves_pd_particles_by_grid(kind)) return;
    for (int d = 0; d < p->dim; d++) {
        if (!sampling->before[d]) sampling->before[d] = BARE("report.before", p->n, real);
        array_copy(sampling->before[d], p->v[d], p->n, sizeof(real));
    }
}

/* Returns the correction that a sample of the run subtracts from the kinetic energy [J]: the mean of m v^2/2 before and
 * after the velocity update of the step, minus m v_before . v_after/2, the value that leap-frog conserves. Absorbing
 * dashpots, which act during the update, are left out. */
static real kick_now(const struct run *run)
{
    const bool grid = run->part.n_free > 0 || coupling_moves_pd_particles_by_grid(run->coupling_kind);
    const real dt = run->grid->transfer.dt_velocity;
    return particles_mean_minus_leapfrog_kinetic_energy(&run->part, grid ? run->report->sampling.before : NULL, dt) +
           mesh_kick(&run->frame->mesh, dt) + mesh_levels_leapfrog_kinetic_energy_correction(&run->frame->levels, dt) -
           run->loads.absorbing.kick;
}

void history_sample_begin_before_step_if_due(struct run *run)
{
    struct sampling *sampling = &run->report->sampling;
    sampling->due = report_history_sample_is_due(run->scene, &run->clock);
    sampling->work = run->loads.work;
    sampling->constraint_work = run->loads.constraint_work;
    sampling->absorbed = run->loads.absorbing.energy;
    if (!sampling->due && run->clock.step < run->clock.steps - 1) return;
    if (wants_motion(run->scene)) lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    if (sampling->due)
        sample_state(run), rigids_warn_of_overlap(run->rigid, run->scene->spacing, run->clock.t, &run->warnings);
    else if (wants_stress(run->scene))
        bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
    struct observed_run o = observed_run_make_read_only_view(run);
    probes_store_motion_before_step(&run->probing->probes, &o);
    keep_velocities(sampling, &run->part, run->coupling_kind);
    sampling->t_velocity = o.t_velocity;
    if (sampling->due) /* sample_state has computed it */
        array_copy(sampling->momentum, run->diagnostics->now.momentum, run->part.dim, sizeof(real));
    else
        momentum_now(&run->part, run->frame, sampling->momentum);
    sampling->kinetic = kinetic_now(&run->part, run->frame);
    sampling->rigid = rigids_compute_energy(run->rigid, run->clock.dt).before;
}

void history_sample_compute_energies(struct run *run)
{
    if (!run->report->sampling.due) return;
    sample_energies(run);
    run->report->sampling.rigid_work = rigids_compute_energy(run->rigid, run->clock.dt).work;
}

/* Returns true if a boundary of scene s prescribes a velocity other than 0, so that velocities jump in the first
 * step. */
static bool velocity_jumps(const struct scene *s)
{
    bool drives = false;
    for (int b = 0; b < s->boundaries; b++)
        drives |=
            s->boundary[b].kind == BOUNDARY_VELOCITY && dot(s->boundary[b].value, s->boundary[b].value, s->dim) > 0;
    return drives;
}

/* Returns true if forces alone change velocities in the first step of scene s. With material points on the grid, APIC,
 * prescribed velocities other than 0 and contact between bodies on the grid change them as well. p: all particles. */
static bool start_separable(const struct scene *s, const struct particles *p, const struct grid_method *grid)
{
    return p->n_free == 0 || (s->transfer == TRANSFER_FLIP && !velocity_jumps(s) && grid->contact.touching == 0);
}

void history_sample_complete_after_step_if_due(struct run *run)
{
    struct sampling *sampling = &run->report->sampling;
    const bool first = run->clock.step == 0;
    const real share = damping_velocity_increment_factor(run->scene->damping * run->clock.dt);
    const struct velocity_time now = {run->clock.t + 0.5 * run->clock.dt, first ? 1 : 1 / share};
    if (!sampling->due) return;
    if (first) { /* the stored velocities are of t = 0, and nothing is damped yet */
        sampling->energy.damped = sampling->energy.absorbed = 0;
        sample_write(run, &now, sampling->kinetic + sampling->rigid, sampling->work);
        /* leap-frog conserves 1/2 m v- . v+ with v+- = v +- a dt/2; at t = 0 the sample has 1/2 m v^2 */
        if (start_separable(run->scene, &run->part, run->grid))
            run->diagnostics->energy_start -= 2 * kick_now(run) / share;
        return;
    }
    real kinetic = 0.5 * (sampling->kinetic + kinetic_now(&run->part, run->frame)) - kick_now(run);
    sampling->energy.damped += run->grid->contact.begun;
    sampling->energy.absorbed = 0.5 * (sampling->absorbed + run->loads.absorbing.energy);
    const struct rigid_energy rigid = rigids_compute_energy(run->rigid, run->clock.dt);
    rigids_average_stored_and_current_velocities(run->rigid);
    sample_write(run, &now, kinetic / share + rigid.step,
                 sampling->work + sampling->rigid_work +
                     0.5 * (sampling->constraint_work + run->loads.constraint_work));
}

void history_sample_write_in_equilibrium(struct run *run)
{
    sample_state(run);
    sample_energies(run);
    sample_write(run, &(struct velocity_time){run->clock.t, 1}, 0,
                 run->loads.work + run->loads.constraint_work + rigids_compute_energy(run->rigid, run->clock.dt).work);
}

/* Returns the power v . f [W] of the forces on those particles p that bonds move, and on the nodes of the mesh of the
 * undeformed body in `reference`, coarse cells included. */
static real power_now(const struct particles *p, const struct lagrangian_mesh *reference)
{
    const struct grid *g = &reference->mesh.grid;
    real power = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        for (int d = 0; d < p->dim && !particle_is_moved_by_grid_or_mesh_nodes(p, i); d++)
            power += p->v[d][i] * p->f[d][i];
    }
    for (int64_t I = 0; I < g->n && reference->mesh.points > 0; I++)
        for (int d = 0; d < p->dim; d++) power += g->velocity[d][I] * g->force[d][I];
    return power + mesh_levels_power_of_coarse_nodal_forces(&reference->levels);
}

/* Returns the power v . f [W] of the forces on nodes of the mesh `reference` whose motion loads prescribe (walls).
 * power_now includes this power, which is work of the loads. */
static real power_of_walls(const struct lagrangian_mesh *reference)
{
    const struct mesh_levels *levels = &reference->levels;
    real power = 0;
    for (int level = 0; level <= levels->n && reference->mesh.points > 0; level++) {
        const struct grid *g = level > 0 ? &levels->at[level].mesh.grid : &reference->mesh.grid;
        for (int64_t k = 0; k < g->walls; k++) {
            const int d = g->wall[k].component;
            const int64_t I = g->wall[k].node;
            power += (real)(1 << level) * g->velocity[d][I] * g->force[d][I];
        }
    }
    return power;
}

/* Subtracts the forces on nodes of the grid g with prescribed motion from the reactions of the loads l [N]. */
static void reactions_add(struct loads *l, const struct grid *g)
{
    for (int64_t k = 0; k < g->walls; k++)
        l->load[g->wall[k].load].reaction[g->wall[k].component] -= g->force[g->wall[k].component][g->wall[k].node];
}

/* Adds the forces on nodes with prescribed motion at the end of the run to the reactions of their loads in l [N],
 * after those on particles. grid: grids of the current frame (background grid of material points), or NULL if no
 * particle is on them; frame: mesh of the reference frame; clock: time step and its number. */
static void reactions_at_end(struct loads *l, const struct grid_method *grid, const struct lagrangian_mesh *frame,
                             const struct run_clock *clock)
{
    for (int k = 0; grid && k < grid->fields; k++)
        loads_add_reactions_at_grid_nodes(l, &grid->field[k].grid, clock->dt);
    if (frame->mesh.points == 0) return;
    reactions_add(l, &frame->mesh.grid);
    for (int level = 1; level <= mesh_levels_coarsest_level_integrated_in_step(&frame->levels, clock->step); level++)
        reactions_add(l, &frame->levels.at[level].mesh.grid);
}

/* Returns the power v . f [W] of the forces at the end of the run. The forces are computed as in a further step, in
 * which nothing moves, no bond breaks, and the loads keep their sums of energies and impulses; only reactions are
 * updated. The power includes the work on particles with prescribed motion, not that on nodes. *held: receives the
 * work that grid and mesh nodes with prescribed motion would do in this step [J]. */
static real power_last(struct run *run, real *held)
{
    struct memory_archive accounts;
    const real before = run->loads.constraint_work, kick = run->loads.absorbing.kick;
    const real dt_velocity = run->clock.dt * damping_velocity_increment_factor(run->scene->damping * run->clock.dt);
    memory_archive_open_for_saving(&accounts, ARCHIVE_ACCOUNTS);
    INVARIANT(loads_save_or_load(&run->loads, &accounts.archive) == OK);
    run->loads.absorbing.idle = run->loads.ended = true;
    loads_clear_forces_of_loaded_particles(&run->loads, &run->part);
    bond_forces(run->kernels.bond_force, &run->bonds, &run->part, &bond_limit_never, NULL);
    contact_compute_forces(run->contact, &run->part, 0);
    loads_apply_forces_and_motion_constraints(&run->loads, &run->part, run->clock.t + 0.5 * run->clock.dt,
                                              run->clock.dt, dt_velocity);
    if (run->frame->mesh.points > 0) lagrangian_mesh_compute_nodal_forces(run->frame, &run->part, run->clock.step);
    const real power = power_now(&run->part, run->frame) +
                       grid_power_of_forces_on_material_points(run, run->clock.t + 0.5 * run->clock.dt);
    const real walls = power_of_walls(run->frame);
    *held = run->loads.constraint_work - before - run->clock.dt * walls;
    const bool on_grid = run->part.n_free + run->part.n_grid_coupled > 0;
    reactions_at_end(&run->loads, on_grid ? run->grid : NULL, run->frame, &run->clock);
    memory_archive_rewind_for_loading(&accounts);
    INVARIANT(loads_save_or_load(&run->loads, &accounts.archive) == OK);
    memory_archive_free(&accounts);
    run->loads.absorbing.kick = kick;
    run->loads.absorbing.idle = run->loads.ended = false;
    return power - walls;
}

/* Writes the last line of history.csv (a sample of energies, probes and crack tips) of the run after the last step. As
 * in all lines, the kinetic energy is m v- . v+/2, with the velocities v- and v+ before and after a velocity update,
 * here by the last forces. */
void history_sample_write_after_last_step(struct run *run)
{
    real held = 0;
    families_compute_pressure_rotation_and_stiffness(&run->bonds, &run->part, &run->source);
    if (run->source.limit.softening && !run->source.modulus) bonds_update_softening(&run->bonds, &run->part);
    lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    sample_state(run);
    sample_energies(run);
    real kinetic = kinetic_now(&run->part, run->frame), before = kinetic;
    const real decay = run->scene->damping * run->clock.dt, share = damping_velocity_increment_factor(decay),
               kick = run->clock.dt * share;
    if (scene_is_dynamic(run->scene)) kinetic += 0.5 * kick * power_last(run, &held);
    if (run->clock.step > 0)
        run->report->sampling.energy.damped += damping_energy_loss_in_last_velocity_update(decay, before, kinetic);
    run->report->sampling.energy.damped += run->grid->contact.begun;
    const struct rigid_energy rigid = rigids_compute_energy(run->rigid, run->clock.dt);
    const struct velocity_time now = {run->clock.t - 0.5 * run->clock.dt, 1 / square(share)};
    rigids_extrapolate_stored_velocities_to_time(run->rigid, run->clock.t, run->clock.dt);
    sample_write(run, &now, kinetic / share + rigid.last,
                 run->loads.work + run->loads.constraint_work + rigid.work + 0.5 * held);
}
