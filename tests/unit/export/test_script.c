/* Script of the export to LAMMPS: coefficients of bonds and neighbourhoods are compared with closed forms; formulas of
 * loads and driven particles, evaluated as LAMMPS does, with functions of time. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/team.h"
#include "export/export.h"
#include "output/output_files.h"
#include "tests/support/folder.h"
#include "tests/support/near.h"

#define STEP 2e-8

static const char equal[] =
    "pd: {volume: cut-ramp, surface: none, weights: uniform, last_force: whole}\ntime: {step: 2e-8}\n";
static const char pairs[] = "contact: {law: pair, distance: lammps}\n", none[] = "contact: {between: none}\n";
static const char plate[] =
    "space: plane stress\nthickness: 0.37 mm\nduration: 1 us\nmethod: pd\n"
    "body: {box: {from: [-3 mm, -3 mm], to: [3 mm, 3 mm]}}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n";
static const char block[] =
    "space: solid\nduration: 1 us\nmethod: pd\n"
    "body: {box: {from: [0, 0, 0], to: [3 mm, 3 mm, 3 mm]}}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n";
static const char glass[] = "material: {young: 192 GPa, density: 8000, critical_stretch: 0.013}\n";

/* If true, script_of stores the text of plate.data in bonds_found, to be freed by the caller. */
static bool bonds_wanted;
static char *bonds_found;

/* Exports the scene with the joined text a, b, c to LAMMPS and returns the text of in.lammps, to be freed. bond_style:
 * true to export bonds as a bond style of LAMMPS, false as a pair style. */
static char *script_of(const char *a, const char *b, const char *c, bool bond_style)
{
    static const char *const file[] = {"plate.data", "in.lammps", "README.txt", "scene.yaml", "check.csv"};
    const struct export_request r = {
        .scene = "scene.yaml", .folder = "out", .bond_style = bond_style, .allow_different = true};
    char *script;
    size_t length;
    FILE *to = fopen("scene.yaml", "w");
    assert_non_null(to);
    fprintf(to, "%s%s%s%s%s", a, b, c, equal, strstr(b, "ospd") ? none : pairs);
    fclose(to);
    assert_ok(export_lammps(&r));
    assert_ok(file_read_whole("out/in.lammps", &script, &length));
    if (bonds_wanted) assert_ok(file_read_whole("out/plate.data", &bonds_found, &length));
    for (size_t k = 0; k < COUNT_OF(file); k++) unlink(path_join("out", file[k]).text);
    rmdir("out");
    return script;
}

/* Returns the part of `script` after the first occurrence of `words`; fails the test if there is none. */
static const char *behind(const char *script, const char *words)
{
    const char *at = strstr(script, words);
    if (!at) fail_msg("no %s in\n%s", words, script);
    return at + strlen(words);
}

static real number_behind(const char *script, const char *words) { return strtod(behind(script, words), NULL); }

/* ---- formulas of LAMMPS ------------------------------------------------------------------------------------------ */

/* State of the evaluation of a formula: position in its text, script with its variables, time step, mass of the
 * atom. */
struct formula {
    const char *at, *script;
    real step, mass;
};

static real sum_of(struct formula *f);

static real variable_of(const struct formula *f, const char *name, size_t length)
{
    char words[80];
    snprintf(words, sizeof words, "variable %.*s ", (int)length, name);
    const char *text = strchr(behind(f->script, words), '"');
    struct formula inner = *f;
    inner.at = text + 1;
    return sum_of(&inner);
}

