/* Finds neighbouring material points of metals on the background grid that separate only because shape functions
 * transmit too little force (numerical fracture, parted.h), and warns of them. */
#include "step/parted.h"

#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "grid/grid_part.h"

/* Equivalent plastic strain below which pairs of neighbouring points are not compared [1], because a stretch by 2 %
 * separates no points. */
#define FLOWED_LEAST 0.02
/* Largest reference distance of neighbours [spacings]: those along the axes of a lattice have 1, along diagonals 1.4.
 */
#define NEIGHBOUR 1.2
/* Ratio of present to reference distance of neighbouring points below which they cannot be parted [1]. */
#define PARTED_LEAST 1.25
enum { PARTS_OF_DURATION = 50 }; /* number of comparisons per run: a delay of a fiftieth does not matter */

/* Shape functions whose forces are too small in tension, so that bodies on the grid separate, with the limits of
 * stretch at which a warning is due (struct weak_shape_function). */
static const struct weak_shape_function weak_shapes[] = {{SHAPE_LINEAR, 1.02, 1.25, 0.01, "linear", "12 to 45"},
                                                         {SHAPE_GIMP, 1.4, 1.4, 0.08, "gimp", "6 to 10"}};

const struct weak_shape_function *numerical_fracture_properties_of_shape_function(enum shape shape)
{
    for (size_t k = 0; k < COUNT_OF(weak_shapes); k++)
        if (weak_shapes[k].shape == shape) return &weak_shapes[k];
    return NULL;
}

/* Returns true if particle i of p is a material point on the background grid and its material (of scene s) yields. */
static bool flows_on_grid(const struct particles *p, const struct scene *s, int64_t i)
{
    return p->kind[i] == KIND_MPM && !(p->flag[i] & FLAG_MESHED) && material_yields(&s->material[p->material[i]]);
}

/* Lists in *pairs the pairs of neighbouring material points of one body that are on the grid and of materials that
 * yield. s: materials and spacing; cells: search cells of all particles. p: all particles. */
static void pairs_make(struct point_pairs *pairs, const struct cells *cells, const struct particles *p,
                       const struct scene *s)
{
    struct neighbour_list near = {0};
    pairs->made = true;
    for (int64_t i = 0; i < p->n; i++) {
        if (!flows_on_grid(p, s, i)) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, NEIGHBOUR * s->spacing, false);
        for (int k = 0; k < near.n; k++) {
            const int32_t j = near.at[k];
            if (j <= i || j >= p->n || p->body[j] != p->body[i] || !flows_on_grid(p, s, j)) continue;
            GROW("step.pairs", pairs->pair, pairs->n + 1);
            pairs->pair[pairs->n++] = (struct point_pair){(int32_t)i, j};
        }
    }
    memory_free(near.at);
}

/* The set of the grid cells that contain material points, as a hash table with open addressing. */
struct held_cells {
    struct grid g; /* size of the cells and corner of one of them, as in the grid of the points; no nodes */
    uint64_t mask; /* number of slots, a power of 2, less 1 */
    uint64_t *key; /* key of the cell in each slot, 0: none */
};

/* Returns the slot of the grid cell at the position x[dim] [m] in the hash table h of cells that contain points, or
 * the empty slot in which the cell has to be entered. *key: receives the key of the cell, which is never 0. */
static uint64_t cell_slot(const struct held_cells *h, const real *x, uint64_t *key)
{
    *key = 1;
    for (int d = 0; d < h->g.dim; d++) *key = *key * 0x200003 + (uint64_t)grid_cell_index_at(&h->g, d, x[d]);
    uint64_t slot = *key * 0x9e3779b97f4a7c15 >> 32;
    while (h->key[slot & h->mask] != 0 && h->key[slot & h->mask] != *key) slot++;
    return slot & h->mask;
}

/* Fills the hash table h with all cells of the grid g that contain particles of p, to find gaps between points.
 * Release h->key with memory_free. */
