/* A mesh of linear cells in the reference frame: the material point method for bodies that keep their
 * neighbours.
 *
 * In the reference frame a point never leaves its cell, so that its weights are constants, and velocity and
 * displacement can stay on the nodes: mapping them to points and back would only dissipate energy. What
 * remains is a mesh of linear cells of two spacings. The material points, at a quarter and three quarters of
 * each edge, are the quadrature points of the cells and carry the history of the material (total Lagrangian
 * MPM: de Vaucorbeil, Nguyen & Hutchinson 2020).
 *
 * Layout: the nodes are those of a struct grid that never changes. A cell has the index I of its lowest node.
 * Its corner number c (bit d of c is set on the upper side in direction d) is the node I + mesh->corner[c];
 * place c of the cell is the position of the material point next to this corner.
 *
 *     cell I     c = 0 .. 2^dim - 1      point[(I << dim) + c]: the particle at place c, -1 if there is none
 *
 * A cell is whole if it has all its points, of one material and without bonds; whole cells that are
 * consecutive along x are processed eight at a time in closed form. All other cells with points are partial:
 * each has its own stiffness, and eight are processed side by side. */
#ifndef CLEAVE_MESH
#define CLEAVE_MESH

#include "data/grid.h"
#include "data/particles.h"
#include "data/active_set.h"

/* Largest sizes of a cell. CORNERS_MAX: number of corners; CELL_UNKNOWNS_MAX: number of displacement components of its
 * corners; MODES_MAX: number of deformation modes that store energy. */
enum { CORNERS_MAX = 8, CELL_UNKNOWNS_MAX = CORNERS_MAX * DIM_MAX, MODES_MAX = 18 };

/* A sequence (run) of whole cells that are consecutive along x. A cell is whole if it has all its material points, of
 * one material and without bonds. */
struct mesh_cell_run {
    int32_t cell, cells; /* first cell; number of cells */
    uint8_t material;
    bool stressed; /* a point may have exceeded the conversion stress */
};

/* Exposed material points of one mesh cell: those whose position and velocity are needed in every step, because bonds,
 * loads or mirror images use them. cell: index of the cell; places: bit c is set if the point next to corner c of the
 * cell is exposed. */
struct mesh_exposed {
    int32_t cell;
    uint8_t places;
};

/* A material point of the mesh with state-based bonds to peridynamic particles. point: index of the particle; lane:
 * position (0 to 7) of its cell in a group of eight cells with own stiffness (cells with missing or bonded points) that
 * are processed together. */
struct mesh_end {
    int32_t point, lane;
};

/* Slits: pre-cracks as free surfaces of the mesh, between material points (mesh_slits.c). A cell divided by a slit
 * becomes several cells, each with the points on one side: one keeps the index of the cell, the others have indices
 * behind those of the box of cells. Around a node on a slit the cells form groups: one group keeps the node of the
 * grid, every other group has an extra node. Extra nodes are in rows behind those of the box, so that loops over all
 * nodes include them. A cell with an extra node is partial (not treated by the loops over whole cells) and stores its
 * corners. The members are computed once, from the reference positions of particles and slits. Arrays are owned by the
 * mesh. */
struct mesh_slits {
    int64_t nodes, first; /* number of extra nodes; index of the first node and cell behind the box */
    int32_t *base;  /* [grid.n - first] index of the node of the grid with the position of node first + k, -1: node
                       first + k is no extra node */
    uint8_t *split; /* [grid.n] 1: other nodes have the position of the node */
    /* [grid.n] bit d: the node is on a mirror plane with normal d, and a slit along the plane separates the points at
     * the node from their images */
    uint8_t *open;
    int32_t *cell; /* [grid.n] index in `corner` of each cell with extra nodes, -1: a cell with the corners of the grid.
                      NULL: no slits */
    int64_t cells; /* number of cells with extra nodes */
    int32_t *corner; /* [cells][2^dim] nodes at the corners of the cell */
    int32_t *next;   /* [grid.n] list of the cells into which one cell was divided: index of the next, -1: the last */
    int32_t *cut;    /* [grid.n] index in `home` of each divided cell of the grid, -1: not divided */
    int32_t *home;   /* [divided cells][2^dim] index of the cell that now has the point at each quarter position */
    int32_t *group; /* [groups of LANES cells with own stiffness] index in `lane`, -1: all cells have the corners of the
                       grid */
    int32_t *lane;  /* [groups with extra nodes][2^dim][LANES] nodes at the corners of the cells of a group */
    int64_t links;  /* number of pairs of blocks of eight nodes: one block of extra nodes or cells, and one of the nodes
                       at the positions of the extra nodes */
    struct mesh_link {
        int32_t extra, base;
    } * link;        /* [links] index of both blocks of a pair */
    uint8_t *linked; /* [blocks of eight nodes] 1: the block is in a pair */
};

