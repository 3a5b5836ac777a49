/* The HDF5 operations that the program needs, on one file at a time. Faults are stored in the struct: after the first
 * failed call all further calls on the file do nothing, because HDF5 1.10 crashes if it is used after a failed write.
 * Included only by files that read or write HDF5. */
#ifndef CLEAVE_OUTPUT_HDF5
#define CLEAVE_OUTPUT_HDF5

#include <hdf5.h>

#include "base/base.h"

/* Types of numbers in a file. */
enum hdf_type { HDF_F32, HDF_F64, HDF_U8, HDF_I32, HDF_I64 };

/* Returns the size of one number [byte]. */
size_t hdf_size(enum hdf_type type);

/* An open HDF5 file and its first fault. */
struct hdf {
    hid_t file;
    bool compress; /* gzip datasets of hdf_rows */
    bool failed;   /* a call failed: make no further one */
    int cause;     /* errno of the failed call, 0 if unknown */
};

/* Creates the file PATH and replaces an existing one. No time stamps are stored: equal content gives equal bytes. A
 * fault is stored in f. */
void hdf_create(struct hdf *f, const char *path, bool compress);

/* Opens the file PATH for reading. A fault is stored in f. */
void hdf_open(struct hdf *f, const char *path);

/* Closes the file and all its objects. */
void hdf_close(struct hdf *f);

/* Creates a group. */
void hdf_group(struct hdf *f, const char *name);

/* Writes a dataset of rows x columns numbers; it has one dimension if columns is 1. data: [rows][columns]. */
void hdf_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t rows, int columns, const void *data);

/* Part of a virtual dataset: `rows` rows of a dataset in another file, whose path is relative to the folder of the
 * virtual file. */
struct hdf_source {
    const char *file;
    int64_t rows;
};

/* Creates a virtual dataset: the rows of the dataset `name` in the files source[sources], one after another. Each
 * source contributes its `rows` plus `more` rows. No data are copied. */
void hdf_virtual(struct hdf *f, const char *name, enum hdf_type type, int columns, const struct hdf_source *source,
                 int sources, int more);

/* Writes a dataset with one fixed-length string. */
void hdf_text(struct hdf *f, const char *name, const char *text);

/* Writes a dataset with a list of one variable-length string, which VTK shows as field data. Bytes that are not ASCII
 * become question marks. */
void hdf_text_list(struct hdf *f, const char *name, const char *text);

/* Writes an attribute of `count` numbers (a list even for one number) to a group or dataset. */
void hdf_mark(struct hdf *f, const char *group, const char *name, enum hdf_type type, int count, const void *values);

/* Writes an attribute of one number (a scalar) to a group or dataset. */
void hdf_mark_one(struct hdf *f, const char *group, const char *name, enum hdf_type type, const void *value);

/* Writes an attribute of one fixed-length ASCII string to a group or dataset. */
void hdf_mark_text(struct hdf *f, const char *group, const char *name, const char *text);

/* Returns the number of numbers in a dataset, or -1 if there is no such dataset, which is not a fault. */
int64_t hdf_count(struct hdf *f, const char *name);

/* Reads exactly `count` numbers of a dataset into `data`; another size is a fault. */
void hdf_read_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t count, void *data);

/* Reads an attribute of one number of a group or dataset; another size is a fault. */
void hdf_read_mark(struct hdf *f, const char *group, const char *name, enum hdf_type type, void *value);

#endif
