/* `cleave bench sensitivity`: sensitivity of crack paths to the time step. Cracks select among nearly equivalent paths,
 * so that a time step 1 % longer may lead to another path. Runs the scenes of `cleave bench efficiency` with time steps
 * from 0.9 to 1.1 of their own, with full peridynamics and adaptively, and compares the scatter of crack ends, angles
 * and start times within each method with the difference of the means. Differences smaller than the scatter do not
 * distinguish the methods. */
#include <math.h>
#include <stdio.h>

#include "efficiency.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "fracture/tips.h"
#include "scene/scene_read.h"

/* STEPS, STEPS_QUICK: numbers of time steps without and with --quick; METHODS: number of methods. */
enum { STEPS = 9, STEPS_QUICK = 3, METHODS = 2 };
#define STEP_RANGE 0.1 /* the time steps lie within this share of the scene's own */
static const int variant_of[METHODS] = {VARIANT_PD, VARIANT_FRAME};

/* Crack that is compared at the end of a run with the time step dt [s]: start time [s], angle [degree] and position
 * of the tip [m]. */
struct end {
    double dt, start, angle;
    real place[DIM_MAX];
};

/* Means over runs that differ in the time step, and root-mean-square deviations from them: start time [s], angle
 * [degree], position of the crack tip [m]. */
struct spread {
    double start, start_scatter, angle, angle_scatter, place_scatter;
    real place[DIM_MAX];
};

struct scatter {
    const struct scene_case *scene;
    int runs, dim;
    double spacing;
    struct end end[METHODS][STEPS];
    struct spread spread[METHODS];
};

struct all_scatters {
    int n;
    struct scatter *at;
};

/* Returns true if case c is run. Returns false for scenes in 3D with a finer spacing than that of the scene file, since
 * their runs take minutes each. dim: dimension of the scene. */
static bool is_short(const struct scene_case *c, int dim) { return !(c->spacing && dim == 3); }

static double factor_of(int run, int runs) { return 1 + STEP_RANGE * (2.0 * run / (runs - 1) - 1); }

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Runs the scene of x with one method and the time step dt [s], and stores its crack tips in *ends and its spacing in
 * x->spacing. method: index in variant_of[]. Returns FAILED or REFUSED if the run does. */
static status sensitivity_run_once(struct scatter *x, int method, double dt, struct crack_ends *ends)
{
    struct scene s;
    struct run e;
    TRY(efficiency_make_run_of_variant(&e, &s, x->scene, variant_of[method], dt));
    x->spacing = s.spacing;
    status ran = bench_engine_run(&e, e.clock.steps, NULL);
    if (ran == OK) crack_ends_store_from_run(ends, &e);
    bench_engine_free(&e, &s);
    return ran;
}

/* Runs the scene of x with both methods and x->runs time steps around dt [s]. Stores start time, tip position and angle
 * of one crack per run in x->end: that crack whose tip is nearest to the tip of the longest crack of the first run.
 * Returns FAILED or REFUSED if a run does. */
