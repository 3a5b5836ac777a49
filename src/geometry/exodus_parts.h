/* Declarations shared by the readers of Exodus II files in both formats of netCDF, classic and netCDF-4 (HDF5). */
#ifndef CLEAVE_EXODUS_PARTS
#define CLEAVE_EXODUS_PARTS

#include "geometry/exodus_file.h"

/* A dimension of a classic netCDF file. length: number of entries, 0 for the dimension of records. */
struct exodus_dimension {
    char name[NAME_MAX_LENGTH];
    int64_t length;
};

/* Types of the numbers of an array, with the codes that classic netCDF files have for these types. */
enum exodus_type {
    EXODUS_BYTE = 1,
    EXODUS_CHAR,
    EXODUS_SHORT,
    EXODUS_INT,
    EXODUS_FLOAT,
    EXODUS_DOUBLE,
    EXODUS_UBYTE,
    EXODUS_USHORT,
    EXODUS_UINT,
    EXODUS_INT64,
    EXODUS_UINT64,
    EXODUS_TYPES
};

/* An array of a netCDF file, with one or two dimensions: name, type and lengths. */
struct exodus_array {
    char name[NAME_MAX_LENGTH], elements[NAME_MAX_LENGTH]; /* its attribute elem_type; "": none */
    enum exodus_type type; /* of HDF5 files: EXODUS_CHAR, EXODUS_INT64 or EXODUS_DOUBLE */
    int64_t extent[2];     /* [1]: 1 if there is one dimension */
    int64_t at;            /* position in a classic file [byte] */
};

/* Removes the blanks at the end of `text`, a text read from the file, and replaces its control characters by `?`. */
static inline void exodus_text_make_printable(char *text)
{
    for (size_t end = strlen(text); end > 0 && text[end - 1] == ' '; end--) text[end - 1] = '\0';
    text_replace_control_characters(text);
}

/* Reads the header of a file of the classic netCDF format into f: its dimensions and arrays. Arrays over time and
 * arrays of more than two dimensions are left out. Returns REFUSED, with a message, if the header is damaged or the
 * file is shorter than its arrays. exodus_close releases the lists. */
status exodus_classic_open(struct exodus_file *f);

/* Copies `count` numbers of the array `array` of the classic netCDF file f to real_value[count], or to
 * whole_value[count] if real_value is NULL. */
void exodus_classic_read_array(const struct exodus_file *f, const struct exodus_array *array, int64_t count,
                               real *real_value, int64_t *whole_value);

/* Opens the netCDF-4 file f->path with HDF5 and stores its handle in f. Returns REFUSED, with a message, if HDF5 cannot
 * read the file. Close with exodus_hdf5_close. */
status exodus_hdf5_open(struct exodus_file *f);

/* Closes the netCDF-4 file of f, opened by exodus_hdf5_open. */
void exodus_hdf5_close(struct exodus_file *f);

/* Returns the length of the dimension called `dimension_name` of the netCDF-4 file f, or 0 if it has no dimension of
 * this name. */
int64_t exodus_hdf5_length_of_dimension(const struct exodus_file *f, const char *dimension_name);

/* Finds the array called `array_name` of the netCDF-4 file f, and stores its properties in *a. Returns true, or false
 * if there is no such array, if it has more than two dimensions or none, or if its numbers are not in the file. */
bool exodus_hdf5_find_array(const struct exodus_file *f, const char *array_name, struct exodus_array *a);

/* Reads all numbers of the array `a` of the netCDF-4 file f into one of the arrays real_value, whole_value and letters;
 * the caller passes NULL for the other two. Returns true, or false if HDF5 cannot read the numbers. */
bool exodus_hdf5_read_array(const struct exodus_file *f, const struct exodus_array *a, real *real_value,
                            int64_t *whole_value, char *letters);

#endif
