/* Edit distance of two words, to suggest the nearest known word for a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

/* Returns the edit distance of the words a and b: the smallest number of operations that turn a into b, each of which
 * adds, deletes or replaces a letter or swaps two neighbours (optimal string alignment). Only the first 48 letters of
 * each word are compared. */
int edit_distance(const char *a, const char *b);

#endif
