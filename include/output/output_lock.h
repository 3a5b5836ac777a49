/* Lock that lets only one run at a time use a folder. */
#ifndef CLEAVE_OUTPUT_LOCK
#define CLEAVE_OUTPUT_LOCK

#include "base/base.h"

/* An open lock file. */
struct folder_lock {
    int fd;
}; /* -1: not locked */

/* Locks the folder for this process until folder_unlock or the end of the process. REFUSED, with the process that holds
 * the lock, while that process runs. OK with a warning on standard error if the file system supports no locks. */
status folder_lock(struct folder_lock *l, const char *folder);

/* Checks that the lock still applies. FAILED if the folder of this name is no longer the folder that was locked. */
status folder_held(const struct folder_lock *l, const char *folder);

/* Removes the lock file, if the lock still applies, and releases the lock. */
void folder_unlock(struct folder_lock *l, const char *folder);

#endif
