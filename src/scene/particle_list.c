/* Reads particle lists: HDF5 files, and the choice of the format. Every message names the entry. */
#include "scene/particle_list.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/input.h"
#include "base/crash_message.h"
#include "base/memory.h"
#include "base/team.h"
#include "geometry/exodus_file.h"
#include "output/output_hdf5.h"
#include "particle_list_parts.h"
#include "scene_internal.h"

/* ---- HDF5 -------------------------------------------------------------------------------------------------------- */

/* A dataset of an HDF5 file as a table of numbers. */
struct table {
    int64_t rows, columns;
    real *value; /* [rows][columns] */
    real factor; /* factor from the unit of the dataset to SI */
};

/* Reads the number of rows and columns of the HDF5 dataset `set` into t. Returns false, and sets both to 0, unless the
 * dataset is a list of numbers with at most PARTICLES_MAX rows and DIM_MAX columns. */
static bool table_shape(hid_t set, struct table *t)
{
    hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    H5T_class_t class = H5Tget_class(type);
    hsize_t extent[2] = {0, 1};
    int rank = H5Sget_simple_extent_ndims(space);
    bool good = (rank == 1 || rank == 2) && (class == H5T_FLOAT || class == H5T_INTEGER) &&
                H5Sget_simple_extent_dims(space, extent, NULL) == rank;
    H5Tclose(type);
    H5Sclose(space);
    good = good && extent[0] <= PARTICLES_MAX && extent[1] >= 1 && extent[1] <= DIM_MAX;
    t->rows = good ? (int64_t)extent[0] : 0, t->columns = good ? (int64_t)extent[1] : 0;
    return good;
}

/* Largest number of rows per byte of an HDF5 file [1]: gzip does not compress equal numbers further. The limit bounds
 * the memory that a small file can claim. */
enum { ROWS_PER_BYTE_MOST = 1024 };

/* Checks that the dataset `name` of the file `path` claims no more rows, t->rows, than a file of its size can contain
 * and than the memory allows. Returns REFUSED, with a message, if it does. */
static status table_check(const struct table *t, const char *path, const char *name)
{
    struct stat about;
    if (stat(path, &about) != 0 || t->rows / ROWS_PER_BYTE_MOST > about.st_size)
        return status_set(
            REFUSED,
            "%s: %s claims %lld entries, more than a file of its size can contain, so it is damaged; write it again",
            path, name, (long long)t->rows);
    return particle_list_check_memory(path, t->rows);
}

/* Reads the dataset `name` of an open HDF5 file into t->value [rows][columns], which the caller releases with
 * memory_free. path: name of the file, for messages. Returns REFUSED, with a message, for links, for data stored in
 * other files, and for datasets that are no list of numbers. */
static status table_read(hid_t file, const char *path, const char *name, struct table *t)
{
    if (hdf_is_link(file, name))
        return status_set(REFUSED, "%s: %s is a link; replace it by a dataset in this file", path, name);
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0) return status_set(REFUSED, "%s: %s is not a dataset; store its numbers as one", path, name);
    bool good = table_shape(set, t);
    status checked = good ? table_check(t, path, name) : OK;
    if (good && !hdf_dataset_is_stored_in_own_file(set))
        checked = status_set(REFUSED, "%s: %s is stored in another file; store its numbers in this file", path, name);
    if (checked != OK) {
        H5Dclose(set);
        return checked;
    }
    if (good) {
        t->value = NEW("list.table", t->rows * t->columns, real);
        good = H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, t->value) >= 0;
    }
    H5Dclose(set);
    if (good) return OK;
    memory_free(t->value);
    t->value = NULL;
    return status_set(REFUSED, "%s: %s: cannot be read as one list of numbers; write it as an array of one dimension",
                      path, name);
}

/* Copies column k of the table t, converted to SI units, to a new array of the list l, which particle_list_free
 * releases. column: quantity in the list (COLUMN_*); path: name of the file, for messages. Returns REFUSED, with a
 * message, for an invalid value. */
static status table_take(struct particle_list *l, int column, const struct table *t, int k, const char *path)
{
    real *array = NEW("list.column", l->n, real);
    *particle_list_address_of_column_array(l, column) = array;
    for (int64_t i = 0; i < l->n; i++) {
        array[i] = t->value[i * t->columns + k] * t->factor;
        const char *fault = particle_list_reason_value_is_invalid(column, array[i]);
        if (fault != NULL)
            return status_set(REFUSED, "%s: entry %lld: %s: %g %s", path, (long long)i, list_quantity[column].name,
                              array[i], fault);
    }
    return OK;
}

/* Reads the dataset `name` of an HDF5 file as `count` columns of the list l, beginning with `column` (COLUMN_*). The
 * positions set the number of entries l->n; positions and velocities may have more components than the space. path:
 * name of the file, for messages. Returns REFUSED, with a message, for another number of rows or columns, a wrong unit
 * or an invalid value. */
