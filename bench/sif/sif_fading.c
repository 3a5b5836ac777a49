/* Gradual release of bonds: reaction of a plate with a slowly growing crack (Imachi et al. 2019, section 5.4), and
 * paths of Kalthoff's cracks with SIF-driven growth (section 5.5). */
#include <math.h>

#include "sif_bench.h"
#include "base/memory.h"

/* ---- reactions --------------------------------------------------------------------------------------------------- */

/* half: half of the span over which a moving parabola is fitted to the reaction of a plate with a growing crack;
 * judged: ends of the time in which the root-mean-square deviation from this parabola, the roughness, is evaluated
 * [s]. */
static const double half = 2.5e-6, judged[2] = {22e-6, 78e-6};

struct reaction_row {
    const char *name, *damping;
    double rough, last; /* roughness; last value [N] */
    int n;
    double *t, *force; /* [s] [N] */
};
enum { RELEASES = 2 };
struct reaction_table {
    struct reaction_row row[RELEASES];
};

/* Returns a smoothed value of the reaction force of r at point `at` [N]: that of the parabola fitted to the equidistant
 * points at - reach to at + reach (Savitzky & Golay 1964). */
static double smooth_at(const struct reaction_row *r, int at, int reach)
{
    double s[5] = {0}, b[3] = {0};
    for (int k = -reach; k <= reach; k++) {
        double power = 1;
        for (int m = 0; m < 5; m++, power *= (double)k / reach) {
            s[m] += power;
            if (m < 3) b[m] += power * r->force[at + k];
        }
    }
    return (s[4] * b[0] - s[2] * b[2]) / (s[4] * s[0] - s[2] * s[2]);
}

static status take_reaction(void *row, const char *folder)
{
    struct reaction_row *r = row;
    struct history h = {0};
    double sum = 0;
    int n = 0;
    TRY(history_read(&h, folder));
    const int time = history_find_column(&h, "time"), force = history_find_column(&h, "reaction.force_y");
    r->n = (int)h.rows;
    r->t = NEW("bench.reaction", r->n, double), r->force = NEW("bench.reaction", r->n, double);
    for (int k = 0; k < r->n; k++)
        r->t[k] = history_value_at(&h, k, time), r->force[k] = history_value_at(&h, k, force);
    history_free(&h);
    const int reach = (int)lround(half / (r->t[r->n - 1] - r->t[r->n - 2]));
    for (int k = reach; k < r->n - reach; k++) {
        if (r->t[k] < judged[0] || r->t[k] > judged[1]) continue;
        const double rest = r->force[k] - smooth_at(r, k, reach);
        sum += rest * rest, n++;
    }
    r->rough = sqrt(sum / n), r->last = r->force[r->n - 1];
    printf("  %-34s rms %7.2f N, %.4f %% of the last value, %.0f N\n", r->name, r->rough,
           100 * r->rough / fabs(r->last), fabs(r->last));
    return OK;
}

static void draw_reactions(FILE *to, const void *context)
{
    const struct reaction_table *t = context;
    static const char *const colour[RELEASES] = {"#0072b2", "#d55e00"};
    for (int k = 0; k < RELEASES; k++) {
        fprintf(to, "$reaction%d << EOD\n", k);
        for (int i = 0; i < t->row[k].n; i++)
            fprintf(to, "%.6g %.6g\n", 1e6 * t->row[k].t[i], 1e-3 * fabs(t->row[k].force[i]));
        fputs("EOD\n", to);
    }
    fputs(
        "set xrange [0:80]\nset xlabel 'time [us]'\nset ylabel 'reaction [kN]'\nset title 'a crack runs slowly'\nplot ",
        to);
    for (int k = RELEASES - 1; k >= 0; k--)
        fprintf(to, "$reaction%d using 1:2 with lines lw 2 lc rgb '%s' title '%s'%s", k, colour[k], t->row[k].name,
                k ? ", " : "\n");
}

static status write_reactions(const struct reaction_table *t)
{
    struct bench_table rows[2];
    bench_table_make(&rows[0], "", "bonds,rms,force_last");
    bench_table_make(&rows[1], "curves", "bonds,time,force");
    for (int k = 0; k < RELEASES; k++) {
        const struct reaction_row *r = &t->row[k];
        bench_table_append_text(&rows[0], r->name);
        bench_table_append_number(&rows[0], r->rough);
        bench_table_append_number(&rows[0], r->last);
        for (int i = 0; i < r->n; i++) {
            bench_table_append_text(&rows[1], r->name);
            bench_table_append_number(&rows[1], r->t[i]);
            bench_table_append_number(&rows[1], r->force[i]);
        }
    }
    status s = bench_write_result_tables("load_displacement", rows, COUNT_OF(rows));
    for (size_t k = 0; k < COUNT_OF(rows); k++) bench_table_free(&rows[k]);
    return s == OK ? bench_draw("load_displacement", 1000, 560, draw_reactions, t) : s;
}

