/* Tests absorbing faces: the velocity update of a dashpot against its closed form; bars, plates and blocks from which
 * waves leave; effects of mirrors, supports and conversion to peridynamics; long runs. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "bench/common/bench.h"
#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "probes/diagnostics.h"
#include "step/report.h"

static const char bonds[] = "method: pd", cells[] = "method: mpm\nmpm: {frame: reference}",
                  flip[] = "method: mpm\nmpm: {frame: current}",
                  apic[] = "method: mpm\nmpm: {frame: current, transfer: apic}";

/* ---- velocity update --------------------------------------------------------------------------------------------- */

/* Checks m (v+ - v-)/dt = f - k (v- + v+)/2 at every peridynamic particle of an absorbing face, with the dashpot
 * coefficient k of its material. Other particles are accelerated by the force f alone. */
static void test_kick(void **state)
{
    (void)state;
    const struct boundary row[] = {
        {.name = "right", .kind = BOUNDARY_ABSORBING, .body = -1, .face = 0, .side = 1, .section = 2e-3},
        {.name = "top", .kind = BOUNDARY_ABSORBING, .body = -1, .face = 1, .side = 1, .section = 2e-3}};
    const struct impedance bond[] = {{4e7, 2e7}, {7e7, 3e7}}, other[] = {{5e7, 6e7}, {9e7, 8e7}};
    const struct impedance *const all[MOVERS] = {
        [MOVED_BY_BONDS] = bond, [MOVED_BY_GRID] = other, [MOVED_BY_MESH] = other};
    const real dt = 1e-6, area = CLOUD_SPACING * 2e-3;
    struct particle_cloud c;
    struct loads l;
    real taken = 0, kick = 0, impulse[2] = {0};
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {5, 4}, .horizon = 3});
    struct particles *p = &c.p;
    for (int64_t i = 0; i < p->n; i++) p->material[i] = i % 3 == 0;
    assert_ok(loads_make_from_boundaries(&l, row, 2, p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    absorbing_dashpots_make(&l, p, all);
    assert_int_equal(l.absorbing.n, 5 * 2 + 4 * 2 - 4); /* two layers deep, for nodes */
    real right = -INFINITY, top = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) right = real_max(right, p->X[0][i]), top = real_max(top, p->X[1][i]);
    for (int64_t k = 0; k < l.absorbing.n; k++) { /* weights of points: 3/2 at the face, -1/2 behind */
        const int32_t i = l.absorbing.particle[k];
        const real behind = (right - p->X[0][i]) / CLOUD_SPACING;
        if (p->X[1][i] > top - 1.5 * CLOUD_SPACING) continue;
        for (int d = 0; d < 2; d++) {
            const real z = d == 0 ? other[p->material[i]].normal : other[p->material[i]].tangential;
            assert_near(l.absorbing.rate[MOVED_BY_GRID][d][k], (behind < 0.5 ? 1.5 : -0.5) * area * z, 1e-9 * area * z);
            assert_near(l.absorbing.rate[MOVED_BY_MESH][d][k], (behind < 0.5) * area * z, 1e-9 * area * z);
        }
    }
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < 2; d++) p->v[d][i] = sin((real)i + d), p->f[d][i] = 1e3 * cos(3 * (real)i + d);
    real *before = NEW("test.f", 2 * p->n, real);
    for (int d = 0; d < 2; d++) memcpy(before + d * p->n, p->f[d], (size_t)p->n * sizeof(real));
    loads_apply_forces_and_motion_constraints(&l, p, dt, dt, dt);
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < 2; d++) {
            const bool on[2] = {p->X[0][i] > right - 1e-9, p->X[1][i] > top - 1e-9};
            const struct impedance *z = &bond[p->material[i]];
            const real k = area * ((on[0] ? d == 0 ? z->normal : z->tangential : 0) +
                                   (on[1] ? d == 1 ? z->normal : z->tangential : 0));
            const real v = p->v[d][i], after = v + dt * p->f[d][i] / p->mass[i], given = -k * dt * 0.5 * (v + after);
            assert_near(dt * (p->f[d][i] - before[d * p->n + i]), given, 1e-12 * (fabs(given) + dt * 1e3));
            taken -= given * 0.5 * (v + after), kick += 0.25 * given * (after - v), impulse[d] += given;
        }
    assert_near(l.absorbing.energy, taken, 1e-12 * taken);
    assert_near(l.absorbing.kick, kick, 1e-12 * taken);
    for (int d = 0; d < 2; d++) assert_near(l.impulse[d], impulse[d], 1e-12 * taken);
    loads_free(&l);
    memory_free(before);
    particle_cloud_free(&c);
}

/* ---- waves that leave through a face ----------------------------------------------------------------------------- */

/* Results of a run: energy at its start and end, absorbed energy [J]; largest relative error of the energy balance and
 * final one of the momentum balance [1]; largest energy, and largest decrease of the absorbed energy in a step [J]. */
