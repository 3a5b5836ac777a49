/* Allocates aligned arrays, whose pages are first written by the threads that use them, and ends the program with a
 * message when memory is exhausted. */
#include "base/memory.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* Sizes [byte]. ALIGNMENT: of a cache line, and of the widest vector register; PIECE: of the pieces in which threads
 * first write to pages; PAGE, LARGE_PAGE: of a page and of a large page; LARGE_ARRAY: of the smallest array on large
 * pages; SMALL_TAIL: of the end of an array that has small pages. On a virtual machine the system takes 18 us to
 * provide a page, and 0.2 to 2 ms for a large one, which replaces 512 (measured). */
enum { ALIGNMENT = 64, PIECE = 65536, PAGE = 4096, LARGE_PAGE = 2 << 20, LARGE_ARRAY = 3 << 19, SMALL_TAIL = 1 << 20 };

/* HEAP_ALONE: 1 if no array has pages of its own from mmap, as under the address sanitizer, which watches the heap
 * only. */
#if defined __SANITIZE_ADDRESS__
enum { HEAP_ALONE = 1 };
#else
enum { HEAP_ALONE = 0 };
#endif

/* Size from which an array has pages of its own instead of a part of the heap [byte]. Reused heap pages would be in the
 * memory of the processor whose threads wrote to them first. New pages are zero, so that zeros need not be written. */
enum { OWN_PAGES = 1 << 20 };
/* Limits of the store of released blocks. KEPT: largest number of blocks; KEPT_LEAST, KEPT_MOST: smallest and largest
 * size of a block [byte]; KEPT_ALL: largest size of the used pages of all blocks [byte]. A block in the store is used
 * again for an array of similar size, mostly for the rebuilt version of the released array. This saves time because the
 * system takes longer to provide a page than a thread takes to write it. */
enum { KEPT = 256, KEPT_LEAST = 1 << 17, KEPT_MOST = 64 << 20, KEPT_ALL = 192 << 20 };

/* Number of elements for which the first growth of an array allocates memory. */
enum { GROWN_FIRST = 16 };

/* Header that is stored before each array: the memory block that contains the array. */
struct block {
    void *whole;    /* address of the block, to release it */
    size_t mapped;  /* length of the pages of the block [byte]; 0: it is a part of the heap */
    size_t length;  /* length of the array [byte] */
    size_t touched; /* largest length of these pages that an array has used so far [byte] */
    bool large;     /* the block has large pages; it then consists of several mappings, which mremap cannot extend */
};
_Static_assert(sizeof(struct block) <= ALIGNMENT, "there is room for it");

static _Noreturn void out_of_memory(const char *label, int64_t count, size_t size)
{
    fprintf(stderr,
            "out of memory: the array %s needs %lld entries of %zu bytes, and %.1f MB are already in use; use a larger "
            "particles.spacing, or a machine with more memory\n",
            label, (long long)count, size, (double)memory_peak_resident_size() * 1e-6);
    _exit(FAILED);
}

/* Writes zeros to an array of `length` bytes. Threads write pieces of PIECE bytes in the static partition of the loops
 * that will use the array, so that each page is in the memory of the processor whose thread uses it. fresh: true for
 * new pages, which are zero already; then only one byte per page is written. */
static void zero(char *bytes, size_t length, bool fresh)
{
    int64_t pieces = (int64_t)((length + PIECE - 1) / PIECE);
    if (pieces < 2) {
        if (!fresh) memset(bytes, 0, length);
        return;
    }
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < pieces; k++) {
        size_t first = (size_t)k * PIECE, end = length - first < PIECE ? length : first + PIECE;
        if (!fresh) memset(bytes + first, 0, end - first);
        for (size_t at = first; fresh && at < end; at += PAGE) ((volatile char *)bytes)[at] = 0;
    }
}

/* Returns the offset of an array of `length` bytes from the beginning of its memory block [byte]. Without offsets all
 * large arrays would begin at the same address within a page. A loop over twenty arrays would then evict its own cache
 * lines, since a cache set has only eight or twelve. So each array begins some lines further on than the previous one.
 * (Measured on two cores: material points on a background grid take 6 % less time in 2D and 16 % less in 3D, bonds
 * equal time.) */
