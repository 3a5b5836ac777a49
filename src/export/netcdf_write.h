/* Writes netCDF files of the classic format with 64-bit offsets (CDF-2; NetCDF User's Guide, "File format
 * specifications"). First dimensions, arrays and attributes are defined; then netcdf_write_header writes the header.
 * Then the numbers of all arrays are written in the order of their definition: first the arrays of fixed length, then
 * for each record the arrays with a dimension of records. Failed writes are found by ferror(w->to). */
#ifndef CLEAVE_NETCDF_WRITE
#define CLEAVE_NETCDF_WRITE

#include <stdio.h>

#include "base/base.h"

/* Types of the numbers of an array, with the codes of the netCDF format. */
enum netcdf_type { NETCDF_CHAR = 2, NETCDF_INT = 4, NETCDF_FLOAT = 5, NETCDF_DOUBLE = 6 };

enum { NETCDF_NAME = 64, NETCDF_RANKS = 2, NETCDF_NUMBERS_MOST = 500000000 }; /* an array has less than 4 GB */

/* A dimension of a netCDF file: name and number of entries. */
struct netcdf_dimension {
    char name[NETCDF_NAME];
    int64_t length; /* 0: that of records */
};

/* An array of a netCDF file. dimension[ranks]: indices of its dimensions; attribute, text: name and text of its only
 * attribute, borrowed. */
struct netcdf_array {
    char name[NETCDF_NAME];
    enum netcdf_type type;
    int ranks, dimension[NETCDF_RANKS];
    const char *attribute, *text; /* an attribute; NULL: none */
};

/* An attribute of a whole netCDF file: the text `text`, or, if `text` is NULL, the number `value`, written as a number
 * of type `type`. `name` and `text` are borrowed. */
struct netcdf_attribute {
    const char *name, *text; /* borrowed */
    enum netcdf_type type;
    real value;
};

/* A netCDF file that is being written to `to`: its dimensions, arrays and attributes (numbers, then lists), and the
 * state of writing. records: number of records; header: buffer of the header. */
struct netcdf_writer {
    FILE *to;
    int dimensions, arrays, attributes;
    struct netcdf_dimension *dimension;
    struct netcdf_array *array;
    const struct netcdf_attribute *attribute; /* [attributes] borrowed */
    int64_t records;
    uint8_t *header;
    int64_t length;  /* of the header [byte] */
    int64_t pending; /* bytes of the array that is written */
};

/* Defines a dimension with `length` entries in the file of w; `length` 0 defines the dimension of records, which grows
 * while the file is written. The name is `name` followed by the number `name_suffix`, or only `name` if `name_suffix`
 * is 0. Returns the index of the dimension, for netcdf_define_array. */
int netcdf_define_dimension(struct netcdf_writer *w, const char *name, int name_suffix, int64_t length);

/* Defines an array of numbers of type `type` in the file of w. The name is `name` followed by the number `name_suffix`,
 * or only `name` if `name_suffix` is 0. dimension[dimension_count]: indices of the dimensions of the array;
 * attribute_name, attribute_text: name and text of the only attribute of the array, kept by reference, or NULL. */
void netcdf_define_array(struct netcdf_writer *w, const char *name, int name_suffix, enum netcdf_type type,
                         int dimension_count, const int *dimension, const char *attribute_name,
                         const char *attribute_text);

/* Writes the header of the netCDF file of w, which follows from the definitions, to w->to. To be called after all
 * definitions and before the arrays are written. */
void netcdf_write_header(struct netcdf_writer *w);

/* Writes value[n] as the next n numbers to the file of w, in the array of type NETCDF_DOUBLE that is being written.
 * Arrays are written one after the other, in the order of their definition; a failure is found by ferror(w->to). */
void netcdf_write_reals(struct netcdf_writer *w, int64_t n, const real *value);

/* Writes value[n] as the next n numbers to the file of w, in the array of type NETCDF_INT that is being written. Arrays
 * are written one after the other, in the order of their definition; a failure is found by ferror(w->to). */
void netcdf_write_integers(struct netcdf_writer *w, int64_t n, const int32_t *value);

/* Writes `text` as the next row of the array of type NETCDF_CHAR that is being written to the file of w. The text is
 * cut or padded to `row_bytes`, the length of a row [byte]. */
void netcdf_write_text_row(struct netcdf_writer *w, const char *text, int row_bytes);

/* Ends the array that is being written to the file of w, or its part in one record, with the padding that the format
 * requires. The next numbers belong to the next array. */
void netcdf_end_array(struct netcdf_writer *w);

/* Releases the definitions of the netCDF file of w. Does not close the file w->to. */
void netcdf_free(struct netcdf_writer *w);

#endif