struct left {
    real start, rest, absorbed, balance, momentum, most, back;
};

/* Runs the scene `text` to its end and returns its results. */
static struct left run_text(const char *text)
{
    struct run e;
    struct scene s;
    struct left m = {0};
    real before = 0;
    assert_ok(bench_engine_make(&e, &s, "absorbing", text, NULL, 0));
    assert_ok(report_open_history_and_write_first_frame(&e));
    while (e.clock.step < e.clock.steps) {
        assert_ok(run_adapt_mesh_and_advance_one_step(&e));
        m.back = real_max(m.back, before - e.loads.absorbing.energy);
        before = e.loads.absorbing.energy;
        const struct energy_balance *now = &e.diagnostics->now;
        m.most = real_max(m.most, now->energy.kinetic + now->energy.strain);
        m.balance = real_max(m.balance, fabs(now->balance_error));
    }
    assert_ok(report_write_last_checkpoint_and_finish(&e));
    m.start = e.diagnostics->energy_start, m.absorbed = e.diagnostics->now.energy.absorbed;
    m.rest = e.diagnostics->now.energy.kinetic + e.diagnostics->now.energy.strain;
    m.momentum = e.diagnostics->now.momentum_error;
    bench_engine_free(&e, &s);
    return m;
}

/* Checks that a pulse 32 spacings wide leaves a bar through its absorbing end. The remaining energy is at most the
 * square of a reflected amplitude, 1 % (cells) to 6.5 % (FLIP, which keeps some noise). Limits of the energy balance:
 * second order in the step for FLIP, the dissipation of APIC on the path, round-off of positions for bonds and
 * cells. */
static void test_bar(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        real rest, balance, back;
    } at[] = {{bonds, 0.025 * 0.025, 1e-8, 0},
              {cells, 0.01 * 0.01, 1e-12, 0},
              {flip, 0.065 * 0.065, 1e-4, 1e-5},
              {apic, 0.05 * 0.05, 0.02, 0}};
    for (size_t k = 0; k < COUNT_OF(at); k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "name: bar\nspace: line\nsection: 0.37 m^2\nduration: 4 ms\n%s\n"
                 "material: {young: 2.3e4, density: 2.3}\n"
                 "body: {box: {from: [0], to: [0.4]}}\nparticles: {spacing: 1 mm, horizon: 3}\n"
                 "initial:\n  - pulse: {at: [0.2], direction: [1], width: 32 mm, velocity: 1 mm/s}\n"
                 "boundary:\n  - {absorbing: true, face: x+}\noutput: {frames: 0, samples: 200}\n",
                 at[k].method);
        const struct left m = run_text(text);
        assert_true(m.rest <= at[k].rest * m.start);
        assert_true(m.balance <= at[k].balance);
        assert_true(m.momentum <= 1e-13);
        assert_true(m.back <= at[k].back * m.start);
    }
}

/* Checks a block with absorbing faces all around that is hit in its middle, over 1e5 steps. It loses its energy and
 * never has more than at the start. The energy balance of bonds and cells closes to second order in the step, and to
 * their strains of 1e-3. */
static void test_long(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        real balance, rest;
    } at[] = {{bonds, 1e-7, 1e-4}, {cells, 1e-6, 1e-4}, {flip, 1e-2, 2e-2}};
    for (size_t k = 0; k < COUNT_OF(at); k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "name: block\nspace: plane stress\nthickness: 0.37 m\nduration: %s\n%s\n"
                 "material: {young: 2.3*80000/9, poisson: 1/3, density: 2.3}\n"
                 "body: {box: {from: [0, 0], to: [12 mm, 10 mm]}}\nparticles: {spacing: 1 mm}\ntime: {step: %s}\n"
                 "initial:\n  - {velocity_gradient: [3, 1, -2, 4], centre: [6 mm, 5 mm]}\n"
                 "boundary:\n  - {absorbing: true, face: x+}\n  - {absorbing: true, face: x-}\n"
                 "  - {absorbing: true, face: y+}\n  - {absorbing: true, face: y-}\n"
                 "output: {frames: 0, samples: 500}\n",
                 k == 0 ? "0.5 s" : "0.8 s", at[k].method, k == 0 ? "5 us" : "8 us");
        const struct left m = run_text(text);
        if (!(m.most <= (1 + 1e-9) * m.start && m.rest <= at[k].rest * m.start && m.balance <= at[k].balance &&
              m.momentum <= 1e-10))
            fail_msg("%s: most %g, rest %g, balance %g, momentum %g", at[k].method, m.most / m.start, m.rest / m.start,
                     m.balance, m.momentum);
    }
}

/* ---- with mirrors, supports, conversion -------------------------------------------------------------------------- */

