/* Runs of LAMMPS, for `cleave compare`. */
#ifndef CLEAVE_COMPARE_LAMMPS
#define CLEAVE_COMPARE_LAMMPS

#include "output/output.h"

/* Does the folder hold a run of LAMMPS, as `cleave export lammps` writes it? */
bool lammps_run_holds(const char *folder);
/* Its frames, as frames_list and run_frame give those of a run here; without stress. */
status lammps_frames_list(const char *folder, int *n, struct listed_frame **list);
status lammps_run_frame(struct frame *f, const char *folder, int number);
/* Prints how far it is from where check.csv says that Cleave was; nothing where it has no check. */
status lammps_check_print(const char *folder);

#endif
