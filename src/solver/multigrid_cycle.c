/* Computes residual, relaxation, restriction and prolongation of a multigrid level, in parallel over matrix rows. Each
 * row of a result is computed by one thread, so that the result does not depend on their number. */
#include "multigrid_parts.h"

typedef float four __attribute__((vector_size(16)));
typedef float two __attribute__((vector_size(8)));

static ALWAYS_INLINE four four_load(const float *from)
{
    four a;
    memcpy(&a, from, sizeof a);
    return a;
}

/* Subtracts row i of the product K x (matrix of level l times displacements of all nodes) from sum[0], on the finest
 * level in 1D. It is computed from differences of displacements, so that a rigid translation gives exactly no force.
 * l->rest: stiffness of supports, which acts on the displacement itself. */
static ALWAYS_INLINE void row_single_1(const struct multigrid_level *l, int64_t i, const real *x, real *sum)
{
    real force = 0;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) force += l->single[q] * (x[l->column[q]] - x[i]);
    sum[0] -= force + l->rest[i] * x[i];
}

/* Multiplies matrix block q (2 x 2) of level l by the displacement of the node of its column relative to `own`, the
 * displacement of the node of its row. x: displacements of all nodes. Returns the four products of an entry and a
 * component: the first two sum to the first component of the force, the last two to the second. */
static ALWAYS_INLINE four single_2(const struct multigrid_level *l, int64_t q, pair own, const real *x)
{
    const two u = __builtin_convertvector(lane_pair_load(x + (int64_t)l->column[q] * 2) - own, two);
    return four_load(l->single + q * 4) * (four){u[0], u[1], u[0], u[1]};
}

/* Subtracts row i of the product K x (matrix of level l times displacements of all nodes), two components of one node,
 * from sum[0 .. 1], on the finest level in 2D. It is computed from differences of displacements, so that a rigid
 * translation gives exactly no force. l->rest: stiffness of supports, which acts on the displacement itself. */
static ALWAYS_INLINE void row_single_2(const struct multigrid_level *l, int64_t i, const real *x, real *sum)
{
    const int64_t end = l->first[i + 1];
    const pair own = lane_pair_load(x + i * 2);
    four even = {0}, odd = {0};
    int64_t q = l->first[i];
    for (; q + 2 <= end; q += 2) even += single_2(l, q, own, x), odd += single_2(l, q + 1, own, x);
    if (q < end) even += single_2(l, q, own, x);
    even += odd;
    for (int a = 0; a < 2; a++) {
        sum[a] -= (real)even[2 * a] + even[2 * a + 1];
        for (int c = 0; c < 2; c++) sum[a] -= (real)l->rest[(i * 2 + a) * 2 + c] * own[c];
    }
}

/* Subtracts row i of the product K x (matrix of level l times displacements of all nodes), three components of one
 * node, from sum[0 .. 2], on the finest level in 3D. It is computed from differences of displacements, so that a rigid
 * translation gives exactly no force. l->rest: stiffness of supports, which acts on the displacement itself. */
static ALWAYS_INLINE void row_single_3(const struct multigrid_level *l, int64_t i, const real *x, real *sum)
{
    const pair own = lane_pair_load(x + i * 3);
    const real own_z = x[i * 3 + 2];
    four head = {0}, middle = {0};
    float tail = 0;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const real *to = x + (int64_t)l->column[q] * 3;
        const float *k = l->single + q * 9;
        const two u = __builtin_convertvector(lane_pair_load(to) - own, two);
        const float z = (float)(to[2] - own_z);
        head += four_load(k) * (four){u[0], u[1], z, u[0]};
        middle += four_load(k + 4) * (four){u[1], z, u[0], u[1]};
        tail += k[8] * z;
    }
    sum[0] -= (real)head[0] + head[1] + head[2];
    sum[1] -= (real)head[3] + middle[0] + middle[1];
    sum[2] -= (real)middle[2] + middle[3] + tail;
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < 3; c++) sum[a] -= (real)l->rest[(i * 3 + a) * 3 + c] * x[i * 3 + c];
}

/* Subtracts row i of the product K x, with the matrix K of level l, from sum[0 .. w - 1]. x: displacements of all
 * nodes; w: components per node; single: true for the finest level, whose matrix is in single precision. w and single
 * must be compile-time constants. */
static ALWAYS_INLINE void row_times(const struct multigrid_level *l, int64_t i, const real *x, real *sum, const int w,
                                    const bool single)
{
    if (single) {
        if (w == 1)
            row_single_1(l, i, x, sum);
        else if (w == 2)
            row_single_2(l, i, x, sum);
        else
            row_single_3(l, i, x, sum);
        return;
    }
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const real *v = x + (int64_t)l->column[q] * w;
        for (int a = 0; a < w; a++)
            for (int c = 0; c < w; c++) sum[a] -= l->block[q * w * w + a * w + c] * v[c];
    }
}

