/* Tests the active set. Forces at rest must be exactly zero, results must be bitwise equal with and without the active
 * set, blocks of eight rows must become inactive, and loads must activate them. */
#include <math.h>
#include <omp.h>
#include <string.h>

#include "tests/support/cloud.h"
#include "engine/engine.h"
#include "tests/support/same.h"
#include "kernels/simd/variants.h"
#include "step/report.h"
#include "mesh/mesh_part.h"
#include "grid/grid_part.h"
#include "grid/active_points.h"
#include "scene/scene_read.h"

/* ---- zero forces at rest ----------------------------------------------------------------------------------------- */

/* Checks that forces and energy of `model` are exactly zero in undeformed bodies of `dim` dimensions, regular or
 * irregular, near the origin or far from it, where bond components have round-off. seed: of size, position and
 * irregularity. */
static void check_at_rest(int dim, enum pd_model model, uint64_t seed)
{
    static const enum space space[DIM_MAX + 1] = {0, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    struct particle_cloud c;
    uint64_t random = seed;
    struct cloud_plan plan = {.space = space[dim],
                              .count = {dim == 1 ? 300 : 19, 17, dim == 3 ? 11 : 0},
                              .horizon = 3.015,
                              .shake = seed % 2 ? 0.4 : 0,
                              .seed = seed};
    particle_cloud_make(&c, &plan);
    const real size = cloud_between(&random, 0.1, 10);
    for (int d = 0; d < dim; d++) {
        const real away = cloud_between(&random, -1e3, 1e3) * (seed % 3 == 0 ? 1 : 1e-3);
        for (int64_t i = 0; i < c.p.n; i++) c.p.x[d][i] = c.p.X[d][i] = size * c.p.X[d][i] + away;
    }
    struct state_modulus modulus[CLOUD_MATERIALS];
    for (int m = 0; m < CLOUD_MATERIALS; m++)
        modulus[m] = state_based_moduli_of_material(&c.material[m], plan.space, model == PD_MOSPD);
    if (model >= PD_OSPD) c.source.modulus = modulus, c.source.rotates = model == PD_MOSPD, c.source.local = true;
    family_make_on_lattice(&c.source.family, plan.space, size * CLOUD_SPACING, plan.horizon, 1);
    cloud_bonds(&c);
    struct kernels k;
    kernels_choose(&k, dim, model, SHAPE_LINEAR, TRANSFER_FLIP);
    for (int d = 0; d < dim; d++)
        for (int64_t i = 0; i < c.p.n; i++) c.p.f[d][i] = 1;
    k.bond_force(&c.bonds, &c.p, &c.source.limit, NULL);
    assert_true(c.bonds.n > 2 * c.p.n);
    for (int d = 0; d < dim; d++)
        for (int64_t i = 0; i < c.p.n; i++) assert_true(c.p.f[d][i] == 0);
    assert_true(k.bond_energy(&c.bonds, &c.p, NULL) == 0);
    particle_cloud_free(&c);
}

static void test_at_rest(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model < PD_MODELS; model++)
            for (uint64_t seed = 1; seed <= 6 && (dim > 1 || model < PD_OSPD); seed++) check_at_rest(dim, model, seed);
}

/* ---- bitwise equality -------------------------------------------------------------------------------------------- */

/* Scenes of a plate and a block that are hit or pulled at one end, so that a pulse crosses them. `%s` is replaced by
 * the keys of a case. */
static const char plate[] =
    "name: plate\nspace: plane stress\nthickness: 1 mm\nduration: 24 us\n"
    "material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}\n"
    "body: [{box: {from: [0, -20 mm], to: [80 mm, 20 mm]}}]\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "cracks: [{from: [20 mm, -5 mm], to: [20 mm, 5 mm]}]\n"
    "output: {samples: 40, frames: 2}\n";
static const char block[] =
    "name: block\nspace: solid\nduration: 16 us\n"
    "material: {young: 72 GPa, poisson: 1/4, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}\n"
    "body: [{box: {from: [0, 0, 0], to: [64 mm, 8 mm, 8 mm]}}]\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "output: {samples: 10, frames: 2}\n";
