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

/* Fills e->report->record, one line of history.csv, from the completed sample of the run e. */
static void fill_record(struct run *e)
{
    const struct energy_balance *l = &e->diagnostics->now;
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&e->fracture->tips);
    real *r = e->report->record;
    const real *place = tip ? tip->place : (const real[DIM_MAX]){NAN, NAN, NAN};
    const int dim = e->part.dim;
    const real n = (real)e->part.n_body, pd = (real)e->report->sampling.pd;
    const real fixed[RECORD_FIXED] = {[0] = l->time,
                                      (real)e->clock.step,
                                      [7] = l->balance_error,
                                      l->momentum[0],
                                      l->momentum[1],
                                      l->momentum[2],
                                      l->momentum_error,
                                      pd,
                                      pd / n,
                                      (real)e->report->sampling.bonds,
                                      tip ? tip->growth : 0,
                                      place[0],
                                      dim > 1 ? place[1] : NAN,
                                      dim > 2 ? place[2] : NAN,
                                      [20] = 1 - pd / n,
                                      inactive_since_sample(&e->clock, e->report),
                                      [25] = tip ? tip->number : 0};
    memcpy(r, fixed, sizeof fixed);
    for (int k = 0; k < ENERGIES; k++) r[ledger[k].column] = l->energy.of[k];
    r[ledger[LEDGER_WORK].column] = l->external_work;
    for (int c = 0; c < e->probing->probes.columns; c++) r[RECORD_FIXED + c] = e->probing->probes.value[c];
    r += RECORD_FIXED + e->probing->probes.columns;
    for (const struct part *const *p = e->parts; *p; p++) {
        if (!(*p)->columns) continue;
        (*p)->record(e, r);
        r += (*p)->columns(e, NULL);
    }
    for (int c = 0; c < spin_columns(e->scene, e->frame, NULL); c++) r[c] = l->spin[e->part.dim == 2 ? 2 : c];
}

/* Stores names and units of the history columns of probes, of the modules of the engine (struct part) and of angular
 * momentum in column[], unless it is NULL. Returns their number. e: the run. */
static int own_columns(const struct run *e, struct column *column)
{
    const struct probes *probes = &e->probing->probes;
    int n = probes->columns;
    for (int c = 0; c < probes->columns && column; c++) column[c] = probes->column[c];
    for (const struct part *const *p = e->parts; *p; p++)
        if ((*p)->columns) n += (*p)->columns(e, column ? column + n : NULL);
    return n + spin_columns(e->scene, e->frame, column ? column + n : NULL);
}

