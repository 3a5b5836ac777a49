/* Reads the bodies, initial states and growth rules of a scene. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene_remedies.h"
#include "scene_shapes.h"

enum { COLUMNS_TEXT = 1000 }; /* bytes of the names of all columns of a list */

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

/* Reads the list n of column names of a particle list into b->columns, joined by commas. Returns REFUSED, with a
 * message, for invalid or too many names. */
static status read_list_columns(struct reader *r, const struct yaml_node *n, struct scene_body *b)
{
    size_t length = 1;
    if (n->kind != NODE_LIST || n->n == 0)
        return fault_report_at_node(r, n, "%s is not a list of columns; give a list such as [x, y, z, volume, block]",
                                    node_value_to_text_for_message(r, n));
    for (const struct yaml_node *name = n->first; name; name = name->next) {
        if (name->kind != NODE_SCALAR || strpbrk(name->text, ",;\"'\n"))
            return fault_report_at_node(r, name,
                                        "%s is not the name of a column; give names such as [x, y, z, volume, block]",
                                        node_value_to_text_for_message(r, name));
        length += strlen(name->text) + 1;
    }
    if (length > COLUMNS_TEXT) return fault_report_at_node(r, n, "is longer than %d letters; shorten it", COLUMNS_TEXT);
    b->columns = NEW("list.columns", length, char);
    for (const struct yaml_node *name = n->first; name; name = name->next) {
        strcat(b->columns, name->text);
        if (name->next) strcat(b->columns, ",");
    }
    b->form.columns = b->columns;
    return OK;
}

/* Reads the particle list of body b: path and hash of its file, unit and columns if the input file (scene) gives them,
 * and the column names in the file. n: YAML node of `particles`, a file name or a mapping. Returns REFUSED, with a
 * message, for an invalid file. */
static status read_particle_list(struct reader *r, const struct yaml_node *n, struct scene_body *b)
{
    const bool mapping = n->kind == NODE_MAP;
    const struct yaml_node *file = mapping ? yaml_node_find(n, "file") : n;
    const struct yaml_node *columns = mapping ? yaml_node_find(n, "columns") : NULL;
    location_write_text_of_node(r, n, b->place, sizeof b->place);
    if (mapping) TRY(read_keys_of_group(r, n, n, "bodies.particles", b));
    if (!file) return fault_report_missing_key(r, n, key_find("bodies.particles", "file"));
    if (file->kind != NODE_SCALAR || !path_has_particle_list_extension(file->text))
        return fault_report_at_node(r, file,
                                    "%s is not a particle list; give the name of a file that ends in .csv, .h5 or .exo",
                                    node_value_to_text_for_message(r, file));
    if (mapping) TRY(read_length_unit_of_file(r, n, false, &b->form.scale));
    if (columns) TRY(read_list_columns(r, columns, b));
    TRY(read_input_file_path(r, file, "a particle list", &b->file, &b->contents));
    return r->files ? particle_list_read_column_names(&b->list, b->file, &b->form, r->dim) : OK;
}

/* Returns REFUSED, with a message, if body b is not rigid and has keys of rigid bodies (mass, ramp, force), or is rigid
 * and has keys of other bodies, an infinite box, ramp without a prescribed velocity, or force without mass. n: YAML
 * node of the body. */
static status check_rigid_body(struct reader *r, const struct yaml_node *n, const struct scene_body *b)
{
    static const char *const own[] = {"mass", "ramp", "force"};
    static const char *const others[] = {"material", "particles", "frame", "parts"};
    for (size_t k = 0; k < COUNT_OF(own) && !b->rigid; k++)
        if (yaml_node_find(n, own[k]))
            return fault_report_at_node(r, yaml_node_find(n, own[k]),
                                        "is a key of rigid bodies only; add rigid: true, or remove it");
    if (yaml_node_find(n, "ramp") && (yaml_node_find(n, "mass") || !yaml_node_find(n, "velocity")))
        return fault_report_at_node(r, yaml_node_find(n, "ramp"),
                                    "is for a rigid body with a prescribed velocity; give velocity, and remove mass");
    if (yaml_node_find(n, "force") && !yaml_node_find(n, "mass"))
        return fault_report_at_node(
            r, yaml_node_find(n, "force"),
            "has no effect on a rigid body without a mass, which keeps its velocity; give a mass");
    for (size_t k = 0; k < COUNT_OF(others) && b->rigid; k++)
        if (yaml_node_find(n, others[k]))
            return fault_report_at_node(
                r, yaml_node_find(n, others[k]),
                "has no meaning for a rigid body; remove it, and give a shape, and a mass if the body moves freely");
    if (b->rigid && region_has_box_with_infinite_side(&b->shape, r->scene->dim))
        return fault_report_at_node(r, yaml_node_find(n, "shape"), "has an infinite box; use a half-space");
    return OK;
}

