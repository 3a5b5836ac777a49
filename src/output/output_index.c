/* Writes the index files of a series of output frames (of the whole run or of one region): frames.hdf.series for
 * ParaView, frames.xdmf for VisIt and other readers of XDMF. */
#include "output_index.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory_stream.h"
#include "output/output_files.h"
#include "particles_file.h"

void frame_compose_file_name(const struct frame_series *series, char *name, size_t capacity, int frame_number)
{
    snprintf(name, capacity, "frames%s%s/%06d.hdf", series->name[0] ? "_" : "", series->name, frame_number);
}

void frame_series_compose_index_file_name(const struct frame_series *series, char *name, size_t capacity,
                                          const char *ending)
{
    snprintf(name, capacity, "%s%s", series->name[0] ? series->name : "frames", ending);
}

/* Writes to `out` the text of frames.hdf.series, the index of the output frame series s (the frames of the run or of
 * one region), in JSON: name and time [s] of each frame that is not lost. */
static void series_print(FILE *out, const struct frame_series *s)
{
    const char *between = "";
    fprintf(out, "{\"file-series-version\":\"1.0\",\"files\":[");
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM];
        if (s->entry[k].fields & FRAME_LOST) continue;
        frame_compose_file_name(s, name, sizeof name, k);
        fprintf(out, "%s\n{\"name\":\"%s\",\"time\":%.17g}", between, name, s->entry[k].time);
        between = ",";
    }
    fprintf(out, "\n]}\n");
}

/* Writes to `out` an XDMF reference to the dataset of `field` with n rows. file: path of the file that contains the
 * dataset itself, since readers of XDMF follow no links. */
static void xdmf_item(FILE *out, const char *file, const struct frame_field *field, int64_t n)
{
    static const char *const number[] = {
        [HDF_F32] = "Float", [HDF_F64] = "Float", [HDF_U8] = "UChar", [HDF_I32] = "Int", [HDF_I64] = "Int"};
    fprintf(out, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%zu\" Dimensions=\"%lld", number[field->type],
            hdf_type_size(field->type), (long long)n);
    if (field->columns > 1) fprintf(out, " %d", field->columns);
    fprintf(out, "\">%s:%s</DataItem>", file, field->path);
}

/* Writes to `out` an XDMF attribute: the values of `field` at n points. file: path of the file that contains the
 * field. */
static void xdmf_attribute(FILE *out, const char *file, const struct frame_field *field, int64_t n)
{
    /* A Matrix, not an XDMF Tensor6: XDMF orders the six components differently, and readers would permute them. */
    const char *shape = field->columns == 1 ? "Scalar" : field->columns == 3 ? "Vector" : "Matrix";
    const char *name = strrchr(field->path, '/') + 1;
    fprintf(out, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">", name, shape);
    xdmf_item(out, file, field, n);
    fprintf(out, "</Attribute>\n");
}

/* Writes to `out` the XDMF grid of one output frame. frame, particles: paths of the frame and of its particles file;
 * e: time, number of particles and fields of the frame. */
static void xdmf_grid(FILE *out, const char *frame, const char *particles, const struct frame_entry *e)
{
    fprintf(out, "<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", e->time);
    fprintf(out, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%lld\" NodesPerElement=\"1\">",
            (long long)e->rows);
    /* the XDMF3 reader creates no cells from their number alone */
    xdmf_item(out, particles, &frame_cells[CELLS_CONNECTIVITY], e->rows);
    fprintf(out, "</Topology>\n<Geometry GeometryType=\"XYZ\">");
    xdmf_item(out, frame, &frame_fields[FIELD_POINTS], e->rows);
    fprintf(out, "</Geometry>\n");
    for (int k = FIELD_POINTS + 1; k < FRAME_FIELDS; k++)
        if (frame_fields[k].columns > 0 && e->fields >> k & 1)
            xdmf_attribute(out, frame_fields[k].fixed ? particles : frame, &frame_fields[k], e->rows);
    fprintf(out, "</Grid>\n");
}

/* Writes to `out` the text of frames.xdmf, the index of the output frame series s (the frames of the run or of one
 * region): a collection in time of the XDMF grids of all frames that are not lost. */
static void xdmf_print(FILE *out, const struct frame_series *s)
{
    fprintf(out, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n");
    fprintf(out, "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    for (int k = 0; k < s->frames; k++) {
        char name[PATH_NAME_ROOM], particles[PATH_NAME_ROOM];
        if (s->entry[k].fields & FRAME_LOST) continue;
        frame_compose_file_name(s, name, sizeof name, k);
        particles_file_compose_name(s, particles, sizeof particles, s->entry[k].particles);
        xdmf_grid(out, name, particles, &s->entry[k]);
    }
    fprintf(out, "</Grid>\n</Domain>\n</Xdmf>\n");
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Returns the path of an index file of the output frame series s (the frames of the run or of one region) in the
 * folder of a run. which: 0 for frames.hdf.series, 1 for frames.xdmf. */
static struct path index_path(const char *folder, const struct frame_series *s, int which)
{
    static const char *const end[INDICES] = {".hdf.series", ".xdmf"};
    char name[PATH_NAME_ROOM];
    frame_series_compose_index_file_name(s, name, sizeof name, end[which]);
    return path_join(folder, name);
}

/* Composes in memory, in index->text[which], the text of an index file of the output frame series s (the frames of the
 * run or of one region). which: 0 for frames.hdf.series, 1 for frames.xdmf. folder: folder of the run, for messages.
 * Returns FAILED, with a message, if memory is exhausted. */
static status index_make(struct frame_index_texts *index, const char *folder, const struct frame_series *s, int which)
{
    static void (*const print[INDICES])(FILE *, const struct frame_series *) = {series_print, xdmf_print};
    FILE *out = memory_stream_open(&index->text[which], &index->length[which]);
    if (out) print[which](out, s);
    const bool whole = out && fclose(out) == 0;
    return whole ? OK : file_report_write_failure(index_path(folder, s, which).text, ENOMEM);
}

status frame_index_files_compose_texts(struct frame_index_texts *index, const char *folder,
                                       const struct frame_series *series)
{
    for (int k = 0; k < INDICES; k++) TRY(index_make(index, folder, series, k));
    return OK;
}

status frame_index_files_write(const struct frame_index_texts *index, const char *folder,
                               const struct frame_series *series)
{
    for (int k = 0; k < INDICES; k++)
        TRY(file_write_whole(index_path(folder, series, k).text, index->text[k], index->length[k]));
    return OK;
}

void frame_index_files_free_texts(struct frame_index_texts *index)
{
    for (int k = 0; k < INDICES; k++) free(index->text[k]);
    *index = (struct frame_index_texts){0};
}
