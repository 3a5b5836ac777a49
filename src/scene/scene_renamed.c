/* Replaces names of keys from earlier versions by the present names, records them in the scene for a warning, and
 * refuses removed keys. */
#include "scene_internal.h"

#include <stdio.h>
#include <string.h>

/* Renamed keys: path in earlier versions and present path; they differ in the last key only. */
static const struct {
    const char *old, *now;
} renamed[] = {
    {"rim_damping", "interface_damping"},
    {"conversion.return", "conversion.reversion"},
    {"conversion.dwell", "conversion.hold_time"},
    {"conversion.return_stress", "conversion.low_stress"},
    {"time.rest", "time.active_set"},
};

/* Keys of earlier versions that no longer exist, with their replacement. */
#define TABLE_REMOVED "is no longer a key; remove it (`method: auto` always chooses by pilot runs)"
static const struct {
    const char *path, *what;
} removed[] = {
    {"accuracy_table", TABLE_REMOVED},
    {"accuracy_chart", TABLE_REMOVED},
};

/* Appends the old and the new name of row k of the table `renamed` to s->renamed, a text that is printed later as a
 * warning. Does nothing if s->renamed has them already. */
static void renamed_note(struct scene *s, int k)
{
    const size_t used = strlen(s->renamed);
    char pair[80];
    snprintf(pair, sizeof pair, "%s has been renamed to %s", renamed[k].old, renamed[k].now);
    if (strstr(s->renamed, pair)) return;
    snprintf(s->renamed + used, sizeof s->renamed - used, "%s%s", used ? ", " : "", pair);
}

const char *former_key_get_current_name(const char *former_path)
{
    for (int k = 0; k < (int)COUNT_OF(renamed); k++)
        if (!strcmp(former_path, renamed[k].old)) return renamed[k].now;
    return NULL;
}

const char *override_key_get_current_name(struct reader *r, const char *path)
{
    for (int k = 0; k < (int)COUNT_OF(renamed); k++) {
        if (strcmp(path, renamed[k].old) != 0) continue;
        renamed_note(r->scene, k);
        return renamed[k].now;
    }
    return path;
}

status tree_rename_old_keys(struct reader *r, struct yaml_node *root)
{
    for (int k = 0; k < (int)COUNT_OF(renamed); k++) {
        struct yaml_node *old = (struct yaml_node *)tree_find_node_by_path(root, renamed[k].old);
        const struct yaml_node *now = tree_find_node_by_path(root, renamed[k].now);
        if (!old) continue;
        if (now) return fault_report_exclusive_keys(r, now, old);
        const char *dot = strrchr(renamed[k].now, '.'), *leaf = dot ? dot + 1 : renamed[k].now;
        old->key = arena_copy_text(r, leaf, strlen(leaf));
        renamed_note(r->scene, k);
    }
    for (int k = 0; k < (int)COUNT_OF(removed); k++) {
        const struct yaml_node *n = tree_find_node_by_path(root, removed[k].path);
        if (n) return fault_report_at_node(r, n, "%s", removed[k].what);
    }
    return OK;
}
