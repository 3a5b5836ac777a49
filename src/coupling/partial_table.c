/* Partial stress on a lattice. The share of a bond inside the cell of a point depends only on the start of the bond
 * relative to the point and on the vector of the bond: shares and the tensors of all directions are tabulated once. For
 * each point there remain a sum of bond responses by direction, and a sum of a few dozen tensors. */
#include <math.h>
#include <string.h>

#include "bonds/sites.h"
#include "base/memory.h"
#include "partial_parts.h"

#define WHOLE 1e-12 /* tolerance of the volume of a lattice cell [1]: round-off */
enum { VECTORS_MOST = 2048, BODIES_MOST = UINT8_MAX + 1 }; /* largest number of bond vectors; of bodies */
enum { ROWS_AHEAD = 6 }; /* distance of prefetching: bond responses are in outer caches */

/* Fraction of the length of a bond that is inside the cell of a point, for one bond that crosses the cell. vector,
 * direction: numbers of the vector and of the direction of the bond. Crossings are listed by the site at which the bond
 * starts. */
struct crossing {
    int16_t vector, direction;
    real share;
};

/* A lattice site that is within the length of a bond from a point, or the site of the point itself. place: number of
 * the site; at: offset from the point [spacings]. */
struct near_place {
    int16_t place, at[DIM_MAX];
};

/* Responses to strain (struct bond_strain_response) of the bonds of all rows of material points, in one entry per row,
 * by the number of the bond's vector. The values of a row are valid until one of its bonds changes. */
struct responses {
    int32_t *of;    /* [n] entry of a particle, -1: no row with an intact bond */
    real *response; /* [room][vectors][parts] */
    int64_t n, room, frees;
    int32_t *free; /* [room] unused entries, the first `frees` */
};

/* Table for one lattice: the fractions of all possible bonds inside the cell of a point, and the tensors of these
 * bonds. Sites are numbered like the cells of a cube with the point in the middle and `reach` cells on either side. */
struct bond_fraction_table {
    int dim, reach, parts, size; /* dimension; reach of bonds [cells]; parts of a response; values of a tensor */
    real spacing, per_spacing;   /* lattice spacing [m]; 1/spacing [1/m] */
    int vectors, directions;     /* vectors of bonds; directions, i.e. pairs of a vector and its opposite */
    struct near_place *near;     /* [vectors + 1] sites within the length of a bond, ascending by number */
    int16_t *vector;             /* [sites] number of the vector to a site, -1: no bond */
    int16_t *mirror;             /* [2^dim][vectors] number of the vector with reversed signs */
    int32_t *start;              /* [sites + 1] crossings of bonds from a site: start[k] .. start[k + 1] - 1 */
    struct crossing *crossing;   /* bonds that cross the cell of the point */
    real *tensor;                /* [directions][parts][size] tensors of unit responses */
    bool uniform;                /* all particles have the volume of a lattice cell */
    struct responses responses;
};

/* ---- sites ------------------------------------------------------------------------------------------------------- */

/* Returns the number of lattice sites in table t: (2 reach + 1)^dim. A material point is at the centre of this cube. */
static int64_t partial_table_places_of(const struct bond_fraction_table *t)
{
    int64_t n = 1;
    for (int d = 0; d < t->dim; d++) n *= 2 * t->reach + 1;
    return n;
}

/* Computes at[dim], the offset of the lattice site with the number `place` from the site at the centre of table t
 * [spacings]. The (2 reach + 1)^dim sites of the table form a cube and are numbered with x fastest. */
static void place_to(const struct bond_fraction_table *t, int64_t place, int *at)
{
    for (int d = 0; d < t->dim; d++, place /= 2 * t->reach + 1) at[d] = (int)(place % (2 * t->reach + 1)) - t->reach;
}

static int64_t place_from(const struct bond_fraction_table *t, const int *at)
{
    int64_t place = 0;
    for (int d = t->dim - 1; d >= 0; d--) {
        if (at[d] < -t->reach || at[d] > t->reach) return -1;
        place = place * (2 * t->reach + 1) + at[d] + t->reach;
    }
    return place;
}

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

/* ---- construction ------------------------------------------------------------------------------------------------ */

/* Numbers all possible bond vectors on the lattice, up to the length `cutoff` [m]. Stores the numbers in t->vector, by
 * the site to which a vector leads from the centre of the table; -1 for sites without a vector. Lists these sites and
 * the centre in t->near. If there are more than VECTORS_MOST vectors, t->vectors becomes VECTORS_MOST + 1. */
