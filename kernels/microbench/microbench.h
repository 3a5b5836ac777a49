/* Limits of the machine, as references for the benches: plain loops that use nothing of the engine. They are compiled
 * with the kernels, since only code with the same vector instructions is a valid reference. */
#ifndef CLEAVE_KERNELS_MICROBENCH
#define CLEAVE_KERNELS_MICROBENCH

#include "base/base.h"
#include "kernels/simd/kernel.h"

/* ---- microbench_machine.c: the machine's own limits -------------------------------------------------------------- */

/* Lattice stencil of the bond law: contiguous loads, no bond data, positions in cache. */
struct stencil_probe;
/* About 80,000 particles in `dim` dimensions, neighbours within 3.015 spacings. */
KERNEL(struct stencil_probe *, stencil_probe_make, (int dim));
/* One sweep over all bonds: seconds per directed bond. */
KERNEL(double, stencil_probe_run, (struct stencil_probe *s));
KERNEL(void, stencil_probe_free, (struct stencil_probe *s));

/* STREAM triad a = b + q c over arrays larger than any cache: bytes per second, counted as 24 bytes an entry. */
struct triad_probe;
KERNEL(struct triad_probe *, triad_probe_make, (void));
KERNEL(double, triad_probe_run, (struct triad_probe *t));
KERNEL(void, triad_probe_free, (struct triad_probe *t));

/* ---- microbench_points.c: the plain material point method -------------------------------------------------------- */

/* 2D linear MUSL FLIP, 80,000 points sorted by cell, four a cell: seconds per point and step. */
struct point_probe;
KERNEL(struct point_probe *, point_probe_make, (void));
KERNEL(double, point_probe_run, (struct point_probe *m));
KERNEL(void, point_probe_free, (struct point_probe *m));

#endif
