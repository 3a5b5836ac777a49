/* Representative position of several particles. If they are in separate groups, the mean of all may be outside the
 * body. */
#ifndef CLEAVE_PLACES
#define CLEAVE_PLACES

#include "base/base.h"

/* A position from which a representative position of several particles is computed. X: reference position of a particle
 * [m]; beside: true if the particle only connects others to a group and does not contribute to the representative
 * position. */
struct place {
    real X[DIM_MAX];
    bool beside;
};

/* Divides positions into groups and computes a representative position of one group. Two positions are in one group if
 * they can be connected by a chain of positions with steps of at most `max_step` [m]. position: array of
 * `position_count` entries, of which at most the first 16384 are examined; entries with `beside` set only serve to
 * connect others. ignored_direction: unit vector with dim components, perpendicular to which steps are measured; zero:
 * steps are measured in all directions. The group used is that of the position with the largest x (of equal x the
 * largest y, then z). cluster_centre: receives the mean of the positions of this group, dim components [m]; if no
 * position of the group is within `max_step` of the mean, the position nearest to the mean instead. Returns the number
 * of groups, or 0, with `cluster_centre` unchanged, if all positions have `beside` set. */
int64_t position_clusters_count_and_centre_at_largest_x(const struct place *position, int64_t position_count, int dim,
                                                        real max_step, const real *ignored_direction,
                                                        real *cluster_centre);

#endif
