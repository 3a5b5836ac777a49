/* JSON, written entry by entry. A key is NULL inside a list. */
#ifndef CLEAVE_JSON
#define CLEAVE_JSON

#include <stdio.h>

#include "base/base.h"

enum { JSON_EXACT = 17, JSON_TIMING = 9 }; /* digits; 17 give back the same double */

/* A text under construction. `filled`: the innermost object has an entry. */
struct json {
    FILE *file;
    int depth;
    bool filled;
};

/* An object or a list begins, with its bracket `{` or `[`, and ends with the other one. */
void json_open(struct json *j, const char *key, char bracket);
void json_close(struct json *j, char bracket);
void json_text(struct json *j, const char *key, const char *text);
void json_count(struct json *j, const char *key, int64_t value);
/* A figure that a run does not have (NaN, infinite) is left out. */
void json_number(struct json *j, const char *key, real value, int digits);
void json_real(struct json *j, const char *key, real value);
/* x, y, z of a point, as far as the space has them; `prefix` stands before the letter. */
void json_point(struct json *j, const char *prefix, const real *x, int dim);

#endif
