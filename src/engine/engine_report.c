/* floor 5: samples, frames, checkpoints and the progress line of a run. */
#include "engine_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "output/output_files.h"

#define PROGRESS_SECONDS 0.5             /* between progress lines on a terminal */
#define PROGRESS_SECONDS_FILE 60.0       /* and elsewhere                        */

/* ---- when ------------------------------------------------------------------------------------------------ */

/* Step of event k of n evenly spread over the run. */
static int64_t due_step(const struct engine *e, int64_t k, int64_t n)
{
    return n > 0 ? (k * e->steps + n / 2) / n : e->steps;
}

/* Step of frame k after the one at t = 0: that nearest to its time, or evenly spread. Every step writes one frame at the
 * most, so that frames closer than a step keep their number. */
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

/* ---- columns ----------------------------------------------------------------------------------------------- */

enum { RECORD_FIXED = 22 };

static const struct column fixed_columns[RECORD_FIXED] = {
    {"time", "s"}, {"step", ""}, {"kinetic", "J"}, {"strain", "J"}, {"plastic", "J"}, {"fracture", "J"},
    {"external_work", "J"}, {"balance_error", ""}, {"momentum_x", "kg m/s"}, {"momentum_y", "kg m/s"},
    {"momentum_z", "kg m/s"}, {"momentum_error", ""}, {"particles_pd", ""}, {"pd_share", ""}, {"bonds", ""},
    {"crack_length", "m"}, {"tip_x", "m"}, {"tip_y", "m"}, {"tip_z", "m"}, {"damped", "J"}, {"mpm_share", ""},
    {"rest_share", ""}};

/* Mean share of the body at rest over the steps since the last sample; 0 where there was none. */
static real rest_since_sample(struct engine *e)
{
    const int64_t steps = e->step - e->sampled.step;
    const real share = steps > 0 ? (e->rested - e->sampled.rested) / (real)steps : 0;
    e->sampled.rested = e->rested, e->sampled.step = e->step;
    return share;
}

