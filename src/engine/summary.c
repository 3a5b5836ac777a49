/* Writes summary.json: the figures of a run, for scripts. Physical figures come first and do not depend on the number
 * of threads; figures that depend on the machine follow. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fracture/fragments.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/json.h"
#include "simd/simd.h"
#include "coupling/coupling_part.h"
#include "mesh/mesh_part.h"
#include "quasistatic/statics.h"
#include "grid/grid_part.h"
#include "contact/contact.h"
#include "rigid/rigid_part.h"
#include "step/report.h"
#include "fracture/fracture_part.h"
#include "output/output.h"
#include "probes/probes_part.h"
#include "step/step.h"

/* ---- physical figures -------------------------------------------------------------------------------------------- */

static void put_run(struct json *j, const struct run *e, status s, const char *message)
{
    static const char *const method[] = {[METHOD_PD] = "pd", [METHOD_MPM] = "mpm", [METHOD_ADAPTIVE] = "adaptive"};
    json_text(j, "name", e->scene->name);
    json_text(j, "version", CLEAVE_VERSION);
    json_text(j, "method", method[e->scene->method]);
    json_text(j, "status", s == OK ? "done" : s == INTERRUPTED ? "interrupted" : "failed");
    if (s != OK && message[0]) json_text(j, "message", message);
    json_count(j, "steps", e->clock.step);
    json_real(j, "time_step", e->clock.dt);
    json_real(j, "time_step_critical", e->clock.dt_critical);
    json_real(j, "time_end", e->clock.t);
    json_count(j, "particles", e->part.n_body);
    json_count(j, "particles_made", e->part.n);
    json_count(j, "particles_pd_start", e->coupling->conversion.start);
    json_count(j, "particles_pd_end", e->part.n_of[KIND_PD]);
    json_count(j, "bonds_peak", e->coupling->conversion.peak_bonds);
}

/* Coarse cells, by level, and how often they have changed. */
static void put_levels(struct json *j, const struct run *e)
{
    const struct mesh_levels *l = &e->frame->levels;
    if (l->n == 0) return;
    json_open(j, "levels", '{');
    json_open(j, "cells", '[');
    for (int level = 0; level <= l->n; level++) json_count(j, NULL, levels_cells(l, level));
    json_close(j, ']');
    json_count(j, "changes", l->changes);
    json_close(j, '}');
}

static void put_warnings(struct json *j, const struct warnings *w)
{
    json_open(j, "warnings", '[');
    for (int k = 0; k < w->n; k++) json_text(j, NULL, w->text[k]);
    json_close(j, ']');
}

static void put_solver(struct json *j, const struct run *e)
{
    static const char *const name[] = {[SOLVER_RELAXATION] = "relaxation", [SOLVER_CG] = "cg"};
    if (!scene_at_rest(e->scene)) return;
    json_open(j, "solver", '{');
    json_text(j, "name", name[e->scene->solver]);
    json_count(j, "steps", e->clock.step);
    json_real(j, "residual", e->solver->residual);
    json_count(j, "bonds_past_limit", e->solver->past_limit);
    json_close(j, '}');
}

/* Load steps, what they took and what they released. */
static void put_load_steps(struct json *j, const struct run *e)
{
    static const char *const control[] = {
        [CONTROL_LOAD] = "load", [CONTROL_ENERGY] = "energy", [CONTROL_OPENING] = "opening"};
    const struct statics *s = e->statics;
    if (!scene_in_steps(e->scene)) return;
    json_open(j, "load_steps", '{');
    json_text(j, "control", control[e->scene->steps.control]);
    json_count(j, "steps", e->clock.step);
    json_real(j, "load_time", s->t);
    json_count(j, "equilibria", s->solutions);
    json_count(j, "directions", s->balance.directions);
    json_real(j, "overload", s->overload);
    json_count(j, "bonds_broken", e->diagnostics->bonds_broken / 2);
    json_real(j, "released", s->record.released);
    json_real(j, "crack_area", s->record.area);
    json_real(j, "release_rate", s->record.area > 0 ? s->record.released / s->record.area : NAN);
    json_close(j, '}');
}

static void put_energy_balance(struct json *j, const struct energy_balance *l)
{
    json_open(j, "energy", '{');
    for (int k = 0; k < ENERGIES; k++) json_real(j, ledger[k].name, l->energy.of[k]);
    json_real(j, ledger[LEDGER_WORK].name, l->external_work);
    json_real(j, "balance_error", l->balance_error);
    json_close(j, '}');
    json_real(j, "momentum_error", l->momentum_error);
    json_real(j, "angular_momentum_error", l->spin_error);
}