/* Reads the body of YAML node n into b. number: index of the body; the names of bodies with smaller indices must differ
 * from its name. Returns REFUSED, with a message, for invalid keys, if the body has neither shape nor particles, or
 * both, if it leaves open which of several materials it has, and if its name is in use. */
static status scene_parts_read_body(struct reader *r, const struct yaml_node *n, struct scene_body *b, int number)
{
    const struct yaml_node *shape = yaml_node_find(n, "shape"), *file = yaml_node_find(n, "particles");
    location_write_text_of_node(r, n, b->place, sizeof b->place);
    b->material = -1;
    r->bounded = !yaml_node_find(n, "rigid");
    TRY(read_keys_of_group(r, n, n, "bodies", b));
    r->bounded = false;
    TRY(check_rigid_body(r, n, b));
    TRY(read_body_parts_by_grey_value(r, shape, b));
    TRY(read_body_parts(r, yaml_node_find(n, "parts"), key_find("bodies", "parts"), b));
    if (!shape && !file) return fault_report_missing_key(r, n, key_find("bodies", "shape"));
    if (shape && file) return fault_report_exclusive_keys(r, shape, file);
    if (file) TRY(read_particle_list(r, file, b));
    if (!b->rigid && b->material < 0 && r->scene->materials > 1 && !b->list.material)
        return fault_report_missing_key(r, n, key_find("bodies", "material"));
    if (b->material < 0) b->material = 0;
    if (!yaml_node_find(n, "frame")) b->frame = r->scene->frame;
    for (int j = 0; j < number; j++)
        if (strcmp(r->scene->body[j].name, b->name) == 0)
            return fault_report_at_node(r, n, "%s is already the name of another body; give each body its own",
                                        b->name);
    return OK;
}

/* Sorts the n bodies of the scene s, deformable ones before rigid ones, and stores their numbers in s->bodies and
 * s->rigids, which must be 0 before. */
static void sort_bodies(struct scene *s, int n)
{
    struct scene_body *sorted = NEW("bodies", n, struct scene_body);
    for (int rigid = 0; rigid < 2; rigid++)
        for (int k = 0; k < n; k++) {
            if (s->body[k].rigid != rigid) continue;
            sorted[s->bodies + s->rigids] = s->body[k];
            *(rigid ? &s->rigids : &s->bodies) += 1;
        }
    memory_free(s->body);
    s->body = sorted;
}

status read_bodies(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *one = yaml_node_find(root, "body"), *many = yaml_node_find(root, "bodies");
    if (!one && !many) return fault_report_missing_key(r, root, key_find("", "body"));
    if (one && many) return fault_report_exclusive_keys(r, one, many);
    const struct yaml_node *parts = yaml_node_find(root, "parts");
    if (many && parts)
        return fault_report_at_node(r, parts, "belongs to the key body; with the key bodies, give parts in each body");
    if (many) TRY(check_node_is_list_of_valid_length(r, key_find("", "bodies"), many));
    const int n_bodies = many ? many->n : 1;
    s->body = NEW("bodies", n_bodies, struct scene_body);
    if (one) {
        s->bodies = 1;
        strcpy(s->body->name, "body");
        location_write_text_of_node(r, one, s->body->place, sizeof s->body->place);
        s->body->frame = s->frame;
        r->bounded = true;
        TRY(read_region(r, one, &s->body->shape));
        r->bounded = false;
        TRY(read_body_parts_by_grey_value(r, one, s->body));
        if (s->materials > 1 && !parts && s->body->parts == 0)
            return fault_report_at_node(
                r, one,
                "the scene has %d materials, but the key body cannot name one; use parts, or the key bodies "
                "with a material for each",
                s->materials);
        return read_body_parts(r, parts, key_find("", "parts"), s->body);
    }
    const struct yaml_node *n = many->first;
    for (int k = 0; k < n_bodies; k++, n = n->next) {
        snprintf(s->body[k].name, sizeof s->body[k].name, "body%d", k);
        s->bodies = k + 1; /* number of bodies to release if the scene is refused */
        TRY(scene_parts_read_body(r, n, &s->body[k], k));
    }
    s->bodies = 0;
    sort_bodies(s, n_bodies);
    if (s->bodies == 0) return fault_report_at_node(r, many, "all bodies are rigid; add a body with a material");
    if (s->rigids == 0) return OK;
    return s->method == METHOD_MPM || scene_is_single_equilibrium(s) ? refuse_unsupported_rigid_bodies(r, many) : OK;
}

