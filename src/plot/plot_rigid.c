/* Draws rigid bodies in maps. Their shapes are those in the scene, translated and rotated as the output frame states,
 * and are evaluated in each pixel. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"
#include "shading.h"

static const struct colour RIGID = {120, 120, 126, 255}; /* colour of rigid bodies */

/* Largest extension of the rectangle of a picture that shows rigid bodies beside the particles, divided by the longer
 * side of the rectangle [1]. */
#define BESIDE 0.3
enum { MARCH_MOST = 300 }; /* largest number of steps along the line of sight of a pixel */

struct colour rigid_body_colour(enum map map)
{
    return map == MAP_CRACKS ? colour_mixed_with_white(RIGID, GHOST) : RIGID;
}

/* Computes the initial position X[dim] [m] of the point of a rigid body that is at x[dim] [m] at present. at: present
 * translation and rotation of the body. */
static void position_at_start(const struct rigid_placement *at, int dim, const double *x, real *X)
{
    for (int a = 0; a < dim; a++) {
        X[a] = at->centre[a];
        for (int b = 0; b < dim; b++) X[a] += at->turn[b][a] * (x[b] - at->x[b]);
    }
}

void rigid_body_displacement_of_nearest_particle(const struct region *shape, const struct rigid_placement *placement,
                                                 const struct output_frame *f, real *displacement)
{
    real least = INFINITY;
    int64_t nearest = -1;
#pragma omp parallel
    {
        real own = INFINITY;
        int64_t found = -1;
#pragma omp for schedule(static)
        for (int64_t i = 0; i < f->n; i++) {
            real x[DIM_MAX], X[DIM_MAX] = {0};
            for (int d = 0; d < f->dim; d++) x[d] = f->X[d][i] + f->u[d][i];
            position_at_start(placement, f->dim, x, X);
            const real level = region_level_set_value(shape, X, f->dim);
            if (level < own) own = level, found = i;
        }
#pragma omp critical
        if (own < least || (own == least && found < nearest))
            least = own, nearest = found; /* NOLINT: other threads read it */
    }
    for (int d = 0; d < f->dim; d++) displacement[d] = nearest < 0 ? 0 : f->u[d][nearest];
}

void plotted_particles_add_placed_rigid_bodies(struct plotted_particles *plotted, const struct scene *s,
                                               const struct rigid_placement *placement, const real *low,
                                               const real *high)
{
    plotted->rigids = s->rigids, plotted->dim = s->dim;
    plotted->rigid = NEW("plot.rigid", s->rigids, struct plotted_rigid_body);
    for (int b = 0; b < s->rigids; b++) {
        struct plotted_rigid_body *r = &plotted->rigid[b];
        *r = (struct plotted_rigid_body){.shape = &s->body[s->bodies + b].shape, .at = placement[b]};
        for (int d = 0; d < s->dim; d++) r->low[d] = low[d], r->high[d] = high[d];
        r->bounded = rigid_compute_plotting_box(r->shape, s->dim, r->low, r->high);
    }
}

void plotted_particles_add_rigid_bodies(struct plotted_particles *plotted, const struct output_frame *f,
                                        const struct scene *s, const char *folder, int frame_number)
{
    if (!s || s->rigids == 0 || s->dim != f->dim || f->dim < 2) return;
    struct rigid_placement *at = NEW("plot.rigid", s->rigids, struct rigid_placement);
    real low[DIM_MAX], high[DIM_MAX];
    for (int d = 0; d < f->dim; d++) {
        low[d] = INFINITY, high[d] = -INFINITY;
        for (int64_t i = 0; i < f->n; i++) low[d] = fmin(low[d], f->X[d][i]), high[d] = fmax(high[d], f->X[d][i]);
    }
    if (rigids_read_placements_of_frame(at, s->rigids, folder, frame_number)) {
        for (int b = 0; b < s->rigids && plotted->magnify != 1; b++) {
            real beside[DIM_MAX];
            rigid_body_displacement_of_nearest_particle(&s->body[s->bodies + b].shape, &at[b], f, beside);
            for (int d = 0; d < f->dim; d++) at[b].x[d] += (plotted->magnify - 1) * beside[d];
        }
        plotted_particles_add_placed_rigid_bodies(plotted, s, at, low, high);
    }
    memory_free(at);
}

