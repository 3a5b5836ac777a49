/* Computes bounds and volumes of regions (solids that are added, subtracted or intersected), evaluates functions of
 * time and wave pulses, and tests which bonds a crack cuts. */
#include "data/region.h"

#include <math.h>

#include "base/memory.h"

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Returns the distance between the points a[dim] and b[dim] [m]. */
static real distance_to(const real *a, const real *b, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += square(a[d] - b[d]);
    return sqrt(sum);
}

/* Computes the unit vector `unit` from a[dim] to b[dim] [m] and returns the distance between both [m]. A distance of 0
 * gives the vector 0. */
static real direction(const real *a, const real *b, int dim, real unit[DIM_MAX])
{
    real length = distance_to(a, b, dim), divisor = length > 0 ? length : INFINITY;
    for (int d = 0; d < dim; d++) unit[d] = (b[d] - a[d]) / divisor;
    return length;
}

real region_support_function_bound(const struct region *r, const real *direction, int dim)
{
    real most = r->n == 0 || r->solid[0].intersect ? INFINITY : -INFINITY;
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        if (s->subtract) continue;
        const real own = solid_support_function(s, direction, dim);
        most = s->intersect ? real_min(most, own) : real_max(most, own);
    }
    return most;
}

bool region_compute_bounding_box_if_finite(const struct region *r, int dim, real lower[DIM_MAX], real upper[DIM_MAX])
{
    bool bounded = r->n > 0;
    for (int d = 0; d < dim; d++) {
        real along[DIM_MAX] = {0};
        along[d] = -1, lower[d] = -region_support_function_bound(r, along, dim);
        along[d] = 1, upper[d] = region_support_function_bound(r, along, dim);
        if (!isfinite(lower[d]) || !isfinite(upper[d])) bounded = false;
    }
    return bounded;
}

/* Returns the volume of the part of region r inside the box lower[dim] .. upper[dim] [m^dim], estimated as the share of
 * sample points that are inside. The points are a Kronecker sequence with the increments g^-1, g^-2, .., where g is the
 * root of g^(dim+1) = g + 1 (Roberts 2018). */
real region_volume_within_box(const struct region *r, int dim, const real *lower, const real *upper)
{
    static const real root[] = {0, 1.61803398874989485, 1.32471795724474602, 1.22074408460575947};
    int64_t inside = 0;
    real volume = 1, share[DIM_MAX] = {0}, effort = 0;
    for (int k = 0; k < r->n; k++) effort += solid_query_cost_relative_to_ball(&r->solid[k]);
    const int points = effort < 100 ? 1 << 18 : 1 << 16;
    for (int d = 0; d < dim; d++) share[d] = pow(root[dim], -(d + 1)), volume *= upper[d] - lower[d];
#pragma omp parallel for schedule(static) reduction(+ : inside)
    for (int k = 0; k < points; k++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < dim; d++) {
            const real at = 0.5 + (k + 1) * share[d];
            X[d] = lower[d] + (at - floor(at)) * (upper[d] - lower[d]);
        }
        inside += region_contains(r, X, dim, 0);
    }
    return volume * (real)inside / points;
}

void region_free(struct region *r)
{
    for (int k = 0; k < r->n && r->solid; k++) solid_free(&r->solid[k]);
    for (int j = 0; j < r->runs; j++) box_tree_free(&r->run[j].tree);
    memory_free(r->run);
    memory_free(r->solid);
    *r = (struct region){0};
}

/* ---- functions of time ------------------------------------------------------------------------------------------- */

/* Returns the value of the table f at time t [s]: linear between its entries, constant before the first and after
 * the last; 0 if the table is empty. */
