/* Tests groups of rotating points (data/turning.h): conserved quantities of both transfers of the change of velocities,
 * points to nodes and nodes to points, for any motion and all shape functions, in 2D and 3D. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "data/transfer_order.h"
#include "data/turning.h"
#include "kernels/kernels.h"

/* Tolerance relative to the largest term: sums of some hundred terms with weights whose errors are 1e-15. */
#define CLOSE 1e-12

struct scene {
    struct particle_cloud c;
    struct grid g;
    struct transfer_order order;
    struct corotating_groups turning;
    struct transfer_data t;
    uint64_t seed;
    int dim, shape;
};

/* Creates s, irregular points of two bodies in `dim` dimensions. About a fifth of the first body and more than half of
 * the smaller second one are peridynamic. shape: shape functions. */
static void scene_make(struct scene *s, int dim, int shape)
{
    static const int count[DIM_MAX + 1][DIM_MAX] = {{0}, {0}, {15, 11}, {9, 8, 7}};
    struct cloud_plan plan = {.space = dim == 2 ? SPACE_PLANE_STRESS : SPACE_SOLID,
                              .horizon = 3,
                              .shake = 0.3,
                              .seed = 5,
                              .optional = shape == SHAPE_CPGIMP ? WITH_STRETCH : 0};
    const bool held[2] = {false};
    const int one[2] = {0, 1};
    bool changed;
    real from[DIM_MAX], to[DIM_MAX];
    *s = (struct scene){.seed = 31, .dim = dim, .shape = shape};
    memcpy(plan.count, count[dim], sizeof plan.count);
    particle_cloud_make(&s->c, &plan);
    struct particles *p = &s->c.p;
    for (int64_t i = 0; i < p->n; i++) {
        p->body[i] = p->X[0][i] > 8.3 * CLOUD_SPACING;
        p->kind[i] = cloud_random(&s->seed) < (p->body[i] ? 0.6 : 0.2) ? KIND_PD : KIND_MPM;
        for (int d = 0; d < dim; d++) p->v[d][i] = cloud_between(&s->seed, -3, 5);
    }
    particles_rebuild_lists_by_kind(p);
    s->g = (struct grid){.dim = dim, .h = 2 * CLOUD_SPACING};
    for (int d = 0; d < dim; d++) {
        s->g.anchor[d] = (3.17 + d) * CLOUD_SPACING;
        particles_coordinate_range(p, p->n, d, &from[d], &to[d]);
    }
    assert_int_equal(grid_extend_box(&s->g, from, to, 100000, &changed), OK);
    transfer_order_sort_points_by_cell(&s->order, p, p->list_free, p->n_free, &s->g);
    corotating_groups_make(&s->turning, p, CLOUD_SPACING, (const real[]){0.0075, 0.0055, 0.0035}, one, held, 2);
    s->t = (struct transfer_data){
        .order = &s->order, .half_width = cloud_half_width(shape, s->g.h), .dt = 1e-14, .dt_velocity = 1};
    struct partial_stress none = {0};
    struct elastic elastic[CLOUD_MATERIALS] = {{0}};
    s->t.partial = &none, s->t.elastic = elastic;
    grid_clear(&s->g);
    p2g_table[dim][shape][TRANSFER_FLIP](&s->g, p, &s->t);
    s->t.partial = NULL, s->t.elastic = NULL;
    for (int c = 0; c < 3; c++) s->t.turn[c] = s->turning.turn[c];
}

static void scene_free(struct scene *s)
{
    corotating_groups_free(&s->turning);
    transfer_order_free(&s->order);
    grid_free(&s->g);
    particle_cloud_free(&s->c);
}

static void node_place(const struct grid *g, int64_t I, real *x)
{
    for (int d = 0; d < 3; d++) x[d] = d < g->dim ? grid_node_position(g, d, I / g->stride[d] % g->count[d]) : 0;
}

/* Adds the vector m a and its moment m x x a to sum[6], and their magnitudes to size[2]. m: mass; x, a: position and
 * vector of a point. */
static void moments_add(real m, const real *x, const real *a, real *sum, real *size)
{
    for (int c = 0; c < 3; c++) {
        const real turn = m * (x[(c + 1) % 3] * a[(c + 2) % 3] - x[(c + 2) % 3] * a[(c + 1) % 3]);
        sum[c] += m * a[c], sum[3 + c] += turn;
        size[0] += fabs(m * a[c]), size[1] += fabs(turn);
    }
}

