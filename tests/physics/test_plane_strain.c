/* Checks the out-of-plane stress sigma_zz in plane strain in frames, probes and profiles, for every method: uniform
 * strain and plastic flow are compared with closed forms. */
#include <stdlib.h>
#include <unistd.h>

#include "engine/engine.h"
#include "tests/support/near.h"
#include "output/output.h"
#include "step/report.h"
#include "scene/scene_read.h"

#define FOLDER "run"
enum { ROW_KEYS = 6 };

/* Two distant blocks of two materials with equal initial strain. In the run of 0.3 us a wave travels 1.8 mm from their
 * edges, or 2.2 mm if nu = 0.4. */
#define BLOCKS(space)                                                                                                  \
    "space: " space "\nthickness: 1 mm\nduration: 0.3 us\nmethod: mpm\n"                                               \
    "materials:\n  - {name: soft, young: 70 GPa, poisson: 1/4, density: 2700}\n"                                       \
    "  - {name: hard, young: 200 GPa, poisson: 1/4, density: 7800}\n"                                                  \
    "bodies:\n  - {name: left, material: soft, shape: {box: {from: [-62 mm, -12 mm], to: [-38 mm, 12 mm]}}}\n"         \
    "  - {name: right, material: hard, shape: {box: {from: [38 mm, -12 mm], to: [62 mm, 12 mm]}}}\n"                   \
    "particles: {spacing: 1 mm, horizon: 3.015}\n"                                                                     \
    "initial: [{displacement_gradient: [4e-5, 2e-5, 1e-5, -1e-5]}]\n"                                                  \
    "output: {frames: 1, samples: 1}\n"                                                                                \
    "probes: [{point: {name: gauge, at: [50.5 mm, 0.5 mm]}}, "                                                         \
    "{line: {name: across, from: [-50 mm, 0.5 mm], to: [-49 mm, 0.5 mm], points: 2}}]\n"
#define TRACE 3e-5 /* eps_xx + eps_yy of the initial strain */
/* Half width of the middle of a block that is undisturbed [m]: below 12 mm minus two horizons, in which surface
 * corrections act, minus the distance travelled by the wave. */
#define INSIDE 3.6e-3

/* Tolerance of frames, whose numbers are in single precision, relative to |sigma_xx| + |sigma_yy|. */
#define SINGLE 1e-6
/* Tolerance of quantities that are linear in the strain: at a strain of about 1e-5 bond stretches, and stresses of the
 * reference frame that rotate with their cell, differ from linear ones. */
#define SMALL 1e-4

struct row {
    const char *name;
    struct scene_override key[ROW_KEYS];
};
#define STATES(model)                                                                                                  \
    {"model", model}, {"materials[0].poisson", "0.1"}, { "materials[1].poisson", "0.4" }
#define HALF                                                                                                           \
    {"method", "adaptive"}, { "pd.region", "{box: {from: [-inf, -inf], to: [inf, 0]}}" }
static const struct row uniform[] = {
    {"mpm flip", {{"materials[0].poisson", "0.1"}, {"materials[1].poisson", "0.4"}}},
    {"mpm apic linear", {{"mpm.transfer", "apic"}, {"materials[0].poisson", "0"}}},
    {"mpm reference", {{"mpm.frame", "reference"}, {"materials[0].poisson", "0.1"}, {"materials[1].poisson", "0.4"}}},
    {"mpm reference small", {{"mpm.frame", "reference"}, {"mpm.strain", "small"}, {"materials[1].poisson", "0.4"}}},
    {"pd bond", {{"method", "pd"}}},
    {"pd ospd", {{"method", "pd"}, STATES("ospd")}},
    {"pd mospd", {{"method", "pd"}, STATES("mospd")}},
    {"adaptive bond", {HALF}},
    {"adaptive bond reference", {HALF, {"mpm.frame", "reference"}}},
    {"adaptive ospd", {HALF, STATES("ospd")}},
    {"adaptive mospd reference", {HALF, STATES("mospd"), {"mpm.frame", "reference"}}},
};

struct ran {
    struct scene s;
    struct run e;
    struct output o;
};

