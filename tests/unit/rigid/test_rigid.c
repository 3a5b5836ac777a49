/* Tests rigid bodies: distances against a search over points of the surface, inertia and free motion against closed
 * forms, polygons of their surfaces, records in the history, refusals. */
#include <math.h>
#include <string.h>

#include "engine/engine.h"
#include "base/memory.h"
#include "rigid/rigid.h"
#include "tests/support/near.h"
#include "rigid/rigid_part.h"
#include "rigid/rigid_surface.h"

/* ---- distances --------------------------------------------------------------------------------------------------- */

/* A box with a ball on it, and a cylinder. */
static struct solid solids[] = {
    {.kind = SOLID_BOX, .from = {0, 0, 0}, .to = {4, 2, 3}},
    {.kind = SOLID_BALL, .centre = {5, 1, 1}, .radius = 1.5},
    {.kind = SOLID_CYLINDER, .from = {-3, 0, 0}, .to = {-3, 4, 1}, .radius = 1},
};
static const struct region shape = {.n = 3, .solid = solids};

/* Checks the distance of the position x outside the bodies: it decreases to 0 along the normal, and no point of a body
 * is closer, i.e. the ball of this radius around x contains none of its points. */
static void check_point(const real *x)
{
    real normal[DIM_MAX], at[DIM_MAX];
    const real distance = region_signed_distance(&shape, x, 3, normal);
    assert_near(dot(normal, normal, 3), 1, 1e-12);
    for (int d = 0; d < 3; d++) at[d] = x[d] - distance * normal[d];
    real other[DIM_MAX];
    if (distance > 0) assert_near(region_signed_distance(&shape, at, 3, other), 0, 1e-12);
    for (int k = 0; k < 500 && distance > 0; k++) {
        const real a = 0.37 * k, b = acos(1 - 2 * (k + 0.5) / 500);
        const real on[] = {x[0] + 0.999 * distance * sin(b) * cos(a), x[1] + 0.999 * distance * sin(b) * sin(a),
                           x[2] + 0.999 * distance * cos(b)};
        assert_false(region_contains(&shape, on, 3, 0));
    }
    assert_int_equal(distance < 0, region_contains(&shape, x, 3, -1e-12));
}

static void test_distance(void **state)
{
    (void)state;
    for (int k = 0; k < 343; k++)
        check_point((const real[]){-5.03 + 2 * (k % 7), -2.01 + k / 7 % 7, -2.02 + 1.1 * (k / 49)});
}

/* Checks a box with a spherical cavity. Inside the cavity the distance is that to its wall, and the normal points from
 * the wall to the position, as outside the box. */
static void test_cavity(void **state)
{
    (void)state;
    static struct solid hollow[] = {{.kind = SOLID_BOX, .from = {0, 0, 0}, .to = {4, 3, 5}},
                                    {.kind = SOLID_BALL, .centre = {1.7, 1.4, 2.1}, .radius = 1.3, .subtract = true}};
    const struct region cavity = {.n = 2, .solid = hollow};
    static const real way[][DIM_MAX] = {{0.6, 0, 0.8}, {-0.48, 0.6, -0.64}, {0.28, -0.96, 0}};
    for (size_t k = 0; k < COUNT_OF(way); k++)
        for (int out = 0; out < 2; out++) {
            const real r = out ? 1.35 : 0.4;
            real X[DIM_MAX], normal[DIM_MAX];
            for (int d = 0; d < DIM_MAX; d++) X[d] = hollow[1].centre[d] + r * way[k][d];
            assert_near(region_signed_distance(&cavity, X, 3, normal), 1.3 - r, 1e-12);
            for (int d = 0; d < DIM_MAX; d++) assert_near(normal[d], -way[k][d], 1e-12);
        }
}

/* ---- surfaces in files ---------------------------------------------------------------------------------------------
 */

/* Returns the area (2D) or volume (3D) enclosed by the faces of the surface s, by Gauss's theorem; a quadrilateral is
 * divided into two triangles. */
