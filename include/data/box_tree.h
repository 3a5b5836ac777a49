/* A tree over boxes, to find the boxes near a point. */
#ifndef CLEAVE_BOX_TREE
#define CLEAVE_BOX_TREE

#include "base/base.h"

/* A box; sides may be infinite [m]. */
struct bounds {
    real low[DIM_MAX], high[DIM_MAX];
};

/* node[0] contains all n boxes; the boxes of a node are divided between the nodes `left` and `left` + 1. left = 0: a
 * leaf with box number `item`. */
struct box_tree {
    int n;
    struct box_node {
        struct bounds box;
        int32_t left, item;
    } * node;
};

/* Creates the tree over n boxes. Release with box_tree_free. */
void box_tree_make(struct box_tree *t, const struct bounds *box, int n, int dim);

/* Releases the tree. */
void box_tree_free(struct box_tree *t);

/* State of a search for boxes near X, nearer halves first; `wait`: nodes still to be visited, with their distances. */
enum { BOXES_WAITING = 48 };
struct box_search {
    const struct box_tree *tree;
    const real *X;
    int dim, waiting;
    struct box_waiting {
        int32_t node;
        real least;
    } wait[BOXES_WAITING];
};

/* Starts a search; X is borrowed. */
void box_search_start(struct box_search *q, const struct box_tree *t, const real *X, int dim);

/* Returns the number of a further box whose distance from X, the largest over the directions and negative inside, is at
 * most `reach` [m]; -1 at the end. `reach` may be reduced between calls. */
int box_search_next(struct box_search *q, real reach);

#endif
