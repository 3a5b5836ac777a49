/* A static edge crack at increasing resolution, with every model: K_I compared with the closed form and with the tables
 * of the paper on the modified ordinary state-based model (J. Mar. Sci. Appl. 2026, doi 10.1007/s11804-026-00791-z).
 * Its figure 5(b) states no numbers; the picture shows those of its Table 1. */
#include <math.h>
#include <string.h>

#include "sif_bench.h"

static const double exact = 11.93;             /* K_I for a/W = 0.5, H = W (Bowie 1973) [MPa mm^0.5] */
static const double unit = 31622.776601683793; /* 1 MPa mm^0.5                               [Pa m^0.5] */
static const double width = 10;                /* width of the plate [mm] */

/* Models that are compared. LOCAL, BULK: the constants of bonds follow from the neighbourhood of each particle, or from
 * that of a particle in the bulk. style: of its line, for gnuplot. */
enum { MOSPD, MOSPD_LOCAL, OSPD, OSPD_BULK, BOND, MODELS };
static const struct edge_model {
    const char *name, *model, *normalisation, *poisson, *style;
} edge_model[MODELS] = {
    [MOSPD] = {"mospd bulk", "mospd", "bulk", "0.3", "lw 4 pt 7 ps 1.1 lc rgb '#0072b2'"},
    [MOSPD_LOCAL] = {"mospd local", "mospd", "local", "0.3", "lw 2 pt 6 ps 1 dt (6,4) lc rgb '#0072b2'"},
    [OSPD] = {"ospd local", "ospd", "local", "0.3", "lw 4 pt 5 ps 1.1 lc rgb '#d55e00'"},
    [OSPD_BULK] = {"ospd bulk", "ospd", "bulk", "0.3", "lw 2 pt 4 ps 1 dt (6,4) lc rgb '#d55e00'"},
    [BOND] = {"bond", "bond", NULL, "1/3", "lw 2.4 pt 9 ps 1 lc rgb '#009e73'"},
};

/* Values of the paper on the modified ordinary state-based model (doi 10.1007/s11804-026-00791-z). Table 1: K_I on
 * rings of 30, 50, 70 spacings with 200 x 200 particles [MPa mm^0.5]. Table 2: seconds and steps on an i9-14900K. */
enum { PAPER_OSPD, PAPER_MOSPD, PAPERS };
static const double paper_radius[EDGE_RINGS] = {30, 50, 70};
static const double paper_ring[PAPERS][EDGE_RINGS] = {{12.015, 12.048, 12.101}, {11.867, 11.887, 11.935}};
enum { PAPER_SIDES = 3 };
static const struct {
    int side;
    double seconds[PAPERS], steps[PAPERS];
} paper_cost[PAPER_SIDES] = {
    {100, {33.7, 33.8}, {4000, 3000}}, {200, {172.5, 302.6}, {5000, 5000}}, {400, {990.4, 1328.1}, {7000, 7000}}};

static int paper_of(int model) { return model == OSPD ? PAPER_OSPD : model == MOSPD ? PAPER_MOSPD : -1; }

static int paper_side(int side)
{
    for (int k = 0; k < PAPER_SIDES; k++)
        if (paper_cost[k].side == side) return k;
    return -1;
}

static double error_of(double K) { return K / unit / exact - 1; }

static double speed_of(const struct edge_row *r) { return r->steps * r->side * r->side / r->seconds; }

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Prints the result r of a run of the edge crack, beside the steps and time that Table 2 of doi
 * 10.1007/s11804-026-00791-z states for it, if it does. */
static void sif_edge_print_row(const struct edge_row *r)
{
    const int paper = paper_of(r->model), side = paper_side(r->side);
    printf("  %4d x %-4d %-12s %-10s %7.3f %+7.2f %% %6.2f %% %7.0f %8.2f %8.1f", r->side, r->side,
           edge_model[r->model].name, r->relaxed ? "relaxation" : "cg", r->K / unit, 100 * error_of(r->K),
           100 * r->spread, r->steps, r->seconds, 1e-6 * speed_of(r));
    if (paper >= 0 && side >= 0)
        printf("     %6.0f %8.1f %7.2f", paper_cost[side].steps[paper], paper_cost[side].seconds[paper],
               1e-6 * paper_cost[side].steps[paper] * r->side * r->side / paper_cost[side].seconds[paper]);
    puts("");
}

static status sif_edge_take_row(void *row, const char *folder)
{
    struct edge_row *r = row;
    r->K = bench_summary_figure(folder, "probes.sif.K_I");
    r->spread = bench_summary_figure(folder, "probes.sif.contour_spread");
    r->steps = bench_summary_figure(folder, "steps");
    r->seconds = bench_summary_figure(folder, "loop_seconds");
    r->peak = bench_summary_figure(folder, "memory_peak_bytes");
    for (int k = 0; k < EDGE_RINGS; k++) {
        char key[64];
        snprintf(key, sizeof key, "probes.ring%g.K_I", paper_radius[k]);
        r->ring[k] = bench_summary_figure(folder, key);
    }
    sif_edge_print_row(r);
    return OK;
}

