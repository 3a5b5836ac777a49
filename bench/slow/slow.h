/* `cleave bench slow`: compares slow crack growth in load steps with linear elastic fracture mechanics. Declarations
 * shared by its files. */
#ifndef CLEAVE_BENCH_SLOW
#define CLEAVE_BENCH_SLOW

#include "bench/common/bench_goals.h"

enum { SLOW_SPACINGS = 3 }; /* coarse, as in the scene, fine */

/* Runs fracture specimens in load steps, compares their loads with linear elastic fracture mechanics, adds the goals
 * for the errors to *goals and draws results/bench/slow_curves (slow_specimens.c). quick: two specimens only. Returns
 * FAILED if a run or a file fails. */
status slow_run_specimens(struct bench_goals *goals, bool quick);

/* Compares the first kinks of inclined cracks with the criterion of the largest hoop stress, and the crack path from an
 * eccentric notch of a beam with finite elements, and adds the goals for the errors to *goals (slow_paths.c). quick:
 * one resolution. Returns FAILED if a run or a file fails. */
status slow_compare_crack_paths(struct bench_goals *goals, bool quick);

/* Times a hundred load steps of 100,000 particles, and one equilibrium with every solver, and adds the goals for the
 * times to *goals (slow_speed.c). quick: small plates. Returns FAILED if a run or a file fails. */
status slow_time_load_steps(struct bench_goals *goals, bool quick);

#endif
