/* Writer of JSON, one entry per call. Pass NULL as `key` for an entry of a list. */
#ifndef CLEAVE_JSON
#define CLEAVE_JSON

#include <stdio.h>

#include "base/base.h"

enum { JSON_EXACT = 17, JSON_TIMING = 9 }; /* significant digits: 17 restore the same double; 9 for times */

/* Document being written. filled: the innermost object or list has at least one entry, so that the next one needs a
 * comma. */
struct json {
    FILE *file;
    int depth;
    bool filled;
};

/* Opens an object (bracket '{') or a list (bracket '['). */
void json_open(struct json *j, const char *key, char bracket);

/* Closes the innermost object (bracket '}') or list (bracket ']'). */
void json_close(struct json *j, char bracket);

/* Writes a string, with escapes. */
void json_text(struct json *j, const char *key, const char *text);

/* Writes an integer. */
void json_count(struct json *j, const char *key, int64_t value);

/* Writes a number with `digits` significant digits. Writes nothing if `value` is NaN or infinite: a value that a run
 * does not have is left out of the file. */
void json_number(struct json *j, const char *key, real value, int digits);

/* Writes a number with the 17 digits of JSON_EXACT; writes nothing if `value` is NaN or infinite. */
void json_real(struct json *j, const char *key, real value);

/* Writes the coordinates of a point, x[dim], as entries PREFIXx, PREFIXy and PREFIXz. */
void json_point(struct json *j, const char *prefix, const real *x, int dim);

#endif
