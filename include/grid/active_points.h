/* The active set of material points: transfers between points and grid skip the cells of a region still at rest, with
 * bitwise equal results. A point is inactive if its velocity, velocity gradient, stress and force are exactly 0, no
 * load acts on it and it has no bond. A cell of inactive points contributes only zeros, and mass to nodes that do not
 * move. In one step motion spreads from cell to cell through common nodes, once for each transfer. Every
 * ACTIVE_POINTS_STEPS steps the cells that motion can reach within as many steps become active. The search ends once
 * all cells are active. After points have been sorted anew, all cells are active until the next search. */
#ifndef CLEAVE_ACTIVE_POINTS
#define CLEAVE_ACTIVE_POINTS

#include "data/grid.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/transfer_order.h"

/* Grid cells and material points that transfers between points and background grid include; all others are still at
 * rest. active: these points, sorted by cell. All arrays are owned. */
struct active_points {
    bool over; /* all cells are active for the rest of the run */
    int64_t nodes;
    uint8_t *active_cell, *near; /* [nodes] by lowest node of a cell: 1: the cell is active; 1: motion can enter the
                                    cell, which becomes active */
    struct transfer_order active;
};

enum { ACTIVE_POINTS_STEPS = 4 }; /* steps between two searches for the cells that motion can reach */

/* Finds the material points whose cells motion can reach in the next steps, so that transfers between points and grid
 * can skip all others. active: the result of the last call, updated; full_order: points sorted by cell; previous_order:
 * the sorted points that transfers have used so far; grid: background grid with the prescribed nodal velocities (walls)
 * of the previous step; b: bonds; p: particles; loads: boundary conditions; shape, transfer: shape functions and
 * transfer scheme (FLIP or APIC), which determine how far motion spreads in a step. Returns the active points sorted
 * like full_order, as an order that `active` owns, or `full_order` if all points are active. */
const struct transfer_order *active_points_update_transfer_order(struct active_points *active,
                                                                 const struct transfer_order *full_order,
                                                                 const struct transfer_order *previous_order,
                                                                 const struct particles *p, const struct grid *grid,
                                                                 const struct bonds *b, const struct loads *loads,
                                                                 enum shape shape, enum transfer transfer);

/* Frees the arrays of `active` (cells and points that transfers include) and sets all members of `active` to 0. */
void active_points_free(struct active_points *active);

#endif
