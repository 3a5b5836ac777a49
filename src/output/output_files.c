/* Composes paths, and writes files safely: under a temporary name first, which is renamed when the data are on the
 * disk. */
#include "output/output_files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/input.h"
#include "base/memory.h"

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* Returns the path that consists of the texts `first`, `between` and `last`; an empty path if it is too long. */
static struct path path_compose(const char *first, const char *between, const char *last)
{
    struct path p;
    int length = snprintf(p.text, sizeof p.text, "%s%s%s", first, between, last);
    /* A path that is too long becomes empty, which every system call refuses; a truncated path could name another
     * file. */
    if (length < 0 || (size_t)length >= sizeof p.text) p.text[0] = '\0';
    return p;
}

struct path path_join(const char *folder, const char *name) { return path_compose(folder, "/", name); }

struct path path_of_temporary_file(const char *path) { return path_compose(path, "", ASIDE_ENDING); }

bool path_exists(const char *path)
{
    struct stat s;
    return lstat(path, &s) == 0;
}

char *path_copy_base_name(char *name, size_t capacity, const char *path)
{
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    size_t from = length;
    while (from > 0 && path[from - 1] != '/') from--;
    snprintf(name, capacity, "%.*s", (int)(length - from), path + from);
    return name;
}

struct path run_frame_path(const char *folder, int frame_number)
{
    char name[32];
    snprintf(name, sizeof name, "frames/%06d.hdf", frame_number);
    return path_join(folder, name);
}

bool path_is_link(const char *path)
{
    struct stat s;
    return lstat(path, &s) == 0 && S_ISLNK(s.st_mode);
}

bool path_is_file(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISREG(s.st_mode);
}

bool path_is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

/* ---- unfinished files -------------------------------------------------------------------------------------------- */

/* Paths of the files that are being written at present, by the main thread or by the thread that writes output frames.
 * "" denotes an unused entry. */
enum { UNFINISHED_MOST = 8 };
static struct path unfinished[UNFINISHED_MOST];
static pthread_mutex_t unfinished_lock = PTHREAD_MUTEX_INITIALIZER;

/* Replaces the path `from` by `to` in the list `unfinished` of files that are being written, if it is there. "" as
 * `from` adds `to` to the list, "" as `to` removes `from`. */
static void unfinished_replace(const char *from, const char *to)
{
    bool found = false;
    pthread_mutex_lock(&unfinished_lock);
    for (int k = 0; k < UNFINISHED_MOST && !found; k++) {
        found = strcmp(unfinished[k].text, from) == 0;
        if (found) strcpy(unfinished[k].text, to);
    }
    pthread_mutex_unlock(&unfinished_lock);
}

struct path file_register_temporary_and_return_path(const char *path)
{
    const struct path aside = path_of_temporary_file(path);
    unfinished_replace(aside.text, "");
    unfinished_replace("", aside.text);
    return aside;
}

static void file_end(const char *path) { unfinished_replace(path_of_temporary_file(path).text, ""); }

void files_remove_unfinished_temporaries(void)
{
    pthread_mutex_lock(&unfinished_lock);
    for (int k = 0; k < UNFINISHED_MOST; k++)
        if (unfinished[k].text[0]) unlink(unfinished[k].text);
    pthread_mutex_unlock(&unfinished_lock);
}

/* ---- faults ------------------------------------------------------------------------------------------------------ */

/* Returns advice on how to remove the cause of a failed write, as the end of a message; "" if there is none. cause:
 * value of errno after the failure. */
static const char *file_remedy(int cause)
{
    switch (cause) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
        return "; free space or choose another -o";
    case EACCES:
    case EPERM:
    case EROFS:
    case ENAMETOOLONG:
    case ENOENT:
    case ENOTDIR:
        return "; choose another -o";
    default:
        return "";
    }
}

status file_report_write_failure(const char *path, int cause)
{
    return status_set(FAILED, "cannot write %s: %s%s", path, cause ? strerror(cause) : "write error",
                      file_remedy(cause));
}

void file_discard_temporary(const char *path)
{
    struct path aside = path_of_temporary_file(path);
    /* After a failed write HDF5 keeps the file open: only truncation frees the disk. */
    if (path_is_file(aside.text) && truncate(aside.text, 0) != 0) errno = 0;
    unlink(aside.text);
    file_end(path);
}

