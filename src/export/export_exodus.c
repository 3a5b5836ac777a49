/* Exports the particles of a scene, or the frames of a run, as an Exodus II file (Schoof, Yarberry 1994): spheres in
 * one block for each material of the scene file, empty where no body consists of it, with radius and volume as
 * attributes; the particles on which loads act as node sets; fields over time. Nodes and elements have the same
 * numbers, and there are always three coordinates, as Peridigm requires. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "export_mesh.h"
#include "netcdf_write.h"
#include "output/output.h"
#include "output/output_files.h"

/* Sizes of names and of lines of text in the file, with the terminating zero [byte]; largest number of variables at
 * nodes, and at elements. */
enum { NAME_WIDTH = 33, LINE_WIDTH = 81, VARIABLES_MOST = 32 };
#define EXODUS_SIGN ", exported by Cleave" /* end of the title, by which a file is recognised as an export */

/* A number over time at every particle, as a variable of the file. field: index of the field of frames; component:
 * index of its component, or -1 for a component that 2D lacks, whose value is 0. */
struct variable {
    char name[NAME_WIDTH];
    int field, component;
};

/* Fields of frames (outputs of all particles at one time) that are exported, if the run has them. nodal: true for
 * vectors, which are stored at nodes; the others are stored as values of elements. */
static const struct exported_field {
    const char *name;
    bool nodal;
} fields[] = {{"displacement", true},    {"velocity", true}, {"damage", false},  {"stress", false},
              {"plastic_strain", false}, {"kind", false},    {"fragment", false}};
enum { FIELDS = COUNT_OF(fields) }; /* number of fields of frames that can be exported */

/* An export of a scene or of the frames of a run to an Exodus II file. */
struct exodus_export {
    const struct export_request *request;
    struct export_mesh mesh;
    const char *folder; /* folder of the run; NULL: a scene is exported */
    int frames;
    struct listed_frame *frame;                  /* [frames] */
    int variables[2];                            /* number of variables at elements [0], at nodes [1] */
    struct variable variable[2][VARIABLES_MOST]; /* [variables[k]] */
    int width[FIELDS];                           /* number of components of each field; 0: the run lacks the field */
    char title[LINE_WIDTH], rows[3][LINE_WIDTH]; /* title of the file; lines of information */
    struct netcdf_writer w;
};

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Appends the components of field number `field` (index in `fields`) to the variables of the Exodus file x. Their names
 * end in _x or _xx, by which readers of Exodus files join them to vectors and tensors. Components that a 2D run lacks
 * are added as well, with component -1; their values are written as 0. */
static void variables_add(struct exodus_export *x, int field)
{
    static const char *const vector[] = {"_x", "_y", "_z"}, *const tensor[] = {"_xx", "_yy", "_zz",
                                                                               "_xy", "_yz", "_zx"};
    const bool nodal = fields[field].nodal;
    const int n = x->width[field] == 1 ? 1 : x->width[field] <= DIM_MAX ? DIM_MAX : SYM_MAX;
    for (int c = 0; c < n; c++) {
        struct variable *v = &x->variable[nodal][x->variables[nodal]++];
        v->field = field, v->component = c < x->width[field] ? c : -1;
        snprintf(v->name, sizeof v->name, "%s%s", fields[field].name,
                 n == 1         ? ""
                 : n == DIM_MAX ? vector[c]
                                : tensor[c]);
    }
}

/* Lists the frames (outputs at one time) of the run in x->folder, and appends the variables of the fields that the
 * first frame has. Returns REFUSED if the run has no frames, FAILED if they or the first frame cannot be read. */
static status frames_open(struct exodus_export *x)
{
    struct output_frame f;
    TRY(run_list_frames(x->folder, &x->frames, &x->frame));
    if (x->frames == 0)
        return status_set(REFUSED, "%s: this run has no frames; give a finished run", printable_name(x->folder).text);
    const struct path path = run_frame_path(x->folder, x->frame[0].number);
    TRY(frame_read(&f, path.text));
    for (int k = 0; k < FIELDS; k++) {
        float *value = NULL;
        if (frame_field_read(&f, path.text, fields[k].name, &x->width[k], &value) == OK)
            variables_add(x, k);
        else
            x->width[k] = 0;
        memory_free(value);
    }
    frame_free(&f);
    return OK;
}

