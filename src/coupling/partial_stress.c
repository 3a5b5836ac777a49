/* Computes the partial stress: the part of its stress that a material point leaves to the bonds that cross
 * its cell. In uniform strain eps the PD-MPM bonds carry
 *     T_q : eps,   T_q = (1/V_q) sum_bonds K xi^2 l_q e (x) e (x) e (x) e
 * where l_q is the share of the reference segment of the bond inside the cell of point q (volume V_q), and e
 * its direction. The point transmits sigma - T_q : C^-1 sigma to the grid and keeps its stress sigma as its
 * state. T_q is geometric, exact in 1D, and the Hessian of an energy: C - T_q, with the elastic tensor C, is
 * the stiffness of the bonds that the cells replace.
 *
 * State-based bonds also respond to the trace of the strain and in other directions (struct
 * bond_strain_response): their T_q is not symmetric and would cause flutter at any time step. A point j of
 * such bonds therefore has the energy of one neighbourhood in D dimensions (A, g: stiffness constants; w, r,
 * Q: weight and length of a bond, weighted volume; 1: unit tensor)
 *     E_j = 1/2 V A S^2 + 1/2 g sum w |Y - R xi|^2,   S = sum w r e/Q + L : eps,
 *     L = 1/D - (1/Q) sum w xi (x) xi
 * in which the bonds of the point (xi, Y: reference and present vector; e here: extension) determine one part
 * of the mean strain S and its cell the rest; R is the rotation of the cell (kernels/mesh/mesh_law.h), and
 * for ordinary models the second term is that of the stretch of the bonds. The derivatives of E_j by the
 * parts of S and R of the cell act on the cell (particles.end_pull, end_moment). The cell keeps K = C - T',
 * T' = sym T + A sym (L (x) 1/D), which fails the patch test only by the part of T that has no energy: 1 to 4
 * % of the nodal force S h at flat interfaces. T' is limited so that the energy of the point stays positive
 * (partial_positive.c). */
#include <math.h>
#include <string.h>

#include "coupling/conversion.h"
#include "base/memory.h"
#include "partial_parts.h"

enum { ENTRY_MOST = SYM_MAX * SYM_MAX + SYM_MAX }; /* largest number of values of an entry: stress and tensor */

/* ---- the tensor -------------------------------------------------------------------------------------------------- */

/* Bounding box of all bonds of one particle [m], by which particles too far from a cell for any of their bonds to cross
 * it are skipped. */
struct box {
    real low[DIM_MAX], high[DIM_MAX];
};

/* Returns the bounding box of the reference positions of the particle of p whose bonds are row `row` of b, and of the
 * particles to which its intact bonds lead [m]. */
static struct box box_of(const struct particles *p, const struct bonds *b, int64_t row)
{
    struct box box = {{0}, {0}};
    for (int d = 0; d < p->dim; d++) {
        const real *X = p->X[d];
        box.low[d] = box.high[d] = X[b->particle[row]];
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const struct bond bond = it.bond;
            if (bond.w == 0) continue;
            box.low[d] = real_min(box.low[d], X[bond.nbr]);
            box.high[d] = real_max(box.high[d], X[bond.nbr]);
        }
    }
    return box;
}

/* Returns true if the box does not overlap with the cube of centre X[dim] and half edge `half` [m]. */
static bool box_passes(const struct box *box, const real *X, real half, int dim)
{
    for (int d = 0; d < dim; d++)
        if (box->high[d] <= X[d] - half || box->low[d] >= X[d] + half) return true;
    return false;
}

/* Adds to T the contributions of the bonds that particle j of p has in b to the stiffness of a cubic cell, which
 * belongs to another material point. Only the part of a bond inside the cell counts; only bonds of material points
 * count. T[n][n]: stiffness of all bonds in the cell times its volume, over symmetric components [J]; s: law of the
 * bonds and list of images; j: particle or mirror image; X[dim], half: centre and half edge of the cell [m]; box[rows]:
 * bounding boxes of the bonds of each row, by which most rows are skipped. */
