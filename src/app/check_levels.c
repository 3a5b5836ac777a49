/* Prints the lines of `cleave check` about coarse cells: their size, the reason for them, and the time that they
 * save. */
#include <math.h>
#include <stdio.h>

#include "check_parts.h"
#include "mesh/mesh_part.h"
#include "mesh/levels.h"

void print_coarse_cell_sizes_and_counts(const struct run *run)
{
    const struct mesh_levels *l = &run->frame->levels;
    char text[1024];
    if (run->frame->mesh.points == 0 || scene_is_single_equilibrium(run->scene)) return;
    const struct levels_choice c =
        mesh_levels_choose_level_count(run->frame, &run->part, run->scene, run->clock.dt_critical);
    mesh_levels_describe_level_count(&c, run->scene, text, sizeof text);
    printf("levels         %s\n", text);
    for (int level = 0; level <= l->n && l->n > 0; level++)
        printf("%s%lld cells with edges of %d spacings%s", level == 0 ? "levels         " : ", ",
               (long long)mesh_levels_count_cells_of_level(l, level), 2 << level, level == l->n ? "\n" : "");
}

/* Writes the number n to text[32]: with all digits or, if `millions`, in millions, such as "52 million". Returns
 * `text`. */
static const char *many(double n, bool millions, char text[static 32])
{
    if (millions)
        snprintf(text, 32, "%.*f million", n < 1e6 ? 2 : n < 1e7 ? 1 : 0, 1e-6 * n);
    else
        snprintf(text, 32, "%.0f", n);
    return text;
}

static const char *long_time(double seconds, char text[static 32])
{
    if (seconds < 100)
        snprintf(text, 32, "%.2g s", seconds);
    else if (seconds < 100 * 60)
        snprintf(text, 32, "%.2g minutes", seconds / 60);
    else
        snprintf(text, 32, "%.3g hours", seconds / 3600);
    return text;
}

static const char *much_memory(double bytes, char text[static 32])
{
    if (bytes < 1e9)
        snprintf(text, 32, "%.0f MB", 1e-6 * bytes);
    else
        snprintf(text, 32, "%.2g GB", 1e-9 * bytes);
    return text;
}

/* Returns the number of material points in the cells of all coarse levels 1 to l->n of the mesh (level 0 is the
 * finest), including points that are not created. A cell of level k has an edge of 2^(k+1) spacings. dim: number of
 * dimensions. */
static double points_in_coarse_cells(const struct mesh_levels *l, int dim)
{
    double n = 0;
    for (int level = 1; level <= l->n; level++)
        n += (double)mesh_levels_count_cells_of_level(l, level) * pow(2 << level, dim);
    return n;
}

void print_cost_saved_by_coarse_cells(const struct run *run, const struct cost *c)
{
    const struct mesh_levels *l = &run->frame->levels;
    char all[32], made[32], few[32], memory[32], whole[32], now[32], then[32];
    const bool millions = run->part.n_body >= 1000000;
    double cells = 0;
    for (int level = 1; level <= l->n; level++) cells += (double)mesh_levels_count_cells_of_level(l, level);
    if (l->n == 0 || cells == 0) return;
    if (c->particles_at_start < run->part.n_body)
        printf("levels         %s particles would fill the body; coarse cells reduce them to %s at the start",
               many((double)run->part.n_body, millions, all), many((double)c->particles_at_start, millions, made));
    else
        printf("levels         %s of %s particles are in %s coarse cells",
               many(points_in_coarse_cells(l, run->part.dim), millions, few),
               many((double)run->part.n_body, millions, all), many(cells, false, made));
    printf("; memory %s", much_memory(c->bytes, memory));
    const double peridynamic = run_estimate_peak_memory_if_all_peridynamic(run->scene, &run->part, &run->source);
    if (run->scene->method == METHOD_ADAPTIVE && peridynamic > c->bytes)
        printf(" instead of %s", much_memory(peridynamic, whole));
    printf("; %s %s", c->basis == COST_FIRST && run->scene->method == METHOD_ADAPTIVE ? "at least" : "about",
           long_time(c->run, now));
    if (c->all_peridynamic > 0) printf(" instead of %s", long_time(c->all_peridynamic, then));
    printf(run->scene->method == METHOD_ADAPTIVE ? " if all of it were peridynamic\n" : "\n");
}
