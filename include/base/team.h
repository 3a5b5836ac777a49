/* Threads, and sums that do not depend on their number. Only team.c uses hwloc (info.c reads its version). */
#ifndef CLEAVE_TEAM
#define CLEAVE_TEAM

#include "base.h"

/* Processor cores, caches and memory of the machine, as far as the affinity mask and the memory limits of this process
 * allow it to use them. */
struct machine {
    int cores, threads_allowed; /* physical cores; hardware threads in the process's mask */
    int64_t cache[4];           /* size of one L1d, L2, L3 cache (index 1 .. 3), 0 if unknown [byte] */
    int64_t memory;             /* memory that the process may use, 0 if unknown [byte] */
    char model[128];            /* name of the processor */
};

/* Sets the number of threads: `requested_threads` if > 0, else the value of OMP_NUM_THREADS, else the number of
 * physical cores that this process may use. Binds helper thread k >= 1 to the k-th of these cores if there are enough
 * and the user has set neither OMP_PROC_BIND nor OMP_PLACES. The calling thread moves to the first core, but is not
 * bound to it. Returns the number of threads. */
int threads_set_count_and_bind_to_cores(int requested_threads);

/* Returns the number of cores, the sizes of caches and memory, as far as this process may use them, and the name of the
 * processor. */
struct machine machine_properties(void);

/* Returns the name of the processor; does not read the topology of the machine again after
 * threads_set_count_and_bind_to_cores. */
const char *machine_processor_name(void);

/* Returns the memory [byte] that this process may use: the memory of the machine or, if a limit (ulimit, control group)
 * left less when threads_set_count_and_bind_to_cores was called, what this limit left. */
int64_t machine_memory_size(void);

/* Returns the name of the limit that machine_memory_size reports: "memory of the machine", "ulimit -v", ... */
const char *machine_memory_limit_describe_source(void);

/* Returns the number of physical cores that the process may use. */
int machine_physical_core_count(void);

/* Divides the cores that this process may use into `group_count` equal groups, for processes that the run side by side:
 * cpu_core_partition_bind_calling_thread binds each of them to one group. Returns NULL if there are fewer cores than
 * groups, or only one group. Release with cpu_core_partition_free. */
struct cpu_core_partition *cpu_core_partition_make(int group_count);

/* Binds the calling thread, and processes that this thread starts later, to group number `group_number` (from 0) of the
 * cores in the partition (cpu_core_partition_make). share_number = -1 restores the binding that the thread had before
 * the first call. Does nothing if `partition` is NULL. */
void cpu_core_partition_bind_calling_thread(const struct cpu_core_partition *partition, int group_number);

/* Releases the partition, the division of the processor cores into groups (cpu_core_partition_make). */
void cpu_core_partition_free(struct cpu_core_partition *partition);

/* Returns the time of the wall clock [s], from an arbitrary origin, to measure durations. */
double wall_clock_seconds(void);

/* Returns the processor time [s] that the calling thread has used; time taken by other programs does not count. */
double thread_cpu_clock_seconds(void);

/* SUM_BLOCK: number of terms per block of a reproducible sum; TERMS_MAX: largest number of sums that reproducible_sums
 * computes in one call. */
enum { SUM_BLOCK = 1024, TERMS_MAX = 8 };

/* Returns the sum of the terms term(context, i) for i = 0 .. term_count - 1. Terms are added in blocks of SUM_BLOCK,
 * and the sums of the blocks in order, so that the result has equal bits with any number of threads. `term` is called
 * by several threads at once and must not write. */
real reproducible_sum(int64_t term_count, real (*term)(const void *context, int64_t i), const void *context);

/* Computes `sum_count` <= TERMS_MAX sums over `term_count` terms in one pass into sum[sum_count], with bit-identical
 * results for any number of threads. add_block_of_terms(context, first, end, partial) must add the terms first .. end -
 * 1 of all sums to partial[sum_count]; several threads call it at once for different ranges, so that it must not write
 * to `context`. */
void reproducible_sums(int64_t term_count, int sum_count,
                       void (*add_block_of_terms)(const void *context, int64_t first, int64_t end, real *sum),
                       const void *context, real *sum);

/* Sections of a time step that are timed: forces of bonds (TIMER_BONDS), mapping of particles to the grid (SCATTER),
 * motion of grid nodes (GRID), mapping of the grid to particles (GATHER), conversion of material points (CONVERT),
 * samples of time series (SAMPLE), files (OUTPUT). timer_name[TIMERS]: name of each section for tables. */
enum timer { TIMER_BONDS, TIMER_SCATTER, TIMER_GRID, TIMER_GATHER, TIMER_CONVERT, TIMER_SAMPLE, TIMER_OUTPUT, TIMERS };
extern const char *const timer_name[TIMERS];

/* Timer of the sections of a time step. spent: time spent in each section so far [s]; last: wall clock at the last call
 * of timer_add_elapsed_to_section or timers_start [s]. */
struct timers {
    double last, spent[TIMERS];
};

/* Sets the time spent in each section of a time step, timers->spent, to 0 and starts timing the first section. */
void timers_start(struct timers *timers);

/* Adds the time since the last call of this function (or of timers_start) to timers->spent[section]: call it at the end
 * of a section of a time step. */
void timer_add_elapsed_to_section(struct timers *timers, enum timer section);

#endif
