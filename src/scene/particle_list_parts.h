/* What the readers of particle lists have in common: columns, units, notes on what is not read. */
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
struct list_quantity {
    const char *name;
    enum unit unit;
};
extern const struct list_quantity list_quantity[COLUMNS];

/* Where a column is kept. */
real **column_array(struct particle_list *l, int column);
/* Has a list in so many dimensions no use for a column? */
bool column_idle(int column, int dim);
/* Fault of a value in a column, as the end of a sentence; NULL: none. */
const char *value_fault(int column, real value);
/* The factor of a unit of this kind; false with the rest of a sentence: it is none. */
bool unit_factor(real *factor, const char *unit, enum unit of, char *what, size_t room);

/* Appends to the note on a list. */
void note_add(struct particle_list_head *head, const char *between, const char *what);
/* What the columns found say about the list: `has` [COLUMNS]. */
void note_columns(struct particle_list_head *head, const bool *has);

/* REFUSED if n particles of a run need more memory than the machine has. */
status list_affordable(const char *path, int64_t n);
/* `head`: the names of columns are enough. */
status list_csv_read(struct particle_list *l, const char *path, bool head);

#endif