/* Checks that the frame f (output at one time) has the particles of the mesh exported by x, as an Exodus file has one
 * list of elements for all times. Returns OK, or REFUSED with a message. */
static status frame_check(const struct exodus_export *x, const struct output_frame *f)
{
    const struct particles *p = &x->mesh.e->part;
    bool same = f->n == x->mesh.n;
    for (int64_t i = 0; i < x->mesh.n && same; i++)
        same = p->id[i] >= 0 && p->id[i] < f->n && f->id[p->id[i]] == p->id[i];
    if (same) return OK;
    return status_set(REFUSED,
                      "%s: at %.6g s the run has %lld of the %lld particles of its body, but an Exodus file needs the "
                      "same particles at all times; run the scene again with -s mpm.fill=all -s mpm.levels=0",
                      printable_name(x->folder).text, f->t, (long long)f->n, (long long)x->mesh.n);
}

/* Writes the variables of frame (output at one time) number k of the list x->frame as one record of the file, in the
 * order in which the arrays were defined. Returns FAILED if the frame cannot be read, REFUSED if it has other particles
 * or components than the first one. */
static status exodus_frame_write(struct exodus_export *x, int k)
{
    const struct export_mesh *m = &x->mesh;
    const struct path path = run_frame_path(x->folder, x->frame[k].number);
    struct output_frame f;
    float *value[FIELDS] = {NULL};
    TRY(frame_read(&f, path.text));
    status s = frame_check(x, &f);
    for (int field = 0; field < FIELDS && s == OK; field++) {
        int columns = 0;
        if (x->width[field] > 0) s = frame_field_read(&f, path.text, fields[field].name, &columns, &value[field]);
        if (s == OK && columns != x->width[field])
            s = status_set(REFUSED,
                           "%s: the field %s has other components than in the first frame; run the scene again",
                           path.text, fields[field].name);
    }
    real *numbers = NEW("export.numbers", m->n, real);
    if (s == OK) netcdf_write_reals(&x->w, 1, &f.t);
    for (int nodal = 1; nodal >= 0 && s == OK; nodal--)
        for (int v = 0; v < x->variables[nodal]; v++) {
            const struct variable *of = &x->variable[nodal][v];
            const int width = x->width[of->field];
            for (int64_t i = 0; i < m->n; i++) {
                const int64_t row = m->e->part.id[m->particle[i]];
                numbers[i] = of->component < 0 ? 0 : value[of->field][row * width + of->component];
            }
            netcdf_write_reals(&x->w, m->n, numbers); /* blocks follow each other as elements do */
        }
    memory_free(numbers);
    for (int field = 0; field < FIELDS; field++) memory_free(value[field]);
    frame_free(&f);
    return s;
}

/* ---- definitions ------------------------------------------------------------------------------------------------- */

static int64_t block_size(const struct export_mesh *m, int material)
{
    return m->first[material + 1] - m->first[material];
}

/* Identifiers of the netCDF dimensions that several arrays of the file share. */
struct shared {
    int records, dim, nodes, blocks, sets, name, line, rows;
};

/* Defines the arrays of the element blocks of the Exodus file x, one block for each material that has particles. d:
 * dimensions that several arrays have in common; over[materials]: receives the index of the dimension of each block,
 * whose length is the number of elements in the block. */
