/* Executes parallel regions of one thread as plain function calls. libgomp, the OpenMP library of gcc, creates a team
 * of threads for a single thread, too, and ends it by a system call to wake waiting threads, although there are none; a
 * run of few particles on one thread took 1.5 times as long (bar_pulse: 235 in place of 153 ms). In use only where the
 * linker replaces GOMP_parallel by this function (option --wrap, Makefile). */
#include <omp.h>

#if defined __GNUC__ && !defined __clang__

/* The function GOMP_parallel of libgomp, under the name that the linker's option --wrap gives it; NULL without this
 * option. region: function to execute on each thread, with the argument `data`; threads: number of threads, 0 for the
 * usual number; flags: of libgomp. */
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
