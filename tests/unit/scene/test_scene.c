/* Tests reading of scenes: every key, exact units, overrides, previous names of keys, and critical stretches. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <stdio.h>
#include <math.h>
#include <cmocka.h>

#include "base/memory.h"
#include "scene/scene_softening.h"
#include "tests/support/scene_texts.h"

/* ---- every key --------------------------------------------------------------------------------------------------- */

/* Checks the values of all scalar keys of the scene `plate`. */
static void test_plate_scalars(void **state)
{
    (void)state;
    struct scene s = read_ok(plate, NULL, 0);
    assert_string_equal(s.name, "plate-1");
    assert_string_equal(s.path, "dir/given.yaml");
    assert_int_equal(s.space, SPACE_PLANE_STRESS);
    assert_int_equal(s.dim, 2);
    assert_true(s.thickness == 0.01 && s.duration == 50e-6 && s.section == 1);
    assert_int_equal(s.method, METHOD_MPM);
    assert_int_equal(s.model, MODEL_BOND);
    assert_int_equal(s.coupling, COUPLING_HANDSHAKE);
    assert_true(s.spacing == 1e-3 && s.horizon == 4.015 && s.irregularity == 0.25 && s.seed == UINT64_MAX);
    assert_true(s.volume == VOLUME_CUT_RAMP && s.calibration == CALIBRATION_VMPD && s.surface == SURFACE_VOLUME);
    assert_true(s.shells == SHELLS_ISOTROPIC && s.has_pd_region && s.pd_region.n == 2);
    assert_true(s.pd_region.solid[1].subtract && s.pd_region.solid[1].from[0] == -INFINITY);
    assert_true(s.cell == 1.5 && s.shape == SHAPE_CUBIC && s.transfer == TRANSFER_APIC);
    assert_true(s.has_grid_origin && s.grid_origin[0] == 0.5e-3 && s.grid_origin[1] == 0);
    assert_true(s.conversion.stress == 3.8e9 && s.conversion.alpha == 0.9 && !s.conversion.block);
    assert_int_equal(s.conversion.criteria, CONVERT_ON_STRESS);
    assert_true(s.speed_window == 2e-6 && s.time_step == 20e-9 && s.safety == 1.5);
    assert_true(s.frames == 0 && s.samples == 10 && s.checkpoint_interval == 5 && s.compress);
    scene_free(&s);
}

static void test_plate_materials_bodies(void **state)
{
    (void)state;
    struct scene s = read_ok(plate, NULL, 0);
    const struct material *m = s.material;
    assert_int_equal(s.materials, 4);
    assert_string_equal(m[0].name, "steel");
    assert_true(m[0].young == 190e9 && m[0].poisson == 0.3 && m[0].density == 7800);
    assert_true(m[0].energy_release_rate == 69e3);
    assert_true(m[0].critical_stretch == material_critical_stretch(&m[0], s.space, 4.015 * 1e-3, STRETCH_BOND));
    assert_true(m[0].wave_speed > 0);
    assert_true(m[1].density == 2440 && m[1].critical_stretch == 1e-3 && isnan(m[1].energy_release_rate));
    assert_true(m[2].energy_release_rate == 60e6 * 60e6 / 200e9); /* plane stress: K^2/E */
    assert_true(m[2].poisson == 1.0 / 3);
    assert_true(isinf(m[3].critical_stretch));
    assert_int_equal(s.bodies, 3);
    assert_true(s.body[0].material == 1 && s.body[0].velocity[0] == 3000 && s.body[0].velocity[1] == -1000);
    assert_true(s.body[0].shape.n == 1 && s.body[0].shape.solid->kind == SOLID_BOX && s.body[0].file == NULL);
    assert_true(s.body[0].parts == 2 && s.body[0].part[0].material == 0 && s.body[0].part[1].material == 3);
    assert_true(s.body[0].part[0].region.solid->radius == 1e-2 && s.body[1].parts == 0);
    const struct solid *solid = s.body[1].shape.solid;
    assert_int_equal(s.body[1].shape.n, 4);
    assert_true(solid[1].subtract && solid[1].kind == SOLID_BALL && solid[1].radius == 5e-3 && !solid[2].subtract);
    assert_true(solid[3].subtract && solid[3].kind == SOLID_HALF_SPACE && solid[3].normal[1] == 2);
    assert_string_equal(s.body[2].name, "body2");
    assert_string_equal(s.body[2].file, "grains.csv");
    assert_int_equal(s.body[2].shape.n, 0);
    scene_free(&s);
}

