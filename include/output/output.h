/* Room `output`: the files of a run, written and read back. It knows particles and archives, but nothing of the engine,
 * which calls it, as do commands and pictures.
 *
 * What a run leaves in its folder: frames, their indices, history, checkpoints. Only output*.c, checkpoint.c and
 * particle_list.c use HDF5 (info.c reads its version). Every file but history.csv, which grows, is written aside,
 * synced and renamed: a file that is there is whole. After a failed write of HDF5 all that needs it returns FAILED
 * and lets the first message stand. */
#ifndef CLEAVE_OUTPUT
#define CLEAVE_OUTPUT

#include <stdio.h>

#include "base/archive.h"
#include "output_lock.h"
#include "data/particles.h"
#include "data/region.h"
#include "column.h"

enum output_mode { OUTPUT_FIRST, OUTPUT_RESUME, OUTPUT_OVERWRITE }; /* what to do with an older run */

enum { SERIES_MOST = 16 }; /* of frames, besides those of the whole body */

/* Frames of the whole body, or of a region: in folders and with indices of their own. */
struct frame_series {
    char name[NAME_MAX_LENGTH];  /* "": of the body */
    const struct region *region; /* borrowed; NULL: everywhere */
    int frames;                  /* frames written */
    real *frame_time;            /* [s] */
    int64_t *frame_rows;         /* of each frame: particles, and points of coarse cells */
    unsigned frame_fields;       /* bits of the fields that frames have (output_fields.c) */
    struct {                     /* while the particles are the same */
        int32_t *order;          /* [n] those shown, by id, then points of coarse cells, numbered behind them */
        char *room;              /* of a field: the writer's */
        int64_t n, of;           /* rows; of so many particles and points */
    } kept;
};

struct output {
    struct folder_lock lock; /* against a second run in the folder; held while `folder` is set */
    char *folder;            /* DIR */
    int n_series;            /* behind that of the body */
    struct frame_series series[1 + SERIES_MOST];
    bool compress;
    FILE *history;
    int64_t history_bytes; /* length at the last sample */
    uint64_t history_hash; /* of those bytes, one by one */
    int columns;
    bool broken;               /* HDF5 failed to write: it must not be called again */
    struct frame_job *writing; /* a frame on its way to the disk; NULL: none */
    char *frame_copy;          /* what it copies; kept for the next one, whose pages are then there */
    int64_t frame_copy_bytes;
};

/* Once per process, before any other HDF5 call: no exit handler, no error stack on the terminal; SIGXFSZ and
 * SIGPIPE ignored (a full disk must be an error, not a death). */
void output_start(void);

/* Makes DIR and DIR/frames, and takes them for this process. REFUSED while another process runs there; if DIR holds
 * files that are no run's; without OUTPUT_OVERWRITE if it holds the run of another scene (a scene.yaml with other
 * text); and in mode OUTPUT_FIRST if it holds a run of the same one. To resume where nothing has run is to begin,
 * with a line that says so; REFUSED where a run has lost its checkpoints. Removes temporary files of runs, and
 * without OUTPUT_RESUME what the older run left; writes scene.yaml. FAILED if it cannot be made. On a fault nothing
 * is left to close. */
status output_open(struct output *o, const char *folder, const char *scene_text, enum output_mode mode, bool compress);
void output_close(struct output *o);
/* REFUSED if what has the name of the folder frames_NAME in a run's folder is a link or a file. Called before
 * output_open, which removes an older run. */
status output_series_guard(const char *folder, const char *name);
/* Adds a series of frames of a region (borrowed), after output_open: frames_NAME/, NAME.hdf.series and the rest. */
status output_add_series(struct output *o, const char *name, const struct region *region);
/* Do two texts of scenes say the same, wherever their particle lists lie? */
bool scene_text_same(const char *a, const char *b);
/* Does the file hold a scene that says the same? False where it cannot be read. */
bool scene_file_same(const char *path, const char *scene_text);
/* Returns true if a text begins as every scene.yaml that Cleave writes: with the quoted name of the scene. */
bool scene_text_is_written(const char *text);

/* Writes `text` to DIR/name (aside, sync, rename). */
status output_text(const struct output *o, const char *name, const char *text, size_t length);

/* After a restart: takes frames that are gone or cut short out of the indices; how many there are, and through
 * `text` what to say of them. */
status output_frames_check(struct output *o, int *lost, char *text, size_t room);

/* Fields by name, in the order of the table of output_fields.c, and those that only runs that ask for them write: a bit
 * each. Pictures and comparisons read the others. */
#define FRAME_FIELD_WORDS                                                                                              \
    "displacement|velocity|stress|damage|plastic_strain|contact_force|fragment|spacing|kind|material|body|id|"         \
    "von_mises|pressure|principal_stress|principal_directions|speed|strain|density|plastic_work|level"
