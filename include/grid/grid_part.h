/* Room `grid`: material points on the grid of the current frame: the grids of bodies, contact between them, and the
 * peridynamic particles that a grid moves. The room uses the run; conversion, the step and the engine use it. */
#ifndef CLEAVE_GRID_PART
#define CLEAVE_GRID_PART

#include "data/grid.h"
#include "data/turning.h"
#include "grid/active_points.h"
#include "grid/contact_grid.h"
#include "grid/grid_coupled.h"
#include "run/run.h"

/* A grid and its material points: all points, or, if bodies in contact have grids of their own, the points of one
 * body. */
struct grid_field {
    struct grid grid;
    struct transfer_order order;
    struct constrained_set held; /* nodes in driven regions and on mirrors */
    int64_t n;
    int32_t *list; /* [n] points of the body in ascending order; NULL: all points */
};

/* Material points on the grid of the current frame. */
struct grid_method {
    int fields; /* number of grids: 1, or one for each body */
    struct grid_field *field;
    struct grid_contact contact;   /* between the bodies of different grids */
    struct active_points active;   /* points that transfers include */
    struct grid_coupled coupled;   /* peridynamic particles that the grid moves (coupling pm .. pgg) */
    struct turning_groups turning; /* groups of points with a common rotation (FLIP) */
    struct transfer_data transfer;
    bool sort_needed;   /* points have left their cells or have converted */
    real smallest_mass; /* of a node that moves [kg] */
    real spacing;       /* of particles [m] */
};

/* Makes the grids with nodes at the positions that the scene requires; a second call moves the nodes. meshed: bodies
 * are in the reference frame, particles must be midway between nodes. */
void grid_part_make(struct grid_method *mpm, const struct scene *s, const struct particles *p, bool meshed);

/* Makes the groups of points with a common rotation, if a body is free to rotate (FLIP only; data/turning.h). */
void grid_turning_make(struct grid_method *mpm, const struct particles *p, const struct loads *loads,
                       const struct scene *s, enum coupling coupling);

/* Computes the position `anchor` of a node [dim, m] for a body whose lower corner is `from`. meshed: nodes midway
 * between particles of a lattice with a particle at `site`. */
void grid_anchor(const struct scene *s, const real *from, const real *site, bool meshed, real *anchor);

/* Returns the number of the k-th body, joined bodies counted once under the first of them, or -1. */
int body_apart(const struct scene *s, int k);

/* Returns true if a mirror is not on a node of g. (Nodes beyond mirrors follow the nodes that they mirror; extra nodes
 * of slits cannot.) */
bool grid_mirror_between(const struct grid *g, const struct scene *s);

/* Sorts the points on the grid into cells. Sets *lost if a position is not finite; nothing is sorted then. FAILED if
 * the grid would have too many nodes. */
status grid_sort(struct run *e, bool *lost);

/* Steps 1 and 3 of the algorithm (step.c): maps mass, momentum and forces of points to the nodes. */
void grid_map(struct grid_method *mpm, struct particles *p, const struct kernels *kernels, struct timers *timers);

/* Steps 3, 4, 6 and 7 of the algorithm: moves the nodes, then the points, and updates strain and stress. middle: time
 * in the middle of the step [s]. */
void grid_step(struct run *e, real middle);

/* Returns the sum of v . f over the points on the grid at the present positions, without motion [W]. middle: present
 * time plus half a step [s]. Changes the accounts of the loads. */
real grid_power(struct run *e, real middle);

#endif
