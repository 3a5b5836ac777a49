/* Samples, frames, checkpoints and the progress line of a run. */
#include "engine_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "output/output_files.h"

#define PROGRESS_SECONDS 0.5             /* between progress lines on a terminal */
#define PROGRESS_SECONDS_FILE 60.0       /* and in files                         */

/* ---- schedule ---------------------------------------------------------------------------------------------------- */

/* Step of event k of n evenly spread over the run. */
static int64_t due_step(const struct engine *e, int64_t k, int64_t n)
{
    return n > 0 ? (k * e->steps + n / 2) / n : e->steps;
}

/* Step of frame k after the one at t = 0: nearest to its time, or evenly spread. A step writes one frame at the most,
 * so frames closer than a step are moved apart and keep their number. */
static int64_t frame_step(const struct engine *e, int64_t k, int64_t n)
{
    const struct number_list *times = &e->scene->times;
    if (times->n == 0 || k < 1) return due_step(e, k, n);
    int64_t step = k <= n ? (int64_t)floor(times->value[k - 1] / e->dt + 0.5) : e->steps, last = e->steps - (n - k);
    return step < k ? k : step > last ? last : step;
}

static bool sample_due(const struct engine *e)
{
    const int64_t n = e->scene->samples < e->steps ? e->scene->samples : e->steps;
    if (e->scene->solver != SOLVER_EXPLICIT) return e->step == 0;    /* and the equilibrium, at the end */
    return due_step(e, (e->step * n + e->steps / 2) / e->steps, n) == e->step;
}

/* ---- columns ----------------------------------------------------------------------------------------------------- */

enum { RECORD_FIXED = 22 };

static const struct column fixed_columns[RECORD_FIXED] = {
    {"time", "s"}, {"step", ""}, {"kinetic", "J"}, {"strain", "J"}, {"plastic", "J"}, {"fracture", "J"},
    {"external_work", "J"}, {"balance_error", ""}, {"momentum_x", "kg m/s"}, {"momentum_y", "kg m/s"},
    {"momentum_z", "kg m/s"}, {"momentum_error", ""}, {"particles_pd", ""}, {"pd_share", ""}, {"bonds", ""},
    {"crack_length", "m"}, {"tip_x", "m"}, {"tip_y", "m"}, {"tip_z", "m"}, {"damped", "J"}, {"mpm_share", ""},
    {"rest_share", ""}};

/* Mean inactive share of the body over the steps since the last sample; 0 where there was none. */
static real inactive_since_sample(struct engine *e)
{
    const int64_t steps = e->step - e->sampled.step;
    const real share = steps > 0 ? (e->inactive - e->sampled.inactive) / (real)steps : 0;
    e->sampled.inactive = e->inactive, e->sampled.step = e->step;
    return share;
}

/* Fills one line of history.csv, e->record [RECORD_FIXED + columns of probes]. */
static void fill_record(struct engine *e)
{
    const struct energy_balance *l = &e->diagnostics.now;
    const struct energy *u = &l->energy;
    const struct tip *tip = tips_longest(&e->tips);
    real *r = e->record;
    const real fixed[RECORD_FIXED] = {
        l->time, (real)e->step, u->kinetic, u->strain, u->plastic, u->fracture, l->external_work, l->balance_error,
        l->momentum[0], l->momentum[1], l->momentum[2], l->momentum_error, (real)e->part.n_of[KIND_PD],
        (real)e->part.n_of[KIND_PD] / (real)e->part.n, (real)e->bonds.n, tip ? tip->growth : 0,
        tip ? tip->place[0] : NAN, tip && e->part.dim > 1 ? tip->place[1] : NAN,
        tip && e->part.dim > 2 ? tip->place[2] : NAN, u->damped,
        (real)e->part.n_of[KIND_MPM] / (real)e->part.n, inactive_since_sample(e)};
    memcpy(r, fixed, sizeof fixed);
    for (int c = 0; c < e->probes.columns; c++) r[RECORD_FIXED + c] = e->probes.value[c];
}

static status history_start(struct engine *e, bool resume)
{
    int columns = RECORD_FIXED + e->probes.columns;
    struct column *column = NEW("report.columns", columns, struct column);
    memcpy(column, fixed_columns, sizeof fixed_columns);
    for (int c = 0; c < e->probes.columns; c++) column[RECORD_FIXED + c] = e->probes.column[c];
    status s = output_history_open(e->out, column, columns, resume);
    memory_free(column);
    return s;
}

/* ---- samples ----------------------------------------------------------------------------------------------------- */