/* Appends an override with probes on rings of 30, 50 and 70 spacings to *o, as in Table 1 of doi
 * 10.1007/s11804-026-00791-z, unless the largest ring does not fit into the plate. side: number of particles along an
 * edge. */
static void override_probes(struct bench_overrides *o, int side)
{
    if (paper_radius[EDGE_RINGS - 1] * width / side > 0.4 * width) return;
    bench_overrides_append(o, "probes",
                           "[sif, sif: {name: ring30, outer: %g mm}, sif: {name: ring50, outer: %g mm}, "
                           "sif: {name: ring70, outer: %g mm}]",
                           30 * width / side, 50 * width / side, 70 * width / side);
}

static status edge_add(struct edge_table *t, int model, int side, bool relaxed)
{
    INVARIANT(t->n < EDGE_ROWS_MAX);
    struct edge_row *r = &t->row[t->n++];
    struct bench_job job = {.path = "inputs/edge_crack_k1.yaml", .row = r, .take = sif_edge_take_row};
    *r = (struct edge_row){.model = model, .side = side, .relaxed = relaxed};
    bench_overrides_append(&job.overrides, "model", "%s", edge_model[model].model);
    if (edge_model[model].normalisation)
        bench_overrides_append(&job.overrides, "pd.normalisation", "%s", edge_model[model].normalisation);
    bench_overrides_append(&job.overrides, "material.poisson", "%s", edge_model[model].poisson);
    bench_overrides_append(&job.overrides, "particles.spacing", "%.9g mm", width / side);
    bench_overrides_append(&job.overrides, "solver", "%s", relaxed ? "relaxation" : "cg");
    bench_overrides_append(&job.overrides, "output.frames", "0");
    override_probes(&job.overrides, side);
    return bench_jobs_run(&job, 1, 1);
}

static void sif_edge_print_header(void)
{
    printf("\n  edge crack at rest: %.2f MPa mm^0.5 (Bowie 1973); the paper's columns: Table 2, %s\n"
           "  %-11s %-12s %-10s %7s %9s %8s %7s %8s %8s     %6s %8s %7s\n",
           exact, "i9-14900K", "particles", "model", "solver", "K_I", "error", "spread", "steps", "s", "M p.st/s",
           "steps", "s", "M/s");
}

static void print_rings(const struct edge_table *t)
{
    bool said = false;
    for (int k = 0; k < t->n; k++) {
        const struct edge_row *r = &t->row[k];
        const int paper = paper_of(r->model);
        if (r->side != 200 || isnan(r->ring[0])) continue;
        if (!said) printf("\n  200 x 200, rings of 30, 50, 70 spacings: error [%%]; the paper's: Table 1\n");
        said = true;
        printf("  %-12s", edge_model[r->model].name);
        for (int m = 0; m < EDGE_RINGS; m++) printf(" %+7.2f", 100 * error_of(r->ring[m]));
        for (int m = 0; m < EDGE_RINGS && paper >= 0; m++)
            printf("%s %+7.2f", m ? "" : "     paper:", 100 * (paper_ring[paper][m] / exact - 1));
        puts("");
    }
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Fills `rows`, an uninitialised table for files, with all runs of the edge crack in t. */
static void fill(struct bench_table *rows, const struct edge_table *t)
{
    bench_table_make(rows, "",
                     "model,solver,particles_a_side,spacing,K_I,error,contour_spread,steps,seconds,"
                     "particle_steps_per_second,memory_peak_bytes,error_ring30,error_ring50,error_ring70,paper_steps,"
                     "paper_seconds");
    for (int k = 0; k < t->n; k++) {
        const struct edge_row *r = &t->row[k];
        const int paper = paper_of(r->model), side = paper_side(r->side);
        const bool has = paper >= 0 && side >= 0;
        bench_table_append_text(rows, edge_model[r->model].name);
        bench_table_append_text(rows, r->relaxed ? "relaxation" : "cg");
        const double number[] = {r->side,
                                 1e-3 * width / r->side,
                                 r->K,
                                 error_of(r->K),
                                 r->spread,
                                 r->steps,
                                 r->seconds,
                                 speed_of(r),
                                 r->peak,
                                 error_of(r->ring[0]),
                                 error_of(r->ring[1]),
                                 error_of(r->ring[2]),
                                 has ? paper_cost[side].steps[paper] : NAN,
                                 has ? paper_cost[side].seconds[paper] : NAN};
        for (size_t m = 0; m < COUNT_OF(number); m++) bench_table_append_number(rows, number[m]);
    }
}

static void fill_paper(struct bench_table *rows)
{
    bench_table_make(rows, "paper_rings", "model,particles_a_side,radius_spacings,K_I,error");
    for (int p = 0; p < PAPERS; p++)
        for (int k = 0; k < EDGE_RINGS; k++) {
            bench_table_append_text(rows, p == PAPER_OSPD ? "ospd" : "mospd");
            bench_table_append_number(rows, 200);
            bench_table_append_number(rows, paper_radius[k]);
            bench_table_append_number(rows, paper_ring[p][k] * unit);
            bench_table_append_number(rows, paper_ring[p][k] / exact - 1);
        }
}

static void panel(FILE *to, int column, const char *title)
{
    const double left = 0.065 + 0.5 * column;
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset title '%s'\nset key at screen %g,0.9 left top "
            "vertical maxrows 12\n",
            left, left + 0.28, title, left + 0.29);
}

