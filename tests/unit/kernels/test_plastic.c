/* Tests return mappings against the conditions that define them, between spaces, and against closed forms. Also
 * compares strain energy plus plastic work in the energy balance with the work done on a point. */
#include "tests/support/near.h"

#include "tests/support/cloud.h"
#include "tests/support/law_step.h"
#include "tests/support/sets.h"
#include "kernels/mpm/stress.h"
#include "probes/diagnostics.h"

/* Tolerance: a few dozen roundings of 1.1e-16, some at stresses larger than the result. */
#define CLOSE 1e-12

/* Yield strain of these tests; with E = 1 Pa strains equal stresses. */
#define YIELD 1e-3

struct point {
    real s[SYM_MAX], a, zz, work;
};

/* A material with linear hardening: yield stress, hardening modulus, and the data of the kernels. */
struct metal {
    real yield, hardening;
    struct elastic elastic;
    struct law law;
};

static const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};

/* Returns a material of the space `space` with E = 1, Poisson's ratio `poisson` and hardening modulus `hardening`. */
static struct material material(enum space space, real poisson, real hardening)
{
    struct material m = {.young = 1,
                         .poisson = space == SPACE_LINE ? 0 : poisson,
                         .density = 1,
                         .yield_stress = YIELD,
                         .yield_tangent = hardening / (1 + hardening)};
    material_compute_derived_constants(&m, space);
    return m;
}

static struct metal constants(const struct material *m, enum space space)
{
    struct metal metal = {.yield = m->yield_stress, .hardening = m->yield_hardening};
    metal.elastic =
        (struct elastic){.c11 = m->c11, .c12 = m->c12, .shear = m->shear, .space = space, .poisson = m->poisson};
    metal.law = (struct law){.given = true, .flow = FLOW_LINEAR, .hardening = m->yield_hardening};
    flow_law_compute_derived_constants(&metal.law, m->yield_stress, m->young, m->poisson, m->shear, m->density);
    return metal;
}

static struct metal steel(enum space space, real hardening)
{
    struct material m = material(space, 0.3, hardening);
    return constants(&m, space);
}

/* Performs a step with the strain increment and rotation L[dim][dim] on the point p of the material `metal`, as in
 * g2p.h. Returns the increment of plastic strain. */
static real step(struct point *p, const struct metal *metal, const real *L)
{
    const struct elastic *m = &metal->elastic;
    const int dim = space_dim(m->space);
    real before[SYM_MAX];
    const struct elastic_points constants = {
        .c11 = points_broadcast(m->c11), .c12 = points_broadcast(m->c12), .shear = points_broadcast(m->shear)};
    row_of_points stress[SYM_MAX], gradient[DIM_MAX * DIM_MAX];
    for (int c = 0; c < dim * (dim + 1) / 2; c++) stress[c] = points_broadcast(p->s[c]);
    for (int k = 0; k < dim * dim; k++) gradient[k] = points_broadcast(L[k]);
    stress_update_and_return_strain_trace(stress, gradient, &constants, 1, dim);
    memcpy(before, p->s, sizeof before);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) p->s[c] = stress[c][0];
    return law_step(&metal->law, m->space, before, p->s, &p->a, &p->work, &p->zz);
}

/* Computes s[6], all components of the stress of point p of metal m in any space (xx yy zz xy yz zx). */
static void whole_stress(const struct point *p, const struct metal *m, real *s)
{
    memset(s, 0, SYM_MAX * sizeof *s);
    if (m->elastic.space == SPACE_SOLID)
        memcpy(s, p->s, SYM_MAX * sizeof *s);
    else
        s[0] = p->s[0];
    if (space_dim(m->elastic.space) != 2) return;
    s[1] = p->s[1], s[3] = p->s[2];
    if (m->elastic.space == SPACE_PLANE_STRAIN) s[2] = m->elastic.poisson * (s[0] + s[1]) + p->zz;
}

/* Returns the von Mises stress of s[6] (xx yy zz xy yz zx): sqrt(((xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2)/2 + 3 (xy^2
 * + yz^2 + zx^2)). */