static void points_moments(const struct particles *p, real *const *v, real *sum, real *size)
{
    for (int64_t k = 0; k < p->n_free; k++) {
        const int32_t i = p->list_free[k];
        real x[3] = {0}, own[3] = {0};
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i], own[d] = v[d][i];
        moments_add(p->mass[i], x, own, sum, size);
    }
}

/* Applies random changes of nodal velocities of s to the points. */
static void gather(struct scene *s)
{
    for (int64_t I = 0; I < s->g.n; I++)
        for (int d = 0; d < s->dim; d++) s->g.force[d][I] = s->g.mass[I] > 0 ? cloud_between(&s->seed, -2, 1) : 0;
    corotating_groups_compute_spins(&s->turning, &s->c.p, CLOUD_SPACING);
    turn_gather_table[s->dim][s->shape](&s->g, &s->c.p, &s->t);
    corotating_groups_restore_angular_momentum(&s->turning, &s->c.p);
}

/* Computes the nodal velocities of s from unchanged points. If the weights are taken ahead of the positions (grid
 * ahead), nodal masses are recomputed as well. */
static void scatter(struct scene *s)
{
    corotating_groups_compute_spins(&s->turning, &s->c.p, CLOUD_SPACING);
    for (int d = 0; d < s->dim; d++) array_fill_bytes(s->g.momentum[d], 0, s->g.n, sizeof(real));
    if (s->g.ahead[0] != 0) array_fill_bytes(s->g.mass, 0, s->g.n, sizeof(real));
    turn_scatter_table[s->dim][s->shape](&s->g, &s->c.p, &s->t);
    for (int d = 0; d < s->dim; d++)
        for (int64_t I = 0; I < s->g.n; I++) s->g.momentum[d][I] /= s->g.mass[I] > 0 ? s->g.mass[I] : 1;
}

/* Checks that the points of s gain the momentum and angular momentum of the change of nodal velocities. */
static void keeps_moments(struct scene *s)
{
    real given[6] = {0}, before[6] = {0}, after[6] = {0}, size[2] = {0}, none[2];
    points_moments(&s->c.p, s->c.p.v, before, size);
    gather(s);
    points_moments(&s->c.p, s->c.p.v, after, none);
    for (int64_t I = 0; I < s->g.n; I++) {
        real x[3], change[3] = {0};
        node_place(&s->g, I, x);
        for (int d = 0; d < s->dim; d++) change[d] = s->g.force[d][I];
        moments_add(s->g.mass[I], x, change, given, size);
    }
    for (int c = 0; c < 6; c++) assert_true(fabs(after[c] - before[c] - given[c]) <= CLOSE * size[c / 3]);
}

/* Checks that the nodes have the velocity of a rotating and translating body s at their position, or at the position
 * behind it if weights are taken ahead of the positions. */
static void turns_rigidly(struct scene *s)
{
    struct particles *p = &s->c.p;
    const real spin[3] = {s->dim == 2 ? 0 : 70, s->dim == 2 ? 0 : -310, 520}, flight[3] = {11, -7, 3};
    for (int64_t i = 0; i < p->n; i++) {
        real x[3] = {0};
        for (int d = 0; d < s->dim; d++) x[d] = p->x[d][i];
        for (int d = 0; d < s->dim; d++)
            p->v[d][i] = flight[d] + spin[(d + 1) % 3] * x[(d + 2) % 3] - spin[(d + 2) % 3] * x[(d + 1) % 3];
    }
    scatter(s);
    for (int64_t I = 0; I < s->g.n; I++) {
        real x[3];
        node_place(&s->g, I, x);
        for (int d = 0; d < s->dim; d++) x[d] -= s->g.ahead[d] * s->g.h;
        if (!(s->g.mass[I] > 1e-6 * p->mass[0])) continue; /* a weight near 0 has few digits */
        for (int d = 0; d < s->dim; d++) {
            const real right = flight[d] + spin[(d + 1) % 3] * x[(d + 2) % 3] - spin[(d + 2) % 3] * x[(d + 1) % 3];
            assert_true(fabs(s->g.momentum[d][I] - right) <= 1e-7 * 11);
        }
    }
}

/* Checks a rigidly moving body s with weights taken ahead of the positions of points, and that the nodes have the whole
 * mass of the points. */
static void flies_rigidly(struct scene *s)
{
    real points = 0, nodes = 0;
    for (int d = 0; d < s->dim; d++) s->g.ahead[d] = 0.1 - 0.06 * d;
    turns_rigidly(s);
    for (int64_t k = 0; k < s->c.p.n_free; k++) points += s->c.p.mass[s->c.p.list_free[k]];
    for (int64_t I = 0; I < s->g.n; I++) nodes += s->g.mass[I];
    assert_true(fabs(nodes - points) <= CLOSE * points);
}

