/* Finds inverted cells of the mesh, i.e. cells with a volume ratio of 0 or less. A linear stress law does not prevent
 * such compression. */
#include "mesh_parts.h"

/* Returns the ratio of present to reference volume at an integration point of a cell of the mesh, 0 or less if the cell
 * is inverted there: the determinant of 1 + sum_c u_c (x) grad N_c over the corners c, with their displacements u_c and
 * shape functions N_c. place: (cell << dim) + number of the integration point in the cell. */
static real volume_ratio(const struct mesh *mesh, int32_t place, int dim)
{
    const int32_t cell = place >> dim;
    real F[DIM_MAX][DIM_MAX] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int c = 0; c < 1 << dim; c++)
        for (int b = 0; b < dim; b++) {
            const real slope = mesh_shape_function_derivative(dim, c, place & ((1 << dim) - 1), b) / mesh->grid.h;
            for (int a = 0; a < dim; a++)
                F[a][b] += mesh->displacement[a][mesh_cell_corner_node(mesh, cell, c)] * slope;
        }
    return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
           F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

/* Returns false if cell `cell` of the mesh cannot be inverted, by a cheap test: dim times the largest difference of a
 * displacement component between two corners is less than the cell edge. Returns true if it may be inverted. Reason: no
 * entry of the displacement gradient exceeds the largest difference of a component between corners divided by the cell
 * edge, and a gradient with row sums below 1 inverts no cell. dim: number of dimensions, known at compile time. */
static inline bool may_invert(const struct mesh *mesh, int64_t cell, const int dim)
{
    real most = 0;
    for (int a = 0; a < dim; a++) {
        const real *u = mesh->displacement[a];
        real low = u[mesh_cell_corner_node(mesh, cell, 0)], high = low;
        for (int c = 1; c < 1 << dim; c++) {
            const real here = u[mesh_cell_corner_node(mesh, cell, c)];
            low = real_min(low, here), high = real_max(high, here);
        }
        most = real_max(most, high - low);
    }
    return !(dim * most < mesh->grid.h);
}

/* Returns the smallest particle number below `first` among the points of cell `cell` of the mesh at which the cell is
 * turned inside out (volume ratio <= 0); `first` if there is no such point. dim: number of dimensions. */
static int64_t inverted_in(const struct mesh *mesh, int64_t cell, int dim, int64_t first)
{
    for (int64_t place = cell << dim; place < (cell + 1) << dim; place++) {
        const int32_t i = mesh->point[place];
        if (i >= 0 && i < first && !(volume_ratio(mesh, (int32_t)place, dim) > 0)) first = i;
    }
    return first;
}

bool mesh_cell_is_inverted(const struct mesh *mesh, int64_t cell)
{
    const int dim = mesh->grid.dim;
    bool inverted = false;
    for (int q = 0; q < 1 << dim && may_invert(mesh, cell, dim); q++)
        inverted |= !(volume_ratio(mesh, (int32_t)((cell << dim) + q), dim) > 0);
    return inverted;
}

int64_t mesh_first_particle_in_inverted_cell(const struct mesh *mesh, const struct particles *p)
{
    int64_t first = p->n;
#pragma omp parallel for schedule(static) reduction(min : first)
    for (int64_t row = 0; row < mesh->rows; row++) {
        const int64_t start = row * mesh->grid.count[0];
        const bool box = start < mesh->slits.first; /* extra cells are not beside the nodes of the same index */
        const int64_t from = box ? mesh->span[2 * row] : start,
                      end = box ? mesh->span[2 * row + 1] : start + mesh->grid.count[0];
        for (int64_t cell = from; cell < end; cell++)
            if (mesh->kind[cell] && mesh->kind[cell] != CELL_COARSE && may_invert(mesh, cell, p->dim))
                first = inverted_in(mesh, cell, p->dim, first);
    }
    return first;
}
