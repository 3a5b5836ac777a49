/* Computes the stiffness matrices of own-stiffness cells of the mesh, in terms of deformation modes
 * (kernels/mesh/mesh_own_stiffness.h), from the points that they contain.
 *
 * The strain at a point is the uniform strain plus, for each bending mode, an amplitude times a product of coordinates
 * +-1/4. An entry of the stiffness matrix thus is a sum over the points of D, the matrix of stress by strain, times
 * signs of coordinates. As the square of a sign is 1, there is one such sum for each set of axes. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"
#include "kernels/mesh/mesh_point.h"

enum { TERMS_MAX = 3 }; /* largest number of terms of the strain field of a mode */

/* One term of the strain field of a deformation mode of a cell. It adds to symmetric component `row` of the strain:
 * `factor` times the amplitude of the mode, times the product of the signs of the coordinates along the axes in the bit
 * set `set`. */
struct mode_term {
    uint8_t row, set;
    real factor;
};
/* Strain field of one deformation mode of a cell: the sum of the n terms at[n]. */
struct mode_terms {
    int n;
    struct mode_term at[TERMS_MAX];
};

/* ---- modes ------------------------------------------------------------------------------------------------------- */

/* Returns the index (from 0) of component ij of a symmetric tensor in `dim` dimensions, in the order in which struct
 * particles stores its components. i, j: axes, 0 to dim - 1. */
static int component(int dim, int i, int j)
{
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        if ((a == i && b == j) || (a == j && b == i)) return k;
    }
    return -1;
}

/* Lists in t the strains that the bending modes of a cell cause in `dim` dimensions. A bending mode is a displacement
 * component i that varies as the product of the coordinates along two or three axes, a bit set M. Its derivative along
 * one of these axes is a strain that varies as the product of the other coordinates; each such strain is one term. */
static void bends_terms(struct mode_terms *t, int dim)
{
    for (int M = 3; M < 1 << dim; M++)
        for (int i = 0; i < dim && M & (M - 1); i++, t++)
            for (int j = 0; j < dim; j++) {
                const int set = M & ~(1 << j);
                if (!(M >> j & 1)) continue;
                t->at[t->n++] = (struct mode_term){(uint8_t)component(dim, i, j), (uint8_t)set,
                                                   pow(0.25, __builtin_popcount((unsigned)set))};
            }
}

/* Lists in t[MODES_MAX] the strains that each deformation mode of a cell causes in `dim` dimensions: first the modes of
 * uniform strain, one for each symmetric component, then the bending modes, set by set of axes
 * (kernels/mesh/mesh_own_stiffness.h). */
static void modes_terms(struct mode_terms *t, int dim)
{
    const int symmetric = symmetric_tensor_component_count(dim);
    memset(t, 0, sizeof *t * MODES_MAX);
    for (int k = 0; k < symmetric; k++) t[k] = (struct mode_terms){1, {{(uint8_t)k, 0, 1}}};
    bends_terms(t + symmetric, dim);
}

/* ---- stiffness of one cell --------------------------------------------------------------------------------------- */

/* Arguments that the functions for stiffness matrices of own-stiffness cells have in common (cells with missing or
 * unequal points): mesh, particles, material data, and numbers of modes and strain components. Made by maker_of. */
struct cell_maker {
    const struct mesh *mesh;
    const struct particles *p;
    const struct mesh_source *source;
    int dim, modes, columns; /* dimension; number of modes; columns of D: symmetric components */
    real (*whole)[SYM_MAX * SYM_MAX], (*isotropic)[SYM_MAX * SYM_MAX]; /* [materials] stress by strain */
    struct mode_terms in[MODES_MAX];                                   /* [modes] strain field of each mode */
};

/* Computes the matrix C[n][n] of stress by strain of a material m [Pa], n = symmetric_tensor_component_count(dim);
 * shear strains are angles. */
