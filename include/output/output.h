/* Room `output`: writes and reads the files of a run. It uses particles and archives; the engine, the commands and the
 * plots call it.
 *
 * The folder of a run holds frames, their indices, history.csv, checkpoints and summaries. Only output*.c, checkpoint.c
 * and particle_list.c call HDF5 (info.c reads its version). Every file but history.csv, which grows, is written under a
 * temporary name, synced and renamed, so that a file under its final name is complete. After HDF5 failed to write,
 * every function that needs HDF5 returns FAILED and keeps the first error message. */
#ifndef CLEAVE_OUTPUT
#define CLEAVE_OUTPUT

#include <stdio.h>

#include "base/archive.h"
#include "output_lock.h"
#include "data/particles.h"
#include "data/region.h"
#include "column.h"

enum output_mode { OUTPUT_FIRST, OUTPUT_RESUME, OUTPUT_OVERWRITE }; /* treatment of an older run in the folder */

enum { SERIES_MOST = 16 }; /* number of regions with frames of their own, in addition to the frames of the whole body */

/* Frames of the whole body or of one region, with their own folder and indices. */
struct frame_series {
    char name[NAME_MAX_LENGTH];  /* name of the region; "" for the whole body */
    const struct region *region; /* borrowed; NULL for the whole body */
    int frames;                  /* number of frames written */
    real *frame_time;            /* [frames] times [s] */
    int64_t *frame_rows;         /* [frames] rows per frame: particles and material points of coarse cells */
    unsigned frame_fields;       /* bit set of the fields in these frames (output_fields.c) */
    struct {                     /* reused while the particles stay the same */
        int32_t *order;          /* [n] shown particles by ascending id, then material points of coarse cells */
        char *room;              /* buffer for one field, used by the writing thread */
        int64_t n, of;           /* number of rows; number of particles and points to select from */
    } kept;
};

/* State of the output of a run. */
struct output {
    struct folder_lock lock; /* excludes a second process from the folder; held while `folder` is not NULL */
    char *folder;            /* path of the run's folder */
    int n_series;            /* number of regions: series[1 .. n_series]; series[0] is the whole body */
    struct frame_series series[1 + SERIES_MOST];
    bool compress;
    FILE *history;
    int64_t history_bytes; /* length of history.csv at the last sample [byte] */
    uint64_t history_hash; /* hash of these bytes (FNV-1a) */
    int columns;
    bool broken;               /* HDF5 failed to write and must not be called again */
    struct frame_job *writing; /* frame that the writing thread is writing; NULL if none */
    char *frame_copy;          /* copies of the fields of `writing`; kept for the next frame to avoid new page faults */
    int64_t frame_copy_bytes;
};

/* Configures HDF5 and signals. Call once per process before any other HDF5 call: no exit handler, no error stack on the
 * terminal. SIGXFSZ and SIGPIPE are ignored, so that a full disk causes an error instead of the end of the process. */
void output_start(void);

/* Creates `folder` and its subfolder frames, locks the folder for this process and writes scene.yaml.
 * Removes temporary files of runs and, unless `mode` is OUTPUT_RESUME, the files of an older run. With OUTPUT_RESUME
 * and no older run, a new run begins and a line reports it.
 * scene_text: scene with all defaults; a copy is written. compress: gzip the frames.
 * REFUSED if another process runs in the folder; if the folder holds files that no run wrote; if it holds a run of
 * another scene (a scene.yaml with another text), unless `mode` is OUTPUT_OVERWRITE; if it holds a run of this scene
 * and `mode` is OUTPUT_FIRST; if `mode` is OUTPUT_RESUME and the older run has lost its checkpoints. FAILED if a file
 * or folder cannot be created. On a fault nothing is left to close. */
status output_open(struct output *o, const char *folder, const char *scene_text, enum output_mode mode, bool compress);

/* Waits for the writing thread, closes history.csv, releases the lock and frees the memory of o. */
void output_close(struct output *o);

/* Checks the subfolder frames_NAME of a run's folder. REFUSED if it is a link or a file. Call before output_open, which
 * removes an older run. */
