/* Compares a quarter of a body between two mirrors (planes of symmetry) with the whole body: forces, also of breaking
 * bonds, energy, surface correction, partial stresses, and conversion to peridynamic particles. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "coupling/conversion.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "loads/mirrors.h"
#include "tests/support/near.h"
#include "base/team.h"

/* Tolerance: round-off of equal sums over bonds in another order. */
#define CLOSE 1e-12

/* A quarter of a body with planes of symmetry x = 0 and y = 0, and the whole body. */
struct quarter {
    struct particle_cloud whole, part;
    struct loads loads;
    int32_t *twin; /* [particles of the quarter] particle of the whole body at that position */
};

static const struct boundary mirror[] = {
    {.name = "left", .kind = BOUNDARY_MIRROR, .body = -1, .axis = 0, .at = 0},
    {.name = "below", .kind = BOUNDARY_MIRROR, .body = -1, .axis = 1, .at = 0},
};

/* Sets displacements of the particles p that are symmetric about the mirrors, and their kinds. Particles within
 * pd_radius of the centre are peridynamic [spacings]. */
static void deform(struct particles *p, real pd_radius)
{
    for (int64_t i = 0; i < p->n; i++) {
        real r2 = 0;
        for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][i] / CLOUD_SPACING);
        for (int d = 0; d < p->dim; d++) p->x[d][i] = p->X[d][i] * (1.01 + 0.004 * d + 1e-5 * r2);
        p->kind[i] = r2 < square(pd_radius) ? KIND_PD : KIND_MPM;
    }
    particles_rebuild_lists_by_kind(p);
}

static void find_twins(struct quarter *q)
{
    q->twin = NEW("test.twin", q->part.p.n, int32_t);
    for (int64_t i = 0; i < q->part.p.n; i++) {
        int found = 0;
        for (int64_t j = 0; j < q->whole.p.n; j++) {
            real r2 = 0;
            for (int d = 0; d < q->part.p.dim; d++) r2 += square(q->whole.p.X[d][j] - q->part.p.X[d][i]);
            if (r2 < 1e-6 * square(CLOUD_SPACING)) q->twin[i] = (int32_t)j, found++;
        }
        assert_int_equal(found, 1);
    }
}

static void quarter_bodies(struct quarter *q, enum space space, enum surface_rule surface, real pd_radius)
{
    const int dim = space_dim(space), n[2] = {6, 5};
    struct cloud_plan plan = {
        .space = space, .count = {n[0], n[1], 4}, .horizon = dim == 3 ? 2.015 : 3.015, .surface = surface};
    memset(q, 0, sizeof *q);
    particle_cloud_make(&q->part, &plan);
    for (int d = 0; d < 2; d++) plan.count[d] *= 2;
    particle_cloud_make(&q->whole, &plan);
    for (int64_t i = 0; i < q->whole.p.n; i++)
        for (int d = 0; d < 2; d++) {
            int64_t at = d == 0 ? i % plan.count[0] : i / plan.count[0] % plan.count[1];
            q->whole.p.X[d][i] = ((real)(at - n[d]) + 0.5) * CLOUD_SPACING;
        }
    find_twins(q);
    deform(&q->whole.p, pd_radius);
    assert_int_equal(loads_make_from_boundaries(&q->loads, mirror, COUNT_OF(mirror), &q->part.p, CLOUD_SPACING,
                                                q->part.source.family.cutoff, 0),
                     OK);
    deform(&q->part.p, pd_radius);
    loads_update_mirror_images_of_particles(&q->loads, &q->part.p);
    q->part.source.image = q->loads.image;
}

static void quarter_make(struct quarter *q, enum space space, enum surface_rule surface, real pd_radius)
{
    quarter_bodies(q, space, surface, pd_radius);
    cloud_bonds(&q->whole);
    cloud_bonds(&q->part);
}

static void quarter_free(struct quarter *q)
{
    memory_free(q->twin);
    loads_free(&q->loads);
    particle_cloud_free(&q->whole);
    particle_cloud_free(&q->part);
}

