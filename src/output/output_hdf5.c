/* HDF5 operations of the program. After the first fault all further operations on a file do nothing. */
#include "output/output_hdf5.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Rows per chunk of a compressed dataset: 64 Ki rows of 24 bytes, 1.5 MiB, fit HDF5's chunk cache. */
enum { CHUNK_ROWS = 1 << 16, GZIP_LEVEL = 4 };

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

/* Records the result of an HDF5 call, which is negative on a fault, and errno in f. Returns true if there was no
 * fault. */
static bool good(struct hdf *f, int64_t result)
{
    if (result >= 0) return true;
    f->failed = true;
    f->cause = errno;
    return false;
}

/* Returns true if no fault has occurred on the file. Clears errno for the next call. */
static bool ready(const struct hdf *f)
{
    errno = 0;
    return !f->failed;
}

/* Returns the access properties for a file: objects that are still open are closed with it, and no file locks are
 * used, which some network file systems do not have. */
static hid_t access_list(struct hdf *f)
{
    hid_t list = -1;
    if (good(f, list = H5Pcreate(H5P_FILE_ACCESS))) good(f, H5Pset_fclose_degree(list, H5F_CLOSE_STRONG));
#if H5_VERSION_GE(1, 10, 7)
    if (!f->failed) good(f, H5Pset_file_locking(list, false, true));
#endif
    return list;
}

void hdf_create(struct hdf *f, const char *path, bool compress)
{
    hid_t create = -1;
    *f = (struct hdf){.file = -1, .compress = compress};
    errno = 0;
    hid_t access = access_list(f);
    if (f->failed) return;
    unlink(path); /* left by a killed run; a link of this name is not followed */
    (void)(good(f, create = H5Pcreate(H5P_FILE_CREATE)) && good(f, H5Pset_obj_track_times(create, false)) &&
           good(f, f->file = H5Fcreate(path, H5F_ACC_EXCL, create, access)) && good(f, H5Pclose(create)) &&
           good(f, H5Pclose(access)));
}

void hdf_open(struct hdf *f, const char *path)
{
    *f = (struct hdf){.file = -1};
    errno = 0;
    hid_t access = access_list(f);
    if (f->failed) return;
    (void)(good(f, f->file = H5Fopen(path, H5F_ACC_RDONLY, access)) && good(f, H5Pclose(access)));
}

void hdf_close(struct hdf *f)
{
    if (f->file < 0) return;
    errno = 0;
    if (H5Fclose(f->file) < 0 && !f->failed) {
        f->failed = true;
        f->cause = errno;
    }
    f->file = -1;
}

void hdf_create_group(struct hdf *f, const char *name)
{
    hid_t list = -1, group = -1;
    if (!ready(f)) return;
    (void)(good(f, list = H5Pcreate(H5P_GROUP_CREATE)) && good(f, H5Pset_obj_track_times(list, false)) &&
           good(f, group = H5Gcreate2(f->file, name, H5P_DEFAULT, list, H5P_DEFAULT)) && good(f, H5Gclose(group)) &&
           good(f, H5Pclose(list)));
}

/* Returns the creation properties of a dataset of this shape: contiguous, or with compression in chunks. */
static hid_t dataset_list(struct hdf *f, int rank, const hsize_t *shape)
{
    hid_t list = -1;
    if (!good(f, list = H5Pcreate(H5P_DATASET_CREATE)) || !good(f, H5Pset_obj_track_times(list, false))) return -1;
    if (!f->compress || shape[0] == 0) return list;
    hsize_t chunk[2] = {shape[0] < CHUNK_ROWS ? shape[0] : CHUNK_ROWS, shape[1]};
    bool made = good(f, H5Pset_chunk(list, rank, chunk)) && good(f, H5Pset_shuffle(list)) &&
                good(f, H5Pset_deflate(list, GZIP_LEVEL));
    return made ? list : -1;
}

