/* Room `simd` (folders include/simd and src/simd): selects the set of kernels that the program uses. It uses `base` and
 * the kernels; the engine, commands and output call it.
 *
 * The kernels (hot loops) are compiled once for each set of vector instructions (kernels/simd/kernel.h). Before main
 * the widest set that the processor supports is selected, or the one named by CLEAVE_SIMD. */
#ifndef CLEAVE_SIMD
#define CLEAVE_SIMD

#include "base/base.h"

/* A set of kernels, the hot loops compiled for one set of vector instructions. */
struct simd_set {
    const char *name;    /* name in CLEAVE_SIMD */
    const char *meaning; /* the instructions, in words */
    bool (*runs)(void);  /* returns true if the processor supports the instructions */
    const struct kernel_set *kernels;
};

/* All sets of kernels in this program, the one with the widest vectors first. */
extern const struct simd_set simd_sets[];
extern const int simd_set_count;

/* Makes all kernel calls use the set of kernels `set` (hot loops compiled for one set of vector instructions) from now
 * on. The processor must support it (set->runs()). Must not be called while kernels run. */
void simd_use_kernels(const struct simd_set *set);

/* Returns the set of kernels (hot loops compiled for one set of vector instructions) that kernel calls currently use.
 */
const struct simd_set *simd_current_kernels(void);

/* Selects the set of kernels named by the environment variable CLEAVE_SIMD, or, if it is not set, the one with the
 * widest vectors that the processor supports. Returns REFUSED, with a message, if no set has that name, or the
 * processor does not support that set or any other. */
status simd_select_kernels_for_processor(void);

#endif
