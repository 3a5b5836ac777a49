/* The exposed face of bodies along an axis, column by column, for tractions.
 *
 * Columns run along the normal of the face. A particle is a cube (in 2D a square) of its volume and belongs to every
 * column whose middle line passes through it. The exposed particle of a column is the first particle of the region that
 * has no particle within GAP widths in front of it; particles of all bodies that the boundary acts on hide those behind
 * them. Steps and curved faces are thus found; particles below an overhang and walls of holes are not, unless the
 * region excludes the particles in front of them.
 *
 * A lattice, regular or irregular, determines its columns: its sites are the mean positions of particles, and each site
 * has one column. Disordered particles are sampled by FINE columns per mean particle width. */
#include <math.h>

#include "loads/loads.h"
#include "base/memory.h"

/* Distance above which the next particle in front is on the other side of a hole [particle widths]. Lattice neighbours
 * are at distance 1, particles on both sides of a missing site at 2. */
#define GAP 1.75
#define BENEATH 0.25 /* smallest distance from the first to the next particle [widths] */
#define EVEN 1e-4    /* relative difference of volumes that count as equal: lattices may be written in decimals */
/* Offset of the cubes of particles relative to the columns [particle widths]. If both ends of a cube are exactly at
 * middle lines of columns, the offset puts the cube in one of these columns only. */
#define TO_ONE_SIDE 1e-6
/* Smallest order parameter at which coordinates count as those of a lattice [1]: the length of the mean direction of
 * the coordinates, mapped to angles with the period of a spacing (find_site). It is 0 without order, 1 on a lattice,
 * and sin(2 pi s)/(2 pi s) if positions are shifted at random by up to s spacings. */
#define ORDER_LEAST 0.05
#define ORDER_CHANCE 3.0 /* times sqrt(n): sum that n disordered particles may reach by chance */
/* FINE: number of columns per mean width of disordered particles; SITES_SAMPLED: largest number of particles,
 * approximately, from which lattice sites are determined; TABLE_FIRST: initial size of the hash table of columns. */
enum { FINE = 4, SITES_SAMPLED = 1 << 16, TABLE_FIRST = 1 << 10 };

/* Particles of one body in columns, i.e. lines of particles along the normal of a loaded face, with a hash table of the
 * columns. Owns its arrays; made by loads_columns_make and released by loads_columns_free. */
struct columns {
    int body, axes, axis[DIM_MAX - 1]; /* index of the body; number of axes across the columns; these axes */
    real middle[DIM_MAX - 1];          /* coordinates of the middle line of column 0 [m] */
    real spacing;                      /* spacing of the scene [m] */
    real width, step;                  /* mean width of the particles; distance of columns [m] */
    bool even;                         /* all particles of the body have one volume */
    int64_t n, room;                   /* number of columns; size of the hash table, a power of two */
    int64_t *key;                      /* [room] key of the position of a column, -1: free entry */
    int32_t *number;                   /* [room] number of this column, 0 .. n-1 */
    int64_t *count;                    /* [room/2] number of particles in column c */
    int64_t *start;                    /* [n + 1] range of `order` for column c: start[c] .. start[c+1]-1 */
    int32_t *order;                    /* indices of the particles of the columns, ascending along the normal */
};

/* ---- positions of columns ---------------------------------------------------------------------------------------- */

/* Returns the edge of the cube (in 2D the square) that represents particle i of p [m]: (volume/section)^(1/dim), with
 * the thickness or area b->section, or the spacing of the scene if there is no section. For particles of body c->body,
 * if all have one volume, returns their common width c->width. */
static real width_of(const struct columns *c, const struct boundary *b, const struct particles *p, int64_t i)
{
    if (p->body[i] == c->body && c->even) return c->width;
    return b->section > 0 ? pow(p->volume0[i] / b->section, 1.0 / p->dim) : c->spacing;
}

/* Computes c->width [m], the edge of a cube (in 2D a square) with the mean volume of the particles of body c->body in
 * p. Sets c->even to true if their volumes are equal up to the relative difference EVEN. A width that differs from the
 * spacing of the scene by less than EVEN is set to the spacing. Without b->section (area or thickness of boundary b)
 * the width is the spacing. */
