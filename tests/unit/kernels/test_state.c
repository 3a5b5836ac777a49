/* Tests state-based peridynamics: energies of uniform strains against classical ones, finite rotation, forces against
 * the gradient of the energy for irregular cracked bodies, momentum and angular momentum, weighted volumes, and the
 * critical time step. */
#include "run/critical_step.h"
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

/* A body of a state-based model with the constants of its materials. */
struct body {
    struct particle_cloud c;
    struct state_modulus modulus[CLOUD_MATERIALS];
    enum pd_model model;
};

static void body_make(struct body *b, const struct cloud_plan *plan, enum pd_model model, real poisson, bool local)
{
    const real D = space_dim(plan->space);
    const bool rotates = model == PD_MOSPD;
    memset(b, 0, sizeof *b);
    b->model = model;
    particle_cloud_make(&b->c, plan);
    for (int k = 0; k < CLOUD_MATERIALS; k++) {
        struct material *m = &b->c.material[k];
        m->poisson = poisson;
        material_compute_derived_constants(m, plan->space);
        b->modulus[k] = (struct state_modulus){D * D * (rotates ? m->c12 : m->c12 - m->shear),
                                               rotates ? 2 * D * m->shear : D * (D + 2) * m->shear};
    }
    b->c.source.modulus = b->modulus;
    b->c.source.local = local, b->c.source.rotates = rotates;
}

static void force(struct body *b)
{
    state_force_table[b->c.p.dim][b->model](&b->c.bonds, &b->c.p, &b->c.source.limit, NULL);
}
static real energy(struct body *b)
{
    force(b);
    return state_energy_table[b->c.p.dim][b->model](&b->c.bonds, &b->c.p, NULL);
}

/* ---- patch tests ------------------------------------------------------------------------------------------------- */

#define STRAIN 1e-6 /* small enough for its square to be negligible */

enum patch_load { DILATATION, UNIAXIAL, SHEAR, PATCH_LOADS };

static void strain_of(enum patch_load load, int dim, real strain[DIM_MAX][DIM_MAX])
{
    memset(strain, 0, DIM_MAX * sizeof *strain);
    for (int d = 0; d < dim && load == DILATATION; d++) strain[d][d] = STRAIN;
    if (load == UNIAXIAL) strain[0][0] = STRAIN;
    if (load == SHEAR) strain[0][1] = STRAIN; /* simple shear: half of it is rotation */
}

/* Returns the classical energy density of material m under the unit strain of `load` in `dim` dimensions [Pa]. */
static real classical(const struct material *m, enum patch_load load, int dim)
{
    switch (load) {
    case DILATATION:
        return 0.5 * dim * (m->c11 + (dim - 1) * m->c12) * square(STRAIN);
    case UNIAXIAL:
        return 0.5 * m->c11 * square(STRAIN);
    default:
        return 0.5 * m->shear * square(STRAIN);
    }
}

/* Returns true if particle i of p is farther than `reach` spacings from every face of the lattice of count[dim]
 * particles. */
static bool inside(const struct particles *p, int64_t i, const int *count, real reach)
{
    for (int d = 0; d < p->dim; d++) {
        real x = p->X[d][i] / CLOUD_SPACING;
        if (x < 2 * reach || x > count[d] - 2 * reach) return false;
    }
    return true;
}

/* Returns the energy of an inner particle of b under the strain of `load`, from its row, divided by the classical
 * energy. count[dim]: particles of the block; space: of the body. Checks that the largest force on inner particles is
 * round-off. */
