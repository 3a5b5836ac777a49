/* Searches for particles near a reference position by linked cells. */
#include "data/cells.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* ---- reference search -------------------------------------------------------------------------------------------- */

/* Returns the index of the search cell of c that contains X[dim] [m]; positions outside the box of the cells belong to
 * the nearest cell. */
static int64_t cells_cell_of(const struct cells *c, const real *X)
{
    int64_t index = 0;
    for (int d = c->dim - 1; d >= 0; d--) {
        int64_t k = (int64_t)((X[d] - c->origin[d]) / c->width); /* a negative one is the first, rounded or not */
        if (k < 0) k = 0;
        if (k >= c->count[d]) k = c->count[d] - 1;
        index = index * c->count[d] + k;
    }
    return index;
}

/* Number of cells along the radius of a search. At the usual horizon cells are then rows of the lattice, so that
 * particles are found in ascending order. The cells around a point also contain fewer particles beyond the radius
 * than larger cells would. */
enum { CELLS_ACROSS = 3 };

/* Computes origin, width and number of the search cells of c, with CELLS_ACROSS cells along `edge`, the largest search
 * radius [m]. Uses larger cells if there would otherwise be more cells than about four per particle of p, as in a box
 * far larger than its particles. */
static void cells_shape(struct cells *c, const struct particles *p, real edge)
{
    real low[DIM_MAX], high[DIM_MAX];
    for (int d = 0; d < p->dim; d++) particles_coordinate_range(p, p->n_all, d, &low[d], &high[d]);
    c->dim = p->dim;
    c->edge = edge;
    for (c->width = edge / CELLS_ACROSS;; c->width *= 1.5) {
        real cells = 1;
        for (int d = 0; d < c->dim; d++) {
            c->origin[d] = low[d];
            c->count[d] = p->n_all > 0 ? (int64_t)floor((high[d] - low[d]) / c->width) + 1 : 1;
            cells *= (real)c->count[d];
        }
        if (cells <= 4.0 * (real)p->n_all + 64 && cells < INT32_MAX) break;
    }
    c->n = 1;
    for (int d = 0; d < c->dim; d++) c->n *= c->count[d];
}

void cells_make_for_neighbour_search(struct cells *c, const struct particles *p, real cell_edge)
{
    cells_shape(c, p, cell_edge);
    c->start = NEW("cells.start", c->n + 2, int32_t);
    c->order = NEW("cells.order", p->n_all, int32_t);
    int32_t *cell = NEW("cells.cell", p->n_all, int32_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n_all; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        cell[i] = (int32_t)cells_cell_of(c, X);
    }
    for (int64_t i = 0; i < p->n_all; i++) c->start[cell[i] + 2]++;
    for (int64_t k = 0; k < c->n; k++) c->start[k + 2] += c->start[k + 1];
    for (int64_t i = 0; i < p->n_all; i++) c->order[c->start[cell[i] + 1]++] = (int32_t)i;
    memory_free(cell);
}

void cells_free(struct cells *c)
{
    memory_free(c->start);
    memory_free(c->order);
    memset(c, 0, sizeof *c);
}

/* Sorts the indices found[n] in ascending order by insertion, which is fast because only the mirror images at the end
 * of the list are out of order. */
static void sort_ascending(int32_t *found, int n)
{
    for (int k = 1; k < n; k++) {
        const int32_t index = found[k];
        int at = k;
        for (; at > 0 && found[at - 1] > index; at--) found[at] = found[at - 1];
        found[at] = index;
    }
}

/* Parameters and results of a search for particles within `radius` of X [m]. skip: particle that is left out, or -1;
 * found[room]: list of the particles; n: their number, which may exceed room; any_order: the list need not be
 * sorted. */
struct search {
    const struct cells *c;
    const real *X;
    real radius;
    int32_t skip, *found;
    int room, n;
    bool ascending, any_order;
};

/* Appends to s->found the particles of p within the search radius in the consecutive cells first .. last of a row along
 * x. Counts in s->n also those that exceed the capacity s->room, which are not stored. dim: number of dimensions, known
 * at compile time. */
static inline void near_in_row(struct search *s, const struct particles *p, int64_t first, int64_t last, const int dim)
{
    const int32_t *order = s->c->order;
    int32_t before = s->n > 0 && s->n <= s->room ? s->found[s->n - 1] : -1;
    for (int32_t k = s->c->start[first]; k < s->c->start[last + 1]; k++) {
        const int32_t j = order[k];
        real r2 = 0;
        for (int d = 0; d < dim; d++) r2 += square(p->X[d][j] - s->X[d]);
        if (r2 > s->radius * s->radius || j == s->skip) continue;
        if (s->n < s->room) s->found[s->n] = j;
        s->n++;
        s->ascending &= j > before;
        before = j;
    }
}

/* Returns a lower bound of the distance of X[dim] from the layer of cells of c with index k, from 0, along axis d [m];
 * 0 if X is in this layer. The bound is slightly smaller than the distance, so that round-off excludes no cell. */
static inline real gap(const struct cells *c, const real *X, int d, int64_t k)
{
    const real low = c->origin[d] + (real)k * c->width;
    return real_max(0, real_max(low - X[d], X[d] - low - c->width) - 1e-9 * c->width - 1e-15 * fabs(X[d]));
}

/* Sets *low and *high to the first and last index along axis d of the cells of c within `reach` [m] of X[dim]; low >
 * high if there are none. */
