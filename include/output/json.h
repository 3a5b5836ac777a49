/* Writer of JSON, one entry per call. Pass NULL as `key` for an entry of a list. */
#ifndef CLEAVE_JSON
#define CLEAVE_JSON

#include <stdio.h>

#include "base/base.h"

/* Numbers of significant digits for json_write_rounded. JSON_EXACT: reading restores the same double; JSON_TIMING: for
 * durations of parts of the program. */
enum { JSON_EXACT = 17, JSON_TIMING = 9 };

/* Document being written. file: its destination; depth: number of open objects and lists; filled: the innermost object
 * or list has at least one entry, so that the next entry needs a comma. */
struct json {
    FILE *file;
    int depth;
    bool filled;
};

/* Opens an object (bracket '{') or a list (bracket '[') as the next entry of j. key: name of the entry; NULL in a list.
 * Close it with json_end_object_or_list. */
void json_begin_object_or_list(struct json *j, const char *key, char bracket);

/* Closes the innermost open object or list of j. bracket: closing bracket, '}' of an object or ']' of a list. */
void json_end_object_or_list(struct json *j, char bracket);

/* Writes the string `text` as the next entry of j, with special characters escaped. key: name of the entry; NULL in a
 * list. */
void json_write_text(struct json *j, const char *key, const char *text);

/* Writes the integer `value` as the next entry of j. key: name of the entry; NULL in a list. */
void json_write_integer(struct json *j, const char *key, int64_t value);

/* Writes the number `value` with `digits` significant digits as the next entry of j. key: name of the entry; NULL in a
 * list. Writes no entry if `value` is NaN or infinite, which marks a quantity that a run does not have. */
void json_write_rounded(struct json *j, const char *key, real value, int digits);

/* Writes the number `value` with 17 significant digits, which restore the same double, as the next entry of j. key:
 * name of the entry; NULL in a list. Writes no entry if `value` is NaN or infinite. */
void json_write_real(struct json *j, const char *key, real value);

/* Writes the coordinates x[dim] of a point as the entries PREFIXx, PREFIXy and PREFIXz of the innermost object of j,
 * with PREFIX = prefix. */
void json_write_point(struct json *j, const char *prefix, const real *x, int dim);

#endif
