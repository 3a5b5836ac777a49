/* Finds the bonds of particles on a lattice by a map from lattice sites to particles, for eight consecutive particles
 * at a time and without a search. Lengths and weights are bitwise equal to those computed for one particle. Particles
 * at ends of lattice rows, at cracks and beside mirror images are left to the neighbour search. */
#include "bonds_parts.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "bonds/surface.h"

/* Smallest allowed difference between the cutoff and the distance of a lattice site [spacings]; if a site is closer to
 * the cutoff, no map is made. Particles may be LATTICE_NEAR off their sites, so round-off does not decide whether a
 * site is within the cutoff. Horizons of whole spacings (tolerance 1e-7) are allowed. */
#define BAND (4 * LATTICE_NEAR)
enum { HALF_MOST = 16 }; /* largest reach of bonds for which blocks of eight rows are made from a map [spacings] */

/* Largest number of lattice sites per particle for which a map of the sites is made. Memory pages of the map without
 * particles are not written, so that sparse bodies need little memory. */
#define SPARSE_MOST 256.0

/* ---- the map of sites -------------------------------------------------------------------------------------------- */

/* Returns the index in `map` of the lattice site at the reference position of particle or mirror image number
 * `particle` of p; -1 if the position is not a lattice site. */
int64_t lattice_site_map_site_of_particle(const struct lattice_site_map *map, const struct particles *p,
                                          int64_t particle)
{
    int64_t site = 0;
    for (int d = 0; d < p->dim; d++) {
        real k;
        if (!lattice_contains_coordinate(p->X[d][particle], map->low[d], map->spacing, &k)) return -1;
        site += map->stride[d] * (map->reach + (int64_t)k);
    }
    return site;
}

/* Computes the smallest box of lattice sites that contains the particles and mirror images of p and a margin of
 * l->reach sites (length of the longest bond): its lower corner without the margin, l->low [m], and the index strides
 * l->stride. Returns the number of sites in the box, or 0 if the box has more than about SPARSE_MOST sites per particle
 * or image, too many for a map. */
static int64_t box_sites(struct lattice_site_map *l, const struct particles *p)
{
    real site_count = 1;
    for (int d = 0; d < p->dim; d++) {
        real high;
        particles_coordinate_range(p, p->n_all, d, &l->low[d], &high);
        l->stride[d] = (int64_t)site_count;
        site_count *= nearbyint((high - l->low[d]) / l->spacing) + 1 + 2 * l->reach;
        if (!(site_count <= SPARSE_MOST * (real)p->n_all + 4096)) return 0;
    }
    return (int64_t)site_count;
}

/* Lists in l->row the sites within the cutoff of a site, as one segment on each lattice row along x, in ascending
 * order. dim: number of dimensions; f: neighbourhood, with cutoff and spacing. Returns false if a site is so close to
 * the cutoff that round-off would decide whether it is inside. */
static bool site_offsets_make(struct lattice_site_map *l, const struct family *f, int dim)
{
    const int high = dim > 2 ? l->reach : 0, wide = dim > 1 ? l->reach : 0;
    l->row = NEW("site_map.row", (2 * high + 1) * (2 * wide + 1), struct stencil_row);
    for (int c = -high; c <= high; c++)
        for (int b = -wide; b <= wide; b++) {
            int half = -1;
            for (int a = 0; a <= l->reach; a++) {
                const real r = sqrt(square(a) + square(b) + square(c)), limit = f->cutoff / f->spacing;
                if (fabs(r - limit) <= BAND) return false;
                if (r < limit) half = a;
            }
            if (half < 0) continue;
            l->row[l->rows++] = (struct stencil_row){b * l->stride[1] + c * l->stride[2], half};
            l->most += 2 * half + 1;
        }
    return true;
}

/* Enters all particles and mirror images of p in the array l->at of the map of lattice sites: their index plus 1 (0: no
 * particle). Returns false if the map cannot be used: a particle or image is off the lattice or shares its site with
 * another one, p has several bodies, or the particles are not numbered in the order of their sites. */
