/* `cleave bench laws`: laws of materials beside closed forms and published values. */
#include <math.h>
#include <stdio.h>

#include "laws_bench.h"
#include "base/team.h"

#define SUM "strain = sigma/E + a"
#define WILKINS "Wilkins & Guinan 1973; Kamoulakos 1990, Zhu & Cescotto 1995, Camacho & Ortiz 1997: 7.0 to 7.2 mm"
#define MPM3D "MPM3D-F90, linear shapes, November 2026"
#define ARMSTRONG "k + C/gamma (1 - exp(-gamma a)); stable: k + C/gamma tanh(gamma da/2)"
#define PRANDTL "equations of Prandtl & Reuss"
#define LOCKED "MPM3D-F90, linear shapes, November 2026; own dilatations of the points, as there"
#define FINER "own, half the spacing; MPM3D-F90, locked: 16.24, 6.56 mm, 1.36 GPa"
#define COOK "quadratic finite elements in plane strain, 27.4 to 27.6 um"
#define HILL "Hill 1950"
#define HILL_RADIAL "Hill 1950; nu 0.3: radial integration of Prandtl & Reuss, 800 elements, both readings"
#define HEATING "T* = 1 - exp(-beta R W/(rho c (T_melt - T_room)))"
#define RATE "integration in 100000 steps a cycle, each by bisection; 5 cycles"
#define RELAX "sigma = sigma_0 (1 - C log(exp(-y) + t E eps0/(sigma_0 C))), y = (sigma(0)/sigma_0 - 1)/C"
#define KRIEG "Krieg & Krieg 1977: tan(psi/2) = exp(-2 G e/R) tan(psi_0/2); load steps: radial returns"
#define NUMERIC "integration of the law in steps of 1e-6"

