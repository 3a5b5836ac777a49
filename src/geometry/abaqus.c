/* Reads Abaqus .inp files: nodes, elements and sets of a flat deck, or of parts each of which has one instance in the
 * assembly. Other keywords (materials, steps, loads) are skipped; keywords that would generate nodes or elements are
 * refused. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "base/memory.h"
#include "abaqus_deck.h"
#include "abaqus_type.h"

enum { PARTS_MAX = 256, DEPTH_MAX = 10, PATH_LENGTH = 4096 };

static const char *parameter(const struct abaqus_input_deck *d, const char *name)
{
    return abaqus_keyword_parameter_value(&d->key, name);
}

/* ---- nodes and elements ---------------------------------------------------------------------------------------- */

/* Reads the data lines of *NODE in deck d, each a label and coordinates. If the keyword has the parameter NSET, the
 * nodes are added to this set. Returns REFUSED, with a message, for malformed lines and for other than Cartesian
 * coordinates. */
static status nodes_read(struct abaqus_input_deck *d)
{
    int set;
    const char *system = parameter(d, "SYSTEM");
    if (system && strcasecmp(system, "R") != 0)
        return geometry_file_report_fault(
            d->s, "coordinates of the system %.10s are not supported; use Cartesian x, y, z", system);
    TRY(abaqus_find_or_create_set_named_by_parameter(d, "NSET", true, &set));
    for (char field[FIELD]; abaqus_skip_blank_lines_and_test_for_data_line(d->s);
         geometry_file_skip_to_next_line(d->s)) {
        int32_t label;
        real X[DIM_MAX] = {0};
        abaqus_read_field(d->s, field);
        TRY(abaqus_parse_label(d->s, field, &label));
        for (int k = 0; k < DIM_MAX && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_real(d->s, field, &X[k]));
        TRY(element_mesh_add_node(d->m, d->s, X, label));
        if (set >= 0) element_mesh_add_to_set(d->m, set, label);
    }
    return OK;
}

/* Reads from deck d the node labels of an element, which may continue on further lines. Stores the labels of its
 * corners in node[] and of its middle nodes in middle[], in the order of elements.h. The interior node of elements with
 * 27 nodes is skipped. size: shape and number of nodes. Returns REFUSED if the element has another number of labels. */
static status element_nodes(struct abaqus_input_deck *d, const struct abaqus_shape *size, int32_t *node,
                            int32_t *middle)
{
    const int corners = element_corners[size->kind], edges = element_edges[size->kind].n;
    char field[FIELD];
    for (int k = 0; k < ELEMENT_MIDDLES_MAX; k++) middle[k] = 0;
    for (int k = 0; k < size->nodes;) {
        int32_t label;
        if (!abaqus_read_field(d->s, field)) {
            geometry_file_skip_to_next_line(d->s);
            if (!abaqus_skip_blank_lines_and_test_for_data_line(d->s))
                return geometry_file_report_fault(
                    d->s, "an element should have the %d nodes of its type, but lists only %d; add the missing nodes",
                    size->nodes, k);
            continue;
        }
        TRY(abaqus_parse_label(d->s, field, &label));
        int slot = k - corners;
        if (size->nodes == 27 && slot >= edges) slot = slot == edges ? -1 : slot - 1;
        if (k < corners) node[k] = label;
        if (k >= corners && slot >= 0) middle[slot] = label;
        k++;
    }
    if (!abaqus_read_field(d->s, field) || field[0] == '\0') return OK;
    return geometry_file_report_fault(
        d->s, "an element has more nodes than the %d of its type, such as %.20s; remove the surplus nodes", size->nodes,
        field);
}

/* Reads the data lines of *ELEMENT in deck d, each a label and nodes. If the keyword has the parameter ELSET, the
 * elements are added to this set. Points, lines and joints are skipped. Returns REFUSED, with a message, for unknown
 * types and malformed lines. */