static real equivalent(const real *s)
{
    return sqrt(0.5 * (square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) +
                3 * (square(s[3]) + square(s[4]) + square(s[5])));
}

static real equivalent_of(const struct point *p, const struct metal *m)
{
    real s[SYM_MAX];
    whole_stress(p, m, s);
    return equivalent(s);
}

/* Computes strain[6], the strain of the stress s[6] by Hooke's law in 3D, E = 1 and Poisson's ratio `poisson`. */
static void strain_of(const real *s, real poisson, real *strain)
{
    const real trace = s[0] + s[1] + s[2];
    for (int c = 0; c < SYM_MAX; c++) strain[c] = (1 + poisson) * s[c] - (c < 3 ? poisson * trace : 0);
}

/* ---- the conditions ---------------------------------------------------------------------------------------------- */

/* Checks a return mapping of metal m from the state `trial` to p with the plastic strain increment `more` >= 0: the
 * result is on the yield surface, and the strain removed from the trial state is normal to it (da dq/dsigma). Trial
 * stresses inside the surface do not change. In plane strain eps_zz does not change. */
static void check_return(const struct metal *m, const struct point *trial, const struct point *p, real more)
{
    real before[SYM_MAX], after[SYM_MAX], strain[SYM_MAX];
    whole_stress(trial, m, before);
    whole_stress(p, m, after);
    const real q = equivalent(after), q_trial = equivalent(before), size = fmax(q_trial, fabs(before[0] + before[1]));
    const real bound = m->yield + m->hardening * trial->a;
    if (q_trial <= bound) {
        assert_true(more == 0 && p->zz == trial->zz && memcmp(p->s, trial->s, sizeof p->s) == 0);
        return;
    }
    assert_true(more > 0); /* the dissipation q da is positive */
    assert_near(q, bound + m->hardening * more, CLOSE * size);
    for (int c = 0; c < SYM_MAX; c++) before[c] -= after[c];
    strain_of(before, m->elastic.poisson, strain);
    const real mean = (after[0] + after[1] + after[2]) / 3;
    /* Under a pressure of `size` the direction of a deviator q is known to their ratio in roundings. */
    const real slack = CLOSE * size + 1e-15 * size / q * more;
    const int n = symmetric_tensor_component_count(space_dim(m->elastic.space));
    static const int place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    for (int c = 0; c < n; c++) {
        const int k = place[space_dim(m->elastic.space)][c];
        const real normal = 1.5 * (after[k] - (k < 3 ? mean : 0)) / q;
        assert_near(strain[k], more * normal, slack);
    }
    if (m->elastic.space == SPACE_PLANE_STRAIN) assert_near(strain[2], more * 1.5 * (after[2] - mean) / q, slack);
}

/* Checks the return mapping (check_return) for trial stresses from inside the yield surface to a million times its
 * size, with weak and strong hardening. */
static void test_conditions(void **state)
{
    (void)state;
    static const real hardening[] = {0, 0.01, 1, 1000}, poisson[] = {-0.9, 0, 0.3, 0.49};
    uint64_t seed = 5;
    for (int s = 0; s < 4; s++)
        for (int k = 0; k < 16; k++) {
            const struct material given = material(spaces[s], poisson[k / 4], hardening[k % 4]);
            const struct metal m = constants(&given, spaces[s]);
            for (int n = 0; n < 2000; n++) {
                struct point trial = {.a = n % 2 ? cloud_between(&seed, 0, 0.01) : 0};
                const real size = YIELD * pow(10, cloud_between(&seed, -1, 6));
                for (int c = 0; c < symmetric_tensor_component_count(space_dim(spaces[s])); c++)
                    trial.s[c] = size * cloud_between(&seed, -1, 1) * pow(10, -cloud_between(&seed, 0, 3) * (n % 3));
                if (spaces[s] == SPACE_PLANE_STRAIN) trial.zz = YIELD * cloud_between(&seed, -1, 1);
                struct point p = trial;
                check_return(&m, &trial, &p, law_step(&m.law, spaces[s], NULL, p.s, &p.a, &p.work, &p.zz));
            }
        }
}

