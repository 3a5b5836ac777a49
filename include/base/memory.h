/* Labelled, 64-byte aligned arrays. Out of memory is handled here: the program prints one line with the label, the size
 * and the memory used so far, and exits with status 1. */
#ifndef CLEAVE_MEMORY
#define CLEAVE_MEMORY

#include "base.h"

/* Allocates `count` zeroed elements of `size` bytes, 64-byte aligned. Each thread writes its part of the array first,
 * so that this part is in memory near the thread. Never returns NULL, not even for count 0: out of memory, the program
 * ends with a message that contains `label`. Release with memory_free. */
void *memory_new(const char *label, int64_t count, size_t size);

/* Allocates `count` elements of `size` bytes with undefined contents, to be written at once and completely by the
 * threads that will use them. Never returns NULL: out of memory, the program ends with a message that contains `label`.
 * Release with memory_free. */
void *memory_new_uninitialised(const char *label, int64_t count, size_t size);

/* Allocates `count` elements of `size` bytes with undefined contents, most of which will never be written: only pages
 * that are written take memory. Never returns NULL: out of memory, the program ends with a message that contains
 * `label`. Release with memory_free. */
void *memory_new_lazy_uninitialised(const char *label, int64_t count, size_t size);

/* Allocates `count` zeroed elements of `size` bytes, most of which will never be written: a page takes memory when it
 * is first written. Never returns NULL: out of memory, the program ends with a message that contains `label`. Release
 * with memory_free. */
void *memory_new_lazy_zeroed(const char *label, int64_t count, size_t size);

/* Changes the length of the array `pointer` of memory_new from old_count to `count` elements of `size` bytes and
 * returns the new array; `pointer` is invalid afterwards. The first elements are kept, additional elements are zero. If
 * `pointer` is NULL, a new array is allocated. label: name of the array for messages about memory. */
void *memory_resize(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size);

/* Returns an array of at least `count` elements of `size` bytes: `pointer` itself if it has so many, else a copy at
 * least twice as long, whose new elements are zero, and `pointer` is released. The number of allocated elements is
 * stored with the array. pointer: an array of memory_new, or NULL; NULL is returned if pointer is NULL and count 0.
 * label: name of the array for messages about memory. */
void *memory_ensure_capacity(const char *label, void *pointer, int64_t count, size_t size);

/* Grows an array of memory_new_lazy_uninitialised or memory_new_uninitialised from old_count to `count` elements of
 * `size` bytes and returns the array, which may have moved, so that `pointer` is invalid afterwards. The contents of
 * the new elements are undefined. label: name of the array for messages about memory. */
void *memory_resize_uninitialised(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size);

/* Releases the array at `pointer`, which one of the functions of this header has returned; does nothing if `pointer` is
 * NULL. */
void memory_free(void *pointer);

/* Sets whether memory_free keeps released arrays for later allocations of similar size (reuse true) or returns them to
 * the system (false), including those kept so far. Keeping them saves time in the time loop, which rebuilds equal
 * arrays whenever material points become peridynamic particles. */
void memory_set_reuse_of_freed_arrays(bool reuse);

/* Returns the largest resident size [byte] of the process so far, as the operating system reports it. */
int64_t memory_peak_resident_size(void);

/* The limit that leaves this process the least memory, from ulimit and control groups: bytes left (INT64_MAX: no limit)
 * and name of the limit. */
struct memory_limit {
    int64_t bytes;
    const char *name;
};

/* Returns the tightest limit of memory for this process, from ulimit and control groups: the bytes that are left
 * (INT64_MAX: no limit) and the name of the limit. */
struct memory_limit memory_limit(void);

/* Allocate `count` elements of the type `type` and return a pointer to the first one: NEW zeroed (memory_new), BLANK
 * zeroed, most of them never to be written (memory_new_lazy_zeroed), BARE with undefined contents
 * (memory_new_uninitialised). */
#define NEW(label, count, type) ((type *)memory_new(label, count, sizeof(type)))
#define BLANK(label, count, type) ((type *)memory_new_lazy_zeroed(label, count, sizeof(type)))
#define BARE(label, count, type) ((type *)memory_new_uninitialised(label, count, sizeof(type)))
/* Makes the array at least `count` elements long (memory_ensure_capacity); the variable `array` receives its new
 * address. */
#define GROW(label, array, count) ((array) = memory_ensure_capacity(label, array, count, sizeof *(array)))

#endif