static size_t offset(size_t length)
{
    static unsigned arrays;
    if (length < 4 * PAGE) return 0;
    return __atomic_fetch_add(&arrays, 13, __ATOMIC_RELAXED) % (PAGE / ALIGNMENT) * ALIGNMENT;
}

#ifdef MAP_ANONYMOUS
/* The store of released memory blocks. waiting: the blocks; waiting_longest: index of the oldest block; waiting_bytes:
 * size of their used pages [byte]; reusing: true while the store is in use. */
static struct block waiting[KEPT];
static int waiting_longest;
static size_t waiting_bytes;
static bool reusing;

/* Returns the size of the pages that are reserved for an array of `length` bytes [byte]. The sizes are in steps of at
 * most a quarter, so that the released block of an array can be used again for a slightly larger one. Pages beyond the
 * end of the array are never written and thus take no memory. */
static size_t room_of(size_t length)
{
    size_t step = OWN_PAGES / 4;
    while (step * 8 <= length) step *= 2;
    return (length + step - 1) / step * step;
}

/* Takes a block out of the store of released blocks (memory kept for new arrays): the smallest one of at least `least`
 * and at most 4 `least` bytes. large: true to consider only blocks with large pages, false only those without. Returns
 * the block, now owned by the caller, or a block with `whole` NULL if none fits. */
static struct block take_kept(size_t least, bool large)
{
    struct block block = {0};
#pragma omp critical(memory_kept)
    {
        int best = -1;
        for (int k = 0; k < KEPT; k++)
            if (waiting[k].mapped >= least && waiting[k].mapped / 4 <= least && waiting[k].large == large &&
                (best < 0 || waiting[k].mapped < waiting[best].mapped))
                best = k;
        if (best >= 0) block = waiting[best], waiting[best] = (struct block){0}, waiting_bytes -= block.touched;
    }
    return block;
}

/* Adds a released block to the store of released blocks (memory kept for new arrays), in place of the oldest one. The
 * oldest ones are returned to the system, until the store holds at most KEPT_ALL bytes. If the store is not in use, or
 * the block is larger than KEPT_MOST bytes, the block itself is returned to the system. */
static void memory_keep(struct block block)
{
    if (!reusing || block.mapped > KEPT_MOST) {
        munmap(block.whole, block.mapped);
        return;
    }
#pragma omp critical(memory_kept)
    do {
        const struct block oldest = waiting[waiting_longest];
        waiting[waiting_longest] = block;
        waiting_bytes += block.touched - oldest.touched;
        if (oldest.whole) munmap(oldest.whole, oldest.mapped);
        block = (struct block){0};
        waiting_longest = (waiting_longest + 1) % KEPT;
    } while (waiting_bytes > KEPT_ALL);
}

/* Returns all blocks in the store of released blocks (memory kept for new arrays) to the system. The store is empty
 * afterwards. */
static void keep_none(void)
{
    waiting_longest = 0;
#pragma omp critical(memory_kept)
    for (int k = 0; k < KEPT; k++) {
        if (waiting[k].whole) munmap(waiting[k].whole, waiting[k].mapped);
        waiting[k] = (struct block){0};
    }
    waiting_bytes = 0;
}
#endif

/* Returns `length` bytes at a multiple of `alignment`, and the block that contains them in *block; NULL if memory is
 * exhausted. anew: true to take new pages instead of a block from the store of released blocks. *fresh: receives
 * whether the bytes are zero. */
static char *memory_block_make(struct block *block, size_t length, size_t alignment, bool anew, bool *fresh)
{
    *block = (struct block){0}, *fresh = false;
#ifdef MAP_ANONYMOUS
    if (!HEAP_ALONE && length >= (size_t)(reusing ? KEPT_LEAST : OWN_PAGES)) {
        const size_t beside = alignment > PAGE ? alignment : 0,
                     room = room_of(reusing ? length + length / 2 : length) + beside;
        if (!anew) *block = take_kept(length + beside, alignment > PAGE);
        if (!block->whole) {
            void *pages = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
            if (pages == MAP_FAILED) return NULL;
            *block = (struct block){.whole = pages, .mapped = room}, *fresh = true;
        }
        return (char *)(((uintptr_t)block->whole + alignment - 1) / alignment * alignment);
    }
#endif
    if (posix_memalign(&block->whole, alignment, length) != 0) block->whole = NULL;
    return block->whole;
}

