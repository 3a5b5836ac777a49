/* floor 3: rest of material points on the grid: maps between points and nodes leave out the cells that nothing has reached.
 *
 * A point is quiet where velocity, its gradient, stress and force are 0 to the last bit, nothing loads it and no bond asks for
 * it. A cell without other points gives and takes nothing but zeros, and mass to nodes that do not move: leaving it out
 * changes no bit. In a step news goes from cell to cell by the nodes that they share, once a map; cells within LOOKS times that
 * of somebody who is not quiet are awake, and who that is is looked for every LOOKS steps. Once all are awake nobody looks
 * again; once points are sorted anew all are awake until the next look. */
#ifndef CLEAVE_REST_POINTS_H
#define CLEAVE_REST_POINTS_H

#include "data/grid.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/transfer_order.h"

struct rest_points {
    bool over;                           /* all are awake for good                                   */
    int64_t nodes;
    uint8_t *busy, *near;                /* [nodes] cells by their lowest node                       */
    struct transfer_order awake;
};

enum { REST_LOOKS = 4 };                 /* steps from look to look */

/* The order of those awake, a part of `all`; `all` itself where all are. `now`: those awake until now, since all were. Walls of
 * `grid` are those of the step before. */
const struct transfer_order *rest_points_look(struct rest_points *r, const struct transfer_order *all,
                                              const struct transfer_order *now, const struct particles *p,
                                              const struct grid *grid, const struct bonds *b, const struct loads *l,
                                              enum shape shape, enum transfer transfer);
void rest_points_free(struct rest_points *r);

#endif
