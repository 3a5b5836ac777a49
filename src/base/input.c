/* Opens the files that a command reads as its input, and keeps their identities until the process ends. */
#include "base/input.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Identity of a file: device, number of the file on it, and time of its last change. The time is included because a new
 * file may get the number of a removed one. */
struct identity {
    dev_t device;
    ino_t number;
    struct timespec changed;
};

static struct identity *inputs;
static int input_count, input_room;

static struct identity identity_of(const struct stat *s)
{
#ifdef __APPLE__
    return (struct identity){s->st_dev, s->st_ino, s->st_mtimespec};
#else
    return (struct identity){s->st_dev, s->st_ino, s->st_mtim};
#endif
}

static bool identity_is_known(const struct identity *one)
{
    bool known = false;
    for (int k = 0; k < input_count; k++)
        known |= inputs[k].device == one->device && inputs[k].number == one->number &&
                 inputs[k].changed.tv_sec == one->changed.tv_sec && inputs[k].changed.tv_nsec == one->changed.tv_nsec;
    return known;
}

/* Adds a file to the list of input files of this process, which must not be overwritten, unless the file is in the
 * list. s: status of the file, from stat. If memory is exhausted, the file is not added, since the next allocation
 * elsewhere ends the program. */
static void input_add(const struct stat *s)
{
    const struct identity one = identity_of(s);
    if (identity_is_known(&one)) return;
    if (input_count == input_room) {
        const int room = 2 * input_room + 16;
        struct identity *more = realloc(inputs, (size_t)room * sizeof *more);
        if (!more) return;
        inputs = more;
        input_room = room;
    }
    inputs[input_count++] = one;
}

void input_file_register_as_read(const char *path)
{
    struct stat s;
    if (stat(path, &s) == 0) input_add(&s);
}

bool input_file_was_read(const char *path)
{
    struct stat s;
    if (input_count == 0 || stat(path, &s) != 0) return false;
    const struct identity one = identity_of(&s);
    return identity_is_known(&one);
}

/* Returns true if `path` is the name of an open file descriptor of this process, such as /dev/stdin or /dev/fd/3. A
 * pipe with such a name is open already, so that opening it does not wait for a writer. */
static bool is_descriptor(const char *path)
{
    return strcmp(path, "/dev/stdin") == 0 || strncmp(path, "/dev/fd/", 8) == 0 ||
           strncmp(path, "/proc/self/fd/", 14) == 0;
}

/* Returns the reason why a file cannot be read as an input, as a text for a message (not to be freed); NULL if it can
 * be read. fd: descriptor of the open file, or -1 if open has just failed (errno is then read); path: name of the file.
 * *s: receives the status of the file. */
static const char *input_fault(int fd, const char *path, struct stat *s)
{
    const int cause = errno;
    if (fd >= 0 && is_descriptor(path) && fstat(fd, s) == 0 && S_ISFIFO(s->st_mode))
        return fcntl(fd, F_SETFL, 0) == 0 ? NULL : strerror(errno);
    if ((fd < 0 ? stat(path, s) : fstat(fd, s)) == 0 && !S_ISREG(s->st_mode))
        return S_ISDIR(s->st_mode) ? "is a folder" : "is not a regular file";
    return fd < 0 ? strerror(cause) : NULL;
}

status input_file_open(FILE **file, const char *path, const char *expected_content)
{
    struct stat s;
    /* a pipe would block until a writer opens it */
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    const char *fault = input_fault(fd, path, &s);
    *file = fault ? NULL : fdopen(fd, "rb");
    if (*file) {
        input_add(&s);
        return OK;
    }
    if (!fault) fault = strerror(errno);
    if (fd >= 0) close(fd);
    return status_set(REFUSED, "%s: %s%s%s", path, fault, expected_content ? "; give " : "",
                      expected_content ? expected_content : "");
}