static void blocks_define(struct exodus_export *x, const struct shared *d, int *over)
{
    struct netcdf_writer *w = &x->w;
    netcdf_define_array(w, "eb_status", 0, NETCDF_INT, 1, &d->blocks, NULL, NULL);
    netcdf_define_array(w, "eb_prop1", 0, NETCDF_INT, 1, &d->blocks, "name", "ID");
    netcdf_define_array(w, "eb_names", 0, NETCDF_CHAR, 2, (const int[]){d->blocks, d->name}, NULL, NULL);
    for (int m = 0; m < x->mesh.materials; m++) {
        if (block_size(&x->mesh, m) == 0) continue;
        over[m] = netcdf_define_dimension(w, "num_el_in_blk", m + 1, block_size(&x->mesh, m));
        const int one = netcdf_define_dimension(w, "num_nod_per_el", m + 1, 1);
        const int two = netcdf_define_dimension(w, "num_att_in_blk", m + 1, 2);
        netcdf_define_array(w, "connect", m + 1, NETCDF_INT, 2, (const int[]){over[m], one}, "elem_type", "SPHERE");
        netcdf_define_array(w, "attrib", m + 1, NETCDF_DOUBLE, 2, (const int[]){over[m], two}, NULL, NULL);
        netcdf_define_array(w, "attrib_name", m + 1, NETCDF_CHAR, 2, (const int[]){two, d->name}, NULL, NULL);
    }
}

static void sets_define(struct exodus_export *x, const struct shared *d)
{
    struct netcdf_writer *w = &x->w;
    const struct loads *l = &x->mesh.e->loads;
    if (l->n == 0) return;
    netcdf_define_array(w, "ns_status", 0, NETCDF_INT, 1, &d->sets, NULL, NULL);
    netcdf_define_array(w, "ns_prop1", 0, NETCDF_INT, 1, &d->sets, "name", "ID");
    netcdf_define_array(w, "ns_names", 0, NETCDF_CHAR, 2, (const int[]){d->sets, d->name}, NULL, NULL);
    for (int k = 0; k < l->n; k++) {
        if (l->load[k].n == 0) continue;
        const int over = netcdf_define_dimension(w, "num_nod_ns", k + 1, l->load[k].n);
        netcdf_define_array(w, "node_ns", k + 1, NETCDF_INT, 1, &over, NULL, NULL);
    }
}

/* Defines the arrays with names and values of the variables of the Exodus file x. The arrays that have an entry for
 * each time are the last ones, in the order in which records are written. d: dimensions that several arrays have in
 * common; over[materials]: index of the dimension of each element block, as stored by blocks_define. */
static void variables_define(struct exodus_export *x, const struct shared *d, const int *over)
{
    struct netcdf_writer *w = &x->w;
    static const char *const counts[] = {"num_elem_var", "num_nod_var"}, *const names[] = {"name_elem_var",
                                                                                           "name_nod_var"};
    for (int nodal = 1; nodal >= 0; nodal--) {
        if (x->variables[nodal] == 0) continue;
        const int n = netcdf_define_dimension(w, counts[nodal], 0, x->variables[nodal]);
        netcdf_define_array(w, names[nodal], 0, NETCDF_CHAR, 2, (const int[]){n, d->name}, NULL, NULL);
    }
    netcdf_define_array(w, "time_whole", 0, NETCDF_DOUBLE, 1, &d->records, NULL, NULL);
    for (int v = 0; v < x->variables[1]; v++)
        netcdf_define_array(w, "vals_nod_var", v + 1, NETCDF_DOUBLE, 2, (const int[]){d->records, d->nodes}, NULL,
                            NULL);
    for (int v = 0; v < x->variables[0]; v++)
        for (int m = 0; m < x->mesh.materials; m++) {
            char name[NETCDF_NAME];
            snprintf(name, sizeof name, "vals_elem_var%deb", v + 1);
            if (block_size(&x->mesh, m) == 0) continue;
            netcdf_define_array(w, name, m + 1, NETCDF_DOUBLE, 2, (const int[]){d->records, over[m]}, NULL, NULL);
        }
}

/* Defines all dimensions, arrays and attributes of the Exodus file x, in the order in which their contents are written.
 * attribute[attributes]: attributes of the file, kept by reference until the header has been written. */
