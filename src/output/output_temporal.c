/* Writes all frames of a run as one temporal file for ParaView 5.12 and later: frames.vtkhdf, an UnstructuredGrid of
 * VTKHDF 2.
 *
 * Its datasets are virtual: they concatenate the rows of all frames, which stay in their own files, so that no crash
 * damages them. The group Steps stores where each time begins (docs.vtk.org, VTKHDF specification, "Temporal data"):
 * each time is one part; its points, cells and connectivity begin at the number of preceding points, and its part of
 * Offsets, which has one entry more than cells, begins one entry later per preceding part. */
#include "output_fields.h"
#include "output_index.h"

#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "particles_file.h"

/* Largest number of frames in a temporal file. With more, opening its virtual datasets takes longer than opening the
 * frames. */
enum { TEMPORAL_MOST = 2000 };

/* Contents of a temporal file while it is written: the output frames of one series and their fields. Owns its
 * arrays. */
struct temporal {
    const char *folder;            /* folder of the run */
    int n;                         /* number of times */
    real *time;                    /* [n] times of the frames [s] */
    char (*frame)[PATH_NAME_ROOM], /* [n] paths of the frames and of their particles files, relative to the run's folder
                                    */
        (*particles)[PATH_NAME_ROOM];
    uint32_t *has;   /* [n] bit set of the fields of each frame */
    int64_t *start;  /* [n] number of points in all preceding frames */
    unsigned fields; /* bit set of the fields that all frames have, and contact forces if any frame has them */
    struct hdf_source *source; /* [n] scratch; its numbers of rows are those of the frames */
};

/* Lists in *a the output frames of a series (of the whole run or of one region) whose files exist, with their
 * particles files, and the fields that all of these frames have. Contact forces are listed if at least one frame has
 * them. */
static void frames_look(struct temporal *a, const struct frame_series *series)
{
    unsigned all = (1u << FRAME_FIELDS) - 1, any = 0;
    for (int k = 0; k < series->frames; k++) {
        const struct frame_entry *e = &series->entry[k];
        frame_compose_file_name(series, a->frame[a->n], sizeof a->frame[a->n], k);
        if (e->fields & FRAME_LOST || !path_is_file(path_join(a->folder, a->frame[a->n]).text)) continue;
        particles_file_compose_name(series, a->particles[a->n], sizeof a->particles[a->n], e->particles);
        a->time[a->n] = e->time, a->has[a->n] = e->fields, a->source[a->n].rows = e->rows;
        a->start[a->n] = a->n > 0 ? a->start[a->n - 1] + a->source[a->n - 1].rows : 0;
        all &= e->fields, any |= e->fields;
        a->n++;
    }
    a->fields = all | (any & 1u << FIELD_CONTACT);
}

/* Writes the group Steps of `hdf`, the file of all output frames for VTK: the times of the frames of a, and where the
 * data of each frame begin in the arrays. number: working memory of n entries, n being the number of frames. */
static void write_steps(struct hdf *hdf, const struct temporal *a, int64_t *number)
{
    static const char *const start[] = {"PointOffsets", "CellOffsets", "ConnectivityIdOffsets"};
    const int32_t steps = a->n;
    char name[PATH_NAME_ROOM];
    double *time = (void *)number;
    hdf_create_group(hdf, "/VTKHDF/Steps");
    hdf_write_scalar_attribute(hdf, "/VTKHDF/Steps", "NSteps", HDF_I32, &steps);
    for (int k = 0; k < a->n; k++) time[k] = a->time[k];
    hdf_write_rows(hdf, "/VTKHDF/Steps/Values", HDF_F64, a->n, 1, time);
    for (int k = 0; k < a->n; k++) number[k] = k;
    hdf_write_rows(hdf, "/VTKHDF/Steps/PartOffsets", HDF_I64, a->n, 1, number);
    for (int k = 0; k < a->n; k++) number[k] = 1;
    hdf_write_rows(hdf, "/VTKHDF/Steps/NumberOfParts", HDF_I64, a->n, 1, number);
    for (int s = 0; s < 3; s++) {
        snprintf(name, sizeof name, "/VTKHDF/Steps/%s", start[s]);
        hdf_write_rows(hdf, name, HDF_I64, a->n, 1, a->start);
    }
    hdf_create_group(hdf, "/VTKHDF/Steps/PointDataOffsets");
    for (int field = FIELD_POINTS + 1; field < FRAME_FIELDS; field++) {
        if (!(a->fields >> field & 1) || frame_fields[field].columns == 0) continue;
        snprintf(name, sizeof name, "/VTKHDF/Steps/PointDataOffsets/%s", strrchr(frame_fields[field].path, '/') + 1);
        hdf_write_rows(hdf, name, HDF_I64, a->n, 1, a->start);
    }
}

/* Writes a virtual dataset to `hdf` that concatenates `field` of all output frames of a. needed: bits of the fields
 * without which a frame does not contain the dataset, 0 if every frame contains it; the rows of frames that lack a
 * needed field read as 0. more: number of rows in each frame beyond its number of points. */
static void write_virtual(struct hdf *hdf, const struct temporal *a, const struct frame_field *field, uint32_t needed,
                          int more)
{
    for (int k = 0; k < a->n; k++) {
        const char *file = field->fixed ? a->particles[k] : a->frame[k];
        a->source[k].file = (a->has[k] & needed) == needed ? file : NULL;
    }
    hdf_write_virtual_dataset(hdf, field->path, field->type, field->columns, a->source, a->n, more);
}

/* Writes points, cells and fields of all output frames of a to `hdf` as virtual datasets. number: working memory with
 * an entry for each frame. */
