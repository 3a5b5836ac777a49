/* Material points that have state-based bonds: forces on particles and nodes are the gradient of one energy, also in
 * rotating bodies; the state of such points on the grid; and their partial stress. */
#include <string.h>

#include "tests/support/cloud.h"
#include "engine/engine.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "base/team.h"
#include "mesh/mesh_part.h"
#include "coupling/coupling_part.h"
#include "coupling/conversion.h"
#include "step/step.h"
#include "run/energies.h"
#include "scene/scene_read.h"

#define TURN_MOST 0.2 /* largest rotation of a particle [rad] */
#define SHAKE 0.02    /* random displacements [spacings]: strains of some percent */

/* A body with a peridynamic disc or ball at a symmetry plane: bonds end at material points and at images of
 * particles. */
static const char plate[] =
    "name: plate\nspace: plane stress\nthickness: 1 mm\nduration: 1 us\nmethod: adaptive\n"
    "material: {young: 72 GPa, poisson: 0.2, density: 2440 kg/m^3}\n"
    "body: [{box: {from: [0, 0], to: [20 mm, 16 mm]}}]\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "pd: {region: {disc: {centre: [10 mm, 0], radius: 5 mm}}}\n"
    "boundary: [{mirror: {axis: y, at: 0, tangential: free}}]\n";
static const char block[] =
    "name: block\nspace: solid\nduration: 1 us\nmethod: adaptive\n"
    "material: {young: 72 GPa, poisson: 0.3, density: 2440 kg/m^3}\n"
    "body: [{box: {from: [0, 0, 0], to: [12 mm, 8 mm, 6 mm]}}]\nparticles: {spacing: 1 mm, horizon: 2.015}\n"
    "pd: {region: {ball: {centre: [6 mm, 0, 3 mm], radius: 3 mm}}}\n"
    "boundary: [{mirror: {axis: y, at: 0, tangential: free}}]\n";

static void engine_from(struct run *run, struct scene *s, const char *text)
{
    if (scene_read_text(s, text, strlen(text), "points.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_int_equal(run_set_up_from_scene(run, s, NULL), OK);
}

/* ---- gradient ---------------------------------------------------------------------------------------------------- */

/* Returns component d of the displacement of the position X[dim] [m]: a rotation about z by an angle that grows with x,
 * and a random part. seed: state of the random numbers, advanced. */
static real shaken(const struct run *run, const real *X, int d, uint64_t *seed)
{
    const real angle = TURN_MOST * X[0] / 20e-3;
    const real rotation[3] = {-angle * X[1], angle * X[1], 0.5 * angle * X[1]};
    return rotation[d] + cloud_between(seed, -SHAKE, SHAKE) * run->scene->spacing;
}

static void shake(struct run *run)
{
    struct particles *p = &run->part;
    struct mesh *mesh = &run->frame->mesh;
    uint64_t seed = 5;
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX] = {0};
        particle_reference_position(p, i, X);
        for (int d = 0; d < p->dim; d++) p->x[d][i] = X[d] + shaken(run, X, d, &seed);
    }
    for (int64_t I = 0; I < mesh->grid.n && mesh->points > 0; I++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < p->dim; d++)
            X[d] = grid_node_position(&mesh->grid, d, I / mesh->grid.stride[d] % mesh->grid.count[d]);
        for (int d = 0; d < p->dim; d++) mesh->displacement[d][I] = shaken(run, X, d, &seed);
    }
}

static real energy_of(struct run *run)
{
    run_compute_internal_forces(run);
    return run->kernels.bond_energy(&run->bonds, &run->part, NULL) +
           mesh_strain(&run->frame->mesh, &run->part, run->frame->elastic, !run->scene->small_strain);
}

/* Compares the force on one component of a particle or node of the run, *force [N], with minus the derivative of the
 * energy by its coordinate *place, by central differences. scale: largest force [N]; the tolerance is 1e-6 of it. */
