/* Flow law given by points of a concave curve of yield stress over plastic strain: the yield stress is the least value
 * of the lines through the segments of the curve. flow_linear.h describes the functions. */
#ifndef CLEAVE_KERNELS_FLOW_TABLE
#define CLEAVE_KERNELS_FLOW_TABLE

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses [Pa] of eight points by the hardening curve law->table: the least value that the lines of
 * its segments have at the plastic strain `plastic_strain` [1]. Stores the slope of that line in *slope [Pa].
 * `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_table(const struct law *law, lanes plastic_strain, lanes temperature,
                                             lanes *slope)
{
    (void)temperature;
    lanes least = law->table.start[0] + law->table.slope[0] * plastic_strain;
    *slope = lanes_broadcast(law->table.slope[0]);
    for (int k = 1; k < law->table.points; k++) {
        const lanes line = law->table.start[k] + law->table.slope[k] * plastic_strain;
        const lanes_mask lower = lanes_less(line, least);
        least = lanes_choose(lower, line, least);
        *slope = lanes_choose(lower, lanes_broadcast(law->table.slope[k]), *slope);
    }
    return least;
}

/* Returns for eight points the integral of the yield stress of the law `law` over the plastic strain from 0 to
 * `plastic_strain`, the plastic work per volume [J/m^3], segment by segment of the curve law->table. `temperature` has
 * no effect. */
static ALWAYS_INLINE lanes flow_stress_integral_table(const struct law *law, lanes plastic_strain, lanes temperature)
{
    (void)temperature;
    lanes work = lanes_broadcast(0);
    for (int k = 0; k < law->table.points; k++) {
        const bool last = k + 1 == law->table.points;
        const lanes from = lanes_min(plastic_strain, lanes_broadcast(law->table.strain[k]));
        const lanes to = last ? plastic_strain : lanes_min(plastic_strain, lanes_broadcast(law->table.strain[k + 1]));
        work += (law->table.start[k] + 0.5 * law->table.slope[k] * (from + to)) * (to - from);
    }
    return work;
}

/* Returns INFINITY for eight points, i.e. no upper bound of the plastic strain at which the yield stress is `stress`:
 * load steps (static equilibria) then start their iteration from a bound by the elastic stress. The arguments are not
 * used. */
static ALWAYS_INLINE lanes plastic_strain_bound_at_stress_table(const struct law *law, lanes stress, lanes temperature)
{
    return (void)law, (void)stress, (void)temperature, lanes_broadcast(INFINITY);
}

#endif
