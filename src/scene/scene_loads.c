/* Reads the boundary conditions of a scene. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* ---- profiles in space ------------------------------------------------------------------------------------------- */

/* Reads the profile in space of a body force into f: a sine wave, or the factor 1 everywhere. n: YAML node of
 * `profile`, NULL or `uniform` for the factor 1. Returns REFUSED, with a message, for another form or a direction
 * without length. */
static status read_profile(struct reader *r, const struct yaml_node *n, struct profile *f)
{
    f->direction[0] = 1;
    if (!n || (n->kind == NODE_SCALAR && strcmp(n->text, "uniform") == 0)) return OK;
    if (n->kind != NODE_MAP)
        return fault_report_at_node(r, n,
                                    "%s is not a profile; give uniform or a mapping such as {sine: {wavelength: 1 m}}",
                                    node_value_to_text_for_message(r, n));
    TRY(check_mapping_keys_known_and_unique(r, n, "boundary.profile"));
    if (n->n != 1) return fault_report_at_node(r, n, "has %d keys; give one, such as {sine: {wavelength: 1 m}}", n->n);
    f->kind = PROFILE_SINE;
    TRY(read_keys_of_group(r, n->first, n->first, "boundary.profile.sine", f));
    real length2 = dot(f->direction, f->direction, r->dim);
    if (length2 > 0 && isfinite(length2)) return OK;
    return fault_report_at_node(
        r, yaml_node_find(n->first, "direction"),
        "has a length of 0 or infinity; give the direction in which the force varies, such as [1, 0]");
}

/* ---- boundary conditions ----------------------------------------------------------------------------------------- */

/* Reads the name of an axis, x, y or z, from `text` into *axis as its number 0, 1 or 2. n: YAML node of the text, for
 * messages. Returns REFUSED, with a message, for axes that the space does not have. */
static status read_axis(struct reader *r, const struct yaml_node *n, const char *text, int *axis)
{
    *axis = word_index_in_list("x|y|z", text);
    if (n->kind != NODE_SCALAR || *axis < 0 || *axis >= r->dim)
        return fault_report_at_node(r, n, "%s is not an axis of space %s; give %s",
                                    node_value_to_text_for_message(r, n), space_names[r->scene->space],
                                    r->dim == 1   ? "x"
                                    : r->dim == 2 ? "x or y"
                                                  : "x, y or z");
    return OK;
}

/* Reads the constrained components of the entry `fixed`, YAML node n, into b->components, one bit per axis: `all` or a
 * list of axes. Returns REFUSED, with a message, for another form, or an axis given twice. */
static status read_fixed(struct reader *r, const struct yaml_node *n, struct boundary *b)
{
    int axis;
    if (n->kind == NODE_SCALAR && strcmp(n->text, "all") == 0) {
        b->components = (uint8_t)((1 << r->dim) - 1);
        return OK;
    }
    if (n->kind != NODE_LIST || n->n == 0)
        return fault_report_at_node(r, n, "%s is not a list of axes; give all, or a list such as [x, y]",
                                    node_value_to_text_for_message(r, n));
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        TRY(read_axis(r, c, c->text, &axis));
        if (b->components >> axis & 1)
            return fault_report_at_node(r, c, "%s is given twice; name each axis once",
                                        node_value_to_text_for_message(r, c));
        b->components |= (uint8_t)(1 << axis);
    }
    return OK;
}

/* Reads one component of a vector from YAML node n: a number into *value, or a formula into *f with *value = 1. k: key
 * of the vector, for unit and range; of: variables allowed in the formula (EXPRESS_*). Returns REFUSED, with a
 * message, if it is neither. */
static status read_formula(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned of, real *value,
                           struct expression *f)
{
    const bool formula =
        n->kind == NODE_SCALAR && (text_is_formula_variable(n->text) || text_looks_like_expression(r, n->text));
    if (!formula) return read_number(r, k, n, value);
    TRY(read_expression(r, k, n, of, f));
    *value = 1;
    if (f->in_space || f->in_time) return OK;
    expression_free(f);
    return read_number(r, k, n, value);
}

