/* A tree over boxes: finds those near a point without a look at all. */
#ifndef CLEAVE_BOX_TREE
#define CLEAVE_BOX_TREE

#include "base/base.h"

/* Sides may be infinite. */
struct bounds {
    real low[DIM_MAX], high[DIM_MAX];
};

/* node[0] is round all n boxes; the boxes of a node are halved into the nodes `left` and `left` + 1. left = 0: a leaf,
 * which is box number `item`. */
struct box_tree {
    int n;
    struct box_node {
        struct bounds box;
        int32_t left, item;
    } * node;
};

void box_tree_make(struct box_tree *t, const struct bounds *box, int n, int dim);
void box_tree_free(struct box_tree *t);

/* A search for boxes near X, nearer halves first. */
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

void box_search_start(struct box_search *q, const struct box_tree *t, const real *X, int dim);
/* The number of a further box from which X is no more than `reach` away in any direction, negative inside [m]; -1: none
 * is left. A smaller reach than before is heeded. */
int box_search_next(struct box_search *q, real reach);

#endif
