/* Reads lists of particles from CSV and HDF5 files; every refusal names the line or entry. */
#include "scene/particle_list.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/last_words.h"
#include "base/memory.h"
#include "base/team.h"
#include "csv.h"

enum { PARTICLES_MAX = INT32_MAX - 64 };

/* Columns of a list; coordinates come first. */
enum column { COLUMN_X, COLUMN_Y, COLUMN_Z, COLUMN_VOLUME, COLUMN_MATERIAL, COLUMN_BODY, COLUMNS };
static const char *const column_name[COLUMNS] = {"x", "y", "z", "volume", "material", "body"};

static real **column_array(struct particle_list *l, int column)
{
    switch (column) {
    case COLUMN_VOLUME: return &l->volume;
    case COLUMN_MATERIAL: return &l->material;
    case COLUMN_BODY: return &l->body;
    default: return &l->X[column];
    }
}

static bool column_needed(int column, int dim) { return column < dim || column == COLUMN_VOLUME; }

void particle_list_free(struct particle_list *l)
{
    for (int c = 0; c < COLUMNS; c++) memory_free(*column_array(l, c));
    memory_free(l->line);
    *l = (struct particle_list){0};
}

/* Fault of a value in a column, as the end of a sentence; NULL: none. */
static const char *value_fault(int column, real value)
{
    if (!isfinite(value)) return "is not a finite number";
    if (column == COLUMN_VOLUME && value <= 0) return "must be larger than 0";
    if (column >= COLUMN_MATERIAL && (value < 0 || value > UINT8_MAX || value != floor(value)))
        return "must be a whole number from 0 to 255";
    return NULL;
}

enum { PARTICLE_NUMBERS = 40 };     /* memory of a particle of a run without its bonds [numbers] */