static real enclosed(const struct rigid_surface *s)
{
    real sum = 0;
    for (int64_t k = 0; k < s->faces; k++) {
        const int32_t *c = s->corner + k * s->corners;
        const real *a = s->X + c[0] * DIM_MAX, *b = s->X + c[1] * DIM_MAX;
        if (s->corners == 2) sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        for (int t = 1; t + 1 < s->corners; t++) {
            const real *p = s->X + c[t] * DIM_MAX, *q = s->X + c[t + 1] * DIM_MAX;
            sum += (a[0] * (p[1] * q[2] - p[2] * q[1]) + a[1] * (p[2] * q[0] - p[0] * q[2]) +
                    a[2] * (p[0] * q[1] - p[1] * q[0])) /
                   6;
        }
    }
    return fabs(sum);
}

/* Checks the polygonal surfaces of a disc, a ball, a brick and a rotated brick. The enclosed size must be right within
 * the resolution of the grids (200 cells across in 2D, 24 in 3D), and points must be on the surface. A half-space is
 * cut off at the given box. */
static void test_surface(void **state)
{
    (void)state;
    const real pi = 3.14159265358979323846, low[] = {-2, -2, -2}, high[] = {2, 2, 2};
    static struct solid ball = {.kind = SOLID_BALL, .centre = {0.2, 0.1, -0.3}, .radius = 1.7};
    static struct solid brick = {.kind = SOLID_BOX, .from = {-1.5, -1, -0.8}, .to = {1.1, 0.7, 0.9}};
    static struct solid ground = {
        .kind = SOLID_BOX, .from = {-INFINITY, -INFINITY, -INFINITY}, .to = {INFINITY, INFINITY, 0}};
    static struct solid turned = {.kind = SOLID_BOX, .from = {-1.5, -1, -0.8}, .to = {1.1, 0.7, 0.9}};
    static const struct {
        struct solid *solid;
        int dim;
        real size, within;
    } body[] = {{&ball, 2, 1.7 * 1.7, 1e-3},         {&ball, 3, 4.0 / 3 * 1.7 * 1.7 * 1.7, 0.01},
                {&brick, 2, 2.6 * 1.7, 1e-6},        {&brick, 3, 2.6 * 1.7 * 1.7, 1e-6},
                {&turned, 3, 2.6 * 1.7 * 1.7, 2e-3}, {&ground, 3, 32, 1e-6}};
    const struct solid_motion motion = {.kind = MOTION_ROTATE, .angle = 0.4, .axis = {1, 2, 3}};
    assert_true(solid_apply_motion_unless_too_many_copies(&turned, &motion, 3));
    for (size_t k = 0; k < COUNT_OF(body); k++) {
        const struct region region = {.n = 1, .solid = body[k].solid};
        struct rigid_surface s;
        real a[DIM_MAX], b[DIM_MAX];
        if (!region_compute_bounding_box_if_finite(&region, body[k].dim, a, b))
            memcpy(a, low, sizeof a), memcpy(b, high, sizeof b);
        rigid_surface_approximate_by_polygons(&s, &region, body[k].dim, a, b);
        const real size = body[k].size * (body[k].solid == &ball ? pi : 1);
        assert_near(enclosed(&s) / size, 1, body[k].within);
        for (int64_t q = 0; q < s.points && body[k].solid == &ball; q++) {
            real r2 = 0;
            for (int d = 0; d < body[k].dim; d++) r2 += square(s.X[q * DIM_MAX + d] - ball.centre[d]);
            assert_near(sqrt(r2) / 1.7, 1, 0.01);
        }
        rigid_surface_free(&s);
    }
    solid_free(&turned);
}

/* Checks that a half-space beyond the box of the particles has a surface on its face, as wide as the box. The box is
 * enlarged by a margin of 0.08 of its longest edge, 5, also where the half-space cuts it. */
static void test_surface_of_a_plane_afar(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        const real face = k == 0 ? -7.5 : -1.2;
        struct solid below = {
            .kind = SOLID_BOX, .from = {-INFINITY, -INFINITY, -INFINITY}, .to = {INFINITY, INFINITY, face}};
        const struct region region = {.n = 1, .solid = &below};
        real low[] = {-2, -2, -2}, high[] = {2, 3, 2};
        struct rigid_surface s;
        int on_face = 0;
        assert_false(rigid_compute_plotting_box(&region, 3, low, high));
        if (k > 0) assert_near(low[2], -2.4, 1e-12);
        assert_near(high[1], 3.4, 1e-12);
        rigid_surface_approximate_by_polygons(&s, &region, 3, low, high);
        for (int64_t q = 0; q < s.points; q++) on_face += fabs(s.X[q * DIM_MAX + 2] - face) < 1e-3;
        assert_true(on_face > 60); /* of at least 10 x 12 cells, without those at the rim */
        rigid_surface_free(&s);
    }
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* Velocity of a body at rest. */
static const real rest[DIM_MAX] = {0, 0, 0};

