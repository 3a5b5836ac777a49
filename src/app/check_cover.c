/* Computes the share of each lattice cell that the shape of a body covers, and whether a particle fills the cell. */
#include "check_cover.h"

#include <math.h>

#include "base/memory.h"
#include "scene/fill.h"

#define CELLS_MOST 6e6 /* largest number of cells of the bounding box of a body; more take too long */
enum {
    PLACES = 64
}; /* number of points that are sampled in a cell which a face crosses; errors average out over several cells */

bool body_piece_contains_point(const struct body_piece *p, const real *X, real tolerance)
{
    const struct scene_body *b = &p->scene->body[p->body];
    return region_contains(&b->shape, X, p->scene->dim, tolerance) &&
           (p->material == ANY_MATERIAL ||
            scene_material_index_at_position(p->scene, b, X, b->material) == p->material);
}

/* Returns true if the point X[dim] [m] is inside the piece p (a body, or its part of one material) or within `distance`
 * [m] of it. Always returns false for the part of the basic material of a body: it is the remainder of the body outside
 * the parts of other materials, so that it has no shape of its own. */
static bool piece_near(const struct body_piece *p, const real *X, real distance)
{
    const struct scene_body *b = &p->scene->body[p->body];
    bool near = p->material == ANY_MATERIAL;
    for (int k = 0; k < b->parts && !near; k++)
        near = b->part[k].material == p->material && region_contains(&b->part[k].region, X, p->scene->dim, distance);
    return near && region_contains(&b->shape, X, p->scene->dim, distance);
}

bool body_piece_compute_bounding_box(const struct body_piece *p, real lower[DIM_MAX], real upper[DIM_MAX])
{
    const struct scene_body *b = &p->scene->body[p->body];
    const int dim = p->scene->dim;
    real low[DIM_MAX], high[DIM_MAX];
    bool any = false;
    if (!region_compute_bounding_box_if_finite(&b->shape, dim, lower, upper)) return false;
    if (p->material == ANY_MATERIAL || p->material == b->material) return true;
    for (int d = 0; d < dim; d++) low[d] = upper[d], high[d] = lower[d];
    for (int k = 0; k < b->parts; k++) {
        real begin[DIM_MAX], end[DIM_MAX];
        if (b->part[k].material != p->material) continue;
        if (!region_compute_bounding_box_if_finite(&b->part[k].region, dim, begin, end)) return true;
        for (int d = 0; d < dim; d++) low[d] = real_min(low[d], begin[d]), high[d] = real_max(high[d], end[d]);
        any = true;
    }
    for (int d = 0; d < dim; d++) {
        lower[d] = real_max(lower[d], low[d]), upper[d] = real_min(upper[d], high[d]);
        any = any && lower[d] < upper[d];
    }
    return any;
}

static int64_t cover_index(const struct cell_coverage *c, const int64_t *at)
{
    return (at[2] * c->n[1] + at[1]) * c->n[0] + at[0];
}

void cell_coverage_compute_lattice_indices_of_cell(const struct cell_coverage *c, int64_t cell, int64_t *index)
{
    index[0] = cell % c->n[0], index[1] = cell / c->n[0] % c->n[1], index[2] = cell / c->n[0] / c->n[1];
}

static void cell_middle(const struct cell_coverage *c, int64_t cell, real *X)
{
    int64_t at[DIM_MAX];
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    for (int d = 0; d < c->dim; d++) X[d] = c->first[d] + (real)at[d] * c->spacing;
}

/* Returns true if a face of the piece p (a body, or its part of one material) seems to cross the lattice cell number
 * `cell` of c. This is so if the cell contains a particle and one of its neighbouring cells does not, or the reverse.
 * It is also so if neither the cell nor its neighbours contain particles, but the piece is within half a cell diagonal
 * of the centre. */
static bool is_crossed(const struct cell_coverage *c, const struct body_piece *p, int64_t cell)
{
    int64_t at[DIM_MAX];
    real X[DIM_MAX];
    bool beside = false;
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    for (int k = 0; k < 27; k++) {
        const int64_t near[DIM_MAX] = {at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1};
        bool within = true;
        for (int d = 0; d < DIM_MAX; d++) within &= near[d] >= 0 && near[d] < c->n[d];
        if (!within) {
            beside |= c->filled[cell] && (c->dim == 3 || k / 9 == 1);
            continue;
        }
        beside |= c->filled[cover_index(c, near)] != c->filled[cell];
    }
    if (beside || c->filled[cell]) return beside;
    cell_middle(c, cell, X);
    return piece_near(p, X, 0.5 * sqrt(c->dim) * c->spacing);
}

/* Returns true if more than one face of the body may cross the lattice cell number `cell` of c, because the body or a
 * gap in it is only one cell wide there. A cell with a particle is thin if both its neighbours along some axis are
 * empty. An empty cell is thin if both its neighbours along some axis contain particles, or if none of its neighbours
 * does. */
