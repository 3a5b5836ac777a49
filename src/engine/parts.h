/* The table of parts (run/part.h). */
#ifndef CLEAVE_PARTS
#define CLEAVE_PARTS

#include "run/run.h"

/* Makes all parts of a run, empty; frees them and what they own: nothing where they have not been made. */
void run_parts_make(struct run *e);
void run_parts_free(struct run *e);

#endif