/* Pairs in contact at once and their largest overlap, in a run with contact. */
static void put_contact(struct json *j, const struct contact *c, const struct grid_method *mpm)
{
    const struct grid_contact *g = &mpm->contact;
    if (c->law.between == CONTACT_NONE && mpm->fields < 2) return;
    json_open(j, "contact", '{');
    json_real(j, "began", fmin(c->began, g->began));
    json_real(j, "ended", fmax(c->ended, g->ended));
    if (mpm->fields > 1) json_count(j, "nodes_max", g->nodes_most);
    if (c->law.between == CONTACT_NONE) {
        json_close(j, '}');
        return;
    }
    json_count(j, "pairs_max", c->pairs_most);
    json_real(j, "friction_work", contact_friction_work(c));
    json_real(j, "overlap_max", c->overlap_most / c->law.spacing);
    json_close(j, '}');
}

/* Rigid bodies at the end, and the largest force on each. */
static void put_rigid(struct json *j, const struct run *e)
{
    static const char *const velocity[] = {"velocity_x", "velocity_y", "velocity_z"};
    if (e->scene->rigids == 0) return;
    json_open(j, "rigid", '[');
    for (int k = 0; k < e->scene->rigids; k++) {
        const struct rigid_body *r = &e->rigid->body[k];
        real v[DIM_MAX];
        rigids_velocity(e, k, v);
        json_open(j, NULL, '{');
        json_text(j, "name", r->name);
        json_point(j, "", r->x, r->dim);
        for (int d = 0; d < r->dim; d++) json_real(j, velocity[d], v[d]);
        json_real(j, "force_max", r->force_most);
        json_real(j, "patch", contact_patch(e->contact, &e->part, k));
        json_close(j, '}');
    }
    json_close(j, ']');
}

/* ---- fragments --------------------------------------------------------------------------------------------------- */

/* Bodies of bonds that have lost some. */
static bool has_fragments(const struct run *e)
{
    return e->scene->method == METHOD_PD && !scene_at_rest(e->scene) &&
           (e->diagnostics->bonds_broken > 0 || e->scene->cracks > 0);
}

static void put_fragments(struct json *j, const struct fragments *f)
{
    json_open(j, "fragments", '{');
    json_count(j, "count", f->n);
    json_real(j, "mass_max", f->n > 0 ? f->fragment[0].mass : 0);
    json_count(j, "particles_alone", f->singles);
    json_real(j, "mass_alone", f->mass_singles);
    json_close(j, '}');
}

/* fragments.csv: a line each, the heaviest first. */
static void fragments_print(FILE *file, const struct run *e, const struct fragments *f)
{
    static const char axis[] = "xyz";
    const int dim = e->part.dim;
    fputs("body,particles,mass [kg]", file);
    for (int d = 0; d < dim; d++) fprintf(file, ",%c [m]", axis[d]);
    for (int d = 0; d < dim; d++) fprintf(file, ",velocity_%c [m/s]", axis[d]);
    fputc('\n', file);
    for (int64_t k = 0; k < f->n; k++) {
        const struct fragment *g = &f->fragment[k];
        fprintf(file, "%d,%lld,%.9g", g->body, (long long)g->particles, g->mass);
        for (int d = 0; d < dim; d++) fprintf(file, ",%.9g", g->x[d]);
        for (int d = 0; d < dim; d++) fprintf(file, ",%.9g", g->v[d]);
        fputc('\n', file);
    }
}

static status fragments_write(const struct run *e, const struct fragments *f)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = memory_stream_open(&text, &length);
    if (!file) return status_set(FAILED, "cannot write fragments.csv: out of memory");
    fragments_print(file, e, f);
    const bool whole = fclose(file) == 0;
    const status written = whole ? output_text(e->report->out, "fragments.csv", text, length)
                                 : status_set(FAILED, "cannot write fragments.csv: out of memory");
    free(text);
    return written;
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* When something was: the time, in load steps their number. */
static void put_when(struct json *j, const struct run *e, const char *what, real t)
{
    char key[NAME_MAX_LENGTH];
    const bool in_steps = scene_in_steps(e->scene);
    snprintf(key, sizeof key, "%s_%s", what, in_steps ? "step" : "time");
    if (!in_steps) json_real(j, key, t);
    else if (!isnan(t)) json_count(j, key, (int64_t)floor(t / e->clock.dt + 0.5));
}