/* Checks that half a plate beside a mirror that intersects absorbing faces absorbs half the energy that the whole plate
 * does. The mirror is on a row of nodes of the mesh, or midway between two. APIC points dissipate slightly differently
 * at mirrors. */
static void test_mirror_faces(void **state)
{
    (void)state;
    static const struct {
        const char *method, *origin;
        real tolerance;
    } at[] = {{bonds, "", 1e-9}, {cells, "", 1e-9}, {cells, ", origin: [0, 1 mm]", 1e-9}, {apic, "", 3e-3}};
    for (size_t k = 0; k < COUNT_OF(at); k++) {
        struct left m[2];
        for (int half = 0; half < 2; half++) {
            char text[1024], method[128];
            snprintf(method, sizeof method, "%s", at[k].method);
            if (*at[k].origin) snprintf(method, sizeof method, "method: mpm\nmpm: {frame: reference%s}", at[k].origin);
            snprintf(text, sizeof text,
                     "name: plate\nspace: plane strain\nthickness: 0.37 m\nduration: 1 ms\n%s\n"
                     "material: {young: 2.3e4, poisson: 1/4, density: 2.3}\n"
                     "body: {box: {from: [0, %s], to: [24 mm, 12 mm]}}\n"
                     "particles: {spacing: 1 mm}\ntime: {step: 2 us}\n"
                     "initial:\n  - {velocity_gradient: [3, 0, 0, 4], centre: [12 mm, 0]}\n"
                     "boundary:\n  - {absorbing: true, face: x+}\n  - {absorbing: true, face: y+}\n%s"
                     "output: {frames: 0, samples: 20}\n",
                     method, half ? "0" : "-12 mm",
                     half ? "  - {mirror: {axis: y, at: 0}}\n" : "  - {absorbing: true, face: y-}\n");
            m[half] = run_text(text);
        }
        if (!(fabs(2 * m[1].absorbed - m[0].absorbed) <= at[k].tolerance * m[0].absorbed))
            fail_msg("%s%s: %.12g, twice %.12g", at[k].method, at[k].origin, m[0].absorbed, m[1].absorbed);
        assert_true(m[1].momentum <= 1e-12);
    }
}

/* Checks a bar that is fixed at its absorbing end: a fixed velocity component has no dashpot, and the whole pulse is
 * reflected. */
static void test_held(void **state)
{
    (void)state;
    const char *const method[] = {bonds, cells, apic};
    for (size_t k = 0; k < COUNT_OF(method); k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "name: bar\nspace: line\nsection: 0.37 m^2\nduration: 4 ms\n%s\n"
                 "material: {young: 2.3e4, density: 2.3}\n"
                 "body: {box: {from: [0], to: [0.4]}}\nparticles: {spacing: 1 mm, horizon: 3}\n"
                 "initial:\n  - pulse: {at: [0.2], direction: [1], width: 32 mm, velocity: 1 mm/s}\n"
                 "boundary:\n  - {absorbing: true, face: x+}\n"
                 "  - {fixed: all, region: {box: {from: [398 mm], to: [400 mm]}}}\n"
                 "output: {frames: 0, samples: 200}\n",
                 method[k]);
        const struct left m = run_text(text);
        assert_true(m.rest >= 0.9 * m.start && m.absorbed <= 1e-3 * m.start && m.balance <= 0.05);
    }
}

/* Checks an adaptive plate whose material points convert to peridynamic particles up to the absorbing faces, which then
 * act on bonds. Conversion in motion dissipates 15 % of the energy in so small a plate; the faces change this by at
 * most 1 %. */
static void test_conversion_at_face(void **state)
{
    (void)state;
    struct left m[2];
    for (int faces = 0; faces < 2; faces++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "name: plate\nspace: plane stress\nthickness: 1 mm\nduration: 8 us\nmethod: adaptive\n"
                 "material: {young: 72 GPa, density: 2440, energy_release_rate: 135}\nmpm: {frame: reference}\n"
                 "body: {box: {from: [0, 0], to: [30 mm, 16 mm]}}\nparticles: {spacing: 1 mm}\n"
                 "conversion: {stress: 20 MPa}\nboundary:\n%s"
                 "  - {velocity: [-8 m/s, free], region: {box: {from: [0, 0], to: [1 mm, 16 mm]}}}\n"
                 "output: {frames: 0, samples: 40}\n",
                 faces ? "  - {absorbing: true, face: x+}\n  - {absorbing: true, face: y+}\n" : "");
        m[faces] = run_text(text);
        assert_true(m[faces].momentum <= 1e-12 && m[faces].back == 0);
    }
    assert_true(m[1].absorbed > 0 && m[0].absorbed == 0);
    assert_near(m[1].balance, m[0].balance, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kick),         cmocka_unit_test(test_bar),  cmocka_unit_test(test_long),
        cmocka_unit_test(test_mirror_faces), cmocka_unit_test(test_held), cmocka_unit_test(test_conversion_at_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
