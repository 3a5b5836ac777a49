/* Reads the files that a scene includes, and merges the scene over them. Later files take precedence over earlier
 * ones, and the scene takes precedence over all files. */
#include "scene_internal.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"

enum { CHAIN_MOST = 8, KEYS_MOST = 1100 }; /* largest depth of inclusion; largest number of keys of a mapping */

/* Chain of the files that are being read, identified by device and inode number. Each file is included by the file
 * `up`; the last one is the scene itself, with up = NULL. */
struct chain {
    const struct chain *up;
    dev_t device;
    ino_t number;
};

/* ---- one mapping over another ------------------------------------------------------------------------------------ */

/* Returns true if the value of the key at `path` ("": the whole scene) is a mapping that is merged entry by entry with
 * an included one. Any other value replaces the included value as a whole. */
bool key_is_mapping_merged_with_included_file(const char *path)
{
    if (*path == '\0') return true;
    const struct key *k = key_find("", path);
    if (k && k->words && strncmp(k->words, "mapping of names", 16) == 0) return true;
    if (k && (k->type == KEY_MAP || k->type == KEY_PART)) return true;
    for (int i = 0; i < keys_count && strchr(path, '.'); i++)
        if (strcmp(keys[i].path, path) == 0) return keys[i].type == KEY_MAP;
    return false;
}

static bool is_empty(const struct yaml_node *n) { return n->kind == NODE_SCALAR && *n->text == '\0'; }

/* Returns REFUSED, with a message, if the mapping `map` has two equal keys, one of which would be lost, or more than
 * KEYS_MOST keys. */
static status check_twins(const struct reader *r, const struct yaml_node *map)
{
    if (map->n > KEYS_MOST)
        return fault_report_at_node(r, map, "has %d keys, but a mapping has at most %d; remove some", map->n,
                                    KEYS_MOST);
    for (const struct yaml_node *n = map->first; n; n = n->next) TRY(check_key_given_once(r, map, n));
    return OK;
}

/* Merges the mapping `over` into the mapping `under`. Values of `over` take precedence. Mappings for which
 * key_is_mapping_merged_with_included_file is true are merged entry by entry. An empty value removes the entry. group:
 * path of both mappings in the scene. Returns REFUSED, with a message, for a key that occurs twice in a mapping. */
