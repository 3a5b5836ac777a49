/* Finds the particles near faces and their neighbours on the lattice. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "bonds_parts.h"
#include "surface_parts.h"

/* ---- offsets of a full neighbourhood ----------------------------------------------------------------------------- */

/* Appends the offset at[dim] [spacings] to the list o, with its length, direction and weight in the neighbourhood f, if
 * it is within the cutoff. Sets its number in o->number, -1 if it is not. states: true if the weights are those of
 * state-based models. */
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

/* Lists in o the lattice offsets of all neighbours in a full neighbourhood f inside a body, with their lengths and
 * weights, and the mirror image of each offset for each set of axes. states: true if the weights are those of
 * state-based models. */
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

/* Returns the index in the list o of the lattice offset from particle i to particle j of p; -1 if they are not a whole
 * number of spacings apart along each axis, or more than o->reach spacings apart along an axis. spacing: lattice
 * spacing [m]. */
static int offset_between(const struct offsets *o, const struct particles *p, real spacing, int64_t i, int64_t j)
{
    int place = 0;
    for (int d = o->dim - 1; d >= 0; d--) {
        const real xi = (p->X[d][j] - p->X[d][i]) / spacing;
        if (!(fabs(xi) < o->reach + 0.5)) return -1;
        const int step = nearest_integer(xi);
        if (!(fabs(xi - step) < 1e-6)) return -1;
        place = place * (2 * o->reach + 1) + o->reach + step;
    }
    return o->number[place];
}

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* Returns the source of the mirror image j (an index of the particle arrays of `near_faces`): a particle of the body,
 * possibly through several mirrors, with the axes that these mirrors reverse (bit d: axis d). */
struct mirrored_particle mirror_image_find_source_and_reversed_axes(const struct particles_near_faces *near_faces,
                                                                    int64_t j)
{
    struct mirrored_particle to = {mirror_image_source_particle(near_faces->p, near_faces->source->image, j), 0};
    for (int d = 0; d < near_faces->p->dim; d++)
        if (fabs(near_faces->p->X[d][j] - near_faces->p->X[d][to.particle]) > 0.25 * near_faces->source->family.spacing)
            to.mirrors |= 1 << d;
    return to;
}

int bond_offset_seen_from_other_particle(const struct particles_near_faces *near_faces,
                                         const struct mirrored_particle *other_particle, int k)
{
    return near_faces->offset.n - 1 - near_faces->offset.mirrored[other_particle->mirrors * near_faces->offset.n + k];
}

/* Parameters and working memory of the neighbour search of one thread, for eight consecutive particles at a time. */
struct search {
    const struct lattice_site_map *map;
    int32_t *found; /* [room] neighbours that a search has found */
    int room;
    int64_t first;                /* first of the eight particles */
    bool eight;                   /* the neighbours of all eight are in `regular`, so that no search is needed */
    struct lattice_bonds regular; /* neighbours of the eight particles on a lattice, regardless of pre-cracks */
};

/* Allocates the working memory of a neighbour search in `search`. near_faces: particles near faces, with the data of
 * bonds; map: map from lattice sites to particles, kept by reference. Release it with search_free. */
static void search_make(struct search *search, const struct particles_near_faces *near_faces,
                        const struct lattice_site_map *map)
{
    const int room = bonds_neighbour_count_upper_bound(near_faces->source);
    *search = (struct search){.map = map, .found = NEW("surface.found", room, int32_t), .room = room};
    lattice_bonds_allocate_for_eight_particles(&search->regular, map);
}

/* Releases the working memory of `search`, a neighbour search. */
static void search_free(struct search *search)
{
    lattice_bonds_free(&search->regular);
    memory_free(search->found);
}

/* Prepares `search` for the particles first .. first + 7. near_faces: particles near faces. Finds the neighbours from
 * the map of lattice sites if the particles are on a regular part of the lattice (search->eight is then true). */
static void search_turn(struct search *search, const struct particles_near_faces *near_faces, int64_t first)
{
    search->first = first;
    search->eight = lattice_bonds_list_neighbours_ignoring_cracks(search->map, near_faces->source, near_faces->p, first,
                                                                  &search->regular);
}

/* Finds the neighbours of particle i among those that a map of lattice sites gave for eight particles that contain i
 * (search->regular, set by search_turn). near_faces: particles near faces, with the pre-cracks; near: true if a
 * pre-crack may separate some of them from i, which are then left out. to[offsets]: receives the neighbours by lattice
 * offset; other entries are unchanged; NULL: neighbours are only counted. Returns the number of neighbours. */
