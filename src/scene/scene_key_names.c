/* Finds keys of a scene by name, the key nearest to a misspelt name, and a word in a list of words. */
#include <string.h>

#include "scene_internal.h"

const char *key_leaf(const struct key *k)
{
    const char *dot = strrchr(k->path, '.');
    return dot ? dot + 1 : k->path;
}

bool key_is_directly_below(const struct key *k, const char *group)
{
    size_t length = strlen(group);
    if (k->type == KEY_GROUP) return false;
    if (length == 0) return !strchr(k->path, '.');
    return strncmp(k->path, group, length) == 0 && k->path[length] == '.' && !strchr(k->path + length + 1, '.');
}

const struct key *key_find(const char *group, const char *leaf)
{
    for (int k = 0; k < keys_count; k++)
        if (key_is_directly_below(&keys[k], group) && strcmp(key_leaf(&keys[k]), leaf) == 0) return &keys[k];
    return NULL;
}

const struct key *key_find_most_similar(const char *group, const char *leaf)
{
    const struct key *nearest = NULL;
    int least = 1000;
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_directly_below(&keys[k], group)) continue;
        int distance = edit_distance(key_leaf(&keys[k]), leaf);
        if (distance < least) nearest = &keys[k], least = distance;
    }
    return nearest;
}

const struct key *key_find_in_any_group(const char *leaf, int *keys_of_name)
{
    const struct key *first = NULL;
    *keys_of_name = 0;
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type == KEY_GROUP || strcmp(key_leaf(&keys[k]), leaf) != 0) continue;
        if ((*keys_of_name)++ == 0 || !strchr(keys[k].path, '.')) first = &keys[k];
    }
    return first;
}

const char *scene_key_unit(const char *path)
{
    const char *end = strrchr(path, '.'), *leaf = end ? end + 1 : path, *any = NULL;
    const size_t group = strcspn(path, ".[");
    bool unique = true;
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type == KEY_GROUP || strcmp(key_leaf(&keys[k]), leaf) != 0) continue;
        const char *symbol = unit_rows[keys[k].unit].symbol;
        const size_t own = strcspn(keys[k].path, ".");
        /* `materials` of a path is the group `material` */
        if (own <= group && group <= own + 1 && strncmp(keys[k].path, path, own) == 0) return symbol;
        unique = unique && (!any || strcmp(any, symbol) == 0);
        any = symbol;
    }
    return any && unique ? any : "";
}

int word_index_in_list(const char *words, const char *text)
{
    size_t length = strlen(text);
    int place = 0;
    for (const char *c = words; c; place++) {
        const char *end = strchr(c, '|');
        size_t word = end ? (size_t)(end - c) : strlen(c);
        if (word == length && memcmp(c, text, length) == 0) return place;
        c = end ? end + 1 : NULL;
    }
    return -1;
}
