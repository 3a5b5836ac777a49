/* Reads arrays of Exodus II files, of both forms of netCDF. Counts are compared with the length of the file before
 * memory is allocated. */
#include "geometry/exodus_file.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <strings.h>

#include "base/memory.h"
#include "exodus_parts.h"
#include "source.h"

/* Largest size of an array divided by the size of its netCDF-4 file [1]: gzip compresses equal numbers by at most this
 * factor. */
enum { UNPACKED_MOST = 1024 };

status exodus_set_message_and_return_refused(const struct exodus_file *f, const char *format, ...)
{
    char what[256];
    va_list more;
    va_start(more, format);
    vsnprintf(what, sizeof what, format, more);
    va_end(more);
    text_replace_control_characters(what);
    return status_set(REFUSED, "%s: %s", f->path, what);
}

bool path_has_exodus_extension(const char *path)
{
    static const char *const endings[] = {".exo", ".e", ".ex2", ".exii", ".g", ".gen"};
    const char *point = strrchr(path, '.');
    for (size_t k = 0; k < COUNT_OF(endings) && point && point > path; k++)
        if (strcasecmp(point, endings[k]) == 0) return true;
    return false;
}

/* ---- the file ---------------------------------------------------------------------------------------------------- */

/* Opens the file f as netCDF-4 (HDF5) or classic netCDF, by its first bytes. Returns REFUSED, with a message, if it is
 * neither. */
static status arrays_open(struct exodus_file *f)
{
    static const char hdf5[] = "\211HDF\r\n\032\n";
    const uint8_t *text = f->text;
    if (f->length >= 8 && memcmp(text, hdf5, 8) == 0) return exodus_hdf5_open(f);
    if (f->length >= 8 && memcmp(text, "CDF", 3) == 0 && (text[3] == 1 || text[3] == 2 || text[3] == 5))
        return exodus_classic_open(f);
    return exodus_set_message_and_return_refused(
        f, "does not begin like a netCDF file; give a file in the format Exodus II");
}

/* Reads the dimension and the numbers of nodes, blocks and sets, which every mesh has, into f. Returns REFUSED, with a
 * message, if they are not those of a mesh. */
static status counts_read(struct exodus_file *f)
{
    const int64_t dim = exodus_read_dimension_length(f, "num_dim", 0);
    f->nodes = exodus_read_dimension_length(f, "num_nodes", 0);
    f->blocks = exodus_read_dimension_length(f, "num_el_blk", 0);
    f->node_sets = exodus_read_dimension_length(f, "num_node_sets", 0);
    f->side_sets = exodus_read_dimension_length(f, "num_side_sets", 0);
    f->element_sets = exodus_read_dimension_length(f, "num_elem_sets", 0);
    f->dim = (int)dim;
    if (dim >= 1 && dim <= DIM_MAX && f->nodes >= 1) return OK;
    return exodus_set_message_and_return_refused(
        f,
        "this netCDF file has num_dim = %lld and num_nodes = %lld, so it is not a mesh; give "
        "one in the format Exodus II",
        (long long)dim, (long long)f->nodes);
}

status exodus_open_from_memory(struct exodus_file *f, const char *path, const char *content, int64_t length)
{
    *f = (struct exodus_file){.path = path, .text = (const uint8_t *)content, .length = length, .hdf5 = -1};
    status s = arrays_open(f);
    if (s == OK) s = counts_read(f);
    if (s != OK) exodus_close(f);
    return s;
}

status exodus_open_from_path(struct exodus_file *f, const char *path)
{
    struct geometry_file s;
    TRY(geometry_file_read_whole(&s, path));
    const status opened = exodus_open_from_memory(f, path, s.text, s.length);
    if (opened == OK)
        f->owned = s.text;
    else
        geometry_file_close(&s);
    return opened;
}

void exodus_close(struct exodus_file *f)
{
    memory_free(f->owned);
    if (f->hdf5 >= 0) exodus_hdf5_close(f);
    memory_free(f->dimension);
    memory_free(f->array);
    f->dimension = NULL, f->array = NULL, f->owned = NULL, f->hdf5 = -1;
}

/* ---- arrays ------------------------------------------------------------------------------------------------------ */

/* Writes `name` followed by `number` to text[NAME_MAX_LENGTH]; `name` alone if the number is 0. */
static void name_numbered(char *text, const char *name, int64_t number)
{
    if (number > 0)
        snprintf(text, NAME_MAX_LENGTH, "%s%lld", name, (long long)number);
    else
        snprintf(text, NAME_MAX_LENGTH, "%s", name);
}

int64_t exodus_read_dimension_length(const struct exodus_file *f, const char *name, int64_t name_suffix)
{
    char called[NAME_MAX_LENGTH];
    name_numbered(called, name, name_suffix);
    if (f->hdf5 >= 0) return exodus_hdf5_length_of_dimension(f, called);
    for (int64_t k = 0; k < f->dimensions; k++)
        if (strcmp(f->dimension[k].name, called) == 0) return f->dimension[k].length;
    return 0;
}

/* Finds the array `name` of the file f and describes it in *a. Returns false if there is no such array. */
static bool array_find(const struct exodus_file *f, const char *name, struct exodus_array *a)
{
    if (f->hdf5 >= 0) return exodus_hdf5_find_array(f, name, a);
    for (int64_t k = 0; k < f->arrays; k++)
        if (strcmp(f->array[k].name, name) == 0) {
            *a = f->array[k];
            return true;
        }
    return false;
}

bool exodus_has_array(const struct exodus_file *f, const char *name, int64_t name_suffix)
{
    char called[NAME_MAX_LENGTH];
    struct exodus_array a;
    name_numbered(called, name, name_suffix);
    return array_find(f, called, &a);
}