static void constants(const struct elastic *m, real *C, int dim)
{
    const int n = symmetric_tensor_component_count(dim);
    for (int t = 0; t < n; t++) {
        real g[DIM_MAX * DIM_MAX] = {0}, s[SYM_MAX];
        int a, b;
        symmetric_tensor_component_axes(dim, t, &a, &b);
        g[a * dim + b] = 1;
        point_hooke_stress(m, g, s, dim);
        for (int k = 0; k < n; k++) C[k * n + t] = s[k];
    }
}

/* Computes the matrix D[n][n] of stress by strain at point i [Pa], n = c->columns: the constants of its material, minus
 * the part that bonds carry if the point has a partial stress (leaves a share of its stress to bonds). */
static void point_constants(const struct cell_maker *c, int32_t i, real *D)
{
    const int n = c->columns;
    const struct partial_stress *partial = c->source->partial;
    const int64_t entry = partial && partial->index ? partial->index[i] : -1;
    const real *isotropic = c->isotropic[c->p->material[i]];
    array_copy(D, c->whole[c->p->material[i]], n * n, sizeof *D);
    if (entry < 0) return;
    for (int row = 0; row < n; row++) {
        const real *M = partial->matrix + (entry * n + row) * n;
        for (int k = 0; k < n; k++)
            for (int t = 0; t < n; t++) D[row * n + t] -= M[k] * isotropic[k * n + t];
    }
}

/* Computes sum[S] [Pa] for each set S of axes (bit d: axis d): the mean of s_S D over the 2^dim integration points of
 * cell I. D is the matrix of stress by strain of a point, 0 for a missing point, stored row by row over the c->columns
 * symmetric components. s_S is the product, over the axes in S, of the signs of the coordinates of the point relative
 * to the middle of the cell. All means are formed together, along one axis after the other (butterflies). c: mesh and
 * particles. */
static void cell_sums(const struct cell_maker *c, int64_t I, real sum[CORNERS_MAX][SYM_MAX * SYM_MAX])
{
    const int corners = 1 << c->dim, size = c->columns * c->columns;
    for (int q = 0; q < corners; q++) {
        const int32_t i = c->mesh->point[(I << c->dim) + q];
        if (i >= 0)
            point_constants(c, i, sum[q]);
        else
            array_fill_bytes(sum[q], 0, size, sizeof(real));
    }
    for (int d = 0; d < c->dim; d++)
        for (int q = 0; q < corners; q++)
            for (int k = 0; k < size && !(q >> d & 1); k++) {
                const real low = sum[q][k], high = sum[q | 1 << d][k];
                sum[q][k] = 0.5 * (low + high), sum[q | 1 << d][k] = 0.5 * (high - low);
            }
}

/* Returns one entry of the stiffness matrix of a cell in terms of its deformation modes [Pa]: the force on the mode
 * `to` for a unit amplitude of the mode `by`. c: dimensions; sum[S]: means of the stiffness matrices of its points
 * times signs of their coordinates, from cell_sums. */
static real own_stiffness_entry(const struct cell_maker *c, real sum[CORNERS_MAX][SYM_MAX * SYM_MAX],
                                const struct mode_terms *to, const struct mode_terms *by)
{
    real value = 0;
    for (int s = 0; s < to->n; s++)
        for (int t = 0; t < by->n; t++)
            value += to->at[s].factor * by->at[t].factor *
                     sum[to->at[s].set ^ by->at[t].set][to->at[s].row * c->columns + by->at[t].row];
    return value;
}

/* Strain of the points of a cell by its modes: [point][symmetric component][mode] [1]; shear strains are angles. */
typedef real point_strains[CORNERS_MAX][SYM_MAX][MODES_MAX];

/* Computes B, the strains of the points of cell I for unit amplitudes of its deformation modes. All points of a
 * material in the cell have their mean dilatation (mesh_law.h). c: mesh and particles. Returns false, without values,
 * if no material of the cell has a mean dilatation. */
