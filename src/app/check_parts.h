/* floor 5: the parts of `cleave check`: what a run costs, by measurement, and what a person would advise. */
#ifndef CLEAVE_CHECK_PARTS_H
#define CLEAVE_CHECK_PARTS_H

#include <stdio.h>

#include "arguments.h"
#include "engine/engine.h"

/* ---- check_cost.c ----------------------------------------------------------------------------------------------- */

/* What the time of a run rests on: all of its steps; its first ones, times what the others take beside those where particles are
 * larger; its first ones, which is little where much will convert. */
enum cost_basis { COST_TRIED, COST_SCALED, COST_FIRST };

struct cost {
    double make;                         /* from the scene to step 0; by the caller                               [s] */
    double step;                         /* first ones, samples included, all of the body awake; static: an iteration [s] */
    double output;                       /* frames and checkpoints, on a disk that nobody else keeps busy          [s] */
    double run;                          /* all of it                                                              [s] */
    enum cost_basis basis;
    double coarser, growth;              /* SCALED: larger by this; steps take that many times the first ones          */
    double all_peridynamic;              /* a run if every particle were; NAN: it is, cannot become so, or is too large [s] */
    double bytes;                        /* high-water mark of a run in which nothing converts                         */
};

/* Takes steps and times them, with the team that runs now: the engine is good for nothing afterwards. `a` is where its scene comes
 * from. FAILED if one of the first steps fails. */
status cost_measure(struct cost *c, struct engine *e, const struct run_arguments *a);

/* ---- check_advice.c --------------------------------------------------------------------------------------------- */

/* A line for each thing that the scene does not resolve, and for each that it does not need, with the numbers. The engine is
 * as made, before any step. */
void advise(const struct engine *e, FILE *out);
/* check_symmetry.c: does the scene equal its mirror image in the plane across `axis` through the middle of its particles, and
 * where is that [m]? */
bool scene_is_mirrored(const struct engine *e, int axis, real *at);

#endif
