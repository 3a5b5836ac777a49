/* Projects a field from the material points of a mesh to its nodes: computes the nodal values whose interpolation fits
 * the values at the points in the least-squares sense. */
#include <math.h>

#include "base/memory.h"
#include "mesh_parts.h"
#include "base/team.h"
#include "kernels/simd/variants.h"

enum { ITERATIONS_MOST = 500 };          /* largest number of iterations of conjugate gradients */
enum { ROW_NONE = -1, ROW_BESIDE = -2 }; /* values of projection.row_of without a row of the matrix */
#define TOLERANCE 1e-15                  /* tolerance of the residual [largest nodal momentum] */

/* Parameters of a projection from points to nodes, and the mass matrix. node: flags of the nodes whose values are
 * computed, others do not change; NULL: all nodes with mass. */
struct projection {
    const struct mesh *mesh;
    const struct particles *p;
    const uint8_t *node;
    real *mass; /* [nodes] mass of a point, if a node has all its points with equal masses; else 0 [kg] */
    /* [nodes] row in `row` of each other node that is computed; ROW_NONE: no row is needed; ROW_BESIDE: the node is
     * beside a slit, so that the nodes around it have no regular indices */
    int32_t *row_of;
    real *row; /* [rows][3^dim] of the mass matrix, by the nodes around [kg] */
};

/* Returns the sum of m_p N_I value_p over the points p of cell `cell` of the mesh m->mesh. m_p: mass of a point; N_I:
 * shape function of node I, which is corner c of the cell; value[particles]: a value for each particle; dim:
 * dimensions, a compile-time constant. */
static ALWAYS_INLINE real cell_sum(const struct projection *m, int64_t cell, int c, const real *value, const int dim)
{
    const int32_t *point = m->mesh->point + (cell << dim);
    real sum = 0;
    for (int q = 0; q < 1 << dim; q++)
        if (point[q] >= 0) sum += m->p->mass[point[q]] * mesh_shape_function_value(dim, c, q) * value[point[q]];
    return sum;
}

/* Returns the number of nodes in the cells around a node, including the node itself, in `dim` dimensions: 3^dim. */
static int nodes_around(int dim) { return dim == 1 ? 3 : dim == 2 ? 9 : 27; }

/* Returns the index, from 0 to 3^dim - 1, of corner k of a cell in the list of the nodes around a node. c: number of
 * the corner of this cell at which the node is; dim: dimensions. */
static int node_around(int dim, int c, int k)
{
    int at = 0;
    for (int d = dim - 1; d >= 0; d--) at = 3 * at + 1 + (k >> d & 1) - (c >> d & 1);
    return at;
}

/* Computes row[3^dim] of the consistent mass matrix of the mesh m->mesh at node I [kg]: the sums of m_p N_I N_J over
 * the points p around node I, for the nodes J around it. */
static void row_make(const struct projection *m, int64_t I, real *row)
{
    const int dim = m->p->dim;
    for (int c = 0; c < 1 << dim; c++) {
        const int32_t *point = m->mesh->point + ((I - m->mesh->corner[c]) << dim);
        for (int q = 0; q < 1 << dim; q++)
            for (int k = 0; k < 1 << dim && point[q] >= 0; k++)
                row[node_around(dim, c, k)] +=
                    m->p->mass[point[q]] * mesh_shape_function_value(dim, c, q) * mesh_shape_function_value(dim, k, q);
    }
}

/* Returns the product of one row of the mass matrix, row[3^dim], with the nodal values around its node. from: address
 * of the value at this node; across, layer: index distances of neighbouring nodes along y and z. */
static ALWAYS_INLINE real row_product(const real *row, const real *from, int64_t across, int64_t layer, const int dim)
{
    real sum = 0;
    for (int c = dim > 2 ? -1 : 0; c <= (dim > 2); c++)
        for (int b = dim > 1 ? -1 : 0; b <= (dim > 1); b++)
            for (int a = -1; a <= 1; a++) sum += *row++ * from[c * layer + b * across + a];
    return sum;
}

