/* Computes exact distances and normals of polygons with sharp or round corners, and of ellipsoids. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "solid_kinds.h"

/* Returns the z component of the cross product a x b of two plane vectors. */
static real cross2(const real *a, const real *b) { return a[0] * b[1] - a[1] * b[0]; }

/* Computes the difference a - b of two vectors in the plane into to[2]. */
static void minus2(const real *a, const real *b, real to[2])
{
    to[0] = a[0] - b[0];
    to[1] = a[1] - b[1];
}

/* ---- distances --------------------------------------------------------------------------------------------------- */

/* The part of a polygon's outline that is nearest to a point so far: squared distance r2 [m^2], nearest point, and
 * outward normal of its edge or arc. at_corner: the nearest point is a corner, which has no normal. */
struct nearest {
    real r2, foot[2], normal[2];
    bool at_corner;
};

/* Updates n, the nearest point of a polygon's outline to X[2] so far, with the edge from a[2] to b[2] if this is
 * nearer. sense: 1 if the corners of the polygon are in counter-clockwise order, else -1. */
static void edge_nearest(struct nearest *n, const real *a, const real *b, real sense, const real *X)
{
    real along[2], arm[2], foot[2];
    minus2(b, a, along);
    minus2(X, a, arm);
    const real length2 = dot(along, along, 2), share = length2 > 0 ? dot(arm, along, 2) / length2 : 0;
    const real within = real_max(0, real_min(1, share));
    for (int d = 0; d < 2; d++) foot[d] = a[d] + within * along[d];
    const real across = length2 > 0 ? cross2(along, arm) / sqrt(length2) : 0;
    const real r2 = within == share && length2 > 0 ? square(across) : square(X[0] - foot[0]) + square(X[1] - foot[1]);
    if (!(r2 < n->r2)) return;
    const real length = length2 > 0 ? sqrt(length2) : 1;
    *n = (struct nearest){
        r2, {foot[0], foot[1]}, {sense * along[1] / length, -sense * along[0] / length}, within != share};
}

/* Returns true if a polygon is convex at a rounded corner. b: arc of the corner; corner[2]: position of the corner
 * before rounding; sense: 1 if the corners are in counter-clockwise order, else -1. */
static bool bend_convex(const struct bend *b, const real *corner, real sense)
{
    real in[2], out[2];
    minus2(corner, b->from, in);
    minus2(b->to, corner, out);
    return sense * cross2(in, out) > 0;
}

/* Returns true if the direction arm[2] from the centre of the arc b is between the directions of its ends, which are
 * less than half a turn apart. Returns false if the corner has no arc because its edges are collinear. */
static bool bend_contains(const struct bend *b, const real *arm)
{
    real from[2], to[2];
    minus2(b->from, b->centre, from);
    minus2(b->to, b->centre, to);
    const real turn = cross2(from, to);
    return turn != 0 && turn * cross2(from, arm) >= 0 && turn * cross2(arm, to) >= 0;
}

/* Updates n, the nearest point of the outline of polygon p to X[2] so far, with the arc that rounds corner k if this is
 * nearer. */
static void bend_nearest(struct nearest *n, const struct polygon *p, int k, const real *X)
{
    real arm[2];
    const struct bend *b = &p->bend[k];
    minus2(X, b->centre, arm);
    const real r = sqrt(dot(arm, arm, 2)), off = r - p->round;
    if (!(r > 0) || !(square(off) < n->r2) || !bend_contains(b, arm)) return;
    const real out = bend_convex(b, p->corner[k], p->sense) ? 1 : -1;
    *n = (struct nearest){square(off),
                          {b->centre[0] + arm[0] / r * p->round, b->centre[1] + arm[1] / r * p->round},
                          {out * arm[0] / r, out * arm[1] / r},
                          false};
}

/* Returns true if X[2] is between corner k of the polygon p and the arc that rounds it. Only in this region do the
 * polygons with sharp and with round corners differ. */