/* clang-format off */
const struct laws_case laws_cases[] = {
    {"bar, Voce 200 + 150 (1 - exp(-20 a)) MPa", SUM, laws_measure_hardening, false, {FLOW_VOCE},
     {{"stress at 0.01", "MPa", 224.403, 6e-4}, {"stress at 0.05", "MPa", 293.176, 6e-4},
      {"plastic work", "MJ/m^3", 12.3281, 1e-4}}},
    {"bar, table 200, 260, 320 MPa", "the lines 200 + 6000 a, 245 + 1500 a, 320",
     laws_measure_tabulated_hardening, false, {0},
     {{"stress at 0.008", "MPa", 248 / 1.03, 1e-10}, {"stress at 0.04", "MPa", 305 / 1.0075, 1e-10},
      {"stress at 0.2", "MPa", 320, 1e-10}}},
    {"plane strain tension, 250 MPa", PRANDTL, laws_measure_plane_strain_tension, false, {0, 0.005},
     {{"stress", "MPa", 288.665, 0.01}, {"stress across", "MPa", 142.289, 0.2}, {"plastic strain", "1e-3", 4.209, 0.02},
      {"elastic up to", "MPa", 281.272 - 1.1, 1.2}}},
    {"plane strain tension, H 1000 MPa", PRANDTL, laws_measure_plane_strain_tension, false, {1000, 0.02},
     {{"stress", "MPa", 313.376, 0.02}, {"stress across", "MPa", 156.376, 0.02}}},
    {"Prager, C 10 GPa, strains +-0.01", "sigma = 200 + C (0.01 - sigma/E)", laws_measure_prager_hardening, false, {0},
     {{"first", "MPa", 285.714, 6e-4}, {"second", "MPa", -285.714, 6e-4}, {"third", "MPa", 285.714, 6e-4},
      {"fourth", "MPa", -285.714, 6e-4}}},
    {"Armstrong-Frederick, C 40 GPa, gamma 300", ARMSTRONG, laws_measure_armstrong_frederick_hardening, false, {0},
     {{"first at 0.01", "MPa", 322.56, 0.03}, {"sixth", "MPa", 331.56, 0.03},
      {"ratchet +300/-200", "1e-3", 2.75560, 2.8e-3}}},
    {"Johnson-Cook copper, 1000/s, m 1, a 0.2", HEATING, laws_measure_johnson_cook_heating, false, {0, 1, 0.2},
     {{"stress", "MPa", 309.393, 0.02}, {"temperature", "K", 307.771, 0.01}}},
    {"Johnson-Cook copper, 1000/s, m 1, a 0.5", HEATING, laws_measure_johnson_cook_heating, false, {0, 1, 0.5},
     {{"stress", "MPa", 367.131, 0.02}, {"temperature", "K", 334.689, 0.01}}},
    {"Johnson-Cook copper, 1000/s, m 1, a 1", HEATING, laws_measure_johnson_cook_heating, false, {0, 1, 1},
     {{"stress", "MPa", 409.161, 0.02}, {"temperature", "K", 386.002, 0.01}}},
    {"Johnson-Cook copper, m 1.09, a 1", NUMERIC, laws_measure_johnson_cook_heating, false, {0, 1.09, 1},
     {{"stress", "MPa", 416.478, 0.02}, {"temperature", "K", 386.955, 0.01}}},
    {"Johnson-Cook 4340 steel, a 0.5", NUMERIC, laws_measure_johnson_cook_heating, false, {1, 1.03, 0.5},
     {{"stress", "MPa", 1217.20, 0.02}, {"temperature", "K", 436.69, 0.01}}},
    {"Johnson-Cook copper, +-0.002 at 10 kHz", RATE, laws_measure_rate_sensitive_cycles, false, {0.002, 1e4},
     {{"a, 1000 steps a cycle", "%", 1.2551, 2e-3}, {"a, 10000 steps a cycle", "%", 1.2551, 2e-4}}},
    {"Johnson-Cook, 90 MPa, held after 1000/s", RELAX, laws_measure_stress_relaxation, false, {1e-6, 1e-5},
     {{"stress at 1000/s", "MPa", 105.542, 1e-3}, {"after 1 us", "MPa", 96.609, 0.02},
      {"after 10 us", "MPa", 91.467, 2e-3}}},
    {"tension, then shear, flow turns by 75 degrees", KRIEG, laws_measure_tension_then_shear, false, {0},
     {{"left, 1000 explicit steps", "sigma_y", 0.26580, 4e-4}, {"left, 1 load step", "sigma_y", 0.44721, 1e-5},
      {"left, 4 load steps", "sigma_y", 0.33514, 1e-5}, {"left, 16 load steps", "sigma_y", 0.28591, 1e-5}}},
    {"500 random strains, energy", "work = elastic energy + plastic work",
     laws_measure_energy_of_random_strains, false, {0},
     {{"Voce, space", "1", 0, 1e-14}, {"kinematic, plane stress", "1", 0, 1e-14},
      {"Johnson-Cook, plane strain", "1", 0, 1e-14}}},
    {"Cook's membrane, nu 0.4999, load steps", COOK, laws_measure_cook_membrane, true, {0, 0, 0.75},
     {{"corner", "um", 27.5, 0.8}}},
    {"Cook's membrane in space, load steps", COOK, laws_measure_cook_membrane, true, {1, 0, 0.75},
     {{"corner", "um", 27.5, 0.8}}},
    {"Cook's membrane, current frame", COOK, laws_measure_cook_membrane, true, {0, 1, 1.5},
     {{"corner", "um", 27.5, 2}}},
    {"torsion, R 10 mm, 250 MPa, first yield", "pi R^3/2 k", laws_measure_torsion_moment, true, {1},
     {{"moment", "N m", 226.725, 2.3}}},
    {"torsion, twice that angle", "2 pi R^3/3 k (1 - 1/32)", laws_measure_torsion_moment, true, {2},
     {{"moment", "N m", 0.96875 * 302.300, 3}}},
    {"torsion, 20 times", "2 pi R^3/3 k", laws_measure_torsion_moment, true, {20}, {{"moment", "N m", 302.300, 3}}},
    {"beam, plane stress, 2 times first yield", "3/2 (1 - 1/12)", laws_measure_beam_bending, true, {0, 2},
     {{"moment", "M_y", 1.375, 0.01}}},
    {"beam, plane stress, 4 times", "3/2 (1 - 1/48)", laws_measure_beam_bending, true, {0, 4},
     {{"moment", "M_y", 1.46875, 0.01}}},
    {"beam, plane strain, 4 times", "1.026 times plane stress", laws_measure_beam_bending, true, {1, 4},
     {{"moment", "M_y", 1.507, 0.015}}},
    {"hollow sphere, b/a 2, front at 1.5 a", HILL, laws_measure_hollow_sphere, true, {0},
     {{"front, elastic part", "a", 1.5, 0.03}, {"front, plastic strain", "a", 1.5, 0.03},
      {"outer displacement", "um", 7.3828, 0.37}, {"collapse", "sigma_y", 1.38629, 0.04}}},
    {"thick cylinder, b/a 2, front at 1.2 a", HILL_RADIAL, laws_measure_thick_cylinder, true, {1.2},
     {{"front, elastic part", "a", 1.2003, 0.015}, {"front, plastic strain", "a", 1.1999, 0.015}}},
    {"thick cylinder, front at 1.5 a", HILL_RADIAL, laws_measure_thick_cylinder, true, {1.5},
     {{"front, elastic part", "a", 1.5021, 0.015}, {"front, plastic strain", "a", 1.5011, 0.015}}},
    {"thick cylinder, front at 1.8 a", HILL_RADIAL, laws_measure_thick_cylinder, true, {1.8},
     {{"front, elastic part", "a", 1.8155, 0.03}, {"front, plastic strain", "a", 1.8137, 0.03}}},
    {"copper bar, 400 + 100 a MPa, 227 m/s, gimp", WILKINS, laws_measure_wilkins_bar_impact, true, {0},
     {{"length", "mm", 21.4, 0.1}, {"foot", "mm", 7.1, 0.3}, {"energy balance", "%", 0, 0.3}}},
    {"copper bar, 227 m/s, linear", WILKINS, laws_measure_wilkins_bar_impact, true, {1},
     {{"length", "mm", 21.4, 0.1}, {"foot", "mm", 7.1, 0.3}, {"energy balance", "%", 0, 0.3}}},
    {"copper bar, 157 + 425 a MPa, 190 m/s, gimp", MPM3D, laws_measure_copper_bar_impact, true, {0},
     {{"height", "mm", 16.24, 0.25}, {"radius", "mm", 6.56, 0.1}, {"plastic strain", "1", 1.60, 0.05},
      {"pressure at rest, r.m.s.", "GPa", 0.3, 0.3}, {"energy balance", "%", 0, 0.3}}},
    {"copper bar, 190 m/s, linear, cells that lock", LOCKED, laws_measure_copper_bar_impact, true, {1, 1},
     {{"height", "mm", 16.24, 0.16}, {"radius", "mm", 6.56, 0.1}, {"plastic strain", "1", 1.60, 0.05},
      {"pressure at rest, r.m.s.", "GPa", 1.36, 0.15}}},
    {"copper bar, 190 m/s, linear", FINER, laws_measure_copper_bar_impact, true, {1},
     {{"height", "mm", 16.125, 0.16}, {"radius", "mm", 6.751, 0.1}, {"plastic strain", "1", 1.66, 0.08},
      {"pressure at rest, r.m.s.", "GPa", 0.3, 0.3}, {"energy balance", "%", 0, 0.3}}},
    {"Johnson-Cook copper bar, 190 m/s, gimp", MPM3D, laws_measure_johnson_cook_bar_impact, true, {0},
     {{"height", "mm", 17.09, 0.16}, {"radius", "mm", 7.03, 0.1}, {"temperature", "K", 546, 10},
      {"energy balance", "%", 0, 0.3}}},
};
/* clang-format on */
const int laws_cases_count = COUNT_OF(laws_cases);

