/* Finds the particles near faces and their neighbours on the lattice. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "bonds_parts.h"
#include "surface_parts.h"

/* ---- offsets of a full family ------------------------------------------------------------------------------------ */

/* Adds the offset at[dim] [spacings] to the list if it is within the cutoff, with its length, direction and weight.
 * states: the weights are those of state-based models. */
static void offset_add(struct offsets *o, const struct family *f, bool states, const int *at)
{
    real xi[DIM_MAX], length2 = 0;
    for (int d = 0; d < o->dim; d++) xi[d] = at[d] * f->spacing, length2 += square((real)at[d]);
    const real length = sqrt(length2);
    int place = 0;
    for (int d = o->dim - 1; d >= 0; d--) place = place * (2 * o->reach + 1) + o->reach + at[d];
    o->number[place] = -1;
    if (length == 0 || length * f->spacing > f->cutoff) return;
    o->number[place] = o->n;
    memcpy(o->at[o->n], at, sizeof *o->at);
    o->length[o->n] = length;
    for (int d = 0; d < o->dim; d++) o->direction[o->n][d] = at[d] / length;
    for (int d = 0; d < o->dim && length2 == 1; d++)
        if (at[d] != 0) o->axis[d][at[d] > 0] = o->n;
    o->share[o->n] = family_bond_weight(f, xi, length * f->spacing);
    o->weight[o->n] = o->share[o->n] * (states ? length : 1), o->n++;
}

/* Lists the offsets of all neighbours in a full family, with their lengths and weights. states: of state-based
 * models. */
static void offsets_make(struct offsets *o, const struct family *f, bool states)
{
    const int dim = space_dim(f->space), reach = (int)ceil(f->cutoff / f->spacing), side = 2 * reach + 1;
    const int64_t room = (int64_t)side * (dim > 1 ? side : 1) * (dim > 2 ? side : 1);
    *o = (struct offsets){.dim = dim, .reach = reach};
    o->at = (int(*)[DIM_MAX])memory_new("surface.offset", room, sizeof *o->at);
    o->direction = (real(*)[DIM_MAX])memory_new("surface.offset", room, sizeof *o->direction);
    o->length = NEW("surface.offset", room, real), o->weight = NEW("surface.offset", room, real);
    o->share = NEW("surface.offset", room, real);
    o->number = NEW("surface.offset", room, int32_t);
    for (int64_t k = 0; k < room; k++) {
        const int at[DIM_MAX] = {(int)(k % side) - reach, dim > 1 ? (int)(k / side % side) - reach : 0,
                                 dim > 2 ? (int)(k / side / side) - reach : 0};
        offset_add(o, f, states, at);
    }
    o->mirrored = NEW("surface.offset", (int64_t)o->n << dim, int32_t);
    for (int mirrors = 0; mirrors < 1 << dim; mirrors++)
        for (int k = 0; k < o->n; k++) {
            int place = 0;
            for (int d = dim - 1; d >= 0; d--)
                place = place * side + reach + (mirrors >> d & 1 ? -o->at[k][d] : o->at[k][d]);
            o->mirrored[mirrors * o->n + k] = o->number[place];
        }
}

static void offsets_free(struct offsets *o)
{
    memory_free(o->at);
    memory_free(o->direction);
    memory_free(o->length);
    memory_free(o->weight);
    memory_free(o->share);
    memory_free(o->number);
    memory_free(o->mirrored);
}

/* Returns the index of the offset from i to j, -1 if they are not on one lattice. */
static int offset_between(const struct offsets *o, const struct particles *p, real spacing, int64_t i, int64_t j)
{
    int place = 0;
    for (int d = o->dim - 1; d >= 0; d--) {
        const real xi = (p->X[d][j] - p->X[d][i]) / spacing, step = nearbyint(xi);
        if (!(fabs(xi - step) < 1e-6) || fabs(step) > o->reach) return -1;
        place = place * (2 * o->reach + 1) + o->reach + (int)step;
    }
    return o->number[place];
}

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* Returns the particle of the body of which entry j of the particle arrays is an image (j itself, if it is not an
 * image), and the mirrors in between as one bit per reversed axis. */
