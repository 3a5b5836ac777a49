/* Finds material points of the current frame that have come apart without fracture. */
#ifndef CLEAVE_PARTED
#define CLEAVE_PARTED

#include "base/warnings.h"
#include "data/cells.h"
#include "scene/scene.h"

/* Two neighbouring material points, by particle index. */
struct point_pair {
    int32_t a, b;
};

/* Pairs of neighbouring material points on the grid of the current frame that can come apart. made: the pairs have been
 * found; this is done at the first comparison. */
struct point_pairs {
    bool made;
    bool pulled; /* the warning that pulled points bear too little has been printed */
    int64_t n;
    struct point_pair *pair; /* [n] owned */
};

/* Warns of neighbouring material points of metal, on the grid of the current frame, between which the cells are empty:
 * they share no nodes, and nothing holds them together; with linear shapes and gimp of those that are pulled so far
 * that they bear too little. Does nothing if the scene accepts large strains, and before the plastic strain of a point
 * exceeds 0.02. cells: of the particles p; t: present time [s]. Returns true if the warning that points have come apart
 * has been printed. */
bool parted_points_say(struct point_pairs *pairs, const struct particles *p, const struct cells *cells,
                       const struct scene *s, real t, struct warnings *to);

#endif