/* Checks that an unloading step after yielding is bitwise elastic for any spin. */
static void test_unloading(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int s = 0; s < 4; s++) {
        const struct metal m = steel(spaces[s], 0.1);
        struct metal never = m;
        never.law.yield = INFINITY;
        for (int n = 0; n < 100; n++) {
            const int dim = space_dim(spaces[s]);
            struct point p = {.a = 0};
            real L[DIM_MAX * DIM_MAX];
            for (int c = 0; c < dim * dim; c++) L[c] = 5 * YIELD * cloud_between(&seed, -1, 1);
            step(&p, &m, L);
            if (p.a == 0) continue;
            for (int c = 0; c < dim * dim; c++) L[c] *= -1e-2;
            struct point elastic = p;
            assert_true(step(&p, &m, L) == 0 && step(&elastic, &never, L) == 0);
            assert_memory_equal(&p, &elastic, sizeof p);
        }
    }
}

/* Checks that a stress on the yield surface that rotates without strain stays on it, with plastic flow of the size of
 * round-off. */
static void test_rotation(void **state)
{
    (void)state;
    for (int s = 1; s < 4; s++) {
        const struct metal m = steel(spaces[s], 0.1);
        struct point p = {.a = 0};
        const real pull2[] = {9e-3, 4e-3, 2e-3, -3e-3}, pull3[] = {9e-3, 4e-3, 1e-3, 2e-3, -3e-3, 2e-3, 0, 5e-3, 1e-3};
        const real spin2[] = {0, 0.02, -0.02, 0}, spin3[] = {0, 0.02, 0.01, -0.02, 0, -0.03, -0.01, 0.03, 0};
        real rotation[DIM_MAX * DIM_MAX]; /* W + W W/2: without strain */
        const bool solid = spaces[s] == SPACE_SOLID;
        assert_true(step(&p, &m, solid ? pull3 : pull2) > 0);
        const struct point start = p;
        const real q = equivalent_of(&p, &m);
        const real *W = solid ? spin3 : spin2;
        const int dim = solid ? 3 : 2;
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++) {
                rotation[a * dim + b] = W[a * dim + b];
                for (int k = 0; k < dim; k++) rotation[a * dim + b] += 0.5 * W[a * dim + k] * W[k * dim + b];
            }
        for (int n = 0; n < 100; n++) step(&p, &m, rotation);
        assert_near(equivalent_of(&p, &m), q, 100 * 1e-15 * q);
        assert_near(p.a, start.a, 100 * 1e-15);
        assert_true(fabs(p.s[0] - start.s[0]) > 0.1 * q); /* check: it rotated */
    }
}

/* Compares the rotation of a stress by a power series with R s R^T by sine and cosine, about any axis, up to and beyond
 * the limit SPIN_SERIES of the series. */
static void test_rotation_by_series(void **state)
{
    (void)state;
    static const real angle[] = {1.1e-3, 5e-3, 0.02, 0.05, 0.0624, 0.0626, 0.3};
    uint64_t seed = 8;
    for (int dim = 2; dim <= 3; dim++)
        for (size_t k = 0; k < COUNT_OF(angle); k++)
            for (int times = 0; times < 100; times++) {
                const int n = symmetric_tensor_component_count(dim);
                real s[SYM_MAX], axis[3] = {1}, size = 0;
                row_of_points turned[SYM_MAX], w[3];
                for (int c = 0; c < 3 && dim == 3; c++) axis[c] = cloud_between(&seed, -1, 1);
                for (int c = 0; c < 3; c++) size += square(axis[c]);
                for (int c = 0; c < 3; c++) axis[c] *= angle[k] / sqrt(size), w[c] = points_broadcast(axis[c]);
                for (int c = 0; c < n; c++) turned[c] = points_broadcast(s[c] = cloud_between(&seed, -1, 1));
                stress_rotate(turned, w, dim);
                if (dim == 2)
                    stress_rotate_2d(s, axis[0]);
                else
                    stress_rotate_3d(s, axis[0], axis[1], axis[2]);
                for (int c = 0; c < n; c++) assert_near(turned[c][0], s[c], 2e-15); /* some roundings of each */
            }
}

