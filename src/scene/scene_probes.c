/* Reads the probes of a scene. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

const char *const probe_names[PROBES] = {"tip",    "break",    "reaction", "patch", "spall", "point",  "line",
                                         "energy", "momentum", "pulse",    "exact", "sif",   "growth", "rigid"};

/* Finds *kind, the kind of a probe, and *map, the mapping of its keys, or NULL if it has none. n: YAML node of the
 * probe in one of the forms `tip`, `tip:` or `tip: {at: [..]}`. Returns REFUSED, with a message, for an unknown kind
 * or several kinds. */
static status kind_of_probe(struct reader *r, const struct yaml_node *n, enum probe_kind *kind,
                            const struct yaml_node **map)
{
    struct yaml_node word = *n, list = {.kind = NODE_MAP, .n = 1, .first = &word};
    *map = NULL;
    if (n->kind == NODE_SCALAR) {
        word.key = n->text, word.next = NULL;
        TRY(check_mapping_keys_known_and_unique(r, &list, "probes"));
    } else {
        TRY(check_node_kind(r, n, NODE_MAP, "give a probe, such as tip (of the crack) or point: {at: [..]}"));
        TRY(check_mapping_keys_known_and_unique(r, n, "probes"));
        if (n->n != 1)
            return fault_report_at_node(r, n, "has %d keys; give one, the kind of the probe, such as point: {at: [..]}",
                                        n->n);
        if (n->first->kind != NODE_SCALAR || *n->first->text) *map = n->first;
    }
    const char *name = n->kind == NODE_SCALAR ? n->text : n->first->key;
    for (int k = 0; k < PROBES; k++)
        if (strcmp(probe_names[k], name) == 0) *kind = (enum probe_kind)k;
    return OK;
}

/* Returns REFUSED, with a message, if p is a reaction probe and the input file (scene) does not have the boundary
 * condition that it names. n: YAML node of this name, for the message. */
static status check_probe_boundary(struct reader *r, const struct yaml_node *n, const struct probe_request *p)
{
    const struct scene *s = r->scene;
    int nearest = 0;
    if (p->kind != PROBE_REACTION) return OK;
    if (s->boundaries == 0)
        return fault_report_at_node(
            r, n, "the scene has no boundary condition whose force can be measured; add a list `boundary`");
    for (int k = 0; k < s->boundaries; k++) {
        if (strcmp(s->boundary[k].name, p->boundary) == 0) return OK;
        if (edit_distance(s->boundary[k].name, p->boundary) < edit_distance(s->boundary[nearest].name, p->boundary))
            nearest = k;
    }
    return fault_report_at_node(
        r, n, "there is no boundary named %s; give the name of one of the %d in the scene (most similar: %s)",
        p->boundary, s->boundaries, s->boundary[nearest].name);
}

/* Checks a probe p that compares with a closed-form solution; returns OK for other probes. n: YAML node of the probe;
 * map: mapping of its keys, or NULL. Returns REFUSED, with a message, outside space line, and if a number of the
 * manufactured solution is missing or is given with another solution. */
static status check_exact(struct reader *r, const struct yaml_node *n, const struct yaml_node *map,
                          const struct probe_request *p)
{
    const char *const numbers[] = {"amplitude", "period", "wavelength", "origin"};
    if (p->kind != PROBE_EXACT) return OK;
    if (r->scene->space != SPACE_LINE)
        return fault_report_at_node(
            r, map ? map : n,
            "compares with the solution of a bar in one dimension; set space: line, or remove this probe");
    for (size_t k = 0; k < COUNT_OF(numbers); k++) {
        const struct yaml_node *given = yaml_node_find(map, numbers[k]);
        if (given && p->form != EXACT_MANUFACTURED)
            return fault_report_at_node(r, given, "has no effect without form: manufactured; remove it");
        if (!given && p->form == EXACT_MANUFACTURED)
            return fault_report_missing_key(r, map, key_find("probes.exact", numbers[k]));
    }
    return OK;
}

static status check_rigid(struct reader *r, const struct yaml_node *n, const struct yaml_node *map,
                          const struct probe_request *p)
{
    if (p->kind != PROBE_RIGID || r->dim == 2) return OK;
    return fault_report_at_node(r, map ? map : n,
                                "the probe rigid works in plane stress and plane strain only; remove it");
}

