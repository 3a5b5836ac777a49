/* Contact of peridynamic particles, as a part of a run. */
#ifndef CLEAVE_CONTACT_PART
#define CLEAVE_CONTACT_PART

#include "run/run.h"

/* Says once that particles in contact overlap much; FAILED where they are about to pass each other. */
status contact_overlap_check(struct run *e);

#endif