static bool averaged_strains(const struct cell_maker *c, int64_t I, point_strains B)
{
    const int32_t *point = &c->mesh->point[I << c->dim];
    const struct elastic *m = c->source->elastic;
    if (!cell_uses_mean_dilatation(m, c->p->material, point, c->dim)) return false;
    memset(B, 0, sizeof(point_strains));
    for (int k = 0; k < c->modes; k++) {
        real trace[CORNERS_MAX] = {0};
        for (int q = 0; q < 1 << c->dim; q++)
            for (int t = 0; t < c->in[k].n; t++) {
                const struct mode_term *term = &c->in[k].at[t];
                const int below = __builtin_popcount((unsigned)(term->set & ~q)); /* coordinates -1/4 */
                B[q][term->row][k] += (below % 2 ? -1 : 1) * term->factor;
            }
        for (int q = 0; q < 1 << c->dim; q++)
            for (int d = 0; d < c->dim; d++) trace[q] += B[q][d][k];
        cell_replace_point_values_by_mean_minus_value(m, c->p->material, point, trace, c->dim);
        for (int q = 0; q < 1 << c->dim; q++)
            for (int d = 0; d < c->dim; d++) B[q][d][k] += trace[q] / c->dim;
    }
    return true;
}

/* Adds to K[MODES_MAX][MODES_MAX] the stiffness B^T D B of a point, divided by the number of points of a whole cell
 * [Pa]. c: numbers of modes and components; B: strain of the point by the modes; D: its matrix of stress by strain
 * [Pa]. */
static void averaged_point_add(const struct cell_maker *c, real B[SYM_MAX][MODES_MAX], const real *D,
                               real K[MODES_MAX][MODES_MAX])
{
    for (int b = 0; b < c->modes; b++) {
        real stress[SYM_MAX] = {0};
        for (int s = 0; s < c->columns; s++)
            for (int t = 0; t < c->columns; t++) stress[s] += D[s * c->columns + t] * B[t][b];
        for (int a = 0; a < c->modes; a++)
            for (int s = 0; s < c->columns; s++) K[a][b] += B[s][a] * stress[s] / (1 << c->dim);
    }
}

/* Computes the stiffness matrix K[MODES_MAX][MODES_MAX] [Pa] of own-stiffness cell I (a cell with missing or unequal
 * points, which has a stiffness matrix of its own), in terms of its deformation modes. c: mesh and particles; B:
 * strains of its points for unit amplitudes of the modes, with the mean dilatation (averaged_strains). */
static void averaged_cell_make(const struct cell_maker *c, int64_t I, point_strains B, real K[MODES_MAX][MODES_MAX])
{
    memset(K, 0, sizeof(real) * MODES_MAX * MODES_MAX);
    for (int q = 0; q < 1 << c->dim; q++) {
        const int32_t i = c->mesh->point[(I << c->dim) + q];
        real D[SYM_MAX * SYM_MAX];
        if (i < 0) continue;
        point_constants(c, i, D);
        averaged_point_add(c, B[q], D, K);
    }
}

/* Computes the stiffness matrix of own-stiffness cell I (a cell with missing or unequal points, which has a stiffness
 * matrix of its own), in terms of its deformation modes [Pa], and stores its upper half row by row. c: mesh and
 * particles. K: address of the first entry; the next entries follow at distances of LANES, since the matrices of LANES
 * cells are interleaved. The lower half is not stored, since the matrix is symmetric up to round-off. */
static void mesh_own_stiffness_cell_compute_stiffness(const struct cell_maker *c, int64_t I, real *K)
{
    const int n = c->modes;
    real sum[CORNERS_MAX][SYM_MAX * SYM_MAX], averaged[MODES_MAX][MODES_MAX];
    point_strains B;
    if (averaged_strains(c, I, B)) {
        averaged_cell_make(c, I, B, averaged);
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++, K += LANES) *K = averaged[a][b];
        return;
    }
    cell_sums(c, I, sum);
    for (int a = 0; a < n; a++)
        for (int b = a; b < n; b++, K += LANES) *K = own_stiffness_entry(c, sum, &c->in[a], &c->in[b]);
}

/* ---- points of PD-MPM bonds -------------------------------------------------------------------------------------- */