/* ---- one space against another ----------------------------------------------------------------------------------- */

/* Checks that plane strain agrees with eps_zz = 0 in 3D, along an irregular path with spin. */
static void test_plane_strain_is_solid(void **state)
{
    (void)state;
    uint64_t seed = 7;
    const struct metal flat = steel(SPACE_PLANE_STRAIN, 0.2), solid = steel(SPACE_SOLID, 0.2);
    struct point p = {.a = 0}, q = {.a = 0};
    for (int n = 0; n < 200; n++) {
        real L[4];
        for (int c = 0; c < 4; c++) L[c] = YIELD * cloud_between(&seed, -1, 1);
        const real whole[] = {L[0], L[1], 0, L[2], L[3], 0, 0, 0, 0};
        step(&p, &flat, L);
        step(&q, &solid, whole);
        real s[SYM_MAX];
        whole_stress(&p, &flat, s);
        for (int c = 0; c < SYM_MAX; c++) assert_near(s[c], q.s[c], CLOSE * YIELD);
        assert_near(p.a, q.a, CLOSE * YIELD);
    }
    assert_true(p.a > 10 * YIELD);
}

/* Performs a step of the strain increment L of the point q of metal m in 3D; eps_zz is found by bisection such that
 * sigma_zz = 0. */
static void step_free(struct point *q, const struct metal *m, const real *L)
{
    real low = -1, high = 1;
    struct point p = *q;
    for (int k = 0; k < 80; k++) {
        const real zz = 0.5 * (low + high), whole[] = {L[0], L[1], 0, L[2], L[3], 0, 0, 0, zz};
        p = *q;
        step(&p, m, whole);
        *(p.s[2] > 0 ? &high : &low) = zz;
    }
    *q = p;
}

static void test_plane_stress_is_solid(void **state)
{
    (void)state;
    uint64_t seed = 8;
    const struct metal flat = steel(SPACE_PLANE_STRESS, 0.2), solid = steel(SPACE_SOLID, 0.2);
    struct point p = {.a = 0}, q = {.a = 0};
    for (int n = 0; n < 200; n++) {
        real L[4];
        for (int c = 0; c < 4; c++) L[c] = YIELD * cloud_between(&seed, -1, 1);
        step(&p, &flat, L);
        step_free(&q, &solid, L);
        real s[SYM_MAX];
        whole_stress(&p, &flat, s);
        for (int c = 0; c < SYM_MAX; c++) assert_near(s[c], q.s[c], CLOSE * YIELD);
        assert_near(p.a, q.a, CLOSE * YIELD);
    }
    assert_true(p.a > 10 * YIELD);
}

/* ---- closed forms ------------------------------------------------------------------------------------------------ */

/* Checks a bar under cyclic load: slope E_t while yielding, else E; reverse yield at the largest previous |sigma|. */
static void test_bilinear_law(void **state)
{
    (void)state;
    const struct metal m = steel(SPACE_LINE, 1); /* E_t = 1/2 */
    struct point p = {.a = 0};
    static const struct {
        real strain, stress;
    } rotation[] = {/* in units of the yield strain and stress */
                    {1, 1}, {3, 2}, {2, 1}, {3, 2}, {5, 3}, {-1, -3}, {-3, -4}, {1, 0}, {5, 4}, {7, 5}};
    real strain = 0;
    for (size_t k = 0; k < COUNT_OF(rotation); k++) {
        const real L = (rotation[k].strain * YIELD - strain) / 50;
        for (int n = 0; n < 50; n++) step(&p, &m, &L);
        strain = rotation[k].strain * YIELD;
        assert_near(p.s[0], rotation[k].stress * YIELD, CLOSE * YIELD);
    }
    assert_near(p.a, 4 * YIELD, CLOSE * YIELD); /* H a = |sigma| - sigma_y */
}

