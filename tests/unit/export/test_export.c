/* Files of the export to LAMMPS, interpreted as LAMMPS does: pairs within the cutoff whose types are not excluded must
 * be the bonds that the crack does not cross, and coefficients must agree with the literature. Scenes that LAMMPS
 * cannot run are refused in one line, with nothing written. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "base/memory.h"
#include "base/team.h"
#include "export/export.h"
#include "output/output_files.h"
#include "tests/support/folder.h"

enum { EDGE = 24, PARTICLES = EDGE * EDGE };
#define SPACING 5e-4

static const char scene_head[] =
    "space: plane stress\nthickness: 1 mm\nduration: 1 us\nmethod: adaptive\n"
    "material: {young: 192 GPa, density: 8000, critical_stretch: 0.01}\n"
    "body: {box: {from: [-6 mm, -6 mm], to: [6 mm, 6 mm]}}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"
    "time: {step: 2e-8}\n";
static const char scene_equal[] = "pd: {volume: cut-ramp, surface: none, weights: uniform, last_force: whole}\n"
                                  "contact: {law: pair, distance: lammps}\n";
static const char scene_crack[] = "cracks: [{from: [-2.1 mm, -1.3 mm], to: [2.7 mm, 1.6 mm]}]\n"
                                  "boundary: [{traction: [0, 8 MPa], face: y+}, {fixed: [x, y], region: {box: {from: "
                                  "[-6 mm, -6 mm], to: [6 mm, -5 mm]}}}]\n";

static status export_text(const char *a, const char *b, const char *c, bool bond_style, bool allow)
{
    const struct export_request r = {"scene.yaml", "out", NULL, 0, bond_style, allow, false};
    FILE *to = fopen("scene.yaml", "w");
    assert_non_null(to);
    fprintf(to, "%s%s%s", a, b, c);
    fclose(to);
    return export_lammps(&r);
}

static void out_remove(void)
{
    static const char *const file[] = {"plate.data", "in.lammps", "README.txt", "scene.yaml", "check.csv"};
    for (size_t k = 0; k < COUNT_OF(file); k++) unlink(path_join("out", file[k]).text);
    rmdir("out");
}

/* Contents of plate.data, and the pairs of types that in.lammps excludes. */
struct plate {
    int n, types, type[PARTICLES];
    double volume[PARTICLES], density[PARTICLES], x[PARTICLES][2];
    bool *excluded;
};

static char *next_section(char *text, const char *section)
{
    char *at = strstr(text, section);
    assert_non_null(at);
    return strstr(at, "\n\n") + 2;
}

static void plate_read(struct plate *p)
{
    char *data, *script;
    size_t length;
    assert_int_equal(file_read_whole("out/plate.data", &data, &length), OK);
    assert_int_equal(file_read_whole("out/in.lammps", &script, &length), OK);
    assert_int_equal(sscanf(strstr(data, "\n\n"), "%d atoms %d atom types", &p->n, &p->types), 2);
    assert_int_equal(p->n, PARTICLES);
    char *at = next_section(data, "\nAtoms");
    for (int k = 0; k < p->n; k++, at = strchr(at, '\n') + 1) {
        int id, type;
        double volume, density, x, y, z;
        assert_int_equal(sscanf(at, "%d %d %lf %lf %lf %lf %lf", &id, &type, &volume, &density, &x, &y, &z), 7);
        assert_true(id >= 1 && id <= PARTICLES && type >= 1 && type <= p->types && z == 0);
        p->type[id - 1] = type, p->volume[id - 1] = volume, p->density[id - 1] = density;
        p->x[id - 1][0] = x, p->x[id - 1][1] = y;
    }
    p->excluded = NEW("test", (p->types + 1) * (p->types + 1), bool);
    for (at = script; (at = strstr(at, "exclude type ")) != NULL; at++) {
        int a, b;
        assert_int_equal(sscanf(at, "exclude type %d %d", &a, &b), 2);
        p->excluded[a * (p->types + 1) + b] = p->excluded[b * (p->types + 1) + a] = true;
    }
    memory_free(data);
    memory_free(script);
}

static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Checks for all pairs within the cutoff that their types are excluded if and only if their line crosses the crack
 * (test by signed areas), and that volumes and densities are those of the scene. */
static void exclusions_are_the_crack(void **state)
{
    static const double from[] = {-2.1e-3, -1.3e-3}, to[] = {2.7e-3, 1.6e-3};
    static struct plate p;
    int cut = 0;
    (void)state;
    assert_int_equal(export_text(scene_head, scene_equal, scene_crack, false, false), OK);
    plate_read(&p);
    for (int i = 0; i < PARTICLES; i++)
        for (int j = 0; j < i; j++) {
            if (hypot(p.x[i][0] - p.x[j][0], p.x[i][1] - p.x[j][1]) > 3.015 * SPACING) continue;
            const bool crosses = turn(from, to, p.x[i]) * turn(from, to, p.x[j]) < 0 &&
                                 turn(p.x[i], p.x[j], from) * turn(p.x[i], p.x[j], to) < 0;
            assert_int_equal(p.excluded[p.type[i] * (p.types + 1) + p.type[j]], crosses);
            cut += crosses;
        }
    assert_true(cut > 100);
    for (int i = 0; i < PARTICLES; i++)
        assert_true(fabs(p.volume[i] / 2.5e-10 - 1) < 1e-12 && fabs(p.density[i] / 8000 - 1) < 1e-12);
    memory_free(p.excluded);
    out_remove();
}

