/* Tests the equilibrium solver with trusses: small displacements against elimination; bars that rotate, snap through
 * and have large prescribed displacements against closed forms; balance of work. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "solver/equilibrium.h"

/* ---- trusses ----------------------------------------------------------------------------------------------------- */

enum { NODES = 12, BARS = 40 };

/* A truss: bars between nodes with the force k (length - rest) along the bar. */
struct truss {
    int dim, nodes, bars;
    real X[NODES][DIM_MAX], load[NODES][DIM_MAX];
    struct {
        int a, b;
        real stiffness, rest;
    } bar[BARS];
    struct newton_solver q;
    struct field way;
};

static real bar_now(const struct truss *t, int k, const struct field *u, real *along)
{
    real length2 = 0;
    for (int d = 0; d < t->dim; d++) {
        const int a = t->bar[k].a, b = t->bar[k].b;
        along[d] = t->X[b][d] + u->of[d][b] - t->X[a][d] - u->of[d][a];
        length2 += square(along[d]);
    }
    return sqrt(length2);
}

static void truss_force(void *context, const struct field *u, struct field *f)
{
    const struct truss *t = context;
    for (int d = 0; d < t->dim; d++)
        for (int i = 0; i < t->nodes; i++) f->of[d][i] = t->load[i][d];
    for (int k = 0; k < t->bars; k++) {
        real along[DIM_MAX];
        const real length = bar_now(t, k, u, along);
        for (int d = 0; d < t->dim; d++) {
            const real force = t->bar[k].stiffness * (length - t->bar[k].rest) * along[d] / length;
            f->of[d][t->bar[k].a] += force, f->of[d][t->bar[k].b] -= force;
        }
    }
}

static real truss_energy(const struct truss *t)
{
    real sum = 0, along[DIM_MAX];
    for (int k = 0; k < t->bars; k++)
        sum += 0.5 * t->bar[k].stiffness * square(bar_now(t, k, &t->q.u, along) - t->bar[k].rest);
    return sum;
}

/* Computes the preconditioned residual z from r with the sum of the diagonal entries of all bars of the truss *context,
 * so that every node has stiffness in it. */
static void truss_precondition(void *context, const struct field *r, struct field *z)
{
    const struct truss *t = context;
    for (int i = 0; i < t->nodes; i++) {
        real sum = 0;
        for (int k = 0; k < t->bars; k++)
            if (t->bar[k].a == i || t->bar[k].b == i) sum += t->bar[k].stiffness;
        for (int d = 0; d < t->dim; d++) z->of[d][i] = t->q.held[i] >> d & 1 ? 0 : r->of[d][i] / sum;
    }
}

static void bar_add(struct truss *t, int a, int b, real stiffness)
{
    real length2 = 0;
    for (int d = 0; d < t->dim; d++) length2 += square(t->X[a][d] - t->X[b][d]);
    t->bar[t->bars].a = a, t->bar[t->bars].b = b;
    t->bar[t->bars].stiffness = stiffness;
    t->bar[t->bars++].rest = sqrt(length2);
}

static void truss_make(struct truss *t, real tolerance)
{
    t->q = (struct newton_solver){.force = truss_force,
                                  .precondition = truss_precondition,
                                  .context = t,
                                  .tolerance = tolerance,
                                  .length = 1,
                                  .unit_energy = 1};
    newton_solver_make(&t->q, t->dim, t->nodes);
    for (int d = 0; d < t->dim; d++) t->way.of[d] = NEW("test.way", t->nodes, real);
}

static void truss_free(struct truss *t)
{
    newton_solver_free(&t->q);
    for (int d = 0; d < t->dim; d++) memory_free(t->way.of[d]);
}

static status truss_find(struct truss *t, bool moved)
{
    real applied = 0;
    for (int i = 0; i < t->nodes; i++)
        for (int d = 0; d < t->dim; d++) applied += t->q.held[i] >> d & 1 ? 0 : square(t->load[i][d]);
    t->q.applied = sqrt(applied);
    return newton_solver_find_equilibrium(&t->q, &t->way, moved);
}

