/* Computes the velocities of the nodes of coarse cells from their momenta (mesh_inertia.h). */
#include "mesh_inertia.h"

#include "kernels/simd/lanes.h"

/* Returns six times the average S w of nodal values at eight nodes along x: w[-1] + 4 w[0] + w[1], with the weights S =
 * (1, 4, 1)/6 of the consistent mass matrix of linear cells in 1D. w: address of the value at the first of the eight
 * nodes. */
static ALWAYS_INLINE lanes line_smooth(const real *w)
{
    return (lanes_load(w - 1) + lanes_load(w + 1)) + 4.0 * lanes_load(w);
}

/* Returns 36 times the average S w of nodal values at eight nodes along x, with the weights S = (1, 4, 1)/6 along x and
 * along y. w: address of the value at the first of the eight nodes; row: index distance of neighbours along y. */
static ALWAYS_INLINE lanes plane_smooth(const real *w, int64_t row)
{
    return (line_smooth(w - row) + line_smooth(w + row)) + 4.0 * line_smooth(w);
}

/* Returns the average S w of nodal values at eight nodes along x. S = (1, 4, 1)/6 along each axis are the weights of
 * the consistent mass matrix of linear cells. w: address of the value at the first node; row, layer: index distances of
 * neighbours along y and z. Valid only if all cells at these nodes have the blended (lumped and consistent) mass matrix
 * of mesh_inertia.h. */
static ALWAYS_INLINE lanes smooth(const real *w, int64_t row, int64_t layer, const int dim)
{
    if (dim == 1) return line_smooth(w) * (1.0 / 6);
    if (dim == 2) return plane_smooth(w, row) * (1.0 / 36);
    return ((plane_smooth(w - layer, row) + plane_smooth(w + layer, row)) + 4.0 * plane_smooth(w, row)) * (1.0 / 216);
}

/* Returns one velocity component of node I of the mesh [m/s], a node between cells with the blended (lumped and
 * consistent) mass matrix of mesh_inertia.h and cells with the lumped one. w: component of the momentum along the same
 * axis at all nodes, divided by the lumped mass [m/s]. */
static ALWAYS_INLINE real node_velocity(const struct mesh *mesh, const real *w, int64_t I, const int dim)
{
    const int corners = 1 << dim;
    real sum = 0;
    for (int c = 0; c < corners; c++) {
        const int64_t cell = I - mesh->corner[c];
        real part = w[I] / corners;
        if (!(mesh->matched[I] >> c & 1)) continue;
        for (int k = 0; k < corners; k++) part -= mesh_consistent_mass_entry(dim, c, k) * w[cell + mesh->corner[k]];
        sum += mesh->cell_mass[mesh->material[cell]] * part;
    }
    return w[I] + mesh->match * mesh->inverse_mass[I] * sum;
}

/* Computes one velocity component v of the nodes of one row along x of a mesh, eight nodes at a time. r: number of the
 * row, from 0; w: the same component of momentum, divided by lumped mass [m/s]; v: velocity [m/s]; both arrays cover
 * all nodes of the mesh. */
static ALWAYS_INLINE void row_velocity(const struct mesh *mesh, int64_t r, const real *w, real *v, const int dim)
{
    const int64_t row = dim > 1 ? mesh->corner[2] : 0, layer = dim > 2 ? mesh->corner[4] : 0,
                  end = mesh->span[2 * r + 1];
    const uint64_t all = EIGHT_TIMES((1 << (1 << dim)) - 1);
    for (int64_t I = mesh->span[2 * r]; I < end; I += LANES) {
        const uint64_t cells = eight_bytes_as_word(mesh->matched + I);
        if (cells == 0)
            lanes_store(v + I, lanes_load(w + I));
        else if (cells == all) {
            const lanes now = lanes_load(w + I);
            lanes_store(v + I, now + mesh->match * (now - smooth(w + I, row, layer, dim)));
        } else
            for (int64_t J = I; J < I + LANES && J < end; J++) v[J] = node_velocity(mesh, w, J, dim);
    }
}

#define VELOCITY(D)                                                                                                    \
    static void velocity_##D(const struct mesh *mesh, real *const *from, real *const *to)                              \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t r = 0; r < mesh->rows; r++) for (int d = 0; d < D;   \
                                                                                                   d++)                \
            row_velocity(mesh, r, from[d], to[d], D);                                                                  \
    }
VELOCITY(1)
VELOCITY(2)
VELOCITY(3)

void mesh_velocity(const struct mesh *mesh, real *const *from, real *const *to)
{
    if (mesh->grid.dim == 1)
        velocity_1(mesh, from, to);
    else if (mesh->grid.dim == 2)
        velocity_2(mesh, from, to);
    else
        velocity_3(mesh, from, to);
}
