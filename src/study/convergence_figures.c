/* Selects and evaluates the scalar results of a convergence study, and writes them as a table and a printed summary. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "convergence_units.h"
#include "study/uncertainty.h"

/* Largest number of scalar results that the printed summary of a convergence study contains. */
enum { PRINTED_MOST = 24 };

/* Factor from the change of a scalar result, when the horizon is made one spacing longer, to the error that remains in
 * the result. The error of sums over the neighbours on an irregular lattice does not decrease with the spacing, only
 * with the number m of spacings in the horizon: as about m^(-3/2) (empirical). One step of the horizon thus removes
 * only a third of it. */
#define HORIZON_REST 2.9

/* Largest standard deviation of an order of convergence that is printed. For comparison: an order about which the runs
 * say nothing is uniform from 0.5 to 2, with a standard deviation of 0.43. */
#define ORDER_KNOWN 0.35

/* ---- sensitivity of a result ------------------------------------------------------------------------------------- */

/* Returns by how much a result (a number in summary.json) of the study s changes if the time step is 10 % longer: b
 * log(1.1), with the slope b of the result over log(time step). The slope is fitted by least squares to the runs of all
 * spacing levels (runs with one particle spacing) with two runs or more, after the mean of the level is subtracted from
 * each result. c: means of the levels; value[k]: result of the run k. Returns NAN if all runs have the same time step
 * or the scene is not dynamic. */
static double step_moves(const struct convergence_study *s, const struct convergence *c, const double *value)
{
    double xx = 0, xy = 0;
    if (!scene_is_dynamic(&s->scene)) return NAN;
    for (int k = 0; k < s->study.n; k++) {
        const struct study_point *p = &s->point[k];
        if (p->level < 0 || !isfinite(value[k]) || c->level[p->level].runs < 2) continue;
        xx += square(log(p->step));
        xy += log(p->step) * (value[k] - c->level[p->level].mean);
    }
    return xx > 0 ? xy / xx * log(1.1) : NAN;
}

/* Returns the change of a result (a number in summary.json) of the study s if the horizon is one spacing longer: the
 * result of the run with the longer horizon, which has level -1, minus that of the first run of level 1, which has the
 * same spacing. value[k]: result of the run k. Returns NAN if the study has no run with a longer horizon. */
static double horizon_moves(const struct convergence_study *s, const double *value)
{
    double longer = NAN, own = NAN;
    for (int k = 0; k < s->study.n; k++) {
        const struct study_point *p = &s->point[k];
        if (p->level == -1)
            longer = value[k];
        else if (p->level == 1 && p->run == 0)
            own = value[k];
    }
    return longer - own;
}

/* Estimates the error of a result that is caused by crack growth from particle to particle, at each spacing level (set
 * of runs with one particle spacing) of the study s, and stores it in resolution[levels]. name: key of the result in
 * summary.json. For positions and lengths of cracks the error is half a spacing [m]. For angles it is the rotation of
 * the longest crack if its tip moves by half a spacing [degree]. Returns false, and stores nothing, for other results.
 */
static bool resolution_find(double *resolution, const struct convergence_study *s, const char *name)
{
    const char *dot = strrchr(name, '.'), *own = dot ? dot + 1 : name;
    const int length = study_table_index_of_result(&s->table, "crack.length_end");
    const bool tip = !strncmp(name, "crack.", 6) || !strncmp(name, "probes.tip", 10);
    const bool is_angle = !strcmp(own, "angle_deg") && length >= 0;
    const bool is_place = !strcmp(own, "length_end") || !strcmp(own, "x") || !strcmp(own, "y") || !strcmp(own, "z");
    if (!tip || (!is_angle && !is_place)) return false;
    for (int l = 0; l < s->spacings.levels; l++) {
        double longest = 0;
        for (int k = 0; k < s->study.n && is_angle; k++)
            if (s->point[k].level == l) longest = fmax(longest, s->table.value[length][k]);
        const double half = 0.5 * s->spacings.at[l][0];
        resolution[l] = is_angle ? 57.29577951 * half / fmax(longest, half) : half;
    }
    return true;
}

