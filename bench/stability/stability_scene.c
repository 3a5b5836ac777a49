/* Scenes of the stability bench: free blocks on a lattice of 1 mm without loads, breaking or conversion. */
#include <stdio.h>
#include <string.h>

#include "stability.h"

static const char *space_of(const struct stability_case *c)
{
    static const char *const space[] = {"", "line", "plane stress", "solid"};
    return c->space ? c->space : space[c->dim];
}

static bool stability_scene_is(const char *word, const char *other) { return word && !strcmp(word, other); }

/* ---- pieces of text ---------------------------------------------------------------------------------------------- */

/* A YAML mapping that is written in one line; nothing is written if it has no entries. */
struct mapping {
    FILE *to;
    const char *name;
    int entries;
};

static void entry(struct mapping *m)
{
    if (m->entries++ == 0)
        fprintf(m->to, "%s: {", m->name);
    else
        fputs(", ", m->to);
}

static void stability_scene_put_text(struct mapping *m, const char *key, const char *value)
{
    if (!value) return;
    entry(m);
    fprintf(m->to, "%s: %s", key, value);
}

static void stability_scene_put_number(struct mapping *m, const char *key, double value)
{
    if (value == 0) return;
    entry(m);
    fprintf(m->to, "%s: %.9g", key, value);
}

static void mapping_end(struct mapping *m)
{
    if (m->entries > 0) fputs("}\n", m->to);
}

static void stability_scene_put_point(FILE *to, int dim, double first, double rest)
{
    fprintf(to, "[%.9g", first);
    for (int d = 1; d < dim; d++) fprintf(to, ", %.9g", rest);
    fputc(']', to);
}

static void stability_scene_put_box(FILE *to, int dim, double from, double until, double edge)
{
    fputs("{box: {from: ", to);
    stability_scene_put_point(to, dim, from, 0);
    fputs(", to: ", to);
    stability_scene_put_point(to, dim, until, edge);
    fputs("}}", to);
}

/* ---- the scene --------------------------------------------------------------------------------------------------- */

#define SPACING 1e-3 /* of the particles [m] */

/* Returns the length of an edge of the block of the case c [m], its number of particles times the spacing. If c->edge
 * is 0, the block is large enough for the horizon and for the cells. */
static double edge_of(const struct stability_case *c)
{
    static const int edge[DIM_MAX + 1] = {0, 48, 16, 8};
    int n = c->edge > 0 ? c->edge : edge[c->dim];
    if (c->dim > 1 && c->edge == 0 && c->horizon > 3.1) n = (int)(2 * c->horizon) + (c->dim == 2 ? 10 : 4);
    if (n < 3 * c->cell) n = (int)(3 * c->cell);
    return n * SPACING;
}

/* Writes the materials and bodies of the case c as keys of a scene: one block of the given edge [m], or two halves of
 * different density if c->heavier is not 0. */
static void put_bodies(FILE *to, const struct stability_case *c, double edge)
{
    char poisson[40] = "";
    if (c->poisson != 0) snprintf(poisson, sizeof poisson, ", poisson: %.9g", c->poisson);
    if (c->heavier == 0) {
        fprintf(to, "material: {young: 72e9, density: 2440%s}\nbody: ", poisson);
        stability_scene_put_box(to, c->dim, 0, edge, edge);
        fputc('\n', to);
        return;
    }
    fprintf(to,
            "materials:\n  - {name: first, young: 72e9, density: 2440%s}\n  - {name: second, young: 72e9, density: "
            "%.9g%s}\n",
            poisson, 2440 * c->heavier, poisson);
    for (int half = 0; half < 2; half++) {
        fprintf(to, "%s  - {material: %s, shape: ", half ? "" : "bodies:\n", half ? "second" : "first");
        stability_scene_put_box(to, c->dim, half ? edge / 2 : 0, half ? edge : edge / 2, edge);
        fputs("}\n", to);
    }
}

/* Writes five balls, each of which contains one or more particles, at irregular positions of the block of the case c.
 * before, after: texts written before and after each ball; edge: of the block [m]. */
