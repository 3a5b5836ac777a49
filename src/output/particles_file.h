/* The particles file of a series of frames, particles_NNNNNN.h5 in the folder of the frames: what does not change while
 * the particles stay the same. It is written before the first frame that uses it, whose number it has, and never
 * again; frames link to its datasets, which have the same paths as in a frame that is complete by itself. Another one
 * is written once particles or material points of coarse cells are added or lost, that is, once its contents differ.
 * Frames and particles file have the same hash of these contents, so that a frame beside the file of another run is
 * recognised. */
#ifndef CLEAVE_PARTICLES_FILE
#define CLEAVE_PARTICLES_FILE

#include "output_fields.h"
#include "output/output_files.h"

/* Contents of a particles file, the fields that do not change between frames, copied from the particles. */
struct particles_file {
    struct path path;
    int64_t n; /* number of rows */
    int dim;
    unsigned fields; /* bit set of all fields of the frames; the units of all of them are listed in the file */
    int64_t content; /* hash of the contents */
    char *rows;      /* the fixed fields one after the other; NULL: the file is there already */
    int32_t *cells;  /* [n + 1] buffer for the lists of cells */
    bool compress;
    const char *scene_text; /* borrowed */
};

/* Writes the name of particles file `number` of a series, relative to the folder of the run, to `name`, which holds
 * `capacity` bytes. */
void particles_file_name(const struct frame_series *s, char *name, size_t capacity, int number);

/* Copies the contents of the particles file for the rows of a series from *source to *f, and computes their hash.
 * fields: bit set of the fields of the frames. Release with particles_file_free. */
void particles_file_make(struct particles_file *f, const struct frame_series *s, const struct frame_source *source,
                         unsigned fields, const char *scene_text);

/* Writes the particles file f->path unless it is there, whole, with the same contents. Sets *broken if HDF5 failed and
 * must not be called again. Returns FAILED if the file cannot be written. */
status particles_file_write(const struct particles_file *f, bool *broken);

/* Releases the contents of *f. */
void particles_file_free(struct particles_file *f);

/* Creates the links of a frame to the particles file. fields: bit set of the fields of the frame. */
void particles_file_create_links(struct hdf *frame, const struct particles_file *f, unsigned fields);

/* Reads the hash of the contents of the particles file `path` into *content; 0, which is the hash of none, if the file
 * is a frame or another file of a run. Returns false if the file cannot be read. */
bool particles_file_read_content(const char *path, int64_t *content);

/* Checks the particles file `path`. Stores the hash of its contents in *content. Returns NULL if the file is whole,
 * else a phrase that completes "PATH ..." in a message (a static text). */
const char *particles_file_describe_damage(const char *path, int64_t *content);

/* Checks the particles file to which the open frame h, the file `path`, links. Returns OK if it is whole and belongs to
 * the frame, or if the frame is complete by itself, as those of earlier versions; else FAILED. */
status particles_file_check(struct hdf *h, const char *path);

#endif
