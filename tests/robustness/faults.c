/* Implements faults.h. A call of the program is linked to __wrap_x, which calls the x of this file, as all libraries
 * do; x calls the C library's function x (found by dlsym). */
#define _GNU_SOURCE /* O_TMPFILE */
#include "faults.h"

#include <stdio.h>

#ifdef __linux__

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "coupling/conversion.h"
#include "output/output.h"
#include "src/quasistatic/stretch_ratio.h"

const char *const fault_name[FAULT_CALLS] = {
    "own malloc", "own open", "own read", "own write", "own fsync",  "own close", "own rename",  "own mkdir",
    "own unlink", "malloc",   "mmap",     "open",      "read",       "write",     "fsync",       "close",
    "rename",     "mkdir",    "unlink",   "sample",    "conversion", "coupling",  "equilibrium",
};

static struct fault_plan plan;
static long *counts; /* NULL: not armed */

void faults_arm(const struct fault_plan *p, long *count)
{
    plan = *p;
    counts = count;
}

/* Counts a call of the kind `call`. If it is the call of the plan, stops or kills the process or breaks an invariant,
 * as the plan states. Returns true if the call must fail, with errno set; false if faults_arm has not been called. */
static bool hit(enum fault_call call)
{
    if (!counts) return false;
    const long number = __atomic_add_fetch(&counts[call], 1, __ATOMIC_RELAXED);
    if (plan.deed == DO_NOTHING || call != plan.call || number != plan.number) return false;
    if (plan.deed == DO_KILL) kill(getpid(), SIGKILL);
    if (plan.deed == DO_STOP) kill(getpid(), SIGINT);
    INVARIANT(plan.deed != DO_BREAK);
    errno = plan.cause;
    return plan.deed == DO_FAIL;
}

/* Counts a call of the kind `call` on the file descriptor fd; returns true if it must fail. Calls on standard input,
 * output and error are neither counted nor disturbed. */
static bool hit_file(enum fault_call call, int fd) { return fd > STDERR_FILENO && hit(call); }

/* Declares the function pointer `next` and sets it to the C library's function of this name. */
#define NEXT(type, name, ...)                                                                                          \
    static type (*next)(__VA_ARGS__);                                                                                  \
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, name)

/* ---- the log ----------------------------------------------------------------------------------------------------- */

/* Returns a hash of the bytes of the file `path`, read by system calls that are not counted; 0 if there is no such
 * file. */
unsigned long fault_hash(const char *path)
{
    unsigned char bytes[4096];
    unsigned long hash = 5381;
    const int fd = (int)syscall(SYS_openat, AT_FDCWD, path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return 0;
    for (long n; (n = syscall(SYS_read, fd, bytes, sizeof bytes)) > 0;)
        for (long k = 0; k < n; k++) hash = hash * 33 ^ bytes[k];
    syscall(SYS_close, fd);
    return hash;
}

static void log_call(const char *what, const char *path, const char *to)
{
    struct stat s;
    if (!counts || plan.log <= 0) return;
    const bool is_file = stat(path, &s) == 0 && S_ISREG(s.st_mode);
    dprintf(plan.log, "%s %s %s %lu\n", what, path, to, is_file ? fault_hash(path) : 0);
}

static void log_sync(int fd)
{
    char link[64], path[4096];
    if (!counts || plan.log <= 0) return;
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return;
    path[length] = '\0';
    log_call("fsync", path, "-");
}

/* ---- the whole process ------------------------------------------------------------------------------------------- */

/* Returns the argument `mode` of open() with these flags, read from `rest`; 0 unless the flags create a file. */
static mode_t mode_of(int flags, va_list rest) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0; }

int open(const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = mode_of(flags, rest);
    va_end(rest);
    NEXT(int, "open", const char *, int, ...);
    return hit(ALL_OPEN) ? -1 : next(path, flags, mode);
}

FILE *fopen(const char *path, const char *mode)
{
    NEXT(FILE *, "fopen", const char *, const char *);
    return hit(ALL_OPEN) ? NULL : next(path, mode);
}

