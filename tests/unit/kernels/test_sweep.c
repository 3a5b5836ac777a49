/* Tests the motion that is fused with the force sweep against all forces followed by all motion. Results must be
 * bitwise equal for every bond model and number of threads, with particles that have applied loads, are inactive, or
 * are moved by the grid. */
#include <omp.h>
#include <stdlib.h>

#include "tests/support/cloud.h"
#include "kernels/kernels.h"
#include "tests/support/same.h"
#include "tests/support/sets.h"
#include "base/team.h"

/* Variants of a body, as bits: random positions, also material points, some particles with loads, some row blocks
 * inactive. */
enum { SHAKEN = 1, MIXED = 2, LOADED = 4, ASLEEP = 8, WAYS = 16 };
enum { THREADS_MOST = 7 };

static const enum space space_of[DIM_MAX + 1] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};

/* Particles along each axis: enough for every thread to have blocks of eight rows that no other thread reads. */
static const int count_of[DIM_MAX + 1][DIM_MAX] = {{0}, {701}, {9, 111}, {5, 4, 61}};

struct body {
    struct particle_cloud c;
    struct state_modulus modulus[CLOUD_MATERIALS];
    uint8_t *loaded;
};

/* Deactivates every third block of eight rows of b (bonds of eight particles of p), but not the first. Its particles
 * receive no new forces, do not move, and keep the states of their neighbourhoods in the model `model`. */
static void put_to_sleep(struct bonds *b, struct particles *p, enum pd_model model)
{
    if (model >= PD_OSPD) state_precompute_table[p->dim][model](b, p);
    for (int64_t g = 1; g < b->row_blocks; g += 3) b->active.level[g] = 0;
    active_set_rebuild_active_block_list(&b->active);
}

static void body_make(struct body *b, int dim, enum pd_model model, int way)
{
    struct cloud_plan plan = {
        .space = space_of[dim], .horizon = dim == 3 ? 1.5 : 3.015, .seed = 3, .shake = way & SHAKEN ? 0.3 : 0};
    uint64_t seed = 77 + (uint64_t)way;
    memcpy(plan.count, count_of[dim], sizeof plan.count);
    plan.optional = model >= PD_OSPD ? WITH_ENDS | (model == PD_MOSPD ? WITH_ROTATIONS : 0) : 0;
    particle_cloud_make(&b->c, &plan);
    struct particles *p = &b->c.p;
    b->loaded = NEW("test.loaded", p->n + LANES, uint8_t);
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = way & MIXED && cloud_random(&seed) < 0.4 ? KIND_MPM : KIND_PD;
        if (way & MIXED && p->kind[i] == KIND_PD && cloud_random(&seed) < 0.2) p->flag[i] = FLAG_GRID_COUPLED;
        b->loaded[i] = cloud_random(&seed) < 0.1;
        for (int d = 0; d < dim; d++) {
            p->x[d][i] = p->X[d][i] * (1.01 + 0.005 * d) + cloud_between(&seed, -0.02, 0.02) * CLOUD_SPACING;
            p->v[d][i] = cloud_between(&seed, -10, 10);
        }
    }
    for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) b->c.limit[m] = 0.04;
    for (int m = 0; m < CLOUD_MATERIALS; m++)
        b->modulus[m] = state_based_moduli_of_material(&b->c.material[m], space_of[dim], model == PD_MOSPD);
    if (model >= PD_OSPD)
        b->c.source.modulus = b->modulus, b->c.source.rotates = model == PD_MOSPD, b->c.source.local = true;
    cloud_bonds(&b->c);
    b->c.source.limit.last_force = LAST_FORCE_MOMENT, b->c.source.limit.dt = 2e-6; /* velocities are also read */
    if (way & ASLEEP) put_to_sleep(&b->c.bonds, p, model);
}

static void body_free(struct body *b)
{
    memory_free(b->loaded);
    particle_cloud_free(&b->c);
}

/* Returns the parameters of the motion of b after the sweep, with dt v of some hundredths of a spacing. way: flags of
 * the variant; fastest: speed above which a particle counts as diverged [m/s]. */
static struct pd_motion motion_of(const struct body *b, int way, real fastest)
{
    return (struct pd_motion){2e-6, 1e-6, fastest, way & LOADED ? b->loaded : NULL, false};
}

/* Computes all forces of b by the kernel `force`, then moves all particles that the fused sweep would move. *motion:
 * parameters; receives whether a particle has diverged. way: flags of the variant. Returns the number of broken
 * bonds. */
