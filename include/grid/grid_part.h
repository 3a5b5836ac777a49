/* Room `grid`: material points on the grid of the current frame: their bodies, their contact, and the peridynamic
 * particles that the grid moves. It knows the run; conversion, the step and the engine call it. */
#ifndef CLEAVE_GRID_PART
#define CLEAVE_GRID_PART

#include "data/grid.h"
#include "data/turning.h"
#include "grid/active_points.h"
#include "grid/contact_grid.h"
#include "grid/grid_coupled.h"
#include "run/run.h"

/* A grid and its material points: all of them, or where bodies meet on the grid those of one body, whose velocities it
 * has. */
struct grid_field {
    struct grid grid;
    struct transfer_order order;
    struct constrained_set held; /* its nodes in driven regions and on mirrors */
    int64_t n;
    int32_t *list; /* [n] its points, ascending; NULL: all */
};

/* Material points on the grid of the current frame. */
struct grid_method {
    int fields; /* 1, or one a body */
    struct grid_field *field;
    struct grid_contact contact;   /* between fields */
    struct active_points active;   /* which of them the transfers leave out */
    struct grid_coupled coupled; /* peridynamic particles that the grid moves (coupling pm .. pgg) */
    struct turning_groups turning; /* groups of them that turn together (FLIP) */
    struct transfer_data transfer;
    bool sort_needed;   /* points moved to other cells or converted */
    real smallest_mass; /* of a node that moves [kg] */
};

#endif
