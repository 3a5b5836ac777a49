/* Room `mesh`: the reference frame of material points: cells, their stiffness, changes by conversion, coarse cells. The
 * room uses bonds and loads; the engine uses it.
 *
 * This header: makes the mesh of the reference frame (include/data/mesh.h) and updates it after conversion. */
#ifndef CLEAVE_MESH_MAKE
#define CLEAVE_MESH_MAKE

#include "base/archive.h"
#include "bonds/bonds.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/hollow.h"
#include "data/mesh.h"
#include "data/particles.h"

/* Data from which cells are made. */
struct mesh_source {
    const struct elastic *elastic;   /* [materials] constants of the cells */
    const struct elastic *isotropic; /* [materials] constants by which partial stresses were made */
    int materials;
    const struct partial_stress *partial; /* partial stresses of the points; NULL: none */
    bool still;                           /* the caller sets the motion of the nodes */
    const struct hollow *hollow;          /* cells whose particles are not made; kept by reference, NULL: none */
    const struct crack *slit;             /* [slits] free surfaces between cells; kept by reference */
    int slits;
    const struct voids *voids;         /* voids of the bodies, also free surfaces; kept by reference, NULL: none */
    const struct mirror_plane *mirror; /* [mirrors] kept by reference */
    int mirrors;
};

/* Makes a mesh of all particles with FLAG_MESHED, with nodes by the anchor and cell size of `like`; displacement and
 * velocity of the nodes are fitted to the points by least squares. REFUSED if particles are not two per cell and
 * direction, all of one volume, or if two bodies share a node and would move as one. */
status mesh_make(struct mesh *mesh, struct particles *p, const struct grid *like, const struct mesh_source *source);

/* Releases all arrays. */
void mesh_free(struct mesh *mesh);

/* Returns the number of disconnected pieces of such a mesh, which share no node; 0 if particles are not two per cell
 * and direction. */
int64_t mesh_pieces(const struct particles *p, const struct grid *like, const struct hollow *hollow);

/* Updates the mesh after n particles `changed` (NULL: any) have converted or changed their partial stress: removes
 * particles that are no longer material points, and rebuilds the cells of changed ones. Nodal velocities are unchanged:
 * each particle removes its share of momentum. Returns the energy of relative motion inside cells that is lost [J]. */
real mesh_follow(struct mesh *mesh, struct particles *p, const struct mesh_source *source, const int32_t *changed,
                 int64_t n);

/* Recomputes the stiffness of cells if all points remain and only partial stresses of n points `changed` have changed.
 * Returns false, without any change, if the set of partial cells changes. */
bool mesh_refresh(struct mesh *mesh, const struct particles *p, const struct mesh_source *source,
                  const int32_t *changed, int64_t n);

/* Inserts n listed particles, which are material points again, in the mesh. Their momentum is added to that of the
 * nodes around them, whose velocity becomes (m_I v_I + sum m_p N v_p)/(m_I + sum m_p N); displacements of these nodes
 * are fitted anew by least squares over all points around them. Returns the kinetic energy that is lost [J]. Call
 * mesh_follow with the points among the changed before the mesh moves, to make their cells. */
real mesh_insert(struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n);

/* Returns true if cell I contains a part of the body. */
bool mesh_cell_holds(const struct mesh *mesh, int64_t I);

/* Finds the exposed points, whose motion is needed outside the mesh in every step: with bonds, loads or images. */
void mesh_find_exposed(struct mesh *mesh, const struct particles *p, const struct bonds *b, const struct loads *l);

/* Returns the largest stable time step by the cells alone [s]: 2/omega of the stiffest single cell. any: for each
 * subset of its points that may remain, else for the present cells. density: [materials, kg/m^3]. */
real mesh_critical_step(const struct mesh *mesh, const struct mesh_source *source, const real *density, bool any);

/* Computes the stiffness K of cell I for displacements of its corners at rest, column by column, component fastest
 * [(dim 2^dim)^2, N/m], without partial stresses. Returns false if the cell has no points. */
bool mesh_cell_stiffness(const struct mesh *mesh, const struct elastic *elastic, const struct particles *p, int64_t I,
                         real *K);

/* Returns the first particle at which the mesh is inverted or has no volume; p->n: none. */
int64_t mesh_inverted(const struct mesh *mesh, const struct particles *p);

/* Minimum number of cells of a level across any part of the body. */
enum { CELLS_ACROSS = 6 };

/* Computes the level of the coarsest cells that the thickness of the body allows in each cell, room[mesh->grid.n]; at
 * planes of symmetry the body continues. Returns the largest of them. */
int mesh_room(const struct mesh *mesh, const struct mirror_plane *mirror, int mirrors, uint8_t *room);

/* Marks all cells of a grid within `reach` cells of a marked one. */
void cells_dilate(const struct grid *g, uint8_t *mark, int reach);

/* Saves or restores the motion of the nodes. */
status mesh_archive(struct mesh *mesh, struct archive *a);

#endif
