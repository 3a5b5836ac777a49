/* Weight factors of bonds near faces (surface_fit.c). They minimise the functional that surface_fit.c states, evaluated
 * here bond by bond; they are symmetric, also in mirrors; and a bent body has the energy of a beam. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <math.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "base/team.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "loads/mirrors.h"
#include "src/bonds/surface_parts.h"

enum { STRAINS = 6 };

/* ---- the functional, from its definition ------------------------------------------------------------------------- */

/* A body, the areas and moments that its faces require, and the factor of each bond: factor[t n + k] for particle t
 * near a face and the offset k to its neighbour. */
struct plain {
    struct particle_cloud cloud;
    struct particles_near_faces body;
    struct surface_fit_targets faces;
    real *factor, alpha, prior, full[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX];
    real strain[STRAINS][DIM_MAX][DIM_MAX];
    int dim, strains;
};

#define FOR4(dim)                                                                                                      \
    for (int a = 0; a < (dim); a++)                                                                                    \
        for (int b = 0; b < (dim); b++)                                                                                \
            for (int c = 0; c < (dim); c++)                                                                            \
                for (int d = 0; d < (dim); d++)

/* Returns x . P x for the particle t of s, with P^-1 = 1 + 1000 Q, by Gaussian elimination. x: one number for each
 * basis strain; Q: scalar products of the tractions on the faces near the particle under pairs of basis strains. */
static real weighed(const struct plain *s, int64_t t, const real *x)
{
    real m[STRAINS][STRAINS + 1], sum = 0;
    for (int k = 0; k < s->strains; k++) {
        for (int l = 0; l < s->strains; l++) {
            real traction = 0, first[DIM_MAX][DIM_MAX] = {{0}}, second[DIM_MAX][DIM_MAX] = {{0}};
            FOR4(s->dim) first[a][b] += s->full[a][b][c][d] * s->strain[k][c][d];
            FOR4(s->dim) second[a][b] += s->full[a][b][c][d] * s->strain[l][c][d];
            for (int a = 0; a < s->dim; a++)
                for (int b = 0; b < s->dim; b++)
                    for (int c = 0; c < s->dim; c++) traction += first[a][b] * s->faces.normal2[t][b][c] * second[a][c];
            m[k][l] = (k == l) + 1000 * traction;
        }
        m[k][s->strains] = x[k];
    }
    for (int k = 0; k < s->strains; k++)
        for (int r = k + 1; r < s->strains; r++) {
            const real factor = m[r][k] / m[k][k];
            for (int c = k; c <= s->strains; c++) m[r][c] -= factor * m[k][c];
        }
    for (int k = 0; k < s->strains; k++) sum += square(m[k][s->strains]) / m[k][k]; /* of L^-1 x, D^-1 */
    return sum;
}

/* Returns the part of the functional for the particle t of s: sum_k (T:B_k) P (T:B_k) for the difference `fourth` of
 * fourth moments, plus sum_p (n_p.T) P (n_p.T) for the difference `third` of third moments. B_k: basis strains; n_p:
 * axes; P: as in weighed. */
static real squares(const struct plain *s, int64_t t, real (*fourth)[DIM_MAX][DIM_MAX][DIM_MAX],
                    real (*third)[DIM_MAX][DIM_MAX])
{
    real sum = 0;
    for (int k = 0; k < s->strains; k++) {
        real x[STRAINS] = {0};
        for (int l = 0; l < s->strains; l++)
            FOR4(s->dim) x[l] += s->strain[k][a][b] * fourth[a][b][c][d] * s->strain[l][c][d];
        sum += weighed(s, t, x);
    }
    for (int p = 0; p < s->dim; p++) {
        real x[STRAINS] = {0};
        for (int l = 0; l < s->strains; l++)
            for (int a = 0; a < s->dim; a++)
                for (int b = 0; b < s->dim; b++) x[l] += third[p][a][b] * s->strain[l][a][b];
        sum += weighed(s, t, x);
    }
    return sum;
}

/* Adds the moments of the bond with the offset k of s, times `factor`, to fourth and third moments, normalised by the
 * whole family. */