status read_vector_of_formulas(struct reader *r, const struct key *k, const struct yaml_node *vector_node,
                               unsigned further_variables, real *value, struct expression *formula)
{
    int d = 0;
    if (vector_node->kind == NODE_SCALAR && r->dim == 1)
        return read_formula(r, k, vector_node, further_variables, value, formula);
    if (vector_node->kind != NODE_LIST || vector_node->n != r->dim)
        return read_point_or_vector(r, k, vector_node, value);
    for (const struct yaml_node *c = vector_node->first; c; c = c->next, d++)
        TRY(read_formula(r, k, c, further_variables, &value[d], &formula[d]));
    return OK;
}

/* Reads component d (from 0) of the vector that the boundary condition b prescribes, a number or a formula, from YAML
 * node n into b->value and b->formula. k: key of the vector, for unit and range. Returns REFUSED, with a message, if
 * it is neither. */
static status read_load_value(struct reader *r, const struct key *k, const struct yaml_node *n, struct boundary *b,
                              int d)
{
    return read_formula(r, k, n, EXPRESS_SPACE | EXPRESS_TIME, &b->value[d], &b->formula[d]);
}

/* Reads the pressure of the boundary condition b from YAML node n, a number or a formula, and sets all components of
 * its value to it. Returns REFUSED, with a message, if it is neither. */
static status read_pressure(struct reader *r, const struct yaml_node *n, struct boundary *b)
{
    TRY(read_load_value(r, key_find("boundary", "pressure"), n, b, 0));
    for (int d = 1; d < r->dim; d++) b->value[d] = b->value[0];
    b->section = scene_cross_section_or_thickness(r->scene);
    return OK;
}

/* Reads component d (from 0) of the prescribed velocity or displacement of the boundary condition b from YAML node n;
 * `free` leaves the component unconstrained. Returns REFUSED, with a message, for an invalid value. */
static status read_component(struct reader *r, const struct yaml_node *n, struct boundary *b, int d)
{
    if (n->kind == NODE_SCALAR && strcmp(n->text, "free") == 0) return OK;
    b->components |= (uint8_t)(1 << d);
    return read_load_value(r, key_find("boundary", b->displaces ? "displacement" : "velocity"), n, b, d);
}

/* Reads the prescribed velocities [m/s] or displacements [m] of the boundary condition b from YAML node n, one number,
 * formula or `free` per component, into b->value, b->formula and b->components. Returns REFUSED, with a message, for a
 * wrong number of components, or if all are free. */
static status read_velocity(struct reader *r, const struct yaml_node *n, struct boundary *b)
{
    const char *const examples[2][DIM_MAX] = {{"[22 m/s]", "[22 m/s, free]", "[22 m/s, free, free]"},
                                              {"[0.1 mm]", "[0.1 mm, free]", "[0.1 mm, free, free]"}};
    int d = 0;
    if (n->kind == NODE_LIST && n->n == r->dim) {
        for (const struct yaml_node *c = n->first; c; c = c->next) TRY(read_component(r, c, b, d++));
    } else if (n->kind == NODE_SCALAR && r->dim == 1) {
        TRY(read_component(r, n, b, 0));
    } else {
        return fault_report_at_node(
            r, n, "%s does not have the number of components of space %s; give a list of %d, for example %s",
            node_value_to_text_for_message(r, n), space_names[r->scene->space], r->dim,
            examples[b->displaces][r->dim - 1]);
    }
    return b->components ? OK
                         : fault_report_at_node(r, n, "every component is free; give at least one %s",
                                                b->displaces ? "displacement" : "velocity");
}

status read_rotation_axis(struct reader *r, const struct yaml_node *rotation_node, const char *group_path,
                          real *unit_vector)
{
    const struct key *k = key_find(group_path, "axis");
    const struct yaml_node *list = yaml_node_find(rotation_node, "axis");
    int d = 0;
    if (r->dim == 1)
        return fault_report_at_node(r, rotation_node,
                                    "a body in space line cannot turn; remove rotation, or set a plane space or solid");
    unit_vector[2] = 1;
    if (!list && r->dim == 2) return OK;
    if (!list) return fault_report_missing_key(r, rotation_node, k);
    if (r->dim == 2) return fault_report_at_node(r, list, "is always z in a plane space; remove it");
    if (list->kind != NODE_LIST || list->n != DIM_MAX)
        return fault_report_at_node(r, list, "%s is not an axis; give three numbers such as [0, 0, 1]",
                                    node_value_to_text_for_message(r, list));
    for (const struct yaml_node *c = list->first; c; c = c->next) {
        struct key plain = *k;
        plain.unit = UNIT_NONE;
        TRY(read_number(r, &plain, c, &unit_vector[d++]));
    }
    const real length2 = dot(unit_vector, unit_vector, DIM_MAX);
    return length2 > 0 && isfinite(length2)
               ? OK
               : fault_report_at_node(r, list, "has the length 0; give an axis such as [0, 0, 1]");
}

