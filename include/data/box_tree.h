/* A tree over boxes, to find the boxes near a point. */
#ifndef CLEAVE_BOX_TREE
#define CLEAVE_BOX_TREE

#include "base/base.h"

/* A box with edges parallel to the axes between the corners `low` and `high` [m]; coordinates may be infinite. */
struct bounds {
    real low[DIM_MAX], high[DIM_MAX];
};

/* A binary search tree over n boxes. node[0] contains all boxes; the boxes of a node are divided between node[left] and
 * node[left + 1]. A node with left = 0 is a leaf, with the single box number `item`. */
struct box_tree {
    int n;
    struct box_node {
        struct bounds box;
        int32_t left, item;
    } * node;
};

/* Creates the tree t over copies of the boxes boxes[box_count] in `dim` dimensions. box_search_start and
 * box_search_find_next_box_within then find the boxes near a point. Release with box_tree_free. */
void box_tree_make(struct box_tree *t, const struct bounds *boxes, int box_count, int dim);

/* Releases the nodes of the tree t of boxes. */
void box_tree_free(struct box_tree *t);

/* State of a search in `tree` for the boxes near the point X, both kept by reference. wait[0 .. waiting - 1]: nodes of
 * the tree still to be visited, each with its number, `node`, and the least possible distance from X of a box below it,
 * `least` [m]. BOXES_WAITING: length of `wait`. */
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

/* Starts a search for the boxes of the tree `tree` near `point` (dim components [m]); box_search_find_next_box_within
 * then returns these boxes one by one. `tree` and `point` are kept by reference. */
void box_search_start(struct box_search *search, const struct box_tree *tree, const real *point, int dim);

/* Returns the number (from 0) of another box that is at most `max_distance` [m] away from the point of `search`, or -1
 * if there are no more boxes. The distance of a box is the largest of the distances along the coordinate axes, negative
 * inside the box. The caller may reduce `max_distance` between calls. */
int box_search_find_next_box_within(struct box_search *search, real max_distance);

#endif
