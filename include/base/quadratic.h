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

/* Minimises from x, in place, until the projected gradient is `close` times its initial size, with at most `products`
 * products (MPRGP, Dostal & Schoeberl 2005). Equal bits on any number of threads if the product has them. Returns the
 * number of products used. */
int quadratic_minimise(const struct quadratic *q, real *x, real close, int products);

#endif
