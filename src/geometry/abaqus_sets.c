/* Reads the sets of an Abaqus deck. */
#include <stdio.h>
#include <strings.h>

#include "abaqus_deck.h"
#include "base/memory.h"

enum { GENERATED_MOST = 16 }; /* most members that are not listed, for each byte of the deck */

/* Writes the name of a set of an Abaqus deck to text[2 * FIELD]: `owner`.`name`, where `owner` is the name of a part or
 * an instance, or `name` alone if `owner` is "". Returns the number of characters before `name`. */
static int name_join(char *text, const char *owner, const char *name)
{
    const int own = *owner ? (int)strlen(owner) + 1 : 0;
    snprintf(text, 2 * FIELD, "%s%s%s", owner, own > 0 ? "." : "", name);
    text_replace_control_characters(text);
    return own;
}

status abaqus_find_or_create_set_named_by_parameter(struct abaqus_input_deck *d, const char *name, bool of_nodes,
                                                    int *set)
{
    char whole[2 * FIELD];
    const char *given = abaqus_keyword_parameter_value(&d->key, name);
    *set = -1;
    if (!given) return OK;
    const int own = name_join(whole, d->scope[d->now].name, given);
    *set = element_mesh_find_or_create_set(d->m, whole, of_nodes);
    if (*set < 0)
        return geometry_file_report_fault(d->s, "the file has more than %d sets; remove some", ELEMENT_SETS_MAX);
    d->m->set[*set].own = own;
    return OK;
}

int abaqus_find_part_by_own_or_instance_name(const struct abaqus_input_deck *d, const char *name, bool instance)
{
    for (int k = 1; k < d->scopes; k++)
        if (strcasecmp(instance ? d->scope[k].instance : d->scope[k].name, name) == 0) return k;
    return -1;
}

/* Counts n members that deck d adds to a set without listing them. Returns REFUSED, with a message, if more than
 * GENERATED_MOST for each byte of the file have been added in this way, because the file is then damaged. */
static status generated_add(struct abaqus_input_deck *d, int64_t n)
{
    d->generated += n;
    if (d->generated <= GENERATED_MOST * d->length) return OK;
    return geometry_file_report_fault(
        d->s, "sets list more nodes or elements than the file has, so it is damaged; write the deck again");
}

/* Adds the node or element with the index `index` in the mesh to set number `number` of deck d. The first set->resolved
 * members of a set are such indices; the members behind them are labels, which become indices when their part ends. */
static void set_add_index(struct abaqus_input_deck *d, int number, int64_t index)
{
    element_mesh_add_to_set(d->m, number, index);
    struct element_set *set = &d->m->set[number];
    set->member[set->n - 1] = set->member[set->resolved];
    set->member[set->resolved++] = (int32_t)index;
}

/* Adds the node or element with the number `label` in the file to set number `set` of deck d. part: a part that has
 * been read completely; its node or element is added by index, and a label that it does not have is left out. NULL: the
 * part that is being read; the label is added and becomes an index when the part ends. */
static void set_add_label(struct abaqus_input_deck *d, int set, const struct abaqus_label_scope *part, int64_t label)
{
    if (!part) {
        element_mesh_add_to_set(d->m, set, label);
        return;
    }
    const int64_t index = label_map_find(d->m->set[set].of_nodes ? &part->node_of : &part->element_of, label);
    if (index >= 0) set_add_index(d, set, index);
}

/* Reads a line of deck d after GENERATE: first label, last label and step. Adds the labels first, first + step, .. last
 * to set number `set` (set_add_label, which describes `part`). Returns REFUSED, with a message, if the step is not
 * positive, last is below first, or there are too many members. */
