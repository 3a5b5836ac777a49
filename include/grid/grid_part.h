/* Room `grid` (folder of include/ and src/): material points on background grids (current frame: mapped to the grid at
 * their present positions): the grids of bodies, contact between them, and the peridynamic particles that a grid moves.
 * The room uses the structures of a run; conversion, the time step and the engine use it. */
#ifndef CLEAVE_GRID_PART
#define CLEAVE_GRID_PART

#include "data/grid.h"
#include "data/turning.h"
#include "grid/active_points.h"
#include "grid/contact_grid.h"
#include "grid/grid_coupled.h"
#include "run/run.h"

/* Which points must be sorted into cells before the next transfer: none, those that have left their cells in the last
 * step (transfer_order.left), or all, because points have converted or have been moved otherwise. */
enum sort_needed { SORT_NONE, SORT_LEFT, SORT_ALL };

/* A background grid and the n material points on it, sorted by cell in `order`: those of all bodies or, if bodies in
 * contact have a grid each, those of one body. */
struct grid_field {
    struct grid grid;
    struct transfer_order order;
    struct constrained_set held; /* nodes in driven regions and on mirrors */
    int64_t n;
    int32_t *list; /* [n] points of the body in ascending order; NULL: all points */
};

/* Material points that move by background grids (current frame: points are mapped to the grid at their present
 * positions): all grids of a run, field[fields], and data that all grids share. */
struct grid_method {
    int fields; /* number of grids: 1, or one for each body */
    struct grid_field *field;
    struct grid_contact contact;      /* between the bodies of different grids */
    struct active_points active;      /* points that transfers include */
    struct grid_coupled coupled;      /* peridynamic particles that the grid moves (coupling pm .. pgg) */
    struct corotating_groups turning; /* groups of points with a common rotation (FLIP) */
    struct transfer_data transfer;    /* inputs of the transfers, besides particles and grid */
    enum sort_needed sort_needed;     /* which points are sorted before the next transfer */
    real smallest_mass;               /* of a node that moves [kg] */
    real spacing;                     /* of particles [m] */
};

/* Makes the background grids mpm of a run: one for all bodies, or one for each body if material points of several
 * bodies can be in contact. Sets cell size and positions of the nodes; grid_sort_points_into_cells allocates the nodes
 * later. May be called again, with another `nodes_midway_between_particles`, to change the positions of the nodes.
 * Released by run_free_memory. s: scene; p: particles; nodes_midway_between_particles: true if bodies move with a mesh
 * of the undeformed body (reference frame), whose particles must be midway between nodes. */
void background_grids_make(struct grid_method *mpm, const struct scene *s, const struct particles *p,
                           bool nodes_midway_between_particles);

/* Makes the groups mpm->turning of material points of p that rotate together (data/turning.h), so that the FLIP
 * transfer conserves angular momentum. Does nothing if no body is free to rotate, in 1D, and for transfers other than
 * FLIP. loads: boundary conditions, which may prevent rotation; s: scene; coupling: how material points and peridynamic
 * particles are coupled. */
void corotating_groups_make_for_flip_transfer(struct grid_method *mpm, const struct particles *p,
                                              const struct loads *loads, const struct scene *s, enum coupling coupling);

/* Returns the length [m] by which the shape function of an unstretched material point of scene s extends beyond the
 * nodes of its cell; 0 for linear shape functions. */
real grid_shape_function_reach_beyond_cell(const struct scene *s);

/* Chooses the position of the nodes of the background grid of scene s: stores the position of one node, from which all
 * others follow, in `node_position` (dim components [m]). body_corner: lower corner of the first body [m];
 * lattice_site: position of one particle of its lattice [m]; midway_between_particles: true to place nodes midway
 * between particles. */
void grid_choose_reference_node_position(const struct scene *s, const real *body_corner, const real *lattice_site,
                                         bool midway_between_particles, real *node_position);

/* Returns the number of the first body in group number `group` (from 0) of the bodies of scene s. A group is a set of
 * bodies that are joined to each other, or a single body. Returns -1 if there are no more than `group` groups. */
int scene_first_body_of_joined_group(const struct scene *s, int group);

/* Returns true if the plane of a mirror boundary of scene s does not pass through nodes of the grid g. Slits
 * (pre-cracks) and voids (narrow gaps) then cannot divide a mesh on these nodes, because the doubled nodes have no
 * mirror nodes. */
bool grid_has_mirror_plane_between_nodes(const struct grid *g, const struct scene *s);

/* Sorts the material points of the run into the cells of their background grids, extends the grids as needed, and
 * selects the peridynamic particles that a grid moves. position_not_finite: receives true if the position of a point is
 * not finite; nothing is sorted then. Returns FAILED, with a message, if the grid would have too many nodes. */
status grid_sort_points_into_cells(struct run *run, bool *position_not_finite);

/* Maps mass, momentum and forces of the material points of p to the nodes of the background grids of mpm. kernels:
 * compiled loops for the vector instructions of this machine; timers: receives the time spent. */
void grid_transfer_mass_momentum_forces_to_nodes(struct grid_method *mpm, struct particles *p,
                                                 const struct kernels *kernels, struct timers *timers);

/* Advances the material points of the run on the background grids by one time step: moves the nodes under their forces,
 * with contact and boundary conditions, then updates positions, velocities, strain and stress of the points. t_middle:
 * time in the middle of the step [s]. Returns FAILED, with a message, if points that have left their cells need a grid
 * with too many nodes. */
status grid_advance_material_points_one_step(struct run *run, real t_middle);

/* Returns the power [W] of all forces on the material points of the run that are on background grids: the sum of v . f
 * over the nodes at the current positions. Nothing is moved, but the recorded reactions and work of the loads change.
 * t_middle: current time plus half a time step [s]. Returns 0 if no particles are on a grid. */
real grid_power_of_forces_on_material_points(struct run *run, real t_middle);

#endif
