/* Parallel regions of one thread, without a team. libgomp makes a team for one thread, too, and ends it by a system
 * call that wakes those who wait: nobody. A run of few particles on one thread took half as long again (measured,
 * bar_pulse). Only where the linker puts this function in the place of GOMP_parallel (Makefile). */
#include <omp.h>

#if defined __GNUC__ && !defined __clang__

/* That of libgomp; NULL where the linker does not know it. */
void __real_GOMP_parallel(void (*region)(void *), void *data, unsigned threads, unsigned flags) __attribute__((weak));
void __wrap_GOMP_parallel(void (*region)(void *), void *data, unsigned threads, unsigned flags);

/* Calls `region` with `data` on each thread of a new team, as libgomp does. threads: number of threads, 0 for the usual
 * number; flags: passed on. One thread outside of all regions calls it without a team. */
void __wrap_GOMP_parallel(void (*region)(void *), void *data, unsigned threads, unsigned flags)
{
    const unsigned wanted = threads ? threads : (unsigned)omp_get_max_threads();
    if (wanted == 1 && omp_get_level() == 0)
        region(data);
    else
        __real_GOMP_parallel(region, data, threads, flags);
}

#endif
