/* The fields of frames, for output_frames.c. */
#ifndef CLEAVE_OUTPUT_FIELDS
#define CLEAVE_OUTPUT_FIELDS

#include "output/output.h"
#include "output/output_hdf5.h"

/* What a frame shows. */
struct frame_source {
    const struct particles *p;
    struct frame_extra extra;
};

/* One dataset with a row per particle; `columns` 0 stands for dim; `unit` as people write it, "" for a pure number.
 * `fill`, for fields that are constant during a run, writes the row of particle i; the writing thread calls it. `copy`,
 * for all other fields, writes rows first .. end - 1 of `rows` of all particles; the step loop waits for it. Fields
 * without either follow from another one (data/derived_fields.h). */
struct frame_field {
    const char *path, *unit;
    enum hdf_type type;
    int columns;
    void (*fill)(const struct particles *p, int64_t i, void *row);
    void (*copy)(const struct frame_source *s, int64_t first, int64_t end, void *rows);
};

enum { FIELD_POINTS, FRAME_FIELDS = 24 }; /* place of the positions in the table; its length */
extern const struct frame_field frame_fields[FRAME_FIELDS];

/* Bits of the fields that there are: plastic strain where a material yields, the force of contact where there is
 * contact, fragments where bodies can break, others where they are asked for. */
unsigned frame_fields_of(const struct frame_source *s);
/* Rows first .. end - 1 of a field that is not constant. */
void frame_field_copy(const struct frame_field *field, const struct frame_source *source, int64_t first, int64_t end,
                      void *rows);
/* Rows of the points of coarse cells (extra.more), of a field that is copied. */
void frame_field_copy_more(const struct frame_field *field, const struct frame_source *source, void *rows);
/* `field [unit]` of the fields that have one, a line each. */
void frame_units_text(unsigned fields, char *text, size_t room);
/* Bytes of a particle. */
size_t frame_field_row(const struct frame_field *field, int dim);

/* Names relative to the run's folder: of a frame of a series, of its files with this end. */
void frame_name(const struct frame_series *s, char *name, size_t room, int number);
void series_file(const struct frame_series *s, char *name, size_t room, const char *end);

#endif