static real patch_ratio(struct body *b, const int *count, enum patch_load load, enum space space)
{
    struct particles *p = &b->c.p;
    real strain[DIM_MAX][DIM_MAX], ratio = NAN;
    const int dim = space_dim(space);
    strain_of(load, dim, strain);
    cloud_strain(&b->c, (const real(*)[DIM_MAX])strain);
    force(b);
    state_stress_table[dim][b->model](&b->c.bonds, p);
    for (int64_t i = 0; i < p->n; i++) {
        if (!inside(p, i, count, 3.015)) continue;
        real f2 = 0, work = 0;
        static const int row[SYM_MAX] = {0, 1, 2, 0, 1, 2}, column[SYM_MAX] = {0, 1, 2, 1, 2, 0};
        for (int d = 0; d < dim; d++) f2 += square(p->f[d][i]);
        for (int s = 0; s < symmetric_tensor_component_count(dim); s++) {
            int a = s < dim ? s : row[3 + s - dim], c = s < dim ? s : column[3 + s - dim];
            work += 0.5 * p->stress[s][i] * (s < dim ? strain[a][c] : strain[a][c] + strain[c][a]);
        }
        /* Stretches of 1e-6 have round-off of 1e-10; their squares are 1e-6. */
        assert_true(sqrt(f2) < 1e-5 * b->c.material[0].young * STRAIN * pow(CLOUD_SPACING, dim - 1));
        ratio = work / classical(&b->c.material[0], load, dim);
    }
    return ratio;
}

/* Rotates the stretched body b by a right angle about z, and checks that sigma_xx becomes sigma_yy and that sigma_xx is
 * round-off. */
static void check_quarter_turn(struct body *b)
{
    struct particles *p = &b->c.p;
    const int dim = p->dim;
    real strain[DIM_MAX][DIM_MAX];
    strain_of(UNIAXIAL, dim, strain);
    cloud_strain(&b->c, (const real(*)[DIM_MAX])strain);
    force(b);
    state_stress_table[dim][b->model](&b->c.bonds, p);
    real *before = NEW("test.stress", p->n * symmetric_tensor_component_count(dim), real);
    for (int c = 0; c < symmetric_tensor_component_count(dim); c++)
        memcpy(before + c * p->n, p->stress[c], (size_t)p->n * sizeof(real));
    for (int64_t i = 0; i < p->n_all; i++) {
        const real x = p->x[0][i];
        p->x[0][i] = -p->x[1][i], p->x[1][i] = x;
    }
    force(b);
    state_stress_table[dim][b->model](&b->c.bonds, p);
    const real close = 1e-4 * b->c.material[0].young * STRAIN; /* stretches of 1e-6 have round-off of 1e-10 */
    for (int64_t i = 0; i < p->n; i++) {
        assert_near(p->stress[0][i], before[p->n + i], close);
        assert_near(p->stress[1][i], before[i], close);
        assert_near(p->stress[dim][i], -before[dim * p->n + i], close);
    }
    memory_free(before);
}

/* Compares energies of the ordinary model (Silling et al. 2007) on a lattice in plane stress, nu = 0.3, with expected
 * values of three decimals. The dilatation is exact; shear has the error of the fourth moments of the lattice. */
static void test_ospd_plane_stress(void **state)
{
    (void)state;
    static const struct {
        enum influence influence;
        real ratio[PATCH_LOADS];
    } want[] = {{INFLUENCE_ONE, {1, 1.012, 0.965}},
                {INFLUENCE_INVERSE, {1, 1.012, 0.966}},
                {INFLUENCE_GAUSSIAN, {1, 1.006, 0.984}},
                {INFLUENCE_INVERSE_SQUARE, {1, 1.022, 0.937}}};
    const int count[DIM_MAX] = {17, 17};
    for (size_t k = 0; k < COUNT_OF(want); k++)
        for (int load = 0; load < PATCH_LOADS; load++) {
            struct body b;
            body_make(
                &b,
                &(struct cloud_plan){
                    .space = SPACE_PLANE_STRESS, .count = {17, 17}, .horizon = 3.015, .influence = want[k].influence},
                PD_OSPD, 0.3, true);
            cloud_bonds(&b.c);
            assert_near(patch_ratio(&b, count, (enum patch_load)load, SPACE_PLANE_STRESS), want[k].ratio[load],
                        load == DILATATION ? 1e-5 : 6e-4);
            particle_cloud_free(&b.c);
        }
}