/* Computes row i (one node) of the residual l->t = l->b - K l->x with the matrix K of level l. w: components per node;
 * single: true for the finest level, whose matrix is in single precision. Both must be compile-time constants. */
static ALWAYS_INLINE void row_residual(const struct multigrid_level *l, int64_t i, const int w, const bool single)
{
    real sum[WIDTH_MOST];
    for (int a = 0; a < w; a++) sum[a] = l->b[i * w + a];
    row_times(l, i, l->x, sum, w, single);
    for (int a = 0; a < w; a++) l->t[i * w + a] = sum[a];
}

/* Computes row i (one node of level l) of a relaxation step: d = keep d + step D^-1 (b - K x), y = x + d, with the
 * diagonal blocks D of the matrix K. zero: true if x and d are 0; w: components per node; single: true for the finest
 * level, whose matrix is in single precision. w and single must be compile-time constants. */
static ALWAYS_INLINE void row_relax(const struct multigrid_level *l, int64_t i, real keep, real step, bool zero,
                                    const int w, const bool single)
{
    real sum[WIDTH_MOST];
    for (int a = 0; a < w; a++) sum[a] = l->b[i * w + a];
    if (!zero) row_times(l, i, l->x, sum, w, single);
    for (int a = 0; a < w; a++) {
        real d = zero ? 0 : keep * l->d[i * w + a];
        for (int c = 0; c < w; c++) d += step * l->inverse[(i * w + a) * w + c] * sum[c];
        l->d[i * w + a] = d;
        l->y[i * w + a] = zero ? d : l->x[i * w + a] + d;
    }
}

/* Computes row i (one coarser node) of next->b, the load of the next coarser level: the residual l->t restricted by the
 * matrix l->up. w, m: components per node of level l and of the next level, compile-time constants. */
static ALWAYS_INLINE void row_restrict(const struct multigrid_level *l, struct multigrid_level *next, int64_t i,
                                       const int w, const int m)
{
    real sum[WIDTH_MOST] = {0};
    for (int64_t q = l->up.first[i]; q < l->up.first[i + 1]; q++) {
        const float *p = l->up.block + q * m * w;
        const real *t = l->t + (int64_t)l->up.column[q] * w;
        for (int a = 0; a < m; a++)
            for (int c = 0; c < w; c++) sum[a] += (real)p[a * w + c] * t[c];
    }
    for (int a = 0; a < m; a++) next->b[i * m + a] = sum[a];
}

/* Adds row i (one node of level l) of the prolongation of next->x, the solution of the next coarser level, to l->x: the
 * product with the matrix l->down. w, m: components per node of level l and of the next level, compile-time
 * constants. */
static ALWAYS_INLINE void row_prolong(struct multigrid_level *l, const struct multigrid_level *next, int64_t i,
                                      const int w, const int m)
{
    real sum[WIDTH_MOST] = {0};
    for (int64_t q = l->down.first[i]; q < l->down.first[i + 1]; q++) {
        const float *p = l->down.block + q * w * m;
        const real *x = next->x + (int64_t)l->down.column[q] * m;
        for (int a = 0; a < w; a++)
            for (int c = 0; c < m; c++) sum[a] += (real)p[a * m + c] * x[c];
    }
    for (int a = 0; a < w; a++) l->x[i * w + a] += sum[a];
}

#define BY_WIDTH(N, NAME, ...)                                                                                         \
    do {                                                                                                               \
        const int kind_ = l->width + (l->single ? 10 : 0);                                                             \
        if (kind_ == 11)                                                                                               \
            ROWS(N, NAME(__VA_ARGS__, 1, true));                                                                       \
        else if (kind_ == 12)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 2, true));                                                                       \
        else if (kind_ == 13)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, true));                                                                       \
        else if (kind_ == 1)                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 1, false));                                                                      \
        else if (kind_ == 3)                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 3, false));                                                                      \
        else                                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 6, false));                                                                      \
    } while (0)

void multigrid_compute_residual(struct multigrid_level *l) { BY_WIDTH(l->n, row_residual, l, i); }

void multigrid_apply_polynomial_smoother_step(struct multigrid_level *l, real previous_correction_factor,
                                              real residual_factor, bool start_from_zero)
{
    BY_WIDTH(l->n, row_relax, l, i, previous_correction_factor, residual_factor, start_from_zero);
    real *x = l->x;
    l->x = l->y, l->y = x;
}

void multigrid_restrict_residual(const struct multigrid_level *l, struct multigrid_level *coarser_level)
{
    BY_WIDTHS(coarser_level->n, row_restrict, l, coarser_level, i);
}
void multigrid_prolong_correction(struct multigrid_level *l, const struct multigrid_level *coarser_level)
{
    BY_WIDTHS(l->n, row_prolong, l, coarser_level, i);
}