static void held_cells_make(struct held_cells *h, const struct particles *p, const struct grid *g)
{
    *h = (struct held_cells){.g = {.dim = p->dim, .h = g->h}, .mask = 1};
    for (int d = 0; d < p->dim; d++) h->g.anchor[d] = g->anchor[d];
    while ((int64_t)h->mask < 2 * p->n_free) h->mask = 2 * h->mask + 1;
    h->key = NEW("step.held_cells", (int64_t)h->mask + 1, uint64_t);
    for (int64_t k = 0; k < p->n_free; k++) {
        real x[DIM_MAX];
        uint64_t key;
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][p->list_free[k]];
        const uint64_t slot = cell_slot(h, x, &key);
        h->key[slot] = key;
    }
}

/* A pair of points that is stretched: the ratio of its present to its reference distance [1] and the position of its
 * middle [m]. */
struct stretched_pair {
    real stretch, middle[DIM_MAX];
};

/* Counts of pairs of neighbouring points at one time. parted: pairs with a gap between them; pulled: pairs under
 * tension stretched beyond a limit; farthest: the most stretched of the parted pairs, or of the pulled pairs if none is
 * parted. */
struct pair_counts {
    int64_t parted, pulled;
    struct stretched_pair farthest;
};

/* Computes the ratio of the present to the reference distance of the two material points of p in `pair` [1] and the
 * position midway between them [m] in *stretched. *axis: receives the axis along which they are farthest apart. Returns
 * false, and stores nothing, if the ratio is below PARTED_LEAST. */
static bool pair_is_stretched(const struct particles *p, const struct point_pair *pair,
                              struct stretched_pair *stretched, int *axis)
{
    const int32_t i = pair->a, j = pair->b;
    real now = 0, before = 0, most = -1;
    for (int d = 0; d < p->dim; d++) now += square(p->x[d][j] - p->x[d][i]), before += square(p->X[d][j] - p->X[d][i]);
    if (now < square(PARTED_LEAST) * before) return false;
    for (int d = 0; d < p->dim; d++) {
        const real apart = square(p->x[d][j] - p->x[d][i]);
        stretched->middle[d] = 0.5 * (p->x[d][i] + p->x[d][j]);
        if (apart > most) most = apart, *axis = d;
    }
    stretched->stretch = sqrt(now / before);
    return true;
}

/* Returns true if the shape functions of the two material points of p in `pair` have at most one layer of nodes in
 * common across `axis`: if the distance of the points along the axis is greater than a cell plus the extent of the
 * functions beyond the cells of the points. s: scene, for cell and shape functions. */
static bool pair_shares_few_nodes(const struct particles *p, const struct point_pair *pair, int axis,
                                  const struct scene *s)
{
    const real cell = s->cell * s->spacing, reach = grid_shape_function_reach_beyond_cell(s);
    real shared = cell;
    for (int side = 0; side < 2; side++)
        shared += p->stretch[axis] ? real_min(reach * p->stretch[axis][side ? pair->b : pair->a], cell) : reach;
    return fabs(p->x[axis][pair->b] - p->x[axis][pair->a]) > shared;
}

/* Returns true if the grid cell at position X[dim] [m] contains no points according to the table h, nor do the cells
 * next to it along the axes other than `axis`. A single empty cell is no gap, since flowing points fill it again. */
static bool cells_are_empty(const struct held_cells *h, const real *X, int axis)
{
    real at[DIM_MAX];
    uint64_t key;
    for (int d = 0; d < h->g.dim; d++) at[d] = X[d];
    if (h->key[cell_slot(h, at, &key)] != 0) return false;
    for (int d = 0; d < h->g.dim; d++)
        for (int side = -1; side <= 1 && d != axis; side += 2) {
            at[d] = X[d] + side * h->g.h;
            const bool held = h->key[cell_slot(h, at, &key)] != 0;
            at[d] = X[d];
            if (held) return false;
        }
    return true;
}

/* Returns true if particle i of p is under tension: its mean stress is positive. */
static bool in_tension(const struct particles *p, int64_t i)
{
    real sum = 0;
    for (int d = 0; d < p->dim; d++) sum += p->stress[d][i];
    return sum > 0;
}

/* Counts two kinds of pairs of points of p: parted ones, which have empty cells between them and at most one common
 * layer of nodes, and pulled ones, whose distance under tension is at least `far` times the reference distance. g: grid
 * of the points; s: scene, for the shape functions. */
