/* Checks folders before commands write into them, so that no files of other programs are overwritten. */
#include "output/folder_guard.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "output/output_files.h"

bool file_name_is_hidden_or_temporary(const char *name)
{
    const size_t length = strlen(name);
    return name[0] == '.' || (length > 4 && strcmp(name + length - 4, ".tmp") == 0);
}

/* Checks that a command of the given kind may write into a folder: it may contain only hidden files, temporary files
 * and those files with which folders of this kind begin. Returns REFUSED, with a message, if there is another entry,
 * whose name the message gives. Also returns REFUSED if the folder cannot be read, and OK if it does not exist. */
static status entries_guard(const struct folder_kind *kind, const char *folder)
{
    char found[PATH_NAME_ROOM] = "";
    DIR *d = opendir(folder);
    if (!d && (errno == ENOENT || errno == ENOTDIR)) return OK;
    if (!d) return status_set(REFUSED, "the folder %s cannot be read (%s); choose another -o", folder, strerror(errno));
    for (struct dirent *e; !*found && (e = readdir(d));)
        if (!file_name_is_hidden_or_temporary(e->d_name) && !(kind->is_early && kind->is_early(folder, e->d_name)))
            snprintf(found, sizeof found, "%s", e->d_name);
    closedir(d);
    if (!*found) return OK;
    return status_set(REFUSED, "the folder %s contains files, for instance %s, but no %s; choose another -o", folder,
                      found, kind->what);
}

status folder_check_writable(const struct folder_kind *kind, const char *folder, const char *scene_text,
                             bool *exists_and_is_of_kind)
{
    const struct path sign = path_join(folder, kind->sign);
    *exists_and_is_of_kind = false;
    if (strlen(folder) + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    for (size_t k = 0; k < COUNT_OF(kind->inner) && kind->inner[k]; k++) {
        const struct path inner = path_join(folder, kind->inner[k]);
        if (path_is_link(inner.text))
            return status_set(
                REFUSED, "%s is a symbolic link, so a %s would remove and write files elsewhere; choose another -o",
                inner.text, kind->what);
    }
    *exists_and_is_of_kind = path_is_file(sign.text) && kind->is_sign(sign.text, scene_text);
    return *exists_and_is_of_kind ? OK : entries_guard(kind, folder);
}