/* ---- cases ------------------------------------------------------------------------------------------------------- */

/* Solves A x = b by elimination. n: number of unknowns; A: n rows of the matrix, each followed by its right-hand
 * side. */
static void eliminate(int n, real (*A)[2 * NODES + 1], real *x)
{
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) {
            const real share = A[i][k] / A[k][k];
            for (int j = k; j <= n; j++) A[i][j] -= share * A[k][j];
        }
    for (int k = n; k-- > 0;) {
        x[k] = A[k][n];
        for (int j = k + 1; j < n; j++) x[k] -= A[k][j] * x[j];
        x[k] /= A[k][k];
    }
}

/* Compares a plane truss of ten free and two fixed nodes with elimination, for residuals of 1e-5 and 1e-9. Tolerance:
 * 30 residuals and 1e-3 for nonlinear effects, since displacements are a thousandth of the size. */
static void test_linear(void **state)
{
    (void)state;
    static const real tolerance[] = {1e-5, 1e-9};
    for (int c = 0; c < 2; c++) {
        struct truss t = {.dim = 2, .nodes = NODES};
        real A[2 * NODES][2 * NODES + 1] = {{0}}, x[2 * NODES], most = 0;
        for (int i = 0; i < NODES; i++)
            t.X[i][0] = i % 2 + 0.1 * i, t.X[i][1] = 0.5 * i, t.load[i][i % 2] = 1e-6 * (1 + i);
        for (int i = 0; i < NODES; i++)
            for (int j = i + 1; j < NODES && j <= i + 3; j++) bar_add(&t, i, j, 1 + 0.1 * i);
        truss_make(&t, tolerance[c]);
        t.q.held[0] = t.q.held[1] = 3;
        for (int k = 0; k < t.bars; k++) {
            real n[2], length = t.bar[k].rest;
            const int end[2] = {t.bar[k].a, t.bar[k].b};
            for (int d = 0; d < 2; d++) n[d] = (t.X[end[1]][d] - t.X[end[0]][d]) / length;
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++)
                    for (int d = 0; d < 4; d++)
                        A[2 * end[a] + d / 2][2 * end[b] + d % 2] +=
                            (a == b ? 1 : -1) * t.bar[k].stiffness * n[d / 2] * n[d % 2];
        }
        for (int k = 0; k < 2 * NODES; k++) A[k][2 * NODES] = t.load[k / 2][k % 2];
        for (int k = 0; k < 4; k++) {
            for (int j = 0; j <= 2 * NODES; j++) A[k][j] = 0;
            A[k][k] = 1;
        }
        eliminate(2 * NODES, A, x);
        for (int k = 0; k < 2 * NODES; k++) most = real_max(most, fabs(x[k]));
        assert_int_equal(truss_find(&t, true), OK);
        assert_true(t.q.residual <= tolerance[c]);
        for (int k = 4; k < 2 * NODES; k++)
            assert_true(fabs(t.q.u.of[k % 2][k / 2] - x[k]) < (30 * tolerance[c] + 1e-3) * most);
        truss_free(&t);
    }
}

/* Checks a bar on a hinge under a transverse force: it rotates by a right angle into the direction of the force and has
 * the length of equilibrium. */
static void test_turns(void **state)
{
    (void)state;
    struct truss t = {.dim = 2, .nodes = 2, .X = {{0, 0}, {1, 0}}, .load = {{0}, {0, 0.05}}};
    bar_add(&t, 0, 1, 1);
    truss_make(&t, 1e-8);
    t.q.held[0] = 3;
    assert_int_equal(truss_find(&t, true), OK);
    assert_true(fabs(1 + t.q.u.of[0][1]) < 1e-6 && fabs(t.q.u.of[1][1] - 1.05) < 1e-6);
    assert_true(t.q.directions < 200);
    truss_free(&t);
}

