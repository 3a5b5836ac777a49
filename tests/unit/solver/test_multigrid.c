/* Tests the multigrid preconditioner: solutions against dense elimination, symmetry, positive definiteness, number of
 * iterations for any size, with cracks and unconstrained fragments, bitwise equality on any number of threads, invalid
 * input. */
#include "tests/support/near.h"

#include <omp.h>
#include <stdlib.h>

#include "base/memory.h"
#include "solver/multigrid.h"

enum {
    MESH_CELLS = 1,
    CRACK = 2,
    HOLE = 4,
    FREE_PIECE = 8,
    SHIFTED = 16,
    LOOSE = 32,
    DAMAGED = 64,
    TWO_MATERIALS = 128
};

/* A lattice of particles with springs of stiffness 1/|xi| (xi: bond vector) within 3.015 spacings, or to the nearest
 * 3^dim - 1 particles as in a mesh of cells. Particles with x < 3 are fixed. kind: flags of the case. */
struct body {
    int dim, kind;
    int size[DIM_MAX];
    struct block_matrix a;
    real *place[DIM_MAX];
    uint8_t *held;
    int32_t *node; /* [positions of the lattice] node, -1: none */
};

/* Returns the pseudo-random number k in [-1/2, 1/2), equal on all machines. */
static real mixed(uint64_t k)
{
    k = (k + 1) * 0x9e3779b97f4a7c15u;
    k = (k ^ k >> 31) * 0xbf58476d1ce4e5b9u;
    return (real)((k ^ k >> 29) >> 11) / 9007199254740992.0 - 0.5;
}

static bool in_piece(const struct body *b, const int *at)
{
    for (int d = 0; d < b->dim; d++)
        if (at[d] < b->size[d] / 3 || at[d] >= b->size[d] * 2 / 3) return false;
    return true;
}

/* Returns true if a bond connects the lattice positions `from` and `to` in a body of b's kind. */
static bool joined(const struct body *b, const int *from, const int *to)
{
    const real middle = b->size[1] / 2 - 0.5;
    if (b->kind & FREE_PIECE && in_piece(b, from) != in_piece(b, to)) return false;
    if (b->kind & CRACK && (from[1] > middle) != (to[1] > middle) && from[0] + to[0] > b->size[0] / 2) return false;
    if (b->kind & DAMAGED) {
        const uint64_t one = (uint64_t)(from[1] * b->size[0] + from[0]), other = (uint64_t)(to[1] * b->size[0] + to[0]);
        if (one != other && mixed(one * other + one + other) < -0.1) return false;
    }
    return true;
}

/* Returns the factor on the stiffness of the bond between the positions `from` and `to` of b. One of two materials is a
 * thousand times as stiff; bonds between them have the harmonic mean. */
static real bond_factor(const struct body *b, const int *from, const int *to)
{
    const int stiff = (from[0] > b->size[0] / 2) + (to[0] > b->size[0] / 2);
    return !(b->kind & TWO_MATERIALS) || stiff == 0 ? 1 : stiff == 2 ? 1000 : 2;
}

static bool is_material(const struct body *b, const int *at)
{
    return !(b->kind & HOLE) || hypot(at[0] - b->size[0] / 2.0, at[1] - b->size[1] / 2.0) >= b->size[0] / 5.0;
}

static void place_of(const struct body *b, int64_t k, int *at)
{
    at[0] = (int)(k % b->size[0]);
    at[1] = (int)(k / b->size[0] % b->size[1]);
    at[2] = (int)(k / b->size[0] / b->size[1]);
}

/* Creates the matrix row of the node at lattice position k of b, from entry `first` on. Returns the end of its
 * entries. */
