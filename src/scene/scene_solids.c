/* Reads the geometry of a scene: solids, regions and cracks, and checks that they are valid. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "geometry/geometry.h"

enum { SOLIDS_MOST = 200000 }; /* largest number of solids of a scene */
#define EFFORT_MOST 1e5        /* largest number of primitive solids with which a lattice position is compared */

/* ---- shapes ------------------------------------------------------------------------------------------------------ */

/* Kinds of solids by their names in input files (scenes). dim: number of dimensions in which a name is valid; 0: in
 * any. */
static const struct solid_word {
    const char *name;
    enum solid_kind kind;
    int dim;
} solid_words[] = {
    {"box", SOLID_BOX, 0},           {"disc", SOLID_BALL, 2},
    {"ball", SOLID_BALL, 0},         {"cylinder", SOLID_CYLINDER, 3},
    {"ellipse", SOLID_ELLIPSOID, 2}, {"ellipsoid", SOLID_ELLIPSOID, 3},
    {"ring", SOLID_RING, 2},         {"polygon", SOLID_POLYGON, 2},
    {"tube", SOLID_TUBE, 3},         {"cone", SOLID_CONE, 3},
    {"torus", SOLID_TORUS, 3},       {"extrude", SOLID_EXTRUSION, 3},
    {"stl", SOLID_HULL, 3},          {"mesh", SOLID_HULL, 0},
    {"image", SOLID_VOXELS, 0},      {"half-space", SOLID_HALF_SPACE, 0},
    {"all", SOLID_ALL, 0},
};

static status read_solids(struct reader *r, const struct yaml_node *n, struct region *region, bool intersect);

static status check_box(struct reader *r, const struct yaml_node *n, const struct solid *s)
{
    for (int d = 0; d < r->dim; d++)
        if (!(s->from[d] < s->to[d]))
            return fault_report_at_node(
                r, n, "from is not below to along %c; give the smaller coordinates by from, the larger ones by to",
                'x' + d);
    return OK;
}

/* Returns REFUSED, with a message, if the solid s has an axis without length, or a hole or section that is not smaller
 * than its radius. n: YAML node of the solid. */
static status check_round(struct reader *r, const struct yaml_node *n, const struct solid *s)
{
    const bool has_ends = s->kind == SOLID_CYLINDER || s->kind == SOLID_TUBE || s->kind == SOLID_CONE;
    if (has_ends && memcmp(s->from, s->to, sizeof s->from) == 0)
        return fault_report_at_node(r, n, "has an axis of length 0; give two different ends, from and to");
    if ((s->kind == SOLID_TUBE || s->kind == SOLID_RING) && !(s->inner < s->radius))
        return fault_report_at_node(r, yaml_node_find(n, "inner"),
                                    "is not below radius; give the radius of the hole, smaller than radius");
    if (s->kind == SOLID_CONE && !(s->inner + s->radius > 0))
        return fault_report_at_node(
            r, n, "has two radii of 0; give one above 0 (the other may be 0, for a cone that ends in a point)");
    if (s->kind == SOLID_TORUS && !(s->inner < s->radius))
        return fault_report_at_node(
            r, yaml_node_find(n, "section"),
            "is not below radius, so the torus has no hole; give a smaller radius of the section");
    return OK;
}

static status check_solid(struct reader *r, const struct yaml_node *n, const struct solid *s)
{
    if (s->kind == SOLID_BOX) return check_box(r, n, s);
    if (s->kind == SOLID_HALF_SPACE && !(dot(s->normal, s->normal, r->dim) > 0))
        return fault_report_at_node(
            r, n, "has a normal of length 0; give one that points out of the half-space, such as [0, 1]");
    if (s->kind == SOLID_TORUS && !(dot(s->normal, s->normal, r->dim) > 0))
        return fault_report_at_node(r, n,
                                    "has an axis of length 0; give the direction through the hole, such as [0, 0, 1]");
    return check_round(r, n, s);
}

/* Reads the corners of a polygon and its rounding into s->polygon. n: YAML node of the polygon. Returns REFUSED, with
 * a message, if edges cross, the corners have no area or the rounding does not fit an edge. */
