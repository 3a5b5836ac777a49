/* floor 4: frames in VTKHDF, each a whole file, and their two indices: frames.hdf.series and frames.xdmf.
 *
 * Written for the reader of VTK 9.1 (ParaView 5.11): a static UnstructuredGrid with one vertex cell per particle.
 * Our own data live in /Cleave. A symmetric tensor has VTK's order xx yy zz xy yz xz; components that the
 * dimension does not have are 0. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "output.h"
#include "output_files.h"
#include "output_hdf5.h"

enum { FRAME_VERSION = 1, VTK_VERTEX = 1 };

/* ---- the table of fields --------------------------------------------------------------------------- */

/* One dataset with a row per particle. `fill` writes the row of particle i; `columns` 0 stands for dim. */
struct frame_field {
    const char *path;
    enum hdf_type type;
    int columns;
    void (*fill)(const struct particles *p, int64_t i, void *row);
};

static void fill_point(const struct particles *p, int64_t i, void *row)
{
    for (int d = 0; d < DIM_MAX; d++) ((float *)row)[d] = d < p->dim ? (float)p->x[d][i] : 0;
}

static void fill_displacement(const struct particles *p, int64_t i, void *row)
{
    for (int d = 0; d < DIM_MAX; d++) ((float *)row)[d] = d < p->dim ? (float)(p->x[d][i] - p->X[d][i]) : 0;
}

static void fill_velocity(const struct particles *p, int64_t i, void *row)
{
    for (int d = 0; d < DIM_MAX; d++) ((float *)row)[d] = d < p->dim ? (float)p->v[d][i] : 0;
}

static void fill_stress(const struct particles *p, int64_t i, void *row)
{
    /* Place of our k-th component in VTK's order; differs only in 2D: xx yy xy. */
    static const int place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    float *out = row;
    for (int k = 0; k < SYM_MAX; k++) out[k] = 0;
    for (int k = 0; k < symmetric_count(p->dim); k++) out[place[p->dim][k]] = (float)p->stress[k][i];
}

static void fill_reference(const struct particles *p, int64_t i, void *row)
{
    for (int d = 0; d < p->dim; d++) ((double *)row)[d] = p->X[d][i];
}

static void fill_damage(const struct particles *p, int64_t i, void *row) { *(float *)row = (float)p->damage[i]; }
static void fill_kind(const struct particles *p, int64_t i, void *row) { *(uint8_t *)row = p->kind[i]; }
static void fill_material(const struct particles *p, int64_t i, void *row) { *(uint8_t *)row = p->material[i]; }
static void fill_body(const struct particles *p, int64_t i, void *row) { *(uint8_t *)row = p->body[i]; }
static void fill_id(const struct particles *p, int64_t i, void *row) { *(int32_t *)row = p->id[i]; }

static void fill_plastic_strain(const struct particles *p, int64_t i, void *row)
{
    *(float *)row = (float)p->plastic_strain[i];
}

#define POINT_DATA "/VTKHDF/PointData/"
enum { FIELD_POINTS };                   /* where in the table the positions stand */
static const struct frame_field frame_fields[] = {
    {"/VTKHDF/Points", HDF_F32, 3, fill_point},
    {POINT_DATA "displacement", HDF_F32, 3, fill_displacement},
    {POINT_DATA "velocity", HDF_F32, 3, fill_velocity},
    {POINT_DATA "stress", HDF_F32, 6, fill_stress},
    {POINT_DATA "damage", HDF_F32, 1, fill_damage},
    {POINT_DATA "plastic_strain", HDF_F32, 1, fill_plastic_strain},
    {POINT_DATA "kind", HDF_U8, 1, fill_kind},
    {POINT_DATA "material", HDF_U8, 1, fill_material},
    {POINT_DATA "body", HDF_U8, 1, fill_body},
    {POINT_DATA "id", HDF_I32, 1, fill_id},
    {"/Cleave/reference", HDF_F64, 0, fill_reference},
};

/* Plastic strain is there only if a material yields. */
static bool field_exists(const struct frame_field *field, bool yielding)
{
    return yielding || field->fill != fill_plastic_strain;
}

/* ---- one frame ------------------------------------------------------------------------------------- */