static void test_plate_conditions(void **state)
{
    (void)state;
    struct scene s = read_ok(plate, NULL, 0);
    assert_true(s.cracks == 2 && s.crack[0].n == 2 && s.crack[1].corner[1][1] == -25e-3);
    assert_int_equal(s.initials, 2);
    const struct scene_initial *i = s.initial;
    assert_true(i[0].body == 0 && i[0].sets_velocity && !i[0].sets_strain && i[0].velocity[1] == 2);
    assert_true(i[0].velocity_gradient[1] == 100 && i[0].velocity_gradient[2] == -100 && i[0].centre[0] == 1e-9);
    assert_true(i[1].body == -1 && !i[1].sets_velocity && i[1].sets_strain && i[1].displacement_gradient[3] == 0.02);
    assert_int_equal(s.boundaries, 8);
    const struct boundary *b = s.boundary;
    assert_string_equal(b[0].name, "impact");
    assert_true(b[0].kind == BOUNDARY_VELOCITY && b[0].components == 1 && b[0].value[0] == 22 && b[0].region.n == 1);
    assert_true(b[0].time.kind == TIME_STEP && b[0].time.from == 0 && b[0].time.until == 5e-6);
    assert_string_equal(b[1].name, "boundary1");
    assert_true(b[1].body == 0 && b[1].components == 2 && b[1].value[1] == 0 && b[1].time.kind == TIME_PULSE);
    assert_true(b[2].components == 3 && b[2].time.kind == TIME_RAMP && b[2].time.until == 1e-3);
    assert_true(b[3].kind == BOUNDARY_TRACTION && b[3].face == 1 && b[3].side == -1 && b[3].value[0] == 1e6);
    assert_true(b[3].time.n == 3 && b[3].time.t[2] == 2e-6 && b[3].time.value[2] == 0.5);
    assert_true(b[4].kind == BOUNDARY_BODY_FORCE && b[4].value[1] == 1e5 && b[4].time.kind == TIME_CONSTANT);
    const struct profile *sine = &b[5].profile, *plain = &b[6].profile;
    assert_int_equal(b[4].profile.kind, PROFILE_UNIFORM);
    assert_true(sine->kind == PROFILE_SINE && sine->wavelength == 0.2 && sine->origin[0] == 1e-3);
    assert_true(sine->direction[0] == 1 && sine->direction[1] == 3);
    assert_true(plain->kind == PROFILE_SINE && plain->wavelength == 1.0 / 3 && plain->origin[0] == 0);
    assert_true(plain->direction[0] == 1 && plain->direction[1] == 0);
    assert_true(b[7].kind == BOUNDARY_MIRROR && b[7].axis == 1 && b[7].at == 1e-3 && b[7].hold_tangential);
    scene_free(&s);
}

static void test_plate_probes(void **state)
{
    (void)state;
    static const enum probe_kind kinds[] = {PROBE_TIP,    PROBE_TIP,      PROBE_BREAK, PROBE_REACTION,
                                            PROBE_PATCH,  PROBE_SPALL,    PROBE_POINT, PROBE_LINE,
                                            PROBE_ENERGY, PROBE_MOMENTUM, PROBE_SIF,   PROBE_RIGID};
    struct scene s = read_ok(plate, NULL, 0);
    const struct probe_request *p = s.probe;
    assert_int_equal(s.probes, COUNT_OF(kinds));
    for (int k = 0; k < s.probes; k++) assert_int_equal(p[k].kind, kinds[k]);
    assert_string_equal(p[0].name, "tip");
    assert_string_equal(p[1].name, "second");
    assert_true(!p[0].has_at && p[1].has_at && p[1].at[1] == 2 && p[2].region.n == 1);
    assert_string_equal(p[3].boundary, "impact");
    assert_true(p[6].has_at && p[7].to[1] == 1 && p[7].points == 11 && p[8].region.n == 1 && p[9].region.n == 0);
    assert_true(p[10].outer == 50e-3 && isnan(p[10].inner) && p[10].contours.n == 2 && p[10].stress == SIF_PARTICLE);
    scene_free(&s);
}

