/* Private header of the files of the mesh. */
#ifndef CLEAVE_MESH_PARTS
#define CLEAVE_MESH_PARTS

#include "base/memory.h"
#include "mesh/mesh_make.h"

enum cell_kind { CELL_EMPTY, CELL_WHOLE, CELL_PARTIAL, CELL_COARSE };

/* Partial cells with their stiffness (mesh_partial.c). mesh_partial_keep moves them from the mesh to *old before cells
 * are classified anew; mesh_partial_make reuses the stiffness of unchanged cells, computes that of all others (dirty:
 * by cell, NULL: all), and frees *old. */
struct mesh_partial {
    int64_t partial_cells;
    int32_t *partial_cell;
    real *stiffness;
};

/* Moves the partial cells from the mesh to the result. */
struct mesh_partial mesh_partial_keep(struct mesh *mesh);

/* Appends cell I to the partial cells. */
void mesh_partial_add(struct mesh *mesh, int64_t I);

/* Computes the stiffness of the partial cells; see struct mesh_partial. */
void mesh_partial_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty,
                       struct mesh_partial *old);

/* Recomputes the stiffness of the cells marked in `dirty`; the set of partial cells is unchanged. */
void mesh_partial_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                        const uint8_t *dirty);

/* Releases the partial cells of the mesh. */
void mesh_partial_free(struct mesh *mesh);

/* Slits (mesh_slits.c). Finds the nodes that slits double, and extends the box of nodes, which covers from..to [m], by
 * rows for the extra nodes. */
status mesh_slits_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *source, const real *from,
                       const real *to);

/* Makes the links between blocks of nodes at slits, after blocks are made. */
void mesh_slits_link(struct mesh *mesh);

/* Makes the corners of the groups of partial cells at slits, after groups are made. */
void mesh_slits_groups(struct mesh *mesh);

/* Releases all arrays. */
void mesh_slits_free(struct mesh_slits *s);

/* Computes nodal values node[dim][nodes] of a field that points sample as value[dim][particles]: least squares weighted
 * by mass, started from the lumped projection. */
void mesh_project(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node);

/* Projects as mesh_project for n listed nodes only, started from their present values; other nodes are unchanged. */
void mesh_project_near(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node,
                       const int32_t *list, int64_t n);

/* Returns cell and quarter point of particle i, (cell << dim) + q, or -1 if it is not at a quarter or three quarters of
 * each edge. */
int64_t mesh_place_of(const struct mesh *mesh, const struct particles *p, int64_t i);

/* Recomputes mass and inverse mass of node I from the points around it that are in no coarse cell. */
void mesh_node_weigh(struct mesh *mesh, const struct particles *p, int64_t I);

/* Recomputes kinds, runs, partial cells and masses after mesh->level has changed in the cells marked in `dirty` [grid.n
 * + LANES]. */
void mesh_cells_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty);

/* Makes runs, spans and active blocks of a mesh without points from the kinds and materials of its cells and the masses
 * of its nodes. */
void mesh_runs_make(struct mesh *mesh);

/* Finds the spans of nodes with mass in each row of nodes. */
void mesh_spans_make(struct mesh *mesh);

/* Activates the blocks of nodes with cells around them, and deactivates all others. */
void mesh_blocks_activate(struct mesh *mesh);

/* Returns true if a cell is inverted or has no volume at a quarter point. */
bool mesh_cell_inverted(const struct mesh *mesh, int64_t cell);

/* Allocates all arrays of a mesh of the box from..to [m] with cells like those of `like`, without points or cells; with
 * slits of the source for particles p (NULL: none). */
status mesh_box_make(struct mesh *mesh, const struct grid *like, const real *from, const real *to,
                     const struct particles *p, const struct mesh_source *source);

/* Returns true if cell I is part of a coarse cell. */
static inline bool cell_is_coarse(const struct mesh *mesh, int64_t I)
{
    return (mesh->level && mesh->level[I] > 0) || (mesh->absent && mesh->absent[I]);
}

/* Allocates marks of cells, all 0. */
static inline uint8_t *cells_mark(const char *label, const struct mesh *mesh)
{
    return NEW(label, mesh->grid.n + LANES, uint8_t);
}

#endif
