/* Reads runs of LAMMPS for `cleave compare`. */
#ifndef CLEAVE_COMPARE_LAMMPS
#define CLEAVE_COMPARE_LAMMPS

#include "output/output.h"

/* Returns true if `folder` contains a run of LAMMPS that `cleave export lammps` has set up. */
bool lammps_run_exists(const char *folder);

/* Lists the output frames (states at output times) of the run of LAMMPS in `folder`, from its file plate.dump. Stores
 * their number in *frame_count and an allocated array in *frames, which the caller releases with memory_free. Returns
 * FAILED if in.lammps or plate.dump cannot be read or has no frame. */
status lammps_run_list_frames(const char *folder, int *frame_count, struct listed_frame **frames);

/* Reads the output frame (state at one output time) with the number `frame_number` of the run of LAMMPS in `folder`
 * into *f. The frame has no stress. Returns FAILED if a file of the run cannot be read or is damaged. Release f with
 * frame_free. */
status lammps_run_read_frame(struct output_frame *f, const char *folder, int frame_number);

/* Prints the differences between the run of LAMMPS in `folder` and the particle positions that Cleave has computed for
 * the same step, which the export wrote to check.csv. Prints nothing if the folder has no check.csv. Returns FAILED if
 * a file cannot be read. */
status lammps_print_differences_from_export(const char *folder);

#endif