/* Checks that both transfers of s are adjoint in the mass metric: the sum of m v dv over points equals that over
 * nodes. */
static void keeps_energy(struct scene *s)
{
    struct particles *p = &s->c.p;
    real *old[DIM_MAX], points = 0, nodes = 0, size = 0;
    scatter(s);
    for (int d = 0; d < s->dim; d++) {
        old[d] = BARE("test.old", p->n, real);
        array_copy(old[d], p->v[d], p->n, sizeof(real));
    }
    gather(s);
    for (int d = 0; d < s->dim; d++) {
        for (int64_t k = 0; k < p->n_free; k++) {
            const int32_t i = p->list_free[k];
            points += p->mass[i] * old[d][i] * (p->v[d][i] - old[d][i]);
        }
        for (int64_t I = 0; I < s->g.n; I++) {
            const real part = s->g.mass[I] * s->g.force[d][I] * s->g.momentum[d][I];
            nodes += part, size += fabs(part);
        }
        memory_free(old[d]);
    }
    assert_true(size > 0 && fabs(points - nodes) <= CLOSE * size);
}

static void for_all(void (*check)(struct scene *s))
{
    for (int dim = 2; dim <= DIM_MAX; dim++)
        for (int shape = 0; shape < SHAPES; shape++) {
            struct scene s;
            scene_make(&s, dim, shape);
            check(&s);
            scene_free(&s);
        }
}

static void test_moments(void **state) { (void)state, for_all(keeps_moments); }
static void test_rigid(void **state) { (void)state, for_all(turns_rigidly); }
static void test_flight(void **state) { (void)state, for_all(flies_rigidly); }
static void test_energy(void **state) { (void)state, for_all(keeps_energy); }

/* Checks that small groups are merged with groups of the same body, and that a group of a single point gains no
 * velocity. */
static void test_groups(void **state)
{
    struct scene s;
    (void)state;
    scene_make(&s, 2, SHAPE_LINEAR);
    struct particles *p = &s.c.p;
    for (int64_t i = 0; i < p->n; i++) p->kind[i] = p->body[i] == 0 || i == p->n - 1 ? KIND_MPM : KIND_PD;
    particles_rebuild_lists_by_kind(p);
    corotating_groups_compute_spins(&s.turning, p, CLOUD_SPACING);
    for (int64_t k = 0; k < p->n; k++) s.turning.turn[2][k] = 1e-9;
    const real alone = p->v[1][p->n - 1];
    corotating_groups_restore_angular_momentum(&s.turning, p);
    assert_true(p->v[1][p->n - 1] == alone);
    for (int32_t g = 0; g < s.turning.groups; g++) {
        const struct turning_group *own = &s.turning.group[g], *root = &s.turning.group[own->root];
        assert_true(own->points == 0 || own->body == 1 || own->points >= TURNING_FEW || own->root != g);
        assert_true(root->root == own->root && root->body == own->body);
    }
    scene_free(&s);
}

/* Checks that groups on both sides of the middle are neighbours, and that points of a constrained body neither receive
 * spins nor change their velocities. */
static void test_held(void **state)
{
    struct scene s;
    (void)state;
    scene_make(&s, 2, SHAPE_LINEAR);
    struct particles *p = &s.c.p;
    for (int32_t g = 0; g < s.turning.groups; g++) {
        int beside = 0;
        for (int k = 0; k < 4; k++) beside += s.turning.group[g].near[k] >= 0;
        assert_true(beside > 0);
    }
    corotating_groups_make(&s.turning, p, CLOUD_SPACING, (const real[]){0.0075, 0.0055, 0}, (const int[]){0, 0},
                           (const bool[]){true, false}, 2);
    real *before = BARE("test.before", p->n, real);
    array_copy(before, p->v[1], p->n, sizeof(real));
    corotating_groups_compute_spins(&s.turning, p, CLOUD_SPACING);
    for (int64_t k = 0; k < p->n; k++) {
        assert_true(p->kind[k] != KIND_MPM || s.turning.turn[2][k] == 0);
        s.turning.turn[2][k] = 1e-6;
    }
    corotating_groups_restore_angular_momentum(&s.turning, p);
    assert_true(arrays_equal(before, p->v[1], p->n, sizeof(real)));
    memory_free(before);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_moments), cmocka_unit_test(test_rigid),
                                       cmocka_unit_test(test_flight),  cmocka_unit_test(test_energy),
                                       cmocka_unit_test(test_groups),  cmocka_unit_test(test_held)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
