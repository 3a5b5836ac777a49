/* The least value of a quadratic function within bounds. */
#ifndef CLEAVE_QUADRATIC
#define CLEAVE_QUADRATIC

#include "base/eigenvalue.h"

/* x H x/2 - goal x, H symmetric and positive definite, low <= x <= high. */
struct quadratic {
    operator_fn *product; /* y = H x */
    void *context;
    int64_t n;
    const real *goal, *diagonal; /* of H, all > 0: unknowns are scaled by its roots */
    const real *low, *high;      /* equal: the unknown is fixed */
};

/* Descends from x, within bounds, until the part of the gradient that bounds do not hold is `close` times its first
 * size, with at most `products` products. The same bits on any number of threads, if those of the product are. Returns
 * the products that it took. */
int quadratic_descend(const struct quadratic *q, real *x, real close, int products);

#endif