/* Frees the lists of points with PD-MPM bonds (between peridynamic particles and material points) in the own-stiffness
 * cells of the mesh (cells with a stiffness matrix of their own). */
static void ends_free(struct mesh *mesh)
{
    memory_free(mesh->ends);
    memory_free(mesh->end);
    memory_free(mesh->end_share);
    mesh->ends = NULL, mesh->end = NULL, mesh->end_share = NULL;
}

/* Computes share[modes]: how much a unit amplitude of each deformation mode of a cell changes the mean strain of the
 * neighbourhood (the neighbours by bonds) of one of its points. c: numbers of modes and components; local: derivative
 * of this mean strain by the strain of the cell at the point (struct partial_stress); place: number of the point in the
 * cell, 0 .. 2^dim - 1; B: strains of the points by the modes, from averaged_strains, or NULL if each point has its own
 * dilatation. */
static void end_share(const struct cell_maker *c, const real *local, int place, point_strains B, real *share)
{
    for (int k = 0; k < c->modes; k++) {
        share[k] = 0;
        for (int s = 0; s < c->columns && B; s++) share[k] += local[s] * B[place][s][k];
        if (B) continue;
        for (int t = 0; t < c->in[k].n; t++) {
            const struct mode_term *term = &c->in[k].at[t];
            const int below = __builtin_popcount((unsigned)(term->set & ~place)); /* coordinates -1/4 */
            share[k] += (below % 2 ? -1 : 1) * term->factor * local[term->row];
        }
    }
}

/* Returns the entry of point i in struct partial_stress if the point has state-based bonds to peridynamic particles,
 * else -1. c: has the partial stresses; i: particle number, or -1 for no point. */
static int64_t end_entry(const struct cell_maker *c, int32_t i)
{
    return i >= 0 && point_has_own_state_based_bonds(c->source->partial, i, c->dim) ? c->source->partial->index[i] : -1;
}

/* Appends the points with state-based PD-MPM bonds in own-stiffness cell number k (a cell with a stiffness matrix of
 * its own) to mesh->end, from index *n on. Stores for each point how much the deformation modes of the cell change the
 * mean strain of its family. Advances *n by the number of these points. c: mesh and bonds. */
static void ends_of_cell(struct mesh *mesh, const struct cell_maker *c, int64_t k, int32_t *n)
{
    const struct partial_stress *partial = c->source->partial;
    point_strains B;
    const bool averaged = averaged_strains(c, mesh->own_stiffness_cell[k], B);
    for (int q = 0; q < 1 << c->dim; q++) {
        const int32_t i = mesh->point[((int64_t)mesh->own_stiffness_cell[k] << c->dim) + q];
        const int64_t entry = end_entry(c, i);
        if (entry < 0) continue;
        mesh->end[*n] = (struct mesh_end){i, (int32_t)(k % LANES)};
        end_share(c, partial->local + entry * c->columns, q, averaged ? B : NULL,
                  mesh->end_share + (int64_t)(*n)++ * c->modes);
    }
}

/* Lists the points with state-based PD-MPM bonds in all own-stiffness cells of the mesh (cells with a stiffness matrix
 * of their own), group by group of LANES such cells. c: has the partial stresses of the points. */
static void mesh_own_stiffness_cells_compute_ends(struct mesh *mesh, const struct cell_maker *c)
{
    const struct partial_stress *partial = c->source->partial;
    int32_t n = 0;
    if (!partial || !partial->index || !partial->local) return;
    mesh->ends = NEW("mesh.ends", mesh_count_groups_of_eight_own_stiffness_cells(mesh) + 1, int32_t);
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        for (int q = 0; q < 1 << c->dim; q++)
            n += end_entry(c, mesh->point[((int64_t)mesh->own_stiffness_cell[k] << c->dim) + q]) >= 0;
    mesh->end = NEW("mesh.end", n, struct mesh_end);
    mesh->end_share = NEW("mesh.end_share", (int64_t)n * c->modes, real);
    n = 0;
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++) {
        ends_of_cell(mesh, c, k, &n);
        mesh->ends[k / LANES + 1] = n;
    }
}