static void tensor_add_row(real *T, const struct particles *p, const struct bonds *b, const struct bond_source *s,
                           const struct box *box, int64_t j, const real *X, real half)
{
    if (j < p->n && (b->row_of[j] < 0 || box_passes(&box[b->row_of[j]], X, half, p->dim))) return;
    struct reflection r = mirror_image_reflection_from_source_particle(s, p, j);
    int32_t row = b->row_of[r.root];
    if (row < 0 || p->kind[r.root] != KIND_MPM) return;
    real xp[DIM_MAX], xm[DIM_MAX];
    for (int d = 0; d < p->dim; d++) xp[d] = p->X[d][j];
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond bond = it.bond;
        if (bond.w == 0) continue;
        bool apart = false; /* most bonds miss the cell: tested without a division */
        for (int d = 0; d < p->dim; d++) {
            xm[d] = r.sign[d] * p->X[d][bond.nbr] + r.offset[d];
            apart |= (xm[d] < xp[d] ? xp[d] : xm[d]) <= X[d] - half || (xm[d] < xp[d] ? xm[d] : xp[d]) >= X[d] + half;
        }
        if (apart) continue;
        cell_stiffness_reduction_add_bond_contribution(
            T, xp, xm, X, half, bond_force_derivative_by_strain(p, b, s, b->particle[row], &bond), p->dim);
    }
}

real particle_cell_half_edge(const struct particles *p, const struct bond_source *s, int64_t i)
{
    return 0.5 * pow(p->volume0[i] / s->family.section, 1.0 / p->dim);
}

/* Computes T, the stiffness that the bonds (of b) of all material points of p near point i have within the cell of i,
 * times the volume of the cell [J]. Tests the bonds one by one, which works for any arrangement of particles. s: law of
 * the bonds and cells of the search; T[n][n]: over symmetric components, 0 before; box[rows]: bounding boxes of the
 * bonds of each row; near: working memory. */
static void tensor_sum(real *T, const struct particles *p, const struct bonds *b, const struct bond_source *s,
                       const struct box *box, int64_t i, struct neighbour_list *near)
{
    const real half = particle_cell_half_edge(p, s, i);
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    particles_list_neighbours_within_radius(near, s->cells, p, i, s->family.cutoff + half * sqrt(p->dim), true);
    for (int k = 0; k < near->n; k++)
        if (p->kind[near->at[k]] == KIND_MPM && p->body[near->at[k]] == p->body[i])
            tensor_add_row(T, p, b, s, box, near->at[k], X, half);
}

/* Computes the matrix M = T C^-1/V over symmetric components, M[n][n]: M sigma is the part of the stress sigma of
 * material point i of p that bonds carry. C, V: elastic tensor and volume of the point; s: has the materials; T[n][n]:
 * stiffness of the bonds within the cell of the point, times V [J]. Returns false if M is 0, i.e. if no bond crosses
 * the cell. */
static bool partial_matrix(real *M, const real *T, const struct particles *p, const struct bond_source *s, int64_t i)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real compliance[SYM_MAX * SYM_MAX];
    material_compliance_matrix(&s->material[p->material[i]], dim, compliance);
    real largest = 0;
    for (int a = 0; a < n; a++)
        for (int c = 0; c < n; c++) {
            M[a * n + c] = 0;
            for (int k = 0; k < n; k++)
                M[a * n + c] += T[a * n + k] * (k < dim ? 1 : 2) * compliance[k * n + c] / p->volume0[i];
            largest = real_max(largest, fabs(M[a * n + c]));
        }
    return largest > 0;
}

/* Returns the number of values that partial_stress stores for a point. These are the entries of the matrix M (share of
 * the point's stress that bonds carry) and, in state-based models (s->modulus), the components of the tensor L
 * (derivative of the mean strain of the point's bonds by the strain of its cell). */
static int partial_stress_entry_size(const struct bond_source *s, int dim)
{
    const int n = symmetric_tensor_component_count(dim);
    return n * n + (s->modulus ? n : 0);
}

/* Computes the values to be stored for material point i of p in a state-based model. entry: receives the matrix M
 * (share of the point's stress that bonds carry), then the tensor L (derivative of the mean strain of its bonds by the
 * strain of its cell). T: stiffness of the bonds within its cell, times its volume [J]; is reduced if the point would
 * be unstable. With partial->gives_all (hand-shake coupling), a point transmits its whole stress itself: all values are
 * 0, and the entry only marks a point with bonds. Returns false if the point needs no entry. */
static bool state_entry(real *entry, real *T, const struct partial_stress *partial, const struct particles *p,
                        const struct bonds *b, const struct bond_source *s, int64_t i)
{
    const int n = symmetric_tensor_component_count(p->dim);
    const bool end = cell_limit_state_based_stiffness_reduction(T, entry + n * n, p, b, s, i);
    if (!partial->gives_all) return partial_matrix(entry, T, p, s, i);
    array_fill_bytes(entry, 0, partial_stress_entry_size(s, p->dim), sizeof *entry);
    return end;
}

