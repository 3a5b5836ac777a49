/* Writes and checks particles files, HDF5 files with the data of particles that do not change from one output frame to
 * the next. */
#include "particles_file.h"

#include <string.h>

#include "base/memory.h"
#include "output/checksum.h"

enum { PARTICLES_VERSION = 1, VTK_VERTEX = 1 }; /* version of the format; VTK's type of a cell of one point */

/* Paths of the datasets, besides those of fields, that every output frame replaces by links to its particles file. */
static const char *const linked[] = {
    "/VTKHDF/NumberOfPoints",  "/VTKHDF/NumberOfCells",   "/VTKHDF/NumberOfConnectivityIds",
    "/VTKHDF/Connectivity",    "/VTKHDF/Offsets",         "/VTKHDF/Types",
    "/VTKHDF/FieldData/units", "/VTKHDF/FieldData/scene", "/Cleave/scene"};

void particles_file_compose_name(const struct frame_series *series, char *name, size_t capacity, int file_number)
{
    snprintf(name, capacity, "frames%s%s/particles_%06d.h5", series->name[0] ? "_" : "", series->name, file_number);
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

/* Returns true if field number k (FIELD_*) is in f, the particles file, because its values do not change from one
 * output frame to the next. */
static bool is_inside(const struct particles_file *f, int k) { return f->fields >> k & 1 && frame_fields[k].fixed; }

/* Returns the size of all rows of field number k (FIELD_*) in the particles file f [byte]. */
static size_t field_bytes(const struct particles_file *f, int k)
{
    return (size_t)f->n * frame_field_bytes_per_row(&frame_fields[k], f->dim);
}

void particles_file_collect_contents(struct particles_file *f, const struct frame_series *series,
                                     const struct frame_contents *source, unsigned field_bits, const char *scene_text)
{
    char units[1000];
    size_t length = 0;
    *f = (struct particles_file){
        .n = series->rows.n, .dim = source->p->dim, .fields = field_bits, .scene_text = scene_text};
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (is_inside(f, k)) length += field_bytes(f, k);
    f->rows = NEW("output.fixed", (int64_t)length, char);
    f->cells = NEW("output.cells", f->n + 1, int32_t);
    frame_fields_list_units_as_text(field_bits, units, sizeof units);
    uint64_t hash = bytes_hash(bytes_hash((uint64_t)f->n, units, strlen(units)), scene_text, strlen(scene_text));
    char *rows = f->rows;
    for (int k = 0; k < FRAME_FIELDS; k++) {
        if (!is_inside(f, k)) continue;
        frame_field_copy_particle_values_to_rows(&frame_fields[k], source, &series->rows, rows);
        hash = bytes_hash(hash, rows, field_bytes(f, k));
        rows += field_bytes(f, k);
    }
    f->content = (int64_t)hash;
}

void particles_file_free(struct particles_file *f)
{
    memory_free(f->rows), memory_free(f->cells);
    f->rows = NULL, f->cells = NULL;
}

/* Writes one of the lists that describe the VTK cells of the particles to h. list: which one (CELLS_*), such as their
 * offsets; of[entries]: its values, in the type of the list. */
static void particles_write_list(struct hdf *h, int list, int64_t entries, const void *of)
{
    hdf_write_rows_zero_padded(h, frame_cells[list].path, frame_cells[list].type, entries, 1, 1, of);
}

/* Writes the VTK cells of the particles file f to h, one vertex per particle: cell k consists of point k and starts at
 * entry k of the connectivity. */
static void particles_write_cells(struct hdf *h, const struct particles_file *f)
{
    for (int k = 0; k < 3; k++) hdf_write_rows(h, linked[k], HDF_I64, 1, 1, &f->n);
    for (int64_t k = 0; k <= f->n; k++) f->cells[k] = (int32_t)k;
    particles_write_list(h, CELLS_CONNECTIVITY, f->n, f->cells);
    particles_write_list(h, CELLS_OFFSETS, f->n + 1, f->cells);
    array_fill_bytes(f->cells, VTK_VERTEX, f->n, 1);
    particles_write_list(h, CELLS_TYPES, f->n, f->cells);
}

/* Writes the groups, attributes, texts, cells and fields of the particles file f to h. */
static void particles_write_contents(struct hdf *h, const struct particles_file *f)
{
    static const int32_t version = PARTICLES_VERSION;
    const char *rows = f->rows;
    char units[1000];
    frame_fields_list_units_as_text(f->fields, units, sizeof units);
    hdf_create_group(h, "/VTKHDF"), hdf_create_group(h, "/VTKHDF/PointData"), hdf_create_group(h, "/VTKHDF/FieldData");
    hdf_create_group(h, "/Cleave");
    hdf_write_scalar_attribute(h, "/Cleave", "version", HDF_I32, &version);
    hdf_write_scalar_attribute(h, "/Cleave", "content", HDF_I64, &f->content);
    hdf_write_text(h, "/Cleave/scene", f->scene_text);
    hdf_write_text_as_list_of_one_string(h, "/VTKHDF/FieldData/units", units);
    hdf_write_text_as_list_of_one_string(h, "/VTKHDF/FieldData/scene", f->scene_text);
    particles_write_cells(h, f);
    for (int k = 0; k < FRAME_FIELDS; k++) {
        if (!is_inside(f, k)) continue;
        frame_field_write(h, &frame_fields[k], f->n, f->dim, rows);
        rows += field_bytes(f, k);
    }
}

status particles_file_write(const struct particles_file *f, bool *hdf5_failed)
{
    struct hdf h;
    int64_t content = 0;
    if (!particles_file_find_fault_and_content_hash(f->path.text, &content) && content == f->content) return OK;
    hdf_create(&h, file_register_temporary_and_return_path(f->path.text).text, f->compress);
    particles_write_contents(&h, f);
    TRY(hdf_close_or_remove_if_write_failed(&h, f->path.text, hdf5_failed));
    TRY(file_append_checksum_footer(f->path.text));
    return file_replace_by_temporary(f->path.text);
}

void particles_file_link_fields_into_frame(struct hdf *frame, const struct particles_file *f, unsigned field_bits)
{
    const char *file = strrchr(f->path.text, '/') + 1;
    for (size_t k = 0; k < COUNT_OF(linked); k++) hdf_create_external_link(frame, linked[k], file);
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (field_bits >> k & 1 && frame_fields[k].fixed) hdf_create_external_link(frame, frame_fields[k].path, file);
    hdf_write_scalar_attribute(frame, "/Cleave", "content", HDF_I64, &f->content);
}

/* ---- checking ---------------------------------------------------------------------------------------------------- */

/* Reads the hash of the contents of the particles file `path` into *content_hash, 0 if the file is an output frame or
 * another file of a run. Returns false if the file cannot be read. */
bool particles_file_read_content_hash(const char *path, int64_t *content_hash)
{
    struct hdf h;
    char target[PATH_NAME_ROOM];
    *content_hash = 0;
    hdf_open_for_reading(&h, path);
    if (hdf_has_attribute(&h, "/Cleave", "content") &&
        !hdf_read_external_link_target(&h, "/VTKHDF/Types", target, sizeof target))
        hdf_read_attribute(&h, "/Cleave", "content", HDF_I64, content_hash);
    hdf_close(&h);
    return !h.failed;
}

const char *particles_file_find_fault_and_content_hash(const char *path, int64_t *content_hash)
{
    const char *fault = file_describe_damage(path);
    if (fault) return fault;
    return particles_file_read_content_hash(path, content_hash) ? NULL : "is not a particles file";
}

status frame_check_linked_particles_file(struct hdf *frame, const char *path)
{
    struct path file = {{0}};
    char name[PATH_NAME_ROOM];
    int64_t content = 0, found = 0;
    if (!hdf_read_external_link_target(frame, "/VTKHDF/Types", name, sizeof name)) return OK;
    hdf_read_attribute(frame, "/Cleave", "content", HDF_I64, &content);
    if (frame->failed || !name[0] || strchr(name, '/'))
        return status_set(FAILED, "cannot read %s; give a frame inside a results folder: frames/NNNNNN.hdf", path);
    const char *slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash + 1 - path) : 0;
    snprintf(file.text, sizeof file.text, "%.*s%s", folder, path, name);
    const char *fault = particles_file_find_fault_and_content_hash(file.text, &found);
    if (!fault && found != content) fault = "belongs to another run";
    if (!fault) return OK;
    return status_set(FAILED, "cannot read %s: the file %s in the same folder, to which it links, %s", path, name,
                      fault);
}