static void test_bar_and_defaults(void **state)
{
    (void)state;
    struct scene s = read_ok(bar, NULL, 0);
    assert_string_equal(s.name, "given");
    assert_true(s.dim == 1 && s.section == 1 && s.thickness == 1 && s.method == METHOD_ADAPTIVE);
    assert_true(s.horizon == 3.015 && s.irregularity == 0 && s.seed == 1 && s.surface == SURFACE_NONE);
    assert_true(s.cell == 2 && s.shape == SHAPE_GIMP && s.transfer == TRANSFER_FLIP && !s.has_grid_origin);
    assert_true(s.coupling == COUPLING_PARTIAL_STRESS && isnan(s.conversion.stress) && s.conversion.alpha == 0.95);
    assert_true(s.conversion.block && s.conversion.criteria == (CONVERT_ON_BREAK | CONVERT_ON_STRESS));
    assert_true(s.time_step == 0 && s.safety == 0.5 && s.frames == 20 && s.samples == 200 && !s.compress);
    assert_true(isnan(s.checkpoint_interval) && s.speed_window == 1e-3 / 10 && s.probes == 0);
    assert_true(s.body[0].velocity[0] == 30 && s.body[0].shape.solid->from[0] == -30e-3 && s.body[1].shape.n == 2);
    assert_true(s.cracks == 2 && s.crack[0].n == 1 && s.crack[0].corner[0][0] == 20e-3);
    assert_true(s.boundary[0].components == 1 && s.boundary[2].side == 1 && s.initial[0].velocity_gradient[0] == 3);
    scene_free(&s);
}

static void test_closed_forms_and_frame_times(void **state)
{
    (void)state;
    struct scene s = read_ok(rod, NULL, 0);
    static const enum exact_form forms[] = {EXACT_STEP_BAR, EXACT_PLASTIC_BAR, EXACT_PULSE, EXACT_MANUFACTURED};
    assert_int_equal(s.probes, 4);
    for (int k = 0; k < 4; k++) assert_true(s.probe[k].kind == PROBE_EXACT && s.probe[k].form == forms[k]);
    assert_string_equal(s.probe[0].name, "exact");
    assert_string_equal(s.probe[1].name, "yields");
    assert_true(isnan(s.probe[0].amplitude) && s.probe[3].amplitude == 1e-3 && s.probe[3].period == 2e-3);
    assert_true(s.probe[3].wavelength == 0.5 && s.probe[3].origin == -1e-3);
    assert_true(s.frames == 3 && s.times.n == 3 && s.times.value[0] == 1e-3 && s.times.value[2] == 0.01);
    assert_true(strstr(s.text, "times: [0.001, 0.005, 0.01]") && !strstr(s.text, "frames:"));
    scene_free(&s);
    static const struct scene_override o[] = {{"output.times", ""}, {"probes[0].exact", "plastic bar"}};
    s = read_ok(rod, o, 2);
    assert_true(s.frames == 20 && s.times.n == 0 && s.probe[0].form == EXACT_PLASTIC_BAR &&
                strstr(s.text, "frames: 20"));
    scene_free(&s);
}

static void test_growth(void **state)
{
    (void)state;
    struct scene s = read_ok(grown, NULL, 0);
    assert_int_equal(s.growths, 2);
    assert_true(s.growth[0].direction[1] == 0.8 && s.growth[0].damping == 0 && !s.growth[0].probe[0]);
    assert_true(isnan(s.growth[0].smoothing) && isnan(s.growth[1].damping) && s.growth[1].smoothing == 2e-3);
    assert_string_equal(s.growth[1].name, "growth1");
    assert_true(s.probe[1].kind == PROBE_GROWTH && !s.probe[1].of[0] && isnan(s.probe[1].experiment));
    assert_string_equal(s.probe[2].of, "growth1");
    assert_true(s.probe[2].experiment == 70);
    scene_free(&s);
}