/* ---- initial states ---------------------------------------------------------------------------------------------- */

/* Completes the polarisation (direction of the motion) of the pulse w, whose direction must be set. w->polarisation
 * holds the vector of the input file; if none is given (n NULL), the direction is used. Normalises it, and sets
 * w->transverse to true if it is perpendicular to the direction, false if parallel. Returns REFUSED, with a message,
 * for a vector of length 0 or one that is neither parallel nor perpendicular. n: YAML node of `polarisation`. */
static status read_polarisation(struct reader *r, const struct yaml_node *n, struct wave_pulse *w)
{
    const int dim = r->dim;
    real *moved = w->polarisation, length = sqrt(dot(moved, moved, dim));
    if (!n)
        memcpy(moved, w->direction, sizeof w->direction);
    else if (!(length > 0))
        return fault_report_at_node(
            r, n, "has the length 0 and thus no direction; give `direction`, or move one of the two ends");
    for (int d = 0; n && d < dim; d++) moved[d] /= length;
    const real along = dot(moved, w->direction, dim);
    w->transverse = fabs(along) < 1e-6;
    if (!w->transverse && fabs(along) < 1 - 1e-6)
        return fault_report_at_node(
            r, n,
            "is neither parallel nor perpendicular to direction, as the motion in a plane wave must be; change it");
    for (int d = 0; d < dim; d++)
        moved[d] = w->transverse ? moved[d] - along * w->direction[d] : along * w->direction[d];
    length = sqrt(dot(moved, moved, dim));
    for (int d = 0; d < dim; d++) moved[d] /= length;
    return OK;
}

static status read_pulse(struct reader *r, const struct yaml_node *n, struct scene_initial *initial)
{
    real *direction = initial->pulse.direction, length;
    if (!n) return OK;
    TRY(read_keys_of_group(r, n, n, "initial.pulse", initial));
    length = sqrt(dot(direction, direction, r->dim));
    if (!(length > 0))
        return fault_report_at_node(r, yaml_node_find(n, "direction"), "has the length 0; give a direction such as 1");
    for (int d = 0; d < r->dim; d++) direction[d] /= length;
    initial->sets_pulse = true;
    return read_polarisation(r, yaml_node_find(n, "polarisation"), &initial->pulse);
}

/* Reads a rigid rotation w x (X - centre) of an initial state as its velocity gradient [1/s]. Does nothing without the
 * key `rotation`. map: YAML node of the initial state. Returns REFUSED, with a message, if velocity_gradient or centre
 * is given too, and for invalid keys. */
static status read_initial_rotation(struct reader *r, const struct yaml_node *map, struct scene_initial *initial)
{
    const struct yaml_node *n = yaml_node_find(map, "rotation"), *gradient = yaml_node_find(map, "velocity_gradient"),
                           *centre = yaml_node_find(map, "centre");
    real w[DIM_MAX] = {0}, rate;
    if (!n) return OK;
    if (gradient || centre) return fault_report_exclusive_keys(r, n, gradient ? gradient : centre);
    TRY(read_keys_of_group(r, n, n, "initial.rotation", initial));
    TRY(read_rotation_axis(r, n, "initial.rotation", w));
    if (!yaml_node_find(n, "rate")) return fault_report_missing_key(r, n, key_find("initial.rotation", "rate"));
    TRY(read_number(r, key_find("initial.rotation", "rate"), yaml_node_find(n, "rate"), &rate));
    const real scale = rate / sqrt(dot(w, w, DIM_MAX));
    for (int a = 0; a < r->dim; a++)
        for (int b = 0; b < r->dim; b++) { /* row a, column b of the matrix of w x: -w_c or w_c with the third axis c */
            const real sign = (b - a + 3) % 3 == 1 ? -1 : 1;
            if (a != b) initial->velocity_gradient[a * r->dim + b] = sign * scale * w[3 - a - b];
        }
    initial->sets_velocity = true;
    return OK;
}