/* ---- all own-stiffness cells
 * ------------------------------------------------------------------------------------------- */

/* Appends cell I to the list of own-stiffness cells of the mesh: cells with missing points, partial stresses (left to
 * bonds), several materials or doubled nodes. Their stiffness is computed later
 * (mesh_own_stiffness_cells_compute_stiffness).
 */
void mesh_own_stiffness_cells_add(struct mesh *mesh, int64_t I)
{
    GROW("mesh.own_stiffness_cell", mesh->own_stiffness_cell, mesh->own_stiffness_cells + 1);
    mesh->own_stiffness_cell[mesh->own_stiffness_cells++] = (int32_t)I;
}

struct mesh_own_stiffness_cells mesh_own_stiffness_cells_remove_and_return(struct mesh *mesh)
{
    const struct mesh_own_stiffness_cells old = {mesh->own_stiffness_cells, mesh->own_stiffness_cell, mesh->stiffness};
    mesh->own_stiffness_cell = NULL, mesh->stiffness = NULL;
    mesh->own_stiffness_cells = 0;
    mesh_own_stiffness_cells_free(mesh);
    return old;
}

void mesh_own_stiffness_cells_free(struct mesh *mesh)
{
    memory_free(mesh->own_stiffness_cell);
    memory_free(mesh->stiffness);
    ends_free(mesh);
    memory_free(mesh->alike);
    memory_free(mesh->own_stiffness_force);
    memory_free(mesh->own_stiffness_stressed);
    memory_free(mesh->own_stiffness_material);
    mesh->own_stiffness_cell = NULL, mesh->own_stiffness_force = NULL, mesh->own_stiffness_stressed = NULL,
    mesh->own_stiffness_material = NULL, mesh->alike = NULL;
    mesh->stiffness = NULL;
}

/* Returns the number of the material with the lowest conversion stress among the materials of the points (of p) of cell
 * I of the mesh. s: elastic constants, with these stresses. */
static uint8_t own_stiffness_material(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                                      int64_t I)
{
    int least = -1;
    for (int q = 0; q < 1 << p->dim; q++) {
        const int32_t i = mesh->point[(I << p->dim) + q];
        if (i < 0) continue;
        if (least < 0 || s->elastic[p->material[i]].trigger < s->elastic[least].trigger) least = p->material[i];
    }
    return (uint8_t)least;
}

/* Returns the parameters for computing the stiffness matrices of the own-stiffness cells of the mesh (cells with
 * missing points, partial stresses, several materials or doubled nodes) from particles p and material data s. Release
 * the member `whole` with memory_free. */
static struct cell_maker maker_of(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    struct cell_maker c = {
        .mesh = mesh, .p = p, .source = s, .dim = dim, .modes = cell_deformation_mode_count(dim), .columns = n};
    c.whole = memory_new("mesh.constants", 2 * s->materials, sizeof *c.whole);
    c.isotropic = c.whole + s->materials;
    for (int m = 0; m < s->materials; m++) {
        constants(&s->elastic[m], c.whole[m], dim);
        constants(&s->isotropic[m], c.isotropic[m], dim);
    }
    modes_terms(c.in, dim);
    return c;
}

/* Returns the address of the first number of own-stiffness cell `cell` (with missing or unequal points) in the array
 * `from`. The array has `each` numbers for every own-stiffness cell, such as stiffnesses; those of LANES cells are
 * interleaved. Returns NULL if `from` is NULL. */
static real *lane_of(real *from, int64_t cell, int each)
{
    return from ? from + (cell / LANES * each) * LANES + cell % LANES : NULL;
}

/* Copies the numbers of own-stiffness cells (such as stiffnesses) from the array `old` to group number `group` of LANES
 * cells of the array `to`: those of cell from[l] to lane l. A lane with from[l] < 0 keeps its values. each: numbers per
 * cell; those of LANES cells are interleaved in both arrays, which are read and written in order. */
