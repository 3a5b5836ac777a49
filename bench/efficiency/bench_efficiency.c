/* `cleave bench efficiency`: compares full peridynamics with adaptive runs at equal spacing and time step: t_r = 1 -
 * t_adaptive / t_PD. Bond-based results are compared with Table 1 of Zeng et al. 2022; state-based models have more
 * expensive bonds. Levers are the options by which an adaptive run saves time. All variants run in turn; medians of the
 * loop time are used. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "efficiency.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "step/report.h"
#include "fracture/tips.h"
#include "scene/scene_read.h"

enum { BARS = 5 }; /* number of variants with a colour */
enum {
    CASES = EFFICIENCY_CASES,
    REPETITIONS = 3,
    SAMPLES = EFFICIENCY_SAMPLES,
    SHOWN = VARIANT_FRAME /* its shares are drawn */
};

/* Parts of the loop time. */
enum loop_part { PART_BONDS, PART_POINTS, PART_CONVERSION, PART_SAMPLES, PARTS };
static const char *const part_name[PARTS] = {"bonds", "points", "conversion", "samples"};

/* Times of the runs of one variant, and what is equal in all repetitions: ends of the cracks, and the share of
 * peridynamic particles over time. */
struct run_times {
    double seconds[REPETITIONS];
    double part[PARTS][REPETITIONS]; /* part of these, for each section of a step [s] */
    struct crack_ends ends;
    double time[SAMPLES + 1], share[SAMPLES + 1];
};

struct result {
    const struct scene_case *scene;
    int64_t particles, steps;
    double dt;
    struct run_times run[VARIANTS];
    double t[VARIANTS], t_r[VARIANTS]; /* loop time [s], t_r [1] */
    double t_r_stepping[VARIANTS];     /* t_r of the time steps alone [1] */
    double t_r_bound[VARIANTS];        /* t_r if conversion took no time [1] */
    double rest_share[VARIANTS];       /* share of time spent neither on bonds nor on points [1] */
    double part[VARIANTS][PARTS];      /* time of a part over t_PD [1] */
    double tip_distance[VARIANTS], angle_difference[VARIANTS], start_difference[VARIANTS]; /* differences from full
                                                                                            * peridynamics [m]
                                                                                            * [degree] [s] */
    double angle[VARIANTS]; /* of the longest crack [degree] */
};

struct efficiency {
    int n;
    struct result *result;
};

static status make(struct run *run, struct scene *s, const struct result *x, int variant)
{
    return efficiency_make_run_of_variant(run, s, x->scene, variant, x->dt);
}

/* ---- one run ----------------------------------------------------------------------------------------------------- */

/* Returns the number of peridynamic particles in the run over the number of all its particles [1]. */
static double pd_share(const struct run *run) { return (double)run->part.n_of[KIND_PD] / (double)run->part.n; }

/* Runs a scene in SAMPLES pieces of equal numbers of steps and stores time and share of peridynamic particles after
 * each of them in r->time and r->share. Returns FAILED if a step fails. */
static status run_pieces(struct run_times *r, struct run *run)
{
    r->share[0] = pd_share(run);
    for (int k = 1; k <= SAMPLES; k++) {
        TRY(bench_engine_run(run, run->clock.steps * k / SAMPLES, NULL));
        r->time[k] = run->clock.t, r->share[k] = pd_share(run);
    }
    return OK;
}

/* Stores the times that run number `repetition` has spent on bonds, material points, conversion and samples in r->part
 * [s]. spent: times of the sections of a step (enum timer), summed over the run [s]. */
static void parts_keep(struct run_times *r, const double *spent, int repetition)
{
    r->part[PART_BONDS][repetition] = spent[TIMER_BONDS];
    r->part[PART_POINTS][repetition] = spent[TIMER_SCATTER] + spent[TIMER_GRID] + spent[TIMER_GATHER];
    r->part[PART_CONVERSION][repetition] = spent[TIMER_CONVERT];
    r->part[PART_SAMPLES][repetition] = spent[TIMER_SAMPLE];
}

static status efficiency_run_once(struct result *x, int variant, int repetition)
{
    struct scene s;
    struct run e;
    TRY(make(&e, &s, x, variant));
    struct run_times *r = &x->run[variant];
    status ran = bench_engine_run(&e, e.clock.steps, NULL);
    r->seconds[repetition] = report_wall_clock_times(e.report, &e.timers).loop;
    parts_keep(r, e.timers.spent, repetition);
    x->particles = e.part.n, x->steps = e.clock.steps;
    if (ran == OK) crack_ends_store_from_run(&r->ends, &e);
    bench_engine_free(&e, &s);
    return ran;
}

