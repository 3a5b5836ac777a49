/* A uniformly strained patch of particles of one or both kinds on a grid, and the forces on its nodes. */
#ifndef CLEAVE_TESTS_PATCH
#define CLEAVE_TESTS_PATCH

#include "cloud.h"
#include "coupling/conversion.h"
#include "kernels/kernels.h"

/* Fails the test unless |value| is at most `most`. what: name of the quantity for the message. */
static inline void at_most(const char *what, real value, real most)
{
    if (!(fabs(value) <= most)) fail_msg("%s: %g is more than %g", what, value, most);
}

/* Fails the test unless |value - expected| <= tolerance. what: name of the quantity for the message. */
static inline void is_near(const char *what, real value, real expected, real tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%s: %g, not %g +- %g", what, value, expected, tolerance);
}

/* A patch of material points, perhaps with peridynamic particles; its grid; the order of its points by cells; and the
 * partial stresses of the points. Release it with patch_free. */
struct patch {
    struct particle_cloud c;
    struct grid g;
    struct transfer_order order;
    struct partial_stress partial;
};

/* Creates the grid s->g of the patch s such that it covers all particles. ratio: edge of the cells [spacings]; offset:
 * distance of a node from the start of the lattice along x [spacings]. */
static inline void patch_grid(struct patch *s, real ratio, real offset)
{
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    s->g = (struct grid){.dim = s->c.p.dim, .h = ratio * CLOUD_SPACING, .anchor = {offset * CLOUD_SPACING}};
    for (int d = 0; d < s->c.p.dim; d++) {
        from[d] = 0, to[d] = 0;
        for (int64_t i = 0; i < s->c.p.n; i++) to[d] = fmax(to[d], s->c.p.x[d][i]);
    }
    assert_int_equal(grid_extend_box(&s->g, from, to, 1000000, &changed), OK);
}

/* Maps mass, momentum and forces of the material points of the patch s to the nodes of its grid by the kernel p2g
 * (FLIP) with the shape functions `shape`. */
static inline void patch_map(struct patch *s, enum shape shape)
{
    struct transfer_data t = {
        .order = &s->order, .partial = &s->partial, .half_width = cloud_half_width(shape, s->g.h)};
    transfer_order_sort_points_by_cell(&s->order, &s->c.p, s->c.p.list[KIND_MPM], s->c.p.n_of[KIND_MPM], &s->g);
    grid_clear(&s->g);
    p2g_table[s->g.dim][shape][TRANSFER_FLIP](&s->g, &s->c.p, &t);
}

/* Returns the largest magnitude of the nodal forces [N] in the box with the corners from[dim] and to[dim] [spacings].
 * The test fails if no node is in the box. */
static inline real patch_residual(const struct patch *s, const real *from, const real *to)
{
    real largest = -1;
    for (int64_t I = 0; I < s->g.n; I++) {
        real f2 = 0;
        bool in = true;
        for (int d = 0; d < s->g.dim; d++) {
            real x = grid_node_position(&s->g, d, I / s->g.stride[d] % s->g.count[d]) / CLOUD_SPACING;
            in = in && x > from[d] - 1e-6 && x < to[d] + 1e-6;
            f2 += square(s->g.force[d][I]);
        }
        if (in) largest = fmax(largest, sqrt(f2));
    }
    assert_true(largest >= 0);
    return largest;
}

/* Frees the particles, grid, order and partial stresses of the patch s. */
static inline void patch_free(struct patch *s)
{
    partial_stress_free(&s->partial);
    transfer_order_free(&s->order);
    grid_free(&s->g);
    particle_cloud_free(&s->c);
}

#endif
