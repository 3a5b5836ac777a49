/* floor 5: what a material point at the end of a state-based bond is taken to know: the mean strain of its stress and the mean
 * rotation of its peridynamic neighbours, images among them; and what stress it leaves to its bonds. */
#include <string.h>

#include "cloud.h"
#include "engine.h"
#include "near.h"
#include "polar.h"
#include "sets.h"
#include "state_laws.h"
#include "team.h"

#define TURN_MOST 0.2                    /* of a particle [rad] */
#define ROUND_OFF 1e-13                  /* of g R: sums of a few dozen bonds, a root and Newton's steps */

/* A crack that begins at a plane of symmetry: bonds end at points, and at images of peridynamic particles. */
static const char plate[] =
    "name: plate\nspace: plane stress\nthickness: 1 mm\nduration: 1 us\nmodel: mospd\n"
    "material: {young: 72 GPa, poisson: 0.2, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}\n"
    "body: [{box: {from: [0, 0], to: [20 mm, 16 mm]}}]\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "cracks: [{from: [10 mm, -1 mm], to: [10 mm, 3 mm]}]\nboundary: [{mirror: {axis: y, at: 0, tangential: free}}]\n";
static const char block[] =
    "name: block\nspace: solid\nduration: 1 us\nmodel: mospd\n"
    "material: {young: 72 GPa, poisson: 0.2, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}\n"
    "body: [{box: {from: [0, 0, 0], to: [14 mm, 9 mm, 5 mm]}}]\nparticles: {spacing: 1 mm, horizon: 2.015}\n"
    "cracks: [{polygon: [[7 mm, -1 mm, -1 mm], [7 mm, 2 mm, -1 mm], [7 mm, 2 mm, 6 mm], [7 mm, -1 mm, 6 mm]]}]\n"
    "boundary: [{mirror: {axis: y, at: 0, tangential: free}}]\n";

/* Places that turn differently everywhere, with random stress in the points. */
static void shake(struct engine *e)
{
    struct particles *p = &e->part;
    uint64_t seed = 5;
    for (int64_t i = 0; i < p->n; i++) {
        const real angle = TURN_MOST * p->X[0][i] / 20e-3;
        const real turn[3] = {-angle * p->X[1][i], angle * p->X[0][i], 0.5 * angle * p->X[0][i]};
        for (int d = 0; d < p->dim; d++) p->x[d][i] = p->X[d][i] + turn[d] + cloud_between(&seed, -1e-5, 1e-5);
        for (int s = 0; s < symmetric_count(p->dim); s++) p->stress[s][i] = cloud_between(&seed, -1e6, 1e6);
    }
    loads_mirror(&e->loads, p);
}

/* g (R - 1) of a particle, row major, from what is kept of it. */
static void turned(const struct state *t, int64_t i, int dim, real *G)
{
    lanes turn[TURN];
    for (int c = 0; c < TURN; c++) turn[c] = lanes_of(t->turn[c][i]);
    for (int c = 0; c < dim; c++) {
        lanes less[DIM_MAX] = {{0}}, unit[DIM_MAX] = {{0}};
        unit[c] = lanes_of(1);
        turn_off(less, turn, unit, dim);
        for (int d = 0; d < dim; d++) G[d * dim + c] = -less[d][0];
    }
}

/* Rotation nearest to sum w g R over the neighbours of a row; returns how many images are among them. */
static int mean_rotation(const struct bonds *b, const struct particles *p, int64_t row, real *R)
{
    real M[DIM_MAX * DIM_MAX] = {0}, G[DIM_MAX * DIM_MAX];
    int images = 0;
    for (int64_t k = 0; k < b->slot_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, (int)(row % LANES));
        if (bond.w == 0) continue;
        images += bond.nbr >= p->n;
        turned(&b->state, bond.nbr, p->dim, G);
        for (int c = 0; c < p->dim * p->dim; c++)
            M[c] += bond.w * (G[c] + (c % (p->dim + 1) == 0 ? b->state.spring[bond.nbr] : 0));
    }
    polar_rotation(M, R, p->dim);
    return images;
}

