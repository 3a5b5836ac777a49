/* Tests of filling bodies: lattices, irregularity, initial state, refusals. */
#include "tests/support/same.h"

#include <omp.h>

#include "base/memory.h"
#include "scene/scene_read.h"
#include "tests/support/setting.h"
#include "scene/fill.h"

/* ---- lattices ---------------------------------------------------------------------------------------------------- */

/* Checks number, positions and volumes of the particles of a box in every space. */
static void boxes_are_filled_in_every_space(void **state)
{
    (void)state;
    const enum space space[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    const real edge[DIM_MAX] = {2, 1.5, 1}, volume[] = {0, 0.5 * 0.1, 0.25 * 0.2, 0.125};
    const int count[] = {0, 4, 12, 24};
    for (size_t k = 0; k < COUNT_OF(space); k++) {
        struct setting s;
        struct particles p;
        setting_make(&s, space[k], edge);
        s.scene.section = 0.1, s.scene.thickness = 0.2;
        int dim = s.scene.dim;
        if (dim == 1) s.scene.thickness = 77; /* each space has its own */
        if (dim == 2) s.scene.section = 77;
        if (dim == 3) s.scene.section = s.scene.thickness = 77;
        s.body[0].material = 1;
        s.body[0].velocity[dim - 1] = 3;
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, EVERYTHING));
        assert_int_equal(p.n, count[dim]);
        assert_int_equal(p.n_of[KIND_MPM], count[dim]);
        for (int i = 0; i < p.n; i++) {
            int at[DIM_MAX] = {i % 4, i / 4 % 3, i / 12};
            for (int d = 0; d < dim; d++) {
                assert_near(p.X[d][i], 0.25 + 0.5 * at[d], 1e-15);
                assert_exact(p.x[d][i], p.X[d][i]);
                assert_exact(p.v[d][i], d == dim - 1 ? 3 : 0);
                assert_exact(p.stretch[d][i], 1);
            }
            assert_close(p.volume0[i], volume[dim], 1e-15);
            assert_exact(p.volume[i], p.volume0[i]);
            assert_close(p.mass[i], 2000 * volume[dim], 1e-15);
            assert_int_equal(p.id[i], i); /* the lattice is created in sorted order */
            assert_int_equal(p.material[i], 1);
        }
        particles_free(&p);
    }
}

/* Checks the materials and masses of a plate with an inclusion that contains a region of the plate's own material. */
static void parts_are_of_their_material(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    struct solid disc = {.kind = SOLID_BALL, .centre = {1.5, 1.5}, .radius = 1};
    struct solid seed = {.kind = SOLID_BOX, .from = {1, 1}, .to = {2, 1.5}};
    struct scene_part part[] = {{{.n = 1, .solid = &disc}, 1}, {{.n = 1, .solid = &seed}, 0}};
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){3, 3});
    s.body[0].parts = 2, s.body[0].part = part;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_int_equal(p.n, 36);
    for (int64_t i = 0; i < p.n; i++) {
        const real x = p.X[0][i] - 1.5, y = p.X[1][i] - 1.5;
        const bool is_seed = fabs(x) < 0.5 && y > -0.5 && y < 0, second = x * x + y * y < 1 && !is_seed;
        assert_int_equal(p.material[i], second);
        assert_close(p.mass[i], (second ? 2000 : 1000) * p.volume0[i], 1e-15);
    }
    particles_free(&p);
}

static void method_decides_the_kind(void **state)
{
    (void)state;
    const enum method method[] = {METHOD_PD, METHOD_MPM, METHOD_ADAPTIVE};
    for (size_t k = 0; k < COUNT_OF(method); k++) {
        struct setting s;
        struct particles p;
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){2, 2});
        s.scene.method = method[k];
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        assert_int_equal(p.n_of[method[k] == METHOD_PD ? KIND_PD : KIND_MPM], 16);
        assert_null(p.stretch[0]);
        particles_free(&p);
    }
}

static bool has_particle(const struct particles *p, real x, real y)
{
    for (int64_t i = 0; i < p->n; i++)
        if (p->X[0][i] == x && p->X[1][i] == y) return true;
    return false;
}

