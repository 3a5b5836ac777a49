/* Picture of a pulse that crosses the interface of a bar: velocity along the bar at three times, and the magnified
 * difference from a bar without interface, for two couplings. */
#include <math.h>

#include "coupling.h"
#include "plot/gnuplot.h"
#include "base/memory.h"

/* TIMES, COLUMNS: numbers of times and couplings that are drawn; MAGNIFIED: factor on the differences; WIDTH: of the
 * pulse [mm]. */
enum { TIMES = 3, COLUMNS = 2, MAGNIFIED = 20, WIDTH = 64 };
static const int column_variant[COLUMNS] = {VARIANT_HANDSHAKE, VARIANT_DAMPED};
static const double time_ms[TIMES] = {1.28, 2.56, 3.84}; /* pulse 128 mm before, at and 128 mm beyond the interface */
static const char *const time_name[TIMES] = {"before", "at the interface", "after"};
static const double from_mm = 272, to_mm = 752, interface_mm = 512;

/* Velocities along the bar [mm/s], and their differences from a bar with material points only. */
struct snapshot {
    double *x, *v, *difference;
};
struct pulse_picture {
    int64_t n;
    struct snapshot shot[COLUMNS][TIMES];
};

static status pulse_bar_make(struct run *run, struct scene *s, int variant)
{
    struct bench_overrides o = {0};
    if (variant >= 0)
        coupling_variant_append_overrides(&o, variant);
    else
        bench_overrides_append(&o, "method", "mpm");
    bench_overrides_append(&o, "initial[0].pulse.width", "%d mm", WIDTH);
    bench_overrides_append(&o, "output.samples", "1");
    return bench_engine_make(run, s, COUPLING_BAR, NULL, bench_overrides_as_array(&o), o.n);
}

/* Stores positions [mm], velocities, and differences of velocity from the bar without interface [mm/s] in *shot, in
 * allocated arrays with an entry per particle. p, plain: particles of the bars with and without interface, which are
 * numbered alike. */
static void coupling_pulse_take(struct snapshot *shot, const struct particles *p, const struct particles *plain)
{
    shot->x = NEW("bench.snapshot", p->n, double);
    shot->v = NEW("bench.snapshot", p->n, double);
    shot->difference = NEW("bench.snapshot", p->n, double);
    for (int64_t i = 0; i < p->n; i++) {
        shot->x[i] = 1e3 * p->X[0][i];
        shot->v[i] = 1e3 * p->v[0][i];
        shot->difference[i] = 1e3 * (p->v[0][i] - plain->v[0][i]);
    }
}