static bool is_thin(const struct cell_coverage *c, int64_t cell)
{
    int64_t at[DIM_MAX], stride = 1;
    bool thin = false, beside = false;
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    for (int d = 0; d < c->dim; stride *= c->n[d], d++) {
        const bool before = at[d] > 0 && c->filled[cell - stride];
        const bool after = at[d] + 1 < c->n[d] && c->filled[cell + stride];
        thin |= c->filled[cell] ? !before && !after : before && after;
        beside |= before || after;
    }
    return thin || !beside;
}

/* Returns true if the test whether a point is inside `shape` is slow: one of its solids is a surface from a file, or a
 * group or extrusion that contains such a surface. */
static bool is_dear(const struct region *shape)
{
    bool dear = false;
    for (int k = 0; k < shape->n; k++)
        dear |= shape->solid[k].kind == SOLID_HULL ||
                (shape->solid[k].kind == SOLID_GROUP && is_dear(&shape->solid[k].region)) ||
                (shape->solid[k].kind == SOLID_EXTRUSION && is_dear(&shape->solid[k].region));
    return dear;
}

/* Returns the fraction of a lattice cell of c that is inside the region `shape` [1]. X[dim]: centre of the cell [m].
 * The surface in the cell is approximated by a plane, from the distance and the normal of the surface at X. */
static real share_behind(const struct cell_coverage *c, const struct region *shape, const real *X)
{
    real normal[DIM_MAX] = {0}, reach = 0;
    const real away = region_signed_distance(shape, X, c->dim, normal);
    for (int d = 0; d < c->dim; d++) reach += fabs(normal[d]) * c->spacing;
    const real share = reach > 0 ? 0.5 - away / reach : away < 0;
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

/* Returns the fraction of the lattice cell number `cell` of c that is inside the piece p (a body, or its part of one
 * material). plane: true if only one face crosses the cell; the face is then approximated by a plane. Otherwise PLACES
 * points in the cell are tested, which form a Weyl sequence (constants of Roberts) with a different start in each cell.
 */
static real share_within_cell(const struct cell_coverage *c, const struct body_piece *p, int64_t cell, bool plane)
{
    static const real step[][DIM_MAX] = {{0.7548776662466927, 0.5698402909980532},
                                         {0.8191725133961645, 0.6710436067037893, 0.5497004779019703}};
    real middle[DIM_MAX], X[DIM_MAX] = {0};
    int inside = 0;
    cell_middle(c, cell, middle);
    if (plane) return share_behind(c, &p->scene->body[p->body].shape, middle);
    for (int k = 0; k < PLACES; k++) {
        for (int d = 0; d < c->dim; d++) {
            const real turn = step[c->dim - 2][d] * (real)(cell % 65521 * PLACES + k) + 0.5;
            X[d] = middle[d] + (turn - floor(turn) - 0.5) * c->spacing;
        }
        inside += body_piece_contains_point(p, X, 0);
    }
    return (real)inside / PLACES;
}

bool cell_coverage_compute_for_body_piece(struct cell_coverage *c, const struct body_piece *p)
{
    const struct scene *s = p->scene;
    const bool dear = p->material == ANY_MATERIAL && is_dear(&s->body[p->body].shape);
    real from[DIM_MAX], to[DIM_MAX], all = 1;
    *c = (struct cell_coverage){.dim = s->dim, .spacing = s->spacing, .n = {1, 1, 1}};
    if (s->body[p->body].file || s->dim < 2 || !(s->spacing > 0)) return false;
    if (!body_piece_compute_bounding_box(p, from, to) ||
        body_lattice_compute_first_site_position(s, p->body, c->first) != OK)
        return false;
    for (int d = 0; d < s->dim; d++) {
        c->first[d] += real_max(0, floor((from[d] - c->first[d]) / s->spacing) - 1) * s->spacing;
        all *= (to[d] - c->first[d]) / s->spacing + 3;
    }
    if (!(all < CELLS_MOST)) return false;
    for (int d = 0; d < s->dim; d++) c->n[d] = (int64_t)((to[d] - c->first[d]) / s->spacing) + 2;
    c->cells = c->n[0] * c->n[1] * c->n[2];
    c->filled = NEW("check.filled", c->cells, uint8_t);
    c->share = NEW("check.share", c->cells, float);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < c->cells; k++) {
        real X[DIM_MAX];
        cell_middle(c, k, X);
        c->filled[k] = body_piece_contains_point(p, X, ON_SURFACE * s->spacing);
    }
#pragma omp parallel for schedule(dynamic, 1024)
    for (int64_t k = 0; k < c->cells; k++)
        c->share[k] = is_crossed(c, p, k) ? (float)share_within_cell(c, p, k, dear && !is_thin(c, k)) : c->filled[k];
    return true;
}

void cell_coverage_free(struct cell_coverage *c)
{
    memory_free(c->filled);
    memory_free(c->share);
    *c = (struct cell_coverage){0};
}
