/* One run at a time has a folder. */
#ifndef CLEAVE_OUTPUT_LOCK
#define CLEAVE_OUTPUT_LOCK

#include "base/base.h"

struct folder_lock {
    int fd;
}; /* -1: none */

/* Takes the folder for this process, until folder_unlock or its end. REFUSED, with the process that has it, while
 * another one lives; OK with a warning on standard error where the file system knows no locks. */
status folder_lock(struct folder_lock *l, const char *folder);
/* FAILED where the folder of this name is no longer the one that was taken. */
status folder_held(const struct folder_lock *l, const char *folder);
void folder_unlock(struct folder_lock *l, const char *folder);

#endif
