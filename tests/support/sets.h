/* Loop over the kernel sets (kernels compiled for one set of vector instructions) that this processor can run:
 * FOR_EVERY_SET failures += ...; */
#ifndef CLEAVE_TESTS_SETS
#define CLEAVE_TESTS_SETS

#include <stdio.h>

#include "simd/simd.h"

/* Finds the first kernel set (kernels compiled for one set of vector instructions), from the entry `set` of the table
 * simd_sets on, that this processor can run, makes it the set in use, and returns it; NULL if there is none. Prints
 * which sets are used and skipped. */
static inline const struct simd_set *sets_next(const struct simd_set *set)
{
    for (; set < simd_sets + simd_set_count; set++) {
        if (set->runs()) {
            printf("kernels: %s\n", set->name);
            simd_use_kernels(set);
            return set;
        }
        printf("kernels: %s skipped, this processor lacks %s\n", set->name, set->meaning);
    }
    return NULL;
}

/* Head of a loop that runs its body once with each kernel set that this processor can run in use. */
#define FOR_EVERY_SET for (const struct simd_set *set = sets_next(simd_sets); set; set = sets_next(set + 1))

#endif
