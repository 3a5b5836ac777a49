/* `cleave bench coupling`: measures the effect of an interface between material points and bonds on waves and on
 * uniform strain. This file: the bar, with couplings and widths of the pulse, positions of the interface in its cell,
 * cells and transfers. */
#include <math.h>
#include <string.h>

#include "coupling.h"
#include "base/memory.h"

const struct coupling_variant coupling_variant[VARIANTS] = {
    [VARIANT_DAMPED] = {"partial stress", "partial stress", NULL},
    [VARIANT_UNDAMPED] = {"partial stress undamped", "partial stress", "0"},
    [VARIANT_HANDSHAKE] = {"handshake", "handshake", NULL},
    [VARIANT_PM] = {"pm", "pm", NULL},
    [VARIANT_PG] = {"pg", "pg", NULL},
    [VARIANT_PMG] = {"pmg", "pmg", NULL},
    [VARIANT_PGG] = {"pgg", "pgg", NULL},
};

void coupling_variant_append_overrides(struct bench_overrides *overrides, int variant)
{
    bench_overrides_append(overrides, "coupling", "%s", coupling_variant[variant].coupling);
    if (coupling_variant[variant].damping)
        bench_overrides_append(overrides, "interface_damping", "%s", coupling_variant[variant].damping);
}

/* ---- runs of the bar --------------------------------------------------------------------------------------------- */

static const double spacing = 1;     /* particle spacing of the bar, as in its file [mm] */
static const double interface = 512; /* position of the interface [mm] */

static status coupling_bar_measure(struct bar_run *r)
{
    struct bench_overrides o = {0};
    struct bench_figure f[] = {{.probe = "pulse", .quantity = "reflected"},
                               {.probe = "pulse", .quantity = "transmitted"},
                               {.probe = "pulse", .quantity = "energy_change"}};
    coupling_variant_append_overrides(&o, r->variant);
    bench_overrides_append(&o, "initial[0].pulse.width", "%g mm", r->width * spacing);
    bench_overrides_append(&o, "mpm.cell", "%d", r->cell);
    bench_overrides_append(&o, "mpm.origin", "[%g mm]", interface + r->place * r->cell * spacing);
    bench_overrides_append(&o, "mpm.transfer", "%s", r->transfer);
    bench_overrides_append(&o, "output.samples", "1");
    TRY(bench_run_scene_and_read_figures(COUPLING_BAR, NULL, &o, f, COUNT_OF(f)));
    r->result = (struct pulse_result){f[0].value, f[1].value, f[2].value};
    return OK;
}

static status bar_add(struct bar_table *t, struct bar_run r)
{
    INVARIANT(t->n < BAR_RUNS_MAX);
    TRY(coupling_bar_measure(&r));
    t->run[t->n++] = r;
    return OK;
}

/* Runs the bar with all couplings and several widths of the pulse, with a grid node at the interface between bonds and
 * material points, and adds the results to the table t. quick: true for fewer widths. Returns FAILED or REFUSED if a
 * run does. */
static status measure_pulses(struct bar_table *t, bool quick)
{
    for (int variant = 0; variant < VARIANTS; variant++)
        for (int width = quick ? 32 : 16; width <= (quick ? 64 : 128); width *= 2)
            TRY(bar_add(t, (struct bar_run){.variant = variant, .width = width, .cell = 2, .transfer = "flip"}));
    return OK;
}

enum { PLACES = 4 };

/* Runs the bar with the couplings partial stress and handshake for several distances between the interface and the next
 * node of the grid, whose cells have two spacings, and adds the results to the table t. quick: fewer widths of the
 * pulse. Returns FAILED or REFUSED if a run does. */
static status measure_places(struct bar_table *t, bool quick)
{
    for (int variant = 0; variant <= VARIANT_HANDSHAKE; variant++)
        for (int width = quick ? 32 : 16; width <= (quick ? 32 : 64); width *= 2)
            for (int place = 0; place < PLACES; place++)
                TRY(bar_add(t, (struct bar_run){.variant = variant,
                                                .width = width,
                                                .cell = 2,
                                                .place = (double)place / PLACES,
                                                .transfer = "flip"}));
    return OK;
}

/* Runs the bar with the couplings partial stress and handshake, with one particle per cell and with the transfer APIC,
 * and adds the results to the table t. With APIC, partial stress is run once only, since only FLIP damps the interface.
 * quick: fewer combinations. Returns FAILED or REFUSED if a run does. */
