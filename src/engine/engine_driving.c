/* Which prescribed velocities a run bears. */
#include "engine/engine.h"

status engine_driving_check(const struct engine *e)
{
    const struct particles *p = &e->part;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        const struct boundary *c = l->boundary;
        if (c->kind != BOUNDARY_VELOCITY || c->rotates || !drives_by_place(c)) continue;
        for (int64_t k = 0; k < l->n; k++)
            if (particle_on_grid(p, l->particle[k]) && !(p->flag[l->particle[k]] & FLAG_MESHED))
                return status_at(c->place,
                                 status_set(REFUSED, "boundary %s: a velocity by x, y, z is that of reference places, "
                                            "which the grid of mpm.frame current does not know; reference, or method "
                                            "pd, is expected", c->name));
    }
    return OK;
}
