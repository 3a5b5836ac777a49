/* Couplings of Zeng et al. 2021, in which the background grid also moves peridynamic particles: those in the cells at
 * the interface (PM, PG), or all of them (PMG, PGG: one grid for all particles). These grid-coupled particles
 * contribute mass, momentum and bond forces to the nodes, and their velocity and position follow from the nodes. They
 * contribute no stress, since their bonds replace it. */
#ifndef CLEAVE_GRID_COUPLED
#define CLEAVE_GRID_COUPLED

#include "data/grid.h"
#include "data/transfer_order.h"
#include "scene/requests.h"

/* The n peridynamic particles that the background grid moves in this step, and the grid cells that hold material
 * points. All arrays are owned. */
struct grid_coupled {
    struct transfer_order order; /* cell order of the grid-coupled particles */
    int32_t *list;               /* [n] grid-coupled particles in ascending order */
    uint8_t *occupied;           /* [nodes] 1: the cell holds a material point */
    int64_t n;
};

/* Selects the peridynamic particles of p that the background grid moves in this step: lists them in c, sets
 * FLAG_GRID_COUPLED and sorts them into cells. coupling: COUPLING_PM and COUPLING_PG select the particles in cells that
 * share a node with a cell that contains a material point; COUPLING_PMG and COUPLING_PGG, with one grid for all
 * particles, select all. g: background grid, which must cover all material points (with one grid for all, all
 * particles). Must be called before the forces are computed. */
void grid_coupled_select_particles_moved_by_grid(struct grid_coupled *c, enum coupling coupling, struct particles *p,
                                                 const struct grid *g);

/* Empties the list c of peridynamic particles of p that the grid moves, and clears FLAG_GRID_COUPLED of these
 * particles. For steps in which no material points are left on the grid. */
void grid_coupled_clear_particles_moved_by_grid(struct grid_coupled *c, struct particles *p);

/* Frees the arrays of c, the list of peridynamic particles that the grid moves. */
void grid_coupled_free(struct grid_coupled *c);

#endif
