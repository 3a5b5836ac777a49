/* Checks bulk viscosity. A front caused by a piston is compared with the closed form, a jump from rest to the speed v
 * of the piston. Further: conservation of momentum and angular momentum, and an energy balance that includes the
 * dissipated part. */
#include "tests/support/near.h"

#include "base/memory.h"
#include "probes/diagnostics.h"
#include "mesh/mesh_part.h"
#include "run/energies.h"
#include "step/sample.h"
#include "step/step.h"
#include "step/viscosity.h"
#include "tests/support/solution.h"

#define PISTON                                                                                                         \
    "material: {young: 70 GPa, density: 2700}\nparticles: {spacing: 1 mm}\noutput: {samples: 20, frames: 1}\n"         \
    "mpm: {frame: reference, levels: 0}\n"

static const char *const line =
    "space: line\nsection: 3 cm^2\nduration: 11 us\n" PISTON "body: {box: {from: [0], to: [90 mm]}}\n"
    "boundary:\n  - {velocity: [5 m/s], region: {box: {from: [-1 mm], to: [2 mm]}}}\n";
static const char *const flat =
    "space: plane strain\nthickness: 7 mm\nduration: 10 us\n" PISTON "body: {box: {from: [0, 0], to: [90 mm, 6 mm]}}\n"
    "boundary:\n  - {velocity: [5 m/s, free], region: {box: {from: [-1 mm, -1 mm], to: [2 mm, 7 mm]}}}\n"
    "  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 6 mm}}\n";
static const char *const solid =
    "space: solid\nduration: 8 us\n" PISTON "body: {box: {from: [0, 0, 0], to: [70 mm, 4 mm, 4 mm]}}\n"
    "boundary:\n  - {velocity: [5 m/s, free, free], region: {box: {from: [-1 mm, -1 mm, -1 mm], to: [2 mm, 5 mm, 5 "
    "mm]}}}\n"
    "  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 4 mm}}\n"
    "  - {mirror: {axis: z, at: 0}}\n  - {mirror: {axis: z, at: 4 mm}}\n";

struct front {
    const char *name, *scene, *method;
};

/* Computes from the run of a piston the largest overshoot, *most, of the velocity over v, and the largest |velocity/v -
 * 1| behind the front, *off; both are relative to v. *off excludes a tenth of the distance travelled, at the piston,
 * and the last 22 mm before the front. */
static void behind(const struct run *run, real *most, real *off)
{
    const struct material *m = &run->scene->material[0];
    const real way = m->wave_speed * run->clock.t, v = 5;
    *most = *off = 0;
    for (int64_t i = 0; i < run->part.n; i++) {
        const real X = run->part.X[0][i], x = run->part.v[0][i] / v;
        *most = real_max(*most, x - 1);
        if (X > 0.1 * way && X < way - 22e-3) *off = real_max(*off, fabs(x - 1));
    }
}

/* Checks that the default viscosity removes the oscillation behind a front: the overshoot, above 15 % without
 * viscosity, is below 2e-3, and the velocity behind the front is v within 3e-3. The energy balance closes to 5e-4,
 * since it omits the first half step, in which the piston starts. */
static void front_does_not_ring(void **state)
{
    const struct front *f = *state;
    char method[40];
    struct solution a;
    real most, off;
    snprintf(method, sizeof method, "method=%s", f->method);
    solution_run(&a, f->scene, method, NULL), solution_done(&a);
    run_update_particle_motion_and_stress(&a.e);
    behind(&a.e, &most, &off);
    if (!(most > 0.15)) fail_msg("%s: rings by %g only, so that nothing is tested", f->name, most);
    assert_true(a.e.diagnostics->now.energy.viscous == 0);
    solution_free(&a);
    solution_run(&a, f->scene, method, "material.viscosity={}", NULL), solution_done(&a);
    run_update_particle_motion_and_stress(&a.e);
    behind(&a.e, &most, &off);
    const struct energy_balance *now = &a.e.diagnostics->now;
    if (!(most < 2e-3 && off < 3e-3)) fail_msg("%s: %g above v, %g off behind the front", f->name, most, off);
    assert_true(now->energy.viscous > 1e-3 * now->external_work && now->energy.viscous < 0.2 * now->external_work);
    if (!(fabs(now->balance_error) < 5e-4)) fail_msg("%s: balance %g", f->name, now->balance_error);
    solution_free(&a);
}

