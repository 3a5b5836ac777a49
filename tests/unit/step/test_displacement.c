/* Tests prescribed displacements: positions accurate to round-off with every method, reactions and stresses against
 * Hooke's law, layers behind faces, refusals. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "engine/engine.h"
#include "tests/support/scene_with.h"
#include "tests/support/near.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "step/step.h"

#define BAR                                                                                                            \
    "space: line\nsection: 1 cm^2\nduration: 0.5 ms\nmethod: pd\n"                                                     \
    "material: {young: 72 GPa, poisson: 0, density: 2440}\nbody: {box: {from: [0], to: [1 m]}}\n"                      \
    "particles: {spacing: 20 mm}\n"
#define PLATE                                                                                                          \
    "space: plane stress\nthickness: 1 mm\nduration: 10 us\nmethod: pd\n"                                              \
    "material: {young: 72 GPa, poisson: 1/3, density: 2440}\nbody: {box: {from: [0, 0], to: [24 mm, 16 mm]}}\n"        \
    "particles: {spacing: 1 mm}\n"
#define BLOCK                                                                                                          \
    "space: solid\nduration: 5 us\nmethod: pd\n"                                                                       \
    "material: {young: 72 GPa, poisson: 1/4, density: 2440}\n"                                                         \
    "body: {box: {from: [0, 0, 0], to: [10 mm, 8 mm, 8 mm]}}\nparticles: {spacing: 1 mm, horizon: 2.015}\npd: "        \
    "{surface: none}\n"

struct scene_run {
    struct scene s;
    struct run e;
};

/* Creates the run a of the scene `text` with the overrides `key=value` of list, terminated by NULL. Returns the
 * status. */
static status run_make(struct scene_run *a, const char *text, va_list list)
{
    memset(a, 0, sizeof *a);
    TRY(scene_with(&a->s, text, list));
    const status s = run_set_up_from_scene(&a->e, &a->s, NULL);
    a->e.report->quiet = true;
    return s;
}

static void make(struct scene_run *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    const status s = run_make(a, text, list);
    va_end(list);
    if (s != OK) fail_msg("%s", status_message());
}

static void run_all(struct scene_run *a)
{
    if (run_advance_to_end_time(&a->e) != OK) fail_msg("%s", status_message());
}

static void run_end(struct scene_run *a)
{
    run_free_memory(&a->e);
    scene_free(&a->s);
}

/* ---- positions --------------------------------------------------------------------------------------------------- */

/* All methods that move particles: bonds, the mesh, the grid with both transfers, and coupled ones. */
static const char *const ways[][3] = {{"method=pd", "mpm.frame=auto", "mpm.transfer=flip"},
                                      {"method=mpm", "mpm.frame=reference", "mpm.levels=0"},
                                      {"method=mpm", "mpm.frame=current", "mpm.transfer=flip"},
                                      {"method=mpm", "mpm.frame=current", "mpm.transfer=apic"},
                                      {"method=adaptive", "mpm.frame=reference", "mpm.levels=0"},
                                      {"method=adaptive", "mpm.frame=current", "mpm.transfer=flip"}};
enum { WAYS = sizeof ways / sizeof *ways };

/* Returns the largest distance of the particles of a with X > `from` from their reference position plus u along x. It
 * is divided by the resolution of the farthest coordinate [1]. */
static real off_place(const struct scene_run *a, real from, real u)
{
    const struct particles *p = &a->e.part;
    real most = 0, far = 0;
    for (int64_t i = 0; i < p->n; i++) {
        far = real_max(far, fabs(p->X[0][i]));
        if (p->X[0][i] > from) most = real_max(most, fabs(p->x[0][i] - (p->X[0][i] + u)));
    }
    return most / (far * DBL_EPSILON);
}

/* Checks at every step of `duration` that driven particles of `scene` with X > `from` are at their prescribed positions
 * to at most four times the resolution: the time in the middle of a step plus half a step is rounded. size: largest
 * displacement [m]. In the mesh, nodes are exact and points are sums of four to eight terms. */