static status elements_read(struct abaqus_input_deck *d)
{
    int set;
    char type[FIELD], field[FIELD];
    abaqus_copy_word_in_capitals(type, parameter(d, "TYPE") ? parameter(d, "TYPE") : "");
    const struct abaqus_shape *size;
    TRY(abaqus_find_shape_of_element_type(&size, d->s, type));
    TRY(abaqus_find_or_create_set_named_by_parameter(d, "ELSET", false, &set));
    if (!size) {
        snprintf(d->m->skipped, sizeof d->m->skipped, "%.40s", type);
        text_replace_control_characters(d->m->skipped);
        return OK;
    }
    for (; abaqus_skip_blank_lines_and_test_for_data_line(d->s); geometry_file_skip_to_next_line(d->s)) {
        int32_t label, node[ELEMENT_CORNERS_MAX], middle[ELEMENT_MIDDLES_MAX];
        abaqus_read_field(d->s, field);
        TRY(abaqus_parse_label(d->s, field, &label));
        TRY(element_nodes(d, size, node, middle));
        TRY(element_mesh_add_element(d->m, d->s, size->kind, node, label));
        if (size->nodes > element_corners[size->kind]) element_mesh_set_middle_nodes_of_last_element(d->m, middle);
        if (set >= 0) element_mesh_add_to_set(d->m, set, label);
    }
    return OK;
}

/* ---- parts ---------------------------------------------------------------------------------------------------- */

/* Replaces the node label *node of element number k of deck d by the index of the node. scope: the part to which the
 * element belongs. Returns REFUSED, with a message, if the part has no such node. */
static status node_resolve(const struct abaqus_input_deck *d, const struct abaqus_label_scope *scope, int64_t k,
                           int32_t *node)
{
    const int64_t index = label_map_find(&scope->node_of, *node);
    if (index < 0)
        return geometry_file_report_fault(
            d->s, "element %lld has node %d, but its part has no such node; define it, or correct the element",
            (long long)d->m->element_label[k], (int)*node);
    *node = (int32_t)index;
    return OK;
}

/* Ends the current part of deck d (an Abaqus input file), or the section outside parts, and replaces its node and
 * element labels by indices. A middle node with label 0 is missing; its edge is then straight. Returns REFUSED, with a
 * message, for unknown or repeated labels. */
static status scope_end(struct abaqus_input_deck *d)
{
    struct abaqus_label_scope *scope = &d->scope[d->now];
    struct element_mesh *m = d->m;
    int64_t twice;
    scope->node_end = m->nodes, scope->element_end = m->elements, scope->set_end = m->sets;
    label_map_make(&scope->node_of, m->node_label + scope->node, scope->node, m->nodes - scope->node);
    label_map_make(&scope->element_of, m->element_label + scope->element, scope->element, m->elements - scope->element);
    if (label_map_find_duplicate(&scope->node_of, &twice))
        return geometry_file_report_fault(d->s, "node %lld is given twice; remove one of the two", (long long)twice);
    if (label_map_find_duplicate(&scope->element_of, &twice))
        return geometry_file_report_fault(d->s, "element %lld is given twice; remove one of the two", (long long)twice);
    for (int64_t k = scope->element; k < m->elements; k++) {
        struct element *e = &m->element[k];
        for (int c = 0; c < element_corners[e->kind]; c++) TRY(node_resolve(d, scope, k, &e->node[c]));
        for (int c = 0; c < element_middles[e->kind] && e->middle >= 0; c++) {
            int32_t *middle = &m->middle[e->middle + c];
            if (*middle != 0)
                TRY(node_resolve(d, scope, k, middle));
            else
                *middle = -1;
        }
    }
    abaqus_replace_set_labels_by_indices(d, scope);
    return OK;
}

/* Begins a part of deck d called `name` and makes it the current one. name: "" for the section outside parts. */
static void scope_begin(struct abaqus_input_deck *d, const char *name)
{
    GROW("abaqus.parts", d->scope, d->scopes + 1);
    d->now = d->scopes++;
    struct abaqus_label_scope *scope = &d->scope[d->now];
    snprintf(scope->name, sizeof scope->name, "%s", name);
    scope->node = d->m->nodes, scope->element = d->m->elements, scope->set = d->m->sets;
}

