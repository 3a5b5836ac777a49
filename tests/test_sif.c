/* floor 5: tests of stress-intensity factors: crack-tip fields, the integral from exact fields and from particles,
 * gradients on clouds. */
#include <math.h>
#include <stdlib.h>

#include "cloud.h"
#include "near.h"
#include "sif.h"

static const real pi = 3.14159265358979323846;

/* Soda-lime glass of Imachi et al. 2019. */
static struct crack_medium glass(enum space space)
{
    struct material m = {.young = 75.629e9, .poisson = 0.286, .density = 2456};
    material_derive(&m, space);
    return crack_medium_of(&m, space);
}

/* ---- fields ------------------------------------------------------------------------------------------------ */

/* Largest entry of the difference of two states over the largest of the second, gradients and stresses apart. */
static real state_difference(const struct crack_state *a, const struct crack_state *b)
{
    real d[2] = {0}, size[2] = {0};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            d[0] = real_max(d[0], fabs(a->gradient[i][j] - b->gradient[i][j]));
            d[1] = real_max(d[1], fabs(a->stress[i][j] - b->stress[i][j]));
            size[0] = real_max(size[0], fabs(b->gradient[i][j])), size[1] = real_max(size[1], fabs(b->stress[i][j]));
        }
    return real_max(d[0] / size[0], d[1] / size[1]);
}

/* Gradients are those of the displacements; stresses balance and leave the faces free; sqrt(2 pi r) sigma = 1 ahead. */
static void field_is_a_solution(const struct crack_medium *m, enum crack_mode mode, real v)
{
    const real e = 1e-5;
    struct crack_field here, to[2][2], face;
    for (int k = 0; k < 7; k++) {
        const real theta = 0.9 * pi * (k - 3) / 3.0, x[2] = {2 * cos(theta), 2 * sin(theta)};
        crack_field(m, mode, v, x, &here);
        for (int j = 0; j < 2; j++)
            for (int side = 0; side < 2; side++) {
                real y[2] = {x[0], x[1]};
                y[j] += side ? e : -e;
                crack_field(m, mode, v, y, &to[j][side]);
            }
        const real size = fabs(here.state.gradient[0][0]) + fabs(here.state.gradient[1][0]);
        for (int i = 0; i < 2; i++) {
            real balance = -m->density * here.state.acceleration[i];
            for (int j = 0; j < 2; j++) {
                balance += (to[j][1].state.stress[i][j] - to[j][0].state.stress[i][j]) / (2 * e);
                assert_near((to[j][1].displacement[i] - to[j][0].displacement[i]) / (2 * e), here.state.gradient[i][j],
                            1e-8 * size);
            }
            assert_near(balance, 0, 1e-8);                /* of stresses of 0.3 Pa; differences cost half the digits */
            assert_near((to[0][1].state.velocity[i] - to[0][0].state.velocity[i]) / (2 * e), here.state.velocity_along[i],
                        1e-8 * size * (v + 1));
        }
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        crack_field(m, mode, v, (real[2]){-2, copysign(0, sign)}, &face);
        assert_near(face.state.stress[0][1], 0, 1e-12);
        assert_near(face.state.stress[1][1], 0, 1e-12);
    }
    crack_field(m, mode, v, (real[2]){2, 0}, &here);
    assert_near(here.state.stress[mode == MODE_I ? 1 : 0][1] * sqrt(2 * pi * 2), 1, 1e-12);
}

static void fields_solve_the_equations_of_motion(void **state)
{
    (void)state;
    for (int thin = 0; thin < 2; thin++) {
        const struct crack_medium m = glass(thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN);
        for (int mode = 0; mode < MODES; mode++)
            for (int k = 0; k < 4; k++) field_is_a_solution(&m, mode, 900.0 * k);
    }
}

/* The moving field tends to that at rest as (v/c_s)^2; at the seam the two differ by less than 2e-4. */
static void fields_meet_at_low_speed(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRAIN);
    struct crack_field rest, moving;
    for (int mode = 0; mode < MODES; mode++)
        for (int k = 0; k < 5; k++) {
            const real theta = 0.45 * pi * (k - 2), x[2] = {cos(theta), sin(theta)};
            crack_field(&m, mode, 0, x, &rest);
            crack_field_moving(&m, mode, 0.01 * m.shear_speed, x, &moving);
            assert_true(state_difference(&moving.state, &rest.state) < 2e-4);
            crack_field_moving(&m, mode, 0.1 * m.shear_speed, x, &moving);
            assert_true(state_difference(&moving.state, &rest.state) > 1e-3);
        }
}

