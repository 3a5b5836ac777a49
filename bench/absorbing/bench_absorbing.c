/* `cleave bench absorbing`: measures how much of a wave an absorbing face reflects. */
#include <math.h>
#include <stdio.h>

#include "absorbing_bench.h"

const struct absorbing_method absorbing_methods[ABSORBING_METHODS] = {
    {"bonds", "method: pd"},
    {"ospd", "method: pd\nmodel: ospd"},
    {"mospd", "method: pd\nmodel: mospd"},
    {"points, flip", "method: mpm\nmpm: {frame: current}"},

    {"points, apic", "method: mpm\nmpm: {frame: current, transfer: apic}"},
    {"cells", "method: mpm\nmpm: {frame: reference}"},
};

/* ---- normal incidence -------------------------------------------------------------------------------------------- */

/* Widths of the pulses [spacings]. */
static const int pulse_widths[] = {16, 32, 64};

/* Measures the reflection of pulses of all widths at normal incidence in `dim` dimensions, prints a line with the
 * results and adds a row per width to the table `rows`. m: method of the runs. */
static void normal_row(const struct absorbing_method *m, int dim, struct bench_table *rows)
{
    printf("  %-14s %d D ", m->name, dim);
    for (int k = 0; k < (int)COUNT_OF(pulse_widths); k++) {
        struct absorbing_pulse figure = {NAN, NAN, NAN};
        if (absorbing_measure_pulse_reflection(m, dim, pulse_widths[k], &figure) != OK) printf(" %s", status_message());
        printf("  %6.2f %%", 100 * figure.reflected);
        if (k == 1) printf(" (balance %.0e, back %.0e)", figure.balance, figure.back);
        fflush(stdout);
        bench_table_append_text(rows, m->name), bench_table_append_number(rows, dim),
            bench_table_append_number(rows, pulse_widths[k]);
        bench_table_append_number(rows, figure.reflected);
        bench_table_append_number(rows, figure.balance), bench_table_append_number(rows, figure.back);
    }
    printf("\n");
}

/* ---- oblique incidence ------------------------------------------------------------------------------------------- */

/* Measures the reflection of one plane wave by an absorbing face, prints it beside the theory, and adds a row to the
 * table `rows`. m: method of the run; shear: S wave, else P wave; degrees: angle of incidence; wavelength
 * [spacings]. */
static void oblique_row(const struct absorbing_method *m, bool shear, int degrees, double wavelength,
                        struct bench_table *rows)
{
    struct absorbing_reflection seen = {NAN, NAN};
    const double angle = degrees * M_PI / 180;
    const struct absorbing_reflection exact = absorbing_reflection_in_closed_form(shear, angle, sqrt(3));
    if (absorbing_measure_oblique_reflection(m, shear, angle, wavelength, &seen) != OK)
        printf("  %s\n", status_message());
    printf("  %-14s %s  %2d degrees  %3.0f spacings  as P %5.1f %% (theory %5.1f)  as S %5.1f %% (theory %5.1f)\n",
           m->name, shear ? "S" : "P", degrees, wavelength, 100 * seen.as_p, 100 * exact.as_p, 100 * seen.as_s,
           100 * exact.as_s);
    fflush(stdout);
    bench_table_append_text(rows, m->name), bench_table_append_text(rows, shear ? "S" : "P"),
        bench_table_append_number(rows, degrees);
    bench_table_append_number(rows, wavelength), bench_table_append_number(rows, seen.as_p),
        bench_table_append_number(rows, exact.as_p);
    bench_table_append_number(rows, seen.as_s), bench_table_append_number(rows, exact.as_s);
}

static void oblique_rows(bool quick, struct bench_table *rows)
{
    static const int degrees[] = {15, 30, 45, 60};
    for (int m = 0; m < ABSORBING_METHODS; m++)
        for (int k = 0; k < (int)COUNT_OF(degrees); k++) {
            if (quick && degrees[k] != 45) continue;
            for (int shear = 0; shear < 2; shear++) oblique_row(&absorbing_methods[m], shear, degrees[k], 32, rows);
        }
}

status bench_absorbing(bool quick)
{
    struct bench_table table[2];
    bench_table_make(&table[0], "", "method,dimensions,width,reflected,balance_error,step_back");
    bench_table_make(&table[1], "oblique", "method,wave,angle_deg,wavelength,as_p,as_p_theory,as_s,as_s_theory");
    printf("absorbing: largest velocity that comes back of plane pulses 16, 32 and 64 spacings wide\n");
    for (int m = 0; m < ABSORBING_METHODS; m++)
        for (int dim = 1; dim <= (quick ? 2 : DIM_MAX); dim++)
            if (dim > 1 || m == 0 || m > 2) normal_row(&absorbing_methods[m], dim, &table[0]);
    printf("waves at an angle to the normal of the face, Poisson's ratio 1/4: amplitudes that come back\n");
    oblique_rows(quick, &table[1]);
    const status s = bench_write_result_tables("absorbing", table, 2);
    bench_table_free(&table[0]), bench_table_free(&table[1]);
    return s;
}