/* Compares moments of inertia with closed forms: a brick, m/12 (b^2 + c^2), to round-off, because cells of the grid fit
 * it; a disc, m R^2/2, within 1e-3 with a grid of points. */
static void test_inertia(void **state)
{
    (void)state;
    static struct solid brick = {.kind = SOLID_BOX, .from = {1, 1, 1}, .to = {5, 3, 2}};
    static struct solid disc = {.kind = SOLID_BALL, .centre = {1, 2}, .radius = 3};
    const struct region a = {.n = 1, .solid = &brick}, b = {.n = 1, .solid = &disc};
    struct rigid_body r = {.name = "brick"};
    assert_ok(rigid_make(&r, &a, 3, 5.3, rest, 1));
    assert_near(r.inertia[0][0], 5.3 / 12 * (4 + 1), 1e-10);
    assert_near(r.inertia[1][1], 5.3 / 12 * (16 + 1), 1e-10);
    assert_near(r.inertia[2][2], 5.3 / 12 * (16 + 4), 1e-10);
    assert_near(r.inertia[0][1], 0, 1e-10);
    assert_near(r.centre[0], 3, 1e-12);
    r = (struct rigid_body){.name = "disc"};
    assert_ok(rigid_make(&r, &b, 2, 2, rest, 1));
    assert_near(r.inertia[2][2], 9, 5e-3 * 9);
}

/* Checks mass centre and inertia of composite bodies with one small part. Parts do not overlap, or a rod ends in the
 * centre of a ball. Expected moments follow from Steiner's theorem. The tolerance of 0.5 % for each part is the limit
 * at which the sampling is refined. */
static void test_inertia_of_composites(void **state)
{
    (void)state;
    static struct solid discs[] = {{.kind = SOLID_BALL, .centre = {0, 0}, .radius = 1},
                                   {.kind = SOLID_BALL, .centre = {300, 0}, .radius = 2}};
    static struct solid hammer[] = {{.kind = SOLID_BALL, .centre = {2, 1}, .radius = 6},
                                    {.kind = SOLID_BOX, .from = {2, 0.8}, .to = {82, 1.2}}};
    static struct solid rods[2][2] = {
        {{.kind = SOLID_BALL, .radius = 5}, {.kind = SOLID_CYLINDER, .to = {0, 0, 60}, .radius = 1.5}},
        {{.kind = SOLID_BALL, .radius = 5}, {.kind = SOLID_CYLINDER, .to = {0, 0, 100}, .radius = 0.5}}};
    /* expected: position of the mass centre along `axis`, moment of inertia across it, for the mass 2.3 */
    static const struct {
        struct solid *solid;
        int dim, axis;
        real centre, inertia;
    } bodies[] = {{discs, 2, 0, 240, 33123.91},
                  {hammer, 2, 0, 10.91957, 949.6904},
                  {rods[0], 3, 2, 13.84074, 854.2949},
                  {rods[1], 3, 2, 6.548114, 927.9531}};
    for (size_t k = 0; k < COUNT_OF(bodies); k++) {
        const struct region region = {.n = 2, .solid = bodies[k].solid};
        const int across = bodies[k].dim == 2 ? 2 : 0;
        struct rigid_body r = {.name = "composite"};
        assert_ok(rigid_make(&r, &region, bodies[k].dim, 2.3, rest, 1));
        assert_close(r.centre[bodies[k].axis], bodies[k].centre, 5e-3);
        assert_close(r.inertia[across][across], bodies[k].inertia, 5e-3);
    }
}

/* Checks free rotation about the axis of the middle moment of inertia, which is unstable: energy and angular momentum
 * stay constant. */
