/* Table of the datasets that frames contain, and functions to copy them; shared by the files of src/output. */
#ifndef CLEAVE_OUTPUT_FIELDS
#define CLEAVE_OUTPUT_FIELDS

#include "output/output.h"
#include "output/output_hdf5.h"

/* Sources of the values of a frame: the particles p, and in `extra` the quantities that particles do not store. */
struct frame_contents {
    const struct particles *p;
    struct frame_extra extra;
};

/* Which components of a row (the stored numbers of one particle) are set. ROW_WHOLE: all; ROW_VECTOR: the first dim
 * ones; ROW_TENSOR: the components of a symmetric tensor in VTK's order that exist in the space, xx in 1D, xx yy zz xy
 * in 2D, all in 3D. The others are 0, the fill value of the dataset. */
enum row_kind { ROW_WHOLE, ROW_VECTOR, ROW_TENSOR };

/* Describes a dataset of an output frame (state of the run at one time). A row has the numbers of one particle, or of
 * one point inside a coarse cell (larger mesh cell inside a body, without particles of its own). */
struct frame_field {
    const char *path, *unit; /* path in the file; unit as people write it, "" for a pure number */
    enum hdf_type type;
    int columns; /* numbers per row; 0: dim */
    enum row_kind row;
    bool fixed; /* does not change while the particles stay the same: stored in the particles file (particles_file.h) */
    /* Copies the stored components of the particle with index row[k] to row k of the array `rows`, for k = first .. end
     * - 1. NULL: the field is computed from another field (data/derived_fields.h). */
    void (*copy)(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows);
};

/* Indices in the table frame_fields: of the positions (FIELD_POINTS) and of the contact forces (FIELD_CONTACT);
 * FRAME_FIELDS: number of its entries. */
enum { FIELD_POINTS, FIELD_CONTACT = 6, FRAME_FIELDS = 26 };

/* Table of all fields that frames may contain, in the order of the bits of field sets. */
extern const struct frame_field frame_fields[FRAME_FIELDS];

/* Entries of the table frame_cells: datasets of the particles file (particles_file.h) that describe to VTK one cell, a
 * single vertex, for each particle. CELL_LISTS: number of entries. */
enum { CELLS_CONNECTIVITY, CELLS_OFFSETS, CELLS_TYPES, CELL_LISTS };
extern const struct frame_field frame_cells[CELL_LISTS];

/* Returns the set of fields that an output frame (state of the run at one time) from `source` contains, as bits in the
 * order of the table frame_fields: the basic ones, plastic strain if a material yields, contact force if the input file
 * has contact, fragments if bodies can break, and those that the input file requests. */
unsigned frame_contents_field_bits_to_write(const struct frame_contents *source);

/* Copies the numbers that an output frame (state of the run at one time) stores of the field `field` from the particles
 * in *source to `rows`, an array of row_order->n rows with frame_field_bytes_per_row bytes each. row_order: which
 * particle each row belongs to. Rows of points inside coarse cells (larger mesh cells without particles;
 * source->extra.more) are 0 in fields that such points lack. */
void frame_field_copy_particle_values_to_rows(const struct frame_field *field, const struct frame_contents *source,
                                              const struct frame_rows *row_order, char *rows);

/* Writes the field `field` of an output frame as a dataset with its unit to `file`. rows: stored numbers of the field
 * at `row_count` points, as frame_field_copy_particle_values_to_rows makes them; dim: dimension of the space. A failure
 * is recorded in file->failed. */
void frame_field_write(struct hdf *file, const struct frame_field *field, int64_t row_count, int dim, const char *rows);

/* Writes one line `field [unit]` for every field with a unit to text[capacity]; a longer text is cut. field_bits: set
 * of fields, one bit per entry of the table frame_fields. */
void frame_fields_list_units_as_text(unsigned field_bits, char *text, size_t capacity);

/* Returns how many bytes an output frame (state of the run at one time) stores of the field `field` per row (particle).
 * dim: dimension of the space. */
size_t frame_field_bytes_per_row(const struct frame_field *field, int dim);

#endif
