/* Room `output` (folder of include/ and src/): writes and reads the files of a run. It uses particles and archives; the
 * engine, the commands and the room `plot` call it.
 *
 * The results folder of a run contains frames (states of the particles at one time), their index files, history.csv,
 * checkpoints and summaries. Only output*.c, checkpoint.c and particle_list.c call HDF5 (info.c reads its version).
 * Every file but history.csv, which grows, is written under a temporary name, synced and renamed, so that a file under
 * its final name is complete. After HDF5 has failed to write, every function that needs HDF5 returns FAILED and keeps
 * the first error message. */
#ifndef CLEAVE_OUTPUT
#define CLEAVE_OUTPUT

#include <stdio.h>

#include "base/archive.h"
#include "output_lock.h"
#include "data/particles.h"
#include "data/region.h"
#include "column.h"

/* Treatment of an older run in the folder: OUTPUT_FIRST refuses it, OUTPUT_RESUME continues it, OUTPUT_OVERWRITE
 * removes its files. */
enum output_mode { OUTPUT_FIRST, OUTPUT_RESUME, OUTPUT_OVERWRITE };

/* Largest number of regions with frames of their own, in addition to the frames of the whole body. */
enum { SERIES_MOST = 16 };

/* Bit of the member `fields` of struct frame_entry: the file of the frame is missing or damaged, so that the index
 * files do not list it (output_remove_missing_frames_from_index). */
#define FRAME_LOST (1u << 31)

/* A frame (state of the particles at one time) that has been written to its file. */
struct frame_entry {
    real time;         /* [s] */
    int64_t rows;      /* particles and material points of coarse cells */
    uint32_t fields;   /* bit set of the fields in this frame (output_fields.c), and FRAME_LOST */
    int32_t particles; /* number in the name of the particles file that the frame links to (particles_file.h) */
};

/* Order of the rows of a frame file (state at one time): particles by ascending id, then material points of coarse
 * cells. */
struct frame_rows {
    int32_t *index; /* [n] index in the particles or, for the last rows, in the material points of coarse cells */
    int64_t n, own; /* number of rows; number of the first rows, which are particles */
};

/* Frames of the whole body or of one region, with their own folder and indices. */
struct frame_series {
    char name[NAME_MAX_LENGTH];  /* name of the region; "" for the whole body */
    const struct region *region; /* borrowed; NULL for the whole body */
    int frames;                  /* number of frames written */
    struct frame_entry *entry;   /* [frames] */
    struct {                     /* the particles file that the last frame links to */
        int32_t number;          /* in its name; -1: none */
        int64_t content;         /* hash of its contents */
        bool current;            /* the particles have not changed since its contents were compared */
    } particles;
    struct frame_rows rows; /* reused while the particles stay the same */
    int64_t rows_of;        /* number of particles and points from which the rows were selected */
};

/* State of the output of a run: its folder, its series of frames, and the table history.csv. */
struct output {
    struct folder_lock lock; /* excludes a second process from the folder; held while `folder` is not NULL */
    char *folder;            /* path of the run's folder */
    bool has_other_scene;    /* output_open has refused, with a message that begins with the key that differs */
    int n_series;            /* number of regions with frames: series[1 .. n_series]; series[0] is the whole body */
    struct frame_series series[1 + SERIES_MOST];
    bool compress;             /* frames are compressed with gzip */
    FILE *history;             /* history.csv, open for writing */
    int64_t history_bytes;     /* length of history.csv at the last sample [byte] */
    uint64_t history_hash;     /* hash of these bytes (FNV-1a) */
    int columns;               /* number of columns of history.csv */
    bool broken;               /* HDF5 failed to write and must not be called again */
    struct frame_job *writing; /* frame that the writing thread is writing; NULL if none */
    char *frame_copy;          /* rows of the fields of `writing`; kept for the next frame to avoid new page faults */
    int64_t frame_copy_bytes;  /* size of frame_copy [byte] */
};

/* Configures signals: SIGXFSZ and SIGPIPE are ignored, so that a full disk causes an error code instead of the end of
 * the process, and a crash removes unfinished files. Call this function once per process. */
void output_install_signal_handling_for_file_writes(void);

