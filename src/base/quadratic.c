/* Projected Newton steps (Bertsekas 1982): the unknowns that no bound holds go to where the function is least as if
 * there were no bounds, by conjugate gradients, roughly at first; the path there is projected on the bounds, and halved
 * until the function falls. Bounds are met many at a time. */
#include "base/quadratic.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

#define ROUGH 0.1                        /* share of the gradient that the first systems leave */
#define FINER 0.01                       /* times that after a step that no bound cut off */
enum { HALVINGS = 40 };

struct factors { const real *a, *b; };
static real factors_term(const void *context, int64_t k)
{
    const struct factors *p = context;
    return p->a[k] * p->b[k];
}
static real inner(int64_t n, const real *a, const real *b)
{
    return team_sum(n, factors_term, &(struct factors){a, b});
}

/* In unknowns times `scale`. */
struct descent {
    const struct quadratic *of;
    int64_t n;
    int products;
    real *x, *low, *high, *scale, *gradient;
    real *step, *left, *direction, *image;       /* of the system; what of the gradient is left, 0 where bounds hold */
    real *next, *next_gradient, *room;
};

static void scaled_product(struct descent *d, const real *x, real *y)
{
    for (int64_t k = 0; k < d->n; k++) d->room[k] = x[k] / d->scale[k];
    d->of->product(d->of->context, d->room, y);
    for (int64_t k = 0; k < d->n; k++) y[k] /= d->scale[k];
    d->products++;
}

static void gradient_at(struct descent *d, const real *x, real *gradient)
{
    scaled_product(d, x, gradient);
    for (int64_t k = 0; k < d->n; k++) gradient[k] -= d->of->goal[k] / d->scale[k];
}

/* Does a bound hold the unknown against the gradient? */
static bool is_held(const struct descent *d, int64_t k)
{
    const bool low = d->x[k] <= d->low[k], high = d->x[k] >= d->high[k];
    return (low && d->gradient[k] >= 0) || (high && d->gradient[k] <= 0) || (low && high);
}

/* The step to the least value of the unknowns that are not held, until `share` of the gradient is left. The directions
 * are those that are free: elsewhere `left` is 0. */
static void system_solve(struct descent *d, real left2, real share, int most)
{
    const real enough = square(share) * left2;
    memset(d->step, 0, (size_t)d->n * sizeof(real));
    memcpy(d->direction, d->left, (size_t)d->n * sizeof(real));
    while (left2 > enough && d->products < most) {
        scaled_product(d, d->direction, d->image);
        const real length = left2 / inner(d->n, d->direction, d->image), before2 = left2;
        for (int64_t k = 0; k < d->n; k++) {
            d->step[k] -= length * d->direction[k];
            d->left[k] -= is_held(d, k) ? 0 : length * d->image[k];
        }
        left2 = inner(d->n, d->left, d->left);
        for (int64_t k = 0; k < d->n; k++) d->direction[k] = d->left[k] + left2 / before2 * d->direction[k];
    }
}

/* Goes as far along the step, within bounds, as the function falls; *cut: a bound cut it off. False: it never falls. */
static bool step_take(struct descent *d, bool *cut)
{
    real length = 1;
    for (int halving = 0; halving < HALVINGS; halving++, length *= 0.5) {
        real change = 0;
        *cut = halving > 0;
        for (int64_t k = 0; k < d->n; k++) {
            const real wish = d->x[k] + length * d->step[k];
            d->next[k] = fmin(fmax(wish, d->low[k]), d->high[k]);
            *cut = *cut || d->next[k] != wish;
            d->room[k] = d->next[k] - d->x[k];
        }
        memcpy(d->image, d->room, (size_t)d->n * sizeof(real));
        gradient_at(d, d->next, d->next_gradient);
        change = inner(d->n, d->image, d->gradient) + inner(d->n, d->image, d->next_gradient);
        if (!(change < 0)) continue;
        memcpy(d->x, d->next, (size_t)d->n * sizeof(real));
        memcpy(d->gradient, d->next_gradient, (size_t)d->n * sizeof(real));
        return true;
    }
    return false;
}

static void descend(struct descent *d, real close, int most)
{
    real share = ROUGH, first2 = -1;
    gradient_at(d, d->x, d->gradient);
    while (d->products < most) {
        bool cut;
        for (int64_t k = 0; k < d->n; k++) d->left[k] = is_held(d, k) ? 0 : d->gradient[k];
        const real left2 = inner(d->n, d->left, d->left);
        if (first2 < 0) first2 = left2;
        if (left2 <= square(close) * first2) break;
        system_solve(d, left2, fmax(share, 0.5 * close * sqrt(first2 / left2)), most);
        if (!step_take(d, &cut)) break;
        share = cut ? ROUGH : share * FINER;
    }
}

int quadratic_descend(const struct quadratic *q, real *x, real close, int products)
{
    const int64_t n = q->n;
    if (n == 0) return 0;
    real *all = NEW("quadratic.descent", 12 * n, real), *at = all;
    struct descent d = {.of = q, .n = n};
    real **const part[] = {&d.x, &d.low, &d.high, &d.scale, &d.gradient, &d.step,
                           &d.left, &d.direction, &d.image, &d.next, &d.next_gradient, &d.room};
    for (size_t k = 0; k < COUNT_OF(part); k++, at += n) *part[k] = at;
    for (int64_t k = 0; k < n; k++) {
        d.scale[k] = sqrt(q->diagonal[k]), d.x[k] = x[k] * d.scale[k];
        d.low[k] = q->low[k] * d.scale[k], d.high[k] = q->high[k] * d.scale[k];
    }
    descend(&d, close, products);
    for (int64_t k = 0; k < n; k++) x[k] = fmin(fmax(d.x[k] / d.scale[k], q->low[k]), q->high[k]);
    memory_free(all);
    return d.products;
}
