/* floor 0: aligned arrays, touched first by their threads; the end of the run where there is no memory. */
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>

/* A cache line and the widest vector [byte]; and the pieces in which pages are touched. */
enum { ALIGNMENT = 64, PIECE = 65536 };

/* Large arrays lie in large pages where the system has them: a stream through memory then waits for fewer addresses. */
enum { LARGE_PAGE = 2 << 20, LARGE = 2 * LARGE_PAGE };

static _Noreturn void out_of_memory(const char *label, int64_t count, size_t size)
{
    fprintf(stderr, "out of memory: %s needs %lld entries of %zu bytes; this run has used %.1f MB so far\n", label,
            (long long)count, size, (double)memory_peak() * 1e-6);
    exit(FAILED);
}

/* Writes zeros piece by piece in the static partition of the loops that will use the array, so that a page
 * lies in the memory of the processor whose thread works on it. */
static void zero(char *bytes, size_t length)
{
    int64_t pieces = (int64_t)((length + PIECE - 1) / PIECE);
    if (pieces < 2) {
        memset(bytes, 0, length);
        return;
    }
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < pieces; k++) {
        size_t first = (size_t)k * PIECE, rest = length - first;
        memset(bytes + first, 0, rest < PIECE ? rest : PIECE);
    }
}

void *memory_new(const char *label, int64_t count, size_t size)
{
    size_t length;
    void *pointer = NULL;
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, &length) || length > PTRDIFF_MAX - ALIGNMENT)
        out_of_memory(label, count, size);
    size_t whole = (length / ALIGNMENT + 1) * ALIGNMENT;   /* also for count 0: a pointer that can be freed */
    if (posix_memalign(&pointer, whole < LARGE ? ALIGNMENT : LARGE_PAGE, whole) != 0) out_of_memory(label, count, size);
#ifdef MADV_HUGEPAGE
    if (whole >= LARGE) madvise(pointer, whole, MADV_HUGEPAGE);     /* a wish: nothing depends on it */
#endif
    zero(pointer, whole);
    return pointer;
}

void *memory_resize(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size)
{
    assert(pointer == NULL || old_count >= 0);
    char *grown = memory_new(label, count, size);
    int64_t kept = old_count < count ? old_count : count;
    if (pointer != NULL && kept > 0) memcpy(grown, pointer, (size_t)kept * size);
    memory_free(pointer);
    return grown;
}

void memory_free(void *pointer) { free(pointer); }

/* VmHWM is of this program alone; ru_maxrss remembers the program that started it. */
static int64_t peak_of_program(void)
{
    FILE *f = fopen("/proc/self/status", "r");
    char line[128];
    long long kilobytes = 0;
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "VmHWM: %lld", &kilobytes) == 1) break;
    if (f) fclose(f);
    return kilobytes * 1024;
}

int64_t memory_peak(void)
{
    int64_t peak = peak_of_program();
    if (peak > 0) return peak;
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return usage.ru_maxrss;              /* bytes there, kilobytes elsewhere */
#else
    return (int64_t)usage.ru_maxrss * 1024;
#endif
}