/* True if a probe uses stresses of peridynamic particles, which are computed only then. */
static bool wants_stress(const struct engine *e)
{
    for (int k = 0; k < e->scene->probes; k++) {
        const struct probe_request *q = &e->scene->probe[k];
        if (q->kind == PROBE_POINT || q->kind == PROBE_RIGID) return true;
        if (q->kind == PROBE_SIF && q->stress == SIF_PARTICLE) return true;
    }
    return false;
}

/* State precompute at the current positions. A step moves particles after its forces, so that stresses in a turning
 * body would else include the rotation of a step. */
static void refresh_states(struct engine *e)
{
    states_precompute(&e->bonds, &e->part, &e->source);
}

void engine_stress(struct engine *e)
{
    refresh_states(e);
    e->kernels.bond_stress(&e->bonds, &e->part);
}

void engine_sync(struct engine *e)
{
    engine_mesh_sync(e);
    engine_stress(e);
}

/* Updates the points of a mesh for probes of the motion of particles; damage and bonds are always up to date. */
static void sync_probes(struct engine *e)
{
    bool motion = false;
    for (int k = 0; k < e->scene->probes; k++) {
        const enum probe_kind kind = e->scene->probe[k].kind;
        motion |= kind != PROBE_TIP && kind != PROBE_BREAK && kind != PROBE_REACTION && kind != PROBE_GROWTH;
    }
    if (motion) engine_mesh_sync(e);
}

static real kinetic_now(const struct engine *e) { return diagnostics_kinetic(&e->part) + mesh_kinetic(&e->mesh); }

/* Samples all quantities but energies: stress, momentum, tips, probes. */
static void sample_state(struct engine *e)
{
    if (wants_stress(e)) engine_stress(e);
    diagnostics_momentum(&e->diagnostics, &e->part, &e->mesh.grid, e->loads.impulse);
    tips_sample(&e->tips, &e->part, &e->cells, e->t);
    struct observed o = engine_observed(e);
    probes_sample(&e->probes, &o);
}

/* Energies of a sample at the current positions, but the kinetic energy [J]. */
static void engine_report_sample_energy(struct engine *e)
{
    const struct material *m = e->scene->material;
    e->sampling.energy = (struct energy){
        .strain = e->kernels.bond_energy(&e->bonds, &e->part) + diagnostics_strain(&e->part, m, &e->partial) +
                  mesh_strain(&e->mesh, &e->part, e->cell_elastic, !e->scene->small_strain),
        .plastic = bond_plastic_work(&e->bonds) + diagnostics_plastic(&e->part, m, &e->partial),
        .fracture = bonds_fracture_energy(&e->bonds),
        .damped = e->damped,
    };
}

/* Completes a sample and writes its line. t_velocity: time of the current velocities [s]; kinetic, work [J]. */
static void sample_write(struct engine *e, real t_velocity, real kinetic, real work)
{
    sync_probes(e);
    struct observed o = engine_observed(e);
    probes_sample_end(&e->probes, &o, t_velocity);
    e->sampling.energy.kinetic = kinetic;
    const struct energy *u = &e->sampling.energy;
    e->lost = !isfinite(kinetic + u->strain + u->plastic + u->fracture + u->damped + work);
    if (e->lost) return;                         /* engine_energy_check reports it; nothing is written */
    diagnostics_balance(&e->diagnostics, e->t, &e->sampling.energy, work);
    fill_record(e);
    if (e->out && e->history_status == OK) e->history_status = output_history(e->out, e->record);
}

/* Keeps the velocities before a step: forces on the grid appear at points only as a change of their velocity. */
static void keep_velocities(struct engine *e)
{
    const struct particles *p = &e->part;
    if (p->n_free == 0 && !coupling_moves_by_grid(e->coupling)) return;
    for (int d = 0; d < p->dim; d++) {
        if (!e->sampling.before[d]) e->sampling.before[d] = BARE("report.before", p->n, real);
        memcpy(e->sampling.before[d], p->v[d], (size_t)p->n * sizeof(real));
    }
}

/* Excess of the mean of the kinetic energies before and after a step over 1/2 m v_before . v_after [J]
 * (diagnostics_kick). */
static real kick_now(const struct engine *e)
{
    const bool grid = e->part.n_free > 0 || coupling_moves_by_grid(e->coupling);
    const real dt = e->transfer.dt_velocity;
    return diagnostics_kick(&e->part, grid ? e->sampling.before : NULL, dt) + mesh_kick(&e->mesh, dt);
}