/* A mesh of square or cubic cells of two spacings in the reference frame, with 2^dim material points at the quarter
 * positions of each cell. A cell has the index of its lowest node. Cells with own stiffness (some points missing or
 * bonded, or beside a slit) are treated in groups of LANES. All arrays are owned unless const. */
struct mesh {
    struct grid grid;            /* nodes: mass, force, velocity; momentum is unused */
    int64_t points;              /* number of particles in the mesh; 0: there is no mesh */
    int32_t corner[CORNERS_MAX]; /* [2^dim] index of the node at each corner minus the index of the cell */
    real *displacement[DIM_MAX]; /* [grid.n] displacement of the nodes [m] */
    real *inverse_mass;          /* [grid.n] 1/mass of the nodes; 0 where there is no mass [1/kg] */
    int32_t *point;              /* [grid.n << dim] particle at each quarter position of a cell, -1: none */
    uint8_t *kind;               /* [grid.n] kind of cell: empty, whole, partial, or part of a coarser cell */
    /* [grid.n] 0, or the level of the coarser cell that contains the cell (mesh/levels.h); NULL: none */
    const uint8_t *level;
    uint8_t *absent; /* [grid.n] 1: a whole cell whose particles are not created (hollow.h), part of a coarser cell;
                        NULL: none */
    /* with `absent`: number of cells that are not absent; of nodes at their corners */
    int64_t filled_cells, filled_nodes;
    /* [filled_cells], [filled_nodes] indices of these, ascending; NULL without `absent` */
    int32_t *filled_cell, *filled_node;
    int32_t *place; /* [particles] (cell << dim) + number of the quarter position, -1: not in the mesh */
    real volume;    /* reference volume of a point [m^3] */

    int64_t rows;         /* number of rows of nodes along x */
    int32_t *span;        /* [rows][2] index of the first node of a row that has mass, and one past the last */
    int64_t bands, *band; /* bands (layers of cells): runs of band b are run[band[b]] .. run[band[b+1]-1] */
    int64_t runs;
    struct mesh_cell_run *run;       /* [runs] consecutive cells along x */
    int64_t own_stiffness_cells;     /* number of cells with own stiffness */
    int32_t *own_stiffness_cell;     /* [own_stiffness_cells, padded to whole groups of LANES] cells with own stiffness,
                                        ascending */
    uint8_t *own_stiffness_material; /* [as own_stiffness_cell] material of the cell, of several the one that converts
                                        first */
    bool *own_stiffness_stressed;    /* [as own_stiffness_cell] a point may have exceeded the conversion stress */
    real *stiffness; /* [groups][modes (modes + 1)/2][LANES] half of the symmetric stiffness by deformation modes
                        of each cell with own stiffness, divided by its volume (mesh_own_stiffness.h) [Pa] */
    /* [groups + 1] bonded points in the cells of a group: end[ends[group]] .. end[ends[group + 1] - 1]; NULL: none */
    int32_t *ends;
    struct mesh_end *end; /* bonded points, group by group */
    real *end_share;      /* [bonded points][modes] derivative of particles.end_strain by the modes of the cell [1] */
    int32_t *alike;       /* [groups] index of the first group with bitwise equal stiffness */
    real *own_stiffness_force; /* [groups][2^dim dim][LANES] forces of the cells with own stiffness on their corners [N]
                                */
    int64_t exposed;
    struct mesh_exposed *exposed_list; /* [exposed] points to which bonds reach, ascending by cell */
    struct active_set active;          /* blocks of nodes that a wave has reached */
    int64_t segments;                  /* number of blocks per row of nodes */
    real rounding;                     /* displacements are rounded to multiples of this [m] */
    struct mesh_slits slits;           /* free surfaces between cells */

    /* Only of a mesh of coarse cells (mesh/levels.h), which has no points; else NULL. Its grid.momentum is the momentum
     * of a node divided by its mass, from which its velocity follows (kernels/mesh/mesh_inertia.c) [m/s]. */
    uint8_t *material; /* [grid.n] material of the cell */
    real *cell_mass;   /* [materials] mass of a cell [kg] */
    uint8_t *matched;  /* [grid.n] bit c: the cell of which the node is corner c is matched (has mixed inertia, so that
                          waves disperse as in bonds) */
    real match;        /* alpha, share of consistent mass in the inertia of matched cells, the rest is lumped [1] */
};

