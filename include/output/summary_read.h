/* Reader of the summary.json of a finished run. */
#ifndef CLEAVE_SUMMARY_READ
#define CLEAVE_SUMMARY_READ

#include "base/base.h"

/* Reads one number from the file summary.json of the folder of a run and stores it in *value, in SI units. dotted_key:
 * names of objects and indices of lists from 0, joined by dots, for example "crack.tips.0.x". Returns FAILED, with
 * *value = NAN, if there is no such file or number, or if any part of the file is not valid JSON. */
status summary_read_number(const char *folder, const char *dotted_key, double *value);

/* Reads one string from the file summary.json of the folder of a run into text[size], cut to size - 1 bytes.
 * dotted_key: names of objects and indices of lists from 0, joined by dots, for example "crack.tips.0.x". Escapes other
 * than \" and \\ are not decoded. Returns FAILED, with an empty text, if there is no such file or string, or if any
 * part of the file is not valid JSON. */
status summary_read_string(const char *folder, const char *dotted_key, char *text, size_t size);

/* Type of a function that receives one number of summary.json. context: the argument `context` of
 * summary_visit_numbers; key: names of objects and indices of lists that lead to the number, joined by dots; value: the
 * number. */
typedef void summary_number_visit_fn(void *context, const char *key, double value);

/* Calls visit(context, key, value) for every number of the file summary.json of the folder of a run, in the order of
 * the file. key: names of objects and indices of lists that lead to the number, joined by dots. Returns FAILED if there
 * is no such file or it is not valid JSON; `visit` has then been called for the numbers before the fault. */
status summary_visit_numbers(const char *folder, summary_number_visit_fn *visit, void *context);

#endif
