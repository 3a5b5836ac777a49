/* Lists narrow parts of bodies whose number of particle rows does not match their width. */
#ifndef CLEAVE_CHECK_UNEVEN
#define CLEAVE_CHECK_UNEVEN

#include <stdio.h>

#include "check_cover.h"
#include "engine/engine.h"

/* A narrow part of a body whose width differs from the number of particle rows across it times the spacing. */
struct uneven {
    real off, width, filled; /* relative error of its section [1]; along `axis`: width, rows times spacing [m] */
    real at[DIM_MAX];        /* point in the middle of the part [m] */
    int axis, across;        /* axis of the width; axis normal to the section */
    int material, more;      /* index, or ANY_MATERIAL; number of other parts of equal width */
    bool measured;           /* the width is measured through the point `at` */
};

/* Largest number of parts in a list of the parts with the largest errors. */
enum { UNEVEN_MOST = 3 };
struct uneven_list {
    struct piece piece; /* piece that is evaluated */
    int n;
    struct uneven part[UNEVEN_MOST];
};

/* Returns true if a part whose cross-section has the relative error `error` [1] may belong to the list of the parts
 * with the largest errors: the list is not full, or |error| is larger than nine tenths of the smallest error in it
 * (errors of equal parts differ a little by sampling). */
bool uneven_list_accepts_error(const struct uneven_list *list, real error);

/* Adds a narrow part of a body to the list, or counts it with a listed part of equal width. already_listed: true if
 * another section of this part has been added before; only the worst of them is kept. */
void uneven_list_add(struct uneven_list *list, const struct uneven *part, bool already_listed);

/* Returns the distance from X, along axis `axis`, to the point at which the line leaves the piece p (a body, or its
 * part of one material), by steps and bisection [m]; max_distance if it is larger. step: length of a step, whose sign
 * is the direction [m]. */
real piece_distance_to_surface(const struct piece *p, const real *X, int axis, real step, real max_distance);

/* Prints a line to `out` for each part of the list whose width has been measured; if there is no such part, a line for
 * the section with the largest error. */
void print_uneven_parts(struct uneven_list *list, FILE *out);

/* Adds the necks of the piece list->piece to the list: parts that widen on both sides, such as the ligament between a
 * hole and an edge (check_necks.c). cover: lattice cells of the piece; named[cells] excludes parts that are in the list
 * already: bit d is set for cells of a listed part whose width is measured along axis d. */
void uneven_add_necks(struct uneven_list *list, const struct run *run, const struct cover *cover, uint8_t *named);

/* Adds the parts of a body in 1D whose length is no whole number of spacings to the list (check_necks.c). */
void uneven_add_lengths(struct uneven_list *list);

#endif
