/* Reads grey values of images. `materials` of an image become parts of the body whose shape the image is. */
#define _GNU_SOURCE /* strverscmp */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene_parts.h"
#include "scene_shapes.h"

int compare_file_names_numerically(const void *a, const void *b)
{
    return strverscmp(*(char *const *)a, *(char *const *)b);
}

/* ---- grey values ------------------------------------------------------------------------------------------------- */

/* Appends the grey values that `text` gives, such as 255 or 100-255, to the ranges of p. n: YAML node of the text, for
 * messages. Returns REFUSED, with a message, for another form, for values above GREY_MAX and for too many ranges. */
static status grey_range_read(struct reader *r, const struct yaml_node *n, const char *text, struct voxel_solid *voxels)
{
    int low = -1, high = -1, end = 0;
    if (sscanf(text, "%d%n", &low, &end) == 1 && text[end] == '\0')
        high = low;
    else if (sscanf(text, "%d - %d%n", &low, &high, &end) != 2 || text[end] != '\0')
        low = -1;
    if (low < 0 || high < low || high > GREY_MAX)
        return fault_report_at_node(
            r, n, "%s is not a grey value; give a number such as 255, or a range such as 100-255 (largest value: %d)",
            text_to_printable_line_for_message(r, text), GREY_MAX);
    if (voxels->ranges == GREY_RANGES_MAX)
        return fault_report_at_node(r, n, "more than %d ranges of grey values; join some", GREY_RANGES_MAX);
    voxels->range[voxels->ranges++] = (struct grey_range){low, high};
    return OK;
}

