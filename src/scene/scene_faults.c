/* Composes messages about faults of an input file (scene): the location, and the key or value at fault. */
#include "scene_internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SHOWN_LONGEST = 40 }; /* longest text of a scene that a message shows in full [byte] */

const char *text_to_printable_line_for_message(struct reader *r, const char *text)
{
    size_t length = strlen(text), cut = length;
    if (cut > SHOWN_LONGEST) cut = SHOWN_LONGEST;
    while (cut < length && cut > 0 && ((unsigned char)text[cut] & 0xC0) == 0x80)
        cut--; /* keep whole UTF-8 characters */
    char *copy = arena_allocate_zeroed(r, cut + 4);
    memcpy(copy, text, cut);
    text_replace_control_characters(copy);
    if (cut < length) memcpy(copy + cut, "...", 3);
    return copy;
}

const char *node_value_to_text_for_message(struct reader *r, const struct yaml_node *n)
{
    if (n->kind == NODE_LIST) return "a list";
    if (n->kind == NODE_MAP) return "a mapping";
    return *n->text ? text_to_printable_line_for_message(r, n->text) : "no value";
}

const char *origin_file_name(const struct reader *r, int origin_index)
{
    return origin_index <= ORIGIN_INCLUDED ? r->included[ORIGIN_INCLUDED - origin_index] : r->name;
}

/* Writes the name of YAML node n for messages to name[capacity]: its key or, for an item of a list, the key of the
 * list with the index of the item, such as `velocity[1]`; "" for the whole scene. */
static void node_name(const struct yaml_node *n, char *name, size_t capacity)
{
    if (n->key) {
        snprintf(name, capacity, "%.48s", n->key);
    } else if (n->parent) {
        int place = 0;
        for (const struct yaml_node *c = n->parent->first; c != n; c = c->next) place++;
        node_name(n->parent, name, capacity);
        size_t used = strlen(name);
        snprintf(name + used, capacity - used, "[%d]", place);
    } else {
        *name = '\0';
    }
}

void location_write_text(const struct reader *r, int origin_index, int line, int column, char *text, size_t capacity)
{
    if (origin_index < 0) {
        snprintf(text, capacity, "%.300s:%d:%d", origin_file_name(r, origin_index), line, column);
        return;
    }
    snprintf(text, capacity, "-s %.100s=%.100s", r->override[origin_index].key, r->override[origin_index].value);
}

status fault_report_at_location(const struct reader *r, int origin_index, int line, int column, const char *format, ...)
{
    char what[512], place[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    location_write_text(r, origin_index, line, column, place, sizeof place);
    return status_set(REFUSED, "%s: %s", place, what);
}

void location_write_text_of_node(const struct reader *r, const struct yaml_node *node, char *text, size_t capacity)
{
    char name[100];
    node_name(node, name, sizeof name);
    location_write_text(r, node->origin, node->line, node->column, text, capacity);
    snprintf(text + strlen(text), capacity - strlen(text), ": %s%s", name, *name ? ": " : "");
}

status fault_report_at_node(const struct reader *r, const struct yaml_node *at, const char *format, ...)
{
    char what[512], place[PLACE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    location_write_text_of_node(r, at, place, sizeof place);
    return status_set(REFUSED, "%s%s", place, what);
}

status check_key_given_once(const struct reader *r, const struct yaml_node *map, const struct yaml_node *n)
{
    for (const struct yaml_node *twin = map->first; twin != n; twin = twin->next)
        if (strcmp(twin->key, n->key) == 0)
            return fault_report_at_node(r, n, "is given twice, first in line %d; remove one of the two", twin->line);
    return OK;
}

status fault_report_exclusive_keys(const struct reader *r, const struct yaml_node *one, const struct yaml_node *other)
{
    const struct yaml_node *late = one->origin > other->origin ? one : other;
    return fault_report_at_node(r, late, "is given together with %s; remove one of the two",
                                late == one ? other->key : one->key);
}

const char *allowed_words_join_for_message(struct reader *r, const char *words)
{
    int left = 1;
    for (const char *c = words; *c; c++) left += *c == '|';
    char *text = arena_allocate_zeroed(r, strlen(words) + 4 * (size_t)left + 1), *to = text;
    for (const char *c = words; *c; c++) {
        if (*c != '|') {
            *to++ = *c;
            continue;
        }
        left--;
        to = stpcpy(to, left == 1 ? " or " : ", ");
    }
    return text;
}