/* Indices of the body in the order of their ids, which are unique but may have gaps. Free with memory_free. */
static int32_t *order_by_id(const struct particles *p)
{
    int64_t room = 0, k = 0;
    for (int64_t i = 0; i < p->n; i++) room = p->id[i] >= room ? (int64_t)p->id[i] + 1 : room;
    int32_t *order = NEW("output.order", room, int32_t);
    for (int64_t i = 0; i < p->n; i++) order[p->id[i]] = (int32_t)i + 1;
    for (int64_t id = 0; id < room; id++)
        if (order[id]) order[k++] = order[id] - 1;
    assert(k == p->n);
    return order;
}

static void write_field(struct hdf *f, const struct frame_field *field, const struct particles *p, const int32_t *order)
{
    int columns = field->columns ? field->columns : p->dim;
    size_t row = hdf_size(field->type) * (size_t)columns;
    char *data = NEW("output.field", p->n * (int64_t)row, char);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < p->n; k++) field->fill(p, order[k], data + (size_t)k * row);
    hdf_rows(f, field->path, field->type, p->n, columns, data);
    memory_free(data);
}

/* One vertex cell per particle: the k-th cell is point k and starts at k. */
static void write_cells(struct hdf *f, int64_t n)
{
    int64_t *number = NEW("output.cells", n + 1, int64_t);
    for (int64_t k = 0; k <= n; k++) number[k] = k;
    hdf_rows(f, "/VTKHDF/NumberOfPoints", HDF_I64, 1, 1, &n);
    hdf_rows(f, "/VTKHDF/NumberOfCells", HDF_I64, 1, 1, &n);
    hdf_rows(f, "/VTKHDF/NumberOfConnectivityIds", HDF_I64, 1, 1, &n);
    hdf_rows(f, "/VTKHDF/Connectivity", HDF_I64, n, 1, number);
    hdf_rows(f, "/VTKHDF/Offsets", HDF_I64, n + 1, 1, number);
    memory_free(number);
    uint8_t *type = NEW("output.types", n, uint8_t);
    if (n > 0) memset(type, VTK_VERTEX, (size_t)n);
    hdf_rows(f, "/VTKHDF/Types", HDF_U8, n, 1, type);
    memory_free(type);
}

static void write_marks(struct hdf *f, int dim, real t, int64_t step, const char *scene_text)
{
    static const int32_t vtk_version[2] = {1, 0}, version = FRAME_VERSION;
    int32_t dimension = dim;
    hdf_group(f, "/VTKHDF");
    hdf_mark(f, "/VTKHDF", "Version", HDF_I32, 2, vtk_version);
    hdf_mark_text(f, "/VTKHDF", "Type", "UnstructuredGrid");
    hdf_group(f, "/VTKHDF/PointData");
    hdf_group(f, "/Cleave");
    hdf_mark_one(f, "/Cleave", "version", HDF_I32, &version);
    hdf_mark_one(f, "/Cleave", "dim", HDF_I32, &dimension);
    hdf_mark_one(f, "/Cleave", "time", HDF_F64, &t);
    hdf_mark_one(f, "/Cleave", "step", HDF_I64, &step);
    hdf_text(f, "/Cleave/scene", scene_text);
}

/* Writes PATH.tmp and publishes it. */
static status frame_write(struct output *o, const char *path, const struct particles *p, real t, int64_t step,
                          const char *scene_text)
{
    struct hdf f;
    hdf_create(&f, path_aside(path).text, o->compress);
    write_marks(&f, p->dim, t, step, scene_text);
    write_cells(&f, p->n);
    int32_t *order = order_by_id(p);
    for (size_t k = 0; k < COUNT_OF(frame_fields); k++)
        if (field_exists(&frame_fields[k], p->plastic_strain != NULL)) write_field(&f, &frame_fields[k], p, order);
    memory_free(order);
    if (!f.failed) hdf_close(&f);
    if (f.failed) {
        o->broken = true;
        file_discard(path);
        return file_fault(path, f.cause);
    }
    TRY(file_seal(path, NULL, 0));
    return file_publish(path);
}

/* ---- indices --------------------------------------------------------------------------------------- */

/* Name of frame `number` relative to the run's folder. */
static void frame_name(char *name, size_t room, int number) { snprintf(name, room, "frames/%06d.hdf", number); }

