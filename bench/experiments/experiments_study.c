/* Convergence studies: a scene at three spacings, each several times with time steps and spacings whose variation has
 * no physical meaning. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "experiments.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "study/convergence_study.h"

#define EXPERIMENT_BUDGET 7200.0 /* allowed duration of one study, never reached in practice [s] */

int experiment_compute_mean_and_interval(const double *value, int value_count, double *mean, double *deviation,
                                         double *interval)
{
    int held = 0;
    double sum = 0;
    *mean = *deviation = *interval = NAN;
    for (int k = 0; k < value_count; k++)
        if (isfinite(value[k])) sum += value[k], held++;
    if (held == 0) return 0;
    *mean = sum / held;
    if (held == 1) return 1;
    for (int k = sum = 0; k < value_count; k++)
        if (isfinite(value[k])) sum += (value[k] - *mean) * (value[k] - *mean);
    *deviation = sqrt(sum / (held - 1));
    *interval = student_t_quantile_975(held - 1) * *deviation / sqrt(held);
    return held;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Returns the value of the result f, a quantity to be measured, in run k of study s; NAN if the run has failed or does
 * not have it. */
static double figure_of_run(const struct convergence_study *s, int k, const struct experiment_figure *f)
{
    double value = NAN;
    const enum case_state state = s->study.at[k].state;
    const struct path folder = study_case_folder(&s->study, &s->study.at[k]);
    if (state != CASE_DONE && state != CASE_DONE_BEFORE) return NAN;
    if (f->measure)
        value = f->measure(folder.text, s->point[k].spacing);
    else if (summary_read_number(folder.text, f->key, &value) != OK)
        return NAN;
    return f->scale * value;
}

/* Computes mean and scatter of a result at each spacing level of study s: of the finest level into *row, of the next
 * two into row->coarse. value[k]: the result in run k of the study; NAN to leave out the run, as for the angle of
 * branching of a crack that does not branch. */
static void mesh_levels_take(struct experiment_row *row, const struct convergence_study *s, const double *value)
{
    double own[LEVELS_MOST * RUNS_MOST], mean, deviation, interval;
    for (int l = 0; l < s->spacings.levels; l++) {
        int n = 0;
        for (int k = 0; k < s->study.n; k++)
            if (s->point[k].level == l) own[n++] = value[k];
        const int runs = experiment_compute_mean_and_interval(own, n, &mean, &deviation, &interval);
        if (l == 0)
            row->value = mean, row->deviation = deviation, row->interval = interval, row->runs = runs;
        else if (l <= 2) {
            const double coarse[] = {1e3 * s->spacings.at[l][0], mean, deviation};
            memcpy(row->coarse[row->coarser++], coarse, sizeof coarse);
        }
    }
    row->spacing = 1e3 * s->spacings.at[0][0];
}

static void figure_take(struct experiments *x, const struct experiment_case *c, const struct convergence_study *s,
                        const struct experiment_figure *f)
{
    const int n = s->study.n;
    struct convergence found;
    double *value = NEW("bench.value", n, double), *spacing = NEW("bench.spacing", n, double);
    int *level = NEW("bench.level", n, int);
    struct experiment_row row = {.unit = f->unit, .source = f->source, .low = f->low, .high = f->high, .verdict = ""};
    snprintf(row.experiment, sizeof row.experiment, "%s", c->experiment);
    snprintf(row.variant, sizeof row.variant, "%s", c->variant);
    snprintf(row.figure, sizeof row.figure, "%s", f->name);
    for (int k = 0; k < n; k++) {
        value[k] = s->point[k].level >= 0 ? figure_of_run(s, k, f) : NAN;
        spacing[k] = s->point[k].spacing, level[k] = s->point[k].level;
    }
    mesh_levels_take(&row, s, value);
    if (convergence_evaluate_scalar_result(&found, spacing, value, level, n, s->spacings.levels, NULL)) {
        row.verdict = verdict_name[found.verdict];
        row.interval = found.uncertainty[0];
    }
    experiment_add_and_print_result(x, row);
    memory_free(level), memory_free(spacing), memory_free(value);
}

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* Appends the position (at_x, at_y) [m] of a damaged particle to the crack paths *p. level: index of the spacing of its
 * run. */
static void path_add(struct experiment_paths *p, double at_x, double at_y, int level)
{
    GROW("bench.path", p->x, p->n + 1);
    GROW("bench.path", p->y, p->n + 1);
    GROW("bench.path", p->level, p->n + 1);
    p->x[p->n] = (float)(1e3 * at_x), p->y[p->n] = (float)(1e3 * at_y), p->level[p->n++] = (uint8_t)level;
}

static void paths_take(struct experiments *x, const struct experiment_case *c, const struct convergence_study *s)
{
    INVARIANT(x->paths < EXPERIMENT_PATHS_MOST);
    struct experiment_paths *p = &x->path[x->paths++];
    *p = (struct experiment_paths){.levels = s->spacings.levels};
    snprintf(p->title, sizeof p->title, "%s, %s", c->experiment, c->variant);
    for (int l = 0; l < p->levels; l++) p->spacing[l] = 1e3 * s->spacings.at[l][0];
    for (int k = 0; k < s->study.n; k++) {
        struct output_frame f = {0};
        if (s->point[k].level < 0) continue;
        if (experiment_read_last_frame(&f, study_case_folder(&s->study, &s->study.at[k]).text) == OK)
            for (int64_t i = 0; i < f.n; i++)
                if (f.damage[i] > 0.01 * EXPERIMENT_DAMAGED) path_add(p, f.X[0][i], f.X[1][i], s->point[k].level);
        frame_free(&f);
    }
}

/* ---- a study ----------------------------------------------------------------------------------------------------- */

/* Makes the convergence study of case c and adds its results and crack paths to x. Does nothing for cases whose scene
 * file is missing, or which --quick leaves out. Returns REFUSED or FAILED if the study does. */
status experiment_make_convergence_study(struct experiments *x, const struct experiment_case *c)
{
    struct convergence_study s;
    struct scene_override pair[EXPERIMENT_PAIRS_MOST + 1] = {{"particles.spacing", c->spacing[x->quick]}};
    int pairs = 1;
    const struct path text = path_join(x->folder, "scene.yaml"), into = path_join(x->folder, "study");
    while (pairs <= EXPERIMENT_PAIRS_MOST && c->pair[pairs - 1].key) pair[pairs] = c->pair[pairs - 1], pairs++;
    const struct convergence_request wish = {.scene = c->path ? c->path : text.text,
                                             .folder = into.text,
                                             .override = pair,
                                             .overrides = pairs,
                                             .levels = LEVELS_LEAST,
                                             .runs = c->runs[x->quick],
                                             .budget = EXPERIMENT_BUDGET,
                                             .options.quiet = true};
    if (x->quick && !c->quick) return OK;
    if (c->path && !bench_scene_exists(c->path)) return OK;
    if (!c->path) remove(text.text); /* written for the previous case, and no longer needed */
    if (!c->path) TRY(file_write_whole(text.text, c->text, strlen(c->text)));
    TRY(convergence_study_run(&s, &wish));
    for (int f = 0; f < EXPERIMENT_FIGURES_MOST && c->figure[f].name; f++) figure_take(x, c, &s, &c->figure[f]);
    if (c->drawn) paths_take(x, c, &s);
    convergence_study_free(&s);
    bench_folder_remove(into.text);
    return OK;
}