static void test_block(void **state)
{
    (void)state;
    struct scene s = read_ok(block, NULL, 0);
    assert_true(s.dim == 3 && s.thickness == 1 && s.surface == SURFACE_MOMENTS && s.material->poisson == 0.25);
    assert_string_equal(s.body->name, "body");
    assert_true(s.body->shape.solid[0].kind == SOLID_CYLINDER && s.body->shape.solid[0].to[2] == 1e-2);
    assert_true(s.crack->n == 4 && s.crack->corner[2][1] == 5e-3 && s.initial->velocity_gradient[7] == 7);
    assert_true(s.boundary->components == 4 && s.boundary->value[2] == 2 && s.boundary->region.solid->normal[2] == 1);
    scene_free(&s);
}

/* Checks that a rotation of 21/s about the axis (3, -6, 2) of length 7 has w = (9, -18, 6)/s, and the velocity gradient
 * w x. */
static void test_turn(void **state)
{
    (void)state;
    static const char value[] = "[{rotation: {centre: [1 mm, 2 mm, 0], axis: [3, -6, 2], rate: 21 1/s}}]";
    const struct scene_override turn = {"initial", value};
    static const real rows[] = {0, -6, -18, 6, 0, -9, 18, 9, 0};
    struct scene s = read_ok(block, &turn, 1);
    for (int k = 0; k < 9; k++) assert_true(fabs(s.initial->velocity_gradient[k] - rows[k]) < 1e-12);
    assert_true(s.initial->sets_velocity && s.initial->centre[1] == 2e-3);
    scene_free(&s);
}

/* ---- units ------------------------------------------------------------------------------------------------------- */

/* Checks numbers with units of every spelling, exact to the last bit. */
static void test_units(void **state)
{
    (void)state;
    /* Exact to the last bit: a unit only changes the decimal exponent. */
    static const struct {
        const char *key, *value;
        real expected;
    } cases[] = {
        {"material.young", "190 GPa", 190e9},
        {"material.young", "0.3 MPa", 0.3e6},
        {"material.young", "200 N/mm^2", 200e6},
        {"material.young", "5kPa", 5e3},
        {"material.young", "1e9", 1e9},
        {"material.young", "2E+3", 2000},
        {"material.young", "1 MN/m\u00b2", 1e6},
        {"material.young", "1 kg / m / s^2", 1},
        {"particles.spacing", "0.3 mm", 0.3e-3},
        {"particles.spacing", "1/3 mm", 1e-3 / 3},
        {"particles.spacing", "0.7 um", 0.7e-6},
        {"particles.spacing", "0.7 \u00b5m", 0.7e-6},
        {"particles.spacing", "0.1 km", 100},
        {"particles.spacing", "900 nm", 900e-9},
        {"particles.spacing", "+.5cm", 0.5e-2},
        {"particles.spacing", "\"1 mm\"", 1e-3},
        {"duration", "20 us", 20e-6},
        {"duration", "0.1 ms", 0.1e-3},
        {"duration", "7 ns", 7e-9},
        {"duration", "4 ps", 4e-12},
        {"duration", "3 s", 3},
        {"material.density", "7.8 g/cm^3", 7800},
        {"material.density", "7800 kg/m3", 7800},
        {"material.density", "7.8e3 kg m^-3", 7800},
        {"material.energy_release_rate", "69 kJ/m^2", 69e3},
        {"material.energy_release_rate", "3 N/mm", 3e3},
        {"thickness", "1/8", 0.125},
        {"material.young", "0.2 TPa", 0.2e12},
        {"material.young", "3 MJ/m^3", 3e6},
        {"duration", "2 min", 120},
        {"duration", "0.3 h", 1080},
        {"material.density", "7 Mg/m^3", 7000},
        {"material.young", "7 N/cm^2", 7e4},
        {"conversion.alpha", "95 %", 0.95},
        {"conversion.alpha", "19 / 20", 0.95},
        {"particles.spacing", "0.7 \u03bcm", 0.7e-6},
        {"material.density", "7.3 g/cm\u00b3", 7300},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        struct scene_override o[] = {{"particles.horizon", "2"}, {cases[k].key, cases[k].value}};
        static const char text[] = "space: plane stress\nthickness: 1\nduration: 1\nmethod: mpm\n"
                                   "material: {young: 1, density: 1, poisson: 0, energy_release_rate: 1}\n"
                                   "body: {box: {from: [0, 0], to: [1 mm, 1 mm]}}\nparticles: {spacing: 1 mm}\n";
        struct scene s = read_ok(text, o, 2);
        const struct {
            const char *key;
            real value;
        } got[] = {
            {"material.young", s.material->young},
            {"particles.spacing", s.spacing},
            {"duration", s.duration},
            {"material.density", s.material->density},
            {"thickness", s.thickness},
            {"conversion.alpha", s.conversion.alpha},
            {"material.energy_release_rate", s.material->energy_release_rate},
        };
        for (size_t j = 0; j < COUNT_OF(got); j++)
            if (strcmp(got[j].key, cases[k].key) == 0 && got[j].value != cases[k].expected)
                fail_msg("%s is %.17g, not %.17g", cases[k].value, got[j].value, cases[k].expected);
        scene_free(&s);
    }
}

