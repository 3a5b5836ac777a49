/* Contact of material points between bodies, each of which has a grid of its own: at nodes that points of two bodies
 * reach. */
#ifndef CLEAVE_CONTACT_GRID
#define CLEAVE_CONTACT_GRID

#include "base/archive.h"
#include "data/grid.h"
#include "data/transfer_order.h"
#include "data/particles.h"

/* One of the bodies between which material points make contact: background grid of the body, its points in the order of
 * the cells, and the range of nodes that the points reach, from[d] to to[d] along each axis d, counted from the anchor
 * of the grid. Both pointers are borrowed. */
struct grid_contact_side {
    struct grid *grid;
    const struct transfer_order *order;
    int64_t from[DIM_MAX], to[DIM_MAX];
};

/* A grid node that material points of two bodies reach, so that contact may act there. side: numbers (from 0) of the
 * two bodies, of which the first is called first body below. */
struct grid_contact_node {
    int side[2];
    int64_t at[2]; /* index of the node in the two grids */
    /* difference of the gradients of the nodal masses, second minus first body [kg] */
    real mass_slope[DIM_MAX];
    real normal[DIM_MAX]; /* unit normal from the first to the second body */
    /* impulse on the second body in this step [N s]; relative velocity after it [m/s] */
    real impulse[DIM_MAX], after[DIM_MAX];
    /* along the normal: largest coordinate of points of the first body, smallest of the second [m] */
    real reach[2];
};

/* Contact of material points between bodies that have a background grid each: its constants, the nodes in contact, and
 * the sums of energy so far. sides: number of these bodies. All arrays are owned. */
struct grid_contact {
    /* coefficient of friction [1]; distance of points of two bodies in contact [m]; length by which the shape function
     * of a point extends beyond a cell [m] */
    real friction, spacing, half_width;
    real smallest_mass; /* of a node in contact, of either body [kg] */
    int64_t nodes;
    struct grid_contact_node *node; /* [nodes] of the present step */
    real begun; /* sum over the nodes of impulse . relative velocity before the step, divided by 2 [J] */
    int sides;
    real *dissipated;             /* [sides^2] energy that contact of two bodies has dissipated so far [J] */
    int64_t touching, nodes_most; /* number of nodes in contact in the last step; largest such number so far */
    real began, ended;            /* first and last time of contact [s]; NAN: none so far */
};

/* Allocates c->dissipated, the energy dissipated by contact for each pair of bodies, all 0. body_count: number of
 * bodies, each with a grid of its own. The caller sets the constants friction, spacing, half_width and smallest_mass of
 * c. Release with grid_contact_free. */
void grid_contact_make(struct grid_contact *c, int body_count);

/* Initialises *side, one of the bodies in contact: its background grid g, its points sorted by cell, `order`, and the
 * range of nodes to which the shape functions of these points (of p) extend, which is computed here. g and order are
 * kept by reference. */
void grid_contact_side_make_for_body(struct grid_contact_side *side, struct grid *g, const struct transfer_order *order,
                                     const struct particles *p);

/* Lists in c->node the grid nodes to which material points of two bodies contribute mass, one entry for each pair of
 * bodies. Stores in each entry the unit normal from the first body to the second and, in `reach`, how far the points of
 * both bodies extend along this normal: largest coordinate of the first body, smallest of the second [m]. p: particles;
 * side[c->sides]: grid and points of each body. */
void grid_contact_find_shared_nodes(struct grid_contact *c, const struct grid_contact_side *side,
                                    const struct particles *p);

/* Exchanges momentum between two bodies at each node that grid_contact_find_shared_nodes has listed, if the bodies
 * touch and approach there: normal momentum without rebound, tangential momentum by friction. Changes the nodal
 * velocities of the grids of both bodies, and the velocity increments stored in their nodal forces. side: grids and
 * points of the bodies, c->sides elements. Returns the energy [J] dissipated by these exchanges. */
real grid_contact_apply_impulses_return_dissipation(struct grid_contact *c, const struct grid_contact_side *side);

/* Returns the part [J] of the energy dissipated by contact in this step that
 * grid_contact_apply_impulses_return_dissipation does not include, and adds this part to c->dissipated. With the FLIP
 * transfer, the moved points are mapped to the nodes a second time to compute their strain. The part is the sum over
 * nodes of J . (w' - w)/2: contact impulse J, relative velocity w of the two bodies just after the impulse and w' after
 * the second mapping. side: grids of the bodies, c->sides elements. */
real grid_contact_add_second_mapping_dissipation(struct grid_contact *c, const struct grid_contact_side *side);

/* Records the times of first and last contact of material points on grids: if bodies touched at nodes in the last step,
 * c->ended becomes t [s], and c->began, too, if it is still NAN. */
void grid_contact_record_first_and_last_contact_time(struct grid_contact *c, real t);

/* Saves energies and times of the contact c to the archive `a` (checkpoint file or memory) if a->saving, else restores
 * them from it. Returns FAILED if the archive cannot be read or written or a stored size differs. */
status grid_contact_save_or_load(struct grid_contact *c, struct archive *a);

/* Frees the arrays of c, the contact of material points on grids. */
void grid_contact_free(struct grid_contact *c);

#endif
