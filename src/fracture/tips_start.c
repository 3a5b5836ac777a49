/* Creates crack tips at the ends of pre-cracks inside the body, where cracks can start to grow. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "tips_parts.h"

#define AHEAD_REACH 1.2 /* range of the search for particles ahead of an end [spacings] */

/* ---- search ------------------------------------------------------------------------------------------------------ */

/* Finds the particles, mirror images included, whose reference position is within `radius` [m] of position[dim] [m].
 * The radius is reduced to the edge of the search cells if it is larger. Stores their indices in s->found, which grows
 * as needed; the caller frees it. Returns the number of these particles. */
int tip_search_find_particles_near_position(struct tip_search *s, const real *position, real radius)
{
    radius = real_min(radius, s->c->edge);
    int n = cells_list_particles_near_point(s->c, s->p, position, radius, -1, s->found, s->room);
    if (n <= s->room) return n;
    memory_free(s->found);
    s->room = 2 * n;
    s->found = NEW("tips.found", s->room, int32_t);
    return cells_list_particles_near_point(s->c, s->p, position, radius, -1, s->found, s->room);
}

/* ---- starts: the ends of pre-cracks ------------------------------------------------------------------------------ */

/* Computes the vector from the nearest point of a segment to a point. centre[dim]: middle of the segment [m];
 * half_vector[dim]: vector from the middle to one end [m]; point[dim]: the point [m]; offset[dim]: receives the vector
 * [m]. Returns the length of the vector [m]. */
real segment_distance_and_offset_to_point(const real *centre, const real *half_vector, const real *point, int dim,
                                          real *offset)
{
    real half2 = dot(half_vector, half_vector, dim), along = 0;
    for (int d = 0; d < dim; d++) offset[d] = point[d] - centre[d];
    if (half2 > 0) along = real_max(-1, real_min(1, dot(offset, half_vector, dim) / half2));
    for (int d = 0; d < dim; d++) offset[d] -= along * half_vector[d];
    return sqrt(dot(offset, offset, dim));
}

bool tips_any_started_at_precrack_end(const struct crack_tips *t, const real *end)
{
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack && arrays_equal(t->tip[k].origin, end, t->dim, sizeof *end)) return true;
    return false;
}

static int crack_edges(const struct crack *c, int dim) { return dim == 3 ? c->n : dim == 2 ? c->n - 1 : 0; }

/* Returns true if the position X[dim] [m], an end of pre-crack number `self`, is within half a spacing of another
 * pre-crack. The end is then a corner or a branch of a longer cut, from which no crack grows. crack[cracks]: pre-cracks
 * of the scene. t: has spacing and dimension. */
static bool on_another(const struct crack_tips *t, const struct crack *crack, int cracks, int self, const real *X)
{
    for (int c = 0; c < cracks; c++) {
        if (c == self) continue;
        for (int k = 0; k < crack_edges(&crack[c], t->dim); k++) {
            const real *a = crack[c].corner[k], *b = crack[c].corner[(k + 1) % crack[c].n];
            real centre[DIM_MAX], half[DIM_MAX], offset[DIM_MAX];
            for (int d = 0; d < t->dim; d++) centre[d] = 0.5 * (a[d] + b[d]), half[d] = 0.5 * (b[d] - a[d]);
            if (segment_distance_and_offset_to_point(centre, half, X, t->dim, offset) < 0.5 * t->spacing) return true;
        }
    }
    return false;
}

/* Returns the number of the body in which a crack that ends at X[dim] [m] could grow in the direction along[dim] (unit
 * vector); -1 if fewer than two particles of free motion are within AHEAD_REACH spacings of the point one spacing ahead
 * of X. t: has the spacing; s: search, whose list of found particles is overwritten. */
static int body_ahead(const struct crack_tips *t, struct tip_search *s, const real *X, const real *along)
{
    real ahead[DIM_MAX];
    for (int d = 0; d < t->dim; d++) ahead[d] = X[d] + t->spacing * along[d];
    int n = tip_search_find_particles_near_position(s, ahead, AHEAD_REACH * t->spacing), free_ones = 0, body = -1;
    for (int k = 0; k < n; k++) {
        int32_t i = s->found[k];
        if (i >= s->p->n || s->p->flag[i] & FLAG_DRIVEN) continue;
        if (free_ones++ == 0) body = s->p->body[i];
    }
    return free_ones >= 2 ? body : -1;
}

struct crack_tip *crack_tips_append_tip_without_growth(struct crack_tips *t, int body_number,
                                                       const real *start_position, const real *direction)
{
    INVARIANT(t->n < TIPS_MAX);
    struct crack_tip *tip = &t->tip[t->n++];
    *tip = (struct crack_tip){.body = body_number,
                              .number = ++t->begun,
                              .first_time = NAN,
                              .start_time = NAN,
                              .arrest_time = NAN,
                              .speed_max = NAN,
                              .speed_mean = NAN};
    array_copy(tip->origin, start_position, t->dim, sizeof *start_position);
    array_copy(tip->place, start_position, t->dim, sizeof *start_position);
    if (direction)
        array_copy(tip->along, direction, t->dim, sizeof *direction);
    else
        tip->along[0] = 1;
    return tip;
}

