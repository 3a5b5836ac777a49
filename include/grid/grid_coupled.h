/* The couplings of Zeng et al. 2021, in which the grid also moves peridynamic particles: those in the cells
 * at the interface (PM, PG), or all of them (PMG, PGG: one unified grid). Grid-coupled particles give mass, momentum
 * and the force of their bonds to the nodes and take velocity and position from them, but give no stress: their bonds
 * are their stress. */
#ifndef CLEAVE_GRID_COUPLED
#define CLEAVE_GRID_COUPLED

#include "data/grid.h"
#include "data/transfer_order.h"
#include "scene/requests.h"

struct grid_coupled {
    struct transfer_order order; /* of the grid-coupled particles */
    int32_t *list;               /* [n] their numbers, ascending */
    uint8_t *occupied;           /* cells of the grid that hold a material point */
    int64_t n;
};

/* Before the forces of a step: lists and flags (FLAG_GRID_COUPLED) the peridynamic particles that the grid moves, and
 * sorts them. At the interface these are the particles in cells that share a node with a cell that holds a material
 * point; so the choice does not depend on the shape functions. The grid must cover all material points, in a unified
 * grid all. */
void grid_coupled_select(struct grid_coupled *c, enum coupling coupling, struct particles *p, const struct grid *g);
/* None: no material point is left. */
void grid_coupled_none(struct grid_coupled *c, struct particles *p);
void grid_coupled_free(struct grid_coupled *c);

#endif
