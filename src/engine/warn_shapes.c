/* Warns of solids in the shape of a body that have no effect: one that is subtracted where there is nothing, one that
 * is added where the body is already. Warns of surfaces whose shells enclose a part of the body twice. */
#include <math.h>

#include "engine_internal.h"
#include "scene/shape_file.h"

enum { SOLIDS_MOST = 32, POINTS_OF_SOLID = 20000 }; /* solids of a body, points of each, that are tested */

#define AGAIN_LEAST 0.001 /* least share of a volume that is enclosed twice of which is warned */

/* Returns element k >= 1 of the van der Corput sequence with the given base (the digits of k mirrored at the radix
 * point), a value between 0 and 1. */
static real radical_inverse(int k, int base)
{
    real sum = 0, digit = 1;
    for (; k > 0; k /= base) digit /= base, sum += digit * (k % base);
    return sum;
}

/* Reduces the box low[dim] .. high[dim] [m] to the part that it has in common with the bounding box of `solid`. Returns
 * the distance between both boxes [m], 0 if they meet; if they do not, low and high are no box. */
static real boxes_common(const struct solid *solid, int dim, real *low, real *high)
{
    struct bounds box;
    real apart2 = 0;
    solid_bounding_box(solid, dim, &box);
    for (int d = 0; d < dim; d++) {
        low[d] = real_max(low[d], box.low[d]), high[d] = real_min(high[d], box.high[d]);
        apart2 += square(real_max(0, low[d] - high[d]));
    }
    return sqrt(apart2);
}

/* Returns true if one of POINTS_OF_SOLID test points is in the solid and in the region `before` (if `inside` is true),
 * or in the solid and outside that region (if false). The points are evenly distributed (Halton 1960) in the box with
 * the corners low[dim] and high[dim] [m]. */
static bool point_found(const struct solid *solid, const struct region *before, int dim, bool inside, const real *low,
                        const real *high)
{
    static const int base[DIM_MAX] = {2, 3, 5};
    for (int k = 1; k <= POINTS_OF_SOLID; k++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < dim; d++) X[d] = low[d] + (high[d] - low[d]) * radical_inverse(k, base[d]);
        if (solid_level_set_is_at_most(solid, X, dim, 0) && region_contains(before, X, dim, 0) == inside) return true;
    }
    return false;
}

/* Adds a warning to *to if solid number k, from 0, of the shape of body b, which is subtracted, removes nothing from
 * the solids before it. dim: number of dimensions. */
static void warn_of_subtracted(const struct scene_body *b, int k, int dim, struct warnings *to)
{
    const struct region before = {.n = k, .solid = b->shape.solid};
    real low[DIM_MAX], high[DIM_MAX];
    if (!region_compute_bounding_box_if_finite(&before, dim, low, high)) return;
    const real apart = boxes_common(&b->shape.solid[k], dim, low, high);
    if (apart > 0)
        warnings_add_if_new(to,
                            "body %s: solid %d of its shape removes nothing: it is %.3g m from the body; check its "
                            "units (m if none is written)",
                            b->name, k + 1, apart);
    else if (!point_found(&b->shape.solid[k], &before, dim, true, low, high))
        warnings_add_if_new(
            to, "body %s: solid %d of its shape removes nothing, because it is outside the body; check its position",
            b->name, k + 1);
}

/* Adds a warning to *to if solid number k, from 0, of the shape of body b, which is added, is completely inside the
 * solids before it. dim: number of dimensions. */
static void warn_of_added(const struct scene_body *b, int k, int dim, struct warnings *to)
{
    const struct region before = {.n = k, .solid = b->shape.solid};
    struct bounds box;
    solid_bounding_box(&b->shape.solid[k], dim, &box);
    for (int d = 0; d < dim; d++)
        if (!isfinite(box.high[d] - box.low[d])) return;
    if (!point_found(&b->shape.solid[k], &before, dim, false, box.low, box.high))
        warnings_add_if_new(to,
                            "body %s: solid %d of its shape adds nothing, because the solids before it contain it; to "
                            "cut this solid out, use subtract: {...}",
                            b->name, k + 1);
}

void run_warn_of_solids_without_effect_on_bodies(const struct scene *s, struct warnings *warnings)
{
    for (int b = 0; b < s->bodies + s->rigids; b++) {
        const struct scene_body *body = &s->body[b];
        const int solids = body->file || body->shape.n > SOLIDS_MOST ? 0 : body->shape.n;
        for (int k = 1; k < solids; k++)
            if (body->shape.solid[k].subtract)
                warn_of_subtracted(body, k, s->dim, warnings);
            else if (!body->shape.solid[k].intersect)
                warn_of_added(body, k, s->dim, warnings);
    }
}

void run_warn_of_overlapping_closed_surface_files(const struct scene *s, struct warnings *warnings)
{
    for (const struct shape_file *f = s->shapes; f; f = f->next) {
        const struct hull *h = &f->geometry.whole;
        const real again =
            f->kind != SHAPE_IMAGE && h->shells > 1 ? hull_sample_winding_number_statistics(h).enclosed_again : 0;
        if (again > AGAIN_LEAST * h->volume)
            warnings_add_if_new(
                warnings,
                "%s: about %.2g of the %.4g m^%d that its %lld shells enclose are enclosed twice but filled once, "
                "because shells overlap or are nested with all normals outwards; for a cavity turn the normals of its "
                "shell into the cavity, or put it into a file of its own and use subtract",
                printable_name(f->path[0]).text, again, h->volume, h->dim, (long long)h->shells);
    }
}