static void add_bond(const struct plain *s, int k, real factor, real (*fourth)[DIM_MAX][DIM_MAX][DIM_MAX],
                     real (*third)[DIM_MAX][DIM_MAX])
{
    const struct offsets *o = &s->body.offset;
    const real *n = o->direction[k];
    real whole = 0;
    for (int q = 0; q < o->n; q++) whole += o->weight[q] * o->length[q] * pow(o->direction[q][0], 4);
    FOR4(s->dim) fourth[a][b][c][d] += factor * o->weight[k] * o->length[k] * n[a] * n[b] * n[c] * n[d] / whole;
    for (int a = 0; a < s->dim; a++)
        for (int b = 0; b < s->dim; b++)
            for (int c = 0; c < s->dim; c++) third[a][b][c] += factor * o->weight[k] * n[a] * n[b] * n[c] / whole;
}

static bool may_change(const struct plain *s, int64_t t, int k)
{
    const int32_t j = particles_near_faces_neighbour_at_offset(&s->body, t, k);
    return j >= 0 && !(s->body.whole[s->body.particle[t]] && s->body.whole[j]);
}

static real objective(const struct plain *s)
{
    const struct particles_near_faces *near = &s->body;
    real sum = 0;
    for (int64_t t = 0; t < near->n; t++) {
        real fourth[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX] = {{{{0}}}}, third[DIM_MAX][DIM_MAX][DIM_MAX] = {{{0}}};
        for (int k = 0; k < near->offset.n; k++) {
            if (particles_near_faces_neighbour_at_offset(near, t, k) < 0) continue;
            const real f = s->factor[t * near->offset.n + k];
            add_bond(s, k, f, fourth, third);
            if (may_change(s, t, k)) sum += 0.5 * s->prior * square(f - 1);
        }
        FOR4(s->dim) fourth[a][b][c][d] -= (1 + s->alpha * s->faces.dipole[t]) * s->full[a][b][c][d];
        FOR4(s->dim) third[a][b][c] += 0.5 * s->full[a][b][c][d] * s->faces.area[t][d];
        sum += squares(s, t, fourth, third);
    }
    return sum;
}

static void plain_make(struct plain *s, const struct cloud_plan *plan)
{
    *s = (struct plain){.dim = space_dim(plan->space)};
    particle_cloud_make(&s->cloud, plan);
    cloud_exact(&s->cloud);
    cloud_source(&s->cloud);
    int64_t apart[2];
    assert_int_equal(particles_near_faces_list_with_neighbours(&s->body, &s->cloud.p, &s->cloud.source, apart), OK);
    surface_fit_targets_compute_areas_and_moments(&s->faces, &s->body, false);
    const struct offsets *o = &s->body.offset;
    real third[DIM_MAX][DIM_MAX][DIM_MAX] = {{{0}}}, bonds = 0, squared = 0;
    for (int k = 0; k < o->n; k++) add_bond(s, k, 1, s->full, third);
    for (int a = 0; a < s->dim; a++) s->strain[s->strains++][a][a] = 1;
    for (int a = 0; a < s->dim; a++)
        for (int c = a + 1; c < s->dim; c++, s->strains++)
            s->strain[s->strains][a][c] = s->strain[s->strains][c][a] = sqrt(0.5);
    s->alpha = 1.0 / 24;
    real across = s->full[0][0][1][1] / (s->full[0][0][0][0] + (s->dim - 2) * s->full[0][0][1][1]), weight = 0, d2 = 0;
    for (int k = 0; k < o->n; k++) {
        const real e = square(o->direction[k][0]) - across * (1 - square(o->direction[k][0]));
        weight += o->weight[k] * o->length[k] * e * e, d2 += o->weight[k] * o->length[k] * e * e * square(o->at[k][1]);
    }
    s->alpha += d2 / weight / 8;
    s->factor = NEW("test.factor", s->body.n * o->n, real);
    for (int64_t t = 0; t < s->body.n; t++)
        for (int k = 0; k < o->n; k++) {
            real one4[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX] = {{{{0}}}}, one3[DIM_MAX][DIM_MAX][DIM_MAX] = {{{0}}};
            if (!may_change(s, t, k)) continue;
            add_bond(s, k, 1, one4, one3);
            squared += squares(s, t, one4, one3), bonds += 0.5;
        }
    s->prior = 2e-2 * squared / bonds;
    for (int64_t t = 0; t < s->body.n; t++)
        for (int k = 0; k < o->n; k++) {
            real xi[DIM_MAX];
            for (int d = 0; d < DIM_MAX; d++) xi[d] = o->at[k][d] * CLOUD_SPACING;
            s->factor[t * o->n + k] = surface_correction_bond_weight_factor(&s->cloud.surface, s->body.particle[t], xi);
        }
}

