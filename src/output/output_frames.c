/* Writes frames as VTKHDF files, and their two indices: frames.hdf.series and frames.xdmf.
 *
 * The layout serves the reader of VTK 9.1 (ParaView 5.11): a static UnstructuredGrid with one vertex cell per particle.
 * Data that VTK does not define are in the group /Cleave. The fields are described in output_fields.c. */
#include "output_fields.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "output/checksum.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"

enum { FRAME_VERSION = 1, VTK_VERTEX = 1 };
enum { COPIED = 4096 }; /* particles whose rows a thread copies at a time */

/* ---- one frame --------------------------------------------------------------------------------------------------- */

/* A frame that is being written: copies of the fields that the next steps change. Constant fields are read from the
 * particles while the run continues. */
struct frame_job {
    struct path path;
    const struct particles *p;    /* borrowed; read only for constant fields */
    const struct particles *more; /* material points of coarse cells, borrowed likewise; NULL if there are none */
    struct output *o;             /* borrowed; owns the buffers of the writing thread */
    struct frame_series *series;  /* borrowed: order of the rows and list of frames */
    int64_t n, step;              /* number of rows; number of the time step */
    int dim;
    real t;
    bool compress, broken;
    unsigned fields;        /* bit set of the fields of this frame */
    const char *scene_text; /* borrowed */
    /* copies in output.frame_copy, in the order of the particles; NULL: constant, or not in this frame */
    char *field[FRAME_FIELDS];
    char *index[2]; /* texts of the two indices, including this frame */
    size_t index_length[2];
    pthread_t thread;
    bool apart; /* the thread is running */
    status ended;
    char message[512];
};

/* Creates a job that writes a frame at time t [s], and copies all fields that the next steps change to memory of the
 * output, which is reused for the next frame. The caller releases the job with job_free. */
static struct frame_job *job_make(struct output *o, struct frame_series *series, const struct frame_source *source,
                                  real t, int64_t step, const char *scene_text)
{
    const struct particles *p = source->p;
    struct frame_job *job = NEW("output.job", 1, struct frame_job);
    size_t offset[FRAME_FIELDS], length = 0;
    const int64_t all = p->n + (source->extra.more ? source->extra.more->n : 0);
    job->p = p, job->more = source->extra.more, job->o = o, job->series = series;
    job->n = series->kept.n;
    job->step = step, job->dim = p->dim, job->t = t;
    job->compress = o->compress, job->fields = frame_fields_of(source), job->scene_text = scene_text;
    for (int k = 0; k < FRAME_FIELDS; k++) {
        offset[k] = length;
        if (job->fields >> k & 1 && !frame_fields[k].fill)
            length += (size_t)all * frame_field_row(&frame_fields[k], p->dim);
    }
    if (o->frame_copy_bytes < (int64_t)length) {
        memory_free(o->frame_copy);
        o->frame_copy = NEW("output.frame", (int64_t)length, char);
        o->frame_copy_bytes = (int64_t)length;
    }
    for (int k = 0; k < FRAME_FIELDS; k++) {
        const struct frame_field *field = &frame_fields[k];
        if (field->fill || !(job->fields >> k & 1)) continue;
        job->field[k] = o->frame_copy + offset[k];
#pragma omp parallel for schedule(static)
        for (int64_t first = 0; first < p->n; first += COPIED)
            frame_field_copy(field, source, first, first + COPIED < p->n ? first + COPIED : p->n, job->field[k]);
        if (job->more)
            frame_field_copy_more(field, source, job->field[k] + (size_t)p->n * frame_field_row(field, p->dim));
    }
    return job;
}

static void job_free(struct frame_job *job)
{
    for (int k = 0; k < 2; k++) free(job->index[k]);
    memory_free(job);
}

/* ---- writing thread: has no thread team, hence allocates no arrays with memory_new ---------------------------- */

/* Returns the indices 0..n-1, released with free; NULL if memory is exhausted. */
static int32_t *ascending_order(int64_t n)
{
    int32_t *order = calloc((size_t)n + 1, sizeof *order);
    for (int64_t i = 0; i < n && order; i++) order[i] = (int32_t)i;
    return order;
}

/* Returns the indices of the particles sorted by id, [n]; ids are unique but may have gaps. NULL if memory is
 * exhausted. Release with free. */
