/* Small bodies of material points on a grid, for tests of the transfer kernels, and one step of these kernels. */
#ifndef CLEAVE_TESTS_POINT_CLOUD
#define CLEAVE_TESTS_POINT_CLOUD

#include <math.h>
#include <string.h>

#include "tests/support/cloud.h"
#include "data/grid.h"
#include "kernels/kernels.h"
#include "kernels/mpm/shape.h"

/* Tolerance relative to the largest entry of a field. Weights follow from positions whose error is 1e-16 times the
 * about ten cells between a point and the origin of the grid, and sums have up to 64 terms: 1e-14 is typical. */
#define CLOSE 1e-12

/* Points on a grid, with all that a step of the transfer kernels needs. Release with point_cloud_free. */
struct point_cloud {
    struct particle_cloud c;
    struct grid g;
    struct transfer_order order;
    struct partial_stress partial;
    struct elastic elastic[CLOUD_MATERIALS];
    struct transfer_data t;
    int dim, optional;
    real smallest_mass;
};

/* Kernels to be used: dimension, shape function (enum shape) and transfer (enum transfer). */
struct transfer_kernels {
    int dim, shape, transfer;
};

/* Sets random materials, volumes, stresses, velocities and forces of the points of s, and makes about a fifth of them
 * peridynamic. seed: state of the random numbers, advanced; spin: half of the largest difference of velocities [m/s].
 */
static inline void point_cloud_set_random_state(struct point_cloud *s, uint64_t *seed, real spin)
{
    struct particles *p = &s->c.p;
    const int n = symmetric_tensor_component_count(s->dim);
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = cloud_random(seed) < 0.2 ? KIND_PD : KIND_MPM;
        p->material[i] = cloud_random(seed) < 0.3;
        p->volume[i] *= cloud_between(seed, 0.9, 1.1);
        for (int a = 0; a < n; a++) p->stress[a][i] = cloud_between(seed, -1e8, 1e8);
        for (int d = 0; d < s->dim; d++) {
            p->v[d][i] = 300 + spin * cloud_between(seed, -1, 1);
            p->f[d][i] = cloud_between(seed, -100, 100) * (s->dim == 2 ? 2 : 1);
            if (s->optional & WITH_STRETCH) p->stretch[d][i] = cloud_between(seed, 0.7, 3.9);
        }
        for (int k = 0; k < s->dim * s->dim && s->optional & WITH_GRADIENT; k++)
            p->gradient[k][i] = cloud_between(seed, -1e3, 1e3);
    }
    particles_rebuild_lists_by_kind(p);
}

/* Gives every second point of s a random partial stress, the part of its stress that bonds carry. seed: state of the
 * random numbers, advanced. */
static inline void point_cloud_set_random_partial_stress(struct point_cloud *s, uint64_t *seed)
{
    const int64_t size = square(symmetric_tensor_component_count(s->dim));
    s->partial.index = NEW("test.index", s->c.p.n, int32_t);
    s->partial.matrix = NEW("test.matrix", s->c.p.n * size, real);
    for (int64_t i = 0; i < s->c.p.n; i++) s->partial.index[i] = i % 2 ? (int32_t)s->partial.entries++ : -1;
    for (int64_t k = 0; k < s->partial.entries * size; k++) s->partial.matrix[k] = cloud_between(seed, -0.5, 0.5);
}

/* Creates the grid of s, with cells of two spacings, around the points of s. */
static inline void point_cloud_make_grid(struct point_cloud *s)
{
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    s->g = (struct grid){.dim = s->dim, .h = 2 * CLOUD_SPACING};
    for (int d = 0; d < s->dim; d++) {
        s->g.anchor[d] = (3.17 + d) * CLOUD_SPACING; /* points on both sides of node 0 */
        from[d] = INFINITY, to[d] = -INFINITY;
        for (int64_t i = 0; i < s->c.p.n; i++)
            from[d] = fmin(from[d], s->c.p.x[d][i]), to[d] = fmax(to[d], s->c.p.x[d][i]);
    }
    assert_int_equal(grid_extend_box(&s->g, from, to, 100000, &changed), OK);
}