static int64_t forces_then_motion(struct body *b, bond_force_fn *force, int way, struct pd_motion *motion)
{
    struct particles *p = &b->c.p;
    const struct bonds *bonds = &b->c.bonds;
    int32_t *list = NEW("test.list", p->n, int32_t);
    int64_t n = 0, broken = force(&b->c.bonds, p, &b->c.source.limit, NULL);
    for (int64_t i = 0; i < p->n; i++) {
        const bool waits = way & LOADED && b->loaded[i];
        if (p->kind[i] == KIND_PD && !waits && bonds->active.level[bonds->row_of[i] / LANES] > 0)
            list[n++] = (int32_t)i;
    }
    motion->diverged = pd_move_table[p->dim](p, list, n, motion);
    memory_free(list);
    return broken;
}

/* A body after a step with separate forces and motion: broken bonds, and whether a particle has diverged. */
struct plain {
    struct body body;
    int64_t broken;
    bool diverged;
};

static real fastest_of(int way) { return way % 2 ? 1e9 : 1e-3; }

static void plain_make(struct plain *plain, bond_force_fn *force, int dim, enum pd_model model, int way)
{
    body_make(&plain->body, dim, model, way);
    struct pd_motion motion = motion_of(&plain->body, way, fastest_of(way));
    plain->broken = forces_then_motion(&plain->body, force, way, &motion);
    plain->diverged = motion.diverged;
    assert_true(plain->broken > 0);
    assert_int_equal(plain->diverged, fastest_of(way) < 1);
}

/* Compares `plain` bit by bit with a fused sweep by the kernel `force` on `threads` threads. dim, model, way:
 * dimensions, bond model and flags of the variant. The body is created on one thread, which is faster. */
static void check_sweep(const struct plain *plain, bond_force_fn *force, int dim, enum pd_model model, int way,
                        int threads)
{
    struct body b;
    omp_set_num_threads(1);
    body_make(&b, dim, model, way);
    struct pd_motion at_once = motion_of(&b, way, fastest_of(way));
    omp_set_num_threads(threads);
    assert_int_equal(force(&b.c.bonds, &b.c.p, &b.c.source.limit, &at_once), plain->broken);
    omp_set_num_threads(1);
    assert_int_equal(at_once.diverged, plain->diverged);
    assert_same_particles(&plain->body.c.p, &b.c.p, 0);
    body_free(&b);
}

static void check_sweeps(int dim, enum pd_model model)
{
    bond_force_fn *force = model >= PD_OSPD ? state_force_table[dim][model] : bond_force_table[dim][model];
    struct plain plain[WAYS];
    for (int way = 0; way < WAYS; way++) plain_make(&plain[way], force, dim, model, way);
    for (int threads = 1; threads <= THREADS_MOST; threads++) {
        threads_set_count_and_bind_to_cores(threads);
        for (int way = 0; way < WAYS; way++) check_sweep(&plain[way], force, dim, model, way, threads);
    }
    threads_set_count_and_bind_to_cores(1);
    for (int way = 0; way < WAYS; way++) body_free(&plain[way].body);
}

static void test_sweep(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model < PD_MODELS; model++)
            if (dim > 1 || model < PD_OSPD) check_sweeps(dim, model);
}

/* Checks that the stored reach, in blocks of eight rows, is at least the distance to the farthest block that any row
 * reads, and at most an eighth of the body. */
static void test_reach(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int way = 0; way < LOADED; way++) {
            struct body b;
            body_make(&b, dim, PD_BOND, way);
            const struct bonds *bonds = &b.c.bonds;
            int64_t farthest = 0;
            for (int64_t g = 0; g < bonds->row_blocks; g++)
                for (int64_t k = 0; k < bonds->column_count[g]; k++)
                    for (int l = 0; l < LANES && g * LANES + l < bonds->rows; l++) {
                        const int64_t row = bonds->row_of[bond_read(bonds, g, k, l).nbr];
                        if (row >= 0 && llabs(row / LANES - g) > farthest) farthest = llabs(row / LANES - g);
                    }
            assert_true(bonds->reach >= farthest);
            assert_true(bonds->reach <= bonds->row_blocks / 8);
            body_free(&b);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sweep),
        cmocka_unit_test(test_reach),
    };
    threads_set_count_and_bind_to_cores(1);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