static real factor_of(struct formula *f)
{
    real value, sign = 1;
    if (*f->at == '-') sign = -1, f->at++;
    if (*f->at == '(') {
        f->at++, value = sum_of(f);
        assert_true(*f->at == ')');
        f->at++;
    } else if (isdigit((unsigned char)*f->at)) {
        char *end;
        value = strtod(f->at, &end), f->at = end;
    } else {
        const char *name = f->at;
        while (isalnum((unsigned char)*f->at) || *f->at == '_') f->at++;
        const size_t length = (size_t)(f->at - name);
        if (length == 4 && memcmp(name, "step", 4) == 0)
            value = f->step;
        else if (length == 4 && memcmp(name, "mass", 4) == 0)
            value = f->mass;
        else if (length == 2 && memcmp(name, "PI", 2) == 0)
            value = 3.14159265358979323846;
        else if (length == 3 && memcmp(name, "sin", 3) == 0) {
            f->at++, value = sin(sum_of(f)), f->at++;
        } else
            value = variable_of(f, name + 2, length - 2);
    }
    if (*f->at == '^') f->at++, value = pow(value, factor_of(f));
    return sign * value;
}

static real product_of(struct formula *f)
{
    real value = factor_of(f);
    while (*f->at == '*' || *f->at == '/') {
        const char sign = *f->at++;
        const real other = factor_of(f);
        value = sign == '*' ? value * other : value / other;
    }
    return value;
}

static real terms_of(struct formula *f)
{
    real value = product_of(f);
    while (*f->at == '+' || *f->at == '-') {
        const char sign = *f->at++;
        value += sign == '+' ? product_of(f) : -product_of(f);
    }
    return value;
}

static real sum_of(struct formula *f)
{
    const real value = terms_of(f);
    if (f->at[0] == '>' && f->at[1] == '=') return f->at += 2, value >= terms_of(f);
    if (f->at[0] == '<') return f->at += 1, value < terms_of(f);
    if (f->at[0] == '>') return f->at += 1, value > terms_of(f);
    return value;
}

static real formula_at(const char *script, const char *name, int step, real mass)
{
    const struct formula f = {NULL, script, step, mass};
    return variable_of(&f, name, strlen(name));
}

/* ---- coefficients ------------------------------------------------------------------------------------------------ */

/* Checks the coefficients of state-based pair styles against closed forms: in 3D K and G; in 2D 4 (lambda' + G)/9 and 8
 * G/15, for which the 3D law of LAMMPS equals the 2D law. */
static void coefficients(void **state)
{
    (void)state;
    static const char ospd[] =
        "model: ospd\nmaterial: {young: 192 GPa, poisson: 0.21, density: 8000, critical_stretch: 0.013}\n";
    const real E = 192e9, nu = 0.21, G = E / (2 * (1 + nu));
    for (int dim = 2; dim <= 3; dim++) {
        char *script = script_of(dim == 2 ? plate : block, ospd, "", false), *end;
        const real first = strtod(strchr(behind(script, "pair_coeff ") + 4, ' '), &end), second = strtod(end, NULL);
        assert_close(first, dim == 3 ? E / (3 * (1 - 2 * nu)) : 4.0 / 9 * (E * nu / (1 - nu * nu) + G), 1e-12);
        assert_close(second, dim == 3 ? G : 8.0 / 15 * G, 1e-12);
        assert_close(number_behind(script, "timestep "), STEP, 1e-12);
        assert_close(number_behind(script, "lattice sc "), 5e-4, 1e-7);
        assert_true(number_behind(script, "comm_modify cutoff ") > 3.015 * 5e-4 * 1.013);
        memory_free(script);
    }
}

/* Checks that bonds between two materials are exported with the harmonic mean of both moduli. */
static void bonds_of_two(void **state)
{
    (void)state;
    static const char two[] = "materials:\n  - {name: a, young: 192 GPa, density: 8000, critical_stretch: 0.013}\n"
                              "  - {name: b, young: 70 GPa, density: 2700, critical_stretch: 0.013}\n"
                              "space: plane stress\nthickness: 0.37 mm\nduration: 1 us\nmethod: pd\n"
                              "bodies:\n  - {material: a, shape: {box: {from: [-3 mm, -3 mm], to: [3 mm, 3 mm]}}, "
                              "parts: [{region: {box: {from: [0, -inf], to: [inf, inf]}}, material: b}]}\n"
                              "particles: {spacing: 0.5 mm, horizon: 3.015}\n";
    real c[3];
    char *script = script_of(two, "", "", false);
    const char *at = script;
    for (int k = 0; k < 3; k++) {
        char types[2][16];
        at = behind(at, "pair_coeff ");
        assert_int_equal(sscanf(at, "%15s %15s %lf", types[0], types[1], &c[k]), 3);
    }
    assert_close(c[2] / c[0], 70.0 / 192, 1e-12);
    assert_close(c[1], 2 * c[0] * c[2] / (c[0] + c[2]), 1e-12);
    memory_free(script);
}