static void run(struct ran *r, const char *text, const struct scene_override *key)
{
    int keys = 0;
    *r = (struct ran){0};
    assert_int_equal(system("rm -rf " FOLDER), 0); /* left by a failed test */
    while (keys < ROW_KEYS && key && key[keys].key) keys++;
    if (scene_read_text(&r->s, text, strlen(text), "test.yaml", key, keys) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(&r->e, &r->s, &r->o));
    assert_ok(output_open(&r->o, FOLDER, r->s.text, OUTPUT_OVERWRITE, false));
    r->e.report->quiet = true;
    assert_ok(run_advance_to_end_time(&r->e));
}

static void done(struct ran *r)
{
    run_free_memory(&r->e);
    output_close(&r->o);
    scene_free(&r->s);
    assert_int_equal(system("rm -rf " FOLDER), 0);
}

/* Returns the value of the column `name` in the last row of the CSV file `file`; NAN if there is no such column. */
static double last_value(const char *file, const char *name)
{
    char head[4096], line[4096], last[4096] = "";
    int column = 0;
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    assert_non_null(fgets(head, sizeof head, in));
    while (fgets(line, sizeof line, in)) strcpy(last, line);
    fclose(in);
    char *value = last, *rest = head, *title;
    for (; (title = strsep(&rest, ",\n")) != NULL && strncmp(title, name, strlen(name)) != 0; column++)
        ;
    for (; title && column > 0; column--) value = strchr(value, ',') + 1;
    return title ? strtod(value, NULL) : NAN;
}

/* Returns the exact sigma_zz = lambda (eps_xx + eps_yy) of the material m, with lambda = E nu/((1 + nu)(1 - 2 nu)). */
static real across_of(const struct material *m)
{
    return m->young * m->poisson / ((1 + m->poisson) * (1 - 2 * m->poisson)) * TRACE;
}

static bool inside(const struct output_frame *f, int64_t i)
{
    const double centre = f->body[i] == 0 ? -0.05 : 0.05;
    return fabs(f->X[0][i] - centre) < INSIDE && fabs(f->X[1][i]) < INSIDE;
}

/* Checks sigma_zz of the frame file `name` of the run r. Everywhere it must be nu (sigma_xx + sigma_yy) of the frame;
 * with `exact` also that of the initial strain in the middle of the blocks. kinds[k]: increased by the number of
 * particles of kind k there. */
static void frame_holds(const struct ran *r, const char *name, bool exact, int64_t *kinds)
{
    struct output_frame f;
    assert_ok(frame_read(&f, name));
    for (int64_t i = 0; i < f.n; i++) {
        const struct material *m = &r->s.material[f.material[i]];
        const real size = fabs(f.stress[0][i]) + fabs(f.stress[1][i]);
        assert_near(f.stress[3][i], m->poisson * (f.stress[0][i] + f.stress[1][i]), SINGLE * size);
        if (!inside(&f, i)) continue;
        kinds[f.kind[i]]++;
        if (exact) assert_near(f.stress[3][i], across_of(m), SMALL * m->young * TRACE);
    }
    frame_free(&f);
}

/* Checks uniform strain with one method. The first frame must have the exact sigma_zz. In the last frame only material
 * points must: ghost forces of couplings move particles near an interface, and bonds transmit disturbances of the edges
 * faster than a wave. state: method and keys. */
static void uniform_strain(void **state)
{
    const struct row *row = *state;
    struct ran r;
    int64_t kinds[KINDS] = {0};
    run(&r, BLOCKS("plane strain"), row->key);
    const bool points = r.s.method == METHOD_MPM;
    frame_holds(&r, FOLDER "/frames/000000.hdf", true, kinds);
    frame_holds(&r, FOLDER "/frames/000001.hdf", points, kinds);
    assert_int_equal(kinds[KIND_MPM] > 0, r.s.method != METHOD_PD);
    assert_int_equal(kinds[KIND_PD] > 0, r.s.method != METHOD_MPM);
    const double gauge = last_value(FOLDER "/history.csv", "gauge.stress_zz");
    const double wanted = r.s.material[1].poisson * (last_value(FOLDER "/history.csv", "gauge.stress_xx") +
                                                     last_value(FOLDER "/history.csv", "gauge.stress_yy"));
    assert_close(gauge, wanted, 1e-7); /* written with nine digits */
    if (points) assert_near(gauge, across_of(&r.s.material[1]), SMALL * r.s.material[1].young * TRACE);
    if (points)
        assert_near(last_value(FOLDER "/across_000001.csv", "stress_zz"), across_of(&r.s.material[0]),
                    SMALL * r.s.material[0].young * TRACE);
    done(&r);
}

