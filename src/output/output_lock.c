/* Locks a results folder, so that only one process writes into it. Uses POSIX record locks, which are released when
 * their process ends, also on file systems that several machines share (such as NFS). The lock file contains the number
 * of the process and is removed when the run ends. */
#include "output/output_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/output_files.h"

/* lock_name: name of the lock file in a folder; lock_begin: first characters of its text, followed by the number of the
 * process. */
static const char lock_name[] = ".running", lock_begin[] = "process ";

enum { TRIES = 100 }; /* a lock file may be removed between open and lock */

/* Returns true if `path` is still the name of the file that is open as fd. The file may have been removed or replaced
 * since it was opened. */
static bool is_still_there(int fd, const char *path)
{
    struct stat own, there;
    return fstat(fd, &own) == 0 && lstat(path, &there) == 0 && own.st_ino == there.st_ino && own.st_dev == there.st_dev;
}

/* Returns true if the open file fd has another hard link: writing to it would then change another file. */
static bool has_other_names(int fd)
{
    struct stat own;
    return fstat(fd, &own) == 0 && own.st_nlink > 1;
}

/* Checks that the open file fd is empty or begins with the text with which lock files of Cleave begin. path: name of
 * the file, for messages. Returns REFUSED if it begins otherwise, and FAILED if it cannot be read, both with a
 * message. */
static status lock_file_check(int fd, const char *path)
{
    char begin[sizeof lock_begin - 1];
    const ssize_t length = pread(fd, begin, sizeof begin, 0);
    if (length < 0) return file_report_write_failure(path, errno);
    if (length == 0 || (length == (ssize_t)sizeof begin && memcmp(begin, lock_begin, sizeof begin) == 0)) return OK;
    return status_set(REFUSED, "%s is not the lock file of a run; choose another -o", path);
}

/* Locks the whole open file fd with a POSIX record lock. Returns 0, EAGAIN if another process holds the lock, or
 * another errno. */
static int lock_try(int fd)
{
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int taken;
    while ((taken = fcntl(fd, F_SETLK, &all)) != 0 && errno == EINTR) continue;
    if (taken == 0) return 0;
    return errno == EACCES ? EAGAIN : errno;
}

/* Returns REFUSED with the message that `folder` is in use by the process that holds the lock, as named in the lock
 * file fd. */
static status say_holder(int fd, const char *folder)
{
    char who[160];
    const ssize_t length = pread(fd, who, sizeof who - 1, 0);
    who[length > 0 ? length : 0] = '\0';
    who[strcspn(who, "\n")] = '\0';
    return status_set(REFUSED, "%s: this folder is in use by a run, %s; wait for its end, or choose another -o", folder,
                      who[0] ? who : "another process");
}

/* Writes the process number and the name of the machine to the lock file fd, for the messages of other processes. */
static void sign(int fd)
{
    char host[64] = "this machine", text[128];
    if (gethostname(host, sizeof host - 1) != 0) strcpy(host, "this machine");
    const int length = snprintf(text, sizeof text, "%s%ld on %s\n", lock_begin, (long)getpid(), host);
    /* The text serves messages only: faults are ignored. */
    if (ftruncate(fd, 0) != 0 || pwrite(fd, text, (size_t)length, 0) != length) errno = 0;
}

status folder_lock(struct folder_lock *l, const char *folder)
{
    const struct path path = path_join(folder, lock_name);
    *l = (struct folder_lock){.fd = -1};
    for (int k = 0; k < TRIES && l->fd < 0; k++) {
        const int fd = open(path.text, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (fd < 0) return file_report_write_failure(path.text, errno);
        const int fault = lock_try(fd);
        if (fault == EAGAIN) {
            const status s = say_holder(fd, folder);
            close(fd);
            return s;
        }
        if (fault) {
            close(fd);
            fprintf(stderr, "warning: cannot lock the folder %s (%s); make sure that no other run uses it\n",
                    printable_name(folder).text, strerror(fault));
            return OK;
        }
        const bool shared = has_other_names(fd);
        const status own = shared ? OK : lock_file_check(fd, path.text);
        if (!shared && own == OK && is_still_there(fd, path.text))
            l->fd = fd;
        else
            close(fd);
        TRY(own);
        if (shared)
            return status_set(REFUSED,
                              "%s is a hard link, so a run would also write to the same file elsewhere; remove it",
                              path.text);
    }
    if (l->fd < 0)
        return status_set(REFUSED, "%s: other runs keep starting and ending in this folder; choose another -o", folder);
    sign(l->fd);
    return OK;
}

status folder_check_lock_still_holds(const struct folder_lock *l, const char *folder)
{
    if (l->fd < 0 || is_still_there(l->fd, path_join(folder, lock_name).text)) return OK;
    return status_set(FAILED,
                      "the folder %s was moved, removed or replaced while this run wrote to it, so the run ends and "
                      "does not change the folder that now has this name; start the run again",
                      folder);
}

void folder_unlock(struct folder_lock *l, const char *folder)
{
    if (l->fd < 0) return;
    /* Remove the file before the lock is released: the next process that locks it then finds that it is removed. */
    if (folder_check_lock_still_holds(l, folder) == OK) unlink(path_join(folder, lock_name).text);
    close(l->fd);
    l->fd = -1;
}
