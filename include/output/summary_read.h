/* Reader of the summary.json of a finished run. */
#ifndef CLEAVE_SUMMARY_READ
#define CLEAVE_SUMMARY_READ

#include "base/base.h"

/* Reads a number of folder/summary.json. dotted_key: names of objects and indices of lists from 0, for example
 * "crack.tips.0.x". value: in the units of the file (SI). The complete file must be valid JSON. FAILED if there is no
 * such file or number, or the file is not JSON; *value is NAN then. */
status summary_number(const char *folder, const char *dotted_key, double *value);

/* Reads a string of folder/summary.json into text[size] and truncates it to size - 1 bytes. Escapes other than \" and
 * \\ are not decoded. FAILED as summary_number; text is "" then. */
status summary_string(const char *folder, const char *dotted_key, char *text, size_t size);

/* Calls `visit` for every number of folder/summary.json in the order of the file. FAILED if there is no such file or it
 * is not JSON; `visit` has received the numbers before the fault then. */

/* Receives a number of summary.json and its dotted key. context: argument of summary_numbers. */
typedef void summary_visit(void *context, const char *key, double value);
status summary_numbers(const char *folder, summary_visit *visit, void *context);

#endif