/* Checks that a ring about the origin is filled symmetrically: the mirror image of each particle is a particle,
 * bitwise. */
static void symmetric_bodies_are_filled_symmetrically(void **state)
{
    (void)state;
    for (int parity = 0; parity < 2; parity++) {
        struct setting s;
        struct particles p;
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        real spacing = s.scene.spacing = parity ? 0.105 : 0.1; /* 20 and 19.05 particles across */
        s.solid[0][0] = (struct solid){.kind = SOLID_BALL, .radius = 1};
        s.solid[0][1] = (struct solid){.kind = SOLID_BALL, .subtract = true, .radius = 0.35};
        s.body[0].shape.n = 2;
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        int count = 0;
        for (int i = -40; i < 40; i++)
            for (int j = -40; j < 40; j++) {
                real radius = spacing * hypot(i + 0.5 - 0.5 * parity, j + 0.5 - 0.5 * parity);
                count += radius >= 0.35 - 1e-9 && radius <= 1 + 1e-9;
            }
        assert_int_equal(p.n, count);
        for (int64_t i = 0; i < p.n; i++) {
            assert_true(has_particle(&p, -p.X[0][i], p.X[1][i]));
            assert_true(has_particle(&p, p.X[0][i], -p.X[1][i]));
            assert_true(has_particle(&p, p.X[1][i], p.X[0][i]));
        }
        particles_free(&p);
    }
}

/* Checks that a layer below the plate continues the lattice of the plate, whether it is a part of the plate or a second
 * body. A body of infinite extent is refused. */
static void added_solids_continue_the_lattice(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){2.1, 1}); /* 4 columns, centred in 2.1 */
    s.solid[0][1] = (struct solid){.kind = SOLID_BOX, .from = {0, -1}, .to = {2.1, 0}};
    s.body[0].shape.n = 2;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_int_equal(p.n, 16);
    for (int i = 0; i < 16; i++) {
        assert_near(p.X[0][i], 0.3 + 0.5 * (i % 4), 1e-15);
        assert_near(p.X[1][i], -0.75 + 0.5 * (i / 4), 1e-15);
    }
    particles_free(&p);

    s.scene.bodies = 2;
    s.body[0].shape.n = 1;
    s.solid[1][0] = (struct solid){.kind = SOLID_BOX, .from = {-INFINITY, -1}, .to = {INFINITY, 0}};
    s.body[1].shape.n = 1;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "body layer: has an infinite shape");
    s.solid[1][0].from[0] = 0, s.solid[1][0].to[0] = 2.1;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_int_equal(p.n, 16);
    for (int i = 0; i < 16; i++) assert_int_equal(p.body[i], i < 8);
    for (int i = 0; i < 16; i++)
        assert_int_equal(p.id[i], (i + 8) % 16); /* the layer is created second and is first
                                                  * in order */
    particles_free(&p);
}

/* Checks that particles exactly on a surface belong to the body on each of its sides, although 0.1 has no exact binary
 * representation. */
static void particles_on_surfaces_are_kept(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 0.3});
    s.scene.spacing = 0.1;
    s.solid[0][1] = (struct solid){.kind = SOLID_BOX, .from = {-0.05, 0}, .to = {1.05, 0.3}};
    s.solid[0][2] = (struct solid){.kind = SOLID_BOX, .subtract = true, .from = {0.35, -1}, .to = {0.65, 1}};
    s.body[0].shape.n = 3;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_int_equal(p.n, 30); /* 12 columns without 0.45 and 0.55 */
    for (int i = 0; i < 10; i++) assert_near(p.X[0][i], -0.05 + 0.1 * (i < 5 ? i : i + 2), 1e-15);
    particles_free(&p);
}

