/* Edit distance of two words, to suggest the nearest known word for a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

/* Returns the number of letters to add, delete, replace or swap with their neighbour (optimal string alignment) between
 * a and b, of which the first 48 letters count. */
int edit_distance(const char *a, const char *b);

#endif