static bool sites_fill(struct lattice_site_map *l, const struct particles *p)
{
    bool regular = true;
#pragma omp parallel for schedule(static) reduction(&& : regular)
    for (int64_t i = 0; i < p->n; i++) {
        const int64_t site = lattice_site_map_site_of_particle(l, p, i);
        regular = regular && site >= 0 && (i == 0 || lattice_site_map_site_of_particle(l, p, i - 1) < site) &&
                  p->body[i] == p->body[0];
        if (site >= 0) l->at[site] = (int32_t)i + 1;
    }
    for (int64_t k = p->n; k < p->n_all && regular; k++) {
        const int64_t site = lattice_site_map_site_of_particle(l, p, k);
        regular = site >= 0 && l->at[site] == 0;
        if (regular) l->at[site] = (int32_t)k + 1;
    }
    return regular;
}

/* Returns true if the reference coordinates of all particles p along axis d differ from the lowest one by exact
 * multiples of one step, without round-off; equal distances on the lattice are then equal to the last bit. Coordinates
 * are compared as whole numbers of units in the last place of the largest coordinate. l: map, with the spacing of the
 * lattice. */
static bool axis_exact(const struct lattice_site_map *l, const struct particles *p, int d)
{
    real low, high;
    particles_coordinate_range(p, p->n, d, &low, &high);
    const real power = exp2(ceil(log2(real_max(fabs(low), fabs(high))))), unit = power * 0x1p-53,
               step_count = nearbyint((high - low) / l->spacing);
    if (step_count == 0) return low == high;
    if (real_min(high - low, l->reach * l->spacing) > power) return false; /* a difference would be rounded */
    const int64_t from = (int64_t)(low / unit), step = ((int64_t)(high / unit) - from) / (int64_t)step_count;
    bool exact = true;
#pragma omp parallel for schedule(static) reduction(&& : exact)
    for (int64_t i = 0; i < p->n; i++) {
        const real place = p->X[d][i] / unit, k = nearbyint((p->X[d][i] - low) / l->spacing);
        exact = exact && place == (real)(int64_t)place && (int64_t)place - from == (int64_t)k * step;
    }
    return exact;
}

/* Returns true if all particles of p (but mirror images) have the same volume, mass and material, and reference
 * positions that are exact multiples of a step: equal distances are then equal to the last bit. l: map, with the
 * spacing of the lattice. Mirror images do not matter, as lattice_bonds leaves them out. */
static bool is_uniform(const struct lattice_site_map *l, const struct particles *p)
{
    bool same = true;
#pragma omp parallel for schedule(static) reduction(&& : same)
    for (int64_t i = 0; i < p->n; i++)
        same = same && p->volume0[i] == p->volume0[0] && p->material[i] == p->material[0] && p->mass[i] == p->mass[0];
    for (int d = 0; d < p->dim && same; d++) same = axis_exact(l, p, d);
    return same;
}

bool lattice_site_map_make_if_particles_fit_lattice(struct lattice_site_map *map, const struct bond_source *s,
                                                    const struct particles *p)
{
    const struct family *f = &s->family;
    *map = (struct lattice_site_map){.spacing = f->spacing, .reach = (int)floor(f->cutoff / f->spacing)};
    if (p->n < LANES || map->reach > HALF_MOST || map->reach < 1 || s->yield.stretch) return false;
    const int64_t site_count = box_sites(map, p);
    if (site_count > 0 && site_offsets_make(map, f, p->dim)) {
        map->at = BLANK("site_map.at", site_count, int32_t);
        if (sites_fill(map, p)) {
            map->uniform = is_uniform(map, p);
            return true;
        }
    }
    lattice_site_map_free(map);
    return false;
}

void lattice_site_map_free(struct lattice_site_map *map)
{
    memory_free(map->at);
    memory_free(map->row);
    *map = (struct lattice_site_map){0};
}

struct lattice_site_map *lattice_site_map_add_reference_or_make(struct lattice_site_map *existing,
                                                                const struct bond_source *s, const struct particles *p)
{
    struct lattice_site_map *l = existing ? existing : NEW("bonds.sites", 1, struct lattice_site_map);
    if (!existing) lattice_site_map_make_if_particles_fit_lattice(l, s, p);
    l->users++;
    return l;
}

void lattice_site_map_release_reference(struct lattice_site_map *map)
{
    if (!map || --map->users > 0) return;
    lattice_site_map_free(map);
    memory_free(map);
}

