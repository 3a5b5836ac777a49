/* Specimens whose cracks grow through half of their width and more, at increasing resolution: largest load, loads at
 * the crack length of later load steps, and released energy, compared with linear elastic fracture mechanics. */
#include <math.h>
#include <stdlib.h>

#include "bench/common/handbook.h"
#include "output/history.h"
#include "plot/gnuplot.h"
#include "slow.h"

static const double young = 3e9, toughness = 300; /* Young's modulus [Pa] and G_c [J/m^2] of the scenes */
static const double long_crack = 0.7;             /* a/W up to which loads are compared; beyond, the formulas are
                                                   * less accurate */

static const struct slow_case {
    const char *name, *scene, *size, *crack; /* size: key of the spacing; crack: replaces the pre-crack, NULL: that
                                              * of the scene */
    struct specimen specimen;
    double spacing;    /* spacing of the scene [m] */
    int across, steps; /* width of the specimen in these spacings; number of load steps */
} slow_case[] = {{"compact tension",
                  "inputs/compact_tension.yaml",
                  "particles.spacing",
                  NULL,
                  {COMPACT_TENSION, 50e-3, 0, 10e-3, 25e-3, young, toughness},
                  0.625e-3,
                  80,
                  14},
                 {"edge crack in grips",
                  "inputs/edge_crack_grips.yaml",
                  "particles.spacing",
                  NULL,
                  {EDGE_CRACK_IN_GRIPS, 40e-3, 120e-3, 5e-3, 12e-3, young, toughness},
                  0.5e-3,
                  80,
                  20},
                 {"three-point bend",
                  "inputs/bend_offset_notch.yaml",
                  "variables.h",
                  "{from: [0, -1 mm], to: [0, 16 mm]}",
                  {THREE_POINT_BEND, 40e-3, 160e-3, 10e-3, 16e-3, young, toughness},
                  0.5e-3,
                  80,
                  16},
                 {"double cantilever",
                  "inputs/cantilevers.yaml",
                  "variables.h",
                  NULL,
                  {DOUBLE_CANTILEVER, 10e-3, 0, 10e-3, 40e-3, young, toughness},
                  0.5e-3,
                  20,
                  30},
                 {"cantilever in space",
                  "inputs/cantilevers_3d.yaml",
                  "particles.spacing",
                  NULL,
                  {DOUBLE_CANTILEVER, 10e-3, 0, 4e-3, 40e-3, young, toughness},
                  1e-3,
                  10,
                  12}};
/* SLOW_CASES: number of cases; IN_SPACE: the one in 3D; BEND, CANTILEVER: those run with --quick; POINTS_MOST:
 * largest number of points of a curve. */
