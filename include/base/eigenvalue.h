/* The largest eigenvalue of a symmetric operator given by its product with vectors. */
#ifndef CLEAVE_EIGENVALUE
#define CLEAVE_EIGENVALUE

#include "base.h"

/* Type of a function that computes y = A x for a matrix A and vectors of n numbers. context: data of the caller, which
 * describe A. */
typedef void matrix_product_fn(void *context, const real *x, real *y);

/* Returns the largest eigenvalue of a symmetric n x n matrix A, n = matrix_size, by Lanczos' iteration (Golub & Van
 * Loan, ch. 10) from a fixed vector; 0 if n = 0. multiply_by_matrix(context, x, y) computes y = A x. The estimate
 * increases towards the eigenvalue. The iteration ends when eight steps increase it by less than a thousandth, at the
 * latest after n steps; 20 to 40 steps suffice for a bounded spectrum without gaps. */
real largest_eigenvalue(int64_t matrix_size, matrix_product_fn *multiply_by_matrix, void *context);

/* Returns the largest eigenvalue of the symmetric tridiagonal matrix with diagonal[size] on its diagonal and
 * off_diagonal[k] between diagonal[k] and diagonal[k + 1]; `size` > 0. */
real tridiagonal_largest_eigenvalue(const real *diagonal, const real *off_diagonal, int size);

#endif