static void test_tumbling(void **state)
{
    (void)state;
    static struct solid brick = {.kind = SOLID_BOX, .from = {-2, -1, -0.5}, .to = {2, 1, 0.5}};
    const struct region a = {.n = 1, .solid = &brick};
    struct rigid_body r = {.name = "brick"};
    assert_ok(rigid_make(&r, &a, 3, 6, rest, 1));
    memcpy(r.angular, (const real[]){0.01, 8.5, 0.01}, sizeof r.angular);
    rigid_advance_one_step(&r, 0, 1e-3, 1e-3);
    const real before = rigid_kinetic_energy(&r);
    real least = INFINITY;
    for (int k = 0; k < 30000; k++) {
        rigid_advance_one_step(&r, 0, 1e-3, 1e-3);
        least = real_min(least, r.turn[1][1]);
        assert_near(rigid_kinetic_energy(&r), before, 1e-5 * before);
    }
    assert_true(least < -0.9); /* check: it has turned over */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            real sum = 0;
            for (int k = 0; k < 3; k++) sum += r.turn[i][k] * r.turn[j][k];
            assert_near(sum, i == j, 1e-11);
        }
}

/* Compares the motion under constant force and moment with the closed forms of leap-frog integration, and the energy
 * with the work. */
static void test_driven(void **state)
{
    (void)state;
    static struct solid disc = {.kind = SOLID_BALL, .centre = {1, 2}, .radius = 3};
    const struct region b = {.n = 1, .solid = &disc};
    struct rigid_body r = {.name = "disc"}, driven = {.name = "plate", .ramp = 1};
    assert_ok(rigid_make(&r, &b, 2, 2, rest, 1));
    assert_ok(rigid_make(&driven, &b, 2, 0, (const real[]){3, 0, 0}, 1));
    real normal[DIM_MAX];
    for (int k = 0; k < 1000; k++) {
        r.force[0] = 4, r.moment[2] = 2;
        driven.force[0] = -5 - 3 * k * 2e-3;
        rigid_add_work_of_prescribed_motion(&driven);
        rigid_advance_one_step(&r, (k + 0.5) * 2e-3, 2e-3, k == 0 ? 1e-3 : 2e-3);
        rigid_advance_one_step(&driven, (k + 0.5) * 2e-3, 2e-3, 2e-3);
    }
    assert_near(r.x[0], 1 + 0.5 * 2 * 4, 1e-9);
    assert_near(atan2(r.turn[1][0], r.turn[0][0]), 0.5 * 2 / r.inertia[2][2] * 4, 1e-9);
    assert_near(driven.x[0], 1 + 3 * 1.5, 1e-9);
    /* Integral of (5 + 3 t) v over 2 s, v = 3 t up to 1 s, then 3; by the trapezoidal rule. */
    assert_near(rigid_work_of_prescribed_motion_and_weight(&driven), 39, 1e-3);
    assert_near(rigid_signed_distance(&driven, (const real[]){5.5 + 5, 2, 0}, normal), 2, 1e-9);
}

/* Checks a brick in free 3D motion. The velocity of its points is the rate of change of their positions, and the
 * kinetic energy increases by the work of force, weight and moment. */
