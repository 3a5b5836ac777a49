/* Whose a folder is: the guard that every command calls before it writes into a folder of its own. */
#ifndef CLEAVE_FOLDER_GUARD
#define CLEAVE_FOLDER_GUARD

#include "base/base.h"

/* A kind of folder that a command makes, and how it is recognised. */
struct folder_kind {
    const char *what; /* of messages: "run", "study", "export" */
    const char *sign; /* name of the file by which a folder of this kind is recognised */
    /* Returns true if Cleave wrote the sign at `path`. text: as given to folder_guard. */
    bool (*is_sign)(const char *path, const char *text);
    /* Returns true for an entry that a folder of this kind may have before its sign; NULL: none. */
    bool (*is_early)(const char *folder, const char *name);
    const char *inner[2]; /* folders in it that the command fills; NULL: no such folder */
};

/* Returns true for the names of hidden and temporary files, which any folder may have. */
bool entry_is_ignored(const char *name);

/* Checks that a command may write into `folder`: it does not exist, is empty but for hidden and temporary files, or is
 * of this kind. *there: it is of this kind. text: of the scene, for is_sign; may be NULL. REFUSED with the name of a
 * file of others, or of an inner folder that is a link. */
status folder_guard(const struct folder_kind *kind, const char *folder, const char *text, bool *there);

#endif