static int64_t row_make(struct body *b, int64_t k, int64_t first)
{
    const int dim = b->dim, reach = b->kind & MESH_CELLS ? 1 : 3, size = dim * dim;
    const int64_t i = b->node[k];
    int at[DIM_MAX], to[DIM_MAX];
    int64_t q = first, own = -1;
    place_of(b, k, at);
    for (int s = 0; s < 343; s++) {
        int64_t at_to = 0, stride = 1;
        bool inside = true;
        for (int d = 0, rest = s; d < DIM_MAX; rest /= 7, d++) {
            to[d] = at[d] + rest % 7 - 3;
            inside = inside && to[d] >= 0 && to[d] < b->size[d] && abs(to[d] - at[d]) <= reach;
            at_to += to[d] * stride, stride *= b->size[d];
        }
        if (!inside || b->node[at_to] < 0 || !joined(b, at, to)) continue;
        const int64_t j = b->node[at_to];
        real xi[DIM_MAX] = {0}, length = 0;
        for (int d = 0; d < dim; d++) xi[d] = b->place[d][j] - b->place[d][i], length += xi[d] * xi[d];
        if (length > square(3.015)) continue;
        b->a.column[q] = (int32_t)j;
        for (int c = 0; c < size; c++) b->a.block[q * size + c] = 0;
        if (j == i)
            own = q;
        else
            for (int c = 0; c < size; c++)
                b->a.block[q * size + c] =
                    (float)(-bond_factor(b, at, to) * xi[c / dim] * xi[c % dim] / (length * sqrt(length)));
        q++;
    }
    for (int64_t p = first; p < q; p++)
        for (int c = 0; c < size && p != own; c++) b->a.block[own * size + c] -= b->a.block[p * size + c];
    return q;
}

static void body_make(struct body *b, int dim, int nx, int ny, int nz, int kind)
{
    *b = (struct body){.dim = dim, .kind = kind, .size = {nx, ny, nz}};
    const int64_t places = (int64_t)nx * ny * nz, loose = kind & LOOSE ? 5 : 0;
    const int64_t most = places * (dim == 1 ? 7 : dim == 2 ? 37 : 160) + loose;
    b->node = NEW("test", places, int32_t);
    b->held = NEW("test", places + loose, uint8_t);
    for (int d = 0; d < dim; d++) b->place[d] = NEW("test", places + loose, real);
    int64_t n = 0;
    for (int64_t k = 0; k < places; k++) {
        int at[DIM_MAX];
        place_of(b, k, at);
        b->node[k] = is_material(b, at) ? (int32_t)n : -1;
        if (b->node[k] < 0) continue;
        b->held[n] = at[0] < 3 ? 7 : 0;
        for (int d = 0; d < dim; d++)
            b->place[d][n] = at[d] + (kind & SHIFTED ? 0.6 * mixed((uint64_t)(k * dim + d)) : 0);
        n++;
    }
    b->a = (struct block_matrix){dim, n + loose, NEW("test", n + loose + 1, int64_t), NEW("test", most, int32_t),
                                 NEW("test", most * dim * dim, float)};
    for (int64_t k = 0, i = 0; k < places; k++)
        if (b->node[k] >= 0) b->a.first[i + 1] = row_make(b, k, b->a.first[i]), i++;
    for (int64_t i = n; i < n + loose; i++) {
        b->a.column[b->a.first[i]] = (int32_t)i;
        b->a.first[i + 1] = b->a.first[i] + 1;
    }
}

static void body_free(struct body *b)
{
    memory_free(b->a.first);
    memory_free(b->a.column);
    memory_free(b->a.block);
    memory_free(b->held);
    memory_free(b->node);
    for (int d = 0; d < b->dim; d++) memory_free(b->place[d]);
}

/* ---- vectors ----------------------------------------------------------------------------------------------------- */

/* A vector field: one array per axis with a value for each node. */
struct vectors {
    real *of[DIM_MAX];
};

static struct vectors vectors_make(const struct body *b)
{
    struct vectors v = {{NULL}};
    for (int d = 0; d < b->dim; d++) v.of[d] = NEW("test", b->a.n, real);
    return v;
}