static int regular_neighbours(const struct particles_near_faces *near_faces, const struct search *search, int64_t i,
                              bool near, int32_t *to)
{
    const struct bond_source *s = near_faces->source;
    const struct lattice_bonds *regular = &search->regular;
    const int lane = (int)(i - search->first);
    int kept = 0;
    if (!to && regular->full && !near) return regular->n;
    for (int k = 0; k < regular->n; k++) {
        const int32_t j = (int32_t)i + regular->offset[k];
        if (lane < regular->from[k] || lane > regular->to[k]) continue;
        if (near && precracks_cut_bond_between(s->crack, s->cracks, near_faces->p, i, j)) continue;
        if (to) to[regular->number[k]] = j;
        kept++;
    }
    return kept;
}

/* Finds the neighbours of particle i that no pre-crack separates from it. i must be one of the eight particles for
 * which `search` was prepared last (search_turn). near_faces: particles near faces, with the pre-cracks; to[offsets]:
 * receives the neighbours by lattice offset, -1 for offsets without a neighbour; NULL: neighbours are only counted.
 * Returns their number, or -1 if a neighbour is not on the lattice of the particle. */
static int neighbours_find(const struct particles_near_faces *near_faces, const struct search *search, int64_t i,
                           int32_t *to)
{
    const struct bond_source *s = near_faces->source;
    const bool near = particle_is_near_precrack(s, near_faces->p, i);
    int kept = 0;
    for (int k = 0; to && k < near_faces->offset.n; k++) to[k] = -1;
    if (search->eight) return regular_neighbours(near_faces, search, i, near, to);
    const int n =
        particle_find_neighbours_within_cutoff(search->map, s, near_faces->p, (int32_t)i, search->found, search->room);
    for (int k = 0; k < n; k++) {
        const int32_t j = search->found[k];
        if (near && precracks_cut_bond_between(s->crack, s->cracks, near_faces->p, i, j)) continue;
        const int at =
            to || kept == 0 ? offset_between(&near_faces->offset, near_faces->p, s->family.spacing, i, j) : 0;
        if (at < 0) return -1;
        if (to) to[at] = j;
        kept++;
    }
    return kept;
}

/* Sets near_faces->whole[i] to 1 for particles i that have neighbours at all lattice offsets within the cutoff, else to
 * 0. map: map from lattice sites to particles. Returns false if a particle is not on the lattice. */
static bool whole_mark(struct particles_near_faces *near_faces, const struct lattice_site_map *map)
{
    bool lattice = true;
#pragma omp parallel reduction(&& : lattice)
    {
        struct search search;
        search_make(&search, near_faces, map);
#pragma omp for schedule(static)
        for (int64_t first = 0; first < near_faces->p->n; first += LANES) {
            search_turn(&search, near_faces, first);
            for (int64_t i = first; i < first + LANES && i < near_faces->p->n; i++) {
                const int n = neighbours_find(near_faces, &search, i, NULL);
                near_faces->whole[i] = n == near_faces->offset.n, lattice = lattice && n >= 0;
            }
        }
        search_free(&search);
    }
    return lattice;
}

/* Sets near[i] to 1, which marks a particle near a face, if i is a particle of near_faces->p and not a mirror image.
 * near[particles]: marks. Several threads may set the same entry. */
static void near_put(const struct particles_near_faces *near_faces, uint8_t *near, int64_t i)
{
    if (i >= near_faces->p->n) return;
#pragma omp atomic write
    near[i] = 1;
}

/* Sets near[i] to 1 for the particles i near faces: those without a neighbour at some lattice offset within the cutoff,
 * and their neighbours. Mirror images are examined too, because particles of the body may be their neighbours.
 * near[particles]: 0 before; near_faces: particles, after whole_mark; map: map from lattice sites to particles. */
static void near_mark(uint8_t *near, const struct particles_near_faces *near_faces, const struct lattice_site_map *map)
{
    const struct particles *p = near_faces->p;
#pragma omp parallel
    {
        struct search search;
        search_make(&search, near_faces, map);
        const struct lattice_bonds *regular = &search.regular;
#pragma omp for schedule(static)
        for (int64_t first = 0; first < p->n_all; first += LANES) {
            const int64_t end = first + LANES < p->n_all ? first + LANES : p->n_all;
            bool whole = true;
            for (int64_t i = first; i < end; i++) whole = whole && particle_family_is_complete(near_faces, i);
            if (whole) continue;
            search_turn(&search, near_faces, first);
            for (int64_t i = first; i < end; i++) {
                if (particle_family_is_complete(near_faces, i)) continue;
                const int l = (int)(i - first);
                near_put(near_faces, near, i);
                for (int k = 0; search.eight && k < regular->n; k++)
                    if (l >= regular->from[k] && l <= regular->to[k])
                        near_put(near_faces, near, i + regular->offset[k]);
                const int n = search.eight ? 0
                                           : particle_find_neighbours_within_cutoff(
                                                 map, near_faces->source, p, (int32_t)i, search.found, search.room);
                for (int k = 0; k < n; k++) near_put(near_faces, near, search.found[k]);
            }
        }
        search_free(&search);
    }
}

