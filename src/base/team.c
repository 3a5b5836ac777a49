/* Implements the team of threads on the cores of the machine, sums that are independent of the number of threads, and
 * clocks. */
#include "base/team.h"

#include <hwloc.h>
#include <omp.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#ifdef __SSE__
#include <immintrin.h>
#endif

#include "base/memory.h"

/* ---- the machine ------------------------------------------------------------------------------------------------- */

/* The topology of the machine from hwloc, and the hardware threads that this process may use. */
struct place {
    hwloc_topology_t topology;
    hwloc_bitmap_t mask; /* hardware threads the process may run on */
};

/* Memory of the machine, or the smallest limit of this process below it. It is read once, because reading takes about 6
 * ms, as long as a hundred steps of a small input file. In a container hwloc may not report the memory, and in a
 * virtual machine only its initial part; the value from the operating system is then used. */
static struct memory_limit memory;

/* The name of the processor, "" before the topology of the machine has been read. */
static char processor[128];

/* Stores in `memory` the memory of the machine [byte], or the smallest limit of this process if that is lower, with a
 * text that states which of both it is. topology: topology of the machine from hwloc, which states its memory; NULL:
 * only the operating system is asked. */
static void note_memory(hwloc_topology_t topology)
{
    const int64_t seen = topology ? (int64_t)hwloc_get_root_obj(topology)->total_memory : 0;
    const int64_t told = (int64_t)sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
    const int64_t all = seen > told ? seen : told;
    const struct memory_limit limit = memory_limit();
    memory = limit.bytes < all ? limit : (struct memory_limit){all, "memory of the machine"};
}

/* Stores the name of the processor from hwloc's topology of the machine in `processor`; "unknown processor" if hwloc
 * does not have it. */
static void note_processor(hwloc_topology_t topology)
{
    hwloc_obj_t package = hwloc_get_next_obj_by_type(topology, HWLOC_OBJ_PACKAGE, NULL);
    const char *name = package != NULL ? hwloc_obj_get_info_by_name(package, "CPUModel") : NULL;
    if (name == NULL) name = hwloc_obj_get_info_by_name(hwloc_get_root_obj(topology), "CPUModel");
    snprintf(processor, sizeof processor, "%s", name != NULL ? name : "unknown processor");
}

/* Returns physical core number k, from 0, of those that this process may use (place->mask); NULL if there are no more
 * than k. */
static hwloc_obj_t core_at(const struct place *place, int k)
{
    hwloc_obj_t core = NULL;
    while ((core = hwloc_get_next_obj_by_type(place->topology, HWLOC_OBJ_CORE, core)) != NULL)
        if (hwloc_bitmap_intersects(core->cpuset, place->mask) && k-- == 0) return core;
    return NULL;
}

/* Moves the calling thread to the first core that this process may use (place->mask), then allows it all of them again.
 * Does nothing if the cores are not known. Reading the topology visits every core and leaves the thread on the last
 * one, where it would share the core with another thread for about 20 ms, until the scheduler moves it. */
static void rebind_main(const struct place *place)
{
    const hwloc_obj_t core = core_at(place, 0);
    if (!core) return;
    hwloc_bitmap_t home = hwloc_bitmap_dup(core->cpuset);
    hwloc_bitmap_and(home, home, place->mask);
    hwloc_set_cpubind(place->topology, home, HWLOC_CPUBIND_THREAD);
    hwloc_set_cpubind(place->topology, place->mask, HWLOC_CPUBIND_THREAD);
    hwloc_bitmap_free(home);
}

/* Reads the topology of the machine and the hardware threads that this process may use into *place, and notes the
 * memory of the machine and the name of the processor. Returns false, with nothing to release, if hwloc fails. */
static bool place_make(struct place *place)
{
    setenv("HWLOC_HIDE_ERRORS", "2", 0); /* a machine that hides its topology is no fault of the run */
    /* plugins search for graphics cards and the like: 3 MB and up to 60 ms for nothing needed here */
    setenv("HWLOC_PLUGINS_PATH", "", 0);
    note_memory(NULL);
    if (hwloc_topology_init(&place->topology) != 0) return false;
    if (hwloc_topology_load(place->topology) != 0) {
        hwloc_topology_destroy(place->topology);
        return false;
    }
    note_memory(place->topology);
    note_processor(place->topology);
    hwloc_const_cpuset_t allowed = hwloc_topology_get_allowed_cpuset(place->topology);
    place->mask = hwloc_bitmap_alloc();
    if (hwloc_get_cpubind(place->topology, place->mask, HWLOC_CPUBIND_THREAD) != 0)
        hwloc_bitmap_copy(place->mask, allowed);
    hwloc_bitmap_and(place->mask, place->mask, allowed);
    if (hwloc_bitmap_iszero(place->mask)) hwloc_bitmap_copy(place->mask, allowed);
    rebind_main(place);
    return true;
}

