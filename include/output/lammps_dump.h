/* Reader of text dumps of LAMMPS in the form that exported input scripts request: columns `id x y z`, and optionally vx
 * vy vz and c_damage. */
#ifndef CLEAVE_LAMMPS_DUMP
#define CLEAVE_LAMMPS_DUMP

#include "base/base.h"

/* Particles of one time step, sorted by id. */
struct lammps_frame {
    int64_t n, step;
    double *x[DIM_MAX], *v[DIM_MAX]; /* position [m]; velocity [m/s], 0 if the dump has none */
    double *damage;                  /* broken share of the bonds that LAMMPS created [1]; 0 if the dump has none */
};

/* Lists the time steps in a dump in ascending order. Stores their number in *n and an allocated array in *step, which
 * the caller releases with memory_free. An incomplete last step is left out. FAILED if the file is
 * not such a dump or holds no complete step. */
status lammps_steps(const char *path, int *n, int64_t **step);

/* Reads the particles of one time step. FAILED if the step is missing or the ids are not 1 .. n, each exactly once; no
 * memory is held then. Release with lammps_frame_free. */
status lammps_frame_read(struct lammps_frame *f, const char *path, int64_t step);

/* Releases the memory of f. */
void lammps_frame_free(struct lammps_frame *f);

#endif
