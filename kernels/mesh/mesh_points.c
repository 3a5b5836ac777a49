/* Transfers between a mesh and its material points: motion, forces, stress and displacement gradient of the points, and
 * rotation of points with bonds. Point number q of a cell is the point next to corner q. */
#include "mesh_flow.h"
#include "mesh_own_stiffness.h"
#include "mesh_point.h"
#include "kernels/pd/rotation.h"

/* Returns the number of cells that may have points: those in mesh->filled_cell if mesh->absent, else all cells. */
static ALWAYS_INLINE int64_t cells_of_points(const struct mesh *mesh)
{
    return mesh->absent ? mesh->filled_cells : mesh->grid.n;
}

/* Returns the index of the k-th cell that may have points, k from 0 to cells_of_points(mesh) - 1. */
static ALWAYS_INLINE int64_t cell_of_points(const struct mesh *mesh, int64_t k)
{
    return mesh->absent ? mesh->filled_cell[k] : k;
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* Sets position and velocity in p of material points of mesh cell I by linear interpolation from the nodes of the
 * cell. places: bit q is set for each point q = 0 .. 2^dim - 1 of the cell that is to be moved. */
static ALWAYS_INLINE void cell_move(const struct mesh *mesh, struct particles *p, int64_t I, unsigned places,
                                    const int dim)
{
    const int32_t *point = &mesh->point[I << dim];
    for (int a = 0; a < dim; a++) {
        real u[CORNERS_MAX], v[CORNERS_MAX];
        mesh_load_corner_values(mesh, mesh->displacement[a], I, u, dim);
        mesh_load_corner_values(mesh, mesh->grid.velocity[a], I, v, dim);
        cell_interpolate_corner_values_to_points(u, dim);
        cell_interpolate_corner_values_to_points(v, dim);
        for (int q = 0; q < 1 << dim; q++) {
            const int32_t i = point[q];
            if (i < 0 || !(places >> q & 1)) continue;
            p->x[a][i] = p->X[a][i] + u[q];
            p->v[a][i] = v[q];
        }
    }
}

/* Sets position and velocity in p of the single point i by linear interpolation from the nodes of its cell. */
static ALWAYS_INLINE void point_move(const struct mesh *mesh, struct particles *p, int64_t i, const int dim)
{
    const int64_t I = mesh->place[i] >> dim;
    const int q = mesh->place[i] & ((1 << dim) - 1);
    for (int a = 0; a < dim; a++) {
        real u[CORNERS_MAX], v[CORNERS_MAX];
        mesh_load_corner_values(mesh, mesh->displacement[a], I, u, dim);
        mesh_load_corner_values(mesh, mesh->grid.velocity[a], I, v, dim);
        p->x[a][i] = p->X[a][i] + cell_interpolate_corner_values_to_one_point(u, q, dim);
        p->v[a][i] = cell_interpolate_corner_values_to_one_point(v, q, dim);
    }
}

enum { FEW = 128 }; /* number of cells whose points one thread moves in less time than a team; empirical */

#define MOVE(D)                                                                                                        \
    static void all_move_##D(const struct mesh *mesh, struct particles *p)                                             \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < cells_of_points(mesh);                    \
                                                          k++) if (mesh->kind[cell_of_points(mesh, k)])                \
            cell_move(mesh, p, cell_of_points(mesh, k), ~0u, D);                                                       \
    }                                                                                                                  \
    static void exposed_move_##D(const struct mesh *mesh, struct particles *p)                                         \
    {                                                                                                                  \
        TEAM_LOOP(mesh->exposed > FEW, for (int64_t k = 0; k < mesh->exposed; k++) cell_move(                          \
                                           mesh, p, mesh->exposed_list[k].cell, mesh->exposed_list[k].places, D););    \
    }                                                                                                                  \
    static void points_move_##D(const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n)          \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < n; k++) if (mesh->place[list[k]] >= 0)    \
            point_move(mesh, p, list[k], D);                                                                           \
    }
DIMENSIONS(MOVE)

void mesh_points_move(const struct mesh *mesh, struct particles *p)
{
    if (p->dim == 1)
        all_move_1(mesh, p);
    else if (p->dim == 2)
        all_move_2(mesh, p);
    else
        all_move_3(mesh, p);
}

void mesh_exposed_move(const struct mesh *mesh, struct particles *p)
{
    if (p->dim == 1)
        exposed_move_1(mesh, p);
    else if (p->dim == 2)
        exposed_move_2(mesh, p);
    else
        exposed_move_3(mesh, p);
}

void mesh_listed_move(const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n)
{
    if (p->dim == 1)
        points_move_1(mesh, p, list, n);
    else if (p->dim == 2)
        points_move_2(mesh, p, list, n);
    else
        points_move_3(mesh, p, list, n);
}

/* ---- bonded points ----------------------------------------------------------------------------------------------- */

/* Computes the rotations of eight cells from their strain cell: rotation[] receives cos - 1 and sin of the angle in 2D,
 * a quaternion in 3D. rotates: true for the finite rotation cell->R, false for that of small displacement gradients. */
