/* Room `simd`: which set of kernels is in use. It knows `base` and the kernels; the engine, commands and output call
 * it.
 *
 * The sets of kernels in this program (kernels/simd/kernel.h), by the vector instructions that they are
 * compiled for, and the one in use. Before main the widest one that the processor runs is taken, or what CLEAVE_SIMD
 * names. */
#ifndef CLEAVE_SIMD
#define CLEAVE_SIMD

#include "base/base.h"

struct simd_set {
    const char *name; /* as CLEAVE_SIMD says it */
    const char *meaning;
    bool (*runs)(void); /* does the processor have them? */
    const struct kernel_set *kernels;
};

/* The widest first. */
extern const struct simd_set simd_sets[];
extern const int simd_set_count;

/* Takes a set that runs here. Not while kernels run. */
void simd_use(const struct simd_set *set);
const struct simd_set *simd_in_use(void);

/* Takes the set that CLEAVE_SIMD names, else the widest that runs. REFUSED: there is no such set, or it cannot run
 * here. */
status simd_start(void);

#endif
