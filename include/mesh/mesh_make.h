/* Room `mesh` (folder of include/ and src/): meshes by which material points move in the reference frame (fixed to the
 * material): cells, their stiffness, changes by conversion, coarse cells. The room uses bonds and loads; the engine
 * uses it.
 *
 * This header: makes such a mesh (include/data/mesh.h) and updates it after conversion. */
#ifndef CLEAVE_MESH_MAKE
#define CLEAVE_MESH_MAKE

#include "base/archive.h"
#include "bonds/bonds.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/hollow.h"
#include "data/mesh.h"
#include "data/particles.h"

/* Data from which the cells of a mesh are made, apart from the particles. */
struct mesh_source {
    const struct elastic *elastic; /* [materials] elastic constants of the cells */
    /* [materials] elastic constants from which the stiffness of partial stresses is computed */
    const struct elastic *isotropic;
    int materials;
    const struct partial_stress *partial; /* partial stresses of the points; NULL: none */
    bool still;                           /* true: the caller sets the motion of the nodes */
    /* cells whose particles are not created; kept by reference, NULL: none */
    const struct cells_without_particles *hollow;
    const struct crack *slit; /* [slits] pre-cracks that are free surfaces between cells; kept by reference */
    int slits;
    const struct voids *voids;         /* voids of the bodies, also free surfaces; kept by reference, NULL: none */
    const struct mirror_plane *mirror; /* [mirrors] planes of symmetry; kept by reference */
    int mirrors;
};

/* Makes a mesh of all particles of p with FLAG_MESHED (material points that shall move with the mesh). node_grid: grid
 * whose anchor (position of node 0) and cell size define the nodes; source: material constants, partial stresses
 * (carried by bonds), slits (pre-cracks as free surfaces) and voids. Unless source->still, displacement and velocity of
 * the nodes are fitted to those of the particles by least squares. Returns REFUSED, with a message, if the particles
 * are not two per cell and direction, if their volumes differ, or if two bodies share a node and would move as one.
 * Returns FAILED, with a message, if there are too many nodes. Release with mesh_free. */
status mesh_make(struct mesh *mesh, struct particles *p, const struct grid *node_grid,
                 const struct mesh_source *source);

/* Frees the arrays of the mesh, which mesh_make has made. */
void mesh_free(struct mesh *mesh);

/* Returns the number of parts, sharing no nodes, of which a mesh of all particles p would consist. node_grid: grid
 * whose anchor (position of node 0) and cell size define the nodes; empty_cells: cells of the body whose particles were
 * left out; they count as filled. Returns 0 if the particles are not two per cell and direction, so that no mesh is
 * possible. */
int64_t mesh_count_connected_parts(const struct particles *p, const struct grid *node_grid,
                                   const struct cells_without_particles *empty_cells);

/* Updates the mesh after particles of p have become peridynamic or have changed their partial stress (share of the
 * stress that bonds carry): removes the peridynamic ones from their cells and recomputes these cells.
 * changed_points[changed_count]: indices of these particles, NULL if they are unknown. Each particle that leaves takes
 * its share of mass and momentum from the nodes of its cell, so that nodal velocities are kept. Returns the kinetic
 * energy that is lost by this [J]. source: material constants. */
real mesh_remove_points_and_return_lost_energy(struct mesh *mesh, struct particles *p, const struct mesh_source *source,
                                               const int32_t *changed_points, int64_t changed_count);

/* Recomputes the stiffness of the cells of the points of p in changed_points[changed_count] (indices) after only their
 * partial stresses (shares of the stress that bonds carry) have changed; all points remain in the mesh. All cells must
 * be cells with own stiffness before and afterwards: cells with a stiffness matrix of their own, because points are
 * missing or leave a share of their stress to bonds. Else returns false without any change; call
 * mesh_remove_points_and_return_lost_energy then. source: material constants. */
bool mesh_try_update_stiffness_for_partial_stress(struct mesh *mesh, const struct particles *p,
                                                  const struct mesh_source *source, const int32_t *changed_points,
                                                  int64_t changed_count);