static status run_shares(struct result *x, int variant)
{
    struct scene s;
    struct run e;
    TRY(make(&e, &s, x, variant));
    s.samples = 0; /* only the last step of each piece */
    status ran = run_pieces(&x->run[variant], &e);
    bench_engine_free(&e, &s);
    return ran;
}

/* ---- results of a scene ------------------------------------------------------------------------------------------ */

/* Compares the longest crack of the run with full peridynamics with that crack of an adaptive run whose tip is nearest
 * at the end. Stores the differences of start time, tip position and angle in *x; the latter two are NAN without a
 * crack. variant: index of the adaptive run; dim: dimension of the scene. */
static void compare_tips(struct result *x, int variant, int dim)
{
    const struct crack_ends *pd = &x->run[0].ends, *adaptive = &x->run[variant].ends;
    x->tip_distance[variant] = x->angle_difference[variant] = x->angle[0] = x->angle[variant] = NAN;
    x->start_difference[variant] = adaptive->start - pd->start;
    if (pd->longest < 0) return;
    const struct crack_tip *a = &pd->tip[pd->longest], *b = crack_tip_nearest_in_other_run(adaptive, a);
    x->angle[0] = tip_deflection_angle(a, dim);
    if (!b) return;
    x->angle[variant] = tip_deflection_angle(b, dim);
    x->tip_distance[variant] = position_distance(a->place, b->place);
    x->angle_difference[variant] = fabs(x->angle[0] - x->angle[variant]);
}

/* Returns the median over the repetitions of the run r of its loop time without the time spent on `part`, such as
 * samples or conversion [s]. */
static double median_without(const struct run_times *r, enum loop_part part, int repetitions)
{
    double t[REPETITIONS];
    for (int k = 0; k < repetitions; k++) t[k] = r->seconds[k] - r->part[part][k];
    return median_by_sorting(t, repetitions);
}

/* Returns the median over the repetitions of the run r of the share of its loop time that is spent on conversion and
 * samples, hence neither on bonds nor on material points [1]. */
static double median_rest(const struct run_times *r, int repetitions)
{
    double t[REPETITIONS];
    for (int k = 0; k < repetitions; k++)
        t[k] = (r->part[PART_CONVERSION][k] + r->part[PART_SAMPLES][k]) / r->seconds[k];
    return median_by_sorting(t, repetitions);
}

