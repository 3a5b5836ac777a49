/* Computes a representative position of several particles, such as those at a crack tip. */
#include "fracture/places.h"

#include <math.h>

#include "base/memory.h"

#define EQUAL_POSITION 1e-6      /* tolerance of equal coordinates [reach] */
enum { POSITIONS_MOST = 16384 }; /* limit of the number of positions: all pairs are compared */

/* Returns true if the positions a and b are at most `reach` apart [m]. Only the distance perpendicular to the vector
 * along[dim] counts, or the whole distance if this vector is 0. */
static bool places_near(const struct place *a, const struct place *b, int dim, real reach, const real *along)
{
    real apart[DIM_MAX];
    const real along2 = dot(along, along, dim);
    for (int d = 0; d < dim; d++) apart[d] = a->X[d] - b->X[d];
    const real share = along2 > 0 ? dot(apart, along, dim) / along2 : 0;
    for (int d = 0; d < dim; d++) apart[d] -= share * along[d];
    return dot(apart, apart, dim) <= square(reach);
}

/* Returns true if position a comes after b in the order of x, then y, then z. dim: number of coordinates. Coordinates
 * that differ by at most EQUAL_POSITION * reach count as equal; reach: largest step between positions of one group
 * [m]. */
static bool comes_after(const struct place *a, const struct place *b, int dim, real reach)
{
    for (int d = 0; d < dim; d++)
        if (fabs(a->X[d] - b->X[d]) > EQUAL_POSITION * reach) return a->X[d] > b->X[d];
    return false;
}

/* Divides the positions place[n] into groups: two positions are in one group if a chain of positions connects them
 * whose steps are at most `reach` [m], measured perpendicular to the vector along[dim]. group[n]: receives the number
 * of the group of each position, from 0. Returns the number of groups. */
static int64_t groups_number(const struct place *place, int64_t n, int dim, real reach, const real *along,
                             int32_t *group)
{
    int32_t *queue = BARE("places.queue", n, int32_t);
    int64_t groups = 0;
    for (int64_t k = 0; k < n; k++) group[k] = -1;
    for (int64_t first = 0; first < n; first++) {
        int64_t queued = 0;
        if (group[first] >= 0) continue;
        queue[queued++] = (int32_t)first, group[first] = (int32_t)groups;
        for (int64_t head = 0; head < queued; head++)
            for (int64_t k = first + 1; k < n; k++)
                if (group[k] < 0 && places_near(&place[queue[head]], &place[k], dim, reach, along))
                    queue[queued++] = (int32_t)k, group[k] = (int32_t)groups;
        groups++;
    }
    memory_free(queue);
    return groups;
}

/* Computes middle[dim], the mean of those positions in group number `which` whose member `beside` is not set [m]; at
 * least one must be. If all of them are farther than `reach` [m] from the mean, as in a ring, the position nearest to
 * the mean is stored instead. place[n]: positions; group[n]: number of the group of each position. */
static void group_middle(const struct place *place, const int32_t *group, int64_t n, int32_t which, int dim, real reach,
                         real *middle)
{
    int64_t count = 0, nearest = -1;
    real least = INFINITY;
    for (int d = 0; d < dim; d++) middle[d] = 0;
    for (int64_t k = 0; k < n; k++)
        if (group[k] == which && !place[k].beside) {
            for (int d = 0; d < dim; d++) middle[d] += place[k].X[d];
            count++;
        }
    for (int d = 0; d < dim; d++) middle[d] /= (real)count;
    for (int64_t k = 0; k < n; k++) {
        real away2 = 0;
        if (group[k] != which || place[k].beside) continue;
        for (int d = 0; d < dim; d++) away2 += square(place[k].X[d] - middle[d]);
        if (away2 < least) nearest = k, least = away2;
    }
    /* a mean outside the group, as of a ring */
    if (least > square(reach)) array_copy(middle, place[nearest].X, dim, sizeof *middle);
}

int64_t position_clusters_count_and_centre_at_largest_x(const struct place *position, int64_t position_count, int dim,
                                                        real max_step, const real *ignored_direction,
                                                        real *cluster_centre)
{
    const int64_t looked = position_count < POSITIONS_MOST ? position_count : POSITIONS_MOST;
    int64_t last = -1;
    int32_t *group = BARE("places.group", looked, int32_t);
    const int64_t groups = groups_number(position, looked, dim, max_step, ignored_direction, group);
    for (int64_t k = 0; k < looked; k++)
        if (!position[k].beside && (last < 0 || comes_after(&position[k], &position[last], dim, max_step))) last = k;
    if (last >= 0) group_middle(position, group, looked, group[last], dim, max_step, cluster_centre);
    memory_free(group);
    return last >= 0 ? groups : 0;
}
