/* The plane in which the tips of SIF-driven cracks (growth direction from stress-intensity factors) move: the plane of
 * a 2D body, or in 3D a plane perpendicular to the crack fronts.
 *
 * In 3D a crack front extends through the body, grows as a whole and stays straight, as in specimens of constant
 * section and through cracks of plates. Its stress-intensity factors are means along the front; mode III and the effect
 * of the free sides are neglected. Particles are projected onto the plane: a bond is cut in 3D if its projection is cut
 * in the plane, and lengths in the plane times the width of the body along the front are areas. */
#include <math.h>

#include "sif_cracks.h"

#include "base/memory.h"

#define STRAIGHT 1e-6  /* sine of the angle below which directions are parallel */
#define NUDGE 1e-6     /* offset that assigns a point on the border of two particles to one of them [spacings] */
#define ON_MIRROR 1e-3 /* distance from a plane of symmetry within which a point lies on it [spacings] */
#define RAGGED 1e-3    /* largest deviation of the edge of a pre-crack from a line along the front [spacings] */
enum { SAMPLES = 16 }; /* points of a segment at which the width is computed */

/* ---- axes -------------------------------------------------------------------------------------------------------- */

/* Scales the vector a[3] to length 1. */
static void make_unit(real *a)
{
    const real length = sqrt(dot(a, a, 3));
    for (int d = 0; d < 3; d++) a[d] /= length;
}

/* Sets the two axes of the plane in which crack tips move, which is perpendicular to plane->front, the direction of the
 * crack fronts. Coordinate axes that are perpendicular to the fronts are preferred, so that planes of symmetry are
 * perpendicular to an axis of the plane. If the front is parallel to a coordinate axis or plane up to STRAIGHT
 * (components of the unit vector), it is set exactly to that axis or plane. */
static void axes_make(struct crack_tip_plane *plane)
{
    real *f = plane->front;
    int most = 0, least = 0;
    for (int d = 1; d < 3; d++) {
        if (fabs(f[d]) > fabs(f[most])) most = d;
        if (fabs(f[d]) < fabs(f[least])) least = d;
    }
    const bool along_axis = fabs(f[(most + 1) % 3]) < STRAIGHT && fabs(f[(most + 2) % 3]) < STRAIGHT;
    for (int d = 0; d < 3 && along_axis; d++) f[d] = d == most;
    if (along_axis) least = (most + 1) % 3;
    if (!along_axis && fabs(f[least]) < STRAIGHT) f[least] = 0, make_unit(f);
    for (int d = 0; d < 3; d++) plane->axis[0][d] = (d == least) - f[least] * f[d];
    make_unit(plane->axis[0]);
    vector_product(f, plane->axis[0], plane->axis[1]);
}

void crack_tip_plane_project_point(const struct crack_tip_plane *plane, const real *point, real projection[2])
{
    for (int a = 0; a < 2; a++) projection[a] = dot(plane->axis[a], point, plane->dim);
}

void crack_tip_plane_project_particle(const struct crack_tip_plane *plane, const struct particles *p, int64_t particle,
                                      real projection[2])
{
    real X[DIM_MAX] = {0};
    particle_reference_position(p, particle, X);
    crack_tip_plane_project_point(plane, X, projection);
}

/* ---- requirements in space --------------------------------------------------------------------------------------- */

/* Stores the common direction of the fronts of all pre-cracks in t in plane->front, as a unit vector. Returns NULL, or
 * a text (not to be freed) with the reason why there is no common direction. */
static const char *front_find(const struct crack_tips *t, struct crack_tip_plane *plane)
{
    bool found = false;
    for (int k = 0; k < t->n; k++) {
        real along[DIM_MAX], turn[DIM_MAX];
        if (!t->tip[k].from_crack) continue;
        memcpy(along, t->tip[k].edge, sizeof along);
        make_unit(along);
        if (!found) memcpy(plane->front, along, sizeof along);
        vector_product(along, plane->front, turn);
        if (dot(turn, turn, 3) > square(STRAIGHT)) return "the crack fronts are not parallel";
        found = true;
    }
    return found ? NULL : "no pre-crack ends in the body";
}

/* Stores in plane->middle the coordinate, along the direction of the fronts, of the middle of the first front in t
 * [m]. */
static void front_middle(const struct crack_tips *t, struct crack_tip_plane *plane)
{
    for (int k = t->n - 1; k >= 0; k--)
        if (t->tip[k].from_crack) plane->middle = dot(plane->front, t->tip[k].origin, 3);
}

