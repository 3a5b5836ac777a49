/* Reads solids from files: surfaces, meshes and images. Files are searched as particle lists are, and identified by
 * the hash of their contents. */
#include "scene/shape_file.h"

#include <glob.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "geometry/image.h"
#include "scene_parts.h"
#include "scene_shapes.h"

enum { SLICES_MOST = 65536 }; /* largest number of slices of an image */

/* ---- names of files ---------------------------------------------------------------------------------------------- */

/* Combines f->contents, the hash of the files read so far, with `contents`, the hash of one more file (FNV-1a). For the
 * first file f->contents becomes the hash of this file. */
static void contents_add(struct shape_file *f, uint64_t contents)
{
    if (f->files == 0)
        f->contents = contents;
    else
        f->contents = (f->contents ^ contents) * UINT64_C(1099511628211);
}

static status shape_path_add(struct reader *r, const struct yaml_node *n, struct shape_file *f)
{
    uint64_t contents = 0;
    GROW("shape files", f->path, f->files + 1);
    TRY(read_input_file_path(r, n, "a file", &f->path[f->files], &contents));
    contents_add(f, contents);
    f->files++;
    return OK;
}

/* Adds to f the files that match the pattern with stars in YAML node n, sorted by name with numbers compared by value.
 * Searches the folder of the scene, then the current one. Returns REFUSED, with a message, if there is no such file,
 * or more than SLICES_MOST. */
static status pattern_add(struct reader *r, const struct yaml_node *n, struct shape_file *f)
{
    const char *slash = strrchr(r->name, '/');
    const int folder = slash && n->text[0] != '/' ? (int)(slash - r->name) + 1 : 0;
    char pattern[4096];
    glob_t found = {0};
    status s = OK;
    snprintf(pattern, sizeof pattern, "%.*s%s", folder, r->name, n->text);
    if (glob(pattern, 0, NULL, &found) != 0 && glob(n->text, 0, NULL, &found) != 0) {
        globfree(&found);
        return fault_report_at_node(r, n, "no file matches this name; give the image slices, such as slice_*.png");
    }
    if (found.gl_pathc > SLICES_MOST)
        s = fault_report_at_node(
            r, n, "more than %d files match; use a narrower pattern, or TIFF files of several pages", SLICES_MOST);
    array_sort(found.gl_pathv, (int64_t)found.gl_pathc, sizeof *found.gl_pathv, compare_file_names_numerically);
    for (size_t k = 0; k < found.gl_pathc && s == OK; k++) {
        struct yaml_node one = *n;
        one.text = found.gl_pathv[k];
        if (folder > 0 && strncmp(one.text, r->name, (size_t)folder) == 0) one.text += folder;
        s = shape_path_add(r, &one, f);
    }
    globfree(&found);
    return s;
}