static status read_corners(struct reader *r, const struct yaml_node *n, struct solid *s)
{
    const struct key *k = key_find("solid.polygon", "corners");
    const struct yaml_node *list = yaml_node_find(n, "corners");
    struct key corner = *k;
    int at = 0;
    corner.range.given = false;
    s->polygon = NEW("solids.polygon", 1, struct polygon);
    TRY(read_keys_of_group(r, n, n, "solid.polygon", s->polygon));
    if (!list) return fault_report_missing_key(r, n, k);
    TRY(check_node_is_list_of_valid_length(r, k, list));
    s->polygon->n = list->n;
    s->polygon->corner = memory_new("solids.corner", list->n, sizeof *s->polygon->corner);
    for (const struct yaml_node *p = list->first; p; p = p->next)
        TRY(read_point_or_vector(r, &corner, p, s->polygon->corner[at++]));
    switch (polygon_check_and_compute_rounded_corners(s->polygon, &at)) {
    case POLYGON_SHORT:
        return fault_report_at_node(r, list, "corner %d and the next one are at the same position; remove one of them",
                                    at);
    case POLYGON_FLAT:
        return fault_report_at_node(r, list, "enclose no area; give three or more corners that are not on one line");
    case POLYGON_CROSSED:
        return fault_report_at_node(
            r, list,
            "the edge that begins at corner %d touches or crosses another edge; give a polygon without crossings", at);
    case POLYGON_TIGHT:
        return fault_report_at_node(r, yaml_node_find(n, "round"),
                                    "is too large for the edge from corner %d to the next one; use a smaller radius",
                                    at);
    default:
        return OK;
    }
}

/* Reads an extrusion along an axis from s->begin to s->end [m]. Its section s->region is read as a region in the plane
 * of the other two axes. n: YAML node of the extrusion. Returns REFUSED, with a message, if the section is missing or
 * begin is not below end. */
static status read_extrusion(struct reader *r, const struct yaml_node *n, struct solid *s)
{
    const struct yaml_node *shape = yaml_node_find(n, "shape");
    TRY(read_keys_of_group(r, n, n, "solid.extrude", s));
    if (!shape) return fault_report_missing_key(r, n, key_find("solid.extrude", "shape"));
    if (!(s->begin < s->end))
        return fault_report_at_node(r, n, "from is not below to; give the lower end by from, the upper one by to");
    r->dim = 2;
    const status read = read_region(r, shape, &s->region);
    r->dim = r->scene->dim;
    return read;
}

/* Reads the keys of a solid of the kind that `word` names into s. n: YAML node of these keys. Returns REFUSED, with a
 * message, for kinds that the space does not have, for an infinite solid in a body and for invalid keys. */
static status read_shape(struct reader *r, const struct yaml_node *n, const struct solid_word *word, struct solid *s)
{
    char group[32];
    snprintf(group, sizeof group, "solid.%s", word->name);
    s->kind = word->kind;
    if (word->dim && word->dim != r->dim)
        return fault_report_at_node(r, n, "cannot be used in %s; use %s", reader_get_expected_point_space_as_text(r),
                                    r->dim == 1                   ? "box"
                                    : r->dim == 2                 ? "disc, polygon, ellipse, ring or box"
                                    : word->kind == SOLID_POLYGON ? "extrude with a polygon as its shape"
                                                                  : "ball, cylinder, tube, cone, extrude or box");
    if (r->bounded && !r->cutting && (s->kind == SOLID_ALL || s->kind == SOLID_HALF_SPACE))
        return fault_report_at_node(r, n,
                                    "a body cannot be infinite; use a finite solid, such as box, ball or cylinder");
    if (s->kind == SOLID_VOXELS) return read_image_solid(r, n, s);
    if (s->kind == SOLID_HULL) return (strcmp(word->name, "stl") == 0 ? read_stl_solid : read_mesh_solid)(r, n, s);
    if (s->kind == SOLID_POLYGON) return read_corners(r, n, s);
    if (s->kind == SOLID_EXTRUSION) return read_extrusion(r, n, s);
    if (s->kind != SOLID_ALL) {
        TRY(read_keys_of_group(r, n, n, group, s));
        return check_solid(r, n, s);
    }
    if (n->kind == NODE_SCALAR && strcmp(n->text, "true") == 0) return OK;
    return fault_report_at_node(r, n, "%s is not true; write all: true", node_value_to_text_for_message(r, n));
}

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* Finds *called, the YAML node of the region whose name is the value of node n; inside an extrusion the node of the
 * section with this name. Returns REFUSED, with the nearest name in the message, if there is none. */