static void numbers_of_the_glass_at_a_kilometre_per_second(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRAIN);
    assert_near(m.longitudinal, 6320.3, 0.05);
    assert_near(m.shear_speed, 3460.1, 0.05);
    assert_near(m.rayleigh, 3201.4, 0.05);
    assert_near(crack_universal(&m, MODE_I, 1000), 1.06758, 5e-6);
    assert_near(crack_universal(&m, MODE_II, 1000), 1.03506, 5e-6);
    assert_near(crack_speed_factor(&m, SPEED_EXACT, 1000), 0.8022, 5e-5);
    assert_near(crack_speed_factor(&m, SPEED_APPROXIMATE, 1000), 0.7495, 5e-5);
    assert_close(crack_speed_factor(&m, SPEED_ROSE, 1000), crack_speed_factor(&m, SPEED_EXACT, 1000), 0.005);
    for (int form = 0; form < 3; form++) {
        assert_near(crack_speed_factor(&m, form, 0), 1, 1e-14);
        assert_near(crack_speed_factor(&m, form, m.rayleigh), 0, 1e-6);
    }
    for (int mode = 0; mode < MODES; mode++) assert_near(crack_universal(&m, mode, 0.0101 * m.shear_speed), 1, 1e-4);
    /* K_I/(sigma_0 sqrt(pi a)), a = 12 mm, 9 us after the load, the wave having come 20 mm */
    const real arrival = 0.02 / m.longitudinal;
    assert_near(arrival, 3.164e-6, 1e-9);
    assert_near(crack_suddenly_loaded(&m, 1, 9e-6 - arrival) / sqrt(pi * 0.012), 1.0226, 1e-4);
    assert_exact(crack_suddenly_loaded(&m, 1, -1e-6), 0);
}

static void constants_of_the_medium(void **state)
{
    (void)state;
    const struct crack_medium thin = glass(SPACE_PLANE_STRESS), thick = glass(SPACE_PLANE_STRAIN);
    for (int k = 0; k < 2; k++) {        /* 8 G/E* = kappa + 1 in both */
        const struct crack_medium *m = k ? &thick : &thin;
        assert_close(8 * m->shear / m->modulus, m->kappa + 1, 1e-14);
        assert_close(m->lambda, m->shear * (3 - m->kappa) / (m->kappa - 1), 1e-14);
    }
    assert_close(thin.modulus, 75.629e9, 1e-15);
}

/* The circumferential stress of the fields at rest is largest where crack_direction says, and is K_eq. */
static void direction_is_that_of_the_largest_hoop_stress(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRESS);
    const real K[][MODES] = {{1, 0}, {1, 1e-9}, {1, 0.1}, {1, -0.5}, {0.2, 1}, {0, 1}, {0, -1}, {-0.3, 1}};
    for (size_t k = 0; k < COUNT_OF(K); k++) {
        enum { ANGLES = 20000 };
        real best = -INFINITY, at = 0;
        for (int n = 1; n < ANGLES; n++) {
            const real theta = pi * (2.0 * n / ANGLES - 1), c = cos(theta), s = sin(theta);
            struct crack_field f[MODES];
            real hoop = 0;
            for (int mode = 0; mode < MODES; mode++) {
                crack_field_at_rest(&m, mode, (real[2]){c, s}, &f[mode]);
                const struct crack_state *t = &f[mode].state;
                hoop += K[k][mode] * (t->stress[0][0] * s * s + t->stress[1][1] * c * c - 2 * t->stress[0][1] * s * c);
            }
            if (hoop > best) best = hoop, at = theta;
        }
        assert_near(crack_direction(K[k]), at, 2 * pi / ANGLES);
        assert_near(crack_equivalent(K[k]), best * sqrt(2 * pi), 1e-6);    /* quadratic in the step of the angles */
    }
    assert_near(crack_direction((const real[]){1, 1e-200}), -2e-200, 1e-210);
    assert_exact(crack_direction((const real[]){1, 0}), 0);
}

/* ---- the integral from exact fields --------------------------------------------------------------------------- */

/* Gauss points of five in [0, 1]. */
static const real gauss_place[] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155, 0.95308992296933200};
static const real gauss_weight[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                    0.11846344252809454};

