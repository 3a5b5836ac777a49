/* Computes the stable time step of the mesh from the largest eigenvalue of single cells. */
#include <math.h>
#include <string.h>

#include "base/eigenvalue.h"
#include "base/memory.h"
#include "mesh_parts.h"
#include "kernels/mesh/mesh_law.h"
#include "kernels/mesh/mesh_point.h"

/* Adds the contribution of point number q (0 .. 2^dim - 1) of a cell to K[n][n], the stiffness matrix for displacements
 * of the corners [N/m], n = 2^dim dim, column by column. m: elastic constants; h: edge of the cell [m]; V: volume of
 * the point [m^3]. */
static void point_stiffness(real *K, const struct elastic *m, int dim, real h, real V, int q)
{
    const int corners = 1 << dim, n = corners * dim;
    for (int column = 0; column < n; column++) {
        real g[DIM_MAX * DIM_MAX] = {0}, s[SYM_MAX], P[DIM_MAX * DIM_MAX];
        for (int d = 0; d < dim; d++)
            g[column % dim * dim + d] = mesh_shape_function_derivative(dim, column / dim, q, d) / h;
        point_hooke_stress(m, g, s, dim);
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++) {
            int a, b;
            symmetric_tensor_component_axes(dim, k, &a, &b);
            P[a * dim + b] = P[b * dim + a] = s[k];
        }
        for (int c = 0; c < corners; c++)
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++)
                    K[column * n + c * dim + a] +=
                        V * mesh_shape_function_derivative(dim, c, q, b) / h * P[a * dim + b];
    }
}

/* Changes the stiffness K[n][n] of cell I of the mesh for displacements of its corners [N/m] such that all N points of
 * `material` in the cell have one dilatation, the mean of their dilatations, against volumetric locking (mesh_law.h):
 * subtracts V k t (x) t for each of these points and adds N V k T (x) T. t[n]: derivative of the trace of the strain
 * at a point by the displacements; T[n]: mean of t over the N points; V: volume of a point; k:
 * elastic_bulk_modulus_if_mean_dilatation. m: elastic constants of the material; p: particles, which include the
 * points. */
static void average_dilatation(const struct mesh *mesh, const struct elastic *m, const struct particles *p, int64_t I,
                               uint8_t material, real *K)
{
    const int dim = mesh->grid.dim, n = dim << dim;
    const real by = elastic_bulk_modulus_if_mean_dilatation(m, dim) * mesh->volume;
    real sum[CELL_UNKNOWNS_MAX] = {0};
    int points = 0;
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        real t[CELL_UNKNOWNS_MAX];
        if (i < 0 || p->material[i] != material) continue;
        points++;
        for (int a = 0; a < n; a++)
            sum[a] += t[a] = mesh_shape_function_derivative(dim, a / dim, q, a % dim) / mesh->grid.h;
        for (int b = 0; b < n; b++)
            for (int a = 0; a < n; a++) K[b * n + a] -= by * t[a] * t[b];
    }
    for (int b = 0; b < n && points > 0; b++)
        for (int a = 0; a < n; a++) K[b * n + a] += by * sum[a] * sum[b] / points;
}

/* Returns true if no point of cell I before point q (0 .. 2^dim - 1) has the given material, so that a loop over the
 * points treats each material of the cell once. p: particles, whose materials are compared. mesh: mesh of the
 * undeformed body. */
static bool first_of_material(const struct mesh *mesh, const struct particles *p, int64_t I, int q, uint8_t material)
{
    for (int k = 0; k < q; k++) {
        const int32_t i = mesh->point[(I << mesh->grid.dim) + k];
        if (i >= 0 && p->material[i] == material) return false;
    }
    return true;
}

bool mesh_compute_cell_stiffness(const struct mesh *mesh, const struct elastic *elastic, const struct particles *p,
                                 int64_t I, real *K)
{
    const int dim = mesh->grid.dim, n = dim << dim;
    bool any = false;
    array_fill_bytes(K, 0, n * n, sizeof *K);
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        if (i < 0) continue;
        const struct elastic *m = &elastic[p->material[i]];
        point_stiffness(K, m, dim, mesh->grid.h, mesh->volume, q);
        if (m->mean_dilatation && first_of_material(mesh, p, I, q, p->material[i]))
            average_dilatation(mesh, m, p, I, p->material[i], K);
        any = true;
    }
    return any;
}