/* Returns the product of a row of the mass matrix in 1D with nodal values, if all points around the node exist and have
 * mass 1. With two points in a cell, the sum over points of N_I N_I is 5/8 in each of the two cells, and that of N_I
 * N_J is 3/8 for either neighbour J. from: address of the value at node I, between those of its neighbours. */
static ALWAYS_INLINE real line_product(const real *from) { return 0.375 * (from[-1] + from[1]) + 1.25 * from[0]; }

static ALWAYS_INLINE real plane_product(const real *from, int64_t row)
{
    return 0.375 * (line_product(from - row) + line_product(from + row)) + 1.25 * line_product(from);
}

/* Returns the product of a row of the mass matrix with nodal values in `dim` dimensions, for a node around which all
 * points exist and have mass 1. from: address of the value at the node; row, layer: index distances of neighbouring
 * nodes along y and z. */
static ALWAYS_INLINE real inner_product(const real *from, int64_t row, int64_t layer, const int dim)
{
    if (dim == 1) return line_product(from);
    if (dim == 2) return plane_product(from, row);
    return 0.375 * (plane_product(from - layer, row) + plane_product(from + layer, row)) +
           1.25 * plane_product(from, row);
}

static bool is_unknown(const struct projection *m, int64_t I)
{
    return m->mesh->inverse_mass[I] > 0 && (!m->node || m->node[I]);
}

/* Returns the right side of the projection m at node I, the sum of m_p N_I value_p over the points p around it, cell by
 * cell (m_p: mass, N_I: shape function); 0 if the value at the node is not computed. value[particles]: values to be
 * projected; dim: dimensions. */
static ALWAYS_INLINE real outer_sum(const struct projection *m, int64_t I, const real *value, const int dim)
{
    real sum = 0;
    for (int c = 0; c < 1 << dim && is_unknown(m, I); c++)
        for (int64_t cell = mesh_cell_with_corner_at_node(m->mesh, I, c); cell >= 0;
             cell = mesh_next_subcell_of_cell_divided_by_slits(m->mesh, cell))
            if (mesh_cell_corner_node(m->mesh, cell, c) == I) sum += cell_sum(m, cell, c, value, dim);
    return sum;
}

/* Returns true if a slit (a gap for a pre-crack) divides a cell around node I of the mesh, or such a cell has extra
 * nodes. */
static bool beside_slit(const struct mesh *mesh, int64_t I)
{
    bool beside = false;
    for (int c = 0; c < 1 << mesh->grid.dim && mesh->slits.cell && !beside; c++) {
        const int64_t cell = mesh_cell_with_corner_at_node(mesh, I, c);
        beside = cell >= 0 && (mesh->slits.cell[cell] >= 0 || mesh->slits.cut[cell] >= 0);
    }
    return beside;
}

/* Returns the product of row I of the mass matrix of m with the nodal values `from`, for a node I beside a slit (a gap
 * for a pre-crack). The product is summed point by point, since corners of the cells around I may be extra nodes, which
 * slits add. Returns 0 for nodes whose values the projection m does not compute. dim: dimensions. */
static ALWAYS_INLINE real slit_product(const struct projection *m, int64_t I, const real *from, const int dim)
{
    real sum = 0;
    for (int c = 0; c < 1 << dim && is_unknown(m, I); c++)
        for (int64_t cell = mesh_cell_with_corner_at_node(m->mesh, I, c); cell >= 0;
             cell = mesh_next_subcell_of_cell_divided_by_slits(m->mesh, cell))
            for (int q = 0; q < 1 << dim && mesh_cell_corner_node(m->mesh, cell, c) == I; q++) {
                const int32_t i = m->mesh->point[(cell << dim) + q];
                real value = 0;
                for (int k = 0; k < 1 << dim && i >= 0; k++)
                    value += mesh_shape_function_value(dim, k, q) * from[mesh_cell_corner_node(m->mesh, cell, k)];
                if (i >= 0) sum += m->p->mass[i] * mesh_shape_function_value(dim, c, q) * value;
            }
    return sum;
}

