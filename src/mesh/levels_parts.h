/* Declarations shared by the files levels*.c of coarse cells: mesh cells in the reference configuration that are larger
 * than the finest ones (include/mesh/levels.h). */
#ifndef CLEAVE_LEVELS_PARTS
#define CLEAVE_LEVELS_PARTS

#include "mesh/levels.h"
#include "mesh_parts.h"

/* Computes the indices `axis_index` of node `node` along the axes of grid g, axis_index[d] = 0 ... g->count[d] - 1; 0
 * for axes beyond g->dim. */
static inline void grid_indices_of_node(const struct grid *g, int64_t node, int64_t *axis_index)
{
    for (int d = 0; d < DIM_MAX; d++) axis_index[d] = d < g->dim ? node / g->stride[d] % g->count[d] : 0;
}

/* Advances the indices `axis_index` of a node along the axes of grid g to those of the next node, first axis fastest,
 * for a loop over all nodes that starts with `axis_index` = 0. */
static inline void grid_advance_to_next_node_indices(const struct grid *g, int64_t *axis_index)
{
    for (int d = 0; d < g->dim && ++axis_index[d] == g->count[d]; d++) axis_index[d] = 0;
}

/* Returns the index of the cell of coarsening level `level` of the mesh l that contains a cell of level 0 (the finest).
 * fine_index: dim indices of the cell of level 0 along the axes; coarse_index: receives the dim indices of the coarse
 * cell, NULL if they are not needed. */
static inline int64_t mesh_levels_coarse_cell_of_fine_cell(const struct mesh_levels *l, int level,
                                                           const int64_t *fine_index, int64_t *coarse_index)
{
    const struct grid *g = &mesh_levels_mesh_of_level_read_only(l, level)->grid;
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) {
        const int64_t at = ((fine_index[d] - l->offset[0][d]) >> level) + l->offset[level][d];
        if (coarse_index) coarse_index[d] = at;
        I += at * g->stride[d];
    }
    return I;
}

/* Returns the index of the node of level 0 (the finest) at the position of a node of coarsening level `level` of the
 * mesh l. coarse_index: dim indices of the coarse node along the axes. */
static inline int64_t mesh_levels_fine_node_of_coarse_node(const struct mesh_levels *l, int level,
                                                           const int64_t *coarse_index)
{
    const struct grid *g = &l->fine->grid;
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++)
        I += (((coarse_index[d] - l->offset[level][d]) << level) + l->offset[0][d]) * g->stride[d];
    return I;
}

/* Returns true if a cell of level 0 (the finest) is the one at the lower corner of the cell of coarsening level `level`
 * of the mesh l that contains it. fine_index: indices of the cell of level 0 along the axes. */
static inline bool mesh_levels_fine_cell_is_lowest_in_coarse_cell(const struct mesh_levels *l, int level,
                                                                  const int64_t *fine_index)
{
    bool lowest = true;
    for (int d = 0; d < l->fine->grid.dim; d++)
        lowest = lowest && (fine_index[d] - l->offset[0][d]) % ((int64_t)1 << level) == 0;
    return lowest;
}

/* Returns the number of cells of level 0 (the finest) in one cell of coarsening level `level` of the mesh l: 2^(dim
 * level). */
static inline int mesh_levels_fine_cells_per_coarse_cell(const struct mesh_levels *l, int level)
{
    return 1 << l->fine->grid.dim * level;
}

/* Returns the index of one of the cells of level 0 (the finest) that form a cell of coarsening level `level` of the
 * mesh l. number_in_coarse_cell: number of this cell of level 0 in the coarse cell, 0 to 2^(dim level) - 1, x fastest;
 * first_cell: index of the cell of level 0 at the lower corner of the coarse cell. */
static inline int64_t mesh_levels_nth_fine_cell_in_coarse_cell(const struct mesh_levels *l, int level,
                                                               int64_t first_cell, int number_in_coarse_cell)
{
    for (int d = 0; d < l->fine->grid.dim; d++, number_in_coarse_cell >>= level)
        first_cell += (number_in_coarse_cell & ((1 << level) - 1)) * l->fine->grid.stride[d];
    return first_cell;
}

/* Returns true if one of the cells of level 0 (the finest) in a cell of coarsening level `level` of the mesh l has a
 * lower level in `cell_level`, an array with a level for each cell of level 0. first_cell: index of the cell of level 0
 * at the lower corner. */
static inline bool mesh_levels_coarse_cell_contains_finer_cells(const struct mesh_levels *l, int level,
                                                                int64_t first_cell, const uint8_t *cell_level)
{
    bool any = false;
    for (int part = 0; part < mesh_levels_fine_cells_per_coarse_cell(l, level) && !any; part++)
        any = cell_level[mesh_levels_nth_fine_cell_in_coarse_cell(l, level, first_cell, part)] < level;
    return any;
}