static status sensitivity_run_all(struct scatter *x, double dt)
{
    struct crack_ends *ends = NEW("bench.ends", 2, struct crack_ends);
    status ran = OK;
    for (int m = 0; m < METHODS && ran == OK; m++)
        for (int r = 0; r < x->runs && ran == OK; r++) {
            struct end *end = &x->end[m][r];
            const bool first = m == 0 && r == 0;
            struct crack_ends *own = &ends[first ? 0 : 1];
            *end = (struct end){.dt = dt * factor_of(r, x->runs), .angle = NAN, .place = {NAN, NAN, NAN}};
            ran = sensitivity_run_once(x, m, end->dt, own);
            if (ran != OK || ends[0].longest < 0) continue;
            const struct crack_tip *tip = crack_tip_nearest_in_other_run(own, &ends[0].tip[ends[0].longest]);
            end->start = own->start;
            if (!tip) continue;
            end->angle = tip_deflection_angle(tip, x->dim);
            for (int d = 0; d < DIM_MAX; d++) end->place[d] = tip->place[d];
        }
    memory_free(ends);
    return ran;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Computes the means of start time [s], crack angle [degree] and tip position [m] over the runs end[n], and the
 * root-mean-square deviations from these means, and stores them in *s. */
static void spread_find(struct spread *s, const struct end *end, int n)
{
    double start = 0, angle = 0, place = 0;
    *s = (struct spread){0};
    for (int r = 0; r < n; r++) {
        s->start += end[r].start / n, s->angle += end[r].angle / n;
        for (int d = 0; d < DIM_MAX; d++) s->place[d] += end[r].place[d] / n;
    }
    for (int r = 0; r < n; r++) {
        start += square(end[r].start - s->start), angle += square(end[r].angle - s->angle);
        place += square(position_distance(end[r].place, s->place));
    }
    s->start_scatter = sqrt(start / n), s->angle_scatter = sqrt(angle / n), s->place_scatter = sqrt(place / n);
}

static void print_scatter(const struct scatter *x)
{
    const struct spread *a = &x->spread[0], *b = &x->spread[1];
    char title[48];
    printf("  %-26s %-5s %6.2f > %5.2f us %5.1f %% %7.1f +- %4.1f > %5.1f +- %4.1f %5.1f  %6.2f %8.2f %6.2f\n",
           efficiency_title(x->scene, title, sizeof title), x->scene->model, 1e6 * a->start, 1e6 * b->start,
           100 * (b->start / a->start - 1), a->angle, a->angle_scatter, b->angle, b->angle_scatter,
           fabs(a->angle - b->angle), a->place_scatter / x->spacing, b->place_scatter / x->spacing,
           position_distance(a->place, b->place) / x->spacing);
    fflush(stdout);
}

static void add_names(struct bench_table *t, const struct scatter *x, int method)
{
    char title[48];
    bench_table_append_text(t, efficiency_title(x->scene, title, sizeof title));
    bench_table_append_text(t, x->scene->model);
    bench_table_append_text(t, efficiency_variant[variant_of[method]].method);
}

static void add_rows(struct bench_table *table, const struct scatter *x)
{
    for (int m = 0; m < METHODS; m++) {
        const struct spread *s = &x->spread[m];
        const double row[] = {(double)x->runs, s->start,    s->start_scatter, s->angle,         s->angle_scatter,
                              s->place[0],     s->place[1], s->place[2],      s->place_scatter, x->spacing};
        add_names(&table[0], x, m);
        for (size_t c = 0; c < COUNT_OF(row); c++) bench_table_append_number(&table[0], row[c]);
        for (int r = 0; r < x->runs; r++) {
            const struct end *end = &x->end[m][r];
            const double run[] = {end->dt, end->start, end->angle, end->place[0], end->place[1], end->place[2]};
            add_names(&table[1], x, m);
            for (size_t c = 0; c < COUNT_OF(run); c++) bench_table_append_number(&table[1], run[c]);
        }
    }
}

static status sensitivity_write_tables(const struct all_scatters *all)
{
    struct bench_table table[2];
    bench_table_make(
        &table[0], "",
        "scene,model,method,runs,start,start_scatter,angle_deg,angle_scatter_deg,x,y,z,place_scatter,spacing");
    bench_table_make(&table[1], "runs", "scene,model,method,time_step,start,angle_deg,x,y,z");
    for (int k = 0; k < all->n; k++) add_rows(table, &all->at[k]);
    status s = bench_write_result_tables("sensitivity", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s;
}

/* ---- picture ----------------------------------------------------------------------------------------------------- */

/* Sends the commands of the picture to gnuplot: for each scene a column with both methods side by side, with the
 * distance of the crack tip of every run from the mean tip position of full peridynamics. context: a struct
 * all_scatters. */
static void sensitivity_draw(FILE *to, const void *context)
{
    const struct all_scatters *all = context;
    for (int m = 0; m < METHODS; m++) {
        fprintf(to, "$m%d << EOD\n", m);
        for (int k = 0; k < all->n; k++) {
            const struct scatter *x = &all->at[k];
            for (int r = 0; r < x->runs; r++)
                fprintf(to, "%.4g %.6g\n", k + 0.36 * (m - 0.5) + 0.02 * (r - x->runs / 2),
                        position_distance(x->end[m][r].place, x->spread[0].place) / x->spacing);
        }
        fputs("EOD\n", to);
    }
    fputs("set xtics scale 0 font ',7' (", to);
    for (int k = 0; k < all->n; k++) {
        if (k > 0) fputs(", ", to);
        efficiency_write_tic_label(to, all->at[k].scene);
        fprintf(to, " %d", k);
    }
    fprintf(
        to,
        ")\nset xrange [-0.6:%g]\nset yrange [0:*]\nset offsets 0, 0, graph 0.05, 0\nset ylabel 'distance [spacings]'\n"
        "set title 'ends of cracks, from the mean of full peridynamics: steps from %g to %g of the scene''s own'\n"
        "set key inside top left\nset bmargin 6\n"
        "plot $m0 using 1:2 with points pt 7 ps 0.9 lc rgb '%s' title 'full peridynamics', "
        "$m1 using 1:2 with points pt 6 ps 1.1 lc rgb '%s' title 'adaptive'\n",
        all->n - 0.4, 1 - STEP_RANGE, 1 + STEP_RANGE, curve_colour[0], curve_colour[4]);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Runs the scene of x with all time steps and both methods, and computes means and scatter of its crack tips. quick:
 * fewer time steps. Returns FAILED or REFUSED if a run does. */
static status sensitivity_measure(struct scatter *x, bool quick)
{
    double dt;
    x->runs = quick ? STEPS_QUICK : STEPS;
    TRY(efficiency_find_common_time_step(x->scene, &dt));
    TRY(sensitivity_run_all(x, dt));
    for (int m = 0; m < METHODS; m++) spread_find(&x->spread[m], x->end[m], x->runs);
    return OK;
}

static status sensitivity_measure_all(struct all_scatters *all, bool quick)
{
    printf("  %d runs of each, steps from %g to %g of the scene's own; full peridynamics > adaptive; ends of cracks in "
           "spacings\n",
           quick ? STEPS_QUICK : STEPS, 1 - STEP_RANGE, 1 + STEP_RANGE);
    printf("  %-26s %-5s %24s %37s  %6s %8s %6s\n", "", "model", "starts", "angles and their difference", "pd +-",
           "ad. +-", "apart");
    for (int k = 0; k < EFFICIENCY_CASES; k++) {
        const struct scene_case *c = &efficiency_case[k];
        struct scene s;
        if (!bench_scene_exists(c->path) || (quick && !c->quick)) continue;
        TRY(scene_read(&s, c->path, NULL, 0));
        const int dim = s.dim;
        scene_free(&s);
        if (!is_short(c, dim)) continue;
        struct scatter *x = &all->at[all->n];
        *x = (struct scatter){.scene = c, .dim = dim};
        TRY(sensitivity_measure(x, quick));
        print_scatter(x);
        all->n++;
    }
    if (all->n == 0)
        return status_set(REFUSED, "bench sensitivity: its scenes are not here; start it where the folder inputs is");
    TRY(sensitivity_write_tables(all));
    return bench_draw("sensitivity", 1200, 560, sensitivity_draw, all);
}

status bench_sensitivity(bool quick)
{
    struct all_scatters all = {.at = NEW("bench.scatter", EFFICIENCY_CASES, struct scatter)};
    printf("sensitivity\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    status s = sensitivity_measure_all(&all, quick);
    memory_free(all.at);
    return s;
}