static int32_t *order_by_id(const struct particles *p)
{
    int64_t room = 0, k = 0;
    bool ascending = true;
    for (int64_t i = 1; i < p->n && ascending; i++) ascending = p->id[i - 1] < p->id[i];
    if (ascending) return ascending_order(p->n);
    for (int64_t i = 0; i < p->n; i++) room = p->id[i] >= room ? (int64_t)p->id[i] + 1 : room;
    int32_t *order = calloc((size_t)room + 1, sizeof *order);
    if (!order) return NULL;
    for (int64_t i = 0; i < p->n; i++) order[p->id[i]] = (int32_t)i + 1;
    for (int64_t id = 0; id < room; id++)
        if (order[id]) order[k++] = order[id] - 1;
    INVARIANT(k == p->n);
    return order;
}

enum { ROW_MOST = 36 }; /* bytes of the longest row: nine single-precision numbers */

/* Writes field k of a frame as rows in the order `order`. room: buffer for the rows. */
static void write_field(struct hdf *f, const struct frame_job *job, int k, const int32_t *order, char *room)
{
    const struct frame_field *field = &frame_fields[k];
    const size_t row = frame_field_row(field, job->dim);
    INVARIANT(row <= ROW_MOST);
    const int64_t own = job->p->n;
    for (int64_t r = 0; r < job->n; r++) {
        const int64_t i = order[r];
        char *to = room + (size_t)r * row;
        if (!field->fill)
            memcpy(to, job->field[k] + (size_t)i * row, row);
        else if (i < own)
            field->fill(job->p, i, to);
        else
            field->fill(job->more, i - own, to);
    }
    hdf_write_rows(f, field->path, field->type, job->n, field->columns ? field->columns : job->dim, room);
    hdf_write_text_attribute(f, field->path, "unit", field->unit[0] ? field->unit : "1");
}

/* Writes one vertex cell per particle: cell k consists of point k and starts at k. room: buffer for one field. */
static void write_cells(struct hdf *f, int64_t n, char *room)
{
    int64_t *number = (int64_t *)room;
    for (int64_t k = 0; k <= n; k++) number[k] = k;
    hdf_write_rows(f, "/VTKHDF/NumberOfPoints", HDF_I64, 1, 1, &n);
    hdf_write_rows(f, "/VTKHDF/NumberOfCells", HDF_I64, 1, 1, &n);
    hdf_write_rows(f, "/VTKHDF/NumberOfConnectivityIds", HDF_I64, 1, 1, &n);
    hdf_write_rows(f, "/VTKHDF/Connectivity", HDF_I64, n, 1, number);
    hdf_write_rows(f, "/VTKHDF/Offsets", HDF_I64, n + 1, 1, number);
    array_fill_bytes(room, VTK_VERTEX, n, 1);
    hdf_write_rows(f, "/VTKHDF/Types", HDF_U8, n, 1, room);
}

/* Writes the data that VTK shows beside the particles: the time, the units and the scene. */
static void write_field_data(struct hdf *f, const struct frame_job *job)
{
    char units[1000];
    frame_units_text(job->fields, units, sizeof units);
    hdf_create_group(f, "/VTKHDF/FieldData");
    hdf_write_rows(f, "/VTKHDF/FieldData/TimeValue", HDF_F64, 1, 1, &job->t);
    hdf_write_text_list(f, "/VTKHDF/FieldData/units", units);
    hdf_write_text_list(f, "/VTKHDF/FieldData/scene", job->scene_text);
}

/* Writes the groups and attributes of a frame, and the text of its scene. */
static void write_marks(struct hdf *f, int dim, real t, int64_t step, const char *scene_text)
{
    static const int32_t vtk_version[2] = {1, 0}, version = FRAME_VERSION;
    int32_t dimension = dim;
    hdf_create_group(f, "/VTKHDF");
    hdf_write_attribute(f, "/VTKHDF", "Version", HDF_I32, 2, vtk_version);
    hdf_write_text_attribute(f, "/VTKHDF", "Type", "UnstructuredGrid");
    hdf_create_group(f, "/VTKHDF/PointData");
    hdf_create_group(f, "/Cleave");
    hdf_write_scalar_attribute(f, "/Cleave", "version", HDF_I32, &version);
    hdf_write_scalar_attribute(f, "/Cleave", "dim", HDF_I32, &dimension);
    hdf_write_scalar_attribute(f, "/Cleave", "time", HDF_F64, &t);
    hdf_write_scalar_attribute(f, "/Cleave", "step", HDF_I64, &step);
    hdf_write_text(f, "/Cleave/scene", scene_text);
}