static status scene_measure(struct result *x, int repetitions)
{
    struct scene s;
    TRY(scene_read(&s, x->scene->path, NULL, 0));
    const int dim = s.dim;
    scene_free(&s);
    TRY(efficiency_find_common_time_step(x->scene, &x->dt));
    for (int r = 0; r < repetitions; r++)
        for (int k = 0; k < VARIANTS; k++) /* the first lever is always none */
            if (efficiency_variant_is_run_for_scene(x->scene, (r + k) % VARIANTS))
                TRY(efficiency_run_once(x, (r + k) % VARIANTS, r));
    x->t[0] = median_by_sorting(x->run[0].seconds, repetitions);
    for (int variant = 1; variant < VARIANTS; variant++) {
        if (!efficiency_variant_is_run_for_scene(x->scene, variant)) continue;
        TRY(run_shares(x, variant));
        x->t[variant] = median_by_sorting(x->run[variant].seconds, repetitions);
        x->t_r[variant] = 1 - x->t[variant] / x->t[0];
        x->t_r_stepping[variant] = 1 - median_without(&x->run[variant], PART_SAMPLES, repetitions) /
                                           median_without(&x->run[0], PART_SAMPLES, repetitions);
        x->t_r_bound[variant] = 1 - median_without(&x->run[variant], PART_CONVERSION, repetitions) / x->t[0];
        x->rest_share[variant] = median_rest(&x->run[variant], repetitions);
        for (int k = 0; k < PARTS; k++)
            x->part[variant][k] = median_by_sorting(x->run[variant].part[k], repetitions) / x->t[0];
        compare_tips(x, variant, dim);
    }
    return OK;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Prints the header of the table of results. repetitions: number of runs of each variant. */
static void efficiency_print_header(int repetitions)
{
    printf("  same spacing, same time step, %d samples a run; loop time, %s; no files\n", SAMPLES,
           repetitions > 1 ? "median of 3, taking turns" : "one run each (--quick)");
    printf("  %-30s %-6s %-10s %9s %6s %10s %10s %7s %8s %7s %7s %8s %15s %17s %14s %10s %6s  %s\n", "", "model",
           "levers", "particles", "steps", "t_PD [s]", "t_ad [s]", "t_r", "stepping", "bound", "paper", "tips",
           "angles", "starts", "PD share", "rest_share", "aim", "in the way");
}

/* Finds the part of the loop (bonds, points, conversion or samples) that takes most time in an adaptive run of x,
 * writes its name and its time over that of full peridynamics to text[room], and returns text. Returns "" if the run
 * saves as much time as required, or if nothing is required. variant: index of the adaptive run. */
static const char *variant_obstacle(const struct result *x, int variant, char *text, size_t room)
{
    int most = 0;
    for (int k = 1; k < PARTS; k++)
        if (x->part[variant][k] > x->part[variant][most]) most = k;
    if (x->t_r[variant] >= x->scene->aim || isnan(x->scene->aim)) return "";
    snprintf(text, room, "%s %.2f", part_name[most], x->part[variant][most]);
    return text;
}

static void print_variant(const struct result *x, int variant)
{
    char paper[16] = "-", aim[16] = "-", title[48], obstacle[32];
    if (isfinite(x->scene->aim)) snprintf(aim, sizeof aim, "%.2f", x->scene->aim);
    if (isfinite(x->scene->paper_t_r)) snprintf(paper, sizeof paper, "%.3f", x->scene->paper_t_r);
    printf("  %-30s %-6s %-10s %9lld %6lld %10.4f %10.4f %7.3f %8.3f %7.3f %7s %5.2f mm",
           efficiency_title(x->scene, title, sizeof title), x->scene->model, efficiency_variant[variant].levers,
           (long long)x->particles, (long long)x->steps, x->t[0], x->t[variant], x->t_r[variant],
           x->t_r_stepping[variant], x->t_r_bound[variant], paper, 1e3 * x->tip_distance[variant]);
    printf(" %5.1f > %5.1f d %5.2f > %5.2f us %5.1f > %4.1f %% %8.1f %% %6s  %s\n", x->angle[0], x->angle[variant],
           1e6 * x->run[0].ends.start, 1e6 * x->run[variant].ends.start, 100 * x->run[variant].share[0],
           100 * x->run[variant].share[SAMPLES], 100 * x->rest_share[variant], aim,
           variant_obstacle(x, variant, obstacle, sizeof obstacle));
    fflush(stdout);
}

/* Returns the share of peridynamic particles [1] in that sample of the run r which is nearest to time t [s]. */
static double share_at(const struct run_times *r, double t)
{
    int best = 0;
    for (int k = 1; k <= SAMPLES; k++)
        if (fabs(r->time[k] - t) < fabs(r->time[best] - t)) best = k;
    return r->share[best];
}

static void print_marks(const struct efficiency *all)
{
    printf("\n  share of peridynamic particles, ours beside the paper's\n");
    for (int k = 0; k < all->n; k++)
        for (int m = 0; m < all->result[k].scene->marks; m++) {
            const struct mark *a = &all->result[k].scene->mark[m];
            printf("    %-20s at %4.0f us  %5.2f %%   paper %4.1f %%\n", all->result[k].scene->name, 1e6 * a->time,
                   100 * share_at(&all->result[k].run[SHOWN], a->time), 100 * a->share);
        }
    printf(
        "  t_r below 0: the adaptive run took longer than full peridynamics; stepping: the same without the samples;\n"
        "  bound: if rows, partial stress and cells with own stiffness of a conversion came for nothing, what kernels "
        "alone "
        "allow;\n  rest_share: part of the loop that is neither bonds nor material points, but conversion, contact "
        "searches and samples;\n  in the way, of rows below their aim: the largest part of the loop, over t_PD\n");
}

/* Adds the rows of an adaptive run of the scene of x to three tables: table[0] with results, table[1] with shares of
 * peridynamic particles over time, table[2] with properties of the runs. variant: index of the adaptive run. */
static void add_variant(struct bench_table *table, const struct result *x, int variant)
{
    const double main[] = {x->t[variant],
                           x->t[0],
                           x->t_r[variant],
                           x->tip_distance[variant],
                           x->angle_difference[variant],
                           x->start_difference[variant]};
    const double run[] = {(double)x->particles,
                          (double)x->steps,
                          x->dt,
                          x->scene->paper_t_r,
                          x->run[0].ends.start,
                          x->run[variant].ends.start,
                          x->angle[0],
                          x->angle[variant],
                          x->t_r_stepping[variant],
                          x->t_r_bound[variant],
                          x->rest_share[variant],
                          x->scene->aim,
                          x->part[variant][PART_BONDS],
                          x->part[variant][PART_POINTS],
                          x->part[variant][PART_CONVERSION],
                          x->part[variant][PART_SAMPLES]};
    char title[48];
    efficiency_title(x->scene, title, sizeof title);
    bench_table_append_text(&table[0], title), bench_table_append_text(&table[0], x->scene->model);
    for (size_t c = 0; c < COUNT_OF(main); c++) bench_table_append_number(&table[0], main[c]);
    bench_table_append_text(&table[0], efficiency_variant[variant].levers);
    bench_table_append_text(&table[2], title), bench_table_append_text(&table[2], x->scene->model),
        bench_table_append_text(&table[2], efficiency_variant[variant].levers);
    for (size_t c = 0; c < COUNT_OF(run); c++) bench_table_append_number(&table[2], run[c]);
    for (int k = 0; k <= SAMPLES; k++) {
        bench_table_append_text(&table[1], title), bench_table_append_text(&table[1], x->scene->model);
        bench_table_append_text(&table[1], efficiency_variant[variant].levers);
        bench_table_append_number(&table[1], x->run[variant].time[k]),
            bench_table_append_number(&table[1], x->run[variant].share[k]);
    }
}

static status efficiency_write_tables(const struct efficiency *all)
{
    struct bench_table table[3];
    bench_table_make(&table[0], "",
                     "scene,model,t_adaptive,t_pd,t_r,tip_distance,angle_difference_deg,start_difference,levers");
    bench_table_make(&table[1], "share", "scene,model,levers,time,pd_share");
    bench_table_make(&table[2], "runs",
                     "scene,model,levers,particles,steps,time_step,paper_t_r,start_pd,start_adaptive,angle_pd_deg,"
                     "angle_adaptive_deg,t_r_stepping,t_r_bound,rest_share,aim,bonds,points,conversion,samples");
    for (int k = 0; k < all->n; k++)
        for (int variant = 1; variant < VARIANTS; variant++)
            if (efficiency_variant_is_run_for_scene(all->result[k].scene, variant))
                add_variant(table, &all->result[k], variant);
    status s = bench_write_result_tables("efficiency", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s;
}

/* ---- picture ----------------------------------------------------------------------------------------------------- */

/* Smallest t_r = 1 - t_adaptive/t_PD that is drawn. Values far below -1 would compress the rest of the picture. */
#define T_R_LEAST -1.0

static void draw_bars(FILE *to, const struct efficiency *all)
{
    fputs("$bars << EOD\n", to);
    for (int k = 0; k < all->n; k++) {
        const struct result *x = &all->result[k];
        efficiency_write_tic_label(to, x->scene);
        for (int variant = 1; variant < VARIANTS; variant++)
            if (!efficiency_variant[variant].colour)
                continue;
            else if (!efficiency_variant_is_run_for_scene(x->scene, variant))
                fputs(" NaN NaN", to);
            else
                fprintf(to, " %.6g %.6g", fmax(x->t_r[variant], T_R_LEAST), x->t_r[variant]);
        if (isfinite(x->scene->paper_t_r))
            fprintf(to, " %.6g\n", x->scene->paper_t_r);
        else
            fputs(" NaN\n", to);
    }
    fprintf(
        to,
        "EOD\nset lmargin at screen 0.09\nset rmargin at screen 0.97\nset bmargin at screen 0.60\nset tmargin at "
        "screen 0.93\n"
        "set title 'time saved by the adaptive run: 1 - t(adaptive)/t(PD), same spacing, same step (bars end at "
        "-1)'\n"
        "set style data histograms\nset style histogram clustered gap 1\nset style fill solid 0.85\nset boxwidth "
        "0.9\n"
        "set xtics scale 0 font ',6'\n"
        "set ylabel 't_r'\nset yrange [-1.25:1.4]\nset xzeroaxis lw 0.8 lc rgb '#555555'\nset key at graph 0.995,0.985 "
        "right top horizontal maxrows 1 font ',9'\n"
        "plot ");
    for (int variant = 1, bar = 0; variant < VARIANTS; variant++) {
        if (!efficiency_variant[variant].colour) continue;
        bar++;
        fprintf(to,
                "$bars using %d%s lc rgb '%s' title 'levers: %s', '' using ($0%+.2f):%d:(sprintf('%%.2f', $%d)) with "
                "labels "
                "font ',6' offset 0, 0.6 notitle, ",
                2 * bar, bar == 1 ? ":xtic(1)" : "", efficiency_variant[variant].colour,
                efficiency_variant[variant].levers, ((double)bar - 1 - 0.5 * BARS) / (BARS + 2), 2 * bar, 2 * bar + 1);
    }
    fprintf(to, "'' using %d lc rgb '%s' title 'Zeng et al. 2022, table 1'\n", 2 * BARS + 2, curve_colour[4]);
    fputs("set yrange [*:*]\n", to);
}

/* Returns the number of panels of `all` that show shares of peridynamic particles over time. Each bond-based scene at
 * its own spacing has a panel; these scenes come first in the list and are the only ones in Zeng et al. 2022. */
static int panels(const struct efficiency *all)
{
    int n = 0;
    while (n < all->n && efficiency_scene_is_bond_based(all->result[n].scene) && !all->result[n].scene->spacing) n++;
    return n;
}

static void draw_share(FILE *to, const struct efficiency *all, int panel)
{
    const struct result *x = &all->result[panel];
    const double width = 0.88 / panels(all), left = 0.09 + panel * width;
    const int marks = x->scene->marks;
    fprintf(to, "$share%d << EOD\n", panel);
    for (int k = 0; k <= SAMPLES; k++)
        fprintf(to, "%.6g %.6g\n", 1e6 * x->run[SHOWN].time[k], 100 * x->run[SHOWN].share[k]);
    fprintf(to, "EOD\n$mark%d << EOD\n", panel);
    for (int k = 0; k < marks; k++)
        fprintf(to, "%.6g %.6g\n", 1e6 * x->scene->mark[k].time, 100 * x->scene->mark[k].share);
    fprintf(to, "EOD\nset lmargin at screen %.4f\nset rmargin at screen %.4f\nset title '%s'\n", left,
            left + width - 0.045, x->scene->name);
    if (panel == 0) fputs("set ylabel 'peridynamic particles [%]'\n", to);
    fprintf(to, "plot $share%d using 1:2 with lines lw 2.4 lc rgb '%s' title '%s'", panel, curve_colour[0],
            marks ? "here" : "");
    if (marks)
        fprintf(to, ", $mark%d using 1:2 with points pt 7 ps 1.4 lc rgb '%s' title 'paper'", panel, curve_colour[4]);
    fputs("\nset ylabel ''\n", to);
}

static void efficiency_draw(FILE *to, const void *context)
{
    const struct efficiency *all = context;
    fputs("set multiplot\n", to);
    draw_bars(to, all);
    fputs("set offsets 0, 0, graph 0.1, 0\nset xtics auto scale 0.5\nset style data lines\nset xrange [0:*]\nset "
          "yrange [0:*]\nset xlabel 'time [us]'\nset bmargin at screen 0.09\n"
          "set tmargin at screen 0.46\nset key inside left top vertical maxrows 2\n",
          to);
    for (int k = 0; k < panels(all); k++) draw_share(to, all, k);
    fputs("unset multiplot\n", to);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Measures all scenes that exist, stores their results in *all, prints a line for each adaptive variant, and writes
 * tables and picture. quick: only short scenes, once each. Returns REFUSED if no scene exists, FAILED if a run or a
 * file fails. */
static status efficiency_measure_all(struct efficiency *all, bool quick)
{
    const int repetitions = quick ? 1 : REPETITIONS;
    efficiency_print_header(repetitions);
    for (int k = 0; k < CASES; k++) {
        if (!bench_scene_exists(efficiency_case[k].path) || (quick && !efficiency_case[k].quick)) continue;
        struct result *x = &all->result[all->n];
        x->scene = &efficiency_case[k];
        TRY(scene_measure(x, repetitions));
        for (int variant = 1; variant < VARIANTS; variant++)
            if (efficiency_variant_is_run_for_scene(x->scene, variant)) print_variant(x, variant);
        all->n++;
    }
    if (all->n == 0)
        return status_set(REFUSED, "bench efficiency: none of its scenes is here; start it where the folder inputs is");
    print_marks(all);
    TRY(efficiency_write_tables(all));
    return bench_draw("efficiency", 1200, 820, efficiency_draw, all);
}

status bench_efficiency(bool quick)
{
    struct efficiency all = {.result = NEW("bench.efficiency", CASES, struct result)};
    printf("efficiency\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    status s = efficiency_measure_all(&all, quick);
    memory_free(all.result);
    return s;
}
