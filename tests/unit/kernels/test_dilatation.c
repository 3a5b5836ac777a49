/* Tests the mean dilatation of cells in the current frame (kernels/mpm/dilatation.h). Forces and strains must be
 * adjoint, uniform strain must not be changed, and points of several bodies or materials must not share a pressure. The
 * plain implementation is in reference_points.h, compared in test_transfers.c. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "tests/support/sets.h"
#include "base/team.h"
#include "data/grid.h"
#include "kernels/kernels.h"

/* Time step in which points rotate by 1e-7 rad [s]; terms of second order cancel in the difference of both
 * directions. */
#define STEP 1e-10
/* Stiffness with which the strains of a step cause stresses of the size of the initial stresses [Pa]. */
#define STIFF 1e15

/* A cloud of material points on a grid whose cells are `edge` spacings long. The materials have stress = STIFF strain
 * in each component. */
struct setting {
    struct particle_cloud c;
    struct grid g;
    struct transfer_order order;
    struct partial_stress none;
    struct elastic elastic[CLOUD_MATERIALS];
    struct transfer_data t;
};

/* Moves all points of s into one cell, which then has more points than a mean dilatation is computed for. */
static void setting_crowd(struct setting *s)
{
    struct particles *p = &s->c.p;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->x[d][i] = s->g.anchor[d] + s->g.h * (0.1 + 50 * p->X[d][i]);
}

static void setting_make(struct setting *s, int dim, enum shape shape, enum transfer transfer, bool crowded)
{
    uint64_t seed = 5;
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    memset(s, 0, sizeof *s);
    const int optional = (shape == SHAPE_CPGIMP ? WITH_STRETCH : 0) | (transfer == TRANSFER_APIC ? WITH_GRADIENT : 0);
    struct cloud_plan plan = {.space = dim == 2 ? SPACE_PLANE_STRAIN : SPACE_SOLID,
                              .count = {dim == 2 ? 11 : 5, dim == 2 ? 9 : 5, 4},
                              .horizon = 3,
                              .shake = 0.3,
                              .seed = 8,
                              .optional = optional};
    particle_cloud_make(&s->c, &plan);
    struct particles *p = &s->c.p;
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = KIND_MPM;
        for (int c = 0; c < symmetric_tensor_component_count(dim); c++)
            p->stress[c][i] = cloud_between(&seed, -1e8, 1e8);
    }
    particles_rebuild_lists_by_kind(p);
    s->g = (struct grid){.dim = dim, .h = 2 * CLOUD_SPACING, .anchor = {0.37e-3, 0.11e-3, 0.23e-3}};
    if (crowded) setting_crowd(s);
    for (int d = 0; d < dim; d++) particles_coordinate_range(p, p->n, d, &from[d], &to[d]);
    assert_int_equal(grid_extend_box(&s->g, from, to, 100000, &changed), OK);
    for (int m = 0; m < CLOUD_MATERIALS; m++)
        s->elastic[m] =
            (struct elastic){.c11 = STIFF, .shear = STIFF / 2, .trigger = INFINITY, .mean_dilatation = true};
    s->t = (struct transfer_data){.order = &s->order,
                                  .partial = &s->none,
                                  .elastic = s->elastic,
                                  .half_width = cloud_half_width(shape, s->g.h),
                                  .dt = STEP,
                                  .dt_velocity = STEP,
                                  .dilatation = NEW("test.dilatation", p->n, real),
                                  .mean_dilatation = true};
    transfer_order_sort_points_by_cell(&s->order, p, p->list[KIND_MPM], p->n_of[KIND_MPM], &s->g);
}

static void setting_free(struct setting *s)
{
    memory_free(s->t.dilatation);
    transfer_order_free(&s->order);
    grid_free(&s->g);
    particle_cloud_free(&s->c);
}

/* Moves the points of s by the nodal velocities in g->velocity times 1 and -1. Stores half the difference of the
 * strains over the time step as rate[c] of each point: the strain rate [1/s], in the components of stress. shape,
 * transfer: shape functions and scheme. */