static void fill_record(struct engine *e)
{
    const struct ledger *l = &e->watch.now;
    const struct energy *u = &l->energy;
    const struct tip *tip = tips_longest(&e->tips);
    real *r = e->record;
    const real fixed[RECORD_FIXED] = {
        l->time, (real)e->step, u->kinetic, u->strain, u->plastic, u->fracture, l->external_work, l->balance_error,
        l->momentum[0], l->momentum[1], l->momentum[2], l->momentum_error, (real)e->part.n_of[KIND_PD],
        (real)e->part.n_of[KIND_PD] / (real)e->part.n, (real)e->bonds.n, tip ? tip->growth : 0,
        tip ? tip->place[0] : NAN, tip && e->part.dim > 1 ? tip->place[1] : NAN,
        tip && e->part.dim > 2 ? tip->place[2] : NAN, u->damped,
        (real)e->part.n_of[KIND_MPM] / (real)e->part.n, rest_since_sample(e)};
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

/* ---- samples ------------------------------------------------------------------------------------------------ */

/* Stresses of peridynamic particles are made only where somebody looks. */
static bool wants_stress(const struct engine *e)
{
    for (int k = 0; k < e->scene->probes; k++) {
        const struct probe_request *q = &e->scene->probe[k];
        if (q->kind == PROBE_POINT || q->kind == PROBE_RIGID) return true;
        if (q->kind == PROBE_SIF && q->stress == SIF_PARTICLE) return true;
    }
    return false;
}

/* Families as they are now: a step moves particles after its forces, and a body that turns would show the stress of a
 * step's rotation. */
static void refresh_states(struct engine *e)
{
    families_know(&e->bonds, &e->part, &e->source);
}

void engine_stress(struct engine *e)
{
    refresh_states(e);
    e->kernels.bond_stress(&e->bonds, &e->part);
}

/* Points of a mesh are brought up to date for probes that look at particles; damage and bonds always are. */
static void show_probes(struct engine *e)
{
    bool motion = false;
    for (int k = 0; k < e->scene->probes; k++) {
        const enum probe_kind kind = e->scene->probe[k].kind;
        motion |= kind != PROBE_TIP && kind != PROBE_BREAK && kind != PROBE_REACTION && kind != PROBE_GROWTH;
    }
    if (motion) engine_mesh_show(e);
}

static real kinetic_now(const struct engine *e) { return watch_kinetic(&e->part) + mesh_kinetic(&e->mesh); }

/* What stands still while the energies of a sample are gathered. */
static void sample_state(struct engine *e)
{
    if (wants_stress(e)) engine_stress(e);
    watch_momentum(&e->watch, &e->part, &e->mesh.grid, e->loads.impulse);
    tips_sample(&e->tips, &e->part, &e->cells, e->t);
    struct observed o = engine_observed(e);
    probes_sample(&e->probes, &o);
}

static void sample_energy(struct engine *e)
{
    const struct material *m = e->scene->material;
    e->sampling.energy = (struct energy){
        .strain = e->kernels.bond_energy(&e->bonds, &e->part) + watch_strain(&e->part, m, &e->partial) +
                  mesh_strain(&e->mesh, &e->part, e->cell_elastic, !e->scene->small_strain),
        .plastic = bond_plastic_work(&e->bonds) + watch_plastic(&e->part, m, &e->partial),
        .fracture = bonds_fracture_energy(&e->bonds),
        .damped = e->damped,
    };
}

/* t_velocity: when the velocities of now are known [s]. */
static void sample_write(struct engine *e, real t_velocity, real kinetic, real work)
{
    show_probes(e);
    struct observed o = engine_observed(e);
    probes_sample_end(&e->probes, &o, t_velocity);
    e->sampling.energy.kinetic = kinetic;
    const struct energy *u = &e->sampling.energy;
    e->lost = !isfinite(kinetic + u->strain + u->plastic + u->fracture + u->damped + work);
    if (e->lost) return;                         /* energy_alarm says so; nothing of it is written */
    watch_ledger(&e->watch, e->t, &e->sampling.energy, work);
    fill_record(e);
    if (e->out && e->history_status == OK) e->history_status = output_history(e->out, e->record);
}

/* Of a force on the grid points know but what it did to their velocity. */
static void keep_velocities(struct engine *e)
{
    const struct particles *p = &e->part;
    if (p->n_free == 0 && !coupling_carries(e->coupling)) return;
    for (int d = 0; d < p->dim; d++) {
        if (!e->sampling.before[d]) e->sampling.before[d] = BARE("report.before", p->n, real);
        memcpy(e->sampling.before[d], p->v[d], (size_t)p->n * sizeof(real));
    }
}

/* What the mean of two kinetic energies, of before and after a step of velocities, has too much. */
static real kick_now(const struct engine *e)
{
    const bool grid = e->part.n_free > 0 || coupling_carries(e->coupling);
    const real dt = e->transfer.dt_velocity;
    return watch_kick(&e->part, grid ? e->sampling.before : NULL, dt) + mesh_kick(&e->mesh, dt);
}

void engine_sample_begin(struct engine *e)
{
    e->sampling.due = sample_due(e);
    e->sampling.work = e->loads.work;
    e->sampling.held_work = e->loads.held_work;
    if (e->sampling.due) {
        show_probes(e);
        sample_state(e);
    }
    if (!e->sampling.due && e->step < e->steps - 1) return;
    if (!e->sampling.due) show_probes(e);
    if (!e->sampling.due && wants_stress(e)) engine_stress(e);
    struct observed o = engine_observed(e);
    probes_keep(&e->probes, &o);
    keep_velocities(e);
    e->sampling.kinetic = kinetic_now(e);
}

void engine_sample_energy(struct engine *e)
{
    if (e->sampling.due) sample_energy(e);
}

/* Is anything driven from the start, so that its first step is a jump? */
static bool sets_out(const struct scene *s)
{
    bool drives = false;
    for (int b = 0; b < s->boundaries; b++)
        drives |= s->boundary[b].kind == BOUNDARY_VELOCITY && dot(s->boundary[b].value, s->boundary[b].value, s->dim) > 0;
    return drives;
}

/* Leap-frog keeps 1/2 m v- . v+, v+- = v +- a dt/2, and not the 1/2 m v^2 of the start. APIC's first step changes velocities by more
 * than forces do, and so does that of points beside what is driven: their jump is not told apart. */
static real start_excess(const struct engine *e)
{
    const bool kept = e->part.n_free == 0 || (e->scene->transfer == TRANSFER_FLIP && !sets_out(e->scene));
    return kept ? 2 * kick_now(e) : 0;
}

void engine_sample_end(struct engine *e)
{
    if (!e->sampling.due) return;
    if (e->step == 0) {                      /* velocities of t = 0, not of half a step before, that nothing has damped yet */
        e->sampling.energy.damped = 0;
        sample_write(e, e->t + 0.5 * e->dt, e->sampling.kinetic, e->sampling.work);
        e->watch.energy_start -= start_excess(e);
        return;
    }
    real kinetic = 0.5 * (e->sampling.kinetic + kinetic_now(e)) - kick_now(e);
    sample_write(e, e->t + 0.5 * e->dt, kinetic, e->sampling.work + 0.5 * (e->sampling.held_work + e->loads.held_work));
}

void engine_sample_rest(struct engine *e)
{
    sample_state(e);
    sample_energy(e);
    sample_write(e, e->t, 0, 0);
}

/* Sum of v . f of particles that bonds move and of nodes in the reference frame [W]; few calls: serial, in order. */
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

/* Sum of v . f by the forces after the last step, which no motion follows: bonds stay, and accounts of loads are put back [W]. `held`:
 * the work of walls of the grid in that step [J]; driven particles and nodes of a mesh have theirs in the power. */
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
    *held = e->loads.held_work - account.held_work;
    if (e->loads.n > 0) memcpy(e->loads.load, own, (size_t)e->loads.n * sizeof *own);
    memcpy(e->loads.impulse, account.impulse, sizeof account.impulse);      /* arrays may have grown with the grid */
    e->loads.work = account.work, e->loads.held_work = account.held_work;
    memory_free(own);
    return power;
}

