/* Reads runs of LAMMPS for `cleave compare`. */
#ifndef CLEAVE_COMPARE_LAMMPS
#define CLEAVE_COMPARE_LAMMPS

#include "output/output.h"

/* Returns true if the folder contains a run of LAMMPS that `cleave export lammps` has set up. */
bool lammps_run_exists(const char *folder);

/* Lists the frames of a run of LAMMPS, as frames_list does. */
status lammps_frames_list(const char *folder, int *n, struct listed_frame **list);

/* Reads a frame of a run of LAMMPS, as run_read_frame does, without stress. */
status lammps_run_read_frame(struct frame *f, const char *folder, int number);

/* Prints the differences from the state of Cleave in check.csv; nothing if the folder has no check.csv. */
status lammps_check_print(const char *folder);

#endif