static status generate_line(struct abaqus_input_deck *d, int set, const struct abaqus_label_scope *part)
{
    int32_t bound[3] = {0, 0, 1};
    char field[FIELD];
    for (int k = 0; k < 3 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_label(d->s, field, &bound[k]));
    if (bound[2] < 1 || bound[1] < bound[0])
        return geometry_file_report_fault(
            d->s, "a set with GENERATE lacks its first number, last number or step; give all three");
    TRY(generated_add(d, (bound[1] - bound[0]) / bound[2] + 1));
    for (int64_t label = bound[0]; label <= bound[1]; label += bound[2]) set_add_label(d, set, part, label);
    return OK;
}

/* Returns the index of the set of nodes (of_nodes is true) or elements called `name` in the input file d; -1 if there
 * is none. The set is one of `part`, the part of an instance, if it has such a set; else one of the part that is being
 * read or, outside parts, of the file. */
static int set_index(const struct abaqus_input_deck *d, const struct abaqus_label_scope *part, const char *name,
                     bool of_nodes)
{
    char whole[2 * FIELD];
    name_join(whole, part ? part->instance : d->scope[d->now].name, name);
    for (int k = 0; k < d->m->sets; k++)
        if (d->m->set[k].of_nodes == of_nodes && strcasecmp(d->m->set[k].name, whole) == 0) return k;
    return part ? set_index(d, NULL, name, of_nodes) : -1;
}

/* Adds the items that the text `field` of a data line names to set number `set` of deck d: the members of another set,
 * given as Name or Instance.Name, or one node or element, given as Instance.Number. part: part of the instance that the
 * keyword names; NULL: none. Returns REFUSED, with a message, if there is no such set, or if there are too many
 * members. */
static status set_join(struct abaqus_input_deck *d, int set, const struct abaqus_label_scope *part, const char *field)
{
    const bool of_nodes = d->m->set[set].of_nodes;
    const char *dot = strrchr(field, '.');
    char owner[FIELD];
    int32_t label;
    const int other = set_index(d, part, field, of_nodes);
    snprintf(owner, sizeof owner, "%.*s", dot ? (int)(dot - field) : 0, field);
    const int scope = dot && dot > field ? abaqus_find_part_by_own_or_instance_name(d, owner, true) : -1;
    if (other < 0 && scope >= 0 && abaqus_field_is_label(dot + 1)) {
        TRY(abaqus_parse_label(d->s, dot + 1, &label));
        set_add_label(d, set, &d->scope[scope], label);
        return OK;
    }
    if (other < 0)
        return geometry_file_report_fault(
            d->s, "set %.40s lists %.40s, which is not the name of an earlier set; give that set before",
            d->m->set[set].name, field);
    TRY(generated_add(d, d->m->set[other].n));
    for (int64_t k = 0; other != set && k < d->m->set[other].n; k++) {
        const int64_t member = d->m->set[other].member[k];
        if (k < d->m->set[other].resolved)
            set_add_index(d, set, member);
        else
            element_mesh_add_to_set(d->m, set, member);
    }
    return OK;
}

void abaqus_replace_set_labels_by_indices(struct abaqus_input_deck *d, const struct abaqus_label_scope *scope)
{
    for (int k = 0; k < d->m->sets; k++) {
        struct element_set *set = &d->m->set[k];
        const struct label_map *map = set->of_nodes ? &scope->node_of : &scope->element_of;
        int64_t kept = set->resolved;
        for (int64_t i = set->resolved; i < set->n; i++) {
            const int64_t index = label_map_find(map, set->member[i]);
            if (index >= 0) set->member[kept++] = (int32_t)index;
        }
        set->n = set->resolved = kept;
    }
}

/* Adds the corners and middle nodes of element k to set number `set`: calls add(d, set, node) for each of them. d:
 * input file, with the mesh d->m; k: index of the element in d->m->element, or < 0, for which nothing is added. node:
 * index of the node in the mesh, or its label in the file while the part (Abaqus keyword *PART) that contains the
 * element is still being read. */