static void check_places(const char *scene, real from, real size, real duration)
{
    char boundary[300];
    snprintf(boundary, sizeof boundary,
             "boundary=[{name: grip, displacement: [%.9g%s], region: {box: {from: [%.9g%s], to: [1%s]}}, "
             "time: {pulse: {until: %.9g}}}]",
             size,
             strstr(scene, "line")    ? ""
             : strstr(scene, "plane") ? ", free"
                                      : ", free, free",
             from,
             strstr(scene, "line")    ? ""
             : strstr(scene, "plane") ? ", -1"
                                      : ", -1, -1",
             strstr(scene, "line")    ? ""
             : strstr(scene, "plane") ? ", 1"
                                      : ", 1, 1",
             1.7 * duration);
    for (int way = 0; way < WAYS; way++) {
        struct scene_run a;
        make(&a, scene, ways[way][0], ways[way][1], ways[way][2], boundary, NULL);
        assert_ok(report_open_history_and_write_first_frame(&a.e));
        const real within = from + 2 * a.s.spacing; /* cells of which all nodes are driven */
        real most = 0, far = 0;
        int64_t steps = 0;
        for (; a.e.clock.t < duration; steps++) {
            if (run_adapt_mesh_and_advance_one_step(&a.e) != OK) fail_msg("%s", status_message());
            const real u = size * square(sin(acos(-1) * a.e.clock.t / (1.7 * duration)));
            run_update_particle_motion_and_stress(&a.e);
            far = real_max(far, fabs(u));
            most = real_max(most, off_place(&a, strstr(ways[way][1], "current") ? from : within, u));
            assert_close(a.e.loads.load[0].displacement[0], u, 1e-12);
        }
        if (!(most <= 4)) fail_msg("%s %s: %g bits off", ways[way][0], ways[way][1], most);
        assert_true(steps > 10 && far > 0.5 * size);
        run_end(&a);
    }
}

static void displaced_is_in_place(void **state)
{
    (void)state;
    check_places(BAR, 0.8, 2e-5, 3e-4);
    check_places(PLATE, 18e-3, 5e-6, 1e-5);
    check_places(BLOCK, 6e-3, 2e-6, 5e-6);
}

/* Checks a displacement by a formula of position and time, for all components: particles and nodes have its values at
 * the end. */
static void formulas_are_in_place(void **state)
{
    (void)state;
    static const char *const drive =
        "boundary=[{displacement: [\"0.01*x*(t/(10 us))^2\", \"(0.002*x - 0.003*y)*ramp(t/(10 us))\"]}]";
    for (int way = 0; way < 2; way++) {
        struct scene_run a;
        make(&a, PLATE, ways[way][0], ways[way][1], drive, NULL);
        run_all(&a);
        run_update_particle_motion_and_stress(&a.e);
        const struct particles *p = &a.e.part;
        for (int64_t i = 0; i < p->n; i++) {
            const real X = p->X[0][i], Y = p->X[1][i];
            assert_true(fabs(p->x[0][i] - 1.01 * X) <= 4 * DBL_EPSILON * 0.024);
            assert_true(fabs(p->x[1][i] - (Y + 0.002 * X - 0.003 * Y)) <= 4 * DBL_EPSILON * 0.024);
        }
        run_end(&a);
    }
}

/* Checks a bar displaced by u (1 - cos omega t)/2. The final reaction is E A u/L (1 + k L cot(k L))/2, k = omega/c, and
 * the work becomes strain energy. Nodes are fixed up to the ends of the regions, L = 0.76 m apart; bonds have the
 * stiffness of the static solver. Tolerances of 2 and 3 %: free waves from the start. */