static void strain_rates(struct setting *s, enum shape shape, enum transfer transfer, real *rate[SYM_MAX])
{
    for (int sign = -1; sign < 2; sign += 2) {
        struct particles p;
        const int optional = (s->c.p.stretch[0] ? WITH_STRETCH : 0) | (s->c.p.gradient[0] ? WITH_GRADIENT : 0);
        cloud_copy(&p, &s->c.p, optional);
        for (int d = 0; d < p.dim; d++)
            for (int64_t I = 0; I < s->g.n; I++) s->g.momentum[d][I] = s->g.velocity[d][I] *= sign;
        g2p_table[p.dim][shape][transfer](&s->g, &p, &s->t);
        for (int d = 0; d < p.dim; d++)
            for (int64_t I = 0; I < s->g.n; I++) s->g.velocity[d][I] *= sign;
        for (int c = 0; c < symmetric_tensor_component_count(p.dim); c++)
            for (int64_t i = 0; i < p.n; i++)
                rate[c][i] += sign * (p.stress[c][i] - s->c.p.stress[c][i]) / (2 * STIFF * STEP);
        particles_free(&p);
    }
}

/* Checks that forces and strains are adjoint, so that the stress does the work that the strain energy gains. For a
 * random motion of the nodes the power of the nodal forces must equal the sum of V sigma : strain rate over the points,
 * to 1e-12 of the sum of magnitudes. crowded: true to move all points into one cell. Returns the power divided by the
 * sum of magnitudes. */
static real adjoint(int dim, enum shape shape, enum transfer transfer, bool crowded)
{
    struct setting s;
    uint64_t seed = 3;
    real *rate[SYM_MAX], given = 0, taken = 0, size = 0;
    setting_make(&s, dim, shape, transfer, crowded);
    struct particles *p = &s.c.p;
    for (int64_t i = 0; i < p->n; i++) p->material[i] = i % 5 == 0, p->body[i] = i % 3 == 0;
    grid_clear(&s.g);
    p2g_table[dim][shape][transfer](&s.g, p, &s.t);
    for (int d = 0; d < dim; d++)
        for (int64_t I = 0; I < s.g.n; I++) {
            s.g.velocity[d][I] = cloud_between(&seed, -1, 1);
            given -= s.g.force[d][I] * s.g.velocity[d][I];
        }
    for (int c = 0; c < symmetric_tensor_component_count(dim); c++) rate[c] = NEW("test.rate", p->n, real);
    strain_rates(&s, shape, transfer, rate);
    for (int c = 0; c < symmetric_tensor_component_count(dim); c++)
        for (int64_t i = 0; i < p->n; i++) {
            const real power = p->volume[i] * p->stress[c][i] * rate[c][i] * (c < dim ? 1 : 2);
            taken += power, size += fabs(power);
        }
    for (int c = 0; c < symmetric_tensor_component_count(dim); c++) memory_free(rate[c]);
    setting_free(&s);
    assert_true(fabs(given - taken) <= 1e-12 * size);
    return given / size;
}

static void test_adjoint(void **state)
{
    (void)state;
    for (int dim = 2; dim <= DIM_MAX; dim++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int transfer = 0; transfer < TRANSFERS; transfer++)
                for (int crowded = 0; crowded < 2; crowded++)
                    assert_true(fabs(adjoint(dim, (enum shape)shape, (enum transfer)transfer, crowded)) > 1e-4);
}

/* Checks that points in a linear velocity field have the strain rate of this field, as they have without mean
 * dilatations. */
static void test_uniform(void **state)
{
    (void)state;
    static const real L[DIM_MAX][DIM_MAX] = {{700, -200, 50}, {30, -100, 80}, {10, -60, 400}};
    for (int dim = 2; dim <= DIM_MAX; dim++) {
        struct setting s;
        real *rate[SYM_MAX];
        setting_make(&s, dim, SHAPE_LINEAR, TRANSFER_FLIP, false);
        for (int c = 0; c < symmetric_tensor_component_count(dim); c++) {
            rate[c] = NEW("test.rate", s.c.p.n, real);
            for (int64_t i = 0; i < s.c.p.n; i++) s.c.p.stress[c][i] = 0;
        }
        for (int64_t I = 0; I < s.g.n; I++)
            for (int a = 0; a < dim; a++) {
                int64_t rest = I;
                s.g.velocity[a][I] = 0;
                for (int d = 0; d < dim; d++) {
                    s.g.velocity[a][I] += L[a][d] * grid_node_position(&s.g, d, rest % s.g.count[d]);
                    rest /= s.g.count[d];
                }
            }
        strain_rates(&s, SHAPE_LINEAR, TRANSFER_FLIP, rate);
        for (int64_t i = 0; i < s.c.p.n; i++)
            for (int d = 0; d < dim; d++) assert_true(fabs(rate[d][i] - L[d][d]) <= 1e-11 * 700);
        for (int c = 0; c < symmetric_tensor_component_count(dim); c++) memory_free(rate[c]);
        setting_free(&s);
    }
}