static void group_copy(real *to, real *old, const int64_t *from, int64_t group, int each)
{
    real *own = to + group * each * LANES;
    const real *source[LANES];
    for (int l = 0; l < LANES; l++) source[l] = from[l] >= 0 ? lane_of(old, from[l], each) : own + l;
    for (int k = 0; k < each * LANES; k += LANES)
        for (int l = 0; l < LANES; l++) own[k + l] = source[l][k];
}

/* Fills up the last group of LANES own-stiffness cells of the mesh (cells with a stiffness matrix of their own) by
 * copies of its first cell. The copies have no stiffness and are not counted. */
static void groups_fill(struct mesh *mesh)
{
    const int64_t whole = mesh_count_groups_of_eight_own_stiffness_cells(mesh) * LANES,
                  own_stiffness_cells = mesh->own_stiffness_cells;
    while (mesh->own_stiffness_cells < whole)
        mesh_own_stiffness_cells_add(mesh, mesh->own_stiffness_cell[whole - LANES]);
    mesh->own_stiffness_cells = own_stiffness_cells;
}

/* Returns a list with an entry for each own-stiffness cell of the mesh (a cell with a stiffness matrix of its own): the
 * index of the same cell in `old`, the list before a change of cells, from which its stiffness is copied. The entry is
 * -1 if the stiffness must be computed, because the cell is new or marked in `dirty` (NULL: all cells are), and for the
 * lanes that fill the last group of LANES cells. Release the list with memory_free. */
static int64_t *origins(const struct mesh *mesh, const struct mesh_own_stiffness_cells *old, const uint8_t *dirty)
{
    int64_t *from = BARE("mesh.from", mesh_count_groups_of_eight_own_stiffness_cells(mesh) * LANES, int64_t);
    for (int64_t k = mesh->own_stiffness_cells; k < mesh_count_groups_of_eight_own_stiffness_cells(mesh) * LANES; k++)
        from[k] = -1;
    for (int64_t k = 0, q = 0; k < mesh->own_stiffness_cells; k++) {
        while (q < old->own_stiffness_cells && old->own_stiffness_cell[q] < mesh->own_stiffness_cell[k]) q++;
        from[k] = dirty && q < old->own_stiffness_cells && old->own_stiffness_cell[q] == mesh->own_stiffness_cell[k] &&
                          !dirty[mesh->own_stiffness_cell[k]]
                      ? q
                      : -1;
    }
    return from;
}

/* Returns an array of `each` numbers for every own-stiffness cell of `mesh` (a cell with a stiffness matrix of its
 * own), interleaved in groups of LANES cells. The numbers of the last group are 0, others are uninitialised. label:
 * name of the array. Release it with memory_free. */
static real *numbers_make(const char *label, const struct mesh *mesh, int64_t each)
{
    const int64_t groups = mesh_count_groups_of_eight_own_stiffness_cells(mesh), size = each * LANES;
    real *numbers = memory_new_uninitialised(label, groups * size, sizeof *numbers);
    if (groups > 0) array_fill_bytes(numbers + (groups - 1) * size, 0, size, sizeof *numbers);
    return numbers;
}

/* Returns true if two groups g and h of LANES own-stiffness cells (cells with a stiffness matrix of their own) have
 * bitwise equal numbers in the array `of`, such as stiffnesses. each: numbers per cell. */
static bool numbers_alike(const real *of, int64_t g, int64_t h, int each)
{
    const int64_t size = (int64_t)each * LANES;
    return arrays_equal(of + g * size, of + h * size, size, sizeof *of);
}

/* Finds groups of LANES own-stiffness cells (cells with a stiffness matrix of their own) that can share one stiffness.
 * mesh->alike[g] receives the first of the groups directly before group g with bitwise equal stiffness, or g itself if
 * there is none. Such groups are frequent, as cells that an edge of the body cuts in the same way are consecutive.
 * modes: number of deformation modes of a cell. */
