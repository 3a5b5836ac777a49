/* A mesh of linear cells in the reference frame: the material point method for bodies that keep their
 * neighbours.
 *
 * In the reference frame points never leave their cell, so that weights are constants and velocity and displacement
 * can stay on the nodes: mapping them to points and back would change nothing but lose energy. What is left is a
 * mesh of linear cells of two spacings; the material points, at a quarter and three quarters of each edge, are their
 * quadrature and carry what happened to the material (total Lagrangian MPM: de Vaucorbeil, Nguyen & Hutchinson
 * 2020).
 *
 * Layout: nodes are those of a struct grid that never changes. A cell is named by its lowest node I; its corner c
 * has the node I + mesh->corner[c], and its point of place c lies next to that corner (bit d of c: upper in
 * direction d).
 *
 *     cell I     0 .. 2^dim - 1      point[(I << dim) + c]: the particle there, -1 without
 *
 * Cells with all their points, of one material, none beside bonds, are whole: runs of them along x are swept eight
 * at a time in closed form. All other cells that hold points are partial: each has its own stiffness, and eight are
 * swept side by side. */
#ifndef CLEAVE_MESH
#define CLEAVE_MESH

#include "data/grid.h"
#include "data/particles.h"
#include "data/active_set.h"

enum { CORNERS_MAX = 8, CELL_UNKNOWNS_MAX = CORNERS_MAX * DIM_MAX, MODES_MAX = 18 };

/* Whole cells side by side. */
struct mesh_run {
    int32_t cell, cells; /* first of them; how many */
    uint8_t material;
    bool stressed; /* a point of it may have passed the trigger */
};

/* Points of a cell whose motion is needed in every step, by place. */
struct mesh_exposed {
    int32_t cell;
    uint8_t places;
};

/* A material point at the end of state-based bonds, and the lane of its cell in the group of partial cells. */
struct mesh_end {
    int32_t point, lane;
};

/* Slits: free surfaces between points (mesh_slits.c). A cell that a slit divides becomes several, each with the points
 * on one side: one keeps the index of the cell, the others have indices behind those of the box. Around a node that a
 * slit passes the cells fall into groups: one keeps the node of the grid, each other has an extra node. Extra nodes lie
 * in rows behind those of the box: whatever works on all nodes works on them. A cell that touches one is partial and
 * says its corners itself. All this follows from where particles and slits are in the reference state, and stays. */
struct mesh_slits {
    int64_t nodes, first; /* number of extra nodes; first node and cell behind the box */
    int32_t *base;        /* [grid.n - first] node of the grid at the same place, -1: no extra node */
    uint8_t *split;       /* [grid.n] 1: other nodes are at the same place */
    uint8_t *open;        /* [grid.n] bit d: on a mirror across axis d, behind a slit that parts what it
                           * holds from its image */
    int32_t *cell;        /* [grid.n] number of a cell in `corner`, -1: corners of the grid. NULL: no
                           * slits */
    int64_t cells;
    int32_t *corner; /* [cells][2^dim] nodes at the corners */
    int32_t *next;   /* [grid.n] next cell of those that a cell was divided into, -1: none */
    int32_t *cut;    /* [grid.n] number of a divided cell of the grid in `home`, -1: it is whole */
    int32_t *home;   /* [numbers][2^dim] cell of the point at each of its places */
    int32_t *group;  /* [groups] of partial cells: number in `lane`, -1: corners of the grid */
    int32_t *lane;   /* [numbers][2^dim][LANES] nodes at the corners of the cells of a group */
    int64_t links;   /* blocks of extra nodes or cells, and of what is at the same places: */
    struct mesh_link {
        int32_t extra, base;
    } * link;        /* [links] */
    uint8_t *linked; /* [blocks] 1: it stands in a link */
};

struct mesh {
    struct grid grid;                   /* nodes: mass, force, velocity; its momentum is unused */
    int64_t points;                     /* particles in the mesh; 0: there is no mesh */
    int32_t corner[CORNERS_MAX];        /* node distance of a cell's corners */
    real *displacement[DIM_MAX];        /* of the nodes [m] */
    real *inverse_mass;                 /* of the nodes; 0 where there is no mass [1/kg] */
    int32_t *point;                     /* [grid.n << dim] particle of a place of a cell, -1 without */
    uint8_t *kind;                      /* [grid.n] of cells: empty, whole, partial, or part of a coarser cell */
    const uint8_t *level;               /* [grid.n] of cells: 0, or the level of the coarser cell that they are part
                                           of (mesh/levels.h); NULL: there are none */
    uint8_t *absent;                    /* [grid.n] 1: a whole cell without its particles (hollow.h), part of a coarser
                                           one; NULL: there are none */
    int64_t filled_cells, filled_nodes; /* with absent: cells that are not, and nodes at their corners, ascending */
    int32_t *filled_cell, *filled_node;
    int32_t *place; /* [particles] (cell << dim) + c, -1: not in the mesh */
    real volume;    /* of a point in the reference frame [m^3] */