/* ---- time step --------------------------------------------------------------------------------------------------- */

/* Argument of mesh_scaled_stiffness: the stiffness K[n][n] of one cell, divided by the square roots of its nodal
 * masses, and the number n of its unknowns. */
struct scaled_cell {
    const real *K;
    int n;
};

/* Computes the product y[n] = A x of the matrix A = M^-1/2 K M^-1/2 of one cell with a vector x[n], with the stiffness
 * K of the cell and the lumped masses M of its corners. context: A, as a struct scaled_cell. Called by
 * largest_eigenvalue. Loops over columns, so that the inner loop uses vector instructions. */
static void mesh_scaled_stiffness(void *context, const real *x, real *y)
{
    const struct scaled_cell *c = context;
    for (int a = 0; a < c->n; a++) y[a] = 0;
    for (int b = 0; b < c->n; b++)
        for (int a = 0; a < c->n; a++) y[a] += c->K[b * c->n + a] * x[b];
}

/* Returns the largest eigenvalue of M^-1/2 K M^-1/2 [1/s^2] of one cell, with its stiffness K and lumped masses M; a
 * stable time step is at most 2 divided by its square root. m: elastic constants; h: edge of the cell [m]; V: volume of
 * a point [m^3]; density: mass density [kg/m^3]; places: bit set of the points that exist. No eigenvalue of the mesh
 * exceeds that of its stiffest cell alone. For cells whose points have one common dilatation, which are softer, the
 * value is an upper bound. */
static real cell_eigenvalue(const struct elastic *m, int dim, real h, real V, real density, unsigned places)
{
    const int corners = 1 << dim, n = corners * dim;
    real K[CELL_UNKNOWNS_MAX * CELL_UNKNOWNS_MAX] = {0}, mass[CORNERS_MAX] = {0};
    for (int q = 0; q < corners; q++) {
        if (!(places >> q & 1)) continue;
        for (int c = 0; c < corners; c++) mass[c] += density * V * mesh_shape_function_value(dim, c, q);
        point_stiffness(K, m, dim, h, V, q);
    }
    for (int b = 0; b < n; b++)
        for (int a = 0; a < n; a++) K[b * n + a] /= sqrt(mass[a / dim] * mass[b / dim]);
    return largest_eigenvalue(n, mesh_scaled_stiffness, &(struct scaled_cell){K, n});
}

/* Returns the points of cell I of the mesh that exist, as one bit for each of its 2^dim integration points. */
static unsigned mesh_stiffness_places_of(const struct mesh *mesh, int64_t I)
{
    const int dim = mesh->grid.dim;
    unsigned places = 0;
    for (int q = 0; q < 1 << dim; q++) places |= (unsigned)(mesh->point[(I << dim) + q] >= 0) << q;
    return places;
}

/* Returns true if bonds carry a part of the stress of a point of cell I of the mesh (partial stress), so that the cell
 * is softer than without bonds. partial: NULL if no point has bonds. */
static bool leaves_stress(const struct mesh *mesh, const struct partial_stress *partial, int64_t I)
{
    if (!partial || !partial->index) return false;
    for (int q = 0; q < 1 << mesh->grid.dim; q++) {
        const int32_t i = mesh->point[(I << mesh->grid.dim) + q];
        if (i >= 0 && partial->index[i] >= 0) return true;
    }
    return false;
}

real mesh_critical_time_step(const struct mesh *mesh, const struct mesh_source *source, const real *density,
                             bool after_any_conversion)
{
    const int dim = mesh->grid.dim, sets = 1 << (1 << dim);
    bool *there = NEW("mesh.there", sets, bool);
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        if (!leaves_stress(mesh, source->partial, mesh->own_stiffness_cell[k]))
            there[mesh_stiffness_places_of(mesh, mesh->own_stiffness_cell[k])] = true;
    real most = 0;
    for (int set = 1; set < sets; set++) {
        if (!after_any_conversion && !there[set] && set != sets - 1) continue;
        for (int m = 0; m < source->materials; m++)
            most = real_max(
                most, cell_eigenvalue(&source->elastic[m], dim, mesh->grid.h, mesh->volume, density[m], (unsigned)set));
    }
    memory_free(there);
    return 2 / sqrt(most);
}