status output_series_guard(const char *folder, const char *name);

/* Adds a series of frames of a region: the folder frames_NAME and its indices NAME.hdf.series and so on. Call after
 * output_open. region: borrowed until output_close. */
status output_add_series(struct output *o, const char *name, const struct region *region);

/* Returns true if two texts of scenes describe the same scene. Particle lists are compared by their checksums, not by
 * their paths. */
bool scene_text_same(const char *a, const char *b);

/* Returns true if the file `path` describes the same scene as scene_text. False also if the file cannot be read. */
bool scene_file_same(const char *path, const char *scene_text);

/* Returns true if `text` begins as every scene.yaml that Cleave writes: with the quoted name of the scene. */
bool scene_text_is_written(const char *text);

/* Writes `text` of `length` bytes to the file `name` in the run's folder, under a temporary name that is synced and
 * renamed. */
status output_text(const struct output *o, const char *name, const char *text, size_t length);

/* Removes missing and incomplete frames from the indices. Call after a restart. lost: their number. text: receives a
 * message about the first of them (`room` bytes). */
status output_frames_check(struct output *o, int *lost, char *text, size_t room);

/* Names of the fields, as in the table of output_fields.c. The ASK_ bits select the fields that are written only if the
 * scene requests them; plots and comparisons read the other fields. */
#define FRAME_FIELD_WORDS                                                                                              \
    "displacement|velocity|stress|damage|plastic_strain|contact_force|fragment|spacing|kind|material|body|id|"         \
    "von_mises|pressure|principal_stress|principal_directions|speed|strain|density|plastic_work|level"
enum { ASK_STRAIN = 1 << 17, ASK_DENSITY = 1 << 18, ASK_PLASTIC_WORK = 1 << 19, ASK_LEVEL = 1 << 20 };

/* Quantities that particles do not store and that the caller computes for requested fields, each [n]. */
struct frame_state {
    real *gradient[DIM_MAX * DIM_MAX]; /* displacement gradient du_a/dX_b in [a dim + b], for strain and density [1] */
    real *plastic_work;                /* plastic work per volume [J/m^3] */
    real *plastic_strain;              /* plastic strain of material points, mean over the bonds of PD particles;
                                        * NULL: use the particles' own [1] */
    uint8_t *level;                    /* refinement level of the coarse cell that holds the material point; 0 if
                                        * none */
};

/* Quantities in frames besides the particles' own arrays, each [n]. NULL: the frames of this run do not have them. */
struct frame_extra {
    real *const *push;               /* [dim] contact force [N] */
    const int32_t *fragment;         /* index of the fragment, 0 for the heaviest; -1: none */
    const struct particles *more;    /* material points of coarse cells, written after the particles; must stay
                                      * unchanged until output_wait */
    real spacing;                    /* spacing of the particles [m] */
    const real *more_spacing;        /* [more->n] spacing of the material points of coarse cells [m] */
    unsigned asked;                  /* bit set of the requested fields: ASK_STRAIN and so on */
    const struct material *material; /* materials of the particles, borrowed; needed for strain and density */
    enum space space;
    struct frame_state state, more_state;
};

/* Writes the next frame of the whole body at time t [s] and step `step`: frames/NNNNNN.hdf, then the indices
 * frames.hdf.series and frames.xdmf. Particles are sorted by id. All fields but the reference positions are in single
 * precision. Returns when the files are complete. */
status output_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text);

/* Starts to write the next frame of series k (0: the whole body; 1 .. n_series: regions) in a separate thread.
 * Fields that change during the run, and `extra`, are copied before the function returns; p and scene_text must stay
 * valid until output_wait. extra: NULL if there is none. Only one frame is written at a time: the next frame,
 * checkpoints and output_close wait for it. A fault of the thread is returned by the call that waits. */
status output_frame_begin(struct output *o, int k, const struct particles *p, const struct frame_extra *extra, real t,
                          int64_t step, const char *scene_text);

