/* Selects the set of kernels (compiled for one instruction set) that the processor can run. */
#include "simd/simd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/simd/set.h"
#include "parts.h"

#ifdef __x86_64__
#include <cpuid.h>
#endif

static inline bool runs_anywhere(void) { return true; }
extern const struct kernel_set kernel_set_portable;

#ifdef __x86_64__
extern const struct kernel_set kernel_set_avx512, kernel_set_avx2;

/* Returns true if the processor reports all features in `bits` in register ecx of the leaf `leaf` of the cpuid
 * instruction. */
static inline bool responses(unsigned leaf, unsigned bits)
{
    unsigned a, b, c, d;
    return __get_cpuid(leaf, &a, &b, &c, &d) && (c & bits) == bits;
}

/* Returns true if the processor has all instructions of x86-64-v3. They are tested individually, since some compilers
 * do not know the names of the x86-64 levels, or of some instructions. */
static inline bool runs_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2") && responses(1, bit_F16C | bit_MOVBE) && responses(0x80000001, bit_LZCNT);
}

static inline bool runs_avx512(void)
{
    return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#endif

/* All sets of kernels that were built, the fastest first. The Makefile defines KERNELS_NAME for each set. */
const struct simd_set simd_sets[] = {
#ifdef KERNELS_avx512
    {"avx512", "AVX-512 (x86-64-v4), 8 doubles a vector", runs_avx512, &kernel_set_avx512},
#endif
#ifdef KERNELS_avx2
    {"avx2", "AVX2 with fused multiply-add (x86-64-v3), 4 doubles a vector", runs_avx2, &kernel_set_avx2},
#endif
#ifdef KERNELS_portable
#ifdef __x86_64__
    {"portable", "SSE2 (x86-64), 2 doubles a vector", runs_anywhere, &kernel_set_portable},
#else
    {"portable", "what the compiler assumes this processor is", runs_anywhere, &kernel_set_portable},
#endif
#endif
};
const int simd_set_count = COUNT_OF(simd_sets);

/* Pointers through which the program calls its kernels, one for each kernel and with its name, and the set to which
 * they belong (in_use). This selection is the only state that all runs of the program share. */
#define DEFINE(name) __typeof__(&*name) name;
KERNELS(DEFINE)
static const struct simd_set *in_use;

void simd_use_kernels(const struct simd_set *set)
{
    INVARIANT(set->runs());
#define TAKE(name) name = set->kernels->name;
    KERNELS(TAKE)
    in_use = set;
}

const struct simd_set *simd_current_kernels(void) { return in_use; }

/* Writes the names of all sets of kernels to text[size], separated by commas as in "avx2, portable", and returns text.
 * running: true to list only sets that this processor supports. */
static const char *names(bool running, char *text, size_t size)
{
    size_t length = 0;
    text[0] = 0;
    for (const struct simd_set *s = simd_sets; s < simd_sets + simd_set_count; s++)
        if (!running || s->runs())
            length += (size_t)snprintf(text + length, size - length, "%s%s", length > 0 ? ", " : "", s->name);
    return text;
}

status simd_select_kernels_for_processor(void)
{
    const char *asked = getenv("CLEAVE_SIMD");
    const struct simd_set *widest = NULL, *wanted = NULL;
    char text[64];
    for (const struct simd_set *s = simd_sets + simd_set_count; s-- > simd_sets;) {
        if (s->runs()) widest = s;
        if (asked && !strcmp(asked, s->name)) wanted = s;
    }
    if (!widest)
        return status_set(REFUSED,
                          "this build has no kernels for this processor, only %s; run `make` to build the missing ones",
                          names(false, text, sizeof text));
    simd_use_kernels(wanted && wanted->runs() ? wanted : widest);
    if (!asked || in_use == wanted) return OK;
    if (!wanted)
        return status_set(REFUSED, "CLEAVE_SIMD=%s: no such set of kernels; there are: %s", asked,
                          names(false, text, sizeof text));
    return status_set(REFUSED, "CLEAVE_SIMD=%s: this processor lacks %s; it supports: %s", asked, wanted->meaning,
                      names(true, text, sizeof text));
}

/* Selects the set of kernels before main starts, without a check of the result: main selects the kernels again and
 * reports a failure. */
__attribute__((constructor)) static void simd_start_set(void) { (void)simd_select_kernels_for_processor(); }
