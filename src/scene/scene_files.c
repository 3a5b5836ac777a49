/* Finds and reads the files that a scene names. */
#include "scene_internal.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/input.h"
#include "output/checksum.h"
#include "base/memory.h"

enum { FILE_LONGEST = 16 * 1024 * 1024 }; /* largest scene file [byte]: a scene of 1e5 entries is far smaller */

status file_read_bytes(const char *path, char **bytes, size_t *length)
{
    FILE *in;
    TRY(input_file_open(&in, path, "a scene file"));
    size_t room = 65536, used = 0, got;
    char *text = NEW("scene file", room, char);
    while ((got = fread(text + used, 1, room - used, in)) > 0 && used <= FILE_LONGEST) {
        used += got;
        if (used < room) continue;
        room *= 2;
        GROW("scene file", text, (int64_t)room);
    }
    int error = ferror(in) ? errno : 0;
    fclose(in);
    *bytes = text;
    *length = used;
    if (error == 0 && used <= FILE_LONGEST) return OK;
    memory_free(text);
    if (error) return status_set(REFUSED, "%s: %s; give a scene file", path, strerror(error));
    return status_set(REFUSED, "%s: the file is longer than 16 MiB; put long data into a particle list", path);
}

int path_folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (int)(slash - path) + 1 : 0;
}

status read_input_file_path(struct reader *r, const struct yaml_node *name_node, const char *file_kind, char **path,
                            uint64_t *contents_hash)
{
    const char *from = origin_file_name(r, name_node->origin);
    const size_t folder = (size_t)path_folder_length(from), length = strlen(name_node->text);
    if (name_node->kind != NODE_SCALAR || length == 0)
        return fault_report_at_node(r, name_node, "%s is not a file name; give %s",
                                    node_value_to_text_for_message(r, name_node), file_kind);
    *path = NEW("file name", folder + length + 1, char);
    if (r->files && folder > 0 && name_node->text[0] != '/') {
        memcpy(*path, from, folder);
        memcpy(*path + folder, name_node->text, length + 1);
        if (access(*path, R_OK) == 0) return file_contents_hash(*path, contents_hash);
    }
    memcpy(*path, name_node->text, length + 1);
    if (!r->files) return OK;
    if (access(*path, R_OK) == 0) return file_contents_hash(*path, contents_hash);
    return fault_report_at_node(
        r, name_node, "%s cannot be read; put %s of this name into the folder of the scene, or correct the name",
        node_value_to_text_for_message(r, name_node), file_kind);
}