/* Computes the values to be stored for material point i of p in a bond-based model. entry: receives the matrix M (share
 * of the point's stress that bonds carry). T: stiffness of the bonds within the cell of the point, times its volume
 * [J]; is reduced if the point would be unstable. Returns false if no bond crosses the cell. */
static bool bond_entry(real *entry, real *T, const struct particles *p, const struct bond_source *s, int64_t i)
{
    cell_limit_bond_based_stiffness_reduction(T, p, s, i);
    return partial_matrix(entry, T, p, s, i);
}

/* ---- marks ------------------------------------------------------------------------------------------------------- */

/* Particles affected when particles have been converted: those whose stored values of the partial stress are
 * recomputed, and the rows (bonds of one particle) that may cross their cells. */
struct renewal {
    int32_t *list; /* particles around the changed ones, of any kind, in ascending order */
    int64_t n;
    int32_t *row; /* rows of material points; none if the table applies to all cells */
    int64_t rows;
    bool *own; /* [n] true: the particle is one of the changed particles */
};

/* Bits by which mark_dirty marks a particle. OWN: it has changed; DIRTY: a changed particle is so near that its partial
 * stress must be recomputed; OTHERS_ROW: its bonds may cross the cell of a DIRTY particle. */
enum { OTHERS_ROW = 1, DIRTY = 2, OWN = 4 };

/* Sets bits in mark[p->n] for the particles that are affected when particles have changed. OWN: a changed particle.
 * DIRTY: its distance from a changed particle is at most `radius` [m], so that its partial stress (stress that bonds
 * replace) must be recomputed. OTHERS_ROW: its distance is at most radius + reach [m], so that its bonds may cross the
 * cell of a DIRTY particle. s: cutoff and cells of the search; changed[n]: indices of the changed particles, or NULL if
 * all peridynamic particles have changed. With reach 0, the affected particles are those within the cutoff of bonds,
 * found by the map from lattice sites to particles, `map` (NULL: by a search). */
static void mark_dirty(uint8_t *mark, const struct particles *p, const struct bond_source *s,
                       const struct lattice_site_map *map, real radius, real reach, const int32_t *changed, int64_t n)
{
    struct neighbour_list near = {0};
    for (int64_t k = 0; k < (changed ? n : p->n_of[KIND_PD]); k++) {
        const int64_t i = changed ? changed[k] : p->list[KIND_PD][k];
        if (reach == 0)
            particle_find_family_members(&near, s, map, p, i);
        else
            particles_list_neighbours_unordered(&near, s->cells, p, i, radius + reach, true);
        for (int m = 0; m < near.n; m++) {
            real r2 = 0;
            for (int d = 0; d < p->dim && reach > 0; d++) r2 += square(p->X[d][near.at[m]] - p->X[d][i]);
            mark[mirror_image_source_particle(p, s->image, near.at[m])] |=
                r2 <= radius * radius ? OTHERS_ROW | DIRTY : OTHERS_ROW;
        }
        mark[i] |= OWN | OTHERS_ROW | DIRTY;
    }
    memory_free(near.at);
}

/* Lists the marked particles i, those with mark[i] != 0. list: receives their indices in ascending order; NULL: they
 * are only counted; n: number of particles. mark must be readable, and 0, from n up to the next multiple of LANES.
 * Returns the number of marked particles. */
static int64_t marked(const uint8_t *mark, int64_t n, int32_t *list)
{
    int64_t found = 0;
    for (int64_t first = 0; first < n; first += LANES) {
        if (!eight_bytes_as_word(mark + first)) continue;
        for (int64_t i = first; i < first + LANES; i++) {
            if (mark[i] && list) list[found] = (int32_t)i;
            found += mark[i] != 0;
        }
    }
    return found;
}

/* Finds the material points of p whose partial stress must be recomputed because particles near them have been
 * converted to peridynamic ones or back, and stores these points in r. The partial stress of a point is its stress
 * without the part that the bonds b across its lattice cell carry. Also stores in r the rows (the bonds of one particle
 * each) that may cross the cells of these points, unless `table` (stiffness that a bond of each lattice direction adds
 * to a cell) is valid for all particles. changed[n]: indices of the converted particles, or NULL for all peridynamic
 * ones; s: cutoff of the bonds and cells for the search of neighbours. Release r with renewal_free. */