static void kept_free(struct frame_series *s)
{
    free(s->kept.order), free(s->kept.room);
    memset(&s->kept, 0, sizeof s->kept);
}

/* Returns true if a series of frames contains point i. Points from the number of particles on are material points of
 * coarse cells. */
static bool series_shows(const struct frame_series *s, const struct frame_source *source, int64_t i)
{
    const struct particles *p = i < source->p->n ? source->p : source->extra.more;
    real X[DIM_MAX];
    if (!s->region) return true;
    particle_place(p, i < source->p->n ? i : i - source->p->n, X);
    return region_contains(s->region, X, p->dim, 0);
}

/* Computes the order of the rows in the frames of a series and a buffer for writing, unless they are still valid:
 * they are kept until the particles change, but not for regions with points of coarse cells. Returns false if memory
 * is exhausted. */
static bool kept_make(struct frame_series *s, const struct frame_source *source)
{
    const int64_t own = source->p->n, all = own + (source->extra.more ? source->extra.more->n : 0);
    if (s->kept.order && s->kept.of == all && !(s->region && source->extra.more)) return true;
    kept_free(s);
    int32_t *by_id = order_by_id(source->p);
    s->kept.order = calloc((size_t)all + 1, sizeof *s->kept.order);
    for (int64_t k = 0; k < all && by_id && s->kept.order; k++) {
        const int64_t i = k < own ? by_id[k] : k;
        if (series_shows(s, source, i)) s->kept.order[s->kept.n++] = (int32_t)i;
    }
    s->kept.room = malloc((size_t)(s->kept.n + 1) * ROW_MOST);
    s->kept.of = all;
    const bool made = by_id && s->kept.order && s->kept.room;
    free(by_id);
    if (!made) kept_free(s);
    return made;
}

void output_particles_changed(struct output *o)
{
    for (int k = 0; k <= o->n_series; k++) kept_free(&o->series[k]);
}

/* Writes a frame under a temporary name and renames it. */
static status frame_write(struct frame_job *job)
{
    struct hdf f;
    const int32_t *order = job->series->kept.order;
    char *room = job->series->kept.room;
    hdf_create(&f, file_begin_temporary(job->path.text).text, job->compress);
    write_marks(&f, job->dim, job->t, job->step, job->scene_text);
    write_field_data(&f, job);
    write_cells(&f, job->n, room);
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (job->fields >> k & 1) write_field(&f, job, k, order, room);
    if (!f.failed) hdf_close(&f);
    if (f.failed) {
        job->broken = true;
        file_discard(job->path.text);
        return file_fault(job->path.text, f.cause);
    }
    TRY(file_append_footer(job->path.text));
    return file_publish(job->path.text);
}

/* ---- indices ----------------------------------------------------------------------------------------------------- */

/* Writes the file name of frame `number` of a series, relative to the folder of the run. name: capacity `room`
 * [byte]. */
void frame_name(const struct frame_series *s, char *name, size_t room, int number)
{
    snprintf(name, room, "frames%s%s/%06d.hdf", s->name[0] ? "_" : "", s->name, number);
}

void series_file(const struct frame_series *s, char *name, size_t room, const char *end)
{
    snprintf(name, room, "%s%s", s->name[0] ? s->name : "frames", end);
}

/* Writes frames.hdf.series. */
static void series_print(FILE *out, const struct frame_series *s)
{
    const char *between = "";
    fprintf(out, "{\"file-series-version\":\"1.0\",\"files\":[");
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM];
        if (isnan(s->frame_time[k])) continue; /* lost (output_frames_check) */
        frame_name(s, name, sizeof name, k);
        fprintf(out, "%s\n{\"name\":\"%s\",\"time\":%.17g}", between, name, s->frame_time[k]);
        between = ",";
    }
    fprintf(out, "\n]}\n");
}

/* Writes an XDMF reference to a dataset of n rows in the file of a frame. */
static void xdmf_item(FILE *out, const char *frame, const struct frame_field *field, int64_t n)
{
    static const char *const number[] = {
        [HDF_F32] = "Float", [HDF_F64] = "Float", [HDF_U8] = "UChar", [HDF_I32] = "Int", [HDF_I64] = "Int"};
    fprintf(out, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%zu\" Dimensions=\"%lld", number[field->type],
            hdf_type_size(field->type), (long long)n);
    if (field->columns > 1) fprintf(out, " %d", field->columns);
    fprintf(out, "\">%s:%s</DataItem>", frame, field->path);
}