/* Adds the particles in inserted_points[inserted_count] (indices), which have become material points again, to the
 * nodes of the mesh, not yet to its cells. The velocity of a node I around them becomes (m_I v_I + sum m_p N v_p)/(m_I
 * + sum m_p N), so that momentum is conserved: m_I, v_I and m_p, v_p are mass and velocity of the node and of each
 * point p, N is the shape function. The displacement of these nodes is fitted by least squares to all points around
 * them. Then call mesh_remove_points_and_return_lost_energy with these particles in its list changed_points, to rebuild
 * the cells that contain them. Returns the kinetic energy that is lost [J]. */
real mesh_insert_points_and_return_lost_energy(struct mesh *mesh, struct particles *p, const int32_t *inserted_points,
                                               int64_t inserted_count);

/* Returns true if the cell of `mesh` with the index `cell` contains a part of the body: it has material points or is
 * part of a coarse cell. */
bool mesh_cell_contains_material(const struct mesh *mesh, int64_t cell);

/* Lists the exposed points of the mesh: material points of p with bonds in b, boundary conditions `loads` or mirror
 * images. Their positions and velocities are updated in every step, since bonds and loads read them. */
void mesh_list_bonded_or_loaded_points(struct mesh *mesh, const struct particles *p, const struct bonds *b,
                                       const struct loads *loads);

/* Returns a lower bound of the critical time step of the mesh [s]: the smallest 2/omega over all cells, with the
 * largest angular frequency omega of a cell that moves on its own. after_any_conversion: true to include the cells that
 * would remain if any of the points of a cell became peridynamic, false for the present cells. density: mass density of
 * each material [kg/m^3]. source: material constants. */
real mesh_critical_time_step(const struct mesh *mesh, const struct mesh_source *source, const real *density,
                             bool after_any_conversion);

/* Computes the stiffness matrix [N/m] of cell number `cell` of `mesh` for displacements of its corners in the
 * undeformed state, from the points of p that the cell still has. The part of the stress that bonds may carry (partial
 * stress) is not subtracted. elastic: array of the elastic constants of all materials; stiffness: receives (dim
 * 2^dim)^2 values, column by column, with index corner x dim + component. Returns false, with stiffness 0, if the cell
 * has no points. */
bool mesh_compute_cell_stiffness(const struct mesh *mesh, const struct elastic *elastic, const struct particles *p,
                                 int64_t cell, real *stiffness);

/* Returns the lowest index of a particle of p at whose position the deformation has turned a cell of the mesh inside
 * out, or p->n if there is none. The determinant of the deformation gradient is 0 or negative there. */
int64_t mesh_first_particle_in_inverted_cell(const struct mesh *mesh, const struct particles *p);

/* Smallest number of coarse cells of one size that must fit across a part of the body for cells of this size to be used
 * there. */
enum { CELLS_ACROSS = 6 };

/* Computes for each cell of the finest mesh the highest coarsening level (0: finest, coarse cells of level L replace
 * 2^L cells along each axis) that the thickness of the body around it allows: CELLS_ACROSS cells of this level must
 * fit. coarsest_level: [mesh->grid.n], receives these levels; mirror[mirror_count]: planes of symmetry, beyond which
 * the body continues. Returns the largest of these levels. */
int mesh_compute_coarsest_cell_levels_for_thickness(const struct mesh *mesh, const struct mirror_plane *mirror,
                                                    int mirror_count, uint8_t *coarsest_level);

/* Marks all cells of grid g that are within `reach_in_cells` cells of a marked cell, in all directions including
 * diagonals. cell_is_marked: [g->n] marks of the cells, not 0 if marked. */
void grid_mark_cells_near_marked_cells(const struct grid *g, uint8_t *cell_is_marked, int reach_in_cells);

/* Saves displacement and velocity of the nodes of a mesh to the archive `a` (checkpoint file or memory) if a->saving,
 * else restores them from it. Returns FAILED, with a message, if the archive cannot be read or written or a stored size
 * differs. */
status mesh_save_or_load_node_motion(struct mesh *mesh, struct archive *a);

#endif