static void renewal_make(struct renewal *r, const struct particles *p, const struct bonds *b,
                         const struct bond_source *s, const struct bond_fraction_table *table, const int32_t *changed,
                         int64_t n)
{
    /* a changed bond ends within a cutoff plus half the diagonal of a cell of every cell it crosses; on a lattice,
     * within its own length, since the middle of the cell is inside the box that the bond spans */
    const bool strange = !bond_fraction_table_is_valid_for_all_particles(table);
    const real radius = s->family.cutoff + (strange ? s->family.spacing * sqrt(p->dim) : 0);
    uint8_t *mark = NEW("partial.mark", p->n + LANES, uint8_t); /* entries beyond the body stay 0 */
    mark_dirty(mark, p, s, b->site_map, radius, strange ? radius : 0, changed, n);
    const int64_t most = marked(mark, p->n, NULL);
    int32_t *list = NEW("partial.marked", most, int32_t);
    marked(mark, p->n, list);
    *r = (struct renewal){.list = NEW("partial.list", most, int32_t),
                          .row = NEW("partial.row", strange ? most : 0, int32_t),
                          .own = NEW("partial.own", most, bool)};
    for (int64_t k = 0; k < most; k++) {
        const int32_t i = list[k], row = b->row_of[i];
        if (strange && row >= 0 && mark[i] & OTHERS_ROW && p->kind[i] == KIND_MPM &&
            bond_row_block_bond_count(b, row / LANES) > 0)
            r->row[r->rows++] = row;
        if (!(mark[i] & DIRTY)) continue;
        r->own[r->n] = !changed || mark[i] & OWN;
        r->list[r->n++] = i;
    }
    memory_free(list);
    memory_free(mark);
}

static void renewal_free(struct renewal *r)
{
    memory_free(r->list);
    memory_free(r->row);
    memory_free(r->own);
}

/* ---- entries ----------------------------------------------------------------------------------------------------- */

/* Stores the values computed for material point i in `partial`. M: `size` values of the matrix M (share of the point's
 * stress that bonds carry), followed by `local` values of the tensor L (derivative of the mean strain of its bonds by
 * the strain of its cell; none in bond-based models). Creates an entry for the point if it has none. */
static void entry_put(struct partial_stress *partial, int64_t i, const real *M, int size, int local)
{
    if (partial->index[i] < 0) {
        GROW("partial.matrix", partial->matrix, (partial->entries + 1) * size);
        GROW("partial.local", partial->local, (partial->entries + 1) * local);
        partial->index[i] = (int32_t)partial->entries++;
    }
    array_copy(partial->matrix + (int64_t)partial->index[i] * size, M, size, sizeof *M);
    array_copy(partial->local + (int64_t)partial->index[i] * local, M + size, local, sizeof *M);
}

/* Removes unused entries from the arrays of values in `partial` if they are more than half of all. Points of p that
 * have become peridynamic or have lost their bonds leave unused entries. size, local: number of values of the matrix M
 * and of the tensor L in an entry. */
static void entries_squeeze(struct partial_stress *partial, const struct particles *p, int size, int local)
{
    int64_t live = 0;
    for (int64_t i = 0; i < p->n; i++) live += partial->index[i] >= 0;
    if (partial->entries <= 2 * live + 256) return;
    struct partial_stress old = *partial;
    partial->matrix = NULL, partial->local = NULL;
    partial->entries = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const int64_t at = partial->index[i];
        real M[ENTRY_MOST];
        if (at < 0) continue;
        array_copy(M, old.matrix + at * size, size, sizeof *M);
        array_copy(M + size, old.local + at * local, local, sizeof *M);
        partial->index[i] = -1;
        entry_put(partial, i, M, size, local);
    }
    memory_free(old.matrix);
    memory_free(old.local);
}

/* Returns true if the entry of material point i in `partial` is bitwise equal to M: `size` values of the matrix M and
 * `local` values of the tensor L that follow. Returns false if the point has no entry. */
static bool entry_is(const struct partial_stress *partial, int64_t i, const real *M, int size, int local)
{
    const int64_t at = partial->index[i];
    return at >= 0 && arrays_equal(partial->matrix + at * size, M, size, sizeof *M) &&
           arrays_equal(partial->local + at * local, M + size, local, sizeof *M);
}

/* Appends particle i to partial->touched, the list of material points whose stored values have changed. */
static void touch(struct partial_stress *partial, int64_t i)
{
    GROW("partial.touched", partial->touched, partial->touches + 1);
    partial->touched[partial->touches++] = (int32_t)i;
}

