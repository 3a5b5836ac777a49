/* Reads arrays of netCDF-4 files, which are HDF5 files: an array is a dataset, a dimension the length of the dataset of
 * its name. */
#include <hdf5.h>

#include "base/crash_message.h"
#include "exodus_parts.h"
#include "output/output_hdf5.h"

status exodus_hdf5_open(struct exodus_file *f)
{
    crash_message_set_file_in_use(f->path);
    hdf_disable_exit_handler_and_messages();
    H5E_BEGIN_TRY /* one message per fault: the error stack of HDF5 is not printed */
    {
        f->hdf5 = H5Fopen(f->path, H5F_ACC_RDONLY, H5P_DEFAULT);
    }
    H5E_END_TRY;
    if (f->hdf5 >= 0) return OK;
    crash_message_set_file_in_use(NULL);
    return status_set(REFUSED, "%s: HDF5 cannot read this file, which is cut off or damaged; write it again", f->path);
}

void exodus_hdf5_close(struct exodus_file *f)
{
    H5Fclose(f->hdf5);
    crash_message_set_file_in_use(NULL);
}

/* Opens the dataset `name` of f and stores its lengths in extent[2]. Returns its handle, to be closed with H5Dclose, or
 * a negative number unless the dataset is in this file and has one or two dimensions. */
static hid_t dataset_open(const struct exodus_file *f, const char *name, int64_t extent[2])
{
    hsize_t lengths[2] = {0, 1};
    if (H5Lexists(f->hdf5, name, H5P_DEFAULT) <= 0 || hdf_is_link(f->hdf5, name)) return -1;
    const hid_t set = H5Dopen2(f->hdf5, name, H5P_DEFAULT);
    if (set < 0) return -1;
    const hid_t space = H5Dget_space(set);
    const int ranks = H5Sget_simple_extent_ndims(space);
    const bool good = (ranks == 1 || ranks == 2) && H5Sget_simple_extent_dims(space, lengths, NULL) == ranks &&
                      lengths[0] <= INT32_MAX && lengths[1] <= INT32_MAX && hdf_dataset_is_stored_in_own_file(set);
    H5Sclose(space);
    extent[0] = (int64_t)lengths[0], extent[1] = (int64_t)lengths[1];
    if (good) return set;
    H5Dclose(set);
    return -1;
}

int64_t exodus_hdf5_length_of_dimension(const struct exodus_file *f, const char *dimension_name)
{
    int64_t extent[2] = {0};
    hid_t set = -1;
    H5E_BEGIN_TRY
    {
        set = dataset_open(f, dimension_name, extent);
        if (set >= 0) H5Dclose(set);
    }
    H5E_END_TRY;
    return set >= 0 ? extent[0] : 0;
}

/* Returns the type of the numbers of the dataset `set`, EXODUS_CHAR for letters, or 0 if it contains neither. */
static enum exodus_type dataset_type(hid_t set)
{
    const hid_t type = H5Dget_type(set);
    const H5T_class_t class = H5Tget_class(type);
    const bool letters = class == H5T_STRING && H5Tis_variable_str(type) == 0 && H5Tget_size(type) == 1;
    H5Tclose(type);
    if (letters) return EXODUS_CHAR;
    return class == H5T_FLOAT ? EXODUS_DOUBLE : class == H5T_INTEGER ? EXODUS_INT64 : 0;
}

bool exodus_hdf5_find_array(const struct exodus_file *f, const char *array_name, struct exodus_array *a)
{
    bool found = false;
    *a = (struct exodus_array){0};
    snprintf(a->name, sizeof a->name, "%s", array_name);
    H5E_BEGIN_TRY
    {
        const hid_t set = dataset_open(f, array_name, a->extent);
        if (set >= 0) {
            a->type = dataset_type(set);
            found = a->type != 0;
            hdf_read_text_attribute(f->hdf5, array_name, "elem_type", a->elements, sizeof a->elements);
            H5Dclose(set);
        }
    }
    H5E_END_TRY;
    return found;
}

bool exodus_hdf5_read_array(const struct exodus_file *f, const struct exodus_array *a, real *real_value,
                            int64_t *whole_value, char *letters)
{
    int64_t extent[2];
    bool good = false;
    H5E_BEGIN_TRY
    {
        const hid_t set = dataset_open(f, a->name, extent), letter = H5Tcopy(H5T_C_S1);
        const hid_t type = real_value ? H5T_NATIVE_DOUBLE : whole_value ? H5T_NATIVE_INT64 : letter;
        void *to = real_value ? (void *)real_value : whole_value ? (void *)whole_value : letters;
        good = set >= 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0;
        H5Tclose(letter);
        if (set >= 0) H5Dclose(set);
    }
    H5E_END_TRY;
    return good;
}