static void vectors_free(struct vectors *v)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(v->of[d]);
}

static bool component_free(const struct body *b, int64_t i, int d)
{
    return !(b->held[i] >> d & 1) && b->a.first[i + 1] > b->a.first[i] + 1;
}

static struct vectors vectors_mixed(const struct body *b, uint64_t seed)
{
    struct vectors v = vectors_make(b);
    for (int d = 0; d < b->dim; d++)
        for (int64_t i = 0; i < b->a.n; i++)
            v.of[d][i] = component_free(b, i, d) ? mixed(seed * 1000003 + (uint64_t)(i * b->dim + d)) : 0;
    return v;
}

static real product(const struct body *b, const struct vectors *x, const struct vectors *y)
{
    real sum = 0;
    for (int d = 0; d < b->dim; d++)
        for (int64_t i = 0; i < b->a.n; i++) sum += x->of[d][i] * y->of[d][i];
    return sum;
}

/* Computes y = K x for b from the forces of bonds stretched by differences of the displacements x. */
static void stiffness(const struct body *b, const struct vectors *x, struct vectors *y)
{
    const int dim = b->dim;
    for (int64_t i = 0; i < b->a.n; i++) {
        real sum[DIM_MAX] = {0};
        for (int64_t q = b->a.first[i]; q < b->a.first[i + 1]; q++)
            for (int c = 0; c < dim * dim && b->a.column[q] != i; c++)
                sum[c / dim] += b->a.block[q * dim * dim + c] * (x->of[c % dim][b->a.column[q]] - x->of[c % dim][i]);
        for (int d = 0; d < dim; d++) y->of[d][i] = component_free(b, i, d) ? sum[d] : 0;
    }
}

/* Solves K u = load for b by conjugate gradients with the preconditioner m to a residual of 1e-8. Returns the number of
 * iterations. */
static int solve_with(struct multigrid *m, const struct body *b, const struct vectors *load, struct vectors *u)
{
    enum { MOST = 200 };
    struct vectors r = vectors_make(b), z = vectors_make(b), d = vectors_make(b), q = vectors_make(b);
    real rz = 0;
    int k = 0;
    for (int c = 0; c < b->dim; c++) memcpy(r.of[c], load->of[c], (size_t)b->a.n * sizeof(real));
    for (; k < MOST && product(b, &r, &r) > 1e-16 * product(b, load, load); k++) {
        multigrid_apply_v_cycle(m, r.of, z.of);
        const real next = product(b, &r, &z), beta = k > 0 ? next / rz : 0;
        rz = next;
        for (int c = 0; c < b->dim; c++)
            for (int64_t i = 0; i < b->a.n; i++) d.of[c][i] = z.of[c][i] + beta * d.of[c][i];
        stiffness(b, &d, &q);
        const real alpha = rz / product(b, &d, &q);
        for (int c = 0; c < b->dim; c++)
            for (int64_t i = 0; i < b->a.n; i++) u->of[c][i] += alpha * d.of[c][i], r.of[c][i] -= alpha * q.of[c][i];
    }
    vectors_free(&r), vectors_free(&z), vectors_free(&d), vectors_free(&q);
    return k;
}

static int solve(const struct body *b, const struct vectors *load, struct vectors *u)
{
    struct multigrid *m;
    assert_ok(multigrid_make(&m, &b->a, b->place, b->held));
    const int k = solve_with(m, b, load, u);
    multigrid_free(m);
    return k;
}

/* Returns a load along the body b with a smaller one across, to be freed with vectors_free. */
static struct vectors load_make(const struct body *b)
{
    struct vectors v = vectors_make(b);
    for (int d = 0; d < b->dim; d++)
        for (int64_t i = 0; i < b->a.n; i++) {
            const bool end = b->place[0][i] > b->size[0] - 2;
            v.of[d][i] = component_free(b, i, d) && end ? (d == 0 ? 1 : 0.3) : 0;
        }
    return v;
}

