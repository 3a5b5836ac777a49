/* Edit distance of two words, to suggest the nearest known word for a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

#include <stdbool.h>

/* Returns the edit distance of the words a and b: the smallest number of operations that turn a into b, each of which
 * adds, deletes or replaces a letter or swaps two neighbours (optimal string alignment). Only the first 48 letters of
 * each word are compared. */
int edit_distance(const char *a, const char *b);

/* Returns true if one of two words is likely to be the other one, misspelt: if one letter of at least two and three
 * differs, or two of at least eight, or two of at least five between equal first and last letters. */
bool words_are_similar(const char *word, const char *other_word);

#endif
