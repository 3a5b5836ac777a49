/* Displacement gradient, strain and stress at each material point of one cell of a mesh, point by point (mesh_law.h has
 * the sums over the points in closed form).
 *
 * Point number q of a cell is at a quarter or three quarters of the edge along every axis, next to corner q. Values are
 * interpolated from corners to points, and distributed from points to corners, along one axis after the other, as near
 * + (far - near)/4. The factor 1/4 is exact, so cell_interpolate_corner_values_to_points and
 * cell_interpolate_corner_values_to_one_point give equal bits. */
#ifndef CLEAVE_KERNELS_MESH_POINT
#define CLEAVE_KERNELS_MESH_POINT

#include "kernels/kernels.h"
#include "base/polar.h"
#include "kernels/mpm/stress.h"

/* Calls X(dim) for dim = 1, 2 and 3, to define one function for each number of dimensions. Parallel loops (OpenMP) are
 * inside these functions. */
#define DIMENSIONS(X) X(1) X(2) X(3)

/* Replaces the values at the two ends of an edge by the linearly interpolated values at one quarter (*low) and three
 * quarters (*high) of the edge. */
static ALWAYS_INLINE void edge_interpolate_end_values_to_quarter_points(real *low, real *high)
{
    const real by = 0.25 * (*high - *low), near = *low + by;
    *high = *high - by;
    *low = near;
}

/* Replaces the values value[2^dim] at the corners of a cell by the interpolated values at its 2^dim material points, in
 * place. The interpolation matrix is symmetric, so the function also distributes values of the points to the
 * corners. */
static ALWAYS_INLINE void cell_interpolate_corner_values_to_points(real *value, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c >> d & 1)) edge_interpolate_end_values_to_quarter_points(&value[c], &value[c | 1 << d]);
}

/* Returns the value at material point number `point` (0 .. 2^dim - 1) of a cell, interpolated linearly from the corners
 * of the cell. value: values at the 2^dim corners, overwritten. */
static ALWAYS_INLINE real cell_interpolate_corner_values_to_one_point(real *value, int point, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c & ((2 << d) - 1))) {
                const real low = value[c], high = value[c | 1 << d], by = 0.25 * (high - low);
                value[c] = point >> d & 1 ? high - by : low + by;
            }
    return value[0];
}

/* Loads the values of a nodal quantity at the 2^dim corners of cell number `cell` of the mesh into `corner_value`.
 * field: the quantity, one value for each node of the mesh. */
static ALWAYS_INLINE void mesh_load_corner_values(const struct mesh *mesh, const real *field, int64_t cell,
                                                  real *corner_value, const int dim)
{
    const int32_t *own = mesh_cell_corner_nodes_if_at_slit(mesh, cell);
    for (int c = 0; c < 1 << dim; c++) corner_value[c] = field[own ? own[c] : cell + mesh->corner[c]];
}

/* Computes the displacement gradient [1] at each material point of cell `cell` of the mesh: gradient[q][a dim + b] =
 * du_a/dX_b at point q (0 .. 2^dim - 1). */
static ALWAYS_INLINE void mesh_compute_displacement_gradients_at_points(const struct mesh *mesh, int64_t cell,
                                                                        real gradient[CORNERS_MAX][DIM_MAX * DIM_MAX],
                                                                        const int dim)
{
    const real inverse = 1 / mesh->grid.h;
    for (int a = 0; a < dim; a++) {
        real u[CORNERS_MAX];
        mesh_load_corner_values(mesh, mesh->displacement[a], cell, u, dim);
        for (int b = 0; b < dim; b++) {
            real v[CORNERS_MAX];
            for (int c = 0; c < 1 << dim; c++) v[c] = u[c ^ 1 << b] - u[c];
            for (int c = 0; c < 1 << dim; c++) v[c] *= c >> b & 1 ? -inverse : inverse;
            for (int d = 0; d < dim; d++)
                for (int c = 0; c < 1 << dim; c++)
                    if (d != b && !(c >> d & 1)) edge_interpolate_end_values_to_quarter_points(&v[c], &v[c | 1 << d]);
            for (int q = 0; q < 1 << dim; q++) gradient[q][a * dim + b] = v[q];
        }
    }
}

/* Computes the strains R^T F - 1 [1] at each material point of cell `cell` of the mesh, with the deformation gradient F
 * at the point and the rotation R of the mean deformation gradient of the cell. rotation: receives R, dim x dim row by
 * row; the identity if `finite` (finite strain) is false or in 1D. strain[q]: dim x dim row by row for point q; only
 * its symmetric part is strain. */