/* Finds the array `name` of the file f and describes it in *a. Returns REFUSED, with a message, if it is missing, does
 * not have n numbers, contains letters, or is larger than its file can be. */
static status array_check(const struct exodus_file *f, const char *name, int64_t n, struct exodus_array *a)
{
    if (!array_find(f, name, a))
        return exodus_set_message_and_return_refused(f, "the array %s is missing; write the file again", name);
    if (a->type == EXODUS_CHAR)
        return exodus_set_message_and_return_refused(
            f, "array %s contains letters in place of numbers; write the file again", name);
    if (a->extent[0] * a->extent[1] != n)
        return exodus_set_message_and_return_refused(
            f, "array %s has %lld x %lld numbers, but must have %lld; write the file again", name,
            (long long)a->extent[0], (long long)a->extent[1], (long long)n);
    if (f->hdf5 < 0 || n <= f->length * UNPACKED_MOST) return OK;
    return exodus_set_message_and_return_refused(
        f,
        "array %s claims %lld numbers, more than the file can contain, so it is cut off or "
        "damaged; write the file again",
        name, (long long)n);
}

/* Reads the array called `name` followed by `number` (n numbers) from the file f into the new array *reals or
 * *integers; one of these two pointers must be NULL. The caller releases it with memory_free. Returns REFUSED, with
 * nothing allocated, if the array is missing or has another size, or the file is damaged. */
static status array_read(const struct exodus_file *f, const char *name, int64_t number, int64_t n, real **reals,
                         int64_t **integers)
{
    char called[NAME_MAX_LENGTH];
    struct exodus_array a;
    name_numbered(called, name, number);
    if (reals) *reals = NULL;
    if (integers) *integers = NULL;
    TRY(array_check(f, called, n, &a));
    real *real_value = reals ? NEW("exodus.numbers", n, real) : NULL;
    int64_t *whole_value = integers ? NEW("exodus.numbers", n, int64_t) : NULL;
    status s = OK;
    if (f->hdf5 < 0)
        exodus_classic_read_array(f, &a, n, real_value, whole_value);
    else if (n > 0 && !exodus_hdf5_read_array(f, &a, real_value, whole_value, NULL))
        s = exodus_set_message_and_return_refused(
            f, "array %s cannot be read, because the file is damaged; write it again", called);
    for (int64_t k = 0; k < n && s == OK && real_value; k++)
        if (!isfinite(real_value[k]))
            s = exodus_set_message_and_return_refused(
                f, "array %s: number %lld is infinite or not a number; correct it", called, (long long)k + 1);
    if (s != OK) {
        memory_free(real_value), memory_free(whole_value);
        return s;
    }
    if (reals) *reals = real_value;
    if (integers) *integers = whole_value;
    return OK;
}

status exodus_read_reals(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t count,
                         real **value)
{
    return array_read(f, name, name_suffix, count, value, NULL);
}

status exodus_read_integers(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t count,
                            int64_t **value)
{
    return array_read(f, name, name_suffix, count, NULL, value);
}

status exodus_read_coordinates(const struct exodus_file *f, real *coordinates[DIM_MAX])
{
    static const char *const names[DIM_MAX] = {"coordx", "coordy", "coordz"};
    real *all;
    if (!exodus_has_array(f, "coord", 0)) {
        for (int d = 0; d < f->dim; d++) TRY(exodus_read_reals(f, names[d], 0, f->nodes, &coordinates[d]));
        return OK;
    }
    TRY(exodus_read_reals(f, "coord", 0, f->nodes * f->dim, &all)); /* as in files of the first versions */
    for (int d = 0; d < f->dim; d++) {
        coordinates[d] = NEW("exodus.numbers", f->nodes, real);
        array_copy(coordinates[d], all + d * f->nodes, f->nodes, sizeof *all);
    }
    memory_free(all);
    return OK;
}

void exodus_read_text_row(const struct exodus_file *f, const char *name, int64_t name_suffix, int64_t row,
                          int64_t row_count, char *text)
{
    char called[NAME_MAX_LENGTH], *all = NULL;
    struct exodus_array a;
    text[0] = '\0';
    name_numbered(called, name, name_suffix);
    if (!array_find(f, called, &a) || a.type != EXODUS_CHAR || a.extent[0] != row_count) return;
    const int64_t length = a.extent[1];
    const char *from = f->hdf5 < 0 ? (const char *)f->text + a.at + row * length : NULL;
    if (!from && row_count * length <= f->length * UNPACKED_MOST) {
        all = NEW("exodus.names", row_count * length, char);
        if (exodus_hdf5_read_array(f, &a, NULL, NULL, all)) from = all + row * length;
    }
    if (from) snprintf(text, LONG_NAME_LENGTH, "%.*s", (int)length, from);
    memory_free(all);
    exodus_text_make_printable(text);
}

status exodus_read_block_header(const struct exodus_file *f, int64_t block_number, char *type, int64_t *element_count,
                                int64_t *nodes_per_element)
{
    char called[NAME_MAX_LENGTH];
    struct exodus_array a;
    name_numbered(called, "connect", block_number);
    if (!array_find(f, called, &a) || a.type == EXODUS_CHAR)
        return exodus_set_message_and_return_refused(
            f, "block %lld lacks the array %s, the nodes of its elements; add the array, or remove the block",
            (long long)block_number, called);
    if (!a.elements[0])
        return exodus_set_message_and_return_refused(
            f, "block %lld does not name the type of its elements; add the attribute elem_type to the variable %s",
            (long long)block_number, called);
    *element_count = a.extent[0], *nodes_per_element = a.extent[1];
    memcpy(type, a.elements, NAME_MAX_LENGTH);
    for (char *c = type; *c; c++) *c = (char)toupper((unsigned char)*c);
    return OK;
}
