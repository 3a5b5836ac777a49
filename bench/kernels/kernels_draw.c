/* Output of `cleave bench kernels`: lines, tables and a picture. */
#include <ctype.h>
#include <math.h>

#include "plot/gnuplot.h"
#include "kernel_bench.h"
#include "contact/contact.h"

static const char *const job_name[JOB_KINDS] = {
    "bond_force", "bond_energy", "bond_stress", "pd_move",        "p2g",          "remap",
    "g2p",        "g2p_yields",  "spread",      "grid_clear",     "grid_move",    "grid_remapped",
    "mesh_clear", "mesh_force",  "mesh_move",   "contact_search", "contact_force"};

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Prints the measured limits l of the machine for one thread: time of the arithmetic of a bond, memory bandwidth, and
 * time of a step of a simple material point method per particle. */
static void print_limits(const struct limits *l)
{
    printf("  limits of this machine, one thread\n");
    for (int d = 1; d <= DIM_MAX; d++)
        printf("    lattice stencil of the bond law, %dD      %8.3f ns per directed bond\n", d,
               1e9 * l->cell_stencil[d]);
    printf("    STREAM triad                             %8.1f GB/s\n", 1e-9 * l->triad);
    printf("    plain cell-sorted MPM, 2D linear FLIP    %8.1f ns per particle and step\n\n", 1e9 * l->points);
}

static void print_jobs(const struct kernel_bench *b)
{
    printf("  kernel         dim variant          ns/particle  ns/bond  bytes/particle   GB/s  share of the limit\n");
    for (int k = 0; k < b->jobs; k++) {
        const struct job *j = &b->job[k];
        const struct ground *g = &b->ground[j->dim];
        const double each = j->seconds / (double)job_particle_count(j, g);
        char bond[16] = "";
        if (job_visits_bonds(j)) snprintf(bond, sizeof bond, "%.3f", 1e9 * each / job_bonds_per_particle(j, g));
        printf("  %-14s  %d  %-16s %10.2f %9s %13.0f %8.1f %10.2f\n", job_name[j->kind], j->dim, j->variant, 1e9 * each,
               bond, j->bytes, 1e-9 * j->bytes / each, j->limit / each);
    }
    printf("  limit: the longer of bytes at the triad's rate and, for bonds, the stencil; above 1 the data stayed in "
           "cache\n\n");
}

static void fill_tables(const struct kernel_bench *b, struct bench_table *rows, struct bench_table *limits)
{
    bench_table_make(rows, "",
                     "kernel,dim,variant,particles,seconds_per_particle,seconds_per_bond,bytes_per_particle,limit_"
                     "seconds_per_particle,share_of_limit");
    for (int k = 0; k < b->jobs; k++) {
        const struct job *j = &b->job[k];
        const struct ground *g = &b->ground[j->dim];
        const double n = (double)job_particle_count(j, g), each = j->seconds / n;
        bench_table_append_text(rows, job_name[j->kind]);
        bench_table_append_number(rows, j->dim);
        bench_table_append_text(rows, j->variant);
        const double number[] = {n, each, each / job_bonds_per_particle(j, g), j->bytes, j->limit, j->limit / each};
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(rows, number[c]);
    }
    bench_table_make(limits, "limits",
                     "stencil_1d_seconds_per_bond,stencil_2d_seconds_per_bond,stencil_3d_seconds_per_bond,triad_bytes_"
                     "per_second,points_seconds_per_particle");
    for (int d = 1; d <= DIM_MAX; d++) bench_table_append_number(limits, b->limits.cell_stencil[d]);
    bench_table_append_number(limits, b->limits.triad);
    bench_table_append_number(limits, b->limits.points);
}

static status kernels_draw_write_tables(const struct kernel_bench *b)
{
    struct bench_table table[4];
    fill_tables(b, &table[0], &table[1]);
    bench_targets_add_to_table(&b->targets, &table[2]);
    table[3] = b->targets.timers;
    status s = bench_write_result_tables("kernels", table, b->targets.timers.cells ? 4 : 3);
    for (int k = 0; k < 3; k++) bench_table_free(&table[k]);
    return s;
}

/* ---- picture ----------------------------------------------------------------------------------------------------- */

/* Writes a label in double quotes: the first word of `variant` in lower case, with spaces for underscores, followed by
 * `more`. */
static void kernels_draw_put_label(FILE *to, const char *variant, const char *more)
{
    fputc('"', to);
    for (; *variant && *variant != ' '; variant++) fputc(*variant == '_' ? ' ' : tolower(*variant), to);
    fprintf(to, "%s\"", more);
}

/* Sends two data blocks of b to gnuplot for each dimension D: $bD with the times of bond kernels per bond, $pD with the
 * times of transfers per particle, one row per shape function [ns]. */
