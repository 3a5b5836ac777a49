/* Writes netCDF files of the classic format with 64-bit offsets (CDF-2; NetCDF User's Guide, "File format
 * specifications"): first dimensions, arrays and attributes are defined, then netcdf_write_header writes the header,
 * then the numbers of all arrays follow in the order of their definition: those of one length, then for each record
 * those over records. Dimensions, arrays and attributes are few; faults of writing are found by ferror. */
#ifndef CLEAVE_NETCDF_WRITE
#define CLEAVE_NETCDF_WRITE

#include <stdio.h>

#include "base/base.h"

enum netcdf_type { NETCDF_CHAR = 2, NETCDF_INT = 4, NETCDF_FLOAT = 5, NETCDF_DOUBLE = 6 };

enum { NETCDF_NAME = 64, NETCDF_RANKS = 2, NETCDF_NUMBERS_MOST = 500000000 }; /* an array has less than 4 GB */

struct netcdf_dimension {
    char name[NETCDF_NAME];
    int64_t length; /* 0: that of records */
};

struct netcdf_array {
    char name[NETCDF_NAME];
    enum netcdf_type type;
    int ranks, dimension[NETCDF_RANKS];
    const char *attribute, *text; /* an attribute; NULL: none */
};

/* An attribute of the file: text, or a number of `type`. */
struct netcdf_attribute {
    const char *name, *text; /* borrowed */
    enum netcdf_type type;
    real value;
};

/* A file that is written. */
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

/* Defines a dimension that is called `name` followed by `number` (0: without a number). Returns its index. */
int netcdf_define_dimension(struct netcdf_writer *w, const char *name, int number, int64_t length);

/* Defines an array that is called `name` followed by `number` over `ranks` dimensions. attribute, text: name and text
 * of its attribute, kept by reference; NULL: none. */
void netcdf_define_array(struct netcdf_writer *w, const char *name, int number, enum netcdf_type type, int ranks,
                         const int *dimension, const char *attribute, const char *text);

/* Writes the header to w->to. */
void netcdf_write_header(struct netcdf_writer *w);

/* Writes the next n numbers of an array of reals or of whole numbers. */
void netcdf_write_reals(struct netcdf_writer *w, int64_t n, const real *value);
void netcdf_write_integers(struct netcdf_writer *w, int64_t n, const int32_t *value);

/* Writes the next row of an array of letters, cut or filled up to `width` bytes. */
void netcdf_write_text_row(struct netcdf_writer *w, const char *text, int width);

/* Ends an array. */
void netcdf_end_array(struct netcdf_writer *w);

/* Releases the memory of *w. */
void netcdf_free(struct netcdf_writer *w);

#endif