struct seen mirrored_source_of(const struct near_faces *b, int64_t j)
{
    struct seen to = {image_root(b->p, b->source->image, j), 0};
    for (int d = 0; d < b->p->dim && j >= b->p->n; d++)
        if (fabs(b->p->X[d][j] - b->p->X[d][to.particle]) > 0.25 * b->source->family.spacing) to.mirrors |= 1 << d;
    return to;
}

struct seen mirrored_neighbour(const struct near_faces *b, const struct seen *from, int k)
{
    const int32_t j = neighbour_of(b, b->place[from->particle], b->offset.mirrored[from->mirrors * b->offset.n + k]);
    struct seen to = {-1, 0};
    if (j < 0) return to;
    to = mirrored_source_of(b, j);
    to.mirrors ^= from->mirrors;
    return to;
}

int reverse_offset(const struct near_faces *b, const struct seen *to, int k)
{
    return b->offset.n - 1 - b->offset.mirrored[to->mirrors * b->offset.n + k];
}

/* Parameters and working memory of the neighbour search of one thread. */
struct search {
    const struct site_map *map;
    int32_t *found;
    int room;
};

/* Finds the neighbours of particle i that pre-cracks do not hide, and stores them by offset in to [offsets], -1 where
 * there is none; to NULL: they are only counted. Returns their number, or -1 if one is not on the lattice of the
 * particle. */
static int neighbours_find(const struct near_faces *b, const struct search *search, int64_t i, int32_t *to)
{
    const struct bond_source *s = b->source;
    const int n = find_neighbours_of(search->map, s, b->p, (int32_t)i, search->found, search->room);
    const bool near = cracks_near_particle(s, b->p, i);
    int kept = 0;
    for (int k = 0; to && k < b->offset.n; k++) to[k] = -1;
    for (int k = 0; k < n; k++) {
        const int32_t j = search->found[k];
        if (near && cracks_separate_particles(s->crack, s->cracks, b->p, i, j)) continue;
        const int at = to || kept == 0 ? offset_between(&b->offset, b->p, s->family.spacing, i, j) : 0;
        if (at < 0) return -1;
        if (to) to[at] = j;
        kept++;
    }
    return kept;
}

/* Returns true if the site map shows that particles first .. first + 7 have whole families, with no crack or void near.
 * False means that it is not known. */
static bool eight_whole(const struct near_faces *b, const struct site_map *map, struct regular_bonds *regular,
                        int64_t first)
{
    if (!map->at || first + LANES > b->p->n || !regular_bonds_find(map, b->p, first, regular)) return false;
    bool near = !regular->full || regular->n != b->offset.n;
    for (int l = 0; l < LANES && !near; l++) near = cuts_near_particle(b->source, b->p, first + l);
    return !near;
}

/* Marks the particles with whole families in b->whole. Returns false if a particle is not on the lattice of its
 * neighbours. */
static bool whole_mark(struct near_faces *b, const struct site_map *map)
{
    const int room = bonds_most_neighbours(b->source);
    bool lattice = true;
#pragma omp parallel reduction(&& : lattice)
    {
        struct search search = {map, NEW("surface.found", room, int32_t), room};
        struct regular_bonds regular;
        regular_bonds_make(&regular, map);
#pragma omp for schedule(static)
        for (int64_t first = 0; first < b->p->n; first += LANES) {
            const bool all = eight_whole(b, map, &regular, first);
            for (int64_t i = first; i < first + LANES && i < b->p->n; i++) {
                const int n = all ? b->offset.n : neighbours_find(b, &search, i, NULL);
                b->whole[i] = n == b->offset.n, lattice = lattice && n >= 0;
            }
        }
        regular_bonds_free(&regular);
        memory_free(search.found);
    }
    return lattice;
}

