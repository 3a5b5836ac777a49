/* Tips of SIF-driven cracks, whose growth direction follows from their stress-intensity factors: position, factors and
 * direction of growth.
 *
 * A tip grows in the direction of the largest hoop stress of its stress-intensity factors (Erdogan & Sih 1963;
 * crack_kink_angle_from_sif). The factors are fitted to displacements in a ring around the tip, along axes that follow
 * the direction of growth over a smoothing length. If they turned at once, the ring would still contain the kink behind
 * the tip, and the direction would oscillate (fracture/growth.h). After a kink at a pre-crack, the crack grows straight
 * until the ring contains only the new segment. */
#include <math.h>
#include <string.h>

#include "sif_cracks.h"
#include "toughness.h"

#include "base/memory.h"
#include "fracture/tip_fit.h"

#define INNER 1.0     /* inner radius of the ring of the fit [horizons] */
#define WIDTH 7.0     /* width of the ring [spacings] */
#define SMOOTHING 2.0 /* length over which the frame follows the direction of growth [spacings] */
#define KINK 0.17     /* smallest change of direction at a pre-crack that counts as a kink [rad] */
#define HOLD 8.0      /* straight growth after a kink [spacings] */
#define LEAST 6.0     /* smallest outer radius of the ring [spacings] */
#define AHEAD 1e-3    /* distance from the tip at which its own crack counts as passed [spacings] */
#define PARALLEL 1e-6 /* sine of the angle below which two segments are parallel */
#define REST 0.1      /* distance to another crack at which the tip has reached it [spacings] */
#define REACH 1.2     /* radius in which particles ahead of the tip are counted [spacings] */

enum { INCREMENT_SPACINGS = 2 }; /* length of a crack increment [spacings] */

bool sif_tip_path_end_is_on_symmetry_plane(const struct crack_tip_plane *plane, const struct sif_crack_tip *tip)
{
    real ahead[2];
    crack_tip_plane_compute_point_ahead(tip->position, plane->spacing, tip->last, ahead);
    return crack_tip_plane_segment_is_on_symmetry_plane(plane, tip->position, ahead);
}

/* ---- factors ----------------------------------------------------------------------------------------------------- */

/* Returns the material (not to be freed) of the particle of p nearest to `tip`, among the particles of the body that
 * contains the tip. cracks: SIF-driven cracks, with the materials. */
static const struct material *material_at(const struct sif_cracks *cracks, const struct particles *p,
                                          const struct sif_crack_tip *tip)
{
    int64_t nearest = 0;
    real least = INFINITY, X[2];
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != tip->body) continue;
        crack_tip_plane_project_particle(&cracks->plane, p, i, X);
        if (crack_tip_plane_point_distance(X, tip->position) < least)
            least = crack_tip_plane_point_distance(X, tip->position), nearest = i;
    }
    return &cracks->scene->material[p->material[nearest]];
}

/* Returns a list of all crack segments of `cracks` in the plane in which the tips move: the pre-cracks and the path of
 * the tips. *n: receives their number. The list refers to the stored path, which must not change while the list is
 * used. Release it with crack_segments_free. */
static struct crack *crack_segments(const struct sif_cracks *cracks, int *n)
{
    const int given = cracks->source->cracks;
    struct crack *crack = NEW("led.cracks", given + cracks->segments + 1, struct crack);
    real(*corner)[DIM_MAX] = memory_new("led.corners", 2 * (given + 1), sizeof *corner);
    for (int k = 0; k < given; k++) {
        crack_tip_plane_intersect_crack(&cracks->plane, &cracks->source->crack[k], corner + 2 * k);
        crack[k] = (struct crack){.n = 2, .corner = corner + 2 * k};
    }
    for (int64_t k = 0; k < cracks->segments; k++)
        crack[given + k] = (struct crack){.n = 2, .corner = cracks->path[k].at};
    *n = given + (int)cracks->segments;
    crack[*n].corner = corner;
    return crack;
}

