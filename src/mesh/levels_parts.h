/* Private header of the files of coarse cells (include/mesh/levels.h). */
#ifndef CLEAVE_LEVELS_PARTS
#define CLEAVE_LEVELS_PARTS

#include "mesh/levels.h"
#include "mesh_parts.h"

/* Computes the indices k [dim] of node I. */
static inline void walk_at(const struct grid *g, int64_t I, int64_t *k)
{
    for (int d = 0; d < DIM_MAX; d++) k[d] = d < g->dim ? I / g->stride[d] % g->count[d] : 0;
}

/* Advances the indices k [dim] to the next node; loops over all nodes start with the indices of node 0. */
static inline void walk_on(const struct grid *g, int64_t *k)
{
    for (int d = 0; d < g->dim && ++k[d] == g->count[d]; d++) k[d] = 0;
}

/* Returns the cell of `level` that contains the cell of level 0 with indices k. q: NULL, or set to its indices. */
static inline int64_t coarse_cell(const struct mesh_levels *l, int level, const int64_t *k, int64_t *q)
{
    const struct grid *g = &level_mesh_of(l, level)->grid;
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) {
        const int64_t at = ((k[d] - l->offset[0][d]) >> level) + l->offset[level][d];
        if (q) q[d] = at;
        I += at * g->stride[d];
    }
    return I;
}

/* Returns the node of level 0 at the position of the node of `level` with indices q. */
static inline int64_t fine_node(const struct mesh_levels *l, int level, const int64_t *q)
{
    const struct grid *g = &l->fine->grid;
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) I += (((q[d] - l->offset[level][d]) << level) + l->offset[0][d]) * g->stride[d];
    return I;
}

/* Returns true if the cell of level 0 with indices k is the lowest in its cell of `level`. */
static inline bool is_lowest(const struct mesh_levels *l, int level, const int64_t *k)
{
    bool lowest = true;
    for (int d = 0; d < l->fine->grid.dim; d++)
        lowest = lowest && (k[d] - l->offset[0][d]) % ((int64_t)1 << level) == 0;
    return lowest;
}

/* Returns the number of cells of level 0 in a cell of `level`. */
static inline int parts_of(const struct mesh_levels *l, int level) { return 1 << l->fine->grid.dim * level; }

/* Returns cell number `part` of level 0 in the cell of `level` whose lowest cell is `first`. */
static inline int64_t part_at(const struct mesh_levels *l, int level, int64_t first, int part)
{
    for (int d = 0; d < l->fine->grid.dim; d++, part >>= level)
        first += (part & ((1 << level) - 1)) * l->fine->grid.stride[d];
    return first;
}

/* Returns true if one of them has a lower level in of[fine->grid.n]. */
static inline bool any_below(const struct mesh_levels *l, int level, int64_t first, const uint8_t *of)
{
    bool any = false;
    for (int part = 0; part < parts_of(l, level) && !any; part++) any = of[part_at(l, level, first, part)] < level;
    return any;
}

/* Returns the material of cell I of level 0, which is whole; cells without particles are in a body of one material. */
static inline uint8_t cell_material(const struct mesh *fine, const struct particles *p, int64_t I)
{
    const int32_t i = fine->point[I << fine->grid.dim];
    return p->material[i >= 0 ? i : 0];
}

/* Returns true if the mesh has a cell I that computes forces. */
static inline bool cell_acts(const struct mesh *mesh, int64_t I)
{
    return mesh->kind[I] == CELL_WHOLE || mesh->kind[I] == CELL_PARTIAL;
}

/* Sets displacement and velocity of the ghosts of a level. */
void levels_ghosts_follow(struct mesh_levels *l, int level);

/* Sets the motion of the hanging nodes of level - 1 to the mean of their masters. */
void levels_hanging_follow(struct mesh_levels *l, int level);

/* Makes cells and masses before transfers (levels_fold) for the present levels. */
void levels_cells_make(struct mesh_levels *l, const struct particles *p);

/* Finds the ghosts, hanging nodes and matched cells of all levels. */
void levels_link(struct mesh_levels *l);

/* Transfers the mass of ghosts and hanging nodes; momenta: also grid.momentum [kg m/s]. */
void levels_fold(struct mesh_levels *l, bool momenta);

/* Makes runs of cells and active blocks; to be called after levels_fold. */
void levels_runs_make(struct mesh_levels *l);

/* Interpolates displacements and velocities of coarse cells to nodes of level 0 inside them that belong to no cell of
 * level 0. all: to all such nodes, else to those around which there are particles. */
void levels_interpolate(struct mesh_levels *l, bool all);

/* Computes the momenta over mass of the nodes of coarse cells from their velocities, up to round-off. */
void levels_momenta_find(struct mesh_levels *l);

/* Returns true if coarse cells are whole and agree with the levels of all their parts. */
bool levels_sound(const struct mesh_levels *l);

/* Computes the distance from coarse cells of all cells of level 0 (l->safe). */
void levels_find_safe(struct mesh_levels *l);

#endif
