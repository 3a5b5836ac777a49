/* Proposes changes of the method of a scene, for refusals: with a proposed change the scene must no longer be
 * refused for the same reason. A table contains what each method and model supports; the features of the scene are
 * compared with it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_remedies.h"

/* Features of a scene that not every method and model supports, as bits of a set. */
enum {
    HAS_RIGID = 1,       /* rigid bodies */
    HAS_RATIO = 2,       /* a Poisson's ratio that bonds do not have */
    HAS_YIELD = 4,       /* yield_stress with linear hardening */
    HAS_FLOW = 8,        /* another law of plasticity */
    HAS_SOFTENING = 16,  /* tensile_strength */
    HAS_VISCOSITY = 32,  /* bulk viscosity */
    HAS_INTERFACES = 64, /* bodies that are joined */
};

/* Features (bits HAS_...) that a scene may have with a method and a model. With method mpm the model has no effect; its
 * row has `bond` for all models. */
static const struct {
    enum method method;
    enum model model;
    unsigned can;
} combination[] = {
    {METHOD_PD, MODEL_BOND, HAS_RIGID | HAS_YIELD | HAS_SOFTENING | HAS_VISCOSITY | HAS_INTERFACES},
    {METHOD_ADAPTIVE, MODEL_BOND, HAS_RIGID | HAS_YIELD | HAS_SOFTENING | HAS_VISCOSITY},
    {METHOD_PD, MODEL_OSPD, HAS_RIGID | HAS_RATIO | HAS_SOFTENING | HAS_INTERFACES},
    {METHOD_ADAPTIVE, MODEL_OSPD, HAS_RIGID | HAS_RATIO | HAS_SOFTENING},
    {METHOD_MPM, MODEL_BOND, HAS_RATIO | HAS_YIELD | HAS_FLOW | HAS_VISCOSITY | HAS_INTERFACES},
};

/* Names of the features that a scene may have, in the order of the bits HAS_... */
static const char *const had[] = {"rigid bodies",     "a Poisson's ratio that bonds do not have",
                                  "yield_stress",     "a law of plasticity other than linear hardening",
                                  "tensile_strength", "viscosity",
                                  "interfaces"};

bool scene_has_material_with_key(const struct yaml_node *root, const char *key)
{
    const struct yaml_node *one = yaml_node_find(root, "material"), *many = yaml_node_find(root, "materials");
    bool has = one && yaml_node_find(one, key);
    for (const struct yaml_node *n = many ? many->first : NULL; n; n = n->next) has = has || yaml_node_find(n, key);
    return has;
}

/* Returns true if an item of the list `bodies` of the scene is rigid. root: YAML tree of the input file (scene). */
static bool has_rigid_bodies(const struct yaml_node *root)
{
    const struct yaml_node *many = yaml_node_find(root, "bodies");
    bool rigid = false;
    for (const struct yaml_node *n = many ? many->first : NULL; n; n = n->next) {
        const struct yaml_node *flag = yaml_node_find(n, "rigid");
        rigid = rigid || (flag && flag->kind == NODE_SCALAR && strcmp(flag->text, "true") == 0);
    }
    return rigid;
}

/* Returns the features of the scene (bits HAS_...) that not every method supports. Materials that have not been read
 * yet are assumed to have the Poisson's ratio of bond-based peridynamics. r: reader with the tree and the scene as far
 * as it has been read. */
static unsigned scene_has(const struct reader *r)
{
    const struct scene *s = r->scene;
    const struct yaml_node *root = r->root;
    unsigned has = 0;
    if (has_rigid_bodies(root)) has |= HAS_RIGID;
    if (yaml_node_find(root, "interfaces")) has |= HAS_INTERFACES;
    if (scene_has_material_with_key(root, "yield_stress")) has |= HAS_YIELD;
    if (scene_has_material_with_key(root, "hardening") || scene_has_material_with_key(root, "kinematic") ||
        scene_has_material_with_key(root, "johnson_cook"))
        has |= HAS_FLOW;
    if (scene_has_material_with_key(root, "tensile_strength")) has |= HAS_SOFTENING;
    if (scene_has_material_with_key(root, "viscosity")) has |= HAS_VISCOSITY;
    for (int m = 0; m < s->materials && s->dim > 1; m++)
        if (s->material[m].young > 0 && fabs(s->material[m].poisson - bond_based_poisson_ratio(s->space)) > 1e-6)
            has |= HAS_RATIO;
    return has;
}

