/* Wrappers of the HDF5 functions that Cleave uses. After the first fault all further operations on a file do nothing,
 * so that a caller may check for faults only at the end. */
#include "output/output_hdf5.h"
#include "output/output_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* CHUNK_ROWS: largest number of rows in a chunk of a table. Chunks of this size fit HDF5's chunk cache of 1 MiB,
 * without which each row is read by a call of its own; their index takes about 0.02 bytes per row. GZIP_LEVEL: level
 * of compression. */
enum { CHUNK_ROWS = 4096, GZIP_LEVEL = 4 };

/* Half of the number of chunks in a node of the tree that indexes chunks. With HDF5's default of 32 every dataset
 * has 2 to 4 kB of index. */
enum { INDEX_HALF = 4 };

/* Size of the buffers in which HDF5 converts a text of variable length [byte]; HDF5 clears its default of 1 MiB for
 * every text. */
enum { TEXT_BUFFER = 1024 };

/* Released memory that HDF5 may keep for reuse in each of its free lists [byte]. */
enum { HDF5_KEPT = 4 << 20 };

void hdf_disable_exit_handler_and_messages(void)
{
    static _Thread_local bool prepared; /* HDF5 keeps for each thread whether it prints errors */
    if (prepared) return;
    prepared = true;
    /* HDF5 1.10 flushes its open files again at exit, and crashes on files that could not be written. */
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    /* The tables of a closed file, 0.6 MB, serve the next file; the kernel need not clear pages for each. */
    H5set_free_list_limits(HDF5_KEPT, HDF5_KEPT, HDF5_KEPT, HDF5_KEPT, HDF5_KEPT, HDF5_KEPT);
}

size_t hdf_type_size(enum hdf_type type)
{
    static const size_t size[] = {[HDF_F32] = 4, [HDF_F64] = 8, [HDF_U8] = 1, [HDF_I32] = 4, [HDF_I64] = 8};
    return size[type];
}

static hid_t hdf_native(enum hdf_type type)
{
    switch (type) {
    case HDF_F32:
        return H5T_NATIVE_FLOAT;
    case HDF_F64:
        return H5T_NATIVE_DOUBLE;
    case HDF_U8:
        return H5T_NATIVE_UINT8;
    case HDF_I32:
        return H5T_NATIVE_INT32;
    default:
        return H5T_NATIVE_INT64;
    }
}

/* Records in `hdf` whether an HDF5 call failed, with errno. result: value that the call returned, negative on a fault.
 * Returns true if the call succeeded. */
static bool good(struct hdf *hdf, int64_t result)
{
    if (result >= 0) return true;
    hdf->failed = true;
    hdf->cause = errno;
    return false;
}

/* Returns true if no operation on the file `hdf` has failed so far. Clears errno for the next call. */
static bool ready(const struct hdf *hdf)
{
    errno = 0;
    return !hdf->failed;
}

/* Returns the access properties for an HDF5 file: objects that are still open are closed with it, and no file locks are
 * used, which some network file systems do not have. Release the list with H5Pclose. On a fault, records it in `hdf`
 * and returns a negative number. */
static hid_t access_list(struct hdf *hdf)
{
    hid_t list = -1;
    hdf_disable_exit_handler_and_messages();
    if (good(hdf, list = H5Pcreate(H5P_FILE_ACCESS))) good(hdf, H5Pset_fclose_degree(list, H5F_CLOSE_STRONG));
#if H5_VERSION_GE(1, 10, 7)
    if (!hdf->failed) good(hdf, H5Pset_file_locking(list, false, true));
#endif
    return list;
}

