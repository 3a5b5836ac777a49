/* Applies overrides `-s key=value` to the tree before it is read. Keys are joined by dots; items of lists are
 * addressed by index (0 or [0]) or by name. */
#include "scene_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads the next part of the path *path, `key` or `[index]`, and advances *path beyond it. *key, *length: receive the
 * key (a pointer into the path) and its length; *index: receives the index, or -1 for a key. Returns false if the path
 * is malformed. */
static bool step_of_path(const char **path, const char **key, size_t *length, int *index)
{
    const char *c = *path;
    *index = -1;
    if (*c == '[') {
        size_t digits = strspn(c + 1, "0123456789");
        if (digits == 0 || digits > 6 || c[digits + 1] != ']') return false;
        *index = atoi(c + 1);
        c += digits + 2;
    } else {
        *key = c;
        *length = strcspn(c, ".[");
        if (*length == 0) return false;
        c += *length;
    }
    if (*c == '.' && c[1] != '\0' && c[1] != '[')
        c++;
    else if (*c != '\0' && *c != '[')
        return false;
    *path = c;
    return true;
}

/* Appends an empty mapping to the mapping `map` and returns it. key, length: its key; origin: number of the override
 * (KEY=VALUE on the command line), for messages. The memory belongs to the reader r. */
static struct yaml_node *new_entry(struct reader *r, struct yaml_node *map, const char *key, size_t length, int origin)
{
    struct yaml_node *n = arena_allocate_zeroed(r, sizeof *n);
    *n = (struct yaml_node){.kind = NODE_MAP, .line = 1, .column = 1, .origin = origin, .text = ""};
    n->key = arena_copy_text(r, key, length);
    yaml_node_append(map, n);
    return n;
}

/* Returns the name by which an override (KEY=VALUE on the command line) addresses an item of a list: the value of its
 * key `name`; for a probe the `name` below its kind, else its kind. Returns NULL if the item has no name. */
static const char *item_name(const struct yaml_node *list, const struct yaml_node *item)
{
    const bool probe = list->key && strcmp(list->key, "probes") == 0;
    const struct yaml_node *name = item->kind == NODE_MAP ? yaml_node_find(item, "name") : NULL;
    if (probe && item->kind == NODE_SCALAR) return item->text;
    if (probe && item->n == 1) {
        name = item->first->kind == NODE_MAP ? yaml_node_find(item->first, "name") : NULL;
        if (!name) return item->first->key;
    }
    return name && name->kind == NODE_SCALAR ? name->text : NULL;
}

/* Sets the origin of YAML node n to override number `origin` (KEY=VALUE on the command line), so that the message of
 * the refusal that follows names this override, and returns n. The tree must not be used afterwards, since the origin
 * is wrong. */
static const struct yaml_node *blamed(struct yaml_node *n, int origin)
{
    n->origin = origin;
    return n;
}

/* Sets *out to item `index` (from 0) of a list. origin: number of the override (KEY=VALUE on the command line), for
 * messages. Returns REFUSED, with a message, if the node is no list or has fewer items. */
static status item_of(struct reader *r, struct yaml_node *list, int index, int origin, struct yaml_node **out)
{
    if (list->kind != NODE_LIST)
        return fault_report_at_node(r, blamed(list, origin),
                                    "is not a list in this scene, so [%d] cannot be used; remove it", index);
    if (index >= list->n)
        return fault_report_at_node(
            r, blamed(list, origin),
            "has %d items, so [%d] is beyond the last one; use a smaller number (the first is [0])", list->n, index);
    struct yaml_node *n = list->first;
    while (index-- > 0) n = n->next;
    *out = n;
    return OK;
}

/* Returns the names of the items of a list as part of a message, such as ` or by name (pull, hold)`; "" if no item has
 * a name. The text is in the arena of the reader r. */
static const char *names_text(struct reader *r, const struct yaml_node *list)
{
    char text[192] = "";
    size_t used = 0;
    for (const struct yaml_node *n = list->first; n && used < 100; n = n->next) {
        const char *name = item_name(list, n);
        if (!name) continue;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%.40s", used ? ", " : " or by name (",
                                 text_to_printable_line_for_message(r, name));
    }
    if (used) snprintf(text + used, sizeof text - used, "%s)", used < 100 ? "" : ", ...");
    return arena_copy_text(r, text, strlen(text));
}

