/* Declares what the readers of particle list files (CSV, Exodus II) share: the columns, their units and defaults, and
 * the message about a list. */
#ifndef CLEAVE_PARTICLE_LIST_PARTS
#define CLEAVE_PARTICLE_LIST_PARTS

#include "scene/particle_list.h"
#include "scene_internal.h"

enum { PARTICLES_MAX = INT32_MAX - 64, NAMES_MAX = 256, UNIT_TEXT = 40 };

/* Columns that the file of a particle list may have; coordinates come first. */
enum list_column {
    COLUMN_X,
    COLUMN_Y,
    COLUMN_Z,
    COLUMN_VX,
    COLUMN_VY,
    COLUMN_VZ,
    COLUMN_VOLUME,
    COLUMN_MASS,
    COLUMN_DENSITY,
    COLUMN_MATERIAL,
    COLUMN_BODY,
    COLUMNS,
    COLUMN_NONE
};
/* A column that the file of a particle list may have: its name and its kind of unit. */
struct list_quantity {
    const char *name;
    enum unit unit;
};
extern const struct list_quantity list_quantity[COLUMNS];

/* Returns a pointer to the member of the particle list l, such as &l->volume, that stores the values of column `column`
 * (enum list_column) of its file. */
real **particle_list_address_of_column_array(struct particle_list *l, int column);

/* Returns true if `column` (COLUMN_*) is a component of position or velocity along an axis that a space of `dim`
 * dimensions does not have. */
bool particle_list_column_exceeds_dimension(int column, int dim);

/* Returns the reason why `value` [SI] is invalid in the column `column` (COLUMN_*), as a static text for the end of a
 * sentence. Returns NULL if it is valid. */
const char *particle_list_reason_value_is_invalid(int column, real value);

/* Finds the factor by which a number in the unit `unit` is multiplied to convert it to SI units, and stores it in
 * *factor; 1 if `unit` is empty. expected_kind: kind of quantity. Returns false if `unit` is not of this kind, and
 * writes the fault to message[capacity] as the rest of a sentence. */
bool unit_find_factor_to_si(real *factor, const char *unit, enum unit expected_kind, char *message, size_t capacity);

/* Returns the factor to SI units of a number in the column `column` (COLUMN_*) if the file gives no unit for it. For
 * coordinates and volumes the factor follows from the unit that the input file gives for the list l, else it is 1. */
real particle_list_default_factor_to_si(const struct particle_list *l, int column);

/* Appends the text `addition` to the note in *head, which is printed about a particle list, preceded by `separator` if
 * the note is not empty. */
void particle_list_head_append_to_message(struct particle_list_head *head, const char *separator, const char *addition);

/* Stores in *head whether the file of a particle list has columns of materials, masses and volumes, and adds to its
 * note which defaults replace missing columns. file_has_column[COLUMNS]: true for each column that the file has. */
void particle_list_head_store_missing_columns(struct particle_list_head *head, const bool *file_has_column);

/* Returns REFUSED, with a message that names the file `path`, if a run with `particle_count` particles needs more
 * memory than the machine has. */
status particle_list_check_memory(const char *path, int64_t particle_count);

/* Reads a particle list from the Exodus II file `path` into *l. l->dim and l->form must be set before. Returns REFUSED,
 * with a message, if the file cannot be read or is invalid. The caller releases l with particle_list_free. */
status particle_list_read_exodus(struct particle_list *l, const char *path);

/* Reads a particle list from the CSV file `path` into *l. l->dim and l->form must be set before. only_header: true to
 * read only the column names. Returns REFUSED, with a message, if the file cannot be read or is invalid. The caller
 * releases l with particle_list_free. */
status particle_list_read_csv(struct particle_list *l, const char *path, bool only_header);

#endif