/* Computes the force along x on every node if every second point has a pressure of 1 Pa and the others none. mixed: the
 * points under pressure are 0: of the same body and material as the others, 1: of another body, 2: of another material.
 * averaged: true for mean dilatations of cells. Returns the number of nodes; *force receives the forces, to be freed by
 * the caller. */
static int64_t press(int mixed, bool averaged, real **force)
{
    struct setting s;
    setting_make(&s, 2, SHAPE_LINEAR, TRANSFER_FLIP, false);
    struct particles *p = &s.c.p;
    const int64_t n = s.g.n;
    s.t.mean_dilatation = averaged;
    for (int64_t i = 0; i < p->n; i++) {
        const bool odd = i % 2;
        for (int c = 0; c < 3; c++) p->stress[c][i] = odd && c < 2 ? -1 : 0;
        p->body[i] = mixed == 1 && odd, p->material[i] = mixed == 2 && odd;
    }
    grid_clear(&s.g);
    p2g_table[2][SHAPE_LINEAR][TRANSFER_FLIP](&s.g, p, &s.t);
    *force = NEW("test.force", n, real);
    memcpy(*force, s.g.force[0], (size_t)n * sizeof(real));
    setting_free(&s);
    return n;
}

/* Checks that points of one body and material share their pressure in a cell, and that points of several do not. */
static void test_several(void **state)
{
    (void)state;
    for (int mixed = 0; mixed < 3; mixed++) {
        real *with, *without;
        press(mixed, true, &with);
        const int64_t n = press(mixed, false, &without);
        const real off = cloud_difference(with, without, n);
        assert_true(mixed == 0 ? off > 0.1 : off <= 1e-14);
        memory_free(with), memory_free(without);
    }
}

/* Computes mean[i], for each point i of s, the mean rate of dilatation of the points of its cell, weighted by volume
 * [1/s]. */
static void means_of_cells(const struct setting *s, real *mean)
{
    const struct particles *p = &s->c.p;
    for (int64_t i = 0; i < p->n; i++) {
        real sum = 0, volume = 0;
        for (int64_t j = 0; j < p->n; j++) {
            bool same = true;
            for (int d = 0; d < p->dim; d++)
                same &= grid_cell_index_at(&s->g, d, p->x[d][i]) == grid_cell_index_at(&s->g, d, p->x[d][j]);
            if (same) volume += p->volume[j], sum += p->volume[j] * s->t.dilatation[j];
        }
        mean[i] = sum / volume;
    }
}

/* Checks points that enter other cells: half of the mean dilatation of the old cell is replaced by half of that of the
 * new cell. */
static void test_cells_change(void **state)
{
    (void)state;
    for (int dim = 2; dim <= DIM_MAX; dim++) {
        struct setting s;
        uint64_t seed = 9;
        setting_make(&s, dim, SHAPE_GIMP, TRANSFER_FLIP, false);
        struct particles *p = &s.c.p;
        real *old = NEW("test.old", p->n, real), *fresh = NEW("test.new", p->n, real), most = 0;
        for (int64_t i = 0; i < p->n; i++) s.t.dilatation[i] = cloud_between(&seed, -1e3, 1e3), p->stress[0][i] = 0;
        means_of_cells(&s, old);
        points_add_mean_dilatation(p, &s.t, -0.5);
        for (int64_t i = 0; i < p->n; i++) p->x[0][i] += 0.4 * CLOUD_SPACING;
        transfer_order_sort_points_by_cell(&s.order, p, p->list[KIND_MPM], p->n_of[KIND_MPM], &s.g);
        means_of_cells(&s, fresh);
        points_add_mean_dilatation(p, &s.t, 0.5);
        for (int64_t i = 0; i < p->n; i++) {
            const real right = 0.5 * STIFF * STEP * (fresh[i] - old[i]) / dim;
            assert_true(fabs(p->stress[0][i] - right) <= 1e-6 * STIFF * STEP * 1e3);
            most = fmax(most, fabs(right));
        }
        assert_true(most > 0.01 * STIFF * STEP * 1e3);
        memory_free(old), memory_free(fresh);
        setting_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_adjoint),
        cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_several),
        cmocka_unit_test(test_cells_change),
    };
    threads_set_count_and_bind_to_cores(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
