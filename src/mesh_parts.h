/* floor 3: what the files of the mesh share. */
#ifndef CLEAVE_MESH_PARTS_H
#define CLEAVE_MESH_PARTS_H

#include "mesh_make.h"

/* Stiffness of a cell with points at the places set in `places`, each of reference volume V; partial[q] is the entry of
 * place q in the partial stress, -1 without. Partial stress is a share of the stress by the
 * constants `isotropic`. Column by column; skew (may be NULL) gets what skew stress adds. */
void mesh_stiffness(real *K, real *skew, const struct elastic *m, const struct elastic *isotropic, int dim, real h, real V, unsigned places,
                    const struct partial_stress *partial, const int32_t *entry);

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