/* ---- overrides --------------------------------------------------------------------------------------------------- */

/* Checks overrides that change, clear and remove keys of the scene `plate`. */
static void test_overrides(void **state)
{
    (void)state;
    static const struct scene_override o[] = {
        {"name", "no"},
        {"materials[1].young", "5 GPa"},
        {"bodies[0].velocity", "[1, 0]"},
        {"boundary[0].velocity", "[0, 20 m/s]"},
        {"boundary[3].time.table[1][1]", "0.25"},
        {"probes[6].point.at", "[2, 3]"},
        {"conversion.criteria", "none"},
        {"cracks", "[]"},
        {"pd.region", ""},
        {"materials[2].toughness", ""},
        {"materials[2].critical_stretch", "0.5"},
        {"boundary[1].fixed", "[x]"},
    };
    struct scene s = read_ok(plate, o, COUNT_OF(o));
    assert_string_equal(s.name, "no");
    assert_true(s.material[1].young == 5e9 && s.body[0].velocity[0] == 1);
    assert_true(s.boundary[0].components == 3 && s.boundary[0].value[1] == 20);
    assert_true(s.boundary[3].time.value[1] == 0.25 && s.boundary[1].components == 1);
    assert_true(s.probe[6].at[1] == 3 && s.conversion.criteria == 0 && s.cracks == 0 && !s.has_pd_region);
    assert_true(s.material[2].critical_stretch == 0.5 && isnan(s.material[2].energy_release_rate));
    scene_free(&s);
    static const struct scene_override named[] = {
        /* Elements of lists by index and by name are the same key. */
        {"materials.glass.young", "5 GPa"},
        {"bodies.bar.velocity", "[1, 0]"},
        {"bodies.2.material", "hard"},
        {"boundary.impact.velocity.1", "20 m/s"},
        {"boundary.boundary3.time.table.1.1", "0.25"},
        {"boundary.4", "{fixed: [x]}"},
        {"boundary.7", ""},
        {"cracks.1.to", "[51 mm, -25 mm]"},
        {"probes.p.at", "[2, 3]"},
        {"probes.7.from", "[3 mm, 0]"},
        {"probes.0.at", "[1, 4]"},
        {"probes.line.points", "13"},
    };
    s = read_ok(plate, named, COUNT_OF(named));
    assert_true(s.material[1].young == 5e9 && s.body[0].velocity[0] == 1);
    assert_string_equal(s.material[s.body[2].material].name, "hard");
    assert_true(s.unused_materials == 1); /* the one that body 2 had */
    assert_true(s.boundary[0].components == 3 && s.boundary[0].value[1] == 20 && s.boundary[3].time.value[1] == 0.25);
    assert_true(s.boundaries == 7 && s.boundary[4].kind == BOUNDARY_VELOCITY && s.boundary[4].components == 1);
    assert_true(s.crack[0].corner[1][0] == 0.05 && s.crack[1].corner[1][0] == 0.051);
    assert_true(s.probe[6].at[1] == 3 && s.probe[7].from[0] == 0.003 && s.probe[7].points == 13 &&
                s.probe[0].at[1] == 4);
    scene_free(&s);
    static const struct scene_override sections[] = {{"pd.volume", "ramp"}, {"method", "pd"}, {"method", "mpm"}};
    s = read_ok(bar, sections, 3); /* a section missing in the file; the later of two applies */
    assert_true(s.volume == VOLUME_RAMP && s.method == METHOD_MPM);
    scene_free(&s);
}