status history_sample_open_csv_file(struct run *e, bool resume)
{
    struct run_report *report = e->report;
    const int columns = RECORD_FIXED + own_columns(e, NULL);
    report->record = NEW("report.record", columns, real);
    if (!report->out) return OK;
    struct column *column = NEW("report.columns", columns, struct column);
    memcpy(column, fixed_columns, sizeof fixed_columns);
    for (int k = 0; k < LEDGER_ROWS; k++) {
        struct column *energy = &column[ledger[k].column];
        INVARIANT(energy->name[0] == 0);
        snprintf(energy->name, sizeof energy->name, "%s", ledger[k].name), strcpy(energy->unit, "J");
    }
    own_columns(e, column + RECORD_FIXED);
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

void run_update_particle_motion_and_stress(struct run *e)
{
    lagrangian_mesh_update_point_motion_and_stress(e->frame, &e->part, &e->loads);
    bonds_compute_particle_stress(&e->bonds, &e->part, &e->source, &e->kernels);
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

/* Records stress, momentum, crack tips and probes of run e at the present positions: all quantities of a sample (the
 * values that a line of history.csv has) except energies. */
static void sample_state(struct run *e)
{
    const struct grid *nodes[LEVELS_MAX + 1];
    const int grids = meshes(e->frame, nodes);
    if (wants_stress(e->scene)) bonds_compute_particle_stress(&e->bonds, &e->part, &e->source, &e->kernels);
    rigids_store_motion_before_step(e->rigid, e->clock.t);
    diagnostics_update_momentum(e->diagnostics, &e->part, nodes, grids, e->loads.impulse);
    if (is_free(e->scene, e->frame))
        diagnostics_update_angular_momentum(e->diagnostics, &e->part,
                                            e->frame->mesh.points > 0 ? &e->frame->mesh : NULL, e->scene->bodies);
    tips_update_from_damage(&e->fracture->tips, &e->part, &e->cells, e->clock.t);
    tips_snap_onto_mirror_planes_they_grow_along(&e->fracture->tips, e->source.mirror, e->source.mirrors);
    struct observed_run o = observed_run_make_read_only_view(e);
    probes_sample_position_dependent_values(&e->probing->probes, &o);
}

real run_compute_elastic_energy(struct run *e)
{
    return e->kernels.bond_energy(&e->bonds, &e->part, NULL) +
           points_strain_energy(&e->part, e->scene->material, &e->coupling->partial) +
           lagrangian_mesh_strain_energy(e->frame, &e->part);
}

/* Computes the energies of a sample (a line of history.csv) of run e at the present positions, except the kinetic
 * energy, in e->report->sampling.energy [J]. */
static void sample_energies(struct run *e)
{
    const struct material *m = e->scene->material;
    e->report->sampling.pd = e->part.n_of[KIND_PD], e->report->sampling.bonds = e->bonds.n;
    e->report->sampling.energy = (struct energy){
        .strain = run_compute_elastic_energy(e),
        .plastic = bond_plastic_work(&e->bonds) + points_plastic_work(&e->part, m, &e->coupling->partial),
        .fracture = bonds_fracture_energy(&e->bonds),
        .contact = contact_elastic_energy(e->contact, &e->part),
        .damped = e->damped + contact_friction_dissipated_energy(e->contact),
        .absorbed = e->loads.absorbing.energy,
        .viscous = e->viscosity->taken,
    };
    const struct observed_run o = observed_run_make_read_only_view(e);
    probes_sample_energies(&e->probing->probes, &o);
}

/* Completes a sample of run e with the quantities that require velocities after the step, and writes it as a line of
 * history.csv. The number of peridynamic particles of the first sample is that of the start in the summary. now: time
 * of these velocities and factor on them; kinetic, work: kinetic energy and external work of the sample [J]. If an
 * energy is not finite, writes no line and sets e->stability->lost. */
static void sample_write(struct run *e, const struct velocity_time *now, real kinetic, real work)
{
    struct sampling *sampling = &e->report->sampling;
    if (wants_motion(e->scene)) lagrangian_mesh_update_point_motion_and_stress(e->frame, &e->part, &e->loads);
    struct observed_run o = observed_run_make_read_only_view(e);
    probes_sample_velocity_dependent_values(&e->probing->probes, &o, now);
    probes_warn_of_meaningless_sif(&e->probing->probes, scene_is_single_equilibrium(e->scene), o.t, &e->warnings);
    if (!e->diagnostics->started) e->coupling->conversion.start = sampling->pd;
    if (scene_is_dynamic(e->scene)) {
        momentum_now(&e->part, e->frame, e->diagnostics->now.momentum);
        momentum_at(sampling, now, e->clock.t, e->part.dim, e->diagnostics->now.momentum);
    }
    sampling->energy.kinetic = kinetic;
    e->stability->lost = !isfinite(energy_sum(&sampling->energy) + work);
    if (e->stability->lost)
        return; /* no line is written; run_check_last_sample_for_energy_divergence reports the failure */
    diagnostics_update_energy_balance(e->diagnostics, e->clock.t, &sampling->energy, work);
    fill_record(e);
    if (e->report->out && e->report->history_status == OK)
        e->report->history_status = output_write_history(e->report->out, e->report->record);
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

/* Returns the correction that a sample of run e subtracts from the kinetic energy [J]: the mean of m v^2/2 before and
 * after the velocity update of the step, minus m v_before . v_after/2, the value that leap-frog conserves. Absorbing
 * dashpots, which act during the update, are left out. */
static real kick_now(const struct run *e)
{
    const bool grid = e->part.n_free > 0 || coupling_moves_pd_particles_by_grid(e->coupling_kind);
    const real dt = e->grid->transfer.dt_velocity;
    return particles_mean_minus_leapfrog_kinetic_energy(&e->part, grid ? e->report->sampling.before : NULL, dt) +
           mesh_kick(&e->frame->mesh, dt) + mesh_levels_leapfrog_kinetic_energy_correction(&e->frame->levels, dt) -
           e->loads.absorbing.kick;
}

void history_sample_begin_before_step(struct run *e)
{
    struct sampling *sampling = &e->report->sampling;
    sampling->due = report_history_sample_is_due(e->scene, &e->clock);
    sampling->work = e->loads.work;
    sampling->constraint_work = e->loads.constraint_work;
    sampling->absorbed = e->loads.absorbing.energy;
    if (!sampling->due && e->clock.step < e->clock.steps - 1) return;
    if (wants_motion(e->scene)) lagrangian_mesh_update_point_motion_and_stress(e->frame, &e->part, &e->loads);
    if (sampling->due)
        sample_state(e), rigids_warn_of_overlap(e->rigid, e->scene->spacing, e->clock.t, &e->warnings);
    else if (wants_stress(e->scene))
        bonds_compute_particle_stress(&e->bonds, &e->part, &e->source, &e->kernels);
    struct observed_run o = observed_run_make_read_only_view(e);
    probes_store_motion_before_step(&e->probing->probes, &o);
    keep_velocities(sampling, &e->part, e->coupling_kind);
    sampling->t_velocity = o.t_velocity;
    if (sampling->due) /* sample_state has computed it */
        array_copy(sampling->momentum, e->diagnostics->now.momentum, e->part.dim, sizeof(real));
    else
        momentum_now(&e->part, e->frame, sampling->momentum);
    sampling->kinetic = kinetic_now(&e->part, e->frame);
    sampling->rigid = rigids_compute_energy(e->rigid, e->clock.dt).before;
}

void history_sample_compute_energies(struct run *e)
{
    if (!e->report->sampling.due) return;
    sample_energies(e);
    e->report->sampling.rigid_work = rigids_compute_energy(e->rigid, e->clock.dt).work;
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

void history_sample_complete_after_step(struct run *e)
{
    struct sampling *sampling = &e->report->sampling;
    const bool first = e->clock.step == 0;
    const real share = damping_velocity_increment_factor(e->scene->damping * e->clock.dt);
    const struct velocity_time now = {e->clock.t + 0.5 * e->clock.dt, first ? 1 : 1 / share};
    if (!sampling->due) return;
    if (first) { /* the stored velocities are of t = 0, and nothing is damped yet */
        sampling->energy.damped = sampling->energy.absorbed = 0;
        sample_write(e, &now, sampling->kinetic + sampling->rigid, sampling->work);
        /* leap-frog conserves 1/2 m v- . v+ with v+- = v +- a dt/2; at t = 0 the sample has 1/2 m v^2 */
        if (start_separable(e->scene, &e->part, e->grid)) e->diagnostics->energy_start -= 2 * kick_now(e) / share;
        return;
    }
    real kinetic = 0.5 * (sampling->kinetic + kinetic_now(&e->part, e->frame)) - kick_now(e);
    sampling->energy.damped += e->grid->contact.begun;
    sampling->energy.absorbed = 0.5 * (sampling->absorbed + e->loads.absorbing.energy);
    const struct rigid_energy rigid = rigids_compute_energy(e->rigid, e->clock.dt);
    rigids_average_stored_and_current_velocities(e->rigid);
    sample_write(e, &now, kinetic / share + rigid.step,
                 sampling->work + sampling->rigid_work + 0.5 * (sampling->constraint_work + e->loads.constraint_work));
}

void history_sample_write_in_equilibrium(struct run *e)
{
    sample_state(e);
    sample_energies(e);
    sample_write(e, &(struct velocity_time){e->clock.t, 1}, 0,
                 e->loads.work + e->loads.constraint_work + rigids_compute_energy(e->rigid, e->clock.dt).work);
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
    for (int k = 0; grid && k < grid->fields; k++) loads_add_grid_reactions(l, &grid->field[k].grid, clock->dt);
    if (frame->mesh.points == 0) return;
    reactions_add(l, &frame->mesh.grid);
    for (int level = 1; level <= mesh_levels_coarsest_level_integrated_in_step(&frame->levels, clock->step); level++)
        reactions_add(l, &frame->levels.at[level].mesh.grid);
}

/* Returns the power v . f [W] of the forces at the end of run e. The forces are computed as in a further step, in
 * which nothing moves, no bond breaks, and the loads keep their sums of energies and impulses; only reactions are
 * updated. The power includes the work on particles with prescribed motion, not that on nodes. *held: receives the
 * work that grid and mesh nodes with prescribed motion would do in this step [J]. */
static real power_last(struct run *e, real *held)
{
    struct memory_archive accounts;
    const real before = e->loads.constraint_work, kick = e->loads.absorbing.kick;
    const real dt_velocity = e->clock.dt * damping_velocity_increment_factor(e->scene->damping * e->clock.dt);
    memory_archive_open_for_saving(&accounts, ARCHIVE_ACCOUNTS);
    INVARIANT(loads_save_or_load(&e->loads, &accounts.archive) == OK);
    e->loads.absorbing.idle = e->loads.ended = true;
    loads_clear_forces_of_loaded_particles(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &bond_limit_never, NULL);
    contact_compute_forces(e->contact, &e->part, 0);
    loads_apply_forces_and_motion_constraints(&e->loads, &e->part, e->clock.t + 0.5 * e->clock.dt, e->clock.dt,
                                              dt_velocity);
    if (e->frame->mesh.points > 0) lagrangian_mesh_compute_nodal_forces(e->frame, &e->part, e->clock.step);
    const real power =
        power_now(&e->part, e->frame) + grid_power_of_forces_on_material_points(e, e->clock.t + 0.5 * e->clock.dt);
    const real walls = power_of_walls(e->frame);
    *held = e->loads.constraint_work - before - e->clock.dt * walls;
    const bool on_grid = e->part.n_free + e->part.n_grid_coupled > 0;
    reactions_at_end(&e->loads, on_grid ? e->grid : NULL, e->frame, &e->clock);
    memory_archive_rewind_for_loading(&accounts);
    INVARIANT(loads_save_or_load(&e->loads, &accounts.archive) == OK);
    memory_archive_free(&accounts);
    e->loads.absorbing.kick = kick;
    e->loads.absorbing.idle = e->loads.ended = false;
    return power - walls;
}

/* Writes the last line of history.csv (a sample of energies, probes and crack tips) of run e after the last step. As
 * in all lines, the kinetic energy is m v- . v+/2, with the velocities v- and v+ before and after a velocity update,
 * here by the last forces. */
void history_sample_write_after_last_step(struct run *e)
{
    real held = 0;
    families_compute_pressure_stiffness_and_rotation(&e->bonds, &e->part, &e->source);
    if (e->source.limit.softening && !e->source.modulus) bonds_update_softening(&e->bonds, &e->part);
    lagrangian_mesh_update_point_motion_and_stress(e->frame, &e->part, &e->loads);
    sample_state(e);
    sample_energies(e);
    real kinetic = kinetic_now(&e->part, e->frame), before = kinetic;
    const real decay = e->scene->damping * e->clock.dt, share = damping_velocity_increment_factor(decay),
               kick = e->clock.dt * share;
    if (scene_is_dynamic(e->scene)) kinetic += 0.5 * kick * power_last(e, &held);
    if (e->clock.step > 0)
        e->report->sampling.energy.damped += damping_energy_loss_in_last_velocity_update(decay, before, kinetic);
    e->report->sampling.energy.damped += e->grid->contact.begun;
    const struct rigid_energy rigid = rigids_compute_energy(e->rigid, e->clock.dt);
    const struct velocity_time now = {e->clock.t - 0.5 * e->clock.dt, 1 / square(share)};
    rigids_extrapolate_stored_velocities_to_time(e->rigid, e->clock.t, e->clock.dt);
    sample_write(e, &now, kinetic / share + rigid.last,
                 e->loads.work + e->loads.constraint_work + rigid.work + 0.5 * held);
}