static void write_rows(struct hdf *hdf, const struct temporal *a, int64_t *number)
{
    static const char *const count[] = {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"};
    char name[PATH_NAME_ROOM];
    for (int k = 0; k < a->n; k++) number[k] = a->source[k].rows;
    for (int c = 0; c < 3; c++) {
        snprintf(name, sizeof name, "/VTKHDF/%s", count[c]);
        hdf_write_rows(hdf, name, HDF_I64, a->n, 1, number);
    }
    for (int c = 0; c < CELL_LISTS; c++) write_virtual(hdf, a, &frame_cells[c], 0, c == CELLS_OFFSETS);
    hdf_create_group(hdf, "/VTKHDF/PointData");
    for (int k = 0; k < FRAME_FIELDS; k++) {
        const struct frame_field *field = &frame_fields[k];
        if (!(a->fields >> k & 1) || field->columns == 0) continue;
        write_virtual(hdf, a, field, 1u << k, 0);
        hdf_write_text_attribute(hdf, field->path, "unit", field->unit[0] ? field->unit : "1");
    }
}

/* Writes the units of the fields of a and scene_text, the text of the input file (scene), to `hdf` as field data that
 * all times share. number: working memory with two entries for each output frame. */
static void write_texts(struct hdf *hdf, const struct temporal *a, const char *scene_text, int64_t *number)
{
    static const char *const name[] = {"units", "scene"};
    char units[1000], path[PATH_NAME_ROOM];
    frame_fields_list_units_as_text(a->fields, units, sizeof units);
    const char *const text[] = {units, scene_text};
    hdf_create_group(hdf, "/VTKHDF/FieldData");
    hdf_create_group(hdf, "/VTKHDF/Steps/FieldDataOffsets");
    hdf_create_group(hdf, "/VTKHDF/Steps/FieldDataSizes");
    for (int k = 0; k < 2; k++) {
        snprintf(path, sizeof path, "/VTKHDF/FieldData/%s", name[k]);
        hdf_write_text_as_list_of_one_string(hdf, path, text[k]);
        for (int step = 0; step < a->n; step++) number[step] = 0;
        snprintf(path, sizeof path, "/VTKHDF/Steps/FieldDataOffsets/%s", name[k]);
        hdf_write_rows(hdf, path, HDF_I64, a->n, 1, number);
        for (int step = 0; step < 2 * a->n; step++) number[step] = 1;
        snprintf(path, sizeof path, "/VTKHDF/Steps/FieldDataSizes/%s", name[k]);
        hdf_write_rows(hdf, path, HDF_I64, a->n, 2, number);
    }
}

/* Writes the file of all output frames of a for VTK under the temporary name of `path` and renames it. scene_text:
 * text of the input file (scene). Returns FAILED, with a message, on a fault. If HDF5 has failed, sets *broken to true
 * and removes the incomplete file. */
static status temporal_write(const struct temporal *a, const char *path, const char *scene_text, bool *broken)
{
    static const int32_t version[2] = {2, 0};
    int64_t *number = NEW("temporal.number", 2 * (int64_t)a->n, int64_t);
    struct hdf f;
    hdf_create(&f, file_register_temporary_and_return_path(path).text, false);
    hdf_create_group(&f, "/VTKHDF");
    hdf_write_attribute(&f, "/VTKHDF", "Version", HDF_I32, 2, version);
    hdf_write_text_attribute(&f, "/VTKHDF", "Type", "UnstructuredGrid");
    write_steps(&f, a, number);
    write_rows(&f, a, number);
    write_texts(&f, a, scene_text, number);
    memory_free(number);
    TRY(hdf_close_or_remove_if_write_failed(&f, path, broken));
    TRY(file_append_and_sync(path, NULL, 0));
    return file_replace_by_temporary(path);
}

static status series_temporal(struct output *o, const struct frame_series *series, const char *scene_text)
{
    struct temporal a = {.folder = o->folder};
    char name[PATH_NAME_ROOM];
    status s = OK;
    if (series->frames == 0 || series->frames > TEMPORAL_MOST) return OK;
    a.time = NEW("temporal.time", series->frames, real);
    a.source = NEW("temporal.source", series->frames, struct hdf_source);
    a.frame = memory_new("temporal.frame", series->frames, sizeof *a.frame);
    a.particles = memory_new("temporal.particles", series->frames, sizeof *a.particles);
    a.has = NEW("temporal.has", series->frames, uint32_t);
    a.start = NEW("temporal.start", series->frames, int64_t);
    frames_look(&a, series);
    frame_series_compose_index_file_name(series, name, sizeof name, ".vtkhdf");
    if (a.n > 0) s = temporal_write(&a, path_join(o->folder, name).text, scene_text, &o->broken);
    memory_free(a.start), memory_free(a.has), memory_free(a.particles), memory_free(a.frame);
    memory_free(a.source), memory_free(a.time);
    return s;
}

void output_remove_single_vtkhdf_with_all_frames(const struct output *o)
{
    for (int k = 0; k <= o->n_series; k++) {
        char name[PATH_NAME_ROOM];
        frame_series_compose_index_file_name(&o->series[k], name, sizeof name, ".vtkhdf");
        unlink(path_join(o->folder, name).text);
    }
}

status output_write_single_vtkhdf_with_all_frames(struct output *o, const char *scene_text)
{
    TRY(output_wait_until_frame_is_written(o));
    if (o->broken) return FAILED;
    TRY(folder_check_lock_still_holds(&o->lock, o->folder));
    for (int k = 0; k <= o->n_series; k++) TRY(series_temporal(o, &o->series[k], scene_text));
    return OK;
}
