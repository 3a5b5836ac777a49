/* Reads output frames and their times, for `cleave plot` and `cleave compare`. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/crash_message.h"
#include "base/memory.h"
#include "data/derived_fields.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/checksum.h"
#include "output/output_hdf5.h"
#include "particles_file.h"

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Largest plausible number of particles per byte of a frame: gzip compresses the 8-byte reference positions of
 * particles by less. The limit bounds the memory that a damaged file can request. */
enum { PARTICLES_PER_BYTE_MOST = 1024 };

/* Reads the dataset `name` of h, with n rows and `columns` columns. Copies its column from[k] to a new array out[k][n],
 * for k = 0 .. wanted - 1. The caller releases the arrays with memory_free. */
static void read_columns(struct hdf *h, const char *name, int64_t n, int columns, int wanted, const int *from,
                         float **out)
{
    float *data = NEW("frame.columns", n * columns, float);
    hdf_read_rows(h, name, HDF_F32, n * columns, data);
    for (int k = 0; k < wanted; k++) {
        out[k] = NEW("frame.field", n, float);
        for (int64_t i = 0; i < n; i++) out[k][i] = data[i * columns + from[k]];
    }
    memory_free(data);
}

/* Reads the reference positions of n particles in `dim` dimensions from h into new arrays X[dim][n] [m], which the
 * caller releases with memory_free. */
static void read_reference(struct hdf *h, int64_t n, int dim, real **X)
{
    double *data = NEW("frame.columns", n * dim, double);
    hdf_read_rows(h, "/Cleave/reference", HDF_F64, n * dim, data);
    for (int d = 0; d < dim; d++) {
        X[d] = NEW("frame.field", n, real);
        for (int64_t i = 0; i < n; i++) X[d][i] = data[i * dim + d];
    }
    memory_free(data);
}

static void *read_list(struct hdf *h, const char *name, enum hdf_type type, int64_t n)
{
    void *data = memory_new("frame.list", n, hdf_type_size(type));
    hdf_read_rows(h, name, type, n, data);
    return data;
}

/* Reads all fields of an output frame from the file h into new arrays of f. Stress components are in the order of
 * struct particles (xx yy xy in 2D, xx yy zz xy yz xz in 3D); in plane spaces zz follows as the last one. */
static void read_fields(struct output_frame *f, struct hdf *h)
{
    static const int plain[] = {0, 1, 2, 3, 4, 5}, plane[] = {0, 1, 3, 2};
    int dim = f->dim;
    read_reference(h, f->n, dim, f->X);
    read_columns(h, "/VTKHDF/PointData/displacement", f->n, 3, dim, plain, f->u);
    read_columns(h, "/VTKHDF/PointData/velocity", f->n, 3, dim, plain, f->v);
    read_columns(h, "/VTKHDF/PointData/stress", f->n, 6, frame_stress_component_count(dim), dim == 2 ? plane : plain,
                 f->stress);
    f->damage = read_list(h, "/VTKHDF/PointData/damage", HDF_F32, f->n);
    f->kind = read_list(h, "/VTKHDF/PointData/kind", HDF_U8, f->n);
    f->material = read_list(h, "/VTKHDF/PointData/material", HDF_U8, f->n);
    f->body = read_list(h, "/VTKHDF/PointData/body", HDF_U8, f->n);
    f->id = read_list(h, "/VTKHDF/PointData/id", HDF_I32, f->n);
    if (hdf_dataset_element_count(h, "/VTKHDF/PointData/fragment") >= 0)
        f->fragment = read_list(h, "/VTKHDF/PointData/fragment", HDF_I32, f->n);
    if (hdf_dataset_element_count(h, "/VTKHDF/PointData/spacing") >= 0)
        f->spacing = read_list(h, "/VTKHDF/PointData/spacing", HDF_F32, f->n);
}

/* Reads dimension, time, step and number of particles of an output frame from the file h into f. Values out of range
 * are recorded as a fault of the file. bytes: size of the file. */
static void read_size(struct output_frame *f, struct hdf *h, int64_t bytes)
{
    int32_t dim = 0;
    hdf_read_attribute(h, "/Cleave", "dim", HDF_I32, &dim);
    hdf_read_attribute(h, "/Cleave", "time", HDF_F64, &f->t);
    hdf_read_attribute(h, "/Cleave", "step", HDF_I64, &f->step);
    if (h->failed) return;
    int64_t n = hdf_dataset_element_count(h, "/VTKHDF/Types");
    if (dim < 1 || dim > DIM_MAX || n < 0 || n > INT32_MAX || n / PARTICLES_PER_BYTE_MOST > bytes) h->failed = true;
    f->dim = dim;
    f->n = n;
}

status frame_read(struct output_frame *f, const char *path)
{
    struct hdf h;
    struct stat s;
    *f = (struct output_frame){0};
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode))
        return status_set(FAILED, "cannot read %s, because there is no such file; check the name", path);
    const char *fault = file_describe_damage(path);
    if (fault) return status_set(FAILED, "cannot read %s: it %s", path, fault);
    crash_message_set_file_in_use(path);
    hdf_open_for_reading(&h, path);
    const status linked = h.failed ? OK : frame_check_linked_particles_file(&h, path);
    if (linked == OK && !h.failed) read_size(f, &h, s.st_size);
    if (linked == OK && !h.failed) read_fields(f, &h);
    bool whole = !h.failed;
    hdf_close(&h);
    crash_message_set_file_in_use(NULL);
    if (whole && linked == OK) return OK;
    frame_free(f);
    return linked == OK
               ? status_set(FAILED, "cannot read %s, which is damaged, or not a frame of Cleave; run the scene again",
                            path)
               : linked;
}

