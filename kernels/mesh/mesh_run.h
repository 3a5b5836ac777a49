/* Computes the forces of consecutive whole cells (with all points, of one material) by the closed form of mesh_law.h,
 * WIDE cells at a time (lanes.h). A run is a row of consecutive whole cells. */
#ifndef CLEAVE_KERNELS_MESH_RUN
#define CLEAVE_KERNELS_MESH_RUN

#include "mesh_law.h"

/* Calls X(dim, finite) for each number of dimensions and strain measure (finite: 1 for finite, 0 for small strain) for
 * which the forces of cells are compiled. */
#define MESH_FORCES(X) X(1, 0) X(2, 0) X(2, 1) X(3, 0) X(3, 1)

/* Loads the displacements u[c][i] [m] of corner c along axis i of WIDE mesh cells: those number k .. k + WIDE - 1,
 * counted from 0, of `run`, a row of consecutive cells. Vector lanes beyond the last cell are set to 0. */
static ALWAYS_INLINE void mesh_cell_run_load_corner_displacements(const struct mesh *mesh,
                                                                  const struct mesh_cell_run *run, int64_t k,
                                                                  lanes u[CORNERS_MAX][3], const int dim)
{
    const int64_t I = run->cell + k, left = run->cells - k;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_load(mesh->displacement[i] + I + mesh->corner[c]);
    if (left >= WIDE) return;
    lanes inside;
    for (int l = 0; l < WIDE; l++) inside[l] = l < left;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] *= inside;
}

/* Returns true if the problem is 2D (dim = 2) and the elastic constants m are isotropic. The stresses in a cell with
 * all its points, of one material, then have no moment, and cell_add_skew_stress_balancing_moment_finite_strain is not
 * needed.
 */
static ALWAYS_INLINE bool elastic_is_isotropic_in_2d(const struct elastic *m, const int dim)
{
    return dim == 2 && fabs(m->c11 - m->c12 - 2 * m->shear) <= 1e-14 * m->c11;
}

/* Computes the forces f[c][i] [N] on corner c along axis i of WIDE whole cells (with all points, of one material,
 * without partial stresses) from the displacements u[c][i] [m]. m: elastic constants; h, volume: edge [m] and volume
 * [m^3] of a cell; tension: raised to an upper bound of the largest principal stress at the material points [Pa];
 * finite: true if strains are finite, false if small; stress_has_no_moment: result of elastic_is_isotropic_in_2d. */
static ALWAYS_INLINE void full_cells_of_one_material_compute_corner_forces(const struct elastic *m, real h, real volume,
                                                                           lanes u[CORNERS_MAX][3],
                                                                           lanes f[CORNERS_MAX][3], lanes *tension,
                                                                           const int dim, const bool finite,
                                                                           const bool stress_has_no_moment)
{
    struct mesh_cell s;
    const bool rotates = finite && dim > 1;
    cell_compute_rotation_strain_and_modes(&s, h, u, dim, rotates);
    cell_compute_stress_and_hourglass_forces(m, &s, dim);
    *tension = lanes_max(*tension, cell_largest_principal_stress_upper_bound(m, &s, s.P, dim));
    if (rotates && !stress_has_no_moment) cell_add_skew_stress_balancing_moment_finite_strain(&s, (lanes[3]){{0}}, dim);
    cell_compute_corner_forces(&s, h, volume, f, dim, rotates);
}

/* Returns the vector `now` shifted by one lane, with the last entry of `before` in front: {before[WIDE - 1], now[0],
 * .., now[WIDE - 2]}. */
static ALWAYS_INLINE lanes lanes_shift_by_one_inserting_last_of_previous(lanes before, lanes now)
{
#if LANES_WIDE == 4
    return VECTOR_PICK(lanes_mask, before, now, 3, 4, 5, 6);
#else
    return VECTOR_PICK(lanes_mask, before, now, 7, 8, 9, 10, 11, 12, 13, 14);
#endif
}

/* Type of a function that computes the forces f[c][i] [N] on corner c along axis i of the WIDE cells number k to k +
 * WIDE - 1 of `run`, a row of consecutive cells, from the displacements u[c][i] [m]. context: data of the function,
 * which mesh_cell_run_add_forces passes on to it. */
typedef void run_cells_force_fn(void *context, const struct mesh_cell_run *run, int64_t k, lanes u[CORNERS_MAX][3],
                                lanes f[CORNERS_MAX][3]);

/* Adds the forces of the cells of `run`, a row of consecutive cells along x, to the nodes of the mesh, cells at rest
 * left out. compute_forces, context: computes the forces of WIDE cells. Neighbouring cells share nodes: the forces on
 * the upper corners along x of WIDE cells are shifted by one lane and added to those on the lower corners of the next
 * cells, so that each node is written once. */
static ALWAYS_INLINE void mesh_cell_run_add_forces(const struct mesh *mesh, const struct mesh_cell_run *run,
                                                   run_cells_force_fn *compute_forces, void *context, const int dim)
{
    const struct grid *g = &mesh->grid;
    const int64_t row = run->cell / g->count[0], start = run->cell - row * g->count[0];
    const uint8_t *levels = mesh_activity_levels_of_node_blocks_in_row(mesh, row);
    lanes carried[CORNERS_MAX][3];
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) carried[c][i] = lanes_broadcast(0);
    for (int64_t k = 0; k < run->cells; k += WIDE) {
        const int64_t I = run->cell + k;
        lanes u[CORNERS_MAX][3], f[CORNERS_MAX][3];
        /* forces carried from cells at rest are 0 */
        if (mesh_eight_nodes_are_at_rest(levels, start + k / LANES * LANES)) continue;
        mesh_cell_run_load_corner_displacements(mesh, run, k, u, dim);
        compute_forces(context, run, k, u, f);
        for (int c = 0; c < 1 << dim; c += 2)
            for (int i = 0; i < dim; i++) {
                real *to = g->force[i] + I + mesh->corner[c];
                lanes_store(to, lanes_load(to) + (f[c][i] + lanes_shift_by_one_inserting_last_of_previous(
                                                                carried[c][i], f[c + 1][i])));
                carried[c][i] = f[c + 1][i];
            }
    }
    if (run->cells % WIDE == 0) /* else the upper corners of the last cell are in the last vector */
        for (int c = 0; c < 1 << dim; c += 2)
            for (int i = 0; i < dim; i++)
                g->force[i][run->cell + run->cells + mesh->corner[c]] += carried[c][i][WIDE - 1];
}

/* Adds the forces of the elastic cells of `run`, a row of consecutive cells along x, to the nodes of the mesh. Sets
 * run->stressed if the principal stress at a point may exceed the conversion stress, at which material points become
 * peridynamic particles. m: elastic constants of the material of the row; finite: true for finite strain. */
KERNEL(void, mesh_elastic_run_force,
       (const struct mesh *mesh, struct mesh_cell_run *run, const struct elastic *m, bool finite));

#endif