static void put_balls(FILE *to, const struct stability_case *c, double edge, const char *before, const char *after)
{
    static const double place[][DIM_MAX] = {
        {0.5, 0.5, 0.5}, {0.19, 0.27, 0.71}, {0.81, 0.33, 0.2}, {0.3, 0.85, 0.4}, {0.7, 0.72, 0.83}};
    static const double radius[] = {0.55, 1.05, 1.45, 0.75, 2.05};
    for (size_t k = 0; k < COUNT_OF(radius); k++) {
        fprintf(to, "%s%s{ball: {centre: [", k > 0 ? ", " : "", before);
        for (int d = 0; d < c->dim; d++) {
            const double at = ((int)(place[k][d] * edge / SPACING) + 0.5 + 0.1 * (int)k) * SPACING;
            fprintf(to, "%s%.9g", d > 0 ? ", " : "", at);
        }
        fprintf(to, "], radius: %.9g}}%s", radius[k] * SPACING, after);
    }
}

/* Writes a box inside the block of case c as a shape of a scene. share[0]: its lower and upper end along x; share[1]:
 * the same along all other axes, both over the edge of the block [1]; edge: edge of the block [m]. */
static void put_shares(FILE *to, const struct stability_case *c, double edge, const double (*share)[2])
{
    for (int end = 0; end < 2; end++) {
        fputs(end ? ", to: " : "{box: {from: ", to);
        stability_scene_put_point(to, c->dim, share[0][end] * edge, share[1][end] * edge);
    }
    fputs("}}", to);
}

static void put_region(FILE *to, const struct stability_case *c, double edge)
{
    static const double share[][2][2] = {[HALF] = {{0, 0.5}, {0, 1}},
                                         [STRIP] = {{0.25, 0.75}, {0, 1}},
                                         [SQUARE] = {{0.25, 0.75}, {0.25, 0.75}},
                                         [CORNER] = {{0, 0.5}, {0, 0.5}},
                                         [NOTCH] = {{0.25, 0.75}, {0, 0.75}}};
    if (c->region == DISC) {
        fputs("{ball: {centre: ", to);
        stability_scene_put_point(to, c->dim, 0.5 * edge, 0.5 * edge);
        fprintf(to, ", radius: %.9g}}", 0.27 * edge);
        return;
    }
    if (c->region != ISLANDS && c->region != SPOTS) {
        put_shares(to, c, edge, share[c->region]);
        return;
    }
    fputc('[', to);
    if (c->region == ISLANDS) {
        stability_scene_put_box(to, c->dim, 0, edge, edge);
        fputs(", ", to);
    }
    put_balls(to, c, edge, c->region == ISLANDS ? "{subtract: " : "", c->region == ISLANDS ? "}" : "");
    fputc(']', to);
}

/* ---- supports ---------------------------------------------------------------------------------------------------- */

/* Writes the supports of the case c as boundary conditions of a scene; nothing for a free body. edge: of the block
 * [m]. */
static void put_support(FILE *to, const struct stability_case *c, double edge)
{
    static const char *const text[] = {
        [MIRROR] = "  - {mirror: {axis: x, at: 0}}\n",
        [MIRROR_ACROSS] = "  - {mirror: {axis: y, at: 0}}\n",
        [MIRRORS] = "  - {mirror: {axis: x, at: 0}}\n  - {mirror: {axis: y, at: 0}}\n",
        [CLAMP] = "  - {mirror: {axis: x, at: 0, tangential: held}}\n",
        [CLAMP_ACROSS] = "  - {mirror: {axis: y, at: 0, tangential: held}}\n",
        [CLAMP_MIRROR] = "  - {mirror: {axis: x, at: 0, tangential: held}}\n  - {mirror: {axis: y, at: 0}}\n"};
    if (c->support == FREE) return;
    fputs("boundary:\n", to);
    if (c->support != FIXED && c->support != DRIVEN) {
        fputs(text[c->support], to);
        return;
    }
    if (c->support == FIXED)
        fputs("  - {fixed: all, region: ", to);
    else
        fprintf(to, "  - {velocity: [0.2%s], time: {pulse: {from: 0, until: 50 us}}, region: ",
                &", free, free"[6 * (DIM_MAX - c->dim)]);
    stability_scene_put_box(to, c->dim, edge - 2 * SPACING, edge, edge);
    fputs("}\n", to);
}

