/* Places of several particles as one: where they lie apart, a mean of all of them would be no place of the body. */
#ifndef CLEAVE_PLACES
#define CLEAVE_PLACES

#include "base/base.h"

/* A particle whose place counts; `beside`: it only joins others into a group. */
struct place {
    real X[DIM_MAX];
    bool beside;
};

/* Parts n places into groups: two are of one group if a chain of places leads from one to the other, each within
 * `reach` [m] of the next, measured across the direction `along` [dim] (0: in all directions). Sets *middle to the mean
 * of the places that count of one group [dim, m], or to the nearest of them where none lies within `reach` of the mean.
 * Where several groups have places that count, it is that of the last place by x, then y, then z. Returns the number of
 * groups, with those that have places beside alone; 0 where no place counts. */
int64_t places_middle(const struct place *place, int64_t n, int dim, real reach, const real *along, real *middle);

#endif
