/* Reading of Exodus II files (Schoof, Yarberry 1994, with the additions of later versions): netCDF files
 * with arrays of agreed names. Meshes (exodus.c) and particle lists (particle_list_exodus.c) are read through it.
 *
 * Of netCDF, the classic formats (CDF-1, CDF-2, CDF-5) are read here by their specification, since libnetcdf 4.9
 * crashes over damaged headers; netCDF-4 files are HDF5 files. */
#ifndef CLEAVE_EXODUS_FILE
#define CLEAVE_EXODUS_FILE

#include "base/base.h"

/* An open file of Exodus II. */
struct exodus_file {
    const char *path;    /* for messages; borrowed */
    const uint8_t *text; /* [length] content; borrowed */
    char *owned;         /* the content, if exodus_open_path has read it; else NULL */
    int64_t length;
    int64_t hdf5; /* handle of HDF5; negative: a classic file */
    int64_t dimensions, arrays;
    struct exodus_dimension *dimension; /* [dimensions], [arrays]: of a classic file */
    struct exodus_array *array;
    int dim; /* of space, 1 to 3 */
    int64_t nodes, blocks, node_sets, side_sets, element_sets;
};

/* Opens the content of the file `path`: content[length], which must outlive f. Returns REFUSED, with a message, if it
 * is no Exodus II file; then nothing need be closed. Close with exodus_close. */
status exodus_open(struct exodus_file *f, const char *path, const char *content, int64_t length);

/* Reads the file `path` into memory, registers it as an input and opens it as exodus_open does. Close with
 * exodus_close. */
status exodus_open_path(struct exodus_file *f, const char *path);

/* Closes f. */
void exodus_close(struct exodus_file *f);

/* Returns true if path ends in one of the endings of Exodus II files: .exo, .e, .ex2, .exii, .g, .gen. */
bool is_exodus_name(const char *path);

/* Sets the message `path: text` and returns REFUSED. format: text as in printf. */
status exodus_report_fault(const struct exodus_file *f, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Returns the length of the dimension that is called `name` followed by `number` (0: without a number), or 0 if the
 * file has no such dimension. */
int64_t exodus_read_dimension(const struct exodus_file *f, const char *name, int64_t number);

/* Returns true if the file has an array that is called `name` followed by `number` (0: without a number). */
bool exodus_has_array(const struct exodus_file *f, const char *name, int64_t number);

/* Reads the array that is called `name` followed by `number` (0: without a number) into *value, allocated, of `count`
 * finite numbers in all; the caller frees it with memory_free. Returns REFUSED, with a message and *value NULL, if it
 * is missing, is not one of numbers, or has another size. */
status exodus_read_reals(const struct exodus_file *f, const char *name, int64_t number, int64_t count, real **value);

/* Reads an array of `count` whole numbers, as exodus_read_reals does. */
status exodus_read_integers(const struct exodus_file *f, const char *name, int64_t number, int64_t count,
                            int64_t **value);

/* Reads the coordinates of all nodes [unit of the file] into axis[d], d below f->dim, allocated, f->nodes numbers each;
 * the caller frees them with memory_free, also after a failure. axis[d] are NULL before. Returns REFUSED, with a
 * message, if they are missing or not finite. */
status exodus_read_coordinates(const struct exodus_file *f, real *axis[DIM_MAX]);

/* Reads row `row` of `rows` rows of text in the array that is called `name` followed by `number` into
 * text[NAME_MAX_LENGTH], without blanks at its end; "" if the file has no such array. */
void exodus_read_name(const struct exodus_file *f, const char *name, int64_t number, int64_t row, int64_t rows,
                      char *text);

/* Reads the type, the number of elements and the number of nodes per element of block `number` (from 1).
 * type[NAME_MAX_LENGTH]: in capital letters. Returns REFUSED, with a message, if the block has no list of nodes for
 * each element. */
status exodus_read_block_header(const struct exodus_file *f, int64_t number, char *type, int64_t *elements,
                                int64_t *nodes_per_element);

#endif
