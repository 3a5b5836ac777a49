/* Files that a scene names. */
#include "scene_internal.h"

#include <string.h>
#include <unistd.h>

#include "output/checksum.h"
#include "base/memory.h"

status read_path(struct reader *r, const struct node *n, const char *what, char **path, uint64_t *contents)
{
    const char *slash = strrchr(r->name, '/');
    const size_t folder = slash ? (size_t)(slash - r->name) + 1 : 0, length = strlen(n->text);
    if (n->kind != NODE_SCALAR || length == 0)
        return fault(r, n, "%s is no file name; %s is expected", shown(r, n), what);
    *path = NEW("file name", folder + length + 1, char);
    if (r->files && folder > 0 && n->text[0] != '/') {
        memcpy(*path, r->name, folder);
        memcpy(*path + folder, n->text, length + 1);
        if (access(*path, R_OK) == 0) return file_contents(*path, contents);
    }
    memcpy(*path, n->text, length + 1);
    if (!r->files) return OK;
    if (access(*path, R_OK) == 0) return file_contents(*path, contents);
    return fault(r, n, "%s cannot be read; %s in the scene's folder is expected", shown(r, n), what);
}
