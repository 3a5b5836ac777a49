/* Declares columns, units and notes that the readers of particle lists (CSV, HDF5) share. */
#ifndef CLEAVE_PARTICLE_LIST_PARTS
#define CLEAVE_PARTICLE_LIST_PARTS

#include "scene/particle_list.h"
#include "scene_internal.h"

enum { PARTICLES_MAX = INT32_MAX - 64, NAMES_MAX = 256, UNIT_TEXT = 40 };

/* Columns of a list; coordinates come first. */
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
/* Name and kind of unit of a column of a particle list. */
struct list_quantity {
    const char *name;
    enum unit unit;
};
extern const struct list_quantity list_quantity[COLUMNS];

/* Returns a pointer to the member of l, such as &l->volume, that stores the values of column `column` (enum
 * list_column). */
real **particle_list_column_array(struct particle_list *l, int column);

/* Returns true for a component of position or velocity along an axis that a space of `dim` dimensions does not have. */
bool particle_list_column_is_unused(int column, int dim);

/* Returns why `value` [SI] is invalid in column `column`, as the end of a sentence (a static text), or NULL if it is
 * valid. */
const char *particle_list_value_fault(int column, real value);

/* Computes the factor that converts a number in `unit` to SI units; 1 if `unit` is empty. expected: kind of unit. If
 * `unit` is not of this kind, returns false and writes the fault to message[capacity], as the rest of a sentence. */
bool unit_factor_to_si(real *factor, const char *unit, enum unit expected, char *message, size_t capacity);

/* Returns the factor to SI units of a number in a column without a unit: in coordinates and volumes that of the form of
 * the list, else 1. */
real particle_list_default_factor(const struct particle_list *l, int column);

/* Appends `what` to the note on a list, preceded by `between` if the note is not empty. */
void particle_list_note_append(struct particle_list_head *head, const char *between, const char *what);

/* Stores in *head whether the file has columns of materials, masses and volumes, and adds the defaults of missing
 * columns to its note. has[COLUMNS]: true for each column that the file has. */
void particle_list_note_columns(struct particle_list_head *head, const bool *has);

/* Returns REFUSED, with a message that names the file `path`, if a run with n particles needs more memory than the
 * machine has. */
status particle_list_check_memory(const char *path, int64_t n);

/* Reads a particle list from an Exodus II file as particle_list_read does. */
status particle_list_read_exodus(struct particle_list *l, const char *path);

/* Reads a particle list from a CSV file as particle_list_read does. head: true to read only the column names. */
status particle_list_read_csv(struct particle_list *l, const char *path, bool head);

#endif
