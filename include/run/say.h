/* Warnings of a running run. */
#ifndef CLEAVE_SAY
#define CLEAVE_SAY

#include "run/run.h"

/* Adds a warning to those of the run and, the first time, unless steps are taken on trial, prints it on standard error.
 */
void run_say(struct run *e, const char *text);

/* Warns how bonds of materials that yield differ from von Mises' law. */
void warn_of_yielding(const struct scene *s, struct warnings *to);

#endif