static status region_called(struct reader *r, const struct yaml_node *n, const struct yaml_node **called)
{
    const struct yaml_node *nearest = NULL, *map = r->dim == r->scene->dim ? r->regions : r->sections;
    const char *word = r->dim == r->scene->dim ? "region" : "section";
    if (n->kind != NODE_SCALAR)
        return fault_report_at_node(r, n, "%s is not a name; give one of the names defined by the key %ss",
                                    node_value_to_text_for_message(r, n), word);
    if (!map)
        return fault_report_at_node(
            r, n, "%s is not a kind of solid, and the scene has no %s of this name; define it by %ss: {%s: {box: ..}}",
            node_value_to_text_for_message(r, n), word, word, node_value_to_text_for_message(r, n));
    for (const struct yaml_node *c = map->first; c; c = c->next) {
        *called = c;
        if (strcmp(c->key, n->text) == 0) return OK;
        if (!nearest || edit_distance(c->key, n->text) < edit_distance(nearest->key, n->text)) nearest = c;
    }
    return fault_report_at_node(r, n, "there is no %s %s; did you mean %s?", word, node_value_to_text_for_message(r, n),
                                nearest->key);
}

/* Reads the solids of the region whose name is the value of YAML node n into `region`. Returns REFUSED, with a
 * message, if there is no such region or it contains itself. */
static status read_called(struct reader *r, const struct yaml_node *n, struct region *region)
{
    struct naming here = {.outer = r->naming};
    TRY(region_called(r, n, &here.region));
    for (const struct naming *k = r->naming; k; k = k->outer)
        if (k->region == here.region)
            return fault_report_at_node(r, n, "region %s is part of itself; remove this reference",
                                        node_value_to_text_for_message(r, n));
    r->naming = &here;
    const status read = read_solids(r, here.region, region, false);
    r->naming = here.outer;
    return read;
}

/* Reads the region whose name is the value of YAML node n as one solid s: the region's only solid, or a group of its
 * solids. Returns REFUSED, with a message, if there is no such region or it contains itself. */
static status read_named(struct reader *r, const struct yaml_node *n, struct solid *s)
{
    s->kind = SOLID_GROUP;
    TRY(read_called(r, n, &s->region));
    const struct solid only = s->region.solid[0];
    if (s->region.n > 1 || only.intersect || only.images > 0) return OK;
    const bool subtract = s->subtract, intersect = s->intersect;
    memory_free(s->region.solid);
    *s = only;
    s->subtract = subtract, s->intersect = intersect;
    return OK;
}

/* Reads the regions in `map`, a mapping of names to solids, into named[map->n]. *count: increased by the number of
 * regions that have been read, also on failure, so that the caller can release them. Returns REFUSED, with a message,
 * for invalid names or solids. */
static status read_names(struct reader *r, const struct yaml_node *map, struct named_region *named, int *count)
{
    for (const struct yaml_node *n = map->first; n; n = n->next) {
        const struct yaml_node name = {
            .text = n->key, .key = n->key, .line = n->line, .column = n->column, .origin = n->origin};
        TRY(check_key_given_once(r, map, n));
        TRY(read_value_of_key(r, &(struct key){.type = KEY_NAME, .place = 1}, &name, named[*count].name));
        TRY(read_called(r, &name, &named[(*count)++].region));
    }
    return OK;
}

/* Finds *map, the mapping of names to solids that is the value of `key` at the top of the scene; NULL if the key is
 * missing. root: YAML tree of the input file (scene). Returns REFUSED, with a message, if the value is no mapping or
 * is empty. */
static status names_find(struct reader *r, const struct yaml_node *root, const char *key, const struct yaml_node **map)
{
    *map = yaml_node_find(root, key);
    if (!*map) return OK;
    TRY(check_node_kind(r, *map, NODE_MAP, "give a mapping of names to solids, such as {grip: {box: ..}}"));
    return (*map)->n > 0
               ? OK
               : fault_report_at_node(r, *map, "has no region; give a name and its solids, such as {grip: {box: ..}}");
}

