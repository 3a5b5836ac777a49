/* Builds the table for partial stress on a lattice. The share of a bond inside the cell of a point depends only on the
 * start of the bond relative to the point and on the vector of the bond: shares, and the tensors of all directions, are
 * tabulated once. */
#include <math.h>
#include <string.h>

#include "bonds/sites.h"
#include "base/memory.h"
#include "partial_table_internal.h"

#define WHOLE 1e-12                   /* tolerance of the volume of a lattice cell [1]: round-off */
enum { BODIES_MOST = UINT8_MAX + 1 }; /* largest number of bodies */

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
 * strain, the tensor T by which a bond reduces the stiffness of a cell if its full length is inside. T_abcd = l e_b
 * dF_a/deps_cd, with the length l of the bond, its unit vector e, its force F and the strain eps
 * (cell_stiffness_reduction_add_bond_contribution). Part 0: force by the deformation of the bond itself, along the bond
 * or, if s->rotates (models with particle rotations), in any direction. Part 1, in state-based models only: force by
 * the dilatation of the neighbourhood (struct bond_strain_response). Each tensor is that of a unit response in one
 * part. */
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

bool particle_has_volume_of_lattice_cell(const struct particles *p, const struct bond_source *s, int64_t particle)
{
    return fabs(p->volume0[particle] / s->family.cell_volume - 1) <= WHOLE;
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

/* Returns true if table t (effect of a bond of each lattice vector on a cell) is filled and can be used: the particles
 * are on a lattice, and the number of possible bond vectors is at most VECTORS_MOST. */
bool bond_fraction_table_is_not_empty(const struct bond_fraction_table *t) { return t->vectors > 0; }
bool bond_fraction_table_is_valid_for_all_particles(const struct bond_fraction_table *t) { return t->uniform; }