static void vectors_make(struct bond_fraction_table *t, real cutoff)
{
    const int64_t places = partial_table_places_of(t), middle = (places - 1) / 2;
    t->vector = NEW("partial.vector", places, int16_t);
    for (int64_t k = 0; k < places; k++) {
        int at[DIM_MAX];
        real length2 = 0;
        place_to(t, k, at);
        for (int d = 0; d < t->dim; d++) length2 += square(at[d] * t->spacing);
        const bool bond = k != middle && sqrt(length2) <= cutoff * (1 + LATTICE_NEAR);
        /* numbering stops one beyond VECTORS_MOST, which marks an overflow */
        t->vector[k] = bond && t->vectors <= VECTORS_MOST ? (int16_t)t->vectors++ : -1;
    }
    t->directions = t->vectors / 2; /* sites k and places - 1 - k are opposite */
    t->near = NEW("partial.near", t->vectors + 1, struct near_place);
    for (int64_t k = 0, n = 0; k < places && n <= t->vectors; k++) {
        int at[DIM_MAX] = {0};
        if (t->vector[k] < 0 && k != middle) continue;
        place_to(t, k, at);
        t->near[n++] = (struct near_place){(int16_t)k, {(int16_t)at[0], (int16_t)at[1], (int16_t)at[2]}};
    }
}

/* Returns the number, from 0, of the direction of the bond vector number `vector` in table t. Opposite vectors have one
 * direction. */
static int direction_of(const struct bond_fraction_table *t, int vector)
{
    return vector < t->directions ? vector : t->vectors - 1 - vector;
}

/* Computes t->mirror[2^dim][vectors]: for each set of axes (one bit each) and each bond vector, the number of the
 * vector whose components along these axes have the opposite sign. */
static void mirrors_make(struct bond_fraction_table *t)
{
    t->mirror = NEW("partial.mirror", (int64_t)t->vectors << t->dim, int16_t);
    for (int64_t k = 0; k < partial_table_places_of(t); k++)
        for (int signs = 0; signs < 1 << t->dim && t->vector[k] >= 0; signs++) {
            int at[DIM_MAX];
            place_to(t, k, at);
            for (int d = 0; d < t->dim; d++) at[d] = signs >> d & 1 ? -at[d] : at[d];
            t->mirror[signs * t->vectors + t->vector[k]] = t->vector[place_from(t, at)];
        }
}

/* Lists the lattice cells that the bond from the centre of the table to site number k crosses. Each crossing is listed
 * as seen from the crossed cell: under the number of the site at which the bond starts if this cell is at the centre of
 * the table. next[sites + 1]: with `count` true, crossings are only counted, in next[site + 1]; otherwise they are
 * stored in t->crossing at the positions next[site], which are incremented. */
static void crossings_of(struct bond_fraction_table *t, int64_t k, int64_t *next, bool count)
{
    int to[DIM_MAX], low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, cell[DIM_MAX] = {0};
    const real from[DIM_MAX] = {0};
    real end[DIM_MAX], X[DIM_MAX];
    place_to(t, k, to);
    for (int d = 0; d < t->dim; d++) end[d] = to[d], low[d] = to[d] < 0 ? to[d] : 0, high[d] = to[d] > 0 ? to[d] : 0;
    for (cell[2] = low[2]; cell[2] <= high[2]; cell[2]++)
        for (cell[1] = low[1]; cell[1] <= high[1]; cell[1]++)
            for (cell[0] = low[0]; cell[0] <= high[0]; cell[0]++) {
                int start[DIM_MAX];
                for (int d = 0; d < t->dim; d++) X[d] = cell[d], start[d] = -cell[d];
                const real share = segment_fraction_in_cube(from, end, X, 0.5, t->dim);
                const int64_t place = place_from(t, start);
                if (share <= 0) continue;
                if (count)
                    next[place + 1]++;
                else
                    t->crossing[next[place]++] =
                        (struct crossing){t->vector[k], (int16_t)direction_of(t, t->vector[k]), share};
            }
}

/* Lists in t->crossing how each possible bond on the lattice crosses the lattice cell at the centre of the table: the
 * number of its bond vector (numbering of vectors_make) and the fraction of its length inside the cell. The list is
 * sorted by the number of the lattice site at which the bond starts, one of the (2 reach + 1)^dim sites of the table;
 * the entries of a site are t->start[site] .. t->start[site + 1] - 1. Call it after vectors_make. */
static void crossings_make(struct bond_fraction_table *t)
{
    const int64_t places = partial_table_places_of(t);
    int64_t *next = NEW("partial.next", places + 1, int64_t);
    for (int64_t k = 0; k < places; k++)
        if (t->vector[k] >= 0) crossings_of(t, k, next, true);
    for (int64_t k = 0; k < places; k++) next[k + 1] += next[k];
    t->start = NEW("partial.start", places + 1, int32_t);
    for (int64_t k = 0; k <= places; k++) t->start[k] = (int32_t)next[k];
    t->crossing = NEW("partial.crossing", next[places], struct crossing);
    for (int64_t k = 0; k < places; k++)
        if (t->vector[k] >= 0) crossings_of(t, k, next, false);
    memory_free(next);
}

/* Computes t->tensor[directions][parts][size]: for each direction of bonds and each part of the response of a bond to
 * strain, the tensor T by which a bond inside a cell over its full length reduces the stiffness of the cell. T_abcd = l
 * e_b dF_a/deps_cd, with the length l of the bond, its unit vector e and its force F
 * (cell_stiffness_reduction_add_bond_contribution). Parts, of which one is 1 and the other 0: 0, the force due to the
 * deformation of the bond itself, along the bond or, if s->rotates (models with particle rotations), in any direction;
 * 1, the force due to the dilatation of the neighbourhood, in state-based models only (struct bond_strain_response). */