/* Reads the velocity of an initial state, numbers [m/s] or formulas, from YAML node n (NULL: none) into *initial.
 * Returns REFUSED, with a message, if it is invalid. */
static status read_initial_velocity(struct reader *r, const struct yaml_node *n, struct scene_initial *initial)
{
    if (!n) return OK;
    initial->sets_velocity = true;
    return read_vector_of_formulas(r, key_find("initial", "velocity"), n, EXPRESS_SPACE, initial->velocity,
                                   initial->formula);
}

/* Reads an initial state from YAML node n into *initial. Returns REFUSED, with a message, for invalid values, and for
 * initial displacements with relaxation on the grid: there the stress of points is accumulated from a start that
 * counts as unloaded, so that the equilibrium would depend on the initial state. */
static status read_initial(struct reader *r, const struct yaml_node *n, struct scene_initial *initial)
{
    initial->body = -1;
    location_write_text_of_node(r, n, initial->place, sizeof initial->place);
    TRY(read_keys_of_group(r, n, n, "initial", initial));
    TRY(read_initial_velocity(r, yaml_node_find(n, "velocity"), initial));
    TRY(read_pulse(r, yaml_node_find(n, "pulse"), initial));
    TRY(read_initial_rotation(r, n, initial));
    if (initial->sets_strain && r->scene->solver == SOLVER_RELAXATION && r->scene->method != METHOD_PD)
        return fault_report_at_node(
            r, yaml_node_find(n, "displacement_gradient"),
            "with solver: relaxation the equilibrium of material points depends on their initial strain; set "
            "solver: static, or remove the initial strain");
    if (initial->sets_velocity || initial->sets_strain || initial->sets_pulse) return OK;
    return fault_report_at_node(
        r, n, "has no initial state; give velocity, velocity_gradient, rotation, displacement_gradient or pulse");
}

status read_initial_states(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "initial");
    if (!list) return OK;
    TRY(check_node_is_list_of_valid_length(r, key_find("", "initial"), list));
    s->initials = list->n;
    s->initial = NEW("initial states", list->n, struct scene_initial);
    const struct yaml_node *n = list->first;
    for (int k = 0; k < s->initials; k++, n = n->next) TRY(read_initial(r, n, &s->initial[k]));
    return OK;
}

/* ---- growth ------------------------------------------------------------------------------------------------------ */

/* Reads the growth rule of YAML node n into g, and normalises its direction. number: index of the rule, for its
 * default name. Returns REFUSED, with a message, for keys without meaning and for an unknown probe. */
static status read_growth(struct reader *r, const struct yaml_node *n, struct growth_rule *g, int number)
{
    real length;
    snprintf(g->name, sizeof g->name, "growth%d", number);
    TRY(read_keys_of_group(r, n, n, "growth", g));
    length = sqrt(dot(g->direction, g->direction, r->dim));
    if (!(length > 0))
        return fault_report_at_node(r, yaml_node_find(n, "direction"),
                                    "has the length 0; give a direction such as [1, 0]");
    for (int d = 0; d < r->dim; d++) g->direction[d] /= length;
    if (!g->probe[0] && yaml_node_find(n, "toughness"))
        return fault_report_at_node(r, yaml_node_find(n, "toughness"),
                                    "has no effect without the key probe; add probe, the name of a sif probe");
    if (!g->probe[0] && !isnan(g->smoothing))
        return fault_report_at_node(r, yaml_node_find(n, "smoothing"),
                                    "has no effect without the key probe; add probe, the name of a sif probe");
    if (growth_rule_controls_speed_by_toughness(g) && !(g->toughness > 0))
        return fault_report_at_node(
            r, yaml_node_find(n, "speed"),
            "the choice follow needs a sif probe (key probe) and toughness, the value at which K_eq is kept; "
            "give both");
    if (!growth_rule_controls_speed_by_toughness(g) && !isnan(g->fastest))
        return fault_report_at_node(r, yaml_node_find(n, "fastest"),
                                    "has no effect with a given speed; set speed: follow, or remove it");
    for (int k = 0; g->probe[0] && k < r->scene->probes; k++)
        if (r->scene->probe[k].kind == PROBE_SIF && strcmp(r->scene->probe[k].name, g->probe) == 0) return OK;
    return g->probe[0] ? fault_report_at_node(r, yaml_node_find(n, "probe"),
                                              "the scene has no sif probe %s; add it to probes", g->probe)
                       : OK;
}