/* Returns the distance of the position x[3] [m] from the surface of the rigid body r in its present placement [m],
 * negative inside (level set). dim: dimension of the run; cut: true to cut an unbounded body to its box
 * r->low..r->high. */
static double level_at(const struct plotted_rigid_body *r, int dim, const double *x, bool cut)
{
    real X[DIM_MAX] = {0};
    position_at_start(&r->at, dim, x, X);
    double level = region_level_set_value(r->shape, X, dim);
    for (int d = 0; d < dim && cut && !r->bounded; d++) level = fmax(level, fmax(r->low[d] - X[d], X[d] - r->high[d]));
    return level;
}

/* Returns the present coordinate of corner k of the box of rigid body r along the unit vector axis[dim] [m]. Bit d of k
 * selects the upper end of the box along axis d. */
static double corner_along(const struct plotted_rigid_body *r, int dim, int k, const double *axis)
{
    double sum = 0;
    for (int a = 0; a < dim; a++) {
        double x = r->at.x[a];
        for (int b = 0; b < dim; b++) x += r->at.turn[a][b] * ((k >> b & 1 ? r->high[b] : r->low[b]) - r->at.centre[b]);
        sum += axis[a] * x;
    }
    return sum;
}

/* Returns true if the rigid body r is not in the plane of the section that `plotted` shows: its box is on one side of
 * it. */
static bool misses_section(const struct plotted_rigid_body *r, const struct plotted_particles *plotted)
{
    int below = 0, corners = 1 << plotted->dim;
    if (plotted->normal < 0) return false;
    for (int k = 0; k < corners; k++)
        below += corner_along(r, plotted->dim, k, plotted->camera.towards) <
                 plotted->layer * plotted->camera.towards[plotted->normal];
    return below == 0 || below == corners;
}

void view_extend_to_rigid_bodies(struct view *v, const struct plotted_particles *frame_particles, int frame_count)
{
    const double longest = fmax(v->to[0] - v->from[0], v->to[1] - v->from[1]);
    const double from[2] = {v->from[0], v->from[1]}, to[2] = {v->to[0], v->to[1]};
    for (const struct plotted_particles *plotted = frame_particles; plotted < frame_particles + frame_count; plotted++)
        for (int q = 0; q < plotted->rigids << plotted->dim; q++) {
            const struct plotted_rigid_body *r = &plotted->rigid[q >> plotted->dim];
            for (int a = 0; a < 2 && !misses_section(r, plotted); a++) {
                const double x = corner_along(r, plotted->dim, q % (1 << plotted->dim),
                                              a ? plotted->camera.up : plotted->camera.right);
                v->from[a] = fmin(v->from[a], fmax(x, from[a] - BESIDE * longest));
                v->to[a] = fmax(v->to[a], fmin(x, to[a] + BESIDE * longest));
            }
        }
}

/* Computes the position x[3] [m] of pixel q of a picture of size[0] x size[1] pixels that shows the rectangle of view v
 * through the camera of c. Pixels are counted row by row from the lower left corner. depth: distance of x from the
 * picture plane towards the viewer [m]. */
static void pixel_position(const struct plotted_particles *plotted, const struct view *v, const int *size, int64_t q,
                           double depth, double *x)
{
    const double a = v->from[0] + (v->to[0] - v->from[0]) * ((double)(q % size[0]) + 0.5) / size[0];
    const double b = v->from[1] + (v->to[1] - v->from[1]) * ((double)(q / size[0]) + 0.5) / size[1];
    for (int d = 0; d < 3; d++)
        x[d] = a * plotted->camera.right[d] + b * plotted->camera.up[d] + depth * plotted->camera.towards[d];
}