/* Checks that in plane stress sigma_zz is 0 in frames and that histories and profiles have no column for it. */
static void plane_stress_has_none(void **state)
{
    (void)state;
    struct ran r;
    struct output_frame f;
    run(&r, BLOCKS("plane stress"), NULL);
    assert_ok(frame_read(&f, FOLDER "/frames/000001.hdf"));
    for (int64_t i = 0; i < f.n; i++) assert_true(f.stress[3][i] == 0);
    frame_free(&f);
    assert_true(isnan(last_value(FOLDER "/history.csv", "gauge.stress_zz")));
    assert_true(isnan(last_value(FOLDER "/across_000001.csv", "stress_zz")));
    done(&r);
}

/* A block that is extended along x and yields without hardening as soon as 2 G e = sigma_y (e: extension, G: shear
 * modulus). From then on y and z are equivalent:
 *
 *     sigma_xx - sigma_yy = sigma_y,   sigma_zz = sigma_yy = K e - sigma_y/3,   e = ln(1 + g t)
 *
 * with the velocity gradient g and the bulk modulus K. At the end e = 9 sigma_y/E; an elastic sigma_zz would be a fifth
 * too small. A wave travels 1.2 mm from the edges; short waves ahead of it have 1.2e-4 of the yield stress at 6.4 mm.
 */
#define FLOWING                                                                                                        \
    "space: plane strain\nthickness: 1 mm\nduration: 0.2 us\nmethod: mpm\n"                                            \
    "material: {young: 200 GPa, poisson: 1/4, density: 7800, yield_stress: 400 MPa}\n"                                 \
    "body: {box: {from: [-10 mm, -10 mm], to: [10 mm, 10 mm]}}\n"                                                      \
    "particles: {spacing: 1 mm}\ntime: {step: 1 ns}\n"                                                                 \
    "initial: [{velocity_gradient: [9e4, 0, 0, 0]}]\noutput: {frames: 1, samples: 1}\n"                                \
    "probes: [{point: {name: gauge, at: [0.5 mm, 0.5 mm]}}]\n"

static void flow(void **state)
{
    struct ran r;
    struct output_frame f;
    run(&r, FLOWING, (struct scene_override[]){{"method", *state}, {0}});
    const real G = 9e4, K = 200e9 / 1.5, yield = 400e6;
    const real wanted = K * log1p(G * 0.2e-6) - yield / 3;
    int64_t seen = 0;
    assert_ok(frame_read(&f, FOLDER "/frames/000001.hdf"));
    for (int64_t i = 0; i < f.n; i++) {
        if (fabs(f.X[0][i]) > INSIDE || fabs(f.X[1][i]) > INSIDE) continue;
        assert_near(f.stress[3][i], f.stress[1][i], 1.5e-4 * yield);
        assert_near(f.stress[0][i] - f.stress[1][i], yield, 1e-4 * yield);
        assert_near(f.stress[3][i], wanted, 1e-3 * wanted);
        assert_true(f.stress[3][i] > 1.1 * 0.25 * (f.stress[0][i] + f.stress[1][i])); /* excludes the elastic value */
        seen++;
    }
    assert_int_equal(seen, 64);
    frame_free(&f);
    assert_near(last_value(FOLDER "/history.csv", "gauge.stress_zz"), wanted, 1e-3 * wanted);
    done(&r);
}

static char folder[] = "/tmp/cleave_plane_strain_XXXXXX";

static int enter(void **state)
{
    (void)state;
    output_install_signal_handling_for_file_writes();
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave(void **state)
{
    (void)state;
    return chdir("/") != 0 || rmdir(folder) != 0;
}

int main(void)
{
    enum { ROWS = COUNT_OF(uniform) };
    struct CMUnitTest tests[ROWS + 3];
    for (int k = 0; k < ROWS; k++)
        tests[k] = (struct CMUnitTest){
            .name = uniform[k].name, .test_func = uniform_strain, .initial_state = (void *)&uniform[k]};
    tests[ROWS] = (struct CMUnitTest)cmocka_unit_test(plane_stress_has_none);
    tests[ROWS + 1] = (struct CMUnitTest){.name = "flow", .test_func = flow, .initial_state = "mpm"};
    tests[ROWS + 2] = (struct CMUnitTest){.name = "flow, adaptive", .test_func = flow, .initial_state = "adaptive"};
    return cmocka_run_group_tests(tests, enter, leave);
}