/* Finds *out, the item of a list that `key` (of `length` characters) addresses: by index, by name, or by the name of
 * the list followed by the index, as in boundary0. origin: number of the override (KEY=VALUE on the command line), for
 * messages. Returns REFUSED, with the names of all items, if there is no such item. */
static status item_called(struct reader *r, struct yaml_node *list, const char *key, size_t length, int origin,
                          struct yaml_node **out)
{
    const char *called = arena_copy_text(r, key, length);
    const size_t stem = list->key && strncmp(called, list->key, strlen(list->key)) == 0 ? strlen(list->key) : 0;
    const size_t digits = strspn(called + stem, "0123456789");
    const bool number = digits > 0 && digits <= 6 && stem + digits == length;
    if (number && atoi(called + stem) < list->n) return item_of(r, list, atoi(called + stem), origin, out);
    for (struct yaml_node *n = list->first; n; n = n->next) {
        const char *name = item_name(list, n);
        if (name && strcmp(name, called) == 0) {
            *out = n;
            return OK;
        }
    }
    return fault_report_at_node(r, blamed(list, origin),
                                "has %d item%s, and %s is %s; name an item by its number (from 0)%s", list->n,
                                list->n == 1 ? "" : "s", text_to_printable_line_for_message(r, called),
                                number ? "beyond the last" : "not the name of one", names_text(r, list));
}

static bool is_key(const struct yaml_node *n, const char *key, size_t length)
{
    return strlen(n->key) == length && (length == 0 || memcmp(n->key, key, length) == 0);
}

/* Writes out the short form of a value: if the value of YAML node n is a word, turns n into a mapping with the one
 * entry `key`, whose value is `text` (NULL: an empty mapping). For example, `exact: step bar` becomes `exact: {form:
 * step bar}`. Leaves other nodes unchanged. origin: number of the override (KEY=VALUE on the command line). */
static void write_out(struct reader *r, struct yaml_node *n, const char *key, const char *text, int origin)
{
    if (n->kind != NODE_SCALAR || *n->text == '\0') return;
    n->kind = NODE_MAP, n->text = (char *)"";
    struct yaml_node *entry = new_entry(r, n, key, strlen(key), origin);
    if (text) entry->kind = NODE_SCALAR, entry->text = (char *)text;
}

/* Returns the mapping in which `key` (of `length` characters) of an item must be searched: the item itself, or for a
 * probe the mapping below its kind, so that a path can omit the kind (probes.0.at for probes.0.point.at). origin:
 * number of the override (KEY=VALUE on the command line), for messages. */
static struct yaml_node *probe_keys(struct reader *r, struct yaml_node *item, const char *key, size_t length,
                                    int origin)
{
    const struct yaml_node *list = item->parent;
    if (!list || list->kind != NODE_LIST || !list->key || strcmp(list->key, "probes") != 0) return item;
    write_out(r, item, item->text, NULL, origin);
    if (item->kind != NODE_MAP || item->n != 1 || is_key(item->first, key, length)) return item;
    if (strcmp(item->first->key, "exact") == 0) write_out(r, item->first, "form", item->first->text, origin);
    return item->first;
}

/* Finds *out, the YAML node that one part of a path addresses: if `map` is a mapping, the entry `key` (of `length`
 * characters), created if it is missing; if it is a list, the item with this index or name. origin: number of the
 * override (KEY=VALUE on the command line), for messages. Returns REFUSED, with a message, for a list without such an
 * item, and for nodes without keys. */
static status scene_override_entry_of(struct reader *r, struct yaml_node *map, const char *key, size_t length,
                                      int origin, struct yaml_node **out)
{
    struct yaml_node at = {.origin = origin, .key = arena_copy_text(r, key, length)};
    if (map->kind == NODE_LIST) return item_called(r, map, key, length, origin, out);
    map = probe_keys(r, map, key, length, origin);
    bool empty = map->kind == NODE_SCALAR && *map->text == '\0';
    if (empty) map->kind = NODE_MAP;
    if (map->kind != NODE_MAP)
        return fault_report_at_node(
            r, &at, "%s has the value %s and no keys below it; `cleave help` shows the path of every key",
            map->key ? text_to_printable_line_for_message(r, map->key) : "the item",
            node_value_to_text_for_message(r, map));
    if (strspn(at.key, "0123456789") == length) {
        at.key = map->key;
        return fault_report_at_node(r, &at, "is not a list in this scene, so %.*s cannot be used; remove it",
                                    (int)length, key);
    }
    *out = yaml_node_find(map, at.key);
    if (!*out) *out = new_entry(r, map, key, length, origin);
    return OK;
}