/* REFUSED if n particles of a run need more memory than the machine has. */
static status list_affordable(const char *path, int64_t n)
{
    const real bytes = (real)n * PARTICLE_NUMBERS * sizeof(real);
    if (team_memory() <= 0 || bytes <= (real)team_memory()) return OK;
    return status_set(REFUSED, "%s: %.3g particles need more than %.2g GB, and %.2g can be had (%s)", path, (real)n,
                      1e-9 * bytes, 1e-9 * (real)team_memory(), team_memory_limit());
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

struct csv {
    struct csv_file in;
    int columns, column[COLUMNS];        /* enum column of each field of a line */
    int64_t room;
};

/* What a header that is no list of names between commas is likely to be, as the end of a sentence. */
static const char *header_guess(const char *name)
{
    if (strchr(name, '\r')) return "; its lines end in carriage returns alone, line feeds are expected";
    if (strpbrk(name, ";\t\"'")) return "; names without quotes, with commas between them, are expected";
    return "";
}

/* Appends a column named in the header. REFUSED if the name is unknown or given twice. */
static status csv_column(struct csv *c, const char *name, int dim)
{
    for (int k = 0; k < COLUMNS; k++) {
        if (strcmp(name, column_name[k]) != 0 || (k < DIM_MAX && k >= dim)) continue;
        for (int used = 0; used < c->columns; used++)
            if (c->column[used] == k)
                return csv_fault(&c->in, name, "column %s is named twice", name);
        c->column[c->columns++] = k;
        return OK;
    }
    return csv_fault(&c->in, name, "unknown column '%.*s'; in %dD a list has %s, volume, material, body%s",
                     (int)strcspn(name, "\r") < 40 ? (int)strcspn(name, "\r") : 40, name, dim,
                     dim == 1 ? "x" : dim == 2 ? "x, y" : "x, y, z", header_guess(name));
}

/* Reads the header. REFUSED if a required column is missing. */
static status csv_header(struct csv *c, int dim)
{
    bool more;
    TRY(csv_line(&c->in, &more));
    if (!more) return status_set(REFUSED, "%s: empty; the first line names the columns: x,y,z,volume", c->in.path);
    char *rest = c->in.text;
    for (char *name; (name = csv_field(&c->in, &rest)) != NULL;) TRY(csv_column(c, name, dim));
    for (int k = 0; k < COLUMNS; k++) {
        bool found = !column_needed(k, dim);
        for (int used = 0; used < c->columns; used++) found = found || c->column[used] == k;
        if (!found)
            return csv_fault(&c->in, c->in.text, "column %s is missing", column_name[k]);
    }
    return OK;
}

/* Makes room for one more entry, doubling. */
static status csv_grow(struct csv *c, struct particle_list *l)
{
    if (l->n < c->room) return OK;
    int64_t room = c->room > 0 ? 2 * c->room : 1024;
    TRY(list_affordable(c->in.path, room / 2));
    for (int k = 0; k < c->columns; k++) {
        real **array = column_array(l, c->column[k]);
        *array = memory_resize("list.column", *array, c->room, room, sizeof(real));
    }
    l->line = memory_resize("list.line", l->line, c->room, room, sizeof *l->line);
    c->room = room;
    return OK;
}

/* Reads one particle from the current line. */
static status csv_entry(struct csv *c, struct particle_list *l)
{
    char *rest = c->in.text;
    for (int k = 0; k < c->columns; k++) {
        char *field = csv_field(&c->in, &rest), *end;
        if (field == NULL)
            return csv_fault(&c->in, c->in.text, "%d values; the header names %d columns", k, c->columns);
        real value = strtod(field, &end);
        const char *name = column_name[c->column[k]];
        if (end == field || *end != '\0' || strpbrk(field, "xX"))
            return csv_fault(&c->in, field, "%s: '%.40s' is not a number", name, field);
        const char *fault = value_fault(c->column[k], value);
        if (fault != NULL) return csv_fault(&c->in, field, "%s: %.40s %s", name, field, fault);
        (*column_array(l, c->column[k]))[l->n] = value;
    }
    if (rest != NULL)
        return csv_fault(&c->in, rest,
                         "more values than the %d columns of the header; numbers have a point, not a comma",
                         c->columns);
    l->line[l->n++] = c->in.line;
    return OK;
}

static status csv_entries(struct csv *c, struct particle_list *l)
{
    TRY(csv_header(c, l->dim));
    for (bool more;;) {
        TRY(csv_line(&c->in, &more));
        if (!more) return OK;
        if (l->n >= PARTICLES_MAX) return status_set(REFUSED, "%s: more than %d particles", c->in.path, PARTICLES_MAX);
        TRY(csv_grow(c, l));
        TRY(csv_entry(c, l));
    }
}

static status csv_read(struct particle_list *l, const char *path)
{
    struct csv c = {0};
    TRY(csv_open(&c.in, path, "a particle list has one particle a line"));
    status s = csv_entries(&c, l);
    csv_close(&c.in);
    return s;
}

/* ---- HDF5 -------------------------------------------------------------------------------------------------------- */

/* A dataset as columns of numbers. */
struct table {
    int64_t rows, columns;
    real *value;                         /* row major */
};

/* Shape of a dataset; false unless it is a list of numbers with at most PARTICLES_MAX rows and DIM_MAX columns. */
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

/* Most rows per byte of the file: gzip does not compress equal numbers further. Bounds the memory that a small file
 * claims. */
enum { ROWS_PER_BYTE_MOST = 1024 };

/* REFUSED if a dataset claims more rows than its file can hold or the memory allows. */
static status table_check(const struct table *t, const char *path, const char *name)
{
    struct stat about;
    if (stat(path, &about) != 0 || t->rows / ROWS_PER_BYTE_MOST > about.st_size)
        return status_set(REFUSED, "%s: %s claims %lld entries, more than a file of its size holds", path, name,
                          (long long)t->rows);
    return list_affordable(path, t->rows);
}

/* True if the numbers of a dataset are in this file, not in external or virtual ones. */
static bool lies_inside(hid_t set)
{
    hid_t made = H5Dget_create_plist(set);
    const bool inside = H5Pget_layout(made) != H5D_VIRTUAL && H5Pget_external_count(made) == 0;
    H5Pclose(made);
    return inside;
}

/* True if `name` is a soft or external link; the link is not followed. */
static bool is_linked(hid_t file, const char *name)
{
    H5L_info_t link;
    return H5Lget_info(file, name, &link, H5P_DEFAULT) >= 0 && link.type != H5L_TYPE_HARD;
}

/* Reads a dataset of numbers into t->value, [rows][columns]; the caller frees it. REFUSED for links, for data in other
 * files, and for datasets that are no list of numbers. */
static status table_read(hid_t file, const char *path, const char *name, struct table *t)
{
    if (is_linked(file, name))
        return status_set(REFUSED, "%s: %s is a link; a dataset of this file is expected", path, name);
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0) return status_set(REFUSED, "%s: %s is not a dataset", path, name);
    bool good = table_shape(set, t);
    status checked = good ? table_check(t, path, name) : OK;
    if (good && !lies_inside(set)) checked = status_set(REFUSED, "%s: %s has its numbers in other files", path, name);
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
    return status_set(REFUSED, "%s: %s: cannot be read as one list of numbers", path, name);
}

