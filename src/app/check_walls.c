/* Writes remarks on bodies of material points that reach a plane of symmetry after the start of the run. */
#include <math.h>

#include "check_parts.h"
#include "mesh/mesh_part.h"

#define TOUCHING 1e-3 /* largest gap between a body and a plane of symmetry that counts as contact [spacings] */

/* Returns the distance between a plane of symmetry and the face of a body on the grid at which the plane begins to stop
 * the body, although both do not touch yet [cells]. shape: shape function of the body. The values were measured with
 * cells of two spacings and a block of 40 layers that strikes the plane at a hundredth of the wave speed, by the time
 * at which its momentum changes its sign. They are the same at half the spacing. */
static real stopping_distance(enum shape shape)
{
    return shape == SHAPE_LINEAR ? 0.73 : shape == SHAPE_QUADRATIC ? 0.9 : shape == SHAPE_CUBIC ? 0.93 : 0.8;
}

/* Returns the distance between the face of body number `body` and the plane of symmetry of boundary b at the start [m];
 * INFINITY if the body has no particles in p. spacing: lattice spacing [m]. */
static real gap_at_plane(const struct particles *p, int body, const struct boundary *b, real spacing)
{
    real nearest = INFINITY;
    for (int64_t i = 0; i < p->n; i++)
        if (p->body[i] == body) nearest = real_min(nearest, fabs(p->X[b->axis][i] - b->at));
    return nearest - 0.5 * spacing;
}

void print_advice_on_gaps_to_mirror_planes(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    const real early = s->cell * stopping_distance(s->shape) * s->spacing;
    for (int b = 0; b < s->boundaries && s->method != METHOD_PD && scene_is_dynamic(s); b++)
        for (int body = 0; body < s->bodies && s->boundary[b].kind == BOUNDARY_MIRROR; body++) {
            const real gap = gap_at_plane(&run->part, body, &s->boundary[b], s->spacing);
            if (run->frame->choice[body].reference || !(gap > TOUCHING * s->spacing) || isinf(gap)) continue;
            fprintf(out,
                    "accuracy       boundary %s: body %s starts %.3g m from this plane of symmetry, which stops its "
                    "material points about %.2g m (%.2g spacings) too early; move the plane back by this distance, or "
                    "use a smaller particles.spacing\n",
                    s->boundary[b].name, s->body[body].name, gap, early, early / s->spacing);
        }
}
