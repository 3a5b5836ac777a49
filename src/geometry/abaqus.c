/* Reads Abaqus .inp files: nodes, elements and sets of a flat deck, or of parts each of which has one instance in the
 * assembly. Other keywords (materials, steps, loads) are skipped; keywords that would generate nodes or elements are
 * refused. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "base/memory.h"
#include "abaqus_lines.h"
#include "abaqus_type.h"

/* Largest numbers: of parts; of set members that GENERATE makes per byte of the deck; of files included by each other;
 * room for the path of a file [byte]. */
enum { PARTS_MAX = 256, GENERATED_MOST = 16, DEPTH_MAX = 10, PATH_LENGTH = 4096 };

/* A range of nodes and elements whose labels are unique: one part of the deck, or all that is outside parts. */
struct scope {
    char name[FIELD], instance[FIELD];            /* name of the part; name of its instance */
    int64_t node, element, node_end, element_end; /* indices of the first and one past the last in the mesh */
    struct label_map node_of, element_of;         /* indices of labels, once the scope has ended */
    bool placed;                                  /* has an instance */
};

/* An input file (deck) of Abaqus while it is read. */
struct deck {
    struct source *s;
    struct element_mesh *m;
    struct abaqus_keyword key; /* the keyword read last */
    int scopes, now;           /* number of scopes, current scope; scope 0 is outside parts */
    struct scope *scope;
    int64_t generated; /* members added by GENERATE or from other sets */
    int64_t length;    /* of the deck with the files that it includes so far [byte] */
    int depth;         /* number of files that are being read, each included by the one before */
    bool in_step;      /* between *STEP and *END STEP, whose loads are not read */
};

static const char *parameter(const struct deck *d, const char *name) { return abaqus_parameter(&d->key, name); }

/* ---- nodes and elements ---------------------------------------------------------------------------------------- */

/* Finds or creates the set of deck d whose name is the value of the parameter `name` of the current keyword, and stores
 * its index in *set; -1 if the parameter is missing. of_nodes: true for a set of nodes, false for a set of elements.
 * Returns REFUSED, with a message, if there are too many sets. */
static status set_named(struct deck *d, const char *name, bool of_nodes, int *set)
{
    const char *given = parameter(d, name);
    *set = given ? element_mesh_find_or_create_set(d->m, given, of_nodes) : -1;
    return given && *set < 0 ? source_report_fault(d->s, "more than %d sets; remove some", ELEMENT_SETS_MAX) : OK;
}

/* Reads the data lines of *NODE in deck d, each a label and coordinates. If the keyword has the parameter NSET, the
 * nodes are added to this set. Returns REFUSED, with a message, for malformed lines and for other than Cartesian
 * coordinates. */