/* Checks pure shear against the closed form in the three spaces with shear: it yields at sigma_y/sqrt(3), then d tau =
 * G H/(3 G + H) d gamma. */
static void test_pure_shear(void **state)
{
    (void)state;
    for (int s = 1; s < 4; s++) {
        const struct metal m = steel(spaces[s], 0.3);
        const real first = YIELD / sqrt(3), slope = m.elastic.shear * m.hardening / (3 * m.elastic.shear + m.hardening);
        const bool solid = spaces[s] == SPACE_SOLID;
        struct point p = {.a = 0};
        const real d = first / m.elastic.shear / 20, flat[] = {0, d / 2, d / 2, 0};
        const real whole[] = {0, d / 2, 0, d / 2, 0, 0, 0, 0, 0};
        for (int n = 1; n <= 100; n++) {
            step(&p, &m, solid ? whole : flat);
            const real expected = n <= 20 ? m.elastic.shear * d * n : first + slope * d * (n - 20);
            assert_near(p.s[solid ? 3 : 2], expected, CLOSE * YIELD);
            if (n < 20) assert_exact(p.a, 0);
            if (n > 20) assert_true(p.a > 0);
        }
    }
}

/* Checks uniaxial strain e against the closed form: q = 2 G e - 3 G a and sigma_xx = K e + 2 q/3: slope K + 4 G/3, then
 * K without hardening. */
static void test_uniaxial_strain(void **state)
{
    (void)state;
    for (int s = 2; s < 4; s++)
        for (int hard = 0; hard < 2; hard++) {
            const struct metal m = steel(spaces[s], 0.3 * hard);
            const real K = 1 / (3 * (1 - 2 * 0.3)), G = m.elastic.shear, d = -YIELD / 10;
            const real flat[] = {d, 0, 0, 0}, whole[] = {d, 0, 0, 0, 0, 0, 0, 0, 0};
            struct point p = {.a = 0};
            for (int n = 1; n <= 100; n++) {
                step(&p, &m, spaces[s] == SPACE_SOLID ? whole : flat);
                const real e = -n * d, a = fmax(0, (2 * G * e - YIELD) / (3 * G + m.hardening));
                const real q = 2 * G * e - 3 * G * a;
                assert_near(p.s[0], -K * e - 2 * q / 3, CLOSE * YIELD);
                assert_near(p.s[1], -K * e + q / 3, CLOSE * YIELD);
                assert_near(p.a, a, CLOSE * YIELD);
            }
            assert_true(p.a > YIELD);
        }
}

/* Checks a thin sheet under equibiaxial strain against the closed form: q = sigma, sigma = E/(1 - nu) (e - a/2). */
static void test_biaxial(void **state)
{
    (void)state;
    const struct metal m = steel(SPACE_PLANE_STRESS, 0.3);
    struct point p = {.a = 0};
    const real d = YIELD / 10, L[] = {d, 0, 0, d}, biaxial = 1 / (1 - 0.3);
    for (int n = 1; n <= 100; n++) {
        step(&p, &m, L);
        const real a = fmax(0, (biaxial * n * d - YIELD) / (m.hardening + 0.5 * biaxial));
        assert_near(p.s[0], biaxial * (n * d - 0.5 * a), CLOSE * YIELD);
        assert_near(p.s[1], p.s[0], CLOSE * YIELD);
        assert_near(p.a, a, CLOSE * YIELD);
    }
    assert_true(p.a > YIELD);
}

/* Checks that a thin sheet with free sides agrees with the bar: sigma = sigma_y + E_t (e - sigma_y/E). */
static void test_uniaxial_stress(void **state)
{
    (void)state;
    const struct metal m = steel(SPACE_PLANE_STRESS, 1); /* E_t = 1/2 */
    struct point p = {.a = 0};
    for (int n = 1; n <= 50; n++) {
        real low = -YIELD, high = YIELD, L[] = {YIELD / 10, 0, 0, 0};
        struct point q = p;
        for (int k = 0; k < 80; k++) {
            L[3] = 0.5 * (low + high);
            q = p;
            step(&q, &m, L);
            *(q.s[1] > 0 ? &high : &low) = L[3];
        }
        p = q;
        assert_near(p.s[0], n <= 10 ? n * YIELD / 10 : YIELD + 0.5 * (n - 10) * YIELD / 10, CLOSE * YIELD);
    }
}

