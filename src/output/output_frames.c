/* Writes frames as VTKHDF files, in a thread of its own.
 *
 * The layout serves the reader of VTK 9.1 (ParaView 5.11): a static UnstructuredGrid with one vertex cell per particle.
 * Data that VTK does not define are in the group /Cleave. The fields are described in output_fields.c. Datasets that do
 * not change from frame to frame are links to the particles file (particles_file.h). */
#include "output_fields.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/checksum.h"
#include "output/output_files.h"
#include "output_index.h"
#include "particles_file.h"

enum { FRAME_VERSION = 2 }; /* version of the format of frames */

/* ---- one frame --------------------------------------------------------------------------------------------------- */

/* One output frame that is to be written, with copies of its data, so that a thread of its own can write it while the
 * simulation goes on. Made by job_make; the output owns it until the frame has been written. */
struct frame_job {
    struct path path;            /* path of the file */
    struct output *o;            /* output of the run; borrowed */
    struct frame_series *series; /* borrowed; read only for its name by the writing thread */
    int64_t n, step;             /* number of rows (particles); number of the time step */
    int dim;
    real t;                /* time of the frame [s] */
    bool compress, broken; /* compress with gzip; HDF5 has failed and must not be called again */
    unsigned fields;       /* bit set of the fields of this frame */
    bool untouched;        /* contact forces are left out because all are 0 */
    /* rows of the fields that change, in output.frame_copy; NULL: in the particles file, or not in this frame */
    char *field[FRAME_FIELDS];
    struct particles_file particles; /* particles file to which the frame links */
    struct frame_index_texts index;  /* lists of all frames, including this frame */
    pthread_t thread;
    bool apart;        /* the thread is running */
    status ended;      /* result of the thread */
    char message[512]; /* its message, if it failed */
};

/* Returns true if field number k is stored in the output frame of `job`, the description of a frame to be written.
 * Fields that do not change from frame to frame are in the particles file instead. */
static bool has_rows(const struct frame_job *job, int k) { return job->fields >> k & 1 && !frame_fields[k].fixed; }

/* Copies from `source` the rows of those fields of a frame (output file of one time) that are stored in the frame
 * itself, not in the particles file, to job->o->frame_copy. This memory is used again for the next frame. job:
 * description of the frame to be written. */
static void job_copy_fields(struct frame_job *job, const struct frame_contents *source)
{
    struct output *o = job->o;
    int64_t at = 0, length = 0;
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (has_rows(job, k)) length += job->n * (int64_t)frame_field_bytes_per_row(&frame_fields[k], job->dim);
    if (o->frame_copy_bytes < length) {
        memory_free(o->frame_copy);
        o->frame_copy = NEW("output.frame", length, char);
        o->frame_copy_bytes = length;
    }
    for (int k = 0; k < FRAME_FIELDS; k++) {
        if (!has_rows(job, k)) continue;
        job->field[k] = o->frame_copy + at;
        at += job->n * (int64_t)frame_field_bytes_per_row(&frame_fields[k], job->dim);
        frame_field_copy_particle_values_to_rows(&frame_fields[k], source, &job->series->rows, job->field[k]);
    }
}

/* Omits the field of contact forces from the output frame of `job` if all contact forces are 0, and sets
 * job->untouched. */
static void job_drop_contact(struct frame_job *job)
{
    const float *force = (const void *)job->field[FIELD_CONTACT];
    const int64_t numbers = job->n * job->dim;
    int64_t k = 0;
    if (!force) return;
    while (k < numbers && force[k] == 0) k++;
    job->untouched = k == numbers;
    if (job->untouched) job->fields &= ~(1u << FIELD_CONTACT);
}

/* Chooses the particles file to which the output frame of `job` links; it has the data that do not change from frame
 * to frame. It is the last particles file of the series of frames, or a new one if its contents would differ. source:
 * data of the frame; scene_text: text of the input file (scene), which the particles file contains. */
