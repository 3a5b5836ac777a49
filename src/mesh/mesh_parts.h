/* Declarations shared by the files of src/mesh: cells with own stiffness and their stiffness, slits, fits of nodal
 * values, masses and blocks of nodes. */
#ifndef CLEAVE_MESH_PARTS
#define CLEAVE_MESH_PARTS

#include "base/memory.h"
#include "mesh/mesh_make.h"

/* Kinds of cells of a mesh. CELL_EMPTY: without material points; CELL_WHOLE: with all points, of one material;
 * CELL_PARTIAL: with missing points, partial stresses, several materials or doubled nodes; CELL_COARSE: replaced by a
 * coarse cell. */
enum cell_kind { CELL_EMPTY, CELL_WHOLE, CELL_PARTIAL, CELL_COARSE };

/* Cells with own stiffness (with missing points, partial stresses, several materials or doubled nodes), moved out of a
 * mesh by mesh_cells_with_own_stiffness_detach before its cells are classified again. own_stiffness_cell:
 * [own_stiffness_cells] indices of the cells; stiffness: their stiffness matrices.
 * mesh_cells_with_own_stiffness_compute copies the stiffness of unchanged cells from here and frees the arrays. */
struct mesh_cells_with_own_stiffness {
    int64_t own_stiffness_cells;
    int32_t *own_stiffness_cell;
    real *stiffness;
};

/* Removes all cells with own stiffness (cells with missing points, points whose stress is partly carried by bonds,
 * several materials or doubled nodes) from the mesh, and returns their list with their stiffness, for
 * mesh_cells_with_own_stiffness_compute. */
struct mesh_cells_with_own_stiffness mesh_cells_with_own_stiffness_detach(struct mesh *mesh);

/* Appends cell number `cell` to the list of cells with own stiffness of the mesh: cells in which points are missing or
 * have different materials, or whose nodes were doubled by a slit (a pre-crack). Their stiffness is computed later by
 * mesh_cells_with_own_stiffness_compute. */
void mesh_cells_with_own_stiffness_add(struct mesh *mesh, int64_t cell);

/* Computes the stiffness of all cells with own stiffness of the mesh with particles p (cells with missing points,
 * points whose stress is partly carried by bonds, several materials or doubled nodes). source: material constants, and
 * the parts of stresses that bonds carry; cell_needs_update: a byte for each cell, not 0 where the stiffness must be
 * computed anew, NULL for all cells; previous_cells: result of mesh_cells_with_own_stiffness_detach, from which
 * the stiffness of all other cells is copied, and which is freed. */
void mesh_cells_with_own_stiffness_compute(struct mesh *mesh, const struct particles *p,
                                           const struct mesh_source *source, const uint8_t *cell_needs_update,
                                           struct mesh_cells_with_own_stiffness *previous_cells);

/* Recomputes the stiffness of the cells with own stiffness of `mesh` with particles p (cells with missing points,
 * points whose stress is partly carried by bonds, several materials or doubled nodes) marked in `cell_is_marked`, a
 * byte for each cell. The list of cells with own stiffness is unchanged. source: material constants, and the parts of
 * stresses that bonds carry.
 */
void mesh_cells_with_own_stiffness_recompute_marked(struct mesh *mesh, const struct particles *p,
                                                    const struct mesh_source *source, const uint8_t *cell_is_marked);

/* Frees the list of cells with own stiffness of the mesh (cells with missing points, several materials or doubled
 * nodes) and their stiffness. */
void mesh_cells_with_own_stiffness_free(struct mesh *mesh);

/* Finds the nodes of `mesh` with particles p at which slits (pre-cracks) or voids (narrow gaps of a body) of `source`
 * separate the points around them, and adds second nodes there. The box of nodes, which covers the range between the
 * corners `lower_corner` and `upper_corner` [m], is extended by rows for these. Returns FAILED, with a message, if
 * there are too many nodes. Release with mesh_slits_free. */
status mesh_slits_duplicate_nodes(struct mesh *mesh, const struct particles *p, const struct mesh_source *source,
                                  const real *lower_corner, const real *upper_corner);

/* Connects each block of nodes (eight along x) beside slits (pre-cracks as free surfaces of the mesh) with the blocks
 * of the second nodes at the same positions, so that a block becomes active, i.e. is computed, when the other one
 * moves. To be called after the blocks are made. */
void mesh_slits_link_node_blocks_to_duplicates(struct mesh *mesh);

/* Stores in mesh->slits the node indices of the corners of cells with own stiffness (cells with missing points, several
 * materials or doubled nodes) that touch a slit, a pre-crack as free surface. Cells with own stiffness are computed in
 * groups of eight; the indices are stored for all cells of a group if one of them touches a slit. Needed because slits
 * double nodes, so that the corners of such cells are not at fixed index distances from the cell. To be called after
 * the groups are made. */
void mesh_slits_store_corner_nodes_of_adjacent_cells(struct mesh *mesh);

/* Frees the arrays of s, the slits (pre-cracks as free surfaces) of a mesh, which mesh_slits_duplicate_nodes has made.
 */
