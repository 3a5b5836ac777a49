/* Patch test: uniform strain across an interface must cause no nodal force. Measures the largest nodal force of the
 * first step over stress times cell face, for interfaces of several shapes, loads and positions of the grid. */
#include <math.h>
#include <string.h>

#include "coupling.h"

/* Scenes of the patch test. All nodes, and all peridynamic particles far from the edges, are measured. Bonds stretch
 * with finite deformation, so that the strain used limits the resolution to 1e-6. */
static const char line_text[] = "space: line\n"
                                "duration: 1 us\n"
                                "material: {young: 1e4, density: 1}\n"
                                "body: {box: {from: [-40 mm], to: [40 mm]}}\n"
                                "particles: {spacing: 1 mm, horizon: 3}\n"
                                "pd: {region: {box: {from: [-inf], to: [0]}}}\n"
                                "conversion: {criteria: none}\n"
                                "mpm: {frame: current}\n"
                                "initial: [{displacement_gradient: [[1e-6]]}]\n"
                                "time: {step: 1 us}\n"
                                "output: {frames: 0, samples: 1}\n"
                                "probes: [{patch: {region: {box: {from: [-20 mm], to: [20 mm]}}}}]\n";

static const char plane_text[] = "space: plane stress\n"
                                 "thickness: 1 mm\n"
                                 "duration: 1 ns\n"
                                 "material: {young: 190 GPa, density: 7800}\n"
                                 "body: {box: {from: [-20 mm, -20 mm], to: [20 mm, 20 mm]}}\n"
                                 "particles: {spacing: 1 mm}\n"
                                 "conversion: {criteria: none}\n"
                                 "mpm: {frame: current}\n"
                                 "time: {step: 1 ns}\n"
                                 "output: {frames: 0, samples: 1}\n"
                                 "probes: [{patch: {region: {box: {from: [-13 mm, -13 mm], to: [13 mm, 13 mm]}}}}]\n";

struct words {
    const char *name, *value;
};
static const struct words shape[] = {
    {"flat", "{box: {from: [-inf, -inf], to: [0, inf]}}"},
    {"45 degrees", "{half-space: {point: [0.25 mm, 0.25 mm], normal: [1, 1]}}"}, /* steps of one particle */
    {"circle, r = 8 D", "{disc: {centre: [0, 0], radius: 8 mm}}"},
    {"square, 6 x 6 D", "{box: {from: [-3 mm, -3 mm], to: [3 mm, 3 mm]}}"},
};
static const struct words load[] = {
    {"axial", "[[1e-6, 0], [0, 0]]"}, {"biaxial", "[[1e-6, 0], [0, 1e-6]]"}, {"shear", "[[0, 1e-6], [1e-6, 0]]"}};
static const struct words variant[] = {
    {"handshake", "uniform"}, {"partial stress", "uniform"}, {"partial stress", "isotropic"}};

static status residual_of(const char *text, struct bench_overrides *o, double *value)
{
    struct bench_figure f = {.probe = "patch", .quantity = "residual_max"};
    TRY(bench_run_scene_and_read_figures("(patch test)", text, o, &f, 1));
    *value = f.value;
    return OK;
}

static void note(struct patch_row *r, int position, double value)
{
    if (position == 0) r->on_node = value;
    r->largest = fmax(r->largest, value);
}

static status measure_line(struct patch_row *r)
{
    for (int k = 0; k < 8; k++) {
        struct bench_overrides o = {0};
        double value;
        bench_overrides_append(&o, "coupling", "%s", r->coupling);
        bench_overrides_append(&o, "mpm.cell", "%d", r->cell);
        bench_overrides_append(&o, "mpm.origin", "[%g mm]", r->cell * k / 8.0);
        TRY(residual_of(line_text, &o, &value));
        note(r, k, value);
    }
    return OK;
}