static void xdmf_attribute(FILE *out, const char *frame, const struct frame_field *field, int64_t n)
{
    /* A Matrix, not an XDMF Tensor6: XDMF orders the six components differently, and readers would permute them. */
    const char *shape = field->columns == 1 ? "Scalar" : field->columns == 3 ? "Vector" : "Matrix";
    const char *name = strrchr(field->path, '/') + 1;
    fprintf(out, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">", name, shape);
    xdmf_item(out, frame, field, n);
    fprintf(out, "</Attribute>\n");
}

/* Writes the XDMF grid of one frame of n particles at time t [s]. */
static void xdmf_grid(FILE *out, const char *frame, real t, int64_t n, unsigned fields)
{
    /* Lists the cells, because the XDMF3 reader creates none from their number alone. */
    static const struct frame_field vertices = {"/VTKHDF/Connectivity", "", HDF_I64, 1, NULL, NULL};
    fprintf(out, "<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", t);
    fprintf(out, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%lld\" NodesPerElement=\"1\">",
            (long long)n);
    xdmf_item(out, frame, &vertices, n);
    fprintf(out, "</Topology>\n<Geometry GeometryType=\"XYZ\">");
    xdmf_item(out, frame, &frame_fields[FIELD_POINTS], n);
    fprintf(out, "</Geometry>\n");
    for (int k = FIELD_POINTS + 1; k < FRAME_FIELDS; k++)
        if (frame_fields[k].columns > 0 && fields >> k & 1) xdmf_attribute(out, frame, &frame_fields[k], n);
    fprintf(out, "</Grid>\n");
}

static void xdmf_print(FILE *out, const struct frame_series *s)
{
    fprintf(out, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n");
    fprintf(out, "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM];
        if (isnan(s->frame_time[k])) continue;
        frame_name(s, name, sizeof name, k);
        xdmf_grid(out, name, s->frame_time[k], s->frame_rows[k], s->frame_fields);
    }
    fprintf(out, "</Grid>\n</Domain>\n</Xdmf>\n");
}

/* ---- one frame at a time ----------------------------------------------------------------------------------------- */

static const char *const index_end[2] = {".hdf.series", ".xdmf"};

static struct path index_path(const char *folder, const struct frame_series *s, int which)
{
    char name[PATH_NAME_ROOM];
    series_file(s, name, sizeof name, index_end[which]);
    return path_join(folder, name);
}

/* Composes the text of an index in memory. which: 0 for frames.hdf.series, 1 for frames.xdmf. */
static status index_make(const struct output *o, struct frame_job *job, int which)
{
    static void (*const print[2])(FILE *, const struct frame_series *) = {series_print, xdmf_print};
    FILE *out = memory_stream_open(&job->index[which], &job->index_length[which]);
    if (out) print[which](out, job->series);
    const bool whole = out && fclose(out) == 0;
    return whole ? OK : file_fault(index_path(o->folder, job->series, which).text, ENOMEM);
}

/* Writes both index files of a series, frames.hdf.series and frames.xdmf. */
static status indices_put(const char *folder, const struct frame_job *job)
{
    for (int k = 0; k < 2; k++)
        TRY(file_write_whole(index_path(folder, job->series, k).text, job->index[k], job->index_length[k]));
    return OK;
}

/* Writes the frame and then the indices, which thus never list a missing frame. The folder of the run is two levels
 * above the frame. */
static status job_write(struct frame_job *job)
{
    TRY(frame_write(job));
    struct path folder = job->path;
    for (int k = 0; k < 2; k++) *strrchr(folder.text, '/') = '\0';
    return indices_put(folder.text, job);
}

static void *job_run(void *context)
{
    struct frame_job *job = context;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* thread-safe builds of HDF5 keep this setting per thread */
    job->ended = job_write(job);
    if (job->ended != OK) snprintf(job->message, sizeof job->message, "%s", status_message());
    return NULL;
}

status output_wait(struct output *o)
{
    struct frame_job *job = o->writing;
    if (!job) return OK;
    if (job->apart) pthread_join(job->thread, NULL);
    o->writing = NULL;
    o->broken = o->broken || job->broken;
    status s = job->ended == OK ? OK : status_set(job->ended, "%s", job->message);
    if (s != OK) job->series->frames--;
    job_free(job);
    return s;
}

/* Adds a frame to the list of its series before it is written. If writing fails, output_wait removes it again. */
static void frame_count(struct frame_series *s, const struct frame_job *job)
{
    GROW("output.frame_time", s->frame_time, s->frames + 1);
    GROW("output.frame_rows", s->frame_rows, s->frames + 1);
    s->frame_rows[s->frames] = job->n;
    s->frame_time[s->frames++] = job->t;
    s->frame_fields = job->fields;
}

/* Starts the writing thread. The thread blocks all signals, which the stepping thread then receives, except the signals
 * of its own faults. */
static void output_frames_job_start(struct frame_job *job)
{
    sigset_t all, before;
    sigfillset(&all);
    sigdelset(&all, SIGSEGV), sigdelset(&all, SIGBUS);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    job->apart = pthread_create(&job->thread, NULL, job_run, job) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!job->apart) job_run(job); /* no thread available: write synchronously */
}