bool laws_figure_holds(const struct laws_figure *expected, double measured)
{
    return fabs(measured - expected->expected) <= expected->tolerance;
}

/* Prints the measured values found[LAWS_FIGURES] of case c beside the expected ones, and adds a row for each to the
 * table `rows`. */
static void laws_rows(const struct laws_case *c, const double *found, struct bench_table *rows)
{
    for (int k = 0; k < LAWS_FIGURES && c->asked[k].what; k++) {
        const struct laws_figure *f = &c->asked[k];
        const char *const verdict = laws_figure_holds(f, found[k]) ? "holds" : "MISSED";
        printf("  %-44s %-27s %9.6g %9.6g %9.2g %-7s %s\n", c->name, f->what, f->expected, found[k], f->tolerance,
               f->unit, verdict);
        bench_table_append_text(rows, c->name), bench_table_append_text(rows, f->what),
            bench_table_append_text(rows, f->unit);
        bench_table_append_number(rows, f->expected), bench_table_append_number(rows, found[k]),
            bench_table_append_number(rows, f->tolerance);
        bench_table_append_text(rows, verdict), bench_table_append_text(rows, c->source);
    }
    fflush(stdout);
}

status bench_laws(bool quick)
{
    static const char *const needed[] = {"inputs/taylor_bar.yaml", "inputs/taylor_bar_jc.yaml"};
    struct bench_table rows;
    if (!quick) TRY(bench_check_scenes_exist("laws", needed, COUNT_OF(needed)));
    printf("laws: metals beside closed forms and published values\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    printf("  %-44s %-27s %9s %9s %9s\n", "", "", "expected", "found", "tolerance");
    bench_table_make(&rows, "", "case,figure,unit,expected,found,tolerance,verdict,source");
    for (int k = 0; k < laws_cases_count; k++) {
        const struct laws_case *c = &laws_cases[k];
        double found[LAWS_FIGURES] = {NAN, NAN, NAN, NAN, NAN, NAN};
        if (quick && c->body) continue;
        if (c->measure(c, found) != OK) printf("  %s\n", status_message());
        laws_rows(c, found, &rows);
    }
    const status s = bench_write_result_tables("laws", &rows, 1);
    bench_table_free(&rows);
    return s;
}