void mesh_slits_free(struct mesh_slits *s);

/* Computes nodal values of a vector field from values at the points p of the mesh, by least squares weighted with mass;
 * the iteration starts from the projection with the lumped mass matrix. point_value: dim arrays with a value for each
 * particle; nodal_value: dim arrays, receives a value for each node. */
void mesh_fit_nodal_values_to_point_values(const struct mesh *mesh, const struct particles *p, real *const *point_value,
                                           real *const *nodal_value);

/* Computes nodal values of a vector field as mesh_fit_nodal_values_to_point_values does, from point_value (at the
 * points p) to nodal_value, but for the listed nodes only; the iteration starts from their present values, and all
 * other nodes are unchanged. node_list[node_count]: node indices. */
void mesh_fit_listed_nodal_values_to_point_values(const struct mesh *mesh, const struct particles *p,
                                                  real *const *point_value, real *const *nodal_value,
                                                  const int32_t *node_list, int64_t node_count);

/* Returns the cell of `mesh` that contains `particle` of p, and the number (0 to 2^dim - 1) of the quadrature point of
 * this cell at which the particle is, as (cell << dim) + number, from its reference position. Returns -1 if the
 * particle is not at a quarter or three quarters of each edge of a cell. */
int64_t mesh_find_quadrature_point_index_of_particle(const struct mesh *mesh, const struct particles *p,
                                                     int64_t particle);

/* Recomputes mass [kg] and inverse mass of the mesh node with the index `node` from the points p in the cells around
 * it; points in coarse cells (larger cells of a coarser level) are left out, since the nodes of the coarse cells carry
 * their mass. */
void mesh_node_update_mass(struct mesh *mesh, const struct particles *p, int64_t node);

/* Rebuilds the cells of the finest mesh `mesh` after mesh->level, the coarsening level of each cell, has changed in
 * some cells; cells of a level above 0 are parts of larger cells, which belong to a coarser mesh. Determines the kind
 * of each changed cell: whole (all points, of one material, none with partial stress, i.e. a share of its stress that
 * bonds carry), partial (points, but not all of these properties), empty, or part of a larger cell. Then lists whole
 * cells in runs (rows of consecutive cells of one material) and cells with own stiffness with their stiffness, and
 * recomputes nodal masses. p: particles; source: elastic constants and partial stresses; level_has_changed[mesh->grid.n
 * + LANES]: not 0 for cells whose level has changed. */
void mesh_rebuild_cells_after_level_change(struct mesh *mesh, const struct particles *p,
                                           const struct mesh_source *source, const uint8_t *level_has_changed);

/* Groups the cells of `mesh`, a mesh of coarse cells without points, into rows of consecutive cells of equal material,
 * the runs of the mesh. Finds the span of nodes with mass in each row of nodes, and the active blocks of nodes (eight
 * nodes each, included in computations). Input: kinds and materials of the cells and masses of the nodes. */
void mesh_list_cell_runs_and_nodes_with_mass(struct mesh *mesh);

/* Finds in each row of nodes of `mesh` along the first axis the span of nodes with mass, to which loops over nodes are
 * limited, and stores it in mesh->span (first node, and the one after the last). */
void mesh_find_span_of_nodes_with_mass_per_row(struct mesh *mesh);

/* Makes the blocks of nodes of `mesh` (eight along x) next to cells active, i.e. included in computations, and all
 * other blocks inactive. */
void mesh_activate_only_node_blocks_next_to_cells(struct mesh *mesh);

/* Returns true if the deformation has turned a cell of the mesh inside out: the determinant of the deformation gradient
 * is 0 or negative at one of its 2^dim points at a quarter or three quarters of each edge. */
bool mesh_cell_is_inverted(const struct mesh *mesh, int64_t cell);

/* Allocates all arrays of a mesh that covers the box between the corners `lower_corner` and `upper_corner` [m], without
 * points or cells. node_grid: grid whose anchor and cell size define the nodes; p, source: particles and the slits and
 * voids that double nodes, p = NULL for none. Release with mesh_free. Returns FAILED, with a message, if there are too
 * many nodes. */
status mesh_allocate_arrays_for_box(struct mesh *mesh, const struct grid *node_grid, const real *lower_corner,
                                    const real *upper_corner, const struct particles *p,
                                    const struct mesh_source *source);

/* Returns true if cell `cell` of `mesh`, level 0 (the finest), is part of a coarse cell, by its coarsening level or
 * because its particles are not made. */
static inline bool mesh_cell_is_part_of_coarse_cell(const struct mesh *mesh, int64_t cell)
{
    return (mesh->level && mesh->level[cell] > 0) || (mesh->absent && mesh->absent[cell]);
}

/* Allocates an array with a byte for each cell of the mesh, all 0, and some padding at its end. label: name of the
 * array for messages about memory. The caller releases the array with memory_free. */
static inline uint8_t *mesh_allocate_byte_for_each_cell(const char *label, const struct mesh *mesh)
{
    return NEW(label, mesh->grid.n + LANES, uint8_t);
}

#endif