/* ---- what is not replaced ---------------------------------------------------------------------------------------- */

/* Checks that the file `path` may be replaced or removed. Returns REFUSED, with a message, if it is an input of the
 * command that is running, a pipe, a socket or a device. Returns OK if there is no such file. */
status file_check_replaceable(const char *path)
{
    struct stat s;
    if (lstat(path, &s) != 0) return OK;
    if (!S_ISREG(s.st_mode) && !S_ISLNK(s.st_mode) && !S_ISDIR(s.st_mode))
        return status_set(REFUSED, "%s is not a regular file and is not replaced; choose another -o", path);
    if (!input_file_was_read(path)) return OK;
    return status_set(REFUSED, "%s is an input of this command and is not replaced; choose another -o", path);
}

status file_check_has_known_beginning(const char *path, const char *const *beginning, size_t beginning_count)
{
    char first[64];
    bool ours = false;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0 && !path_exists(path)) return OK;
    const ssize_t have = fd < 0 ? 0 : read(fd, first, sizeof first);
    if (fd >= 0) close(fd);
    for (size_t k = 0; k < beginning_count && have >= 0; k++) {
        const size_t length = strlen(beginning[k]);
        ours |= strncmp(first, beginning[k], (size_t)have < length ? (size_t)have : length) == 0;
    }
    return ours ? OK : status_set(REFUSED, "%s exists and was not written by cleave; move or remove it", path);
}

bool file_contents_equal_bytes(const char *path, const void *bytes, size_t length)
{
    char *text;
    size_t there;
    if (!path_is_file(path) || file_read_whole(path, &text, &there) != OK) return false;
    const bool same = there == length && memcmp(text, bytes, length) == 0;
    memory_free(text);
    return same;
}

/* ---- whole files ------------------------------------------------------------------------------------------------- */

/* Writes `length` bytes from `bytes` on to the open file fd. Returns 0, or the errno of a failed write. */
static int write_all(int fd, const char *bytes, size_t length)
{
    while (length > 0) {
        ssize_t done = write(fd, bytes, length);
        if (done < 0 && errno != EINTR) return errno;
        if (done == 0) return ENOSPC;
        if (done > 0) {
            bytes += done;
            length -= (size_t)done;
        }
    }
    return 0;
}

/* Opens the file `path` with the additional flags `flags` of open(2), writes `length` bytes at its end, synchronises it
 * with the disk and closes it. With O_EXCL an existing file is removed first. Returns 0, or the errno of a failed
 * call. */