static void job_choose_particles_file(struct frame_job *job, const struct frame_contents *source,
                                      const char *scene_text)
{
    struct frame_series *s = job->series;
    char name[PATH_NAME_ROOM];
    if (s->particles.number < 0 || !s->particles.current || source->extra.more) {
        particles_file_collect_contents(&job->particles, s, source, job->fields, scene_text);
        if (s->particles.number >= 0 && s->particles.content == job->particles.content)
            particles_file_free(&job->particles);
        else
            s->particles.number = s->frames, s->particles.content = job->particles.content;
        s->particles.current = true;
    }
    particles_file_compose_name(s, name, sizeof name, s->particles.number);
    job->particles.path = path_join(job->o->folder, name);
    job->particles.content = s->particles.content;
    job->particles.compress = job->compress;
}

/* Returns the job of writing a frame (output file of one time) of a series to the output o at time t [s] and time step
 * number `step`, and copies the fields of the particles of `source` into it, so that the run can go on while it is
 * written. series: frames of the whole run or of one region; scene_text: text of the input file (scene), for the
 * particles file. The caller owns the job. */
static struct frame_job *job_make(struct output *o, struct frame_series *series, const struct frame_contents *source,
                                  real t, int64_t step, const char *scene_text)
{
    struct frame_job *job = NEW("output.job", 1, struct frame_job);
    job->o = o, job->series = series;
    job->n = series->rows.n, job->step = step, job->dim = source->p->dim, job->t = t;
    job->compress = o->compress, job->fields = frame_contents_field_bits_to_write(source);
    job_copy_fields(job, source);
    job_choose_particles_file(job, source, scene_text);
    job_drop_contact(job);
    return job;
}

static void job_free(struct frame_job *job)
{
    particles_file_free(&job->particles);
    frame_index_files_free_texts(&job->index);
    memory_free(job);
}

/* ---- the rows ---------------------------------------------------------------------------------------------------- */

/* Returns an allocated array of the numbers 0 .. n - 1; NULL if memory is exhausted. The caller releases it with
 * free. */
static int32_t *ascending_order(int64_t n)
{
    int32_t *order = calloc((size_t)n + 1, sizeof *order);
    for (int64_t i = 0; i < n && order; i++) order[i] = (int32_t)i;
    return order;
}

/* Returns an allocated array of the indices of the particles p, [p->n], in ascending order of their ids. Ids are unique
 * but need not be consecutive. Returns NULL if memory is exhausted. The caller releases the array with free. */
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

/* Releases the list of the particles that the output frames of the series s (of the whole run or of one region) show.
 * They are selected again for the next frame. */
static void rows_free(struct frame_series *s)
{
    free(s->rows.index);
    s->rows = (struct frame_rows){0};
    s->particles.current = false;
}

/* Returns true if the output frames of the series s show particle i of p: it is in the region of the series, or the
 * series has no region. p: particles, or material points of coarse cells. */
static bool series_shows(const struct frame_series *s, const struct particles *p, int64_t i)
{
    real X[DIM_MAX];
    if (!s->region) return true;
    particle_reference_position(p, i, X);
    return region_contains(s->region, X, p->dim, 0);
}

/* Selects the particles of `source` that the output frames of the series s show, in the order of their ids, and stores
 * them in s->rows. The selection is kept until output_discard_cached_frame_particle_order, or until the number of
 * particles changes. It is made again for each frame if the series has a region and there are material points of coarse
 * grid cells, which may change at any step. Returns false if memory is exhausted. */
static bool rows_make(struct frame_series *s, const struct frame_contents *source)
{
    const struct particles *more = source->extra.more;
    const int64_t own = source->p->n, all = own + (more ? more->n : 0);
    if (s->rows.index && s->rows_of == all && !(s->region && more)) return true;
    rows_free(s);
    int32_t *by_id = order_by_id(source->p), *index = calloc((size_t)all + 1, sizeof *index);
    const bool made = by_id && index;
    int64_t n = 0;
    for (int64_t k = 0; k < own && made; k++)
        if (series_shows(s, source->p, by_id[k])) index[n++] = by_id[k];
    s->rows.own = n;
    for (int64_t k = 0; k < all - own && made; k++)
        if (series_shows(s, more, k)) index[n++] = (int32_t)k;
    s->rows.index = index, s->rows.n = n, s->rows_of = all;
    free(by_id);
    if (!made) rows_free(s);
    return made;
}

