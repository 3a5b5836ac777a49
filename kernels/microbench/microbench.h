/* Limits of the machine, as references for the benches: plain loops that use nothing of the engine. They are compiled
 * with the kernels, since only code with the same vector instructions is a valid reference. */
#ifndef CLEAVE_KERNELS_MICROBENCH
#define CLEAVE_KERNELS_MICROBENCH

#include "base/base.h"
#include "kernels/simd/kernel.h"

/* ---- microbench_machine.c: the machine's own limits -------------------------------------------------------------- */

/* Lattice stencil of the bond law: contiguous loads, no bond data, positions in cache. */
struct microbench_lattice;
/* About 80,000 particles in `dim` dimensions, neighbours within 3.015 spacings. */
KERNEL(struct microbench_lattice *, microbench_lattice_make, (int dim));
/* One sweep over all bonds: seconds per directed bond. */
KERNEL(double, microbench_lattice_run, (struct microbench_lattice *s));
KERNEL(void, microbench_lattice_free, (struct microbench_lattice *s));

/* STREAM triad a = b + q c over arrays larger than any cache: bytes per second, counted as 24 bytes an entry. */
struct microbench_triad;
KERNEL(struct microbench_triad *, microbench_triad_make, (void));
KERNEL(double, microbench_triad_run, (struct microbench_triad *t));
KERNEL(void, microbench_triad_free, (struct microbench_triad *t));

/* ---- microbench_points.c: the plain material point method -------------------------------------------------------- */

/* 2D linear MUSL FLIP, 80,000 points sorted by cell, four a cell: seconds per point and step. */
struct microbench_points;
KERNEL(struct microbench_points *, microbench_points_make, (void));
KERNEL(double, microbench_points_run, (struct microbench_points *m));
KERNEL(void, microbench_points_free, (struct microbench_points *m));

#endif