/* I of two motions: panels in radius; points evenly round the tip, which converge faster than any power as products of
 * two fields are periodic. The disc inside 1e-3 is left out: the second sum vanishes point by point. */
static real integral(const struct sif_tip *tip, const struct contour *c, enum crack_mode actual, enum crack_mode auxiliary)
{
    enum { RINGS = 4, ANGLES = 400, POINTS = 5 };
    const real bound[] = {1e-3 * c->inner, c->inner, c->outer};
    real sum = 0;
    for (int n = 0; n < 2 * RINGS * POINTS * ANGLES; n++) {
        const int part = n % 2, ring = n / 2 % RINGS, a = n / 2 / RINGS % POINTS, b = n / 2 / RINGS / POINTS;
        const real width = (bound[part + 1] - bound[part]) / RINGS, step = 2 * pi / ANGLES;
        const real r = bound[part] + width * (ring + gauss_place[a]), theta = step * (b + 0.5) - pi;
        const real x[2] = {r * cos(theta), r * sin(theta)};
        struct crack_field f[2];
        crack_field(&tip->medium, actual, tip->speed, x, &f[0]);
        crack_field(&tip->medium, auxiliary, tip->speed, x, &f[1]);
        sum += gauss_weight[a] * width * step * r * sif_density(tip, c, x, &f[0].state, &f[1].state, true);
    }
    return sum;
}

/* I times half of E* is A_I and A_II, whatever the weight and the contour; the modes do not mix. */
static void exact_fields_return_the_universal_functions(void **state)
{
    (void)state;
    const struct contour contour[] = {{1, 2}, {0.3, 3}};
    const real speed[] = {0, 500, 1000, 2000, 3000};
    for (int thin = 0; thin < 2; thin++)
        for (size_t n = 0; n < COUNT_OF(speed); n++)
            for (int form = 0; form < 2; form++) {
                const struct contour *c = &contour[(n + form) % 2];
                const struct sif_tip tip = {.medium = glass(thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN),
                                            .speed = speed[n], .weight = form ? SIF_LINEAR : SIF_SMOOTH};
                for (int mode = 0; mode < MODES; mode++) {
                    const real I = integral(&tip, c, mode, mode), A = crack_universal(&tip.medium, mode, tip.speed);
                    assert_near(0.5 * tip.medium.modulus * I / A, 1, 1e-10);
                }
                assert_near(0.5 * tip.medium.modulus * integral(&tip, c, MODE_I, MODE_II), 0, 1e-10);
            }
}

/* ---- gradients ------------------------------------------------------------------------------------------------- */

/* A shaken square of particles with room for two fields. */
struct patch { struct particles p; struct cells c; real *u[2]; };

static void patch_make(struct patch *k, int edge, real shake, uint64_t seed)
{
    particles_make(&k->p, 2, (int64_t)edge * edge, 0);
    for (int64_t i = 0; i < k->p.n; i++) {
        const real place[2] = {(real)(i % edge), (real)(i / edge)};
        for (int d = 0; d < 2; d++)
            k->p.X[d][i] = k->p.x[d][i] = place[d] - 0.5 * (edge - 1) + cloud_between(&seed, -shake, shake);
        k->p.volume0[i] = 1 + cloud_between(&seed, -shake, shake);
    }
    cells_make(&k->c, &k->p, 3.1);
    for (int d = 0; d < 2; d++) k->u[d] = NEW("test.u", k->p.n, real);
}

static void patch_free(struct patch *k)
{
    for (int d = 0; d < 2; d++) memory_free(k->u[d]);
    cells_free(&k->c);
    particles_free(&k->p);
}

/* Coefficients of two quadratics, and their gradient. */
static const real quadratic[2][6] = {{0.3, 1.5, -0.7, 0.2, 0.9, -0.4}, {-2, 0.1, 0.6, -1.1, 0.35, 0.8}};

static real quadratic_at(const real *a, real x, real y)
{
    return a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y;
}

static real quadratic_slope(const real *a, real x, real y, int d)
{
    return d == 0 ? a[1] + 2 * a[3] * x + a[4] * y : a[2] + a[4] * x + 2 * a[5] * y;
}