void output_discard_cached_frame_particle_order(struct output *o)
{
    for (int k = 0; k <= o->n_series; k++) rows_free(&o->series[k]);
}

/* ---- writing thread: has no thread team, hence allocates no arrays with memory_new ------------------------------- */

/* Writes the groups and attributes of the output frame of `job` to the file `hdf`, and its time, which VTK shows beside
 * the particles. */
static void write_marks(struct hdf *hdf, const struct frame_job *job)
{
    static const int32_t vtk_version[2] = {1, 0}, version = FRAME_VERSION;
    int32_t dimension = job->dim;
    hdf_create_group(hdf, "/VTKHDF");
    hdf_write_attribute(hdf, "/VTKHDF", "Version", HDF_I32, 2, vtk_version);
    hdf_write_text_attribute(hdf, "/VTKHDF", "Type", "UnstructuredGrid");
    hdf_create_group(hdf, "/VTKHDF/PointData");
    hdf_create_group(hdf, "/VTKHDF/FieldData");
    hdf_write_rows(hdf, "/VTKHDF/FieldData/TimeValue", HDF_F64, 1, 1, &job->t);
    hdf_create_group(hdf, "/Cleave");
    hdf_write_scalar_attribute(hdf, "/Cleave", "version", HDF_I32, &version);
    hdf_write_scalar_attribute(hdf, "/Cleave", "dim", HDF_I32, &dimension);
    hdf_write_scalar_attribute(hdf, "/Cleave", "time", HDF_F64, &job->t);
    hdf_write_scalar_attribute(hdf, "/Cleave", "step", HDF_I64, &job->step);
    if (job->untouched) hdf_write_text_attribute(hdf, "/Cleave", "zero", "contact_force");
}

/* Writes the output frame of a job (the description of a frame to be written) under its temporary name PATH.cleave.tmp,
 * and renames it to PATH. Before that, writes the particles file to which it links, if this is new. Returns FAILED,
 * with a message, if a file cannot be written. */
static status frame_write(struct frame_job *job)
{
    struct hdf f;
    if (job->particles.rows) TRY(particles_file_write(&job->particles, &job->broken));
    hdf_create(&f, file_register_temporary_and_return_path(job->path.text).text, job->compress);
    write_marks(&f, job);
    particles_file_link_fields_into_frame(&f, &job->particles, job->fields);
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (has_rows(job, k)) frame_field_write(&f, &frame_fields[k], job->n, job->dim, job->field[k]);
    TRY(hdf_close_or_remove_if_write_failed(&f, job->path.text, &job->broken));
    TRY(file_append_checksum_footer(job->path.text));
    return file_replace_by_temporary(job->path.text);
}

/* Writes the output frame of a job (the description of a frame to be written) and then the index files of its series of
 * frames, which thus never list a missing frame. The folder of the run is two levels above the frame. Returns FAILED,
 * with a message, if a file cannot be written. */
static status job_write(struct frame_job *job)
{
    TRY(frame_write(job));
    struct path folder = job->path;
    for (int k = 0; k < 2; k++) *strrchr(folder.text, '/') = '\0';
    return frame_index_files_write(&job->index, folder.text, job->series);
}

/* ---- one frame at a time ----------------------------------------------------------------------------------------- */

/* Writes the output frame of the job `context` in a thread of its own. Stores status and message in the job. Returns
 * NULL. */
static void *job_run(void *context)
{
    struct frame_job *job = context;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* thread-safe builds of HDF5 keep this setting per thread */
    job->ended = job_write(job);
    if (job->ended != OK) snprintf(job->message, sizeof job->message, "%s", status_message());
    return NULL;
}