static status hdf5_column(struct particle_list *l, hid_t file, const char *path, const char *name, int column,
                          int count)
{
    char unit[UNIT_TEXT], what[160];
    struct table t = {0};
    TRY(table_read(file, path, name, &t));
    status s = OK;
    hdf_read_text_attribute(file, name, "unit", unit, UNIT_TEXT);
    if (!unit[0]) t.factor = particle_list_default_factor_to_si(l, column);
    if (column == COLUMN_X) l->n = t.rows;
    if (t.rows != l->n || (count > 1 || column < COLUMN_VOLUME ? t.columns < count : t.columns != count))
        s = status_set(REFUSED, "%s: dataset %s has %lld x %lld numbers, but must have %lld x %d; correct it", path,
                       name, (long long)t.rows, (long long)t.columns, (long long)l->n, count);
    else if (unit[0] && !unit_find_factor_to_si(&t.factor, unit, list_quantity[column].unit, what, sizeof what))
        s = status_set(REFUSED, "%s: %s: its unit %s %s", path, name, unit, what);
    if (t.columns > count)
        particle_list_head_append_to_message(&l->head, ", ",
                                             column == COLUMN_X ? "further positions" : "further velocities");
    for (int k = 0; k < count && s == OK; k++) s = table_take(l, column + k, &t, k, path);
    memory_free(t.value);
    return s;
}

static status hdf5_columns(struct particle_list *l, hid_t file, const char *path)
{
    static const struct {
        const char *name;
        int column;
    } sets[] = {{"volumes", COLUMN_VOLUME}, {"mass", COLUMN_MASS},         {"density", COLUMN_DENSITY},
                {"velocities", COLUMN_VX},  {"material", COLUMN_MATERIAL}, {"body", COLUMN_BODY}};
    bool has[COLUMNS] = {false};
    TRY(hdf5_column(l, file, path, "positions", COLUMN_X, l->dim));
    for (size_t k = 0; k < COUNT_OF(sets); k++) {
        if (H5Lexists(file, sets[k].name, H5P_DEFAULT) <= 0) continue;
        TRY(hdf5_column(l, file, path, sets[k].name, sets[k].column, sets[k].column == COLUMN_VX ? l->dim : 1));
        has[sets[k].column] = true;
    }
    particle_list_head_store_missing_columns(&l->head, has);
    if (!has[COLUMN_MASS] || !has[COLUMN_DENSITY]) return OK;
    return status_set(
        REFUSED, "%s: mass and density are both given, but each determines the other; remove one of the two datasets",
        path);
}

/* Reads the list l from the HDF5 file `path`. If the library crashes on a damaged file, the crash message names the
 * file. Returns REFUSED, with a message, if the file is not HDF5 or its datasets are invalid. */
static status hdf5_read(struct particle_list *l, const char *path)
{
    status s;
    input_file_register_as_read(path);
    crash_message_set_file_in_use(path);
    hdf_disable_exit_handler_and_messages();
    H5E_BEGIN_TRY /* one message per fault: the error stack of HDF5 is not printed */
    {
        hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        s = file < 0 ? status_set(REFUSED, "%s: this is not an HDF5 file; give one, or a .csv file", path)
                     : hdf5_columns(l, file, path);
        if (file >= 0) H5Fclose(file);
    }
    H5E_END_TRY;
    crash_message_set_file_in_use(NULL);
    return s;
}

/* ---- choice of the format ---------------------------------------------------------------------------------------- */

/* Returns true if `path` ends with the text `ending` and has further characters before it. Capitals count as small
 * letters. */
static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

/* Format of a particle list. */
enum { NO_LIST, LIST_CSV, LIST_HDF5, LIST_EXODUS };

/* Returns the format of the particle list in the file `path` (LIST_CSV, LIST_HDF5, LIST_EXODUS) from its file name
 * extension; NO_LIST for any other extension. */
static int list_format(const char *path)
{
    static const char *const endings[] = {".csv", ".tsv", ".txt", ".dat", ".h5", ".hdf5", ".hdf"};
    for (size_t k = 0; k < COUNT_OF(endings); k++)
        if (ends_with(path, endings[k])) return k < 4 ? LIST_CSV : LIST_HDF5;
    return path_has_exodus_extension(path) ? LIST_EXODUS : NO_LIST;
}

bool path_has_particle_list_extension(const char *path) { return list_format(path) != NO_LIST; }

/* Reads a particle list of any format from the file `path` into l. form: unit and columns that the input file (scene)
 * gives, or NULL if it gives none; dim: coordinates per position; head: true to read only the column names (CSV files).
 * Returns REFUSED, with a message and l released, if the file is missing or invalid, or if the scene gives columns for
 * a file other than CSV. */
static status list_read(struct particle_list *l, const char *path, const struct particle_list_form *form, int dim,
                        bool head)
{
    *l = (struct particle_list){.dim = dim};
    if (form) l->form = *form;
    struct stat about;
    const int format = list_format(path);
    if (format == NO_LIST)
        return status_set(REFUSED, "%s: is not a particle list; give a file that ends in .csv, .h5 or .exo", path);
    if (l->form.columns && format != LIST_CSV)
        return status_set(
            REFUSED, "%s: this kind of file names its columns itself; remove columns, which are for .csv files", path);
    if (stat(path, &about) != 0)
        return status_set(REFUSED, "%s: there is no such file; check the name and the folder", path);
    if (!S_ISREG(about.st_mode))
        return status_set(REFUSED, "%s: this is not a regular file; give a .csv, .h5 or .exo file", path);
    status s = format == LIST_CSV    ? particle_list_read_csv(l, path, head)
               : format == LIST_HDF5 ? hdf5_read(l, path)
                                     : particle_list_read_exodus(l, path);
    if (s != OK) particle_list_free(l);
    return s;
}

status particle_list_read(struct particle_list *l, const char *path, const struct particle_list_form *form, int dim)
{
    return list_read(l, path, form, dim, false);
}

status particle_list_read_column_names(struct particle_list_head *head, const char *path,
                                       const struct particle_list_form *form, int dim)
{
    struct particle_list l;
    TRY(list_read(&l, path, form, dim, true));
    *head = l.head;
    particle_list_free(&l);
    return OK;
}