static void plain_free(struct plain *s)
{
    surface_fit_targets_free(&s->faces);
    particles_near_faces_free(&s->body);
    memory_free(s->factor);
    particle_cloud_free(&s->cloud);
}

/* Returns the derivative of the functional of s by the factor of the bond with the offset k of particle t, by a central
 * difference. The factor is changed at both ends of the bond. */
static real slope(struct plain *s, int64_t t, int k)
{
    const int n = s->body.offset.n;
    real *one = &s->factor[t * n + k];
    real *other = &s->factor[s->body.place[particles_near_faces_neighbour_at_offset(&s->body, t, k)] * n + n - 1 - k];
    const real was = *one, step = 1e-4;
    assert_true(*one == *other);
    *one = *other = was + step;
    const real more = objective(s);
    *one = *other = was - step;
    const real less = objective(s);
    *one = *other = was;
    return (more - less) / (2 * step);
}

static void check_least(const struct cloud_plan *plan)
{
    struct plain s;
    uint64_t seed = 7;
    real largest = 0;
    int bound = 0, free = 0;
    plain_make(&s, plan);
    const int n = s.body.offset.n;
    for (int64_t k = 0; k < s.body.n * n; k++) largest = fmax(largest, s.prior * fabs(s.factor[k] - 1));
    for (int tried = 0; tried < 60;) {
        const int64_t t = (int64_t)(cloud_random(&seed) * (real)s.body.n);
        const int k = (int)(cloud_random(&seed) * n);
        if (!may_change(&s, t, k)) continue;
        const real f = s.factor[t * n + k], g = slope(&s, t, k);
        tried++;
        assert_true(f >= 0.2 && f <= 3);
        if (f > 0.2 * (1 + 1e-12) && f < 3 * (1 - 1e-12)) {
            if (!(fabs(g) <= 1e-6 * largest)) fail_msg("slope %g of %g", g, largest);
            free++;
        } else
            assert_true(f < 1 ? g >= 0 : g <= 0), bound++;
    }
    assert_true(free > 0);
    plain_free(&s);
}

/* Checks that the fitted factors minimise the functional within their limits of 0.2 and 3: slopes vanish to 1e-6, or
 * point outwards at a limit. The bodies are so small that no two particles have equal surroundings except in mirrors,
 * so that bonds that share one factor impose no further constraint. */
static void factors_are_least(void **state)
{
    (void)state;
    check_least(&(struct cloud_plan){.space = SPACE_PLANE_STRESS,
                                     .count = {11, 7},
                                     .horizon = 3.015,
                                     .surface = SURFACE_MOMENTS,
                                     .shells = SHELLS_ISOTROPIC});
    check_least(&(struct cloud_plan){
        .space = SPACE_PLANE_STRAIN, .count = {9, 8}, .horizon = 2.015, .surface = SURFACE_MOMENTS});
    check_least(
        &(struct cloud_plan){.space = SPACE_SOLID, .count = {6, 5, 7}, .horizon = 2.015, .surface = SURFACE_MOMENTS});
}

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* Checks the areas of faces along a row of particles across a plate, far from its other sides. Their moment shows that
 * both faces are half a spacing beyond the outer particles. Expected weight of a face at a depth of 0 to 2 particles:
 * the ratio of the sum of 1 - r/4 over the bonds that reach the face to that of an outer particle, 1 + 2 (3/4 + 1/2),
 * to the third power. */
