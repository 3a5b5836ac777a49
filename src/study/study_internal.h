/* Declares what the files study*.c share: names of runs, labels and sizes of pictures. */
#ifndef CLEAVE_STUDY_INTERNAL
#define CLEAVE_STUDY_INTERNAL

#include "study/convergence_study.h"
#include "study/study.h"

/* Beginning of the second line of the file STUDY_SCENE; the options of the study follow in this line. */
#define STUDY_OPTIONS_MARK "# options: "

/* ---- names (study_names.c) --------------------------------------------------------------------------------------- */

#define STUDY_HASH_START 0xcbf29ce484222325u
/* Returns the hash of a sequence of texts that ends with `next_text`. hash: hash of the preceding texts;
 * STUDY_HASH_START if there are none. */
uint64_t study_hash_add_text(uint64_t hash, const char *next_text);

/* Enlarges the hash table of the names of the runs of the study s if the table has no space for one more name. */
void study_enlarge_run_name_table_if_full(struct study *s);

/* Chooses a name for a run that no other run of the study s has, and writes it to name[CASE_NAME_ROOM]. The name is the
 * text `wanted_name`, restricted to characters that every file system accepts. If that is too long, reserved or taken,
 * the name is case-HASH, with a hash of override[override_count], the overrides of the run. */
void study_choose_case_name(const struct study *s, char *name, const char *wanted_name,
                            const struct scene_override *override, int override_count);

/* Adds the name of the run with the index `case_number` of the study s to the hash table of the names of its runs. */
void study_register_case_name(struct study *s, int case_number);

/* Finds which of the keys key[key_count] of a study appear in the names of its runs: those with several values. Stores
 * their indices in key_order[], which has space for `key_count` entries, in the order of the names. Returns the number
 * of these keys. */
int study_list_multivalued_keys_in_name_order(int *key_order, const struct varied_key *key, int key_count);

/* Composes the name of a run from its values, for example `spacing=0.5mm,speed=20`, and writes it to
 * name[CASE_NAME_ROOM]. key[key_count]: all keys of the study; key_order[named_key_count]: indices of those in the
 * name, in order of appearance; value_index[k]: index of the value of key k in this run. */
void study_compose_case_name(char *name, const struct varied_key *key, int key_count, const int *key_order,
                             int named_key_count, const int *value_index);

/* ---- labels of pictures (study_labels.c) ------------------------------------------------------------------------- */

/* Capacity of the label of a value in a picture [byte]. */
enum { LABEL_ROOM = 40 };

/* Writes the label of value number `value_index` of a varied key, as in pictures, to text[LABEL_ROOM]. If the values of
 * the key are too long, the label omits their common beginning and end. */
void varied_key_compose_label_of_value(char *text, const struct varied_key *key, int value_index);

/* Returns the number of characters of the longest label (varied_key_compose_label_of_value) of the values of a varied
 * key.
 */
int varied_key_longest_value_label_length(const struct varied_key *key);

/* Writes the title of a panel that shows the result `result_name` of summary.json in `unit` ("" for none) to
 * text[capacity]: in words, such as `tip: speed max [m/s]` for probes.tip.speed_max. */
void study_panel_compose_title(char *text, size_t capacity, const char *result_name, const char *unit);

/* Capacity of the name of a picture [byte]. */
enum { PICTURE_NAME_ROOM = CASE_NAME_ROOM + 8 };

/* Writes the file name of the picture of a varied key to name[PICTURE_NAME_ROOM]: KEY.png with KEY = key, or with the
 * ending of another picture format that picture_size_set_process_wide has set. */
void study_picture_compose_file_name(char *name, const char *key);

/* Returns the width [pixel] of a character in the pictures of a study. */
int study_picture_character_width_in_pixels(void);

/* Returns a distance between tics, 1, 2 or 5 times a power of ten, that divides an axis of length `range` > 0 into at
 * most `max_intervals` intervals. */
double axis_tick_distance(double range, int max_intervals);

/* Returns true if all values of the varied key are numbers with the same unit, and then stores a pointer to the text of
 * this unit in *unit. */
bool varied_key_values_are_numbers_of_one_unit(const struct varied_key *key, const char **unit);

/* ---- pictures of convergence studies (convergence_paths.c) --------------------------------------------------------
 */

/* Returns the path FOLDER/pictures/KEY.png of a picture of the study in `folder`, with KEY = key (the name of the
 * picture), or with the ending of another format that picture_size_set_process_wide has set. */
struct path convergence_picture_path(const char *folder, const char *key);

/* Draws the crack paths of all runs of the study s in one picture. Their data are composed before the picture is
 * opened, since their extent determines its height. Returns FAILED, with a message, without memory or if gnuplot
 * fails. */
status convergence_draw_crack_paths(const struct convergence_study *s);

#endif
