/* Warns of strength surfaces (failure criteria in stress) whose strains are averaged over a radius that is large
 * compared with the body. */
#include "engine_internal.h"

#include <math.h>

#include "scene/scene_softening.h"

/* Largest radius over which strains are averaged without a warning, divided by the shortest side of the body [1].
 * Averages of a bending strain over the depth of a beam are near 0 and delay failure. A concrete beam, 0.1 m deep,
 * bears 1.2 times the moment of bonds that only soften with a radius of half its depth, and 2.6 times with 2.2 depths
 * (eight energy-controlled load steps). */
#define RADIUS_MOST 0.5

/* Returns the shortest side [m] of the box around the particles of p that belong to body number `body` of scene s and
 * to bodies joined to it; INFINITY if there are none. */
static real shortest_side(const struct scene *s, const struct particles *p, int body)
{
    real low[DIM_MAX], high[DIM_MAX], side = INFINITY;
    if (!joined_bodies_compute_bounding_box(s, p, s->body[body].joined, low, high)) return INFINITY;
    for (int d = 0; d < p->dim; d++) side = real_min(side, high[d] - low[d] + s->spacing);
    return side;
}

void run_warn_of_strength_averaging_over_thin_bodies(const struct scene *s, const struct particles *p,
                                                     struct warnings *warnings)
{
    for (int b = 0; b < s->bodies; b++) {
        const struct material *m = &s->material[s->body[b].material];
        if (!material_has_strength_surface(m)) continue;
        const real radius = scene_strength_surface_averaging_radius(s, m), side = shortest_side(s, p, b);
        if (!(radius > RADIUS_MOST * side)) continue;
        warnings_add_if_new(warnings,
                            "material %s: its strength surface averages strains over %.3g m, but body %s is only %.3g "
                            "m thick: the mean of a bending strain is nearly 0, so the body carries too much load in "
                            "bending; use a strength_radius below %.3g m, or remove the strength surface",
                            m->name, radius, s->body[b].name, side, RADIUS_MOST * side);
    }
}