/* Lists the particles near faces, i.e. within the cutoff of a particle or image without a whole family, and their
 * neighbours by offset. Returns false if a neighbour is not on the lattice. */
static bool near_list(struct near_faces *b, const struct site_map *map)
{
    const struct particles *p = b->p;
    const int room = bonds_most_neighbours(b->source);
    uint8_t *near = NEW("surface.near", p->n, uint8_t);
    struct search search = {map, NEW("surface.found", room, int32_t), room};
    for (int64_t i = 0; i < p->n_all; i++) { /* images too: their families reach into the body */
        if (is_whole(b, i)) continue;
        if (i < p->n) near[i] = 1;
        const int n = find_neighbours_of(map, b->source, p, (int32_t)i, search.found, room);
        for (int k = 0; k < n; k++)
            if (search.found[k] < p->n) near[search.found[k]] = 1;
    }
    memory_free(search.found);
    for (int64_t i = 0; i < p->n; i++) b->n += near[i];
    b->particle = NEW("surface.particle", b->n, int32_t);
    b->place = NEW("surface.place", p->n, int32_t);
    for (int64_t i = 0, t = 0; i < p->n; i++) {
        b->place[i] = near[i] ? (int32_t)t : -1;
        if (near[i]) b->particle[t++] = (int32_t)i;
    }
    memory_free(near);
    b->neighbour = BARE("surface.neighbour", b->n * b->offset.n, int32_t);
    bool lattice = true;
#pragma omp parallel reduction(&& : lattice)
    {
        struct search own = {map, NEW("surface.found", room, int32_t), room};
#pragma omp for schedule(static)
        for (int64_t t = 0; t < b->n; t++)
            lattice = neighbours_find(b, &own, b->particle[t], b->neighbour + t * b->offset.n) >= 0 && lattice;
        memory_free(own.found);
    }
    return lattice;
}

/* Finds the first pair of neighbours that is not a whole number of spacings apart along each axis and not separated by
 * a pre-crack. apart: receives both, -1 if there is none. */
static void apart_find(const struct near_faces *b, const struct site_map *map, int64_t apart[2])
{
    const struct bond_source *s = b->source;
    const int room = bonds_most_neighbours(s);
    int32_t *found = NEW("surface.found", room, int32_t);
    apart[0] = apart[1] = -1;
    for (int64_t i = 0; i < b->p->n && apart[0] < 0; i++) {
        const int n = find_neighbours_of(map, s, b->p, (int32_t)i, found, room);
        for (int k = 0; k < n && apart[0] < 0; k++)
            if (offset_between(&b->offset, b->p, s->family.spacing, i, found[k]) < 0 &&
                !(cracks_near_particle(s, b->p, i) &&
                  cracks_separate_particles(s->crack, s->cracks, b->p, i, found[k])))
                apart[0] = i, apart[1] = found[k];
    }
    memory_free(found);
}

status near_faces_make(struct near_faces *b, const struct particles *p, const struct bond_source *s, int64_t apart[2])
{
    struct site_map map = {0};
    *b = (struct near_faces){.p = p, .source = s};
    offsets_make(&b->offset, &s->family, s->modulus != NULL);
    b->whole = NEW("surface.whole", p->n, uint8_t);
    site_map_make(&map, s, p);
    const bool lattice = whole_mark(b, &map) && near_list(b, &map);
    if (!lattice) apart_find(b, &map, apart);
    site_map_free(&map);
    if (lattice) return OK;
    near_faces_free(b);
    return status_set(REFUSED, "pd.surface: moments requires particles on a lattice; volume or none is expected");
}

void near_faces_free(struct near_faces *b)
{
    offsets_free(&b->offset);
    memory_free(b->particle);
    memory_free(b->place);
    memory_free(b->neighbour);
    memory_free(b->whole);
    *b = (struct near_faces){0};
}