/* Returns the array of the 2^dim nodes at the corners of cell `cell` of the mesh if one of these nodes is an extra
 * node, i.e. a second node at the position of a grid node, where a slit (a pre-crack) divides the mesh. The array
 * belongs to the mesh. Returns NULL otherwise: the corners are then the nodes `cell` + mesh->corner[c] of the grid. */
static inline const int32_t *mesh_cell_corner_nodes_if_at_slit(const struct mesh *mesh, int64_t cell)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->cell && s->cell[cell] >= 0 ? s->corner + ((int64_t)s->cell[cell] << mesh->grid.dim) : NULL;
}

/* Returns the index of the node at corner `corner` of cell `cell` of the mesh; it may be an extra node (second node at
 * the position of a grid node, where a pre-crack divides the mesh). corner: 0 .. 2^dim - 1, bit d is set on the upper
 * side along axis d. */
static inline int64_t mesh_cell_corner_node(const struct mesh *mesh, int64_t cell, int corner)
{
    const int32_t *own = mesh_cell_corner_nodes_if_at_slit(mesh, cell);
    return own ? own[corner] : cell + mesh->corner[corner];
}

/* Returns the nodes at the corners of the eight cells of group number `group` of cells with own stiffness (cells with
 * missing points, or points with bonds to peridynamic particles), as an array [2^dim][LANES]. The array belongs to the
 * mesh. Returns NULL if none of these nodes is an extra node (second node where a pre-crack divides the mesh): all
 * corners are then nodes of the grid. */
static inline const int32_t *mesh_cells_with_own_stiffness_corner_nodes_if_at_slit(const struct mesh *mesh,
                                                                                   int64_t group, const int dim)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->group && s->group[group] >= 0 ? s->lane + ((int64_t)s->group[group] << dim) * LANES : NULL;
}

/* Returns the index of the node of the regular grid at the position of the mesh node `node`. For an extra node, a
 * second node where a pre-crack divides the mesh, this is the grid node at the same position; for all other nodes it is
 * `node` itself. */
static inline int64_t mesh_original_node_of_doubled_node(const struct mesh *mesh, int64_t node)
{
    const struct mesh_slits *s = &mesh->slits;
    return s->cell && node >= s->first && s->base[node - s->first] >= 0 ? s->base[node - s->first] : node;
}

/* Returns the index of the cell of the regular grid whose corner `corner` (0 .. 2^dim - 1, bit d set on the upper side
 * along axis d) is at the position of mesh node `node`; -1 if there is none. Where slits (pre-cracks) divide this cell,
 * mesh_next_subcell_of_cell_divided_by_slits lists its further parts, and mesh_cell_corner_node shows which of the
 * parts has node `node` itself. */
static inline int64_t mesh_cell_with_corner_at_node(const struct mesh *mesh, int64_t node, int corner)
{
    const int64_t cell = mesh_original_node_of_doubled_node(mesh, node) - mesh->corner[corner];
    return cell >= 0 ? cell : -1;
}

/* Returns the next one of the cells of the mesh into which slits (pre-cracks as free surfaces) divide a cell of the
 * regular grid. cell: the cell of the grid for the first call, then the previous result. Returns -1 after the last one,
 * and for a cell that is not divided. */
static inline int64_t mesh_next_subcell_of_cell_divided_by_slits(const struct mesh *mesh, int64_t cell)
{
    return mesh->slits.next ? mesh->slits.next[cell] : -1;
}

/* Returns the number of bending modes of a linear cell in dim dimensions, i.e. deformations with zero mean strain that
 * store energy: 0 in 1D, 2 in 2D, 12 in 3D. */
static inline int cell_bending_mode_count(int dim) { return dim * ((1 << dim) - 1 - dim); }

/* Returns the number of deformation modes of a linear cell in dim dimensions that store energy: components of the mean
 * strain plus bending modes (cell_bending_mode_count): 1 in 1D, 5 in 2D, 18 in 3D. */
static inline int cell_deformation_mode_count(int dim)
{
    return symmetric_tensor_component_count(dim) + cell_bending_mode_count(dim);
}

/* Returns the number of groups of eight (LANES) cells with own stiffness of the mesh that are processed side by side;
 * the last group may be incomplete. Cells with own stiffness are cells with missing points, points with bonds to
 * peridynamic particles, or several materials. */
