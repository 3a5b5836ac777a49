/* Computes the partial stress on a lattice by the table of partial_table.c. The responses of the bonds of each material
 * point to strain are stored; the tensor of a point is computed from responses summed by bond direction and a few dozen
 * tabulated tensors. */
#include "bonds/sites.h"
#include "base/memory.h"
#include "partial_table_internal.h"

enum { ROWS_AHEAD = 6 }; /* distance of prefetching: bond responses are in outer caches */

/* Returns the number of a lattice site in table t, from 0; -1 if the site is outside the table. The table is a cube of
 * sites around a centre. from[dim]: position of the site at which the centre is placed [m]; to[dim]: position of the
 * site whose number is returned [m]. */
static inline int64_t place_between(const struct bond_fraction_table *t, const real *from, const real *to)
{
    int64_t place = 0;
    for (int d = t->dim - 1; d >= 0; d--) {
        /* rounded to whole spacings, 0 at -reach */
        const int k = (int)((to[d] - from[d]) * t->per_spacing + (t->reach + 1.5)) - 1;
        if (k < 0 || k > 2 * t->reach) return -1;
        place = place * (2 * t->reach + 1) + k;
    }
    return place;
}

/* ---- bond responses ---------------------------------------------------------------------------------------------- */

static real *response_at(const struct bond_fraction_table *t, int64_t k)
{
    return t->responses.response + k * t->vectors * t->parts;
}

/* Reserves memory in t->responses for `open` rows (a row has the bonds of one particle). A row has an entry of
 * t->vectors responses to strain (struct bond_strain_response), one for each possible bond vector on the lattice. Does
 * nothing if the memory suffices. */
static void responses_room(struct bond_fraction_table *t, int64_t open)
{
    struct responses *a = &t->responses;
    const int64_t each = (int64_t)t->vectors * t->parts;
    if (open <= a->room) return;
    const int64_t room = 2 * open; /* only entries that are written take memory */
    a->response = a->response ? memory_resize_uninitialised("partial.answer", a->response, a->room * each, room * each,
                                                            sizeof *a->response)
                              : memory_new_lazy_uninitialised("partial.answer", room * each, sizeof *a->response);
    a->free = memory_resize("partial.free", a->free, a->room, room, sizeof *a->free);
    a->room = room;
}

/* Assigns an entry of t->responses to particle i, for the responses of its bonds to strain (struct
 * bond_strain_response). Reuses a released entry if there is one. Does nothing if the particle has an entry. Call
 * responses_room before. */
static void response_open(struct bond_fraction_table *t, int64_t i)
{
    struct responses *a = &t->responses;
    if (a->of[i] < 0) a->of[i] = a->frees > 0 ? a->free[--a->frees] : (int32_t)a->n++;
}

/* Releases the entry of particle i in t->responses (responses of its bonds to strain) for use by another particle. Does
 * nothing if it has none. */
static void response_close(struct bond_fraction_table *t, int64_t i)
{
    struct responses *a = &t->responses;
    if (a->of[i] < 0) return;
    a->free[a->frees++] = a->of[i];
    a->of[i] = -1;
}

/* Computes the responses to strain (struct bond_strain_response) of the bonds in row `row` of b, the bonds of one
 * particle of p. t: table of bond vectors; s: law of the bonds; response[vectors][parts]: receives the responses, by
 * the number of the bond's vector on the lattice; 0 for broken bonds and for vectors without a bond. */
static void response_make(const struct bond_fraction_table *t, const struct particles *p, const struct bonds *b,
                          const struct bond_source *s, int64_t row, real *response)
{
    real X[DIM_MAX];
    array_fill_bytes(response, 0, t->vectors * t->parts, sizeof *response);
    particle_reference_position(p, b->particle[row], X);
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond bond = it.bond;
        real to[DIM_MAX];
        if (bond.w == 0) continue;
        particle_reference_position(p, bond.nbr, to);
        const int64_t place = place_between(t, X, to);
        INVARIANT(place >= 0 && t->vector[place] >= 0);
        const struct bond_strain_response r = bond_force_derivative_by_strain(p, b, s, b->particle[row], &bond);
        real *part = response + t->vector[place] * t->parts;
        part[0] = s->rotates ? r.vector : r.central;
        if (t->parts > 1) part[1] = r.pressure;
    }
}

