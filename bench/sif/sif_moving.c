/* Plane waves load a semi-infinite crack, stationary or moving: K_I(t) compared with Freund's solution, and the effects
 * of gradual bond release, time step, horizon, spacing and irregular particles (Imachi et al. 2019, figures 6, 7 and 9
 * to 12). Ripple is the root-mean-square deviation from a parabola over 5 to 9 us over the mean, of the probe's factor
 * and of the sum over the whole disc, which the paper uses; the probe leaves out the process zone. */
#include <math.h>
#include <string.h>

#include "sif_bench.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "fracture/sif_fields.h"
#include "scene/scene_read.h"

#define SCENE "inputs/semi_infinite_crack.yaml"

static const double speed = 1000;                      /* speed of the crack [m/s] */
static const double stress = 2e6, path_length = 20e-3; /* stress on the crack plane [Pa]; distance of the wave fronts
                                                        * from the crack [m] */
static const double window[2] = {5e-6, 9e-6};          /* times between which ripple is evaluated [s] */
static const double is_current = 5.5e-6;               /* time from which a moving crack is compared [s] */

/* Figures of Imachi et al. (2019) to which a case belongs, as bits. */
enum { LENGTH = 1, EXPONENT = 2, STEP = 4, HORIZON = 8, SPACING = 16, IRREGULAR = 32, OTHER = 64, EACH = 63 };
static const struct {
    int bit;
    const char *name, *title;
} group[] = {{LENGTH, "damping", "damping length, exponent 1 (figure 6)"},
             {EXPONENT, "exponent", "exponent, half a horizon (figure 7)"},
             {STEP, "step", "time step (figure 9)"},
             {HORIZON, "horizon", "horizon (figure 10)"},
             {SPACING, "spacing", "spacing (figure 11)"},
             {IRREGULAR, "irregular", "irregular particles (figure 12)"}};

#define SUDDEN                                                                                                         \
    {                                                                                                                  \
        "growth[0].damping", "0 mm"                                                                                    \
    }
enum { PAIRS = 4, QUICK = 2 /* number of rows with --quick, from the first; one has a moving crack */ };
static const struct moving_case {
    const char *name;
    int groups;
    struct {
        const char *key, *value;
    } pair[PAIRS];
} moving_case[] = {
    {"at rest", OTHER, {{"growth", ""}}},
    {"moving: as it stands", EACH, {{NULL, NULL}}},
    {"sudden release", EACH, {SUDDEN}},
    {"damping of a horizon, exponent 1", LENGTH, {{"growth[0].damping", "1 mm"}, {"growth[0].exponent", "1"}}},
    {"damping of a half, exponent 1", LENGTH | EXPONENT, {{"growth[0].exponent", "1"}}},
    {"damping of a quarter, exponent 1", LENGTH, {{"growth[0].damping", "0.25 mm"}, {"growth[0].exponent", "1"}}},
    {"damping of a horizon, exponent 4", OTHER, {{"growth[0].damping", "1 mm"}}},
    {"damping of a quarter, exponent 4", OTHER, {{"growth[0].damping", "0.25 mm"}}},
    {"exponent 2", EXPONENT, {{"growth[0].exponent", "2"}}},
    {"step 10 ns", STEP, {{"time.step", "10 ns"}}},
    {"step 10 ns, sudden", STEP, {{"time.step", "10 ns"}, SUDDEN}},
    {"step 25 ns", STEP, {{"time.step", "25 ns"}}},
    {"step 25 ns, sudden", STEP, {{"time.step", "25 ns"}, SUDDEN}},
    {"horizon 3.5", HORIZON, {{"particles.horizon", "3.5"}}},
    {"horizon 3.5, sudden", HORIZON, {{"particles.horizon", "3.5"}, SUDDEN}},
    {"horizon 4.5", HORIZON, {{"particles.horizon", "4.5"}}},
    {"horizon 4.5, sudden", HORIZON, {{"particles.horizon", "4.5"}, SUDDEN}},
    {"spacing 0.5 mm", SPACING, {{"particles.spacing", "0.5 mm"}}},
    {"spacing 0.5 mm, sudden", SPACING, {{"particles.spacing", "0.5 mm"}, SUDDEN}},
    {"spacing 0.2 mm", SPACING, {{"particles.spacing", "0.2 mm"}, {"time.step", "16 ns"}}},
    {"spacing 0.2 mm, sudden", SPACING, {{"particles.spacing", "0.2 mm"}, {"time.step", "16 ns"}, SUDDEN}},
    {"spacing 0.1 mm", SPACING, {{"particles.spacing", "0.1 mm"}, {"time.step", "10 ns"}}},
    {"spacing 0.1 mm, sudden", SPACING, {{"particles.spacing", "0.1 mm"}, {"time.step", "10 ns"}, SUDDEN}},
    {"irregular 0.3", IRREGULAR, {{"particles.irregularity", "0.3"}}},
    {"irregular 0.3, sudden", IRREGULAR, {{"particles.irregularity", "0.3"}, SUDDEN}},
    {"irregular 0.3, another seed", IRREGULAR, {{"particles.irregularity", "0.3"}, {"particles.seed", "2"}}},
    {"mospd", OTHER, {{"model", "mospd"}}},
    {"spacing 0.5 mm, adaptive", OTHER, {{"method", "adaptive"}, {"particles.spacing", "0.5 mm"}}},
};
enum { CASES = COUNT_OF(moving_case), SAMPLES = 92 };