static void reaction_is_hookes(void **state)
{
    (void)state;
    static const char *const pulled =
        "boundary=[{fixed: all, region: {box: {from: [0], to: [0.12]}}}, {displacement: [1e-4], "
        "region: {box: {from: [0.88], to: [1]}}, time: {pulse: {until: 2.4 ms}}}]";
    const real kL = acos(-1) / 1.2e-3 / sqrt(72e9 / 2440) * 0.76, inertia = 0.5 * (1 + kL / tan(kL));
    static const real balance[WAYS] = {1e-9, 1e-9, 2e-3, 2e-3, 1e-9, 2e-3};
    struct scene_run a;
    make(&a, BAR, "solver=cg", "duration=1.2 ms", pulled, NULL);
    run_all(&a);
    const real bonds = a.e.loads.load[1].reaction[0], nodes = 72e9 * 1e-4 * 1e-4 / 0.76;
    assert_true(bonds < nodes && bonds > 0.9 * nodes);
    run_end(&a);
    for (int way = 0; way < WAYS; way++) {
        make(&a, BAR, ways[way][0], ways[way][1], ways[way][2], "duration=1.2 ms", pulled, NULL);
        run_all(&a);
        const struct load *grip = &a.e.loads.load[1];
        assert_close(grip->displacement[0], 1e-4, 1e-12);
        assert_close(grip->reaction[0], (way == 0 ? bonds : nodes) * inertia, 0.03);
        const struct energy_balance *now = &a.e.diagnostics->now;
        assert_close(now->external_work, 0.5 * (way == 0 ? bonds : nodes) * 1e-4, 0.02);
        if (!(fabs(now->balance_error) <= balance[way])) fail_msg("way %d: balance %g", way, now->balance_error);
        assert_true(now->momentum_error <= 1e-12);
        run_end(&a);
    }
}

/* ---- statics ----------------------------------------------------------------------------------------------------- */

/* Checks uniform strain: formulas (`drive`) displace the ends or the border of `scene` over the depth of a horizon. The
 * free part must follow, the stress must be that of Hooke's law (stress[]), and the work must be the strain energy.
 * solver, model: overrides. Strains of 1e-6 are linear to 1e-5; relaxation moves supports in steps with round-off. */
static void check_patch(const char *scene, const char *solver, const char *model, const char *drive, const real *strain,
                        const real *stress)
{
    struct scene_run a;
    make(&a, scene, solver, model, drive, "solver_tolerance=1e-7", "duration=1 s", NULL);
    run_all(&a);
    bonds_compute_particle_stress(&a.e.bonds, &a.e.part, &a.e.source, &a.e.kernels);
    const struct particles *p = &a.e.part;
    const real far = particles_bounding_box_longest_edge(p), within = 1e-4 * fabs(strain[0]) * far;
    int64_t free = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const bool driven = p->flag[i] & FLAG_DRIVEN;
        for (int d = 0; d < p->dim; d++) {
            const real off = p->x[d][i] - p->X[d][i] - strain[d] * p->X[d][i];
            if (!(fabs(off) <= (driven ? 50 * DBL_EPSILON * far : within)))
                fail_msg("%s %s: %g m off, driven %d", solver, model, off, driven);
            if (!driven) assert_close(p->stress[d][i], stress[d], 1e-3);
        }
        free += !driven;
    }
    assert_true(free >= 24);
    const struct energy_balance *now = &a.e.diagnostics->now;
    assert_close(now->external_work, now->energy.strain, 1e-4);
    run_end(&a);
}

static void uniform_strain_is_uniform_stress(void **state)
{
    (void)state;
    const real E = 72e9, e = 1e-6;
    for (int k = 0; k < 2; k++) {
        const char *solver = k == 0 ? "solver=cg" : "solver=relaxation";
        check_patch(BAR, solver, "model=bond",
                    "boundary=[{displacement: [\"2e-6*x*t/s\"], region: [{box: {from: [0], to: [0.13]}}, "
                    "{box: {from: [0.87], to: [1]}}], time: {ramp: {until: 2 s}}}]",
                    (real[]){e}, (real[]){E * e});
        for (int model = 0; model < 2; model++)
            check_patch(PLATE, solver, model == 0 ? "model=bond" : "model=ospd",
                        "boundary=[{displacement: [\"1e-6*x\", \"-2e-7*y\"], region: [{box: {from: [0, 0], to: [7 mm, "
                        "16 mm]}}, {box: {from: [17 mm, 0], to: [24 mm, 16 mm]}}, {box: {from: [0, 0], to: [24 mm, 6 "
                        "mm]}}, {box: {from: [0, 10 mm], to: [24 mm, 16 mm]}}]}]",
                        (real[]){e, -0.2 * e},
                        (real[]){E / (1 - 1.0 / 9) * (e - 0.2 * e / 3), E / (1 - 1.0 / 9) * (e / 3 - 0.2 * e)});
    }
    check_patch(BLOCK, "solver=cg", "model=bond",
                "boundary=[{displacement: [\"1e-6*x\", 0, \"-2e-7*z\"], region: [{box: {from: [0, 0, 0], to: [3 mm, 8 "
                "mm, 8 mm]}}, {box: {from: [7 mm, 0, 0], to: [10 mm, 8 mm, 8 mm]}}, {box: {from: [0, 0, 0], to: [10 "
                "mm, 2.1 mm, 8 mm]}}, {box: {from: [0, 5.9 mm, 0], to: [10 mm, 8 mm, 8 mm]}}, {box: {from: [0, 0, 0], "
                "to: [10 mm, 8 mm, 2.1 mm]}}, {box: {from: [0, 0, 5.9 mm], to: [10 mm, 8 mm, 8 mm]}}]}]",
                (real[]){e, 0, -0.2 * e},
                (real[]){0.4 * E * (3 * e - 0.2 * e), 0.4 * E * (e - 0.2 * e), 0.4 * E * (e - 0.6 * e)});
}