/* Checks that the model with rotations is exact on every lattice, for every influence function, Poisson's ratio and
 * space, because its effective displacements involve second moments only. Tolerance 1e-5: squares of the strain and
 * single precision of weights. */
static void test_mospd_exact(void **state)
{
    (void)state;
    static const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    static const real poisson[] = {0.1, 0.3, 0.45};
    const int count[DIM_MAX] = {15, 15, 15};
    for (size_t s = 0; s < COUNT_OF(spaces); s++)
        for (size_t k = 0; k < COUNT_OF(poisson); k++)
            for (int load = 0; load < PATCH_LOADS; load++)
                for (int local = 0; local < 2; local++) {
                    struct body b;
                    body_make(&b,
                              &(struct cloud_plan){.space = spaces[s],
                                                   .count = {15, 15, 15},
                                                   .horizon = 3.015,
                                                   .influence = (enum influence)(k + 1)},
                              PD_MOSPD, poisson[k], local);
                    cloud_bonds(&b.c);
                    assert_near(patch_ratio(&b, count, (enum patch_load)load, spaces[s]), 1, 1e-5);
                    particle_cloud_free(&b.c);
                }
}

static void test_turned_stress(void **state)
{
    (void)state;
    static const enum space spaces[] = {SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t s = 0; s < COUNT_OF(spaces); s++)
        for (int rotates = 0; rotates < 2; rotates++) {
            struct body b;
            body_make(&b,
                      &(struct cloud_plan){
                          .space = spaces[s], .count = {9, 9, 9}, .horizon = 3.015, .influence = INFLUENCE_ONE},
                      rotates ? PD_MOSPD : PD_OSPD, 0.3, true);
            cloud_bonds(&b.c);
            check_quarter_turn(&b);
            particle_cloud_free(&b.c);
        }
}

/* Returns the energy of the ordinary model under `load` in `dim` dimensions over the classical energy of material m.
 * Sums over a full neighbourhood of the lattice: W = D^2 (lambda' - G) S^2/2 + D (D + 2) G sum e^2/(2 q), S = sum r
 * e/q, q = sum r^2 (Silling et al. 2007). D: dimensions, r, e: length and elongation of a bond. */
static real lattice_ratio(const struct material *m, enum patch_load load, int dim)
{
    const int reach = 3, top = dim == 3 ? reach : 0;
    real strain[DIM_MAX][DIM_MAX], q = 0, S = 0, squares = 0;
    strain_of(load, dim, strain);
    for (int x = -reach; x <= reach; x++)
        for (int y = -reach; y <= reach; y++)
            for (int z = -top; z <= top; z++) {
                const real xi[DIM_MAX] = {x, y, z}, r = sqrt(x * x + y * y + z * z);
                real e = 0;
                if (r == 0 || r > 3.015) continue;
                for (int a = 0; a < dim; a++)
                    for (int b = 0; b < dim; b++) e += strain[a][b] * xi[a] * xi[b] / r;
                q += r * r, S += r * e, squares += e * e;
            }
    S /= q;
    return (0.5 * dim * dim * (m->c12 - m->shear) * S * S + 0.5 * dim * (dim + 2) * m->shear * squares / q) /
           classical(m, load, dim);
}

/* Compares energies of the ordinary model in every space, for every Poisson's ratio and load, with lattice_ratio
 * (1e-5), and these ratios with published values: dilatation exact; plane stress at nu = 0.3: uniaxial strain 1.012,
 * shear 0.965; 3D: 0.93 to 0.95 and 1.09 to 1.11. */