/* Sends the gnuplot command that plots column `y` of the data of the edge crack over the spacing, one line per model.
 * t: not used. */
static void plot_models(FILE *to, const struct edge_table *t, const char *y)
{
    for (int m = 0; m < MODELS; m++)
        fprintf(to, "%s$edge%d using 1:%s with linespoints %s title '%s'", m ? ", " : "plot ", m, y,
                edge_model[m].style, edge_model[m].name);
    (void)t;
}

static void sif_edge_draw(FILE *to, const void *context)
{
    const struct edge_table *t = context;
    for (int m = 0; m < MODELS; m++) {
        fprintf(to, "$edge%d << EOD\n", m);
        for (int k = 0; k < t->n; k++)
            if (t->row[k].model == m && !t->row[k].relaxed)
                fprintf(to, "%g %.6g %.6g\n", width / t->row[k].side, 100 * fabs(error_of(t->row[k].K)),
                        t->row[k].seconds);
        fputs("EOD\n", to);
    }
    for (int p = 0; p < PAPERS; p++) {
        fprintf(to, "$paper%d << EOD\n", p);
        for (int k = 0; k < EDGE_RINGS; k++)
            fprintf(to, "%g %.6g\n", width / 200, 100 * fabs(paper_ring[p][k] / exact - 1));
        fprintf(to, "EOD\n$cost%d << EOD\n", p);
        for (int k = 0; k < PAPER_SIDES; k++)
            fprintf(to, "%g %g\n", width / paper_cost[k].side, paper_cost[k].seconds[p]);
        fputs("EOD\n", to);
    }
    fputs("set multiplot\nset logscale xy\nset xrange [0.02:0.25]\nset xtics (0.025, 0.05, 0.1, 0.2)\n"
          "set xlabel 'spacing [mm]'\nset ylabel 'error of K_I, either way [%]'\nset yrange [0.005:10]\n",
          to);
    panel(to, 0, "edge crack: K_I against the closed form");
    plot_models(to, t, "2");
    fputs(", $paper0 using 1:2 with points pt 1 ps 1.6 lw 2.4 lc rgb '#d55e00' title 'paper, OSPD'"
          ", $paper1 using 1:2 with points pt 2 ps 1.6 lw 2.4 lc rgb '#0072b2' title 'paper, MOSPD'\n"
          "set ylabel 'seconds to equilibrium'\nset yrange [0.005:3000]\n",
          to);
    panel(to, 1, "edge crack: what it takes");
    plot_models(to, t, "3");
    fputs(", $cost0 using 1:2 with linespoints pt 1 ps 1.6 lw 2.4 dt (2,3) lc rgb '#d55e00' title 'paper, OSPD'"
          ", $cost1 using 1:2 with linespoints pt 2 ps 1.6 lw 2.4 dt (2,3) lc rgb '#0072b2' title 'paper, MOSPD'\n"
          "unset multiplot\n",
          to);
}

static status sif_edge_write_tables(const struct edge_table *t)
{
    struct bench_table table[2];
    fill(&table[0], t);
    fill_paper(&table[1]);
    status s = bench_write_result_tables("edge_crack_convergence", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s == OK ? bench_draw("edge_crack_convergence", 1400, 520, sif_edge_draw, t) : s;
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Adds the goals for the edge crack to *asked: largest errors of K_I of the runs in t with at least 100 particles along
 * an edge. */
static void sif_edge_ask(struct bench_goals *asked, const struct edge_table *t)
{
    for (int k = 0; k < t->n; k++) {
        const struct edge_row *r = &t->row[k];
        if (r->relaxed || r->side < 100) continue;
        if (r->model == MOSPD)
            bench_add_goal(asked, "%", fabs(error_of(r->K)), 0.003, "edge crack, mospd bulk, %d a side", r->side);
        if (r->model == OSPD)
            bench_add_goal(asked, "%", fabs(error_of(r->K)), r->side == 100 ? 0.01 : 0.005,
                           "edge crack, ospd local, %d a side", r->side);
        if (r->side == 200 && (r->model == MOSPD || r->model == OSPD))
            bench_add_goal(asked, "%", r->spread, 0.003, "edge crack, %s, 200 a side: between contours",
                           edge_model[r->model].name);
    }
}

status edge_crack_bench(struct bench_goals *goals, bool quick)
{
    struct edge_table t = {0};
    sif_edge_print_header();
    for (int side = 50; side <= (quick ? 100 : 400); side *= 2) {
        for (int model = 0; model < MODELS; model++) TRY(edge_add(&t, model, side, false));
        if (side != 100) continue;
        TRY(edge_add(&t, MOSPD, side, true));
        TRY(edge_add(&t, OSPD, side, true));
    }
    print_rings(&t);
    sif_edge_ask(goals, &t);
    return sif_edge_write_tables(&t);
}