/* Checks that an eccentric collision of two peridynamic blocks with viscosity conserves momentum and angular momentum
 * to round-off, because viscous forces act in pairs along the bonds. */
static void momenta_are_kept(void **state)
{
    (void)state;
    static const char *const blocks =
        "space: plane strain\nthickness: 7 mm\nduration: 60 us\nmethod: pd\ncontact: {between: bodies}\n"
        "materials:\n  - {name: a, young: 70 GPa, density: 2700, viscosity: {linear: 0.3, quadratic: 2}}\n"
        "  - {name: b, young: 200 GPa, density: 7800, viscosity: {linear: 0.1}}\n"
        "bodies:\n  - {name: one, material: a, velocity: [40 m/s, 3 m/s], shape: {box: {from: [0, 0], to: [12 mm, 9 "
        "mm]}}}\n"
        "  - {name: other, material: b, shape: {box: {from: [13 mm, 5 mm], to: [25 mm, 14 mm]}}}\n"
        "particles: {spacing: 1 mm}\noutput: {samples: 30, frames: 1}\n";
    struct solution a;
    solution_run(&a, blocks, NULL), solution_done(&a);
    const struct energy_balance *now = &a.e.diagnostics->now;
    assert_true(now->energy.viscous > 0.02 * a.e.diagnostics->energy_scale);
    assert_near(now->momentum_error, 0, 1e-12);
    assert_near(now->spin_error, 0, 1e-12);
    assert_near(now->balance_error, 0, 2e-3); /* error of the contact, equal with and without viscosity */
    solution_free(&a);
}

/* Checks that viscosity only dissipates energy, in a block that moves irregularly, with 0.95 of the critical step. */
static void only_takes(void **state)
{
    static const char *const block =
        "space: solid\nduration: 60 us\ntime: {safety: 0.95}\n"
        "material: {young: 70 GPa, density: 2700, viscosity: {linear: 0.4, quadratic: 2}}\n"
        "body: {box: {from: [0, 0, 0], to: [6 mm, 6 mm, 6 mm]}}\nparticles: {spacing: 1 mm}\n"
        "output: {samples: 40, frames: 1}\n"
        "initial: [{velocity: [20 m/s * sin(2100 / m * x + 900 / m * y), 15 m/s * cos(1900 / m * z), 9 m/s * sin(2500 "
        "/ m * x)]}]\n";
    struct solution a;
    solution_make(&a, block, *state, "mpm.levels=0", NULL), solution_done(&a);
    assert_ok(history_sample_open_csv_file(&a.e, false));
    real before = INFINITY, taken = 0;
    const real start = particles_kinetic_energy(&a.e.part) + lagrangian_mesh_kinetic_energy(a.e.frame);
    for (int k = 0; k < 240; k++) {
        assert_ok(run_adapt_mesh_and_advance_one_step(&a.e));
        if (k % 60 != 59) continue;
        assert_true(a.e.viscosity->taken > taken);
        taken = a.e.viscosity->taken;
        const real all = particles_kinetic_energy(&a.e.part) + lagrangian_mesh_kinetic_energy(a.e.frame) +
                         run_compute_elastic_energy(&a.e);
        assert_true(all < before);
        before = all;
    }
    assert_true(taken > 0.2 * start);
    solution_free(&a);
}

/* Checks that four descriptions of an end driven at 2000 m/s, and the traction rho c v, give equal critical steps. Also
 * checks the ratio to the step of 5 m/s: that of sqrt(1 + q^2) - q, with q = 0.2 + 1.5 v/c. */
