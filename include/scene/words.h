/* Reads words of command lines with the functions that read scenes. */
#ifndef CLEAVE_WORDS
#define CLEAVE_WORDS

#include "base/base.h"

/* Reads a length with its unit, such as `4mm`, as a number in metres. Returns false on failure and writes to what[room]
 * the rest of a sentence that begins with the text. */
bool length_read(real *value, const char *text, char *what, size_t room);

/* Reads a time with its unit, such as `4us`, as a number in seconds; fails as length_read does. */
bool time_read(real *value, const char *text, char *what, size_t room);

/* Returns the one of n names with the smallest edit distance to `word`. */
const char *word_nearest(const char *word, const char *const *name, int n);

#endif
