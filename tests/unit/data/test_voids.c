/* Voids: whether the line between two positions of a body leaves its shape, which separates the positions. Round holes
 * and slots are compared with exact lines; further planes of symmetry, adjacent faces of solids, and slits of meshes
 * with doubled nodes. */
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "data/voids.h"
#include "geometry/geometry.h"

#define SPACING 0.37e-3
enum { TRIES = 4000 };

/* Returns a box from (-8, -8, -8) to (8, 8, 8) spacings. */
static struct solid block(void)
{
    struct solid s = {.kind = SOLID_BOX};
    for (int d = 0; d < DIM_MAX; d++) s.from[d] = -8 * SPACING, s.to[d] = 8 * SPACING;
    return s;
}

static struct solid ball(real radius)
{
    return (struct solid){.kind = SOLID_BALL,
                          .subtract = true,
                          .radius = radius * SPACING,
                          .centre = {0.3 * SPACING, -0.7 * SPACING, 0.4 * SPACING}};
}

/* Returns the voids of body 3 in `dim` dimensions, whose shape is *r. shape, body: memory for the pointer to the shape
 * and for the number of the body, to which the result refers. */
static struct voids voids_of(int dim, struct region *r, const struct region **shape, int *body)
{
    *shape = r, *body = 3;
    return (struct voids){.dim = dim, .shapes = 1, .shape = shape, .body = body, .spacing = SPACING};
}

static void place_random(uint64_t *seed, int dim, real most, real *X)
{
    for (int d = 0; d < DIM_MAX; d++) X[d] = d < dim ? cloud_between(seed, -most, most) * SPACING : 0;
}

/* Returns the distance of the line segment from a[dim] to b[dim] from the position centre[dim]. */
static real line_distance(const real *a, const real *b, const real *centre, int dim)
{
    real along = 0, length2 = 0, r2 = 0;
    for (int d = 0; d < dim; d++) along += (centre[d] - a[d]) * (b[d] - a[d]), length2 += square(b[d] - a[d]);
    along = fmin(fmax(along / length2, 0), 1);
    for (int d = 0; d < dim; d++) r2 += square(a[d] + along * (b[d] - a[d]) - centre[d]);
    return sqrt(r2);
}

/* Checks that a round hole separates two positions if and only if the line between them passes through the hole; lines
 * within 2e-5 spacings of its edge are left out. */
static void round_holes(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < 3; k++) {
            const real radius = (const real[]){0.05, 0.9, 4.3}[k];
            struct solid solids[2] = {block(), ball(radius)};
            struct region r = {.n = 2, .solid = solids};
            const struct region *shape;
            int body, hidden = 0;
            const struct voids v = voids_of(dim, &r, &shape, &body);
            uint64_t seed = 5 + dim;
            assert_true(region_may_have_voids(&r, &v));
            for (int n = 0; n < TRIES; n++) {
                real a[DIM_MAX], b[DIM_MAX];
                bool across;
                place_random(&seed, dim, fmin(7, 2.2 * radius), a), place_random(&seed, dim, fmin(7, 2.2 * radius), b);
                for (int d = 0; d < dim; d++) a[d] += solids[1].centre[d], b[d] += solids[1].centre[d];
                const real near = line_distance(a, b, solids[1].centre, dim);
                const real out = fmax(region_level_set_value(&r, a, dim), region_level_set_value(&r, b, dim));
                if (fabs(near - solids[1].radius) < 2e-5 * v.spacing || out > 0) continue; /* a seam is closed */
                const bool hides = near < solids[1].radius;
                assert_int_equal(void_separates_points(&v, 3, a, b, &across), hides);
                assert_int_equal(void_separates_points(&v, 3, b, a, NULL), hides);
                assert_false(void_separates_points(&v, 2, a, b, NULL)); /* belongs to another body */
                /* across: normals at both ends of the chord differ by more than a right angle. */
                if (hides && fabs(near / solids[1].radius - sqrt(0.5)) > 1e-3)
                    assert_int_equal(across, near < sqrt(0.5) * solids[1].radius);
                hidden += hides;
            }
            assert_true(hidden > 20);
        }
}

/* Checks that a slot a thousandth of a spacing wide blocks all lines through it, and none beside it or beyond its
 * end. */
