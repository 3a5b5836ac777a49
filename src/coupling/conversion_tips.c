/* Defines the region around the ends of pre-cracks in which particles are peridynamic from the start, because cracks
 * start to grow there. Bonds in this region carry the load from the first step on, and break at the load at which they
 * break if the whole body is peridynamic. Bonds of particles that convert under load break later at a crack tip and
 * earlier at a free surface. */
#include <string.h>

#include "coupling/conversion.h"
#include "base/memory.h"

static void region_add(struct region *r, const struct solid *s)
{
    GROW("convert.region", r->solid, r->n + 1);
    r->solid[r->n++] = *s;
}

/* Returns true if X, a position at an end of pre-crack c, is inside the body: if a particle is within one spacing of X,
 * and no plane of symmetry continues the crack there. Outside the body an end is the mouth of a notch. p: particles; s:
 * cells of the neighbour search and planes of symmetry; X[dim]: position [m]. */
static bool in_body(const struct particles *p, const struct bond_source *s, const struct crack *c, const real *X)
{
    return !crack_end_is_continued_by_mirrors(s->mirror, s->mirrors, c, X, ON_SURFACE * s->family.spacing) &&
           cells_list_particles_near_point(s->cells, p, X, s->family.spacing, -1, NULL, 0) > 0;
}

/* Adds a ball of `radius` [m] around end k of pre-crack c to the region r, if this end is inside the body of the
 * particles p. In 3D adds a cylinder around the edge from corner k to the next corner instead. s: cells of the
 * neighbour search and planes of symmetry. */
static void conversion_tip_add(struct region *r, const struct particles *p, const struct bond_source *s,
                               const struct crack *c, int k, real radius)
{
    const int next = (k + 1) % c->n;
    struct solid solid = {.kind = p->dim == 3 ? SOLID_CYLINDER : SOLID_BALL, .radius = radius};
    real middle[DIM_MAX] = {0};
    for (int d = 0; d < p->dim; d++) {
        solid.centre[d] = solid.from[d] = c->corner[k][d];
        solid.to[d] = c->corner[next][d];
        middle[d] = p->dim == 3 ? 0.5 * (solid.from[d] + solid.to[d]) : solid.centre[d];
    }
    if (in_body(p, s, c, middle)) region_add(r, &solid);
}

void initial_pd_region_make(struct region *region, const struct region *scene_region, const struct particles *p,
                            const struct bond_source *source, real tip_radius)
{
    memset(region, 0, sizeof *region);
    for (int k = 0; scene_region && k < scene_region->n; k++) region_add(region, &scene_region->solid[k]);
    for (int c = 0; c < source->givens && tip_radius > 0; c++)
        for (int k = 0; k < source->given[c].n; k++)
            conversion_tip_add(region, p, source, &source->given[c], k, tip_radius);
}
