/* Lock that lets only one run at a time use a folder. */
#ifndef CLEAVE_OUTPUT_LOCK
#define CLEAVE_OUTPUT_LOCK

#include "base/base.h"

/* Lock of a folder: the descriptor `fd` of its open lock file, -1 if the folder is not locked. */
struct folder_lock {
    int fd;
};

/* Locks `folder` for this process, until folder_unlock or the end of the process, and stores the lock in *l. Returns
 * REFUSED, with the number of the process that holds the lock, while another process has locked the folder. Returns
 * OK, with a warning on standard error, if the file system does not support locks. */
status folder_lock(struct folder_lock *l, const char *folder);

/* Checks that the lock l still applies to `folder`. Returns FAILED if another folder has that name now, for example
 * because the locked one was moved or removed. */
status folder_check_lock_still_holds(const struct folder_lock *l, const char *folder);

/* Releases the lock l, and removes the lock file in `folder` if the lock still applies to this folder. Does nothing if
 * l holds no lock. */
void folder_unlock(struct folder_lock *l, const char *folder);

#endif
