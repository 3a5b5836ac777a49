/* Builds a tree of bounding boxes, by halving lists of boxes at the median of their middles, and searches it for the
 * boxes near a point. */
#include "data/box_tree.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* A box during the construction of a tree: number `item` of the box, and coordinate of its middle along the axis of
 * the present division [m]; 0 if the box is infinite. */
struct boxed {
    real middle;
    int32_t item;
};

/* Compares two boxes a and b (struct boxed) for array_sort: by the coordinate of their middle, then by number. Returns
 * -1, 0 or 1. */
static int boxed_order(const void *a, const void *b)
{
    const struct boxed *p = a, *q = b;
    if (p->middle != q->middle) return p->middle < q->middle ? -1 : 1;
    return (p->item > q->item) - (p->item < q->item);
}

/* Returns the coordinate d of the middle of a box [m]; 0 if the box is infinite along d. */
static real middle_of(const struct bounds *box, int d)
{
    const real middle = 0.5 * (box->low[d] + box->high[d]);
    return isfinite(middle) ? middle : 0;
}

/* Returns the axis along which the middles of the n boxes list[n] have the widest range. box: all boxes, which the
 * entries of the list refer to; dim: dimensions. */
static int widest_spread(const struct boxed *list, int n, const struct bounds *box, int dim)
{
    int widest = 0;
    real most = -1;
    for (int d = 0; d < dim; d++) {
        real low = INFINITY, high = -INFINITY;
        for (int k = 0; k < n; k++) {
            const real middle = middle_of(&box[list[k].item], d);
            low = real_min(low, middle), high = real_max(high, middle);
        }
        if (high - low > most) most = high - low, widest = d;
    }
    return widest;
}

/* Builds node number `at` of the tree t from the boxes list[n], and recursively its two children. The list is sorted by
 * the middles of the boxes along the axis of widest spread, and each child gets one half. *nodes: number of nodes so
 * far, increased; box: all boxes, which list[k].item refers to; dim: number of dimensions. */
static void boxes_halve(struct box_tree *t, int32_t at, int32_t *nodes, struct boxed *list, int n,
                        const struct bounds *box, int dim)
{
    struct box_node *node = &t->node[at];
    node->box = box[list[0].item], node->item = list[0].item;
    for (int k = 1; k < n; k++)
        for (int d = 0; d < dim; d++) {
            node->box.low[d] = real_min(node->box.low[d], box[list[k].item].low[d]);
            node->box.high[d] = real_max(node->box.high[d], box[list[k].item].high[d]);
        }
    if (n == 1) return;
    const int d = widest_spread(list, n, box, dim);
    for (int k = 0; k < n; k++) list[k].middle = middle_of(&box[list[k].item], d);
    array_sort(list, n, sizeof *list, boxed_order);
    const int32_t left = *nodes;
    *nodes += 2, node->left = left;
    boxes_halve(t, left, nodes, list, n / 2, box, dim);
    boxes_halve(t, left + 1, nodes, list + n / 2, n - n / 2, box, dim);
}

void box_tree_make(struct box_tree *t, const struct bounds *boxes, int box_count, int dim)
{
    struct boxed *list = NEW("boxes.list", box_count, struct boxed);
    int32_t nodes = 1;
    *t = (struct box_tree){box_count, NEW("boxes.node", 2 * (int64_t)box_count - 1, struct box_node)};
    for (int k = 0; k < box_count; k++) list[k].item = k;
    boxes_halve(t, 0, &nodes, list, box_count, boxes, dim);
    memory_free(list);
}

void box_tree_free(struct box_tree *t)
{
    memory_free(t->node);
    *t = (struct box_tree){0};
}

/* ---- search ------------------------------------------------------------------------------------------------------ */

/* Appends node number `node` of the tree q->tree to the list of nodes that the search q still has to visit, and stores
 * a lower bound of the distance of its box from the search point q->X [m]. */
static void box_wait(struct box_search *q, int32_t node)
{
    const struct bounds *box = &q->tree->node[node].box;
    real least = -INFINITY;
    for (int d = 0; d < q->dim; d++) least = real_max(least, real_max(box->low[d] - q->X[d], q->X[d] - box->high[d]));
    q->wait[q->waiting++] = (struct box_waiting){node, least};
}

void box_search_start(struct box_search *search, const struct box_tree *tree, const real *point, int dim)
{
    search->tree = tree, search->X = point, search->dim = dim, search->waiting = 0;
    if (tree->n > 0) box_wait(search, 0);
}

int box_search_find_next_box_within(struct box_search *search, real max_distance)
{
    while (search->waiting > 0) {
        const struct box_waiting next = search->wait[--search->waiting];
        const struct box_node *node = &search->tree->node[next.node];
        if (next.least > max_distance) continue;
        if (node->left == 0) return node->item;
        box_wait(search, node->left);
        box_wait(search, node->left + 1);
        struct box_waiting *two = &search->wait[search->waiting - 2];
        if (two[0].least < two[1].least) {
            const struct box_waiting nearer = two[0];
            two[0] = two[1], two[1] = nearer;
        }
    }
    return -1;
}