static void irregularity_is_seeded_and_bounded(void **state)
{
    (void)state;
    struct setting s;
    struct particles regular, one, again, other;
    setting_make(&s, SPACE_SOLID, (real[]){5, 5, 5});
    assert_ok(bodies_fill_with_particles(&regular, &s.scene, NULL, 0));
    s.scene.irregularity = 0.4, s.scene.seed = 7;
    assert_ok(bodies_fill_with_particles(&one, &s.scene, NULL, 0));
    assert_ok(bodies_fill_with_particles(&again, &s.scene, NULL, 0));
    s.scene.seed = 8;
    assert_ok(bodies_fill_with_particles(&other, &s.scene, NULL, 0));
    int64_t n = regular.n, same = 0;
    assert_int_equal(n, 1000);
    for (int d = 0; d < 3; d++) {
        real *place = NEW("test", n, real), mean = 0, spread = 0;
        for (int64_t i = 0; i < n; i++) place[regular.id[i]] = regular.X[d][i];
        for (int64_t i = 0; i < n; i++) {
            real shift = (one.X[d][i] - place[one.id[i]]) / (0.5 * 0.4);
            assert_true(shift >= -0.5 - 1e-12 && shift < 0.5 + 1e-12);
            mean += shift / (real)n, spread += shift * shift / (real)n;
            assert_int_equal(one.id[i], again.id[i]);
            assert_exact(one.X[d][i], again.X[d][i]);
            same += one.X[d][i] == other.X[d][i];
        }
        assert_near(mean, 0, 0.04);          /* standard error of 1000 numbers: 0.009 */
        assert_near(spread, 1.0 / 12, 0.01); /* uniform: 1/12; standard error 0.0024 */
        memory_free(place);
    }
    assert_int_equal(same, 0);
    for (int64_t i = 0; i < n; i++) assert_exact(one.volume[i], 0.125);
    particles_free(&regular), particles_free(&one), particles_free(&again), particles_free(&other);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    struct setting s;
    struct particles p[2];
    setting_make(&s, SPACE_PLANE_STRAIN, (real[]){40, 30});
    s.scene.irregularity = 0.3;
    s.scene.initials = 1;
    s.initial[0].sets_strain = true;
    s.initial[0].displacement_gradient[1] = 0.01;
    for (int k = 0; k < 2; k++) {
        omp_set_num_threads(k + 1);
        assert_ok(bodies_fill_with_particles(&p[k], &s.scene, NULL, EVERYTHING));
    }
    assert_int_equal(p[0].n, 4800);
    assert_same_particles(&p[0], &p[1], EVERYTHING);
    particles_free(&p[0]), particles_free(&p[1]);
}

/* ---- initial state ----------------------------------------------------------------------------------------------- */

/* Checks that where initial entries overlap, the later one determines velocity and gradient. */
static void later_initial_entries_overwrite(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){2, 1});
    struct solid right = {.kind = SOLID_BOX, .from = {1, -9}, .to = {9, 9}};
    s.scene.initials = 3;
    s.initial[0].sets_velocity = s.initial[1].sets_velocity = s.initial[2].sets_velocity = true;
    s.initial[0].velocity[0] = 1;
    s.initial[1].region = (struct region){.n = 1, .solid = &right};
    s.initial[1].velocity[1] = 2;
    memcpy(s.initial[1].velocity_gradient, (real[]){0.5, -3, 3, 0}, 4 * sizeof(real));
    s.initial[1].centre[0] = 1;
    s.initial[2].body = 1; /* none */
    s.initial[2].velocity[0] = 99;
    s.body[0].velocity[1] = 5;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, WITH_GRADIENT));
    for (int i = 0; i < p.n; i++) {
        real x = p.X[0][i], y = p.X[1][i];
        assert_near(p.v[0][i], x > 1 ? 0.5 * (x - 1) - 3 * y : 1, 1e-15);
        assert_near(p.v[1][i], x > 1 ? 2 + 3 * (x - 1) : 0, 1e-15);
        assert_exact(p.gradient[1][i], x > 1 ? -3 : 0);
        assert_exact(p.gradient[2][i], x > 1 ? 3 : 0);
    }
    particles_free(&p);
}