/* Result of the last query of partial_table_has_bonds, kept because the next query mostly concerns the same block of
 * eight bond rows. rows: bit l is set if row l of the block has an intact bond. */
struct row_block_intact {
    int64_t row_block;
    unsigned rows;
};

/* Returns true if particle i of p is a material point with an intact bond in b. *last: result for the last block of
 * eight rows queried (rows of eight particles stored together), updated. */
static bool partial_table_has_bonds(struct row_block_intact *last, const struct particles *p, const struct bonds *b,
                                    int64_t i)
{
    const int64_t row = b->row_of[i], row_block = row / LANES;
    if (p->kind[i] != KIND_MPM || row < 0) return false;
    if (last->row_block != row_block)
        *last = (struct row_block_intact){row_block, bond_row_block_intact_bond_lane_mask(b, row_block)};
    return last->rows >> row % LANES & 1;
}

void bond_fraction_table_update_strain_responses(struct bond_fraction_table *t, const struct particles *p,
                                                 const struct bonds *b, const struct bond_source *s,
                                                 const int32_t *point_list, int64_t point_count)
{
    struct responses *a = &t->responses;
    struct row_block_intact last = {.row_block = -1};
    if (!point_list) {
        a->n = a->frees = 0;
        for (int64_t i = 0; i < p->n; i++) a->of[i] = -1;
        point_list = p->list[KIND_MPM], point_count = p->n_of[KIND_MPM];
    }
    int64_t more = 0;
    bool *has = NEW("partial.has", point_count, bool);
    for (int64_t k = 0; k < point_count; k++) {
        has[k] = partial_table_has_bonds(&last, p, b, point_list[k]);
        if (!has[k])
            response_close(t, point_list[k]);
        else
            more += a->of[point_list[k]] < 0;
    }
    responses_room(t, a->n - a->frees + more);
    for (int64_t k = 0; k < point_count; k++)
        if (has[k]) response_open(t, point_list[k]);
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t k = 0; k < point_count; k++)
        if (has[k]) response_make(t, p, b, s, b->row_of[point_list[k]], response_at(t, a->of[point_list[k]]));
    memory_free(has);
}

/* ---- one point --------------------------------------------------------------------------------------------------- */

/* A particle or mirror image j whose bonds may cross the cell of a material point, because the cell is within a bond
 * length. place: number of its lattice site in the table with that point at the centre; response: entry of its bond
 * responses to strain. */
struct crossing_row {
    int32_t j, place, response;
};

/* Adds to sum[directions][parts] the responses to strain of the bonds of one particle, each times the fraction of the
 * bond inside the cell of a material point. place: number of the particle's site in table t with the material point at
 * its centre; response[vectors][parts]: responses of the particle's bonds; signs: axes along which a mirror image is
 * reflected, one bit each; parts: t->parts, known at compile time. */
static ALWAYS_INLINE void sum_row(const struct bond_fraction_table *t, real *sum, int64_t place, const real *response,
                                  int signs, const int parts)
{
    const int16_t *mirror = t->mirror + signs * t->vectors;
    for (int32_t c = t->start[place]; c < t->start[place + 1]; c++) {
        const struct crossing *x = &t->crossing[c];
        const real *part = response + mirror[x->vector] * parts;
        for (int k = 0; k < parts; k++) sum[x->direction * parts + k] += x->share * part[k];
    }
}

/* Prefetches the responses to strain that sum_row reads from table t for *row, the bonds of one particle, into the
 * cache. It has no other effect. */
static ALWAYS_INLINE void row_fetch(const struct bond_fraction_table *t, const struct crossing_row *row)
{
    const real *response = response_at(t, row->response);
    for (int32_t c = t->start[row->place]; c < t->start[row->place + 1]; c++)
        __builtin_prefetch(response + t->crossing[c].vector * t->parts);
}

/* Adds the sum of sum[k] tensor_k over all k to T[t->size]. A number k stands for a direction of bonds and a part of
 * their response to strain. sum[directions][parts]: summed responses; tensor_k: stiffness of a bond with a unit
 * response, from t->tensor. */
static void sum_tensors(const struct bond_fraction_table *t, const real *sum, real *T)
{
    for (int k = 0; k < t->directions * t->parts; k++) {
        const real *tensor = t->tensor + (int64_t)k * t->size;
        if (sum[k] == 0) continue;
        for (int c = 0; c < t->size; c++) T[c] += sum[k] * tensor[c];
    }
}