/* ---- layers behind faces ----------------------------------------------------------------------------------------- */

/* Returns the number of particles on which the first load of `scene` acts, with these overrides of method, body and
 * boundary. */
static int64_t layer_of(const char *scene, const char *method, const char *body, const char *boundary)
{
    struct scene_run a;
    make(&a, scene, method, body, boundary, NULL);
    const int64_t n = a.e.loads.load[0].n;
    run_end(&a);
    return n;
}

/* Checks that the layer behind a face has its specified depth, from the outermost particle to the first gap and inside
 * the region only. On a curved face it consists of whole columns. */
static void faces_have_layers(void **state)
{
    (void)state;
    static const char *const box = "body=[{box: {from: [0, 0], to: [24 mm, 16 mm]}}]",
                             *const hole = "body=[{box: {from: [0, 0], to: [24 mm, 16 mm]}}, "
                                           "{subtract: {box: {from: [0, 4 mm], to: [12 mm, 14 mm]}}}]",
                             *const disc = "body=[{disc: {centre: [0, 0], radius: 8 mm}}]",
                             *const fixed = "boundary=[{fixed: all, face: y+}]",
                             *const deep = "boundary=[{fixed: all, face: y+, depth: 6 mm}]";
    assert_int_equal(layer_of(PLATE, "method=pd", box, fixed), 3 * 24); /* a horizon of 3.015 spacings */
    assert_int_equal(layer_of(PLATE, "method=adaptive", box, fixed), 3 * 24);
    assert_int_equal(layer_of(PLATE, "method=mpm", box, fixed), 24);
    assert_int_equal(layer_of(PLATE, "method=pd", box, deep), 6 * 24);
    assert_int_equal(layer_of(PLATE, "method=pd", hole, deep), 2 * 12 + 6 * 12);
    assert_int_equal(layer_of(PLATE, "method=pd", box,
                              "boundary=[{fixed: all, face: x-, region: {box: {from: [0, 0], "
                              "to: [2 mm, 8 mm]}}}]"),
                     2 * 8);
    assert_int_equal(layer_of(PLATE, "method=pd", disc, "boundary=[{fixed: all, face: y+, depth: 1 mm}]"), 16);
    assert_int_equal(layer_of(BAR, "method=pd", "body=[{box: {from: 0, to: 1}}]", "boundary=[{fixed: all, face: x-}]"),
                     3);
    assert_int_equal(layer_of(BLOCK, "method=pd", "body=[{box: {from: [0, 0, 0], to: [10 mm, 8 mm, 6 mm]}}]",
                              "boundary=[{displacement: [0, 0, free], face: z-}]"),
                     2 * 80);
}

