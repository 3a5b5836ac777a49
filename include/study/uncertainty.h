/* Reads the error bars of the results of a run from an existing convergence study of its scene. */
#ifndef CLEAVE_UNCERTAINTY
#define CLEAVE_UNCERTAINTY

#include "engine/engine.h"
#include "output/output_files.h"
#include "step/report.h"

/* Returns the path FOLDER_pilot of the folder for the pilot runs of the run in `folder`, with FOLDER = folder. */
struct path pilot_folder_of_run(const char *folder);

/* Reads the half-widths of the 95 % intervals of scalar results from an existing convergence study of the scene s: the
 * study in the folder NAME_converge beside `folder`, the folder of the run, with the name NAME of the scene, or else
 * the study of its pilot runs. Stores at most `capacity` results with their half-widths in error_bars[]. Returns their
 * number; 0 if there is no study of this scene or it cannot be read. */
int error_bars_read_from_convergence_study(struct error_bar *error_bars, int capacity, const struct scene *s,
                                           const char *folder);

#endif
