/* floor 4: state-based bonds as partners of material points: uniform strain across a flat interface leaves neither force
 * nor torque, and converting a block costs nothing. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "patch.h"
#include "team.h"

#define STRAIN 1e-7                      /* finite geometry deviates from linear theory by as much */

struct partners {
    struct cloud_plan plan;
    enum pd_model model;
    real poisson;
    int split;                           /* peridynamic columns, left of the interface */
    real offset;                         /* of the grid's nodes [spacings] */
};

struct both {
    struct patch s;
    struct state_modulus modulus[CLOUD_MATERIALS];
};

static void both_make(struct both *b, const struct partners *k)
{
    memset(b, 0, sizeof *b);
    struct cloud *c = &b->s.c;
    cloud_make(c, &k->plan);
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        c->material[m].poisson = k->poisson;
        material_derive(&c->material[m], k->plan.space);
        b->modulus[m] = state_modulus_of(&c->material[m], k->plan.space, k->model == PD_MOSPD);
    }
    c->source.modulus = b->modulus, c->source.turns = k->model == PD_MOSPD;
}

/* Stress of Hooke's law in the material points. */
static void stress_set(struct cloud *c, const real strain[DIM_MAX][DIM_MAX])
{
    real vector[SYM_MAX] = {0}, stiffness[SYM_MAX * SYM_MAX];
    const int dim = c->p.dim, n = symmetric_count(dim);
    for (int a = 0; a < dim; a++) vector[a] = strain[a][a];
    if (dim == 2) vector[2] = strain[0][1];
    if (dim == 3) vector[3] = strain[0][1], vector[4] = strain[1][2], vector[5] = strain[0][2];
    material_stiffness(&c->material[0], dim, stiffness);
    for (int64_t i = 0; i < c->p.n; i++)
        for (int s = 0; s < n; s++) {
            c->p.stress[s][i] = 0;
            for (int t = 0; t < n && c->p.kind[i] == KIND_MPM; t++) c->p.stress[s][i] += stiffness[s * n + t] * vector[t];
        }
}

/* Largest nodal force over (largest stress times a cell's face). */
static real residual(const struct partners *k, const real strain[DIM_MAX][DIM_MAX])
{
    struct both b;
    real from[DIM_MAX], to[DIM_MAX], reach = 8, stress = 0;
    both_make(&b, k);
    struct particles *p = &b.s.c.p;
    for (int64_t i = 0; i < p->n; i++) p->kind[i] = p->X[0][i] > k->split * CLOUD_SPACING ? KIND_MPM : KIND_PD;
    cloud_bonds(&b.s.c);
    cloud_strain(&b.s.c, strain);
    stress_set(&b.s.c, strain);
    state_force_table[p->dim][k->model](&b.s.c.bonds, p, &b.s.c.source.limit, NULL);
    partial_stress_make(&b.s.partial, p, &b.s.c.bonds, &b.s.c.source, NULL, 0);
    patch_grid(&b.s, 2, k->offset);
    patch_map(&b.s, SHAPE_LINEAR);
    for (int d = 0; d < p->dim; d++) from[d] = reach, to[d] = k->plan.count[d] - reach;
    from[0] = 0, to[0] = k->plan.count[0] - 4;
    for (int s = 0; s < symmetric_count(p->dim); s++) stress = real_max(stress, fabs(p->stress[s][p->n - 1]));
    real force = patch_residual(&b.s, from, to) / (pow(b.s.g.h, p->dim - 1) * b.s.c.source.family.section * stress);
    patch_free(&b.s);
    return force;
}

/* Effective displacements leave nothing for any Poisson's ratio, strain and place of the interface: 3e-6 is round-off of
 * positions over the strain and the weights' single precision. Without the skew part of the stress 0.13 in shear. The
 * ordinary model leaves what the lattice's fourth moments differ by: as bonds do, 0.034 in shear. */
static void test_flat(void **state)
{
    (void)state;
    static const real load[][DIM_MAX][DIM_MAX] = {{{STRAIN}}, {{STRAIN}, {0, STRAIN}}, {{0, STRAIN}, {STRAIN, 0}}};
    struct partners k = {.plan = {.space = SPACE_PLANE_STRESS, .count = {32, 24}, .horizon = 3.015,
                                  .influence = INFLUENCE_INVERSE}, .split = 16};
    for (int n = 0; n < 3; n++)
        for (int l = 0; l < 3; l++)
            for (int o = 0; o < 2; o++) {
                k.poisson = (const real[]){0.2, 1.0 / 3, 0.45}[n], k.offset = o, k.model = PD_MOSPD;
                at_most("with rotations", residual(&k, load[l]), 3e-6);
                k.model = PD_OSPD;
                if (l == 1) at_most("ordinary, biaxial", residual(&k, load[l]), 3e-6);
                if (l == 2) is_near("ordinary, shear", residual(&k, load[l]), o ? 0.017 : 0.034, 1e-3);
            }
}

