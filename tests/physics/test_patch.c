/* Patch tests of each method alone (test_coupling.c has those of coupled methods): uniform strain must cause no force
 * on inner particles and nodes, and the elastic energy or stress must agree with closed forms on the lattice. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/patch.h"
#include "base/team.h"

#define STRAIN 1e-6 /* bonds stretch with finite deformation: relative deviations from linear theory of this order */

/* Returns true if particle i of p is farther than `reach` spacings from every face of the lattice of count[dim]
 * particles. */
static bool inside(const struct particles *p, int64_t i, const int *count, real reach)
{
    for (int d = 0; d < p->dim; d++)
        if (p->X[d][i] < reach * CLOUD_SPACING || p->X[d][i] > (count[d] - reach) * CLOUD_SPACING) return false;
    return true;
}

/* ---- peridynamics ------------------------------------------------------------------------------------------------ */

/* Lattices whose middle particle has a complete neighbourhood, in every space. */
static const struct cloud_plan lattice[] = {
    {.space = SPACE_LINE, .count = {15}, .horizon = 3},
    {.space = SPACE_PLANE_STRESS, .count = {9, 9}, .horizon = 3.015},
    {.space = SPACE_PLANE_STRAIN, .count = {9, 9}, .horizon = 3.015},
    {.space = SPACE_SOLID, .count = {9, 9, 9}, .horizon = 3.015},
};

/* Checks that the forces on inner particles of a uniformly strained lattice vanish. Tolerance, relative to the sum of
 * the magnitudes of the bond forces: round-off of positions, 1e-15 of a spacing over strains of 1e-2. */
static void test_pd_rest(void **state)
{
    (void)state;
    static const real strain[DIM_MAX][DIM_MAX] = {{0.01, 0.004, -0.003}, {0.002, -0.007, 0.005}, {0.001, 0.006, 0.008}};
    for (size_t k = 0; k < COUNT_OF(lattice); k++)
        for (int volume = VOLUME_WHOLE; volume <= VOLUME_CUT_RAMP; volume++) {
            struct particle_cloud c;
            struct cloud_plan plan = lattice[k];
            int checked = 0;
            plan.volume = (enum volume_rule)volume;
            particle_cloud_make(&c, &plan);
            cloud_bonds(&c);
            cloud_strain(&c, strain);
            bond_force_table[c.p.dim][PD_BOND](&c.bonds, &c.p, &c.source.limit, NULL);
            real weights = c.source.family.full / c.source.family.cell_volume;
            for (int64_t i = 0; i < c.p.n; i++) {
                if (!inside(&c.p, i, plan.count, plan.horizon + (volume == VOLUME_RAMP))) continue;
                for (int d = 0; d < c.p.dim; d++)
                    at_most("inner force", c.p.f[d][i] / (c.bonds.stiffness * weights * 0.01), 1e-12);
                checked++;
            }
            assert_true(checked > 0);
            particle_cloud_free(&c);
        }
}

/* Computes stress[k] of the bonds of the middle particle of a body by `plan` under the displacement gradient `strain`
 * [Pa]. */
static void lattice_stress(const struct cloud_plan *plan, const real strain[DIM_MAX][DIM_MAX], real *stress)
{
    struct particle_cloud c;
    particle_cloud_make(&c, plan);
    cloud_bonds(&c);
    cloud_strain(&c, strain);
    bond_stress_table[c.p.dim][PD_BOND](&c.bonds, &c.p);
    for (int s = 0; s < symmetric_tensor_component_count(c.p.dim); s++) stress[s] = c.p.stress[s][c.p.n / 2];
    particle_cloud_free(&c);
}

/* Dilatational stiffness and elastic constants C11, C12, C66 of a lattice, divided by those of the material [1]. */
struct constants {
    real dilatation, c11, c12, c66;
};

static struct constants lattice_constants(const struct cloud_plan *plan)
{
    static const real dilatation[DIM_MAX][DIM_MAX] = {{STRAIN}, {0, STRAIN}, {0, 0, STRAIN}},
                      axial[DIM_MAX][DIM_MAX] = {{STRAIN}};
    static const real shear[DIM_MAX][DIM_MAX] = {{0, STRAIN}, {STRAIN, 0}};
    struct constants result = {1, 1, 1, 1};
    struct particle_cloud c;
    real stress[SYM_MAX];
    const int dim = space_dim(plan->space);
    particle_cloud_make(&c, plan);
    const struct material m = c.material[0];
    particle_cloud_free(&c);
    lattice_stress(plan, dilatation, stress);
    result.dilatation = stress[0] / (STRAIN * (m.c11 + (dim - 1) * m.c12));
    lattice_stress(plan, axial, stress);
    result.c11 = stress[0] / (STRAIN * m.c11);
    if (dim == 1) return result;
    result.c12 = stress[1] / (STRAIN * m.c12);
    lattice_stress(plan, shear, stress);
    result.c66 = stress[dim] / (STRAIN * 2 * m.shear);
    return result;
}

