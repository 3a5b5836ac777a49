/* Tests whether points are in a region, and computes distances from it and normals. Evaluates the solids of the region
 * in turn; of long runs of added or subtracted solids only those near the point. */
#include <float.h>
#include <math.h>

#include "base/memory.h"
#include "data/region.h"

/* ---- index ------------------------------------------------------------------------------------------------------- */

enum { RUN_LEAST = 8 }; /* smallest number of solids for which a tree is faster */

/* Returns how many consecutive solids of the region r, from number `first` on, are all added or all subtracted. Returns
 * 1 if they are fewer than RUN_LEAST, too few for a tree of boxes to be faster, or if solid `first` is intersected. */
static int run_length(const struct region *r, int first)
{
    const struct solid *s = &r->solid[first];
    int end = first + 1;
    if (s->intersect) return 1;
    while (end < r->n && r->solid[end].subtract == s->subtract && !r->solid[end].intersect) end++;
    return end - first < RUN_LEAST ? 1 : end - first;
}

void region_build_search_trees(struct region *r, int dim)
{
    int runs = 0;
    for (int k = 0; k < r->n; k += run_length(r, k)) runs++;
    if (runs == r->n) return;
    r->run = NEW("solids.run", runs, struct region_run);
    for (int k = 0; k < r->n; k += r->run[r->runs++].count) {
        struct region_run *run = &r->run[r->runs];
        *run = (struct region_run){.first = k, .count = run_length(r, k)};
        if (run->count == 1) continue;
        struct bounds *box = NEW("solids.box", run->count, struct bounds);
        for (int j = 0; j < run->count; j++) solid_bounding_box(&r->solid[k + j], dim, &box[j]);
        box_tree_make(&run->tree, box, run->count, dim);
        memory_free(box);
    }
}

/* Returns the number of runs of the region r. A run is a sequence of consecutive solids that are all added or all
 * subtracted; in a region without search trees (region_build_search_trees) each solid is a run. */
static int region_runs(const struct region *r) { return r->run ? r->runs : r->n; }

/* Returns run number j of the region, 0 <= j < region_runs(r). A run is a sequence of consecutive solids that are all
 * added or all subtracted. */
static struct region_run region_run(const struct region *r, int j)
{
    return r->run ? r->run[j] : (struct region_run){.first = j, .count = 1};
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Returns true if at least one solid of a run has a level (<= 0 inside, solid_level_set_value) of at most `most` [m] at
 * X[dim]. A run is a sequence of solids that are all added or all subtracted; which of both makes no difference here.
 * s: first solid of the run; run: number of solids, and a tree of their boxes. */
static bool run_within(const struct solid *s, const struct region_run *run, const real *X, int dim, real most)
{
    struct box_search near;
    bool within = false;
    if (run->count == 1) return solid_level_set_is_at_most(s, X, dim, most);
    box_search_start(&near, &run->tree, X, dim);
    for (int k;
         !within && (k = box_search_find_next_box_within(&near, solid_distance_upper_bound_from_level_set(most))) >= 0;)
        within = solid_level_set_is_at_most(&s[k], X, dim, most);
    return within;
}

/* Returns the smallest level (<= 0 inside, solid_level_set_value) at X[dim] over the solids of a run, which are all
 * added or all subtracted [m]. s: first solid of the run; run: number of solids, and a tree of their boxes. */
static real run_level(const struct solid *s, const struct region_run *run, const real *X, int dim)
{
    struct box_search near;
    real nearest = INFINITY;
    if (run->count == 1) return solid_level_set_value(s, X, dim);
    box_search_start(&near, &run->tree, X, dim);
    for (int k; (k = box_search_find_next_box_within(&near, solid_distance_upper_bound_from_level_set(nearest))) >= 0;)
        nearest = real_min(nearest, solid_level_set_value(&s[k], X, dim));
    return nearest;
}

/* Returns the signed distance of X[dim] from the nearest solid of a run, whose solids are all added or all subtracted
 * [m], negative inside. normal[dim]: receives the outward normal of that solid. If several solids are equally near, the
 * first one counts. s: first solid of the run; run: number of solids, and a tree of their boxes. */
static real run_distance(const struct solid *s, const struct region_run *run, const real *X, int dim, real *normal)
{
    struct box_search near;
    real nearest = INFINITY, own[DIM_MAX];
    int first = 0;
    if (run->count == 1) return solid_signed_distance(s, X, dim, normal);
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    box_search_start(&near, &run->tree, X, dim);
    for (int k;
         (k = box_search_find_next_box_within(&near, solid_distance_upper_bound_from_level_set(nearest))) >= 0;) {
        const real distance = solid_signed_distance(&s[k], X, dim, own);
        if (!(distance < nearest || (distance == nearest && k < first))) continue;
        nearest = distance, first = k;
        for (int d = 0; d < dim; d++) normal[d] = own[d];
    }
    return nearest;
}

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Returns the largest number below x. For x = 0 it is the smallest normal number with a negative sign, because
 * processors may flush smaller numbers to 0. */
static real number_before(real x)
{
    const real before = nextafter(x, -INFINITY);
    return fabs(before) < DBL_MIN ? -DBL_MIN : before;
}

/* Returns true if X[dim] is in the region r extended by `tolerance` [m]. The surface of a subtracted solid belongs to
 * the region, and extending the region shrinks the hole: only points deeper than the tolerance in a subtracted solid
 * are outside. An empty region contains all points. */
bool region_contains(const struct region *r, const real *X, int dim, real tolerance)
{
    bool inside = r->n == 0 || r->solid[0].intersect;
    for (int j = 0; j < region_runs(r); j++) {
        const struct region_run run = region_run(r, j);
        const struct solid *s = &r->solid[run.first];
        if (s->subtract || s->intersect ? !inside : inside) continue;
        const bool within = run_within(s, &run, X, dim, s->subtract ? number_before(-tolerance) : tolerance);
        inside = s->subtract ? !within : within;
    }
    return inside;
}

real region_level_set_value(const struct region *r, const real *X, int dim)
{
    real level = r->n == 0 || r->solid[0].intersect ? -INFINITY : INFINITY;
    for (int j = 0; j < region_runs(r); j++) {
        const struct region_run run = region_run(r, j);
        const struct solid *s = &r->solid[run.first];
        const real own = run_level(s, &run, X, dim);
        level = s->subtract ? real_max(level, -own) : s->intersect ? real_max(level, own) : real_min(level, own);
    }
    return level;
}

bool region_has_box_with_infinite_side(const struct region *r, int dim)
{
    bool endless = false;
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        for (int d = 0; d < dim && s->kind == SOLID_BOX; d++) endless |= !isfinite(s->from[d]) || !isfinite(s->to[d]);
        endless |= region_has_box_with_infinite_side(&s->region, dim);
    }
    return endless;
}

real region_signed_distance(const struct region *r, const real *X, int dim, real *normal)
{
    real nearest = r->n > 0 && r->solid[0].intersect ? -INFINITY : INFINITY, own[DIM_MAX];
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    for (int j = 0; j < region_runs(r); j++) {
        const struct region_run run = region_run(r, j);
        const struct solid *s = &r->solid[run.first];
        const real distance = run_distance(s, &run, X, dim, own) * (s->subtract ? -1 : 1);
        if (s->subtract || s->intersect ? distance <= nearest : distance >= nearest) continue;
        nearest = distance;
        for (int d = 0; d < dim; d++) normal[d] = s->subtract ? -own[d] : own[d];
    }
    return nearest;
}