status output_wait_until_frame_is_written(struct output *o)
{
    struct frame_job *job = o->writing;
    if (!job) return OK;
    if (job->apart) pthread_join(job->thread, NULL);
    o->writing = NULL;
    o->broken = o->broken || job->broken;
    status s = job->ended == OK ? OK : status_set(job->ended, "%s", job->message);
    if (s != OK) job->series->frames--, job->series->particles.number = -1;
    job_free(job);
    return s;
}

/* Appends the output frame of `job`, which is about to be written, to the list of its series s, the frames of the
 * whole run or of one region. If writing fails later, output_wait_until_frame_is_written removes it from the list. */
static void frame_count(struct frame_series *s, const struct frame_job *job)
{
    GROW("output.frames", s->entry, s->frames + 1);
    s->entry[s->frames++] =
        (struct frame_entry){.time = job->t, .rows = job->n, .fields = job->fields, .particles = s->particles.number};
}

/* Starts a thread that writes the frame (output file of one time) that `job` describes; if no thread is available,
 * writes the frame at once. The thread blocks all signals except SIGSEGV and SIGBUS, the signals of its own faults, so
 * that the stepping thread receives them. */
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

status output_begin_writing_frame_in_thread(struct output *o, int number, const struct particles *p,
                                            const struct frame_extra *extra, real t, int64_t step,
                                            const char *scene_text)
{
    const struct frame_contents source = {p, extra ? *extra : (struct frame_extra){0}};
    struct frame_series *series = &o->series[number];
    char name[PATH_NAME_ROOM];
    TRY(output_wait_until_frame_is_written(o));
    if (o->broken) return FAILED;
    TRY(folder_check_lock_still_holds(&o->lock, o->folder));
    frame_compose_file_name(series, name, sizeof name, series->frames);
    if (!rows_make(series, &source)) return file_report_write_failure(path_join(o->folder, name).text, ENOMEM);
    struct frame_job *job = o->writing = job_make(o, series, &source, t, step, scene_text);
    job->path = path_join(o->folder, name);
    frame_count(series, job);
    job->ended = frame_index_files_compose_texts(&job->index, o->folder, series);
    if (job->ended != OK)
        snprintf(job->message, sizeof job->message, "%s", status_message());
    else
        output_frames_job_start(job);
    return OK;
}

status output_write_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text)
{
    TRY(output_begin_writing_frame_in_thread(o, 0, p, NULL, t, step, scene_text));
    return output_wait_until_frame_is_written(o);
}

/* ---- after a restart --------------------------------------------------------------------------------------------- */

/* Result of the check of one particles file after a restart. It is kept while output frames that link to this file are
 * checked, so that the file is read only once. */
struct particles_seen {
    int32_t number;            /* -1: none has been checked */
    char name[PATH_NAME_ROOM]; /* relative to the folder of the run */
    const char *fault;         /* a phrase that completes "NAME ..." if the file is lost for certain; else NULL */
    bool known;                /* `content` has been read */
    int64_t content;           /* hash of the contents of the file */
};

/* Checks particles file number `number` of the series of output frames s in the folder of a run, and stores name,
 * fault and hash of the file in *seen. Does nothing if *seen already describes this file. The state restored from the
 * checkpoint has the hash of the last particles file of the series. If this file has another hash, it belongs to
 * another run and counts as lost. */
static void particles_file_look(struct particles_seen *seen, const char *folder, const struct frame_series *s,
                                int number)
{
    if (seen->number == number) return;
    particles_file_compose_name(s, seen->name, sizeof seen->name, number);
    const struct path path = path_join(folder, seen->name);
    seen->number = number;
    seen->fault = file_describe_damage_ignoring_read_errors(path.text);
    seen->known =
        !seen->fault && path_is_file(path.text) && particles_file_read_content_hash(path.text, &seen->content);
    if (seen->known && number == s->particles.number && seen->content != s->particles.content)
        seen->fault = "belongs to another run";
}

