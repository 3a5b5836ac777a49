/* Contact of peridynamic particles in a run. */
#ifndef CLEAVE_CONTACT_PART
#define CLEAVE_CONTACT_PART

#include "run/run.h"

/* Checks the largest overlap of two particles of the run that were in contact in the last step. Adds a warning to the
 * run, at most once, if this overlap exceeds 0.3 spacings. Returns FAILED, with a message, if it exceeds 0.9 spacings,
 * else OK. At 0.9 spacings particles are about to pass through each other. */
status contact_warn_or_fail_if_overlap_too_large(struct run *run);

#endif