/* Computes to[I] for all nodes I of the mesh of m. If `value` is not NULL, to[I] is the right side of the projection,
 * the sum of m_p N_I value_p over the points p (m_p: mass, N_I: shape function). Else it is the product of the mass
 * matrix with the nodal values `from`. to[I] is 0 for nodes whose values the projection does not compute. Each node is
 * written by one thread. dim: dimensions. */
static ALWAYS_INLINE void nodes_gather(const struct projection *m, const real *value, const real *from, real *to,
                                       const int dim)
{
    const int64_t across = dim > 1 ? m->mesh->corner[2] : 0, layer = dim > 2 ? m->mesh->corner[4] : 0,
                  n = m->mesh->grid.n;
    const real *mass = m->mass;
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < n; I++) {
        if (value)
            to[I] = outer_sum(m, I, value, dim);
        else if (mass[I] > 0)
            to[I] = mass[I] * inner_product(from + I, across, layer, dim);
        else if (m->row_of[I] == ROW_BESIDE)
            to[I] = slit_product(m, I, from, dim);
        else
            to[I] = m->row_of[I] < 0
                        ? 0
                        : row_product(m->row + (int64_t)m->row_of[I] * nodes_around(dim), from + I, across, layer, dim);
    }
}

/* Computes to[I] for all nodes I of the mesh of m, by code compiled for the number of dimensions. If `value` is not
 * NULL, to[I] is the right side of the projection of `value`, a value for each point. Else it is the product of the
 * mass matrix with the nodal values `from`. */
static void gather(const struct projection *m, const real *value, const real *from, real *to)
{
#define CASE(D)                                                                                                        \
    case D:                                                                                                            \
        nodes_gather(m, value, from, to, D);                                                                           \
        break;
    switch (m->p->dim) {
        DIM_VARIANTS(CASE)
    }
}

/* Returns the mass [kg] of each of the 4^dim points in the 2^dim cells around node I of the mesh of m if all of them
 * exist and have the same mass, so that a row of the mass matrix is a constant times this mass. Returns 0 if not, if a
 * slit (a pre-crack as a gap in the mesh) is beside the node, or if the projection m from points to nodes does not
 * compute the value at the node. */
static real mass_around(const struct projection *m, int64_t I)
{
    const int dim = m->p->dim;
    real mass = 0;
    if (!is_unknown(m, I) || beside_slit(m->mesh, I)) return 0;
    for (int c = 0; c < 1 << dim; c++)
        for (int q = 0; q < 1 << dim; q++) {
            const int32_t i = m->mesh->point[((I - m->mesh->corner[c]) << dim) + q];
            if (i < 0 || (c + q > 0 && m->p->mass[i] != mass)) return 0;
            mass = m->p->mass[i];
        }
    return mass;
}

static void masses_find(struct projection *m)
{
    m->mass = NEW("mesh.point_mass", m->mesh->grid.n, real);
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < m->mesh->grid.n; I++) m->mass[I] = mass_around(m, I);
}

/* Computes the rows of the mass matrix of m that inner_product cannot replace: those of nodes whose value is unknown,
 * and around which points are missing or have unequal masses. Nodes beside slits (gaps for pre-cracks) get no row. */
static void mesh_project_rows_make(struct projection *m)
{
    const int64_t n = m->mesh->grid.n, far = m->mesh->corner[(1 << m->p->dim) - 1];
    const int each = nodes_around(m->p->dim);
    int32_t rows = 0;
    m->row_of = BARE("mesh.row_of", n, int32_t);
    for (int64_t I = 0; I < n; I++) {
        const bool without = is_unknown(m, I) && m->mass[I] == 0, beside = without && beside_slit(m->mesh, I);
        m->row_of[I] = !without ? ROW_NONE : beside ? ROW_BESIDE : rows++;
    }
    m->row = NEW("mesh.row", (int64_t)rows * each, real);
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < n; I++)
        if (m->row_of[I] >= 0) {
            INVARIANT(I >= far && I + far < n); /* a grid has a margin (grid.h) */
            row_make(m, I, m->row + (int64_t)m->row_of[I] * each);
        }
}

struct pair {
    const real *a, *b, *weight;
}; /* weight NULL: 1 */

