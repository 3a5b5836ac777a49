/* The largest eigenvalue of a symmetric operator given by its product with vectors. */
#ifndef CLEAVE_EIGENVALUE
#define CLEAVE_EIGENVALUE

#include "base.h"

/* Computes y = A x for vectors of n numbers. */
typedef void matrix_product_fn(void *context, const real *x, real *y);

/* Returns the largest eigenvalue of A (n x n, symmetric), 0 if n = 0, by Lanczos' iteration (Golub & Van Loan, ch. 10)
 * from a fixed vector. Converges from below; stops when eight iterations add less than a thousandth; exact after n
 * iterations. A bounded spectrum without gaps takes 20 to 40 iterations, a third of those of the power method. context:
 * for `apply`. */
real largest_eigenvalue(int64_t n, matrix_product_fn *apply, void *context);

/* Returns the largest eigenvalue of the symmetric tridiagonal matrix with a[n] on its diagonal and b[k] between a[k]
 * and a[k + 1]; n > 0. */
real tridiagonal_largest_eigenvalue(const real *a, const real *b, int n);

#endif