enum { SLOW_CASES = COUNT_OF(slow_case), IN_SPACE = SLOW_CASES - 1, BEND = 2, CANTILEVER = 3, POINTS_MOST = 100 };
static const char *const slow_model[] = {"bond", "ospd", "mospd"};
enum { SLOW_MODELS = COUNT_OF(slow_model) };
static const char *const row_colour[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"};
static const double refined[SLOW_SPACINGS] = {0.5, 1, 2};

struct slow_row {
    const struct slow_case *of;
    int model;   /* index in slow_model */
    double fine; /* resolution over that of the scene */
    double particles, seconds;
    double peak, mean, farthest, opening; /* load over the reference load - 1: largest load; later loads, mean and
                                           * extreme; at equal opening, for cantilevers; NAN: none */
    double released;                      /* released energy over new area and G_c */
    int n;
    double crack[POINTS_MOST], load[POINTS_MOST]; /* crack length a/W; load over the largest reference load */
};
struct slow_table {
    int n;
    struct slow_row row[SLOW_CASES * (SLOW_SPACINGS + SLOW_MODELS)];
};

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Returns the crack length up to which the loads of case c are compared with the formulas [m]; INFINITY for double
 * cantilevers. */
static double longest_crack(const struct slow_case *c)
{
    return c->specimen.kind == DOUBLE_CANTILEVER ? INFINITY : long_crack * c->specimen.width;
}

/* Returns `load` [N] over the load that a double cantilever s has at the opening `opening` [m] by beam theory while its
 * crack grows. By that theory both follow from the crack length, which is eliminated. */
static double cantilever_at_opening(const struct specimen *s, double load, double opening)
{
    const double unit = specimen_load_at_crack_growth(s, 0) * 0.673 * s->width; /* load times (a + 0.673 h) */
    const double squared = opening * s->modulus * s->thickness * pow(s->width, 3) / (8 * unit);
    return load / (unit / sqrt(squared));
}

/* Returns the distance between the load and the end of the specimen in the run r [m]: half a spacing for a double
 * cantilever, which is loaded on its first column of particles, else 0. */
static double load_offset(const struct slow_row *r)
{
    return r->of->specimen.kind == DOUBLE_CANTILEVER ? 0.5 * r->of->spacing / r->fine : 0;
}

static void slow_row_read(struct slow_row *r, const struct history *h)
{
    const struct specimen *s = &r->of->specimen;
    const int force = history_find_column(h, "reaction.force_y"),
              displacement = history_find_column(h, "reaction.displacement_y");
    const int area = history_find_column(h, "crack_area"), lost = history_find_column(h, "released");
    const double crack = s->crack - load_offset(r);
    double sum = 0, largest = 0;
    int later = 0;
    r->mean = r->farthest = 0, r->opening = s->kind == DOUBLE_CANTILEVER ? 0 : NAN;
    for (int64_t k = 1; k < h->rows && r->n < POINTS_MOST; k++) {
        const double load = fabs(history_value_at(h, k, force)), grown = history_value_at(h, k, area) / s->thickness;
        const double a = crack + grown, off = load / specimen_load_at_crack_growth(s, a) - 1;
        r->crack[r->n] = a / s->width, r->load[r->n++] = load / specimen_load_at_crack_growth(s, s->crack);
        largest = fmax(largest, load);
        if (!(grown > 0) || a > longest_crack(r->of)) continue;
        sum += off, later++;
        if (fabs(off) > fabs(r->farthest)) r->farthest = off;
        if (s->kind != DOUBLE_CANTILEVER) continue;
        const double apart = cantilever_at_opening(s, load, 2 * fabs(history_value_at(h, k, displacement))) - 1;
        if (fabs(apart) > fabs(r->opening)) r->opening = apart;
    }
    r->peak = largest / specimen_load_at_crack_growth(s, crack) - 1;
    r->mean = later > 0 ? sum / later : NAN;
    r->released = history_value_at(h, h->rows - 1, lost) / history_value_at(h, h->rows - 1, area) / toughness;
}

static void slow_row_print(const struct slow_row *r)
{
    printf("  %-20s %-6s %7.0f %9.0f %8.1f %+8.1f %% %+8.1f %% %+8.1f %%", r->of->name, slow_model[r->model],
           r->of->across * r->fine, r->particles, r->seconds, 100 * r->peak, 100 * r->mean, 100 * r->farthest);
    if (isnan(r->opening))
        printf(" %10s", "");
    else
        printf(" %+8.1f %%", 100 * r->opening);
    printf(" %9.3f\n", r->released);
}

static status slow_row_take(void *row, const char *folder)
{
    struct slow_row *r = row;
    struct history h = {0};
    TRY(history_read(&h, folder));
    slow_row_read(r, &h);
    history_free(&h);
    r->particles = bench_summary_figure(folder, "particles");
    r->seconds = bench_summary_figure(folder, "loop_seconds");
    slow_row_print(r);
    return OK;
}

static status slow_add(struct slow_table *t, int of, int model, double fine)
{
    const struct slow_case *c = &slow_case[of];
    struct slow_row *r = &t->row[t->n++];
    *r = (struct slow_row){.of = c, .model = model, .fine = fine};
    struct bench_job job = {.path = c->scene, .row = r, .take = slow_row_take};
    bench_overrides_append(&job.overrides, c->size, "%.9g mm", 1e3 * c->spacing / fine);
    bench_overrides_append(&job.overrides, "steps.number", "%.0f", c->steps * fine);
    bench_overrides_append(&job.overrides, "output.frames", "0");
    bench_overrides_append(&job.overrides, "model", "%s", slow_model[model]);
    if (model > 0) bench_overrides_append(&job.overrides, "material.poisson", "0.3");
    if (c->crack) bench_overrides_append(&job.overrides, "cracks.0", "%s", c->crack);
    return bench_jobs_run(&job, 1, 1);
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes the results of all specimens in t as the table slow_specimens.csv. Returns FAILED if it cannot be written. */
static status slow_rows_write(const struct slow_table *t)
{
    struct bench_table rows;
    bench_table_make(&rows, "",
                     "specimen,model,spacings_across,particles,loop_seconds,peak_error,later_mean_error,"
                     "later_farthest_error,opening_farthest_error,released_over_G_c");
    for (int k = 0; k < t->n; k++) {
        const struct slow_row *r = &t->row[k];
        const double number[] = {
            r->of->across * r->fine, r->particles, r->seconds, r->peak, r->mean, r->farthest, r->opening, r->released};
        bench_table_append_text(&rows, r->of->name), bench_table_append_text(&rows, slow_model[r->model]);
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(&rows, number[c]);
    }
    const status s = bench_write_result_tables("slow_specimens", &rows, 1);
    bench_table_free(&rows);
    return s;
}

/* Sends the gnuplot commands that draw load over crack length for all specimens, with lines for linear elastic fracture
 * mechanics. Crack lengths are relative to the width, for double cantilevers to the height of an arm. context: a struct
 * slow_table. */
static void slow_curves_draw(FILE *to, const void *context)
{
    const struct slow_table *t = context;
    fprintf(to, "set multiplot layout 2,3\nset xtics autofreq\nset xlabel 'crack length over width'\nset ylabel 'load "
                "over largest'\n"
                "set yrange [0:1.15]\nset key inside top right font ',9'\n");
    for (int c = 0; c < SLOW_CASES; c++) {
        const struct specimen *s = &slow_case[c].specimen;
        const double from = s->crack / s->width, end = s->kind == DOUBLE_CANTILEVER ? 8 : 0.8;
        fprintf(to, "set title '%s'\n$exact << EOD\n", slow_case[c].name);
        for (int k = 0; k <= 100; k++) {
            const double x = from + (end - from) * k / 100;
            fprintf(to, "%.6g %.6g\n", x,
                    specimen_load_at_crack_growth(s, x * s->width) / specimen_load_at_crack_growth(s, s->crack));
        }
        fputs("EOD\n", to);
        for (int k = 0; k < t->n; k++) {
            if (t->row[k].of != &slow_case[c]) continue;
            fprintf(to, "$row%d << EOD\n", k);
            for (int p = 0; p < t->row[k].n; p++) fprintf(to, "%.6g %.6g\n", t->row[k].crack[p], t->row[k].load[p]);
            fputs("EOD\n", to);
        }
        fprintf(to, "set xrange [%g:%g]\nplot $exact with lines lw 3 lc rgb '#3d3d3d' title 'linear elastic'", from,
                end);
        for (int k = 0, style = 0; k < t->n; k++)
            if (t->row[k].of == &slow_case[c])
                fprintf(to, ", $row%d with points pt %d lc rgb '%s' title '%s, %.0f across'", k, 4 + style,
                        row_colour[style], slow_model[t->row[k].model], slow_case[c].across * t->row[k].fine),
                    style++;
        putc('\n', to);
    }
    fputs("unset multiplot\n", to);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Adds the goals for the run r of a specimen to *asked: each of its errors must be at most 3 %. */
static void slow_ask(struct bench_goals *asked, const struct slow_row *r)
{
    const char *name = r->of->name, *model = slow_model[r->model];
    const double across = r->of->across * r->fine;
    bench_add_goal(asked, "%", fabs(r->peak), 0.03, "%s, %s, %.0f across: largest load", name, model, across);
    bench_add_goal(asked, "%", fabs(r->farthest), 0.03, "%s, %s, %.0f across: later loads", name, model, across);
    if (r->of->specimen.kind == DOUBLE_CANTILEVER)
        bench_add_goal(asked, "%", fabs(r->opening), 0.03, "%s, %s, %.0f across: load by opening", name, model, across);
    bench_add_goal(asked, "%", fabs(r->released - 1), 0.03, "%s, %s, %.0f across: released over area", name, model,
                   across);
}

static status slow_rows(struct slow_table *t, struct bench_goals *asked, bool quick)
{
    for (int c = 0; c < SLOW_CASES; c++) {
        if (quick && c != BEND && c != CANTILEVER) continue;
        const int first = c == IN_SPACE ? 1 : 0, last = quick || c == IN_SPACE ? first : SLOW_SPACINGS - 1;
        for (int k = first; k <= last; k++) TRY(slow_add(t, c, 0, refined[k]));
        slow_ask(asked, &t->row[t->n - 1]);
        for (int model = 1; model < SLOW_MODELS && !quick && c != IN_SPACE; model++) TRY(slow_add(t, c, model, 1));
    }
    return OK;
}

status slow_run_specimens(struct bench_goals *goals, bool quick)
{
    struct slow_table *t = calloc(1, sizeof *t);
    printf("\n  %-20s %-6s %7s %9s %8s %10s %10s %10s %10s %9s\n", "load beside LEFM", "model", "across", "particles",
           "s", "largest", "later mean", "farthest", "by opening", "G/G_c");
    status s = t ? slow_rows(t, goals, quick) : status_set(FAILED, "bench slow: no memory");
    if (s == OK) s = slow_rows_write(t);
    if (s == OK) s = bench_draw("slow_specimens", 1200, 900, slow_curves_draw, t);
    free(t);
    return s;
}