static void step_follows_every_drive(void **state)
{
    static char *const drive[] = {
        "boundary[0]={velocity: [2000 m/s], region: {box: {from: [-1 mm], to: [2 mm]}}}",
        "boundary[0]={displacement: [(2000 m/s)*t], region: {box: {from: [-1 mm], to: [2 mm]}}}",
        "boundary[0]={velocity: [(2000 m/s)*(t + 1 s)/(1 s)], region: {box: {from: [-1 mm], to: [2 mm]}}}",
        "boundary[0]={velocity: [1 m/s], region: {box: {from: [-1 mm], to: [2 mm]}}, time: {table: [[0 s, 2000], [1 s, "
        "2000]]}}",
        "boundary[0]={traction: [27495.45 MPa], face: x-}"}; /* 2700 kg/m^3 times 5091.75 m/s times 2000 m/s */
    struct solution a;
    real first = 0;
    (void)state;
    for (size_t k = 0; k < COUNT_OF(drive); k++) {
        solution_make(&a, line, "method=mpm", "material.viscosity={}", drive[k], NULL);
        if (a.made != OK) fail_msg("%s: %s", drive[k], status_message());
        if (k == 0) first = a.e.clock.dt_critical;
        if (!(fabs(a.e.clock.dt_critical / first - 1) < 1e-4))
            fail_msg("%s: step %g, not %g", drive[k], a.e.clock.dt_critical, first);
        solution_free(&a);
    }
    solution_make(&a, line, "method=mpm", "material.viscosity={}", NULL);
    const real q = 0.2 + 1.5 * 2000 / a.s.material[0].wave_speed, slow = 0.2 + 1.5 * 5 / a.s.material[0].wave_speed;
    const real share = (sqrt(1 + q * q) - q) / (sqrt(1 + slow * slow) - slow);
    assert_true(fabs(first / a.e.clock.dt_critical / share - 1) < 1e-4);
    solution_free(&a);
}

/* Checks that leaving out regions at rest (key time.active_set) changes no bit of the velocities. */
static void rest_changes_no_bit(void **state)
{
    struct solution a, b;
    (void)state;
    solution_run(&a, flat, "method=pd", "material.viscosity={}", "time.active_set=true", NULL), solution_done(&a);
    solution_run(&b, flat, "method=pd", "material.viscosity={}", "time.active_set=false", NULL), solution_done(&b);
    for (int d = 0; d < 2; d++)
        for (int64_t i = 0; i < a.e.part.n; i++) assert_true(a.e.part.v[d][i] == b.e.part.v[d][i]);
    assert_true(a.e.diagnostics->now.momentum_error == b.e.diagnostics->now.momentum_error);
    solution_free(&a), solution_free(&b);
}

static void refused(void **state)
{
    (void)state;
    static const char *const key[][2] = {
        {"solver=static", "explicit"}, {"mpm.levels=2", "levels: 0"}, {"model=ospd", "model: bond"}};
    struct solution a;
    for (size_t k = 0; k < COUNT_OF(key); k++) {
        solution_make(&a, flat, "method=adaptive", "material.viscosity={}", key[k][0], NULL);
        assert_int_equal(a.made, REFUSED);
        assert_non_null(strstr(status_message(), key[k][1]));
        solution_free(&a);
    }
}

int main(void)
{
    static const struct front front[] = {{"line, bonds", line, "pd"},   {"line, cells", line, "mpm"},
                                         {"plane, bonds", flat, "pd"},  {"plane, cells", flat, "mpm"},
                                         {"solid, bonds", solid, "pd"}, {"solid, cells", solid, "mpm"}};
    static char *const method[] = {"method=pd", "method=mpm"};
    struct CMUnitTest tests[COUNT_OF(front) + 6];
    int n = 0;
    for (size_t k = 0; k < COUNT_OF(front); k++)
        tests[n++] = (struct CMUnitTest){
            .name = front[k].name, .test_func = front_does_not_ring, .initial_state = (void *)&front[k]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(momenta_are_kept);
    for (int k = 0; k < 2; k++)
        tests[n++] = (struct CMUnitTest){.name = method[k], .test_func = only_takes, .initial_state = method[k]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(step_follows_every_drive);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(rest_changes_no_bit);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(refused);
    return _cmocka_run_group_tests("viscosity", tests, (size_t)n, NULL, NULL);
}
