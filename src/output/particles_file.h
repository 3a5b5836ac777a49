/* Declares the functions that write and check particles files. A particles file, particles_NNNNNN.h5 in the folder of
 * the output frames (states at output times), stores the data that stay the same in many frames. It is written once,
 * before the first frame that uses it, and has the number of this frame. Frames link to its datasets, which have the
 * paths that they would have in the frame itself. A new particles file is written once its contents would differ, i.e.
 * once particles or material points of coarse cells are added or removed. Frames and their particles file store one
 * hash of these contents, by which a particles file of another run is recognised. */
#ifndef CLEAVE_PARTICLES_FILE
#define CLEAVE_PARTICLES_FILE

#include "output_fields.h"
#include "output/output_files.h"

/* Contents of one particles file: the fields of the particles that do not change between output frames, copied from the
 * particles. Made by particles_file_collect_contents for one file, released by particles_file_free. */
struct particles_file {
    struct path path; /* path of the file */
    int64_t n;        /* number of rows */
    int dim;
    unsigned fields;        /* bit set of all fields of the frames; the units of all of them are listed in the file */
    int64_t content;        /* hash of the contents */
    char *rows;             /* the fixed fields one after the other; NULL: the file is there already */
    int32_t *cells;         /* [n + 1] buffer for the lists of cells */
    bool compress;          /* with gzip */
    const char *scene_text; /* borrowed */
};

/* Writes the name of particles file number `file_number` (the data that do not change between output frames) of a
 * series of output frames (states at output times), relative to the folder of the run, to name[capacity]:
 * frames/particles_NNNNNN.h5 for the whole body, frames_REGION/... for a region. A longer name is cut. */
void particles_file_compose_name(const struct frame_series *series, char *name, size_t capacity, int file_number);

/* Initialises *f with the contents of a particles file, the data that do not change from one output frame to the next:
 * copies the fields in the set `field_bits` (one bit per entry of frame_fields) from *source for the particles of which
 * `series` has rows, and computes a hash of the contents. scene_text: text of the input file, which the file contains.
 * Release f with particles_file_free. */
void particles_file_collect_contents(struct particles_file *f, const struct frame_series *series,
                                     const struct frame_contents *source, unsigned field_bits, const char *scene_text);

/* Writes the particles file f->path (the data that do not change between output frames), unless a complete file with
 * the same contents exists. Sets *hdf5_failed to true if HDF5 failed and must not be called again. Returns FAILED if
 * the file cannot be written. */
status particles_file_write(const struct particles_file *f, bool *hdf5_failed);

/* Frees the contents of *f, which particles_file_collect_contents has copied. */
void particles_file_free(struct particles_file *f);

/* Creates in the file `frame`, an output frame (state at one time), a link to each of its fields that is stored in the
 * particles file f (the data that do not change between output frames). field_bits: fields of the frame, one bit per
 * entry of the table frame_fields. A failure is stored in frame->failed. */
void particles_file_link_fields_into_frame(struct hdf *frame, const struct particles_file *f, unsigned field_bits);

/* Reads the hash of the contents of the particles file `path` (the data that do not change between output frames) into
 * *content_hash. If the file is an output frame or another file of a run, *content_hash is 0, which is the hash of no
 * particles file. Returns false if the file cannot be read. */
bool particles_file_read_content_hash(const char *path, int64_t *content_hash);

/* Checks the particles file `path` (the data that do not change between output frames) and stores the hash of its
 * contents in *content_hash. Returns NULL if the file is complete and unchanged, else a static text that completes
 * "PATH ..." in a message. */
const char *particles_file_find_fault_and_content_hash(const char *path, int64_t *content_hash);

/* Checks the particles file (the data that do not change between output frames) to which `frame`, the open file `path`
 * of an output frame (state at one time), links. Returns OK if it is complete and belongs to the frame, or if the frame
 * needs none, as frames of earlier versions; else FAILED. */
status frame_check_linked_particles_file(struct hdf *frame, const char *path);

#endif