/* Checks that bonds of plate.data between two of three materials have bond types with the harmonic mean of both
 * stiffnesses. */
static void bonds_of_three(void **state)
{
    (void)state;
    static const char three[] =
        "materials:\n  - {name: a, young: 192 GPa, density: 8000, critical_stretch: 0.013}\n"
        "  - {name: b, young: 70 GPa, density: 2700, critical_stretch: 0.013}\n"
        "  - {name: c, young: 3.1 GPa, density: 1180, critical_stretch: 0.013}\n"
        "space: plane stress\nthickness: 0.37 mm\nduration: 1 us\nmethod: pd\n"
        "bodies:\n  - {material: a, shape: {box: {from: [-3 mm, -3 mm], to: [3 mm, 3 mm]}}, parts: [\n"
        "      {region: {box: {from: [0, -inf], to: [inf, inf]}}, material: b},\n"
        "      {region: {box: {from: [-inf, 0], to: [inf, inf]}}, material: c}]}\n"
        "particles: {spacing: 0.5 mm, horizon: 3.015}\n";
    static const real young[] = {192, 70, 3.1};
    enum { SIDE = 12 };
    int found[3][3] = {{0}}, bonds = 0;
    real of_type[7] = {0};
    bonds_wanted = true;
    char *script = script_of(three, "", "", true), *data = bonds_found;
    bonds_wanted = false;
    const char *at = script;
    for (int k = 0; k < 6; k++) {
        int type;
        at = behind(at, "bond_coeff ");
        assert_int_equal(sscanf(at, "%d %*s %lf", &type, &of_type[k + 1]), 2);
        assert_int_equal(type, k + 1);
    }
    for (at = behind(data, "\nBonds\n\n"); *at != '\n' && *at; at = strchr(at, '\n') + 1, bonds++) {
        int number, type, end[2], m[2];
        assert_int_equal(sscanf(at, "%d %d %d %d", &number, &type, &end[0], &end[1]), 4);
        for (int e = 0; e < 2; e++) /* row by row from the lower left */
            m[e] = (end[e] - 1) / SIDE >= SIDE / 2 ? 2 : (end[e] - 1) % SIDE >= SIDE / 2 ? 1 : 0;
        const real expected = 2 * young[m[0]] * young[m[1]] / (young[m[0]] + young[m[1]]);
        assert_close(of_type[type] / of_type[1], expected / young[0], 1e-9);
        found[m[0]][m[1]]++;
    }
    for (int a = 0; a < 3; a++)
        for (int b = a; b < 3; b++) assert_true(found[a][b] + found[b][a] > 4);
    memory_free(script);
    memory_free(data);
}

/* ---- loads ------------------------------------------------------------------------------------------------------- */

/* Checks the exported forces of a traction normal to a face: traction over spacing (force per volume), with bond styles
 * traction times face area. The function of time is the mean of its values at both ends of the velocity update, from
 * step - 1/2 to step + 1/2, from 0 in the first step. */
