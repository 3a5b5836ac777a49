/* Error bars of a scene from a study of convergence that is at hand. */
#ifndef CLEAVE_UNCERTAINTY
#define CLEAVE_UNCERTAINTY

#include "engine/engine.h"
#include "output/output_files.h"
#include "step/report.h"

/* The folder of the pilot runs of a run: its own name with _pilot behind it. */
struct path pilot_folder(const char *folder);

/* The 95 % intervals of the figures of a scene that is run in `folder`, if NAME_converge beside that folder is a study
 * of it. Returns how many; 0: there is none, or it cannot be read. */
int error_bars_at_hand(struct error_bar *bar, int most, const struct scene *s, const char *folder);

#endif