static void place_free(struct place *place)
{
    hwloc_bitmap_free(place->mask);
    hwloc_topology_destroy(place->topology);
}

/* Returns the number of physical cores that this process may use (place->mask). If hwloc sees no cores, as in some
 * virtual machines, returns the number of hardware threads instead. */
static int core_count(const struct place *place)
{
    int cores = 0;
    while (core_at(place, cores) != NULL) cores++;
    return cores > 0 ? cores : hwloc_bitmap_weight(place->mask);
}

static int64_t cache_size(hwloc_topology_t topology, hwloc_obj_type_t level)
{
    hwloc_obj_t cache = hwloc_get_obj_by_depth(topology, hwloc_get_type_depth(topology, level), 0);
    return cache != NULL ? (int64_t)cache->attr->cache.size : 0;
}

struct machine machine_properties(void)
{
    struct machine m = {.cores = omp_get_num_procs(), .threads_allowed = omp_get_num_procs()};
    struct place place;
    const bool known = place_make(&place);
    snprintf(m.model, sizeof m.model, "unknown processor");
    m.memory = memory.bytes;
    if (!known) return m;
    m.cores = core_count(&place);
    m.threads_allowed = hwloc_bitmap_weight(place.mask);
    m.cache[1] = cache_size(place.topology, HWLOC_OBJ_L1CACHE);
    m.cache[2] = cache_size(place.topology, HWLOC_OBJ_L2CACHE);
    m.cache[3] = cache_size(place.topology, HWLOC_OBJ_L3CACHE);
    snprintf(m.model, sizeof m.model, "%s", processor);
    place_free(&place);
    return m;
}

int64_t machine_memory_size(void) { return memory.bytes > 0 ? memory.bytes : machine_properties().memory; }

const char *machine_processor_name(void)
{
    if (!*processor) (void)machine_properties();
    return *processor ? processor : "unknown processor";
}

const char *machine_memory_limit_describe_source(void)
{
    (void)machine_memory_size();
    return memory.name;
}

/* ---- the team ---------------------------------------------------------------------------------------------------- */

/* Binds each of the `threads` threads of the team, except the calling one, to a core of its own, or to all allowed
 * cores if there are fewer cores than threads. The calling thread remains free: its mask shows later calls, for other
 * team sizes, what the process may use, and programs that it starts inherit it. place: cores that the process may
 * use. */
static void bind_helpers(const struct place *place, int threads)
{
    bool apart = core_at(place, threads - 1) != NULL;
#pragma omp parallel num_threads(threads)
    {
        int k = omp_get_thread_num();
        hwloc_bitmap_t mine = hwloc_bitmap_dup(place->mask);
        if (apart) hwloc_bitmap_and(mine, mine, core_at(place, k)->cpuset);
        if (k > 0) hwloc_set_cpubind(place->topology, mine, HWLOC_CPUBIND_THREAD); /* advisory: refusal does no harm */
        hwloc_bitmap_free(mine);
    }
}

static bool user_binds(void) { return getenv("OMP_PROC_BIND") != NULL || getenv("OMP_PLACES") != NULL; }

/* Returns the number of threads for which OMP_PLACES, if the user has set it, provides hardware threads, at most
 * omp_get_max_threads(). Returns omp_get_max_threads() if OMP_PLACES is not set. */
static int bound_threads(void)
{
    int held = 0, most = omp_get_max_threads();
    for (int k = 0; k < omp_get_num_places(); k++) held += omp_get_place_num_procs(k);
    return held > 0 && held < most ? held : most;
}

/* Makes each of the `threads` threads of the team treat denormal numbers as 0. Ahead of a wave, values mapped from node
 * to node fall below 1e-308 within some steps, and operations on denormal numbers take a hundred times as long. Does
 * nothing on processors without SSE. */
static void flush_tiny_numbers(int threads)
{
#ifdef __SSE__
#pragma omp parallel num_threads(threads)
    _mm_setcsr(_mm_getcsr() | 0x8040); /* results, and operands */
#else
    (void)threads;
#endif
}