static int iterations(int dim, int nx, int ny, int nz, int kind)
{
    struct body b;
    body_make(&b, dim, nx, ny, nz, kind);
    struct vectors load = load_make(&b), u = vectors_make(&b);
    const int k = solve(&b, &load, &u);
    vectors_free(&load), vectors_free(&u);
    body_free(&b);
    return k;
}

/* ---- solutions --------------------------------------------------------------------------------------------------- */

/* Computes x = K^-1 load for b by elimination of the dense matrix of the free components. */
static void dense_reference(const struct body *b, const struct vectors *load, real *x)
{
    const int dim = b->dim;
    const int64_t n = b->a.n * dim;
    real *k = NEW("test", n * n, real);
    for (int64_t i = 0; i < b->a.n; i++)
        for (int64_t q = b->a.first[i]; q < b->a.first[i + 1]; q++)
            for (int c = 0; c < dim * dim; c++) {
                const int64_t row = i * dim + c / dim, column = (int64_t)b->a.column[q] * dim + c % dim;
                if (row != column || component_free(b, i, c / dim))
                    k[row * n + column] = component_free(b, i, c / dim) && component_free(b, b->a.column[q], c % dim)
                                              ? b->a.block[q * dim * dim + c]
                                              : 0;
                else
                    k[row * n + column] = 1;
            }
    for (int64_t i = 0; i < n; i++) x[i] = load->of[i % dim][i / dim];
    for (int64_t j = 0; j < n; j++)
        for (int64_t i = j + 1; i < n; i++) {
            const real part = k[i * n + j] / k[j * n + j];
            for (int64_t c = j; c < n && part != 0; c++) k[i * n + c] -= part * k[j * n + c];
            x[i] -= part * x[j];
        }
    for (int64_t i = n - 1; i >= 0; i--) {
        for (int64_t c = i + 1; c < n; c++) x[i] -= k[i * n + c] * x[c];
        x[i] /= k[i * n + i];
    }
    memory_free(k);
}

/* Compares solutions with dense elimination. Tolerance: the stiffness is in single precision, 6e-8 of the diagonal,
 * over the smallest eigenvalue of these small bodies, 1e-3. */
static void solutions_are_those_of_elimination(void **state)
{
    (void)state;
    const struct {
        int dim, size[DIM_MAX], kind;
    } body[] = {{1, {60, 1, 1}, 0}, {2, {24, 10, 1}, CRACK}, {2, {16, 16, 1}, MESH_CELLS}, {3, {9, 6, 5}, SHIFTED}};
    for (size_t c = 0; c < COUNT_OF(body); c++) {
        struct body b;
        body_make(&b, body[c].dim, body[c].size[0], body[c].size[1], body[c].size[2], body[c].kind);
        struct vectors load = load_make(&b), u = vectors_make(&b);
        real *x = NEW("test", b.a.n * b.dim, real), most = 0;
        assert_true(solve(&b, &load, &u) < 30);
        dense_reference(&b, &load, x);
        for (int64_t k = 0; k < b.a.n * b.dim; k++) most = real_max(most, fabs(x[k]));
        for (int64_t k = 0; k < b.a.n * b.dim; k++) assert_near(u.of[k % b.dim][k / b.dim], x[k], 1e-4 * most);
        memory_free(x);
        vectors_free(&load), vectors_free(&u);
        body_free(&b);
    }
}

/* Checks that the number of iterations does not grow with the body. Limits are observed numbers plus three, equal on
 * all machines up to round-off. Coarse spaces without rotations, or aggregates across cracks, would need twice as
 * many. */