void engine_sample_begin(struct engine *e)
{
    e->sampling.due = sample_due(e);
    e->sampling.work = e->loads.work;
    e->sampling.constraint_work = e->loads.constraint_work;
    if (e->sampling.due) {
        sync_probes(e);
        sample_state(e);
    }
    if (!e->sampling.due && e->step < e->steps - 1) return;
    if (!e->sampling.due) sync_probes(e);
    if (!e->sampling.due && wants_stress(e)) engine_stress(e);
    struct observed o = engine_observed(e);
    probes_keep(&e->probes, &o);
    keep_velocities(e);
    e->sampling.kinetic = kinetic_now(e);
}

void engine_sample_energy(struct engine *e)
{
    if (e->sampling.due) engine_report_sample_energy(e);
}

/* True if a boundary drives particles at a speed, so that velocities jump in the first step. */
static bool sets_out(const struct scene *s)
{
    bool drives = false;
    for (int b = 0; b < s->boundaries; b++)
        drives |=
            s->boundary[b].kind == BOUNDARY_VELOCITY && dot(s->boundary[b].value, s->boundary[b].value, s->dim) > 0;
    return drives;
}

/* Twice the excess of the start [J]: leap-frog keeps 1/2 m v- . v+, v+- = v +- a dt/2, and not the 1/2 m v^2 of the
 * start. 0 where the first step changes velocities by more than forces do and the two cannot be separated: with APIC,
 * and for points beside driven ones. */
static real start_excess(const struct engine *e)
{
    const bool kept = e->part.n_free == 0 || (e->scene->transfer == TRANSFER_FLIP && !sets_out(e->scene));
    return kept ? 2 * kick_now(e) : 0;
}

void engine_sample_end(struct engine *e)
{
    if (!e->sampling.due) return;
    if (e->step == 0) {                /* velocities of t = 0, not of half a step before; nothing is damped yet */
        e->sampling.energy.damped = 0;
        sample_write(e, e->t + 0.5 * e->dt, e->sampling.kinetic, e->sampling.work);
        e->diagnostics.energy_start -= start_excess(e);
        return;
    }
    real kinetic = 0.5 * (e->sampling.kinetic + kinetic_now(e)) - kick_now(e);
    sample_write(e, e->t + 0.5 * e->dt, kinetic,
                 e->sampling.work + 0.5 * (e->sampling.constraint_work + e->loads.constraint_work));
}

void engine_sample_rest(struct engine *e)
{
    sample_state(e);
    engine_report_sample_energy(e);
    sample_write(e, e->t, 0, 0);
}

/* Sum of v . f of particles that bonds move and of nodes in the reference frame [W]; serial, as calls are few. */
static real power_now(const struct engine *e)
{
    const struct particles *p = &e->part;
    const struct grid *g = &e->mesh.grid;
    real power = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        for (int d = 0; d < p->dim && !particle_on_grid(p, i); d++) power += p->v[d][i] * p->f[d][i];
    }
    for (int64_t I = 0; I < g->n && e->mesh.points > 0; I++)
        for (int d = 0; d < p->dim; d++) power += g->velocity[d][I] * g->force[d][I];
    return power;
}

/* Sum of v . f by the forces after the last step, which no motion follows [W]: no bond breaks, and the accounts of
 * loads are restored. *held: work of walls of the grid in that step [J]; the work of driven particles and of nodes of a
 * mesh is part of the power. */
static real power_last(struct engine *e, real *held)
{
    const struct loads account = e->loads;
    struct load *own = BARE("report.load", e->loads.n, struct load);
    if (e->loads.n > 0) memcpy(own, e->loads.load, (size_t)e->loads.n * sizeof *own);
    loads_clear(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &bond_limit_never, NULL);
    loads_apply(&e->loads, &e->part, e->t + 0.5 * e->dt, e->dt, e->dt);
    if (e->mesh.points > 0) engine_nodes_force(e);
    const real power = power_now(e) + engine_grid_power(e, e->t + 0.5 * e->dt);
    *held = e->loads.constraint_work - account.constraint_work;
    if (e->loads.n > 0) memcpy(e->loads.load, own, (size_t)e->loads.n * sizeof *own);
    memcpy(e->loads.impulse, account.impulse, sizeof account.impulse);      /* arrays may have grown with the grid */
    e->loads.work = account.work, e->loads.constraint_work = account.constraint_work;
    memory_free(own);
    return power;
}

/* The last sample. No force follows the last step: kinetic energy is 1/2 m v- . v+, as in all samples before, with v+
 * after the kick of the forces at the end. */