static void find_width(struct columns *c, const struct boundary *b, const struct particles *p)
{
    real mean = 0, least = INFINITY, most = 0;
    int64_t n = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != c->body) continue;
        mean += p->volume0[i], n++;
        least = real_min(least, p->volume0[i]), most = real_max(most, p->volume0[i]);
    }
    mean /= (real)n;
    c->even = most - least <= EVEN * mean || !(b->section > 0);
    c->width = b->section > 0 ? pow(mean / b->section, 1.0 / p->dim) : c->spacing;
    if (fabs(c->width - c->spacing) <= EVEN * c->spacing) c->width = c->spacing;
}

/* Finds the coordinate of a lattice site of body c->body along axis d, at or near coordinate `low` [m], and stores it
 * in *site [m]. Coordinates of particles p are mapped to angles on a circle whose circumference is one particle width,
 * and the site follows from the mean direction. Uses at most about SITES_SAMPLED particles. Returns false if the
 * coordinates are not concentrated enough around lattice sites, so that the particles have no order along d. */
static bool find_site(const struct columns *c, const struct particles *p, int d, real low, real *site)
{
    const int64_t stride = p->n / SITES_SAMPLED + 1;
    real along = 0, across = 0;
    int64_t n = 0;
    for (int64_t i = 0; i < p->n; i += stride) {
        if (p->body[i] != c->body) continue;
        const real angle = 2 * M_PI * (p->X[d][i] - low) / c->width;
        along += cos(angle), across += sin(angle), n++;
    }
    *site = low + atan2(across, along) / (2 * M_PI) * c->width;
    return hypot(along, across) > real_max(ORDER_LEAST * (real)n, ORDER_CHANCE * sqrt((real)n)) ||
           along > (1 - EVEN) * (real)n;
}

/* Sets where the columns (lines of particles parallel to the normal of the face of b) are. Stores in c->axis the axes
 * across the columns, in c->step the distance of neighbouring columns [m], and in c->middle the position of column 0
 * along each of these axes [m]. If the particles p are on a lattice and have equal volumes, there is a column at each
 * lattice site; else there are FINE columns for each particle width. */
static void find_middles(struct columns *c, const struct boundary *b, const struct particles *p)
{
    real low[DIM_MAX - 1];
    bool ordered = c->even;
    for (int d = 0; d < p->dim; d++)
        if (d != b->face) c->axis[c->axes++] = d;
    for (int k = 0; k < c->axes; k++) {
        const real *X = p->X[c->axis[k]];
        low[k] = INFINITY;
        for (int64_t i = 0; i < p->n; i++)
            if (p->body[i] == c->body) low[k] = real_min(low[k], X[i]);
        ordered = find_site(c, p, c->axis[k], low[k], &c->middle[k]) && ordered;
    }
    c->step = ordered ? c->width : c->width / FINE;
    for (int k = 0; k < c->axes && !ordered; k++) c->middle[k] = low[k] - 0.5 * c->width + 0.5 * c->step;
}

/* ---- particles in columns ---------------------------------------------------------------------------------------- */

/* Returns the index of `key` in the hash table of the columns c (lines of particles behind a face), or the free index
 * where it must be inserted (Fibonacci hashing, Knuth vol. 3). The table must have a free index. */
static int64_t table_place(const struct columns *c, int64_t key)
{
    const int64_t last = c->room - 1;
    int64_t place = (int64_t)((uint64_t)key * 0x9E3779B97F4A7C15u >> 32) & last;
    while (c->key[place] >= 0 && c->key[place] != key) place = (place + 1) & last;
    return place;
}

/* Doubles the size c->room of the hash table of the columns (lines of particles behind a face; TABLE_FIRST entries at
 * first) and enters all keys again. Column numbers do not change. */
static void table_grow(struct columns *c)
{
    const struct columns old = *c;
    c->room = old.room > 0 ? 2 * old.room : TABLE_FIRST;
    c->key = NEW("loads.key", c->room, int64_t);
    c->number = NEW("loads.number", c->room, int32_t);
    GROW("loads.count", c->count, c->room / 2);
    for (int64_t k = 0; k < c->room; k++) c->key[k] = -1;
    for (int64_t k = 0; k < old.room; k++) {
        if (old.key[k] < 0) continue;
        const int64_t place = table_place(c, old.key[k]);
        c->key[place] = old.key[k], c->number[place] = old.number[k];
    }
    memory_free(old.key);
    memory_free(old.number);
}

/* Returns the number, from 0, of the column (line of particles behind a face) whose position has the key `key` in the
 * hash table of c. If there is none, appends a column if `make` is true, else returns -1. */