/* Returns the material (index in the materials of the run) of cell `cell` of `finest_mesh`, the finest mesh; the cell
 * must be completely filled with material points. For a cell whose particles are not made (inside a coarse cell)
 * returns the material of particle 0 of p, since the body then has only one material. */
static inline uint8_t mesh_material_of_filled_cell(const struct mesh *finest_mesh, const struct particles *p,
                                                   int64_t cell)
{
    const int32_t i = finest_mesh->point[cell << finest_mesh->grid.dim];
    return p->material[i >= 0 ? i : 0];
}

/* Returns true if cell `cell` of the mesh has material points and is not part of a coarse cell (a cell of a coarser
 * level of the mesh), so that it contributes forces to its nodes. */
static inline bool mesh_cell_contributes_forces_to_nodes(const struct mesh *mesh, int64_t cell)
{
    return mesh->kind[cell] == CELL_WHOLE || mesh->kind[cell] == CELL_PARTIAL;
}

/* Copies displacement and velocity from nodes of the next finer level to the ghosts of coarsening level `level` > 0 of
 * the mesh l at their positions. Ghosts are nodes of this level that move with these finer nodes. */
void mesh_levels_copy_motion_to_ghosts_of_one_level(struct mesh_levels *l, int level);

/* Sets displacement and velocity of the hanging nodes of the mesh l to the mean of the nodes around them. These are
 * nodes of level `level` - 1 in the middle of an edge or a face of a cell of the coarser level `level`; the mean is
 * over the ends of the edge or the corners of the face. */
void mesh_levels_interpolate_motion_of_hanging_nodes(struct mesh_levels *l, int level);

/* Determines the cells of all coarse levels with particles p from l->level, the coarsening level of each cell of level
 * 0 (the finest): their kind, material and number, and the masses of their nodes (the mass of a cell is divided equally
 * among its corners). The transfer of mass between levels follows in mesh_levels_add_dependent_node_masses_to_masters.
 */
void mesh_levels_rebuild_coarse_cells_and_node_masses(struct mesh_levels *l, const struct particles *p);

/* Finds the nodes at interfaces of the coarsening levels of the mesh l: ghosts, at the position of a node of the next
 * finer level, and hanging nodes, in the middle of an edge or face of a coarser cell. Also finds the coarse cells whose
 * mass matrix is to be blended such that waves disperse as with bonds (mesh_levels_match_wave_dispersion_of_bonds). */
void mesh_levels_find_ghost_and_hanging_nodes(struct mesh_levels *l);

/* Adds the masses of ghosts and hanging nodes of the mesh l to the nodes that determine their motion. Ghosts are at the
 * position of a node of the next finer level, hanging nodes in the middle of an edge or face of a coarser cell.
 * transfer_momenta: true to transfer their momentum in grid.momentum [kg m/s], too. */
void mesh_levels_add_dependent_node_masses_to_masters(struct mesh_levels *l, bool transfer_momenta);

/* Finds the runs of all coarsening levels of l (rows of consecutive cells of equal material), the spans of nodes with
 * mass, and the active blocks of nodes (eight nodes each, included in computations). To be called after
 * mesh_levels_add_dependent_node_masses_to_masters. */
void mesh_levels_list_cell_runs_and_nodes_with_mass(struct mesh_levels *l);

/* Interpolates displacement and velocity of coarse cells of the mesh l to nodes of level 0 (the finest) inside them
 * that belong to no cell of level 0. all_nodes: true for all such nodes, false for those with particles in an adjacent
 * cell. */
void mesh_levels_interpolate_motion_into_coarse_cells(struct mesh_levels *l, bool all_nodes);

/* Computes grid.momentum of the nodes of coarse cells of l, i.e. momentum divided by nodal mass [m/s], from the nodal
 * velocities. It differs from the velocity where the mass matrix is not diagonal. Inverts the kernel mesh_velocity
 * (velocities from momenta) iteratively up to round-off, then sets the velocities to the result of mesh_velocity. The
 * nodal forces serve as working memory and are 0 afterwards. */
void mesh_levels_compute_momenta_from_velocities(struct mesh_levels *l);

/* Returns true if the coarse cells of the mesh l are consistent: the fine cells that make up a coarse cell all state
 * the level of this coarse cell (l->level: 0 for a fine cell that is not part of one, k for a cell 2^k times as long),
 * and each of them is completely filled with material. */
bool mesh_levels_coarse_cells_are_consistent_and_filled(const struct mesh_levels *l);

/* Stores in l->safe for each cell of level 0 (the finest) how far it is from coarse cells: less than l->safe_cells,
 * less than l->roomy_cells, or more (enum levels_distance). Material points become peridynamic particles only at a
 * distance of at least safe_cells; points that may soon do so request finer cells at less than roomy_cells. */
void mesh_levels_classify_cells_by_distance_to_coarse(struct mesh_levels *l);

#endif
