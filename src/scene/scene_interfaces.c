/* Reads the interfaces of a scene: bodies that are joined become one body of several materials. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene_parts.h"
#include "scene_remedies.h"

/* Sets face->body[2] to the indices of the two bodies that the interface `face` joins, found by name. n: YAML node of
 * the interface. Returns REFUSED, with a message, for unknown or rigid bodies, equal bodies and pairs that have an
 * interface already. */
static status interface_bodies(struct reader *r, const struct yaml_node *n, struct scene_interface *face)
{
    const struct scene *s = r->scene;
    const struct yaml_node *names = yaml_node_find(n, "bodies");
    if (!names) return fault_report_missing_key(r, n, key_find("interfaces", "bodies"));
    if (names->kind != NODE_LIST || names->n != 2)
        return fault_report_at_node(r, names, "is not two names; give the names of two bodies, such as [plate, layer]");
    const struct yaml_node *name = names->first;
    for (int k = 0; k < 2; k++, name = name->next) {
        face->body[k] = -1;
        for (int b = 0; b < s->bodies; b++)
            if (name->kind == NODE_SCALAR && strcmp(s->body[b].name, name->text) == 0) face->body[k] = b;
        for (int b = 0; b < s->rigids; b++)
            if (name->kind == NODE_SCALAR && strcmp(s->body[s->bodies + b].name, name->text) == 0)
                return fault_report_at_node(
                    r, name,
                    "%s is rigid, but an interface joins only bodies with particles; name two such bodies, or "
                    "remove the interface (contact acts without it)",
                    name->text);
        if (face->body[k] < 0)
            return fault_report_at_node(r, name, "is not the name of a body with particles; check its spelling");
    }
    if (face->body[0] == face->body[1]) return fault_report_at_node(r, names, "names one body twice; give two bodies");
    for (const struct scene_interface *other = s->interface; other < face; other++)
        if ((other->body[0] == face->body[0] && other->body[1] == face->body[1]) ||
            (other->body[0] == face->body[1] && other->body[1] == face->body[0]))
            return fault_report_at_node(r, names,
                                        "these two bodies have an interface already; remove one of the two interfaces");
    return OK;
}

/* Makes a copy of the material of body b, named MATERIAL_BODY, and assigns the copy to b. It is needed because bonds
 * between joined bodies are recognised by their different materials. n: YAML node of the interface, for messages.
 * Returns REFUSED, with a message, if there are 255 materials already. */
static status material_apart(struct reader *r, const struct yaml_node *n, struct scene_body *b)
{
    struct scene *s = r->scene;
    if (s->materials >= 255)
        return fault_report_at_node(
            r, n,
            "each joined body needs a material of its own, and the limit of 255 materials is reached; use "
            "fewer interfaces");
    const int all = s->materials + s->unused_materials;
    GROW("materials", s->material, all + 1);
    GROW("materials.numbers", s->material_number, all + 1);
    s->material[all] = s->material[s->materials]; /* one that no body consists of makes room */
    s->material_number[all] = s->material_number[s->materials], s->material_number[s->materials] = all;
    struct material *own = &s->material[s->materials];
    *own = s->material[b->material];
    char name[2 * NAME_MAX_LENGTH + 8];
    snprintf(name, sizeof name, "%s_%s", s->material[b->material].name, b->name);
    snprintf(own->name, sizeof own->name, "%.*s", (int)sizeof own->name - 1, name);
    b->material = s->materials++;
    return OK;
}

/* Computes face->critical_stretch, the critical stretch of bonds across the interface `face`, if the interface has an
 * energy release rate. With model bond it is the critical stretch of a material with the harmonic mean of both Young's
 * moduli, this energy release rate, and the other properties of the softer body; state-based bonds have the mean of
 * the energies of both materials. n: YAML node of the interface. Returns REFUSED, with a message, for bodies of
 * several materials or with bonds that soften. */
