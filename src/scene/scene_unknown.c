/* Finds the unknown keys of a scene and reports them together. */
#include "scene_internal.h"

#include <stdio.h>
#include <string.h>

/* Returns the path of the group of keys in the mapping that is the value of key k (of input files), or in each mapping
 * of the list. Returns NULL if the value is no such mapping, or a mapping of names. */
static const char *group_of_values(const struct key *k)
{
    const char *words = k->words ? k->words : "", *group = key_get_group_path_of_list_items(k);
    if (k->type == KEY_REGION || (k->type == KEY_HAND && strncmp(words, "solid", 5) == 0)) return "solid";
    for (int i = 0; i < keys_count; i++)
        if (key_is_directly_below(&keys[i], group)) return group;
    return NULL;
}

/* Returns the entry beside YAML node n, in the same mapping with keys of `group`, below which the key of n is valid:
 * for a misplaced `at` in {at: [..], point: {}} the entry `point`. Returns NULL if there is no such entry. */
static const struct yaml_node *owner_beside(const struct yaml_node *n, const char *group)
{
    for (const struct yaml_node *c = n->parent ? n->parent->first : NULL; c; c = c->next) {
        const struct key *k = c->key ? key_find(group, c->key) : NULL;
        const char *inner = k ? group_of_values(k) : NULL;
        if (inner && key_find(inner, n->key)) return c;
    }
    return NULL;
}

/* Returns the key of the list whose entries node n names in a mapping, such as `materials` in materials: {glass:
 * {young: 1 GPa}}, where a list of entries with a key `name` is meant; NULL if n is not such an entry. */
static const char *list_of_named_entries(const struct yaml_node *n)
{
    const struct yaml_node *list = n->parent;
    const struct key *k = list && list->key && list->kind == NODE_MAP ? key_find("", list->key) : NULL;
    const char *group = k && k->type == KEY_LIST && n->kind == NODE_MAP ? group_of_values(k) : NULL;
    return group && key_find(group, "name") ? list->key : NULL;
}

/* Writes the reason why YAML node n, which is no key of the group `group`, is refused to text[capacity], with the key
 * that is probably meant if there is a similar one. */
static void describe_unknown_key(const struct yaml_node *n, const char *group, char *text, size_t capacity)
{
    char instead[400];
    const struct key *nearest = key_find_most_similar(group, n->key);
    const char *leaf = nearest ? key_get_last_name_of_path(nearest) : "";
    int others;
    const struct key *other = key_find_in_any_group(n->key, &others);
    const struct yaml_node *owner = owner_beside(n, group);
    const char *list = list_of_named_entries(n);
    if (list)
        snprintf(text, capacity, "unknown key; names of entries stand inside a list: %s: [{name: %s, ..}]", list,
                 n->key);
    else if (other_program_keyword_write_advice(n->key, group, instead, sizeof instead))
        snprintf(text, capacity, "unknown key; %s", instead);
    else if (nearest && word_is_probable_misspelling_of(leaf, n->key))
        snprintf(text, capacity, "unknown key; did you mean %s?", leaf);
    else if (owner && others > 1)
        snprintf(text, capacity, "this key belongs inside %s; write %s: {%s: ..}", owner->key, owner->key, n->key);
    else if (other && !strchr(other->path, '.'))
        snprintf(text, capacity, "this key does not belong here; put %s at the left margin", n->key);
    else if (others == 1)
        snprintf(text, capacity, "this key does not belong here; use the key %s", other->path);
    else if (others > 1)
        snprintf(text, capacity, "this key does not belong here; `cleave help %s` lists the %d keys of that name",
                 n->key, others);
    else
        snprintf(text, capacity, "unknown key; `cleave help%s%s` lists the known ones", *group ? " " : "", group);
}

status check_mapping_keys_known_and_unique(struct reader *r, const struct yaml_node *mapping, const char *group_path)
{
    char text[500];
    for (const struct yaml_node *n = mapping->first; n; n = n->next) {
        if (!key_find(group_path, n->key)) {
            describe_unknown_key(n, group_path, text, sizeof text);
            return fault_report_at_node(r, n, "%s", text);
        }
        TRY(check_key_given_once(r, mapping, n));
    }
    return OK;
}

/* ---- all of a scene ---------------------------------------------------------------------------------------------- */

enum { SHOWN_MOST = 10 }; /* lines of unknown keys in one message */

/* Sets the message about the unknown key at node n, or adds it as a line to the message about earlier unknown keys.
 * group: path of the key's group; *found: number of unknown keys so far, which increases by one. */
static void report_unknown_key(const struct reader *r, const struct yaml_node *n, const char *group, int *found)
{
    char place[PLACE_LENGTH], text[500];
    if ((*found)++ >= SHOWN_MOST) return;
    describe_unknown_key(n, group, text, sizeof text);
    location_write_text_of_node(r, n, place, sizeof place);
    if (*found == 1)
        status_set(REFUSED, "%s%s", place, text);
    else
        status_message_append_line("%s%s", place, text);
}

/* Reports the unknown keys of `node`, a mapping or a list of mappings with keys of `group`, and of all nodes below it.
 * *found: number of unknown keys so far, which increases. Other nodes are left to the functions that read them. */
static void report_unknown_keys(const struct reader *r, const struct yaml_node *node, const char *group, int *found)
{
    for (const struct yaml_node *n = node->first; n; n = n->next) {
        if (node->kind == NODE_LIST) {
            report_unknown_keys(r, n, group, found);
            continue;
        }
        const struct key *k = key_find(group, n->key);
        const char *inner = k ? group_of_values(k) : NULL;
        if (!k) report_unknown_key(r, n, group, found);
        const bool one = k && (k->type == KEY_MAP || k->type == KEY_PART); /* a list of these is refused later */
        if (inner && !(one && n->kind == NODE_LIST)) report_unknown_keys(r, n, inner, found);
    }
}

status check_all_keys_known(const struct reader *r, const struct yaml_node *root)
{
    int found = 0;
    report_unknown_keys(r, root, "", &found);
    if (found > SHOWN_MOST) status_message_append_line("%s: and %d more unknown keys", r->name, found - SHOWN_MOST);
    return found > 0 ? REFUSED : OK;
}
