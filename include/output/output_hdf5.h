/* The HDF5 operations that the program needs, on one file at a time. Faults are stored in the struct: after the first
 * failed call all further calls on the file do nothing, because HDF5 1.10 crashes if it is used after a failed write.
 * Included only by files that read or write HDF5. */
#ifndef CLEAVE_OUTPUT_HDF5
#define CLEAVE_OUTPUT_HDF5

#include <hdf5.h>

#include "base/base.h"

/* Types of the numbers in a dataset of an HDF5 file: floating point (F), unsigned (U) and signed integers (I), with the
 * number of bits of each. */
enum hdf_type { HDF_F32, HDF_F64, HDF_U8, HDF_I32, HDF_I64 };

/* Returns the size of one number of the given type [byte]. */
size_t hdf_type_size(enum hdf_type type);

/* An open HDF5 file, and whether a call on it has failed. */
struct hdf {
    hid_t file;
    bool compress; /* gzip the tables of hdf_write_rows_zero_padded */
    bool failed;   /* a call failed: make no further one */
    int cause;     /* errno of the failed call, 0 if unknown */
};

/* Prepares HDF5 for the calling thread: no exit handler of HDF5, no error messages of HDF5 on the terminal. Functions
 * that open files call it first; commands without such files then start faster, as HDF5 is not initialised. */
void hdf_disable_exit_handler_and_messages(void);

/* Creates the HDF5 file `path`, replacing an existing one, and stores its handle in *f. compress: compress the tables
 * that hdf_write_rows_zero_padded writes with gzip. No time stamps are stored, so that equal content gives equal bytes.
 * Close it with hdf_close_or_remove_if_write_failed or hdf_close. A failure is stored in hdf->failed. */
void hdf_create(struct hdf *hdf, const char *path, bool compress);

/* Opens the HDF5 file `path` for reading and stores its handle in *f. Close it with hdf_close. A failure is stored in
 * hdf->failed. */
void hdf_open_for_reading(struct hdf *hdf, const char *path);

/* Closes the HDF5 file of *hdf and all its objects. A failure is stored in hdf->failed. */
void hdf_close(struct hdf *hdf);

/* Closes the HDF5 file `hdf`, which was created under PATH.cleave.tmp, the temporary name of `path`. If a call of HDF5
 * on the file has failed, removes the incomplete file, sets *write_failed to true and returns FAILED, with a
 * message. */
status hdf_close_or_remove_if_write_failed(struct hdf *hdf, const char *path, bool *write_failed);

/* Creates the group `name`, a path within the HDF5 file f. A failure is stored in hdf->failed. */
void hdf_create_group(struct hdf *hdf, const char *name);

/* Writes the dataset `name` of rows x columns numbers of the given type from data[rows][columns]; the dataset has one
 * dimension if `columns` is 1. A failure is stored in hdf->failed. */
void hdf_write_rows(struct hdf *hdf, const char *name, enum hdf_type type, int64_t rows, int columns, const void *data);

/* Writes the dataset `name` of rows x columns numbers of the given type. Only the first `stored_columns` numbers of
 * each row are given, in data[rows][stored_columns]; the others are 0 and take no space in the file. The dataset has
 * one dimension if `columns` is 1. Rows are stored in chunks. A chunk takes no space either if all its numbers equal
 * the fill value of the dataset: 0, or in a dataset of one column the number of its first row. A failure is stored in
 * hdf->failed. */
void hdf_write_rows_zero_padded(struct hdf *hdf, const char *name, enum hdf_type type, int64_t rows, int columns,
                                int stored_columns, const void *data);

/* Creates the external link `name` to the dataset of the same path in another file. target_file: path of that file
 * relative to the folder of f. A failure is stored in hdf->failed. */
void hdf_create_external_link(struct hdf *hdf, const char *name, const char *target_file);

/* Returns true if `name` is an external link, and stores the path of the file to which it leads in
 * target_file[capacity]; an empty text if the path is too long. A failure is stored in hdf->failed, also if nothing has
 * this name. */