static void forces(void **state)
{
    (void)state;
    static const struct {
        const char *time;
        int kind;
    } f[] = {{"ramp: {from: 0.1 us, until: 0.7 us}", 0},
             {"pulse: {from: 0.1 us, until: 0.7 us}", 1},
             {"step: {from: 0.11 us, until: 0.69 us}", 2},
             {"step: {until: 0.69 us}", 4},
             {"table: [[0.1 us, 0.2], [0.3 us, -1], [0.8 us, 0.5]]", 3}};
    for (size_t k = 0; k < COUNT_OF(f); k++)
        for (int style = 0; style < 2; style++) {
            char load[200];
            snprintf(load, sizeof load, "boundary: [{traction: [0, 8 MPa], face: y+, time: {%s}}]\n", f[k].time);
            char *script = script_of(plate, glass, load, style == 1);
            const real whole = style == 1 ? 8e6 * 0.5e-3 * 0.37e-3 : 8e6 / 0.5e-3;
            for (int step = 0; step <= 50; step += 1 + step / 7) {
                real mean = 0;
                for (int end = 0; end < 2; end++) {
                    const real t = (end ? step + 0.5 : step > 0 ? step - 0.5 : 0) * STEP, a = (t - 1e-7) / 6e-7;
                    real value = a <= 0 ? 0 : a >= 1 ? 1 : a;
                    if (f[k].kind == 1) value = a > 0 && a < 1 ? square(sin(3.14159265358979323846 * a)) : 0;
                    if (f[k].kind == 2) value = t >= 1.1e-7 && t < 6.9e-7;
                    if (f[k].kind == 4) value = t >= 0 && t < 6.9e-7;
                    if (f[k].kind == 3)
                        value = t < 1e-7   ? 0.2
                                : t < 3e-7 ? 0.2 - 1.2 * (t - 1e-7) / 2e-7
                                : t < 8e-7 ? -1 + 1.5 * (t - 3e-7) / 5e-7
                                           : 0.5;
                    mean += 0.5 * value;
                }
                assert_near(formula_at(script, "force1y", step, 1), whole * mean, 1e-9 * whole);
            }
            assert_non_null(strstr(script, "fix load1 load1 addforce 0.0 v_force1y 0.0\n"));
            memory_free(script);
        }
}

/* Checks that a constant force is exported as a number. The force on driven particles is replaced by a formula with
 * which their velocity is that of the function of time in the middle of each step. */
static void drives(void **state)
{
    (void)state;
    static const char loads[] = "boundary:\n  - {traction: [0, -8 MPa], face: y-}\n"
                                "  - {velocity: [3 m/s, free], time: {ramp: {until: 0.7 us}}, "
                                "region: {box: {from: [-3 mm, 2 mm], to: [3 mm, 3 mm]}}}\n"
                                "  - {fixed: [x], region: {box: {from: [-3 mm, 1 mm], to: [3 mm, 2 mm]}}}\n";
    char *script = script_of(plate, glass, loads, false);
    real force[3];
    const char *line = behind(script, "fix load1 load1 addforce");
    assert_int_equal(sscanf(line, "%lf %lf %lf", &force[0], &force[1], &force[2]), 3);
    assert_near(force[0], 0, 0);
    assert_close(force[1], -8e6 / 0.5e-3, 1e-9);
    assert_non_null(strstr(script, "fix load2 load2 setforce v_drive2x NULL NULL\n"));
    assert_non_null(strstr(script, "fix load3 load3 setforce 0.0 NULL NULL\n"));
    for (int step = 0; step <= 50; step += 3) {
        const real to = real_min(1, (step + 0.5) * STEP / 7e-7), from = real_min(1, (step - 0.5) * STEP / 7e-7);
        const real rate = step > 0 ? (to - from) / STEP : 0; /* the first step begins with its velocity */
        assert_near(formula_at(script, "drive2x", step, 2.3), 2.3 * 3 * rate, 1e-6 * 2.3 * 3 / 7e-7);
    }
    memory_free(script);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(coefficients), cmocka_unit_test(bonds_of_two),
                                       cmocka_unit_test(bonds_of_three), cmocka_unit_test(forces),
                                       cmocka_unit_test(drives)};
    threads_set_count_and_bind_to_cores(1);
    return cmocka_run_group_tests(tests, folder_enter, folder_leave);
}