/* Returns the largest difference between the field part[] of the quarter and the field whole[] of the whole body at
 * corresponding particles of q. */
static real deviation(const struct quarter *q, const real *part, const real *whole)
{
    real *twin = NEW("test.field", q->part.p.n, real);
    for (int64_t i = 0; i < q->part.p.n; i++) twin[i] = whole[q->twin[i]];
    real result = cloud_difference(part, twin, q->part.p.n);
    memory_free(twin);
    return result;
}

static void check_forces(struct quarter *q)
{
    const int dim = q->part.p.dim;
    struct particle_cloud *both[] = {&q->part, &q->whole};
    real energy[2];
    for (int k = 0; k < 2; k++) {
        bond_force_table[dim][PD_BOND](&both[k]->bonds, &both[k]->p, &both[k]->source.limit, NULL);
        bond_stress_table[dim][PD_BOND](&both[k]->bonds, &both[k]->p);
        energy[k] = bond_energy_table[dim][PD_BOND](&both[k]->bonds, &both[k]->p, NULL);
    }
    assert_true(fabs(4 * energy[0] - energy[1]) <= CLOSE * energy[1] && energy[1] > 0);
    for (int d = 0; d < dim; d++) assert_true(deviation(q, q->part.p.f[d], q->whole.p.f[d]) <= CLOSE);
    for (int s = 0; s < dim; s++) assert_true(deviation(q, q->part.p.stress[s], q->whole.p.stress[s]) <= CLOSE);
    for (int64_t i = 0; i < q->part.p.n; i++) {
        int32_t a = q->part.bonds.row_of[i], b = q->whole.bonds.row_of[q->twin[i]];
        const bool bonded =
            a >= 0 && (bond_row_block_intact_bond_lane_mask(&q->part.bonds, a / LANES) >> a % LANES & 1);
        assert_int_equal(bonded,
                         b >= 0 && (bond_row_block_intact_bond_lane_mask(&q->whole.bonds, b / LANES) >> b % LANES & 1));
        if (bonded) assert_true(fabs(q->part.bonds.family_volume[a] / q->whole.bonds.family_volume[b] - 1) <= 1e-6);
    }
}

static void check_partial(const struct quarter *q, const struct partial_stress *part,
                          const struct partial_stress *whole)
{
    const int size = (int)square(symmetric_tensor_component_count(q->part.p.dim));
    int entries = 0;
    for (int64_t i = 0; i < q->part.p.n; i++) {
        int32_t a = part->index[i], b = whole->index[q->twin[i]];
        assert_int_equal(a >= 0, b >= 0);
        if (a < 0) continue;
        for (int k = 0; k < size; k++) /* fractions of stress, of order one */
            assert_true(fabs(part->matrix[a * size + k] - whole->matrix[b * size + k]) <= CLOSE);
        entries++;
    }
    assert_true(entries > 0);
}

static void quarter_case(enum space space, enum surface_rule surface, real pd_radius)
{
    struct quarter q;
    quarter_make(&q, space, surface, pd_radius);
    check_forces(&q);
    if (surface == SURFACE_VOLUME)
        assert_true(deviation(&q, q.part.neighbour_volume, q.whole.neighbour_volume) <= CLOSE);
    if (q.part.p.n_of[KIND_MPM] > 0) {
        struct partial_stress part = {0}, whole = {0};
        partial_stress_compute_from_bonds(&part, &q.part.p, &q.part.bonds, &q.part.source, NULL, 0);
        partial_stress_compute_from_bonds(&whole, &q.whole.p, &q.whole.bonds, &q.whole.source, NULL, 0);
        check_partial(&q, &part, &whole);
        partial_stress_free(&part);
        partial_stress_free(&whole);
    }
    quarter_free(&q);
}

static void test_mirror(void **state)
{
    (void)state;
    static const enum space space[] = {SPACE_PLANE_STRESS, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(space); k++)
        for (int surface = SURFACE_NONE; surface <= SURFACE_VOLUME; surface++) {
            quarter_case(space[k], (enum surface_rule)surface, 3.3); /* a core of peridynamic particles */
            quarter_case(space[k], (enum surface_rule)surface, 0.9); /* so small that all its bonds cross the mirrors */
            quarter_case(space[k], (enum surface_rule)surface, 99);  /* all particles */
        }
}