    int64_t rows;         /* of nodes along x */
    int32_t *span;        /* [rows][2] first node of a row that has mass, and behind the last */
    int64_t bands, *band; /* layers of cells in bands: runs of band b: run[band[b]] .. run[band[b+1]-1] */
    int64_t runs;
    struct mesh_run *run;
    int64_t partial_cells;
    int32_t *partial_cell;     /* [partial_cells, filled up to whole groups of LANES] partial cells, ascending */
    uint8_t *partial_material; /* [as partial_cell] of their points, the one that converts first */
    bool *partial_stressed;    /* [as partial_cell] as of a run */
    real *stiffness;           /* [groups][modes (modes + 1)/2][LANES] 1/2 V K in the modal
                                * basis, lower triangle (mesh_partial.h) [Pa] */
    /* [groups + 1] points at the end of state-based bonds in the cells of a group: end[ends[group]] ..
     * end[ends[group + 1] - 1]; NULL: there are none */
    int32_t *ends;
    struct mesh_end *end;
    real *end_share;     /* [ends][modes] what a cell's modes add to a point's particles.end_strain [1] */
    int32_t *alike;      /* [groups] an earlier group with bitwise equal stiffness */
    real *partial_force; /* [groups][corners dim][LANES] [N] */
    int64_t exposed;
    struct mesh_exposed *exposed_list; /* [exposed] by ascending cell */
    struct active_set active;          /* of blocks of nodes */
    int64_t segments;                  /* blocks in a row of nodes */
    real rounding;                     /* displacements are rounded to multiples of it [m] */
    struct mesh_slits slits;

    /* Of a mesh of coarse cells (mesh/levels.h), which has no points; else NULL. There grid.momentum is the momentum
     * of a node over its mass, from which its velocity follows (kernels/mesh/mesh_inertia.c) [m/s]. */
    uint8_t *material; /* [grid.n] of cells */
    real *cell_mass;   /* [materials] of a cell [kg] */
    uint8_t *matched;  /* [grid.n] bit c: the cell of which the node is corner c is matched */
    real match;        /* share of consistent inertia that is taken from matched cells [1] */
};

/* Nodes at the corners of cell I, if they are not all of the grid; else NULL. */
static inline const int32_t *mesh_own_corners(const struct mesh *mesh, int64_t I)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->cell && s->cell[I] >= 0 ? s->corner + ((int64_t)s->cell[I] << mesh->grid.dim) : NULL;
}

/* Node at corner c of cell I. */
static inline int64_t mesh_node(const struct mesh *mesh, int64_t I, int c)
{
    const int32_t *own = mesh_own_corners(mesh, I);
    return own ? own[c] : I + mesh->corner[c];
}

/* Nodes [2^dim][LANES] at the corners of a group of partial cells, if they are not all of the grid; else NULL. */
static inline const int32_t *mesh_group_corners(const struct mesh *mesh, int64_t group, const int dim)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->group && s->group[group] >= 0 ? s->lane + ((int64_t)s->group[group] << dim) * LANES : NULL;
}

/* Node of the grid at the place of node I. */
static inline int64_t mesh_base(const struct mesh *mesh, int64_t I)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->cell && I >= s->first && s->base[I - s->first] >= 0 ? s->base[I - s->first] : I;
}

/* First cell of which node I may be corner c, -1: none; then the next one after `cell`. Whether it is: mesh_node. */
static inline int64_t mesh_cell_at(const struct mesh *mesh, int64_t I, int c)
{
    const int64_t cell = mesh_base(mesh, I) - mesh->corner[c];
    return cell >= 0 ? cell : -1;
}
static inline int64_t mesh_cell_next(const struct mesh *mesh, int64_t cell)
{
    return mesh->slits.next ? mesh->slits.next[cell] : -1;
}

/* Modes of a cell that store energy: its mean strain, and its bending. */
static inline int mesh_bends(int dim) { return dim * ((1 << dim) - 1 - dim); }
static inline int mesh_modes(int dim) { return symmetric_count(dim) + mesh_bends(dim); }

/* Groups of partial cells side by side. */
static inline int64_t mesh_groups(const struct mesh *mesh) { return (mesh->partial_cells + LANES - 1) / LANES; }

/* May a point of any cell be past its trigger, as the last forces found? */
static inline bool mesh_stressed(const struct mesh *mesh)
{
    bool any = false;
    for (int64_t r = 0; r < mesh->runs; r++) any |= mesh->run[r].stressed;
    for (int64_t k = 0; k < mesh_groups(mesh) * LANES; k++) any |= mesh->partial_stressed[k];
    return any;
}

/* Block of a node. */
static inline int64_t mesh_block(const struct mesh *mesh, int64_t I)
{
    return I / mesh->grid.count[0] * mesh->segments + I % mesh->grid.count[0] / LANES;
}

/* Levels of the blocks of a row of nodes; true if eight nodes, or cells, from the k-th of the row on are inactive. */
static inline const uint8_t *mesh_levels(const struct mesh *mesh, int64_t row)
{
    return mesh->active.level + row * mesh->segments;
}
static inline bool mesh_inactive(const uint8_t *levels, int64_t k)
{
    return (levels[k / LANES] | levels[(k + LANES - 1) / LANES]) == 0;
}

/* Share of node `corner` in a point at `place` of its cell: 3/4 or 1/4 by direction. */
static inline real mesh_weight(int dim, int corner, int place)
{
    static const real weight[DIM_MAX + 1][CORNERS_MAX] = {
        /* by the directions in which they are apart */
        {1},
        {0.75, 0.25},
        {0.5625, 0.1875, 0.1875, 0.0625},
        {0.421875, 0.140625, 0.140625, 0.046875, 0.140625, 0.046875, 0.046875, 0.015625}};
    return weight[dim][corner ^ place];
}

/* Slope of that share along direction d [1/h]. */
static inline real mesh_slope(int dim, int corner, int place, int d)
{
    real slope = corner >> d & 1 ? 1 : -1;
    for (int b = 0; b < dim; b++)
        if (b != d) slope *= (corner ^ place) >> b & 1 ? 0.25 : 0.75;
    return slope;
}

#endif