static void put_tip(struct json *j, const struct run *e, const struct tip *tip)
{
    const int dim = e->part.dim;
    json_open(j, NULL, '{');
    json_count(j, "body", tip->body);
    json_point(j, "origin_", tip->origin, dim);
    json_point(j, "", tip->place, dim);
    json_real(j, "growth", tip->growth);
    json_real(j, "angle_deg", tip_angle(tip, dim));
    put_when(j, e, "start", tip->start_time);
    put_when(j, e, "arrest", tip->arrest_time);
    if (!scene_in_steps(e->scene)) json_real(j, "speed_max", tip->speed_max);
    if (!scene_in_steps(e->scene)) json_real(j, "speed_mean", tip->speed_mean);
    json_close(j, '}');
}

/* Bonds of driven particles that loads have broken; of one between two of them both count. */
static int64_t driven_bonds(const struct run *e)
{
    int64_t broken = 0;
    for (int64_t row = 0; row < e->bonds.rows; row++)
        if (e->part.flag[e->bonds.particle[row]] & FLAG_DRIVEN) broken += e->bonds.broken[row];
    return broken;
}

static void put_crack(struct json *j, const struct run *e)
{
    const struct tip *longest = tips_longest(&e->fracture->tips);
    int dim = e->part.dim;
    json_open(j, "crack", '{');
    put_when(j, e, "start", e->diagnostics->break_time);
    put_when(j, e, "driven_start", e->diagnostics->driven_time);
    if (!isnan(e->diagnostics->driven_time)) json_count(j, "driven_bonds", driven_bonds(e));
    if (longest) {
        put_when(j, e, "tip_start", longest->start_time);
        put_when(j, e, "arrest", longest->arrest_time);
        json_real(j, "length_end", longest->growth);
        json_real(j, "angle_deg", tip_angle(longest, dim));
        json_count(j, "tied", tips_tied(&e->fracture->tips));
    }
    if (longest && !scene_in_steps(e->scene)) {
        json_real(j, "tip_speed_max", longest->speed_max);
        json_real(j, "tip_speed_mean", longest->speed_mean);
    }
    json_open(j, "tips", '[');
    for (int k = 0; k < e->fracture->tips.n; k++) put_tip(j, e, &e->fracture->tips.tip[k]);
    json_close(j, ']');
    json_close(j, '}');
}

/* Most reversions of one particle. */
static int reversions_most(const struct particles *p)
{
    int most = 0;
    for (int64_t i = 0; i < p->n; i++) most = p->reversions[i] > most ? p->reversions[i] : most;
    return most;
}

/* What stands for each of the first pre-cracks. */
static void put_notches(struct json *j, const struct run *e)
{
    enum { SAID = 16 };
    char text[256];
    if (e->coupling->notches.n == 0) return;
    json_open(j, "notches", '[');
    for (int k = 0; k < e->coupling->notches.n && k < SAID; k++) {
        notch_text(e, k, text, sizeof text);
        json_text(j, NULL, text);
    }
    json_close(j, ']');
}

static void put_conversion(struct json *j, const struct run *e)
{
    const struct conversion *c = &e->coupling->conversion;
    real n = (real)e->part.n_body, start = (real)c->start / n, end = (real)e->part.n_of[KIND_PD] / n;
    json_open(j, "conversion", '{');
    if (isfinite(c->first_time) && c->events > 0) {
        json_real(j, "first_time", c->first_time);
        json_point(j, "", c->first_place, e->part.dim);
    }
    json_real(j, "pd_share_start", start);
    json_real(j, "pd_share_end", end);
    json_real(j, "pd_share_max", real_max((real)c->peak / n, real_max(start, end)));
    put_notches(j, e);
    if (e->part.low_since) {
        json_count(j, "converted", c->converted);
        json_count(j, "returned", c->reverted);
        json_count(j, "returns_most", reversions_most(&e->part));
        json_real(j, "return_energy", c->reversion_energy);
    }
    json_close(j, '}');
}

/* Figures of one probe follow each other: a new name closes the object of the probe before. */
struct probe_sink { struct json *json; char name[NAME_MAX_LENGTH]; bool open; };

