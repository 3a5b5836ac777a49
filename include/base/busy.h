/* Measures the load of the machine by other programs, and how much longer a computation takes because of it. */
#ifndef CLEAVE_BUSY
#define CLEAVE_BUSY

#include <stdbool.h>
#include <stddef.h>

/* Returns the mean number of processes that used or waited for a processor of the machine in the last minute
 * (getloadavg); 0 if this number is not known. */
double machine_load_average(void);

/* Writes to text[capacity] a warning that other programs slow this one down, with the factor by which it takes longer
 * than alone. other_process_load: mean number of processes of other programs (machine_load_average); core_count: cores
 * of the machine; thread_count: threads of this program. Returns true if a warning was written; false, and writes
 * nothing, if there are enough cores for all processes and threads. A text longer than `capacity` is truncated. */
bool machine_compose_warning_if_overloaded(char *text, size_t capacity, double other_process_load, int core_count,
                                           int thread_count);

#endif