static void gradients_are_exact_for_polynomials(const struct gradient_rule *rule, struct patch *k, bool bends)
{
    struct gradient_stencil s = {0};
    real coefficient[2][6] = {{0}}, gradient[2][2], worst = 0;
    const real *const field[2] = {k->u[0], k->u[1]};
    for (int a = 0; a < 2; a++)
        for (int m = 0; m < (bends ? 6 : 3); m++) coefficient[a][m] = quadratic[a][m];
    for (int64_t i = 0; i < k->p.n; i++)
        for (int a = 0; a < 2; a++) k->u[a][i] = quadratic_at(coefficient[a], k->p.X[0][i], k->p.X[1][i]);
    for (int64_t i = 0; i < k->p.n; i++) {
        gradient_stencil_at(&s, rule, &k->p, &k->c, i);
        assert_int_equal(s.order, rule->method == GRADIENT_MLS ? 2 : 1);
        gradient_of(&s, i, field, gradient);
        for (int a = 0; a < 2; a++)
            for (int d = 0; d < 2; d++)
                worst = real_max(worst, fabs(gradient[a][d]
                                             - quadratic_slope(coefficient[a], k->p.X[0][i], k->p.X[1][i], d)));
    }
    assert_near(worst, 0, 1e-10);            /* slopes up to 20; corners of the patch lie badly */
    gradient_stencil_free(&s);
}

static void gradients_on_irregular_clouds(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < 4; seed++) {
        struct patch k;
        patch_make(&k, 12, 0.25 * (real)(seed - 1), seed);
        struct gradient_rule rule = {.method = GRADIENT_MLS, .reach = 1.5};
        gradients_are_exact_for_polynomials(&rule, &k, true);
        rule.method = GRADIENT_PDDO;
        gradients_are_exact_for_polynomials(&rule, &k, false);
        patch_free(&k);
    }
}

/* A jump across a crack does not enter; with diffraction, what the crack hides counts round the tip. */
static void cracks_hide_particles(void **state)
{
    (void)state;
    struct patch k;
    patch_make(&k, 13, 0, 1);
    real corner[2][DIM_MAX] = {{-20, 0.5, 0}, {0.5, 0.5, 0}};
    const struct crack crack = {2, corner};
    struct gradient_rule rule = {.reach = 1.5, .sight = {.crack = &crack, .cracks = 1}, .tip = {0.5, 0.5}};
    struct gradient_stencil s = {0};
    const real *const field[2] = {k.u[0], k.u[1]};
    for (int64_t i = 0; i < k.p.n; i++)
        k.u[0][i] = 3 * k.p.X[0][i] + (k.p.X[1][i] > 0.5 && k.p.X[0][i] < 0.5 ? 7 : 0);
    for (int64_t i = 0; i < k.p.n; i++) {
        real gradient[2][2];
        for (int method = 0; method < 2; method++) {
            if (k.p.X[0][i] > -3) continue;               /* wholly behind the tip */
            rule.method = method;
            gradient_stencil_at(&s, &rule, &k.p, &k.c, i);
            gradient_of(&s, i, field, gradient);
            assert_near(gradient[0][0], 3, 1e-12);
            assert_near(gradient[0][1], 0, 1e-12);
        }
    }
    int64_t i = 6 * 13 + 6;                               /* the origin, beside the tip */
    rule.method = GRADIENT_MLS;
    gradient_stencil_at(&s, &rule, &k.p, &k.c, i);
    const int seen = s.n;
    rule.diffraction = 1;
    gradient_stencil_at(&s, &rule, &k.p, &k.c, i);
    const int round = s.n;
    rule.sight.cracks = 0;
    gradient_stencil_at(&s, &rule, &k.p, &k.c, i);
    assert_true(seen < round && round < s.n);
    gradient_stencil_free(&s);
    patch_free(&k);
}

/* Fewer than six particles, or all on two lines: linear; alone: nothing. */
static void gradients_fall_back(void **state)
{
    (void)state;
    static const real place[3][8][2] = {{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
                                        {{0, 0}, {1, 0}, {2, 0}, {-1, 0}, {-2, 0}, {0, 1}, {1, 1}, {-1, 1}},
                                        {{0, 0}}};
    static const int count[] = {5, 8, 1}, order[] = {1, 1, 0};
    for (int k = 0; k < 3; k++) {
        struct particles p;
        struct cells c;
        struct gradient_stencil s = {0};
        particles_make(&p, 2, count[k], 0);
        for (int i = 0; i < count[k]; i++)
            for (int d = 0; d < 2; d++) p.X[d][i] = place[k][i][d];
        for (int i = 0; i < count[k]; i++) p.volume0[i] = 1;
        cells_make(&c, &p, 3.1);
        const real *const field[2] = {p.X[0], p.X[1]};
        real gradient[2][2];
        for (int method = 0; method < 2; method++) {
            gradient_stencil_at(&s, &(struct gradient_rule){.method = method, .reach = 1.5}, &p, &c, 0);
            assert_int_equal(s.order, order[k]);
            gradient_of(&s, 0, field, gradient);
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) assert_near(gradient[a][b], order[k] > 0 && a == b, 1e-14);
        }
        gradient_stencil_free(&s);
        cells_free(&c);
        particles_free(&p);
    }
}