static status paths_read(struct reader *r, const struct yaml_node *n, struct shape_file *f)
{
    if (n->kind == NODE_SCALAR && f->kind == SHAPE_IMAGE && strchr(n->text, '*')) return pattern_add(r, n, f);
    if (n->kind != NODE_LIST || f->kind != SHAPE_IMAGE) return shape_path_add(r, n, f);
    if (n->n == 0 || n->n > SLICES_MOST)
        return fault_report_at_node(r, n, "gives %d files; give 1 to %d", n->n, SLICES_MOST);
    for (const struct yaml_node *item = n->first; item; item = item->next) TRY(shape_path_add(r, item, f));
    return OK;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Releases the file f of solids with all that was read from it, and the structure f itself. */
static void shape_file_free(struct shape_file *f)
{
    for (int k = 0; k < f->files; k++) memory_free(f->path[k]);
    for (int k = 0; k < f->parts; k++) {
        voxel_solid_free(f->part[k]);
        memory_free(f->part[k]);
    }
    memory_free(f->path);
    memory_free(f->part);
    geometry_free(&f->geometry);
    voxels_free(&f->voxels);
    memory_free(f);
}

void shape_files_free(struct shape_file *first)
{
    for (struct shape_file *next; first; first = next) {
        next = first->next;
        shape_file_free(first);
    }
}

static bool same_words(const struct shape_file *a, const struct shape_file *b)
{
    bool same = a->kind == b->kind && a->dim == b->dim && a->files == b->files && a->contents == b->contents &&
                reals_are_bitwise_equal(a->scale, b->scale) && memcmp(a->size, b->size, sizeof a->size) == 0 &&
                memcmp(a->from, b->from, sizeof a->from) == 0;
    for (int k = 0; k < a->files && same; k++) same = strcmp(a->path[k], b->path[k]) == 0;
    return same;
}

#define CURVE_FINE 0.01 /* largest distance of chords from curved element edges [spacings] */

/* Reads the particle spacing that the input file (scene) gives into *spacing [m]; NAN if it gives none. Needed because
 * shapes are read before the spacing. n: any YAML node of the tree of the scene. Returns REFUSED, with a message, if
 * the spacing is no length in its range. */
static status read_spacing(struct reader *r, const struct yaml_node *n, real *spacing)
{
    *spacing = NAN;
    while (n->parent) n = n->parent;
    const struct yaml_node *given = tree_find_node_by_path(n, "particles.spacing");
    const struct key *k = key_find("particles", "spacing");
    return given && k ? read_number(r, k, given, spacing) : OK;
}

/* Reads the file f of a solid, unless the same file with the same settings has been read already. Takes ownership of
 * f, and frees it if it is not needed or cannot be read. n: YAML node of the solid; *known: receives the file that has
 * been read, which the scene owns. Returns REFUSED, with a message, if the file is invalid. */
static status shape_take(struct reader *r, const struct yaml_node *n, struct shape_file *f, struct shape_file **known)
{
    struct shape_file **last = &r->scene->shapes;
    for (; *last; last = &(*last)->next)
        if (same_words(*last, f)) {
            shape_file_free(f);
            *known = *last;
            return OK;
        }
    real spacing = NAN;
    status s = f->kind == SHAPE_MESH ? read_spacing(r, n, &spacing) : OK;
    if (s == OK)
        s = f->kind == SHAPE_IMAGE ? image_read_voxels(&f->voxels, f->files, f->path, f->dim, f->size, f->from)
                                   : geometry_read(&f->geometry, f->path[0], f->dim, f->scale, CURVE_FINE * spacing);
    if (s != OK) {
        shape_file_free(f);
        return s;
    }
    *known = *last = f;
    return OK;
}

/* Returns REFUSED, with a message, if the input file (scene) gives the hash of a file of a solid and the file has
 * another hash. n: YAML node of the solid; words: its keys; contents: hash of the file. */
static status check_contents(struct reader *r, const struct yaml_node *n, const struct shape_words *words,
                             uint64_t contents)
{
    char found[NAME_MAX_LENGTH];
    snprintf(found, sizeof found, "%016" PRIx64, contents);
    if (!words->contents[0] || strcmp(words->contents, found) == 0) return OK;
    return fault_report_at_node(
        r, yaml_node_find(n, "contents"),
        "is %s, but the hash of the file is %s, so the file has changed; restore the earlier file, or remove "
        "the key contents",
        words->contents, found);
}

status read_length_unit_of_file(struct reader *r, const struct yaml_node *file_node, bool is_required,
                                real *scale_value)
{
    const struct yaml_node *unit = yaml_node_find(file_node, "unit"), *scale = yaml_node_find(file_node, "scale");
    char text[48], what[256];
    if (unit && scale) return fault_report_exclusive_keys(r, unit, scale);
    if (!unit && !scale && is_required)
        return fault_report_at_node(
            r, file_node, "unit is missing, and the file does not state one; add unit: mm, or scale: 25.4 mm");
    if (!unit) return OK;
    snprintf(text, sizeof text, "1 %.40s", unit->text);
    if (unit->kind == NODE_SCALAR && number_parse_with_unit(scale_value, text, UNIT_LENGTH, false, what, sizeof what))
        return OK;
    return fault_report_at_node(r, unit, "%s is not a unit of length; give one such as mm, m or um, or scale: 25.4 mm",
                                node_value_to_text_for_message(r, unit));
}

/* ---- surfaces and meshes ----------------------------------------------------------------------------------------- */

/* Returns REFUSED with the message that the mesh g has no part called `name` (a set of elements, nodes or faces), or
 * that several sets have names that contain it. The message lists these sets, or all sets if none has the name. n:
 * YAML node of the name. */
static status refuse_set(struct reader *r, const struct yaml_node *n, const char *name, const struct geometry *g)
{
    char names[120 + LONG_NAME_LENGTH + 4] = "";
    int several = 0;
    for (int k = 0; k < g->sets; k++) several += geometry_set_name_matches_after_instance_prefix(&g->set[k], name);
    for (int k = 0; k < g->sets && strlen(names) < 120; k++) {
        if (several > 0 && !geometry_set_name_matches_after_instance_prefix(&g->set[k], name)) continue;
        strcat(names, names[0] ? ", " : "");
        strcat(names, g->set[k].name);
    }
    if (several > 0) return fault_report_at_node(r, n, "the file has %d sets %s; give one of %s", several, name, names);
    return fault_report_at_node(r, n, "the file has no set %s; give one of its sets (%s)", name,
                                g->sets ? names : "none");
}

#define AT_NODE 0.01 /* largest distance of a particle from a node of the list in which it was [spacings] */

/* Sets s->hull to the part of the mesh g of which the solid s consists: the whole mesh, a set of elements, or the
 * points within a distance s->radius [m] of a set of nodes or faces. n: YAML node of the solid; words: its keys.
 * Returns REFUSED, with a message, for an unknown set, and for a distance that is missing or has no meaning. */
static status read_mesh_set(struct reader *r, const struct yaml_node *n, const struct shape_words *words,
                            const struct geometry *g, struct solid *s)
{
    const struct yaml_node *within = yaml_node_find(n, "within");
    const struct geometry_set *set = words->set[0] ? geometry_find_set_by_name(g, words->set) : NULL;
    if (words->set[0] && !set) return refuse_set(r, yaml_node_find(n, "set"), words->set, g);
    if (set && set->fault)
        return fault_report_at_node(r, yaml_node_find(n, "set"), "%s of the file %s", set->name, set->fault);
    if (!set && g->whole.dim == 0)
        return fault_report_at_node(
            r, n,
            "the file has particles, elements of one node, that fill no volume; a body of them is "
            "{particles: {file: .., unit: ..}}, and a region names one of their sets by the key set");
    s->hull = set ? &set->hull : &g->whole;
    if (within && !s->hull->open)
        return fault_report_at_node(r, within,
                                    "is for sets of nodes or faces only, but this solid fills a volume; remove it");
    if (!s->hull->open) return OK;
    TRY(read_spacing(r, n, &s->radius));
    if (g->whole.dim == 0) s->radius *= AT_NODE;
    if (within) s->radius = words->within;
    if (s->radius > 0) return OK;
    return fault_report_at_node(
        r, n, "set %s contains nodes or faces; give within, the distance up to which particles belong to it",
        words->set);
}

static status read_geometry(struct reader *r, const struct yaml_node *n, enum shape_kind kind, struct solid *s)
{
    const char *const group = kind == SHAPE_STL ? "solid.stl" : "solid.mesh";
    const struct yaml_node *file = yaml_node_find(n, "file");
    struct shape_words words = {.scale = NAN, .within = NAN};
    struct shape_file *f = NULL;
    TRY(read_keys_of_group(r, n, n, group, &words));
    if (!file) return fault_report_missing_key(r, n, key_find(group, "file"));
    TRY(read_length_unit_of_file(r, n, true, &words.scale));
    if (r->dim == 1) return fault_report_at_node(r, n, "cannot be used in space line; use box");
    f = NEW("shape files", 1, struct shape_file);
    *f = (struct shape_file){.kind = kind, .dim = r->dim, .scale = words.scale};
    status result = paths_read(r, file, f);
    if (result == OK) result = check_contents(r, n, &words, f->contents);
    if (result != OK) {
        shape_file_free(f);
        return result;
    }
    TRY(shape_take(r, n, f, &f));
    s->kind = SOLID_HULL;
    return read_mesh_set(r, n, &words, &f->geometry, s);
}

status read_stl_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid)
{
    return read_geometry(r, solid_node, SHAPE_STL, solid);
}
status read_mesh_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid)
{
    return read_geometry(r, solid_node, SHAPE_MESH, solid);
}