/* Ends the current part of deck d (an Abaqus input file), or the section outside parts, and begins the next one. name:
 * name of the part that begins; NULL for the section outside parts. Returns REFUSED if the file has more than PARTS_MAX
 * parts, or if labels in the ended one are invalid. */
static status scope_change(struct abaqus_input_deck *d, const char *name)
{
    if (d->scopes >= PARTS_MAX)
        return geometry_file_report_fault(d->s, "the file has more than %d parts; join some", PARTS_MAX);
    TRY(scope_end(d));
    scope_begin(d, name ? name : "");
    return OK;
}

/* Reads an instance of deck d: up to two lines, with a displacement, then two points of an axis and an angle in
 * degrees. Moves the nodes of its part to this position, and names the sets of the part by the instance. Returns
 * REFUSED, with a message, if the part is unknown or already has an instance. */
static status instance_read(struct abaqus_input_deck *d)
{
    const char *part = parameter(d, "PART"), *name = parameter(d, "NAME");
    const int scope = part ? abaqus_find_part_by_own_or_instance_name(d, part, false) : -1;
    real shift[DIM_MAX] = {0}, turn[7] = {0};
    char field[FIELD];
    if (scope < 0)
        return geometry_file_report_fault(
            d->s, "an instance uses part %.40s, but the file has no such part; check its spelling", part ? part : "?");
    struct abaqus_label_scope *p = &d->scope[scope];
    if (p->placed)
        return geometry_file_report_fault(
            d->s, "part %.40s is in the assembly twice; give each instance a part of its own", p->name);
    if (abaqus_skip_blank_lines_and_test_for_data_line(d->s)) {
        for (int k = 0; k < 3 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_real(d->s, field, &shift[k]));
        geometry_file_skip_to_next_line(d->s);
    }
    if (abaqus_skip_blank_lines_and_test_for_data_line(d->s))
        for (int k = 0; k < 7 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_real(d->s, field, &turn[k]));
    const bool turns = turn[6] != 0 && memcmp(turn, turn + 3, 3 * sizeof *turn) != 0;
    for (int64_t k = p->node; k < p->node_end; k++) {
        for (int a = 0; a < DIM_MAX; a++) d->m->node[k][a] += shift[a];
        if (turns) element_mesh_rotate_node(d->m, k, turn, turn + 3, turn[6] * 3.14159265358979323846 / 180);
    }
    p->placed = true;
    snprintf(p->instance, sizeof p->instance, "%s", name ? name : p->name);
    abaqus_prefix_set_names_with_instance(d, p);
    return OK;
}

/* ---- the deck ------------------------------------------------------------------------------------------------- */

/* Reads all keywords of the input file d. Returns REFUSED, with a message, for invalid ones. Declared before its
 * definition because a keyword may include another file, whose keywords are read in turn. */
static status keywords_read(struct abaqus_input_deck *d);

/* Calls read(d) for the file that the parameter INPUT of the current keyword names, sought in the folder of the file
 * that names it. keywords: true if the file has keywords, as that of *INCLUDE; false if it has the data lines of the
 * current keyword. Returns REFUSED if the file cannot be read or has the other kind of lines, or if files include each
 * other without end. */
static status input_read(struct abaqus_input_deck *d, status (*read)(struct abaqus_input_deck *d), bool keywords)
{
    const char *name = parameter(d, "INPUT"), *folder = d->s->path, *slash = strrchr(folder, '/');
    struct geometry_file file, *const outer = d->s;
    char path[PATH_LENGTH], keyword[FIELD];
    snprintf(keyword, sizeof keyword, "%s", d->key.name);
    if (!name || !*name) return geometry_file_report_fault(d->s, "*%s has no file name; add INPUT=FILE", keyword);
    const int before = slash && *name != '/' ? (int)(slash - folder) + 1 : 0;
    if (snprintf(path, sizeof path, "%.*s%s", before, folder, name) >= (int)sizeof path)
        return geometry_file_report_fault(d->s, "the name of an included file is too long; shorten it");
    if (d->depth >= DEPTH_MAX)
        return geometry_file_report_fault(d->s, "more than %d files are nested by *INCLUDE; put them into one file",
                                          DEPTH_MAX);
    if (geometry_file_read_whole(&file, path) != OK)
        return geometry_file_report_fault(d->s, "*%s: %.200s", keyword, status_message());
    d->s = &file, d->depth++, d->length += file.length;
    status s = OK;
    if (keywords && abaqus_skip_blank_lines_and_test_for_data_line(&file))
        s = geometry_file_report_fault(&file, "an included file does not begin with a keyword; add one, such as *NODE");
    if (s == OK) s = read(d);
    while (s == OK && abaqus_skip_blank_lines_and_test_for_data_line(&file))
        geometry_file_skip_to_next_line(&file); /* of types that are left out */
    if (s == OK && file.at < file.length)
        s = geometry_file_report_fault(
            &file, "a keyword is among the data lines of *%.40s; only data lines are possible there", keyword);
    d->s = outer, d->depth--;
    geometry_file_close(&file);
    return s;
}