static real table_at(const struct time_function *f, real t)
{
    int low = 0, k = f->n - 1;
    if (f->n == 0) return 0;
    if (t <= f->t[0]) return f->value[0];
    if (!(t < f->t[k])) return f->value[k];
    while (k - low > 1) {
        const int middle = low + (k - low) / 2;
        if (t < f->t[middle])
            k = middle;
        else
            low = middle;
    }
    const real share = (t - f->t[k - 1]) / (f->t[k] - f->t[k - 1]);
    return f->value[k - 1] + share * (f->value[k] - f->value[k - 1]);
}

real time_function_value(const struct time_function *f, real t)
{
    static const real pi = 3.14159265358979323846;
    bool inside = f->from <= t && t < f->until;
    real share = inside ? (t - f->from) / (f->until - f->from) : 0;
    switch (f->kind) {
    case TIME_STEP:
        return inside ? 1 : 0;
    case TIME_PULSE:
        return inside ? square(sin(pi * share)) : 0;
    case TIME_RAMP:
        return inside ? share : (t < f->from ? 0 : 1);
    case TIME_TABLE:
        return table_at(f, t);
    default:
        return 1;
    }
}

/* Returns the integral of the table f over the times 0 .. t [s times the unit of the values]. The table is linear
 * between its entries, and constant before its first and after its last entry. */
static real table_integral(const struct time_function *f, real t)
{
    real sum = 0, from = 0;
    for (int k = 0; k <= f->n && from < t; k++) {
        const real to = k < f->n ? real_min(f->t[k], t) : t;
        if (to <= from) continue;
        /* a jump is a pair of equal times: the value at the middle of a piece is its mean */
        sum += (to - from) * table_at(f, 0.5 * (from + to));
        from = to;
    }
    return sum;
}

real time_function_integral(const struct time_function *f, real t)
{
    static const real pi = 3.14159265358979323846;
    const real length = f->until - f->from;
    const real past = real_min(real_max(t - f->from, 0), length), before = real_min(real_max(-f->from, 0), length);
    switch (f->kind) {
    case TIME_STEP:
        return past - before;
    case TIME_PULSE:
        return 0.5 * (past - before) -
               length / (4 * pi) * (sin(2 * pi * past / length) - sin(2 * pi * before / length));
    case TIME_RAMP:
        return (square(past) - square(before)) / (2 * length) + real_max(t - real_max(f->until, 0), 0);
    case TIME_TABLE:
        return table_integral(f, t);
    default:
        return t;
    }
}

/* Returns the largest absolute slope of the table f [1/s] among the intervals that begin before t [s] and end after
 * 0. */
static real table_steepest(const struct time_function *f, real t)
{
    real most = 0;
    for (int k = 1; k < f->n; k++)
        if (f->t[k] > 0 && f->t[k - 1] < t)
            most = real_max(most, fabs(f->value[k] - f->value[k - 1]) / (f->t[k] - f->t[k - 1]));
    return most;
}

