/* Finds neighbouring material points on the background grid that have separated without fracture (numerical
 * fracture). */
#ifndef CLEAVE_PARTED
#define CLEAVE_PARTED

#include "base/warnings.h"
#include "data/cells.h"
#include "scene/scene.h"

struct grid_method; /* grid/grid_part.h */

/* A shape function of the background grid that transmits too little force between material points of metal under
 * tension. Source of the limits: force on a specimen with the yield stress sigma_y + H a = 100 + 500 a MPa, a: plastic
 * strain (tests/scenes/claims/pulled_metal.yaml), compared with the exact (sigma_y + H log l)/l at the stretch l.
 * Errors: linear shapes -12 % at l = 1.1, -30 % at 1.2; gimp, whose particle domains do not stretch, -4, -6, -10 % at
 * 1.3, 1.4, 1.5; cpgimp -3, -4, -4 %. In bars that hit a wall, up to 0.06 of the pairs of neighbours exceed the limit
 * for a short time. */
struct weak_shape_function {
    enum shape shape;
    real stretch;       /* stretch of a bar (length divided by initial length) above which the force is too small [1] */
    real pulled, share; /* stretch of the distance of two neighbours above which the pair counts as pulled [1]; fraction
                           of pulled pairs above which the run warns [1] */
    const char *word;   /* name of the shape function in key mpm.shape */
    const char *too_little; /* by how much the force is too small [%] */
};

/* Returns the properties of the shape function `shape` if it transmits too little force between material points of
 * metal under tension, as a row of a constant table; else NULL. */
const struct weak_shape_function *numerical_fracture_properties_of_shape_function(enum shape shape);

/* A pair of neighbouring material points with the particle indices a and b. */
struct point_pair {
    int32_t a, b;
};

/* Pairs of neighbouring material points on the grid of the current frame that can come apart in tension. made: true
 * once the pairs have been found, at the first comparison. */
struct point_pairs {
    bool made;
    bool pulled;  /* the warning that stretched points transmit too little force has been printed */
    int compared; /* number, from 1, of the part of the duration at whose beginning they were compared last; 0: never */
    int64_t n;
    struct point_pair *pair; /* [n] owned */
};

struct grid_method;

/* Warns of neighbouring material points of metal, on the background grid, that have separated without fracture: the
 * cells between them are empty, and they share at most one layer of nodes, so that little or no force acts between
 * them. With linear shapes and gimp, also warns of points that are stretched apart so far that they transmit too little
 * force. Compares them once in each fiftieth of the duration. Does nothing if the scene accepts large strains, and
 * before the plastic strain of a point exceeds 0.02. cells: search cells of the particles p; grid: grids of the points;
 * t: current time [s]; pairs: pairs of neighbours, found at the first call. Returns true if the warning that points
 * have separated has been printed. warning_list: receives the warning. */
bool material_points_warn_of_numerical_fracture(struct point_pairs *pairs, const struct particles *p,
                                                const struct cells *cells, const struct grid_method *grid,
                                                const struct scene *s, real t, struct warnings *warning_list);

#endif
