/* Index files of a series of frames, which list the frames with their times for ParaView. */
#ifndef CLEAVE_OUTPUT_INDEX
#define CLEAVE_OUTPUT_INDEX

#include "output/output.h"

/* Number of index files of a series of frames: frames.hdf.series and frames.xdmf. */
enum { INDICES = 2 };

/* Texts of the index files of one series of frames (the frames of the whole body or of one region), owned. */
struct frame_index_texts {
    char *text[INDICES];
    size_t length[INDICES]; /* [byte] */
};

/* Composes the texts of both index files of a series of output frames (states at output times), frames.hdf.series and
 * frames.xdmf, in memory and stores them in *index, which the caller has set to zero. folder: folder of the run, for
 * messages. Returns FAILED if memory is exhausted. Release *index with frame_index_files_free_texts in any case. */
status frame_index_files_compose_texts(struct frame_index_texts *index, const char *folder,
                                       const struct frame_series *series);

/* Writes the composed texts in *index as the index files of `series`, the output frames of a run, to `folder`, the
 * folder of the run. Returns FAILED if one cannot be written. */
status frame_index_files_write(const struct frame_index_texts *index, const char *folder,
                               const struct frame_series *series);

/* Frees the texts in *index, which frame_index_files_compose_texts has allocated. */
void frame_index_files_free_texts(struct frame_index_texts *index);

/* Writes the file name of frame number `frame_number` of a series of output frames (states at output times), relative
 * to the folder of the run, to name[capacity]: frames/NNNNNN.hdf for the whole body, frames_REGION/NNNNNN.hdf for a
 * region. A longer name is cut. */
void frame_compose_file_name(const struct frame_series *series, char *name, size_t capacity, int frame_number);

/* Writes the name of an index file of a series of output frames (states at output times), relative to the folder of the
 * run, to name[capacity]: the name of the region, or `frames` for the whole body, followed by the ending `ending`. A
 * longer name is cut. */
void frame_series_compose_index_file_name(const struct frame_series *series, char *name, size_t capacity,
                                          const char *ending);

#endif