void stability_write_scene_text(const struct stability_case *c, char *text, size_t capacity)
{
    if (c->text) {
        snprintf(text, capacity, "%s", c->text);
        return;
    }
    const double edge = edge_of(c), cell = c->cell > 0 ? c->cell : 2, origin = c->offset * cell * SPACING;
    FILE *to = fmemopen(text, capacity, "w");
    fprintf(to, "name: block\nspace: %s\nmethod: %s\nduration: 1\n", space_of(c), c->method);
    if (c->dim == 2) fputs("thickness: 1 mm\n", to);
    if (c->model) fprintf(to, "model: %s\n", c->model);
    if (c->coupling) fprintf(to, "coupling: %s\n", c->coupling);
    put_bodies(to, c, edge);
    struct mapping particles = {to, "particles", 0}, mpm = {to, "mpm", 0}, pd = {to, "pd", 0};
    stability_scene_put_number(&particles, "spacing", SPACING);
    stability_scene_put_number(&particles, "horizon", c->horizon);
    stability_scene_put_number(&particles, "irregularity", c->irregularity);
    mapping_end(&particles);
    stability_scene_put_number(&mpm, "cell", cell);
    stability_scene_put_text(&mpm, "shape", c->shape);
    stability_scene_put_text(&mpm, "transfer", c->transfer);
    stability_scene_put_text(&mpm, "frame", c->frame ? c->frame : "current");
    stability_scene_put_text(&mpm, "strain", c->strain);
    stability_scene_put_text(&mpm, "constants", c->constants);
    if (c->offset != 0) {
        entry(&mpm);
        fputs("origin: ", to);
        stability_scene_put_point(to, c->dim, origin, origin);
    }
    mapping_end(&mpm);
    stability_scene_put_text(&pd, "surface", c->surface);
    stability_scene_put_text(&pd, "weights", c->weights);
    stability_scene_put_text(&pd, "normalisation", c->normalisation);
    stability_scene_put_text(&pd, "calibration", c->calibration);
    if (stability_scene_is(c->method, "adaptive")) {
        entry(&pd);
        fputs("region: ", to);
        put_region(to, c, edge);
    }
    mapping_end(&pd);
    if (stability_scene_is(c->method, "adaptive")) fputs("conversion: {criteria: none}\n", to);
    if (c->region == NOTCH)
        fprintf(to, "cracks: [{from: [%.9g, 0], to: [%.9g, %.9g]}]\n", edge / 2, edge / 2, edge / 2);
    fprintf(to, "contact: {between: %s}\n", c->contact ? "all" : "none");
    put_support(to, c, edge);
    fputs("output: {frames: 0, samples: 1}\n", to);
    fclose(to);
}

/* ---- label ------------------------------------------------------------------------------------------------------- */

/* Writes a label that describes the case c into text[capacity]: dimension, method, model, horizon or points per cell,
 * and its special property. */
void stability_label(const struct stability_case *c, char *text, size_t capacity)
{
    FILE *to = fmemopen(text, capacity, "w");
    fputs(space_of(c), to);
    if (stability_scene_is(c->method, "pd"))
        fprintf(to, " %s, horizon %g", c->model ? c->model : "bond", c->horizon > 0 ? c->horizon : 3.015);
    else if (stability_scene_is(c->frame, "reference"))
        fprintf(to, " %s", c->method);
    else if (stability_scene_is(c->method, "adaptive"))
        fprintf(to, " %s%s%s, %s %s", c->coupling, c->model ? ", " : "", c->model ? c->model : "",
                c->shape ? c->shape : "gimp", c->transfer);
    else
        fprintf(to, " %s %s", c->shape, c->transfer);
    if (c->group == GROUP_POINTS || c->group == GROUP_COUPLED) fprintf(to, ", %g a cell", c->cell > 0 ? c->cell : 2);
    if (c->poisson != 0) fprintf(to, ", nu %g", c->poisson);
    if (c->note) fprintf(to, ", %s", c->note);
    fputc('\0', to);
    fclose(to);
    text[capacity - 1] = 0;
}