/* Reads the prescribed rotation of the boundary condition b from the mapping n: rate, centre and axis. Returns REFUSED,
 * with a message, for invalid values. */
static status read_rotation(struct reader *r, const struct yaml_node *n, struct boundary *b)
{
    TRY(read_keys_of_group(r, n, n, "boundary.rotation", b));
    TRY(read_rotation_axis(r, n, "boundary.rotation", b->axis_of));
    b->rotates = true;
    b->components = (uint8_t)((1 << r->dim) - 1);
    for (int d = 0; d < r->dim; d++) b->value[d] = 1; /* a rotation moves all components */
    return OK;
}

/* Reads a plane of symmetry into the boundary condition b. map: YAML node of the condition; n: node of its `mirror`.
 * Returns REFUSED, with a message, for an invalid axis, and if region, body or time are given, which have no meaning
 * here. */
static status read_mirror(struct reader *r, const struct yaml_node *map, const struct yaml_node *n, struct boundary *b)
{
    const char *const senseless[] = {"region", "body", "time"};
    int axis;
    for (size_t k = 0; k < COUNT_OF(senseless); k++) {
        const struct yaml_node *other = yaml_node_find(map, senseless[k]);
        if (other)
            return fault_report_at_node(r, other, "has no effect with mirror, which acts on every body; remove it");
    }
    TRY(read_keys_of_group(r, n, n, "boundary.mirror", b));
    const struct yaml_node *at = yaml_node_find(n, "axis");
    return read_axis(r, at, at->text, &axis);
}

/* Checks the entry `absorbing` of a boundary condition. map: YAML node of the condition; n: node of the entry. Returns
 * REFUSED, with a message, if a time is given, and for another value than true. */
static status read_absorbing(struct reader *r, const struct yaml_node *map, const struct yaml_node *n)
{
    const struct yaml_node *time = yaml_node_find(map, "time");
    if (time)
        return fault_report_at_node(r, time, "cannot be given with absorbing, which acts at all times; remove it");
    if (n->kind == NODE_SCALAR && strcmp(n->text, "true") == 0) return OK;
    return fault_report_at_node(
        r, n, "%s is given, but absorbing can only be true; write absorbing: true, or leave the boundary out",
        node_value_to_text_for_message(r, n));
}

/* Reads the face of the boundary condition b, such as `x+`, into b->face (axis 0 to 2) and b->side (+1 or -1). map:
 * YAML node of the boundary condition. Returns REFUSED, with a message, if it is missing or not a face of this space.
 */
static status read_face(struct reader *r, const struct yaml_node *map, struct boundary *b)
{
    const struct yaml_node *n = yaml_node_find(map, "face");
    const struct key *k = key_find("boundary", "face");
    if (!n) return fault_report_missing_key(r, map, k);
    int face = n->kind == NODE_SCALAR ? word_index_in_list(k->words, n->text) : -1;
    if (face < 0 || face >= 2 * r->dim)
        return fault_report_at_node(r, n, "%s is not the name of a face in space %s; give %s",
                                    node_value_to_text_for_message(r, n), space_names[r->scene->space],
                                    r->dim == 1   ? "x+ or x-"
                                    : r->dim == 2 ? "x+, x-, y+ or y-"
                                                  : allowed_words_join_for_message(r, k->words));
    b->face = face / 2;
    b->side = face % 2 == 0 ? 1 : -1;
    b->section = scene_cross_section_or_thickness(r->scene);
    return OK;
}

/* Reads face and depth of the layer of particles that the boundary condition b moves, if a face is given. By default
 * the depth is one horizon, or one spacing with method mpm. map: YAML node of the boundary condition. Returns REFUSED,
 * with a message, for a depth without face. */
static status read_layer(struct reader *r, const struct yaml_node *map, struct boundary *b)
{
    const struct yaml_node *depth = yaml_node_find(map, "depth");
    const struct scene *s = r->scene;
    if (!yaml_node_find(map, "face"))
        return depth ? fault_report_at_node(r, depth, "has no effect without face; add one, such as face: x+") : OK;
    b->depth = (s->method == METHOD_MPM ? 1 : s->horizon) * s->spacing;
    if (depth) TRY(read_number(r, key_find("boundary", "depth"), depth, &b->depth));
    return read_face(r, map, b);
}