/* Opens the output o of a run: creates `folder` and its subfolder frames, locks the folder for this process and writes
 * scene.yaml. Removes temporary files of runs and, unless `mode` is OUTPUT_RESUME, the files of an older run. With
 * OUTPUT_RESUME and no older run, a new run begins and a printed line reports it. scene_text: text of the scene with
 * all defaults, of which a copy is written; compress: true to compress frames with gzip. Returns REFUSED if another
 * process runs in the folder, or if it contains files that no run wrote. Returns REFUSED also if it contains a run of
 * another scene (another text in scene.yaml) unless `mode` is OUTPUT_OVERWRITE; a run of this scene and `mode` is
 * OUTPUT_FIRST; or an older run without checkpoints and `mode` is OUTPUT_RESUME. Returns FAILED if a file or folder
 * cannot be created. Unless OK is returned, output_close need not be called. */
status output_open(struct output *o, const char *folder, const char *scene_text, enum output_mode mode, bool compress);

/* Waits for the thread that writes frames, closes history.csv, unlocks the folder of the run, and frees the memory of
 * *o. */
void output_close(struct output *o);

/* Checks that the subfolder frames_NAME of a results folder can be created for the frames (the particles at one time)
 * of a region, with NAME = series_name, the name of the region. Returns REFUSED if a link or a file has that name. Must
 * be called before output_open, which removes the files of an older run. */
status output_check_series_folder_can_be_created(const char *folder, const char *series_name);

/* Adds a series of frames (files with the particles of a region at one time) to the output o: the subfolder frames_NAME
 * and its index files NAME.hdf.series and NAME.xdmf, with NAME = series_name. region: kept by reference until
 * output_close. output_open must have been called. Returns REFUSED if a link or a file has the name of the subfolder,
 * FAILED if it cannot be created. */
status output_add_frame_series(struct output *o, const char *series_name, const struct region *region);

/* Writes `length` bytes of `text` to the file `file_name` in the folder of the run o. The file is first written under a
 * temporary name and then renamed, so that a file under its final name is complete. Returns FAILED if the file cannot
 * be written. */
status output_write_text(const struct output *o, const char *file_name, const char *text, size_t length);

/* Writes the index files of all series of frames (files with the particles at one time) of o again, without frames
 * that are missing or incomplete. A frame that was lost at an earlier restart and exists again is listed again. To be
 * called after a restart. Stores the number of lost frames in *lost_frame_count and, unless it is 0, a message about
 * the first lost frame in message[capacity]. Returns FAILED if an index file cannot be written. */
status output_remove_missing_frames_from_index(struct output *o, int *lost_frame_count, char *message, size_t capacity);

/* First lines of the files of rigid bodies, which are written beside the frames and by which Cleave recognises them
 * (rigid/rigid_surface.h). */
#define RIGID_FILE_BEGIN                                                                                               \
    "<?xml version=\"1.0\"?>\n<!-- rigid bodies of cleave -->\n<VTKFile type=\"PolyData\" version=\"0.1\" "            \
    "byte_order=\"LittleEndian\">\n"

/* Names of the fields, as in the table of output_fields.c. The ASK_ bits select the fields that are written only if the
 * scene requests them; plots and comparisons read the other fields. */
#define FRAME_FIELD_WORDS                                                                                              \
    "displacement|velocity|stress|damage|plastic_strain|contact_force|fragment|spacing|kind|material|body|id|"         \
    "von_mises|pressure|principal_stress|principal_directions|speed|strain|density|plastic_work|level|temperature|"    \
    "strength_share"
enum {
    ASK_STRAIN = 1 << 17,
    ASK_DENSITY = 1 << 18,
    ASK_PLASTIC_WORK = 1 << 19,
    ASK_LEVEL = 1 << 20,
    ASK_SHARE = 1 << 22
};

/* Quantities that particles do not store and that the caller computes for requested fields, each [n]. */
struct frame_state {
    real *gradient[DIM_MAX * DIM_MAX]; /* displacement gradient du_a/dX_b in [a dim + b], for strain and density [1] */
    real *plastic_work;                /* plastic work per volume [J/m^3] */
    real *plastic_strain;              /* plastic strain of material points, mean over the bonds of PD particles;
                                        * NULL: use the particles' own [1] */
    real *damage;                      /* damage with that of softening bonds; NULL: use the particles' own [1] */
    real *share;                       /* stress divided by the strength by the strength surface, 1 on it [1] */
    uint8_t *level;                    /* coarsening level of the mesh cell that contains the particle: each level
                                        * doubles the edge of the cell; 0: finest cell, or none */
};

