/* Writes solids in flow style: {box: {..}}, {subtract: {box: {..}, move: [..]}}. References by name are replaced by
 * the solids. */
#include "scene_echo.h"

#include <string.h>

/* Writes the keys of a group of solids to scene.yaml (w) in flow style, such as `centre: [0, 0], radius: 1`. group:
 * path of the keys; base: structure with their values; between: text before the first key; a comma precedes further
 * keys. */
static void write_keys(struct yaml_writer *w, const char *group, const void *base, const char *between)
{
    for (int i = 0; i < keys_count; i++) {
        const struct key *k = &keys[i];
        if (!key_is_directly_below(k, group) || !k->place) continue;
        if (k->has && !*((const bool *)base + (k->has - 1))) continue;
        fprintf(w->out, "%s%s: ", between, key_get_last_name_of_path(k));
        yaml_write_value(w, k, (const char *)base + (k->place - 1));
        if (k->unit == UNIT_ANGLE) fputs(" rad", w->out);
        between = ", ";
    }
}

static void write_corners(struct yaml_writer *w, const struct polygon *p)
{
    for (int k = 0; k < p->n; k++) {
        fputs(k ? ", " : "corners: [", w->out);
        yaml_write_number_list(w, p->corner[k], 2);
    }
    fputc(']', w->out);
    write_keys(w, "solid.polygon", p, ", ");
}

static void write_items(struct yaml_writer *w, const struct region *region, bool intersect);

static void write_extrusion(struct yaml_writer *w, const struct solid *s)
{
    const int dim = w->dim;
    fputs("shape: ", w->out);
    w->dim = 2;
    yaml_write_region(w, &s->region);
    w->dim = dim;
    write_keys(w, "solid.extrude", s, ", ");
}

/* Writes shape and keys of the solid s to scene.yaml (w) in flow style, such as `box: {from: .., to: ..}`. */
static void write_shape(struct yaml_writer *w, const struct solid *s)
{
    static const char *const words[] = {[SOLID_BOX] = "box",           [SOLID_BALL] = "ball",
                                        [SOLID_CYLINDER] = "cylinder", [SOLID_HALF_SPACE] = "half-space",
                                        [SOLID_RING] = "ring",         [SOLID_POLYGON] = "polygon",
                                        [SOLID_TUBE] = "tube",         [SOLID_CONE] = "cone",
                                        [SOLID_TORUS] = "torus",       [SOLID_EXTRUSION] = "extrude"};
    char group[32];
    if (s->kind == SOLID_ALL) {
        fputs("all: true", w->out);
        return;
    }
    if (s->kind == SOLID_HULL || s->kind == SOLID_VOXELS) {
        yaml_write_solid_from_file(w, s);
        return;
    }
    const char *word = s->kind == SOLID_ELLIPSOID ? w->dim == 2 ? "ellipse" : "ellipsoid" : words[s->kind];
    fprintf(w->out, "%s: {", word);
    snprintf(group, sizeof group, "solid.%s", word);
    if (s->kind == SOLID_POLYGON)
        write_corners(w, s->polygon);
    else if (s->kind == SOLID_EXTRUSION)
        write_extrusion(w, s);
    else
        write_keys(w, group, s, "");
    fputc('}', w->out);
}

static void write_motions(struct yaml_writer *w, const struct solid *s)
{
    static const char *const begins[] = {[MOTION_ROTATE] = ", rotate: {",
                                         [MOTION_MIRROR] = ", mirror: {",
                                         [MOTION_GRID] = ", pattern: {grid: {",
                                         [MOTION_RING] = ", pattern: {ring: {"};
    static const char *const groups[] = {[MOTION_ROTATE] = "solid.rotate",
                                         [MOTION_MIRROR] = "solid.mirror",
                                         [MOTION_GRID] = "solid.pattern.grid",
                                         [MOTION_RING] = "solid.pattern.ring"};
    for (int k = 0; k < s->motions; k++) {
        const struct solid_motion *m = &s->motion[k];
        if (m->kind == MOTION_MOVE) {
            fputs(", move: ", w->out);
            yaml_write_number_list(w, m->step, w->dim);
            continue;
        }
        fputs(begins[m->kind], w->out);
        write_keys(w, groups[m->kind], m, "");
        fputs(m->kind == MOTION_GRID || m->kind == MOTION_RING ? "}}" : "}", w->out);
    }
}

/* Writes the solid s to scene.yaml (w) in flow style with its operation (add, subtract, intersect) and its motions.
 * plain: true to omit the word add. */
static void write_solid(struct yaml_writer *w, const struct solid *s, bool plain)
{
    const bool group = s->kind == SOLID_GROUP;
    const char *word = s->subtract ? "subtract" : s->intersect ? "intersect" : group || !plain ? "add" : NULL;
    fputc('{', w->out);
    if (word) fprintf(w->out, "%s: ", word);
    if (group)
        write_items(w, &s->region, s->intersect);
    else {
        if (word) fputc('{', w->out);
        write_shape(w, s);
    }
    write_motions(w, s);
    fputs(word && !group ? "}}" : "}", w->out);
}

/* Writes the solids of a region to scene.yaml (w) as a list in flow style. intersect: true if they are the operands of
 * an intersection. */
static void write_items(struct yaml_writer *w, const struct region *region, bool intersect)
{
    for (int k = 0; k < region->n; k++) {
        fputs(k ? ", " : "[", w->out);
        write_solid(w, &region->solid[k], !intersect);
    }
    fputc(']', w->out);
}

void yaml_write_region(struct yaml_writer *w, const struct region *region) { write_items(w, region, false); }

void yaml_write_named_regions(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->regions) fputs("regions:\n", w->out);
    for (int k = 0; k < s->regions; k++) {
        fprintf(w->out, "  %s: ", s->named[k].name);
        yaml_write_region(w, &s->named[k].region);
        fputc('\n', w->out);
    }
}