static status interface_strength(struct reader *r, const struct yaml_node *n, struct scene_interface *face)
{
    struct scene *s = r->scene;
    if (!(face->energy_release_rate > 0)) return OK;
    struct scene_body *one = &s->body[face->body[0]], *other = &s->body[face->body[1]];
    if (one->parts > 0 || other->parts > 0)
        return fault_report_at_node(
            r, yaml_node_find(n, "energy_release_rate"),
            "body %s has parts of different materials; an interface with its own energy needs bodies of one "
            "material each",
            one->parts > 0 ? one->name : other->name);
    if (material_has_softening_bonds(&s->material[one->material]) ||
        material_has_softening_bonds(&s->material[other->material]))
        return fault_report_at_node(
            r, yaml_node_find(n, "energy_release_rate"),
            "one of the bodies has a tensile_strength; an interface with its own energy joins brittle bodies "
            "only; remove the tensile_strength, or this key");
    if (one->material == other->material) TRY(material_apart(r, n, other));
    const struct material *a = &s->material[one->material], *b = &s->material[other->material];
    struct material between = a->young < b->young ? *a : *b, first = *a, second = *b;
    between.young = 2 * a->young * b->young / (a->young + b->young);
    between.energy_release_rate = face->energy_release_rate;
    material_compute_derived_constants(&between, s->space);
    face->critical_stretch = scene_critical_stretch(s, &between);
    if (s->model == MODEL_BOND || materials_have_equal_stiffness(a, b)) return OK;
    first.energy_release_rate = second.energy_release_rate = face->energy_release_rate;
    const real one_stretch = scene_critical_stretch(s, &first), other_stretch = scene_critical_stretch(s, &second);
    face->critical_stretch = sqrt(2 / (1 / square(one_stretch) + 1 / square(other_stretch)));
    return OK;
}

static void join_bodies(struct scene *s, int one, int other)
{
    const int from = s->body[one].joined, to = s->body[other].joined;
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].joined == (from > to ? from : to)) s->body[b].joined = from > to ? to : from;
}

status read_interfaces(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "interfaces");
    for (int b = 0; b < s->bodies; b++) s->body[b].joined = b;
    if (!list) return OK;
    TRY(check_node_is_list_of_valid_length(r, key_find("", "interfaces"), list));
    if (s->method == METHOD_ADAPTIVE) return refuse_interfaces_with_adaptive_method(r, list);
    s->interface = NEW("interfaces", list->n, struct scene_interface);
    s->interfaces = list->n;
    const struct yaml_node *n = list->first;
    for (int k = 0; k < s->interfaces; k++, n = n->next) {
        struct scene_interface *face = &s->interface[k];
        TRY(read_keys_of_group(r, n, n, "interfaces", face));
        TRY(interface_bodies(r, n, face));
        if (!face->joined && yaml_node_find(n, "energy_release_rate"))
            return fault_report_at_node(r, yaml_node_find(n, "energy_release_rate"),
                                        "has no effect on bodies that are not joined; remove it, or set joined: true");
        if (s->method == METHOD_MPM && yaml_node_find(n, "energy_release_rate"))
            return fault_report_at_node(
                r, yaml_node_find(n, "energy_release_rate"),
                "bodies joined by the grid of method: mpm do not separate; set method: pd, or remove this key");
        if (!face->joined) continue;
        TRY(interface_strength(r, n, face));
        join_bodies(s, face->body[0], face->body[1]);
    }
    return OK;
}

status check_boundaries_apply_to_all_joined_bodies(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *n = yaml_node_find(root, "boundary");
    n = n ? n->first : NULL;
    for (int k = 0; k < s->boundaries && n; k++, n = n->next) {
        const int body = s->boundary[k].body;
        for (int b = 0; b < s->bodies && body >= 0; b++)
            if (b != body && s->body[b].joined == s->body[body].joined)
                return fault_report_at_node(
                    r, yaml_node_find(n, "body"),
                    "the body is joined to body %s by an interface, and both count as one body; remove this "
                    "key and give a region",
                    s->body[b].name);
    }
    return OK;
}
