/* Finds keys of a scene by name, the key nearest to a misspelt name, and a word in a list of words. */
#include <string.h>

#include "scene_internal.h"

const char *key_get_last_name_of_path(const struct key *k)
{
    const char *dot = strrchr(k->path, '.');
    return dot ? dot + 1 : k->path;
}

bool key_is_directly_below(const struct key *k, const char *group_path)
{
    size_t length = strlen(group_path);
    if (k->type == KEY_GROUP) return false;
    if (length == 0) return !strchr(k->path, '.');
    return strncmp(k->path, group_path, length) == 0 && k->path[length] == '.' && !strchr(k->path + length + 1, '.');
}

const char *key_get_group_path_of_list_items(const struct key *k)
{
    if (strcmp(k->path, "materials") == 0) return "material";
    return strcmp(k->path, "parts") == 0 ? "bodies.parts" : k->path;
}

const struct key *key_find(const char *group_path, const char *name_in_group)
{
    for (int k = 0; k < keys_count; k++)
        if (key_is_directly_below(&keys[k], group_path) &&
            strcmp(key_get_last_name_of_path(&keys[k]), name_in_group) == 0)
            return &keys[k];
    return NULL;
}

const struct key *key_find_most_similar(const char *group_path, const char *name_in_group)
{
    const struct key *nearest = NULL;
    int least = 1000;
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_directly_below(&keys[k], group_path)) continue;
        int distance = edit_distance(key_get_last_name_of_path(&keys[k]), name_in_group);
        if (distance < least) nearest = &keys[k], least = distance;
    }
    return nearest;
}

const struct key *key_find_in_any_group(const char *key_name, int *matching_key_count)
{
    const struct key *first = NULL;
    *matching_key_count = 0;
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type == KEY_GROUP || strcmp(key_get_last_name_of_path(&keys[k]), key_name) != 0) continue;
        if ((*matching_key_count)++ == 0 || !strchr(keys[k].path, '.')) first = &keys[k];
    }
    return first;
}

const char *scene_key_unit(const char *path)
{
    const char *end = strrchr(path, '.'), *leaf = end ? end + 1 : path, *any = NULL;
    const size_t group = strcspn(path, ".[");
    bool unique = true;
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type == KEY_GROUP || strcmp(key_get_last_name_of_path(&keys[k]), leaf) != 0) continue;
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