static ALWAYS_INLINE void cells_rotate(const struct mesh_cell *cell, lanes *rotation, const int dim, const bool rotates)
{
    lanes R[DIM_MAX * DIM_MAX], w[3], square = lanes_broadcast(0);
    for (int a = 0; a < dim && rotates; a++)
        for (int b = 0; b < dim; b++) R[a * dim + b] = cell->R[a][b];
    for (int k = dim == 2 ? 2 : 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        w[k] =
            0.25 *
            (cell->mode[1 << i][j] -
             cell->mode[1 << j][i]); /* a quarter of the curl: half of the rotation angle, halved for the quaternion */
        square += w[k] * w[k];
    }
    if (dim == 2) {
        rotation[0] = rotates ? R[0] - 1.0 : -2.0 * square / (1.0 + square);
        rotation[1] = rotates ? R[2] : 2.0 * w[2] / (1.0 + square);
        return;
    }
    if (rotates) {
        rotation_encode_with_spring_stiffness(rotation, R, lanes_broadcast(0.5), 3);
        return;
    }
    rotation[3] = lanes_inverse_square_root(1.0 + square);
    for (int k = 0; k < 3; k++) rotation[k] = w[k] * rotation[3];
}

/* Computes two quantities for material points with state-based bonds, of the eight cells with own stiffness (with
 * missing or unequal points) in group number `group`. p->end_rotation: rotation of the cell of the point;
 * p->end_strain: part of the cell in the mean strain of the bonds of the point [1]. finite: true for finite strain. */
static ALWAYS_INLINE void group_ends_update(const struct mesh *mesh, struct particles *p, int64_t group, const int dim,
                                            const bool finite)
{
    struct mesh_cell s;
    lanes u[CORNERS_MAX][3], v[MODES_MAX], rotation[ROTATION];
    const int n = cell_deformation_mode_count(dim);
    if (mesh->ends[group] == mesh->ends[group + 1]) return;
    mesh_cells_with_own_stiffness_gather_displacements(mesh, group, u, dim);
    cell_compute_rotation_strain_and_modes(&s, mesh->grid.h, u, dim, finite);
    cells_pack_strains_and_mode_amplitudes_in_vector(&s, v, dim);
    if (p->end_rotation[0]) cells_rotate(&s, rotation, dim, finite);
    for (int32_t k = mesh->ends[group]; k < mesh->ends[group + 1]; k++) {
        const struct mesh_end *end = &mesh->end[k];
        const real *share = mesh->end_share + (int64_t)k * n;
        real strain = 0;
        for (int m = 0; m < n; m++) strain += share[m] * v[m][end->lane];
        p->end_strain[end->point] = strain;
        for (int c = 0; p->end_rotation[0] && c < (dim == 2 ? 2 : ROTATION); c++)
            p->end_rotation[c][end->point] = rotation[c][end->lane];
    }
}

#define ENDS(D, FINITE)                                                                                                \
    static NEVER_INLINE void group_ends_##D##_##FINITE(const struct mesh *mesh, struct particles *p, int64_t k)        \
    {                                                                                                                  \
        group_ends_update(mesh, p, k, D, FINITE);                                                                      \
    }                                                                                                                  \
    static void ends_update_##D##_##FINITE(const struct mesh *mesh, struct particles *p)                               \
    {                                                                                                                  \
        TEAM_LOOP(mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) > FEW / LANES,                             \
                  for (int64_t k = 0; k < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh); k++)              \
                      group_ends_##D##_##FINITE(mesh, p, k););                                                         \
    }
ENDS(2, false)
ENDS(2, true)
ENDS(3, false)
ENDS(3, true)

void mesh_ends_update(const struct mesh *mesh, struct particles *p, bool finite)
{
    if (!mesh->ends) return;
    if (p->dim == 2) (finite ? ends_update_2_true : ends_update_2_false)(mesh, p);
    if (p->dim == 3) (finite ? ends_update_3_true : ends_update_3_false)(mesh, p);
}

/* ---- forces of points -------------------------------------------------------------------------------------------- */

/* Adds the forces p->f on material points of cell I to the nodes of this mesh cell, by interpolation weights. places:
 * bit q is set for each point q = 0 .. 2^dim - 1 of the cell whose force is added. */
static ALWAYS_INLINE void cell_pull(struct mesh *mesh, const struct particles *p, int64_t I, unsigned places,
                                    const int dim)
{
    const int32_t *point = &mesh->point[I << dim];
    for (int a = 0; a < dim; a++) {
        real f[CORNERS_MAX];
        for (int q = 0; q < 1 << dim; q++) f[q] = places >> q & 1 ? p->f[a][point[q]] : 0;
        cell_interpolate_corner_values_to_points(f, dim);
        for (int c = 0; c < 1 << dim; c++) mesh->grid.force[a][mesh_cell_corner_node(mesh, I, c)] += f[c];
    }
}