static void test_flat_solid(void **state)
{
    (void)state;
    static const real strain[DIM_MAX][DIM_MAX] = {{3e-7, 1e-7, -2e-7}, {1e-7, -2e-7, 1e-7}, {-2e-7, 1e-7, 2e-7}};
    struct partners k = {.plan = {.space = SPACE_SOLID, .count = {16, 20, 20}, .horizon = 2.015,
                                  .influence = INFLUENCE_INVERSE}, .model = PD_MOSPD, .poisson = 0.35, .split = 8};
    at_most("solid", residual(&k, strain), 5e-6);
}

/* ---- torque ---------------------------------------------------------------------------------------------- */

/* Torque about the z axis of all forces that bonds and the partial stress's skew part give to a strip, and its size. Free
 * edges of the strip are far from what is summed: particles and points between two heights, as whole layers. */
static real torque(const struct partners *k, bool skew)
{
    static const real shear[DIM_MAX][DIM_MAX] = {{0, STRAIN}, {STRAIN, 0}};
    struct both b;
    both_make(&b, k);
    struct particles *p = &b.s.c.p;
    for (int64_t i = 0; i < p->n; i++) p->kind[i] = p->X[0][i] > k->split * CLOUD_SPACING ? KIND_MPM : KIND_PD;
    cloud_bonds(&b.s.c);
    cloud_strain(&b.s.c, shear);
    stress_set(&b.s.c, shear);
    state_force_table[2][k->model](&b.s.c.bonds, p, &b.s.c.source.limit, NULL);
    partial_stress_make(&b.s.partial, p, &b.s.c.bonds, &b.s.c.source, NULL, 0);
    const struct bonds *bonds = &b.s.c.bonds;
    real sum = 0, size = 0, T[2][DIM_MAX], xi[DIM_MAX];
    for (int64_t row = 0; row < bonds->rows; row++) {       /* xi x T of both ends of each bond, half to each end */
        const int32_t i = bonds->particle[row];
        if (fabs(p->X[1][i] - 12 * CLOUD_SPACING) > 2 * CLOUD_SPACING || p->X[0][i] < 6 * CLOUD_SPACING) continue;
        for (int64_t c = 0; c < bonds->slot_count[row / LANES]; c++) {
            const int64_t q = bond_index(bonds, row / LANES, c, (int)(row % LANES));
            const int32_t j = bonds->nbr[q];
            if (bonds->w[q] == 0) continue;
            for (int end = 0; end < 2; end++) {
                const int32_t own = end ? j : i, other = end ? i : j;
                for (int d = 0; d < 2; d++) {
                    xi[d] = p->X[d][other] - p->X[d][own];
                    real effective = bonds->state.spring[own] * (p->x[d][other] - p->x[d][own] - xi[d]);
                    for (int e = 0; e < 2; e++)
                        effective -= bonds->state.turn[d * 2 + e][own] * (p->X[e][other] - p->X[e][own]);
                    T[end][d] = bonds->w[q] * effective;
                }
                sum += 0.5 * (xi[0] * T[end][1] - xi[1] * T[end][0]);
                size += 0.5 * fabs(xi[0] * T[end][1]);
            }
        }
    }
    for (int64_t i = 0; i < p->n && skew; i++) {            /* sigma_yx - sigma_xy of what points give = -2 skew_xy */
        if (fabs(p->X[1][i] - 12 * CLOUD_SPACING) > 2 * CLOUD_SPACING || b.s.partial.index[i] < 0) continue;
        for (int s = 0; s < 3; s++)
            sum += 2 * b.s.partial.skew[b.s.partial.index[i] * 3 + s] * p->stress[s][i] * p->volume0[i];
    }
    patch_free(&b.s);
    return sum / size;
}