static void sample_last(struct engine *e)
{
    real held = 0;
    refresh_states(e);
    engine_mesh_sync(e);                         /* callers may read the particles from here on */
    sample_state(e);
    engine_report_sample_energy(e);
    real kinetic = kinetic_now(e);
    if (e->scene->solver == SOLVER_EXPLICIT) kinetic += 0.5 * e->dt * power_last(e, &held);
    sample_write(e, e->t - 0.5 * e->dt, kinetic, e->loads.work + e->loads.constraint_work + 0.5 * held);
}

void engine_breaks(struct engine *e, int64_t broken)
{
    if (broken > 0) diagnostics_breaks(&e->diagnostics, &e->part, broken, e->t);
    struct observed o = engine_observed(e);
    probes_step(&e->probes, &o);
}

static bool in_patch(const struct engine *e, const real *x)
{
    for (int k = 0; k < e->scene->probes; k++)
        if (e->scene->probe[k].kind == PROBE_PATCH && region_contains(&e->scene->probe[k].region, x, e->part.dim, 0))
            return true;
    return false;
}

static bool wants_residual(const struct engine *e)
{
    bool wanted = false;
    for (int k = 0; k < e->scene->probes; k++) wanted |= e->scene->probe[k].kind == PROBE_PATCH;
    return wanted && e->step == 0;
}

void engine_residual_of(struct engine *e, const struct grid *g)
{
    real x[DIM_MAX];
    if (!wants_residual(e)) return;
    for (int64_t I = 0; I < g->n; I++) {
        for (int d = 0; d < g->dim; d++) x[d] = grid_position(g, d, I / g->stride[d] % g->count[d]);
        for (int d = 0; d < g->dim; d++)
            if (in_patch(e, x)) e->residual_step0 = real_max(e->residual_step0, fabs(g->force[d][I]));
    }
}

void engine_residual(struct engine *e)
{
    const struct particles *p = &e->part;
    real x[DIM_MAX];
    if (!wants_residual(e)) return;
    engine_residual_of(e, &e->grid);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        int32_t i = p->list[KIND_PD][k];
        if (particle_on_grid(p, i)) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->X[d][i];
        for (int d = 0; d < p->dim; d++)
            if (in_patch(e, x)) e->residual_step0 = real_max(e->residual_step0, fabs(p->f[d][i]));
    }
}

/* ---- frames and checkpoints -------------------------------------------------------------------------------------- */

/* FAILED if a frame would hold a number that is not finite. The stability check covers positions and speeds of every
 * step, the energy check the energies of samples; this check covers stresses and the rest of a frame. */
static status frame_sound(const struct engine *e)
{
    const struct particles *p = &e->part;
    int64_t first = p->n;
#pragma omp parallel for schedule(static) reduction(min : first)
    for (int64_t i = 0; i < p->n; i++) {
        real sum = 0;
        for (int k = 0; k < symmetric_count(p->dim); k++) sum += 0 * p->stress[k][i];
        for (int d = 0; d < p->dim; d++) sum += 0 * (p->x[d][i] + p->v[d][i]);
        if (!(sum == 0) && i < first) first = i;
    }
    if (first == p->n) return OK;
    return status_set(
        FAILED,
        "step %lld, t = %.4g s: particle %d has a stress, place or velocity that is no finite number; see whether "
        "material, supports and initial state are meant (`cleave check`)",
        (long long)e->step, e->t, (int)p->id[first]);
}

static status write_frame(struct engine *e)
{
    engine_sync(e);
    TRY(frame_sound(e));
    TRY(output_frame_begin(e->out, &e->part, e->t, e->step, e->scene->text));
    return engine_profiles_write(e);
}

static status write_checkpoint(struct engine *e)
{
    engine_mesh_sync(e);
    e->last_checkpoint = team_clock();
    TRY(checkpoint_write(e->out, e->scene->text, engine_archive, e));
    e->checkpoint_seconds = real_max(e->checkpoint_seconds, team_clock() - e->last_checkpoint);
    return OK;
}

/* True if the wall time left is at most twice that of the longest checkpoint so far. */
static bool wall_is_over(const struct engine *e)
{
    return team_clock() - e->began + 2 * e->checkpoint_seconds >= e->scene->wall;
}

/* Warns of frames and profiles that a resumed run had written and that are lost. */
static status say_lost(struct engine *e)
{
    char text[PATH_NAME_ROOM + 200];
    int lost;
    TRY(output_frames_check(e->out, &lost, text, sizeof text));
    if (lost > 0) engine_say(e, text);
    engine_profiles_check(e);
    return OK;
}