static void product_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct pair *q = context;
    for (int64_t I = first; I < end && q->weight; I++) sum[0] += q->a[I] * q->b[I] * q->weight[I];
    for (int64_t I = first; I < end && !q->weight; I++) sum[0] += q->a[I] * q->b[I];
}

/* Returns the sum of a[k] b[k] weight[k] over n nodes k. All weights are 1 if `weight` is NULL. The sum does not depend
 * on the number of threads. */
static real product(const real *a, const real *b, const real *weight, int64_t n)
{
    real sum;
    reproducible_sums(n, 1, product_block, &(struct pair){a, b, weight}, &sum);
    return sum;
}

static real mesh_project_largest_of(const real *a, int64_t n)
{
    real most = 0;
    for (int64_t I = 0; I < n; I++) most = real_max(most, fabs(a[I]));
    return most;
}

/* Computes x[nodes], the nodal values whose interpolation fits value[particles], the values at the points, by least
 * squares weighted with mass. Solves with the consistent mass matrix of m by conjugate gradients, with the lumped
 * matrix as preconditioner, until the largest residual is TOLERANCE times the largest entry of the right side or
 * ITERATIONS_MOST is reached, which is not reported. Starts from the lumped projection if m->node is NULL, i.e. if the
 * values at all nodes with mass are computed, else from x; x does not change at nodes that are not computed. */
static void project(const struct projection *m, const real *value, real *x)
{
    const int64_t n = m->mesh->grid.n;
    const real *inverse = m->mesh->inverse_mass;
    real *r = NEW("mesh.r", n, real), *d = NEW("mesh.d", n, real), *q = NEW("mesh.q", n, real);
    gather(m, value, NULL, r);
    const real scale = mesh_project_largest_of(r, n);
    for (int64_t I = 0; I < n && !m->node; I++) x[I] = r[I] * inverse[I];
    gather(m, NULL, x, q);
    for (int64_t I = 0; I < n; I++) r[I] -= q[I], d[I] = r[I] * inverse[I];
    real rho = product(r, r, inverse, n);
    for (int k = 0; k < ITERATIONS_MOST && mesh_project_largest_of(r, n) > TOLERANCE * scale; k++) {
        gather(m, NULL, d, q);
        const real one = product(d, q, NULL, n);
        if (!(one > 0)) break;
        const real step = rho / one;
        for (int64_t I = 0; I < n; I++) x[I] += step * d[I], r[I] -= step * q[I];
        const real next = product(r, r, inverse, n);
        for (int64_t I = 0; I < n; I++) d[I] = r[I] * inverse[I] + next / rho * d[I];
        rho = next;
    }
    memory_free(r);
    memory_free(d);
    memory_free(q);
}

/* Projects a vector field from the points of the mesh to its nodes. value[dim]: arrays with a value for each particle;
 * node[dim]: receive a value for each node. m: parameters of the projection, whose arrays are allocated and freed
 * here. */
static void project_all(struct projection m, real *const *value, real *const *node)
{
    masses_find(&m);
    mesh_project_rows_make(&m);
    for (int a = 0; a < m.p->dim; a++) project(&m, value[a], node[a]);
    memory_free(m.mass);
    memory_free(m.row_of);
    memory_free(m.row);
}

void mesh_fit_nodal_values_to_point_values(const struct mesh *mesh, const struct particles *p, real *const *point_value,
                                           real *const *nodal_value)
{
    project_all((struct projection){.mesh = mesh, .p = p}, point_value, nodal_value);
}

void mesh_fit_listed_nodal_values_to_point_values(const struct mesh *mesh, const struct particles *p,
                                                  real *const *point_value, real *const *nodal_value,
                                                  const int32_t *node_list, int64_t node_count)
{
    uint8_t *mark = NEW("mesh.unknown", mesh->grid.n, uint8_t);
    for (int64_t k = 0; k < node_count; k++) mark[node_list[k]] = 1;
    project_all((struct projection){.mesh = mesh, .p = p, .node = mark}, point_value, nodal_value);
    memory_free(mark);
}