void frame_free(struct output_frame *f)
{
    for (int d = 0; d < DIM_MAX; d++) {
        memory_free(f->X[d]);
        memory_free(f->u[d]);
        memory_free(f->v[d]);
    }
    for (int k = 0; k < SYM_MAX; k++) memory_free(f->stress[k]);
    memory_free(f->damage);
    memory_free(f->kind);
    memory_free(f->material);
    memory_free(f->body);
    memory_free(f->id);
    memory_free(f->fragment);
    memory_free(f->spacing);
    *f = (struct output_frame){0};
}

/* ---- one field by name ------------------------------------------------------------------------------------------- */

/* Copies the quantity of particle i of output frame f from which a derived field is computed, stress or velocity as
 * `from` selects, to row[SYM_MAX]. Components that the space does not have are 0. */
static void source_row(const struct output_frame *f, enum derived_from from, int64_t i, real *row)
{
    static const int plane[] = {0, 1, 3, 2}, plain[] = {0, 1, 2, 3, 4, 5}; /* order of read_fields */
    memset(row, 0, SYM_MAX * sizeof *row);
    if (from == FROM_VELOCITY)
        for (int d = 0; d < f->dim; d++) row[d] = f->v[d][i];
    else
        for (int k = 0; k < frame_stress_component_count(f->dim); k++)
            row[(f->dim == 2 ? plane : plain)[k]] = f->stress[k][i];
}

static float *derive_field(const struct output_frame *f, const struct derived_field *field)
{
    float *value = NEW("frame.derived", f->n * field->columns, float);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < f->n; i++) {
        real from[SYM_MAX], to[DERIVED_MOST];
        source_row(f, field->from, i, from);
        field->compute(from, to);
        for (int c = 0; c < field->columns; c++) value[i * field->columns + c] = (float)to[c];
    }
    return value;
}

/* Largest accepted number of components of a field, a guard against damaged files. */
enum { COLUMNS_MOST = 16 };

status frame_field_read(const struct output_frame *f, const char *path, const char *name, int *component_count,
                        float **value)
{
    char place[PATH_NAME_ROOM];
    struct hdf h;
    const struct derived_field *derived = derived_field_find_by_name(name);
    *value = NULL, *component_count = 0;
    if (derived) {
        *component_count = derived->columns, *value = derive_field(f, derived);
        return OK;
    }
    snprintf(place, sizeof place, "/VTKHDF/PointData/%s", name);
    crash_message_set_file_in_use(path);
    hdf_open_for_reading(&h, path);
    const bool zero = strcmp(name, "contact_force") == 0 && hdf_has_attribute(&h, "/Cleave", "zero");
    const int64_t count = strchr(name, '/') ? -1 : hdf_dataset_element_count(&h, place), most = f->n * COLUMNS_MOST;
    if (zero) *component_count = DIM_MAX, *value = NEW("frame.field", f->n * DIM_MAX, float);
    if (count > 0 && count <= most && count % f->n == 0) {
        *component_count = (int)(count / f->n), *value = NEW("frame.field", count, float);
        hdf_read_rows(&h, place, HDF_F32, count, *value);
    }
    const bool whole = !h.failed && *value;
    hdf_close(&h);
    crash_message_set_file_in_use(NULL);
    if (whole) return OK;
    memory_free(*value);
    *value = NULL;
    return status_set(FAILED, "%s has no field %s; for new runs, `output: {fields: [%s]}` adds it", path, name, name);
}

/* ---- times of frames --------------------------------------------------------------------------------------------- */

/* Reads one entry of the text of frames.hdf.series, from *at on, into f, and sets *at to the text after it. Returns
 * false if there is no further entry. */
static bool next_frame(const char **at, struct listed_frame *f)
{
    static const char name[] = "frames/", key[] = "\"time\":";
    const char *number = strstr(*at, name), *time = number ? strstr(number, key) : NULL;
    char *end = NULL;
    if (!time) return false;
    const long read = strtol(number + sizeof name - 1, NULL, 10);
    f->number = read >= 0 && read < INT32_MAX ? (int)read : INT32_MAX;
    f->time = strtod(time + sizeof key - 1, &end);
    *at = end;
    return end > time + sizeof key - 1;
}

status run_list_frames(const char *folder, int *frame_count, struct listed_frame **frames)
{
    struct path path = path_join(folder, "frames.hdf.series");
    char *text = NULL;
    size_t length = 0;
    struct listed_frame f;
    *frame_count = 0;
    *frames = NULL;
    if (!path_exists(path.text))
        return status_set(FAILED,
                          "%s contains no frames (no frames.hdf.series); give the folder of a run, which cleave run "
                          "prints at its end",
                          folder);
    TRY(file_read_whole(path.text, &text, &length));
    int count = 0;
    for (const char *at = text; next_frame(&at, &f);) count++;
    *frames = NEW("frames.list", count, struct listed_frame);
    for (const char *at = text; *frame_count < count && next_frame(&at, &(*frames)[*frame_count]);) ++*frame_count;
    memory_free(text);
    if (count > 0) return OK;
    memory_free(*frames);
    *frames = NULL;
    return status_set(FAILED, "%s lists no frames", path.text);
}