/* Finds *kind, the entry of a boundary condition that determines its kind, such as velocity or pressure. map: YAML
 * node of the condition. Returns REFUSED, with a message, if there is no such entry or more than one. */
static status kind_of_boundary(struct reader *r, const struct yaml_node *map, const struct yaml_node **kind)
{
    const char *const words = "fixed|velocity|displacement|rotation|traction|pressure|body_force|mirror|absorbing";
    *kind = NULL;
    for (const struct yaml_node *n = map->first; n; n = n->next) {
        if (word_index_in_list(words, n->key) < 0) continue;
        if (*kind)
            return fault_report_at_node(
                r, n,
                "is given together with %s in one item of the list; write each boundary condition as an item "
                "of its own",
                (*kind)->key);
        *kind = n;
    }
    return *kind ? OK
                 : fault_report_at_node(r, map, "has no load or support; give one of %s",
                                        allowed_words_join_for_message(r, words));
}

/* Returns true if the text of YAML node n, a number or a formula, contains a unit and is not 0. value: the number that
 * was read from n. Returns false if n is NULL. */
static bool carries_unit(struct reader *r, const struct yaml_node *n, real value)
{
    struct key plain = *key_find("boundary", "traction");
    struct expression e = {0};
    plain.unit = UNIT_NONE;
    if (!n || n->kind != NODE_SCALAR || value == 0) return false;
    const bool unit = read_expression(r, &plain, n, EXPRESS_SPACE | EXPRESS_TIME, &e) != OK;
    expression_free(&e);
    return unit;
}

/* Checks that only one of two factors of the load of boundary condition b has a unit: the value of b, or its factor of
 * time if that is a column of a CSV file. Returns REFUSED, with a message, if the heading of the column has a unit, and
 * the value has one too or a component above 1. kind: YAML node of the value (traction, velocity, ...). */
static status check_time_unit(struct reader *r, const struct yaml_node *kind, const struct boundary *b)
{
    real most = 0;
    bool unit = carries_unit(r, kind->kind == NODE_MAP ? yaml_node_find(kind, "rate") : kind, b->value[0]);
    int k = 0;
    for (int d = 0; d < r->dim; d++) most = real_max(most, fabs(b->value[d]));
    for (const struct yaml_node *c = kind->kind == NODE_LIST ? kind->first : NULL; c && k < r->dim; c = c->next)
        unit = carries_unit(r, c, b->value[k++]) || unit;
    if (!b->time_unit || (most <= 1 && !unit)) return OK;
    return fault_report_at_node(
        r, kind,
        "%s has a unit, and so has the column of the file that multiplies it; give a direction such as [0, "
        "-1], or a column without unit",
        node_value_to_text_for_message(r, kind));
}

/* Reads the value of the boundary condition b by its kind. n: YAML node of the condition; kind: its entry that gives
 * the kind, such as velocity. Returns REFUSED, with a message, for invalid values and for keys that have no meaning
 * with this kind. */