status output_frame_begin(struct output *o, int k, const struct particles *p, const struct frame_extra *extra, real t,
                          int64_t step, const char *scene_text)
{
    const struct frame_source source = {p, extra ? *extra : (struct frame_extra){0}};
    struct frame_series *series = &o->series[k];
    char name[PATH_NAME_ROOM];
    TRY(output_wait(o));
    if (o->broken) return FAILED;
    TRY(folder_check_lock(&o->lock, o->folder));
    frame_name(series, name, sizeof name, series->frames);
    if (!kept_make(series, &source)) return file_fault(path_join(o->folder, name).text, ENOMEM);
    struct frame_job *job = o->writing = job_make(o, series, &source, t, step, scene_text);
    job->path = path_join(o->folder, name);
    frame_count(series, job);
    for (int which = 0; which < 2 && job->ended == OK; which++) job->ended = index_make(o, job, which);
    if (job->ended != OK)
        snprintf(job->message, sizeof job->message, "%s", status_message());
    else
        output_frames_job_start(job);
    return OK;
}

status output_write_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text)
{
    TRY(output_frame_begin(o, 0, p, NULL, t, step, scene_text));
    return output_wait(o);
}

/* ---- after a restart --------------------------------------------------------------------------------------------- */

/* Returns the fault of the frame at `path` as a phrase for a message; NULL if it has none or cannot be read. time: [s],
 * NAN for a frame that was lost earlier. */
static const char *frame_fault(const char *path, real time)
{
    struct hdf f;
    real found = NAN;
    if (isnan(time)) return "is missing";
    const char *fault = file_certain_damage(path);
    if (fault || !path_is_file(path)) return fault;
    hdf_open(&f, path);
    hdf_read_attribute(&f, "/Cleave", "time", HDF_F64, &found);
    const bool read = !f.failed;
    hdf_close(&f);
    return read && !bits_equal(found, time) ? "is another one" : NULL;
}

/* Marks the lost frames of a series, adds their number to *lost and writes the first of all to `text`, capacity `room`
 * [byte]. Returns the number of frames lost in this series. */
static int series_check(const struct output *o, struct frame_series *s, int *lost, char *text, size_t room)
{
    int own = 0;
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM];
        frame_name(s, name, sizeof name, k);
        const char *fault = frame_fault(path_join(o->folder, name).text, s->frame_time[k]);
        if (!fault) continue;
        if ((*lost)++ == 0) snprintf(text, room, "%s %s", name, fault);
        s->frame_time[k] = NAN;
        own++;
    }
    return own;
}

/* Composes and writes both index files of a series again, after frames were lost. */
static status series_index(const struct output *o, struct frame_series *series)
{
    struct frame_job job = {.series = series};
    status s = OK;
    for (int k = 0; k < 2 && s == OK; k++) s = index_make(o, &job, k);
    if (s == OK) s = indices_put(o->folder, &job);
    for (int k = 0; k < 2; k++) free(job.index[k]);
    return s;
}

status output_frames_check(struct output *o, int *lost, char *text, size_t room)
{
    *lost = 0;
    for (int k = 0; k <= o->n_series; k++)
        if (series_check(o, &o->series[k], lost, text, room) > 0) TRY(series_index(o, &o->series[k]));
    if (*lost == 0) return OK;
    const size_t used = strlen(text);
    if (*lost > 1) snprintf(text + used, room - used, ", and %d frames more are lost", *lost - 1);
    strncat(text, ": the indices leave out what is lost; a run of its own would make it again",
            room - strlen(text) - 1);
    return OK;
}
