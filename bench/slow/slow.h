/* What the parts of `cleave bench slow` share. */
#ifndef CLEAVE_BENCH_SLOW
#define CLEAVE_BENCH_SLOW

#include "bench/common/bench_goals.h"

enum { SLOW_SPACINGS = 3 }; /* coarse, as the scene is, fine */

/* slow_specimens.c: loads of specimens beside linear elastic fracture mechanics; draws results/bench/slow_curves. */
status slow_specimens(struct bench_goals *asked, bool quick);
/* slow_paths.c: kinks of inclined cracks; the path from a notch beside the middle of a beam. */
status slow_paths(struct bench_goals *asked, bool quick);
/* slow_speed.c: a hundred load steps of 100,000 particles; one equilibrium beside the other solvers. */
status slow_speed(struct bench_goals *asked, bool quick);

#endif