void mesh_exposed_force(struct mesh *mesh, const struct particles *p)
{
    for (int64_t k = 0; k < mesh->exposed; k++) { /* few, and cells share nodes: in order */
        const struct mesh_exposed s = mesh->exposed_list[k];
        if (p->dim == 1)
            cell_pull(mesh, p, s.cell, s.places, 1);
        else if (p->dim == 2)
            cell_pull(mesh, p, s.cell, s.places, 2);
        else
            cell_pull(mesh, p, s.cell, s.places, 3);
    }
}

/* ---- stress ------------------------------------------------------------------------------------------------------ */

/* Stores the Cauchy stress of point i in p: the stress s of the strain e at small strain; at finite strain R sym(s U)
 * R^T/det U, with U = 1 + e and the rotation R of the cell, and also the volume of the point. In plates that yield
 * (plane stress) the stress is divided by the stretch of the thickness. m: elastic constants of the point's material;
 * R, e: dim x dim, row by row; finite: true for finite strain. */
static ALWAYS_INLINE void store_point_stress(struct particles *p, const struct elastic *m, int64_t i, const real *R,
                                             const real *e, const int dim, bool finite)
{
    const int n = symmetric_tensor_component_count(dim);
    real s[SYM_MAX], S[9], T[9], det = 1;
    if (mesh_points_can_yield(p))
        point_compute_trial_stress(p, m, i, e, s, dim);
    else
        point_hooke_stress(m, e, s, dim);
    if (!finite) {
        for (int k = 0; k < n; k++) p->stress[k][i] = s[k];
        return;
    }
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        S[a * dim + b] = S[b * dim + a] = s[k];
    }
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            T[a * dim + b] = S[a * dim + b];
            for (int k = 0; k < dim; k++) T[a * dim + b] += S[a * dim + k] * 0.5 * (e[k * dim + b] + e[b * dim + k]);
        }
    if (dim == 1) det = 1 + e[0];
    if (dim == 2) det = ((1 + e[0]) * (1 + e[3]) - e[1] * e[2]) * mesh_point_plane_stress_thickness_stretch(p, m, i, s);
    if (dim == 3)
        det = (1 + e[0]) * ((1 + e[4]) * (1 + e[8]) - e[5] * e[7]) - e[1] * (e[3] * (1 + e[8]) - e[5] * e[6]) +
              e[2] * (e[3] * e[7] - (1 + e[4]) * e[6]);
    for (int k = 0; k < n; k++) {
        int a, b;
        real sum = 0;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        for (int c = 0; c < dim; c++)
            for (int d = 0; d < dim; d++)
                sum += R[a * dim + c] * 0.5 * (T[c * dim + d] + T[d * dim + c]) * R[b * dim + d];
        p->stress[k][i] = sum / det;
    }
    p->volume[i] = p->volume0[i] * det;
}

/* Stores Cauchy stress and, at finite strain (`finite`), volume of the points of cell I in p. m: elastic constants. */
static ALWAYS_INLINE void cell_stress(const struct mesh *mesh, struct particles *p, const struct elastic *m, int64_t I,
                                      const int dim, bool finite)
{
    real R[9], e[CORNERS_MAX][DIM_MAX * DIM_MAX];
    mesh_compute_strains_at_points(mesh, I, R, e, dim, finite);
    mesh_replace_dilatation_in_strains_by_cell_mean(mesh, p, m, I, e, dim);
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        if (i >= 0) store_point_stress(p, &m[p->material[i]], i, R, e[q], dim, finite);
    }
}

#define STRESS(D)                                                                                                      \
    static void stress_##D(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)         \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < cells_of_points(mesh);                    \
                                                          k++) if (mesh->kind[cell_of_points(mesh, k)])                \
            cell_stress(mesh, p, m, cell_of_points(mesh, k), D, finite);                                               \
    }
DIMENSIONS(STRESS)

void mesh_points_stress(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)
{
    if (p->dim == 1)
        stress_1(mesh, p, m, finite);
    else if (p->dim == 2)
        stress_2(mesh, p, m, finite);
    else
        stress_3(mesh, p, m, finite);
}

/* Stores the gradient du_a/dX_b [1] of the displacement u at each point i of cell I in to[a dim + b][i]. */
static ALWAYS_INLINE void cell_gradient(const struct mesh *mesh, int64_t I, real *const *to, const int dim)
{
    real g[CORNERS_MAX][DIM_MAX * DIM_MAX];
    mesh_compute_displacement_gradients_at_points(mesh, I, g, dim);
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        for (int a = 0; a < dim * dim && i >= 0; a++) to[a][i] = g[q][a];
    }
}

#define GRADIENT(D)                                                                                                    \
    static void gradient_##D(const struct mesh *mesh, real *const *to)                                                 \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < cells_of_points(mesh);                    \
                                                          k++) if (mesh->kind[cell_of_points(mesh, k)])                \
            cell_gradient(mesh, cell_of_points(mesh, k), to, D);                                                       \
    }
DIMENSIONS(GRADIENT)

void mesh_points_gradient(const struct mesh *mesh, real *const *to)
{
    if (mesh->grid.dim == 1)
        gradient_1(mesh, to);
    else if (mesh->grid.dim == 2)
        gradient_2(mesh, to);
    else
        gradient_3(mesh, to);
}