static void thin_slot(void **state)
{
    (void)state;
    struct solid solids[2] = {block(), block()};
    struct region r = {.n = 2, .solid = solids};
    const struct region *shape;
    int body;
    solids[1].subtract = true, solids[1].to[0] = 1.3 * SPACING;
    solids[1].from[1] = 0.2 * SPACING, solids[1].to[1] = 0.201 * SPACING;
    const struct voids v = voids_of(2, &r, &shape, &body);
    uint64_t seed = 11;
    int hidden = 0;
    for (int n = 0; n < TRIES; n++) {
        real a[DIM_MAX], b[DIM_MAX];
        place_random(&seed, 2, 3, a), place_random(&seed, 2, 3, b);
        const real y[] = {0.2 * SPACING, 0.201 * SPACING};
        if ((a[1] >= y[0] && a[1] <= y[1]) || (b[1] >= y[0] && b[1] <= y[1])) continue;
        const bool sides = (a[1] < y[0]) != (b[1] < y[0]);
        const real x = a[0] + (0.2005 * SPACING - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        if (sides && fabs(x / SPACING - 1.3) < 0.01) continue;
        bool across;
        assert_int_equal(void_separates_points(&v, 3, a, b, &across), sides && x < 1.3 * SPACING);
        hidden += sides && x < 1.3 * SPACING;
    }
    assert_true(hidden > 100);
}

/* Checks that boxes in contact separate no positions, whether the line crosses their common face or runs in it, and
 * that a plane of symmetry at the end of a body does not. A slot beside the plane separates positions from images. */
static void joined_and_mirrored(void **state)
{
    (void)state;
    struct solid left = block(), right = block();
    struct region r[2] = {{.n = 1, .solid = &left}, {.n = 1, .solid = &right}};
    const struct region *shape[2] = {&r[0], &r[1]};
    const int body[2] = {3, 3};
    left.to[0] = right.from[0] = 0.1 * SPACING;
    struct voids v = {.dim = 2, .shapes = 2, .shape = shape, .body = (int *)body, .spacing = SPACING};
    assert_false(region_may_have_voids(&r[0], &v));
    uint64_t seed = 3;
    for (int n = 0; n < TRIES / 10; n++) {
        real a[DIM_MAX], b[DIM_MAX];
        place_random(&seed, 2, 7, a), place_random(&seed, 2, 7, b);
        if (n % 3 == 0) a[0] = b[0] = 0.1 * SPACING;
        assert_false(void_separates_points(&v, 3, a, b, NULL));
    }
    struct mirror_plane plane = {.axis = 0, .outside = 1, .at = 0.1 * SPACING};
    v.mirror = &plane, v.mirrors = 1, v.shapes = 1;
    const real a[DIM_MAX] = {-0.4 * SPACING, 0.3 * SPACING}, b[DIM_MAX] = {1.1 * SPACING, -0.6 * SPACING};
    assert_false(void_separates_points(&v, 3, a, b, NULL));
    left.to[0] = 0.09 * SPACING; /* now the body ends before the plane */
    assert_true(void_separates_points(&v, 3, a, b, NULL));
    left.to[0] = 0.1 * SPACING; /* a slot half a spacing before the plane has an image behind it */
    struct solid slotted[2] = {left, block()};
    slotted[1].subtract = true, slotted[1].from[0] = -0.55 * SPACING, slotted[1].to[0] = -0.45 * SPACING;
    r[0] = (struct region){.n = 2, .solid = slotted};
    const real before[DIM_MAX] = {-0.2 * SPACING}, nearer[DIM_MAX] = {0.6 * SPACING}, beyond[DIM_MAX] = {0.9 * SPACING};
    assert_false(void_separates_points(&v, 3, before, nearer, NULL));
    assert_true(void_separates_points(&v, 3, before, beyond, NULL));
}

/* Checks the marks of particles on a lattice beside a slot, i.e. that a void separates them from a neighbour, and the
 * separation of pairs, against tests of all pairs. */
static void bits_of_particles(void **state)
{
    (void)state;
    struct particle_cloud c;
    struct cloud_plan plan = {.space = SPACE_PLANE_STRESS, .horizon = 3, .count = {11, 9}};
    particle_cloud_make(&c, &plan);
    cloud_source(&c);
    struct particles *p = &c.p;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < 2; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    struct solid solids[2] = {{.kind = SOLID_BOX}, {.kind = SOLID_BOX, .subtract = true}};
    for (int d = 0; d < 2; d++)
        solids[0].from[d] = low[d] - 0.5 * CLOUD_SPACING, solids[0].to[d] = high[d] + 0.5 * CLOUD_SPACING;
    solids[1].from[0] = low[0] - CLOUD_SPACING, solids[1].to[0] = low[0] + 3.6 * CLOUD_SPACING;
    solids[1].from[1] = low[1] + 2.4 * CLOUD_SPACING, solids[1].to[1] = low[1] + 2.6 * CLOUD_SPACING;
    struct region r = {.n = 2, .solid = solids};
    const struct region *shape = &r;
    const int body = p->body[0];
    const real reach = 3.01 * CLOUD_SPACING;
    struct voids v = {.dim = 2, .shapes = 1, .shape = &shape, .body = (int *)&body, .spacing = CLOUD_SPACING};
    voids_mark_particles_beside_voids(&v, p, &c.cells, NULL, reach);
    int64_t near = 0;
    for (int64_t i = 0; i < p->n; i++) {
        bool hides = false;
        for (int64_t j = 0; j < p->n; j++) {
            const real x = p->X[0][j] - p->X[0][i], y = p->X[1][j] - p->X[1][i], cut = low[1] + 2.5 * CLOUD_SPACING;
            if (j == i || hypot(x, y) > reach || (p->X[1][i] < cut) == (p->X[1][j] < cut)) continue;
            const real face = 0.1 * CLOUD_SPACING; /* where the line crosses both faces of the slot */
            const real at[2] = {p->X[0][i] + (cut - face - p->X[1][i]) / y * x,
                                p->X[0][i] + (cut + face - p->X[1][i]) / y * x};
            const bool one = fmin(at[0], at[1]) < solids[1].to[0];
            hides |= one;
            if (particle_is_beside_void(&v, i) && particle_is_beside_void(&v, j))
                assert_int_equal(void_separates_particles(&v, p, i, j), one);
        }
        assert_int_equal(particle_is_beside_void(&v, i), hides);
        near += hides;
    }
    assert_true(near > 10);
    memory_free(v.near); /* shape and body are on the stack */
    particle_cloud_free(&c);
}

/* Checks that each particle of an L of two boxes is marked that a void separates from a neighbour, and the number of
 * such particles: without a disc; with the foot of the L alone intersected with a disc, which leaves a slit beside the
 * leg; and with both boxes intersected. */
static void marks_of_intersections(void **state)
{
    (void)state;
    struct particle_cloud c;
    struct cloud_plan plan = {.space = SPACE_PLANE_STRESS, .horizon = 3, .count = {11, 9}};
    particle_cloud_make(&c, &plan);
    cloud_source(&c);
    struct particles *p = &c.p;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < 2; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    const real half = 0.5 * CLOUD_SPACING, reach = 3.01 * CLOUD_SPACING;
    const struct solid disc = {.kind = SOLID_BALL,
                               .intersect = true,
                               .radius = 4.6 * CLOUD_SPACING,
                               .centre = {low[0] + 7.5 * CLOUD_SPACING, low[1] + CLOUD_SPACING}};
    const struct solid foot = {.kind = SOLID_BOX,
                               .from = {low[0] - half, low[1] - half},
                               .to = {high[0] + half, low[1] + 2.5 * CLOUD_SPACING}};
    const struct solid leg = {.kind = SOLID_BOX,
                              .from = {low[0] - half, low[1] - half},
                              .to = {low[0] + 2.5 * CLOUD_SPACING, high[1] + half}};
    const int64_t expected[3] = {4, 17, 0};
    for (int way = 0; way < 3; way++) {
        struct solid solids[3] = {foot, leg, disc};
        if (way == 1) solids[1] = disc, solids[2] = leg; /* a slit between disc and leg */
        struct region r = {.n = way == 0 ? 2 : 3, .solid = solids};
        const struct region *shape = &r;
        const int body = p->body[0];
        struct voids v = {.dim = 2, .shapes = 1, .shape = &shape, .body = (int *)&body, .spacing = CLOUD_SPACING};
        int64_t beside = 0;
        assert_true(region_may_have_voids(&r, &v));
        voids_mark_particles_beside_voids(&v, p, &c.cells, NULL, reach);
        for (int64_t i = 0; i < p->n; i++) {
            bool separated = false;
            const real a[DIM_MAX] = {p->X[0][i], p->X[1][i]};
            for (int64_t j = 0; j < p->n && region_level_set_value(&r, a, 2) <= 0; j++) {
                const real b[DIM_MAX] = {p->X[0][j], p->X[1][j]};
                if (j == i || hypot(b[0] - a[0], b[1] - a[1]) > reach || region_level_set_value(&r, b, 2) > 0) continue;
                separated |= void_separates_points(&v, body, a, b, NULL);
            }
            if (separated) assert_true(particle_is_beside_void(&v, i));
            beside += separated;
        }
        assert_int_equal(beside, expected[way]);
        memory_free(v.near);
    }
    particle_cloud_free(&c);
}

/* Checks that a quarter of a cylinder between planes of symmetry is known to have no voids. A cylinder whose axis is
 * not on a plane may have some, since it has a groove there, and so may shapes with a solid added or subtracted after
 * the intersection. */
static void convex_intersections(void **state)
{
    (void)state;
    struct mirror_plane planes[2] = {{.axis = 0, .outside = -1}, {.axis = 1, .outside = -1}};
    struct solid solids[3] = {
        {.kind = SOLID_CYLINDER, .to = {0, 0, 9 * SPACING}, .radius = 4 * SPACING}, block(), block()};
    struct region r = {.n = 2, .solid = solids};
    const struct region *shape;
    int body;
    struct voids v = voids_of(3, &r, &shape, &body);
    solids[1].intersect = true, solids[1].from[0] = solids[1].from[1] = 0;
    v.mirror = planes, v.mirrors = 2;
    assert_false(region_may_have_voids(&r, &v));
    solids[0].from[0] = solids[0].to[0] = 0.3 * SPACING;
    assert_true(region_may_have_voids(&r, &v));
    solids[0].from[0] = 0;
    assert_true(region_may_have_voids(&r, &v)); /* an inclined axis */
    solids[0].to[0] = 0, r.n = 3;
    assert_true(region_may_have_voids(&r, &v));
    solids[2].subtract = true;
    assert_true(region_may_have_voids(&r, &v));
    solids[2].subtract = false, solids[2].intersect = true;
    assert_false(region_may_have_voids(&r, &v));
    v.mirrors = 1, planes[0].axis = 2, planes[0].at = 9 * SPACING; /* across the axis, at its end */
    assert_true(region_may_have_voids(&r, &v));                    /* ... which the boxes do not reach */
    planes[0].at = 8 * SPACING;
    assert_false(region_may_have_voids(&r, &v));
}

/* ---- slits ------------------------------------------------------------------------------------------------------- */

/* Writes to `text` a mesh of 4 x 2 squares, or in 3D of 4 x 2 x 2 cubes, with edge 2.5. Nodes of the first two columns
 * are doubled at the height 2.5, which makes a slit from x = 0 to 5. */
static void slit_file(char *text, int dim)
{
    const int layers = dim == 3 ? 2 : 0, columns = 5, slit = 3;
    int used =
        sprintf(text, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n", (columns * 3 + slit - 1) * (layers + 1));
    for (int k = 0; k <= layers; k++)
        for (int j = 0; j < 4; j++)
            for (int i = 0; i < (j == 3 ? slit - 1 : columns); i++)
                used += sprintf(text + used, "%d %g %g %g\n", 1 + k * 17 + (j == 3 ? 15 : j * columns) + i, 2.5 * i,
                                2.5 * (j == 3 ? 1 : j), 2.5 * k);
    used += sprintf(text + used, "$EndNodes\n$Elements\n%d\n", 8 * (layers ? layers : 1));
    for (int e = 0; e < 8 * (layers ? layers : 1); e++) {
        const int i = e % 4, j = e / 4 % 2, k = e / 8, at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        used += sprintf(text + used, "%d %d 2 1 1", e + 1, dim == 3 ? 5 : 3);
        for (int c = 0; c < (dim == 3 ? 8 : 4); c++) {
            const int x = i + at[c % 4][0], y = j + at[c % 4][1];
            const bool above = y == 1 && j == 1 && x < slit - 1;
            used += sprintf(text + used, " %d", 1 + (k + c / 4) * 17 + (above ? 15 + x : y * columns + x));
        }
        used += sprintf(text + used, "\n");
    }
    sprintf(text + used, "$EndElements\n");
}

/* Checks the cracks made of doubled nodes: two collinear edges become one segment of length 5; in 3D the four squares
 * of the slit, eight triangles, become one rectangle of 5 x 5. */
static void slits_of_doubled_nodes(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        static char text[1 << 14];
        struct geometry g;
        struct crack *crack = NULL;
        int n = 0;
        slit_file(text, dim);
        FILE *file = fopen("slit.msh", "w");
        assert_non_null(file);
        fputs(text, file);
        fclose(file);
        assert_ok(geometry_read(&g, "slit.msh", dim, 1, 1e-3));
        unlink("slit.msh");
        geometry_append_mesh_slits_as_precracks(&g.whole, &crack, &n);
        assert_int_equal(n, 1);
        assert_int_equal(crack[0].n, dim == 3 ? 4 : 2);
        real area[DIM_MAX] = {0}, far = 0;
        for (int c = 0; c < crack[0].n; c++) {
            assert_near(crack[0].corner[c][1], 2.5, 1e-12);
            far = fmax(far, fabs(crack[0].corner[c][0] - 2.5));
        }
        assert_near(far, 2.5, 1e-12); /* from 0 to 5 */
        if (dim == 3) {
            crack_area_vector(&crack[0], area);
            assert_near(fabs(area[1]), 25, 1e-10);
        }
        memory_free(crack[0].corner);
        memory_free(crack);
        geometry_free(&g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(round_holes),
                                       cmocka_unit_test(thin_slot),
                                       cmocka_unit_test(joined_and_mirrored),
                                       cmocka_unit_test(bits_of_particles),
                                       cmocka_unit_test(marks_of_intersections),
                                       cmocka_unit_test(convex_intersections),
                                       cmocka_unit_test(slits_of_doubled_nodes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