status engine_report_start(struct engine *e)
{
    e->record = NEW("report.record", RECORD_FIXED + e->probes.columns, real);
    e->started = e->last_progress = e->last_checkpoint = team_clock();
    e->step_started = e->step;
    e->loop_before = e->loop_seconds;
    if (!e->out) return OK;
    bool resumed = e->out->frames > 0;       /* the first checkpoint, of step 0, already counts the first frame */
    TRY(history_start(e, resumed));
    if (resumed) return say_lost(e);
    engine_profiles_remove(e);
    TRY(write_frame(e));
    return write_checkpoint(e);
}

/* ---- progress ---------------------------------------------------------------------------------------------------- */

static void duration_text(char *text, size_t size, double seconds)
{
    if (seconds < 100) snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 6000) snprintf(text, size, "%.0f min", seconds / 60);
    else snprintf(text, size, "%.1f h", seconds / 3600);
}

/* Prints the progress line if it is due; `last`: after the last step. */
static void progress(struct engine *e, bool last)
{
    bool terminal = isatty(STDERR_FILENO);
    double now = team_clock();
    if (e->quiet || (!last && now - e->last_progress < (terminal ? PROGRESS_SECONDS : PROGRESS_SECONDS_FILE))) return;
    if (last && !terminal) return;
    e->last_progress = now;
    double rate = (double)(e->step - e->step_started) / real_max(now - e->started, 1e-9);
    char left[32];
    duration_text(left, sizeof left, rate > 0 ? (double)(e->steps - e->step) / rate : 0);
    const struct tip *tip = tips_longest(&e->tips);
    fprintf(stderr, "%sstep %lld/%lld  t = %.4g s  %.0f steps/s  %s left  PD %.1f %%  crack %.3g mm%s",
            terminal ? "\r" : "", (long long)e->step, (long long)e->steps, e->t, rate, left,
            100.0 * (double)e->part.n_of[KIND_PD] / (double)e->part.n,
            tip ? 1e3 * tip->growth : 0.0, terminal && !last ? "\033[K" : "\n");
    fflush(stderr);
}

/* ---- after a step ------------------------------------------------------------------------------------------------ */

real engine_inactive_share(const struct engine *e)
{
    real at_rest = inactive_share(&e->bonds.active) * (real)e->part.n_of[KIND_PD];
    if (e->mesh.points > 0) at_rest += inactive_share(&e->mesh.active) * (real)e->mesh.points;
    return at_rest / (real)e->part.n;
}

status engine_report(struct engine *e)
{
    e->particle_steps[KIND_PD] += e->part.n_of[KIND_PD];
    e->particle_steps[KIND_MPM] += e->part.n_of[KIND_MPM];
    e->bond_visits += e->bonds.n;
    e->inactive += engine_inactive_share(e);
    lap(&e->laps, LAP_WATCH);
    /* before any checkpoint, so that a finished run has nothing left to write */
    if (e->step == e->steps) sample_last(e);
    TRY(e->history_status);
    TRY(engine_energy_check(e));
    if (e->step == e->steps) engine_say_balance(e);
    if (e->out) {
        const bool between = e->scene->solver != SOLVER_EXPLICIT && e->step < e->steps;
        const int64_t frames = e->scene->frames < e->steps ? e->scene->frames : e->steps;
        if (!between && e->out->frames <= frames && e->step >= frame_step(e, e->out->frames, frames))
            TRY(write_frame(e));
        const bool late = wall_is_over(e), stop = late || (e->stop && *e->stop);
        if (stop || team_clock() - e->last_checkpoint > e->scene->checkpoint_interval) TRY(write_checkpoint(e));
        if (stop && e->step < e->steps)
            return status_set(INTERRUPTED, "%s at step %lld of %lld; go on with --resume",
                              late ? "time.wall is over" : "interrupted", (long long)e->step, (long long)e->steps);
    }
    progress(e, false);
    lap(&e->laps, LAP_OUTPUT);
    e->loop_seconds = e->loop_before - e->laps.spent[LAP_OUTPUT];
    for (int k = 0; k < LAPS; k++) e->loop_seconds += e->laps.spent[k];
    return OK;
}

status engine_report_end(struct engine *e)
{
    progress(e, true);
    if (e->out) TRY(output_wait(e->out));
    return e->out && e->step > e->step_started ? write_checkpoint(e) : OK;
}
