/* Lists narrow parts of bodies whose number of particle rows does not match their width. */
#ifndef CLEAVE_CHECK_UNEVEN
#define CLEAVE_CHECK_UNEVEN

#include <stdio.h>

#include "check_cover.h"
#include "engine/engine.h"

/* A narrow part of a piece (a body, or its part of one material) whose width differs from the number of particle rows
 * across it times the spacing. */
struct narrow_part {
    real off, width, filled; /* relative error of its section [1]; along `axis`: width, rows times spacing [m] */
    real at[DIM_MAX];        /* point in the middle of the part [m] */
    int axis, across;        /* axis of the width; axis normal to the section */
    int material, more;      /* index, or ANY_MATERIAL; number of other parts of equal width */
    bool measured;           /* the width is measured through the point `at` */
};

/* List of the narrow parts of a piece (a body, or its part of one material) whose widths have the largest errors.
 * UNEVEN_MOST: largest number of parts in the list. */
enum { UNEVEN_MOST = 3 };
struct width_misfit_list {
    struct body_piece piece; /* piece that is evaluated */
    int n;
    struct narrow_part part[UNEVEN_MOST];
};

/* Returns true if a part of a body whose cross-section, as its particles fill it, has the relative error `error` [1]
 * qualifies for `list`, the parts with the largest errors: if the list has fewer than UNEVEN_MOST parts, or |error| is
 * more than 0.9 times the smallest |error| in it (errors of equal parts differ a little by sampling). */
bool width_misfit_list_error_is_large_enough_to_add(const struct width_misfit_list *list, real error);

/* Adds `part`, a narrow part of a body whose rows of particles do not add up to its width, to `list`, which has at most
 * UNEVEN_MOST parts, the largest |off| first (off: relative error of the cross-section of the particles). If the list
 * is full, `part` replaces the last one, unless |off| of that one is as large. If the list has a part of nearly equal
 * width, only the one with the larger |off| is kept, and its count `more` of equal parts increases, unless
 * already_listed is true, i.e. another cross-section of the same part was added before. */
void width_misfit_list_add_narrow_part(struct width_misfit_list *list, const struct narrow_part *part,
                                       bool already_listed);

/* Computes the distance from the point X[dim] [m], which is inside the piece p (a body, or its part of one material),
 * to the surface of p along the axis `axis`, by steps and bisection. step: length of a step [m]; its sign is the
 * direction. Returns the distance, or max_distance if the distance is larger [m]. */
real body_piece_distance_to_surface_along_axis(const struct body_piece *p, const real *X, int axis, real step,
                                               real max_distance);

/* Measures the width of each narrow part in `list` along a line through the part, and prints to `out` a line for each
 * part whose error the measurement confirms. If it confirms none, prints a line for the part with the largest error.
 * Prints nothing if the list is empty. */
void print_parts_whose_width_misfits_spacing(struct width_misfit_list *list, FILE *out);

/* Adds the necks of the piece list->piece of `run` (a body, or its part of one material) to `list`, the narrow parts
 * whose width is no whole number of spacings. A neck is a narrow part that widens on both sides, such as the ligament
 * between a hole and an edge. cover: lattice cells of the piece. listed_axes[cells] excludes parts that are in the list
 * already: bit d is set for cells of a listed part whose width is measured along axis d. */
void width_misfit_list_add_necks_of_piece(struct width_misfit_list *list, const struct run *run,
                                          const struct cell_coverage *cover, uint8_t *listed_axes);

/* Adds to the list `list`, the parts with the largest errors, the parts of the 1D body list->piece (a body, or its part
 * of one material) whose length is no whole number of spacings. */
void width_misfit_list_add_parts_of_1d_body(struct width_misfit_list *list);

#endif
