/* The background grid of the material point method: a box of nodes around the material points. Nodes are counted from
 * an anchor fixed for the whole run, so that a growing grid keeps its node positions exactly. */
#ifndef CLEAVE_GRID
#define CLEAVE_GRID

#include "base/base.h"

/* Dashpots on one grid node of an absorbing face, one for each velocity component. node: index of the grid node; rate:
 * force divided by velocity, for each component [kg/s]; 0 if there is no dashpot or if the component is prescribed. */
struct dashpot {
    int32_t node;
    real rate[DIM_MAX];
    real impulse[DIM_MAX]; /* impulse on the body in this step [N s] */
};

/* Sums over all dashpots of a grid or mesh in one time step. energy: energy that the dashpots dissipate [J]; kick: a
 * quarter of the sum of impulse times change of velocity [J], by which a sample of the kinetic energy must not be
 * corrected (kernels/dashpot.h); impulse: impulse of the dashpots on the body [N s]. */
struct dashpot_effect {
    real energy, kick, impulse[DIM_MAX];
};

/* Effect of bulk damping on a velocity update, for the work of supports, which refers to undamped motion
 * (step/damping.h). velocities, increments: relative amounts [1] by which the velocities before the update, and the
 * increments of velocity in the update, would be larger without damping; 0 if there is no damping. */
struct undamped_velocity_excess {
    real velocities, increments;
};

/* The background grid in dim dimensions: a box of equal square or cubic cells with values at their nodes. All arrays
 * are owned. */
struct grid {
    int dim;
    int body;                  /* number of the body whose points the grid has, from 1; 0: all bodies */
    real h;                    /* distance of neighbouring nodes, edge of a cell [m] */
    real anchor[DIM_MAX];      /* position of node 0 [m] */
    int64_t first[DIM_MAX];    /* lowest node of the box, counted from the anchor */
    int64_t count[DIM_MAX], n; /* nodes per direction; product */
    int64_t stride[DIM_MAX];   /* step of the node index along each axis; stride[0] = 1 */
    real *mass;                /* nodal mass [kg] */
    real *momentum[DIM_MAX];   /* nodal momentum [kg m/s]; after grid_remapped the velocity of the second map [m/s] */
    real *force[DIM_MAX];      /* nodal force [N]; after grid_move the change of velocity [m/s] */
    real *velocity[DIM_MAX];   /* nodal velocity at the end of the step [m/s] */
    real ahead[DIM_MAX]; /* added to the positions of the points where their weights are computed [node distances]:
                          * half a step of common flight in the second map and g2p, else 0 */
    int64_t walls;
    struct wall *wall; /* [walls] prescribed velocities of this step; a later entry overrules an earlier entry */
    struct undamped_velocity_excess damped; /* effect of damping in this step, for the work of the walls */
    int64_t mirror_nodes;
    struct mirror_node *mirror_node; /* [mirror_nodes] nodes of this box beyond planes of symmetry */
    real light_mass;                 /* nodes lighter than this follow a neighbour (grid_move.c); 0: none [kg] */
    int64_t followers;
    struct follower *follower; /* [n] the first `followers` entries are the light nodes of this step, ascending */
    uint8_t *held; /* [n] not 0: a component is prescribed; valid only in the search for followers and in contact. In
                    * that search bit d for a plane of symmetry with normal d, and HELD if others prescribe it */
    int64_t dashpots;
    struct dashpot *dashpot;        /* [dashpots] of absorbing faces in this step, ascending by node */
    struct dashpot_effect absorbed; /* their effect in this step */
};

/* A grid node of very small mass (below GRID_MASS_LIGHT), whose acceleration is extrapolated from two heavier nodes.
 * leader: the adjacent heavier node; behind: the next node in the same direction, equal to `leader` if there is none.
 * All three are node indices. */
struct follower {
    int32_t node, leader, behind;
};

/* A grid node beyond a plane of symmetry. It moves as the mirror image of a node on the body's side of the plane. The
 * mass and impulse that material points give to the node beyond the plane are added to the node on the body's side. */
struct mirror_node {
    int32_t node, image;            /* node beyond the plane; node on the body's side */
    int8_t sign[DIM_MAX];           /* sign of each component of the image: -1 or 1 */
    uint8_t load;                   /* index of the boundary condition that is this plane */
    real mass, taken[DIM_MAX];      /* mass and impulse of points on the node itself in this step [kg], [N s] */
    real image_mass, image_inverse; /* of the image node alone (reference frame) [kg], [1/kg] */
    real reaction[DIM_MAX];         /* impulse of the plane on the body in this step [N s] */
};

/* A wall: one velocity component of one grid node that a boundary condition prescribes. The nodal force on this
 * component is replaced by the force that the prescribed motion requires. */
struct wall {
    int32_t node;
    int16_t component, load; /* load: index of the boundary condition */
    real velocity, change;   /* prescribed velocity; its change since the previous step [m/s] */
    real place;     /* prescribed displacement at the end of the step [m]; NAN: only the velocity is prescribed */
    real reaction;  /* impulse in this step, without that of the prescribed change [N s] */
    bool symmetric; /* true: the wall is a plane of symmetry, and other components of the node are free */
};

/* Enlarges the box of nodes of g, if necessary, so that it covers the positions between the corners `lower` and `upper`
 * [m] with a margin of three cells. The box grows in steps of several nodes and never shrinks. *changed receives true
 * if the box changed; all nodal values are then 0. Returns FAILED, with a message, if a position is not finite or too
 * far away, or if the box would have more than `max_nodes` nodes. */
status grid_extend_box(struct grid *g, const real *lower, const real *upper, int64_t max_nodes, bool *changed);