/* Reads the data lines of the current keyword of deck d, *NODE, *ELEMENT, *NSET or *ELSET. Returns REFUSED for invalid
 * data. */
static status data_read(struct abaqus_input_deck *d)
{
    const char *name = d->key.name;
    if (strcmp(name, "NODE") == 0) return nodes_read(d);
    return strcmp(name, "ELEMENT") == 0 ? elements_read(d) : abaqus_read_set(d, strcmp(name, "NSET") == 0);
}

/* Reads the data lines of the current keyword of deck d, or skips them if it has no meaning for the mesh. Returns
 * REFUSED for invalid data, and for keywords that generate nodes or elements. */
static status keyword_follow(struct abaqus_input_deck *d)
{
    static const char *const makers[] = {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
    const char *name = d->key.name;
    for (size_t k = 0; k < COUNT_OF(makers); k++)
        if (strcmp(name, makers[k]) == 0)
            return geometry_file_report_fault(
                d->s, "keyword *%s is not supported; write a deck that lists all nodes and elements in x, y, z", name);
    if (strcmp(name, "STEP") == 0) d->in_step = true;
    if (strcmp(name, "ENDSTEP") == 0) d->in_step = false;
    if (strcmp(name, "INCLUDE") == 0) /* files of steps have loads */
        return d->in_step ? OK : input_read(d, keywords_read, true);
    if (!strcmp(name, "NODE") || !strcmp(name, "ELEMENT") || !strcmp(name, "NSET") || !strcmp(name, "ELSET"))
        return parameter(d, "INPUT") ? input_read(d, data_read, false) : data_read(d);
    if (strcmp(name, "PART") == 0) return scope_change(d, parameter(d, "NAME"));
    if (strcmp(name, "ENDPART") == 0) return scope_change(d, NULL);
    if (strcmp(name, "INSTANCE") == 0) return instance_read(d);
    return OK;
}

/* Reads all keywords of the current file of deck d, with their data. Returns REFUSED, with a message, for invalid
 * ones. */
static status keywords_read(struct abaqus_input_deck *d)
{
    while (geometry_file_skip_blanks(d->s)) {
        while (abaqus_skip_blank_lines_and_test_for_data_line(d->s))
            geometry_file_skip_to_next_line(d->s); /* data lines of a skipped keyword */
        if (d->s->at >= d->s->length) break;
        geometry_file_skip_blanks(d->s);
        abaqus_read_keyword(d->s, &d->key);
        TRY(keyword_follow(d));
    }
    return OK;
}

status abaqus_read(struct element_mesh *m, struct geometry_file *file)
{
    struct abaqus_input_deck d = {.s = file, .m = m, .length = file->length};
    scope_begin(&d, "");
    status result = keywords_read(&d);
    if (result == OK) result = scope_end(&d);
    if (result == OK && m->nodes == 0)
        result = geometry_file_report_fault(
            file, "has no *NODE, so this is not a mesh in the format of Abaqus; give an Abaqus "
                  "input file with nodes and elements");
    for (int k = 0; k < d.scopes; k++) {
        label_map_free(&d.scope[k].node_of);
        label_map_free(&d.scope[k].element_of);
    }
    memory_free(d.scope);
    return result;
}