/* Evaluates the convergence of one number of summary.json, in column `at` of the table s->table, and its sensitivity
 * to time step, spacing and horizon, into *f. Returns false if one of the finest spacing levels (runs with one
 * particle spacing each) has no value. */
static bool figure_make(struct scalar_result_study *f, const struct convergence_study *s, int at)
{
    double *spacing = NEW("study.spacing", s->study.n, double);
    int *level = NEW("study.level", s->study.n, int);
    for (int k = 0; k < s->study.n; k++) spacing[k] = s->point[k].spacing, level[k] = s->point[k].level;
    *f = (struct scalar_result_study){.name = s->table.figure[at]};
    double resolution[LEVELS_MOST];
    const bool steps = resolution_find(resolution, s, f->name);
    const bool known = convergence_evaluate_scalar_result(&f->c, spacing, s->table.value[at], level, s->study.n,
                                                          s->spacings.levels, steps ? resolution : NULL);
    memory_free(level);
    memory_free(spacing);
    if (!known) return false;
    f->step_moves = step_moves(s, &f->c, s->table.value[at]);
    f->horizon_moves = horizon_moves(s, s->table.value[at]);
    if (s->scene.irregularity > 0 && isfinite(f->horizon_moves)) {
        f->c.bias = HORIZON_REST * fabs(f->horizon_moves);
        convergence_fit_order_and_uncertainty_intervals(&f->c);
    }
    f->spacing_moves = f->c.level[0].mean - f->c.level[1].mean;
    return true;
}

/* Returns true if the result f (a number in summary.json) differs between the spacing levels (runs with one particle
 * spacing each) or the runs of a study. Energies of mechanisms that the input file (scene) does not have are an
 * example of constant results, which are not reported. */
static bool figure_moves(const struct scalar_result_study *f)
{
    bool moves = false;
    for (int k = 0; k < f->c.levels; k++)
        moves |= f->c.level[k].deviation > 0 || f->c.level[k].mean != f->c.level[0].mean;
    return moves;
}

/* ---- choice ------------------------------------------------------------------------------------------------------ */

/* Returns true if a study s that requests no particular numbers reports the number of summary.json called `name`.
 * Excluded are technical numbers such as run times, counts of equal positions (`tied`), numbers of single crack tips,
 * since runs differ in how many tips they have, and angles in 1D. */
static bool is_of_interest(const struct convergence_study *s, const char *name)
{
    const char *dot = strrchr(name, '.');
    if (s->scene.dim == 1 && dot && !strcmp(dot, ".angle_deg")) return false;
    return !result_describes_computation_instead_of_body(name) && strncmp(name, "crack.tips.", 11) != 0 &&
           !(dot && !strcmp(dot, ".tied"));
}

/* Returns true if the number of summary.json called `name` is a coordinate of an event that occurred at several
 * positions at once in some run of the study, so that its value is arbitrary: other runs may report another of these
 * positions. summary.json counts such positions under the name `tied`. s: the study. */
static bool is_one_of_several(const struct convergence_study *s, const char *name)
{
    const char *dot = strrchr(name, '.');
    char tied[NAME_MAX_LENGTH * 2];
    if (!dot || (strcmp(dot, ".x") && strcmp(dot, ".y") && strcmp(dot, ".z"))) return false;
    snprintf(tied, sizeof tied, "%.*s.tied", (int)(dot - name), name);
    const int count = study_table_index_of_result(&s->table, tied);
    for (int k = 0; k < s->study.n && count >= 0; k++)
        if (s->table.value[count][k] > 1) return true;
    return false;
}

/* Returns in which part of the output the number of summary.json called `name` is listed: 0 for numbers of cracks, 1
 * for others such as those of probes, 2 for energies. */
static int part_of(const char *name) { return !strncmp(name, "crack.", 6) ? 0 : !strncmp(name, "energy.", 7) ? 2 : 1; }