static void test_points_move(void **state)
{
    (void)state;
    static struct solid brick = {.kind = SOLID_BOX, .from = {1, 0, -2}, .to = {4, 1.3, 0.6}};
    const struct region a = {.n = 1, .solid = &brick};
    const real force[] = {4, -3, 2.5}, weight[] = {0.7, 1.1, -9}, moment[] = {2, 0.4, -1.7}, dt = 1e-4;
    struct rigid_body r = {.name = "brick"};
    assert_ok(rigid_make(&r, &a, 3, 5.3, (const real[]){0.3, -0.2, 0.5}, 1));
    memcpy(r.weight, weight, sizeof weight);
    memcpy(r.angular, (const real[]){3, -2, 1.5}, sizeof r.angular);
    real X[] = {3.7, 0.2, 0.4}, before[3], after[3], v[3], work = 0, start = 0;
    for (int k = 0; k < 5000; k++) {
        memcpy(r.force, force, sizeof force), memcpy(r.moment, moment, sizeof moment);
        if (k == 0)
            for (int d = 0; d < 3; d++) r.force[d] = r.moment[d] = r.weight[d] = 0;
        rigid_compute_current_position_of_point(&r, X, before);
        rigid_advance_one_step(&r, 0, dt, dt);
        rigid_compute_current_position_of_point(&r, X, after);
        if (k == 0) start = r.kinetic, memcpy(r.weight, weight, sizeof weight);
        for (int d = 0; d < 3 && k > 0; d++) /* the kinetic energy is that before the last step's motion */
            work += (force[d] * r.increment[d] + moment[d] * r.spin[d] * dt) * (k == 4999 ? 0.5 : 1);
    }
    rigid_compute_velocity_at_point(
        &r, (const real[]){0.5 * (before[0] + after[0]), 0.5 * (before[1] + after[1]), 0.5 * (before[2] + after[2])},
        v);
    for (int d = 0; d < 3; d++) assert_near((after[d] - before[d]) / dt, v[d], 3e-3); /* the centre is dt/2 older */
    for (int d = 0; d < 3; d++) work += weight[d] * (r.x[d] - r.centre[d] - 0.5 * r.increment[d]);
    assert_near(r.kinetic, start + work, 2e-3 * work);
    assert_true(work > 0.5);
}

/* Checks the kinetic energy that half a velocity update adds: half a step times the power of force, weight and moment.
 * A driven body has none. */
static void test_kick(void **state)
{
    (void)state;
    struct rigid_body r = {.dim = 3,
                           .motion = RIGID_FREE,
                           .turns = true,
                           .mass = 5.3,
                           .v = {0.3, -0.2, 0.5},
                           .force = {4, -3, 2.5},
                           .weight = {0.7, 1.1, -9},
                           .moment = {2, 0.4, -1.7},
                           .spin = {0.6, -1.3, 0.9}};
    const real force = 4 * 0.3 + 3 * 0.2 + 2.5 * 0.5, weight = 0.7 * 0.3 - 1.1 * 0.2 - 9 * 0.5;
    const real moment = 2 * 0.6 - 0.4 * 1.3 - 1.7 * 0.9;
    assert_close(rigid_half_step_kinetic_energy_change(&r, 0.03), 0.015 * (force + weight + moment), 1e-14);
    r.turns = false;
    assert_close(rigid_half_step_kinetic_energy_change(&r, 0.03), 0.015 * (force + weight), 1e-14);
    r.motion = RIGID_DRIVEN;
    assert_exact(rigid_half_step_kinetic_energy_change(&r, 0.03), 0);
}

/* ---- in the engine ----------------------------------------------------------------------------------------------- */

/* Returns the value of column `name` of history.csv in `record`, which has n columns. */
static real recorded(const struct column *column, const real *record, int n, const char *name)
{
    for (int k = 0; k < n; k++)
        if (strcmp(column[k].name, name) == 0) return record[k];
    fail_msg("no column %s", name);
    return NAN;
}

/* Checks the record of two bodies in the history: each value is in its column. In 2D the moment is about z. Energies
 * are sums over both bodies. */