static void tensors_make(struct bond_fraction_table *t, const struct bond_source *s)
{
    t->tensor = NEW("partial.tensor", (int64_t)t->directions * t->parts * t->size, real);
    for (int64_t k = 0; k < partial_table_places_of(t); k++) {
        const real from[DIM_MAX] = {0};
        real to[DIM_MAX];
        int at[DIM_MAX];
        if (t->vector[k] < 0 || t->vector[k] >= t->directions) continue;
        place_to(t, k, at);
        for (int d = 0; d < t->dim; d++) to[d] = at[d];
        for (int part = 0; part < t->parts; part++) {
            const struct bond_strain_response one = {
                .central = part == 0 && !s->rotates, .vector = part == 0 && s->rotates, .pressure = part == 1};
            cell_stiffness_reduction_add_bond_contribution(t->tensor +
                                                               ((int64_t)t->vector[k] * t->parts + part) * t->size,
                                                           from, to, from, 2 * t->reach + 1, one, t->dim);
        }
    }
}

/* Returns true if the reference positions of the particles p of each body, with their mirror images, are on one lattice
 * with the given spacing [m]. Bodies may have different lattices. */
static bool on_lattice(const struct particles *p, real spacing)
{
    int64_t first[BODIES_MOST];
    bool regular = true;
    for (int k = 0; k < BODIES_MOST; k++) first[k] = -1;
    for (int64_t i = 0; i < p->n_all; i++)
        if (first[p->body[i]] < 0) first[p->body[i]] = i;
#pragma omp parallel for schedule(static) reduction(&& : regular)
    for (int64_t i = 0; i < p->n_all; i++)
        for (int d = 0; d < p->dim; d++) {
            real k;
            regular = regular && lattice_contains_coordinate(p->X[d][i], p->X[d][first[p->body[i]]], spacing, &k);
        }
    return regular;
}

static bool all_known(const struct particles *p, const struct bond_source *s)
{
    bool known = true;
#pragma omp parallel for schedule(static) reduction(&& : known)
    for (int64_t i = 0; i < p->n; i++) known = known && particle_has_volume_of_lattice_cell(p, s, i);
    return known;
}

struct bond_fraction_table *bond_fraction_table_make_for_lattice_cells(const struct particles *p,
                                                                       const struct bond_source *s, int tensor_size)
{
    const struct family *f = &s->family;
    struct bond_fraction_table *t = NEW("partial.table", 1, struct bond_fraction_table);
    *t = (struct bond_fraction_table){.dim = p->dim,
                                      .reach = (int)floor(f->cutoff / f->spacing * (1 + LATTICE_NEAR)),
                                      .parts = s->modulus ? 2 : 1,
                                      .size = tensor_size,
                                      .spacing = f->spacing,
                                      .per_spacing = 1 / f->spacing};
    if (!on_lattice(p, f->spacing)) return t;
    vectors_make(t, f->cutoff);
    if (t->vectors * t->parts > VECTORS_MOST) t->vectors = 0;
    if (t->vectors == 0) return t;
    t->uniform = all_known(p, s);
    mirrors_make(t);
    crossings_make(t);
    tensors_make(t, s);
    t->responses.of = NEW("partial.answer_of", p->n, int32_t);
    return t;
}

void bond_fraction_table_free(struct bond_fraction_table *t)
{
    if (!t) return;
    memory_free(t->vector);
    memory_free(t->near);
    memory_free(t->mirror);
    memory_free(t->start);
    memory_free(t->crossing);
    memory_free(t->tensor);
    memory_free(t->responses.of);
    memory_free(t->responses.response);
    memory_free(t->responses.free);
    memory_free(t);
}

/* ---- bond responses ---------------------------------------------------------------------------------------------- */

/* Returns true if table t (effect of a bond of each lattice vector on a cell) is filled and can be used: the particles
 * are on a lattice, and the number of possible bond vectors is at most VECTORS_MOST. */
bool bond_fraction_table_is_not_empty(const struct bond_fraction_table *t) { return t->vectors > 0; }
bool bond_fraction_table_is_valid_for_all_particles(const struct bond_fraction_table *t) { return t->uniform; }

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

/* The block of eight rows of the last query, and its rows with an intact bond, one bit each: the next query is mostly
 * of this block. */
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

/* A row whose bonds may cross the cell of a point. j: particle or mirror image of the row; place: number of its site
 * relative to the point; response: entry of its bond responses. A bond starts within its length of any cell that it
 * crosses. */
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

bool particle_has_volume_of_lattice_cell(const struct particles *p, const struct bond_source *s, int64_t particle)
{
    return fabs(p->volume0[particle] / s->family.cell_volume - 1) <= WHOLE;
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
            const struct reflection r = mirror_image_reflection(s, p, row[k].j);
            for (int d = 0; d < t->dim; d++) signs |= (r.sign[d] < 0) << d;
        }
        if (t->parts == 1)
            sum_row(t, sum, row[k].place, response, signs, 1);
        else
            sum_row(t, sum, row[k].place, response, signs, 2);
    }
    sum_tensors(t, sum, tensor);
}