static status read_kind(struct reader *r, const struct yaml_node *n, const struct yaml_node *kind, struct boundary *b)
{
    const struct yaml_node *face = NULL, *depth = NULL, *profile = yaml_node_find(n, "profile");
    b->kind = *kind->key == 't'   ? BOUNDARY_TRACTION
              : *kind->key == 'b' ? BOUNDARY_BODY_FORCE
              : *kind->key == 'p' ? BOUNDARY_PRESSURE
              : *kind->key == 'm' ? BOUNDARY_MIRROR
              : *kind->key == 'a' ? BOUNDARY_ABSORBING
                                  : BOUNDARY_VELOCITY;
    if (b->kind == BOUNDARY_VELOCITY)
        TRY(read_layer(r, n, b));
    else
        depth = yaml_node_find(n, "depth");
    if (depth)
        return fault_report_at_node(r, depth,
                                    "has no effect without fixed, velocity, displacement or rotation; remove it");
    if (boundary_applies_force(b) || b->kind == BOUNDARY_MIRROR) face = yaml_node_find(n, "face");
    if (face && b->kind == BOUNDARY_PRESSURE)
        return fault_report_at_node(
            r, face,
            "a pressure acts on every free face of the particles in `region`; give region in place of face, "
            "or a traction in place of the pressure");
    if (face && b->kind != BOUNDARY_TRACTION)
        return fault_report_at_node(r, face, "has no effect with %s; remove it", kind->key);
    if (b->follow && b->kind != BOUNDARY_PRESSURE)
        return fault_report_at_node(r, yaml_node_find(n, "follow"), "has no effect without pressure; remove it");
    if (profile && b->kind != BOUNDARY_BODY_FORCE)
        return fault_report_at_node(r, profile, "has no effect without body_force; remove it");
    TRY(read_profile(r, profile, &b->profile));
    if (b->kind == BOUNDARY_MIRROR) return read_mirror(r, n, kind, b);
    if (b->kind == BOUNDARY_ABSORBING) {
        TRY(read_absorbing(r, n, kind));
        return read_face(r, n, b);
    }
    if (*kind->key == 'f') return read_fixed(r, kind, b);
    b->displaces = *kind->key == 'd';
    if (*kind->key == 'v' || b->displaces) return read_velocity(r, kind, b);
    if (*kind->key == 'r') return read_rotation(r, kind, b);
    if (*kind->key == 'p') return read_pressure(r, kind, b);
    TRY(read_vector_of_formulas(r, key_find("boundary", kind->key), kind, EXPRESS_SPACE | EXPRESS_TIME, b->value,
                                b->formula));
    return b->kind == BOUNDARY_TRACTION ? read_face(r, n, b) : OK;
}

static status read_boundary(struct reader *r, const struct yaml_node *n, struct boundary *b)
{
    const struct yaml_node *kind;
    TRY(check_node_is_mapping(r, n, "boundary"));
    TRY(check_mapping_keys_known_and_unique(r, n, "boundary"));
    TRY(kind_of_boundary(r, n, &kind));
    TRY(read_keys_of_group(r, n, n, "boundary", b));
    TRY(read_kind(r, n, kind, b));
    TRY(read_time_function(r, yaml_node_find(n, "time"), b));
    return check_time_unit(r, kind, b);
}

/* Appends gravity to the boundary conditions of the scene as a body force on all bodies. n: YAML node of `gravity`,
 * for messages. Returns REFUSED, with a message, if there are BOUNDARIES_MAX conditions already, or one called
 * gravity. */
static status gravity_add(struct reader *r, const struct yaml_node *n)
{
    struct scene *s = r->scene;
    struct boundary *b = &s->boundary[s->boundaries];
    if (s->boundaries == BOUNDARIES_MAX)
        return fault_report_at_node(r, n, "is one boundary condition more than the limit of %d; join or remove some",
                                    BOUNDARIES_MAX);
    for (int k = 0; k < s->boundaries; k++)
        if (strcmp(s->boundary[k].name, "gravity") == 0)
            return fault_report_at_node(
                r, n,
                "a boundary has the name gravity, which is the name of the load by this key; rename the boundary");
    *b = (struct boundary){.name = "gravity", .kind = BOUNDARY_BODY_FORCE, .body = -1, .by_mass = true};
    memcpy(b->value, s->gravity, sizeof b->value);
    location_write_text_of_node(r, n, b->place, sizeof b->place);
    s->boundaries++;
    return OK;
}

status read_boundaries(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "boundary"), *n = list ? list->first : NULL;
    const bool falls = dot(s->gravity, s->gravity, s->dim) > 0;
    if (list) TRY(check_node_is_list_of_valid_length(r, key_find("", "boundary"), list));
    s->boundary = NEW("boundary conditions", (list ? list->n : 0) + falls, struct boundary);
    for (int k = 0; n; k++, n = n->next) {
        struct boundary *b = &s->boundary[k];
        s->boundaries++; /* released with the scene if the rest is refused */
        b->body = -1, b->end = s->duration;
        location_write_text_of_node(r, n, b->place, sizeof b->place);
        snprintf(b->name, sizeof b->name, "boundary%d", k);
        TRY(read_boundary(r, n, b));
        for (int j = 0; j < k; j++)
            if (strcmp(s->boundary[j].name, b->name) == 0)
                return fault_report_at_node(
                    r, n, "%s is already the name of another boundary; give each boundary its own name", b->name);
    }
    return falls ? gravity_add(r, yaml_node_find(root, "gravity")) : OK;
}
