/* Minimisation of a quadratic function within bounds. */
#ifndef CLEAVE_QUADRATIC
#define CLEAVE_QUADRATIC

#include "base/eigenvalue.h"

/* The function x H x/2 - goal x with H symmetric and positive definite, for low <= x <= high. */
struct quadratic {
    matrix_product_fn *product; /* computes y = H x */
    void *context;
    int64_t n;
    const real *goal, *diagonal; /* [n] right side; diagonal of H, all > 0, whose roots scale the unknowns */
    const real *low, *high;      /* [n] bounds; low = high: the unknown is fixed */
};

/* Minimises the function q within its bounds, starting from x[n], which is overwritten by the result (MPRGP, Dostal &
 * Schoeberl 2005). Stops when the norm of the projected gradient is at most `close` times its initial value, or after
 * about `products` products with the matrix. Returns the number of products, without those that estimate the largest
 * eigenvalue. The result is bit-identical for any number of threads if q->product is. */
int quadratic_minimise(const struct quadratic *q, real *x, real close, int products);

#endif