static bool is_wanted(const struct convergence_study *s, const char *name, const char *const *wanted, int wanteds)
{
    if (wanteds == 0) return is_of_interest(s, name);
    for (int k = 0; k < wanteds; k++)
        if (strcmp(name, wanted[k]) == 0) return true;
    return false;
}

static void figures_units(const struct convergence_study *s, struct scalar_result_study *figure, int figures)
{
    char header[HEADER_ROOM];
    study_read_history_header(header, sizeof header, &s->study);
    for (int f = 0; f < figures; f++)
        study_determine_unit_of_result(figure[f].unit, sizeof figure[f].unit, header, figure[f].name);
}

status scalar_results_determine_convergence(const struct convergence_study *s, const char *const *wanted_names,
                                            int wanted_count, struct scalar_result_study **figure, int *figure_count)
{
    for (int k = 0; k < wanted_count; k++)
        if (study_table_index_of_result(&s->table, wanted_names[k]) < 0)
            return status_set(REFUSED,
                              "%s: summary.json has no number of this name; join the names that lead to the number by "
                              "dots, as in crack.angle_deg",
                              wanted_names[k]);
    *figure = NEW("study.figures", s->table.figures, struct scalar_result_study);
    *figure_count = 0;
    for (int f = 0; f < s->table.figures && wanted_count == 0; f++)
        if (is_of_interest(s, s->table.figure[f]) && is_one_of_several(s, s->table.figure[f]))
            fprintf(stderr,
                    "figure %s is left out: in some run the event occurred at several positions at once, and the run "
                    "reports only one of them; --of %s includes it\n",
                    s->table.figure[f], s->table.figure[f]);
    for (int part = 0; part < 3; part++)
        for (int f = 0; f < s->table.figures; f++)
            if ((wanted_count > 0 || !is_one_of_several(s, s->table.figure[f])) &&
                part_of(s->table.figure[f]) == part && is_wanted(s, s->table.figure[f], wanted_names, wanted_count) &&
                figure_make(&(*figure)[*figure_count], s, f) &&
                (wanted_count > 0 || figure_moves(&(*figure)[*figure_count])))
                ++*figure_count;
    figures_units(s, *figure, *figure_count);
    if (*figure_count > 0) return OK;
    memory_free(*figure);
    *figure = NULL;
    return status_set(FAILED,
                      "no figure can be extrapolated, because none has a value at every spacing; some runs failed: "
                      "read their messages in %s/logs",
                      s->study.folder);
}

/* ---- converge.csv ------------------------------------------------------------------------------------------------ */

/* Writes a comma and the number `value` as the next cell of a CSV table to the stream `to`; the cell is empty if it is
 * not finite. */
static void print_cell(FILE *to, double value)
{
    if (isfinite(value))
        fprintf(to, ",%.10g", value);
    else
        putc(',', to);
}

static void figures_table(FILE *to, const struct convergence_study *s, const struct scalar_result_study *figure,
                          int figures)
{
    fputs("figure,unit,value,uncertainty,scatter,discretisation,deviation_of_a_run,verdict,order,order_likely,"
          "order_error,grid_convergence_index,extrapolated,step_moves,spacing_moves,horizon_moves",
          to);
    for (int l = 0; l < s->spacings.levels; l++)
        fprintf(to, ",spacing_%d [m],mean_%d,deviation_%d,uncertainty_%d,runs_%d", l, l, l, l, l);
    putc('\n', to);
    for (int f = 0; f < figures; f++) {
        const struct convergence *c = &figure[f].c;
        fprintf(to, "%s,%s", figure[f].name, figure[f].unit);
        const double before[] = {c->level[0].mean, c->uncertainty[0], c->level[0].error, c->discretisation[0],
                                 c->level[0].deviation};
        for (size_t k = 0; k < COUNT_OF(before); k++) print_cell(to, before[k]);
        fprintf(to, ",%s", verdict_name[c->verdict]);
        const double behind[] = {
            c->order,        c->order_likely,      c->order_error,          c->index,
            c->extrapolated, figure[f].step_moves, figure[f].spacing_moves, figure[f].horizon_moves};
        for (size_t k = 0; k < COUNT_OF(behind); k++) print_cell(to, behind[k]);
        for (int l = 0; l < c->levels; l++) {
            print_cell(to, c->level[l].spacing), print_cell(to, c->level[l].mean);
            print_cell(to, c->level[l].deviation), print_cell(to, c->uncertainty[l]);
            fprintf(to, ",%d", c->level[l].runs);
        }
        putc('\n', to);
    }
}