bool view_shows_any_rigid_body(const struct view *v, const struct plotted_particles *plotted)
{
    enum { SAMPLES = 300 };
    const int size[2] = {SAMPLES, SAMPLES};
    const double depth = plotted->normal < 0 ? 0 : plotted->layer * plotted->camera.towards[plotted->normal];
    bool visible = plotted->rigids > 0 && plotted->position[2];
    for (int b = 0; b < plotted->rigids && !visible; b++)
        for (int64_t q = 0; q < (int64_t)SAMPLES * SAMPLES && !visible; q++) {
            double x[3];
            pixel_position(plotted, v, size, q, depth, x);
            visible = level_at(&plotted->rigid[b], plotted->dim, x, false) <= 0;
        }
    return visible;
}

void image_paint_rigid_bodies_in_plane(struct colour *pixel, int width, int height, const struct view *v,
                                       const struct plotted_particles *plotted)
{
    const int size[2] = {width, height};
    const double depth = plotted->normal < 0 ? 0 : plotted->layer * plotted->camera.towards[plotted->normal];
    for (int b = 0; b < plotted->rigids; b++)
        for (int64_t q = 0; q < (int64_t)width * height; q++) {
            double x[3];
            pixel_position(plotted, v, size, q, depth, x);
            if (level_at(&plotted->rigid[b], plotted->dim, x, false) <= 0) pixel[q] = RIGID;
        }
}

/* Returns the brightness of the surface of the rigid body r at x[3] [m], a factor on its colour. It is the mean of the
 * brightnesses of the axes, weighted by the squared components of the normal, and is reduced where the surface turns
 * away from the viewer. towards[3]: direction to the viewer; step: distance for finite differences of the level set
 * [m]. */
static double brightness_at(const struct plotted_rigid_body *r, const double *x, const double *towards, double step)
{
    double normal[3], length = 0, shade = 0, facing = 0;
    for (int d = 0; d < 3; d++) {
        double near[3] = {x[0], x[1], x[2]}, far[3] = {x[0], x[1], x[2]};
        near[d] -= step, far[d] += step;
        normal[d] = level_at(r, 3, far, true) - level_at(r, 3, near, true);
        length += square(normal[d]), facing += normal[d] * towards[d];
    }
    for (int d = 0; d < 3; d++) shade += FACE_BRIGHTNESS[d] * square(normal[d]);
    return length > 0 ? (shade / length) * (0.6 + 0.4 * fmax(facing, 0) / sqrt(length)) : 1;
}

void image_paint_rigid_bodies_with_depth_test(struct colour *pixel, float *depth, int width, int height,
                                              const struct view *v, const struct plotted_particles *plotted,
                                              enum map map)
{
    const int size[2] = {width, height};
    for (int b = 0; b < plotted->rigids; b++) {
        const struct plotted_rigid_body *r = &plotted->rigid[b];
        double near = -INFINITY, far = INFINITY;
        for (int k = 0; k < 8; k++) {
            const double z = corner_along(r, 3, k, plotted->camera.towards);
            near = fmax(near, z), far = fmin(far, z);
        }
        const double small = 1e-3 * (near - far);
#pragma omp parallel for schedule(static)
        for (int64_t q = 0; q < (int64_t)width * height; q++) {
            double z = near + small, level = INFINITY, x[3];
            for (int k = 0; k < MARCH_MOST && z > fmax(far, (double)depth[q]); k++) {
                pixel_position(plotted, v, size, q, z, x);
                level = level_at(r, 3, x, true);
                if (level <= small) break;
                z -= level;
            }
            if (!(level <= small) || z <= depth[q]) continue;
            depth[q] = (float)z;
            pixel[q] = colour_mixed_with_white(
                colour_mixed_with_black(RIGID, brightness_at(r, x, plotted->camera.towards, small)),
                map == MAP_CRACKS ? GHOST : 1);
        }
    }
}