static ALWAYS_INLINE void mesh_compute_strains_at_points(const struct mesh *mesh, int64_t cell, real *rotation,
                                                         real strain[CORNERS_MAX][DIM_MAX * DIM_MAX], const int dim,
                                                         bool finite)
{
    real g[CORNERS_MAX][DIM_MAX * DIM_MAX], mean[DIM_MAX * DIM_MAX];
    mesh_compute_displacement_gradients_at_points(mesh, cell, g, dim);
    if (!finite || dim == 1) {
        for (int a = 0; a < dim * dim; a++) rotation[a] = a % (dim + 1) == 0;
        for (int q = 0; q < 1 << dim; q++)
            for (int a = 0; a < dim * dim; a++) strain[q][a] = g[q][a];
        return;
    }
    for (int a = 0; a < dim * dim; a++) {
        real sum = 0;
        for (int q = 0; q < 1 << dim; q++) sum += g[q][a];
        mean[a] = sum / (1 << dim) + (a % (dim + 1) == 0);
    }
    polar_rotation(mean, rotation, dim);
    for (int q = 0; q < 1 << dim; q++)
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++) {
                strain[q][a * dim + b] = rotation[b * dim + a] - (a == b);
                for (int k = 0; k < dim; k++) strain[q][a * dim + b] += rotation[k * dim + a] * g[q][k * dim + b];
            }
}

/* Returns true if at least one point of a cell is of a material whose points in a cell have one common dilatation, the
 * mean (elastic.mean_dilatation). m: elastic constants of all materials; material: number of the material of every
 * particle; point: the 2^dim points of the cell, -1: none. */
static ALWAYS_INLINE bool cell_uses_mean_dilatation(const struct elastic *m, const uint8_t *material,
                                                    const int32_t *point, const int dim)
{
    bool any = false;
    for (int q = 0; q < 1 << dim; q++) any |= point[q] >= 0 && m[material[point[q]]].mean_dilatation;
    return any;
}

/* Replaces value[q] of each point q (0 .. 2^dim - 1) of a cell by mean - value[q], with the mean of the values over the
 * points of the cell that have the same material. This is the change that gives all these points the mean. value[q]
 * becomes 0 for materials without mean dilatation, and where there is no point. m: elastic constants of all materials;
 * material: number of the material of every particle; point: the 2^dim points of the cell, -1: none. */
static ALWAYS_INLINE void cell_replace_point_values_by_mean_minus_value(const struct elastic *m,
                                                                        const uint8_t *material, const int32_t *point,
                                                                        real *value, const int dim)
{
    unsigned left = 0;
    for (int q = 0; q < 1 << dim; q++) {
        const bool averaged = point[q] >= 0 && m[material[point[q]]].mean_dilatation;
        if (averaged)
            left |= 1u << q;
        else
            value[q] = 0;
    }
    while (left) {
        const uint8_t first = material[point[__builtin_ctz(left)]];
        unsigned own = 0;
        real sum = 0;
        for (int q = 0; q < 1 << dim; q++)
            if (left >> q & 1 && material[point[q]] == first) own |= 1u << q, sum += value[q];
        const real mean = sum / __builtin_popcount(own);
        for (int q = 0; q < 1 << dim; q++)
            if (own >> q & 1) value[q] = mean - value[q];
        left &= ~own;
    }
}

/* Replaces the traces of the strains of the points (particles of p) of cell `cell` of the mesh by their mean over the
 * points of the same material, where the points of this material have one dilatation (elastic.mean_dilatation). strain:
 * as from mesh_compute_strains_at_points; m: elastic constants of all materials. */
static ALWAYS_INLINE void mesh_replace_dilatation_in_strains_by_cell_mean(const struct mesh *mesh,
                                                                          const struct particles *p,
                                                                          const struct elastic *m, int64_t cell,
                                                                          real strain[CORNERS_MAX][DIM_MAX * DIM_MAX],
                                                                          const int dim)
{
    const int32_t *point = &mesh->point[cell << dim];
    real trace[CORNERS_MAX] = {0};
    if (!cell_uses_mean_dilatation(m, p->material, point, dim)) return;
    for (int q = 0; q < 1 << dim; q++)
        for (int d = 0; d < dim; d++) trace[q] += strain[q][d * (dim + 1)];
    cell_replace_point_values_by_mean_minus_value(m, p->material, point, trace, dim);
    for (int q = 0; q < 1 << dim; q++)
        for (int d = 0; d < dim; d++) strain[q][d * (dim + 1)] += trace[q] / dim;
}

/* Computes the stress of a material point from its strain by Hooke's law. strain: dim x dim row by row, of which the
 * symmetric part counts [1]; stress: receives symmetric components [Pa]; m: elastic constants. */
static ALWAYS_INLINE void point_hooke_stress(const struct elastic *m, const real *strain, real *stress, const int dim)
{
    for (int a = 0; a < dim; a++) {
        stress[a] = m->c11 * strain[a * dim + a];
        for (int b = 0; b < dim; b++)
            if (b != a) stress[a] += m->c12 * strain[b * dim + b];
    }
    for (int k = dim; k < symmetric_tensor_component_count(dim); k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        stress[k] = m->shear * (strain[a * dim + b] + strain[b * dim + a]);
    }
}

#endif