static struct pair_counts pairs_count(const struct point_pairs *pairs, const struct particles *p, const struct grid *g,
                                      const struct scene *s, real far)
{
    struct held_cells held = {.key = NULL}; /* made for the first pair that may be parted: most samples have none */
    struct pair_counts c = {0};
    struct stretched_pair pulled_most = {0};
    for (int64_t k = 0; k < pairs->n; k++) {
        struct stretched_pair now;
        const struct point_pair *pair = &pairs->pair[k];
        int axis = 0;
        if (!pair_is_stretched(p, pair, &now, &axis)) continue;
        const bool pulled = now.stretch >= far && in_tension(p, pair->a) && in_tension(p, pair->b);
        if (pulled && now.stretch > pulled_most.stretch) pulled_most = now;
        c.pulled += pulled;
        if (!pair_shares_few_nodes(p, pair, axis, s)) continue;
        if (!held.key) held_cells_make(&held, p, g);
        if (!cells_are_empty(&held, now.middle, axis)) continue;
        if (now.stretch > c.farthest.stretch) c.farthest = now;
        c.parted++;
    }
    if (c.parted == 0) c.farthest = pulled_most;
    memory_free(held.key);
    return c;
}

/* Prints a warning about pairs of neighbouring points and adds it to the list `to`: c->parted of n pairs have gaps
 * between them or, if there are none, c->pulled of them are stretched too far for the shape function of the scene s. t:
 * current time [s]. */
static void warn_of_parted(const struct scene *s, const struct pair_counts *c, int64_t n, real t, struct warnings *to)
{
    const struct weak_shape_function *w =
        c->parted > 0 ? NULL : numerical_fracture_properties_of_shape_function(s->shape);
    const struct position_text at = position_text(c->farthest.middle, s->dim, 4);
    char text[640], what[400];
    if (w)
        snprintf(what, sizeof what,
                 "metal is pulled too far for mpm.shape: %s, which carries %s %% too little stress where the distance "
                 "of neighbouring points is above %.3g times the initial one. At t = %.3g s this holds for %lld of "
                 "%lld pairs; the largest distance is %.2g times the initial one, near (%s) m",
                 w->word, w->too_little, w->pulled, t, (long long)c->pulled, (long long)n, c->farthest.stretch,
                 at.text);
    else
        snprintf(what, sizeof what,
                 "metal has separated by a numerical error, without fracture, at t = %.3g s: between %lld of %lld "
                 "pairs of neighbouring points the cells of the grid are empty and transfer little or no force; near "
                 "(%s) m their distance is %.2g times the initial one",
                 t, (long long)c->parted, (long long)n, at.text, c->farthest.stretch);
    snprintf(
        text, sizeof text,
        "%s; use %smpm.frame: reference up to plastic strains of 0.05%s; if this is intended, add accept: [strain]",
        what, s->shape == SHAPE_CPGIMP ? "" : "mpm.shape: cpgimp, or ",
        c->parted > 0 ? ", and pull it by wider parts that do not yield" : "");
    warnings_add_and_print(to, text);
}

bool material_points_warn_of_numerical_fracture(struct point_pairs *pairs, const struct particles *p,
                                                const struct cells *cells, const struct grid_method *grid,
                                                const struct scene *s, real t, struct warnings *warning_list)
{
    real most = 0;
    const int part = 1 + scene_duration_interval_index_at_time(s, t, PARTS_OF_DURATION);
    if (p->n_free == 0 || !p->plastic_strain || scene_silences_warning(s, ACCEPT_STRAIN)) return false;
    if (part == pairs->compared) return false;
    pairs->compared = part;
    for (int64_t i = 0; i < p->n; i++) most = real_max(most, p->plastic_strain[i]);
    if (!(most > FLOWED_LEAST)) return false;
    if (!pairs->made) pairs_make(pairs, cells, p, s);
    const struct weak_shape_function *w = numerical_fracture_properties_of_shape_function(s->shape);
    const struct pair_counts c = pairs_count(pairs, p, &grid->field[0].grid, s, w ? w->pulled : INFINITY);
    const bool weak = !pairs->pulled && w && (real)c.pulled > w->share * (real)pairs->n;
    if (c.parted == 0 && !weak) return false;
    warn_of_parted(s, &c, pairs->n, t, warning_list);
    if (c.parted == 0) pairs->pulled = true;
    return c.parted > 0;
}