/* Returns the index of the row of the table `combination` for a method that supports all features in `has` (bits
 * HAS_...), with the model of the scene s if possible; -1 if there is none. */
static int row_of_method(const struct scene *s, enum method method, unsigned has)
{
    int row = -1;
    for (size_t k = 0; k < COUNT_OF(combination); k++) {
        if (combination[k].method != method || (has & ~combination[k].can) != 0) continue;
        if (row < 0 || combination[k].model == s->model) row = (int)k;
    }
    return row;
}

/* Writes to text[capacity], as words of a message, how the scene s must be changed to the method and model in row
 * number `row` of the table `combination`. With method mpm, which does not use the key `model`, the key is mentioned
 * only if the input file (scene) has plasticity: a scene with plasticity must not name a state-based model. has:
 * features of the scene (bits HAS_...). */
static void write_change(const struct scene *s, int row, unsigned has, char *text, size_t capacity)
{
    static const char *const methods[] = {
        [METHOD_PD] = "`method: pd`", [METHOD_MPM] = "`method: mpm`", [METHOD_ADAPTIVE] = "`method: adaptive`"};
    static const char *const models[] = {[MODEL_BOND] = "`model: bond`", [MODEL_OSPD] = "`model: ospd`"};
    const enum method method = combination[row].method;
    const char *model = models[combination[row].model];
    const bool other = combination[row].model != s->model;
    if (method == s->method && method == METHOD_MPM)
        snprintf(text, capacity, "no key model");
    else if (method == s->method)
        snprintf(text, capacity, "%s", model);
    else if (method == METHOD_MPM)
        snprintf(text, capacity, "%s%s", methods[method],
                 other && has & (HAS_YIELD | HAS_FLOW) ? " without the key model" : "");
    else
        snprintf(text, capacity, "%s%s%s", methods[method], other ? " with " : "", other ? model : "");
}

/* Returns the changes of method or model with which the scene could have all features in `has` (bits HAS_...), as words
 * of a message. If another model suffices, only this model is named. Returns NULL if there is no such change. The text
 * is in the arena of the reader r. */
static const char *changes_that_allow(struct reader *r, unsigned has)
{
    static const enum method methods[] = {METHOD_PD, METHOD_ADAPTIVE, METHOD_MPM};
    const struct scene *s = r->scene;
    const int same = row_of_method(s, s->method, has);
    char text[160] = "", one[80];
    if (same >= 0) write_change(s, same, has, text, sizeof text);
    for (size_t k = 0; k < COUNT_OF(methods) && same < 0; k++) {
        const int row = row_of_method(s, methods[k], has);
        const size_t used = strlen(text);
        if (row < 0) continue;
        write_change(s, row, has, one, sizeof one);
        snprintf(text + used, sizeof text - used, "%s%s", used > 0 ? " or " : "", one);
    }
    return *text ? arena_copy_text(r, text, strlen(text)) : NULL;
}

/* Returns the names of the features in `has` (bits HAS_...), joined by "and", in the arena of the reader r. */
static const char *names_of(struct reader *r, unsigned has)
{
    char text[240] = "";
    for (size_t bit = 0; bit < COUNT_OF(had); bit++) {
        const size_t used = strlen(text);
        if (has >> bit & 1) snprintf(text + used, sizeof text - used, "%s%s", used > 0 ? " and " : "", had[bit]);
    }
    return arena_copy_text(r, text, strlen(text));
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Returns the Poisson's ratio of bond-based peridynamics in the space of the scene s (plane stress, or plane strain and
 * 3D), as text. */
static const char *ratio_of_bonds(const struct scene *s) { return s->space == SPACE_PLANE_STRESS ? "1/3" : "1/4"; }

status refuse_bond_based_poisson_ratio(struct reader *r, const struct yaml_node *poisson_node)
{
    const unsigned has = scene_has(r) | HAS_RATIO;
    const char *change = changes_that_allow(r, has), *bonds = ratio_of_bonds(r->scene);
    if (change)
        return fault_report_at_node(
            r, poisson_node,
            "a Poisson's ratio of %s is impossible with bonds, which have %s in space %s; use %s for any ratio, or "
            "remove this key",
            node_value_to_text_for_message(r, poisson_node), bonds, space_names[r->scene->space], change);
    return fault_report_at_node(
        r, poisson_node,
        "a Poisson's ratio of %s is impossible with bonds, which have %s in space %s; use the ratio of bonds, "
        "because no method allows another one together with %s",
        node_value_to_text_for_message(r, poisson_node), bonds, space_names[r->scene->space],
        names_of(r, has & ~(unsigned)HAS_RATIO));
}