ssize_t read(int fd, void *bytes, size_t n)
{
    NEXT(ssize_t, "read", int, void *, size_t);
    return hit_file(ALL_READ, fd) ? -1 : next(fd, bytes, n);
}

ssize_t pread(int fd, void *bytes, size_t n, off_t at)
{
    NEXT(ssize_t, "pread", int, void *, size_t, off_t);
    return hit_file(ALL_READ, fd) ? -1 : next(fd, bytes, n, at);
}

ssize_t write(int fd, const void *bytes, size_t n)
{
    NEXT(ssize_t, "write", int, const void *, size_t);
    return hit_file(ALL_WRITE, fd) ? -1 : next(fd, bytes, n);
}

ssize_t pwrite(int fd, const void *bytes, size_t n, off_t at)
{
    NEXT(ssize_t, "pwrite", int, const void *, size_t, off_t);
    return hit_file(ALL_WRITE, fd) ? -1 : next(fd, bytes, n, at);
}

#ifdef __GLIBC__
extern __typeof__(open) open64 __attribute__((alias("open")));
extern __typeof__(fopen) fopen64 __attribute__((alias("fopen")));
extern __typeof__(pread) pread64 __attribute__((alias("pread")));
extern __typeof__(pwrite) pwrite64 __attribute__((alias("pwrite")));
#endif

int fflush(FILE *f)
{
    NEXT(int, "fflush", FILE *);
    return f && f != stdout && f != stderr && hit(ALL_WRITE) ? EOF : next(f);
}

int fsync(int fd)
{
    if (hit(ALL_FSYNC)) return -1;
    log_sync(fd);
    return counts ? 0 : (int)syscall(SYS_fsync, fd);
}

int close(int fd)
{
    NEXT(int, "close", int);
    const bool fails = hit_file(ALL_CLOSE, fd);
    const int closed = next(fd); /* a close that fails closes nevertheless */
    if (fails) errno = plan.cause;
    return fails ? -1 : closed;
}

int rename(const char *from, const char *to)
{
    NEXT(int, "rename", const char *, const char *);
    if (hit(ALL_RENAME)) return -1;
    log_call("rename", from, to);
    return next(from, to);
}

int mkdir(const char *path, mode_t mode)
{
    NEXT(int, "mkdir", const char *, mode_t);
    if (hit(ALL_MKDIR)) return -1;
    const int made = next(path, mode);
    if (made == 0) log_call("mkdir", path, "-");
    return made;
}

int unlink(const char *path)
{
    NEXT(int, "unlink", const char *);
    return hit(ALL_UNLINK) ? -1 : next(path);
}

void *mmap(void *at, size_t length, int protection, int flags, int fd, off_t offset)
{
    NEXT(void *, "mmap", void *, size_t, int, int, int, off_t);
    return fd < 0 && hit(ALL_MMAP) ? MAP_FAILED : next(at, length, protection, flags, fd, offset);
}

/* dlsym itself allocates memory: therefore the C library's internal names are called. */
#ifdef __GLIBC__
void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t),
    *__libc_memalign(size_t, size_t);

void *malloc(size_t n) { return hit(ALL_MALLOC) ? NULL : __libc_malloc(n); }
void *calloc(size_t count, size_t n) { return hit(ALL_MALLOC) ? NULL : __libc_calloc(count, n); }
void *realloc(void *old, size_t n) { return hit(ALL_MALLOC) ? NULL : __libc_realloc(old, n); }
void *aligned_alloc(size_t alignment, size_t n) { return hit(ALL_MALLOC) ? NULL : __libc_memalign(alignment, n); }
int posix_memalign(void **pointer, size_t alignment, size_t n)
{
    *pointer = hit(ALL_MALLOC) ? NULL : __libc_memalign(alignment, n);
    return *pointer ? 0 : ENOMEM;
}
#endif

/* ---- the program's own calls ------------------------------------------------------------------------------------- */