/* Reads from the output frame at `path` its time into *time [s] and the hash of its particles file into *content.
 * Returns false if the frame cannot be read. */
static bool frame_read_marks(const char *path, real *time, int64_t *content)
{
    struct hdf f;
    hdf_open_for_reading(&f, path);
    hdf_read_attribute(&f, "/Cleave", "time", HDF_F64, time);
    hdf_read_attribute(&f, "/Cleave", "content", HDF_I64, content);
    const bool read = !f.failed;
    hdf_close(&f);
    return read;
}

/* Returns true if the output frame at `path` is damaged or missing for certain, and then writes a phrase that
 * completes "FRAME ..." to text[capacity]. Returns false if the frame has no fault, or if it cannot be decided because
 * reading failed. e: entry of the frame in the list of frames; particles: the particles file to which it should link.
 */
static bool frame_is_lost(const char *path, const struct frame_entry *e, const struct particles_seen *particles,
                          char *text, size_t capacity)
{
    real time = NAN;
    int64_t content = 0;
    const char *fault = file_describe_damage_ignoring_read_errors(path);
    if (fault) return snprintf(text, capacity, "%s", fault) > 0;
    if (!path_is_file(path)) return false;
    if (particles->fault)
        return snprintf(text, capacity, "links to %s, which %s", particles->name, particles->fault) > 0;
    if (!frame_read_marks(path, &time, &content)) return false;
    if (!reals_are_bitwise_equal(time, e->time)) return snprintf(text, capacity, "belongs to another time") > 0;
    if (!particles->known || content == particles->content) return false;
    return snprintf(text, capacity, "links to %s, which belongs to another run", particles->name) > 0;
}

/* Marks the frames (output files) of the series s of the output o that are lost (damaged or missing) and adds their
 * number to *lost. If *lost was 0, describes the first of them in text[capacity]. Frames that were marked at an
 * earlier restart and exist again are no longer marked. A particles file that is lost is not used for further frames.
 */
static void series_check(const struct output *o, struct frame_series *s, int *lost, char *text, size_t capacity)
{
    struct particles_seen seen = {.number = -1};
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM], fault[PATH_NAME_ROOM + 100];
        frame_compose_file_name(s, name, sizeof name, k);
        particles_file_look(&seen, o->folder, s, s->entry[k].particles);
        const struct path path = path_join(o->folder, name);
        s->entry[k].fields &= ~FRAME_LOST;
        if (!frame_is_lost(path.text, &s->entry[k], &seen, fault, sizeof fault)) continue;
        if ((*lost)++ == 0) snprintf(text, capacity, "%s %s", name, fault);
        s->entry[k].fields |= FRAME_LOST;
    }
    if (seen.fault) s->particles.number = -1;
}

/* Composes and writes both index files of a series of output frames of the output o (frames.hdf.series and
 * frames.xdmf). Returns FAILED, with a message, if one cannot be written. */
static status series_index(const struct output *o, struct frame_series *series)
{
    struct frame_index_texts index = {0};
    status s = frame_index_files_compose_texts(&index, o->folder, series);
    if (s == OK) s = frame_index_files_write(&index, o->folder, series);
    frame_index_files_free_texts(&index);
    return s;
}

status output_remove_missing_frames_from_index(struct output *o, int *lost_frame_count, char *message, size_t capacity)
{
    *lost_frame_count = 0;
    for (int k = 0; k <= o->n_series; k++) {
        if (o->series[k].frames == 0) continue;
        series_check(o, &o->series[k], lost_frame_count, message, capacity);
        TRY(series_index(o, &o->series[k]));
    }
    if (*lost_frame_count == 0) return OK;
    const size_t used = strlen(message);
    if (*lost_frame_count > 1)
        snprintf(message + used, capacity - used, ", and %d more frames are lost", *lost_frame_count - 1);
    strncat(message, ": the indices leave out lost frames; to make them again, run the scene in another folder",
            capacity - strlen(message) - 1);
    return OK;
}