enum { LOOKS_MOST = 4096 }; /* more than the number of particles in a quarter */

/* Callback that adds 1 to ((int *)context)[list[k]] for each of the n listed particles. Fails if one list contains a
 * particle twice. */
static void count_looks(void *context, const int32_t *list, int64_t n)
{
    int *looks = context, before[LOOKS_MOST];
    memcpy(before, looks, sizeof before);
    for (int64_t k = 0; k < n; k++) {
        assert_in_range(list[k], 0, LOOKS_MOST - 1);
        assert_int_equal(looks[list[k]]++, before[list[k]]);
    }
}

/* Checks the conversion of a point beside a mirror and its neighbourhood. Its images and their neighbours behave as in
 * the whole body, in which all four symmetric points are flagged. The callback receives each converted particle. */
static void test_mirror_convert(void **state)
{
    (void)state;
    struct quarter q;
    struct partial_stress partial[2] = {{0}, {0}};
    struct conversion conversion[2] = {{.first_time = NAN}, {.first_time = NAN}};
    const struct conversion_rule rule = {.criteria = CONVERT_ON_STRESS, .stress = NAN, .alpha = 1, .block = true};
    quarter_make(&q, SPACE_PLANE_STRESS, SURFACE_NONE, 0);
    struct particles *part = &q.part.p, *whole = &q.whole.p;
    int32_t marked = 3; /* beside the lower mirror, away from the left one */
    part->flag[marked] |= FLAG_STRESSED;
    for (int64_t j = 0; j < whole->n; j++)
        if (fabs(fabs(whole->X[0][j]) - part->X[0][marked]) + fabs(fabs(whole->X[1][j]) - part->X[1][marked]) < 1e-9)
            whole->flag[j] |= FLAG_STRESSED;
    int looks[LOOKS_MOST] = {0};
    const struct conversion_sync look = {.sync = count_looks, .context = looks};
    int64_t converted = convert_flagged_points_to_peridynamic(&conversion[0], &rule, part, &q.part.bonds,
                                                              &q.part.source, &partial[0], &look, 1e-6);
    for (int64_t i = 0; i < part->n; i++) {
        assert_true(looks[i] > 0 || part->kind[i] == KIND_MPM);
        assert_false(part->flag[i] & FLAG_LISTED);
    }
    assert_int_equal(convert_flagged_points_to_peridynamic(&conversion[1], &rule, whole, &q.whole.bonds,
                                                           &q.whole.source, &partial[1], NULL, 1e-6),
                     4 * converted);
    for (int64_t i = 0; i < part->n; i++) assert_int_equal(part->kind[i], whole->kind[q.twin[i]]);
    check_forces(&q);
    check_partial(&q, &partial[0], &partial[1]);
    for (int k = 0; k < 2; k++) partial_stress_free(&partial[k]);
    quarter_free(&q);
}

/* ---- bonds that break -------------------------------------------------------------------------------------------- */

/* Creates the neighbourhoods of q in `space` for a `model` with Poisson's ratio 0.2. modulus: receives the constants of
 * state-based models. */
static void quarter_families(struct quarter *q, enum space space, enum pd_model model, struct state_modulus *modulus)
{
    static const int axis[] = {0, 1};
    struct particle_cloud *both[] = {&q->part, &q->whole};
    for (int k = 0; k < 2; k++)
        for (int m = 0; m < CLOUD_MATERIALS; m++) {
            both[k]->material[m].poisson = 0.2;
            material_compute_derived_constants(&both[k]->material[m], space);
            modulus[m] = state_based_moduli_of_material(&both[k]->material[m], space, model == PD_MOSPD);
            both[k]->source.modulus = modulus, both[k]->source.rotates = model == PD_MOSPD;
            both[k]->source.mirror_axis = axis;
        }
}

