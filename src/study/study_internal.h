/* Studies: declarations shared by the files study*.c. */
#ifndef CLEAVE_STUDY_INTERNAL
#define CLEAVE_STUDY_INTERNAL

#include "study/study.h"

/* ---- names (study_names.c) --------------------------------------------------------------------------------------- */

#define STUDY_HASH_START 0xcbf29ce484222325u
/* Continues the hash of a text with another one; begin with STUDY_HASH_START. */
uint64_t study_hash(uint64_t hash, const char *text);

/* Enlarges the hash table for the name of one more run. */
void study_names_grow(struct study *s);

/* Chooses a name that no run of s has: `wanted` if possible, else case-HASH of the overrides o[n]. name:
 * [CASE_NAME_ROOM]. */
void study_name_settle(const struct study *s, char *name, const char *wanted, const struct scene_override *o, int n);

/* Adds the name of run `number` to the hash table. */
void study_name_book(struct study *s, int number);

/* Selects the keys with several values, in the order in which they appear in names. order: [keys]. Returns their
 * number. */
int study_names_order(int *order, const struct varied_key *key, int keys);

/* Composes a name such as `spacing=0.5mm,speed=20` from the value number at[k] of each of the n keys in `order`. name:
 * [CASE_NAME_ROOM]. */
void study_name_compose(char *name, const struct varied_key *key, int keys, const int *order, int n, const int *at);

/* ---- labels of pictures (study_labels.c) ------------------------------------------------------------------------- */

/* Capacity of a label [byte]. */
enum { LABEL_ROOM = 40 };

/* Writes the label of value v of a key; if the values are long, their common beginning and end are left out. text:
 * [LABEL_ROOM]. */
void study_value_shown(char *text, const struct varied_key *key, int v);

/* Returns the number of characters of the longest label of a key. */
int study_values_longest(const struct varied_key *key);

/* Capacity of the name of a picture [byte]. */
enum { PICTURE_NAME_ROOM = CASE_NAME_ROOM + 8 };

/* Writes the name of the picture of a key, KEY.png. name: [PICTURE_NAME_ROOM]. */
void study_picture_name(char *name, const char *key);

/* Returns a round distance of tics that divides the range into at most `most` steps. */
double study_tics_apart(double range, int most);

#endif