static void all_define(struct exodus_export *x, const struct netcdf_attribute *attribute, int attributes)
{
    static const char *const axes[] = {"coordx", "coordy", "coordz"};
    struct netcdf_writer *w = &x->w;
    const struct export_mesh *m = &x->mesh;
    struct shared d;
    int *over = NEW("export.blocks", m->materials, int);
    w->attribute = attribute, w->attributes = attributes, w->records = x->frames;
    d.records = netcdf_define_dimension(w, "time_step", 0, 0);
    netcdf_define_dimension(w, "len_string", 0, NAME_WIDTH);
    d.line = netcdf_define_dimension(w, "len_line", 0, LINE_WIDTH);
    netcdf_define_dimension(w, "four", 0, 4);
    d.name = netcdf_define_dimension(w, "len_name", 0, NAME_WIDTH);
    d.dim = netcdf_define_dimension(w, "num_dim", 0, DIM_MAX);
    d.nodes = netcdf_define_dimension(w, "num_nodes", 0, m->n);
    netcdf_define_dimension(w, "num_elem", 0, m->n);
    d.blocks = netcdf_define_dimension(w, "num_el_blk", 0, m->materials);
    d.sets = m->e->loads.n > 0 ? netcdf_define_dimension(w, "num_node_sets", 0, m->e->loads.n) : -1;
    d.rows = netcdf_define_dimension(w, "num_info", 0, m->materials + 1);
    netcdf_define_array(w, "info_records", 0, NETCDF_CHAR, 2, (const int[]){d.rows, d.line}, NULL, NULL);
    netcdf_define_array(w, "coor_names", 0, NETCDF_CHAR, 2, (const int[]){d.dim, d.name}, NULL, NULL);
    for (int k = 0; k < DIM_MAX; k++) netcdf_define_array(w, axes[k], 0, NETCDF_DOUBLE, 1, &d.nodes, NULL, NULL);
    blocks_define(x, &d, over);
    sets_define(x, &d);
    variables_define(x, &d, over);
    memory_free(over);
}

/* ---- contents ---------------------------------------------------------------------------------------------------- */

/* Writes spacing, horizon and materials of the exported scene as lines of text to the array info_records of the Exodus
 * file x. */
static void info_write(struct exodus_export *x)
{
    const struct scene *s = &x->mesh.scene;
    char line[2 * LINE_WIDTH];
    snprintf(line, sizeof line, "spacing %.9g m, horizon %.9g m", s->spacing, s->horizon * s->spacing);
    netcdf_write_text_row(&x->w, line, LINE_WIDTH);
    for (int k = 0; k < x->mesh.materials; k++) {
        const struct material *m = scene_find_material_by_number(s, k);
        snprintf(line, sizeof line, "block_%d: %.24s: density %.5g kg/m^3, E %.5g Pa, nu %.4g", k + 1, m->name,
                 m->density, m->young, m->poisson);
        netcdf_write_text_row(&x->w, line, LINE_WIDTH);
    }
    netcdf_end_array(&x->w);
}

static void coordinates_write(struct exodus_export *x)
{
    static const char *const axis[] = {"x", "y", "z"};
    const struct particles *p = &x->mesh.e->part;
    real *numbers = NEW("export.numbers", x->mesh.n, real);
    for (int d = 0; d < DIM_MAX; d++) netcdf_write_text_row(&x->w, axis[d], NAME_WIDTH);
    netcdf_end_array(&x->w);
    for (int d = 0; d < DIM_MAX; d++) {
        for (int64_t k = 0; k < x->mesh.n; k++) numbers[k] = d < p->dim ? p->X[d][x->mesh.particle[k]] : 0;
        netcdf_write_reals(&x->w, x->mesh.n, numbers);
        netcdf_end_array(&x->w);
    }
    memory_free(numbers);
}

/* Writes the element block of material number `material` to the Exodus file x: the nodes of its elements, and the
 * attributes radius [m] and volume [m^3] of the spheres that represent the particles. */
