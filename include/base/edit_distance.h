/* Edit distance of two words, to suggest the nearest known word for a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

#include <stdbool.h>

/* Returns the edit distance of the words a and b: the smallest number of operations that turn a into b, each of which
 * adds, deletes or replaces a letter or swaps two neighbours (optimal string alignment). Only the first 48 letters of
 * each word are compared. */
int edit_distance(const char *a, const char *b);

/* Returns true if `word` is probably `other_word` misspelt, or the reverse. The shorter word must have at least 2
 * letters, both together at least 5. Their edit distance must be at most 1. It may be 2 if the shorter word has at
 * least 8 letters, or at least 5 while the first and the last letters of both words are equal. */
bool word_is_probable_misspelling_of(const char *word, const char *other_word);

#endif