/* ---- the integral from particles ---------------------------------------------------------------------------------- */

/* An even lattice of spacing 1 round the tip at (shift), displaced by the exact field of a crack at an angle. */
struct lattice {
    struct patch patch;
    struct sif_tip tip;
    real corner[2][DIM_MAX];
    struct crack crack;
    struct gradient_rule rule;
    real *a[2], *v[2];
};

static void rotate(const struct sif_tip *tip, const real local[2], real global[2])
{
    global[0] = tip->along[0] * local[0] - tip->along[1] * local[1];
    global[1] = tip->along[1] * local[0] + tip->along[0] * local[1];
}

static void lattice_field(struct lattice *l, const real K[MODES])
{
    struct particles *p = &l->patch.p;
    for (int64_t i = 0; i < p->n; i++) {
        const real d[2] = {p->X[0][i] - l->tip.place[0], p->X[1][i] - l->tip.place[1]}, *e = l->tip.along;
        real x[2] = {d[0] * e[0] + d[1] * e[1], d[1] * e[0] - d[0] * e[1]}, sum[3][2] = {{0}}, turned[2];
        if (fabs(x[1]) < 1e-9) x[1] = copysign(0, l->tip.face);
        for (int mode = 0; mode < MODES; mode++) {
            struct crack_field f;
            crack_field(&l->tip.medium, mode, l->tip.speed, x, &f);
            for (int k = 0; k < 2; k++) {
                sum[0][k] += K[mode] * f.displacement[k];
                sum[1][k] += K[mode] * f.state.velocity[k];
                sum[2][k] += K[mode] * f.state.acceleration[k];
            }
        }
        real *const to[3][2] = {{l->patch.u[0], l->patch.u[1]}, {l->v[0], l->v[1]}, {l->a[0], l->a[1]}};
        for (int k = 0; k < 3; k++) {
            rotate(&l->tip, sum[k], turned);
            to[k][0][i] = turned[0], to[k][1][i] = turned[1];
        }
    }
}

static void lattice_make(struct lattice *l, int edge, real degrees, const real shift[2], real speed)
{
    memset(l, 0, sizeof *l);
    patch_make(&l->patch, edge, 0, 1);
    const real angle = degrees * pi / 180;
    l->tip = (struct sif_tip){.medium = glass(SPACE_PLANE_STRAIN), .place = {shift[0], shift[1]},
                              .along = {cos(angle), sin(angle)}, .face = 1, .body = -1, .thickness = 1, .speed = speed};
    for (int d = 0; d < 2; d++) {
        l->corner[0][d] = shift[d] - 2 * edge * l->tip.along[d];
        l->corner[1][d] = shift[d];
        l->v[d] = NEW("test.v", l->patch.p.n, real), l->a[d] = NEW("test.a", l->patch.p.n, real);
        l->rule.tip[d] = shift[d];
    }
    l->crack = (struct crack){2, l->corner};
    l->rule.reach = 1.5, l->rule.sight = (struct sight){.crack = &l->crack, .cracks = 1};
}

static void lattice_free(struct lattice *l)
{
    for (int d = 0; d < 2; d++) memory_free(l->v[d]), memory_free(l->a[d]);
    patch_free(&l->patch);
}

static struct sif lattice_sif(const struct lattice *l, real inner, real outer)
{
    const struct contour c = {inner, outer};
    const bool moves = l->tip.speed > 0;
    const struct sif_motion m = {.displacement = {l->patch.u[0], l->patch.u[1]},
                                 .velocity = {moves ? l->v[0] : NULL, moves ? l->v[1] : NULL},
                                 .acceleration = {l->a[0], l->a[1]}};
    struct sif found;
    sif_integrate(&l->tip, &c, 1, &m, &l->rule, &l->patch.p, &l->patch.c, &found);
    return found;
}