/* Frees `crack`, a list of n segments that crack_segments returned. */
static void crack_segments_free(struct crack *crack, int n)
{
    memory_free(crack[n].corner);
    memory_free(crack);
}

/* Returns the elastic constants for the crack-tip fields at `tip`, a tip of l. In 2D they are those of the plane space.
 * In 3D they are those of plane stress if the fit is at a distance of half the thickness or more from the front
 * (Nakamura & Parks 1988), else those of plane strain. p: particles, which give material and thickness; radius: mean
 * radius of the ring of particles used for the fit [m]. */
static struct crack_medium medium_at(const struct sif_cracks *cracks, const struct particles *p,
                                     const struct sif_crack_tip *tip, real radius)
{
    enum space space = cracks->scene->space;
    if (p->dim == 3) {
        real ahead[2];
        crack_tip_plane_compute_point_ahead(tip->position, cracks->plane.spacing, tip->last, ahead);
        const bool thin = crack_tip_plane_body_width_along_front(&cracks->plane, p, tip->position, ahead) < 2 * radius;
        space = thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN;
    }
    return crack_medium_of_material(material_at(cracks, p, tip), space);
}

bool sif_tip_compute_intensity_factors(const struct sif_cracks *cracks, const struct particles *p,
                                       const struct sif_crack_tip *tip, bool faces_in_contact, real K[MODES])
{
    const real h = cracks->plane.spacing, inner = real_max(3 * h, INNER * cracks->source->family.horizon);
    struct tip_view view = {.inner = inner, .outer = inner + WIDTH * h, .body = tip->body};
    for (int d = 0; d < 2; d++)
        view.place[d] = tip->position[d], view.along[d] = tip->along[d], view.last[d] = tip->last[d];
    memcpy(view.axis, cracks->plane.axis, sizeof view.axis);
    view.outer = real_min(view.outer, real_max(tip->length_behind, LEAST * h));
    view.medium = medium_at(cracks, p, tip, 0.5 * (view.inner + view.outer));
    struct crack *crack = crack_segments(cracks, &view.cracks);
    view.crack = crack;
    const bool seen = crack_tip_fit_sif_to_displacements(&view, p, K);
    crack_segments_free(crack, view.cracks);
    if (sif_tip_path_end_is_on_symmetry_plane(&cracks->plane, tip)) K[MODE_II] = 0;
    if (faces_in_contact) K[MODE_I] = real_max(K[MODE_I], 0); /* the fit takes contact forces for stress */
    return seen;
}

void sif_tip_compute_growth_direction(const struct sif_cracks *cracks, const struct particles *p, bool faces_in_contact,
                                      struct sif_crack_tip *tip)
{
    if (tip->straight > AHEAD * cracks->plane.spacing ||
        !sif_tip_compute_intensity_factors(cracks, p, tip, faces_in_contact, tip->K)) {
        for (int d = 0; d < 2; d++) tip->heading[d] = tip->last[d];
        return;
    }
    const real angle = crack_kink_angle_from_sif(tip->K), c = cos(angle), s = sin(angle), *a = tip->along;
    tip->heading[0] = c * a[0] - s * a[1], tip->heading[1] = s * a[0] + c * a[1];
}

/* Returns the tip of `cracks` with the largest growth, the first of several with equal growth; NULL if none qualifies.
 * on: true to consider only tips that can grow further, false for all tips. */
static const struct sif_crack_tip *tip_longest(const struct sif_cracks *cracks, bool on)
{
    const struct sif_crack_tip *first = NULL;
    for (int k = 0; k < cracks->n; k++) {
        const struct sif_crack_tip *tip = &cracks->tip[k];
        if (!(on && tip->ended) && (!first || tip->grown > first->grown * (1 + ON_SURFACE))) first = tip;
    }
    return first;
}

