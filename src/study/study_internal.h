/* Shared by the files study*.c. */
#ifndef CLEAVE_STUDY_INTERNAL
#define CLEAVE_STUDY_INTERNAL

#include "study/study.h"

/* ---- names (study_names.c) --------------------------------------------------------------------------------------- */

#define STUDY_HASH_START 0xcbf29ce484222325u
/* Hash of a text, begun with that of another one or STUDY_HASH_START. */
uint64_t study_hash(uint64_t hash, const char *text);
/* Makes room for the name of one more run. */
void study_names_grow(struct study *s);
/* A name that no run has, from the wanted one if that is possible; [CASE_NAME_ROOM]. */
void study_name_settle(const struct study *s, char *name, const char *wanted, const struct scene_override *o, int n);
void study_name_book(struct study *s, int number);
/* The keys that vary as they stand in names; how many. */
int study_names_order(int *order, const struct varied_key *key, int keys);
/* `spacing=0.5mm,speed=20` of the values number at[k] of the n keys of `order`; [CASE_NAME_ROOM]. */
void study_name_compose(char *name, const struct varied_key *key, int keys, const int *order, int n, const int *at);

/* ---- labels of pictures (study_labels.c) ------------------------------------------------------------------------- */

enum { LABEL_ROOM = 40 };
/* Value number v of a key: without what all values begin and end with if they are long; [LABEL_ROOM]. */
void study_value_shown(char *text, const struct varied_key *key, int v);
/* Characters of the longest of these. */
int study_values_longest(const struct varied_key *key);
/* Name of the picture of a key, KEY.png; [PICTURE_NAME_ROOM]. */
enum { PICTURE_NAME_ROOM = CASE_NAME_ROOM + 8 };
void study_picture_name(char *name, const char *key);
/* A round distance of tics, of which there are at most so many steps in the range. */
double study_tics_apart(double range, int most);

#endif