/* Checks the bond coefficients written for LAMMPS against the micro-modulus 8 k2/sum r V beta of a full neighbourhood,
 * with k2 = E/(2 (1 - nu)) and nu = 1/3 (Silling and Askari 2005). */
static void coefficients(void **state)
{
    double sum = 0, c, cutoff, stretch;
    char *script;
    size_t length;
    (void)state;
    for (int a = -3; a <= 3; a++)
        for (int b = -3; b <= 3; b++) {
            const double r = SPACING * hypot(a, b), horizon = 3.015 * SPACING;
            if (r == 0 || r > horizon) continue;
            sum += r * 2.5e-10 * fmin(1, (horizon + SPACING / 2 - r) / SPACING);
        }
    assert_int_equal(export_text(scene_head, scene_equal, "", false, false), OK);
    assert_int_equal(file_read_whole("out/in.lammps", &script, &length), OK);
    assert_int_equal(sscanf(strstr(script, "pair_coeff"), "pair_coeff %*s %*s %lf %lf %lf", &c, &cutoff, &stretch), 3);
    assert_true(fabs(c * sum / (8 * 192e9 / (2 * (1 - 1.0 / 3))) - 1) < 1e-9);
    assert_true(fabs(cutoff / (3.015 * SPACING) - 1) < 1e-12 && stretch == 0.01);
    memory_free(script);
    out_remove();
}

/* Checks that the export as a bond style lists all pairs of the lattice within three spacings, numbered from 1. */
static void bonds_of_bpm(void **state)
{
    char *data;
    size_t length;
    long long bonds, whole = 0;
    (void)state;
    assert_int_equal(export_text(scene_head, scene_equal, "", true, true), OK);
    assert_int_equal(file_read_whole("out/plate.data", &data, &length), OK);
    assert_int_equal(sscanf(strstr(data, "atom types\n"), "atom types %lld bonds", &bonds), 1);
    for (int a = 0; a < EDGE; a++) /* pairs of a lattice by their offsets */
        for (int b = 1 - EDGE; b < EDGE; b++)
            if ((a > 0 || b > 0) && a * a + b * b <= 9) whole += (EDGE - a) * (EDGE - abs(b));
    assert_int_equal(bonds, whole);
    char *at = next_section(data, "\nBonds");
    for (long long k = 1; k <= bonds; k++, at = strchr(at, '\n') + 1) assert_int_equal(strtoll(at, NULL, 10), k);
    assert_int_equal(*at, '\n');
    memory_free(data);
    out_remove();
}

static void refused(const char *b, const char *c, bool bond_style, const char *message)
{
    assert_int_equal(export_text(scene_head, b, c, bond_style, false), REFUSED);
    if (!strstr(status_message(), message)) fail_msg("%s\nnot: %s", status_message(), message);
    assert_null(strchr(status_message(), '\n'));
    assert_false(path_exists("out"));
}

static void what_lammps_cannot(void **state)
{
    (void)state;
    refused("", "", false,
            "-s pd.volume=cut-ramp -s pd.surface=none -s pd.weights=uniform -s pd.last_force=whole "
            "-s contact.law=pair -s contact.distance=lammps; set these keys in the scene, or add --allow-different");
    refused(scene_equal, "", true, "-s contact.between=none");
    refused(scene_equal, "boundary: [{mirror: {axis: x, at: -6 mm}}]\n", false, "no planes of symmetry");
    refused(scene_equal, "boundary: [{absorbing: true, face: x+}]\n", false, "absorbing faces cannot be exported");
    refused(scene_equal, "boundary: [{traction: [0, 1 MPa * t / us], face: y+}]\n", false,
            "formulas and rotation cannot be");
    refused(scene_equal, "boundary: [{pressure: 1 MPa}]\n", false, "this kind of load cannot be exported");
    refused(scene_equal, "solver: relaxation\n", false, "solver: ");
    refused(scene_equal, "solver: static\n", false, "solver: ");
    refused(scene_equal, "solver: cg\n", false, "solver: ");
    refused(scene_equal, "damping: 10 1/s\n", false, "damping cannot be exported");
    refused(scene_equal, "boundary: [{rotation: {centre: [0, 0], rate: 10 1/s}}]\n", false,
            "rotation cannot be exported");
    refused(scene_equal, "growth: [{at: [0, 0], direction: [1, 0], speed: 100 m/s}]\n", false, "growth: LAMMPS");
    refused("", "model: mospd\n", false, "model: mospd does not exist in LAMMPS");
    assert_int_equal(export_text("space: solid\nduration: 1 us\nmethod: pd\nparticles: {spacing: 1 mm}\n"
                                 "material: {young: 192 GPa, density: 8000, viscosity: {}}\n"
                                 "body: {box: {from: [0, 0, 0], to: [6 mm, 6 mm, 6 mm]}}\n",
                                 scene_equal, "", false, false),
                     REFUSED);
    assert_non_null(strstr(status_message(), "viscosity cannot be exported"));
    refused("pd: {volume: cut-ramp, surface: none, weights: uniform, last_force: whole, influence: inverse, "
            "normalisation: local}\n"
            "contact: {between: none}\n",
            "model: ospd\n", false, "the weighted volume of a particle; set model: bond");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(exclusions_are_the_crack), cmocka_unit_test(coefficients),
                                       cmocka_unit_test(bonds_of_bpm), cmocka_unit_test(what_lammps_cannot)};
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, folder_enter, folder_leave);
}
