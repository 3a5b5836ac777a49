/* Representative position of several particles. If they are in separate groups, the mean of all may be outside the
 * body. */
#ifndef CLEAVE_PLACES
#define CLEAVE_PLACES

#include "base/base.h"

/* Reference position of a particle, X [m]. beside: true if the particle only connects others to a group and does not
 * contribute to the representative position. */
struct place {
    real X[DIM_MAX];
    bool beside;
};

/* Divides `positions` positions into groups and computes a representative position of one group. Two positions are in
 * one group if a chain of positions connects them in steps of at most `reach` [m], measured perpendicular to the unit
 * vector `along` (dim components; zero vector: in all directions). Positions with `beside` connect others, but no
 * result is computed from them. centre: receives the mean of the other positions of a group or, if none of them is
 * within `reach` of the mean, the one nearest to it (dim components [m]). If there are several groups, the one with the
 * largest x is used (of equal x the largest y, then z). Returns the number of groups, or 0, without a result, if all
 * positions have `beside`. At most the first 16384 positions are examined. */
int64_t positions_cluster_centre(const struct place *position, int64_t positions, int dim, real reach,
                                 const real *along, real *centre);

#endif