/* Inserts particle or mirror image j of p into to[n], a list in ascending order of j, if its bonds may cross the cell
 * of a material point: if j is a material point, or the image of one, whose bond responses are stored in t. s: list of
 * the images; place: number of the site of j in the table with that material point at its centre. Returns the new
 * length of the list. */
static int crossing_row_add(const struct bond_fraction_table *t, const struct particles *p, const struct bond_source *s,
                            int32_t j, int64_t place, struct crossing_row *to, int n)
{
    const int32_t response =
        p->kind[j] == KIND_MPM ? t->responses.of[mirror_image_source_particle(p, s->image, j)] : -1;
    int at = n;
    if (response < 0) return n;
    for (; at > 0 && to[at - 1].j > j; at--) to[at] = to[at - 1];
    to[at] = (struct crossing_row){j, (int32_t)place, response};
    return n + 1;
}

/* Lists the particles and mirror images whose bonds may cross the cell of material point i of p in `to`, in ascending
 * order. l: map from lattice sites to particles, in which the sites of table t are looked up; s: list of the images.
 * Sites are visited in the order of the particles, so that only images have to be inserted between others. Returns the
 * number of listed particles, at most t->vectors + 1. */
static int crossing_rows_by_site(const struct bond_fraction_table *t, const struct lattice_site_map *l,
                                 const struct particles *p, const struct bond_source *s, int64_t i,
                                 struct crossing_row *to)
{
    const int32_t *own = l->at + lattice_site_map_site_of_particle(l, p, i);
    int n = 0;
    for (int k = 0; k <= t->vectors; k++) {
        const struct near_place *near = &t->near[k];
        const int32_t j = own[near->at[0] + near->at[1] * l->stride[1] + near->at[2] * l->stride[2]] - 1;
        if (j >= 0) n = crossing_row_add(t, p, s, j, near->place, to, n);
    }
    return n;
}

/* Lists the particles and mirror images whose bonds may cross the cell of material point i of p in `to`, in ascending
 * order, found by a neighbour search: for particles without a map of lattice sites. t: table of bond responses; s:
 * cells of the search; near: working memory. Returns the number of listed particles. */
static int crossing_rows_by_search(const struct bond_fraction_table *t, const struct particles *p,
                                   const struct bond_source *s, int64_t i, struct neighbour_list *near,
                                   struct crossing_row *to)
{
    real X[DIM_MAX], Y[DIM_MAX];
    int n = 0;
    particle_reference_position(p, i, X);
    particles_list_neighbours_within_radius(near, s->cells, p, i, s->family.cutoff, true);
    for (int k = 0; k < near->n; k++) {
        const int32_t j = near->at[k];
        if (p->body[j] != p->body[i]) continue;
        particle_reference_position(p, j, Y);
        n = crossing_row_add(t, p, s, j, place_between(t, X, Y), to, n);
    }
    return n;
}

void bond_fraction_table_sum_cell_stiffness_reduction(const struct bond_fraction_table *t, const struct particles *p,
                                                      const struct bonds *b, const struct bond_source *s, int64_t point,
                                                      struct neighbour_list *near, real *tensor)
{
    real sum[VECTORS_MOST];
    struct crossing_row row[VECTORS_MOST + 1];
    const bool mapped = b->site_map && b->site_map->at;
    const int rows = mapped ? crossing_rows_by_site(t, b->site_map, p, s, point, row)
                            : crossing_rows_by_search(t, p, s, point, near, row);
    array_fill_bytes(sum, 0, t->directions * t->parts, sizeof *sum);
    for (int k = 0; k < rows; k++) {
        const real *response = response_at(t, row[k].response);
        if (k + ROWS_AHEAD < rows) row_fetch(t, &row[k + ROWS_AHEAD]);
        int signs = 0;
        if (row[k].j >= p->n) {
            const struct reflection r = mirror_image_reflection_from_source_particle(s, p, row[k].j);
            for (int d = 0; d < t->dim; d++) signs |= (r.sign[d] < 0) << d;
        }
        if (t->parts == 1)
            sum_row(t, sum, row[k].place, response, signs, 1);
        else
            sum_row(t, sum, row[k].place, response, signs, 2);
    }
    sum_tensors(t, sum, tensor);
}