/* ---- images ------------------------------------------------------------------------------------------------------ */

/* Reads an image from its keys: files, size of the voxels and position. n: YAML node of the image. *known: receives
 * the image, which the scene owns. Returns REFUSED, with a message, for invalid keys or files, and in 1D. */
static status read_voxels(struct reader *r, const struct yaml_node *n, struct shape_file **known)
{
    const struct yaml_node *file = yaml_node_find(n, "file"), *slice = yaml_node_find(n, "slice");
    struct shape_words words = {.pixel = NAN, .slice = NAN};
    TRY(read_keys_of_group(r, n, n, "solid.image", &words));
    if (!file) return fault_report_missing_key(r, n, key_find("solid.image", "file"));
    if (r->dim == 1) return fault_report_at_node(r, n, "cannot be used in space line; use box");
    if (slice && r->dim == 2)
        return fault_report_at_node(r, slice,
                                    "has no effect in plane spaces, where a solid has a single image; remove it");
    struct shape_file *f = NEW("shape files", 1, struct shape_file);
    *f = (struct shape_file){.kind = SHAPE_IMAGE, .dim = r->dim, .scale = NAN};
    for (int d = 0; d < r->dim; d++)
        f->size[d] = d == 2 && slice ? words.slice : words.pixel, f->from[d] = words.origin[d];
    status result = paths_read(r, file, f);
    if (result == OK) result = check_contents(r, n, &words, f->contents);
    if (result != OK) {
        shape_file_free(f);
        return result;
    }
    return shape_take(r, n, f, known);
}