/* Checks initial velocities by quadratic formulas and their gradients, for which central differences are exact. */
static void velocities_by_formulas(void **state)
{
    static const char text[] =
        "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: mpm\nmpm: {transfer: apic}\n"
        "material: {young: 3 GPa, poisson: 0.3, density: 1180}\n"
        "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 2 mm}\n"
        "initial: [{velocity: [\"11 1/s * x * (1 + y / (3 mm))\", \"-7 1/s * y * y / (2 mm)\"],\n"
        "           velocity_gradient: [13, -5, 3, 17], centre: [1.7 mm, 0.6 mm]}]\n";
    struct scene s;
    struct particles p;
    (void)state;
    if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(bodies_fill_with_particles(&p, &s, NULL, WITH_GRADIENT));
    assert_int_equal(p.n, 12);
    for (int64_t i = 0; i < p.n; i++) {
        const real x = p.X[0][i], y = p.X[1][i], dx = x - 1.7e-3, dy = y - 0.6e-3;
        assert_near(p.v[0][i], 11 * x * (1 + y / 3e-3) + 13 * dx - 5 * dy, 1e-14);
        assert_near(p.v[1][i], -7 * y * y / 2e-3 + 3 * dx + 17 * dy, 1e-14);
        assert_near(p.gradient[0][i], 13 + 11 * (1 + y / 3e-3), 1e-11); /* round-off over a spacing */
        assert_near(p.gradient[1][i], -5 + 11 * x / 3e-3, 1e-11);
        assert_near(p.gradient[2][i], 3, 1e-11);
        assert_near(p.gradient[3][i], 17 - 7 * y / 1e-3, 1e-11);
    }
    particles_free(&p);
    scene_free(&s);
}

/* Compares stress, position, volume and stretch under a uniform displacement gradient with Hooke's law. */
static void initial_strain_is_hooke(void **state)
{
    (void)state;
    const real H[DIM_MAX][DIM_MAX] = {{1e-3, 2e-4, -5e-4}, {6e-4, -2e-3, 3e-4}, {1e-4, 7e-4, 5e-4}};
    const enum space space[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(space); k++) {
        struct setting s;
        struct particles p;
        setting_make(&s, space[k], (real[]){1, 1, 1});
        int dim = s.scene.dim;
        s.scene.initials = 1;
        s.initial[0].sets_strain = true;
        s.initial[0].centre[0] = 0.5;
        real trace = 0;
        for (int a = 0; a < dim; a++) {
            trace += H[a][a];
            for (int b = 0; b < dim; b++) s.initial[0].displacement_gradient[a * dim + b] = H[a][b];
        }
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, WITH_STRETCH));
        const struct material *m = &s.material[0];
        const int pair[SYM_MAX][2] = {{0, 1}, {1, 2}, {2, 0}};
        for (int i = 0; i < p.n; i++) {
            for (int a = 0; a < dim; a++) {
                real moved = 0;
                for (int b = 0; b < dim; b++) moved += H[a][b] * (p.X[b][i] - (b == 0 ? 0.5 : 0));
                assert_near(p.x[a][i], p.X[a][i] + moved, 1e-15);
                assert_close(p.stretch[a][i], 1 + H[a][a], 1e-15);
                /* c12 tr eps + 2 G eps; in 1D c11 only. */
                real want = dim == 1 ? m->young * H[0][0] : m->c12 * trace + (m->c11 - m->c12) * H[a][a];
                assert_near(p.stress[a][i], want, 1e-6); /* relative to 1e6 Pa */
            }
            for (int c = dim; c < symmetric_tensor_component_count(dim); c++) {
                const int *ab = pair[c - dim];
                assert_near(p.stress[c][i], m->shear * (H[ab[0]][ab[1]] + H[ab[1]][ab[0]]), 1e-6);
            }
            assert_close(p.volume[i], p.volume0[i] * (1 + trace), 1e-15);
        }
        particles_free(&p);
    }
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Checks the messages for bodies that cannot be filled: without a particle, with too many, without bounds or spacing,
 * overlapping, or with a displacement gradient that inverts them. */
