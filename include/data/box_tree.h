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

/* Creates a search tree over copies of the n boxes in the array `box`, in dim dimensions, with which box_search_start
 * and box_search_next find the boxes near a point. Release with box_tree_free. */
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

/* Starts a search for the boxes of the tree `tree` near `point` (dim components [m]); box_search_next then returns them
 * one by one. `tree` and `point` are kept by reference. */
void box_search_start(struct box_search *search, const struct box_tree *tree, const real *point, int dim);

/* Returns the number of another box that is at most `reach` [m] away from the point of `search`, or -1 if there are no
 * more. The distance is the largest over the coordinate directions, negative inside the box. The caller may reduce
 * `reach` between calls. */
int box_search_next(struct box_search *search, real reach);

#endif