/* Content of a new array. ZEROED: all zero; WRITTEN_SOON: undefined, to be written soon; MOSTLY_UNWRITTEN: undefined,
 * for the most part never written; MOSTLY_ZERO: zero, for the most part never written. */
enum content { ZEROED, WRITTEN_SOON, MOSTLY_UNWRITTEN, MOSTLY_ZERO };

/* Allocates an array of `count` elements of `size` bytes, aligned to a cache line, with a header (struct block) before
 * it, and returns the array. content: states whether its bytes must be zero, and whether most of them will never be
 * written. If memory is exhausted, ends the program with a message that names the array by `label`. */
static void *array_make(const char *label, int64_t count, size_t size, enum content content)
{
    size_t length;
    struct block block;
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, &length) || length > PTRDIFF_MAX - 2 * LARGE_PAGE)
        out_of_memory(label, count, size);
    /* +1: also for count 0 */
    const size_t ahead = ALIGNMENT + offset(length), rounded = (length / ALIGNMENT + 1) * ALIGNMENT;
    const bool sparse = content == MOSTLY_UNWRITTEN || content == MOSTLY_ZERO;
    const bool large = rounded >= LARGE_ARRAY && !sparse;
    bool fresh;
    char *from =
        memory_block_make(&block, ahead + rounded, large ? LARGE_PAGE : ALIGNMENT, content == MOSTLY_ZERO, &fresh);
    if (!block.whole) out_of_memory(label, count, size);
#ifdef MADV_HUGEPAGE
    if (large) /* advisory: fewer page faults and TLB misses */
        madvise(from, (ahead + rounded + LARGE_PAGE - SMALL_TAIL) / LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE);
    if (sparse && block.mapped > 0) madvise(block.whole, block.mapped, MADV_NOHUGEPAGE);
#endif
    char *pointer = from + ahead;
    if (content == ZEROED) zero(pointer, rounded, fresh);
    if (content == MOSTLY_ZERO && !fresh) memset(pointer, 0, rounded);
    block.length = length, block.large = large;
    if (block.touched < ahead + rounded) block.touched = ahead + rounded;
    memcpy(pointer - sizeof block, &block, sizeof block);
    return pointer;
}

void *memory_new(const char *label, int64_t count, size_t size) { return array_make(label, count, size, ZEROED); }
void *memory_new_uninitialised(const char *label, int64_t count, size_t size)
{
    return array_make(label, count, size, WRITTEN_SOON);
}
void *memory_new_lazy_uninitialised(const char *label, int64_t count, size_t size)
{
    return array_make(label, count, size, MOSTLY_UNWRITTEN);
}

void *memory_new_lazy_zeroed(const char *label, int64_t count, size_t size)
{
    return array_make(label, count, size, MOSTLY_ZERO);
}

/* Extends the array `pointer` from old_length to `length` bytes within the pages that it owns, without moving it, and
 * sets the new bytes to 0. Returns true on success. Returns false, and changes nothing, if the array has no pages of
 * its own, these are too short, or `length` is smaller than old_length. */
static bool array_extend(void *pointer, size_t old_length, size_t length)
{
    struct block block;
    memcpy(&block, (char *)pointer - sizeof block, sizeof block);
    const size_t ahead = (size_t)((char *)pointer - (char *)block.whole),
                 rounded = (length / ALIGNMENT + 1) * ALIGNMENT;
    if (length < old_length || ahead + rounded > block.mapped) return false;
    memset((char *)pointer + old_length, 0, rounded - old_length);
    block.length = length;
    if (block.touched < ahead + rounded) block.touched = ahead + rounded;
    memcpy((char *)pointer - sizeof block, &block, sizeof block);
    return true;
}

