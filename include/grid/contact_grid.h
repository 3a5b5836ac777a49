/* Contact of material points: bodies with a grid each, which meet at nodes that points of two of them reach. */
#ifndef CLEAVE_CONTACT_GRID
#define CLEAVE_CONTACT_GRID

#include "base/archive.h"
#include "data/grid.h"
#include "data/transfer_order.h"
#include "data/particles.h"

/* The grid of a body, its points, and the nodes that they can reach, counted from the anchor. */
struct grid_side {
    struct grid *grid;
    const struct transfer_order *order;
    int64_t from[DIM_MAX], to[DIM_MAX];
};

/* A node that two of them reach. */
struct grid_contact_node {
    int side[2];
    int64_t at[2];                         /* in their grids */
    real leaning[DIM_MAX];                 /* difference of the gradients of both masses [kg] */
    real normal[DIM_MAX];                  /* from the first to the second */
    real impulse[DIM_MAX], after[DIM_MAX]; /* given to the second in this step [N s]; relative velocity then [m/s] */
    real reach[2];                         /* along it: largest of the first's points, least of the second's [m] */
};

struct grid_contact {
    real friction, spacing, half_width; /* [1]; distance of points in touch [m]; of their shapes beyond a cell [m] */
    real smallest_mass;                 /* of a node that moves [kg] */
    int64_t nodes;
    struct grid_contact_node *node; /* [nodes] of this step */
    real begun;                     /* work over the velocities before the step, half of it [J] */
    int sides;
    real *taken;                  /* [sides^2] energy that contact of two bodies has taken so far [J] */
    int64_t touching, nodes_most; /* in touch: in the last step, most so far */
    real began, ended;            /* of all contact so far, NAN: none yet [s] */
};

/* An account for each two of so many sides. */
void grid_contact_make(struct grid_contact *c, int sides);
void grid_side_make(struct grid_side *a, struct grid *g, const struct transfer_order *order, const struct particles *p);
/* Nodes at which any two of the sides, [c->sides], may meet in this step, by masses and points. */
void grid_contact_find(struct grid_contact *c, const struct grid_side *side, const struct particles *p);
/* Exchanges momentum where they touch and approach: of the velocities that points receive, and their change. Returns
 * the energy taken [J]; remapped: what FLIP takes beyond that, whose points have the velocities of the second map. */
real grid_contact_exchange(struct grid_contact *c, const struct grid_side *side);
real grid_contact_remapped(struct grid_contact *c, const struct grid_side *side);
/* Notes that the time is t [s]. */
void grid_contact_clock(struct grid_contact *c, real t);
status grid_contact_archive(struct grid_contact *c, struct archive *a);
void grid_contact_free(struct grid_contact *c);

#endif