/* Releases all arrays of the grid g. */
void grid_free(struct grid *g);

/* Appends a copy of `prescribed_velocity`, a prescribed velocity component of a node, to the list g->wall of this step,
 * which grows as needed. */
void grid_add_prescribed_velocity(struct grid *g, const struct wall *prescribed_velocity);

/* Appends a copy of `mirror_node`, a node beyond a plane of symmetry that moves as the image of another node, to the
 * list g->mirror_node, which grows as needed. */
void grid_add_mirror_node(struct grid *g, const struct mirror_node *mirror_node);

/* Appends a copy of `dashpot`, the dashpots of one node on an absorbing face, to the list g->dashpot of this step,
 * which grows as needed. */
void grid_add_dashpot(struct grid *g, const struct dashpot *dashpot);

/* Sets the numbers of walls (prescribed nodal velocities) and dashpots of g in this step to 0, and the reactions of
 * mirror nodes (nodes beyond planes of symmetry), too. For a step without points on the grid. */
void grid_clear_constraints(struct grid *g);

/* Mass of a grid node, divided by that of a full node [1], below which the node is left at rest. Other programs use
 * 1e-9, but the impulse of the force on such a node is lost, and momentum is conserved to 1e-12 only if no node with
 * mass is left out. Light nodes do no harm: points with their new velocities are mapped to the nodes a second time
 * (data/turning.h), which gives a light node the velocity of its material point. */
#define GRID_MASS_SMALLEST 1e-30

/* Mass ratio below which two bodies are not in contact at a grid node: the mass that either body has there, divided by
 * that of a full node [1]. Round-off leaves such masses where the shape function of a material point just ends, and
 * normals would depend on them. */
#define GRID_MASS_CONTACT 1e-8

/* Mass ratio below which the acceleration of a grid node is extrapolated from heavier neighbours (struct follower):
 * mass divided by that of a full node [1]. Empirical: with values below 1e-6, motions of a hundredth of a spacing act
 * across gaps; with values above 1e-3, rotating bodies gain more than 1e-3 of their energy in four turns. */
#define GRID_MASS_LIGHT 1e-5

/* Mass ratio of light nodes in static solutions, in place of GRID_MASS_LIGHT: mass of a node divided by that of a full
 * node [1]. A node that only the edge of a material point reaches would be in equilibrium only if the stress of the
 * point were zero. If such nodes were left at rest instead, they would support the body: a cantilever of 15 times its
 * depth bent by a quarter. */
#define GRID_MASS_STATIC 1e-3

/* Returns the coordinate [m] along axis `axis` of the grid node number `node`, counted along this axis from the lowest
 * node (0) of the box of g. */
static inline real grid_node_position(const struct grid *g, int axis, int64_t node)
{
    return g->anchor[axis] + g->h * (real)(g->first[axis] + node);
}

/* Returns the coordinate x [m] along axis `axis` in node distances from node 0 at g->anchor. The floor of the result is
 * the number of the cell that contains x. All callers use this function, so that they round alike. */
static inline real grid_coordinate_in_cell_lengths(const struct grid *g, int axis, real x)
{
    return (x - g->anchor[axis]) * (1 / g->h);
}

/* Returns the number, along axis `axis` and counted from node 0 at g->anchor, of the cell of g that contains the
 * coordinate x [m]: the floor of grid_coordinate_in_cell_lengths, without a library call. */
static ALWAYS_INLINE int64_t grid_cell_index_at(const struct grid *g, int axis, real x)
{
    const real place = grid_coordinate_in_cell_lengths(g, axis, x);
    const int64_t k = (int64_t)place;
    return k - (place < (real)k);
}

/* Returns the coordinate [m] along axis `axis` of one of the 2^dim particles that cell number `cell` of g contains at a
 * quarter and three quarters of each edge. corner: number of the corner of the cell that is nearest to the particle;
 * bit d of it is set if the corner is on the upper side along axis d. */
static inline real grid_cell_quadrature_point_coordinate(const struct grid *g, int64_t cell, int corner, int axis)
{
    return grid_node_position(g, axis, cell / g->stride[axis] % g->count[axis]) +
           (corner >> axis & 1 ? 0.75 : 0.25) * g->h;
}

/* Returns the index in grid `to_grid` of the cell that has index `cell` in grid `from_grid`; -1 if the box of `to_grid`
 * does not contain the cell. Both grids must have the same node positions, but may have different boxes. */
static inline int64_t grid_cell_index_in_other_grid(const struct grid *from_grid, int64_t cell,
                                                    const struct grid *to_grid)
{
    int64_t J = 0;
    for (int d = 0; d < from_grid->dim; d++) {
        const int64_t k = cell / from_grid->stride[d] % from_grid->count[d] + from_grid->first[d] - to_grid->first[d];
        if (k < 0 || k >= to_grid->count[d]) return -1;
        J += k * to_grid->stride[d];
    }
    return J;
}

/* Returns true if the box of nodes of g covers the positions between the corners `lower` and `upper` [m] with its
 * margin, so that grid_extend_box would leave it as it is; false also for positions that are not finite. */
bool grid_box_covers(const struct grid *g, const real *lower, const real *upper);

/* Sets the box of g (first, count, n, stride) to the nodes of all cells that contain positions between the corners
 * `lower` and `upper` [m]. g->dim, h and anchor must be set; nodal arrays are not allocated. Returns true, or false,
 * with an undefined box, if the box would have more than `max_nodes` nodes. */
bool grid_set_box_if_not_too_large(struct grid *g, const real *lower, const real *upper, int64_t max_nodes);

#endif
