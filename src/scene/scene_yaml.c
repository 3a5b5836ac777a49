/* Builds the tree of nodes, with line and column, from the events of libyaml. YAML features that a scene may not use
 * are refused. */
#include "scene_internal.h"

#include <string.h>
#include <yaml.h>

#include "base/memory.h"

enum { DEPTH_MOST = 16, EVENTS_MOST = 1000000 }; /* largest depth of nested values; number of events of libyaml */

/* ---- events ------------------------------------------------------------------------------------------------------ */

/* State of the parsing of text[length] by libyaml. origin: as in struct yaml_node; events: number of events so far. */
struct parse {
    struct reader *r;
    yaml_parser_t yaml;
    const char *text;
    size_t length;
    int origin, events;
};

static status fault_at(struct parse *p, yaml_mark_t mark, const char *what)
{
    return fault_report_at_location(p->r, p->origin, (int)mark.line + 1, (int)mark.column + 1, "%s", what);
}

/* Returns line and column, both from 0, of the byte at `offset` in the text of p. For faults of the encoding libyaml
 * gives only the offset. */
static yaml_mark_t mark_of_offset(const struct parse *p, size_t offset)
{
    yaml_mark_t mark = {0};
    for (size_t k = 0; k < offset && k < p->length; k++) {
        bool newline = p->text[k] == '\n', inside = ((unsigned char)p->text[k] & 0xC0) == 0x80;
        mark.line += newline;
        mark.column = newline ? 0 : mark.column + !inside;
    }
    return mark;
}

static status yaml_fault(struct parse *p)
{
    const yaml_parser_t *yaml = &p->yaml;
    if (yaml->error == YAML_MEMORY_ERROR)
        return status_set(FAILED, "%s: out of memory while the scene is read; free memory and try again", p->r->name);
    yaml_mark_t mark = yaml->error == YAML_READER_ERROR ? mark_of_offset(p, yaml->problem_offset) : yaml->problem_mark;
    return fault_report_at_location(
        p->r, p->origin, (int)mark.line + 1, (int)mark.column + 1,
        "not YAML: %s; indent by spaces (not tabs), write `: ` after each key, and close all brackets",
        yaml->problem ? yaml->problem : "it cannot be read");
}

static status next_event(struct parse *p, yaml_event_t *event)
{
    if (!yaml_parser_parse(&p->yaml, event)) return yaml_fault(p);
    if (++p->events <= EVENTS_MOST) return OK;
    yaml_mark_t mark = event->start_mark;
    yaml_event_delete(event);
    return fault_at(p, mark, "the scene has more than 1000000 YAML items; put long data into a particle list");
}

/* Returns a message if the event e of libyaml is not allowed in an input file (scene): an alias, anchor or tag, a NUL
 * character, or nesting of more than DEPTH_MOST levels. Returns NULL if it is allowed. depth: levels of nesting. */
static const char *event_refusal(const yaml_event_t *e, int depth)
{
    const yaml_char_t *anchor = NULL, *tag = NULL;
    if (e->type == YAML_ALIAS_EVENT) return "an alias (*) is not allowed in a scene; write the value out";
    if (e->type == YAML_SCALAR_EVENT) {
        anchor = e->data.scalar.anchor, tag = e->data.scalar.tag;
        if (memchr(e->data.scalar.value, 0, e->data.scalar.length)) return "contains a NUL character; remove it";
    }
    if (e->type == YAML_SEQUENCE_START_EVENT) anchor = e->data.sequence_start.anchor, tag = e->data.sequence_start.tag;
    if (e->type == YAML_MAPPING_START_EVENT) anchor = e->data.mapping_start.anchor, tag = e->data.mapping_start.tag;
    if (anchor) return "an anchor (&) is not allowed in a scene; write the value out where it is used";
    if (tag) return "a tag (!) is not allowed in a scene, whose keys determine the types of values; remove it";
    if (depth > DEPTH_MOST) return "is nested deeper than 16 levels, more than any key of a scene; remove some levels";
    return NULL;
}

static const char *key_refusal(const yaml_event_t *e)
{
    if (e->type == YAML_SEQUENCE_START_EVENT || e->type == YAML_MAPPING_START_EVENT)
        return "has a list or mapping as a key; write a single word";
    if (e->type == YAML_SCALAR_EVENT && strcmp((char *)e->data.scalar.value, "<<") == 0)
        return "merge keys (<<) are not allowed in a scene; write the keys out";
    return NULL;
}

static struct yaml_node *node_new(struct parse *p, const yaml_event_t *e, enum node_kind kind)
{
    struct yaml_node *n = arena_allocate_zeroed(p->r, sizeof *n);
    *n = (struct yaml_node){.kind = kind,
                            .line = (int)e->start_mark.line + 1,
                            .column = (int)e->start_mark.column + 1,
                            .origin = p->origin,
                            .text = ""};
    return n;
}

static status read_value(struct parse *p, yaml_event_t *event, int depth, struct yaml_node **out);

