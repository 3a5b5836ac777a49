/* floor 4: `-s key=value` laid over the tree before anything is read: dotted keys, items of lists by number. */
#include "scene_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes the next `key` or `[number]` off the path: *index is -1 for a key. False: malformed. */
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
    if (*c == '.' && c[1] != '\0' && c[1] != '[') c++;
    else if (*c != '\0' && *c != '[') return false;
    *path = c;
    return true;
}

static struct node *new_entry(struct reader *r, struct node *map, const char *key, size_t length, int origin)
{
    struct node *n = arena_new(r, sizeof *n);
    *n = (struct node){.kind = NODE_MAP, .line = 1, .column = 1, .origin = origin, .text = ""};
    n->key = arena_text(r, key, length);
    node_append(map, n);
    return n;
}

static status item_of(struct reader *r, struct node *list, int index, int origin, struct node **out)
{
    struct node at = {.origin = origin, .key = list->key, .parent = list->parent};
    if (list->kind != NODE_LIST) return fault(r, &at, "is no list in this scene; [%d] has no meaning", index);
    if (index >= list->n)
        return fault(r, &at, "has %d items; [%d] is behind the last (the first is [0])", list->n, index);
    struct node *n = list->first;
    while (index-- > 0) n = n->next;
    *out = n;
    return OK;
}

static status entry_of(struct reader *r, struct node *map, const char *key, size_t length, int origin,
                       struct node **out)
{
    struct node at = {.origin = origin, .key = arena_text(r, key, length)};
    bool empty = map->kind == NODE_SCALAR && *map->text == '\0';
    if (empty) map->kind = NODE_MAP;
    if (map->kind != NODE_MAP)
        return fault(r, &at, "%s holds %s, not keys; `cleave help` shows the path of every key",
                     map->key ? shown_text(r, map->key) : "the item", shown(r, map));
    *out = node_find(map, at.key);
    if (!*out) *out = new_entry(r, map, key, length, origin);
    return OK;
}

static void remove_child(struct node *parent, struct node *child)
{
    struct node *before = NULL;
    for (struct node *n = parent->first; n != child; n = n->next) before = n;
    if (before) before->next = child->next;
    else parent->first = child->next;
    if (parent->last == child) parent->last = before;
    parent->n--;
}

/* The value takes the node's place; its key stays. */
static void replace(struct node *n, const struct node *value)
{
    struct node whole = *value;
    whole.key = n->key;
    whole.parent = n->parent;
    whole.next = n->next;
    *n = whole;
    for (struct node *c = n->first; c; c = c->next) c->parent = n;
}

static status override_one(struct reader *r, struct node *root, int origin)
{
    const struct scene_override *o = &r->override[origin];
    const char *path = o->key, *key = NULL;
    size_t length = 0;
    int index;
    struct node *n = root, *value;
    TRY(tree_read(r, o->value, strlen(o->value), origin, &value));
    while (*path) {
        if (!step_of_path(&path, &key, &length, &index))
            return fault_mark(r, origin, 0, 0, "%s: not a path of keys; material.young or boundary[0].velocity is one",
                              shown_text(r, o->key));
        TRY(index >= 0 ? item_of(r, n, index, origin, &n) : entry_of(r, n, key, length, origin, &n));
    }
    if (n == root) return fault_mark(r, origin, 0, 0, "no key; material.young=70e9 is an override");
    if (value) replace(n, value);
    else if (n->origin == origin) return fault(r, n, "is not in the scene; an empty value takes a key away");
    else remove_child(n->parent, n);
    return OK;
}

status tree_override(struct reader *r, struct node *root)
{
    for (int k = 0; k < r->overrides; k++) TRY(override_one(r, root, k));
    return OK;
}

status tree_set(struct reader *r, struct node *root, const char *key, const char *value)
{
    const int n = r->overrides;
    struct scene_override *more = arena_new(r, (size_t)(n + 1) * sizeof *more);
    if (n > 0) memcpy(more, r->override, (size_t)n * sizeof *more);
    more[n].key = arena_text(r, key, strlen(key));
    more[n].value = arena_text(r, value, strlen(value));
    r->override = more;
    return override_one(r, root, r->overrides++);
}

const struct node *tree_at(const struct node *root, const char *path)
{
    char leaf[64];
    const struct node *n = root;
    while (n && *path) {
        const size_t length = strcspn(path, ".");
        snprintf(leaf, sizeof leaf, "%.*s", (int)length, path);
        n = n->kind == NODE_MAP ? node_find(n, leaf) : NULL;
        path += length + (path[length] == '.');
    }
    return n;
}
