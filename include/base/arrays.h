/* Copies, fills, compares and sorts arrays that may be empty or overlap. The C library's functions must not be given
 * NULL, even for no bytes, and memcpy must not be given arrays that overlap. tests/house.sh requires these
 * functions. */
#ifndef CLEAVE_ARRAYS
#define CLEAVE_ARRAYS

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Copies `count` elements of `size` bytes from `from` to `to`. Does nothing if there are no bytes; the arrays may
 * overlap or be equal. */
static inline void array_copy(void *to, const void *from, int64_t count, size_t size)
{
    if (count > 0 && size > 0) memmove(to, from, (size_t)count * size);
}

/* Sets every byte of `count` elements of `size` bytes to `byte`. Does nothing if there are none. */
static inline void array_fill_bytes(void *array, int byte, int64_t count, size_t size)
{
    if (count > 0 && size > 0) memset(array, byte, (size_t)count * size);
}

/* Returns true if `count` elements of `size` bytes are equal to the last bit in both arrays, or if there are none. */
static inline bool arrays_equal(const void *a, const void *b, int64_t count, size_t size)
{
    return count <= 0 || size == 0 || memcmp(a, b, (size_t)count * size) == 0;
}

/* Sorts `count` elements of `size` bytes in the order of `compare`, as qsort. Does nothing if there are none. */
static inline void array_sort(void *array, int64_t count, size_t size, int (*compare)(const void *, const void *))
{
    if (count > 1) qsort(array, (size_t)count, size, compare);
}

#endif