real time_function_largest_slope_until(const struct time_function *f, real t_end)
{
    static const real pi = 3.14159265358979323846;
    const bool meets = f->from < t_end && f->until > 0;
    switch (f->kind) {
    case TIME_STEP:
        return (f->from > 0 && f->from <= t_end) || (f->until > 0 && f->until <= t_end) ? INFINITY : 0;
    case TIME_PULSE:
        return meets ? pi / (f->until - f->from) : 0;
    case TIME_RAMP:
        return meets ? 1 / (f->until - f->from) : 0;
    case TIME_TABLE:
        return table_steepest(f, t_end);
    default:
        return 0;
    }
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Tolerance for touching a crack, relative to the size of the crack [1]. */
static const real touch = 1e-9;

/* Line (2D) or plane (3D) of a crack: its unit normal, and the length to which tolerances refer [m]. */
struct crack_plane {
    real normal[DIM_MAX], length;
};

void crack_area_vector(const struct crack *c, real area[DIM_MAX])
{
    for (int d = 0; d < 3; d++) area[d] = 0;
    for (int k = 1; k + 1 < c->n; k++) {
        real u[DIM_MAX], w[DIM_MAX], twice[DIM_MAX];
        for (int d = 0; d < 3; d++) {
            u[d] = c->corner[k][d] - c->corner[0][d];
            w[d] = c->corner[k + 1][d] - c->corner[0][d];
        }
        vector_product(u, w, twice);
        for (int d = 0; d < 3; d++) area[d] += 0.5 * twice[d];
    }
}

/* Computes *plane for a polygonal crack c in 3D: the unit normal of its plane, and the length to which tolerances
 * refer, the largest distance of a corner from the first one [m]. Returns false if the crack has no area. */
static bool polygon_plane(const struct crack *c, struct crack_plane *plane)
{
    real area[DIM_MAX], zero[DIM_MAX] = {0};
    crack_area_vector(c, area);
    plane->length = 0;
    for (int k = 1; k < c->n; k++) plane->length = real_max(plane->length, distance_to(c->corner[0], c->corner[k], 3));
    return direction(zero, area, 3, plane->normal) > 0;
}

/* Computes *plane for a crack c, a point (1D), line (2D) or plane (3D): its unit normal, and the length to which
 * tolerances refer [m]. a[dim], b[dim]: end points of a bond [m], whose length is used in 1D. Returns false if the
 * crack has no extent, or fewer corners than `dim`. */
static bool crack_plane(const struct crack *c, const real *a, const real *b, int dim, struct crack_plane *plane)
{
    real along[DIM_MAX];
    if (c->n < dim) return false;
    switch (dim) {
    case 1:
        plane->normal[0] = 1;
        plane->length = fabs(b[0] - a[0]); /* a point has no length */
        return true;
    case 2:
        plane->length = direction(c->corner[0], c->corner[1], 2, along);
        plane->normal[0] = -along[1], plane->normal[1] = along[0];
        return plane->length > 0;
    default:
        return polygon_plane(c, plane);
    }
}

/* Returns true if the point P[3] of the crack's plane is inside the polygon of crack c or on its edge, up to a relative
 * tolerance of 1e-9. The polygon must be convex, since P must be on the inner side of every edge. plane: plane of the
 * crack (polygon_plane). */
static bool polygon_holds(const struct crack *c, const struct crack_plane *plane, const real *P)
{
    for (int k = 0; k < c->n; k++) {
        const real *from = c->corner[k], *to = c->corner[(k + 1) % c->n], *m = plane->normal;
        real edge[DIM_MAX], across[DIM_MAX], inward = 0;
        direction(from, to, 3, edge);
        vector_product(m, edge, across);
        for (int d = 0; d < 3; d++) inward += across[d] * (P[d] - from[d]);
        if (inward < -touch * plane->length) return false;
    }
    return true;
}

/* Returns true if the point P[2] of the crack's line is inside the segment of crack c or at one of its ends, up to a
 * relative tolerance of 1e-9. plane: line of the crack (crack_plane). */
static bool segment_holds(const struct crack *c, const struct crack_plane *plane, const real *P)
{
    real along[DIM_MAX];
    direction(c->corner[0], c->corner[1], 2, along);
    real place = (P[0] - c->corner[0][0]) * along[0] + (P[1] - c->corner[0][1]) * along[1];
    return place >= -touch * plane->length && place <= (1 + touch) * plane->length;
}

/* Returns the distance of X[dim] from the line or plane of crack c along its normal [m], negative on the other side.
 * plane: as computed by crack_plane. */
static real region_height(const struct crack *c, const struct crack_plane *plane, const real *X, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += plane->normal[d] * (X[d] - c->corner[0][d]);
    return sum;
}

/* Returns true if the bounding boxes of the crack c and of the bond from a[dim] to b[dim] [m] are apart along an axis
 * by more than 1e-3 of the sum of their edges, so that the bond cannot touch the crack. Always false in 1D. */
static bool far_apart(const struct crack *c, const real *a, const real *b, int dim)
{
    real low[DIM_MAX], high[DIM_MAX], size = 0;
    for (int d = 0; d < dim; d++) {
        low[d] = high[d] = c->corner[0][d];
        for (int k = 1; k < c->n; k++)
            low[d] = real_min(low[d], c->corner[k][d]), high[d] = real_max(high[d], c->corner[k][d]);
        size += fabs(a[d] - b[d]) + high[d] - low[d];
    }
    for (int d = 0; d < dim && dim > 1; d++)
        if (real_max(a[d], b[d]) < low[d] - 1e-3 * size || real_min(a[d], b[d]) > high[d] + 1e-3 * size) return true;
    return false;
}

bool crack_cuts_bond(const struct crack *c, const real *position, const real *other_position, int dim)
{
    struct crack_plane plane;
    int d = 0;
    if (far_apart(c, position, other_position, dim)) return false;
    while (d < dim && position[d] == other_position[d]) d++;
    if (d == dim) return false;
    if (position[d] > other_position[d]) { /* one order of the ends, so that both directions give equal bits */
        const real *other = position;
        position = other_position, other_position = other;
    }
    if (!crack_plane(c, position, other_position, dim, &plane)) return false;
    real above_a = region_height(c, &plane, position, dim), above_b = region_height(c, &plane, other_position, dim),
         snap = touch * plane.length;
    if ((above_a >= -snap) == (above_b >= -snap)) return false;
    if (dim == 1) return true;
    real share = real_min(1, real_max(0, above_a / (above_a - above_b))), P[DIM_MAX]; /* clamped to the bond */
    for (d = 0; d < dim; d++) P[d] = position[d] + share * (other_position[d] - position[d]);
    return dim == 2 ? segment_holds(c, &plane, P) : polygon_holds(c, &plane, P);
}

bool crack_may_cut_bonds_near(const struct crack *c, const real *X, real bond_length, int dim)
{
    real far = -INFINITY,
         size = 0; /* distance from the bounding box of its corners; all tolerances are below size/1e9 */
    for (int d = 0; d < dim; d++) {
        real low = INFINITY, high = -INFINITY;
        for (int k = 0; k < c->n; k++) low = real_min(low, c->corner[k][d]), high = real_max(high, c->corner[k][d]);
        far = real_max(far, real_max(low - X[d], X[d] - high));
        size = real_max(size, high - low);
    }
    const real most = bond_length * (1 + 1e-6) + 1e-6 * size;
    struct crack_plane plane;
    if (far > most) return false;
    return dim == 1 || (crack_plane(c, X, X, dim, &plane) && fabs(region_height(c, &plane, X, dim)) <= most);
}

/* ---- waves ------------------------------------------------------------------------------------------------------- */

/* Returns velocity [m/s], displacement [m] and strain [1] of the wave pulse w at X[dim] [m] at time 0. c: wave speed of
 * the material [m/s]. */
struct wave_state wave_pulse_initial_state(const struct wave_pulse *w, const real *X, real c, int dim)
{
    const real root_of_pi = 1.77245385090551602730, radius = 0.25 * w->width;
    real xi = 0;
    for (int d = 0; d < dim; d++) xi += (X[d] - w->at[d]) * w->direction[d];
    xi /= radius;
    const real velocity = w->velocity * exp(-xi * xi);
    return (struct wave_state){velocity, w->velocity / c * radius * 0.5 * root_of_pi * erfc(xi), -velocity / c};
}

real segment_distance_from_point(const real *segment_start, const real *segment_end, const real *point, int dim)
{
    real along = 0, length2 = 0, r2 = 0;
    for (int d = 0; d < dim; d++)
        along += (point[d] - segment_start[d]) * (segment_end[d] - segment_start[d]),
            length2 += square(segment_end[d] - segment_start[d]);
    along = length2 > 0 ? real_max(0, real_min(1, along / length2)) : 0;
    for (int d = 0; d < dim; d++)
        r2 += square(point[d] - segment_start[d] - along * (segment_end[d] - segment_start[d]));
    return sqrt(r2);
}