static void test_ospd_spaces(void **state)
{
    (void)state;
    static const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    static const real poisson[] = {0.1, 0.3, 0.45};
    const int count[DIM_MAX] = {15, 15, 15};
    for (size_t s = 0; s < COUNT_OF(spaces); s++)
        for (size_t k = 0; k < COUNT_OF(poisson); k++)
            for (int load = 0; load < PATCH_LOADS; load++) {
                struct body b;
                body_make(&b,
                          &(struct cloud_plan){
                              .space = spaces[s], .count = {15, 15, 15}, .horizon = 3.015, .influence = INFLUENCE_ONE},
                          PD_OSPD, poisson[k], false);
                cloud_bonds(&b.c);
                const real ratio = patch_ratio(&b, count, (enum patch_load)load, spaces[s]);
                assert_near(ratio, lattice_ratio(&b.c.material[0], (enum patch_load)load, space_dim(spaces[s])), 1e-5);
                if (load == DILATATION)
                    assert_near(ratio, 1, 1e-5);
                else if (spaces[s] == SPACE_SOLID && poisson[k] == 0.3)
                    assert_near(ratio, load == UNIAXIAL ? 0.94 : 1.10, 0.015);
                else if (spaces[s] == SPACE_PLANE_STRESS && poisson[k] == 0.3)
                    assert_near(ratio, load == UNIAXIAL ? 1.012 : 0.965, 6e-4);
                particle_cloud_free(&b.c);
            }
}

/* ---- irregular cracked bodies ------------------------------------------------------------------------------------ */

static const enum pd_model models[] = {PD_OSPD, PD_MOSPD};

/* Creates in `space` the body b, irregular and cut along x = 4.5 spacings, with bonds of the model `model`. local: true
 * if neighbourhoods are normalised by their intact bonds. */
static void cracked_make(struct body *b, enum space space, enum pd_model model, bool local)
{
    struct cloud_plan plan = {
        .space = space, .count = {9, 8, 6}, .horizon = 2.5, .shake = 0.2, .seed = 3, .influence = INFLUENCE_INVERSE};
    const int dim = space_dim(space);
    body_make(b, &plan, model, 0.3, local);
    cloud_bonds(&b->c);
    for (int64_t g = 0; g < b->c.bonds.row_blocks; g++) bond_row_block_copy_bonds_from_stencil(&b->c.bonds, g);
    for (int64_t g = 0; g < b->c.bonds.row_blocks; g++) /* a cut along x = 4.5, up to y = 4 */
        for (int64_t q = b->c.bonds.column[g] * LANES; q < (b->c.bonds.column[g] + b->c.bonds.column_count[g]) * LANES;
             q++) {
            int32_t i = b->c.bonds.particle[g * LANES + q % LANES], j = b->c.bonds.nbr[q];
            const real *X = b->c.p.X[0], *Y = b->c.p.X[1], line = 4.5 * CLOUD_SPACING;
            if (b->c.bonds.w[q] == 0 || (X[i] < line) == (X[j] < line) || Y[i] + Y[j] > 8 * CLOUD_SPACING) continue;
            b->c.bonds.w[q] = 0, b->c.bonds.inverse_length[q] *= -1;
            bond_update_cached_data_after_modification(&b->c.bonds, g * LANES + q % LANES, q);
        }
    state_based_update_weighted_volumes(&b->c.bonds, &b->c.p, &b->c.source);
    uint64_t seed = 17;
    for (int64_t i = 0; i < b->c.p.n; i++)
        for (int d = 0; d < dim; d++)
            b->c.p.x[d][i] = b->c.p.X[d][i] + cloud_between(&seed, -0.02, 0.02) * CLOUD_SPACING;
}

/* Checks f = -dE/dx by central differences over 1e-6 of a spacing, for the model `model` in `space`, and that the
 * forces and their moments add up to zero. local: true if neighbourhoods are normalised by their intact bonds.
 * Tolerance 1e-6 of the largest force: truncation error (1e-6)^2 over strains of 0.02, and round-off 1e-16 E/(1e-6). */