void hdf_create(struct hdf *hdf, const char *path, bool compress)
{
    hid_t create = -1;
    *hdf = (struct hdf){.file = -1, .compress = compress};
    errno = 0;
    hid_t access = access_list(hdf);
    if (hdf->failed) return;
    unlink(path); /* left by a killed run; a link of this name is not followed */
    (void)(good(hdf, create = H5Pcreate(H5P_FILE_CREATE)) && good(hdf, H5Pset_obj_track_times(create, false)) &&
           good(hdf, H5Pset_istore_k(create, INDEX_HALF)) &&
           good(hdf, hdf->file = H5Fcreate(path, H5F_ACC_EXCL, create, access)) && good(hdf, H5Pclose(create)) &&
           good(hdf, H5Pclose(access)));
}

void hdf_open_for_reading(struct hdf *hdf, const char *path)
{
    *hdf = (struct hdf){.file = -1};
    errno = 0;
    hid_t access = access_list(hdf);
    if (hdf->failed) return;
    (void)(good(hdf, hdf->file = H5Fopen(path, H5F_ACC_RDONLY, access)) && good(hdf, H5Pclose(access)));
}

void hdf_close(struct hdf *hdf)
{
    if (hdf->file < 0) return;
    errno = 0;
    if (H5Fclose(hdf->file) < 0 && !hdf->failed) {
        hdf->failed = true;
        hdf->cause = errno;
    }
    hdf->file = -1;
}

status hdf_close_or_remove_if_write_failed(struct hdf *hdf, const char *path, bool *write_failed)
{
    if (!hdf->failed) hdf_close(hdf);
    if (!hdf->failed) return OK;
    *write_failed = true;
    file_discard_temporary(path);
    return file_report_write_failure(path, hdf->cause);
}