static status read_items(struct parse *p, struct yaml_node *list, int depth)
{
    yaml_event_t event;
    for (;;) {
        struct yaml_node *child;
        TRY(next_event(p, &event));
        bool end = event.type == YAML_SEQUENCE_END_EVENT;
        if (end) yaml_event_delete(&event);
        if (end) return OK;
        TRY(read_value(p, &event, depth + 1, &child));
        yaml_node_append(list, child);
    }
}

/* Reads a key and its value from the parser p, and appends the entry to `map`; line and column of the entry are those
 * of the key. key_event: event of the key, already read, which is deleted; depth: levels of nesting above the mapping.
 * Returns REFUSED, with a message, for invalid YAML. */
static status read_entry(struct parse *p, struct yaml_node *map, yaml_event_t *key_event, int depth)
{
    yaml_event_t event;
    struct yaml_node *key, *child;
    const char *refusal = key_refusal(key_event);
    if (refusal) {
        status s = fault_at(p, key_event->start_mark, refusal);
        yaml_event_delete(key_event);
        return s;
    }
    TRY(read_value(p, key_event, depth, &key));
    TRY(next_event(p, &event));
    TRY(read_value(p, &event, depth + 1, &child));
    child->key = key->text;
    child->line = key->line;
    child->column = key->column;
    yaml_node_append(map, child);
    return OK;
}

static status read_entries(struct parse *p, struct yaml_node *map, int depth)
{
    yaml_event_t event;
    for (;;) {
        TRY(next_event(p, &event));
        bool end = event.type == YAML_MAPPING_END_EVENT;
        if (end) yaml_event_delete(&event);
        if (end) return OK;
        TRY(read_entry(p, map, &event, depth));
    }
}

/* Reads from the parser p the node that begins with `event` into *out, and deletes the event. depth: levels of nesting
 * above the node. Returns REFUSED, with a message, for invalid YAML and for YAML that a scene may not contain. */
static status read_value(struct parse *p, yaml_event_t *event, int depth, struct yaml_node **out)
{
    const char *refusal = event_refusal(event, depth);
    if (refusal) {
        status s = fault_at(p, event->start_mark, refusal);
        yaml_event_delete(event);
        return s;
    }
    yaml_event_type_t type = event->type;
    struct yaml_node *n = node_new(p, event,
                                   type == YAML_SCALAR_EVENT           ? NODE_SCALAR
                                   : type == YAML_SEQUENCE_START_EVENT ? NODE_LIST
                                                                       : NODE_MAP);
    if (type == YAML_SCALAR_EVENT)
        n->text = arena_copy_text(p->r, (char *)event->data.scalar.value, event->data.scalar.length);
    yaml_event_delete(event);
    *out = n;
    if (type == YAML_SEQUENCE_START_EVENT) return read_items(p, n, depth);
    if (type == YAML_MAPPING_START_EVENT) return read_entries(p, n, depth);
    return OK;
}

/* Skips one event of the parser p that begins or ends the stream or a document, and stores its type in *type. Returns
 * REFUSED, with a message, if a second document begins. */
static status skip_event(struct parse *p, yaml_event_type_t *type)
{
    yaml_event_t event;
    TRY(next_event(p, &event));
    *type = event.type;
    yaml_mark_t mark = event.start_mark;
    yaml_event_delete(&event);
    return *type == YAML_DOCUMENT_START_EVENT && p->events > 2
               ? fault_at(p, mark, "a second document (---) begins; put each scene into a file of its own")
               : OK;
}

/* Reads the only document of p->text into the tree *root, NULL if the text is empty. Returns REFUSED, with a message,
 * for invalid YAML and for a second document. */
static status read_document(struct parse *p, struct yaml_node **root)
{
    yaml_event_t event;
    yaml_event_type_t type;
    *root = NULL;
    TRY(skip_event(p, &type));
    TRY(skip_event(p, &type));
    if (type == YAML_STREAM_END_EVENT) return OK;
    TRY(next_event(p, &event));
    TRY(read_value(p, &event, 1, root));
    while (type != YAML_STREAM_END_EVENT) TRY(skip_event(p, &type));
    return OK;
}

status tree_parse_yaml(struct reader *r, const char *text, size_t length, int origin_index, struct yaml_node **root)
{
    struct parse p = {.r = r, .text = text, .length = length, .origin = origin_index};
    const char *nul = memchr(text, 0, length);
    if (nul)
        return fault_at(&p, mark_of_offset(&p, (size_t)(nul - text)),
                        "contains a NUL byte, but a scene is UTF-8 text; remove it");
    if (!yaml_parser_initialize(&p.yaml))
        return status_set(FAILED, "%s: out of memory while the scene is read; free memory and try again", r->name);
    yaml_parser_set_input_string(&p.yaml, (const unsigned char *)text, length);
    status s = read_document(&p, root);
    yaml_parser_delete(&p.yaml);
    return s;
}