static void gradient_case(enum space space, enum pd_model model, bool local)
{
    struct body b;
    cracked_make(&b, space, model, local);
    struct particles *p = &b.c.p;
    const int dim = p->dim;
    real largest = 0, sum[DIM_MAX] = {0}, moment[DIM_MAX] = {0}, scale = 0, *kept[DIM_MAX];
    force(&b);
    for (int d = 0; d < dim; d++) {
        kept[d] = NEW("test.force", p->n, real);
        memcpy(kept[d], p->f[d], (size_t)p->n * sizeof(real));
        for (int64_t i = 0; i < p->n; i++) largest = real_max(largest, fabs(p->f[d][i]));
    }
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < dim; d++) {
            const int e = (d + 1) % dim;
            sum[d] += kept[d][i];
            moment[d] += p->x[d][i] * kept[e][i] - p->x[e][i] * kept[d][i];
            scale += fabs(kept[d][i]);
        }
    for (int d = 0; d < dim; d++) {
        assert_near(sum[d], 0, 1e-14 * scale);
        assert_near(moment[d], 0, 1e-13 * scale * 9 * CLOUD_SPACING);
    }
    const real h = 1e-6 * CLOUD_SPACING;
    for (int64_t i = 0; i < p->n; i += 7)
        for (int d = 0; d < dim; d++) {
            const real x = p->x[d][i];
            p->x[d][i] = x + h;
            real above = energy(&b);
            p->x[d][i] = x - h;
            real below = energy(&b);
            p->x[d][i] = x;
            assert_near(kept[d][i], -(above - below) / (2 * h), 2e-6 * largest);
        }
    for (int d = 0; d < dim; d++) memory_free(kept[d]);
    particle_cloud_free(&b.c);
}

static void test_gradient(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(models); k++)
        for (int local = 0; local < 2; local++) {
            gradient_case(SPACE_PLANE_STRESS, models[k], local);
            gradient_case(SPACE_PLANE_STRAIN, models[k], local);
            gradient_case(SPACE_SOLID, models[k], local);
        }
}

/* Checks that a rigid rotation of any size causes no force, to 1e-12 of the force of a strain of 1. */
static void test_rotation(void **state)
{
    (void)state;
    const real angle[] = {1e-3, 0.1257, 1, 3};
    for (size_t k = 0; k < COUNT_OF(models); k++)
        for (size_t a = 0; a < COUNT_OF(angle); a++)
            for (int solid = 0; solid < 2; solid++) {
                struct body b;
                cracked_make(&b, solid ? SPACE_SOLID : SPACE_PLANE_STRESS, models[k], true);
                struct particles *p = &b.c.p;
                const real c = cos(angle[a]), s = sin(angle[a]);
                for (int64_t i = 0; i < p->n; i++) {
                    p->x[0][i] = c * p->X[0][i] - s * p->X[1][i];
                    p->x[1][i] = s * p->X[0][i] + c * p->X[1][i];
                    if (solid) p->x[2][i] = p->X[2][i];
                }
                force(&b);
                for (int d = 0; d < p->dim; d++)
                    for (int64_t i = 0; i < p->n; i++)
                        assert_near(p->f[d][i], 0,
                                    1e-12 * 200e9 * pow(CLOUD_SPACING, p->dim - 1) * (solid ? 1 : 2e-3) * 10);
                particle_cloud_free(&b.c);
            }
}

/* Checks the weighted volume Q of particles whose own volume is 1.37 times that of their cell. In a complete
 * neighbourhood Q is the sum over its bonds to 1e-6, the single precision of weights. Without local normalisation a
 * particle at a corner has the same Q, with it less than half. */
