/* Lowers the stress at which material points convert to peridynamics to that of the weakest particle of each material,
 * if strength scatters. Bounds of stresses are compared with this value, single points with their own
 * (point_stress_threshold_for_conversion_to_pd). */
#include "run/make.h"

void conversion_stresses_set_by_weakest_particles(struct elastic *elastic, const struct particles *p)
{
    for (int64_t i = 0; i < p->n && p->strength; i++) {
        struct elastic *m = &elastic[p->material[i]];
        m->trigger = real_min(m->trigger, point_stress_threshold_for_conversion_to_pd(m, p, i));
    }
}