/* Reads all named sections in r->sections and discards them: faults in unused sections are found in this way, and
 * extrusions read those that they use again. Returns REFUSED, with a message, for a fault, and outside 3D. */
static status read_sections(struct reader *r)
{
    const struct yaml_node *map = r->sections;
    int count = 0;
    if (r->dim != 3)
        return fault_report_at_node(r, map, "cannot be used in %s; use the key regions there",
                                    reader_get_expected_point_space_as_text(r));
    struct named_region *named = NEW("regions", map->n, struct named_region);
    r->dim = 2;
    const status read = read_names(r, map, named, &count);
    r->dim = 3;
    for (int k = 0; k < count; k++) region_free(&named[k].region);
    memory_free(named);
    return read;
}

status read_regions(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    r->regions = r->sections = NULL, r->solids = 0;
    TRY(names_find(r, root, "regions", &r->regions));
    TRY(names_find(r, root, "sections", &r->sections));
    if (r->sections) TRY(read_sections(r));
    if (!r->regions) return OK;
    s->named = NEW("regions", r->regions->n, struct named_region);
    return read_names(r, r->regions, s->named, &s->regions);
}

/* ---- lists of solids --------------------------------------------------------------------------------------------- */

/* Reads a solid from YAML node n into *s. It is declared here because the operand of an operation may be a group of
 * solids; signed_before and the returned status are explained at its definition below. */
static status read_solid(struct reader *r, const struct yaml_node *n, struct solid *s, bool signed_before);

/* Reads the operand of add, subtract or intersect into s: one solid, or a group if the operand is a list or has
 * motions. n: YAML node of the solid; what: its entry with the operation. Returns REFUSED, with a message, for an
 * invalid operand. */
static status read_operation(struct reader *r, const struct yaml_node *n, const struct yaml_node *what, struct solid *s)
{
    const bool cutting = r->cutting;
    status read;
    s->subtract = strcmp(what->key, "subtract") == 0;
    s->intersect = strcmp(what->key, "intersect") == 0;
    r->cutting = cutting || s->subtract || s->intersect;
    if (what->kind == NODE_LIST || n->n > 1) {
        s->kind = SOLID_GROUP;
        read = read_solids(r, what, &s->region, s->intersect);
    } else {
        read = read_solid(r, what, s, true);
    }
    r->cutting = cutting;
    return read;
}

/* Reads the solid of YAML node n with its motions into s. The node may also be an operation add, subtract or intersect
 * with its operand. signed_before: true if the solid is such an operand itself; then a further operation is refused.
 * Returns REFUSED, with a message, for an invalid solid, or too many copies. */
static status read_solid(struct reader *r, const struct yaml_node *n, struct solid *s, bool signed_before)
{
    const struct yaml_node *child = NULL;
    const struct solid_word *word = NULL;
    int solids = 0;
    TRY(check_node_kind(r, n, NODE_MAP, "give a solid such as box: {from: [..], to: [..]}"));
    TRY(check_mapping_keys_known_and_unique(r, n, "solid"));
    for (const struct yaml_node *c = n->first; c; c = c->next)
        if (!node_is_motion_key_of_solid(c)) child = c, solids++;
    if (solids != 1)
        return fault_report_at_node(
            r, n,
            "has %d solids, but needs exactly one: box, disc, ball, cylinder, polygon or another (list: "
            "`cleave help solid`)",
            solids);
    if (r->solids++ > SOLIDS_MOST)
        return fault_report_at_node(r, n, "has more than %d solids; remove some, or use a mesh", SOLIDS_MOST);
    for (size_t k = 0; k < COUNT_OF(solid_words) && !word; k++)
        if (strcmp(solid_words[k].name, child->key) == 0) word = &solid_words[k];
    if (word)
        TRY(read_shape(r, child, word, s));
    else if (strcmp(child->key, "region") == 0)
        TRY(read_named(r, child, s));
    else if (signed_before)
        return fault_report_at_node(r, child,
                                    "cannot be inside add, subtract or intersect; give a solid such as box there");
    else
        TRY(read_operation(r, n, child, s));
    TRY(read_solid_motions(r, n, s));
    if (solid_query_cost_relative_to_ball(s) <= EFFORT_MOST) return OK;
    return fault_report_at_node(r, n, "makes more than %g solids with its copies; use fewer copies", EFFORT_MOST);
}

