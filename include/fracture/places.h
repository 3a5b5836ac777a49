/* Representative position of several particles. If they are in separate groups, the mean of all may be outside the
 * body. */
#ifndef CLEAVE_PLACES
#define CLEAVE_PLACES

#include "base/base.h"

/* A particle whose position counts; `beside`: it connects others to a group, without counting. */
struct place {
    real X[DIM_MAX];
    bool beside;
};

/* Divides n positions into groups: two are in one group if a chain of positions leads from one to the other, with
 * distances of at most `reach` [m] perpendicular to the direction `along` [dim] (0: in all directions). Sets *middle to
 * the mean of the counting positions of one group [dim, m], or to the nearest of them if none is within `reach` of the
 * mean. If several groups have counting positions, the group is that of the last of these by x, then y, then z. Returns
 * the number of groups, including those without counting positions, or 0 if no position counts. */
int64_t places_middle(const struct place *place, int64_t n, int dim, real reach, const real *along, real *middle);

#endif
