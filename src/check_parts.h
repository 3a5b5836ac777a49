/* floor 5: the parts of `cleave check`: what a run costs, by measurement, and what a person would advise. */
#ifndef CLEAVE_CHECK_PARTS_H
#define CLEAVE_CHECK_PARTS_H

#include <stdio.h>

#include "engine.h"

/* ---- check_cost.c ----------------------------------------------------------------------------------------------- */

struct cost {
    double step;                         /* samples included, of the body as it is at the start; with the team that runs now [s] */
    double all_peridynamic;              /* a step if every particle were; NAN: it is, or cannot become so   [s] */
    double bytes;                        /* high-water mark of a run in which nothing converts                  */
};

/* Takes some steps and times them: the engine is good for nothing afterwards. FAILED if a step fails. */
status cost_measure(struct cost *c, struct engine *e, int threads);

/* ---- check_advice.c --------------------------------------------------------------------------------------------- */

/* A line for each thing that the scene does not resolve, and for each that it does not need, with the numbers. The engine is
 * as made, before any step. */
void advise(const struct engine *e, FILE *out);
/* check_symmetry.c: does the scene equal its mirror image in the plane across `axis` through the middle of its particles, and
 * where is that [m]? */
bool scene_is_mirrored(const struct engine *e, int axis, real *at);

#endif
