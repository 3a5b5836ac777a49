/* Text dumps of LAMMPS read back, as `cleave export lammps` has them written: `id x y z`, and vx vy vz and c_damage
 * where they are there. */
#ifndef CLEAVE_LAMMPS_DUMP
#define CLEAVE_LAMMPS_DUMP

#include "base/base.h"

/* Particles of one step, by id. */
struct lammps_frame {
    int64_t n, step;
    double *x[DIM_MAX], *v[DIM_MAX]; /* [m], [m/s] */
    double *damage;                  /* share of the bonds that LAMMPS made [1] */
};

/* The steps in a dump, ascending, allocated; how many through *n. A last one that is being written is left out. FAILED
 * where the file is no such dump. */
status lammps_steps(const char *path, int *n, int64_t **step);
/* The frame of a step. FAILED where it is not there, or ids are not 1 .. n, each once. On a fault nothing is left to
 * free. */
status lammps_frame_read(struct lammps_frame *f, const char *path, int64_t step);
void lammps_frame_free(struct lammps_frame *f);

#endif