/* Checks bars fixed by their faces: driven nodes are at the faces, so that the free length is the whole bar. */
static void faces_hold_nodes(void **state)
{
    (void)state;
    for (int way = 1; way < 4; way++) {
        struct scene_run a;
        make(&a, BAR, ways[way][0], ways[way][1], ways[way][2], "duration=3 ms",
             "boundary=[{fixed: all, face: x-}, {displacement: [1e-4], face: x+, time: {pulse: {until: 6 ms}}}]", NULL);
        run_all(&a);
        assert_close(a.e.loads.load[1].reaction[0], 72e9 * 1e-4 * 1e-4,
                     0.02); /* free waves from the start, which have crossed the bar 16 times */
        run_end(&a);
    }
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Creates the run of the scene with the overrides `key=value`, terminated by NULL, and releases it. Returns the status
 * of creating it. */
static status refusal(const char *scene, ...)
{
    struct scene_run a;
    va_list list;
    va_start(list, scene);
    const status s = run_make(&a, scene, list);
    va_end(list);
    run_end(&a);
    return s;
}

#define GRIP(text) "boundary=[{name: grip, " text "}]"

/* Checks the refusal of jumps and speeds above wave speeds, which a run could not follow, of positions that are not
 * numbers, and of keys without effect. */
static void jumps_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *keys, *boundary, *part;
    } bad[] = {
        {"method=pd", GRIP("displacement: [1 um, free], face: x+"),
         "boundary grip: its displacement is 1e-06 m at t = 0 already, a jump within the first step; let it grow from "
         "0, for example by time: {ramp: {until: 100 us}}"},
        {"method=pd", GRIP("displacement: [\"1 um*cos(t/(1 us))\", free], face: x+"), "is 1e-06 m at t = 0 already"},
        {"method=pd", GRIP("displacement: [1 um, free], face: x+, time: {step: {from: 1 us, until: 1}}"),
         "boundary grip: its displacement jumps (time: step), which no body can follow; set time: ramp, pulse or "
         "table"},
        {"method=pd", GRIP("displacement: [1 mm, free], face: x+, time: {ramp: {until: 0.1 us}}"),
         "its displacement grows by 1e+04 m/s, faster than waves in the body"},
        {"method=pd", GRIP("displacement: [1 mm*ramp(t/(0.1 us)), free], face: x+"), "faster than waves in the body"},
        {"method=pd", GRIP("displacement: [1 um, free], depth: 1 mm"), "depth: has no effect without face"},
        {"method=pd", GRIP("displacement: [1 um, free], face: x+, depth: 0"), "depth"},
        {"method=pd", GRIP("displacement: [1 um, free], face: z+"),
         "z+ is not the name of a face in space plane stress"},
        {"method=pd", GRIP("displacement: [free, free]"), "every component is free; give at least one displacement"},
        {"method=pd", GRIP("displacement: [1 m/s, free]"), "give a length"},
        {"method=pd", GRIP("displacement: 1 um"), "give a list of 2, for example [0.1 mm, free]"},
        {"method=pd", GRIP("displacement: [1 um, free], velocity: [0, 0]"), "given together with displacement"},
        {"method=pd", GRIP("pressure: 1 MPa, face: x+"),
         "face: a pressure acts on every free face of the particles in `region`"},
        {"method=pd", GRIP("traction: [1 MPa, 0], face: x+, depth: 1 mm"),
         "depth: has no effect without fixed, velocity, displacement or rotation; remove it"},
        {"solver=cg", GRIP("velocity: [\"t*1 m/s^2\", free], face: x+"), "does not give; give a displacement"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        assert_refused(refusal(PLATE, bad[k].keys, bad[k].boundary, NULL), bad[k].part);
    assert_refused(
        refusal(PLATE, "method=mpm", "mpm.frame=current", GRIP("displacement: [1e-3*x*ramp(t/(10 us)), free]"), NULL),
        "a displacement that depends on x, y, z needs reference positions");
    assert_refused(refusal(PLATE, "method=pd", "initial=[{displacement_gradient: [[1e-3, 0], [0, 0]]}]",
                           GRIP("displacement: [1 um, free], face: x+, time: {ramp: {until: 10 us}}"), NULL),
                   "displacements are relative to the reference position, but `initial` moves particles there by");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(displaced_is_in_place), cmocka_unit_test(formulas_are_in_place),
        cmocka_unit_test(reaction_is_hookes),    cmocka_unit_test(uniform_strain_is_uniform_stress),
        cmocka_unit_test(faces_have_layers),     cmocka_unit_test(faces_hold_nodes),
        cmocka_unit_test(jumps_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
