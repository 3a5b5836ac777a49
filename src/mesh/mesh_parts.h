/* Declarations shared by the files of the mesh. */
#ifndef CLEAVE_MESH_PARTS
#define CLEAVE_MESH_PARTS

#include "base/memory.h"
#include "mesh/mesh_make.h"

enum cell_kind { CELL_EMPTY, CELL_WHOLE, CELL_PARTIAL, CELL_COARSE };

/* Partial cells with their stiffness (mesh_partial.c). mesh_partial_keep takes them off the mesh before cells are
 * sorted out anew; mesh_partial_make puts the stiffness of unchanged cells back and makes that of all others (`dirty`
 * by cell; NULL: all are made), and frees `old`. */
struct mesh_partial {
    int64_t partial_cells;
    int32_t *partial_cell;
    real *stiffness;
};
struct mesh_partial mesh_partial_keep(struct mesh *mesh);
void mesh_partial_add(struct mesh *mesh, int64_t I);
void mesh_partial_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty,
                       struct mesh_partial *old);
/* Makes the stiffness of the cells marked in `dirty` anew; the set of partial cells stays. */
void mesh_partial_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                        const uint8_t *dirty);
void mesh_partial_free(struct mesh *mesh);

/* Slits (mesh_slits.c). Finds the nodes that they double, and extends the box of nodes, which covers from..to [m], by
 * rows for the extra ones; then the links between blocks, once blocks are known; the corners of groups, once these are
 * known. */
status mesh_slits_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *source, const real *from,
                       const real *to);
void mesh_slits_link(struct mesh *mesh);
void mesh_slits_groups(struct mesh *mesh);
void mesh_slits_free(struct mesh_slits *s);

/* Nodal values `node` [dim][nodes] of a field that the points sample as `value` [dim][particles]: least squares
 * weighted by mass, started from the lumped projection. */
void mesh_project(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node);

/* mesh_project for the n listed nodes only, started from their present values; all other nodes stay. */
void mesh_project_near(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node,
                       const int32_t *list, int64_t n);

/* Cell and place of particle i, (cell << dim) + place, or -1 where it is not at a quarter or three quarters of each
 * edge. */
int64_t mesh_place_of(const struct mesh *mesh, const struct particles *p, int64_t i);
/* Computes the mass and inverse mass of node I anew, from the points around it that are in no coarser cell. */
void mesh_node_weigh(struct mesh *mesh, const struct particles *p, int64_t I);

/* Makes kinds, runs, partial cells and masses anew after mesh->level has changed in the cells marked in `dirty`
 * [grid.n + LANES]. */
void mesh_cells_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty);
/* Runs, spans and active blocks of a mesh without points, from its kinds and materials of cells and masses of nodes. */
void mesh_runs_make(struct mesh *mesh);
/* Spans of nodes with mass in the rows. */
void mesh_spans_make(struct mesh *mesh);
/* Blocks of nodes with cells around them become active, all others inactive. */
void mesh_blocks_activate(struct mesh *mesh);
/* Is a cell squeezed to nothing or through itself at one of its places? */
bool mesh_cell_inverted(const struct mesh *mesh, int64_t cell);
/* All arrays of a mesh of the box `from` .. `to` [m] with cells like those of `like`, without points or cells; slits of
 * the source for particles p, NULL: none. */
status mesh_box_make(struct mesh *mesh, const struct grid *like, const real *from, const real *to,
                     const struct particles *p, const struct mesh_source *source);
/* Is cell I part of a coarser one? */
static inline bool cell_is_coarse(const struct mesh *mesh, int64_t I)
{
    return (mesh->level && mesh->level[I] > 0) || (mesh->absent && mesh->absent[I]);
}

/* Marks of cells, none set. */
static inline uint8_t *cells_mark(const char *label, const struct mesh *mesh)
{
    return NEW(label, mesh->grid.n + LANES, uint8_t);
}

#endif