/* Returns REFUSED, with a message, if a probe of the input file (scene) names a growth rule that the scene lacks.
 * root: YAML tree of the scene, for the location in the message. */
static status check_growth_probes(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "probes"), *n = list ? list->first : NULL;
    for (int k = 0; k < s->probes; k++, n = n->next) {
        bool found = false;
        if (s->probe[k].kind != PROBE_GROWTH) continue;
        if (s->growths == 0)
            return fault_report_at_node(
                r, n,
                "the scene has no crack with prescribed growth to measure; add the key growth, or remove this probe");
        for (int g = 0; g < s->growths; g++)
            found = found || !s->probe[k].of[0] || strcmp(s->growth[g].name, s->probe[k].of) == 0;
        if (!found)
            return fault_report_at_node(r, yaml_node_find(n->first, "of"),
                                        "the scene has no growth named %s; give an existing name (the first one: %s)",
                                        s->probe[k].of, s->growth[0].name);
    }
    return OK;
}

/* Reads the list `growth`, the rules of crack growth, after the probes that they can name. root: YAML tree of the
 * input file (scene). Returns REFUSED, with a message, for invalid rules, outside plane spaces and with method mpm. */
status read_crack_growths(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "growth");
    if (!list) return check_growth_probes(r, root);
    TRY(check_node_is_list_of_valid_length(r, key_find("", "growth"), list));
    if (s->dim != 2)
        return fault_report_at_node(
            r, list, "prescribed crack growth is possible in plane spaces only; set a plane space, or remove growth");
    if (s->method == METHOD_MPM)
        return fault_report_at_node(r, list, "method: mpm has no bonds to cut; set method: pd or adaptive");
    s->growths = list->n;
    s->growth = NEW("growth", list->n, struct growth_rule);
    const struct yaml_node *n = list->first;
    for (int k = 0; k < s->growths; k++, n = n->next) TRY(read_growth(r, n, &s->growth[k], k));
    return check_growth_probes(r, root);
}

/* ---- frames of regions ------------------------------------------------------------------------------------------- */

/* Reads entry number `number` of `output.regions` from YAML node n into r->scene: a region for which frames are
 * written at intervals of their own. Returns REFUSED, with a message, for a name whose files are used already, and for
 * too many frames. */
static status read_frame_region(struct reader *r, const struct yaml_node *n, int number)
{
    struct scene *s = r->scene;
    struct scene_series *one = &s->series[number];
    TRY(read_keys_of_group(r, n, n, "output.regions", one));
    if (strcmp(one->name, "frames") == 0)
        return fault_report_at_node(r, yaml_node_find(n, "name"),
                                    "frames is the name of the frames of all bodies; choose another name");
    for (int k = 0; k < number; k++)
        if (strcmp(s->series[k].name, one->name) == 0)
            return fault_report_at_node(r, yaml_node_find(n, "name"),
                                        "%s is already the name of another region; choose another one", one->name);
    if (s->duration / one->every > FRAMES_MOST)
        return fault_report_at_node(
            r, yaml_node_find(n, "every"), "%s makes more than %d frames; use an interval of at least %.3g s",
            node_value_to_text_for_message(r, yaml_node_find(n, "every")), FRAMES_MOST, s->duration / FRAMES_MOST);
    return OK;
}

status read_regions_of_output_frames(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *output = yaml_node_find(root, "output"),
                           *list = output ? yaml_node_find(output, "regions") : NULL;
    if (!list) return OK;
    TRY(check_node_is_list_of_valid_length(r, key_find("output", "regions"), list));
    s->n_series = list->n;
    s->series = NEW("scene.series", list->n, struct scene_series);
    const struct yaml_node *n = list->first;
    for (int k = 0; k < s->n_series; k++, n = n->next) TRY(read_frame_region(r, n, k));
    return OK;
}