status refuse_yield_with_state_model(struct reader *r, const struct yaml_node *yield_node)
{
    const unsigned has = scene_has(r);
    const char *model = r->scene->model == MODEL_OSPD ? "ospd" : "mospd", *change = changes_that_allow(r, has);
    if (change) return fault_report_at_node(r, yield_node, "the model %s cannot yield; set %s", model, change);
    return fault_report_at_node(r, yield_node,
                                "the model %s cannot yield, and no method has all of %s; remove one of these", model,
                                names_of(r, has));
}

status refuse_flow_law_without_mpm(struct reader *r, const struct yaml_node *law_node)
{
    const struct scene *s = r->scene;
    const unsigned has = scene_has(r), linear = (has & ~(unsigned)HAS_FLOW) | HAS_YIELD;
    const char *points = changes_that_allow(r, has);
    const int bonds = row_of_method(s, s->method, linear & ~(unsigned)HAS_RATIO);
    const bool ratio = has & HAS_RATIO;
    if (bonds < 0)
        return fault_report_at_node(r, law_node, "works for material points only; use %s",
                                    points ? points : "`method: mpm` without rigid bodies and tensile_strength");
    return fault_report_at_node(
        r, law_node,
        "works for material points only; use %s%syield_stress with linear hardening by yield_hardening, which "
        "bonds%s have%s%s",
        points ? points : "", points ? ", or " : "", s->model == MODEL_BOND ? "" : " (`model: bond`)",
        ratio ? " at a Poisson's ratio of " : "", ratio ? ratio_of_bonds(s) : "");
}

status refuse_unsupported_softening(struct reader *r, const struct yaml_node *strength_node)
{
    const unsigned has = scene_has(r);
    const char *change = changes_that_allow(r, has);
    if (change) return fault_report_at_node(r, strength_node, "needs bonds that can soften; set %s", change);
    return fault_report_at_node(
        r, strength_node,
        "needs bonds that can soften, which cannot be combined with %s; remove this key and softening (bonds "
        "are then brittle)",
        names_of(r, has & ~(unsigned)HAS_SOFTENING));
}

status refuse_unsupported_rigid_bodies(struct reader *r, const struct yaml_node *bodies_node)
{
    const unsigned has = scene_has(r);
    const char *change = changes_that_allow(r, has);
    if (r->scene->method != METHOD_MPM)
        return fault_report_at_node(
            r, bodies_node,
            "rigid bodies move in time steps only; set `solver: explicit`; a smooth wall at rest can be a "
            "boundary `mirror` instead");
    if (change)
        return fault_report_at_node(
            r, bodies_node,
            "rigid bodies have contact with peridynamic particles only: use %s; a smooth wall at rest can be "
            "a boundary `mirror` instead",
            change);
    return fault_report_at_node(
        r, bodies_node,
        "rigid bodies have contact with peridynamic particles only, which do not allow %s; use a boundary "
        "`mirror` for a smooth wall at rest, or a body of a stiff elastic material",
        names_of(r, has & ~(unsigned)HAS_RIGID));
}

status refuse_interfaces_with_adaptive_method(struct reader *r, const struct yaml_node *interfaces_node)
{
    const unsigned has = scene_has(r);
    const char *change = changes_that_allow(r, has);
    if (change)
        return fault_report_at_node(
            r, interfaces_node, "bodies are joined by bonds (method: pd) or by their grid (method: mpm) only; set %s",
            change);
    return fault_report_at_node(
        r, interfaces_node,
        "bodies are joined by bonds (method: pd) or by their grid (method: mpm) only, and no method has all "
        "of %s; remove one of these",
        names_of(r, has));
}

const char *strength_unit_hint_if_required_horizon_is_tiny(const struct scene *s, real required_horizon)
{
    return required_horizon < 1e-3 * s->horizon * s->spacing
               ? "; check the units of energy_release_rate (J/m^2), tensile_strength (Pa) and spacing (m)"
               : "";
}