/* Takes column k of a dataset as column `column` of the list. */
static status table_take(struct particle_list *l, int column, const struct table *t, int k, const char *path)
{
    real *array = NEW("list.column", l->n, real);
    *column_array(l, column) = array;
    for (int64_t i = 0; i < l->n; i++) {
        array[i] = t->value[i * t->columns + k];
        const char *fault = value_fault(column, array[i]);
        if (fault != NULL)
            return status_set(REFUSED, "%s: entry %lld: %s: %g %s", path, (long long)i, column_name[column], array[i],
                              fault);
    }
    return OK;
}

/* Reads a dataset as `count` columns of the list, from `column` on. The positions set the number of entries. */
static status hdf5_column(struct particle_list *l, hid_t file, const char *path, const char *name, int column,
                          int count)
{
    struct table t = {0};
    TRY(table_read(file, path, name, &t));
    status s = OK;
    if (column == COLUMN_X) l->n = t.rows;
    if (t.rows != l->n || t.columns != count)
        s = status_set(REFUSED, "%s: %s has %lld x %lld numbers; %lld x %d are wanted", path, name, (long long)t.rows,
                       (long long)t.columns, (long long)l->n, count);
    for (int k = 0; k < count && s == OK; k++) s = table_take(l, column + k, &t, k, path);
    memory_free(t.value);
    return s;
}

static status hdf5_columns(struct particle_list *l, hid_t file, const char *path)
{
    TRY(hdf5_column(l, file, path, "positions", COLUMN_X, l->dim));
    TRY(hdf5_column(l, file, path, "volumes", COLUMN_VOLUME, 1));
    if (H5Lexists(file, "material", H5P_DEFAULT) > 0)
        TRY(hdf5_column(l, file, path, "material", COLUMN_MATERIAL, 1));
    if (H5Lexists(file, "body", H5P_DEFAULT) > 0) TRY(hdf5_column(l, file, path, "body", COLUMN_BODY, 1));
    return OK;
}

/* Reads a list from an HDF5 file. A crash of the library on a damaged file is reported with the name of the file. */
static status hdf5_read(struct particle_list *l, const char *path)
{
    status s;
    last_words_reading(path);
    H5E_BEGIN_TRY                        /* one message per fault: the error stack of HDF5 is not printed */
    {
        hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        s = file < 0 ? status_set(REFUSED, "%s: not an HDF5 file", path) : hdf5_columns(l, file, path);
        if (file >= 0) H5Fclose(file);
    }
    H5E_END_TRY;
    last_words_reading(NULL);
    return s;
}

/* ---- choice of the format ---------------------------------------------------------------------------------------- */

static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

status particle_list_read(struct particle_list *l, const char *path, int dim)
{
    *l = (struct particle_list){.dim = dim};
    struct stat about;
    bool csv = ends_with(path, ".csv");
    bool hdf5 = ends_with(path, ".h5") || ends_with(path, ".hdf5") || ends_with(path, ".hdf");
    if (!csv && !hdf5) return status_set(REFUSED, "%s: a particle list is a .csv or an .h5 file", path);
    if (stat(path, &about) != 0) return status_set(REFUSED, "%s: there is no such file", path);
    if (!S_ISREG(about.st_mode)) return status_set(REFUSED, "%s: not a plain file", path);
    status s = csv ? csv_read(l, path) : hdf5_read(l, path);
    if (s != OK) particle_list_free(l);
    return s;
}
