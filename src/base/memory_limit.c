/* Determines the memory that this process may use, from its own limits and those of its control groups (containers,
 * batch systems). */
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }

/* ---- control groups ---------------------------------------------------------------------------------------------- */

/* Returns the first number in the file `path`, as the files of control groups contain it; INT64_MAX if the file does
 * not exist or contains no number (`max`: no limit). */
static int64_t number_in(const char *path)
{
    FILE *f = fopen(path, "r");
    long long number;
    const bool found = f && fscanf(f, "%lld", &number) == 1 && number >= 0;
    if (f) fclose(f);
    return found ? number : INT64_MAX;
}

/* Returns the smallest memory limit of a control group and of all groups above it [byte]; INT64_MAX if there is none.
 * The limits are the numbers in the files base/group/file. In a container, the highest group is that of the container.
 * group: path of the control group, which is cut to the empty text; file: name of the files with limits. */
static int64_t group_and_above(const char *base, char *group, const char *file)
{
    int64_t limit = INT64_MAX;
    char path[2048];
    for (;;) {
        if (snprintf(path, sizeof path, "%s%s/%s", base, group, file) < (int)sizeof path)
            limit = least(limit, number_in(path));
        char *slash = strrchr(group, '/');
        if (!slash) return limit;
        *slash = '\0';
    }
}

/* Returns the smallest memory limit of all control groups of the process [byte]; INT64_MAX if there is none.
 * /proc/self/cgroup has lines `number:controllers:group`, in version 2 `0::group`. */
static int64_t groups_limit(void)
{
    FILE *f = fopen("/proc/self/cgroup", "r");
    int64_t limit = INT64_MAX;
    char line[1024];
    while (f && fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = '\0';
        char *controllers = strchr(line, ':'), *group = controllers ? strchr(controllers + 1, ':') : NULL;
        if (!group) continue;
        *group++ = '\0';
        if (strcmp(controllers, ":") == 0)
            limit = least(limit, group_and_above("/sys/fs/cgroup", group, "memory.max"));
        else if (strstr(controllers, "memory"))
            limit = least(limit, group_and_above("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
    }
    if (f) fclose(f);
    return limit;
}

/* ---- limits of the process --------------------------------------------------------------------------------------- */

/* Returns the memory that a limit of the process leaves [byte]: the limit minus the memory in use, at least 1;
 * INT64_MAX if there is no limit. resource: number of the limit for getrlimit (RLIMIT_*); taken: memory in use
 * [pages]. */
static int64_t left_of(int resource, long long taken)
{
    struct rlimit l;
    if (getrlimit(resource, &l) != 0 || l.rlim_cur == RLIM_INFINITY || l.rlim_cur > INT64_MAX) return INT64_MAX;
    const int64_t left = (int64_t)l.rlim_cur - taken * sysconf(_SC_PAGESIZE);
    return left > 1 ? left : 1;
}

static struct memory_limit tighter(struct memory_limit a, struct memory_limit b) { return b.bytes < a.bytes ? b : a; }

struct memory_limit memory_limit(void)
{
    FILE *f = fopen("/proc/self/statm", "r");
    long long size = 0, data = 0;
    if (f && fscanf(f, "%lld %*d %*d %*d %*d %lld", &size, &data) != 2) size = data = 0;
    if (f) fclose(f);
    struct memory_limit limit = {groups_limit(), "limit of a control group"};
    limit = tighter(limit, (struct memory_limit){left_of(RLIMIT_DATA, data), "ulimit -d"});
#ifdef RLIMIT_AS
    limit = tighter(limit, (struct memory_limit){left_of(RLIMIT_AS, size), "ulimit -v"});
#endif
    return limit;
}
