/* Declarations shared by the files of coarse cells (include/mesh/levels.h). */
#ifndef CLEAVE_LEVELS_PARTS
#define CLEAVE_LEVELS_PARTS

#include "mesh/levels.h"
#include "mesh_parts.h"

static inline void walk_at(const struct grid *g, int64_t I, int64_t *k)
{
    for (int d = 0; d < DIM_MAX; d++) k[d] = d < g->dim ? I / g->stride[d] % g->count[d] : 0;
}

/* Indices of the next node; walks over all nodes begin with those of node 0. */
static inline void walk_on(const struct grid *g, int64_t *k)
{
    for (int d = 0; d < g->dim && ++k[d] == g->count[d]; d++) k[d] = 0;
}

/* Cell of `level` that holds the cell of level 0 with indices k; q: its indices, may be NULL. */
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

/* Node of level 0 at the place of the node of `level` with indices q. */
static inline int64_t fine_node(const struct mesh_levels *l, int level, const int64_t *q)
{
    const struct grid *g = &l->fine->grid;
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) I += (((q[d] - l->offset[level][d]) << level) + l->offset[0][d]) * g->stride[d];
    return I;
}

/* Is the cell of level 0 with indices k the lowest in its cell of `level`? */
static inline bool is_lowest(const struct mesh_levels *l, int level, const int64_t *k)
{
    bool lowest = true;
    for (int d = 0; d < l->fine->grid.dim; d++)
        lowest = lowest && (k[d] - l->offset[0][d]) % ((int64_t)1 << level) == 0;
    return lowest;
}

/* Cells of level 0 in one of `level`, and number `part` of them; `first` is the lowest. */
static inline int parts_of(const struct mesh_levels *l, int level) { return 1 << l->fine->grid.dim * level; }
static inline int64_t part_at(const struct mesh_levels *l, int level, int64_t first, int part)
{
    for (int d = 0; d < l->fine->grid.dim; d++, part >>= level)
        first += (part & ((1 << level) - 1)) * l->fine->grid.stride[d];
    return first;
}

/* Is any of them of a finer level in `of` [fine->grid.n]? */
static inline bool any_below(const struct mesh_levels *l, int level, int64_t first, const uint8_t *of)
{
    bool any = false;
    for (int part = 0; part < parts_of(l, level) && !any; part++) any = of[part_at(l, level, first, part)] < level;
    return any;
}

/* Material of cell I of level 0, which is whole; cells whose particles are not made are in a body of one material. */
static inline uint8_t cell_material(const struct mesh *fine, const struct particles *p, int64_t I)
{
    const int32_t i = fine->point[I << fine->grid.dim];
    return p->material[i >= 0 ? i : 0];
}

/* Does the mesh have a cell I that computes forces? */
static inline bool cell_acts(const struct mesh *mesh, int64_t I)
{
    return mesh->kind[I] == CELL_WHOLE || mesh->kind[I] == CELL_PARTIAL;
}

/* Nodes of coarser meshes at the place of finer nodes take their displacement and velocity. */
void levels_ghosts_follow(struct mesh_levels *l, int level);
/* Hanging nodes of level - 1 take the mean motion of their masters. */
void levels_hanging_follow(struct mesh_levels *l, int level);
/* Cells, masses before any node gives its own away, ghosts, hanging nodes, matched cells, of the present levels. */
void levels_cells_make(struct mesh_levels *l, const struct particles *p);
void levels_link(struct mesh_levels *l);
/* Ghosts and hanging nodes give their mass away, and if `momenta` what they have in grid.momentum [kg m/s]. */
void levels_fold(struct mesh_levels *l, bool momenta);
/* Runs and active blocks, after levels_fold. */
void levels_runs_make(struct mesh_levels *l);
/* Displacements and velocities of coarse cells to the nodes of level 0 inside them that no cell of level 0 has;
 * of all, or of those round which there are particles. */
void levels_interpolate(struct mesh_levels *l, bool all);
/* Momenta of the nodes of coarse cells, over mass, that belong to their velocities, which then differ by round-off. */
void levels_momenta_find(struct mesh_levels *l);
/* Are coarse cells whole, and their levels those of all their parts? */
bool levels_sound(const struct mesh_levels *l);
/* Marks the cells of level 0 that are far from coarse ones. */
void levels_find_safe(struct mesh_levels *l);

#endif