/* Start routine of the threads that threads_start creates: waits until the mutex `mutex` is unlocked. */
static void *wait_for(void *mutex)
{
    pthread_mutex_lock(mutex);
    pthread_mutex_unlock(mutex);
    return NULL;
}

enum { LIBRARY_ROOM = 16 << 20 }; /* memory that the OpenMP library may allocate besides stacks [byte] */

/* Returns true if `threads` threads can exist at once with LIBRARY_ROOM bytes of memory to spare; tests this by
 * starting and ending them. If they cannot, the OpenMP library would end the process with several lines of its own. */
static bool threads_start(int threads)
{
    void *room =
        threads > 1 ? mmap(NULL, LIBRARY_ROOM, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) : NULL;
    pthread_mutex_t all = PTHREAD_MUTEX_INITIALIZER;
    pthread_t *made = malloc((size_t)threads * sizeof *made);
    int n = 0;
    pthread_mutex_lock(&all);
    while (made && n < threads - 1 && pthread_create(&made[n], NULL, wait_for, &all) == 0) n++;
    pthread_mutex_unlock(&all);
    for (int k = 0; k < n; k++) pthread_join(made[k], NULL);
    const bool started = made && n == threads - 1 && room != MAP_FAILED;
    free(made);
    if (room && room != MAP_FAILED) munmap(room, LIBRARY_ROOM);
    return started;
}

int threads_set_count_and_bind_to_cores(int requested_threads)
{
    struct place place;
    bool known = place_make(&place);
    if (requested_threads <= 0) {
        /* a process bound to places sees only one of them in its mask: count threads by places */
        if (getenv("OMP_NUM_THREADS") != NULL)
            requested_threads = omp_get_max_threads();
        else if (user_binds())
            requested_threads = bound_threads();
        else
            requested_threads = known ? core_count(&place) : omp_get_num_procs();
    }
    if (!threads_start(requested_threads)) {
        fprintf(stderr,
                "%d threads cannot be started: memory for their stacks is missing, or a limit of processes is reached; "
                "choose fewer with -t\n",
                requested_threads);
        _exit(FAILED);
    }
    omp_set_dynamic(0); /* a fixed number: partitions must not change between loops */
    omp_set_num_threads(requested_threads);
    flush_tiny_numbers(requested_threads);
    if (known) {
        if (!user_binds()) bind_helpers(&place, requested_threads);
        place_free(&place);
    }
    return requested_threads;
}

/* ---- shares of the cores ----------------------------------------------------------------------------------------- */

/* A machine whose physical cores are divided into shares. n: number of shares; cores: number of cores. */
struct cpu_core_partition {
    struct place place;
    int n, cores;
};

int machine_physical_core_count(void)
{
    struct place place;
    if (!place_make(&place)) return omp_get_num_procs();
    const int cores = core_count(&place);
    place_free(&place);
    return cores;
}

struct cpu_core_partition *cpu_core_partition_make(int group_count)
{
    struct cpu_core_partition *partition = NEW("team.shares", 1, struct cpu_core_partition);
    if (place_make(&partition->place)) {
        partition->n = group_count;
        partition->cores = core_count(&partition->place);
        if (group_count > 1 && group_count <= partition->cores && core_at(&partition->place, partition->cores - 1))
            return partition;
        place_free(&partition->place);
    }
    memory_free(partition);
    return NULL;
}

void cpu_core_partition_bind_calling_thread(const struct cpu_core_partition *partition, int group_number)
{
    if (!partition || group_number >= partition->n) return;
    hwloc_bitmap_t mine = hwloc_bitmap_alloc();
    const int first = group_number < 0 ? 0 : group_number * partition->cores / partition->n;
    const int end = group_number < 0 ? partition->cores : (group_number + 1) * partition->cores / partition->n;
    for (int k = first; k < end; k++) hwloc_bitmap_or(mine, mine, core_at(&partition->place, k)->cpuset);
    hwloc_bitmap_and(mine, mine, partition->place.mask);
    hwloc_set_cpubind(partition->place.topology, group_number < 0 ? partition->place.mask : mine, HWLOC_CPUBIND_THREAD);
    hwloc_bitmap_free(mine);
}

void cpu_core_partition_free(struct cpu_core_partition *partition)
{
    if (!partition) return;
    place_free(&partition->place);
    memory_free(partition);
}