/* Writes all frames of each series as one temporal file for later versions of ParaView, frames.vtkhdf
 * (output_temporal.c). Call at the end of a run. Writes nothing if there is no frame, or more frames than such a file
 * can serve efficiently. */
status output_temporal(struct output *o, const char *scene_text);

/* Removes the files that output_temporal of an earlier process wrote: they lack the frames of a continued run, and a
 * failing run does not write them again. */
void output_temporal_remove(const struct output *o);

/* Discards the stored order of the particles. Call when particles or their ids have changed, after output_wait. */
void output_particles_changed(struct output *o);

/* Waits until the writing thread has finished. Returns its status; OK if there was none. */
status output_wait(struct output *o);

/* Opens history.csv and writes its header `name [unit],...`. column[columns]: the first two are time and step. resume:
 * cut the file to the length that output_archive restored instead of starting a new one. */
status output_history_open(struct output *o, const struct column *column, int columns, bool resume);

/* Appends a line to history.csv and flushes it. value[columns] in SI units, written with 9 significant digits. */
status output_history(struct output *o, const real *value);

/* Fields read from a frame, in the order of ascending id. Every array has n entries and belongs to the frame. */
struct frame {
    int64_t n;
    int dim;
    real t; /* time [s] */
    int64_t step;
    /* reference position, displacement [m], velocity [m/s], damage [1] */
    float *X[DIM_MAX], *u[DIM_MAX], *v[DIM_MAX], *damage;
    float *stress[SYM_MAX]; /* stress [Pa], component order of struct particles; in 2D zz is last */
    uint8_t *kind, *material, *body;
    int32_t *id;
    int32_t *fragment; /* index of the fragment; NULL if the frames of this run do not have it */
    float *spacing;    /* particle spacing [m]; NULL if all particles have the same */
};

/* Returns the number of stress components in a frame: 1 in 1D, 4 in 2D (with zz), 6 in 3D. */
static inline int frame_stresses(int dim) { return symmetric_count(dim) + (dim == 2); }

/* Reads a frame from the file `path`. FAILED if the file cannot be read or is damaged; no memory is held then. Release
 * with frame_free. */
status frame_read(struct frame *f, const char *path);

/* Releases the memory of f. */
void frame_free(struct frame *f);

/* Reads a field by name at the particles of frame f, which was read from `path`: a field of the file, or one derived
 * from the fields of f (data/derived_fields.h).
 * Stores the number of components in *columns and an allocated array [n][columns] in *value, which the caller releases
 * with memory_free. FAILED if the frame has no such field. */
status frame_field_read(const struct frame *f, const char *path, const char *name, int *columns, float **value);

/* Entry of frames.hdf.series. Numbers have gaps where files were lost. */
struct listed_frame {
    int number; /* number in the file name */
    real time;  /* [s] */
};

/* Lists the frames in frames.hdf.series of a run's folder in ascending order. Stores their number in *n and an
 * allocated array in *list, which the caller releases with memory_free. FAILED if the index cannot be read. */
status frames_list(const char *folder, int *n, struct listed_frame **list);

/* ---- checkpoints ------------------------------------------------------------------------------------------------- */

/* Saves or restores the complete state of a run through the archive a; a->saving selects the direction. context:
 * argument of checkpoint_write or checkpoint_read. */
typedef status archive_all_fn(void *context, struct archive *a);

/* Writes checkpoint.h5 and renames the previous one to checkpoint.previous.h5. The file holds the format version,
 * scene_text, the state that archive_all saves, and a footer that detects damage (checksum.h). Waits for a frame that
 * is being written. */
status checkpoint_write(struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context);

/* Restores the state from checkpoint.h5; if that file is damaged, from checkpoint.previous.h5, with a line on standard
 * error. FAILED if neither is whole, or if the checkpoint belongs to another scene or format version. */
status checkpoint_read(const struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context);

/* Returns true if the folder holds checkpoint.h5 or checkpoint.previous.h5. */
bool checkpoint_exists(const char *folder);

/* Saves or restores the state of the output: number and times of the frames, length and hash of history.csv. */
status output_archive(struct output *o, struct archive *a);

#endif