static void faces_are_at_their_places(void **state)
{
    (void)state;
    enum { WIDE = 11, HIGH = 19 };
    const struct cloud_plan plan = {
        .space = SPACE_PLANE_STRESS, .count = {WIDE, HIGH}, .horizon = 2.015, .surface = SURFACE_MOMENTS};
    const real seen[] = {1, (0.75 + 2 * (1 - sqrt(2) / 4)) / 3.5, 0.5 / 3.5};
    struct plain s;
    real sum = 0, moment = 0;
    plain_make(&s, &plan);
    for (int k = 0; k < WIDE; k++) {
        const int64_t t = s.body.place[HIGH / 2 * WIDE + k];
        const int deep = k < WIDE / 2 ? k : WIDE - 1 - k;
        if (t < 0) continue;
        sum += s.faces.area[t][0], moment += s.faces.area[t][0] * (k + 0.5);
        if (deep < 3 && !(fabs(s.faces.normal2[t][0][0] - pow(seen[deep], 3)) < 1e-9))
            fail_msg("%d deep: %g", deep, s.faces.normal2[t][0][0]);
    }
    if (!(fabs(sum) < 1e-9 && fabs(moment - WIDE) < 1e-9)) fail_msg("areas %g, their moment %g", sum, moment);
    plain_free(&s);
}

/* ---- energy ------------------------------------------------------------------------------------------------------ */

/* Returns the energy of a beam of `length` x `layers` particles bent with the curvature k, divided by E I k^2/2 [m]: u
 * = k (x y, -(x^2 + nu y^2 - nu z^2)/2, -nu y z), which leaves all faces but the ends free. The difference of two
 * lengths is free of the energy of the ends. space: plane stress or solid; surface: rule of the weights near faces. */
static real bending_energy(enum space space, enum surface_rule surface, int length, int layers)
{
    const real curvature = 1e-3;
    struct cloud_plan plan = {.space = space,
                              .count = {length, layers, layers},
                              .horizon = 3.015,
                              .surface = surface,
                              .shells = SHELLS_ISOTROPIC};
    struct particle_cloud c;
    particle_cloud_make(&c, &plan);
    cloud_exact(&c);
    cloud_bonds(&c);
    struct particles *p = &c.p;
    const real nu = bond_based_poisson_ratio(space);
    for (int64_t i = 0; i < p->n; i++) {
        const real x = p->X[0][i] - 0.5 * length * CLOUD_SPACING, y = p->X[1][i] - 0.5 * layers * CLOUD_SPACING;
        const real z = p->dim > 2 ? p->X[2][i] - 0.5 * layers * CLOUD_SPACING : 0;
        const real u[] = {x * y, -0.5 * (x * x + nu * y * y - nu * z * z), -nu * y * z};
        for (int d = 0; d < p->dim; d++) p->x[d][i] = p->X[d][i] + curvature * u[d];
    }
    const real energy = bond_energy_table[p->dim][PD_BOND](&c.bonds, p, NULL);
    const real width = p->dim > 2 ? layers * CLOUD_SPACING : c.source.family.section;
    const real inertia = width * pow(layers * CLOUD_SPACING, 3) / 12;
    const real unit = 0.5 * c.material[0].young * inertia * square(curvature);
    particle_cloud_free(&c);
    return energy / unit;
}