/* Checks keys under their previous names: in the file, in the path of an override and in its value. The scene as
 * written out has the current names. */
static void test_renamed(void **state)
{
    (void)state;
    static const char text[] = "space: line\nduration: 1\nmaterial: {young: 1, density: 1}\n"
                               "body: {box: {from: [0], to: [1]}}\nparticles: {spacing: 0.1}\nrim_damping: 0.5\n"
                               "time: {rest: false}\n";
    static const struct scene_override o[] = {{"conversion", "{return: true, dwell: 3}"},
                                              {"conversion.return_stress", "0.25"},
                                              {"interface_damping", "0.75"}};
    struct scene s = read_ok(text, o, COUNT_OF(o));
    assert_true(s.interface_damping == 0.75 && !s.active_set && s.conversion.reverts);
    assert_true(s.conversion.hold_time == 3 && s.conversion.low_stress == 0.25);
    assert_non_null(strstr(s.renamed, "rim_damping has been renamed to interface_damping"));
    assert_non_null(strstr(s.renamed, "conversion.dwell has been renamed to conversion.hold_time"));
    assert_null(strstr(s.text, "rim_damping"));
    struct scene again = read_ok(s.text, NULL, 0);
    assert_string_equal(again.renamed, "");
    assert_string_equal(again.text, s.text);
    scene_free(&again);
    scene_free(&s);
}

/* Checks that bonds across an interface break as bonds of a material with the harmonic mean of both moduli: the
 * critical stretch is proportional to sqrt(G/E). */
static void interfaces_have_their_strength(void **state)
{
    (void)state;
    static const char text[] =
        "space: plane stress\nthickness: 0.37 mm\nduration: 1 us\nmethod: pd\nmaterials:\n"
        "  - {name: stiff, young: 192 GPa, density: 7900, energy_release_rate: 210}\n"
        "  - {name: soft, young: 3.1 GPa, density: 1180, energy_release_rate: 90}\n"
        "bodies:\n  - {name: low, material: stiff, shape: {box: {from: [0, 0], to: [4 mm, 2 mm]}}}\n"
        "  - {name: high, material: soft, shape: {box: {from: [0, 2 mm], to: [4 mm, 4 mm]}}}\n"
        "particles: {spacing: 0.2 mm}\ninterfaces: [{bodies: [low, high], energy_release_rate: 37}]\n";
    struct scene s;
    if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    const real between = 2 * 192 * 3.1 / (192 + 3.1), ratio = sqrt(37 / between / (210.0 / 192));
    assert_int_equal(s.interfaces, 1);
    assert_true(fabs(s.interface[0].critical_stretch / s.material[0].critical_stretch / ratio - 1) < 1e-12);
    scene_free(&s);
}