void hdf_create_group(struct hdf *hdf, const char *name)
{
    hid_t list = -1, group = -1;
    if (!ready(hdf)) return;
    (void)(good(hdf, list = H5Pcreate(H5P_GROUP_CREATE)) && good(hdf, H5Pset_obj_track_times(list, false)) &&
           good(hdf, group = H5Gcreate2(hdf->file, name, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(hdf, H5Gclose(group)) && good(hdf, H5Pclose(list)));
}

void hdf_write_rows(struct hdf *hdf, const char *name, enum hdf_type type, int64_t rows, int columns, const void *data)
{
    hsize_t shape[2] = {(hsize_t)rows, (hsize_t)columns};
    int rank = columns > 1 ? 2 : 1;
    hid_t space = -1, list = -1, set = -1, native;
    if (!ready(hdf)) return;
    native = hdf_native(type);
    (void)(good(hdf, space = H5Screate_simple(rank, shape, NULL)) && good(hdf, list = H5Pcreate(H5P_DATASET_CREATE)) &&
           good(hdf, H5Pset_obj_track_times(list, false)) &&
           good(hdf, set = H5Dcreate2(hdf->file, name, native, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           (rows == 0 || good(hdf, H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, data))) &&
           good(hdf, H5Dclose(set)) && good(hdf, H5Pclose(list)) && good(hdf, H5Sclose(space)));
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* A dataset with one or two dimensions while it is written to an HDF5 file in chunks. Local to the function that writes
 * the dataset. */
struct table {
    hid_t set, space, native; /* handles: dataset, its dataspace, type of a number in memory */
    int rank;                 /* number of dimensions of the dataset */
    int64_t rows, chunk;      /* number of all rows; of the rows of a chunk */
    size_t row;               /* size of the stored numbers of a row [byte] */
    hsize_t stored;           /* number of stored numbers per row */
    const char *data;         /* [rows] rows */
    uint64_t fill;            /* bytes of the number that fills entries that are not stored */
    size_t number;            /* size of a number [byte] */
};

/* Returns true if all numbers in the rows first .. end - 1 of the table t equal its fill value, bit for bit. */
static bool table_is_fill(const struct table *t, int64_t first, int64_t end)
{
    const char *at = t->data + (size_t)first * t->row;
    const size_t length = (size_t)(end - first) * t->row;
    /* the first number equals the fill value, and each number equals the one before it */
    return arrays_equal(at, &t->fill, 1, t->number) && arrays_equal(at + t->number, at, 1, length - t->number);
}

/* Writes the rows first .. end - 1 of table t, one chunk, to the file f. Returns false on a fault, which is recorded in
 * f. */
static bool table_write_chunk(struct hdf *hdf, const struct table *t, int64_t first, int64_t end)
{
    const hsize_t at[2] = {(hsize_t)first, 0}, shape[2] = {(hsize_t)(end - first), t->stored};
    const char *rows = t->data + (size_t)first * t->row;
    hid_t from = -1;
#if H5_VERSION_GE(1, 10, 3)
    /* whole chunks go to the file as they are, without a copy in the cache of chunks */
    if (!hdf->compress && end - first == t->chunk)
        return good(hdf, H5Dwrite_chunk(t->set, H5P_DEFAULT, 0, at, (size_t)t->chunk * t->row, rows));
#endif
    return good(hdf, from = H5Screate_simple(t->rank, shape, NULL)) &&
           good(hdf, H5Sselect_hyperslab(t->space, H5S_SELECT_SET, at, NULL, shape, NULL)) &&
           good(hdf, H5Dwrite(t->set, t->native, from, t->space, H5P_DEFAULT, rows)) && good(hdf, H5Sclose(from));
}

/* Writes to the file `hdf` all chunks of table t in which a number differs from the fill value; HDF5 reads the others
 * as fill value. Returns false on a fault, which is recorded in f. */
static bool table_write_chunks(struct hdf *hdf, const struct table *t)
{
    for (int64_t first = 0; first < t->rows; first += t->chunk) {
        const int64_t end = first + t->chunk < t->rows ? first + t->chunk : t->rows;
        if (!table_is_fill(t, first, end) && !table_write_chunk(hdf, t, first, end)) return false;
    }
    return true;
}

/* Returns the creation properties of table t for the file hdf: fill value, chunks of t->chunk rows, compressed if
 * hdf->compress. Returns -1 on a fault. Release the list with H5Pclose. */
static hid_t table_list(struct hdf *hdf, const struct table *t)
{
    const hsize_t chunk[2] = {(hsize_t)t->chunk, t->stored};
    hid_t list = -1;
    if (!good(hdf, list = H5Pcreate(H5P_DATASET_CREATE)) || !good(hdf, H5Pset_obj_track_times(list, false)) ||
        !good(hdf, H5Pset_fill_value(list, t->native, &t->fill)) || !good(hdf, H5Pset_chunk(list, t->rank, chunk)))
        return -1;
    if (!hdf->compress) return list;
    return good(hdf, H5Pset_shuffle(list)) && good(hdf, H5Pset_deflate(list, GZIP_LEVEL)) ? list : -1;
}

void hdf_write_rows_zero_padded(struct hdf *hdf, const char *name, enum hdf_type type, int64_t rows, int columns,
                                int stored_columns, const void *data)
{
    const hsize_t shape[2] = {(hsize_t)rows, (hsize_t)columns};
    const int64_t chunks = (rows + CHUNK_ROWS - 1) / CHUNK_ROWS;
    struct table t = {.rank = columns > 1 ? 2 : 1, .rows = rows, .stored = (hsize_t)stored_columns, .data = data};
    hid_t list = -1;
    if (rows == 0) hdf_write_rows(hdf, name, type, rows, columns, data);
    if (!ready(hdf) || rows == 0) return;
    t.chunk = (rows + chunks - 1) / chunks;
    t.native = hdf_native(type), t.number = hdf_type_size(type), t.row = (size_t)stored_columns * t.number;
    if (columns == 1) array_copy(&t.fill, data, 1, t.number);
    (void)(good(hdf, t.space = H5Screate_simple(t.rank, shape, NULL)) && good(hdf, list = table_list(hdf, &t)) &&
           good(hdf, t.set = H5Dcreate2(hdf->file, name, t.native, t.space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           table_write_chunks(hdf, &t) && good(hdf, H5Dclose(t.set)) && good(hdf, H5Pclose(list)) &&
           good(hdf, H5Sclose(t.space)));
}

/* ---- links ------------------------------------------------------------------------------------------------------- */

/* Creates in `hdf` the external link `name` to the dataset of the same path in the file target_file, a path relative to
 * the folder of f. A failure is stored in hdf->failed. */
void hdf_create_external_link(struct hdf *hdf, const char *name, const char *target_file)
{
    if (ready(hdf)) good(hdf, H5Lcreate_external(target_file, name, hdf->file, name, H5P_DEFAULT, H5P_DEFAULT));
}

bool hdf_read_external_link_target(struct hdf *hdf, const char *name, char *target_file, size_t capacity)
{
    H5L_info_t link;
    char value[1024];
    const char *target = NULL;
    target_file[0] = '\0';
    if (!ready(hdf) || !good(hdf, H5Lget_info(hdf->file, name, &link, H5P_DEFAULT)) || link.type != H5L_TYPE_EXTERNAL)
        return false;
    if (link.u.val_size <= sizeof value && good(hdf, H5Lget_val(hdf->file, name, value, sizeof value, H5P_DEFAULT)) &&
        good(hdf, H5Lunpack_elink_val(value, link.u.val_size, NULL, &target, NULL)))
        snprintf(target_file, capacity, "%s", target);
    return true;
}

/* ---- virtual datasets -------------------------------------------------------------------------------------------- */

/* Maps the rows of one source file to the rows of a virtual dataset of `hdf` from at[0] on. list: creation properties
 * of the dataset; space: its data space; name: path of the dataset in the source; at[rank]: first row and column in the
 * virtual dataset; shape[rank]: rows and columns of the source. Returns false on a fault. */
static bool source_map(struct hdf *hdf, hid_t list, hid_t space, const char *name, const hsize_t *at,
                       const struct hdf_source *source, const hsize_t *shape, int rank)
{
    hid_t from = -1;
    return good(hdf, from = H5Screate_simple(rank, shape, NULL)) &&
           good(hdf, H5Sselect_hyperslab(space, H5S_SELECT_SET, at, NULL, shape, NULL)) &&
           good(hdf, H5Pset_virtual(list, space, source->file, name, from)) && good(hdf, H5Sclose(from));
}

void hdf_write_virtual_dataset(struct hdf *hdf, const char *name, enum hdf_type type, int columns,
                               const struct hdf_source *source_files, int source_count, int extra_rows)
{
    hsize_t all[2] = {0, (hsize_t)columns}, at[2] = {0, 0};
    const int rank = columns > 1 ? 2 : 1;
    hid_t space = -1, list = -1, set = -1;
    if (!ready(hdf)) return;
    for (int k = 0; k < source_count; k++) all[0] += (hsize_t)(source_files[k].rows + extra_rows);
    if (!good(hdf, space = H5Screate_simple(rank, all, NULL)) || !good(hdf, list = H5Pcreate(H5P_DATASET_CREATE)) ||
        !good(hdf, H5Pset_obj_track_times(list, false)))
        return;
    for (int k = 0; k < source_count; k++) {
        const hsize_t shape[2] = {(hsize_t)(source_files[k].rows + extra_rows), (hsize_t)columns};
        if (source_files[k].file && shape[0] > 0 &&
            !source_map(hdf, list, space, name, at, &source_files[k], shape, rank))
            return;
        at[0] += shape[0];
    }
    (void)(good(hdf, H5Sselect_all(space)) &&
           good(hdf, set = H5Dcreate2(hdf->file, name, hdf_native(type), space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(hdf, H5Dclose(set)) && good(hdf, H5Pclose(list)) && good(hdf, H5Sclose(space)));
}

/* Returns an HDF5 type of fixed length for the text `text`, or -1 on a fault, which is recorded in f. VTK 9.1 cannot
 * read texts of variable length. Release it with H5Tclose. */
static hid_t text_type(struct hdf *hdf, const char *text)
{
    hid_t type = -1;
    size_t length = strlen(text);
    if (good(hdf, type = H5Tcopy(H5T_C_S1))) good(hdf, H5Tset_size(type, length > 0 ? length : 1));
    if (!hdf->failed) good(hdf, H5Tset_strpad(type, H5T_STR_NULLPAD));
    return hdf->failed ? -1 : type;
}

void hdf_write_text(struct hdf *hdf, const char *name, const char *text)
{
    hid_t type = -1, space = -1, list = -1, set = -1;
    if (!ready(hdf)) return;
    (void)(good(hdf, type = text_type(hdf, text)) && good(hdf, space = H5Screate(H5S_SCALAR)) &&
           good(hdf, list = H5Pcreate(H5P_DATASET_CREATE)) && good(hdf, H5Pset_obj_track_times(list, false)) &&
           good(hdf, set = H5Dcreate2(hdf->file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(hdf, H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text)) && good(hdf, H5Dclose(set)) &&
           good(hdf, H5Pclose(list)) && good(hdf, H5Sclose(space)) && good(hdf, H5Tclose(type)));
}

void hdf_write_text_as_list_of_one_string(struct hdf *hdf, const char *name, const char *text)
{
    const hsize_t one = 1;
    hid_t type = -1, space = -1, list = -1, transfer = -1, set = -1;
    char *plain = hdf->failed ? NULL : strdup(text);
    if (!ready(hdf)) return;
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c > 126) *c = '?';
    (void)(good(hdf, plain ? 0 : -1) && good(hdf, type = H5Tcopy(H5T_C_S1)) &&
           good(hdf, H5Tset_size(type, H5T_VARIABLE)) && good(hdf, space = H5Screate_simple(1, &one, NULL)) &&
           good(hdf, list = H5Pcreate(H5P_DATASET_CREATE)) && good(hdf, H5Pset_obj_track_times(list, false)) &&
           good(hdf, transfer = H5Pcreate(H5P_DATASET_XFER)) &&
           good(hdf, H5Pset_buffer(transfer, TEXT_BUFFER, NULL, NULL)) &&
           good(hdf, set = H5Dcreate2(hdf->file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(hdf, H5Dwrite(set, type, H5S_ALL, H5S_ALL, transfer, &plain)) && good(hdf, H5Dclose(set)) &&
           good(hdf, H5Pclose(transfer)) && good(hdf, H5Pclose(list)) && good(hdf, H5Sclose(space)) &&
           good(hdf, H5Tclose(type)));
    free(plain);
}

/* Writes the attribute `name` of the group `group` in the file `hdf`, with one value *value of the HDF5 type `type`,
 * and closes the data space `space`. A fault is recorded in f. */
static void output_hdf5_mark(struct hdf *hdf, const char *group, const char *name, hid_t type, hid_t space,
                             const void *value)
{
    hid_t at = -1;
    (void)(good(hdf, type) && good(hdf, space) &&
           good(hdf,
                at = H5Acreate_by_name(hdf->file, group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)) &&
           good(hdf, H5Awrite(at, type, value)) && good(hdf, H5Aclose(at)) && good(hdf, H5Sclose(space)));
}

void hdf_write_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type, int count,
                         const void *values)
{
    hsize_t shape = (hsize_t)count;
    if (ready(hdf)) output_hdf5_mark(hdf, group, name, hdf_native(type), H5Screate_simple(1, &shape, NULL), values);
}

void hdf_write_scalar_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type,
                                const void *value)
{
    if (ready(hdf)) output_hdf5_mark(hdf, group, name, hdf_native(type), H5Screate(H5S_SCALAR), value);
}

void hdf_write_text_attribute(struct hdf *hdf, const char *group, const char *name, const char *text)
{
    if (!ready(hdf)) return;
    hid_t type = text_type(hdf, text);
    if (hdf->failed) return;
    output_hdf5_mark(hdf, group, name, type, H5Screate(H5S_SCALAR), text);
    if (!hdf->failed) good(hdf, H5Tclose(type));
}

int64_t hdf_dataset_element_count(struct hdf *hdf, const char *name)
{
    hid_t set = -1, space = -1;
    if (!ready(hdf)) return -1;
    const htri_t there = H5Lexists(hdf->file, name, H5P_DEFAULT);
    if (!good(hdf, there) || there == 0 || !good(hdf, set = H5Dopen2(hdf->file, name, H5P_DEFAULT))) return -1;
    const int64_t count = good(hdf, space = H5Dget_space(set)) ? H5Sget_simple_extent_npoints(space) : -1;
    if (space >= 0) H5Sclose(space);
    H5Dclose(set);
    return count;
}

void hdf_read_rows(struct hdf *hdf, const char *name, enum hdf_type type, int64_t count, void *data)
{
    hid_t set = -1;
    if (!ready(hdf)) return;
    if (hdf_dataset_element_count(hdf, name) != count) {
        hdf->failed = true;
        return;
    }
    if (count == 0) return;
    (void)(good(hdf, set = H5Dopen2(hdf->file, name, H5P_DEFAULT)) &&
           good(hdf, H5Dread(set, hdf_native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data)) && good(hdf, H5Dclose(set)));
}

bool hdf_has_attribute(struct hdf *hdf, const char *group, const char *name)
{
    htri_t there = 0;
    if (ready(hdf)) good(hdf, there = H5Aexists_by_name(hdf->file, group, name, H5P_DEFAULT));
    return there > 0;
}

void hdf_read_attribute(struct hdf *hdf, const char *group, const char *name, enum hdf_type type, void *value)
{
    hid_t at = -1, space = -1;
    if (!ready(hdf)) return;
    if (!good(hdf, at = H5Aopen_by_name(hdf->file, group, name, H5P_DEFAULT, H5P_DEFAULT))) return;
    if (!good(hdf, space = H5Aget_space(at))) return;
    /* A damaged or foreign file may hold more numbers than `value` has room for. */
    if (H5Sget_simple_extent_npoints(space) != 1) hdf->failed = true;
    if (!hdf->failed) (void)(good(hdf, H5Aread(at, hdf_native(type), value)) && good(hdf, H5Aclose(at)));
    H5Sclose(space);
}

/* ---- files of other programs ------------------------------------------------------------------------------------- */

/* Returns true if the data of `dataset` are in its own file, neither in an external one nor in those of a virtual
 * dataset. */
bool hdf_dataset_is_stored_in_own_file(hid_t dataset)
{
    hid_t made = H5Dget_create_plist(dataset);
    const bool inside = H5Pget_layout(made) != H5D_VIRTUAL && H5Pget_external_count(made) == 0;
    H5Pclose(made);
    return inside;
}

bool hdf_is_link(hid_t file, const char *name)
{
    H5L_info_t link;
    return H5Lget_info(file, name, &link, H5P_DEFAULT) >= 0 && link.type != H5L_TYPE_HARD;
}

void hdf_read_text_attribute(hid_t file, const char *object_path, const char *name, char *text, size_t capacity)
{
    text[0] = '\0';
    if (H5Aexists_by_name(file, object_path, name, H5P_DEFAULT) <= 0) return;
    hid_t held = H5Aopen_by_name(file, object_path, name, H5P_DEFAULT, H5P_DEFAULT), type = H5Aget_type(held);
    char *long_text = NULL;
    if (H5Tget_class(type) == H5T_STRING && H5Aget_storage_size(held) > 0) {
        if (H5Tis_variable_str(type) > 0) {
            if (H5Aread(held, type, &long_text) >= 0 && long_text) snprintf(text, capacity, "%s", long_text);
            if (long_text) H5free_memory(long_text);
        } else if (H5Tget_size(type) < capacity && H5Aread(held, type, text) >= 0) {
            text[H5Tget_size(type)] = '\0';
        }
    }
    H5Tclose(type);
    H5Aclose(held);
}