static status column_run(struct pulse_picture *picture, int column)
{
    struct run e[2]; /* coupled run; run with material points only */
    struct scene s[2];
    TRY(pulse_bar_make(&e[0], &s[0], column_variant[column]));
    status ran = pulse_bar_make(&e[1], &s[1], -1);
    if (ran != OK) {
        bench_engine_free(&e[0], &s[0]);
        return ran;
    }
    picture->n = e[0].part.n;
    for (int k = 0; k < TIMES && ran == OK; k++) {
        const int64_t until = llround(1e-3 * time_ms[k] / e[0].clock.dt);
        for (int b = 0; b < 2 && ran == OK; b++) ran = bench_engine_run(&e[b], until, NULL);
        if (ran == OK) coupling_pulse_take(&picture->shot[column][k], &e[0].part, &e[1].part);
    }
    for (int b = 0; b < 2; b++) bench_engine_free(&e[b], &s[b]);
    return ran;
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

/* Sends snapshot k of a coupling to gnuplot as a data block: position, velocity and difference of velocity of each
 * particle. column: column of the picture, which belongs to the coupling. */
static void put_shot(FILE *to, const struct pulse_picture *picture, int column, int k)
{
    const struct snapshot *shot = &picture->shot[column][k];
    fprintf(to, "$shot%d%d << EOD\n", column, k);
    for (int64_t i = 0; i < picture->n; i++)
        if (shot->x[i] >= from_mm && shot->x[i] <= to_mm)
            fprintf(to, "%.6g %.6g %.6g\n", shot->x[i], shot->v[i], shot->difference[i]);
    fputs("EOD\n", to);
}

static void coupling_pulse_draw_panel(FILE *to, int column, int k)
{
    const double left = 0.065 + 0.48 * column, above = 0.87 - 0.265 * k;
    fprintf(
        to,
        "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n"
        "set xlabel '%s'\nset format x '%s'\nset ylabel '%s'\nset label 1 '%.2f ms: %s' at graph 0.02, graph 0.91\n",
        left, left + 0.435, above, above - 0.235, k == TIMES - 1 ? "place along the bar [mm]" : "",
        k == TIMES - 1 ? "%g" : "", column ? "" : "velocity [mm/s]", time_ms[k], time_name[k]);
    fprintf(to, "set label 2 '%s' at graph 0.5, graph 1.1 center font ',16'\n",
            k == 0 ? coupling_variant[column_variant[column]].name : "");
    fprintf(to, "set label 3 'material points' at graph 0.48, graph 0.06 right tc rgb '#777777'\n"
                "set label 4 'bonds' at graph 0.52, graph 0.06 left tc rgb '#777777'\n");
    fprintf(to,
            "plot $shot%d%d using 1:2 smooth unique with lines lw 2.6 lc rgb '%s' title '%s', "
            "'' using ($1 < %g ? $1 : NaN):(%d*$3) smooth unique with lines lw 1.8 lc rgb '%s' title '%s'\n",
            column, k, curve_colour[0], column || k ? "" : "velocity", interface_mm, MAGNIFIED, curve_colour[1],
            column || k ? "" : "what came back, 20 times");
}

static void coupling_pulse_draw(FILE *to, const void *context)
{
    const struct pulse_picture *picture = context;
    for (int column = 0; column < COLUMNS; column++)
        for (int k = 0; k < TIMES; k++) put_shot(to, picture, column, k);
    fprintf(to,
            "set multiplot\nset xrange [%g:%g]\nset yrange [-0.55:1.45]\nset ytics 0, 0.5\nset xtics 300, 100\n"
            "set object 1 rectangle from %g, graph 0 to %g, graph 1 behind fc rgb '#f1f4f8' fs solid noborder\n"
            "set arrow 1 from %g, graph 0 to %g, graph 1 nohead dt (6,4) lw 1.4 lc rgb '#3d3d3d'\n"
            "set key at screen 0.52,0.975 center top horizontal maxrows 1\n",
            from_mm, to_mm, interface_mm, to_mm, interface_mm, interface_mm);
    for (int column = 0; column < COLUMNS; column++)
        for (int k = 0; k < TIMES; k++) coupling_pulse_draw_panel(to, column, k);
    fputs("unset multiplot\n", to);
}

static status coupling_pulse_write_table(const struct pulse_picture *picture)
{
    struct bench_table rows;
    bench_table_make(&rows, "", "coupling,time,x,velocity,difference");
    for (int column = 0; column < COLUMNS; column++)
        for (int k = 0; k < TIMES; k++)
            for (int64_t i = 0; i < picture->n; i++) {
                const struct snapshot *shot = &picture->shot[column][k];
                bench_table_append_text(&rows, coupling_variant[column_variant[column]].name);
                bench_table_append_number(&rows, 1e-3 * time_ms[k]);
                bench_table_append_number(&rows, 1e-3 * shot->x[i]);
                bench_table_append_number(&rows, 1e-3 * shot->v[i]);
                bench_table_append_number(&rows, 1e-3 * shot->difference[i]);
            }
    status s = bench_write_result_tables("coupling_pulse", &rows, 1);
    bench_table_free(&rows);
    return s;
}

status coupling_draw_picture_of_pulse(void)
{
    struct pulse_picture picture = {0};
    status s = OK;
    for (int column = 0; column < COLUMNS && s == OK; column++) s = column_run(&picture, column);
    if (s == OK) s = coupling_pulse_write_table(&picture);
    if (s == OK) s = bench_draw("coupling_pulse", 1200, 760, coupling_pulse_draw, &picture);
    for (int column = 0; column < COLUMNS; column++)
        for (int k = 0; k < TIMES; k++) {
            memory_free(picture.shot[column][k].x);
            memory_free(picture.shot[column][k].v);
            memory_free(picture.shot[column][k].difference);
        }
    return s;
}
