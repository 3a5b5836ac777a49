/* Modified proportioning with reduced gradient projections (MPRGP, Dostal & Schoeberl 2005): conjugate gradients over
 * the unknowns away from bounds, until the gradient at bounds dominates; a step into a bound continues along the
 * projected gradient. */
#include "base/quadratic.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

struct pair {
    const real *a, *b;
};
static real pair_term(const void *context, int64_t k)
{
    const struct pair *p = context;
    return p->a[k] * p->b[k];
}
static real inner(int64_t n, const real *a, const real *b)
{
    return reproducible_sum(n, pair_term, &(struct pair){a, b});
}

/* State of the minimisation. x, its bounds low and high, and the other vectors [n] are in unknowns scaled by `scale`.
 * image: product of the matrix with the search direction; room: gradient, limited such that a step of length `reach`
 * against it stays within the bounds. */
struct descent {
    const struct quadratic *of;
    int64_t n;
    real *x, *low, *high, *scale;
    real *gradient, *free, *chopped, *direction, *image,
        *room;  /* chopped: gradient of unknowns that would leave their bound */
    real reach; /* safe length of a step along the gradient: 1 over the largest eigenvalue */
};

/* Computes y = H x in scaled unknowns. */
static void scaled_product(void *context, const real *x, real *y)
{
    const struct descent *d = context;
    for (int64_t k = 0; k < d->n; k++) d->room[k] = x[k] / d->scale[k];
    d->of->product(d->of->context, d->room, y);
    for (int64_t k = 0; k < d->n; k++) y[k] /= d->scale[k];
}

/* Splits the gradient into `free`, its components at unknowns away from their bounds, and `chopped`, those at unknowns
 * on a bound that a step against the gradient moves away from the bound. Stores room . free in *proportional and
 * chopped . chopped in *chopped2. */
static void gradient_split(struct descent *d, real *proportional, real *chopped2)
{
    for (int64_t k = 0; k < d->n; k++) {
        const real g = d->gradient[k];
        const bool low = d->x[k] <= d->low[k], high = d->x[k] >= d->high[k];
        d->free[k] = low || high ? 0 : g;
        d->chopped[k] = (low && !high && g < 0) || (high && !low && g > 0) ? g : 0;
        d->room[k] = g > 0 ? fmin(g, (d->x[k] - d->low[k]) / d->reach) : fmax(g, (d->x[k] - d->high[k]) / d->reach);
    }
    *proportional = inner(d->n, d->room, d->free), *chopped2 = inner(d->n, d->chopped, d->chopped);
}

/* Returns the largest length for which x - length `direction` is within all bounds; INFINITY if `direction` is 0. */
static real longest_step(const struct descent *d, const real *direction)
{
    real length = INFINITY;
    for (int64_t k = 0; k < d->n; k++)
        if (direction[k] != 0)
            length = fmin(length, (direction[k] > 0 ? d->x[k] - d->low[k] : d->x[k] - d->high[k]) / direction[k]);
    return length;
}

/* Replaces x by x - length `direction`, limited to the bounds, and updates the gradient. d->image must be the product
 * of the matrix with `direction`. */
static void step_against(struct descent *d, const real *direction, real length)
{
    for (int64_t k = 0; k < d->n; k++) {
        d->x[k] = fmin(fmax(d->x[k] - length * direction[k], d->low[k]), d->high[k]);
        d->gradient[k] -= length * d->image[k];
    }
}

/* Moves x along the free gradient, projected to the bounds. */
static void step_projected(struct descent *d)
{
    for (int64_t k = 0; k < d->n; k++)
        if (d->x[k] > d->low[k] && d->x[k] < d->high[k])
            d->x[k] = fmin(fmax(d->x[k] - d->reach * d->gradient[k], d->low[k]), d->high[k]);
    scaled_product(d, d->x, d->gradient);
    for (int64_t k = 0; k < d->n; k++) d->gradient[k] -= d->of->goal[k] / d->scale[k];
}

/* Minimises until the norm of the projected gradient is at most `close` times its first value, or until `most` products
 * with the matrix have been made. Returns the number of products. */
static int descend(struct descent *d, real close, int most)
{
    real proportional, chopped2, first = -1;
    bool restart = true;
    int products = 0;
    d->reach = 0;
    step_projected(d);
    d->reach = 1 / (1.1 * largest_eigenvalue(d->n, scaled_product, d));
    while (products < most) {
        gradient_split(d, &proportional, &chopped2);
        const real left = inner(d->n, d->free, d->free) + chopped2;
        if (first < 0) first = left;
        if (left <= square(close) * first) break;
        const bool release = chopped2 > proportional;
        if (restart && !release) memcpy(d->direction, d->free, (size_t)d->n * sizeof(real));
        const real *along = release ? d->chopped : d->direction;
        scaled_product(d, along, d->image), products++;
        const real curvature = inner(d->n, along, d->image), best = inner(d->n, d->gradient, along) / curvature;
        const real longest = longest_step(d, along);
        step_against(d, along, fmin(best, longest));
        restart = release || best > longest;
        if (best > longest && !release) step_projected(d), products++;
        if (restart) continue;
        gradient_split(d, &proportional, &chopped2);
        const real share = inner(d->n, d->free, d->image) / curvature;
        for (int64_t k = 0; k < d->n; k++) d->direction[k] = d->free[k] - share * d->direction[k];
    }
    return products;
}

int quadratic_minimise(const struct quadratic *q, real *x, real close, int products)
{
    const int64_t n = q->n;
    if (n == 0) return 0;
    real *all = NEW("quadratic.descent", 10 * n, real);
    struct descent d = {
        q,           n,           all,         all + n, all + 2 * n, all + 3 * n, all + 4 * n, all + 5 * n, all + 6 * n,
        all + 7 * n, all + 8 * n, all + 9 * n, 0};
    for (int64_t k = 0; k < n; k++) {
        d.scale[k] = sqrt(q->diagonal[k]), d.x[k] = x[k] * d.scale[k];
        d.low[k] = q->low[k] * d.scale[k], d.high[k] = q->high[k] * d.scale[k];
    }
    const int taken = descend(&d, close, products);
    for (int64_t k = 0; k < n; k++) x[k] = fmin(fmax(d.x[k] / d.scale[k], q->low[k]), q->high[k]);
    memory_free(all);
    return taken;
}