status scalar_results_write(const struct convergence_study *s, const struct scalar_result_study *results,
                            int result_count)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&text, &length);
    if (to) figures_table(to, s, results, result_count);
    TRY(study_write_memory_stream_to_file(&s->study, "converge.csv", to, &text, &length));
    return study_write_scene_and_options(s->study.folder, s->scene.text, s->study.options);
}

/* ---- printed summary --------------------------------------------------------------------------------------------- */

/* Writes `value` into text[capacity] with the digits that `uncertainty` justifies, down to the second digit of the
 * uncertainty. An uncertainty of 0 counts as 1e-4 |value|. */
static void certain_digits(char *text, size_t capacity, double value, double uncertainty)
{
    const double size = fabs(value);
    const double least = uncertainty > 0 ? uncertainty : 1e-4 * fmax(size, 1e-300);
    const int uncertain = (int)floor(log10(least)) - 1;
    const int leading = size > 0 ? (int)floor(log10(size)) : 0;
    if (leading >= 6 || leading < -3) {
        const int digits = leading - uncertain;
        snprintf(text, capacity, "%.*e", digits < 0 ? 0 : digits > 9 ? 9 : digits, value);
    } else
        snprintf(text, capacity, "%.*f", uncertain > 0 ? 0 : uncertain < -9 ? 9 : -uncertain, value);
}

/* Returns the name of the parameter that changes the result f (a scalar result) most: the time step (10 % longer), the
 * spacing (by the factor sqrt(2)) or the horizon (one spacing longer); "nothing" if none changes it. */
static const char *mover(const struct scalar_result_study *f)
{
    const double step = fabs(f->step_moves), spacing = fabs(f->spacing_moves), horizon = fabs(f->horizon_moves);
    const double most = fmax(spacing, fmax(isfinite(step) ? step : 0, isfinite(horizon) ? horizon : 0));
    return most == 0 ? "nothing" : most == spacing ? "spacing" : most == step ? "time step" : "horizon";
}

/* Returns true if the extrapolated value of a result f that cannot be negative, a crack length or an energy, is
 * negative although the means of all levels are positive. */
static bool limit_is_impossible(const struct scalar_result_study *f)
{
    const char *dot = strrchr(f->name, '.');
    const bool positive = !strncmp(f->name, "energy.", 7) || (dot && !strcmp(dot, ".length_end"));
    double least = INFINITY;
    for (int k = 0; k < f->c.levels; k++) least = fmin(least, f->c.level[k].mean);
    return positive && least > 0 && f->c.extrapolated < 0;
}

/* Prints the orders of convergence of the result f (a scalar result), and its limit at spacing 0, as part of a
 * sentence. Prints nothing if the means of the spacing levels (runs with one particle spacing each) oscillate or
 * diverge. */
static void order_print(const struct scalar_result_study *f)
{
    const struct convergence *c = &f->c;
    char text[40];
    if (c->verdict == VERDICT_DIVERGES || c->verdict == VERDICT_OSCILLATES) return;
    if (isfinite(c->order)) printf(", order %.2f from the finest three spacings", c->order);
    if (!isfinite(c->order_likely)) return;
    if (c->order_error < ORDER_KNOWN)
        printf("; order %.1f +- %.1f from all spacings", c->order_likely, c->order_error);
    else
        printf("; all spacings allow orders from 0.5 to 2");
    certain_digits(text, sizeof text, c->extrapolated, c->uncertainty[0] / 4);
    printf(", %s%s", limit_is_impossible(f) ? "no limit, because it would be negative: " : "limit ", text);
}