static int32_t column_number(struct columns *c, int64_t key, bool make)
{
    if (make && 2 * c->n >= c->room) table_grow(c);
    const int64_t place = table_place(c, key);
    if (c->key[place] < 0 && !make) return -1;
    if (c->key[place] < 0) c->key[place] = key, c->number[place] = (int32_t)c->n++;
    return c->number[place];
}

/* Range of the columns whose middle lines pass through the cube of a particle: column numbers from[a] .. to[a] - 1
 * along each axis a across the columns. */
struct span {
    int64_t from[DIM_MAX - 1], to[DIM_MAX - 1];
};

/* Returns the range of columns of c (lines of particles normal to a face) whose middle lines pass through the cube that
 * represents particle i of p. width: edge of the cube [m]. */
static struct span span_of(const struct columns *c, const struct particles *p, int64_t i, real width)
{
    struct span s = {{0, 0}, {1, 1}};
    for (int k = 0; k < c->axes; k++) {
        const real low = p->X[c->axis[k]][i] - c->middle[k] - (0.5 + TO_ONE_SIDE) * width;
        s.from[k] = (int64_t)ceil(low / c->step), s.to[k] = (int64_t)ceil((low + width) / c->step);
    }
    return s;
}

/* Adds particle i of p to each column of c (line of particles normal to the face of b) whose middle line passes through
 * the cube of the particle. It is called twice for each particle: with `put` false it counts the particle in c->count,
 * with `put` true it stores the particle in c->order. While counting, a particle of body c->body creates columns that
 * do not exist yet, and a particle of another body does not. */
static void particle_enter(struct columns *c, const struct boundary *b, const struct particles *p, int64_t i, bool put)
{
    const bool make = p->body[i] == c->body && !put;
    const struct span s = span_of(c, p, i, width_of(c, b, p, i));
    for (int64_t u = s.from[0]; u < s.to[0]; u++)
        for (int64_t w = s.from[1]; w < s.to[1]; w++) {
            const uint64_t key = ((uint64_t)u << 32 ^ ((uint64_t)w & UINT32_MAX)) & INT64_MAX;
            const int32_t column = column_number(c, (int64_t)key, make);
            if (column < 0) continue;
            if (put)
                c->order[c->start[column + 1]++] = (int32_t)i;
            else
                c->count[column]++;
        }
}

/* Returns the height of particle i of p: its reference coordinate along the outward normal of the face of boundary b
 * [m]. */
static real loads_columns_height(const struct boundary *b, const struct particles *p, int32_t i)
{
    return b->side * p->X[b->face][i];
}

/* Returns true if particle i of p is lower than particle j along the outward normal of the face of boundary b.
 * Particles of equal height are ordered by index. */
static bool is_lower(const struct boundary *b, const struct particles *p, int32_t i, int32_t j)
{
    return loads_columns_height(b, p, i) < loads_columns_height(b, p, j) ||
           (loads_columns_height(b, p, i) == loads_columns_height(b, p, j) && i < j);
}

/* Sorts order[n], the indices in p of the particles of one column, by ascending height along the outward normal of the
 * face of boundary b: Shell's sort with Knuth's gaps, because columns of a lattice are already in order. */