static void alike_find(struct mesh *mesh, int modes)
{
    const int64_t groups = mesh_count_groups_of_eight_own_stiffness_cells(mesh);
    const int half = modes * (modes + 1) / 2;
    mesh->alike = NEW("mesh.alike", groups, int32_t);
    for (int64_t g = 0; g < groups; g++) {
        const int32_t before = g > 0 ? mesh->alike[g - 1] : 0;
        mesh->alike[g] = numbers_alike(mesh->stiffness, before, g, half) ? before : (int32_t)g;
    }
}

void mesh_own_stiffness_cells_compute_stiffness(struct mesh *mesh, const struct particles *p,
                                                const struct mesh_source *s, const uint8_t *cell_needs_update,
                                                struct mesh_own_stiffness_cells *previous_cells)
{
    struct cell_maker c = maker_of(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2, unknowns = (1 << c.dim) * c.dim;
    const int64_t groups = mesh_count_groups_of_eight_own_stiffness_cells(mesh);
    groups_fill(mesh);
    mesh->stiffness = numbers_make("mesh.stiffness", mesh, half);
    mesh->own_stiffness_force = BARE("mesh.own_stiffness_force", groups * unknowns * LANES, real);
    mesh->own_stiffness_stressed = NEW("mesh.own_stiffness_stressed", groups * LANES, bool);
    mesh->own_stiffness_material = NEW("mesh.own_stiffness_material", groups * LANES, uint8_t);
    for (int64_t k = 0; k < groups * LANES; k++)
        mesh->own_stiffness_material[k] = own_stiffness_material(mesh, p, s, mesh->own_stiffness_cell[k]);
    int64_t *from = origins(mesh, previous_cells, cell_needs_update);
#pragma omp parallel for schedule(dynamic, 2)
    for (int64_t g = 0; g < groups; g++) {
        group_copy(mesh->stiffness, previous_cells->stiffness, from + g * LANES, g, half);
        for (int64_t k = g * LANES; k < (g + 1) * LANES && k < mesh->own_stiffness_cells; k++)
            if (from[k] < 0)
                mesh_own_stiffness_cell_compute_stiffness(&c, mesh->own_stiffness_cell[k],
                                                          lane_of(mesh->stiffness, k, half));
    }
    alike_find(mesh, c.modes);
    mesh_slits_store_corner_nodes_of_adjacent_cells(mesh);
    mesh_own_stiffness_cells_compute_ends(mesh, &c);
    memory_free(from);
    memory_free(c.whole);
    memory_free(previous_cells->own_stiffness_cell);
    memory_free(previous_cells->stiffness);
}

/* Ends the sharing of stiffness by groups of LANES own-stiffness cells (missing or unequal points) of which one has
 * changed. Sets mesh->alike[g] = g for each group g with changed[g], and for each group that uses the stiffness of such
 * a group. changed: [groups]. */
static void alike_part(struct mesh *mesh, const uint8_t *changed)
{
    for (int64_t g = mesh_count_groups_of_eight_own_stiffness_cells(mesh) - 1; g >= 0; g--)
        if (changed[g] || changed[mesh->alike[g]]) mesh->alike[g] = (int32_t)g;
}

void mesh_own_stiffness_cells_recompute_marked(struct mesh *mesh, const struct particles *p,
                                               const struct mesh_source *s, const uint8_t *cell_is_marked)
{
    struct cell_maker c = maker_of(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2;
    uint8_t *changed = NEW("mesh.changed", mesh_count_groups_of_eight_own_stiffness_cells(mesh), uint8_t);
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        changed[k / LANES] |= cell_is_marked[mesh->own_stiffness_cell[k]];
    alike_part(mesh, changed);
    memory_free(changed);
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        if (cell_is_marked[mesh->own_stiffness_cell[k]])
            mesh_own_stiffness_cell_compute_stiffness(&c, mesh->own_stiffness_cell[k],
                                                      lane_of(mesh->stiffness, k, half));
    ends_free(mesh);
    mesh_own_stiffness_cells_compute_ends(mesh, &c);
    memory_free(c.whole);
}
