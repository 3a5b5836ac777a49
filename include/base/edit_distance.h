/* Edit distance of two words, to suggest the nearest known word for a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

#include <stdbool.h>

/* Returns the edit distance of the words a and b: the smallest number of operations that turn a into b, each of which
 * adds, deletes or replaces a letter or swaps two neighbours (optimal string alignment). Only the first 48 letters of
 * each word are compared. */
int edit_distance(const char *a, const char *b);

/* Returns true if `word` is probably `other_word` misspelt, or the reverse. With n the length of the shorter word (at
 * least 2, both together at least 5 letters), the edit distance must be at most 1, or 2 if n >= 8 or if n >= 5 and the
 * first and the last letters are equal. */
bool word_is_probable_misspelling_of(const char *word, const char *other_word);

#endif
