/* The largest eigenvalue of a symmetric operator, which is given by its product with vectors. */
#ifndef CLEAVE_EIGENVALUE
#define CLEAVE_EIGENVALUE

#include "base.h"

/* y = A x of vectors of n numbers. */
typedef void operator_fn(void *context, const real *x, real *y);

/* By Lanczos' iteration (Golub & Van Loan, ch. 10) from a vector that is the same on every machine: from below,
 * until eight iterations add less than a thousandth, exact after n of them. A bounded spectrum without gaps takes 20
 * to 40 iterations, where powers take three times as many. 0 if A is 0 or n is. */
real largest_eigenvalue(int64_t n, operator_fn *apply, void *context);

/* The same of the symmetric tridiagonal matrix with a[n] on its diagonal and b[k] between a[k] and a[k + 1]; n > 0. */
real largest_of_tridiagonal(const real *a, const real *b, int n);

#endif