static status nodes_read(struct deck *d)
{
    int set;
    const char *system = parameter(d, "SYSTEM");
    if (system && strcasecmp(system, "R") != 0)
        return source_report_fault(d->s, "coordinates in the system %.10s are not supported; use Cartesian x, y, z",
                                   system);
    TRY(set_named(d, "NSET", true, &set));
    for (char field[FIELD]; abaqus_find_data_line(d->s); source_skip_to_next_line(d->s)) {
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
static status element_nodes(struct deck *d, const struct abaqus_shape *size, int32_t *node, int32_t *middle)
{
    const int corners = element_corners[size->kind], edges = element_edges[size->kind].n;
    char field[FIELD];
    for (int k = 0; k < ELEMENT_MIDDLES_MAX; k++) middle[k] = 0;
    for (int k = 0; k < size->nodes;) {
        int32_t label;
        if (!abaqus_read_field(d->s, field)) {
            source_skip_to_next_line(d->s);
            if (!abaqus_find_data_line(d->s))
                return source_report_fault(
                    d->s, "an element of a type with %d nodes lists only %d; add the missing nodes", size->nodes, k);
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
    return source_report_fault(d->s,
                               "an element of a type with %d nodes lists more, such as %.20s; remove the surplus ones",
                               size->nodes, field);
}

/* Reads the data lines of *ELEMENT in deck d, each a label and nodes. If the keyword has the parameter ELSET, the
 * elements are added to this set. Points, lines and joints are skipped. Returns REFUSED, with a message, for unknown
 * types and malformed lines. */
static status elements_read(struct deck *d)
{
    int set;
    char type[FIELD], field[FIELD];
    abaqus_plain_word(type, parameter(d, "TYPE") ? parameter(d, "TYPE") : "");
    const struct abaqus_shape *size;
    TRY(abaqus_shape_of_type(&size, d->s, type));
    TRY(set_named(d, "ELSET", false, &set));
    if (!size) {
        snprintf(d->m->skipped, sizeof d->m->skipped, "%.40s", type);
        text_replace_control_characters(d->m->skipped);
        return OK;
    }
    for (; abaqus_find_data_line(d->s); source_skip_to_next_line(d->s)) {
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

/* ---- sets ----------------------------------------------------------------------------------------------------- */

/* Reads a line of deck d after GENERATE: first label, last label and step. Adds the labels first, first + step, .. last
 * to set number `set`. Returns REFUSED, with a message, if the step is not positive, last is below first, or there are
 * too many members. */
static status generate_line(struct deck *d, int set)
{
    int32_t bound[3] = {0, 0, 1};
    char field[FIELD];
    for (int k = 0; k < 3 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_label(d->s, field, &bound[k]));
    if (bound[2] < 1 || bound[1] < bound[0])
        return source_report_fault(d->s, "a set with GENERATE lacks first, last or step; give all three");
    d->generated += (bound[1] - bound[0]) / bound[2] + 1;
    if (d->generated > GENERATED_MOST * d->length)
        return source_report_fault(d->s, "sets list more nodes or elements than the file has; it is damaged");
    for (int64_t label = bound[0]; label <= bound[1]; label += bound[2]) element_mesh_add_to_set(d->m, set, label);
    return OK;
}

/* Adds the present members of the set called `name` in deck d to the set number `set`. of_nodes: true for sets of
 * nodes, false for sets of elements. Returns REFUSED, with a message, if there are too many sets or members. */
static status set_join(struct deck *d, int set, const char *name, bool of_nodes)
{
    const int other = element_mesh_find_or_create_set(d->m, name, of_nodes);
    if (other < 0) return source_report_fault(d->s, "more than %d sets; remove some", ELEMENT_SETS_MAX);
    d->generated += d->m->set[other].n;
    if (d->generated > GENERATED_MOST * d->length)
        return source_report_fault(d->s, "sets list more nodes or elements than the file has; it is damaged");
    for (int64_t k = d->m->set[other].resolved; other != set && k < d->m->set[other].n; k++)
        element_mesh_add_to_set(d->m, set, d->m->set[other].member[k]);
    return OK;
}

/* Replaces labels by indices in the sets of the mesh of deck d: the labels added since the last call, which belong to
 * `scope`. (A scope is a part of the deck, or what is outside parts.) Removes labels that the scope does not
 * contain. */
static void sets_resolve(struct deck *d, const struct scope *scope)
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

/* Returns the index of the part of deck d called `name` or, if `instance` is true, of the part of which an instance is
 * called `name`. Returns -1 if there is none. */
static int scope_find(const struct deck *d, const char *name, bool instance)
{
    for (int k = 1; k < d->scopes; k++)
        if (strcasecmp(instance ? d->scope[k].instance : d->scope[k].name, name) == 0) return k;
    return -1;
}

/* Adds the nodes of an element of the current scope (part of the deck d), by their labels, to the set number `set`.
 * label: label of the element; of: map from labels to the elements of the scope. */
static void nodes_of_element_add(struct deck *d, int set, const struct label_map *of, int64_t label)
{
    const int64_t k = label_map_find(of, label);
    const struct element *e = k < 0 ? NULL : &d->m->element[k];
    for (int c = 0; e && c < element_corners[e->kind]; c++) element_mesh_add_to_set(d->m, set, e->node[c]);
    for (int c = 0; e && e->middle >= 0 && c < element_middles[e->kind]; c++)
        element_mesh_add_to_set(d->m, set, d->m->middle[e->middle + c]);
}

/* Adds the nodes of the elements that are in the set called `name` in deck d so far to the set number `set`, for *NSET
 * with the parameter ELSET. Returns REFUSED if there are too many sets or members. */
static status set_join_nodes_of(struct deck *d, int set, const char *name)
{
    const int64_t first = d->scope[d->now].element;
    const int other = element_mesh_find_or_create_set(d->m, name, false);
    struct label_map of;
    if (other < 0) return source_report_fault(d->s, "more than %d sets; remove some", ELEMENT_SETS_MAX);
    d->generated += (ELEMENT_CORNERS_MAX + ELEMENT_MIDDLES_MAX) * d->m->set[other].n;
    if (d->generated > GENERATED_MOST * d->length)
        return source_report_fault(d->s,
                                   "sets list more nodes or elements than the file has; it is damaged or incomplete");
    label_map_make(&of, d->m->element_label + first, first, d->m->elements - first);
    for (int64_t k = d->m->set[other].resolved; k < d->m->set[other].n; k++)
        nodes_of_element_add(d, set, &of, d->m->set[other].member[k]);
    label_map_free(&of);
    return OK;
}

/* Reads the set of *NSET or *ELSET in deck d: labels, names of other sets, or ranges. of_nodes: true for *NSET. Returns
 * REFUSED, with a message, for malformed lines, a set without name or an unknown instance. */
static status set_read(struct deck *d, bool of_nodes)
{
    int set;
    const char *instance = parameter(d, "INSTANCE"), *elements = parameter(d, "ELSET");
    const bool generate = parameter(d, "GENERATE") != NULL;
    TRY(set_named(d, of_nodes ? "NSET" : "ELSET", of_nodes, &set));
    if (set < 0) return source_report_fault(d->s, "a set has no name; give it one");
    if (of_nodes && elements) TRY(set_join_nodes_of(d, set, elements));
    for (char field[FIELD]; abaqus_find_data_line(d->s); source_skip_to_next_line(d->s)) {
        int32_t label;
        if (generate) {
            TRY(generate_line(d, set));
            continue;
        }
        while (abaqus_read_field(d->s, field)) {
            if (field[0] == '\0') continue;
            if (!abaqus_is_label(field)) {
                TRY(set_join(d, set, field, of_nodes));
                continue;
            }
            TRY(abaqus_parse_label(d->s, field, &label));
            element_mesh_add_to_set(d->m, set, label);
        }
    }
    if (!instance) return OK;
    const int scope = scope_find(d, instance, true);
    if (scope < 0) return source_report_fault(d->s, "there is no instance %.40s; check its spelling", instance);
    sets_resolve(d, &d->scope[scope]);
    return OK;
}

/* ---- parts ---------------------------------------------------------------------------------------------------- */

/* Replaces the node label *node of element number k of deck d by the index of the node. scope: the part to which the
 * element belongs. Returns REFUSED, with a message, if the part has no such node. */
static status node_resolve(const struct deck *d, const struct scope *scope, int64_t k, int32_t *node)
{
    const int64_t index = label_map_find(&scope->node_of, *node);
    if (index < 0)
        return source_report_fault(
            d->s, "element %lld has node %d, but its part has no such node; define it, or correct the element",
            (long long)d->m->element_label[k], (int)*node);
    *node = (int32_t)index;
    return OK;
}

/* Ends the current part of deck d, or what is outside parts, and replaces its labels by indices. A middle node with
 * label 0 is missing; its edge is then straight. Returns REFUSED, with a message, for unknown or repeated labels. */
static status scope_end(struct deck *d)
{
    struct scope *scope = &d->scope[d->now];
    struct element_mesh *m = d->m;
    int64_t twice;
    scope->node_end = m->nodes, scope->element_end = m->elements;
    label_map_make(&scope->node_of, m->node_label + scope->node, scope->node, m->nodes - scope->node);
    label_map_make(&scope->element_of, m->element_label + scope->element, scope->element, m->elements - scope->element);
    if (label_map_find_duplicate(&scope->node_of, &twice))
        return source_report_fault(d->s, "node %lld is given twice; remove one of the two", (long long)twice);
    if (label_map_find_duplicate(&scope->element_of, &twice))
        return source_report_fault(d->s, "element %lld is given twice; remove one of the two", (long long)twice);
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
    sets_resolve(d, scope);
    return OK;
}

/* Begins a part of deck d called `name` and makes it the current one. name: "" for what is outside parts. */
static void scope_begin(struct deck *d, const char *name)
{
    GROW("abaqus.parts", d->scope, d->scopes + 1);
    d->now = d->scopes++;
    struct scope *scope = &d->scope[d->now];
    snprintf(scope->name, sizeof scope->name, "%s", name);
    scope->node = d->m->nodes, scope->element = d->m->elements;
}

/* Ends the current part of deck d, or what is outside parts, and begins the next. name: name of the part that begins;
 * NULL for what is outside parts. Returns REFUSED if there are too many parts, or if labels in the ended one are
 * invalid. */
static status scope_change(struct deck *d, const char *name)
{
    if (d->scopes >= PARTS_MAX) return source_report_fault(d->s, "more than %d parts; join some", PARTS_MAX);
    TRY(scope_end(d));
    scope_begin(d, name ? name : "");
    return OK;
}

/* Reads an instance of deck d: up to two lines, with a displacement, then two points of an axis and an angle in
 * degrees. Moves the nodes of its part to this position. Returns REFUSED, with a message, if the part is unknown or
 * already has an instance. */
static status instance_read(struct deck *d)
{
    const char *part = parameter(d, "PART"), *name = parameter(d, "NAME");
    const int scope = part ? scope_find(d, part, false) : -1;
    real shift[DIM_MAX] = {0}, turn[7] = {0};
    char field[FIELD];
    if (scope < 0)
        return source_report_fault(
            d->s, "an instance uses part %.40s, but the file has no such part; check its spelling", part ? part : "?");
    struct scope *p = &d->scope[scope];
    if (p->placed)
        return source_report_fault(d->s, "part %.40s is in the assembly twice; give each instance a part of its own",
                                   p->name);
    if (abaqus_find_data_line(d->s)) {
        for (int k = 0; k < 3 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_real(d->s, field, &shift[k]));
        source_skip_to_next_line(d->s);
    }
    if (abaqus_find_data_line(d->s))
        for (int k = 0; k < 7 && abaqus_read_field(d->s, field); k++) TRY(abaqus_parse_real(d->s, field, &turn[k]));
    const bool turns = turn[6] != 0 && memcmp(turn, turn + 3, 3 * sizeof *turn) != 0;
    for (int64_t k = p->node; k < p->node_end; k++) {
        for (int a = 0; a < DIM_MAX; a++) d->m->node[k][a] += shift[a];
        if (turns) element_mesh_rotate_node(d->m, k, turn, turn + 3, turn[6] * 3.14159265358979323846 / 180);
    }
    p->placed = true;
    if (name) snprintf(p->instance, sizeof p->instance, "%s", name);
    return OK;
}

/* ---- the deck ------------------------------------------------------------------------------------------------- */

/* Declared here because keywords include files, whose keywords it reads in turn. */
static status keywords_read(struct deck *d);

/* Calls read(d) for the file that the parameter INPUT of the current keyword names, sought in the folder of the file
 * that names it. keywords: true if the file has keywords, as that of *INCLUDE; false if it has the data lines of the
 * current keyword. Returns REFUSED if the file cannot be read or has the other kind of lines, or if files include each
 * other without end. */
static status input_read(struct deck *d, status (*read)(struct deck *d), bool keywords)
{
    const char *name = parameter(d, "INPUT"), *folder = d->s->path, *slash = strrchr(folder, '/');
    struct source file, *const outer = d->s;
    char path[PATH_LENGTH], keyword[FIELD];
    snprintf(keyword, sizeof keyword, "%s", d->key.name);
    if (!name || !*name) return source_report_fault(d->s, "*%s has no INPUT=FILE; add it", keyword);
    const int before = slash && *name != '/' ? (int)(slash - folder) + 1 : 0;
    if (snprintf(path, sizeof path, "%.*s%s", before, folder, name) >= (int)sizeof path)
        return source_report_fault(d->s, "the name of an included file is too long; shorten it");
    if (d->depth >= DEPTH_MAX)
        return source_report_fault(d->s, "more than %d files include each other; put them into one file", DEPTH_MAX);
    if (source_read_whole_file(&file, path) != OK)
        return source_report_fault(d->s, "*%s: %.200s", keyword, status_message());
    d->s = &file, d->depth++, d->length += file.length;
    status s = OK;
    if (keywords && abaqus_find_data_line(&file))
        s = source_report_fault(&file, "an included file does not begin with a keyword; add one, such as *NODE");
    if (s == OK) s = read(d);
    while (s == OK && abaqus_find_data_line(&file)) source_skip_to_next_line(&file); /* of types that are left out */
    if (s == OK && file.at < file.length)
        s = source_report_fault(
            &file, "a keyword is among the data lines of *%.40s; only data lines are possible there", keyword);
    d->s = outer, d->depth--;
    source_close(&file);
    return s;
}

/* Reads the data lines of the current keyword of deck d, *NODE, *ELEMENT, *NSET or *ELSET. Returns REFUSED for invalid
 * data. */
static status data_read(struct deck *d)
{
    const char *name = d->key.name;
    if (strcmp(name, "NODE") == 0) return nodes_read(d);
    return strcmp(name, "ELEMENT") == 0 ? elements_read(d) : set_read(d, strcmp(name, "NSET") == 0);
}

/* Reads the data lines of the current keyword of deck d, or skips them if it has no meaning for the mesh. Returns
 * REFUSED for invalid data, and for keywords that generate nodes or elements. */
static status keyword_follow(struct deck *d)
{
    static const char *const makers[] = {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
    const char *name = d->key.name;
    for (size_t k = 0; k < COUNT_OF(makers); k++)
        if (strcmp(name, makers[k]) == 0)
            return source_report_fault(
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
static status keywords_read(struct deck *d)
{
    while (source_skip_blanks(d->s)) {
        while (abaqus_find_data_line(d->s)) source_skip_to_next_line(d->s); /* data lines of a skipped keyword */
        if (d->s->at >= d->s->length) break;
        source_skip_blanks(d->s);
        abaqus_read_keyword(d->s, &d->key);
        TRY(keyword_follow(d));
    }
    return OK;
}

status abaqus_read(struct element_mesh *m, struct source *s)
{
    struct deck d = {.s = s, .m = m, .length = s->length};
    scope_begin(&d, "");
    status result = keywords_read(&d);
    if (result == OK) result = scope_end(&d);
    if (result == OK && m->nodes == 0)
        result = source_report_fault(
            s, "has no *NODE, so this is not a mesh in the format of Abaqus; give one, or a file of another kind");
    for (int k = 0; k < d.scopes; k++) {
        label_map_free(&d.scope[k].node_of);
        label_map_free(&d.scope[k].element_of);
    }
    memory_free(d.scope);
    return result;
}