/* Checks in `space` a sweep of the model `model` in which all bonds beyond a stretch of 1.2 % break, many of which were
 * below it one step earlier. The quarter has a fourth of the broken bonds of the whole body, and equal forces in the
 * last step of these bonds. */
static void breaks_case(enum space space, enum pd_model model)
{
    const int dim = space_dim(space);
    struct quarter q;
    struct state_modulus modulus[CLOUD_MATERIALS];
    quarter_bodies(&q, space, SURFACE_NONE, 99);
    if (model >= PD_OSPD) quarter_families(&q, space, model, modulus);
    struct particle_cloud *both[] = {&q.part, &q.whole};
    struct kernels kernels;
    int64_t broken[2];
    kernels_choose(&kernels, dim, model, SHAPE_LINEAR, TRANSFER_FLIP);
    for (int k = 0; k < 2; k++) {
        struct particles *p = &both[k]->p;
        const struct bond_limit limit = {.critical_stretch = both[k]->limit,
                                         .materials = CLOUD_MATERIALS,
                                         .last_force = LAST_FORCE_MOMENT,
                                         .dt = 1e-7};
        for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) both[k]->limit[m] = 0.012;
        for (int64_t i = 0; i < p->n_all; i++)
            for (int d = 0; d < dim; d++) p->v[d][i] = 1e5 * p->X[d][i];
        cloud_bonds(both[k]);
        broken[k] = kernels.bond_force(&both[k]->bonds, p, &limit, NULL);
    }
    assert_int_equal(4 * broken[0], broken[1]);
    assert_in_range(broken[1], q.whole.bonds.n / 20, q.whole.bonds.n * 9 / 10);
    for (int d = 0; d < dim; d++) assert_true(deviation(&q, q.part.p.f[d], q.whole.p.f[d]) <= CLOSE);
    quarter_free(&q);
}

static void test_mirror_breaks(void **state)
{
    (void)state;
    static const enum pd_model model[] = {PD_BOND, PD_OSPD, PD_MOSPD};
    for (size_t k = 0; k < COUNT_OF(model); k++) {
        breaks_case(SPACE_PLANE_STRAIN, model[k]);
        breaks_case(SPACE_SOLID, model[k]);
    }
}

/* ---- material points --------------------------------------------------------------------------------------------- */

/* A quarter of a body of material points on a grid, or the whole body. */
struct points {
    struct particles *p;
    struct grid g;
    struct transfer_order order;
    struct partial_stress partial;
    struct transfer_data t;
    struct loads loads;
    struct constrained_set held;
};

static const struct elastic steel = {.c11 = 2e11, .c12 = 7e10, .shear = 6.5e10, .trigger = INFINITY};

/* Sets velocities and stresses of the points p that are symmetric about the mirrors, in a deformed body, so that points
 * are at arbitrary positions in cells. */
static void points_state(struct particles *p)
{
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX] = {0}, r2 = 0;
        particle_reference_position(p, i, X);
        for (int d = 0; d < p->dim; d++) X[d] /= CLOUD_SPACING, r2 += X[d] * X[d];
        for (int d = 0; d < p->dim; d++) {
            p->x[d][i] = p->X[d][i] * (1.07 + 0.02 * d + 1e-4 * r2);
            p->v[d][i] = X[d] * (3 + d - 0.01 * r2);
            p->stretch[d][i] = 1.1 + 0.1 * d;
            p->gradient[d * p->dim + d][i] = 3e3 + d;
        }
        p->kind[i] = KIND_MPM;
        for (int c = 0; c < p->dim; c++) p->stress[c][i] = 1e8 * (1 + c + 0.1 * r2);
        p->stress[p->dim][i] = 1e7 * X[0] * X[1]; /* xy */
        if (p->dim == 3) p->stress[4][i] = 1e7 * X[1], p->stress[5][i] = 1e7 * X[0];
    }
    particles_rebuild_lists_by_kind(p);
}

/* Creates s, the points p on a grid with the boundaries b[n]. offset: distance of the mirror planes from a node [node
 * distances]. */
