/* Room `mesh`: the reference frame of material points: cells, their stiffness, what conversion leaves of them. It knows
 * bonds and loads; the engine calls it.
 *
 * Makes the mesh of the reference frame (include/data/mesh.h) and follows conversion. */
#ifndef CLEAVE_MESH_MAKE
#define CLEAVE_MESH_MAKE

#include "base/archive.h"
#include "bonds/bonds.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/hollow.h"
#include "data/mesh.h"
#include "data/particles.h"

/* What partial cells depend on. */
struct mesh_source {
    const struct elastic *elastic;   /* [materials] of the cells */
    const struct elastic *isotropic; /* [materials] those that partial stress rests on */
    int materials;
    const struct partial_stress *partial; /* NULL, or what points leave to bonds */
    bool still;                           /* the caller sets the motion of the nodes */
    const struct hollow *hollow;          /* cells whose particles are not made, borrowed; NULL: none */
    const struct crack *slit;             /* [slits] free surfaces between cells, borrowed */
    int slits;
    const struct voids *voids;         /* of the bodies, likewise free surfaces, borrowed; NULL: there are none */
    const struct mirror_plane *mirror; /* [mirrors] borrowed */
    int mirrors;
};

/* A mesh of all particles with FLAG_MESHED, nodes where the anchor and node distance of `like` put them; nodes take
 * what the points have of displacement and velocity, by least squares. REFUSED where particles are not two a cell
 * and direction, all of one volume, or where two bodies would share a node: they would move as one. */
status mesh_make(struct mesh *mesh, struct particles *p, const struct grid *like, const struct mesh_source *source);
void mesh_free(struct mesh *mesh);
/* Number of disconnected pieces of such a mesh, which share no node; 0: particles do not lie two a cell and direction.
 */
int64_t mesh_pieces(const struct particles *p, const struct grid *like, const struct hollow *hollow);

/* Takes particles out that are no material points any more, and makes cells anew where `changed` [n] (NULL:
 * everywhere) have converted or leave another part of their stress to bonds. Nodal velocities stay: each particle
 * takes its share of momentum along. Returns the energy of motion inside cells that ends with that [J]. */
real mesh_follow(struct mesh *mesh, struct particles *p, const struct mesh_source *source, const int32_t *changed,
                 int64_t n);
/* The same where all points stay and only their share of stress has changed; false, and nothing is changed, if
 * other cells are partial than before. */
bool mesh_refresh(struct mesh *mesh, const struct particles *p, const struct mesh_source *source,
                  const int32_t *changed, int64_t n);

/* The listed particles, material points again, become points of the mesh. Their momentum joins that of the nodes
 * round them, whose velocity becomes (m_I v_I + sum m_p N v_p)/(m_I + sum m_p N); displacements of these nodes are
 * fitted anew, by least squares over all points that they move. Returns the kinetic energy that ends with that [J].
 * mesh_follow, with those points among the changed, makes their cells; until then the mesh must not be moved. */
real mesh_insert(struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n);

/* Is any of the body in cell I? */
bool mesh_cell_holds(const struct mesh *mesh, int64_t I);

/* Points that something outside the mesh needs the motion of in every step: beside bonds, loaded, or with an image. */
void mesh_find_exposed(struct mesh *mesh, const struct particles *p, const struct bonds *b, const struct loads *l);

/* Largest stable step by the cells alone: 2/omega of the stiffest single cell, for each set of points it may be left
 * with (`any`) or only for the cells there are [s]. */
real mesh_critical_step(const struct mesh *mesh, const struct mesh_source *source, const real *density, bool any);

/* Stiffness of cell I by the displacements of its corners at rest, column by column, component fastest
 * [(dim 2^dim)^2, N/m]: of all the stress of its points, whatever they leave to bonds; false: it has none. */
bool mesh_cell_stiffness(const struct mesh *mesh, const struct elastic *elastic, const struct particles *p, int64_t I,
                         real *K);

/* First particle at which the mesh is squeezed to nothing or through itself, p->n: none. */
int64_t mesh_inverted(const struct mesh *mesh, const struct particles *p);

/* Cells of a level across any part of the body, at the least. */
enum { CELLS_ACROSS = 6 };
/* Level of the coarsest cells that `room` [mesh->grid.n] allows in each cell by the thickness of the body, beyond
 * planes of symmetry as thick again. Returns the largest. */
int mesh_room(const struct mesh *mesh, const struct mirror_plane *mirror, int mirrors, uint8_t *room);
/* Marks all cells of a grid within `reach` cells of a marked one. */
void cells_dilate(const struct grid *g, uint8_t *mark, int reach);

status mesh_archive(struct mesh *mesh, struct archive *a);

#endif