static void block_write(struct exodus_export *x, int material)
{
    const int64_t first = x->mesh.first[material], n = block_size(&x->mesh, material);
    int32_t *node = NEW("export.nodes", n, int32_t);
    real(*attribute)[2] = memory_new("export.attributes", n, sizeof *attribute);
    for (int64_t k = 0; k < n; k++) {
        const real volume = x->mesh.e->part.volume0[x->mesh.particle[first + k]];
        node[k] = (int32_t)(first + k + 1);
        attribute[k][0] = cbrt(0.75 * volume / M_PI), attribute[k][1] = volume;
    }
    netcdf_write_integers(&x->w, n, node);
    netcdf_end_array(&x->w);
    netcdf_write_reals(&x->w, 2 * n, attribute[0]);
    netcdf_end_array(&x->w);
    netcdf_write_text_row(&x->w, "radius", NAME_WIDTH);
    netcdf_write_text_row(&x->w, "volume", NAME_WIDTH);
    netcdf_end_array(&x->w);
    memory_free(node);
    memory_free(attribute);
}

static void blocks_write(struct exodus_export *x)
{
    const int n = x->mesh.materials;
    for (int m = 0; m < n; m++) netcdf_write_integers(&x->w, 1, (const int32_t[]){block_size(&x->mesh, m) > 0});
    netcdf_end_array(&x->w);
    for (int m = 0; m < n; m++) netcdf_write_integers(&x->w, 1, (const int32_t[]){m + 1});
    netcdf_end_array(&x->w);
    for (int m = 0; m < n; m++) {
        char name[NAME_WIDTH];
        snprintf(name, sizeof name, "block_%d", m + 1);
        netcdf_write_text_row(&x->w, name, NAME_WIDTH);
    }
    netcdf_end_array(&x->w);
    for (int m = 0; m < n; m++)
        if (block_size(&x->mesh, m) > 0) block_write(x, m);
}

static void sets_write(struct exodus_export *x)
{
    const struct loads *l = &x->mesh.e->loads;
    for (int k = 0; k < l->n; k++) netcdf_write_integers(&x->w, 1, (const int32_t[]){l->load[k].n > 0});
    netcdf_end_array(&x->w);
    for (int k = 0; k < l->n; k++) netcdf_write_integers(&x->w, 1, (const int32_t[]){k + 1});
    netcdf_end_array(&x->w);
    for (int k = 0; k < l->n; k++)
        netcdf_write_text_row(&x->w, export_node_set_name_of_load(&x->mesh, k).text, NAME_WIDTH - 1),
            netcdf_write_text_row(&x->w, "", 1);
    netcdf_end_array(&x->w);
    for (int k = 0; k < l->n; k++) {
        int32_t *node = export_node_set_particles_of_load(&x->mesh, k);
        netcdf_write_integers(&x->w, l->load[k].n, node);
        netcdf_end_array(&x->w);
        memory_free(node);
    }
}

/* Writes the whole Exodus file to the stream `to`; export_write_file_and_rename calls it. context: the export (struct
 * exodus_export). Returns FAILED or REFUSED if a frame cannot be written. */
static status exodus_put(FILE *to, void *context)
{
    struct exodus_export *x = context;
    const struct netcdf_attribute attribute[] = {
        {"title", x->title, NETCDF_CHAR, 0},   {"api_version", NULL, NETCDF_FLOAT, 8.03},
        {"version", NULL, NETCDF_FLOAT, 8.03}, {"floating_point_word_size", NULL, NETCDF_INT, 8},
        {"file_size", NULL, NETCDF_INT, 1},    {"maximum_name_length", NULL, NETCDF_INT, 32},
        {"int64_status", NULL, NETCDF_INT, 0}};
    x->w.to = to;
    all_define(x, attribute, COUNT_OF(attribute));
    netcdf_write_header(&x->w);
    info_write(x);
    coordinates_write(x);
    blocks_write(x);
    sets_write(x);
    for (int nodal = 1; nodal >= 0; nodal--) {
        for (int v = 0; v < x->variables[nodal]; v++)
            netcdf_write_text_row(&x->w, x->variable[nodal][v].name, NAME_WIDTH);
        netcdf_end_array(&x->w);
    }
    for (int k = 0; k < x->frames; k++) TRY(exodus_frame_write(x, k));
    return OK;
}