/* Quantities that a frame (state at one time) contains besides the arrays of the particles. Arrays are borrowed and
 * have an entry for each particle; NULL: the frames of this run do not have the quantity. */
struct frame_extra {
    real *const *push;               /* [dim] contact force [N] */
    const int32_t *fragment;         /* index of the fragment, 0 for the heaviest; -1: none */
    const struct particles *more;    /* material points of coarse cells, written after the particles */
    real spacing;                    /* spacing of the particles [m] */
    const real *more_spacing;        /* [more->n] spacing of the material points of coarse cells [m] */
    unsigned asked;                  /* bit set of the requested fields: ASK_STRAIN and so on */
    const struct material *material; /* materials of the particles, borrowed; needed for strain and density */
    const int *material_number; /* [materials] number of each material in the scene file, borrowed; NULL: its index */
    enum space space;
    struct frame_state state, more_state; /* quantities computed for frames: of the particles, of `more` */
};

/* Writes to o the next frame (state of the particles p) of the whole body at time t [s] after `step` time steps: the
 * file frames/NNNNNN.hdf, then the index files frames.hdf.series and frames.xdmf. Data that do not change while the
 * particles stay the same are written to a separate file before the first frame, and all frames link to it. Particles
 * are sorted by id. All fields but the reference positions have single precision. scene_text: text of the scene, stored
 * in the separate file. Returns when the files are complete, FAILED if one cannot be written. */
status output_write_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text);

/* Starts to write to o the next frame (state of the particles) of a series at time t [s] after `step` time steps, in a
 * separate thread. series: 0 for the whole body, 1 .. n_series for regions; extra: quantities that p does not store,
 * NULL for none. The fields of p and *extra are copied before the function returns; scene_text must stay valid until
 * output_wait_until_frame_is_written. Contact forces are left out if they are 0 everywhere. Only one frame is written
 * at a time: the next frame, checkpoints and output_close wait for it. Returns FAILED if the previous frame, for which
 * it waits, could not be written. A failure of this frame is returned by the call that waits for it. */
status output_begin_writing_frame_in_thread(struct output *o, int series, const struct particles *p,
                                            const struct frame_extra *extra, real t, int64_t step,
                                            const char *scene_text);

/* Writes all frames (states of the particles) of each series of o as one file with all times for ParaView,
 * frames.vtkhdf, at the end of a run. scene_text: text of the scene, stored in the file. Writes nothing if there is no
 * frame, or if there are more frames than such a file can serve efficiently. Returns FAILED if a file cannot be
 * written. */
status output_write_single_vtkhdf_with_all_frames(struct output *o, const char *scene_text);

/* Removes the files with all frames, frames.vtkhdf, that an earlier process wrote to the folder of the run o, since
 * they lack the frames of a run that continues. */
void output_remove_single_vtkhdf_with_all_frames(const struct output *o);

/* Discards the stored order in which o writes particles to frames (ascending id), for all series of frames, so that the
 * next frame determines it again. Must be called when the number of particles or their ids have changed, after
 * output_wait_until_frame_is_written. */
void output_discard_cached_frame_particle_order(struct output *o);

/* Waits until the thread that writes a frame (stored state of the particles at one time) of o has finished. Returns
 * FAILED if the frame could not be written; OK if it was written or there was no frame in progress. */
status output_wait_until_frame_is_written(struct output *o);

/* Opens history.csv of o and writes its header `name [unit],...` from column[column_count], of which the first two are
 * time and step. If `resume` is true, opens the existing file instead and cuts it to the length that
 * output_save_or_load has restored. Returns FAILED if the file cannot be opened or written. */
status output_history_open(struct output *o, const struct column *column, int column_count, bool resume);

/* Appends one line with value[columns] in SI units to history.csv of o, with 9 significant digits each, and flushes it.
 * Returns FAILED if the line cannot be written. */
status output_write_history(struct output *o, const real *value);