static bool bend_cuts(const struct polygon *p, int k, const real *X)
{
    real arm[2];
    const struct bend *b = &p->bend[k];
    minus2(X, b->centre, arm);
    if (dot(arm, arm, 2) <= square(p->round) || !bend_contains(b, arm)) return false;
    const real *corner[] = {b->from, p->corner[k], b->to};
    real first = 0;
    for (int j = 0; j < 2; j++) { /* on the inner side of both edges, i.e. towards the centre */
        real edge[2], off[2], to_centre[2];
        minus2(corner[j + 1], corner[j], edge);
        minus2(X, corner[j], off);
        minus2(b->centre, corner[j], to_centre);
        first = cross2(edge, off) * cross2(edge, to_centre);
        if (first < 0) return false;
    }
    return true;
}

/* Returns true if the ray from X[2] in the direction of +x crosses the edge from a[2] to b[2]. */
static bool edge_crossed(const real *a, const real *b, const real *X)
{
    if ((a[1] > X[1]) == (b[1] > X[1])) return false;
    return X[0] < a[0] + (X[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

real polygon_signed_distance(const struct polygon *p, const real *X, real *normal)
{
    struct nearest n = {.r2 = INFINITY};
    bool inside = false;
    for (int k = 0; k < p->n; k++) {
        const int next = (k + 1) % p->n;
        inside ^= edge_crossed(p->corner[k], p->corner[next], X);
        edge_nearest(&n, p->bend ? p->bend[k].to : p->corner[k], p->bend ? p->bend[next].from : p->corner[next],
                     p->sense, X);
    }
    for (int k = 0; k < p->n && p->bend; k++) {
        if (bend_cuts(p, k, X)) inside = !bend_convex(&p->bend[k], p->corner[k], p->sense);
        bend_nearest(&n, p, k, X);
    }
    const real r = sqrt(n.r2), sign = inside ? -1 : 1;
    memcpy(normal, n.normal, sizeof n.normal);
    for (int d = 0; d < 2 && n.at_corner && r > 0; d++) normal[d] = sign * (X[d] - n.foot[d]) / r;
    return sign * r;
}

real polygon_support_function(const struct polygon *p, const real *direction)
{
    real most = -INFINITY;
    for (int k = 0; k < p->n; k++) {
        if (!p->bend) {
            most = real_max(most, dot(p->corner[k], direction, 2));
            continue;
        }
        const struct bend *b = &p->bend[k];
        most = real_max(most, real_max(dot(b->from, direction, 2), dot(b->to, direction, 2)));
        if (bend_convex(b, p->corner[k], p->sense) && bend_contains(b, direction))
            most = real_max(most, dot(b->centre, direction, 2) + p->round * sqrt(dot(direction, direction, 2)));
    }
    return most;
}

/* ---- making ------------------------------------------------------------------------------------------------------ */

/* Returns true if the edges from a[2] to b[2] and from c[2] to d[2] have a common point. */
static bool edges_meet(const real *a, const real *b, const real *c, const real *d)
{
    real ab[2], cd[2], ac[2], ad[2], ca[2], cb[2];
    minus2(b, a, ab), minus2(d, c, cd);
    minus2(c, a, ac), minus2(d, a, ad), minus2(a, c, ca), minus2(b, c, cb);
    const real left = cross2(ab, ac), right = cross2(ab, ad), under = cross2(cd, ca), over = cross2(cd, cb);
    if (left == 0 && right == 0) {
        const int x = fabs(ab[0]) < fabs(ab[1]);
        return real_max(real_min(a[x], b[x]), real_min(c[x], d[x])) <=
               real_min(real_max(a[x], b[x]), real_max(c[x], d[x]));
    }
    return left * right <= 0 && under * over <= 0;
}

/* Checks the edges of the polygon p: adjacent edges must have a length and must not fold back on each other, others
 * must not meet. *corner: receives the corner at which the faulty edge begins. Returns the fault, or POLYGON_FINE. */
static enum polygon_fault polygon_check(const struct polygon *p, int *corner)
{
    real(*c)[2] = p->corner, one[2], two[2];
    const int n = p->n;
    for (int k = 0; k < n; k++) {
        *corner = k;
        minus2(c[(k + 1) % n], c[k], one);
        minus2(c[(k + 2) % n], c[(k + 1) % n], two);
        if (!(dot(one, one, 2) > 0)) return POLYGON_SHORT;
        *corner = (k + 1) % n;
        if (fabs(cross2(one, two)) <= 1e-12 * sqrt(dot(one, one, 2) * dot(two, two, 2)) && dot(one, two, 2) < 0)
            return POLYGON_CROSSED;
    }
    for (int k = 0; k < n; k++)
        for (int j = k + 2; j < n; j++) {
            *corner = k;
            if ((j + 1) % n != k && edges_meet(c[k], c[k + 1], c[j], c[(j + 1) % n])) return POLYGON_CROSSED;
        }
    return POLYGON_FINE;
}

/* Computes p->bend[k], the arc that rounds corner k of the polygon p. Returns the length by which the arc shortens both
 * edges at the corner [m]. The edges must not be collinear. */
static real bend_make(struct polygon *p, int k)
{
    const real *at = p->corner[k], *before = p->corner[(k + p->n - 1) % p->n], *after = p->corner[(k + 1) % p->n];
    real back[2], on[2];
    struct bend *b = &p->bend[k];
    minus2(before, at, back);
    minus2(after, at, on);
    const real l1 = sqrt(dot(back, back, 2)), l2 = sqrt(dot(on, on, 2));
    for (int d = 0; d < 2; d++) back[d] /= l1, on[d] /= l2;
    const real half = 0.5 * atan2(fabs(cross2(back, on)), dot(back, on, 2)), take = p->round / tan(half);
    const real middle[2] = {back[0] + on[0], back[1] + on[1]}, size = sqrt(dot(middle, middle, 2));
    for (int d = 0; d < 2; d++) {
        b->from[d] = at[d] + take * back[d];
        b->to[d] = at[d] + take * on[d];
        b->centre[d] = at[d] + (size > 0 ? p->round / sin(half) * middle[d] / size : 0);
    }
    return take;
}

/* Returns true if the edges at corner k of the polygon p are collinear, so that the corner cannot be rounded. */
static bool is_straight(const struct polygon *p, int k)
{
    real in[2], out[2];
    minus2(p->corner[k], p->corner[(k + p->n - 1) % p->n], in);
    minus2(p->corner[(k + 1) % p->n], p->corner[k], out);
    return fabs(cross2(in, out)) <= 1e-9 * sqrt(dot(in, in, 2) * dot(out, out, 2));
}

/* Computes the arcs of all corners of the polygon p in p->bend, which is allocated. Returns POLYGON_TIGHT if two arcs
 * overlap on an edge, and stores the corner at which this edge begins in *corner; else POLYGON_FINE. */
static enum polygon_fault bends_make(struct polygon *p, int *corner)
{
    p->bend = NEW("solids.bend", p->n, struct bend);
    real *take = NEW("solids.bend", p->n, real);
    enum polygon_fault fault = POLYGON_FINE;
    for (int k = 0; k < p->n; k++) {
        if (!is_straight(p, k))
            take[k] = bend_make(p, k);
        else
            for (int d = 0; d < 2; d++) p->bend[k].from[d] = p->bend[k].to[d] = p->bend[k].centre[d] = p->corner[k][d];
    }
    for (int k = 0; k < p->n && fault == POLYGON_FINE; k++) {
        real edge[2];
        minus2(p->corner[(k + 1) % p->n], p->corner[k], edge);
        *corner = k;
        if (take[k] + take[(k + 1) % p->n] > (1 + 1e-9) * sqrt(dot(edge, edge, 2))) fault = POLYGON_TIGHT;
    }
    memory_free(take);
    return fault;
}

enum polygon_fault polygon_check_and_compute_rounded_corners(struct polygon *p, int *faulty_corner)
{
    real twice_area = 0, size2 = 0;
    enum polygon_fault fault = polygon_check(p, faulty_corner);
    if (fault != POLYGON_FINE) return fault;
    for (int k = 0; k < p->n; k++) {
        real one[2], two[2];
        minus2(p->corner[k], p->corner[0], one);
        minus2(p->corner[(k + 1) % p->n], p->corner[0], two);
        twice_area += cross2(one, two);
        size2 = real_max(size2, dot(one, one, 2));
    }
    if (!(fabs(twice_area) > 1e-12 * size2)) return POLYGON_FLAT;
    p->sense = twice_area > 0 ? 1 : -1;
    return p->round > 0 ? bends_make(p, faulty_corner) : POLYGON_FINE;
}

/* ---- ellipsoids -------------------------------------------------------------------------------------------------- */

enum { STEPS = 200 }; /* largest number of iterations for the nearest point of an ellipsoid */

/* Returns F(t) = sum_d (e_d y_d/(t + e_d^2))^2 - 1 and its derivative in *slope. e[dim]: half axes of an ellipsoid
 * [m]; y[dim]: a point with components >= 0 [m]. At the root t of F the nearest point of the ellipsoid is x_d =
 * e_d^2 y_d/(t + e_d^2). */
static real ellipsoid_excess(const real *e, const real *y, int dim, real t, real *slope)
{
    real sum = -1;
    *slope = 0;
    for (int d = 0; d < dim; d++) {
        if (y[d] == 0) continue;
        const real below = t + square(e[d]), share = e[d] * y[d] / below;
        sum += square(share);
        *slope -= 2 * square(share) / below;
    }
    return sum;
}

/* Computes x[dim], the point of an ellipsoid's surface nearest to y[dim] >= 0: x_d = e_d^2 y_d/(t + e_d^2) with the
 * root t > -e_min^2 of F(t) = sum_d (e_d y_d/(t + e_d^2))^2 - 1. F is decreasing and convex there (Eberly 2013), so
 * that Newton's steps from the left do not pass the root. If y is on the plane normal to the shortest half axis,
 * there may be no root; then x is not in that plane. e[dim]: half axes [m]. */
static void ellipsoid_foot(const real *e, const real *y, int dim, real *x)
{
    int least = 0;
    real slope, t = 0;
    for (int d = 1; d < dim; d++)
        if (e[d] < e[least]) least = d;
    t = -square(e[least]);
    for (int d = 0; d < dim; d++) t = real_max(t, e[d] * y[d] - square(e[d]));
    for (int k = 0; k < STEPS; k++) {
        const real excess = ellipsoid_excess(e, y, dim, t, &slope);
        if (!(excess > 0) || !(t - excess / slope > t)) break;
        t -= excess / slope;
    }
    real rest = 1;
    for (int d = 0; d < dim; d++) {
        const real below = t + square(e[d]);
        x[d] = y[d] > 0 && below > 0 ? square(e[d]) * y[d] / below : 0;
        if (d != least) rest -= square(x[d] / e[d]);
    }
    if (t == -square(e[least])) x[least] = e[least] * sqrt(real_max(0, rest));
}

real ellipsoid_signed_distance(const struct solid *s, const real *X, int dim, real *normal)
{
    real y[DIM_MAX], x[DIM_MAX], level = 0, r2 = 0, size2 = 0;
    for (int d = 0; d < dim; d++) {
        y[d] = fabs(X[d] - s->centre[d]);
        level += square(y[d] / s->radii[d]);
    }
    ellipsoid_foot(s->radii, y, dim, x);
    for (int d = 0; d < dim; d++) {
        r2 += square(y[d] - x[d]);
        normal[d] = x[d] / square(s->radii[d]);
        size2 += square(normal[d]);
    }
    for (int d = 0; d < dim; d++) normal[d] = copysign(normal[d] / sqrt(size2), X[d] - s->centre[d]);
    return level > 1 ? sqrt(r2) : -sqrt(r2);
}