static status measure_plane(struct patch_row *r, const char *region, const char *gradient, int positions)
{
    for (int k = 0; k < positions * positions; k++) {
        struct bench_overrides o = {0};
        double value, step = (double)r->cell / positions; /* [spacings] */
        bench_overrides_append(&o, "pd.region", "%s", region);
        bench_overrides_append(&o, "pd.weights", "%s", r->weights);
        bench_overrides_append(&o, "coupling", "%s", r->coupling);
        bench_overrides_append(&o, "mpm.origin", "[%g mm, %g mm]", step * (k % positions), step * (k / positions));
        bench_overrides_append(&o, "initial", "[{displacement_gradient: %s}]", gradient);
        TRY(residual_of(plane_text, &o, &value));
        note(r, k, value);
    }
    return OK;
}

static struct patch_row *row_add(struct patch_table *t, struct patch_row r)
{
    INVARIANT(t->n < PATCH_ROWS_MAX);
    t->row[t->n] = r;
    return &t->row[t->n++];
}

status patch_test_measure_nodal_forces(struct patch_table *table, bool quick)
{
    for (int w = 0; w < 2; w++)
        for (int cell = 1; cell <= 2; cell++)
            TRY(measure_line(
                row_add(table, (struct patch_row){"bar", "axial", variant[w].name, variant[w].value, cell, 0, 0})));
    for (size_t s = 0; s < COUNT_OF(shape); s++)
        for (size_t w = 0; w < COUNT_OF(variant); w++)
            for (size_t l = 0; l < (quick ? 1 : COUNT_OF(load)); l++) {
                struct patch_row r = {shape[s].name, load[l].name, variant[w].name, variant[w].value, 2, 0, 0};
                TRY(measure_plane(row_add(table, r), shape[s].value, load[l].value, quick ? 2 : 4));
            }
    return OK;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Returns true if the rows a and b of the patch test are printed in one line because they differ only in their load. */
static bool coupling_patch_same_line(const struct patch_row *a, const struct patch_row *b)
{
    return !strcmp(a->shape, b->shape) && !strcmp(a->coupling, b->coupling) && !strcmp(a->weights, b->weights) &&
           a->cell == b->cell;
}

/* Prints the results of the patch test in `table`, one line for all loads of an interface and coupling. */
void patch_print(const struct patch_table *table)
{
    printf(
        "\n  uniform strain: largest nodal force over stress x cell face, with the interface on a node > and largest "
        "over positions of the grid\n  %-16s %4s  %-15s %-10s",
        "interface", "cell", "coupling", "weights");
    for (size_t l = 0; l < COUNT_OF(load); l++) printf("   %-16s", load[l].name);
    for (int k = 0; k < table->n; k++) {
        const struct patch_row *r = &table->row[k];
        if (k == 0 || !coupling_patch_same_line(r, r - 1))
            printf("\n  %-16s %2d D  %-15s %-10s", r->shape, r->cell, r->coupling, r->weights);
        printf("  %7.4f > %6.4f", r->on_node, r->largest);
    }
    puts("");
    fflush(stdout);
}

void patch_test_fill_file_table(const struct patch_table *table, struct bench_table *rows)
{
    bench_table_make(rows, "patch", "interface,load,cell_spacings,coupling,weights,on_node,largest");
    for (int k = 0; k < table->n; k++) {
        const struct patch_row *r = &table->row[k];
        char interface[NAME_MAX_LENGTH];
        snprintf(interface, sizeof interface, "%.*s", (int)strcspn(r->shape, ","), r->shape); /* a comma would end
                                                                                               * the cell */
        bench_table_append_text(rows, interface);
        bench_table_append_text(rows, r->load);
        bench_table_append_number(rows, r->cell);
        bench_table_append_text(rows, r->coupling);
        bench_table_append_text(rows, r->weights);
        bench_table_append_number(rows, r->on_node);
        bench_table_append_number(rows, r->largest);
    }
}