/* Reads the list of solids of YAML node n into `region`. intersect: true if solids without an operation of their own
 * are intersected instead of added. Returns REFUSED, with a message, for an empty list, an invalid solid, and if the
 * first one is subtracted. */
static status read_solids(struct reader *r, const struct yaml_node *n, struct region *region, bool intersect)
{
    if (n->kind == NODE_LIST && n->n == 0)
        return fault_report_at_node(r, n, "is an empty list; give at least one solid, such as box");
    const struct yaml_node *item = n->kind == NODE_LIST ? n->first : n;
    int count = n->kind == NODE_LIST ? n->n : 1;
    region->solid = NEW("solids", count, struct solid);
    region->n = count;
    for (int k = 0; k < count; k++, item = item->next) {
        region->solid[k].intersect = intersect;
        TRY(read_solid(r, item, &region->solid[k], false));
    }
    if (region->solid[0].subtract)
        return fault_report_at_node(
            r, n, "has no solid before it from which to subtract; add one first (in a region perhaps all: true)");
    region_build_search_trees(region, r->dim);
    return OK;
}

status read_region(struct reader *r, const struct yaml_node *region_node, struct region *region)
{
    return region_node->kind == NODE_SCALAR && *region_node->text ? read_called(r, region_node, region)
                                                                  : read_solids(r, region_node, region, false);
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Allocates an array for the n corners of the crack c and sets the width of the crack to 0. */
static void crack_make(struct crack *c, int n)
{
    c->corner = memory_new("cracks", n, sizeof *c->corner);
    c->n = n, c->width = 0;
}

/* Computes n = (b - a) x (c - a), a normal of the plane of the points a, b and c in space. */
static void cross_at(const real *a, const real *b, const real *c, real n[DIM_MAX])
{
    for (int d = 0; d < DIM_MAX; d++) {
        int e = (d + 1) % DIM_MAX, f = (d + 2) % DIM_MAX;
        n[d] = (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    }
}

/* Returns REFUSED, with a message, unless the corners of crack c form a plane convex polygon: every corner is in the
 * plane and on the inner side of every edge, to a millionth of the size of the polygon. n: YAML node of the crack. */
static status check_polygon(struct reader *r, const struct yaml_node *n, const struct crack *c)
{
    real normal[DIM_MAX] = {0}, part[DIM_MAX];
    for (int k = 1; k + 1 < c->n; k++) {
        cross_at(c->corner[0], c->corner[k], c->corner[k + 1], part);
        for (int d = 0; d < DIM_MAX; d++) normal[d] += part[d];
    }
    real twice_area = sqrt(dot(normal, normal, DIM_MAX)), size = sqrt(twice_area);
    if (!(twice_area > 0))
        return fault_report_at_node(r, n, "has no area; give three or more corners that are not on one line");
    for (int k = 0; k < c->n; k++) {
        for (int j = 0; j < c->n; j++) {
            real away[DIM_MAX];
            for (int d = 0; d < DIM_MAX; d++) away[d] = c->corner[j][d] - c->corner[0][d];
            cross_at(c->corner[k], c->corner[(k + 1) % c->n], c->corner[j], part);
            if (fabs(dot(away, normal, DIM_MAX)) > 1e-6 * size * twice_area)
                return fault_report_at_node(
                    r, n, "corner %d is not in the plane of the other corners; give a plane polygon", j);
            if (dot(part, normal, DIM_MAX) < -1e-6 * square(twice_area))
                return fault_report_at_node(r, n, "is not convex at corner %d; give several convex polygons", k);
        }
    }
    return OK;
}

static status read_polygon(struct reader *r, const struct yaml_node *n, struct crack *c)
{
    const struct key *k = key_find("cracks", "polygon");
    struct key corner = *k;
    int at = 0;
    corner.range.given = false;
    TRY(check_node_is_list_of_valid_length(r, k, n));
    crack_make(c, n->n);
    for (const struct yaml_node *p = n->first; p; p = p->next)
        TRY(read_point_or_vector(r, &corner, p, c->corner[at++]));
    return check_polygon(r, n, c);
}

/* Reads the position of crack c from YAML node n: a point in 1D, a segment in 2D, a polygon in 3D. Returns REFUSED,
 * with a message, for keys of another space, and for a segment or polygon without extent. */
static status read_crack_place(struct reader *r, const struct yaml_node *n, struct crack *c)
{
    static const char *const first[] = {"at", "from", "polygon"}, *const form[] = {"at", "from and to", "polygon"};
    const char *word = first[r->dim - 1];
    TRY(check_node_kind(r, n, NODE_MAP, "give a crack such as {from: [..], to: [..]}"));
    TRY(check_mapping_keys_known_and_unique(r, n, "cracks"));
    for (const struct yaml_node *k = n->first; k; k = k->next)
        if (strcmp(k->key, word) != 0 && strcmp(k->key, "width") != 0 && (r->dim != 2 || strcmp(k->key, "to") != 0))
            return fault_report_at_node(r, k, "cannot be used in space %s; give the crack by %s",
                                        space_names[r->scene->space], form[r->dim - 1]);
    const struct yaml_node *a = yaml_node_find(n, word), *b = yaml_node_find(n, "to");
    if (!a) return fault_report_missing_key(r, n, key_find("cracks", word));
    if (r->dim == 2 && !b) return fault_report_missing_key(r, n, key_find("cracks", "to"));
    if (r->dim == 3) return read_polygon(r, a, c);
    crack_make(c, r->dim);
    TRY(read_point_or_vector(r, key_find("cracks", word), a, c->corner[0]));
    if (r->dim == 1) return OK;
    TRY(read_point_or_vector(r, key_find("cracks", "to"), b, c->corner[1]));
    if (c->corner[0][0] != c->corner[1][0] || c->corner[0][1] != c->corner[1][1]) return OK;
    return fault_report_at_node(r, n, "has the length 0; give two different ends, from and to");
}

static status read_crack(struct reader *r, const struct yaml_node *n, struct crack *c)
{
    TRY(read_crack_place(r, n, c));
    const struct yaml_node *width = yaml_node_find(n, "width");
    return width ? read_value_of_key(r, key_find("cracks", "width"), width, c) : OK;
}

/* Appends the slits (inner free surfaces) of all meshes in a shape to the cracks of the scene s, once for each copy
 * of a mesh, at its position. */
static void take_slits(struct scene *s, const struct region *shape)
{
    const struct placement there = {.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int k = 0; k < shape->n; k++) {
        const struct solid *a = &shape->solid[k];
        if (a->kind == SOLID_GROUP) take_slits(s, &a->region);
        for (int m = 0; m < (a->images > 0 ? a->images : 1) && a->kind == SOLID_HULL && !a->subtract; m++) {
            const struct placement *to = a->images > 0 ? &a->image[m] : &there;
            int first = s->cracks;
            for (geometry_append_mesh_slits_as_precracks(a->hull, &s->crack, &s->cracks); first < s->cracks; first++)
                for (int c = 0; c < s->crack[first].n; c++) {
                    real X[DIM_MAX];
                    array_copy(X, s->crack[first].corner[c], DIM_MAX, sizeof *X);
                    for (int d = 0; d < DIM_MAX; d++)
                        s->crack[first].corner[c][d] = to->shift[d] + dot(to->turn[d], X, DIM_MAX);
                }
        }
    }
}

status read_cracks(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "cracks");
    if (list) {
        TRY(check_node_is_list_of_valid_length(r, key_find("", "cracks"), list));
        s->crack = NEW("cracks", list->n, struct crack);
        s->cracks = s->cracks_given = list->n;
        const struct yaml_node *n = list->first;
        for (int k = 0; k < s->cracks; k++, n = n->next) TRY(read_crack(r, n, &s->crack[k]));
    }
    for (int b = 0; b < s->bodies; b++) take_slits(s, &s->body[b].shape);
    return OK;
}