static void iterations_do_not_grow(void **state)
{
    (void)state;
    const struct {
        int dim, size[DIM_MAX], kind, most;
    } body[] = {
        {1, {2000, 1, 1}, 0, 14},          {2, {40, 40, 1}, 0, 16},          {2, {120, 120, 1}, 0, 17},
        {2, {60, 60, 1}, CRACK, 18},       {2, {60, 60, 1}, HOLE, 17},       {2, {60, 60, 1}, SHIFTED, 18},
        {2, {300, 8, 1}, 0, 18},           {2, {60, 60, 1}, FREE_PIECE, 18}, {2, {60, 60, 1}, LOOSE, 18},
        {2, {60, 60, 1}, MESH_CELLS, 17},  {3, {11, 11, 11}, 0, 14},         {3, {11, 11, 11}, CRACK | SHIFTED, 15},
        {3, {11, 11, 11}, FREE_PIECE, 16}, {2, {60, 60, 1}, DAMAGED, 20},    {2, {60, 60, 1}, TWO_MATERIALS, 18},
    };
    for (size_t c = 0; c < COUNT_OF(body); c++) {
        const int n = iterations(body[c].dim, body[c].size[0], body[c].size[1], body[c].size[2], body[c].kind);
        if (n > body[c].most) fail_msg("body %zu takes %d iterations, where %d are expected", c, n, body[c].most);
    }
}

/* ---- the operator ------------------------------------------------------------------------------------------------ */

/* Checks for random vectors that the preconditioner is symmetric and positive definite, as conjugate gradients
 * require. */
static void operator_is_symmetric_and_positive(void **state)
{
    (void)state;
    const struct {
        int dim, size[DIM_MAX], kind;
    } body[] = {
        {1, {400, 1, 1}, 0}, {2, {70, 70, 1}, CRACK | LOOSE}, {2, {60, 60, 1}, FREE_PIECE}, {3, {10, 10, 10}, SHIFTED}};
    for (size_t c = 0; c < COUNT_OF(body); c++) {
        struct body b;
        struct multigrid *m;
        body_make(&b, body[c].dim, body[c].size[0], body[c].size[1], body[c].size[2], body[c].kind);
        assert_ok(multigrid_make(&m, &b.a, b.place, b.held));
        struct vectors mx = vectors_make(&b), my = vectors_make(&b);
        for (uint64_t seed = 0; seed < 6; seed += 2) {
            struct vectors x = vectors_mixed(&b, seed), y = vectors_mixed(&b, seed + 1);
            multigrid_apply_v_cycle(m, x.of, mx.of);
            multigrid_apply_v_cycle(m, y.of, my.of);
            const real xx = product(&b, &x, &mx), yy = product(&b, &y, &my);
            assert_true(xx > 0 && yy > 0);
            /* The prolongator and its transpose have the same entries: only double-precision round-off. */
            assert_near(product(&b, &x, &my), product(&b, &y, &mx), 1e-5 * sqrt(xx * yy));
            for (int d = 0; d < b.dim; d++)
                for (int64_t i = 0; i < b.a.n; i++)
                    if (!component_free(&b, i, d)) assert_exact(mx.of[d][i], 0);
            vectors_free(&x), vectors_free(&y);
        }
        vectors_free(&mx), vectors_free(&my);
        multigrid_free(m);
        body_free(&b);
    }
}

/* Checks a free body, whose rigid motions have zero stiffness up to round-off and must not be amplified. Balanced loads
 * are solved in as few iterations as for a fixed body. */
static void free_body_stays_bounded(void **state)
{
    (void)state;
    struct body b;
    body_make(&b, 2, 60, 60, 1, 0);
    memset(b.held, 0, (size_t)b.a.n);
    struct vectors load = vectors_make(&b), u = vectors_make(&b);
    for (int64_t i = 0; i < b.a.n; i++) load.of[0][i] = b.place[0][i] < 1 ? -1 : b.place[0][i] > 58 ? 1 : 0;
    assert_true(solve(&b, &load, &u) <= 17);
    real most = 0;
    for (int64_t i = 0; i < b.a.n; i++) most = real_max(most, fabs(u.of[0][i] - u.of[0][0]));
    for (int64_t i = 0; i < b.a.n; i++) assert_true(fabs(u.of[0][i]) < 10 * most && fabs(u.of[1][i]) < 10 * most);
    vectors_free(&load), vectors_free(&u);
    body_free(&b);
}