static status sif_fading_reactions(struct bench_goals *asked)
{
    struct reaction_table t = {
        {{.name = "fading bonds", .damping = "half"}, {.name = "sudden release", .damping = "0 mm"}}};
    struct bench_job job[RELEASES];
    printf("\n  reaction of a plate whose crack runs slowly, about a parabola that moves along\n");
    for (int k = 0; k < RELEASES; k++) {
        job[k] = (struct bench_job){.path = "inputs/load_displacement.yaml", .row = &t.row[k], .take = take_reaction};
        bench_overrides_append(&job[k].overrides, "growth[0].damping", "%s", t.row[k].damping);
    }
    status s = bench_jobs_run(job, RELEASES, threads_set_count_and_bind_to_cores(0));
    if (s == OK) bench_add_goal(asked, "%", t.row[0].rough / t.row[1].rough, 1.0 / 3, "reaction, fading over sudden");
    if (s == OK) s = write_reactions(&t);
    for (int k = 0; k < RELEASES; k++) memory_free(t.row[k].t), memory_free(t.row[k].force);
    return s;
}

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* A crack path: its name, the scene key and value that are varied, and the results of its run. */
struct path_row {
    const char *name, *key, *value;
    double angle, length, start, ratio, seconds; /* angle [degree], length [m], start [s]; root mean square of
                                                  * K_II/K_I after 2 mm; loop time [s] */
};
enum { PATHS = 6 };
static const struct path_row path_row[PATHS] = {
    {.name = "1 mm"},
    {.name = "1 mm, irregular 0.3", .key = "particles.irregularity", .value = "0.3"},
    {.name = "1 mm, irregular 0.6", .key = "particles.irregularity", .value = "0.6"},
    {.name = "1 mm, mospd", .key = "model", .value = "mospd"},
    {.name = "1 mm, adaptive", .key = "method", .value = "adaptive"},
    {.name = "0.5 mm", .key = "particles.spacing", .value = "0.5 mm"},
};

/* Returns the root mean square of K_II/K_I over the rows of history h in which the crack grows, without its first 2 mm
 * of growth. */
static double modes_ratio(const struct history *h)
{
    const int length = history_find_column(h, "growth.length"), speed = history_find_column(h, "growth.speed");
    const int K_I = history_find_column(h, "sif.K_I"), K_II = history_find_column(h, "sif.K_II");
    double sum = 0;
    int n = 0;
    for (int64_t k = 0; k < h->rows; k++) {
        const double ratio = history_value_at(h, k, K_II) / history_value_at(h, k, K_I);
        if (!(history_value_at(h, k, length) > 2e-3 && history_value_at(h, k, speed) > 0) || !isfinite(ratio)) continue;
        sum += ratio * ratio, n++;
    }
    return sqrt(sum / n);
}

static status take_path(void *row, const char *folder)
{
    struct path_row *r = row;
    struct history h = {0};
    TRY(history_read(&h, folder));
    r->ratio = modes_ratio(&h);
    history_free(&h);
    r->angle = bench_summary_figure(folder, "probes.growth.angle_deg");
    r->length = bench_summary_figure(folder, "probes.growth.length_end");
    r->start = bench_summary_figure(folder, "probes.growth.start_time");
    r->seconds = bench_summary_figure(folder, "loop_seconds");
    printf("  %-34s %7.1f %10.1f %10.1f %9.1f %% %8.1f\n", r->name, r->angle, 1e3 * r->length, 1e6 * r->start,
           100 * r->ratio, r->seconds);
    return OK;
}

static status paths(void)
{
    struct path_row row[PATHS];
    struct bench_job job[PATHS];
    struct bench_table rows;
    printf(
        "\n  Kalthoff's plate, led by its factors (Imachi et al. 2019: 73.6 degrees; experiment: 70); one thread each\n"
        "  %-34s %7s %10s %10s %11s %8s\n",
        "", "angle", "length mm", "start us", "K_II/K_I", "s");
    for (int k = 0; k < PATHS; k++) {
        row[k] = path_row[k];
        job[k] = (struct bench_job){.path = "inputs/kalthoff_sif.yaml", .row = &row[k], .take = take_path};
        bench_overrides_append(&job[k].overrides, "output.frames", "0");
        if (row[k].key) bench_overrides_append(&job[k].overrides, row[k].key, "%s", row[k].value);
    }
    TRY(bench_jobs_run(job, PATHS, threads_set_count_and_bind_to_cores(0)));
    bench_table_make(&rows, "", "name,angle_deg,length,start_time,K_II_over_K_I,seconds");
    for (int k = 0; k < PATHS; k++) {
        bench_table_append_text(&rows, row[k].name);
        const double number[] = {row[k].angle, row[k].length, row[k].start, row[k].ratio, row[k].seconds};
        for (size_t m = 0; m < COUNT_OF(number); m++) bench_table_append_number(&rows, number[m]);
    }
    status s = bench_write_result_tables("kalthoff_sif", &rows, 1);
    bench_table_free(&rows);
    return s;
}

status growing_cracks_bench(struct bench_goals *goals)
{
    TRY(sif_fading_reactions(goals));
    return paths();
}