void hdf_write_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t rows, int columns, const void *data)
{
    hsize_t shape[2] = {(hsize_t)rows, (hsize_t)columns};
    int rank = columns > 1 ? 2 : 1;
    hid_t space = -1, list = -1, set = -1, native;
    if (!ready(f)) return;
    native = hdf_native(type);
    (void)(good(f, space = H5Screate_simple(rank, shape, NULL)) && good(f, list = dataset_list(f, rank, shape)) &&
           good(f, set = H5Dcreate2(f->file, name, native, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           (rows == 0 || good(f, H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, data))) &&
           good(f, H5Dclose(set)) && good(f, H5Pclose(list)) && good(f, H5Sclose(space)));
}

/* Adds one source to the properties `list` of a virtual dataset: its rows appear from row at[0] on. shape: size of
 * the source. Returns false on a fault. */
static bool source_map(struct hdf *f, hid_t list, hid_t space, const char *name, const hsize_t *at,
                       const struct hdf_source *source, const hsize_t *shape, int rank)
{
    hid_t from = -1;
    return good(f, from = H5Screate_simple(rank, shape, NULL)) &&
           good(f, H5Sselect_hyperslab(space, H5S_SELECT_SET, at, NULL, shape, NULL)) &&
           good(f, H5Pset_virtual(list, space, source->file, name, from)) && good(f, H5Sclose(from));
}

void hdf_write_virtual(struct hdf *f, const char *name, enum hdf_type type, int columns,
                       const struct hdf_source *source, int sources, int more)
{
    hsize_t all[2] = {0, (hsize_t)columns}, at[2] = {0, 0};
    const int rank = columns > 1 ? 2 : 1;
    hid_t space = -1, list = -1, set = -1;
    if (!ready(f)) return;
    for (int k = 0; k < sources; k++) all[0] += (hsize_t)(source[k].rows + more);
    if (!good(f, space = H5Screate_simple(rank, all, NULL)) || !good(f, list = H5Pcreate(H5P_DATASET_CREATE)) ||
        !good(f, H5Pset_obj_track_times(list, false)))
        return;
    for (int k = 0; k < sources; k++) {
        const hsize_t shape[2] = {(hsize_t)(source[k].rows + more), (hsize_t)columns};
        if (shape[0] > 0 && !source_map(f, list, space, name, at, &source[k], shape, rank)) return;
        at[0] += shape[0];
    }
    (void)(good(f, H5Sselect_all(space)) &&
           good(f, set = H5Dcreate2(f->file, name, hdf_native(type), space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(f, H5Dclose(set)) && good(f, H5Pclose(list)) && good(f, H5Sclose(space)));
}

/* Returns the HDF5 type of a text with a fixed length; VTK 9.1 cannot read texts of variable length. */
static hid_t text_type(struct hdf *f, const char *text)
{
    hid_t type = -1;
    size_t length = strlen(text);
    if (good(f, type = H5Tcopy(H5T_C_S1))) good(f, H5Tset_size(type, length > 0 ? length : 1));
    if (!f->failed) good(f, H5Tset_strpad(type, H5T_STR_NULLPAD));
    return f->failed ? -1 : type;
}

void hdf_write_text(struct hdf *f, const char *name, const char *text)
{
    hid_t type = -1, space = -1, list = -1, set = -1;
    if (!ready(f)) return;
    (void)(good(f, type = text_type(f, text)) && good(f, space = H5Screate(H5S_SCALAR)) &&
           good(f, list = H5Pcreate(H5P_DATASET_CREATE)) && good(f, H5Pset_obj_track_times(list, false)) &&
           good(f, set = H5Dcreate2(f->file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(f, H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text)) && good(f, H5Dclose(set)) &&
           good(f, H5Pclose(list)) && good(f, H5Sclose(space)) && good(f, H5Tclose(type)));
}

void hdf_write_text_list(struct hdf *f, const char *name, const char *text)
{
    const hsize_t one = 1;
    hid_t type = -1, space = -1, list = -1, set = -1;
    char *plain = f->failed ? NULL : strdup(text);
    if (!ready(f)) return;
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c > 126) *c = '?';
    (void)(good(f, plain ? 0 : -1) && good(f, type = H5Tcopy(H5T_C_S1)) && good(f, H5Tset_size(type, H5T_VARIABLE)) &&
           good(f, space = H5Screate_simple(1, &one, NULL)) && good(f, list = H5Pcreate(H5P_DATASET_CREATE)) &&
           good(f, H5Pset_obj_track_times(list, false)) &&
           good(f, set = H5Dcreate2(f->file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT)) &&
           good(f, H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &plain)) && good(f, H5Dclose(set)) &&
           good(f, H5Pclose(list)) && good(f, H5Sclose(space)) && good(f, H5Tclose(type)));
    free(plain);
}

/* Writes an attribute of a group and closes its data space. */
static void output_hdf5_mark(struct hdf *f, const char *group, const char *name, hid_t type, hid_t space,
                             const void *value)
{
    hid_t at = -1;
    (void)(good(f, type) && good(f, space) &&
           good(f, at = H5Acreate_by_name(f->file, group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)) &&
           good(f, H5Awrite(at, type, value)) && good(f, H5Aclose(at)) && good(f, H5Sclose(space)));
}

void hdf_write_attribute(struct hdf *f, const char *group, const char *name, enum hdf_type type, int count,
                         const void *values)
{
    hsize_t shape = (hsize_t)count;
    if (ready(f)) output_hdf5_mark(f, group, name, hdf_native(type), H5Screate_simple(1, &shape, NULL), values);
}

void hdf_write_scalar_attribute(struct hdf *f, const char *group, const char *name, enum hdf_type type,
                                const void *value)
{
    if (ready(f)) output_hdf5_mark(f, group, name, hdf_native(type), H5Screate(H5S_SCALAR), value);
}

void hdf_write_text_attribute(struct hdf *f, const char *group, const char *name, const char *text)
{
    if (!ready(f)) return;
    hid_t type = text_type(f, text);
    if (f->failed) return;
    output_hdf5_mark(f, group, name, type, H5Screate(H5S_SCALAR), text);
    if (!f->failed) good(f, H5Tclose(type));
}

int64_t hdf_dataset_size(struct hdf *f, const char *name)
{
    hid_t set = -1, space = -1;
    if (!ready(f)) return -1;
    const htri_t there = H5Lexists(f->file, name, H5P_DEFAULT);
    if (!good(f, there) || there == 0 || !good(f, set = H5Dopen2(f->file, name, H5P_DEFAULT))) return -1;
    const int64_t count = good(f, space = H5Dget_space(set)) ? H5Sget_simple_extent_npoints(space) : -1;
    if (space >= 0) H5Sclose(space);
    H5Dclose(set);
    return count;
}

void hdf_read_rows(struct hdf *f, const char *name, enum hdf_type type, int64_t count, void *data)
{
    hid_t set = -1;
    if (!ready(f)) return;
    if (hdf_dataset_size(f, name) != count) {
        f->failed = true;
        return;
    }
    if (count == 0) return;
    (void)(good(f, set = H5Dopen2(f->file, name, H5P_DEFAULT)) &&
           good(f, H5Dread(set, hdf_native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data)) && good(f, H5Dclose(set)));
}

void hdf_read_attribute(struct hdf *f, const char *group, const char *name, enum hdf_type type, void *value)
{
    hid_t at = -1, space = -1;
    if (!ready(f)) return;
    if (!good(f, at = H5Aopen_by_name(f->file, group, name, H5P_DEFAULT, H5P_DEFAULT))) return;
    if (!good(f, space = H5Aget_space(at))) return;
    /* A damaged or foreign file may hold more numbers than `value` has room for. */
    if (H5Sget_simple_extent_npoints(space) != 1) f->failed = true;
    if (!f->failed) (void)(good(f, H5Aread(at, hdf_native(type), value)) && good(f, H5Aclose(at)));
    H5Sclose(space);
}
