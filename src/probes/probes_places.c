/* Finds the particle nearest to the position of a probe, and the positions of the points of LINE probes. */
#include <math.h>

#include "base/memory.h"
#include "probes_parts.h"

const char *const axis_name[DIM_MAX] = {"x", "y", "z"};

/* Returns the largest distance from a particle at which a position counts as inside a body of the run o [m]: half the
 * diagonal of a lattice cell times 1.5, to allow for particles that are not on a lattice. */
static real nearest_reach(const struct observed_run *o) { return 0.75 * sqrt(o->part->dim) * o->spacing; }

int32_t probe_find_nearest_particle(const struct observed_run *o, const real *position)
{
    const struct particles *p = o->part;
    real reach = real_min(nearest_reach(o), o->cells->edge), least = INFINITY;
    int room = cells_list_particles_near_point(o->cells, p, position, reach, -1, NULL, 0);
    int32_t *found = NEW("probes.found", room, int32_t), nearest = -1;
    int n = cells_list_particles_near_point(o->cells, p, position, reach, -1, found, room);
    for (int k = 0; k < n; k++) {
        if (found[k] >= p->n) continue;
        real distance2 = 0;
        for (int d = 0; d < p->dim; d++) distance2 += square(p->X[d][found[k]] - position[d]);
        if (distance2 < least) nearest = found[k], least = distance2;
    }
    memory_free(found);
    return nearest;
}

void line_probe_compute_station_position(const struct probe *probe, int dim, int k, real *position)
{
    const struct probe_request *r = &probe->request;
    real s = r->points > 1 ? (real)k / (r->points - 1) : 0;
    for (int d = 0; d < dim; d++) position[d] = r->from[d] + s * (r->to[d] - r->from[d]);
}
