/* Names of keys of a scene: finding one, and the nearest to a misspelt one. */
#include <string.h>

#include "scene_internal.h"

const char *key_leaf(const struct key *k)
{
    const char *dot = strrchr(k->path, '.');
    return dot ? dot + 1 : k->path;
}

bool key_in(const struct key *k, const char *group)
{
    size_t length = strlen(group);
    if (k->type == KEY_GROUP) return false;
    if (length == 0) return !strchr(k->path, '.');
    return strncmp(k->path, group, length) == 0 && k->path[length] == '.' && !strchr(k->path + length + 1, '.');
}

const struct key *key_find(const char *group, const char *leaf)
{
    for (int k = 0; k < keys_count; k++)
        if (key_in(&keys[k], group) && strcmp(key_leaf(&keys[k]), leaf) == 0) return &keys[k];
    return NULL;
}

/* Number of letters to add, drop, change or swap with their neighbour (optimal string alignment) between a and b. */
int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 48 };
    int row[3][LONGEST + 1], n = (int)strnlen(a, LONGEST), m = (int)strnlen(b, LONGEST);
    int *older = row[0], *old = row[1], *now = row[2];
    for (int j = 0; j <= m; j++) old[j] = j;
    for (int i = 1; i <= n; i++) {
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            int best = old[j - 1] + (a[i - 1] != b[j - 1]);
            if (old[j] + 1 < best) best = old[j] + 1;
            if (now[j - 1] + 1 < best) best = now[j - 1] + 1;
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && older[j - 2] + 1 < best) best = older[j - 2] + 1;
            now[j] = best;
        }
        int *spare = older;
        older = old, old = now, now = spare;
    }
    return old[m];
}

const struct key *key_nearest(const char *group, const char *leaf)
{
    const struct key *nearest = NULL;
    int least = 1000;
    for (int k = 0; k < keys_count; k++) {
        if (!key_in(&keys[k], group)) continue;
        int distance = edit_distance(key_leaf(&keys[k]), leaf);
        if (distance < least) nearest = &keys[k], least = distance;
    }
    return nearest;
}
