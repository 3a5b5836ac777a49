/* Figures out of a finished run's summary.json. */
#ifndef CLEAVE_SUMMARY_READ
#define CLEAVE_SUMMARY_READ

#include "base/base.h"

/* The number at `dotted_key` (names of objects and places in lists, from 0: "crack.tips.0.x") in
 * folder/summary.json, in the file's own units (SI). The whole file must be sound JSON. FAILED: no file, not JSON,
 * no such figure, or not a number; *value is NAN then. */
status summary_number(const char *folder, const char *dotted_key, double *value);

/* The same for a text; escapes other than \" and \\ are kept as they stand. At most size - 1 bytes; "" on FAILED. */
status summary_string(const char *folder, const char *dotted_key, char *text, size_t size);

/* Hands every number of folder/summary.json to `visit`, with its dotted key, in the order of the file. FAILED: no file,
 * or not JSON; numbers before the fault have been handed out then. */
typedef void summary_visit(void *context, const char *key, double value);
status summary_numbers(const char *folder, summary_visit *visit, void *context);

#endif
