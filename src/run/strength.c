/* Where strength scatters: bounds of stresses are compared with the trigger of the weakest point of a material, the
 * points themselves with their own (point_trigger). */
#include "run/run.h"

void strength_found(struct run *e)
{
    const struct particles *p = &e->part;
    for (int64_t i = 0; i < p->n && p->strength; i++) {
        struct elastic *m = &e->tables.elastic[p->material[i]];
        m->trigger = real_min(m->trigger, point_trigger(m, p, i));
    }
}
