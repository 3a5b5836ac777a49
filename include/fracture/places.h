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

/* Divides n positions into groups and computes a representative position of one group. Two positions are in one group
 * if a chain of positions connects them with steps of at most `reach` [m], measured perpendicular to the unit vector
 * `along` (dim components; 0 vector: in all directions). *middle receives dim components [m]: the mean of the counting
 * positions (those without `beside`) of one group, or the nearest of them if none is within `reach` of the mean. If
 * several groups have counting positions, the group is chosen that contains the last of them by x, then y, then z.
 * Returns the number of groups, including those without counting positions, or 0 if no position counts; *middle is
 * then not set. */
int64_t positions_group_middle(const struct place *place, int64_t n, int dim, real reach, const real *along,
                               real *middle);

#endif
