/* The few HDF5 operations that the program needs, on one file at a time, with one sticky fault: after the
 * first failed call every further one on the same file does nothing, because HDF5 1.10 crashes when it is used on
 * after a failed write. Only the output files include this. */
#ifndef CLEAVE_OUTPUT_HDF5
#define CLEAVE_OUTPUT_HDF5

#include <hdf5.h>

#include "base/base.h"

enum hdf_type { HDF_F32, HDF_F64, HDF_U8, HDF_I32, HDF_I64 };
size_t hdf_size(enum hdf_type type); /* bytes of one number */

struct hdf {
    hid_t file;
    bool compress; /* gzip for rows */
    bool failed;   /* a call failed: make no further one */
    int cause;     /* errno of that call, 0 if not known */
};

/* Makes PATH anew. No times are stored: the same content gives the same bytes. */
void hdf_create(struct hdf *f, const char *path, bool compress);
void hdf_open(struct hdf *f, const char *path);
/* Closes the file and all in it. */
void hdf_close(struct hdf *f);

void hdf_group(struct hdf *f, const char *name);
/* A dataset of `rows` times `columns` numbers (a plain list if columns is 1). */
void hdf_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t rows, int columns, const void *data);
/* A dataset with the rows of datasets of one name in other files, one after the other; their names are relative to the
 * folder of this one. Each has `rows` + `more` rows. Nothing is copied. */
struct hdf_source {
    const char *file;
    int64_t rows;
};
void hdf_virtual(struct hdf *f, const char *name, enum hdf_type type, int columns, const struct hdf_source *source,
                 int sources, int more);
/* A dataset with one string. */
void hdf_text(struct hdf *f, const char *name, const char *text);
/* A list of one string of variable length, which VTK shows among the data of a field; bytes that are not ASCII become
 * question marks. */
void hdf_text_list(struct hdf *f, const char *name, const char *text);
/* Attributes of a group or a dataset: `count` numbers (a list even if one), one number, one fixed-length ASCII
 * string. */
void hdf_mark(struct hdf *f, const char *group, const char *name, enum hdf_type type, int count, const void *values);
void hdf_mark_one(struct hdf *f, const char *group, const char *name, enum hdf_type type, const void *value);
void hdf_mark_text(struct hdf *f, const char *group, const char *name, const char *text);

/* Numbers in a dataset, -1 if it is not there. No fault. */
int64_t hdf_count(struct hdf *f, const char *name);
/* Reads exactly `count` numbers. */
void hdf_read_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t count, void *data);
void hdf_read_mark(struct hdf *f, const char *group, const char *name, enum hdf_type type, void *value);

#endif
