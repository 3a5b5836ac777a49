/* Limits of the machine, as references for the benches: plain loops that use nothing of the engine. They are compiled
 * with the kernels, since only code with equal vector instructions is a valid reference. */
#ifndef CLEAVE_KERNELS_MICROBENCH
#define CLEAVE_KERNELS_MICROBENCH

#include "base/base.h"
#include "kernels/simd/kernel.h"

/* ---- microbench_machine.c: limits of the machine ----------------------------------------------------------------- */

/* Data of the lattice benchmark, which evaluates the law of bonds under ideal conditions: consecutive memory accesses,
 * no stored bond data, and positions that fit into the cache. */
struct microbench_lattice;
/* Creates the data of the lattice benchmark: about 80,000 particles on a lattice in `dim` dimensions, with bonds to all
 * neighbours within 3.015 spacings. Release with microbench_lattice_free. */
KERNEL(struct microbench_lattice *, microbench_lattice_make, (int dim));
/* Computes once the force on every particle of the lattice s as the sum over its bonds. Each bond is thus evaluated
 * twice, once for each of the two particles that it joins. Returns the elapsed time [s] divided by the number of
 * evaluations. */
KERNEL(double, microbench_lattice_run, (struct microbench_lattice *s));

/* Releases s, the data of the lattice benchmark. */
KERNEL(void, microbench_lattice_free, (struct microbench_lattice *s));

/* Data of the STREAM triad a = b + q c over arrays larger than any cache. */
struct microbench_triad;

/* Allocates the three arrays of the STREAM triad a = b + q c. Each has twice the size of the last-level cache and at
 * least 64 MB, or 64 MB if `quick`. Release with microbench_triad_free. */
KERNEL(struct microbench_triad *, microbench_triad_make, (bool quick));

/* Computes the STREAM triad a = b + q c of the arrays in t once. Returns the bandwidth [bytes/s], counting 24 bytes for
 * each entry. */
KERNEL(double, microbench_triad_run, (struct microbench_triad *t));

/* Releases t, the data of the triad. */
KERNEL(void, microbench_triad_free, (struct microbench_triad *t));

/* ---- microbench_points.c: the plain material point method -------------------------------------------------------- */

/* Data of a plain material point method: 2D linear MUSL FLIP, 80,000 points sorted by cell, four per cell. */
struct microbench_points;

/* Creates the data of the benchmark of a plain material point method: 80,000 points in 2D, which are in motion. Release
 * with microbench_points_free. */
KERNEL(struct microbench_points *, microbench_points_make, (void));

/* Runs one step of the plain material point method on the data m. Returns the time per point [s]. */
KERNEL(double, microbench_points_run, (struct microbench_points *m));

/* Releases m, the data of the plain material point method. */
KERNEL(void, microbench_points_free, (struct microbench_points *m));

#endif
