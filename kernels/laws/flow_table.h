/* Flow law through the points of a concave curve: the least of the lines of its segments. The functions:
 * flow_linear.h. */
#ifndef CLEAVE_KERNELS_FLOW_TABLE
#define CLEAVE_KERNELS_FLOW_TABLE

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses of eight points, the least of the lines of all segments at the plastic strain a [Pa], and
 * stores the slopes of these lines in *slope [Pa]. Rate and temperature have no effect. */
static ALWAYS_INLINE lanes flow_table(const struct law *m, lanes a, lanes rate, lanes T, lanes *slope)
{
    (void)rate, (void)T;
    lanes least = m->table.start[0] + m->table.slope[0] * a;
    *slope = lanes_broadcast(m->table.slope[0]);
    for (int k = 1; k < m->table.points; k++) {
        const lanes line = m->table.start[k] + m->table.slope[k] * a;
        const lanes_mask lower = lanes_less(line, least);
        least = lanes_choose(lower, line, least);
        *slope = lanes_choose(lower, lanes_broadcast(m->table.slope[k]), *slope);
    }
    return least;
}

/* Returns the integral of the yield stress from plastic strain 0 to a [J/m^3], segment by segment. */
static ALWAYS_INLINE lanes work_table(const struct law *m, lanes a, lanes rate, lanes T)
{
    (void)rate, (void)T;
    lanes work = lanes_broadcast(0);
    for (int k = 0; k < m->table.points; k++) {
        const bool last = k + 1 == m->table.points;
        const lanes from = lanes_min(a, lanes_broadcast(m->table.strain[k]));
        const lanes to = last ? a : lanes_min(a, lanes_broadcast(m->table.strain[k + 1]));
        work += (m->table.start[k] + 0.5 * m->table.slope[k] * (from + to)) * (to - from);
    }
    return work;
}

/* Returns INFINITY: this law gives no bound of the plastic strain at which the yield stress is q. */
static ALWAYS_INLINE lanes reach_table(const struct law *m, lanes q, lanes rate, lanes T)
{
    return (void)m, (void)q, (void)rate, (void)T, lanes_broadcast(INFINITY);
}

#endif