static int write_synced(const char *path, int flags, const void *bytes, size_t length)
{
    if (flags & O_EXCL) unlink(path); /* left by a killed run; a link of this name is not followed */
    int fd = open(path, O_WRONLY | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
    if (fd < 0) return errno;
    int fault = write_all(fd, bytes, length);
    if (!fault && fsync(fd) != 0) fault = errno;
    if (close(fd) != 0 && !fault) fault = errno;
    return fault;
}

/* Synchronises the folder that contains `path` with the disk, so that a rename survives a crash. Returns 0, or the
 * errno of a failure. File systems that cannot do so return EINVAL, which is not a failure. */
static int sync_folder_of(const char *path)
{
    struct path folder = path_compose(path, "", "");
    char *slash = strrchr(folder.text, '/');
    if (slash == folder.text) slash++;
    if (slash) *slash = '\0';
    int fd = open(slash ? folder.text : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return errno;
    int fault = fsync(fd) != 0 && errno != EINVAL ? errno : 0;
    if (close(fd) != 0 && !fault) fault = errno;
    return fault;
}

/* Returns the status of a write from its errno `fault`: OK if it is 0. Otherwise removes the incomplete temporary file
 * of `path` and returns FAILED with a message. */
static status outcome(const char *path, int fault)
{
    if (!fault) return OK;
    file_discard_temporary(path);
    return file_report_write_failure(path, fault);
}

status file_append_and_sync(const char *path, const void *tail, size_t length)
{
    return outcome(path, write_synced(path_of_temporary_file(path).text, O_APPEND, tail, length));
}

static status file_rename(const char *path)
{
    status s = file_check_replaceable(path);
    if (s != OK) file_discard_temporary(path);
    TRY(s);
    s = outcome(path, rename(path_of_temporary_file(path).text, path) != 0 ? errno : 0);
    file_end(path);
    return s;
}

status file_sync_parent_folder(const char *path)
{
    const int fault = sync_folder_of(path);
    return fault && fault != EACCES ? file_report_write_failure(path, fault)
                                    : OK; /* EACCES: the folder may be written but not read */
}

status file_replace_by_temporary(const char *path)
{
    TRY(file_rename(path));
    return file_sync_parent_folder(path);
}

status file_write_whole_unsynced(const char *path, const void *bytes, size_t length)
{
    if (input_file_was_read(path) && file_contents_equal_bytes(path, bytes, length)) return OK;
    TRY(outcome(path,
                write_synced(file_register_temporary_and_return_path(path).text, O_CREAT | O_EXCL, bytes, length)));
    return file_rename(path);
}

status file_write_whole(const char *path, const void *bytes, size_t length)
{
    TRY(file_write_whole_unsynced(path, bytes, length));
    return file_sync_parent_folder(path);
}

/* ---- folders ----------------------------------------------------------------------------------------------------- */

/* Creates the folder `path`, but not its parents, unless it exists or is a symbolic link to a folder. Returns REFUSED
 * if a file, or a link to anything else, has this name; FAILED if it cannot be created, both with a message. */
static status folder_make_one(const char *path)
{
    if (mkdir(path, 0777) == 0) return file_sync_parent_folder(path);
    const int cause = errno;
    if (cause == EEXIST && path_is_folder(path)) return OK;
    if (cause == EEXIST && path_is_link(path))
        return status_set(REFUSED, "%s is a symbolic link, but not to a folder; choose another -o", path);
    if (cause == EEXIST || cause == ENOTDIR)
        return status_set(REFUSED, "%s is a file, not a folder; choose another -o", path);
    return status_set(FAILED, "cannot make the folder %s: %s; choose another -o", path, strerror(cause));
}

status folder_create_with_parents(const char *path)
{
    struct path part = {{0}};
    if (strlen(path) >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    for (size_t k = 0; path[k]; k++) {
        if (path[k] == '/' && k > 0 && !path_is_folder(part.text)) TRY(folder_make_one(part.text));
        part.text[k] = path[k];
    }
    return folder_make_one(part.text);
}

status folder_create_parents_of_file(const char *path)
{
    struct path above = {{0}};
    const char *end = strrchr(path, '/');
    if (!end || end == path) return OK;
    if (end - path >= PATH_ROOM) return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    snprintf(above.text, sizeof above.text, "%.*s", (int)(end - path), path);
    return folder_create_with_parents(above.text);
}

status folder_visit_selected_files(const char *folder, bool (*name_is_chosen)(const char *name, const char *ending),
                                   const char *ending, file_visit_fn *visit)
{
    status s = OK;
    DIR *d = path_is_link(folder) ? NULL : opendir(folder);
    if (!d) return OK;
    for (struct dirent *e; s == OK && (e = readdir(d));)
        if (name_is_chosen(e->d_name, ending)) s = visit(path_join(folder, e->d_name).text);
    closedir(d);
    return s;
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* Reads up to `capacity` bytes from the open file fd to bytes[]. Returns their number, or -1 on a fault. */
static int64_t output_files_read_all(int fd, char *bytes, size_t capacity)
{
    size_t have = 0;
    while (have < capacity) {
        ssize_t done = read(fd, bytes + have, capacity - have);
        if (done < 0 && errno != EINTR) return -1;
        if (done == 0) break;
        if (done > 0) have += (size_t)done;
    }
    return (int64_t)have;
}

status file_read_whole(const char *path, char **text, size_t *length)
{
    struct stat s;
    /* Open without blocking: a FIFO of this name would otherwise stop the program. */
    int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return status_set(FAILED, "cannot read %s: %s", path, strerror(errno));
    if (fstat(fd, &s) != 0 || !S_ISREG(s.st_mode)) {
        close(fd);
        return status_set(FAILED, "cannot read %s, which is not a regular file; give another one", path);
    }
    *text = NEW("output.text", s.st_size + 1, char);
    int64_t have = output_files_read_all(fd, *text, (size_t)s.st_size);
    close(fd);
    if (have < 0) {
        memory_free(*text);
        *text = NULL;
        return status_set(FAILED, "cannot read %s: %s", path, strerror(errno));
    }
    *length = (size_t)have;
    return OK;
}
