/* `cleave bench slow`: declarations shared by its files. */
#ifndef CLEAVE_BENCH_SLOW
#define CLEAVE_BENCH_SLOW

#include "bench/common/bench_goals.h"

enum { SLOW_SPACINGS = 3 }; /* coarse, as in the scene, fine */

/* Compares loads of specimens with linear elastic fracture mechanics, adds the goals and draws
 * results/bench/slow_curves (slow_specimens.c). */
status slow_specimens(struct bench_goals *asked, bool quick);

/* Compares kinks of inclined cracks, and the path from an eccentric notch of a beam, and adds the goals
 * (slow_paths.c). */
status slow_paths(struct bench_goals *asked, bool quick);

/* Times a hundred load steps of 100,000 particles, and one equilibrium with all solvers, and adds the goals
 * (slow_speed.c). */
status slow_speed(struct bench_goals *asked, bool quick);

#endif
