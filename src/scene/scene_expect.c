/* Checks that a node has the kind of its key and that its keys are known, and reports missing keys, with examples. */
#include "scene_parts.h"

#include <stdio.h>
#include <string.h>

enum { EXAMPLE_LENGTH = 200 }; /* room for an example in a message [byte] */

/* Returns a text for messages on the values that key k (of input files) expects. The text is static or in the arena of
 * the reader r. */
static const char *form_text(struct reader *r, const struct key *k)
{
    switch (k->type) {
    case KEY_REAL:
        return unit_rows[k->unit].name;
    case KEY_POINT:
        return "a list of numbers";
    case KEY_REGION:
        return "a solid or a list of solids";
    case KEY_NAME:
        return "a name";
    case KEY_MATERIAL:
        return "the name of a material";
    default:
        return k->words ? allowed_words_join_for_message(r, k->words) : "a mapping of keys";
    }
}

status fault_report_missing_key(struct reader *r, const struct yaml_node *map, const struct key *k)
{
    char example[EXAMPLE_LENGTH];
    key_write_example(k, r->dim, NULL, example, sizeof example);
    const char *leaf = key_get_last_name_of_path(k);
    const int group = leaf > k->path ? (int)(leaf - k->path) - 1 : 0;       /* length of the path before the last dot */
    const bool helps = k->type != KEY_CHOICE && strcmp(example, "..") != 0; /* the words of a choice are listed */
    return fault_report_at_location(r, map->origin, map->line, map->column, "%s: missing%s%.*s; give %s%s%s", leaf,
                                    group > 0 ? " in " : "", group, k->path, form_text(r, k), helps ? ", such as " : "",
                                    helps ? example : "");
}

status check_node_kind(struct reader *r, const struct yaml_node *n, enum node_kind kind, const char *advice)
{
    const bool top = n->key && n->parent && !n->parent->key;
    const char *foreign = top ? other_program_value_get_advice(n->key, n->text) : NULL;
    if (n->kind == kind) return OK;
    return fault_report_at_node(r, n, "%s is not allowed here; %s%s%s", node_value_to_text_for_message(r, n), advice,
                                foreign ? "; " : "", foreign ? foreign : "");
}

/* Returns REFUSED, with a message and an example of a value of key k (of input files), if YAML node n is not of the
 * kind `kind`; else OK. expected: name of the kind in the message, with its article. */
static status expect_kind_of_key(struct reader *r, const struct key *k, const struct yaml_node *n, enum node_kind kind,
                                 const char *expected)
{
    char example[EXAMPLE_LENGTH], form[EXAMPLE_LENGTH + 40];
    key_write_example(k, r->dim, n->kind == NODE_MAP && n->first ? n->first->key : NULL, example, sizeof example);
    snprintf(form, sizeof form, "give %s such as %s", expected, example);
    return check_node_kind(r, n, kind, form);
}

status check_node_is_mapping(struct reader *r, const struct yaml_node *n, const char *group_path)
{
    const struct key group = {.path = group_path, .type = KEY_MAP};
    return expect_kind_of_key(r, &group, n, NODE_MAP, "a mapping");
}

status check_node_is_list(struct reader *r, const struct key *k, const struct yaml_node *n)
{
    return expect_kind_of_key(r, k, n, NODE_LIST, "a list");
}

status check_node_is_list_of_valid_length(struct reader *r, const struct key *k, const struct yaml_node *n)
{
    int least = (int)k->range.least, most = (int)k->range.most;
    TRY(check_node_is_list(r, k, n));
    if (n->n >= least && n->n <= most) return OK;
    return fault_report_at_node(r, n, "has %d items; give %d to %d", n->n, least, most);
}