static void check_slope(struct run *run, real *place, const real *force, real scale)
{
    const real step = 1e-5 * run->scene->spacing, was = *place;
    *place = was + step;
    const real above = energy_of(run);
    *place = was - step;
    const real below = energy_of(run);
    *place = was;
    (void)energy_of(run);
    assert_near(-(above - below) / (2 * step), *force, 1e-6 * scale);
}

static real largest(const struct run *run)
{
    real most = 0;
    for (int64_t i = 0; i < run->part.n; i++)
        if (run->part.kind[i] == KIND_PD) most = real_max(most, fabs(run->part.f[0][i]));
    return most;
}

/* Compares forces with the energy gradient (check_slope) for every fifth unknown of particles and of nodes. Nodes on or
 * beyond a plane of symmetry, which follow others, are left out. */
static void check_gradient(struct run *run)
{
    struct particles *p = &run->part;
    struct mesh *mesh = &run->frame->mesh;
    int64_t particles = 0, nodes = 0;
    shake(run);
    (void)energy_of(run);
    const real scale = largest(run);
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim && p->kind[i] == KIND_PD; d++)
            if (++particles % 5 == 0) check_slope(run, &p->x[d][i], &p->f[d][i], scale);
    for (int64_t I = 0; I < mesh->grid.n; I++)
        for (int d = 0; d < p->dim && mesh->grid.mass[I] > 0; d++)
            if (grid_node_position(&mesh->grid, 1, I / mesh->grid.stride[1] % mesh->grid.count[1]) >
                    0.5 * run->scene->spacing &&
                ++nodes % 5 == 0)
                check_slope(run, &mesh->displacement[d][I], &mesh->grid.force[d][I], scale);
    assert_true(particles > 60 && nodes > 50);
}

/* Checks the forces of coupled bodies against the energy gradient, in 2D and 3D, for two models and both couplings.
 * Tolerance 1e-6 of the largest force: third derivative of the energy times the square of the difference step, and
 * round-off over the step. */
static void test_gradient(void **state)
{
    (void)state;
    static const char *const text[] = {plate, block}, *const model[] = {"ospd", "mospd"},
                             *const coupling[] = {"partial stress", "handshake"};
    for (int k = 0; k < 8; k++) {
        struct scene s;
        struct run e = {0};
        char whole[2048];
        snprintf(whole, sizeof whole, "%smodel: %s\ncoupling: %s\nmpm: {frame: reference}\n", text[k / 4], model[k % 2],
                 coupling[k / 2 % 2]);
        engine_from(&e, &s, whole);
        check_gradient(&e);
        run_free_memory(&e);
        scene_free(&s);
    }
}

/* ---- a point on the grid ----------------------------------------------------------------------------------------- */

/* Checks the state of the material point of row `row` (its bonds): the mean strain is the sum of those of its bonds and
 * of its own stress; its pressure and its force on the mean strain (end_pull) follow from it with the modulus A, its
 * stiffness with the modulus B. */
static void check_point(const struct run *run, int64_t row)
{
    const struct bonds *b = &run->bonds;
    const struct particles *p = &run->part;
    const int32_t i = b->particle[row];
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    const struct state_modulus *m = &b->state.modulus[0];
    const real share = p->volume0[i] / b->state.weighted[row],
               *local = run->coupling->partial.local + run->coupling->partial.index[i] * n;
    real S = 0, compliance[SYM_MAX * SYM_MAX];
    material_compliance_matrix(&run->scene->material[0], dim, compliance);
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, (int)(row % LANES));
        real y2 = 0, r = fabs(1 / bond.inverse_length);
        for (int d = 0; d < dim; d++) y2 += square(p->x[d][bond.nbr] - p->x[d][i]);
        if (bond.w != 0) S += bond.w * r * (sqrt(y2) - r) / b->state.weighted[row];
    }
    for (int c = 0; c < n; c++)
        for (int d = 0; d < n; d++) S += local[c] * (c < dim ? 1 : 2) * compliance[c * n + d] * p->stress[d][i];
    assert_near(b->state.pressure[i], m->A * S * share, 1e-12 * fabs(m->A * share));
    assert_close(p->end_pull[i], m->A * S * p->volume0[i], 1e-9);
    assert_close(b->state.spring[i], m->B * share, 1e-14);
}

