/* Words of command lines, read as scenes read theirs. */
#ifndef CLEAVE_WORDS
#define CLEAVE_WORDS

#include "base/base.h"

/* A length [m] or a time [s] with its unit: `4mm`. False: `what` is the rest of a sentence that begins with the
 * text. */
bool word_length(real *value, const char *text, char *what, size_t room);
bool word_time(real *value, const char *text, char *what, size_t room);

/* The one of n names that is written most like `word`. */
const char *word_nearest(const char *word, const char *const *name, int n);

#endif