static inline void cells_within(const struct cells *c, const real *X, int d, real reach, int64_t *low, int64_t *high)
{
    reach = reach * (1 + 1e-12) + 1e-15 * fabs(X[d]); /* round-off of the distance */
    /* rounded towards 0: negative indices, which are rare, are no cells or the first */
    *low = (int64_t)((X[d] - reach - c->origin[d]) / c->width);
    *high = (int64_t)((X[d] + reach - c->origin[d]) / c->width);
    if (*low < 0) *low = 0;
    if (*high >= c->count[d]) *high = c->count[d] - 1;
}

/* Lists the particles of p within s->radius of s->X in s->found, in ascending order unless s->any_order. dim: number of
 * dimensions, known at compile time. Returns the number of particles found; if it exceeds the capacity s->room, the
 * list is incomplete. */
static inline int near(struct search *s, const struct particles *p, const int dim)
{
    const struct cells *c = s->c;
    int64_t low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < dim; d++) {
        cells_within(c, s->X, d, s->radius, &low[d], &high[d]);
        if (low[d] > high[d]) return 0;
    }
    for (int64_t a = low[2]; a <= high[2]; a++) {
        const real above = dim > 2 ? square(gap(c, s->X, 2, a)) : 0;
        for (int64_t b = low[1]; b <= high[1]; b++) {
            const real left = square(s->radius) - (above + (dim > 1 ? square(gap(c, s->X, 1, b)) : 0));
            int64_t from = low[0], to = high[0];
            if (left < 0) continue;
            if (dim > 1) cells_within(c, s->X, 0, sqrt(left) + 1e-9 * c->width, &from, &to);
            const int64_t row = (a * (dim > 1 ? c->count[1] : 1) + b) * c->count[0];
            if (from <= to) near_in_row(s, p, row + from, row + to, dim);
        }
    }
    if (!s->ascending && !s->any_order) sort_ascending(s->found, s->n < s->room ? s->n : s->room);
    return s->n;
}

/* Lists the particles of p within s->radius of s->X in s->found, by the copy of `near` that is compiled for the number
 * of dimensions. Returns the number of particles found; if it exceeds the capacity s->room, the list is incomplete. */
static int search(struct search *s, const struct particles *p)
{
    switch (s->c->dim) {
    case 1:
        return near(s, p, 1);
    case 2:
        return near(s, p, 2);
    default:
        return near(s, p, 3);
    }
}

int cells_list_particles_near_point(const struct cells *c, const struct particles *p, const real *X, real radius,
                                    int32_t excluded_particle, int32_t *found, int capacity)
{
    struct search s = {.c = c,
                       .X = X,
                       .radius = radius,
                       .skip = excluded_particle,
                       .found = found,
                       .room = capacity,
                       .ascending = true};
    return search(&s, p);
}

/* Returns the number of particles in the cells that are at most `reach` cells away from cell number `cell` of c along
 * each axis. */
static int64_t around(const struct cells *c, int64_t cell, int64_t reach)
{
    int64_t low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, sum = 0;
    for (int d = 0; d < c->dim; d++, cell /= c->count[d - 1]) {
        const int64_t k = cell % c->count[d];
        low[d] = k < reach ? 0 : k - reach;
        high[d] = k + reach >= c->count[d] ? c->count[d] - 1 : k + reach;
    }
    for (int64_t a = low[2]; a <= high[2]; a++)
        for (int64_t b = low[1]; b <= high[1]; b++) {
            const int64_t row = (a * (c->dim > 1 ? c->count[1] : 1) + b) * c->count[0];
            sum += c->start[row + high[0] + 1] - c->start[row + low[0]];
        }
    return sum;
}

int cells_neighbour_count_upper_bound(const struct cells *c, real radius)
{
    real far = 0;
    int64_t most = 0;
    for (int d = 0; d < c->dim; d++)
        far = real_max(far, real_max(fabs(c->origin[d]), fabs(c->origin[d] + (real)c->count[d] * c->width)));
    const int64_t reach = (int64_t)ceil((radius * (1 + 2e-12) + 2e-15 * far) / c->width);
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t cell = 0; cell < c->n; cell++) {
        const int64_t n = c->start[cell + 1] > c->start[cell] ? around(c, cell, reach) : 0;
        if (n > most) most = n;
    }
    return (int)most;
}

/* Lists in near->at the particles and mirror images of p whose reference position is within `radius` [m] of that of
 * particle i, and stores their number in near->n. The list grows as needed. c: search cells; itself: true to include
 * particle i; any_order: true if the list need not be sorted. */
static void cells_find(struct neighbour_list *near, const struct cells *c, const struct particles *p, int64_t i,
                       real radius, bool itself, bool any_order)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    for (;;) {
        struct search s = {.c = c,
                           .X = X,
                           .radius = radius,
                           .skip = itself ? -1 : (int32_t)i,
                           .found = near->at,
                           .room = near->room,
                           .ascending = true,
                           .any_order = any_order};
        near->n = search(&s, p);
        if (near->n <= near->room) return;
        near->at = memory_resize("cells.near", near->at, near->room, 2 * near->n, sizeof *near->at);
        near->room = 2 * near->n;
    }
}

void particles_list_neighbours_within_radius(struct neighbour_list *near, const struct cells *c,
                                             const struct particles *p, int64_t particle, real radius,
                                             bool include_itself)
{
    cells_find(near, c, p, particle, radius, include_itself, false);
}

void particles_list_neighbours_unordered(struct neighbour_list *near, const struct cells *c, const struct particles *p,
                                         int64_t particle, real radius, bool include_itself)
{
    cells_find(near, c, p, particle, radius, include_itself, true);
}