static void bad_bodies_are_refused(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 0.2}); /* 0.4 of a spacing thick */
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "body plate: contains no particle");
    s.solid[0][0].to[1] = 1e300;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "body plate: is too large for particles.spacing");
    s.solid[0][0].to[0] = s.solid[0][0].to[1] = 2e8; /* 1.6e17 positions */
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "body plate: is too large for particles.spacing");
    s.solid[0][0].to[0] = s.solid[0][0].to[1] = 1;
    s.body[0].shape.n = 0;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "body plate: has an infinite shape");
    s.body[0].shape.n = 1;
    s.scene.spacing = 0;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "particles.spacing is missing: a shape is filled with particles at this distance; add it");
    s.scene.spacing = 0.5;
    s.scene.bodies = 2;
    s.solid[1][0] = s.solid[0][0]; /* the same position twice */
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "both have a particle at (");
    s.scene.bodies = 1;
    s.scene.initials = 1;
    s.initial[0].sets_strain = true;
    s.initial[0].displacement_gradient[0] = -1.5;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "inside out");
    s.initial[0].displacement_gradient[s.scene.dim + 1] = 3; /* lateral stretch of 4 */
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "inside out");
    s.scene.bodies = 0;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "the scene has no body");
}

/* Checks longitudinal and transverse pulses: velocity from the given form, displacement from its integral. The stress
 * on planes across the direction is -rho c v with the longitudinal or transverse wave speed c. Longitudinal pulses
 * change the volume by -v/c. */
static void pulses_are_waves(void **state)
{
    (void)state;
    static const char *const across[] = {"", ", polarisation: [-4, 3]"};
    const real E = 3e9, nu = 0.3, rho = 1180, n[] = {0.6, 0.8};
    for (int k = 0; k < 2; k++) {
        char text[600];
        struct scene s;
        struct particles p;
        snprintf(text, sizeof text,
                 "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: mpm\n"
                 "material: {young: 3 GPa, poisson: 0.3, density: 1180}\n"
                 "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 1 mm}\n"
                 "initial: [{pulse: {at: [3 mm, 2 mm], direction: [3, 4], width: 9 mm, velocity: 2 m/s%s}}]\n",
                 across[k]);
        if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
        assert_ok(bodies_fill_with_particles(&p, &s, NULL, EVERYTHING));
        const real c = sqrt((k ? 0.5 / (1 + nu) : (1 - nu) / ((1 + nu) * (1 - 2 * nu))) * E / rho);
        const real along[] = {k ? -0.8 : 0.6, k ? 0.6 : 0.8};
        for (int64_t i = 0; i < p.n; i++) {
            const real xi = (n[0] * (p.X[0][i] - 3e-3) + n[1] * (p.X[1][i] - 2e-3)) / 2.25e-3, v = 2 * exp(-xi * xi);
            const real xx = p.stress[0][i], yy = p.stress[1][i], xy = p.stress[2][i];
            const real traction[] = {xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]};
            for (int d = 0; d < 2; d++) {
                assert_near(p.v[d][i], v * along[d], 1e-12);
                assert_near(traction[d], -rho * c * v * along[d], 1e-9 * rho * c);
                assert_near(p.x[d][i] - p.X[d][i], 2 / c * 2.25e-3 * 0.5 * sqrt(M_PI) * erfc(xi) * along[d], 1e-15);
                assert_near(p.stretch[d][i], 1 - v / c * n[d] * along[d], 1e-15);
            }
            assert_near(p.volume[i] / p.volume0[i] - 1, k ? 0 : -v / c, 1e-15);
        }
        particles_free(&p);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_are_filled_in_every_space),
        cmocka_unit_test(parts_are_of_their_material),
        cmocka_unit_test(method_decides_the_kind),
        cmocka_unit_test(symmetric_bodies_are_filled_symmetrically),
        cmocka_unit_test(added_solids_continue_the_lattice),
        cmocka_unit_test(particles_on_surfaces_are_kept),
        cmocka_unit_test(irregularity_is_seeded_and_bounded),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(later_initial_entries_overwrite),
        cmocka_unit_test(velocities_by_formulas),
        cmocka_unit_test(initial_strain_is_hooke),
        cmocka_unit_test(pulses_are_waves),
        cmocka_unit_test(bad_bodies_are_refused),
    };
    omp_set_num_threads(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