/* Bonds whose one end is a material point leave a torque that no family closes: the skew stress takes it away. */
static void test_torque(void **state)
{
    (void)state;
    const struct partners k = {.plan = {.space = SPACE_PLANE_STRESS, .count = {32, 24}, .horizon = 3.015,
                                        .influence = INFLUENCE_INVERSE}, .model = PD_MOSPD, .poisson = 0.3, .split = 16};
    at_most("torque", torque(&k, true), 1e-9);    /* round-off over the strain */
    is_near("torque without it", fabs(torque(&k, false)), 0.05, 0.01);      /* of the sum of all bonds' torques */
}

/* ---- energy of conversion -------------------------------------------------------------------------------- */

/* Bonds, and half sigma_given : C^-1 sigma of the points [J]. */
static real energy_of(const struct both *b, enum pd_model model)
{
    const struct cloud *c = &b->s.c;
    const int dim = c->p.dim, n = symmetric_count(dim);
    real sum = c->bonds.rows > 0 ? state_energy_table[dim][model](&c->bonds, &c->p) : 0, compliance[SYM_MAX * SYM_MAX];
    material_compliance(&c->material[0], dim, compliance);
    for (int64_t i = 0; i < c->p.n; i++) {
        const int32_t at = b->s.partial.index ? b->s.partial.index[i] : -1;
        for (int s = 0; s < n && c->p.kind[i] == KIND_MPM; s++) {
            real given = c->p.stress[s][i], strain = 0;
            for (int t = 0; t < n; t++) {
                strain += compliance[s * n + t] * c->p.stress[t][i];
                if (at >= 0) given -= b->s.partial.matrix[(at * n + s) * n + t] * c->p.stress[t][i];
            }
            sum += 0.5 * (s < dim ? 1 : 2) * c->p.volume0[i] * given * strain;
        }
    }
    return sum;
}

/* Energy that comes of making a square block in a uniformly strained plate peridynamic, in energies of a particle. */
static real jump(enum pd_model model, const real strain[DIM_MAX][DIM_MAX], int edge)
{
    const struct partners k = {.plan = {.space = SPACE_PLANE_STRESS, .count = {32, 32}, .horizon = 3.015,
                                        .influence = INFLUENCE_INVERSE}, .model = model, .poisson = 0.3};
    struct solid box = {.kind = SOLID_BOX};
    struct both b;
    for (int d = 0; d < 2; d++) box.from[d] = (16 - edge / 2) * CLOUD_SPACING, box.to[d] = (16 + edge / 2) * CLOUD_SPACING;
    both_make(&b, &k);
    struct cloud *c = &b.s.c;
    for (int64_t i = 0; i < c->p.n; i++) c->p.kind[i] = KIND_MPM;
    cloud_source(c);
    cloud_strain(c, strain);
    stress_set(c, strain);
    const real before = energy_of(&b, model), particle = before / (real)c->p.n;
    convert_start(&c->p, &c->source, &(struct region){1, &box});
    assert_int_equal(c->p.n_of[KIND_PD], edge * edge);
    bonds_make(&c->bonds, NULL, &c->p, &c->source);
    state_force_table[2][model](&c->bonds, &c->p, &c->source.limit, NULL);
    partial_stress_make(&b.s.partial, &c->p, &c->bonds, &c->source, NULL, 0);
    const real came = (energy_of(&b, model) - before) / particle;
    patch_free(&b.s);
    return came;
}

/* The block's sides cost nothing: the energy is that of four corners, whatever its size, load and model: bonds round a
 * corner run less than half their way in material points. In the ordinary model the lattice differs from the points, by 1.4 %
 * axially and 3.4 % in shear (its fourth moments), over the block and half of the bonds round it. */
#define CORNER (-0.08604)
static void test_energy(void **state)
{
    (void)state;
    static const real load[][DIM_MAX][DIM_MAX] = {{{STRAIN}}, {{STRAIN}, {0, STRAIN}}, {{0, STRAIN}, {STRAIN, 0}}};
    for (int l = 0; l < 3; l++)
        for (int edge = 8; edge <= 12; edge += 4) {
            is_near("jump, with rotations", jump(PD_MOSPD, load[l], edge), 4 * CORNER, 1e-4);
            real ordinary = jump(PD_OSPD, load[l], edge) - 4 * CORNER;
            if (l == 1) at_most("jump, ordinary, dilatation", ordinary, 1e-4);
            else at_most("jump, ordinary", ordinary, (l == 0 ? 0.0137 : 0.0343) * square(edge + 2));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_flat), cmocka_unit_test(test_flat_solid),
                                       cmocka_unit_test(test_torque), cmocka_unit_test(test_energy)};
    team_make(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
