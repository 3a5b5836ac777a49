/* floor 3: what the files of the mesh share. */
#ifndef CLEAVE_MESH_PARTS_H
#define CLEAVE_MESH_PARTS_H

#include "mesh/mesh_make.h"

enum cell_kind { CELL_EMPTY, CELL_WHOLE, CELL_CUT };

/* Cut cells with their stiffness (mesh_cut.c): taken off the mesh before cells are sorted out anew, put back where nothing has
 * changed (`dirty` by cell, NULL: everywhere), else made; frees `old`. */
struct mesh_cuts { int64_t cuts; int32_t *cut; real *stiffness; };
struct mesh_cuts mesh_cuts_keep(struct mesh *mesh);
void mesh_cuts_add(struct mesh *mesh, int64_t I);
void mesh_cuts_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty,
                    struct mesh_cuts *old);
/* The stiffness of marked cells anew, where they are. */
void mesh_cuts_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty);
void mesh_cuts_free(struct mesh *mesh);

/* Nodal values of a field that the points sample: least squares by mass, from the lumped projection. */
void mesh_project(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node);

/* The same for some nodes only, from what they have; all others stay. */
void mesh_project_near(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node,
                       const int32_t *list, int64_t n);

/* Cell and place of particle i, (cell << dim) + place, or -1 where it is not at a quarter or three quarters of each edge. */
int64_t mesh_place_of(const struct mesh *mesh, const struct particles *p, int64_t i);
/* Mass of a node anew from the points round it. */
void mesh_node_weigh(struct mesh *mesh, const struct particles *p, int64_t I);

#endif
