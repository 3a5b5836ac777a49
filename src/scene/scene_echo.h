/* Declares the writer of scene.yaml, the input file with all keys and defaults of a run (scene_echo*.c). It writes each
 * value in the form that the type of its key requires. */
#ifndef CLEAVE_SCENE_ECHO
#define CLEAVE_SCENE_ECHO

#include <stdio.h>

#include "scene_internal.h"

/* Writer of YAML text: its output stream and the state of the current line. */
struct yaml_writer {
    FILE *out;                 /* receives the text */
    const struct scene *scene; /* the scene that is written */
    int dim;                   /* dimensions of points: dim of the scene, or 2 in an extrusion */
    int indent;                /* indentation of the next line [characters] */
    bool dash;                 /* the next line begins an item of a list */
};

/* Begins a line of the YAML text of the writer w: writes the indentation, a dash if the key is the first one of a list
 * item, and the text `key` with a colon. */
void yaml_write_key(struct yaml_writer *w, const char *key);

/* Begins an item of a list in the YAML text of the writer w. The dash of the item is written with the next key
 * (yaml_write_key). */
void yaml_begin_list_item(struct yaml_writer *w);

/* Writes the number `value` to the YAML text of the writer w with so many digits that it reads back to identical bits.
 */
void yaml_write_real(struct yaml_writer *w, real value);

/* Writes the string `text` in double quotes to the YAML text of the writer w. Quotes and backslashes in it are escaped,
 * and all characters but printable ASCII, such as line breaks or accented letters, are written as \U escapes. */
void yaml_write_quoted_text(struct yaml_writer *w, const char *text);

/* Writes the numbers value[count] to the YAML text of the writer w as a list in brackets. */
void yaml_write_number_list(struct yaml_writer *w, const real *value, int count);

/* Writes the value of key k to the YAML text of the writer w, in the form that the type of the key requires.
 * value_address: address of the value. */
void yaml_write_value(struct yaml_writer *w, const struct key *k, const void *value_address);

/* Returns the address of the value of key k in the structure `group_values`, which stores the values of the group of
 * keys to which k belongs; NULL if the value of the key is not stored there. */
const void *key_get_value_address_in_group(const struct key *k, const void *group_values);

/* Writes to the YAML text of the writer w all keys of the group `group_path` (the path of a key with keys below it),
 * one per line. group_values: structure with their values. */
void yaml_write_keys_of_group(struct yaml_writer *w, const char *group_path, const void *group_values);

/* Writes to the YAML text of the writer w the text `key` with a colon and below it, as a mapping, all keys of the group
 * `group_path`. group_values: structure with their values. */
void yaml_write_group_as_mapping(struct yaml_writer *w, const char *key, const char *group_path,
                                 const void *group_values);

/* Writes to w the key `key` with the absolute path of the file `file`, so that the input file can be run from any
 * folder. contents_hash: hash of the file, which is written as a comment. */
void yaml_write_file_path_and_hash(struct yaml_writer *w, const char *key, const char *file, uint64_t contents_hash);

/* Writes all boundary conditions (loads, supports, mirrors) of the input file to the YAML text of the writer w. */
void yaml_write_boundaries(struct yaml_writer *w);

/* Writes the key `key` with a vector of w->scene->dim components to the YAML text of the writer w: component d is the
 * formula formula[d] if that is not empty, else the number value[d]. */
void yaml_write_vector_of_formulas(struct yaml_writer *w, const char *key, const real *value,
                                   const struct expression *formula);

/* Writes the region `region` to the YAML text of the writer w, as a list of its solids. */
void yaml_write_region(struct yaml_writer *w, const struct region *region);

/* Writes the named regions of the input file to the YAML text of the writer w. */
void yaml_write_named_regions(struct yaml_writer *w);

/* Writes the solid `solid`, which was read from a file, to the YAML text of the writer w, for example as `stl: {..}`.
 */
void yaml_write_solid_from_file(struct yaml_writer *w, const struct solid *solid);

#endif
