/* Reader of text dumps of LAMMPS in the form that exported input scripts request: columns `id x y z`, and optionally vx
 * vy vz and c_damage. */
#ifndef CLEAVE_LAMMPS_DUMP
#define CLEAVE_LAMMPS_DUMP

#include "base/base.h"

/* Particles of one time step in a dump of LAMMPS, sorted by id. */
struct lammps_frame {
    int64_t n, step;
    double *x[DIM_MAX], *v[DIM_MAX]; /* position [m]; velocity [m/s], 0 if the dump has none */
    double *damage;                  /* broken share of the bonds that LAMMPS created [1]; 0 if the dump has none */
};

/* Lists the numbers of the time steps in the LAMMPS dump `path` in ascending order. Stores how many there are in
 * *step_count and an allocated array of them in *step_numbers, which the caller releases with memory_free. An
 * incomplete last time step is skipped. Returns FAILED if the file is no dump with the expected columns, or contains no
 * complete time step. */
status lammps_list_step_numbers(const char *path, int *step_count, int64_t **step_numbers);

/* Reads the particles of time step number `step` of the LAMMPS dump `path` into *f, sorted by id. Returns FAILED, with
 * no memory to release, if the dump lacks that time step, or if its ids are not 1 .. n, each exactly once. Release
 * with lammps_frame_free. */
status lammps_frame_read(struct lammps_frame *f, const char *path, int64_t step);

/* Frees the particle arrays of *f, which lammps_frame_read has allocated. */
void lammps_frame_free(struct lammps_frame *f);

#endif