/* Breaks the bonds of b across the middle of a plate between x0 and x1: their entries of the matrix become 0, with the
 * same sparsity. */
static void bonds_break(struct body *b, real x0, real x1)
{
    const real middle = b->size[1] / 2 - 0.5;
    for (int64_t i = 0; i < b->a.n; i++)
        for (int64_t q = b->a.first[i], own = q; q < b->a.first[i + 1]; q++) {
            const int64_t j = b->a.column[q];
            const real x = 0.5 * (b->place[0][i] + b->place[0][j]);
            if ((b->place[1][i] > middle) == (b->place[1][j] > middle) || x < x0 || x > x1) continue;
            while (b->a.column[own] != i) own++;
            for (int c = 0; c < 4; c++) b->a.block[own * 4 + c] += b->a.block[q * 4 + c], b->a.block[q * 4 + c] = 0;
        }
}

/* Checks that a preconditioner of the intact body remains effective while a crack grows (at most six more iterations),
 * and that one created afterwards takes no account of broken bonds. */
static void broken_bonds_cost_few_iterations(void **state)
{
    (void)state;
    struct body b;
    struct multigrid *m;
    body_make(&b, 2, 70, 70, 1, 0);
    struct vectors load = load_make(&b), u = vectors_make(&b);
    assert_ok(multigrid_make(&m, &b.a, b.place, b.held));
    const int whole = solve_with(m, &b, &load, &u);
    bonds_break(&b, 30, 38);
    assert_in_range(solve_with(m, &b, &load, &u), whole, whole + 6);
    multigrid_free(m);
    bonds_break(&b, 30, 70);
    assert_true(solve(&b, &load, &u) <= 17);
    vectors_free(&load), vectors_free(&u);
    body_free(&b);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    const int before = omp_get_max_threads();
    for (int dim = 2; dim <= 3; dim++) {
        struct body b;
        body_make(&b, dim, dim == 2 ? 90 : 12, dim == 2 ? 90 : 12, dim == 2 ? 1 : 12, SHIFTED);
        struct vectors x = vectors_mixed(&b, 1), z[2];
        for (int t = 0; t < 2; t++) {
            struct multigrid *m;
            omp_set_num_threads(t + 1);
            assert_ok(multigrid_make(&m, &b.a, b.place, b.held));
            z[t] = vectors_make(&b);
            multigrid_apply_v_cycle(m, x.of, z[t].of);
            multigrid_free(m);
            for (int d = 0; d < dim; d++) assert_memory_equal(z[t].of[d], z[0].of[d], (size_t)b.a.n * sizeof(real));
        }
        for (int t = 0; t < 2; t++) vectors_free(&z[t]);
        vectors_free(&x);
        body_free(&b);
    }
    omp_set_num_threads(before);
}

static void bad_stiffness_fails(void **state)
{
    (void)state;
    struct body b;
    struct multigrid *m;
    body_make(&b, 2, 8, 8, 1, 0);
    for (int c = 0; c < 2; c++) {
        const int64_t i = 40;
        for (int64_t q = b.a.first[i]; q < b.a.first[i + 1]; q++)
            if (b.a.column[q] == i) b.a.block[q * 4] = b.a.block[q * 4 + 3] = c ? NAN : -1;
        assert_failed(multigrid_make(&m, &b.a, b.place, b.held), "the stiffness of node 40 is");
        assert_null(m);
    }
    multigrid_free(m);
    body_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_are_those_of_elimination),
        cmocka_unit_test(iterations_do_not_grow),
        cmocka_unit_test(operator_is_symmetric_and_positive),
        cmocka_unit_test(free_body_stays_bounded),
        cmocka_unit_test(broken_bonds_cost_few_iterations),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(bad_stiffness_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