static void points_make(struct points *s, struct particles *p, const struct boundary *b, int n, real offset)
{
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    *s = (struct points){.p = p, .g = {.dim = p->dim, .h = 2 * CLOUD_SPACING}};
    s->t = (struct transfer_data){.order = &s->order, .partial = &s->partial, .elastic = &steel, .dt = 1e-7};
    for (int d = 0; d < p->dim; d++) {
        s->g.anchor[d] = d < 2 ? offset * s->g.h : 0;
        from[d] = -20 * CLOUD_SPACING, to[d] = 20 * CLOUD_SPACING;
    }
    assert_ok(
        loads_make_from_boundaries(&s->loads, b, n, p, CLOUD_SPACING, 3 * CLOUD_SPACING, WITH_GRADIENT | WITH_STRETCH));
    points_state(p);
    assert_ok(grid_extend_box(&s->g, from, to, 10000000, &changed));
}

static void points_step(struct points *s, enum shape shape, enum transfer transfer, int step)
{
    struct kernels k;
    real work = 0;
    kernels_choose(&k, s->p->dim, PD_BOND, shape, transfer);
    s->t.half_width = cloud_half_width(shape, s->g.h);
    s->t.dt_velocity = step == 0 ? 0.5 * s->t.dt : s->t.dt;
    transfer_order_sort_points_by_cell(&s->order, s->p, s->p->list[KIND_MPM], s->p->n, &s->g);
    grid_clear(&s->g);
    k.p2g(&s->g, s->p, &s->t);
    loads_prescribe_grid_velocities(&s->loads, &s->held, &s->g, s->p, &k, s->t.half_width, 0, s->t.dt);
    grid_advance_and_constrain_nodes(&s->g, transfer, s->t.dt_velocity, 1e-30, s->loads.impulse, &work);
    if (transfer == TRANSFER_FLIP) {
        k.remap(&s->g, s->p, &s->t);
        grid_remapped(&s->g, 1e-30);
    }
    k.g2p(&s->g, s->p, &s->t);
    for (int b = 0; b < s->loads.n; b++) memset(s->loads.load[b].reaction, 0, sizeof s->loads.load[b].reaction);
    loads_add_reactions_at_grid_nodes(&s->loads, &s->g, s->t.dt_velocity);
    loads_impose_prescribed_motion_on_particles(&s->loads, s->p, 0, s->t.dt);
}

static void points_free(struct points *s)
{
    transfer_order_free(&s->order);
    loads_free(&s->loads);
    grid_free(&s->g);
}

static real points_momentum(const struct particles *p, int d)
{
    real sum = 0;
    for (int64_t i = 0; i < p->n; i++) sum += p->mass[i] * p->v[d][i];
    return sum;
}

static void points_compare(const struct quarter *q)
{
    const struct particles *part = &q->part.p, *whole = &q->whole.p;
    for (int d = 0; d < part->dim; d++) {
        assert_true(deviation(q, part->x[d], whole->x[d]) <= CLOSE);
        assert_true(deviation(q, part->v[d], whole->v[d]) <= CLOSE);
    }
    for (int c = 0; c < symmetric_tensor_component_count(part->dim); c++)
        assert_true(deviation(q, part->stress[c], whole->stress[c]) <= CLOSE);
}

/* Checks in `space`, with the shape functions `shape` and the scheme `transfer`, that the quarter moves as the whole
 * body does. The shape functions extend beyond the planes. The impulse of the planes is the change of momentum. offset:
 * as in points_make. */
