/* Reading of Exodus II files (Schoof, Yarberry 1994, with the additions of later versions): netCDF files
 * with arrays of agreed names. Meshes (exodus.c) and particle lists (particle_list_exodus.c) are read through it.
 *
 * Of netCDF, the classic formats (CDF-1, CDF-2, CDF-5) are read here by their specification, since libnetcdf 4.9
 * crashes over damaged headers; netCDF-4 files are HDF5 files. */
#ifndef CLEAVE_EXODUS_FILE
#define CLEAVE_EXODUS_FILE

#include "base/base.h"

/* An open Exodus II file: content, dimensions and arrays of a classic netCDF file or the HDF5 handle of a netCDF-4
 * file, and numbers of nodes, blocks and sets. */
struct exodus_file {
    const char *path;    /* for messages; borrowed */
    const uint8_t *text; /* [length] content; borrowed */
    char *owned;         /* the content, if exodus_open_from_path has read it; else NULL */
    int64_t length;
    int64_t hdf5; /* handle of HDF5; negative: a classic file */
    int64_t dimensions, arrays;
    struct exodus_dimension *dimension;                        /* classic file: [dimensions]; owned */
    struct exodus_array *array;                                /* classic file: [arrays]; owned */
    int dim;                                                   /* number of coordinates of a node, 1 to 3 */
    int64_t nodes, blocks, node_sets, side_sets, element_sets; /* numbers of each in the file */
};

/* Opens in f an Exodus II file that has been read into memory. path: name of the file, for messages; content[length]:
 * contents of the file, which must outlive f. Returns REFUSED, with a message, if the contents are not those of an
 * Exodus II file; then nothing has to be closed. Close f with exodus_close. */
status exodus_open_from_memory(struct exodus_file *f, const char *path, const char *content, int64_t length);

/* Reads the Exodus II file `path` into memory and opens it in f. The file is registered as an input of the command that
 * is running, so that it is not overwritten. Returns REFUSED, with a message, if the file cannot be read or is no
 * Exodus II file; then nothing has to be closed. Close f with exodus_close. */
status exodus_open_from_path(struct exodus_file *f, const char *path);

/* Closes the Exodus II file f and releases the memory that f owns; content passed to exodus_open_from_memory stays with
 * the caller. */
void exodus_close(struct exodus_file *f);

/* Returns true if the file name `path` has an extension of Exodus II files: .exo, .e, .ex2, .exii, .g or .gen. */
bool path_has_exodus_extension(const char *path);

/* Sets the message of a failure (status_set) to `path: text` with the path of the file f and a text composed from
 * `format` as by printf. Returns REFUSED. */
status exodus_set_message_and_return_refused(const struct exodus_file *f, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Returns the length of a dimension (as of netCDF) of the file f, or 0 if the file has no such dimension. The dimension
 * is called `name` followed by `name_suffix`, or only `name` if `name_suffix` is 0. */
int64_t exodus_read_dimension_length(const struct exodus_file *f, const char *name, int64_t name_suffix);

/* Returns true if the file f has the array that is called `name` followed by `name_suffix`, or only `name` if
 * `name_suffix` is 0. */
bool exodus_has_array(const struct exodus_file *f, const char *name, int64_t name_suffix);

/* Reads an array of `count` finite numbers of the file f into a new array *value, which the caller releases with
 * memory_free. In the file the array is called `name` followed by `name_suffix`, or only `name` if `name_suffix` is 0.
 * Returns REFUSED, with a message and *value NULL, if this array is missing, contains no numbers, or has another
 * size. */
status exodus_read_reals(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t count,
                         real **value);

/* Reads an array of `count` whole numbers of the file f into a new array *value, which the caller releases with
 * memory_free. In the file the array is called `name` followed by `name_suffix`, or only `name` if `name_suffix` is 0.
 * Returns REFUSED, with a message and *value NULL, if this array is missing, contains no numbers, or has another
 * size. */
status exodus_read_integers(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t count,
                            int64_t **value);

/* Reads the coordinates of all nodes of the file f, in the unit of the file, into new arrays coordinates[d], d = 0 ..
 * f->dim - 1, of f->nodes numbers each. The caller must have set coordinates[d] to NULL, and releases the arrays with
 * memory_free, also after a failure. Returns REFUSED, with a message, if coordinates are missing or not finite. */
status exodus_read_coordinates(const struct exodus_file *f, real *coordinates[DIM_MAX]);

/* Reads one row of an array of texts of the file f into text[LONG_NAME_LENGTH], without blanks at its end; a longer
 * text is cut; "" if the file has no such array. The array is called `name` followed by `name_suffix`, or only `name`
 * if `name_suffix` is 0. row: number of the row, from 0; row_count: number of rows that the array must have. */
void exodus_read_text_row(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t row,
                          int64_t row_count, char *text);

/* Reads the properties of the element block number `block_number` (from 1) of the file f: the type of its elements in
 * capital letters into type[NAME_MAX_LENGTH], the number of elements into *element_count, and the number of nodes of an
 * element into *nodes_per_element. Returns REFUSED, with a message, if the block has no list of nodes, or does not name
 * the type of its elements. */
status exodus_read_block_header(const struct exodus_file *f, int64_t block_number, char *type, int64_t *element_count,
                                int64_t *nodes_per_element);

#endif
