/* Table of the datasets that frames contain, and functions to copy them; shared by the files of src/output. */
#ifndef CLEAVE_OUTPUT_FIELDS
#define CLEAVE_OUTPUT_FIELDS

#include "output/output.h"
#include "output/output_hdf5.h"

/* Source of the values of a frame. */
struct frame_source {
    const struct particles *p;
    struct frame_extra extra;
};

/* Describes a dataset with one row per particle (or material point of a coarse cell). */
struct frame_field {
    const char *path, *unit; /* path in the file; unit as people write it, "" for a pure number */
    enum hdf_type type;
    int columns; /* numbers per row; 0: dim */
    /* Writes the row of particle i. For fields that are constant during a run; called by the writing thread. Else
     * NULL. */
    void (*fill)(const struct particles *p, int64_t i, void *row);
    /* Writes rows first .. end - 1 into `rows`, which starts at particle 0. For fields that change; the step loop waits
     * for the copy. NULL: `fill` is set, or the field is derived from another one (data/derived_fields.h). */
    void (*copy)(const struct frame_source *s, int64_t first, int64_t end, void *rows);
};

enum { FIELD_POINTS, FRAME_FIELDS = 24 }; /* index of the positions in the table; size of the table */

/* Table of all fields, in the order of their bits. */
extern const struct frame_field frame_fields[FRAME_FIELDS];

/* Returns the set of the fields of a frame, one bit per field in the order of frame_fields[]: the basic ones, plastic
 * strain if a material yields, contact force if the scene has contact, fragments if bodies can break, and those that
 * the scene requests. */
unsigned frame_fields_of(const struct frame_source *s);

/* Copies rows first .. end - 1 (one row per particle) of a field that changes during a run to `rows`, whose first row
 * belongs to particle 0. */
void frame_field_copy(const struct frame_field *field, const struct frame_source *source, int64_t first, int64_t end,
                      void *rows);

/* Copies the rows of the material points of coarse cells (source->extra.more), one per point, of a field that changes
 * during a run to `rows`. */
void frame_field_copy_more(const struct frame_field *field, const struct frame_source *source, void *rows);

/* Writes one line `field [unit]` for every field with a unit in the set `fields` (bits as returned by frame_fields_of)
 * to `text`, which holds `room` bytes. */
void frame_units_text(unsigned fields, char *text, size_t room);

/* Returns the size of one row of a field, its values at one particle [byte]. dim: dimension of the body. */
size_t frame_field_row(const struct frame_field *field, int dim);

/* Writes the file name of frame `number` of a series, relative to the folder of the run, to `name`, which holds `room`
 * bytes. */
void frame_name(const struct frame_series *s, char *name, size_t room, int number);

/* Writes the name of an index file of a series, relative to the folder of the run, to `name`, which holds `room`
 * bytes: the name of the series followed by the ending `end`. */
void series_file(const struct frame_series *s, char *name, size_t room, const char *end);

#endif