/* Returns the downward load at which a flat roof of two bars (k = 1, half span 1, initial height 0.1) is in equilibrium
 * at height y. The snap-through load is about 2 k 0.1^3/(3 sqrt 3) = 3.85e-4. Below it the roof stays above its
 * supports, beyond it it hangs. */
static real roof_load(real y) { return 2 * (sqrt(1.01) / hypot(1, y) - 1) * y; }
static void test_snaps(void **state)
{
    (void)state;
    static const struct {
        real load, from, to;
    } roof[] = {{3.0e-4, 0.07, 0.1}, {5.0e-4, -0.2, -0.1}};
    for (int c = 0; c < 2; c++) {
        struct truss t = {
            .dim = 2, .nodes = 3, .X = {{-1, 0}, {1, 0}, {0, 0.1}}, .load = {{0}, {0}, {0, -roof[c].load}}};
        bar_add(&t, 0, 2, 1);
        bar_add(&t, 1, 2, 1);
        truss_make(&t, 1e-9);
        t.q.held[0] = t.q.held[1] = 3;
        assert_int_equal(truss_find(&t, true), OK);
        real low = roof[c].from, high = roof[c].to; /* bisection: the load decreases from `from` to `to` */
        for (int k = 0; k < 60; k++) {
            const real y = 0.5 * (low + high);
            if (roof_load(y) > roof[c].load)
                low = y;
            else
                high = y;
        }
        assert_true(fabs(0.1 + t.q.u.of[1][2] - low) < 1e-6);
        truss_free(&t);
    }
}

/* Checks a roof whose middle is pushed through by a prescribed displacement: strain energy plus dissipated energy
 * equals the work of the support. Then a bar breaks: its energy and that released by the others are dissipated.
 * Tolerances: the work is that of the mean support force, to 0.5 %, for displacements of a twentieth of a bar. */
static void test_work(void **state)
{
    (void)state;
    struct truss t = {.dim = 2, .nodes = 4, .X = {{-1, 0}, {1, 0}, {0, 0.3}, {0, 1.3}}};
    real work = 0;
    bar_add(&t, 0, 2, 1);
    bar_add(&t, 2, 3, 2);
    bar_add(&t, 0, 3, 0.1);
    bar_add(&t, 1, 2, 1);
    truss_make(&t, 1e-9);
    t.q.held[0] = t.q.held[1] = t.q.held[3] = 3;
    for (int k = 0; k < 6; k++) {
        const real before = t.q.f.of[1][3];
        t.way.of[1][3] = 0.05;
        assert_int_equal(truss_find(&t, true), OK);
        work -= 0.5 * (before + t.q.f.of[1][3]) * 0.05;
    }
    assert_true(fabs(truss_energy(&t) + t.q.lost - work) < 1e-3 * work);
    assert_true(fabs(t.q.lost) < 5e-3 * work);
    t.bars--;
    const real had = truss_energy(&t), lost = t.q.lost;
    assert_int_equal(truss_find(&t, false), OK);
    assert_true(had > truss_energy(&t));
    assert_true(fabs(t.q.lost - lost - (had - truss_energy(&t))) < 1e-3 * (had - truss_energy(&t)));
    truss_free(&t);
}

/* Checks that a structure without resistance to the load has no equilibrium. */
static void test_none(void **state)
{
    (void)state;
    struct truss t = {.dim = 2, .nodes = 2, .X = {{0, 0}, {1, 0}}, .load = {{0}, {1e-3, 0}}};
    bar_add(&t, 0, 1, 1);
    truss_make(&t, 1e-8);
    assert_int_equal(truss_find(&t, true), FAILED);
    truss_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear), cmocka_unit_test(test_turns), cmocka_unit_test(test_snaps),
        cmocka_unit_test(test_work),   cmocka_unit_test(test_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