/* Fields read from a frame, in the order of ascending id. Every array has n entries and belongs to the frame. */
struct output_frame {
    int64_t n; /* number of particles */
    int dim;
    real t;           /* time [s] */
    int64_t step;     /* number of the time step or load step */
    real *X[DIM_MAX]; /* reference position [m]; in double precision for bodies far from the origin */
    /* displacement [m], velocity [m/s], damage [1] */
    float *u[DIM_MAX], *v[DIM_MAX], *damage;
    float *stress[SYM_MAX];          /* stress [Pa], component order of struct particles; in 2D zz is last */
    uint8_t *kind, *material, *body; /* enum kind; index of the material, of the body */
    int32_t *id;                     /* index in the order in which the scene made the particles */
    int32_t *fragment;               /* index of the fragment; NULL if the frames of this run do not have it */
    float *spacing;                  /* particle spacing [m]; NULL if all particles have the same */
};

/* Returns the number of stress components that a frame (stored state of the particles at one time) of dimension `dim`
 * contains: 1 in 1D, 4 in 2D (zz included), 6 in 3D. */
static inline int frame_stress_component_count(int dim) { return symmetric_tensor_component_count(dim) + (dim == 2); }

/* Reads the frame (stored state of the particles at one time) in the file `path` into *f, in the order of ascending id.
 * Returns FAILED, with no memory to release, if the file, or the particles file that it links to, cannot be read or is
 * damaged. Release with frame_free. */
status frame_read(struct output_frame *f, const char *path);

/* Frees the arrays of the frame *f, which frame_read has allocated. */
void frame_free(struct output_frame *f);

/* Reads the field called `name` at the particles of the frame f, which was read from the file `path`: a field stored in
 * the file, one computed from fields of f (data/derived_fields.h), or contact forces that the frame leaves out because
 * they are 0. Stores the number of its components in *component_count and an allocated array, with that many values for
 * each of the f->n particles, in *value, which the caller releases with memory_free. Returns FAILED if the frame has no
 * such field. */
status frame_field_read(const struct output_frame *f, const char *path, const char *name, int *component_count,
                        float **value);

/* Entry of frames.hdf.series, the list of the frames of a run. Numbers have gaps where files were lost. */
struct listed_frame {
    int number; /* number in the file name */
    real time;  /* [s] */
};

/* Reads the list of frames (stored state of the particles at one time), in ascending order, from the index
 * frames.hdf.series of the folder of a run. Stores their number in *frame_count and an allocated array in *frames,
 * which the caller releases with memory_free. Returns FAILED if the index cannot be read. */
status run_list_frames(const char *folder, int *frame_count, struct listed_frame **frames);

/* ---- checkpoints ------------------------------------------------------------------------------------------------- */

/* Type of a function that saves the complete state of a run to the archive a (checkpoint file or memory) if a->saving
 * is true, else restores it from a. context: the argument `context` of checkpoint_write or checkpoint_read. Returns
 * FAILED if an entry cannot be written or read. */
typedef status run_state_save_or_load_fn(void *context, struct archive *a);

/* Writes the file checkpoint.h5 of o after renaming the previous one to checkpoint.previous.h5. The file contains the
 * format version, scene_text, the state that save_or_load_all(context, archive) saves, and a footer with a hash by
 * which damage is detected. Waits first for a frame that is being written. Returns FAILED if a file cannot be
 * written. */
status checkpoint_write(struct output *o, const char *scene_text, run_state_save_or_load_fn *save_or_load_all,
                        void *context);

/* Restores the state of the run in the folder of o by save_or_load_all(context, archive) from checkpoint.h5. If that
 * file is damaged, uses checkpoint.previous.h5 and prints a line on standard error. scene_text: text of the scene of
 * the run. Returns FAILED if both files are damaged or missing, or if the checkpoint belongs to another scene or format
 * version. */
status checkpoint_read(const struct output *o, const char *scene_text, run_state_save_or_load_fn *save_or_load_all,
                       void *context);

/* Returns true if `folder`, the folder of a run, holds a checkpoint: checkpoint.h5 or checkpoint.previous.h5. */
bool checkpoint_exists(const char *folder);

/* Saves the state of the output o (number and times of frames, length and hash of history.csv) to the archive a
 * (checkpoint file or memory) if a->saving is true, else restores it from a. Returns FAILED if an entry is missing or
 * does not agree with the files of the run. */
status output_save_or_load(struct output *o, struct archive *a);

#endif