void sif_leading_tip_compute_intensity_factors(const struct sif_cracks *cracks, const struct particles *p,
                                               bool faces_in_contact, real K[MODES])
{
    const struct sif_crack_tip *first = tip_longest(cracks, true);
    K[MODE_I] = K[MODE_II] = NAN;
    if (first) sif_tip_compute_intensity_factors(cracks, p, first, faces_in_contact, K);
}

void sif_leading_tip_compute_position(const struct sif_cracks *cracks, real position[DIM_MAX])
{
    const struct crack_tip_plane *plane = &cracks->plane;
    const struct sif_crack_tip *first = tip_longest(cracks, false);
    for (int d = 0; d < DIM_MAX; d++)
        position[d] = first ? first->position[0] * plane->axis[0][d] + first->position[1] * plane->axis[1][d] +
                                  plane->middle * plane->front[d]
                            : NAN;
}

/* ---- growth ------------------------------------------------------------------------------------------------------ */

/* Returns the fraction (0 to 1) of the segment from a[2] to b[2] at which crack segment c intersects it; 1 if they do
 * not intersect. a, b: points in the plane in which the tips move [m]. */
static real intersection_share(const struct crack *c, const real *a, const real *b)
{
    const real *p = c->corner[0], *q = c->corner[1];
    const real step[2] = {b[0] - a[0], b[1] - a[1]}, wall[2] = {q[0] - p[0], q[1] - p[1]};
    const real across = step[0] * wall[1] - step[1] * wall[0], gap[2] = {p[0] - a[0], p[1] - a[1]};
    const bool parallel = fabs(across) <= PARALLEL * hypot(step[0], step[1]) * hypot(wall[0], wall[1]);
    const real share = (gap[0] * wall[1] - gap[1] * wall[0]) / across,
               at = (gap[0] * step[1] - gap[1] * step[0]) / across;
    return !parallel && share >= 0 && share < 1 && at >= 0 && at <= 1 ? share : 1;
}

/* Returns true if an end of crack segment c is at most `within` [m] from `tip`: the segment is then the pre-crack or
 * the last part of the path behind the tip, which growth must not be tested against. */
static bool crack_ends_at_tip(const struct crack *c, const struct sif_crack_tip *tip, real within)
{
    return crack_tip_plane_point_distance(c->corner[0], tip->position) <= within ||
           crack_tip_plane_point_distance(c->corner[1], tip->position) <= within;
}

void sif_tip_compute_end_of_next_increment(const struct sif_cracks *l, const struct particles *p,
                                           const struct sif_crack_tip *tip, real position[2])
{
    const real h = l->plane.spacing, energy = l->scene->steps.energy;
    real from[2], to[2], growth = INCREMENT_SPACINGS * h, share = 1;
    int cracks;
    crack_tip_plane_compute_point_ahead(tip->position, AHEAD * h, tip->heading, from);
    crack_tip_plane_compute_point_ahead(tip->position, h, tip->heading, to);
    if (energy > 0)
        growth = energy / (sif_tip_toughness(l, p, tip) *
                           real_max(h, crack_tip_plane_body_width_along_front(&l->plane, p, tip->position, to)));
    struct crack *crack = crack_segments(l, &cracks);
    crack_tip_plane_compute_point_ahead(tip->position, growth, tip->heading, to);
    for (int k = 0; k < cracks; k++)
        if (!crack_ends_at_tip(&crack[k], tip, AHEAD * h))
            share = real_min(share, intersection_share(&crack[k], from, to));
    for (int d = 0; d < 2; d++) position[d] = share < 1 ? from[d] + share * (to[d] - from[d]) : to[d];
    crack_segments_free(crack, cracks);
}

real sif_tip_toughness(const struct sif_cracks *cracks, const struct particles *p, const struct sif_crack_tip *tip)
{
    return toughness_of_material(&cracks->source->family, cracks->scene->model, material_at(cracks, p, tip));
}

/* Returns true if the body of p continues ahead of `tip`: if at least n particles of the body, without those whose
 * motion is prescribed, are within REACH spacings of the point one spacing ahead of the tip. n is 2 in 2D; in 3D it is
 * 2 for each whole spacing of the width of the body along the crack front. cracks: cracks, with the plane of the tips.
 */
