/* floor 4: every transfer kernel in the tables against its plain twin: shapes, maps, nodal updates, stresses. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>
#include <omp.h>

#include "cloud.h"
#include "reference.h"
#include "shape.h"
#include "team.h"

/* Of the largest entry of a field. Weights come from positions with an absolute error of 1e-16 times the cells between
 * point and anchor (about ten), sums have up to 64 terms: 1e-14 is usual. */
#define CLOSE 1e-12
/* Sums over all points against sums over all nodes: round-off only, of the sum of magnitudes. */
#define CONSERVED 1e-13

/* ---- shapes ----------------------------------------------------------------------------------------- */

/* All weights of a shape at place r, in node distances, from the kernels' side; partition of unity and linear
 * completeness: sum N = 1, sum N x_I = x, sum dN = 0, sum dN x_I = 1. */
static void check_shape(enum shape shape, real r, real l)
{
    real N[SHAPE_NODES_MAX], dN[SHAPE_NODES_MAX], sum[4] = {0};
    int64_t base = shape_1d(shape, r, l, N, dN);
    for (int64_t node = base - 3; node < base + SHAPE_NODES_MAX + 3; node++) {
        bool inside = node >= base && node < base + shape_nodes(shape);
        struct reference_shape s = reference_shape(shape, r - (real)node, 1, l);
        /* round-off of (r +- l), up to ten, in an integral over 2 l >= 0.02 */
        assert_true(fabs(s.value - (inside ? N[node - base] : 0)) <= 1e-13);
        if (!(shape == SHAPE_LINEAR && r == floor(r)))         /* a kink: the slope on either side is right */
            assert_true(fabs(s.slope - (inside ? dN[node - base] : 0)) <= 1e-12);
        if (!inside) continue;
        sum[0] += N[node - base], sum[1] += N[node - base] * (real)node;
        sum[2] += dN[node - base], sum[3] += dN[node - base] * (real)node;
    }
    assert_true(fabs(sum[0] - 1) <= 1e-14 && fabs(sum[1] - r) <= 1e-13);
    assert_true(fabs(sum[2]) <= 1e-13 && fabs(sum[3] - 1) <= 1e-12);
}

static void test_shapes(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int shape = 0; shape < SHAPES; shape++) {
        for (int k = 0; k < 2000; k++) check_shape((enum shape)shape, cloud_between(&seed, -9, 9), cloud_between(&seed, 0.01, 0.5));
        for (int k = -16; k <= 16; k++) {                      /* on nodes, mid-cells and the edges of pieces */
            check_shape((enum shape)shape, 0.25 * k, 0.25);
            check_shape((enum shape)shape, 0.25 * k, 0.5);
            check_shape((enum shape)shape, 0.25 * k + 1e-15, 0.25);
        }
    }
}

/* ---- a cloud on a grid -------------------------------------------------------------------------------- */

struct scene {
    struct cloud c;
    struct grid g;
    struct transfer_order order;
    struct partial_stress partial;
    struct elastic elastic[CLOUD_MATERIALS];
    struct transfer_data t;
    int dim, optional;
    real smallest_mass;
};

struct choice { int dim, shape, transfer; };

static void random_state(struct scene *s, uint64_t *seed, real spin)
{
    struct particles *p = &s->c.p;
    const int n = symmetric_count(s->dim);
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = cloud_random(seed) < 0.2 ? KIND_PD : KIND_MPM;
        p->material[i] = cloud_random(seed) < 0.3;
        p->volume[i] *= cloud_between(seed, 0.9, 1.1);
        for (int a = 0; a < n; a++) p->stress[a][i] = cloud_between(seed, -1e8, 1e8);
        for (int d = 0; d < s->dim; d++) {
            p->v[d][i] = 300 + spin * cloud_between(seed, -1, 1);
            p->f[d][i] = cloud_between(seed, -100, 100) * (s->dim == 2 ? 2 : 1);
            if (s->optional & WITH_STRETCH) p->stretch[d][i] = cloud_between(seed, 0.7, 1.9);
        }
        for (int k = 0; k < s->dim * s->dim && s->optional & WITH_GRADIENT; k++)
            p->gradient[k][i] = cloud_between(seed, -1e3, 1e3);
    }
    particles_list(p);
}