/* Error of K over |K|. */
static real sif_error(const struct sif *s, const real K[MODES])
{
    return real_max(fabs(s->K[0] - K[0]), fabs(s->K[1] - K[1])) / hypot(K[0], K[1]);
}

/* The midpoint sum with exact gradients: what is left is quadrature. */
static real exact_gradient_error(const struct lattice *l, real outer, enum crack_mode mode)
{
    const struct contour c = {0.5 * outer, outer};
    const struct particles *p = &l->patch.p;
    real sum[MODES] = {0}, K[MODES] = {mode == MODE_I, mode == MODE_II}, worst = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const real d[2] = {p->X[0][i] - l->tip.place[0], p->X[1][i] - l->tip.place[1]}, *e = l->tip.along;
        const real x[2] = {d[0] * e[0] + d[1] * e[1], d[1] * e[0] - d[0] * e[1]};
        struct crack_field f[MODES];
        if (hypot(x[0], x[1]) > outer || hypot(x[0], x[1]) < 0.5 * outer) continue;
        for (int m = 0; m < MODES; m++) crack_field(&l->tip.medium, m, 0, x, &f[m]);
        for (int m = 0; m < MODES; m++) sum[m] += sif_density(&l->tip, &c, x, &f[mode].state, &f[m].state, false);
    }
    for (int m = 0; m < MODES; m++) worst = real_max(worst, fabs(0.5 * l->tip.medium.modulus * sum[m] - K[m]));
    return worst;
}

static void lattice_sums_of_exact_gradients(void **state)
{
    (void)state;
    const real degrees[] = {0, 30, 45};
    for (size_t n = 0; n < COUNT_OF(degrees)*4; n++) {
        const real shift[2] = {n/3%2 * 0.499, n/6*0.3};
        struct lattice l;
        lattice_make(&l, 90, degrees[n%3], shift, 0);
        for (int mode = 0; mode < MODES; mode++) {
            real e10 = exact_gradient_error(&l, 10, mode), e20 = exact_gradient_error(&l, 20, mode);
            real e40 = exact_gradient_error(&l, 40, mode);
            print_message("exact gradients, crack at %g deg, mode %d: %.3f %% %.3f %% %.3f %%\n", degrees[n%3], mode + 1,
                          100 * e10, 100 * e20, 100 * e40);
        }
        lattice_free(&l);
    }
}

static void lattice_sums_of_fitted_gradients(void **state)
{
    (void)state;
    const real shift[2] = {0, 0}, degrees[] = {0, 30, 45}, outer[] = {10, 20, 40};
    const real Ks[][MODES] = {{1, 0}, {0, 1}, {0.8, -0.6}};
    for (size_t n = 0; n < COUNT_OF(degrees); n++) {
        struct lattice l;
        lattice_make(&l, 96, degrees[n], shift, 0);
        for (int method = 0; method < 2; method++)
            for (size_t k = 0; k < COUNT_OF(Ks); k++) {
                lattice_field(&l, Ks[k]);
                l.rule.method = method;
                print_message("%s %2g deg K = %.1f %.1f:", method ? "PDDO" : "MLS ", degrees[n], Ks[k][0], Ks[k][1]);
                for (size_t o = 0; o < COUNT_OF(outer); o++) {
                    const struct sif s = lattice_sif(&l, 0.5 * outer[o], outer[o]);
                    print_message("  %+.3f %+.3f J %+.3f %%", 100 * (s.K[0] - Ks[k][0]), 100 * (s.K[1] - Ks[k][1]),
                                  100 * (s.J * l.tip.medium.modulus - 1));
                }
                print_message("\n");
            }
        lattice_free(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_solve_the_equations_of_motion),
        cmocka_unit_test(fields_meet_at_low_speed),
        cmocka_unit_test(numbers_of_the_glass_at_a_kilometre_per_second),
        cmocka_unit_test(constants_of_the_medium),
        cmocka_unit_test(direction_is_that_of_the_largest_hoop_stress),
        cmocka_unit_test(exact_fields_return_the_universal_functions),
        cmocka_unit_test(gradients_on_irregular_clouds),
        cmocka_unit_test(cracks_hide_particles),
        cmocka_unit_test(gradients_fall_back),
        cmocka_unit_test(lattice_sums_of_exact_gradients),
        cmocka_unit_test(lattice_sums_of_fitted_gradients),
    };
    (void)sif_error;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