/* Places every fifth point of s so close to the end of its cell in one direction that it leaves the cell in the step.
 */
static inline void point_cloud_move_points_to_cell_ends(struct point_cloud *s)
{
    for (int64_t i = 0; i < s->c.p.n; i += 5) {
        int d = (int)(i / 5 % s->dim);
        real *x = &s->c.p.x[d][i], cell = floor((*x - s->g.anchor[d]) / s->g.h);
        *x = s->g.anchor[d] + (cell + 0.985) * s->g.h;
    }
}

/* Creates the points and the grid of s for the kernels k. spin: half of the largest difference of velocities [m/s]; 2
 * m/s rotate a point by less than 1e-3 rad in the step. Release s with point_cloud_free. */
static inline void point_cloud_make(struct point_cloud *s, const struct transfer_kernels *k, real spin)
{
    static const enum space space[] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    static const int count[DIM_MAX + 1][DIM_MAX] = {{0}, {40}, {9, 8}, {4, 4, 3}};
    uint64_t seed = 77;
    memset(s, 0, sizeof *s);
    s->dim = k->dim;
    s->optional = WITH_PLASTIC | (k->shape == SHAPE_CPGIMP ? WITH_STRETCH : 0) |
                  (k->transfer == TRANSFER_APIC ? WITH_GRADIENT : 0);
    struct cloud_plan plan = {.space = space[k->dim], .horizon = 3, .shake = 0.3, .seed = 8, .optional = s->optional};
    memcpy(plan.count, count[k->dim], sizeof plan.count);
    particle_cloud_make(&s->c, &plan);
    point_cloud_set_random_state(s, &seed, spin);
    point_cloud_set_random_partial_stress(s, &seed);
    point_cloud_make_grid(s);
    point_cloud_move_points_to_cell_ends(s);
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        const struct material *c = &s->c.material[m];
        s->elastic[m] = (struct elastic){.c11 = c->c11, .c12 = c->c12, .shear = c->shear, .trigger = 1e8};
    }
    s->smallest_mass = GRID_MASS_SMALLEST * s->c.p.mass[0];
    s->t = (struct transfer_data){.order = &s->order,
                                  .partial = &s->partial,
                                  .elastic = s->elastic,
                                  .half_width = cloud_half_width((enum shape)k->shape, s->g.h),
                                  .dt = 2e-7,
                                  .dt_velocity = 1e-7};
    transfer_order_sort_points_by_cell(&s->order, &s->c.p, s->c.p.list[KIND_MPM], s->c.p.n_of[KIND_MPM], &s->g);
}

/* Frees all arrays of s. */
static inline void point_cloud_free(struct point_cloud *s)
{
    memory_free(s->partial.index);
    memory_free(s->partial.matrix);
    transfer_order_free(&s->order);
    grid_free(&s->g);
    particle_cloud_free(&s->c);
}

/* Performs one step of the kernels k on s. impulse[dim] [N s], *work [J]: increased by the impulse and work of walls.
 * Returns the return value of the kernel g2p. */
static inline int64_t point_cloud_step(struct point_cloud *s, const struct transfer_kernels *k, real *impulse,
                                       real *work)
{
    struct kernels kernel;
    kernels_choose(&kernel, k->dim, PD_BOND, (enum shape)k->shape, (enum transfer)k->transfer);
    grid_clear(&s->g);
    kernel.p2g(&s->g, &s->c.p, &s->t);
    grid_advance_and_constrain_nodes(&s->g, (enum transfer)k->transfer, s->t.dt_velocity, s->smallest_mass, impulse,
                                     work);
    if (k->transfer == TRANSFER_FLIP) {
        kernel.remap(&s->g, &s->c.p, &s->t);
        grid_remapped(&s->g, s->smallest_mass);
    }
    return kernel.g2p(&s->g, &s->c.p, &s->t);
}

/* Calls check(k) for all dimensions, shape functions and transfers. */
static inline void for_all_transfer_kernels(void (*check)(const struct transfer_kernels *k))
{
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int transfer = 0; transfer < TRANSFERS; transfer++)
                check(&(struct transfer_kernels){dim, shape, transfer});
}

#endif