static void send_data(FILE *to, const struct kernel_bench *b)
{
    for (int d = 1; d <= DIM_MAX; d++) {
        fprintf(to, "$b%d << EOD\n", d);
        for (int k = 0; k < b->jobs; k++) {
            const struct job *j = &b->job[k];
            if (j->dim != d || !job_visits_bonds(j)) continue;
            const double bonds =
                job_bonds_per_particle(j, &b->ground[d]) * (double)job_particle_count(j, &b->ground[d]);
            kernels_draw_put_label(to, j->variant,
                                   j->kind == BOND_FORCE    ? " force"
                                   : j->kind == BOND_ENERGY ? " energy"
                                                            : " stress");
            fprintf(to, " %.6g\n", 1e9 * j->seconds / bonds);
        }
        fprintf(to, "EOD\n$p%d << EOD\n", d);
        for (int shape = 0; shape < SHAPES; shape++) {
            for (int k = 0; k < b->jobs; k++) {
                const struct job *j = &b->job[k];
                if (j->dim != d || (int)j->shape != shape || (j->kind != P2G && j->kind != G2P && j->kind != REMAP))
                    continue;
                if (j->kind == REMAP) kernels_draw_put_label(to, j->variant, "");
                fprintf(to, " %.6g", 1e9 * j->seconds / (double)job_particle_count(j, &b->ground[d]));
            }
            fputc('\n', to);
        }
        fputs("EOD\n", to);
    }
}

static void kernels_draw_set_panel(FILE *to, double left, double right, double below, double above)
{
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\nset tmargin at screen %g\n",
            left, right, below, above);
}

/* Draws a bar for each measured quantity of f with a target: measured value over target. A bar of 1 or less meets its
 * target. */
static void draw_speed_targets(FILE *to, const struct targets *f)
{
    if (!f->figures) return;
    const double most = 4; /* longer bars are cut; their value is printed */
    fputs("$targets << EOD\n", to);
    for (int k = 0; k < f->figures; k++) {
        const struct target_figure *a = &f->figure[k];
        const double ratio = a->measured / a->limit;
        const double shown = a->at_least ? a->asked / ratio : ratio / a->asked;
        fprintf(to, "\"%s\" %.4g %d %.3g\n", a->name, fmin(shown, most), f->figures - k, shown);
    }
    fputs("EOD\n", to);
    kernels_draw_set_panel(to, 0.36, 0.97, 0.05, 0.26);
    fprintf(to,
            "set title 'targets: measured over asked (1 or less is met)'\nset xrange [0:%g]\nset yrange "
            "[0.4:%d.6]\nset xtics auto norotate\nset grid noy\n"
            "set arrow 1 from 1, graph 0 to 1, graph 1 nohead dt (6,4) lw 1.4 lc rgb '#3d3d3d'\nset ylabel ''\n"
            "plot $targets using (0.5*$2):3:(0.5*$2):(0.36):ytic(1) with boxxy fs solid 0.85 lc rgb '%s' notitle, "
            "'' using (%g):3:(sprintf('%%.2f', $4)) with labels right notitle\n",
            1.12 * most, f->figures, curve_colour[0], 1.11 * most);
}

static void kernels_draw_picture(FILE *to, const void *context)
{
    static const char *const transfer[] = {"re-map", "p2g FLIP", "g2p FLIP", "p2g APIC", "g2p APIC"};
    const struct kernel_bench *b = context;
    send_data(to, b);
    fputs("set multiplot\nset style data histograms\nset style histogram clustered gap 1\nset style fill solid 0.85\n"
          "set boxwidth 0.9\nset xtics nomirror scale 0\nset yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n",
          to);
    for (int d = 1; d <= DIM_MAX; d++) {
        const double left = 0.07 + 0.315 * (d - 1);
        kernels_draw_set_panel(to, left, left + 0.27, 0.78, 0.95);
        fprintf(to,
                "set title '%dD: ns per bond'\nset arrow 1 from graph 0, first %.6g to graph 1, first %.6g nohead dt "
                "(6,4) lw 1.4 lc rgb '%s'\n"
                "set xtics rotate by -60 font ',9'\nset key inside left top\nplot $b%d using 2:xtic(1) lc rgb '%s' "
                "notitle, NaN with lines dt (6,4) lw "
                "1.4 lc rgb '%s' title '%s'\n",
                d, 1e9 * b->limits.cell_stencil[d], 1e9 * b->limits.cell_stencil[d], curve_colour[1], d,
                curve_colour[0], curve_colour[1], d == 1 ? "stencil limit" : "");
        fprintf(to, "unset arrow 1\nset xtics rotate by -25 font ',12'\n%s\n",
                d == 1 ? "set key at screen 0.5,0.67 center top vertical maxrows 2" : "unset key");
        kernels_draw_set_panel(to, left, left + 0.27, 0.40, 0.59);
        fprintf(to, "set title '%dD: ns per particle'\nplot ", d);
        for (int k = 0; k < 5; k++)
            fprintf(to, "%s$p%d using %d:xtic(1) lc rgb '%s' title '%s'", k ? ", " : "", d, k + 2, curve_colour[k],
                    d == 1 ? transfer[k] : "");
        fputs("\nset xtics norotate\n", to);
    }
    draw_speed_targets(to, &b->targets);
    fputs("unset multiplot\n", to);
}

void kernels_print(const struct kernel_bench *b)
{
    print_limits(&b->limits);
    print_jobs(b);
}

status kernels_write(const struct kernel_bench *b)
{
    TRY(kernels_draw_write_tables(b));
    return bench_draw("kernels", 1200, 1100, kernels_draw_picture, b);
}