int lattice_site_map_list_neighbours_of_particle(const struct lattice_site_map *map, const struct particles *p,
                                                 int32_t particle, int32_t *neighbour)
{
    const int32_t *own = map->at + lattice_site_map_site_of_particle(map, p, particle);
    int n = 0;
    for (int k = 0; k < map->rows; k++)
        for (int a = -map->row[k].half; a <= map->row[k].half; a++) {
            const int32_t j = own[map->row[k].site + a] - 1;
            if (j < 0 || j == particle) continue;
            if (j >= p->n) return -1;
            neighbour[n++] = j;
        }
    return n;
}

/* ---- eight particles --------------------------------------------------------------------------------------------- */

/* Appends to *to the bonds from particles i .. i + 7 of p to their neighbours on one line of the lattice parallel to x.
 * l: map from lattice sites to particles; site: index in the map of the site of particle i; row: the sites of the line
 * within the cutoff, relative to that site; number: number of neighbours that a full neighbourhood has on all lines
 * before this one. Returns false if the particles on the line do not have consecutive indices. */
static bool row_bonds(const struct lattice_site_map *l, const struct particles *p, int64_t site,
                      const struct stencil_row *row, int64_t i, int number, struct lattice_bonds *to)
{
    const int32_t *line = l->at + site + row->site - row->half;
    int first = 0, last = 2 * row->half + LANES - 1;
    while (first <= last && line[first] == 0) first++;
    while (last > first && line[last] == 0) last--;
    if (first > last) return true;
    if (line[last] > p->n || line[last] - line[first] != last - first) return false;
    const int64_t base = line[first] - 1 - first;
    for (int k = 0; k <= 2 * row->half; k++) {
        const int from = first - k > 0 ? first - k : 0, to_lane = last - k < LANES - 1 ? last - k : LANES - 1;
        if (from > to_lane || (row->site == 0 && k == row->half)) continue;
        if (base + k < 0 || base + k + LANES > p->n_all) return false;
        to->number[to->n] = (int16_t)(number + k - (row->site == 0 && k > row->half));
        to->offset[to->n] = (int32_t)(base + k - i);
        to->from[to->n] = (uint8_t)from, to->to[to->n++] = (uint8_t)to_lane;
    }
    return true;
}

/* Returns true if each of the eight consecutive particles whose bonds are in b has a neighbour at every index distance
 * (neighbour minus particle) in b->offset. */
static bool is_full(const struct lattice_bonds *b)
{
    unsigned other = 0;
    for (int k = 0; k < b->n; k++) other |= b->from[k] | (b->to[k] ^ (LANES - 1u));
    return other == 0;
}

bool lattice_bonds_list_neighbours_by_offset(const struct lattice_site_map *map, const struct particles *p,
                                             int64_t first_particle, struct lattice_bonds *found_bonds)
{
    const int64_t site = lattice_site_map_site_of_particle(map, p, first_particle);
    int number = 0;
    found_bonds->n = 0;
    if (map->at[site + LANES - 1] - map->at[site] != LANES - 1) return false;
    for (int k = 0; k < map->rows; k++) {
        if (!row_bonds(map, p, site, &map->row[k], first_particle, number, found_bonds)) return false;
        number += 2 * map->row[k].half + (map->row[k].site != 0);
    }
    found_bonds->full = is_full(found_bonds);
    if (found_bonds->full) return eight_bond_rows_are_compact_as_lattice_columns(found_bonds->n, found_bonds->n);
    int bonds[LANES] = {0}, longest = 0;
    for (int k = 0; k < found_bonds->n; k++)
        for (int lane = 0; lane < LANES; lane++)
            bonds[lane] += lane >= found_bonds->from[k] && lane <= found_bonds->to[k];
    for (int lane = 0; lane < LANES; lane++) longest = bonds[lane] > longest ? bonds[lane] : longest;
    return eight_bond_rows_are_compact_as_lattice_columns(found_bonds->n, longest);
}

bool lattice_bonds_list_neighbours_ignoring_cracks(const struct lattice_site_map *map, const struct bond_source *source,
                                                   const struct particles *p, int64_t first_particle,
                                                   struct lattice_bonds *found_bonds)
{
    if (!map->at || first_particle + LANES > p->n ||
        !lattice_bonds_list_neighbours_by_offset(map, p, first_particle, found_bonds))
        return false;
    for (int lane = 0; lane < LANES; lane++)
        if (particle_is_beside_void(source->voids, first_particle + lane)) return false;
    return true;
}