/* Every second point leaves some of its stress to bonds. */
static void random_partial(struct scene *s, uint64_t *seed)
{
    const int64_t size = square(symmetric_count(s->dim));
    s->partial.index = NEW("test.index", s->c.p.n, int32_t);
    s->partial.matrix = NEW("test.matrix", s->c.p.n * size, real);
    for (int64_t i = 0; i < s->c.p.n; i++) s->partial.index[i] = i % 2 ? (int32_t)s->partial.entries++ : -1;
    for (int64_t k = 0; k < s->partial.entries * size; k++) s->partial.matrix[k] = cloud_between(seed, -0.5, 0.5);
}

static void scene_grid(struct scene *s)
{
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    s->g = (struct grid){.dim = s->dim, .h = 2 * CLOUD_SPACING};
    for (int d = 0; d < s->dim; d++) {
        s->g.anchor[d] = (3.17 + d) * CLOUD_SPACING;            /* points on both sides of node 0 */
        from[d] = INFINITY, to[d] = -INFINITY;
        for (int64_t i = 0; i < s->c.p.n; i++) from[d] = fmin(from[d], s->c.p.x[d][i]), to[d] = fmax(to[d], s->c.p.x[d][i]);
    }
    assert_int_equal(grid_cover(&s->g, from, to, 100000, &changed), OK);
}

/* `spin`: difference of neighbours' velocities [m/s]; 2 m/s turn a point by less than 1e-3 rad in the step. */
static void scene_make(struct scene *s, const struct choice *k, real spin)
{
    static const enum space space[] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    static const int count[DIM_MAX + 1][DIM_MAX] = {{0}, {40}, {9, 8}, {5, 5, 4}};
    uint64_t seed = 77;
    memset(s, 0, sizeof *s);
    s->dim = k->dim;
    s->optional = (k->shape == SHAPE_CPGIMP ? WITH_STRETCH : 0) | (k->transfer == TRANSFER_APIC ? WITH_GRADIENT : 0);
    struct cloud_plan plan = {.space = space[k->dim], .horizon = 3, .shake = 0.3, .seed = 8, .optional = s->optional};
    memcpy(plan.count, count[k->dim], sizeof plan.count);
    cloud_make(&s->c, &plan);
    random_state(s, &seed, spin);
    random_partial(s, &seed);
    scene_grid(s);
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        const struct material *c = &s->c.material[m];
        s->elastic[m] = (struct elastic){c->c11, c->c12, c->shear, 1e8};
    }
    s->smallest_mass = GRID_MASS_SMALLEST * s->c.p.mass[0];
    s->t = (struct transfer_data){.order = &s->order, .partial = &s->partial, .elastic = s->elastic,
                                  .half_width = 0.5 * CLOUD_SPACING, .dt = 2e-7, .dt_velocity = 1e-7};
    transfer_order_sort(&s->order, &s->c.p, &s->g);
}

static void scene_free(struct scene *s)
{
    partial_free:
    memory_free(s->partial.index);
    memory_free(s->partial.matrix);
    transfer_order_free(&s->order);
    grid_free(&s->g);
    cloud_free(&s->c);
    if (0) goto partial_free;
}

/* One step of the kernels, as the loop calls them. */
static int64_t scene_step(struct scene *s, const struct choice *k, real *impulse, real *work)
{
    struct kernels kernel;
    kernels_choose(&kernel, k->dim, PD_BOND, (enum shape)k->shape, (enum transfer)k->transfer);
    grid_clear(&s->g);
    kernel.p2g(&s->g, &s->c.p, &s->t);
    grid_move(&s->g, (enum transfer)k->transfer, s->t.dt_velocity, s->smallest_mass, impulse, work);
    if (k->transfer == TRANSFER_FLIP) {
        kernel.remap(&s->g, &s->c.p, &s->t);
        grid_remapped(&s->g, s->smallest_mass);
    }
    return kernel.g2p(&s->g, &s->c.p, &s->t);
}

static void for_all(void (*check)(const struct choice *k))
{
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int transfer = 0; transfer < TRANSFERS; transfer++) check(&(struct choice){dim, shape, transfer});
}