#define WRAP(type, name, parameters, arguments, fails, failed)                                                         \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters { return fails ? failed : name arguments; }

/* clang-format off */
WRAP(void *, malloc, (size_t n), (n), hit(OWN_MALLOC), NULL)
WRAP(void *, calloc, (size_t count, size_t n), (count, n), hit(OWN_MALLOC), NULL)
WRAP(void *, realloc, (void *old, size_t n), (old, n), hit(OWN_MALLOC), NULL)
WRAP(int, posix_memalign, (void **to, size_t alignment, size_t n), (to, alignment, n), hit(OWN_MALLOC), ENOMEM)
WRAP(void *, mmap, (void *at, size_t n, int protection, int flags, int fd, off_t offset),
     (at, n, protection, flags, fd, offset), hit(OWN_MALLOC), MAP_FAILED)
WRAP(int, open, (const char *path, int flags, mode_t mode), (path, flags, mode), hit(OWN_OPEN), -1)
WRAP(FILE *, fopen, (const char *path, const char *mode), (path, mode), hit(OWN_OPEN), NULL)
WRAP(ssize_t, read, (int fd, void *bytes, size_t n), (fd, bytes, n), hit(OWN_READ), -1)
WRAP(ssize_t, pread, (int fd, void *bytes, size_t n, off_t at), (fd, bytes, n, at), hit(OWN_READ), -1)
WRAP(ssize_t, write, (int fd, const void *bytes, size_t n), (fd, bytes, n), hit_file(OWN_WRITE, fd), -1)
WRAP(ssize_t, pwrite, (int fd, const void *bytes, size_t n, off_t at), (fd, bytes, n, at), hit_file(OWN_WRITE, fd), -1)
WRAP(int, fflush, (FILE *f), (f), f && f != stdout && f != stderr && hit(OWN_WRITE), EOF)
WRAP(int, fsync, (int fd), (fd), hit(OWN_FSYNC), -1)
WRAP(int, rename, (const char *from, const char *to), (from, to), hit(OWN_RENAME), -1)
WRAP(int, mkdir, (const char *path, mode_t mode), (path, mode), hit(OWN_MKDIR), -1)
WRAP(int, unlink, (const char *path), (path), hit(OWN_UNLINK), -1)
WRAP(int, close, (int fd), (fd), hit_file(OWN_CLOSE, fd) && (close(fd), errno = plan.cause), -1)

/* ---- stages of a run --------------------------------------------------------------------------------------------- */

/* Defines the wrapper of an engine function at which runs are stopped or killed: it counts a call of the kind `place`,
 * then calls the function. */
#define PLACE(type, name, parameters, arguments, place)                                                                \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters                                                                                      \
    {                                                                                                                  \
        (void)hit(place);                                                                                              \
        return __real_##name arguments;                                                                                \
    }

PLACE(status, output_write_history, (struct output *o, const real *value), (o, value), AT_SAMPLE)
PLACE(int64_t, convert_flagged_points_to_peridynamic,
      (struct conversion *c, const struct conversion_rule *rule, struct particles *p, struct bonds *b,
       const struct bond_source *source, struct partial_stress *partial, const struct conversion_sync *look, real t),
      (c, rule, p, b, source, partial, look, t), AT_CONVERSION)
PLACE(void, partial_stress_compute_from_bonds,
      (struct partial_stress *partial, const struct particles *p, const struct bonds *b,
       const struct bond_source *source, const int32_t *changed, int64_t n),
      (partial, p, b, source, changed, n), AT_COUPLING)
PLACE(real, bonds_largest_stretch_ratio,
      (const struct bonds *b, const struct particles *p, const struct bond_limit *limit), (b, p, limit), AT_EQUILIBRIUM)
/* clang-format on */

/* ---- the program ------------------------------------------------------------------------------------------------- */

int __real_main(int argc, char **argv);
int program_main(int argc, char **argv) { return __real_main(argc, argv); }

#endif