/* Sink of the figures of probes; `context`: struct probe_sink. */
static void put_figure(void *context, const char *probe, const char *quantity, real value)
{
    struct probe_sink *sink = context;
    if (!isfinite(value)) return;
    if (!sink->open || strcmp(sink->name, probe) != 0) {
        if (sink->open) json_close(sink->json, '}');
        json_open(sink->json, probe, '{');
        snprintf(sink->name, sizeof sink->name, "%s", probe);
        sink->open = true;
    }
    json_real(sink->json, quantity, value);
}

static void put_probes(struct json *j, const struct run *e)
{
    struct observed o = run_observed(e);
    struct probe_sink sink = {.json = j};
    json_open(j, "probes", '{');
    probes_figures(&e->probing->probes, &o, put_figure, &sink);
    if (sink.open) json_close(j, '}');
    json_close(j, '}');
}

/* Half-widths of the figures above, where a study of this scene is at hand. */
static void put_error_bars(struct json *j, const struct run_report *r)
{
    if (r->bars == 0) return;
    json_open(j, "uncertainty", '{');
    for (int k = 0; k < r->bars; k++) json_number(j, r->bar[k].figure, r->bar[k].half_width, 3);
    json_close(j, '}');
}

/* ---- figures of the machine -------------------------------------------------------------------------------------- */

/* Figures that depend on the machine: threads, kernels, times, memory; laps: parts of the loop of this process [s]. */
static void put_machine(struct json *j, const struct run *e, int threads, double wall_seconds)
{
    real steps = 0, ns = 1e9 * e->report->loop_seconds;
    for (int k = 0; k < KINDS; k++) steps += (real)e->report->particle_steps[k];
    json_count(j, "threads", threads);
    json_text(j, "kernels", simd_in_use()->name);
    json_number(j, "wall_seconds", wall_seconds, JSON_TIMING);
    json_number(j, "loop_seconds", e->report->loop_seconds, JSON_TIMING);
    json_count(j, "memory_peak_bytes", memory_peak());
    json_number(j, "ns_per_particle_step", ns / steps, JSON_TIMING);
    json_number(j, "ns_per_bond_step", ns / (real)e->report->bond_visits, JSON_TIMING);
    json_number(j, "rest_share", e->report->inactive / (real)(e->clock.step > 0 ? e->clock.step : 1), JSON_TIMING);
    json_open(j, "laps", '{');
    for (int k = 0; k < LAPS; k++) json_number(j, lap_name[k], e->laps.spent[k], JSON_TIMING);
    json_close(j, '}');
}

static void summary_print(FILE *file, const struct run *e, const struct fragments *fragments, status s,
                          const char *message, int threads, double wall_seconds)
{
    struct json j = {.file = file, .depth = 1};
    fputc('{', file);
    put_run(&j, e, s, message);
    put_warnings(&j, &e->warnings);
    put_solver(&j, e);
    put_load_steps(&j, e);
    put_energy_balance(&j, &e->diagnostics->now);
    put_contact(&j, e->contact, e->grid);
    put_rigid(&j, e);
    if (has_fragments(e)) put_fragments(&j, fragments);
    put_crack(&j, e);
    put_conversion(&j, e);
    put_levels(&j, e);
    put_probes(&j, e);
    put_error_bars(&j, e->report);
    put_machine(&j, e, threads, wall_seconds);
    fputs("\n}\n", file);
}

status summary_write(const struct run *e, status s, int threads, double wall_seconds)
{
    char message[1024], *text = NULL;
    size_t length = 0;
    if (!e->report->out) return OK;
    snprintf(message, sizeof message, "%s", status_message());
    struct fragments fragments = {0};
    if (has_fragments(e)) {
        fragments_find(&fragments, &e->bonds, &e->part);
        TRY(fragments_write(e, &fragments));
    }
    FILE *file = memory_stream_open(&text, &length);
    if (!file) return status_set(FAILED, "cannot write summary.json: out of memory");
    summary_print(file, e, &fragments, s, message, threads, wall_seconds);
    fragments_free(&fragments);
    const bool whole = fclose(file) == 0;
    status written = whole ? output_text(e->report->out, "summary.json", text, length)
                           : status_set(FAILED, "cannot write summary.json: out of memory");
    free(text);
    /* The cause of a failed run has precedence over a fault of writing its summary. */
    if (written != OK && s != OK) return status_set(s, "%s", message);
    return written;
}
