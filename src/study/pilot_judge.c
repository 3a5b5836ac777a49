/* Determines the spacing that a method requires from its convergence study. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "pilot_parts.h"
#include "scene/spacings.h"

/* ---- the result -------------------------------------------------------------------------------------------------- */

/* Returns the result (a number in summary.json) by which pilot runs are judged if the input file (scene) names none.
 * Of the array figure[figures] it is the first result of a probe that is larger than its uncertainty; else the time at
 * which cracks start; else the largest energy; NULL if these are missing, too. */
static const struct scalar_result_study *figure_usual(const struct scalar_result_study *figure, int figures)
{
    const struct scalar_result_study *start = NULL, *energy = NULL;
    for (int f = 0; f < figures; f++) {
        const struct convergence *c = &figure[f].c;
        const double size = fabs(c->level[0].mean);
        if (!strncmp(figure[f].name, "probes.", 7) && size > c->uncertainty[0]) return &figure[f];
        if (!strcmp(figure[f].name, "crack.start_time")) start = &figure[f];
        if (!strncmp(figure[f].name, "energy.", 7) && strcmp(figure[f].name, "energy.balance_error") != 0 &&
            (!energy || size > fabs(energy->c.level[0].mean)))
            energy = &figure[f];
    }
    return start ? start : energy;
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* Returns the index of the first run of a spacing level (0: finest), which has the same time step and seed as a run
 * outside a study; -1 if the level has no run. s: the study. */
static int level_run(const struct convergence_study *s, int level)
{
    for (int k = 0; k < s->study.n; k++)
        if (s->point[k].level == level && s->point[k].run == 0) return k;
    return -1;
}

static double pilot_run_figure(const struct convergence_study *s, const char *name, int run)
{
    const int figure = study_table_index_of_result(&s->table, name);
    return figure >= 0 && run >= 0 ? s->table.value[figure][run] : NAN;
}

/* Finds the spacing that a method requires for the requested accuracy of the result f (a scalar result). It is the
 * spacing of the coarsest level, at most the largest allowed spacing, whose run has an error of at most the requested
 * one (p->wish.within). If there is none, it is extrapolated from the finest level, with the smallest order of
 * convergence that the means allow. Stores spacing, accuracy and duration of the run in *c; c->spacing remains 0 if
 * neither is possible. p: requested accuracy and spacing; s: convergence study of the method. */
static void spacing_find(struct pilot_search *p, struct pilot_candidate *c, const struct convergence_study *s,
                         const struct scalar_result_study *f)
{
    const double size = fabs(f->c.extrapolated);
    for (int level = f->c.levels - 1; level >= 0; level--) {
        const int run = level_run(s, level);
        const double value = pilot_run_figure(s, f->name, run), seconds = pilot_run_figure(s, "wall_seconds", run);
        if (!isfinite(value) || !isfinite(seconds)) continue;
        c->finest = s->point[run].spacing, c->finest_seconds = seconds;
        c->width = convergence_confidence_interval_half_width(&f->c, value, 0.95);
        c->value = value, c->reached = c->width / size;
        const bool fixed = p->wish.spacing > 0 && level != s->own;
        if (!(c->reached <= p->wish.within) || fixed || c->finest > p->wish.spacing_most) continue;
        c->spacing = c->finest, c->seconds = seconds, c->expected = c->reached, c->seen = true;
        return;
    }
    /* A requested spacing that exceeds the budget is finer than a spacing that is accurate enough. */
    if (p->wish.spacing > 0 && p->wish.spacing < c->finest && c->reached <= p->wish.within) {
        c->spacing = p->wish.spacing, c->expected = c->reached, c->seen = true;
        c->seconds = c->finest_seconds * pow(c->finest / c->spacing, s->scene.dim + 1);
    }
    if (!(c->finest > 0) || !isfinite(c->reached) || p->wish.spacing > 0) return;
    /* The part of the error that refinement reduces must become small enough beside the bias, which stays. */
    const double bias = f->c.bias / size, within = sqrt(square(p->wish.within) - square(bias));
    if (!(within > 0)) return;
    const double likely = isfinite(f->c.order_likely) ? f->c.order_likely - f->c.order_error : 0.5;
    const double reduction = fmax(square(c->reached) - square(bias), 0); /* a spacing above the largest may be enough */
    const double finer = fmax(pow(sqrt(reduction) / within, 1 / fmax(likely, 0.5)), c->finest / p->wish.spacing_most);
    c->spacing = spacing_that_fits_box_edges(&p->wish.provisional, c->finest / finer, false);
    const double loop = pilot_run_figure(s, "loop_seconds", level_run(s, 0)); /* the rest of wall_seconds is mostly the
                                                                               * start of the process */
    const double growth = pow(c->finest / c->spacing, s->scene.dim + 1);
    c->seconds = isfinite(loop) ? c->finest_seconds + loop * (growth - 1) : c->finest_seconds * growth;
    c->expected = p->wish.within;
}

status pilot_runs_determine_required_spacing(struct pilot_search *search, struct pilot_candidate *c,
                                             const struct convergence_study *study)
{
    struct scalar_result_study *figure = NULL;
    int figures = 0;
    const char *wanted = search->wish.figure[0] ? search->wish.figure : search->figure;
    TRY(scalar_results_determine_convergence(study, &wanted, *wanted ? 1 : 0, &figure, &figures));
    const struct scalar_result_study *f = *wanted ? figure : figure_usual(figure, figures);
    status done = OK;
    if (f && !(fabs(f->c.extrapolated) > 1e-9 * f->c.uncertainty[0]))
        done = status_set(REFUSED, "accuracy.of: %s is zero, so no relative error is defined; name another figure",
                          f->name);
    else if (!f)
        done = status_set(REFUSED, "accuracy.of: the scene has no probe, crack or energy to compare; add a probe");
    else {
        c->spacing = c->finest = c->seconds = 0, c->seen = false;
        snprintf(search->figure, sizeof search->figure, "%s", f->name);
        spacing_find(search, c, study, f);
    }
    if (done == OK) done = scalar_results_write(study, f, 1);
    memory_free(figure);
    return done;
}

void pilot_runs_print_results_of_method(const struct pilot_search *search, const struct pilot_candidate *c)
{
    if (c->failed[0])
        fprintf(stderr, "pilot          %s: %s\n", c->name, c->failed);
    else if (c->seen)
        fprintf(stderr, "pilot          method %s: %s +- %.2g %% at a spacing of %.4g mm, in %.2g s\n", c->name,
                search->figure, 100 * c->expected, 1e3 * c->spacing, c->seconds);
    else {
        fprintf(stderr, "pilot          method %s: %s +- %.2g %% at a spacing of %.4g mm, in %.2g s", c->name,
                search->figure, 100 * c->reached, 1e3 * c->finest, c->finest_seconds);
        if (c->spacing > 0)
            fprintf(stderr, "; for %.2g %% it would need %.4g mm, %.2g s", 100 * search->wish.within, 1e3 * c->spacing,
                    c->seconds);
        fputc('\n', stderr);
    }
}
