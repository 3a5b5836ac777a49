/* Labelled, 64-byte aligned, zeroed arrays. Out of memory is answered here, once: one line that
 * names the label, the size and the memory used so far, and exit status 1. */
#ifndef CLEAVE_MEMORY
#define CLEAVE_MEMORY

#include "base.h"

/* `count` zeroed elements of `size` bytes, written first by the threads that will own them (static
 * partition). Never returns NULL; count 0 gives a valid pointer. Free with memory_free. */
void *memory_new(const char *label, int64_t count, size_t size);

/* The same without zeros, for what is written at once and whole by the threads that will own it. */
void *memory_bare(const char *label, int64_t count, size_t size);

/* The same for what is mostly never written: small pages, and only those that are written take memory. */
void *memory_sparse(const char *label, int64_t count, size_t size);

/* Zeros, of which most stay so: pages take memory when they are first written. */
void *memory_blank(const char *label, int64_t count, size_t size);

/* Grows or shrinks an array of memory_new; the first min(old, new) elements are kept, new ones are zero.
 * `pointer` may be NULL. */
void *memory_resize(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size);

/* Returns an array of at least `count` elements: `pointer` if it has so many, else a copy at least twice as long, whose
 * further elements are zero; `pointer` is freed. The number of elements that were allocated is stored with the array.
 * pointer: an array of memory_new, or NULL, which stays NULL for count 0. */
void *memory_grow(const char *label, void *pointer, int64_t count, size_t size);

/* Grows an array of memory_sparse or memory_bare; new elements are not written. */
void *memory_extend(const char *label, void *pointer, int64_t old_count, int64_t count, size_t size);

/* Frees; NULL is allowed. */
void memory_free(void *pointer);

/* Arrays that are freed may wait for others of about their size. For runs, which make the same arrays anew when
 * particles convert; set-up needs the memory that this takes. */
void memory_reuse(bool reuse);

/* High-water mark of the process as the operating system knows it [byte]. */
int64_t memory_peak(void);

/* What limits of the process (ulimit) and of its control groups leave it [byte], and the tightest of them; INT64_MAX:
 * there is none. */
struct memory_limit {
    int64_t bytes;
    const char *name;
};
struct memory_limit memory_limit(void);

#define NEW(label, count, type) ((type *)memory_new(label, count, sizeof(type)))
#define BLANK(label, count, type) ((type *)memory_blank(label, count, sizeof(type)))
#define BARE(label, count, type) ((type *)memory_bare(label, count, sizeof(type)))
/* Makes array[count - 1] an element that can be written. */
#define GROW(label, array, count) ((array) = memory_grow(label, array, count, sizeof *(array)))

#endif