/* Returns the voxels of the image f that have the grey values in `wanted`. They are computed once; solids with the same
 * grey values share them. f owns them. */
static const struct voxel_solid *grey_part_of(struct shape_file *f, const struct voxel_solid *wanted)
{
    for (int k = 0; k < f->parts; k++)
        if (f->part[k]->ranges == wanted->ranges &&
            arrays_equal(f->part[k]->range, wanted->range, wanted->ranges, sizeof *wanted->range))
            return f->part[k];
    GROW("shape parts", f->part, f->parts + 1);
    struct voxel_solid *part = NEW("shape parts", 1, struct voxel_solid);
    *part = *wanted;
    part->of = &f->voxels;
    voxel_solid_make_from_grey_value_ranges(part);
    return f->part[f->parts++] = part;
}

status read_image_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid)
{
    const struct yaml_node *values = yaml_node_find(solid_node, "values"),
                           *materials = yaml_node_find(solid_node, "materials");
    struct voxel_solid wanted = {.ranges = 1, .range = {{1, GREY_MAX}}};
    struct shape_file *f = NULL;
    TRY(read_voxels(r, solid_node, &f));
    if (values && materials) return fault_report_exclusive_keys(r, values, materials);
    if (values) TRY(read_grey_value_ranges_of_voxel_solid(r, values, &wanted));
    if (materials) TRY(read_materials_by_grey_value(r, materials, &f->voxels, &wanted));
    solid->kind = SOLID_VOXELS;
    solid->voxels = grey_part_of(f, &wanted);
    if (solid->voxels->voxels > 0) return OK;
    return fault_report_at_node(r, values ? values : solid_node,
                                "no voxel of the image has one of these grey values; %s",
                                "give values that occur in the image");
}
