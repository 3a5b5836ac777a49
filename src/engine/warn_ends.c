/* Warns of supports at an end of a body that is in the middle of a cell of material points.
 *
 * Supports prescribe the motion of grid nodes. If the end of a body is an odd number of spacings from a node, it cuts a
 * cell of two spacings in half. The nodes half a cell beyond the end then have the prescribed displacement, and half a
 * cell has half of its stiffness: a bar of N spacings has the compliance of a bar of N - 1 + 4. If the nodes half a
 * cell before the end are prescribed as well, it has that of a bar of N - 1. */
#include <math.h>

#include "engine_internal.h"

#define CELL_OF_PAIRS 2.0          /* edge of the cells to which the errors refer [spacings] */
enum { LONGER = 3, SHORTER = -1 }; /* errors of the length of a body [spacings]: N - 1 + 4 and N - 1 instead of N */

/* Range of the material points of a load, and of the body to which the first of them belongs. */
struct supported {
    int body, axis;
    real low[2], high[2];  /* centres of the outermost particles along the axis: of the load, of the body [m] */
    int side;              /* -1, 1: the load acts at the lower, the upper end of the body only; 0: at none or both */
    real end, inner_nodes; /* positions along the axis: of the end; of the nodes half a cell before it [m] */
};

/* Returns true if the scene s has a plane of symmetry at the end of the body that *a describes. */
static bool mirror_at_end(const struct scene *s, const struct supported *a)
{
    bool any = false;
    for (int b = 0; b < s->boundaries; b++)
        any |= s->boundary[b].kind == BOUNDARY_MIRROR && s->boundary[b].axis == a->axis &&
               fabs(s->boundary[b].at - a->end) < 0.5 * s->spacing;
    return any;
}

/* Finds the end of a body at which the load l acts, along the axis a->axis, which the caller has set. Sets all other
 * members of *a: the body, the ranges of the driven points and of the body along the axis, the side (lower or upper
 * end), and the positions of the end and of the nodes half a cell before it. Returns false, with these members partly
 * set or invalid, if the load drives no particle, particles other than material points, more than one layer of points
 * normal to the axis, or not exactly one end of the body. s: scene, with the particle spacing; p: particles. */
static bool supported_end_find(const struct scene *s, const struct load *l, const struct particles *p,
                               struct supported *a)
{
    real low[DIM_MAX], high[DIM_MAX];
    const int d = a->axis;
    a->low[0] = INFINITY, a->high[0] = -INFINITY, a->body = l->n > 0 ? p->body[l->particle[0]] : -1;
    for (int64_t q = 0; q < l->n; q++) {
        const int32_t i = l->particle[q];
        if (!particle_is_moved_by_grid_or_mesh_nodes(p, i)) return false;
        a->low[0] = real_min(a->low[0], p->X[d][i]), a->high[0] = real_max(a->high[0], p->X[d][i]);
    }
    if (!(a->high[0] - a->low[0] < 0.5 * s->spacing)) return false;
    if (!joined_bodies_compute_bounding_box(s, p, a->body, low, high)) return false;
    a->low[1] = low[d], a->high[1] = high[d];
    const bool upper = high[d] - a->high[0] < 0.5 * s->spacing, lower = a->low[0] - low[d] < 0.5 * s->spacing;
    a->side = upper - lower;
    a->end = (upper ? a->high[0] : a->low[0]) + a->side * 0.5 * s->spacing;
    a->inner_nodes = a->end - a->side * s->spacing;
    return a->side != 0;
}

/* Returns true if the load l also drives the grid nodes half a cell before the end of the body, a->inner_nodes, because
 * they are in the region of the load. g: background grid; p: particles; s: scene. */
static bool region_has_inner_nodes(const struct scene *s, const struct load *l, const struct particles *p,
                                   const struct grid *g, const struct supported *a)
{
    bool any = false;
    for (int64_t q = 0; q < l->n && l->boundary->body < 0 && l->boundary->side == 0 && !any; q++)
        for (int c = 0; c < 1 << s->dim && !any; c++) {
            real x[DIM_MAX] = {0};
            for (int d = 0; d < s->dim; d++)
                x[d] = g->anchor[d] + g->h * (floor((p->X[d][l->particle[q]] - g->anchor[d]) / g->h) + (c >> d & 1));
            x[a->axis] = a->inner_nodes;
            any = region_contains(&l->boundary->region, x, s->dim, LOADS_TOLERANCE * s->spacing);
        }
    return any;
}

/* Adds a warning to *to about the support `boundary` of the body named `body`, at the end a: the body behaves as if its
 * length were `length` + `off` [spacings] instead of `length`. The warning states the resulting errors of the
 * stiffness, which varies as 1/length for a bar in tension and as 1/length^3 in bending. */
static void warn_of_end(const struct supported *a, const char *boundary, const char *body, real length, int off,
                        struct warnings *to)
{
    const real tension = length / (length + off) - 1, bending = pow(length / (length + off), 3) - 1;
    const char axis = "xyz"[a->axis];
    warnings_add_if_new(
        to,
        "boundary %s: the end of body %s at %c = %.6g m is in the middle of a cell of two spacings, so the support "
        "acts as if the %.0f spacings of the body were %.0f. The stiffness is off by %+.2g %% in tension, %+.2g %% in "
        "bending; make the length from the other end (or mpm.origin) to %c = %.6g m an even number of spacings",
        boundary, body, axis, a->end, length, length + off, 100 * tension, 100 * bending, axis, a->end);
}

void run_warn_of_supports_between_grid_nodes(const struct scene *s, const struct loads *loads,
                                             const struct particles *p, const struct grid *grid,
                                             struct warnings *warnings)
{
    for (int b = 0; b < loads->n && s->method != METHOD_PD && s->cell == CELL_OF_PAIRS; b++)
        for (int d = 0; d < s->dim; d++) {
            const struct load *l = &loads->load[b];
            struct supported a = {.axis = d};
            if (l->boundary->kind != BOUNDARY_VELOCITY || !supported_end_find(s, l, p, &a)) continue;
            const real nodes = (a.end - grid->anchor[d]) / grid->h, length = (a.high[1] - a.low[1]) / s->spacing + 1;
            if (fabs(nodes - floor(nodes) - 0.5) > 0.01 || mirror_at_end(s, &a)) continue;
            const int off = region_has_inner_nodes(s, l, p, grid, &a) ? SHORTER : LONGER;
            warn_of_end(&a, l->boundary->name, s->body[a.body].name, length, off, warnings);
        }
}
