/* How far two words are apart, to name the nearest to a mistyped one. */
#ifndef CLEAVE_EDIT_DISTANCE
#define CLEAVE_EDIT_DISTANCE

/* Number of letters to add, drop, change or swap with their neighbour (optimal string alignment) between a and b, of
 * their first 48. */
int edit_distance(const char *a, const char *b);

#endif