static void bending_has_the_energy_of_a_beam(void **state)
{
    (void)state;
    static const struct {
        enum space space;
        int layers;
        real without, with;
    } body[] = {
        {SPACE_PLANE_STRESS, 10, 0.88, 0.01}, {SPACE_PLANE_STRESS, 20, 0.95, 0.005}, {SPACE_SOLID, 10, 0.82, 0.02}};
    for (size_t k = 0; k < COUNT_OF(body); k++) {
        const int length = 24, longer = 34;
        real stiffness[SURFACE_MOMENTS + 1];
        for (int rule = SURFACE_NONE; rule <= SURFACE_MOMENTS; rule += SURFACE_MOMENTS)
            stiffness[rule] = (bending_energy(body[k].space, (enum surface_rule)rule, longer, body[k].layers) -
                               bending_energy(body[k].space, (enum surface_rule)rule, length, body[k].layers)) /
                              ((longer - length) * CLOUD_SPACING);
        if (!(fabs(stiffness[SURFACE_MOMENTS] - 1) < body[k].with && stiffness[SURFACE_NONE] < body[k].without))
            fail_msg("body %zu: stiffness %g, without weights %g", k, stiffness[SURFACE_MOMENTS],
                     stiffness[SURFACE_NONE]);
    }
}

/* ---- mirrors ----------------------------------------------------------------------------------------------------- */

/* A plane of symmetry at x = 0. */
static const struct boundary mirror[] = {{.name = "left", .kind = BOUNDARY_MIRROR, .body = -1, .axis = 0, .at = 0}};

/* Checks that half of a body beside a mirror has the weight factors of the whole body, to 1e-7. */
static void half_is_as_the_whole(void **state)
{
    (void)state;
    struct cloud_plan plan = {
        .space = SPACE_PLANE_STRESS, .count = {14, 9}, .horizon = 3.015, .surface = SURFACE_MOMENTS};
    struct particle_cloud whole, half;
    struct loads loads = {0};
    particle_cloud_make(&whole, &plan);
    for (int64_t i = 0; i < whole.p.n; i++) whole.p.X[0][i] -= 7 * CLOUD_SPACING;
    plan.count[0] = 7;
    particle_cloud_make(&half, &plan);
    assert_int_equal(
        loads_make_from_boundaries(&loads, mirror, 1, &half.p, CLOUD_SPACING, half.source.family.cutoff, 0), OK);
    loads_update_mirror_images_of_particles(&loads, &half.p);
    half.source.image = loads.image;
    cloud_source(&whole);
    cloud_source(&half);
    for (int64_t i = 0; i < half.p.n; i++)
        for (int x = -3; x <= 3; x++)
            for (int y = -3; y <= 3; y++) {
                const real xi[DIM_MAX] = {x * CLOUD_SPACING, y * CLOUD_SPACING, 0};
                const real one = surface_correction_bond_weight_factor(&half.surface, i, xi);
                const real other = surface_correction_bond_weight_factor(&whole.surface, i / 7 * 14 + 7 + i % 7, xi);
                if (!(fabs(one - other) <= 1e-7)) fail_msg("particle %d, %d %d: %g, %g", (int)i, x, y, one, other);
            }
    loads_free(&loads);
    particle_cloud_free(&whole);
    particle_cloud_free(&half);
}

/* Checks that the returned residual of the fit shows whether its solver has converged: below 1e-12 with
 * SURFACE_PRODUCTS matrix products, above 1e-6 with three. */
static void residual_is_told(void **state)
{
    (void)state;
    const struct cloud_plan plan = {
        .space = SPACE_PLANE_STRESS, .count = {12, 7}, .horizon = 3.015, .surface = SURFACE_MOMENTS};
    struct plain s;
    struct bond_classes a;
    plain_make(&s, &plan);
    bond_classes_group_bonds_near_faces(&a, &s.body);
    real *factor = NEW("test.factors", a.groups, real);
    assert_true(surface_fit_compute_bond_weight_factors(factor, &s.body, &s.faces, &a, false, SURFACE_PRODUCTS) <
                1e-12);
    const real left = surface_fit_compute_bond_weight_factors(factor, &s.body, &s.faces, &a, false, 3);
    if (!(left > 1e-6 && left < 1)) fail_msg("%g", left);
    memory_free(factor);
    bond_classes_free(&a);
    plain_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(factors_are_least), cmocka_unit_test(faces_are_at_their_places),
                                       cmocka_unit_test(bending_has_the_energy_of_a_beam),
                                       cmocka_unit_test(half_is_as_the_whole), cmocka_unit_test(residual_is_told)};
    threads_set_count_and_bind_to_cores(0);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