enum { ASK_STRAIN = 1 << 17, ASK_DENSITY = 1 << 18, ASK_PLASTIC_WORK = 1 << 19, ASK_LEVEL = 1 << 20 };

/* What particles do not keep and the caller works out for fields that a run asks for, [n] each. */
struct frame_state {
    real *gradient[DIM_MAX * DIM_MAX]; /* du_a/dX_b at [a dim + b]; for strain and density [1] */
    real *plastic_work;                /* per volume [J/m^3] */
    real *plastic_strain;              /* of points, and of bonds in the mean; NULL: that of the particles [1] */
    uint8_t *level;                    /* of the coarse cell that a material point is part of; 0: none */
};

/* What frames show besides the particles' own arrays, [n] each; NULL: frames of this run do not have it. */
struct frame_extra {
    real *const *push;            /* [dim] force of contact [N] */
    const int32_t *fragment;      /* number of the fragment, 0: the heaviest; -1: none */
    const struct particles *more; /* points of coarse cells, shown behind the particles; until output_wait */
    real spacing;                 /* of the particles; [more->n] of those points [m] */
    const real *more_spacing;
    unsigned asked;                  /* bits of FRAME_FIELD_WORDS */
    const struct material *material; /* of the particles, borrowed; with strain and density */
    enum space space;
    struct frame_state state, more_state;
};

/* The next frame of the body at time t [s]: frames/NNNNNN.hdf, then frames.hdf.series and frames.xdmf. Particles are
 * written in the order of their id. Single precision but for the reference positions. */
status output_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text);
/* The same, of series k (0: of the body), written by a thread of its own while the particles go on: what changes of
 * them is copied before it returns; they and `scene_text` must stay until output_wait. One frame at a time: the next
 * frame, checkpoints and output_close wait for it. A fault is returned by the call that waits. extra: NULL, nothing;
 * copied likewise. */
status output_frame_begin(struct output *o, int k, const struct particles *p, const struct frame_extra *extra, real t,
                          int64_t step, const char *scene_text);
/* All frames of each series so far as one file for later versions of ParaView, frames.vtkhdf (output_temporal.c): at
 * the end of a run. Nothing where there is no frame, or more than such a file is good for. */
status output_temporal(struct output *o, const char *scene_text);
/* Removes the files that output_temporal of an earlier process wrote: a run that goes on has other frames, and one that
 * fails does not write them again. */
void output_temporal_remove(const struct output *o);
/* The next frame has other particles than the last one, which must be written. */
void output_particles_changed(struct output *o);
/* Until no frame is on its way; OK without one. */
status output_wait(struct output *o);

/* history.csv: header `name [unit],...` of all `columns`, time and step first among them, then one line per sample
 * (%.9g), flushed. With `resume` the file is cut to the length that output_archive restored. */
status output_history_open(struct output *o, const struct column *column, int columns, bool resume);
status output_history(struct output *o, const real *value);

/* Figures read back from a frame, by id; for plot and compare. Arrays are allocated here, freed by frame_free. */
struct frame {
    int64_t n;
    int dim;
    real t;
    int64_t step;
    float *X[DIM_MAX], *u[DIM_MAX], *v[DIM_MAX], *damage;
    float *stress[SYM_MAX]; /* as in struct particles; in the plane zz comes last */
    uint8_t *kind, *material, *body;
    int32_t *id;
    int32_t *fragment; /* NULL: frames of this run do not have it */
    float *spacing;    /* [m] likewise: all have the same */
};
static inline int frame_stresses(int dim) { return symmetric_count(dim) + (dim == 2); }
status frame_read(struct frame *f, const char *path);
void frame_free(struct frame *f);
/* Numbers of a field at the particles of this frame, which was read from `path`, by name: one that follows from what
 * was read (data/derived_fields.h), or one that the file holds. *columns numbers a particle, *value [n columns] row by
 * row, freed with memory_free. FAILED where the frame has no such field. */
status frame_field_read(const struct frame *f, const char *path, const char *name, int *columns, float **value);
/* The frames that frames.hdf.series lists, ascending; how many through `n`. Numbers have gaps where files were lost. */
struct listed_frame {
    int number;
    real time;
};
status frames_list(const char *folder, int *n, struct listed_frame **list);

/* ---- checkpoints ------------------------------------------------------------------------------------------------- */

/* DIR/checkpoint.h5, the one before as checkpoint.previous.h5. `archive_all` saves or restores everything through
 * the archive it is handed. Format version, scene text and a 24-byte footer (magic, length, hash of all bytes
 * before) guard it. */
typedef status archive_all_fn(void *context, struct archive *a);
status checkpoint_write(struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context);
/* Restores from the newest whole checkpoint; falls back to the one before and says so on standard error. FAILED if
 * there is none or it belongs to another scene or version. */
status checkpoint_read(const struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context);
bool checkpoint_exists(const char *folder);
status output_archive(struct output *o, struct archive *a);

#endif