static void sort_column(const struct boundary *b, const struct particles *p, int32_t *order, int64_t n)
{
    int64_t gap = 1;
    while (gap < n / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (int64_t k = gap; k < n; k++) {
            const int32_t i = order[k];
            int64_t at = k;
            for (; at >= gap && is_lower(b, p, i, order[at - gap]); at -= gap) order[at] = order[at - gap];
            order[at] = i;
        }
}

/* Makes the columns of body c->body (lines of particles along the normal of the face of b). Stores in c->order the
 * particles of p in each column, in ascending height along the outward normal. If b acts on all bodies, the columns
 * include particles of other bodies. */
static void columns_fill(struct columns *c, const struct boundary *b, const struct particles *p)
{
    for (int others = 0; others < (b->body < 0 ? 2 : 1); others++)
        for (int64_t i = 0; i < p->n; i++)
            if ((p->body[i] != c->body) == others) particle_enter(c, b, p, i, false);
    c->start = NEW("loads.start", c->n + 2, int64_t);
    for (int64_t k = 0; k < c->n; k++) c->start[k + 2] = c->start[k + 1] + c->count[k];
    c->order = NEW("loads.order", c->start[c->n + 1], int32_t);
    for (int64_t k = 0; k < p->n; k++) {
        const int64_t i = b->side > 0 ? k : p->n - 1 - k; /* upwards */
        if (p->body[i] == c->body || b->body < 0) particle_enter(c, b, p, i, true);
    }
    for (int64_t k = 0; k < c->n; k++) sort_column(b, p, c->order + c->start[k], c->start[k + 1] - c->start[k]);
}

/* Makes in *c the columns of body `body` of p: lines of particles along the normal of the face of boundary b. spacing:
 * lattice spacing of the scene [m]. Release with loads_columns_free. */
static void loads_columns_make(struct columns *c, const struct boundary *b, const struct particles *p, int body,
                               real spacing)
{
    *c = (struct columns){.body = body, .spacing = spacing};
    find_width(c, b, p);
    find_middles(c, b, p);
    columns_fill(c, b, p);
}

static void loads_columns_free(struct columns *c)
{
    memory_free(c->key);
    memory_free(c->number);
    memory_free(c->count);
    memory_free(c->start);
    memory_free(c->order);
}

/* ---- exposed particles ------------------------------------------------------------------------------------------- */

/* Returns how far particle j of p is behind particle i along the normal of the face of boundary b, divided by their
 * mean width; negative if j is in front. c: lines of particles behind the face, with their widths. */
static real behind(const struct columns *c, const struct boundary *b, const struct particles *p, int32_t i, int32_t j)
{
    return (loads_columns_height(b, p, i) - loads_columns_height(b, p, j)) /
           (0.5 * (width_of(c, b, p, i) + width_of(c, b, p, j)));
}

/* Returns the index in c->order of the highest exposed particle of column `column` (a line of particles normal to the
 * face of b) among those with an index below `from`; -1 if there is none. A particle is exposed if it is selected, and
 * the next particle in front of it in the column is more than GAP particle widths away. selected[p->n]: 1 for particles
 * in the region of b. */
static int64_t exposed_below(const struct columns *c, int64_t column, int64_t from, const struct boundary *b,
                             const struct particles *p, const uint8_t *selected)
{
    const int32_t *order = c->order;
    const int64_t end = c->start[column + 1];
    for (int64_t k = from; k-- > c->start[column];) {
        const bool free = k + 1 == end || behind(c, b, p, order[k + 1], order[k]) > GAP;
        if (selected[order[k]] && free) return k;
    }
    return -1;
}

/* Returns the index in c->order of the exposed particle of column `column` (a line of particles normal to the face of
 * b): the first one seen from outside. Returns -1 if the column has none, or if this particle belongs to another body
 * than c->body. selected[p->n]: 1 for particles in the region of b. */
static int64_t loads_columns_shown(const struct columns *c, int64_t column, const struct boundary *b,
                                   const struct particles *p, const uint8_t *selected)
{
    const int64_t k = exposed_below(c, column, c->start[column + 1], b, p, selected);
    return k >= 0 && p->body[c->order[k]] == c->body ? k : -1;
}

/* Returns the index in c->order of the first particle of column `column` (a line of particles normal to the face of b)
 * that belongs to body c->body and is at least BENEATH particle widths behind particle c->order[k]. Returns -1 if there
 * is none before the column ends or has a hole of more than GAP widths. p: particles. */
static int64_t beneath(const struct columns *c, int64_t column, int64_t k, const struct boundary *b,
                       const struct particles *p)
{
    for (int64_t m = k; m-- > c->start[column];) {
        const real depth = behind(c, b, p, c->order[k], c->order[m]);
        if (depth > GAP) return -1;
        if (depth >= BENEATH && p->body[c->order[m]] == c->body) return m;
    }
    return -1;
}

/* Adds the area of column `column` of c, a line of particles behind the face, to the areas f of its exposed particle,
 * the outermost one [m^2]. A tangential traction acts on the face, half a spacing outside this particle, and its moment
 * would be wrong by this distance. (The shear stress in a plate of n particles per side would be 1 + 1.3/n times too
 * large.) So for tangential components the exposed particle gets 3/2 of the area and the next one in the column -1/2,
 * which preserves force and moment. If there is no next particle or `two` is false, the first one gets all.
 * selected[p->n]: 1 for particles in the region of b; area: of the column [m^2], or 0 to use the volume of the exposed
 * particle divided by its width. */
static void face_add(struct exposed_face *f, const struct columns *c, int64_t column, const struct boundary *b,
                     const struct particles *p, const uint8_t *selected, real area, bool two)
{
    const int64_t k = loads_columns_shown(c, column, b, p, selected),
                  m = k >= 0 && two ? beneath(c, column, k, b, p) : -1;
    if (k < 0) return;
    const int32_t first = c->order[k];
    if (!(area > 0)) area = p->volume0[first] / c->width;
    f->normal[first] += area;
    f->along[first] += area * (m < 0 ? 1 : 1.5);
    if (m >= 0) f->along[c->order[m]] += area * -0.5;
}

/* Returns the cross-section of a column (line of particles normal to the face of b) [m^2]: the volume of a particle
 * divided by its width c->width, or a part of that if there are several columns for each particle width. Returns 0 if
 * boundary b has no section (area or thickness). dim: number of dimensions. */
static real column_area(const struct columns *c, const struct boundary *b, int dim)
{
    if (!(b->section > 0)) return 0;
    const real area = lattice_particle_volume(b->section, c->width, dim) / c->width;
    return c->step == c->width ? area : area * pow(c->step / c->width, dim - 1);
}

/* Iterator over the bodies that have a selected particle; for each one, `columns` are the lines of particles
 * normal to the loaded face. Usage:
 *
 *     for (struct faced f = {0}; faced_next(&f, b, p, selected, spacing);) ... f.columns ... */
struct faced {
    bool known, has[UINT8_MAX + 1]; /* `has` is set; whether body b has a selected particle */
    int next, body;                 /* next body to be examined; present body */
    struct columns columns;
};

/* Makes in f->columns the columns (lines of particles normal to the face of b) of the next body of p that has a
 * selected particle, and frees the previous columns. Before the first call, f must be zero. selected[p->n]: 1 for
 * particles in the region of boundary b; spacing: lattice spacing [m]. Returns false after the last body, with all
 * columns freed. */
static bool faced_next(struct faced *f, const struct boundary *b, const struct particles *p, const uint8_t *selected,
                       real spacing)
{
    if (f->next > 0) loads_columns_free(&f->columns);
    for (int64_t i = 0; !f->known && i < p->n; i++) f->has[p->body[i]] |= selected[i];
    f->known = true;
    while (f->next <= UINT8_MAX && !f->has[f->next]) f->next++;
    if (f->next > UINT8_MAX) return false;
    f->body = f->next++;
    loads_columns_make(&f->columns, b, p, f->body, spacing);
    return true;
}

void boundary_face_visit_surface_particles(const struct boundary *b, const struct particles *p, const uint8_t *selected,
                                           real spacing, face_particle_fn *visit, void *context)
{
    for (struct faced f = {0}; faced_next(&f, b, p, selected, spacing);) {
        const struct columns *c = &f.columns;
        const real area = column_area(c, b, p->dim);
        for (int64_t column = 0; column < c->n; column++)
            for (int64_t k = c->start[column + 1]; (k = exposed_below(c, column, k, b, p, selected)) >= 0;)
                if (p->body[c->order[k]] == f.body)
                    visit(context, c->order[k], area > 0 ? area : p->volume0[c->order[k]] / c->width);
    }
}

void exposed_face_compute_particle_areas(struct exposed_face *f, const struct boundary *b, const struct particles *p,
                                         const uint8_t *selected, real spacing, bool extrapolate_traction)
{
    *f = (struct exposed_face){NEW("loads.normal", p->n, real), NEW("loads.along", p->n, real)};
    for (struct faced of = {0}; faced_next(&of, b, p, selected, spacing);)
        for (int64_t k = 0; k < of.columns.n; k++)
            face_add(f, &of.columns, k, b, p, selected, column_area(&of.columns, b, p->dim), extrapolate_traction);
}

void boundary_face_flag_particles_within_depth(const struct boundary *b, const struct particles *p,
                                               const uint8_t *selected, real spacing, uint8_t *in_layer)
{
    for (struct faced f = {0}; faced_next(&f, b, p, selected, spacing);) {
        const struct columns *c = &f.columns;
        for (int64_t column = 0; column < c->n; column++) {
            const int64_t first = loads_columns_shown(c, column, b, p, selected);
            for (int64_t k = first; k >= 0; k = beneath(c, column, k, b, p)) {
                const real deep = loads_columns_height(b, p, c->order[first]) - loads_columns_height(b, p, c->order[k]);
                if (k != first && deep + 0.5 * c->width > b->depth + LOADS_TOLERANCE * spacing) break;
                in_layer[c->order[k]] |= selected[c->order[k]];
            }
        }
    }
}

void exposed_face_free(struct exposed_face *f)
{
    memory_free(f->normal);
    memory_free(f->along);
}