static const char struck[] = "boundary: [{velocity: [5 m/s, free], region: {box: {from: [0, -20 mm], to: [1 mm, 20 "
                             "mm]}}, time: {step: {from: 0, until: 2 us}}}%s]\n";
static const char pulled[] = "boundary: [{traction: [20 MPa, 0], face: x-, time: {step: {from: 0, until: 2 us}}}%s]\n";
static const char struck_block[] =
    "boundary: [{velocity: [5 m/s, free, free], region: {box: {from: [0, 0, 0], to: [1 mm, 8 mm, 8 mm]}}}%s]\n";
static const char mirror[] =
    ", {mirror: {axis: y, at: -20 mm, tangential: free}}, {mirror: {axis: x, at: 80 mm, tangential: held}}";
static const char late[] = ", {body_force: [1e9, 0], region: {box: {from: [60 mm, -10 mm], to: [70 mm, 10 mm]}}, time: "
                           "{step: {from: 6 us, until: 8 us}}}";

static struct run *run_make(struct scene *s, const char *body, const char *boundary, const char *more, const char *keys,
                            bool rest)
{
    char text[4096], edges[1024];
    struct run *run = NEW("test.engine", 1, struct run);
    snprintf(edges, sizeof edges, boundary, more);
    snprintf(text, sizeof text, "%s%s%s\ntime: {active_set: %s, step: 0.08 us}\n", body, edges, keys,
             rest ? "true" : "false");
    if (scene_read_text(s, text, strlen(text), "active_set.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
    return run;
}

static void run_free(struct run *run, struct scene *s)
{
    run_free_memory(run);
    memory_free(run);
    scene_free(s);
}

static void same_bits(const struct run *a, const struct run *b)
{
    const struct particles *p = &a->part, *q = &b->part;
    assert_int_equal(p->n_of[KIND_PD], q->n_of[KIND_PD]);
    assert_same_particles(p, q, a->optional);
    assert_memory_equal(a->loads.impulse, b->loads.impulse, sizeof a->loads.impulse);
    assert_int_equal(a->frame->mesh.points, b->frame->mesh.points);
    for (int d = 0; d < p->dim && a->frame->mesh.points > 0; d++) {
        assert_memory_equal(a->frame->mesh.displacement[d], b->frame->mesh.displacement[d],
                            (size_t)a->frame->mesh.grid.n * sizeof(real));
        assert_memory_equal(a->frame->mesh.grid.velocity[d], b->frame->mesh.grid.velocity[d],
                            (size_t)a->frame->mesh.grid.n * sizeof(real));
    }
    const real energy = a->kernels.bond_energy(&a->bonds, p, NULL);
    assert_memory_equal(&energy, &(real){b->kernels.bond_energy(&b->bonds, q, NULL)}, sizeof energy);
}

/* Returns the inactive fraction of the body of the run, or of its points on the grid [1]. */
static real sleeping(const struct run *run)
{
    const struct transfer_order *active = run->grid->transfer.order;
    const struct transfer_order *all = &run->grid->field[0].order;
    const real points = all->n > 0 && active != all ? 1 - (real)active->n / (real)all->n : 0;
    return real_max(particles_at_rest_fraction(&run->bonds, &run->frame->mesh, &run->part), points);
}

/* Runs the scene of `body`, `boundary`, `more` and `keys` with and without the active set. Results must be bitwise
 * equal after every tenth step. At least the fraction `early` must be inactive after a tenth of the steps (for points
 * on the grid after the first check, because round-off travels some cells per step), and none at the end. Returns the
 * number of converted particles. */
static int64_t check_same(const char *body, const char *boundary, const char *more, const char *keys, real early)
{
    struct scene s[2];
    struct run *on = run_make(&s[0], body, boundary, more, keys, true),
               *off = run_make(&s[1], body, boundary, more, keys, false);
    assert_true(on->clock.steps > 50);
    const int64_t before = on->part.n_of[KIND_PD];
    const int64_t look =
        strstr(keys, "reference") || strstr(keys, "method: pd") ? on->clock.steps / 10 : ACTIVE_POINTS_STEPS + 1;
    for (int64_t step = 1; step <= on->clock.steps; step++) {
        omp_set_num_threads(1 + (int)(step & 1));
        assert_ok(run_adapt_mesh_and_advance_one_step(on));
        assert_ok(run_adapt_mesh_and_advance_one_step(off));
        assert_true(sleeping(off) == 0);
        if (step == look && !(sleeping(on) >= early)) fail_msg("%s: only %g sleep", keys, sleeping(on));
        if (step % 10 == 0 || step == on->clock.steps) same_bits(on, off);
    }
    if (sleeping(on) > 0) fail_msg("%s: %g sleep at the end", keys, sleeping(on));
    const int64_t converted = on->part.n_of[KIND_PD] - before;
    run_free(on, &s[0]);
    run_free(off, &s[1]);
    return converted;
}

static void test_bonds(void **state)
{
    (void)state;
    check_same(plate, struck, "", "method: pd", 0.15);
    check_same(plate, pulled, mirror, "method: pd\npd: {surface: none}", 0.15);
    check_same(plate, struck, "", "method: pd\nmodel: ospd", 0.1);
    check_same(plate, struck, mirror, "method: pd\nmodel: mospd", 0.1);
}

static void test_solid(void **state)
{
    (void)state;
    check_same(block, struck_block, "", "method: pd", 0.1);
    check_same(block, struck_block, "", "method: pd\nmodel: mospd", 0.05);
    check_same(block, struck_block, "", "method: mpm\nmpm: {frame: reference}", 0.1);
}

static void test_mesh(void **state)
{
    (void)state;
    check_same(plate, pulled, "", "method: mpm\nmpm: {frame: reference}", 0.1);
    check_same(plate, pulled, mirror, "method: mpm\nmpm: {frame: reference, strain: small}", 0.1);
}

/* Checks points on the grid, where disturbances travel from cell to cell, farthest with FLIP and wide shape
 * functions. */
static void test_points(void **state)
{
    (void)state;
    check_same(plate, struck, "", "method: mpm\nmpm: {transfer: flip}", 0.02);
    check_same(plate, pulled, mirror, "method: mpm\nmpm: {transfer: apic}", 0.1);
    check_same(plate, struck, mirror, "method: mpm\nmpm: {shape: linear}", 0.2);
    check_same(plate, pulled, "", "method: mpm\nmpm: {shape: cubic, transfer: apic}", 0.1);
    check_same(block, struck_block, "", "method: mpm\nmpm: {shape: linear}", 0.2);
    check_same(plate, struck, late, "method: mpm\nmpm: {shape: linear}", 0.05);
}

/* Checks adaptive runs, in which crack tips are peridynamic from the start, and the pulse breaks bonds there, so that
 * more particles convert. */
static void test_adaptive(void **state)
{
    (void)state;
    static const char keys[] = "method: adaptive\nconversion: {tips: 1, alpha: 0.2}\nmpm: {frame: reference}";
    assert_true(check_same(plate, pulled, "", keys, 0.05) > 0);
    check_same(plate, pulled, "", "method: adaptive\nconversion: {tips: 1, alpha: 0.2}\nmpm: {transfer: apic}", 0.05);
    check_same(plate, pulled, "",
               "method: adaptive\nmodel: ospd\nconversion: {tips: 1, alpha: 0.2}\nmpm: {frame: reference}", 0.05);
}

/* ---- activation -------------------------------------------------------------------------------------------------- */

/* Checks that a load that starts late, far from the wave, moves the particles on which it acts as without the active
 * set. */
static void test_late(void **state)
{
    (void)state;
    check_same(plate, struck, late, "method: pd", 0.05);
    check_same(plate, struck, late, "method: mpm\nmpm: {frame: reference}", 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_at_rest), cmocka_unit_test(test_bonds),
                                       cmocka_unit_test(test_solid),   cmocka_unit_test(test_mesh),
                                       cmocka_unit_test(test_points),  cmocka_unit_test(test_adaptive),
                                       cmocka_unit_test(test_late)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