/* Adds a tip to t at the end `to` of a segment of pre-crack number `self`, if a body continues there and no other
 * pre-crack does. Adds none if t is full. s: search of particles; from, to: ends of the segment [m]; crack[cracks]:
 * pre-cracks of the scene. */
static void start_at_end(struct crack_tips *t, struct tip_search *s, const struct crack *crack, int cracks, int self,
                         const real *from, const real *to)
{
    real along[DIM_MAX], length = 0;
    for (int d = 0; d < t->dim; d++) along[d] = to[d] - from[d];
    length = sqrt(dot(along, along, t->dim));
    if (!(length > 0) || t->n == TIPS_MAX || on_another(t, crack, cracks, self, to)) return;
    for (int d = 0; d < t->dim; d++) along[d] /= length;
    int body = body_ahead(t, s, to, along);
    if (body >= 0) crack_tips_append_tip_without_growth(t, body, to, along)->from_crack = true;
}

/* Computes outward[3], the unit vector in the plane of polygon c perpendicular to its edge k (from corner k to the next
 * one) and away from the middle of the polygon. Returns false if the edge has no length or the polygon no area beside
 * it. */
static bool edge_outward(const struct crack *c, int k, real *outward)
{
    const real *a = c->corner[k], *b = c->corner[(k + 1) % c->n];
    real middle[DIM_MAX] = {0}, edge[DIM_MAX], length2 = 0;
    for (int m = 0; m < c->n; m++)
        for (int d = 0; d < 3; d++) middle[d] += c->corner[m][d] / c->n;
    for (int d = 0; d < 3; d++) edge[d] = b[d] - a[d], outward[d] = a[d] - middle[d];
    length2 = dot(edge, edge, 3);
    if (!(length2 > 0)) return false;
    real share = dot(outward, edge, 3) / length2;
    for (int d = 0; d < 3; d++) outward[d] -= share * edge[d];
    real size = sqrt(dot(outward, outward, 3));
    for (int d = 0; d < 3 && size > 0; d++) outward[d] /= size;
    return size > 0;
}

/* Adds a crack front to t along the part of edge k of polygon number `self` that is inside a body, found in steps of
 * about one spacing. Adds none if no part is inside a body or t is full. s: search of particles; crack[cracks]:
 * pre-cracks of the scene. */
static void start_at_edge(struct crack_tips *t, struct tip_search *s, const struct crack *crack, int cracks, int self,
                          int k)
{
    enum { STEPS_MAX = 100000 };
    const real *a = crack[self].corner[k], *b = crack[self].corner[(k + 1) % crack[self].n];
    real edge[DIM_MAX], outward[DIM_MAX], X[DIM_MAX], first = NAN, last = NAN;
    if (t->n == TIPS_MAX || !edge_outward(&crack[self], k, outward)) return;
    for (int d = 0; d < 3; d++) edge[d] = b[d] - a[d];
    int steps = (int)real_min(STEPS_MAX, ceil(sqrt(dot(edge, edge, 3)) / t->spacing)), body = -1;
    for (int m = 0; m < steps; m++) {
        for (int d = 0; d < 3; d++) X[d] = a[d] + (m + 0.5) / steps * edge[d];
        int here = on_another(t, crack, cracks, self, X) ? -1 : body_ahead(t, s, X, outward);
        if (here < 0 || (body >= 0 && here != body)) continue;
        if (body < 0) first = (real)m / steps;
        last = (m + 1.0) / steps;
        body = here;
    }
    if (body < 0) return;
    for (int d = 0; d < 3; d++) X[d] = a[d] + 0.5 * (first + last) * edge[d];
    struct crack_tip *tip = crack_tips_append_tip_without_growth(t, body, X, outward);
    tip->from_crack = true;
    for (int d = 0; d < 3; d++) tip->edge[d] = 0.5 * (last - first) * edge[d];
}

void tips_make_at_precrack_ends(struct crack_tips *t, const struct particles *p, const struct cells *c,
                                const struct crack *precrack, int precrack_count, real spacing,
                                real speed_averaging_time)
{
    INVARIANT(spacing > 0 && speed_averaging_time >= 0);
    *t = (struct crack_tips){.dim = p->dim, .spacing = spacing, .window = speed_averaging_time, .count = p->n};
    t->label = NEW("tips.label", p->n, uint8_t);
    for (int64_t i = 0; i < p->n; i++)
        if (p->damage[i] > TIP_DAMAGE) t->label[i] = TIP_BEFORE;
    struct tip_search s = {.p = p, .c = c};
    for (int k = 0; k < precrack_count; k++)
        for (int e = 0; e < crack_edges(&precrack[k], p->dim); e++) {
            if (p->dim == 3) {
                start_at_edge(t, &s, precrack, precrack_count, k, e);
            } else {
                start_at_end(t, &s, precrack, precrack_count, k, precrack[k].corner[e + 1], precrack[k].corner[e]);
                start_at_end(t, &s, precrack, precrack_count, k, precrack[k].corner[e], precrack[k].corner[e + 1]);
            }
        }
    memory_free(s.found);
}

void tips_ignore_particles_damaged_by_precracks(struct crack_tips *t, const real *cut_fraction)
{
    for (int64_t i = 0; i < t->count; i++)
        if (cut_fraction[i] > TIP_DAMAGE) t->label[i] = TIP_BEFORE;
}