/* ---- sums -------------------------------------------------------------------------------------------------------- */

/* FEW_BLOCKS: largest number of blocks of a sum for which no memory is allocated, since each time step computes several
 * short sums. FEW_TERMS: largest number of terms that the threads compute one by one before they are added. */
enum { FEW_BLOCKS = 16, FEW_TERMS = 4 * SUM_BLOCK };

/* Computes `terms` sums over block number b, from 0, of the entries 0 .. n - 1, and stores them in part[terms]. A block
 * has SUM_BLOCK entries, the last one fewer. block(context, first, end, sum): adds the terms of the entries first ..
 * end - 1 to sum[terms]. */
static void sum_block(int64_t n, int terms, void (*block)(const void *context, int64_t first, int64_t end, real *sum),
                      const void *context, int64_t b, real *part)
{
    const int64_t first = b * SUM_BLOCK, end = first + SUM_BLOCK;
    real own[TERMS_MAX] = {0};
    block(context, first, end < n ? end : n, own);
    for (int k = 0; k < terms; k++) part[k] = own[k];
}

void reproducible_sums(int64_t term_count, int sum_count,
                       void (*add_block_of_terms)(const void *context, int64_t first, int64_t end, real *sum),
                       const void *context, real *sum)
{
    int64_t blocks = (term_count + SUM_BLOCK - 1) / SUM_BLOCK;
    real few[FEW_BLOCKS * TERMS_MAX], *part = blocks <= FEW_BLOCKS ? few : NEW("team.sums", blocks * sum_count, real);
    INVARIANT(sum_count <= TERMS_MAX);
    TEAM_LOOP(blocks > 1, for (int64_t b = 0; b < blocks; b++)
                              sum_block(term_count, sum_count, add_block_of_terms, context, b, part + b * sum_count););
    for (int k = 0; k < sum_count; k++) sum[k] = 0;
    for (int64_t b = 0; b < blocks; b++)
        for (int k = 0; k < sum_count; k++) sum[k] += part[b * sum_count + k];
    if (part != few) memory_free(part);
}

/* Terms of one sum: term(context, i) returns term number i. */
struct single {
    real (*term)(const void *context, int64_t i);
    const void *context;
};

/* Computes the terms s->term(s->context, i), i = 0 .. n - 1, of a sum and stores them in each[n]. Threads divide single
 * terms among them instead of blocks of terms, because n is small and each term may take long. */
static void terms_store(int64_t n, const struct single *s, real *each)
{
    TEAM_LOOP(n > 1, for (int64_t i = 0; i < n; i++) each[i] = s->term(s->context, i););
}

static void single_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct single *s = context;
    for (int64_t i = first; i < end; i++) sum[0] += s->term(s->context, i);
}

/* Returns element i, from 0, of an array of real numbers, as a term of reproducible_sum. context: the array. */
static real stored_term(const void *context, int64_t i) { return ((const real *)context)[i]; }

real reproducible_sum(int64_t term_count, real (*term)(const void *context, int64_t i), const void *context)
{
    real sum, few[FEW_TERMS];
    struct single s = {term, context};
    if (term_count <= FEW_TERMS) {
        terms_store(term_count, &s, few);
        s = (struct single){stored_term, few};
    }
    reproducible_sums(term_count, 1, single_block, &s, &sum);
    return sum;
}

/* ---- clocks ------------------------------------------------------------------------------------------------------ */

/* Returns the time of the system clock `which` (CLOCK_MONOTONIC and the like) [s]. */
static double clock_read(clockid_t which)
{
    struct timespec now;
    clock_gettime(which, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double wall_clock_seconds(void) { return clock_read(CLOCK_MONOTONIC); }

double thread_cpu_clock_seconds(void) { return clock_read(CLOCK_THREAD_CPUTIME_ID); }

const char *const timer_name[TIMERS] = {
    [TIMER_BONDS] = "bonds",     [TIMER_SCATTER] = "scatter", [TIMER_GRID] = "grid",     [TIMER_GATHER] = "gather",
    [TIMER_CONVERT] = "convert", [TIMER_SAMPLE] = "sample",   [TIMER_OUTPUT] = "output",
};

void timers_start(struct timers *timers) { *timers = (struct timers){.last = wall_clock_seconds()}; }

void timer_add_elapsed_to_section(struct timers *timers, enum timer section)
{
    double now = wall_clock_seconds();
    timers->spent[section] += now - timers->last;
    timers->last = now;
}
