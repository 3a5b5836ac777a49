/* Reads words of command lines with the functions that read scenes. */
#ifndef CLEAVE_WORDS
#define CLEAVE_WORDS

#include "base/base.h"

/* Reads a length with its unit, such as `4mm`, from `text` into *value [m]. Returns false if the text is no length, and
 * writes what is wrong to `message` (`capacity` bytes), as the rest of a sentence that begins with the text. */
bool length_read(real *value, const char *text, char *message, size_t capacity);

/* Reads a time with its unit, such as `4us`, from `text` into *value [s]. Returns false if the text is no time, and
 * writes what is wrong to `message` (`capacity` bytes), as the rest of a sentence that begins with the text. */
bool time_read(real *value, const char *text, char *message, size_t capacity);

/* Reads a number with a unit of the kind whose SI symbol is `symbol` (such as Pa; without a unit if there is none of
 * this symbol) from `text` into *value [SI]. Returns false if the text is no such number, and writes what is wrong to
 * `message` (`capacity` bytes), as the rest of a sentence that begins with the text. */
bool value_read_in_unit(real *value, const char *text, const char *symbol, char *message, size_t capacity);

/* Returns the index of `text` in the words a|b|c, or -1. */
int word_index_in_list(const char *words, const char *text);

/* Returns the name among the n > 0 names in `name` that has the smallest edit distance to `word`, the first of
 * several. */
const char *word_nearest(const char *word, const char *const *name, int n);

#endif