static void points_case(enum space space, enum shape shape, enum transfer transfer, real offset)
{
    const int n[2] = {6, 5};
    struct quarter q = {0};
    struct points part, whole;
    struct cloud_plan plan = {.space = space, .count = {n[0], n[1], 4}, .optional = WITH_GRADIENT | WITH_STRETCH};
    plan.horizon = 3;
    particle_cloud_make(&q.part, &plan);
    for (int d = 0; d < 2; d++) plan.count[d] *= 2;
    particle_cloud_make(&q.whole, &plan);
    for (int64_t i = 0; i < q.whole.p.n; i++)
        for (int d = 0; d < 2; d++) q.whole.p.X[d][i] -= n[d] * CLOUD_SPACING;
    find_twins(&q);
    points_make(&part, &q.part.p, mirror, COUNT_OF(mirror), offset);
    points_make(&whole, &q.whole.p, NULL, 0, offset);
    for (int step = 0; step < 3; step++) {
        real before[2], impulse[2];
        for (int d = 0; d < 2; d++) before[d] = points_momentum(part.p, d), impulse[d] = part.loads.impulse[d];
        points_step(&part, shape, transfer, step);
        points_step(&whole, shape, transfer, step);
        points_compare(&q);
        for (int d = 0; d < 2; d++) {
            real given = part.loads.impulse[d] - impulse[d], reaction = 0;
            assert_near(points_momentum(part.p, d) - before[d], given, CLOSE * fabs(before[d]));
            for (int b = 0; b < part.loads.n; b++) reaction += part.loads.load[b].reaction[d] * part.t.dt_velocity;
            assert_near(reaction, given, CLOSE * fabs(before[d]));
        }
    }
    assert_true(part.g.mirror_nodes > 0);
    points_free(&part);
    points_free(&whole);
    memory_free(q.twin);
    particle_cloud_free(&q.whole);
    particle_cloud_free(&q.part);
}

static void test_mirror_points(void **state)
{
    (void)state;
    static const enum space space[] = {SPACE_PLANE_STRESS, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(space); k++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int transfer = 0; transfer < TRANSFERS; transfer++) {
                points_case(space[k], (enum shape)shape, (enum transfer)transfer, 0);   /* planes on nodes */
                points_case(space[k], (enum shape)shape, (enum transfer)transfer, 0.5); /* midway between nodes */
            }
}

/* Checks a strip between two mirrors with displacements of 1e-13 spacings. The distance from particle i to the image of
 * j must be bitwise equal to that from j to the image of i, so that no force along the mirrors remains. */
static void test_mirror_places(void **state)
{
    (void)state;
    static const struct boundary strip[] = {
        {.name = "low", .kind = BOUNDARY_MIRROR, .body = -1, .axis = 1, .at = 0},
        {.name = "high", .kind = BOUNDARY_MIRROR, .body = -1, .axis = 1, .at = 4 * CLOUD_SPACING},
    };
    struct particle_cloud c;
    struct loads l;
    const real reach = 3.015 * CLOUD_SPACING;
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {6, 4, 1}, .horizon = 3.015});
    assert_int_equal(loads_make_from_boundaries(&l, strip, COUNT_OF(strip), &c.p, CLOUD_SPACING, reach, 0), OK);
    for (int64_t i = 0; i < c.p.n; i++)
        for (int d = 0; d < 2; d++) c.p.x[d][i] = c.p.X[d][i] + 1e-13 * CLOUD_SPACING * sin((real)(i + d));
    loads_update_mirror_images_of_particles(&l, &c.p);
    for (int64_t a = 0; a < l.images; a++)
        for (int64_t b = 0; b < l.images; b++) {
            const struct image *i = &l.image[a], *j = &l.image[b];
            if (i->load != j->load || i->source >= c.p.n || j->source >= c.p.n) continue;
            const int64_t of_i = c.p.n + a, of_j = c.p.n + b;
            assert_true(c.p.X[1][of_j] - c.p.X[1][i->source] == c.p.X[1][of_i] - c.p.X[1][j->source]);
            assert_true(c.p.x[1][of_j] - c.p.x[1][i->source] == c.p.x[1][of_i] - c.p.x[1][j->source]);
            assert_true(c.p.x[0][of_j] - c.p.x[0][i->source] == -(c.p.x[0][of_i] - c.p.x[0][j->source]));
        }
    loads_free(&l);
    particle_cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror_places),  cmocka_unit_test(test_mirror),
        cmocka_unit_test(test_mirror_convert), cmocka_unit_test(test_mirror_breaks),
        cmocka_unit_test(test_mirror_points),
    };
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
