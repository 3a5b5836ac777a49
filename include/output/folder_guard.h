/* Check of results folders: every command calls it before it writes into a folder, so that files that Cleave did not
 * write are not replaced. */
#ifndef CLEAVE_FOLDER_GUARD
#define CLEAVE_FOLDER_GUARD

#include "base/base.h"

/* Describes a kind of output folder, such as that of a run, and how Cleave recognises it before it writes there. */
struct folder_kind {
    const char *what; /* noun for messages: "run", "study", "export" */
    const char *sign; /* name of the file by which a folder of this kind is recognised */
    /* Returns true if Cleave wrote the file `sign` at `path`. text: argument of folder_check_writable. */
    bool (*is_sign)(const char *path, const char *text);
    /* Returns true if a folder of this kind may hold the entry `name` before `sign` is written. NULL: no such
     * entries. */
    bool (*is_early)(const char *folder, const char *name);
    const char *inner[2]; /* subfolders that the command fills; NULL: unused slot */
};

/* Returns true if the file name `name` (without folder) begins with a dot (hidden) or ends in .tmp (temporary); any
 * output folder may contain such files. */
bool file_name_is_hidden_or_temporary(const char *name);

/* Checks that a command may write its files into `folder`. It may if the folder does not exist, contains only hidden
 * and temporary files, or is of the given kind. scene_text: text of the scene, passed to kind->is_sign; may be NULL if
 * kind->is_sign does not use it. Sets *exists to true if the folder exists and is of this kind, else to false. Returns
 * REFUSED, with the name of the entry in the message, if the folder contains a file that Cleave did not write, or if a
 * subfolder listed in kind->inner is a symbolic link. */
status folder_check_writable(const struct folder_kind *kind, const char *folder, const char *scene_text,
                             bool *exists_and_is_of_kind);

#endif
