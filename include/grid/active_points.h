/* The active set of material points: maps between points and grid leave out the cells that no wave has reached. A
 * point is inactive where its velocity, velocity gradient, stress and force are 0 to the last bit, no load acts on
 * it and no bond reaches it. A cell of inactive points gives and takes zeros only, and mass to nodes that do not
 * move: leaving it out changes no bit. In one step motion spreads from cell to cell through shared nodes, once per
 * map. Every ACTIVE_POINTS_STEPS steps the cells within that many steps' reach of an active point become active.
 * Once all cells are active the search ends; after points are sorted anew all cells are active until the next
 * search. */
#ifndef CLEAVE_ACTIVE_POINTS
#define CLEAVE_ACTIVE_POINTS

#include "data/grid.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/transfer_order.h"

struct active_points {
    bool over; /* all cells are active, for the rest of the run */
    int64_t nodes;
    uint8_t *active_cell, *near; /* [nodes] by the lowest node of the cell; near: reached next */
    struct transfer_order active;
};

enum { ACTIVE_POINTS_STEPS = 4 }; /* steps between searches */

/* The order of the active points, a part of `all`; `all` itself where all are active. `now`: the order used until
 * now. Walls of `grid` are those of the previous step. */
const struct transfer_order *active_points_update(struct active_points *r, const struct transfer_order *all,
                                                  const struct transfer_order *now, const struct particles *p,
                                                  const struct grid *grid, const struct bonds *b, const struct loads *l,
                                                  enum shape shape, enum transfer transfer);
void active_points_free(struct active_points *r);

#endif