/* Computes in parallel the values to be stored for the material points of p in the list r->list. entry: receives r->n
 * entries, each with the matrix M (share of the point's stress that bonds carry) and for state-based models the tensor
 * L; crossed[r->n]: set to true for the points that need an entry because bonds cross their cell. partial: supplies the
 * table of bonds on a lattice, if there is one. */
static void entries_make(real *entry, bool *crossed, const struct partial_stress *partial, const struct renewal *r,
                         const struct particles *p, const struct bonds *b, const struct bond_source *s)
{
    const bool served = bond_fraction_table_is_not_empty(partial->table);
    const int each = partial_stress_entry_size(s, p->dim);
    struct box *box = NEW("partial.box", r->rows > 0 ? b->rows : 0, struct box);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t k = 0; k < r->rows; k++) box[r->row[k]] = box_of(p, b, r->row[k]);
#pragma omp for schedule(dynamic, 16)
        for (int64_t k = 0; k < r->n; k++) {
            const int64_t i = r->list[k];
            real T[SYM_MAX * SYM_MAX] = {0};
            if (p->kind[i] != KIND_MPM) continue;
            if (served && particle_has_volume_of_lattice_cell(p, s, i))
                bond_fraction_table_sum_cell_stiffness_reduction(partial->table, p, b, s, i, &near, T);
            else
                tensor_sum(T, p, b, s, box, i, &near);
            crossed[k] = s->modulus ? state_entry(entry + k * each, T, partial, p, b, s, i)
                                    : bond_entry(entry + k * each, T, p, s, i);
        }
        memory_free(near.at);
    }
    memory_free(box);
}

void partial_stress_compute_from_bonds(struct partial_stress *partial, const struct particles *p, const struct bonds *b,
                                       const struct bond_source *source, const int32_t *converted_particles,
                                       int64_t converted_count)
{
    const int n_symmetric = symmetric_tensor_component_count(p->dim), size = n_symmetric * n_symmetric;
    const int whole = partial_stress_entry_size(source, p->dim), local = whole - size;
    const bool all = !converted_particles || !partial->index;
    struct renewal r;
    if (!partial->index) {
        partial->index = NEW("partial.index", p->n, int32_t);
        for (int64_t i = 0; i < p->n; i++) partial->index[i] = -1;
        partial->table = bond_fraction_table_make_for_lattice_cells(p, source, size);
    }
    renewal_make(&r, p, b, source, partial->table, converted_particles, converted_count);
    if (bond_fraction_table_is_not_empty(partial->table))
        bond_fraction_table_update_strain_responses(partial->table, p, b, source, all ? NULL : r.list, r.n);
    real *M = BARE("partial.new", r.n * whole, real);
    bool *crossed = NEW("partial.crossed", r.n, bool);
    entries_make(M, crossed, partial, &r, p, b, source);
    for (int64_t k = 0; k < r.n; k++) {
        const int64_t i = r.list[k];
        const bool same = crossed[k] ? entry_is(partial, i, M + k * whole, size, local) : partial->index[i] < 0;
        if (!same || r.own[k]) touch(partial, i);
        if (same) continue;
        if (crossed[k])
            entry_put(partial, i, M + k * whole, size, local);
        else
            partial->index[i] = -1;
    }
    entries_squeeze(partial, p, size, local);
    memory_free(crossed);
    memory_free(M);
    renewal_free(&r);
}

void bonded_mpm_points_compute_strain_from_stress(const struct partial_stress *partial, struct particles *p,
                                                  const struct material *material)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real compliance[UINT8_MAX + 1][SYM_MAX * SYM_MAX];
    bool known[UINT8_MAX + 1] = {false};
    if (!partial->index || !partial->local) return;
    for (int64_t k = 0; k < p->n_free; k++) {
        const int64_t i = p->list_free[k], entry = partial->index[i];
        const int m = p->material[i];
        if (entry < 0) continue;
        if (!known[m]) material_compliance_matrix(&material[m], dim, compliance[m]), known[m] = true;
        p->end_strain[i] = 0;
        for (int c = 0; c < n; c++)
            for (int d = 0; d < n; d++)
                p->end_strain[i] +=
                    partial->local[entry * n + c] * (c < dim ? 1 : 2) * compliance[m][c * n + d] * p->stress[d][i];
    }
}

void partial_stress_free(struct partial_stress *partial)
{
    memory_free(partial->index);
    memory_free(partial->matrix);
    memory_free(partial->local);
    memory_free(partial->touched);
    if (partial->table) bond_fraction_table_free(partial->table);
    *partial = (struct partial_stress){.gives_all = partial->gives_all};
}
