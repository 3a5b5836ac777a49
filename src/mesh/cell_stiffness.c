/* Computes the stiffness matrix of a cell with missing or unequal points, in terms of deformation modes
 * (kernels/mesh/mesh_own_stiffness.h), from the points that it contains.
 *
 * The strain at a point is the uniform strain plus, for each bending mode, an amplitude times a product of coordinates
 * +-1/4. An entry of the stiffness matrix thus is a sum over the points of D, the matrix of stress by strain, times
 * signs of coordinates. As the square of a sign is 1, there is one such sum for each set of axes. */
#include "cell_stiffness.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "kernels/mesh/mesh_point.h"

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

bool cell_compute_averaged_strains(const struct cell_maker *c, int64_t I, point_strains B)
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

/* Computes the stiffness matrix K[MODES_MAX][MODES_MAX] [Pa] of cell with own stiffness I (a cell with missing or
 * unequal points, which has a stiffness matrix of its own), in terms of its deformation modes. c: mesh and particles;
 * B: strains of its points for unit amplitudes of the modes, with the mean dilatation (averaged_strains). */
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

void cell_compute_own_stiffness(const struct cell_maker *c, int64_t I, real *K)
{
    const int n = c->modes;
    real sum[CORNERS_MAX][SYM_MAX * SYM_MAX], averaged[MODES_MAX][MODES_MAX];
    point_strains B;
    if (cell_compute_averaged_strains(c, I, B)) {
        averaged_cell_make(c, I, B, averaged);
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++, K += LANES) *K = averaged[a][b];
        return;
    }
    cell_sums(c, I, sum);
    for (int a = 0; a < n; a++)
        for (int b = a; b < n; b++, K += LANES) *K = own_stiffness_entry(c, sum, &c->in[a], &c->in[b]);
}

struct cell_maker cell_maker_make(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s)
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