struct moving_row {
    const struct moving_case *at;
    bool moves;
    double low, high, mean; /* K over the exact value */
    double ripple[2];       /* ripple of the probe's factor; of the sum over the whole disc */
    double seconds;
    int n;
    double t[SAMPLES + 2], K[2][SAMPLES + 2]; /* [s] [Pa m^0.5]                           */
};
struct moving_table {
    struct crack_medium medium;
    double factor, printed; /* factor k(v): exact; as printed in the paper */
    struct moving_row row[CASES];
    int n;
};

/* ---- the closed form --------------------------------------------------------------------------------------------- */

/* Computes the material constants of the scene and the factor k(v) of Freund's closed form, K(v) = k(v) K(0) at the
 * crack speed v: t->factor exactly, t->printed by the approximation that is usually printed. Returns FAILED or REFUSED
 * if the scene cannot be read. */
static status closed_form(struct moving_table *t)
{
    struct scene s = {0};
    TRY(scene_read(&s, SCENE, NULL, 0));
    t->medium = crack_medium_of_material(&s.material[0], s.space);
    t->factor = crack_moving_to_resting_sif_ratio(&t->medium, SPEED_EXACT, speed);
    t->printed = crack_moving_to_resting_sif_ratio(&t->medium, SPEED_APPROXIMATE, speed);
    scene_free(&s);
    return OK;
}

static double sif_moving_at_rest(const struct moving_table *t, double time)
{
    return crack_sif_after_plane_wave(&t->medium, stress, time - path_length / t->medium.longitudinal);
}

/* ---- ripple ------------------------------------------------------------------------------------------------------ */

/* Returns the ripple of a curve with n points (x, y): the root-mean-square deviation of y from the parabola fitted to
 * the points, over the mean of y. */
