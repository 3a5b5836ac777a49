/* Copies, fills, compares and sorts arrays that may be empty or overlap. The C library's functions must not be given
 * NULL, even for no bytes, and memcpy must not be given arrays that overlap. tests/house.sh requires these
 * functions. */
#ifndef CLEAVE_ARRAYS
#define CLEAVE_ARRAYS

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Copies `count` elements of `size` bytes from array `from` to array `to`, which may overlap or be equal. Does nothing,
 * even for NULL, if count or size is 0. */
static inline void array_copy(void *to, const void *from, int64_t count, size_t size)
{
    if (count > 0 && size > 0) memmove(to, from, (size_t)count * size);
}

/* Sets every byte of `count` elements of `size` bytes in `array` to `byte`. Does nothing, even for NULL, if count or
 * size is 0. */
static inline void array_fill_bytes(void *array, int byte, int64_t count, size_t size)
{
    if (count > 0 && size > 0) memset(array, byte, (size_t)count * size);
}

/* Returns true if the arrays a and b of `count` elements of `size` bytes are equal in every bit, or if count or size
 * is 0. */
static inline bool arrays_equal(const void *a, const void *b, int64_t count, size_t size)
{
    return count <= 0 || size == 0 || memcmp(a, b, (size_t)count * size) == 0;
}

/* Sorts `count` elements of `size` bytes in `array`, in place, as qsort: compare(a, b) < 0 if *a precedes *b. Does
 * nothing, even for NULL, if count is below 2. */
static inline void array_sort(void *array, int64_t count, size_t size, int (*compare)(const void *, const void *))
{
    if (count > 1) qsort(array, (size_t)count, size, compare);
}

#endif