/* After the last step no force follows: kinetic energy is, as at all samples before, 1/2 m v- . v+, v+ after the kick that the forces
 * there would give. */
static void sample_last(struct engine *e)
{
    real held = 0;
    refresh_states(e);
    engine_mesh_show(e);                         /* whoever holds the engine may look at it now */
    sample_state(e);
    sample_energy(e);
    real kinetic = kinetic_now(e);
    if (e->scene->solver == SOLVER_EXPLICIT) kinetic += 0.5 * e->dt * power_last(e, &held);
    sample_write(e, e->t - 0.5 * e->dt, kinetic, e->loads.work + e->loads.held_work + 0.5 * held);
}

void engine_breaks(struct engine *e, int64_t broken)
{
    if (broken > 0) watch_breaks(&e->watch, &e->part, broken, e->t);
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

/* ---- frames and checkpoints ------------------------------------------------------------------------------- */

/* The alarm looks at places and speeds of every step, the ledger at energies of samples; this at what else a frame holds. */
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
    return status_set(FAILED, "step %lld, t = %.4g s: particle %d has a stress, place or velocity that is no finite number; see whether "
                              "material, supports and initial state are meant (`cleave check`)", (long long)e->step, e->t,
                      (int)p->id[first]);
}

static status write_frame(struct engine *e)
{
    engine_mesh_show(e);
    engine_stress(e);
    TRY(frame_sound(e));
    TRY(output_frame_begin(e->out, &e->part, e->t, e->step, e->scene->text));
    return engine_profiles_write(e);
}

static status write_checkpoint(struct engine *e)
{
    engine_mesh_show(e);
    e->last_checkpoint = team_clock();
    TRY(checkpoint_write(e->out, e->scene->text, engine_archive, e));
    e->checkpoint_seconds = real_max(e->checkpoint_seconds, team_clock() - e->last_checkpoint);
    return OK;
}

/* Is there just time left for another checkpoint, and for one that takes twice as long as any before? */
static bool wall_is_over(const struct engine *e)
{
    return team_clock() - e->began + 2 * e->checkpoint_seconds >= e->scene->wall;
}

/* What a run that goes on finds no more of what it had written. */
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

/* ---- progress ------------------------------------------------------------------------------------------------ */

static void duration_text(char *text, size_t size, double seconds)
{
    if (seconds < 100) snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 6000) snprintf(text, size, "%.0f min", seconds / 60);
    else snprintf(text, size, "%.1f h", seconds / 3600);
}

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

/* ---- after a step ---------------------------------------------------------------------------------------------- */

real engine_rest(const struct engine *e)
{
    real at_rest = rest_share(&e->bonds.rest) * (real)e->part.n_of[KIND_PD];
    if (e->mesh.points > 0) at_rest += rest_share(&e->mesh.rest) * (real)e->mesh.points;
    return at_rest / (real)e->part.n;
}

status engine_report(struct engine *e)
{
    e->particle_steps[KIND_PD] += e->part.n_of[KIND_PD];
    e->particle_steps[KIND_MPM] += e->part.n_of[KIND_MPM];
    e->bond_visits += e->bonds.n;
    e->rested += engine_rest(e);
    lap(&e->laps, LAP_WATCH);
    if (e->step == e->steps) sample_last(e);     /* before any checkpoint: a finished run has nothing left to write */
    TRY(e->history_status);
    TRY(engine_energy_alarm(e));
    if (e->step == e->steps) engine_say_balance(e);
    if (e->out) {
        const bool between = e->scene->solver != SOLVER_EXPLICIT && e->step < e->steps;
        const int64_t frames = e->scene->frames < e->steps ? e->scene->frames : e->steps;
        if (!between && e->out->frames <= frames && e->step >= frame_step(e, e->out->frames, frames)) TRY(write_frame(e));
        const bool late = wall_is_over(e), stop = late || (e->stop && *e->stop);
        if (stop || team_clock() - e->last_checkpoint > e->scene->checkpoint_interval) TRY(write_checkpoint(e));
        if (stop && e->step < e->steps)
            return status_set(INTERRUPTED, "%s at step %lld of %lld; go on with --resume", late ? "time.wall is over" : "interrupted",
                              (long long)e->step, (long long)e->steps);
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