static inline int64_t mesh_count_groups_of_eight_cells_with_own_stiffness(const struct mesh *mesh)
{
    return (mesh->own_stiffness_cells + LANES - 1) / LANES;
}

/* Returns true if, according to the last computation of forces, the stress of a material point of the mesh may have
 * exceeded the limit at which points are converted to peridynamic particles. */
static inline bool mesh_stress_may_exceed_conversion_limit(const struct mesh *mesh)
{
    bool any = false;
    for (int64_t r = 0; r < mesh->runs; r++) any |= mesh->run[r].stressed;
    for (int64_t k = 0; k < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) * LANES; k++)
        any |= mesh->own_stiffness_stressed[k];
    return any;
}

/* Returns the index of the block that contains mesh node `node`. A block is eight nodes of a row along x that are
 * skipped together while they are at rest (active_set.h). */
static inline int64_t mesh_block_of_node(const struct mesh *mesh, int64_t node)
{
    return node / mesh->grid.count[0] * mesh->segments + node % mesh->grid.count[0] / LANES;
}

/* Returns a pointer to the activity levels of the blocks (eight nodes each) in row number `row` of the mesh nodes along
 * x: one entry per block, mesh->segments entries. Level 0: the block is at rest and skipped (active_set.h). */
static inline const uint8_t *mesh_activity_levels_of_node_blocks_in_row(const struct mesh *mesh, int64_t row)
{
    return mesh->active.level + row * mesh->segments;
}

/* Returns true if the eight consecutive nodes or cells of a row from number `first_node` (from 0) of the row on are at
 * rest, so that they can be skipped. activity_levels: activity levels of the blocks of this row
 * (mesh_activity_levels_of_node_blocks_in_row). */
static inline bool mesh_eight_nodes_are_at_rest(const uint8_t *activity_levels, int64_t first_node)
{
    return (activity_levels[first_node / LANES] | activity_levels[(first_node + LANES - 1) / LANES]) == 0;
}

/* Range of blocks (eight nodes each) of a row of nodes: the blocks number first .. end - 1, counted from 0 at the begin
 * of the row, contain all nodes of the row that have mass. */
struct mesh_row_blocks {
    int64_t first, end;
};

/* Returns the range of blocks (eight nodes each) of row number `row` of mesh nodes along x that contains all nodes of
 * this row with mass; an empty range if there is none. */
static inline struct mesh_row_blocks mesh_block_range_with_mass_in_node_row(const struct mesh *mesh, int64_t row)
{
    const int64_t start = row * mesh->grid.count[0], first = mesh->span[2 * row], end = mesh->span[2 * row + 1];
    if (first == end) return (struct mesh_row_blocks){0, 0};
    return (struct mesh_row_blocks){(first - start) / LANES, (end - start + LANES - 1) / LANES};
}

/* Returns the number of the first block (eight nodes of a row) from `block` to `end_block` - 1 that is not at rest;
 * `end_block` if all are. activity_levels: activity levels of the blocks of the row. */
static inline int64_t mesh_next_active_block(const uint8_t *activity_levels, int64_t block, int64_t end_block)
{
    return block < end_block && activity_levels[block] ? block : next_marked_index(activity_levels, block, end_block);
}

/* Returns the value [1] in dim dimensions of the linear shape function of a corner node at a quadrature point (material
 * point) of its cell. corner, point: number of the corner, and of the corner next to the point; bit d is set on the
 * upper side in direction d. The value is a product over the directions: 3/4 where these bits agree, 1/4 elsewhere. */
static inline real mesh_shape_function_value(int dim, int corner, int point)
{
    static const real weight[DIM_MAX + 1][CORNERS_MAX] = {
        /* by the number of directions in which corner and place differ */
        {1},
        {0.75, 0.25},
        {0.5625, 0.1875, 0.1875, 0.0625},
        {0.421875, 0.140625, 0.140625, 0.046875, 0.140625, 0.046875, 0.046875, 0.015625}};
    return weight[dim][corner ^ point];
}

/* Returns the derivative along axis `axis` of the linear shape function of a corner node at a quadrature point
 * (material point) of its cell in dim dimensions, times the edge h of the cell [1]. corner, point: number of the
 * corner, and of the corner next to the point; bit d is set on the upper side in direction d. */
static inline real mesh_shape_function_derivative(int dim, int corner, int point, int axis)
{
    real slope = corner >> axis & 1 ? 1 : -1;
    for (int b = 0; b < dim; b++)
        if (b != axis) slope *= (corner ^ point) >> b & 1 ? 0.25 : 0.75;
    return slope;
}

#endif