static bool body_continues(const struct sif_cracks *cracks, const struct particles *p, const struct sif_crack_tip *tip)
{
    const real h = cracks->plane.spacing;
    real ahead[2];
    crack_tip_plane_compute_point_ahead(tip->position, h, tip->heading, ahead);
    const real wide =
        p->dim == 2 ? 1 : crack_tip_plane_body_width_along_front(&cracks->plane, p, tip->position, ahead) / h;
    int free_ones = 0;
    for (int64_t i = 0; i < p->n_all; i++) {
        real X[2];
        crack_tip_plane_project_particle(&cracks->plane, p, i, X);
        free_ones += p->body[i] == tip->body && !(p->flag[i] & FLAG_DRIVEN) &&
                     crack_tip_plane_point_distance(X, ahead) <= REACH * h;
    }
    return wide > 0 && free_ones >= 2 * floor(wide);
}

/* Appends the segment from the position of tip number k to the point to[2] to the path of the cracks, cracks->path.
 * Coordinates are those in the plane in which the tips move [m]. */
static void sif_path_add(struct sif_cracks *cracks, int k, const real *to)
{
    GROW("led.path", cracks->path, cracks->segments + 1);
    struct path_segment *s = &cracks->path[cracks->segments++];
    const struct sif_crack_tip *tip = &cracks->tip[k];
    *s = (struct path_segment){.tip = k};
    for (int d = 0; d < 2; d++) s->at[tip->reversed][d] = tip->position[d], s->at[!tip->reversed][d] = to[d];
}

/* Turns tip->along, the x axis of the frame in which stress-intensity factors of `tip` are computed, towards the
 * direction of growth. The difference decays exponentially with the growth, over a length SMOOTHING h. At a kink of a
 * pre-crack the axis takes the direction of growth at once, and the crack then grows straight for some spacings.
 * growth: length of the present increment [m]; h: lattice spacing [m]. */
static void tip_frame_turn(struct sif_crack_tip *tip, real growth, real h)
{
    const real *a = tip->last, *b = tip->heading, share = -expm1(-growth / (SMOOTHING * h));
    const bool kink = tip->grown == 0 && fabs(atan2(a[0] * b[1] - a[1] * b[0], dot(a, b, 2))) > KINK;
    if (kink) tip->straight = HOLD * h, tip->length_behind = 0;
    const bool straight = tip->straight > 0;
    for (int d = 0; d < 2; d++) tip->along[d] += (straight ? 1 : share) * (b[d] - tip->along[d]);
    const real length = hypot(tip->along[0], tip->along[1]);
    for (int d = 0; d < 2; d++) tip->along[d] /= length;
    tip->straight = real_max(0, tip->straight - growth);
}

void sif_tip_move_to_end_of_increment(struct sif_cracks *cracks, const struct particles *p, int k)
{
    struct sif_crack_tip *tip = &cracks->tip[k];
    const real h = cracks->plane.spacing;
    real to[2];
    sif_tip_compute_end_of_next_increment(cracks, p, tip, to);
    const real growth = crack_tip_plane_point_distance(to, tip->position);
    sif_path_add(cracks, k, to);
    tip_frame_turn(tip, growth, h);
    for (int d = 0; d < 2; d++) tip->last[d] = tip->heading[d], tip->position[d] = to[d];
    tip->grown += growth, tip->length_behind += growth;
    sif_tip_compute_end_of_next_increment(cracks, p, tip, to);
    tip->ended = !body_continues(cracks, p, tip) || crack_tip_plane_point_distance(to, tip->position) < REST * h;
}

void sif_tips_stop_all(struct sif_cracks *cracks)
{
    for (int k = 0; k < cracks->n; k++) cracks->tip[k].ended = true;
}

void sif_cracks_free(struct sif_cracks *cracks)
{
    memory_free(cracks->path);
    memset(cracks, 0, sizeof *cracks);
}