static status measure_variants(struct bar_table *t, bool quick)
{
    static const struct {
        int cell;
        const char *transfer;
    } grid[] = {{1, "flip"}, {2, "apic"}, {1, "apic"}};
    for (size_t v = 0; v < (quick ? 2 : COUNT_OF(grid)); v++)
        for (int variant = 0; variant <= VARIANT_HANDSHAKE; variant++)
            for (int width = 32; width <= (quick ? 32 : 64); width *= 2) {
                if (variant == VARIANT_UNDAMPED && v > 0) continue;
                TRY(bar_add(
                    t, (struct bar_run){
                           .variant = variant, .width = width, .cell = grid[v].cell, .transfer = grid[v].transfer}));
            }
    return OK;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Indices of the values of a result (share_of). */
enum { REFLECTED, TRANSMITTED, ENERGY, SHARES };

/* Returns one of the three values of the result r [1]. share: REFLECTED, TRANSMITTED or ENERGY. */
static double share_of(const struct pulse_result *r, int share)
{
    return share == REFLECTED ? r->reflected : share == TRANSMITTED ? r->transmitted : r->energy_change;
}

/* Prints a line of table t for each coupling with its results for all widths of the pulse. Runs of one coupling must be
 * consecutive in it. */
static void print_pulses(const struct bar_table *t)
{
    static const char *const format[SHARES] = {" %7.2f", " %7.1f", " %+7.2f"};
    const int widths = t->n / VARIANTS;
    printf("  a pulse in a bar, its width in spacings; against the bar of material points alone [%%]\n"
           "  %-24s   %-*s   %-*s   %-*s\n  %-24s",
           "", 8 * widths, "reflected", 8 * widths, "transmitted", 8 * widths, "change of energy", "coupling");
    for (int k = 0; k < SHARES * widths; k++) printf("%s %7.0f", k % widths ? "" : "   ", t->run[k % widths].width);
    for (int k = 0; k < t->n; k += widths) {
        printf("\n  %-24s", coupling_variant[t->run[k].variant].name);
        for (int share = 0; share < SHARES; share++) {
            fputs("   ", stdout);
            for (int w = 0; w < widths; w++) printf(format[share], 100 * share_of(&t->run[k + w].result, share));
        }
    }
    puts("");
    fflush(stdout);
}

static void print_places(const struct bar_table *t)
{
    printf("\n  the interface elsewhere in its cell (of 2 D): reflected share\n  %-24s %6s", "coupling", "width");
    for (int place = 0; place < PLACES; place++) printf(" %7.2f h", (double)place / PLACES);
    printf(" %10s\n", "largest");
    for (int k = 0; k < t->n; k += PLACES) {
        double largest = 0;
        printf("  %-24s %4.0f D", coupling_variant[t->run[k].variant].name, t->run[k].width);
        for (int place = 0; place < PLACES; place++) {
            largest = fmax(largest, t->run[k + place].result.reflected);
            printf(" %7.2f %%", 100 * t->run[k + place].result.reflected);
        }
        printf(" %8.2f %%\n", 100 * largest);
    }
    fflush(stdout);
}

static void print_variants(const struct bar_table *t)
{
    printf("\n  other cells and transfers\n  %-24s %4s %5s %6s %11s %13s %9s\n", "coupling", "cell", "", "width",
           "reflected", "transmitted", "energy");
    for (int k = 0; k < t->n; k++) {
        const struct bar_run *r = &t->run[k];
        printf("  %-24s %2d D %5s %4.0f D %9.2f %% %11.2f %% %+7.2f %%\n", coupling_variant[r->variant].name, r->cell,
               r->transfer, r->width, 100 * r->result.reflected, 100 * r->result.transmitted,
               100 * r->result.energy_change);
    }
    fflush(stdout);
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Appends reflected amplitude, transmitted amplitude and change of energy of the result r to a row of the table
 * `rows`. */
static void fill_result(struct bench_table *rows, const struct pulse_result *r)
{
    bench_table_append_number(rows, r->reflected);
    bench_table_append_number(rows, r->transmitted);
    bench_table_append_number(rows, r->energy_change);
}

static void fill_bars(struct bench_table *rows, const struct bar_table *t, const char *name)
{
    bench_table_make(rows, name,
                     name[0] ? "coupling,width_spacings,cell_spacings,place_cells,transfer,reflected,transmitted,"
                               "energy_change"
                             : "coupling,width_spacings,reflected,transmitted,energy_change");
    for (int k = 0; k < t->n; k++) {
        const struct bar_run *r = &t->run[k];
        bench_table_append_text(rows, coupling_variant[r->variant].name);
        bench_table_append_number(rows, r->width);
        if (name[0]) {
            bench_table_append_number(rows, r->cell);
            bench_table_append_number(rows, r->place);
            bench_table_append_text(rows, r->transfer);
        }
        fill_result(rows, &r->result);
    }
}

static status coupling_write_tables(const struct coupling_figures *all)
{
    struct bench_table table[5];
    fill_bars(&table[0], &all->pulses, "");
    fill_bars(&table[1], &all->places, "places");
    fill_bars(&table[2], &all->variants, "variants");
    patch_test_fill_file_table(&all->patch, &table[3]);
    plane_wave_fill_file_table(&all->plane, &table[4]);
    status s = bench_write_result_tables("coupling", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Runs all parts of the bench, stores their results in *all, prints them and writes tables and pictures. quick: fewer
 * runs. Returns REFUSED if the scene files are missing, FAILED if a run or a file fails. */
static status coupling_measure_all(struct coupling_figures *all, bool quick)
{
    if (!bench_scene_exists(COUPLING_BAR) || !bench_scene_exists(COUPLING_PLATE))
        return status_set(REFUSED, "bench coupling: its scenes are not here; start it where the folder inputs is");
    threads_set_count_and_bind_to_cores(1); /* a bar is too short to be divided among threads */
    TRY(measure_pulses(&all->pulses, quick));
    print_pulses(&all->pulses);
    TRY(measure_places(&all->places, quick));
    print_places(&all->places);
    TRY(measure_variants(&all->variants, quick));
    print_variants(&all->variants);
    TRY(patch_test_measure_nodal_forces(&all->patch, quick));
    patch_print(&all->patch);
    threads_set_count_and_bind_to_cores(0);
    TRY(plane_wave_measure_reflections(&all->plane, quick));
    plane_print(&all->plane);
    TRY(coupling_write_tables(all));
    TRY(coupling_draw_picture_of_pulse());
    return bench_draw("coupling", 1400, 1000, coupling_write_picture_commands, all);
}

status bench_coupling(bool quick)
{
    struct coupling_figures *all = NEW("bench.coupling", 1, struct coupling_figures);
    printf("coupling\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    status s = coupling_measure_all(all, quick);
    memory_free(all);
    return s;
}