void lattice_bonds_allocate_for_eight_particles(struct lattice_bonds *bonds, const struct lattice_site_map *l)
{
    bonds->offset = NEW("site_map.offset", l->most, int32_t);
    bonds->number = NEW("site_map.number", l->most, int16_t);
    bonds->from = NEW("site_map.from", l->most, uint8_t);
    bonds->to = NEW("site_map.to", l->most, uint8_t);
    bonds->bonds = NEW("site_map.bonds", l->most, uint8_t);
    bonds->stencil_cache = stencil_cache_make_for_thread(l);
}

void lattice_bonds_free(struct lattice_bonds *bonds)
{
    memory_free(bonds->offset);
    memory_free(bonds->number);
    memory_free(bonds->from);
    memory_free(bonds->to);
    memory_free(bonds->bonds);
    stencil_cache_free(bonds->stencil_cache);
}

/* Computes inverse length [1/m] and weight [1] of the bonds from particle i + l to j + l of p for l = 0 .. 7, in
 * inverse[8] and w[8]. The numbers have the same bits as those of row_weigh, which handles one particle. s:
 * neighbourhood and materials; pairs: stiffness by pair of materials, divided by that of material 0; dim: number of
 * dimensions, known at compile time. */
static ALWAYS_INLINE void weigh(const struct bond_source *s, const struct particles *p,
                                const struct material_pair_table *pairs, int64_t i, int64_t j, real *inverse, real *w,
                                const int dim)
{
    const struct family *f = &s->family;
    const real *volume = p->volume0, *around = s->neighbour_volume;
    real xi[DIM_MAX][LANES], r[LANES];
    int same = 1;
    for (int l = 0; l < LANES; l++) {
        w[l] = f->shell_weight[0];
        for (int d = 0; d < dim; d++) xi[d][l] = p->X[d][j + l] - p->X[d][i + l], same &= xi[d][l] == xi[d][0];
    }
    for (int l = 0; l < LANES; l++) { /* with exact positions all lanes have equal length and weight */
        real r2 = 0;
        for (int d = 0; d < dim; d++) r2 += square(xi[d][l]);
        r[l] = same && l > 0 ? r[0] : sqrt(r2);
        inverse[l] = same && l > 0 ? inverse[0] : 1 / r[l];
    }
    for (int l = 0; l < LANES && !family_bonds_have_equal_weights(f); l++) {
        real one[DIM_MAX];
        for (int d = 0; d < dim; d++) one[d] = xi[d][l];
        w[l] = same && l > 0 ? w[0] : family_bond_weight(f, one, r[l]);
    }
    for (int l = 0; l < LANES; l++) w[l] *= (volume[i + l] * volume[j + l]) / square(f->cell_volume);
    if (pairs->materials == 1)
        for (int l = 0; l < LANES; l++) w[l] *= pairs->ratio[0];
    else
        for (int l = 0; l < LANES; l++)
            w[l] *= pairs->ratio[p->material[i + l] * pairs->materials + p->material[j + l]];
    if (around)
        for (int l = 0; l < LANES; l++) w[l] *= 2 * f->full / (around[i + l] + around[j + l]);
    for (int l = 0; l < LANES && s->surface; l++) {
        real one[DIM_MAX];
        for (int d = 0; d < dim; d++) one[d] = xi[d][l];
        w[l] *= surface_correction_bond_weight_factor(s->surface, i + l, one);
    }
}

void lattice_bonds_compute_eight_lengths_and_weights(const struct bond_source *source, const struct particles *p,
                                                     const struct material_pair_table *pairs, int64_t first_particle,
                                                     int64_t first_neighbour, real *inverse_length, real *w)
{
    switch (p->dim) {
    case 1:
        weigh(source, p, pairs, first_particle, first_neighbour, inverse_length, w, 1);
        break;
    case 2:
        weigh(source, p, pairs, first_particle, first_neighbour, inverse_length, w, 2);
        break;
    default:
        weigh(source, p, pairs, first_particle, first_neighbour, inverse_length, w, 3);
        break;
    }
}