/* Returns true if the last part of a path addresses the position after the last item of a list, and `value` can be such
 * an item: a mapping or list, or for probes a word. key[length]: the last part of the path; index: its value if it has
 * the form [index], else -1. */
static bool is_new_item(const struct yaml_node *list, const char *key, size_t length, int index,
                        const struct yaml_node *value)
{
    char number[16];
    if (list->kind != NODE_LIST || !value) return false;
    snprintf(number, sizeof number, "%d", list->n);
    const bool next =
        index == list->n || (index < 0 && key && strlen(number) == length && !memcmp(key, number, length));
    return next && (value->kind != NODE_SCALAR || (list->key && strcmp(list->key, "probes") == 0));
}

/* Replaces the value of YAML node n (text, or entries) by the value of the node `value`. The key of n and its position
 * in the tree do not change. */
static void replace(struct yaml_node *n, const struct yaml_node *value)
{
    struct yaml_node whole = *value;
    whole.key = n->key;
    whole.parent = n->parent;
    whole.next = n->next;
    *n = whole;
    for (struct yaml_node *c = n->first; c; c = c->next) c->parent = n;
}

/* Applies override number `origin` (from 0; KEY=VALUE on the command line) to `root`, the YAML tree of the input file
 * (scene). Sets the value at its path; appends the value to a list if the path ends in the index after the last item;
 * removes the key if the value is empty. Returns REFUSED, with a message, for a malformed path, and if the key to be
 * removed is missing. */
static status override_one(struct reader *r, struct yaml_node *root, int origin)
{
    const struct scene_override *o = &r->override[origin];
    const char *path = override_key_get_current_name(r, o->key), *key = NULL;
    size_t length = 0;
    int index;
    struct yaml_node *n = root, *value;
    TRY(tree_parse_yaml(r, o->value, strlen(o->value), origin, &value));
    while (*path) {
        if (!step_of_path(&path, &key, &length, &index))
            return fault_report_at_location(
                r, origin, 0, 0, "%s: is not a path of keys; give one such as material.young or boundary.0.velocity",
                text_to_printable_line_for_message(r, o->key));
        if (*path == '\0' && is_new_item(n, key, length, index, value)) return yaml_node_append(n, value), OK;
        TRY(index >= 0 ? item_of(r, n, index, origin, &n) : scene_override_entry_of(r, n, key, length, origin, &n));
    }
    if (n == root)
        return fault_report_at_location(r, origin, 0, 0, "has no key; write for example material.young=70e9");
    if (value)
        replace(n, value);
    else if (n->origin == origin)
        return fault_report_at_node(
            r, n, "is not in the scene, so it cannot be removed (an empty value removes a key); check its spelling");
    else
        yaml_node_remove(n->parent, n);
    return OK;
}

status tree_apply_all_overrides(struct reader *r, struct yaml_node *root)
{
    for (int k = 0; k < r->overrides; k++) TRY(override_one(r, root, k));
    return OK;
}

status tree_apply_override(struct reader *r, struct yaml_node *root, const char *key, const char *value)
{
    const int n = r->overrides;
    struct scene_override *more = arena_allocate_zeroed(r, (size_t)(n + 1) * sizeof *more);
    array_copy(more, r->override, n, sizeof *more);
    more[n].key = arena_copy_text(r, key, strlen(key));
    more[n].value = arena_copy_text(r, value, strlen(value));
    r->override = more;
    return override_one(r, root, r->overrides++);
}

const struct yaml_node *tree_find_node_by_path(const struct yaml_node *root, const char *path)
{
    char leaf[64];
    const struct yaml_node *n = root;
    while (n && *path) {
        const size_t length = strcspn(path, ".");
        snprintf(leaf, sizeof leaf, "%.*s", (int)length, path);
        n = n->kind == NODE_MAP ? yaml_node_find(n, leaf) : NULL;
        path += length + (path[length] == '.');
    }
    return n;
}