bool hdf_read_external_link_target(struct hdf *hdf, const char *name, char *target_file, size_t capacity);

/* Part of a virtual dataset: `rows` rows of a dataset in another file, whose path is relative to the folder of the
 * virtual file; NULL: there is no such dataset, and the rows are 0. */
struct hdf_source {
    const char *file;
    int64_t rows;
};

/* Creates the virtual dataset `name`, which refers to data in other files instead of copying them: the rows of the
 * dataset of the same name in the files source_files[source_count], one after another. type, columns: type of the
 * numbers and numbers per row, equal in all files. From each file source_files[k].rows + extra_rows rows are taken. A
 * failure is stored in hdf->failed. */
void hdf_write_virtual_dataset(struct hdf *hdf, const char *name, enum hdf_type type, int columns,
                               const struct hdf_source *source_files, int source_count, int extra_rows);

/* Writes the string `text` to the HDF5 file `hdf` as the dataset `name`, of one string of fixed length. A failure is
 * stored in hdf->failed. */
void hdf_write_text(struct hdf *hdf, const char *name, const char *text);

/* Writes the string `text` as the dataset `name`, a list of one string of variable length, which VTK shows as field
 * data. Bytes that are not ASCII become question marks. A failure is stored in hdf->failed. */
void hdf_write_text_as_list_of_one_string(struct hdf *hdf, const char *name, const char *text);

/* Writes values[count], numbers of the given type, as the attribute `name` of a group or dataset; the attribute is a
 * list even for one number. group: path of the group or dataset. A failure is stored in hdf->failed. */
void hdf_write_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type, int count,
                         const void *values);

/* Writes the number *value of the given type as the attribute `name` of a group or dataset; the attribute is a scalar.
 * group: path of the group or dataset. A failure is stored in hdf->failed. */
void hdf_write_scalar_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type,
                                const void *value);

/* Writes the ASCII string `text` as the attribute `name` of a group or dataset, with fixed length. group: path of the
 * group or dataset. A failure is stored in hdf->failed. */
void hdf_write_text_attribute(struct hdf *hdf, const char *group, const char *name, const char *text);

/* Returns the number of elements of the dataset `name`, the product of its dimensions, or -1 if the file `hdf` has no
 * such dataset, which is not a failure. Any other failure is stored in hdf->failed. */
int64_t hdf_dataset_element_count(struct hdf *hdf, const char *name);

/* Reads the dataset `name`, which must hold exactly `count` numbers, and converts them to the given type in
 * data[count]. Another size or a failed read is stored in hdf->failed. */
void hdf_read_rows(struct hdf *hdf, const char *name, enum hdf_type type, int64_t count, void *data);

/* Returns true if the group or dataset at the path `group` of the file has an attribute `name`. A failure is stored in
 * hdf->failed. */
bool hdf_has_attribute(struct hdf *hdf, const char *group, const char *name);

/* Reads the attribute `name` of a group or dataset, which must be one number, and converts it to the given type in
 * *value. group: path of the group or dataset. Another size or a failed read is stored in hdf->failed. */
void hdf_read_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type, void *value);

/* ---- files of other programs, by HDF5's own handles -------------------------------------------------------------- */

/* Returns true if `name` is a soft or external link in the file or group with the handle `file`; does not follow the
 * link. */
bool hdf_is_link(hid_t file, const char *name);

/* Returns true if the data of the dataset with the handle `dataset` are stored in its own file: neither in an external
 * file nor as a virtual dataset, whose data are in other files. */
bool hdf_dataset_is_stored_in_own_file(hid_t dataset);

/* Reads the attribute `name` of the dataset or group at the path `object_path` of the file into text[capacity]; "" if
 * there is no such attribute, it is no text, or it has a fixed length of more than capacity - 1 bytes. Longer texts of
 * variable length are cut. */
void hdf_read_text_attribute(hid_t file, const char *object_path, const char *name, char *text, size_t capacity);

#endif