/* Checks the calibration on the lattice: the dilatational stiffness is exact, and C11, C12, C66 differ from those of
 * the material by the known anisotropy of the lattice only (tolerance 6e-4). */
static void test_pd_lattice(void **state)
{
    (void)state;
    static const struct constants expected[] = {
        {1, 1, 1, 1}, {1, 1.011, 0.966, 0.966}, {1, 1.011, 0.966, 0.966}, {1, 0.943, 1.086, 1.086}};
    for (size_t k = 0; k < COUNT_OF(lattice); k++) {
        struct constants c = lattice_constants(&lattice[k]);
        is_near("dilatation", c.dilatation, 1, 3 * STRAIN);
        /* Plane strain has another C11 : C12 than plane stress, but bonds have 3 : 1 in both, as in every bond-based
         * body in 2D. */
        is_near("C11", c.c11, expected[k].c11, 6e-4);
        is_near("C12", c.c12, expected[k].c12, 6e-4);
        is_near("C66", c.c66, expected[k].c66, 6e-4);
    }
}

/* Checks that weights that differ between axes and diagonals make the elastic constants of the lattice those of the
 * isotropic material. */
static void test_pd_isotropic(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(lattice); k++)
        for (int volume = VOLUME_WHOLE; volume <= VOLUME_CUT_RAMP; volume++) {
            struct cloud_plan plan = lattice[k];
            plan.shells = SHELLS_ISOTROPIC;
            plan.volume = (enum volume_rule)volume;
            for (int d = 0; d < space_dim(plan.space); d++) plan.count[d] += 2;
            struct constants c = lattice_constants(&plan);
            /* Weights are stored in single precision, with round-off 6e-8 each. */
            is_near("dilatation", c.dilatation, 1, 3 * STRAIN);
            is_near("C11", c.c11, 1, 3 * STRAIN);
            is_near("C12", c.c12, 1, 3 * STRAIN);
            is_near("C66", c.c66, 1, 3 * STRAIN);
        }
}

/* Checks the ratio of the dilatational stiffness of the lattice to that of the material for the continuum and the
 * volume-modified calibration against expected values (tolerance 6e-4). */
static void test_pd_calibrations(void **state)
{
    (void)state;
    static const struct {
        size_t lattice;
        enum volume_rule volume;
        enum calibration calibration;
        real expected;
    } rule[] = {
        {0, VOLUME_WHOLE, CALIBRATION_CONTINUUM, 4.0 / 3},  {0, VOLUME_WHOLE, CALIBRATION_VMPD, 1 - 1.0 / 49},
        {1, VOLUME_WHOLE, CALIBRATION_CONTINUUM, 1.025},    {1, VOLUME_RAMP, CALIBRATION_CONTINUUM, 1.018},
        {1, VOLUME_CUT_RAMP, CALIBRATION_CONTINUUM, 0.862}, {3, VOLUME_WHOLE, CALIBRATION_CONTINUUM, 1.099},
        {3, VOLUME_RAMP, CALIBRATION_CONTINUUM, 1.059},
    };
    for (size_t k = 0; k < COUNT_OF(rule); k++) {
        struct cloud_plan plan = lattice[rule[k].lattice];
        plan.volume = rule[k].volume;
        plan.calibration = rule[k].calibration;
        for (int d = 0; d < space_dim(plan.space); d++) plan.count[d] += 2;
        is_near("dilatation", lattice_constants(&plan).dilatation, rule[k].expected, 6e-4);
    }
}

/* ---- material points --------------------------------------------------------------------------------------------- */

/* Checks that two points per cell and direction, aligned with the cells, under uniform stress cause no force on inner
 * nodes, for every shape function, and a force on nodes at the edge. */