/* Checks the state (check_point) of all material points with bonds of their own in the displaced body of the scene
 * `text`, whose points have random stresses. */
static void check_points(const char *text)
{
    struct scene s;
    struct run e = {0};
    char whole[2048];
    int64_t points = 0;
    uint64_t seed = 3;
    snprintf(whole, sizeof whole, "%smodel: mospd\nmpm: {frame: current}\n", text);
    engine_from(&e, &s, whole);
    shake(&e);
    for (int64_t i = 0; i < e.part.n; i++)
        for (int c = 0; c < symmetric_tensor_component_count(e.part.dim); c++)
            e.part.stress[c][i] = cloud_between(&seed, -1e9, 1e9);
    bonded_mpm_points_update_cell_strain(&e.coupling->partial, e.frame, &e.part, e.scene->material);
    families_compute_pressure_rotation_and_stiffness(&e.bonds, &e.part, &e.source);
    for (int64_t row = 0; row < e.bonds.rows; row++) {
        const int64_t i = e.bonds.particle[row];
        if (e.part.kind[i] != KIND_MPM || e.coupling->partial.index[i] < 0 ||
            !point_has_own_state_based_bonds(&e.coupling->partial, i, e.part.dim))
            continue;
        check_point(&e, row);
        points++;
    }
    assert_true(points > 40);
    run_free_memory(&e);
    scene_free(&s);
}

static void test_points(void **state)
{
    (void)state;
    check_points(plate);
    check_points(block);
}

/* ---- partial stress ---------------------------------------------------------------------------------------------- */

/* Asserts that the partial stresses a (from the site map) and b (from searches) of n points in dim dimensions are
 * bitwise equal. */
static void same_partials(const struct partial_stress *a, const struct partial_stress *b, int64_t n, int dim)
{
    const int symmetric = symmetric_tensor_component_count(dim), size = symmetric * symmetric;
    int64_t points = 0;
    for (int64_t i = 0; i < n; i++) {
        assert_int_equal(a->index[i] >= 0, b->index[i] >= 0);
        if (a->index[i] < 0) continue;
        assert_memory_equal(a->matrix + a->index[i] * size, b->matrix + b->index[i] * size,
                            (size_t)size * sizeof(real));
        assert_memory_equal(a->local + a->index[i] * symmetric, b->local + b->index[i] * symmetric,
                            (size_t)symmetric * sizeof(real));
        points++;
    }
    assert_true(points > 40);
}

/* Checks that partial stresses after a conversion in the scene `text`, made by means of the site map, are bitwise equal
 * to those from newly searched bonds. */
static void check_partials(const char *text)
{
    struct scene s;
    struct run e = {0};
    struct bonds searched;
    struct partial_stress again = {0};
    char whole[2048];
    snprintf(whole, sizeof whole, "%smodel: mospd\nmpm: {frame: current}\n", text);
    engine_from(&e, &s, whole);
    int64_t point = 0;
    while (e.part.kind[point] != KIND_MPM || e.bonds.row_of[point] < 0) point++;
    e.part.flag[point] |= FLAG_STRESSED;
    assert_true(convert_flagged_points_to_peridynamic(&e.coupling->conversion, &s.conversion, &e.part, &e.bonds,
                                                      &e.source, &e.coupling->partial, NULL, 0) > 0);
    assert_non_null(e.bonds.site_map);
    bonds_make(&searched, NULL, &e.part, &e.source);
    struct lattice_site_map *sites = searched.site_map;
    searched.site_map = NULL;
    partial_stress_compute_from_bonds(&again, &e.part, &searched, &e.source, NULL, 0);
    searched.site_map = sites;
    same_partials(&e.coupling->partial, &again, e.part.n, e.part.dim);
    partial_stress_free(&again);
    bonds_free(&searched);
    run_free_memory(&e);
    scene_free(&s);
}

static void test_partials(void **state)
{
    (void)state;
    check_partials(plate);
    check_partials(block);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gradient), cmocka_unit_test(test_points),
                                       cmocka_unit_test(test_partials)};
    threads_set_count_and_bind_to_cores(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
