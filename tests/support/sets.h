/* Every set of kernels that this processor can run, for tests of kernels:  FOR_EVERY_SET failures += ...; */
#ifndef CLEAVE_TESTS_SETS
#define CLEAVE_TESTS_SETS

#include <stdio.h>

#include "simd/simd.h"

/* Takes the next set that runs here; NULL at the end. Says which ones do not. */
static inline const struct simd_set *sets_next(const struct simd_set *set)
{
    for (; set < simd_sets + simd_set_count; set++) {
        if (set->runs()) {
            printf("kernels: %s\n", set->name);
            simd_use(set);
            return set;
        }
        printf("kernels: %s skipped, this processor lacks %s\n", set->name, set->meaning);
    }
    return NULL;
}

#define FOR_EVERY_SET for (const struct simd_set *set = sets_next(simd_sets); set; set = sets_next(set + 1))

#endif