static void test_record(void **state)
{
    (void)state;
    static const char *const what[] = {"force_", "moment_", "", "velocity_"};
    struct rigid_body body[2];
    for (int b = 0; b < 2; b++) {
        body[b] = (struct rigid_body){
            .motion = RIGID_FREE, .mass = 5.3 + 2 * b, .kinetic = 0.9 + 1.7 * b, .work = 3.1 + 0.4 * b};
        snprintf(body[b].name, sizeof body[b].name, "%s", b ? "ram" : "anvil");
        for (int d = 0; d < 3; d++) {
            body[b].force[d] = 11 + d + 30 * b, body[b].moment[d] = 14.5 + d + 30 * b;
            body[b].x[d] = body[b].centre[d] = 17.25 + d + 30 * b, body[b].v[d] = 20.75 + d + 30 * b;
        }
    }
    static struct run e;
    struct rigid_set rigid = {.n = 2, .moves = true, .body = body};
    e.rigid = &rigid;
    for (int dim = 1; dim <= 3; dim++) {
        struct column column[24];
        real record[24], kinetic = 0, kick = 0;
        int wanted = 0;
        rigid.dim = body[0].dim = body[1].dim = dim;
        const int n = rigids_list_history_columns(&e, NULL);
        assert_int_equal(rigids_list_history_columns(&e, column), n);
        rigids_store_motion_before_step(&rigid, 0);
        rigids_write_history_values(&e, record);
        for (int b = 0; b < 2; b++) {
            const real *const from[] = {body[b].force, body[b].moment, body[b].x, body[b].v};
            for (int d = 0; d < dim; d++) {
                kinetic += 0.5 * body[b].mass * square(body[b].v[d]);
                kick += 0.015 * body[b].force[d] * body[b].v[d];
            }
            for (int k = 0; k < 4; k++)
                for (int d = k == 1 && dim == 2 ? 2 : 0; d < (k != 1 ? dim : dim > 1 ? 3 : 0); d++, wanted++) {
                    char name[64];
                    snprintf(name, sizeof name, "%s_%s%c", b ? "ram" : "anvil", what[k], "xyz"[d]);
                    assert_exact(recorded(column, record, n, name), from[k][d]);
                }
        }
        assert_int_equal(n, wanted);
        const struct rigid_energy sum = rigids_compute_energy(&rigid, 0.03);
        assert_close(sum.before, kinetic, 1e-14);
        assert_close(sum.last, kinetic + kick, 1e-14);
        assert_close(sum.step, 0.9 + 2.6, 1e-14);
        assert_close(sum.work, 3.1 + 3.5, 1e-14);
    }
    memory_free(rigid.motion);
}

/* Compares the displacement of a driven body, computed from its speed and ramp, with the sum of its steps. */
static void test_ramp(void **state)
{
    (void)state;
    static struct solid disc = {.kind = SOLID_BALL, .centre = {1, 2}, .radius = 3};
    const struct region b = {.n = 1, .solid = &disc};
    struct rigid_body r = {.name = "plate", .ramp = 0.7};
    assert_ok(rigid_make(&r, &b, 2, 0, (const real[]){3, -1.3, 0}, 1));
    for (int k = 0; k < 1000; k++) {
        real way[DIM_MAX];
        rigid_advance_one_step(&r, (k + 0.5) * 2e-3, 2e-3, 2e-3);
        assert_near(rigid_compute_prescribed_displacement(&r, (k + 1) * 2e-3, way), hypot(r.x[0] - 1, r.x[1] - 2),
                    1e-9);
        for (int d = 0; d < 2; d++) assert_near(way[d], r.x[d] - r.centre[d], 1e-9);
    }
}

/* Checks that invalid rigid bodies are refused, also a free body with a part so thin (1 : 1000) that its mass is
 * uncertain; a fixed body may have such a part. */
static void test_refused(void **state)
{
    (void)state;
    static struct solid half = {.kind = SOLID_HALF_SPACE, .normal = {0, 1, 0}}, none = {.kind = SOLID_BOX};
    const struct region a = {.n = 1, .solid = &half}, b = {.n = 1, .solid = &none};
    struct rigid_body r = {.name = "floor"};
    assert_ok(rigid_make(&r, &a, 2, 0, rest, 1));
    assert_int_equal(rigid_make(&r, &a, 2, 1, rest, 1), REFUSED);
    assert_int_equal(rigid_make(&r, &b, 2, 0, rest, 1), REFUSED);
    static struct solid thin[] = {{.kind = SOLID_CYLINDER, .to = {0, 0, 100}, .radius = 0.05},
                                  {.kind = SOLID_BALL, .centre = {0, 0, 104}, .radius = 4}};
    const struct region c = {.n = 2, .solid = thin};
    assert_ok(rigid_make(&r, &c, 3, 0, rest, 1));
    assert_int_equal(rigid_make(&r, &c, 3, 1.7, rest, 1), REFUSED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distance),    cmocka_unit_test(test_cavity),
        cmocka_unit_test(test_surface),     cmocka_unit_test(test_surface_of_a_plane_afar),
        cmocka_unit_test(test_inertia),     cmocka_unit_test(test_inertia_of_composites),
        cmocka_unit_test(test_tumbling),    cmocka_unit_test(test_driven),
        cmocka_unit_test(test_points_move), cmocka_unit_test(test_ramp),
        cmocka_unit_test(test_kick),        cmocka_unit_test(test_record),
        cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