static void check_point(const struct engine *e, int64_t i, const real *R)
{
    const struct state *t = &e->bonds.state;
    const struct state_modulus *m = &t->modulus[0];
    const int dim = e->part.dim;
    const real share = e->part.volume0[i] / t->weighted[e->bonds.row_of[i]];
    real trace = 0, G[DIM_MAX * DIM_MAX];
    for (int d = 0; d < dim; d++) trace += e->part.stress[d][i];
    assert_close(t->pressure[i], m->A * trace / (dim * dim * m->bulk) * share, 1e-14);
    assert_close(t->spring[i], m->B * share, 1e-14);
    turned(t, i, dim, G);
    for (int c = 0; c < dim * dim; c++)
        assert_near(G[c], t->spring[i] * (R[c] - (c % (dim + 1) == 0)), ROUND_OFF * t->spring[i]);
}

/* What is known twice in a row is the same: nothing is read before it is known. */
static void check_once(struct engine *e)
{
    const struct state *t = &e->bonds.state;
    const size_t bytes = (size_t)e->part.n_all * sizeof(real);
    real *before[TURN];
    for (int c = 0; c < TURN; c++) memcpy(before[c] = NEW("test.turn", e->part.n_all, real), t->turn[c], bytes);
    families_know(&e->bonds, &e->part, &e->source);
    for (int c = 0; c < TURN; c++) {
        assert_memory_equal(before[c], t->turn[c], bytes);
        memory_free(before[c]);
    }
}

static void engine_from(struct engine *e, struct scene *s, const char *text)
{
    if (scene_read_text(s, text, strlen(text), "points.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_int_equal(engine_make(e, s, NULL), OK);
}

static void check_points(const char *text)
{
    struct scene s;
    struct engine e = {0};
    int64_t points = 0, images = 0;
    engine_from(&e, &s, text);
    shake(&e);
    families_know(&e.bonds, &e.part, &e.source);
    check_once(&e);
    for (int64_t row = 0; row < e.bonds.rows; row++) {
        const int64_t i = e.bonds.particle[row];
        real R[DIM_MAX * DIM_MAX];
        if (e.part.kind[i] != KIND_MPM) continue;
        images += mean_rotation(&e.bonds, &e.part, row, R);
        check_point(&e, i, R);
        points++;
    }
    assert_true(points > 50 && images > 10);
    engine_free(&e);
    scene_free(&s);
}

static void test_points(void **state)
{
    (void)state;
    check_points(plate);
    check_points(block);
}

/* Of a point, with the map of sites and by searching: the same bits. */
static void same_partials(const struct partial_stress *a, const struct partial_stress *b, int64_t n, int dim)
{
    const int symmetric = symmetric_count(dim), size = symmetric * symmetric, skew = dim * (dim - 1) / 2 * symmetric;
    int64_t points = 0;
    for (int64_t i = 0; i < n; i++) {
        assert_int_equal(a->index[i] >= 0, b->index[i] >= 0);
        if (a->index[i] < 0) continue;
        assert_memory_equal(a->matrix + a->index[i] * size, b->matrix + b->index[i] * size, (size_t)size * sizeof(real));
        assert_memory_equal(a->skew + a->index[i] * skew, b->skew + b->index[i] * skew, (size_t)skew * sizeof(real));
        points++;
    }
    assert_true(points > 50);
}

static void check_partials(const char *text)
{
    struct scene s;
    struct engine e = {0};
    struct bonds searched;
    struct partial_stress again = {0};
    engine_from(&e, &s, text);
    int64_t point = 0;
    while (e.part.kind[point] != KIND_MPM || e.bonds.row_of[point] < 0) point++;
    e.part.flag[point] |= FLAG_STRESSED;
    assert_true(convert(&e.conversion, &s.conversion, &e.part, &e.bonds, &e.source, &e.partial, NULL, 0) > 0);
    assert_non_null(e.bonds.sites);
    bonds_make(&searched, NULL, &e.part, &e.source);
    struct lattice *sites = searched.sites;
    searched.sites = NULL;
    partial_stress_make(&again, &e.part, &searched, &e.source, NULL, 0);
    searched.sites = sites;
    same_partials(&e.partial, &again, e.part.n, e.part.dim);
    partial_stress_free(&again);
    bonds_free(&searched);
    engine_free(&e);
    scene_free(&s);
}

static void test_partials(void **state)
{
    (void)state;
    check_partials(plate);
    check_partials(block);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_partials)};
    team_make(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