/* Returns a copy of the result f (scalar result) with all values converted to the unit in which it is printed. */
static struct scalar_result_study figure_in_printed_unit(const struct scalar_result_study *f)
{
    const struct unit unit = scalar_result_study_choose_unit(f);
    struct scalar_result_study p = *f;
    snprintf(p.unit, sizeof p.unit, "%.15s", unit.name);
    for (int k = 0; k < p.c.levels; k++) {
        struct spacing_level_statistics *level = &p.c.level[k];
        level->mean /= unit.factor, level->error /= unit.factor, level->deviation /= unit.factor;
        p.c.uncertainty[k] /= unit.factor, p.c.discretisation[k] /= unit.factor;
    }
    p.c.extrapolated /= unit.factor, p.c.index /= unit.factor;
    return p;
}

/* Prints the means of the scalar result `figure` at all spacings, how it converges, and its value with its 95 %
 * interval. own: index of the level with the spacing of the scene, -1 if there is none; metre: unit of the spacings. */
static void figure_print(const struct scalar_result_study *figure, int own, const struct unit *metre)
{
    const struct scalar_result_study shown = figure_in_printed_unit(figure), *f = &shown;
    const struct convergence *c = &f->c;
    char text[40];
    printf(*f->unit ? "%s [%s]\n " : "%s%s\n ", f->name, f->unit);
    for (int k = c->levels - 1; k >= 0; k--) {
        certain_digits(text, sizeof text, c->level[k].mean, c->uncertainty[0] / 4);
        printf(" %s (%.4g %s)%s", text, c->level[k].spacing / metre->factor, metre->name, k > 0 ? "," : "");
    }
    printf("; %s", verdict_name[c->verdict]);
    order_print(f);
    if (isfinite(c->index)) printf("; grid convergence index %.2g", c->index);
    certain_digits(text, sizeof text, c->level[0].mean, c->uncertainty[0]);
    printf("\n  %s +- %.2g (%.2g of it from the scatter of runs, %.2g from the spacing)", text, c->uncertainty[0],
           c->level[0].error, c->discretisation[0]);
    if (own > 0 && own < c->levels) {
        certain_digits(text, sizeof text, c->level[own].mean, c->uncertainty[own]);
        printf("; at the scene's own %.4g %s %s +- %.2g", c->level[own].spacing / metre->factor, metre->name, text,
               c->uncertainty[own]);
    }
    if (c->level[0].runs > 1 || c->level[0].deviation > 0)
        printf("; a single run differs from its mean by up to %.2g", 2 * c->level[0].deviation);
    else
        printf("; scatter unknown (one run only)");
    printf("; most sensitive to: %s\n", mover(f));
}

void scalar_results_print(const struct convergence_study *s, const struct scalar_result_study *figure, int figures)
{
    const int shown = figures < PRINTED_MOST ? figures : PRINTED_MOST;
    const struct unit metre = convergence_study_choose_spacing_unit(s);
    int lost = 0;
    printf("for each figure of summary.json: its mean at each spacing and its convergence with the spacing; below, its "
           "value at %.4g %s +- the error bar within which the true value is with 95 %% probability\n",
           s->spacings.at[0][0] / metre.factor, metre.name);
    for (int f = 0; f < shown; f++) figure_print(&figure[f], s->own, &metre);
    for (int f = 0; f < figures; f++) lost += figure[f].c.verdict == VERDICT_DIVERGES;
    if (lost > 0)
        printf("%d of %d figures do not converge at these spacings: their +- is an upper bound of the error, not an "
               "estimate\n",
               lost, figures);
    if (shown < figures)
        printf("%d more figures", figures - shown);
    else
        printf("all figures");
    printf(" in %s/converge.csv\n", printable_name(s->study.folder).text);
}