/* ---- the energy balance ------------------------------------------------------------------------------------------ */

/* Returns the energy of one particle of unit volume with the state of p in the balance of `space`: strain energy plus
 * plastic work [J]. m: material; partial: partial stress of the particle. */
static real balance_energy(const struct point *p, const struct material *m, enum space space,
                           const struct partial_stress *partial)
{
    const int dim = space_dim(space);
    struct particles body;
    particles_make(&body, dim, 1, WITH_PLASTIC | (space == SPACE_PLANE_STRAIN ? WITH_OUT_OF_PLANE : 0));
    for (int c = 0; c < symmetric_tensor_component_count(dim); c++) body.stress[c][0] = p->s[c];
    body.volume[0] = body.volume0[0] = 1, body.plastic_work[0] = p->work;
    if (body.out_of_plane) body.out_of_plane[0] = p->zz;
    const real energy = points_strain_energy(&body, m, partial) + points_plastic_work(&body, m, partial);
    particles_free(&body);
    return energy;
}

/* Checks that the work of the stress along a path equals strain energy plus plastic work in the balance. The path has
 * loading and partial unloading in other proportions. The mean of the stress before and after a step leaves an error of
 * second order, below 1e-5 with 2000 steps. */
static void test_work_is_booked(void **state)
{
    (void)state;
    static const real whole[2][9] = {{4, 1, 0, 3, -2, 1, 0, 2, 1}, {-2, 1, 0, -2, 0.5, -1, 1, 0, 1}};
    for (int s = 0; s < 4; s++) {
        const int dim = space_dim(spaces[s]), n = symmetric_tensor_component_count(dim), steps = 2000;
        const struct material given = material(spaces[s], 0.3, 0.2);
        const struct metal m = constants(&given, spaces[s]);
        struct point p = {.a = 0};
        real work = 0;
        for (int k = 0; k < 2 * steps; k++) {
            real L[DIM_MAX * DIM_MAX];
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++) /* symmetric: no spin */
                    L[a * dim + b] = 0.5 * YIELD / steps * (whole[k / steps][a * 3 + b] + whole[k / steps][b * 3 + a]);
            const struct point old = p;
            step(&p, &m, L);
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++) {
                    const int c = a == b ? a : dim == 2 ? 2 : a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
                    work += 0.5 * (old.s[c] + p.s[c]) * L[a * dim + b];
                }
        }
        assert_true(p.a > 0.5 * YIELD && (spaces[s] != SPACE_PLANE_STRAIN || fabs(p.zz) > 0.05 * YIELD));
        const real energy = balance_energy(&p, &given, spaces[s], NULL);
        assert_close(energy, work, 1e-5);

        /* A point that leaves half its stress to bonds has half of both energies. */
        int32_t entry = 0;
        real half[SYM_MAX * SYM_MAX] = {0};
        for (int c = 0; c < n; c++) half[c * n + c] = 0.5;
        struct partial_stress partial = {.index = &entry, .matrix = half, .entries = 1};
        assert_close(balance_energy(&p, &given, spaces[s], &partial), 0.5 * energy, CLOSE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_conditions),
        cmocka_unit_test(test_unloading),
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_rotation_by_series),
        cmocka_unit_test(test_plane_strain_is_solid),
        cmocka_unit_test(test_plane_stress_is_solid),
        cmocka_unit_test(test_bilinear_law),
        cmocka_unit_test(test_pure_shear),
        cmocka_unit_test(test_uniaxial_strain),
        cmocka_unit_test(test_biaxial),
        cmocka_unit_test(test_uniaxial_stress),
        cmocka_unit_test(test_work_is_booked),
    };
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