/* ---- the export -------------------------------------------------------------------------------------------------- */

/* Checks that the file name `path` ends in .exo, .e or .g, in either case of letters, as readers of Exodus files
 * expect. Returns OK, or REFUSED with a message. */
static status exodus_check_name(const char *path)
{
    const char *const endings[] = {".exo", ".e", ".g"};
    const char *point = strrchr(path, '.');
    for (size_t k = 0; k < COUNT_OF(endings); k++)
        if (point && strcasecmp(point, endings[k]) == 0) return OK;
    return status_set(REFUSED, "%s: give a name that ends in .exo, .e or .g", path);
}

/* Creates the particles of the scene of the request `scene`, lists the frames if a run is exported (x->folder), and
 * writes the Exodus file. Returns REFUSED, with a message, if there are more than NETCDF_NUMBERS_MOST particles;
 * REFUSED or FAILED if the scene or a frame cannot be read, or the file cannot be written. */
static status exodus_make(struct exodus_export *x, const struct export_request *scene)
{
    TRY(export_mesh_create_from_input_file(&x->mesh, scene));
    if (x->mesh.n > NETCDF_NUMBERS_MOST)
        return status_set(REFUSED,
                          "%s: %lld particles are more than the %d of an Exodus file; use a larger particles.spacing",
                          scene->scene, (long long)x->mesh.n, NETCDF_NUMBERS_MOST);
    if (x->folder) TRY(frames_open(x));
    snprintf(x->title, sizeof x->title, "%.40s%s %s", x->mesh.scene.name, EXODUS_SIGN, CLEAVE_VERSION);
    return export_write_file_and_rename(x->request->folder, exodus_put, x);
}

/* Prints to standard output the name of the Exodus file that the export x has written, what it contains, and what of
 * the scene it does not contain: rigid bodies and pre-cracks. */
static void exodus_print(const struct exodus_export *x)
{
    const struct scene *s = &x->mesh.scene;
    const int cracks = s->cracks;
    printf("%s: %lld particles in %d block%s, %d node set%s", printable_name(x->request->folder).text,
           (long long)x->mesh.n, x->mesh.materials, x->mesh.materials == 1 ? "" : "s", x->mesh.e->loads.n,
           x->mesh.e->loads.n == 1 ? "" : "s");
    if (x->folder)
        printf(", %d variables at %d times\n", x->variables[0] + x->variables[1], x->frames);
    else
        puts("");
    if (s->rigids == 0 && cracks == 0) return;
    printf("left out: ");
    if (s->rigids > 0) printf("%d rigid bod%s%s", s->rigids, s->rigids == 1 ? "y" : "ies", cracks > 0 ? ", " : "\n");
    if (cracks > 0)
        printf("%d pre-crack%s (%s)\n", cracks, cracks == 1 ? "" : "s",
               x->folder ? "the damage of peridynamic particles shows where" : "Peridigm and PeriLab: Bond Filters");
}

status export_exodus(const struct export_request *request)
{
    struct exodus_export *x = NEW("export", 1, struct exodus_export);
    struct export_request scene = *request;
    const struct path run = path_join(request->scene, "scene.yaml");
    *x = (struct exodus_export){.request = request};
    if (path_is_folder(request->scene)) scene.scene = run.text, x->folder = request->scene;
    status s = exodus_check_name(request->folder);
    if (s == OK && x->folder && request->overrides > 0)
        s = status_set(REFUSED, "%s is a run, whose scene -s cannot change; give the scene in its place",
                       printable_name(x->folder).text);
    if (s == OK) s = export_check_file_may_be_written(request->folder, EXODUS_SIGN, request->overwrite);
    if (s == OK) s = exodus_make(x, &scene);
    if (s == OK) exodus_print(x);
    netcdf_free(&x->w);
    memory_free(x->frame);
    export_mesh_free(&x->mesh);
    memory_free(x);
    return s;
}
