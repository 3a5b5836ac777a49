/* Contact of peridynamic particles in a run. */
#ifndef CLEAVE_CONTACT_PART
#define CLEAVE_CONTACT_PART

#include "run/run.h"

/* Warns, once in a run, if the largest overlap exceeds 0.3 spacings. Returns FAILED if it exceeds 0.9 spacings, where
 * particles are about to pass each other. */
status contact_overlap_check(struct run *e);

#endif