static void series_print(FILE *out, const struct output *o)
{
    fprintf(out, "{\"file-series-version\":\"1.0\",\"files\":[\n");
    for (int k = 0; k < o->frames; k++) {
        char name[PATH_NAME_ROOM];
        frame_name(name, sizeof name, k);
        fprintf(out, "{\"name\":\"%s\",\"time\":%.17g}%s\n", name, o->frame_time[k], k + 1 < o->frames ? "," : "");
    }
    fprintf(out, "]}\n");
}

/* A whole dataset of a frame. */
static void xdmf_item(FILE *out, const char *frame, const struct frame_field *field, int64_t n)
{
    static const char *const number[] = {[HDF_F32] = "Float", [HDF_F64] = "Float", [HDF_U8] = "UChar",
                                         [HDF_I32] = "Int", [HDF_I64] = "Int"};
    fprintf(out, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%zu\" Dimensions=\"%lld", number[field->type],
            hdf_size(field->type), (long long)n);
    if (field->columns > 1) fprintf(out, " %d", field->columns);
    fprintf(out, "\">%s:%s</DataItem>", frame, field->path);
}

static void xdmf_attribute(FILE *out, const char *frame, const struct frame_field *field, int64_t n)
{
    /* The six components are no XDMF tensor: that one has another order, and readers would permute them. */
    const char *shape = field->columns == 1 ? "Scalar" : field->columns == 3 ? "Vector" : "Matrix";
    const char *name = strrchr(field->path, '/') + 1;
    fprintf(out, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">", name, shape);
    xdmf_item(out, frame, field, n);
    fprintf(out, "</Attribute>\n");
}

static void xdmf_grid(FILE *out, const char *frame, real t, int64_t n, bool yielding)
{
    /* Named, because the XDMF3 reader makes no cells from a count alone. */
    static const struct frame_field vertices = {"/VTKHDF/Connectivity", HDF_I64, 1, NULL};
    fprintf(out, "<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"%.17g\"/>\n", t);
    fprintf(out, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%lld\" NodesPerElement=\"1\">",
            (long long)n);
    xdmf_item(out, frame, &vertices, n);
    fprintf(out, "</Topology>\n<Geometry GeometryType=\"XYZ\">");
    xdmf_item(out, frame, &frame_fields[FIELD_POINTS], n);
    fprintf(out, "</Geometry>\n");
    for (size_t k = FIELD_POINTS + 1; k < COUNT_OF(frame_fields); k++)
        if (frame_fields[k].columns > 0 && field_exists(&frame_fields[k], yielding))
            xdmf_attribute(out, frame, &frame_fields[k], n);
    fprintf(out, "</Grid>\n");
}

static void xdmf_print(FILE *out, const struct output *o)
{
    fprintf(out, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n");
    fprintf(out, "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    for (int k = 0; k < o->frames; k++) {
        char name[PATH_NAME_ROOM];
        frame_name(name, sizeof name, k);
        xdmf_grid(out, name, o->frame_time[k], o->frame_particles, o->frame_yielding);
    }
    fprintf(out, "</Grid>\n</Domain>\n</Xdmf>\n");
}

/* Composes a text in memory and writes it as DIR/name. */
static status index_write(const struct output *o, const char *name, void (*print)(FILE *, const struct output *))
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out) print(out, o);
    bool whole = out && !ferror(out);
    if (out && fclose(out) != 0) whole = false;
    status s = whole ? output_text(o, name, text, length) : file_fault(path_join(o->folder, name).text, ENOMEM);
    free(text);
    return s;
}

status output_frame(struct output *o, const struct particles *p, real t, int64_t step, const char *scene_text)
{
    char name[PATH_NAME_ROOM];
    if (o->broken) return FAILED;
    frame_name(name, sizeof name, o->frames);
    TRY(frame_write(o, path_join(o->folder, name).text, p, t, step, scene_text));
    if (o->frames == o->frames_room) {
        int room = 2 * o->frames_room + 16;
        o->frame_time = memory_resize("output.frame_time", o->frame_time, o->frames_room, room, sizeof(real));
        o->frames_room = room;
    }
    o->frame_time[o->frames++] = t;
    o->frame_particles = p->n;
    o->frame_yielding = p->plastic_strain != NULL;
    TRY(index_write(o, "frames.hdf.series", series_print));
    return index_write(o, "frames.xdmf", xdmf_print);
}
