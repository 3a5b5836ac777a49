/* Computes the largest eigenvalue of a matrix by Lanczos iterations. */
#include "base/eigenvalue.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

#define STATIONARY 1e-4 /* relative increase in the last ITERATIONS_SEEN iterations at which the iteration stops */
#define EXHAUSTED 1e-12 /* residual divided by eigenvalue below which the vectors found span an invariant space */

/* ITERATIONS_LEAST, ITERATIONS_MOST: least and largest number of iterations. ITERATIONS_SEEN: number of last iterations
 * over which the increase of the eigenvalue is measured. */
enum { ITERATIONS_LEAST = 16, ITERATIONS_MOST = 200, ITERATIONS_SEEN = 8 };

/* Three consecutive Lanczos vectors, each [n]: the previous vector `before`, the present vector v, and the next vector
 * w, under construction. */
struct lanczos {
    int64_t n;
    real *v, *before, *w;
};

/* Adds the scalar products v . w to sum[0] and w . w to sum[1], over the entries first .. end - 1 of two Lanczos
 * vectors. context: the vectors (struct lanczos: v is the present one, w the one under construction). reproducible_sums
 * calls it for each block of entries. */
static void overlap_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct lanczos *l = context;
    for (int64_t k = first; k < end; k++) {
        sum[0] += l->v[k] * l->w[k];
        sum[1] += l->w[k] * l->w[k];
    }
}

/* Starts the Lanczos iteration: sets l->v, the present vector, to a fixed pseudo-random unit vector, and l->before, the
 * previous vector, to 0. Overwrites l->w. */
static void eigenvalue_start(struct lanczos *l)
{
    uint64_t seed = 1;
    real sum[2];
    for (int64_t k = 0; k < l->n; k++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        l->w[k] = (real)(seed >> 11) * 0x1p-52 - 1;
        l->v[k] = l->before[k] = 0;
    }
    reproducible_sums(l->n, 2, overlap_block, l, sum);
    for (int64_t k = 0; k < l->n; k++) l->v[k] = l->w[k] / sqrt(sum[1]);
}

/* Computes the next Lanczos vector of the symmetric matrix A, not normalised: w = A v - (v . A v) v - last u, where v =
 * l->v is the present vector and u = l->before the previous one. Stores w in l->w and v . A v, a diagonal element of
 * the tridiagonal matrix, in *diagonal. apply(context, v, w): computes w = A v; last: length of the vector w of the
 * previous iteration. Returns the length of w. */
static real next(struct lanczos *l, matrix_product_fn *apply, void *context, real last, real *diagonal)
{
    real sum[2];
    apply(context, l->v, l->w);
    reproducible_sums(l->n, 2, overlap_block, l, sum);
    *diagonal = sum[0];
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < l->n; k++) l->w[k] -= *diagonal * l->v[k] + last * l->before[k];
    reproducible_sums(l->n, 2, overlap_block, l, sum);
    return sqrt(sum[1]);
}

/* Prepares the next Lanczos iteration: the present vector l->v becomes the previous one, and l->w, divided by its
 * length `size`, becomes the present one. */
static void eigenvalue_turn(struct lanczos *l, real size)
{
    real *spare = l->before;
    l->before = l->v, l->v = l->w, l->w = spare;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < l->n; k++) l->v[k] /= size;
}

/* Returns true if x is larger than all eigenvalues of a symmetric tridiagonal matrix with n rows, i.e. if all pivots of
 * x 1 - matrix (its Sturm sequence) are positive. a[n]: diagonal; b[n - 1]: secondary diagonal, where b[k] couples rows
 * k and k + 1. */
static bool above_all(const real *a, const real *b, int n, real x)
{
    real pivot = x - a[0];
    for (int k = 1; k < n && pivot > 0; k++) pivot = x - a[k] - b[k - 1] * (b[k - 1] / pivot);
    return pivot > 0;
}

real tridiagonal_largest_eigenvalue(const real *diagonal, const real *off_diagonal, int size)
{
    real low = diagonal[0], high = 0;
    for (int k = 0; k < size; k++) {
        low = real_max(low, diagonal[k]);
        high = real_max(high, diagonal[k] + (k > 0 ? off_diagonal[k - 1] : 0) + (k + 1 < size ? off_diagonal[k] : 0));
    }
    for (int k = 0; k < 50; k++) {
        const real middle = 0.5 * (low + high);
        if (above_all(diagonal, off_diagonal, size, middle))
            high = middle;
        else
            low = middle;
    }
    return high;
}

real largest_eigenvalue(int64_t matrix_size, matrix_product_fn *multiply_by_matrix, void *context)
{
    real a[ITERATIONS_MOST], b[ITERATIONS_MOST], found[ITERATIONS_MOST] = {0};
    const int most = matrix_size < ITERATIONS_MOST ? (int)matrix_size : ITERATIONS_MOST;
    int k = 0;
    if (matrix_size == 0) return 0;
    struct lanczos l = {matrix_size, NEW("eigenvalue.v", matrix_size, real),
                        NEW("eigenvalue.before", matrix_size, real), NEW("eigenvalue.w", matrix_size, real)};
    eigenvalue_start(&l);
    while (k < most) {
        b[k] = next(&l, multiply_by_matrix, context, k > 0 ? b[k - 1] : 0, &a[k]);
        found[k] = tridiagonal_largest_eigenvalue(a, b, k + 1);
        k++;
        if (!(b[k - 1] > EXHAUSTED * fabs(found[k - 1]))) break;
        if (k > ITERATIONS_LEAST && found[k - 1] - found[k - 1 - ITERATIONS_SEEN] <= STATIONARY * found[k - 1]) break;
        eigenvalue_turn(&l, b[k - 1]);
    }
    memory_free(l.v);
    memory_free(l.before);
    memory_free(l.w);
    return real_max(0, found[k - 1]);
}
