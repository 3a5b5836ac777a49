/* Other programs on the machine: by how much they make a computation take longer than its processor time. */
#ifndef CLEAVE_BUSY
#define CLEAVE_BUSY

#include <stdbool.h>
#include <stddef.h>

/* Returns the mean number of processes that used or waited for a processor of the machine in the last minute
 * (getloadavg); 0 if it is not known. */
double machine_load_average(void);

/* Writes to text[capacity] a sentence on the factor by which wall time exceeds processor time, as `other_process_load`
 * processes of other programs (machine_load_average) and `threads` threads of this one share `cores` cores. Returns
 * false, and writes nothing, if there are enough cores for all of them. */
bool machine_describe_overload_if_any(char *text, size_t capacity, double other_process_load, int cores, int threads);

#endif