static void test_mpm_rest(void **state)
{
    (void)state;
    static const real from[DIM_MAX] = {4, 4, 4},
                      to[DIM_MAX] = {8, 8, 8}; /* two cells from the edge: the reach of the cubic shape */
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int shape = 0; shape < SHAPES; shape++) {
            struct patch s = {0};
            const enum space space = dim == 1 ? SPACE_LINE : dim == 2 ? SPACE_PLANE_STRESS : SPACE_SOLID;
            particle_cloud_make(
                &s.c,
                &(struct cloud_plan){.space = space, .count = {12, 12, 12}, .horizon = 3, .optional = WITH_STRETCH});
            for (int64_t i = 0; i < s.c.p.n; i++) {
                s.c.p.kind[i] = KIND_MPM;
                for (int c = 0; c < symmetric_tensor_component_count(dim); c++) s.c.p.stress[c][i] = 1e6 * (c + 1);
            }
            particles_rebuild_lists_by_kind(&s.c.p);
            patch_grid(&s, 2, 0);
            patch_map(&s, (enum shape)shape);
            real face = 1e6 * pow(2 * CLOUD_SPACING, dim - 1) * s.c.source.family.section;
            at_most("inner nodal force", patch_residual(&s, from, to) / face, 1e-12); /* relative to about six
                                                                                       * stresses */
            assert_true(patch_residual(&s, (real[]){-9, -9, -9}, (real[]){99, 99, 99}) >
                        0.4 * face); /* check: the edge has a force */
            patch_free(&s);
        }
}

/* Returns the largest force on an inner node in 1D, divided by stress times cross-section [1], under uniform stress
 * with the shape functions `shape`, for the worst of 500 positions of the points in their cells. lambda: stretch of the
 * points, of which there are two per cell at lambda = 1. With cpGIMP, the exact mean of the hat functions, the force is
 * 0 up to lambda = 4, where a point is two cells wide; beyond, the width is limited and gaps open between points. */
static real crossing_residual(enum shape shape, real lambda)
{
    real worst = 0;
    for (int k = 0; k < 500; k++) {
        struct patch s = {0};
        particle_cloud_make(
            &s.c, &(struct cloud_plan){.space = SPACE_LINE, .count = {30}, .horizon = 3, .optional = WITH_STRETCH});
        struct particles *p = &s.c.p;
        for (int64_t i = 0; i < p->n; i++) {
            p->kind[i] = KIND_MPM;
            p->x[0][i] = lambda * p->X[0][i] + (k + 0.5) / 500 * CLOUD_SPACING;
            p->volume[i] = lambda * p->volume0[i];
            p->stretch[0][i] = lambda;
            p->stress[0][i] = 1;
        }
        particles_rebuild_lists_by_kind(p);
        patch_grid(&s, 2, 0);
        patch_map(&s, shape);
        worst = fmax(worst, patch_residual(&s, (real[]){8}, (real[]){30 * lambda - 8}) / s.c.source.family.section);
        patch_free(&s);
    }
    return worst;
}

/* Compares the largest force on inner nodes of stretched points (crossing_residual) with published values, for four
 * shape functions. The force is 0 for cpGIMP up to lambda = 4, where a point is two cells wide, and not beyond. */
static void test_mpm_crossing(void **state)
{
    (void)state;
    static const struct {
        real lambda, linear, gimp, cpgimp, quadratic;
    } row[] = {{1.0, 0, 0, 0, 0}, {1.1, 0.55, 0.055, 0, 0.055}, {1.5, 0.75, 0.375, 0, 0.19}, {3.0, 1.5, 1.5, 0, 0.75}};
    for (size_t k = 0; k < COUNT_OF(row); k++) {
        /* Tolerance: published to two digits, and 1 % for sampling the positions; exact zeros up to the round-off of
         * positions of up to 60 cells. */
        is_near("linear", crossing_residual(SHAPE_LINEAR, row[k].lambda), row[k].linear, 0.02 * row[k].linear + 1e-13);
        is_near("uGIMP", crossing_residual(SHAPE_GIMP, row[k].lambda), row[k].gimp, 0.02 * row[k].gimp + 1e-13);
        is_near("cpGIMP", crossing_residual(SHAPE_CPGIMP, row[k].lambda), row[k].cpgimp, 0.02 * row[k].cpgimp + 1e-13);
        is_near("quadratic", crossing_residual(SHAPE_QUADRATIC, row[k].lambda), row[k].quadratic,
                0.02 * row[k].quadratic + 1e-13);
    }
    at_most("cpGIMP, two cells wide", crossing_residual(SHAPE_CPGIMP, 4), 1e-13);
    assert_true(crossing_residual(SHAPE_CPGIMP, 4.5) > 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pd_rest),         cmocka_unit_test(test_pd_lattice), cmocka_unit_test(test_pd_isotropic),
        cmocka_unit_test(test_pd_calibrations), cmocka_unit_test(test_mpm_rest),   cmocka_unit_test(test_mpm_crossing),
    };
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