static void test_volumes(void **state)
{
    (void)state;
    static const enum space spaces[] = {SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t s = 0; s < COUNT_OF(spaces); s++) {
        real Q[2], corner[2];
        for (int local = 0; local < 2; local++) {
            struct body b;
            body_make(&b,
                      &(struct cloud_plan){
                          .space = spaces[s], .count = {7, 7, 7}, .horizon = 2.515, .influence = INFLUENCE_INVERSE},
                      PD_OSPD, 0.23, local);
            const real middle[DIM_MAX] = {3.5 * CLOUD_SPACING, 3.5 * CLOUD_SPACING, 3.5 * CLOUD_SPACING};
            const int64_t i = particles_index_nearest_to_position(&b.c.p, middle);
            b.c.p.volume0[i] *= 1.37, b.c.p.volume0[0] *= 1.37;
            cloud_bonds(&b.c);
            Q[local] = b.c.bonds.state.weighted[b.c.bonds.row_of[i]];
            corner[local] = b.c.bonds.state.weighted[b.c.bonds.row_of[0]];
            if (local)
                assert_close(Q[1], state_based_weighted_volume_of_intact_bonds(&b.c.bonds, b.c.bonds.row_of[i]), 1e-6);
            particle_cloud_free(&b.c);
        }
        assert_close(Q[0], Q[1], 1e-6);
        assert_close(corner[0], Q[1], 1e-6);
        assert_true(corner[1] < 0.5 * Q[1]);
    }
}

/* Checks the weighted volume Q at corners with surface correction by classes of particles: a corner particle of 1.37
 * times the volume has 1.37 times the Q of the opposite corner, to round-off. */
static void test_volumes_at_faces(void **state)
{
    (void)state;
    struct body b;
    body_make(&b,
              &(struct cloud_plan){.space = SPACE_PLANE_STRAIN,
                                   .count = {9, 9},
                                   .horizon = 2.515,
                                   .influence = INFLUENCE_INVERSE,
                                   .surface = SURFACE_MOMENTS},
              PD_OSPD, 0.23, false);
    b.c.p.volume0[0] *= 1.37;
    cloud_bonds(&b.c);
    const struct bonds *bonds = &b.c.bonds;
    assert_true(b.c.source.surface && b.c.surface.class_of[0] > 0);
    const real Q = bonds->state.weighted[bonds->row_of[0]];
    assert_close(Q, 1.37 * bonds->state.weighted[bonds->row_of[8]], 1e-12);
    particle_cloud_free(&b.c);
}

/* ---- critical step ----------------------------------------------------------------------------------------------- */

/* Compares critical time steps with published values for large plates in plane stress, horizon 3.015 D, nu = 0.3,
 * within 6 %: 1.79 D/c for OSPD and 1.94 D/c for MOSPD; D: spacing, c: wave speed. Also checks that the step scales
 * with the root of the density down to a factor of 2^-80: powers of high frequencies must not overflow. */
static void test_critical_step(void **state)
{
    (void)state;
    const struct {
        enum pd_model model;
        real nu, limit;
    } want[] = {{PD_OSPD, 0.3, 1.79}, {PD_MOSPD, 0.3, 1.94}};
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        struct body b;
        body_make(&b,
                  &(struct cloud_plan){
                      .space = SPACE_PLANE_STRESS, .count = {12, 12}, .horizon = 3.015, .influence = INFLUENCE_INVERSE},
                  want[k].model, want[k].nu, true);
        cloud_bonds(&b.c);
        real step =
            lattice_critical_time_step(&b.c.source, state_force_table[2][want[k].model], 8000, (real[]){1, 1}, NULL);
        assert_close(step * b.c.material[0].wave_speed / CLOUD_SPACING, want[k].limit, 0.06);
        const real light = lattice_critical_time_step(&b.c.source, state_force_table[2][want[k].model], 8000 * 0x1p-80,
                                                      (real[]){1, 1}, NULL);
        assert_close(light, step * 0x1p-40, 1e-12);
        particle_cloud_free(&b.c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ospd_plane_stress), cmocka_unit_test(test_mospd_exact),
                                       cmocka_unit_test(test_turned_stress),     cmocka_unit_test(test_ospd_spaces),
                                       cmocka_unit_test(test_gradient),          cmocka_unit_test(test_rotation),
                                       cmocka_unit_test(test_volumes),           cmocka_unit_test(test_critical_step),
                                       cmocka_unit_test(test_volumes_at_faces)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
