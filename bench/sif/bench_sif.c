/* `cleave bench sif`: stress-intensity factors beside closed forms and published tables: an edge crack, an
 * inclined one, a crack that waves meet, one that runs, and what growing cracks make of reactions and paths. */
#include <math.h>
#include <stdarg.h>

#include "sif_bench.h"
#include "base/memory.h"
#include "output/summary_read.h"

/* ---- runs -------------------------------------------------------------------------------------------------------- */

static status sif_job_start(struct sif_bench_job *job, struct bench_child *child, int threads)
{
    return bench_child_start(child, job->path, bench_overrides_ready(&job->overrides), job->overrides.n, threads);
}

static status job_end(struct sif_bench_job *job, struct bench_child *child)
{
    TRY(bench_child_wait(child));
    TRY(job->take(job->row, child->folder));
    fflush(stdout);
    return OK;
}

status sif_bench_run(struct sif_bench_job *job, int n, int at_once)
{
    const int threads = at_once > 1 ? 1 : team_make(0);
    struct bench_child *child = NEW("bench.children", n, struct bench_child);
    status s = OK;
    int started = 0;
    for (int k = 0; k < n && s == OK; k++) {
        while (started < n && started < k + at_once && s == OK)
            s = sif_job_start(&job[started], &child[started], threads), started++;
        if (s == OK) s = job_end(&job[k], &child[k]);
        bench_child_free(&child[k]);
    }
    for (int k = 0; k < started; k++) bench_child_free(&child[k]);
    memory_free(child);
    return s;
}

double sif_bench_figure(const char *folder, const char *key)
{
    double value;
    return summary_number(folder, key, &value) == OK ? value : NAN;
}

/* ---- targets ----------------------------------------------------------------------------------------------------- */

void sif_bench_ask(struct sif_bench_targets *t, double measured, double asked, const char *name, ...)
{
    va_list more;
    assert(t->n < TARGETS_MAX);
    struct sif_bench_target *new = &t->target[t->n++];
    va_start(more, name);
    vsnprintf(new->name, sizeof new->name, name, more);
    va_end(more);
    new->measured = measured, new->asked = asked;
}

static void print_targets(const struct sif_bench_targets *t)
{
    printf("\n  what is asked%-46s %10s %10s\n", "", "measured", "at most");
    for (int k = 0; k < t->n; k++) {
        const struct sif_bench_target *g = &t->target[k];
        printf("  %-59s %8.2f %% %8.2f %%%s\n", g->name, 100 * g->measured, 100 * g->asked,
               g->measured <= g->asked ? "" : "   missed");
    }
}

static status write_targets(const struct sif_bench_targets *t)
{
    struct bench_table rows;
    bench_table_make(&rows, "", "figure,measured,asked_at_most");
    for (int k = 0; k < t->n; k++) {
        bench_text(&rows, t->target[k].name);
        bench_number(&rows, t->target[k].measured);
        bench_number(&rows, t->target[k].asked);
    }
    status s = bench_write("sif", &rows, 1);
    bench_table_free(&rows);
    return s;
}

/* Bars of measured over target. */
static void draw_targets(FILE *to, const void *context)
{
    const struct sif_bench_targets *t = context;
    fputs("$bars << EOD\n", to);
    for (int k = 0; k < t->n; k++)
        fprintf(to, "%d %.6g \"%s\"\n", t->n - k, t->target[k].measured / t->target[k].asked, t->target[k].name);
    fprintf(to,
            "EOD\nset lmargin at screen 0.5\nset xrange [0:1.6]\nset yrange [0.3:%g]\nset boxwidth 0.6\nset key off\n"
            "set ytics scale 0\nset xlabel 'deviation over what is asked'\n"
            "set arrow 1 from 1, graph 0 to 1, graph 1 nohead lw 2 lc rgb '#3d3d3d' front\n"
            "plot $bars using (0.5*$2):1:(0.5*$2):(0.3):ytic(3) with boxxy fs solid 0.85 noborder lc rgb '#0072b2'\n",
            t->n + 0.7);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

static bool scenes_here(void)
{
    static const char *const scene[] = {"inputs/edge_crack_k1.yaml", "inputs/inclined_crack.yaml",
                                        "inputs/semi_infinite_crack.yaml", "inputs/load_displacement.yaml",
                                        "inputs/kalthoff_sif.yaml"};
    for (size_t k = 0; k < COUNT_OF(scene); k++)
        if (!bench_scene_exists(scene[k])) return false;
    return true;
}

status bench_sif(bool quick)
{
    struct sif_bench_targets asked = {0};
    if (!scenes_here())
        return status_set(REFUSED, "bench sif: its scenes are not here; start it where the folder inputs is");
    printf("stress-intensity factors\n");
    bench_print_machine(team_make(0));
    TRY(edge_bench(&asked, quick));
    TRY(inclined_bench(&asked, quick));
    TRY(moving_bench(&asked, quick));
    if (!quick) TRY(cracks_bench(&asked));
    print_targets(&asked);
    TRY(write_targets(&asked));
    return bench_draw("sif", 1100, 120 + 32 * asked.n, draw_targets, &asked);
}