static double ripple_of(const double *x, const double *y, int n)
{
    double basis[3][SAMPLES + 2], rest[SAMPLES + 2], mean = 0, square_sum = 0;
    for (int k = 0; k < n; k++) rest[k] = y[k], mean += y[k] / n;
    for (int m = 0; m < 3; m++) {
        double along = 0, size = 0;
        for (int k = 0; k < n; k++) basis[m][k] = m == 0 ? 1 : basis[m - 1][k] * (x[k] - x[0]) / (x[n - 1] - x[0]);
        for (int l = 0; l < m; l++) {
            double part = 0, whole = 0;
            for (int k = 0; k < n; k++) part += basis[m][k] * basis[l][k], whole += basis[l][k] * basis[l][k];
            for (int k = 0; k < n; k++) basis[m][k] -= part / whole * basis[l][k];
        }
        for (int k = 0; k < n; k++) along += rest[k] * basis[m][k], size += basis[m][k] * basis[m][k];
        for (int k = 0; k < n; k++) rest[k] -= along / size * basis[m][k];
    }
    for (int k = 0; k < n; k++) square_sum += rest[k] * rest[k];
    return sqrt(square_sum / n) / mean;
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Reads K_I over time from the history of a run into *r: K[0] by the probe that excludes the process zone, K[1] by the
 * sum over the whole disc around the tip. folder: of the run. Returns FAILED if the history cannot be read. */
static status read_curves(struct moving_row *r, const char *folder)
{
    struct history h = {0};
    TRY(history_read(&h, folder));
    const int time = history_find_column(&h, "time"),
              K[2] = {history_find_column(&h, "sif.K_I"), history_find_column(&h, "disc.K_I")};
    for (int64_t k = 0; k < h.rows && r->n < SAMPLES + 2; k++, r->n++) {
        r->t[r->n] = history_value_at(&h, k, time);
        for (int p = 0; p < 2; p++) r->K[p][r->n] = history_value_at(&h, k, K[p]);
    }
    history_free(&h);
    return OK;
}

static void find_figures(struct moving_row *r, const struct moving_table *t)
{
    int first = r->n, end = 0, judged = 0;
    r->low = INFINITY, r->high = -INFINITY, r->mean = 0;
    for (int k = 0; k < r->n; k++) {
        if (r->t[k] < window[0] * (1 - 1e-9) || r->t[k] > window[1] * (1 + 1e-9)) continue;
        if (k < first) first = k;
        end = k + 1;
        if (r->moves && r->t[k] < is_current * (1 - 1e-9)) continue;
        const double ratio = r->K[0][k] / sif_moving_at_rest(t, r->t[k]) / (r->moves ? t->factor : 1);
        r->low = fmin(r->low, ratio), r->high = fmax(r->high, ratio), r->mean += ratio, judged++;
    }
    r->mean /= judged;
    for (int p = 0; p < 2; p++)
        r->ripple[p] = end > first ? ripple_of(r->t + first, r->K[p] + first, end - first) : NAN;
}

static struct moving_table *table; /* table of the run that is being read */

static status sif_moving_take_row(void *row, const char *folder)
{
    struct moving_row *r = row;
    TRY(read_curves(r, folder));
    find_figures(r, table);
    r->seconds = bench_summary_figure(folder, "loop_seconds");
    printf("  %-34s %6.3f .. %5.3f  %6.3f  %6.2f %% %6.2f %% %8.1f\n", r->at->name, r->low, r->high, r->mean,
           100 * r->ripple[0], 100 * r->ripple[1], r->seconds);
    return OK;
}

static struct bench_job job_of(struct moving_row *r, const struct moving_case *c)
{
    struct bench_job job = {.path = SCENE, .row = r, .take = sif_moving_take_row};
    *r = (struct moving_row){.at = c, .moves = !c->pair[0].key || strcmp(c->pair[0].key, "growth") != 0};
    for (int k = 0; k < PAIRS && c->pair[k].key; k++)
        bench_overrides_append(&job.overrides, c->pair[k].key, "%s", c->pair[k].value);
    return job;
}

/* Makes all runs of t, as many at a time as there are threads, each on one thread, so that times are those of one
 * thread. quick: only the first QUICK cases. Returns FAILED if a run fails. */
static status sif_moving_run_all(struct moving_table *t, bool quick)
{
    struct bench_job job[CASES];
    t->n = quick ? QUICK : CASES;
    for (int k = 0; k < t->n; k++) job[k] = job_of(&t->row[k], &moving_case[k]);
    table = t;
    return bench_jobs_run(job, t->n, threads_set_count_and_bind_to_cores(0));
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Fills `rows`, an uninitialised table for files, with K_I over time of all runs in t, and with the exact values at the
 * same times. */
static void fill_curves(struct bench_table *rows, const struct moving_table *t)
{
    bench_table_make(rows, "curves", "name,time,K_I,K_I_disc,K_I_exact,K_I_printed");
    for (int k = 0; k < t->n; k++) {
        const struct moving_row *r = &t->row[k];
        for (int i = 0; i < r->n; i++) {
            const double rest = sif_moving_at_rest(t, r->t[i]);
            bench_table_append_text(rows, r->at->name);
            const double number[] = {r->t[i], r->K[0][i], r->K[1][i], rest * (r->moves ? t->factor : 1),
                                     rest * (r->moves ? t->printed : 1)};
            for (size_t m = 0; m < COUNT_OF(number); m++) bench_table_append_number(rows, number[m]);
        }
    }
}

static status sif_moving_write_tables(const struct moving_table *t)
{
    struct bench_table rows[2];
    bench_table_make(&rows[0], "", "name,low,high,mean,ripple,ripple_disc,seconds");
    for (int k = 0; k < t->n; k++) {
        const struct moving_row *r = &t->row[k];
        bench_table_append_text(&rows[0], r->at->name);
        const double number[] = {r->low, r->high, r->mean, r->ripple[0], r->ripple[1], r->seconds};
        for (size_t m = 0; m < COUNT_OF(number); m++) bench_table_append_number(&rows[0], number[m]);
    }
    fill_curves(&rows[1], t);
    status s = bench_write_result_tables("moving_crack", rows, COUNT_OF(rows));
    for (size_t k = 0; k < COUNT_OF(rows); k++) bench_table_free(&rows[k]);
    return s;
}

struct moving_picture {
    const struct moving_table *t;
    int group;
};

static bool is_sudden(const struct moving_case *c)
{
    for (int k = 0; k < PAIRS && c->pair[k].key; k++)
        if (!strcmp(c->pair[k].value, "0 mm")) return true;
    return false;
}

/* Sends K_I over sigma (pi a)^(1/2) for all runs in t of the figures `groups` and the exact curves to gnuplot. sigma:
 * stress on the crack plane; a = 12 mm, as in Imachi et al. (2019); groups: figures of that paper, as bits. */
static void put_curves(FILE *to, const struct moving_table *t, int groups)
{
    const double size = stress * sqrt(3.14159265358979 * 12e-3);
    for (int k = 0; k < t->n; k++) {
        const struct moving_row *r = &t->row[k];
        if (!(r->at->groups & groups)) continue;
        fprintf(to, "$moving%d << EOD\n", k);
        for (int i = 0; i < r->n; i++)
            fprintf(to, "%.6g %.6g %.6g\n", 1e6 * r->t[i], r->K[0][i] / size, r->K[1][i] / size);
        fputs("EOD\n", to);
    }
    fputs("$exact << EOD\n", to);
    for (double time = 3.2e-6; time < 9.2e-6; time += 0.05e-6) {
        const double rest = sif_moving_at_rest(t, time) / size;
        fprintf(to, "%.6g %.6g %.6g %.6g\n", 1e6 * time, rest, rest * t->factor, rest * t->printed);
    }
    fputs("EOD\n", to);
}

static bool release_methods(int groups) { return groups == LENGTH || groups == EXPONENT; }

/* Returns true if case c is drawn in panel `column` (1 or 2) of the picture for the figures `groups` of Imachi et al.
 * (2019), as bits. If the picture compares methods of releasing bonds, both panels show all cases; else panel 2 shows
 * the cases with immediate release and panel 1 the others. */
static bool is_shown(const struct moving_case *c, int groups, int column)
{
    return (c->groups & groups) && (release_methods(groups) || is_sudden(c) == (column == 2));
}

/* Draws one of two panels with K_I over time in the runs of t. column: 1 for the upper panel, K_I by the probe without
 * the process zone; 2 for the lower panel, K_I by the sum over the whole disc around the tip, as in Imachi et al.
 * (2019). groups: figures of that paper whose cases are drawn, as bits; what: title. */
static void sif_moving_draw_panel(FILE *to, const struct moving_table *t, int groups, int column, const char *what)
{
    const double above = column < 2 ? 0.93 : 0.45;
    int colour = 0;
    fprintf(
        to,
        "set lmargin at screen 0.07\nset rmargin at screen 0.67\nset tmargin at screen %g\nset bmargin at screen %g\n"
        "set title '%s'\nset key at screen 0.68,%g left top vertical maxrows 12\n",
        above, above - 0.36, what, above);
    fputs(
        "plot $exact using ($1 >= 4.4 ? $1 : NaN):3 with lines lw 2 dt (6,4) lc rgb '#111111' title 'exact, 1000 m/s', "
        "'' using ($1 >= 4.4 ? $1 : NaN):4 with lines lw 2 dt (2,3) lc rgb '#777777' title 'printed approximation', "
        "'' using 1:2 with lines lw 1.4 dt (6,4) lc rgb '#777777' title 'exact, at rest'",
        to);
    for (int k = 0; k < t->n; k++) {
        const struct moving_case *c = t->row[k].at;
        if (!is_shown(c, groups, column)) continue;
        fprintf(to, ", $moving%d using 1:%d with lines lw 2.4 lc rgb '%s' title '%s'", k, column + 1,
                curve_colour[colour++ % CURVE_COLOURS], c->name);
    }
    fputc('\n', to);
}

static void sif_moving_draw(FILE *to, const void *context)
{
    const struct moving_picture *p = context;
    const int groups = group[p->group].bit;
    put_curves(to, p->t, groups);
    fputs("set multiplot\nset xrange [3:9.2]\nset yrange [0:1.2]\nset xlabel 'time [us]'\n"
          "set ylabel 'K_I over sigma (pi a)^0.5'\n",
          to);
    char title[160];
    snprintf(title, sizeof title, "%s: without the process zone", group[p->group].title);
    sif_moving_draw_panel(to, p->t, groups, 1, title);
    sif_moving_draw_panel(to, p->t, groups, 2,
                          release_methods(groups) ? "the whole disc" : "released at once, the whole disc");
    fputs("unset multiplot\n", to);
}

static status draw_groups(const struct moving_table *t)
{
    for (int g = 0; g < (int)COUNT_OF(group); g++) {
        char name[64];
        const struct moving_picture picture = {t, g};
        snprintf(name, sizeof name, "moving_crack_%s", group[g].name);
        TRY(bench_draw(name, 1100, 900, sif_moving_draw, &picture));
    }
    return OK;
}

/* ---- targets ----------------------------------------------------------------------------------------------------- */

/* Returns the largest relative deviation of K_I from the exact value in the run r [1]. */
static double farthest(const struct moving_row *r) { return fmax(r->high - 1, 1 - r->low); }

/* Adds the goals for stationary and moving cracks to *asked. Those for moving cracks apply to spacings of 0.25 mm and
 * less. A release of bonds over a whole horizon has a goal of its own, as it delays the start of the crack. t:
 * results. */
static void sif_moving_ask(struct bench_goals *asked, const struct moving_table *t)
{
    double worst = 0, slow = 0;
    bench_add_goal(asked, "%", farthest(&t->row[0]), 0.03, "crack at rest under waves, 5 to 9 us");
    bench_add_goal(asked, "%", farthest(&t->row[1]), 0.05, "moving crack, 5.5 to 9 us");
    if (t->n <= 2) return;
    for (int k = 2; k < t->n; k++) {
        const char *name = t->row[k].at->name;
        if (strstr(name, "0.5 mm")) continue;
        double *most = strstr(name, "of a horizon") ? &slow : &worst;
        *most = fmax(*most, farthest(&t->row[k]));
    }
    bench_add_goal(asked, "%", worst, 0.05, "moving crack, worst of all ways to 0.25 mm");
    bench_add_goal(asked, "%", slow, 0.05, "moving crack, damping of a whole horizon");
    bench_add_goal(asked, "%", t->row[1].ripple[1] / t->row[2].ripple[1], 1.0 / 3,
                   "ripple, fading over sudden, whole disc");
}

status moving_crack_bench(struct bench_goals *goals, bool quick)
{
    struct moving_table *t = NEW("bench.moving", 1, struct moving_table);
    status s = closed_form(t);
    if (s == OK) {
        printf(
            "\n  semi-infinite crack under plane waves, K_I over the exact one (5 to 9 us at rest, 5.5 to 9 us moving; "
            "k(1000 m/s) = %.4f,\n  as usually printed %.4f); one thread each\n  %-34s %15s  %6s  %8s %8s %8s\n",
            t->factor, t->printed, "", "low, high", "mean", "ripple", "disc", "s");
        s = sif_moving_run_all(t, quick);
    }
    if (s == OK) sif_moving_ask(goals, t);
    if (s == OK) s = sif_moving_write_tables(t);
    if (s == OK && !quick) s = draw_groups(t);
    memory_free(t);
    return s;
}