status read_grey_value_ranges_of_voxel_solid(struct reader *r, const struct yaml_node *values_node,
                                             struct voxel_solid *voxels)
{
    voxels->ranges = 0;
    if (values_node->kind == NODE_SCALAR) return grey_range_read(r, values_node, values_node->text, voxels);
    if (values_node->kind != NODE_LIST || values_node->n == 0)
        return fault_report_at_node(
            r, values_node,
            "is not a grey value; give a number such as 255, a range such as 100-255, or a list of these");
    for (const struct yaml_node *item = values_node->first; item; item = item->next) {
        if (item->kind != NODE_SCALAR)
            return fault_report_at_node(r, item,
                                        "is not a grey value; give a number such as 255, or a range such as 100-255");
        TRY(grey_range_read(r, item, item->text, voxels));
    }
    return OK;
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Returns true if the value of YAML node n, an entry of `materials` of an image, is the word `void`: pixels with the
 * grey values of this entry are left out of the body. */
static bool is_void(const struct yaml_node *n) { return n->kind == NODE_SCALAR && strcmp(n->text, "void") == 0; }

/* Returns REFUSED, with a message, if a voxel of v has a grey value for which the input file (scene) names no
 * material. in[GREY_MAX + 1]: true for grey values in a range of `materials`; n: YAML node of the image, for messages.
 */
static status check_covered(struct reader *r, const struct yaml_node *n, const struct voxels *v, const bool *in)
{
    const int64_t all = v->n[0] * v->n[1] * v->n[2];
    int64_t missing = 0;
    int value = 0;
    for (int64_t k = all - 1; k >= 0; k--)
        if (!in[v->grey[k]]) missing++, value = v->grey[k];
    if (missing == 0) return OK;
    return fault_report_at_node(
        r, n,
        "%.3g %% of the image have grey values without a material, for instance %d; give each value a "
        "material, or void to leave its pixels out",
        100 * (real)missing / (real)all, value);
}

status read_materials_by_grey_value(struct reader *r, const struct yaml_node *materials_node,
                                    const struct voxels *voxels, struct voxel_solid *voxel_solid)
{
    if (!r->bounded || r->cutting)
        return fault_report_at_node(
            r, materials_node, "is only for an image that is the shape of a body; here give values, such as 100-255");
    TRY(check_node_kind(r, materials_node, NODE_MAP,
                        "give a mapping of grey values to materials, such as {0: void, 1-255: rock}"));
    bool *in = NEW("grey values", GREY_MAX + 1, bool);
    status s = OK;
    voxel_solid->ranges = 0;
    for (const struct yaml_node *c = materials_node->first; c && s == OK; c = c->next) {
        const int before = voxel_solid->ranges;
        s = grey_range_read(r, c, c->key, voxel_solid);
        if (s != OK) break;
        const struct grey_range range = voxel_solid->range[before];
        for (int grey = range.low; grey <= range.high && s == OK; grey++) {
            if (in[grey])
                s = fault_report_at_node(r, c, "has grey value %d in two ranges; remove it from one of them", grey);
            in[grey] = true;
        }
        if (is_void(c)) voxel_solid->ranges = before;
    }
    if (s == OK && voxel_solid->ranges == 0)
        s = fault_report_at_node(r, materials_node, "has only void grey values; give at least one of them a material");
    if (s == OK) s = check_covered(r, materials_node, voxels, in);
    memory_free(in);
    r->grey_materials++;
    return s;
}

/* Returns a copy of the YAML node n and its descendants, without entries that have the key `without`. The copy is in
 * the arena of the reader r, which frees it. parent: parent of the copy. */
static struct yaml_node *node_copy(struct reader *r, const struct yaml_node *n, struct yaml_node *parent,
                                   const char *without)
{
    struct yaml_node *copy = arena_allocate_zeroed(r, sizeof *copy);
    *copy = *n;
    copy->parent = parent, copy->first = copy->last = copy->next = NULL, copy->n = 0;
    for (const struct yaml_node *c = n->first; c; c = c->next)
        if (!c->key || strcmp(c->key, without) != 0) yaml_node_append(copy, node_copy(r, c, copy, without));
    return copy;
}

static int material_called(const struct scene *s, const char *name)
{
    for (int m = 0; m < s->materials; m++)
        if (strcmp(s->material[m].name, name) == 0) return m;
    return -1;
}

/* Reads one entry of `materials` of an image as a part of the body b: the image, restricted to the grey values of the
 * entry, with the motions of its solid. solid: YAML node of that solid; entry: node with grey values as key and the
 * name of the material as value. Returns REFUSED, with a message, for an unknown material or invalid grey values. */
static status read_grey_part(struct reader *r, const struct yaml_node *solid, const struct yaml_node *entry,
                             struct scene_body *b)
{
    const int material = entry->kind == NODE_SCALAR ? material_called(r->scene, entry->text) : -1;
    if (material < 0)
        return fault_report_at_node(
            r, entry, "the scene has no material %s; to leave out the pixels of this grey value, write void",
            node_value_to_text_for_message(r, entry));
    struct yaml_node *copy = node_copy(r, solid, solid->parent, "materials"), *image = yaml_node_find(copy, "image");
    struct yaml_node *values = arena_allocate_zeroed(r, sizeof *values);
    *values = (struct yaml_node){.kind = NODE_SCALAR,
                                 .line = entry->line,
                                 .column = entry->column,
                                 .origin = entry->origin,
                                 .key = arena_copy_text(r, "values", 6),
                                 .text = entry->key};
    yaml_node_append(image, values);
    GROW("parts", b->part, b->parts + 1);
    struct scene_part *part = &b->part[b->parts++];
    part->material = material;
    return read_region(r, copy, &part->region);
}

status read_body_parts_by_grey_value(struct reader *r, const struct yaml_node *shape_node, struct scene_body *body)
{
    const struct yaml_node *solid = shape_node && shape_node->kind == NODE_LIST ? shape_node->first : shape_node;
    const int wanted = r->grey_materials;
    int found = 0;
    r->grey_materials = 0;
    for (; solid; solid = shape_node->kind == NODE_LIST ? solid->next : NULL) {
        const struct yaml_node *image = solid->kind == NODE_MAP ? yaml_node_find(solid, "image") : NULL;
        const struct yaml_node *materials = image ? yaml_node_find(image, "materials") : NULL;
        found += materials != NULL;
        for (const struct yaml_node *c = materials ? materials->first : NULL; c; c = c->next) {
            if (is_void(c)) continue;
            if (body->parts == 0) body->material = material_called(r->scene, c->text);
            const bool bounded = r->bounded;
            r->bounded = false;
            const status s = read_grey_part(r, solid, c, body);
            r->bounded = bounded;
            TRY(s);
        }
    }
    if (found == wanted) return OK;
    return fault_report_at_node(
        r, shape_node,
        "is an image with materials, which cannot be nested in another solid; put it directly into the list "
        "of the shape");
}
