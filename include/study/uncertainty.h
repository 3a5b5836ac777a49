/* Error bars of the figures of a run from an existing convergence study of its scene. */
#ifndef CLEAVE_UNCERTAINTY
#define CLEAVE_UNCERTAINTY

#include "engine/engine.h"
#include "output/output_files.h"
#include "step/report.h"

/* Returns the folder of the pilot runs of a run: FOLDER_pilot. */
struct path pilot_folder(const char *folder);

/* Reads the 95 % intervals of figures from the convergence study in NAME_converge beside `folder`, if it is a study of
 * scene s. bar: receives at most `most` of them. Returns their number; 0 if there is no study or it cannot be read. */
int error_bars_at_hand(struct error_bar *bar, int most, const struct scene *s, const char *folder);

#endif