/* Lists in plane->mirror the planes of symmetry parallel to the crack fronts, each with the axis of the plane of the
 * tips to which it is perpendicular. Returns NULL, or a text (not to be freed) with the reason, if a plane of symmetry
 * is neither parallel nor perpendicular to the fronts. */
static const char *mirrors_find(struct crack_tip_plane *plane)
{
    for (int k = 0; k < plane->body_mirrors; k++) {
        struct mirror_plane m = plane->body_mirror[k];
        const int axis = m.axis;
        if (plane->dim == 3 && fabs(plane->front[axis]) > 1 - STRAIGHT) continue;
        for (m.axis = 0; m.axis < 2 && fabs(plane->axis[m.axis][axis]) < 1 - STRAIGHT;) m.axis++;
        if (m.axis == 2 || plane->mirrors == 2 * DIM_MAX)
            return "a plane of symmetry is neither parallel nor perpendicular to the crack fronts";
        if (plane->axis[m.axis][axis] < 0) m.at = -m.at, m.outside = -m.outside;
        plane->mirror[plane->mirrors++] = m;
    }
    return NULL;
}

/* Intersects the pre-crack `precrack`, a polygon, with the plane in which crack tips move, and stores the ends of the
 * common segment in segment_end[0] and segment_end[1] [m]. Their order is such that the normal of the segment points to
 * the same side as the normal of the polygon. Returns false if the pre-crack is not parallel to the crack fronts. */
bool crack_tip_plane_intersect_crack(const struct crack_tip_plane *plane, const struct crack *precrack,
                                     real segment_end[2][DIM_MAX])
{
    real area[DIM_MAX], across[2], least = INFINITY, most = -INFINITY;
    if (plane->dim == 2) return memcpy(segment_end, precrack->corner, 2 * sizeof *segment_end), true;
    crack_area_vector(precrack, area);
    crack_tip_plane_project_point(plane, area, across);
    const real size = hypot(across[0], across[1]), along[2] = {across[1] / size, -across[0] / size};
    for (int k = 0; k < precrack->n; k++) {
        real P[2];
        crack_tip_plane_project_point(plane, precrack->corner[k], P);
        const real s = dot(along, P, 2);
        for (int d = 0; d < 2 && s < least; d++) segment_end[0][d] = P[d];
        for (int d = 0; d < 2 && s > most; d++) segment_end[1][d] = P[d];
        least = real_min(least, s), most = real_max(most, s);
    }
    segment_end[0][2] = segment_end[1][2] = 0;
    return fabs(dot(area, plane->front, 3)) <= STRAIGHT * size;
}

/* Returns NULL if all pre-cracks of l are rectangles with edges along the crack fronts of `plane`, else a text (not to
 * be freed) with the reason why they are not. */
static const char *cracks_check(const struct crack_list *l, const struct crack_tip_plane *plane)
{
    for (int k = 0; k < l->n; k++) {
        real at[2][DIM_MAX] = {{0}};
        if (!crack_tip_plane_intersect_crack(plane, &l->crack[k], at))
            return "a pre-crack is not parallel to the crack fronts";
        for (int c = 0; c < l->crack[k].n; c++) {
            real P[2];
            crack_tip_plane_project_point(plane, l->crack[k].corner[c], P);
            const real off = real_min(hypot(P[0] - at[0][0], P[1] - at[0][1]), hypot(P[0] - at[1][0], P[1] - at[1][1]));
            if (off > RAGGED * plane->spacing)
                return "a pre-crack is not a rectangle with edges along the crack fronts";
        }
    }
    return NULL;
}

/* Returns NULL if all crack fronts of t run through the whole width of the body of p along plane->front, else a text
 * (not to be freed) with the reason why they do not. */
static const char *fronts_check(const struct crack_tips *t, const struct particles *p,
                                const struct crack_tip_plane *plane)
{
    const real h = plane->spacing;
    for (int k = 0; k < t->n; k++) {
        real at[2][2], along[2];
        if (!t->tip[k].from_crack) continue;
        crack_tip_plane_project_point(plane, t->tip[k].origin, at[0]);
        crack_tip_plane_project_point(plane, t->tip[k].along, along);
        crack_tip_plane_compute_point_ahead(at[0], h, along, at[1]);
        const real width = crack_tip_plane_body_width_along_front(plane, p, at[0], at[1]);
        if (width > 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, 3)) + h) return "a crack front ends inside the body";
    }
    return NULL;
}