/* Checks a probe p of stress-intensity factors; returns OK for other probes. Sets its outer radius to its last contour
 * if none is given. n: YAML node of the probe; map: mapping of its keys, or NULL. Returns REFUSED, with a message, for
 * invalid radii, contours or direction, and outside plane spaces. */
static status check_sif(struct reader *r, const struct yaml_node *n, const struct yaml_node *map,
                        struct probe_request *p)
{
    enum { CONTOURS_MAX = 16 };
    if (p->kind != PROBE_SIF) return OK;
    if (r->dim != 2)
        return fault_report_at_node(r, map ? map : n,
                                    "the probe sif works in plane stress and plane strain only; remove it");
    const struct number_list *c = &p->contours;
    const struct yaml_node *contours = yaml_node_find(map, "contours");
    if (c->n > CONTOURS_MAX) return fault_report_at_node(r, contours, "has %d items; give 1 to %d", c->n, CONTOURS_MAX);
    if (isnan(p->outer) && c->n > 0) p->outer = c->value[c->n - 1];
    const real outer = isnan(p->outer) ? 20 * r->scene->spacing : p->outer;
    if (p->inner >= outer)
        return fault_report_at_node(
            r, yaml_node_find(map, "inner"),
            "the inner radius %s is not smaller than the outer radius, %.6g m; use about half the outer radius",
            node_value_to_text_for_message(r, yaml_node_find(map, "inner")), outer);
    const real shares[2] = {p->direction[0], p->direction[1]};
    if (!p->has_direction || dot(shares, shares, 2) > 0) return OK;
    return fault_report_at_node(r, yaml_node_find(map, "direction"),
                                "has the length 0; give the direction ahead of the crack tip, such as [1, 0]");
}

/* Reads the probe of YAML node n, in any of its forms, into *p. A number that is not given and has no default becomes
 * NAN. Returns REFUSED, with a message, for an invalid probe. */
static status read_probe(struct reader *r, const struct yaml_node *n, struct probe_request *p)
{
    const struct yaml_node *map;
    struct yaml_node form, short_form;
    char group[32];
    TRY(kind_of_probe(r, n, &p->kind, &map));
    if (p->kind == PROBE_EXACT && map && map->kind == NODE_SCALAR) { /* `exact: step bar` */
        form = short_form = *map;
        form.key = (char *)"form", form.next = NULL;
        short_form.kind = NODE_MAP, short_form.n = 1, short_form.first = short_form.last = &form;
        map = &short_form;
    }
    location_write_text_of_node(r, n, p->place, sizeof p->place);
    p->amplitude = p->period = p->wavelength = p->origin = NAN;
    p->inner = p->outer = p->core = p->experiment = NAN;
    snprintf(group, sizeof group, "probes.%s", probe_names[p->kind]);
    strcpy(p->name, probe_names[p->kind]);
    TRY(read_keys_of_group(r, map ? map : n, map, group, p));
    if (p->kind == PROBE_LINE && memcmp(p->from, p->to, sizeof p->from) == 0)
        return fault_report_at_node(r, map, "has the length 0; give two different ends, from and to");
    TRY(check_exact(r, n, map, p));
    TRY(check_sif(r, n, map, p));
    TRY(check_rigid(r, n, map, p));
    return check_probe_boundary(r, map ? yaml_node_find(map, "boundary") : n, p);
}

status read_probes(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "probes");
    if (!list) return OK;
    TRY(check_node_is_list_of_valid_length(r, key_find("", "probes"), list));
    s->probes = list->n;
    s->probe = NEW("probes", list->n, struct probe_request);
    const struct yaml_node *n = list->first;
    for (int k = 0; k < s->probes; k++, n = n->next) {
        TRY(read_probe(r, n, &s->probe[k]));
        for (int j = 0; j < k; j++)
            if (strcmp(s->probe[j].name, s->probe[k].name) == 0)
                return fault_report_at_node(r, n, "%s is already the name of another probe; give each its own",
                                            s->probe[k].name);
    }
    return OK;
}
