/* Writes the rigid bodies of a page: their surfaces once, and their positions in each frame. */
#include <math.h>

#include "base/memory.h"
#include "film.h"
#include "rigid/rigid_surface.h"

/* Returns the number of rigid bodies that the page of film shows: none in one dimension or without the scene. */
static int rigids_of(const struct run_animation *animation)
{
    return animation->scene && animation->dim > 1 ? animation->scene->rigids : 0;
}

/* Computes the bounding box of the particles in the first output frame of film f. low[dim], high[dim]: receive its
 * lower and upper corner [m]. */
static void particles_box(const struct run_animation *animation, real *low, real *high)
{
    const struct animation_particle_set *s = &animation->set[0];
    for (int d = 0; d < animation->dim; d++) {
        low[d] = INFINITY, high[d] = -INFINITY;
        for (int64_t i = 0; i < s->n; i++) low[d] = fmin(low[d], s->X[d][i]), high[d] = fmax(high[d], s->X[d][i]);
    }
}

/* Writes the numbers value[n] as an array to the JSON of the page p. key: name of the array; NULL if the array is an
 * element of a list and has no name. */
static void write_vector(struct html_page *p, const char *key, const real *value, int n)
{
    json_begin_object_or_list(&p->json, key, '[');
    for (int k = 0; k < n; k++) json_write_rounded(&p->json, NULL, value[k], JSON_EXACT);
    json_end_object_or_list(&p->json, ']');
}

/* Writes a surface s in `dim` dimensions to the page p: its points [points][dim], relative to centre[dim] [m], and its
 * faces [faces][corners], indices of points, as arrays in single precision, in which the indices are exact. */
static void write_surface(struct html_page *p, const struct rigid_surface *s, const real *centre, int dim)
{
    const int64_t corners = s->faces * s->corners;
    float *X = NEW("report.X", s->points * dim, float), *corner = NEW("report.corner", corners, float);
    for (int64_t k = 0; k < s->points * dim; k++) X[k] = (float)(s->X[k / dim * DIM_MAX + k % dim] - centre[k % dim]);
    for (int64_t k = 0; k < corners; k++) corner[k] = (float)s->corner[k];
    json_write_integer(&p->json, "corners", s->corners);
    html_page_add_array(p, "X", PAGE_F32, X, s->points * dim);
    html_page_add_array(p, "corner", PAGE_F32, corner, corners);
    memory_free(X), memory_free(corner);
}

void animation_write_rigid_body_surfaces(struct html_page *p, const struct run_animation *animation)
{
    const int rigids = rigids_of(animation);
    struct rigid_placement *at = NEW("report.rigid", rigids, struct rigid_placement);
    if (rigids > 0 &&
        rigids_read_placements_of_frame(at, rigids, animation->folder, animation->frame[0].listed.number)) {
        json_begin_object_or_list(&p->json, "rigid", '[');
        for (int b = 0; b < rigids; b++) {
            const struct scene_body *body = &animation->scene->body[animation->scene->bodies + b];
            real low[DIM_MAX], high[DIM_MAX];
            struct rigid_surface surface;
            particles_box(animation, low, high);
            (void)rigid_compute_plotting_box(&body->shape, animation->dim, low, high);
            rigid_surface_approximate_by_polygons(&surface, &body->shape, animation->dim, low, high);
            json_begin_object_or_list(&p->json, NULL, '{');
            json_write_text(&p->json, "name", body->name);
            write_vector(p, "centre", at[b].centre, animation->dim);
            write_surface(p, &surface, at[b].centre, animation->dim);
            json_end_object_or_list(&p->json, '}');
            rigid_surface_free(&surface);
        }
        json_end_object_or_list(&p->json, ']');
    }
    memory_free(at);
}

void animation_write_rigid_body_motion_of_frame(struct html_page *p, const struct run_animation *animation,
                                                const struct output_frame *frame, int frame_number)
{
    const int rigids = rigids_of(animation);
    struct rigid_placement *at = NEW("report.rigid", rigids, struct rigid_placement);
    if (rigids > 0 && rigids_read_placements_of_frame(at, rigids, animation->folder, frame_number)) {
        json_begin_object_or_list(&p->json, "rigid", '[');
        for (int b = 0; b < rigids; b++) {
            json_begin_object_or_list(&p->json, NULL, '{');
            real beside[DIM_MAX];
            rigid_body_displacement_of_nearest_particle(&animation->scene->body[animation->scene->bodies + b].shape,
                                                        &at[b], frame, beside);
            write_vector(p, "x", at[b].x, animation->dim);
            write_vector(p, "beside", beside, animation->dim);
            json_begin_object_or_list(&p->json, "turn", '[');
            for (int d = 0; d < animation->dim; d++) write_vector(p, NULL, at[b].turn[d], animation->dim);
            json_end_object_or_list(&p->json, ']');
            json_end_object_or_list(&p->json, '}');
        }
        json_end_object_or_list(&p->json, ']');
    }
    memory_free(at);
}