static status merge(struct reader *r, struct yaml_node *under, struct yaml_node *over, const char *group)
{
    char path[64];
    TRY(check_twins(r, over));
    TRY(check_twins(r, under));
    under->line = over->line, under->column = over->column, under->origin = over->origin;
    for (struct yaml_node *n = over->first, *next; n; n = next) {
        struct yaml_node *old = yaml_node_find(under, n->key);
        next = n->next;
        snprintf(path, sizeof path, "%.30s%s%.30s", group, *group ? "." : "", n->key);
        if (old && old->kind == NODE_MAP && n->kind == NODE_MAP && key_is_mapping_merged_with_included_file(path)) {
            TRY(merge(r, old, n, path));
            continue;
        }
        if (old) yaml_node_remove(under, old);
        if (!old || !is_empty(n)) yaml_node_append(under, n);
    }
    return OK;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Returns true if the file with the status `file` (from stat) is one of the files that are being read, so that it would
 * include itself. chain: the files that are being read, the innermost first. */
static bool is_open(const struct chain *chain, const struct stat *file)
{
    for (; chain; chain = chain->up)
        if (chain->device == file->st_dev && chain->number == file->st_ino) return true;
    return false;
}

static int length_of(const struct chain *chain)
{
    int n = 0;
    for (; chain; chain = chain->up) n++;
    return n;
}

/* Returns the path of the file that YAML node n includes, in memory of the reader r that arena_free releases. A
 * relative name starts from the folder of the including file. */
static char *path_from(struct reader *r, const struct yaml_node *n)
{
    const char *from = origin_file_name(r, n->origin);
    const size_t folder = *n->text == '/' ? 0 : (size_t)path_folder_length(from), length = strlen(n->text);
    char *path = arena_allocate_zeroed(r, folder + length + 1);
    memcpy(path, from, folder);
    memcpy(path + folder, n->text, length);
    return path;
}

static status include_all(struct reader *r, struct yaml_node *root, const struct chain *chain);

/* Reads the scene in the file that YAML node n names, and the scenes that it includes, into the tree *root. chain:
 * files that are being read, to find a file that includes itself. Returns REFUSED, with a message, if the file cannot
 * be read, is no scene or includes itself. */
static status include_file(struct reader *r, const struct yaml_node *n, const struct chain *chain,
                           struct yaml_node **root)
{
    struct stat file;
    char *text, *path;
    size_t length;
    if (n->kind != NODE_SCALAR || is_empty(n))
        return fault_report_at_node(r, n, "%s is not a file name; give a scene file",
                                    node_value_to_text_for_message(r, n));
    if (!r->files)
        return fault_report_at_node(
            r, n, "%s: scenes with the key include cannot be read here; give a scene without this key",
            node_value_to_text_for_message(r, n));
    path = path_from(r, n);
    if (stat(path, &file) != 0 || !S_ISREG(file.st_mode))
        return fault_report_at_node(r, n, "%s cannot be read; give a scene file in the folder of this one",
                                    node_value_to_text_for_message(r, n));
    if (is_open(chain, &file))
        return fault_report_at_node(r, n,
                                    "%s includes itself, or the scene that includes it; remove one of these includes",
                                    node_value_to_text_for_message(r, n));
    if (length_of(chain) == CHAIN_MOST)
        return fault_report_at_node(
            r, n, "%s ends a chain of more than %d scenes, each included by the previous one; merge some of them",
            node_value_to_text_for_message(r, n), CHAIN_MOST);
    if (r->includes == INCLUDED_MOST)
        return fault_report_at_node(r, n, "more than %d scenes are included; merge some of them", INCLUDED_MOST);
    const int origin = ORIGIN_INCLUDED - r->includes;
    r->included[r->includes++] = path;
    TRY(file_read_bytes(path, &text, &length));
    const status read = tree_parse_yaml(r, text, length, origin, root);
    memory_free(text);
    TRY(read);
    if (!*root)
        return fault_report_at_location(r, origin, 1, 1,
                                        "the scene is empty; begin with keys such as space and duration");
    TRY(check_node_kind(r, *root, NODE_MAP, "give a scene, which is a mapping of keys to values"));
    TRY(tree_rename_old_keys(r, *root));
    struct yaml_node *name = yaml_node_find(*root, "name");
    if (name) yaml_node_remove(*root, name);
    return include_all(r, *root, &(struct chain){chain, file.st_dev, file.st_ino});
}

/* Reads the files in the list `include` of the scene in order, and merges them: later files replace values of earlier
 * ones, the scene itself those of all files. root: YAML tree of the input file (scene), replaced by the merged tree;
 * chain: files that are being read. Returns REFUSED, with a message, for an invalid list or file. */
static status include_all(struct reader *r, struct yaml_node *root, const struct chain *chain)
{
    struct yaml_node *list = yaml_node_find(root, "include"), *file;
    if (!list) return OK;
    struct yaml_node base = {.kind = NODE_MAP, .text = ""};
    const struct yaml_node *n = list->kind == NODE_LIST ? list->first : list;
    TRY(check_twins(r, root));
    if (!n || list->n > INCLUDED_MOST)
        return fault_report_at_node(r, list, "has %d items; give 1 to %d", list->n, INCLUDED_MOST);
    yaml_node_remove(root, list);
    for (const struct yaml_node *next; n; n = next) {
        next = list->kind == NODE_LIST ? n->next : NULL;
        TRY(include_file(r, n, chain, &file));
        TRY(merge(r, &base, file, ""));
    }
    TRY(merge(r, &base, root, ""));
    root->first = base.first, root->last = base.last, root->n = base.n;
    for (struct yaml_node *c = root->first; c; c = c->next) c->parent = root;
    return OK;
}

status tree_merge_included_files(struct reader *r, struct yaml_node *root)
{
    struct stat file = {0};
    r->includes = 0;
    if (root->kind != NODE_MAP) return OK;
    const bool known = r->files && stat(r->name, &file) == 0;
    TRY(include_all(r, root, known ? &(struct chain){NULL, file.st_dev, file.st_ino} : NULL));
    for (int k = 0; k < r->overrides; k++)
        if (strcmp(r->override[k].key, "include") == 0)
            return fault_report_at_location(r, k, 0, 0,
                                            "include cannot be given by -s; write a scene file that includes this one");
    return OK;
}