const char *crack_tip_plane_find_or_return_reason(struct crack_tip_plane *plane, const struct crack_tips *tips,
                                                  const struct crack_list *precracks, const struct particles *p)
{
    const char *fault = NULL;
    if (plane->dim == 2) {
        plane->axis[0][0] = plane->axis[1][1] = 1;
        return mirrors_find(plane);
    }
    if (plane->dim != 3) return "space line has no crack tips";
    fault = front_find(tips, plane);
    if (!fault) axes_make(plane), front_middle(tips, plane), fault = mirrors_find(plane);
    if (!fault) fault = cracks_check(precracks, plane);
    return fault ? fault : fronts_check(tips, p, plane);
}

/* ---- areas ------------------------------------------------------------------------------------------------------- */

/* Returns the fraction of the volume of particle i of p that belongs to the modelled body [1]: 1, halved for each plane
 * of symmetry that is perpendicular to the crack front of `plane` and contains the centre of the particle. */
static real share_beside_mirrors(const struct crack_tip_plane *plane, const struct particles *p, int64_t i)
{
    real share = 1;
    for (int k = 0; k < plane->body_mirrors; k++) {
        const struct mirror_plane *m = &plane->body_mirror[k];
        const bool across = fabs(plane->front[m->axis]) > 1 - STRAIGHT;
        if (across && fabs(p->X[m->axis][i] - m->at) <= ON_SURFACE * plane->spacing) share *= 0.5;
    }
    return share;
}

/* Returns the length that the cube of particle i of p has in common with a line parallel to the crack front of `plane`
 * [m]. P[2]: point in which the line intersects the plane of the tips [m]. */
static real chord(const struct crack_tip_plane *plane, const struct particles *p, int64_t i, const real *P)
{
    const real half = 0.5 * cbrt(p->volume0[i]);
    real low = -INFINITY, high = INFINITY;
    for (int d = 0; d < 3; d++) {
        const real position = P[0] * plane->axis[0][d] + P[1] * plane->axis[1][d] + NUDGE * plane->spacing;
        const real from = p->X[d][i] - half - position, to = p->X[d][i] + half - position, f = plane->front[d];
        if (fabs(f) < STRAIGHT) {
            if (from > 0 || to <= 0) return 0;
        } else {
            low = real_max(low, real_min(from / f, to / f)), high = real_min(high, real_max(from / f, to / f));
        }
    }
    return real_max(0, high - low);
}

real crack_tip_plane_body_width_along_front(const struct crack_tip_plane *plane, const struct particles *p,
                                            const real *segment_start, const real *segment_end)
{
    const real a[DIM_MAX] = {segment_start[0], segment_start[1]}, b[DIM_MAX] = {segment_end[0], segment_end[1]};
    real sum = 0;
    if (plane->dim == 2) return plane->section;
    for (int64_t i = 0; i < p->n; i++) {
        const real position[DIM_MAX] = {p->X[0][i], p->X[1][i], p->X[2][i]};
        real X[2];
        crack_tip_plane_project_point(plane, position, X);
        if (segment_distance_from_point(a, b, X, 2) > cbrt(p->volume0[i])) continue;
        const real share = share_beside_mirrors(plane, p, i);
        for (int k = 0; k < SAMPLES; k++) {
            const real at = (k + 0.5) / SAMPLES, P[2] = {a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
            sum += share * chord(plane, p, i, P);
        }
    }
    return sum / SAMPLES;
}

bool crack_tip_plane_segment_is_on_symmetry_plane(const struct crack_tip_plane *plane, const real *segment_start,
                                                  const real *segment_end)
{
    bool on = false;
    for (int k = 0; k < plane->mirrors; k++) {
        const struct mirror_plane *m = &plane->mirror[k];
        const real tolerance = ON_MIRROR * plane->spacing;
        on |= fabs(segment_start[m->axis] - m->at) <= tolerance && fabs(segment_end[m->axis] - m->at) <= tolerance;
    }
    return on;
}

real crack_tip_plane_crack_area(const struct crack_tip_plane *plane, const struct particles *p,
                                const real *segment_start, const real *segment_end)
{
    const real length = hypot(segment_end[0] - segment_start[0], segment_end[1] - segment_start[1]);
    return length * crack_tip_plane_body_width_along_front(plane, p, segment_start, segment_end) *
           (crack_tip_plane_segment_is_on_symmetry_plane(plane, segment_start, segment_end) ? 0.5 : 1);
}