void *memory_resize(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size)
{
    size_t length;
    INVARIANT(pointer == NULL || old_count >= 0);
    if (pointer && !__builtin_mul_overflow((size_t)count, size, &length) && length < PTRDIFF_MAX / 2 &&
        array_extend(pointer, (size_t)old_count * size, length))
        return pointer;
    char *grown = memory_new(label, count, size);
    int64_t kept = old_count < count ? old_count : count;
    if (pointer != NULL && kept > 0) memcpy(grown, pointer, (size_t)kept * size);
    memory_free(pointer);
    return grown;
}

void *memory_ensure_capacity(const char *label, void *pointer, int64_t count, size_t size)
{
    struct block block = {0};
    if (pointer) memcpy(&block, (char *)pointer - sizeof block, sizeof block);
    const int64_t room = (int64_t)(block.length / size), more = room > 0 ? 2 * room : GROWN_FIRST;
    return count <= room ? pointer : memory_resize(label, pointer, room, count > more ? count : more, size);
}

/* Extends the pages of the array *pointer to at least `length` bytes. The system may move the pages to another address,
 * but nothing is copied, and unwritten pages remain unwritten. Updates *pointer and *block, the header of the array.
 * Returns false, and changes nothing, if the array has no pages of its own (it is on the heap) or the system cannot
 * extend them. */
static bool pages_extend(struct block *block, char **pointer, size_t length)
{
#ifdef MREMAP_MAYMOVE
    const size_t ahead = (size_t)(*pointer - (char *)block->whole), room = room_of(ahead + length);
    if (block->mapped >= ahead + length) return true;
    void *pages = block->mapped > 0 ? mremap(block->whole, block->mapped, room, MREMAP_MAYMOVE) : MAP_FAILED;
    if (pages == MAP_FAILED) return false;
    block->whole = pages, block->mapped = room;
    *pointer = (char *)pages + ahead;
    return true;
#else
    (void)block, (void)pointer, (void)length;
    return false;
#endif
}

void *memory_resize_uninitialised(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size)
{
    struct block block;
    char *array = pointer;
    size_t length;
    INVARIANT(pointer && old_count <= count);
    memcpy(&block, array - sizeof block, sizeof block);
    if (__builtin_mul_overflow((size_t)count, size, &length) || length > PTRDIFF_MAX - 2 * LARGE_PAGE)
        out_of_memory(label, count, size);
    if (pages_extend(&block, &array, (length / ALIGNMENT + 1) * ALIGNMENT)) {
        block.length = length;
        if (block.touched < length) block.touched = length;
        memcpy(array - sizeof block, &block, sizeof block);
        return array;
    }
    array = memory_new_lazy_uninitialised(label, count, size);
    memcpy(array, pointer, (size_t)old_count * size);
    memory_free(pointer);
    return array;
}

void memory_free(void *pointer)
{
    struct block block;
    if (!pointer) return;
    memcpy(&block, (char *)pointer - sizeof block, sizeof block);
#ifdef MAP_ANONYMOUS
    if (block.mapped > 0) {
        memory_keep(block);
        return;
    }
#endif
    free(block.whole);
}

void memory_set_reuse_of_freed_arrays(bool reuse)
{
#ifdef __GLIBC__ /* the heap neither gives back pages nor merges small pieces whenever a large one is released */
    if (reuse) mallopt(M_TRIM_THRESHOLD, KEPT_ALL), mallopt(M_MXFAST, 0);
#endif
#ifdef MAP_ANONYMOUS
    reusing = reuse;
    if (!reuse) keep_none();
#else
    (void)reuse;
#endif
}

/* Returns the largest memory that this process has used so far [byte]; 0 if unknown. Reads VmHWM in /proc/self/status,
 * which counts this program alone; ru_maxrss would include the program that started it. */
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

int64_t memory_peak_resident_size(void)
{
    int64_t peak = peak_of_program();
    if (peak > 0) return peak;
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return usage.ru_maxrss; /* bytes there, kilobytes elsewhere */
#else
    return (int64_t)usage.ru_maxrss * 1024;
#endif
}