/* Lists the neighbours of all particles near faces in near_faces->neighbour[near_faces->n, offsets]. map: map from
 * lattice sites to particles. Returns false if a particle is not on the lattice. */
static bool neighbours_list(struct particles_near_faces *near_faces, const struct lattice_site_map *map)
{
    const struct particles *p = near_faces->p;
    bool lattice = true;
    near_faces->neighbour = BARE("surface.neighbour", near_faces->n * near_faces->offset.n, int32_t);
#pragma omp parallel reduction(&& : lattice)
    {
        struct search search;
        search_make(&search, near_faces, map);
#pragma omp for schedule(static)
        for (int64_t first = 0; first < p->n; first += LANES) {
            bool any = false;
            for (int64_t i = first; i < first + LANES && i < p->n; i++) any = any || near_faces->place[i] >= 0;
            if (!any) continue;
            search_turn(&search, near_faces, first);
            for (int64_t i = first; i < first + LANES && i < p->n; i++) {
                if (near_faces->place[i] < 0) continue;
                int32_t *to = near_faces->neighbour + (int64_t)near_faces->place[i] * near_faces->offset.n;
                lattice = neighbours_find(near_faces, &search, i, to) >= 0 && lattice;
            }
        }
        search_free(&search);
    }
    return lattice;
}

/* Lists the particles near faces in near_faces->particle, and their neighbours by lattice offset in
 * near_faces->neighbour. map: map from lattice sites to particles. Returns false if a particle is not on the lattice.
 */
static bool near_list(struct particles_near_faces *near_faces, const struct lattice_site_map *map)
{
    const struct particles *p = near_faces->p;
    uint8_t *near = NEW("surface.near", p->n, uint8_t);
    near_mark(near, near_faces, map);
    for (int64_t i = 0; i < p->n; i++) near_faces->n += near[i];
    near_faces->particle = NEW("surface.particle", near_faces->n, int32_t);
    near_faces->place = NEW("surface.place", p->n, int32_t);
    for (int64_t i = 0, t = 0; i < p->n; i++) {
        near_faces->place[i] = near[i] ? (int32_t)t : -1;
        if (near[i]) near_faces->particle[t++] = (int32_t)i;
    }
    memory_free(near);
    return neighbours_list(near_faces, map);
}

/* Finds the first pair of neighbours whose distance along some axis is not a whole number of spacings, and which no
 * pre-crack separates. near_faces: particles near faces; map: map from lattice sites to particles; apart[2]: receives
 * both particles, -1 if there is no such pair. */
static void apart_find(const struct particles_near_faces *near_faces, const struct lattice_site_map *map,
                       int64_t apart[2])
{
    const struct bond_source *s = near_faces->source;
    const int room = bonds_neighbour_count_upper_bound(s);
    int32_t *found = NEW("surface.found", room, int32_t);
    apart[0] = apart[1] = -1;
    for (int64_t i = 0; i < near_faces->p->n && apart[0] < 0; i++) {
        const int n = particle_find_neighbours_within_cutoff(map, s, near_faces->p, (int32_t)i, found, room);
        for (int k = 0; k < n && apart[0] < 0; k++)
            if (offset_between(&near_faces->offset, near_faces->p, s->family.spacing, i, found[k]) < 0 &&
                !(particle_is_near_precrack(s, near_faces->p, i) &&
                  precracks_cut_bond_between(s->crack, s->cracks, near_faces->p, i, found[k])))
                apart[0] = i, apart[1] = found[k];
    }
    memory_free(found);
}

status particles_near_faces_list_with_neighbours(struct particles_near_faces *near_faces, const struct particles *p,
                                                 const struct bond_source *s, int64_t unfitting_pair[2])
{
    struct lattice_site_map map = {0};
    *near_faces = (struct particles_near_faces){.p = p, .source = s};
    offsets_make(&near_faces->offset, &s->family, s->modulus != NULL);
    near_faces->whole = NEW("surface.whole", p->n, uint8_t);
    lattice_site_map_make_if_particles_fit_lattice(&map, s, p);
    const bool lattice = whole_mark(near_faces, &map) && near_list(near_faces, &map);
    if (!lattice) apart_find(near_faces, &map, unfitting_pair);
    lattice_site_map_free(&map);
    if (lattice) return OK;
    particles_near_faces_free(near_faces);
    return status_set(REFUSED,
                      "pd.surface: moments needs particles on a regular lattice; set pd.surface: volume or none");
}

void particles_near_faces_free(struct particles_near_faces *near_faces)
{
    offsets_free(&near_faces->offset);
    memory_free(near_faces->particle);
    memory_free(near_faces->place);
    memory_free(near_faces->neighbour);
    memory_free(near_faces->whole);
    *near_faces = (struct particles_near_faces){0};
}