static void nodes_of_element_add(struct abaqus_input_deck *d, int set, int64_t k,
                                 void (*add)(struct abaqus_input_deck *, int, int64_t))
{
    const struct element *e = k < 0 ? NULL : &d->m->element[k];
    for (int c = 0; e && c < element_corners[e->kind]; c++) add(d, set, e->node[c]);
    for (int c = 0; e && e->middle >= 0 && c < element_middles[e->kind]; c++)
        if (d->m->middle[e->middle + c] >= 0) add(d, set, d->m->middle[e->middle + c]);
}

/* Appends `label` to set number `set` of deck d. */
static void label_append(struct abaqus_input_deck *d, int set, int64_t label)
{
    element_mesh_add_to_set(d->m, set, label);
}

/* Adds the nodes of the elements that are in the element set called `name` so far to set number `set` of the input file
 * d, for *NSET with the parameter ELSET. part: part of the instance that the keyword names; NULL: none. Returns REFUSED
 * if there is no such set, or if there are too many members. */
static status set_join_nodes_of(struct abaqus_input_deck *d, int set, const struct abaqus_label_scope *part,
                                const char *name)
{
    const int64_t first = d->scope[d->now].element;
    const int other = set_index(d, part, name, false);
    struct label_map of;
    if (other < 0)
        return geometry_file_report_fault(
            d->s, "no element set %.40s is defined before this line; define it earlier in the file", name);
    TRY(generated_add(d, (ELEMENT_CORNERS_MAX + ELEMENT_MIDDLES_MAX) * d->m->set[other].n));
    label_map_make(&of, d->m->element_label + first, first, d->m->elements - first);
    for (int64_t k = 0; k < d->m->set[other].n; k++) {
        const int64_t member = d->m->set[other].member[k];
        if (k < d->m->set[other].resolved)
            nodes_of_element_add(d, set, member, set_add_index);
        else
            nodes_of_element_add(d, set, label_map_find(&of, member), label_append);
    }
    label_map_free(&of);
    return OK;
}

status abaqus_read_set(struct abaqus_input_deck *d, bool of_nodes)
{
    int set;
    const char *instance = abaqus_keyword_parameter_value(&d->key, "INSTANCE"),
               *elements = abaqus_keyword_parameter_value(&d->key, "ELSET");
    const bool generate = abaqus_keyword_parameter_value(&d->key, "GENERATE") != NULL;
    const int scope = instance ? abaqus_find_part_by_own_or_instance_name(d, instance, true) : -1;
    const struct abaqus_label_scope *part = scope >= 0 ? &d->scope[scope] : NULL;
    TRY(abaqus_find_or_create_set_named_by_parameter(d, of_nodes ? "NSET" : "ELSET", of_nodes, &set));
    if (set < 0) return geometry_file_report_fault(d->s, "a set has no name; give it one");
    if (instance && !part)
        return geometry_file_report_fault(d->s, "the assembly has no instance %.40s; check the spelling", instance);
    if (of_nodes && elements) TRY(set_join_nodes_of(d, set, part, elements));
    for (char field[FIELD]; abaqus_skip_blank_lines_and_test_for_data_line(d->s);
         geometry_file_skip_to_next_line(d->s)) {
        int32_t label;
        if (generate) {
            TRY(generate_line(d, set, part));
            continue;
        }
        while (abaqus_read_field(d->s, field)) {
            if (field[0] == '\0') continue;
            if (!abaqus_field_is_label(field)) {
                TRY(set_join(d, set, part, field));
                continue;
            }
            TRY(abaqus_parse_label(d->s, field, &label));
            set_add_label(d, set, part, label);
        }
    }
    return OK;
}

void abaqus_prefix_set_names_with_instance(struct abaqus_input_deck *d, const struct abaqus_label_scope *part)
{
    for (int k = part->set; k < part->set_end; k++) {
        struct element_set *set = &d->m->set[k];
        char own[FIELD];
        snprintf(own, sizeof own, "%.*s", FIELD - 1, set->name + set->own);
        set->own = name_join(set->name, part->instance, own);
    }
}
