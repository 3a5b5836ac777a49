/* How much of each cell of a body's lattice its shape covers, beside whether a particle fills it. */
#include "check_cover.h"

#include <math.h>

#include "base/memory.h"
#include "scene/fill.h"

#define CELLS_MOST 6e6 /* of the box round a body: larger ones take too long */
enum { PLACES = 64 };  /* within a cell that a face crosses; parts of several cells are known by more */

static int64_t cover_index(const struct cover *c, const int64_t *at)
{
    return (at[2] * c->n[1] + at[1]) * c->n[0] + at[0];
}

void cover_place(const struct cover *c, int64_t cell, int64_t *at)
{
    at[0] = cell % c->n[0], at[1] = cell / c->n[0] % c->n[1], at[2] = cell / c->n[0] / c->n[1];
}

static void cell_middle(const struct cover *c, int64_t cell, real *X)
{
    int64_t at[DIM_MAX];
    cover_place(c, cell, at);
    for (int d = 0; d < c->dim; d++) X[d] = c->first[d] + (real)at[d] * c->spacing;
}

/* Does a face cross a cell, as far as its neighbours tell? They are filled and it is not, or the other way round; or
 * there are none, and the shape comes near. */
static bool is_crossed(const struct cover *c, const struct region *shape, int64_t cell)
{
    int64_t at[DIM_MAX];
    real X[DIM_MAX];
    bool beside = false;
    cover_place(c, cell, at);
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
    return region_contains(shape, X, c->dim, 0.5 * sqrt(c->dim) * c->spacing);
}

/* Can a cell that a face crosses have several? It stands alone along an axis, or between two others, or beside none. */
static bool is_thin(const struct cover *c, int64_t cell)
{
    int64_t at[DIM_MAX], stride = 1;
    bool thin = false, beside = false;
    cover_place(c, cell, at);
    for (int d = 0; d < c->dim; stride *= c->n[d], d++) {
        const bool before = at[d] > 0 && c->filled[cell - stride];
        const bool after = at[d] + 1 < c->n[d] && c->filled[cell + stride];
        thin |= c->filled[cell] ? !before && !after : before && after;
        beside |= before || after;
    }
    return thin || !beside;
}

/* Is a solid a surface from a file, of which places are dear? */
static bool is_dear(const struct region *shape)
{
    bool dear = false;
    for (int k = 0; k < shape->n; k++)
        dear |= shape->solid[k].kind == SOLID_HULL ||
                (shape->solid[k].kind == SOLID_GROUP && is_dear(&shape->solid[k].region)) ||
                (shape->solid[k].kind == SOLID_EXTRUSION && is_dear(&shape->solid[k].region));
    return dear;
}

/* Share of a cell behind a plane face at the distance and with the normal of the shape's in its middle. */
static real share_behind(const struct cover *c, const struct region *shape, const real *X)
{
    real normal[DIM_MAX] = {0}, reach = 0;
    const real away = region_distance(shape, X, c->dim, normal);
    for (int d = 0; d < c->dim; d++) reach += fabs(normal[d]) * c->spacing;
    const real share = reach > 0 ? 0.5 - away / reach : away < 0;
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

/* Share of a cell by places of a Weyl sequence (Roberts' constants), which begins elsewhere in each cell. plane: one
 * face crosses it. */
static real share_within_cell(const struct cover *c, const struct region *shape, int64_t cell, bool plane)
{
    static const real step[][DIM_MAX] = {{0.7548776662466927, 0.5698402909980532},
                                         {0.8191725133961645, 0.6710436067037893, 0.5497004779019703}};
    real middle[DIM_MAX], X[DIM_MAX] = {0};
    int inside = 0;
    cell_middle(c, cell, middle);
    if (plane) return share_behind(c, shape, middle);
    for (int k = 0; k < PLACES; k++) {
        for (int d = 0; d < c->dim; d++) {
            const real turn = step[c->dim - 2][d] * (real)(cell % 65521 * PLACES + k) + 0.5;
            X[d] = middle[d] + (turn - floor(turn) - 0.5) * c->spacing;
        }
        inside += region_contains(shape, X, c->dim, 0);
    }
    return (real)inside / PLACES;
}

bool cover_make(struct cover *c, const struct scene *s, int body)
{
    const struct region *shape = &s->body[body].shape;
    const bool dear = is_dear(shape);
    real from[DIM_MAX], to[DIM_MAX], all = 1;
    *c = (struct cover){.dim = s->dim, .spacing = s->spacing, .n = {1, 1, 1}};
    if (s->body[body].file || s->dim < 2 || !(s->spacing > 0)) return false;
    if (!region_bounds(shape, s->dim, from, to) || fill_place(s, body, c->first) != OK) return false;
    for (int d = 0; d < s->dim; d++) all *= (to[d] - c->first[d]) / s->spacing + 3;
    if (!(all < CELLS_MOST)) return false;
    for (int d = 0; d < s->dim; d++) c->n[d] = (int64_t)((to[d] - c->first[d]) / s->spacing) + 2;
    c->cells = c->n[0] * c->n[1] * c->n[2];
    c->filled = NEW("check.filled", c->cells, uint8_t);
    c->share = NEW("check.share", c->cells, float);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < c->cells; k++) {
        real X[DIM_MAX];
        cell_middle(c, k, X);
        c->filled[k] = region_contains(shape, X, c->dim, ON_SURFACE * s->spacing);
    }
#pragma omp parallel for schedule(dynamic, 1024)
    for (int64_t k = 0; k < c->cells; k++)
        c->share[k] =
            is_crossed(c, shape, k) ? (float)share_within_cell(c, shape, k, dear && !is_thin(c, k)) : c->filled[k];
    return true;
}

void cover_free(struct cover *c)
{
    memory_free(c->filled);
    memory_free(c->share);
    *c = (struct cover){0};
}