/* Reads into s a scene of a stiff and a soft material whose bodies meet, with the further lines `more`. */
static void read_joint(struct scene *s, const char *more)
{
    char text[1200];
    snprintf(text, sizeof text,
             "duration: 1 us\nmethod: pd\nmaterials:\n"
             "  - {name: stiff, young: 192 GPa, density: 7900, energy_release_rate: 210}\n"
             "  - {name: soft, young: 3.1 GPa, density: 1180, energy_release_rate: 90}\n"
             "bodies:\n  - {name: low, material: stiff, shape: {box: {from: [0, 0], to: [4 mm, 2 mm]}}}\n"
             "  - {name: high, material: soft, shape: {box: {from: [0, 2 mm], to: [4 mm, 4 mm]}}}\n"
             "space: plane stress\nthickness: 0.37 mm\n%s",
             more);
    if (scene_read_text(s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
}

/* Checks joined bodies: the fracture energy is that of the interface if given, else the smaller one of both materials.
 * The critical stretch is proportional to sqrt(G/E); E is the harmonic mean for model bond, the arithmetic mean for
 * ospd. */
static void joints_have_their_energy(void **state)
{
    (void)state;
    const real series = 2 * 192 * 3.1 / (192 + 3.1), mean = (192 + 3.1) / 2;
    struct scene s;
    for (int ospd = 0; ospd < 2; ospd++)
        for (int given = 0; given < 2; given++) {
            char more[200];
            snprintf(more, sizeof more,
                     "particles: {spacing: 0.2 mm}\nmodel: %s\ninterfaces: [{bodies: [low, high]%s}]\n",
                     ospd ? "ospd" : "bond", given ? ", energy_release_rate: 37" : "");
            read_joint(&s, more);
            const real ratio = sqrt((given ? 37 : 90) / (ospd ? mean : series) / (210.0 / 192));
            const real stretch =
                given ? s.interface[0].critical_stretch
                      : scene_critical_stretch_between_materials(&s, &s.material[given], &s.material[!given]);
            assert_true(fabs(stretch / s.material[0].critical_stretch / ratio - 1) < 1e-12);
            scene_free(&s);
        }
}

/* Checks critical stretches with an influence function omega. In a continuum they are those of omega = 1 times
 * sqrt(mu/nu), where mu and nu are means of omega weighted by r^2 and r^3 in 2D: 3 and 2 for (horizon/r)^2, 3/2 and 4/3
 * for horizon/r. A lattice with a horizon of 10 spacings agrees within 3.5 %: it lacks the particle itself, where omega
 * is largest. */
static void stretches_depend_on_influence(void **state)
{
    (void)state;
    static const char *const name[] = {"inverse square", "inverse"};
    static const real ratio[] = {1.5, 9.0 / 8};
    for (int k = 0; k < 2; k++) {
        struct scene s, plain;
        char more[120];
        snprintf(more, sizeof more, "particles: {spacing: 0.2 mm, horizon: 10.015}\npd: {influence: %s}\n", name[k]);
        read_joint(&s, more);
        read_joint(&plain, "particles: {spacing: 0.2 mm, horizon: 10.015}\n");
        const real found = s.material[0].critical_stretch / plain.material[0].critical_stretch / sqrt(ratio[k]);
        if (!(fabs(found - 1) < 0.035)) fail_msg("%s: off by %g", name[k], found - 1);
        scene_free(&s), scene_free(&plain);
    }
}

/* Checks the critical stretch s of a line with a horizon of 3 spacings h, where k bonds of length k h cross each plane:
 * G = E s^2 h/2 (1 + 4 + 9)/(1 + 2 + 3). Also checks that (horizon/r)^2 with continuum calibration is refused, because
 * its integral diverges. */
static void stretch_on_a_line(void **state)
{
    (void)state;
    static const char text[] = "space: line\nsection: 3 mm^2\nduration: 1 us\nmethod: pd\n"
                               "material: {young: 70 GPa, density: 2500, energy_release_rate: 8}\n"
                               "body: {box: {from: 0, to: 20 mm}}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n";
    struct scene s;
    if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_true(fabs(s.material[0].critical_stretch / sqrt(8 * 12 / 14.0 / (70e9 * 0.5e-3)) - 1) < 1e-12);
    scene_free(&s);
    char endless[sizeof text + 60];
    snprintf(endless, sizeof endless, "%spd: {influence: inverse square, calibration: continuum}\n", text);
    assert_int_equal(scene_read_text(&s, endless, strlen(endless), "test.yaml", NULL, 0), REFUSED);
    assert_true(strstr(status_message(), "has no continuum integral") != NULL);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interfaces_have_their_strength),
        cmocka_unit_test(joints_have_their_energy),
        cmocka_unit_test(stretches_depend_on_influence),
        cmocka_unit_test(stretch_on_a_line),
        cmocka_unit_test(test_plate_scalars),
        cmocka_unit_test(test_plate_materials_bodies),
        cmocka_unit_test(test_plate_conditions),
        cmocka_unit_test(test_plate_probes),
        cmocka_unit_test(test_bar_and_defaults),
        cmocka_unit_test(test_block),
        cmocka_unit_test(test_turn),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_closed_forms_and_frame_times),
        cmocka_unit_test(test_units),
        cmocka_unit_test(test_overrides),
        cmocka_unit_test(test_renamed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
