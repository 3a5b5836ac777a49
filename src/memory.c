/* floor 0: aligned arrays, touched first by their threads; the end of the run where there is no memory. */
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* A cache line and the widest vector [byte]; the pieces in which pages are touched; a page, a large one, and the arrays that
 * lie on such. */
enum { ALIGNMENT = 64, PIECE = 65536, PAGE = 4096, LARGE_PAGE = 2 << 20, LARGE_ARRAY = 4 << 20 };

#ifdef __GLIBC__
/* From this size on an array has pages of its own, given back when it is freed: pages used before would lie where
 * somebody else's threads touched them first. */
enum { OWN_PAGES = 1 << 20 };
__attribute__((constructor)) static void own_pages(void) { mallopt(M_MMAP_THRESHOLD, OWN_PAGES); }
#endif

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

/* Large blocks all begin at the same place of a page, and a cache has room for eight or twelve lines of one place: loops that
 * read twenty arrays side by side would push out their own. So each array begins some lines further on than the last. */
static size_t offset(size_t length)
{
    static unsigned arrays;
    if (length < 4 * PAGE) return 0;
    return __atomic_fetch_add(&arrays, 13, __ATOMIC_RELAXED) % (PAGE / ALIGNMENT) * ALIGNMENT;
}

void *memory_new(const char *label, int64_t count, size_t size)
{
    size_t length;
    void *whole = NULL;
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, &length) || length > PTRDIFF_MAX - 2 * PAGE)
        out_of_memory(label, count, size);
    const size_t ahead = ALIGNMENT + offset(length), rounded = (length / ALIGNMENT + 1) * ALIGNMENT;   /* also for count 0 */
    const bool large = rounded >= LARGE_ARRAY;
    if (posix_memalign(&whole, large ? LARGE_PAGE : ALIGNMENT, ahead + rounded) != 0) out_of_memory(label, count, size);
#ifdef MADV_HUGEPAGE
    if (large) madvise(whole, ahead + rounded, MADV_HUGEPAGE);   /* a wish: fewer faults and misses of the page table */
#endif
    char *pointer = (char *)whole + ahead;
    ((void **)pointer)[-1] = whole;
    zero(pointer, rounded);
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

void memory_free(void *pointer)
{
    if (pointer) free(((void **)pointer)[-1]);
}

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
