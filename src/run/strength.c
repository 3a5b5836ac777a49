/* Scattered strength: bounds of stresses are compared with the trigger of the weakest point of a material, the points
 * themselves with their own trigger (point_pd_conversion_stress_threshold). */
#include "run/make.h"

void conversion_stress_reduce_to_weakest_particle(struct elastic *elastic, const struct particles *p)
{
    for (int64_t i = 0; i < p->n && p->strength; i++) {
        struct elastic *m = &elastic[p->material[i]];
        m->trigger = real_min(m->trigger, point_pd_conversion_stress_threshold(m, p, i));
    }
}
