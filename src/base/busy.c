/* Determines whether other programs keep the machine busy, from the load average of the system. */
#include "base/busy.h"

#include <stdio.h>
#include <stdlib.h>

/* Largest number of running processes, beyond the number of processors, for which nothing is reported: some of them may
 * have ended. */
#define UNNOTICED 0.5

double machine_load_average(void)
{
    double load;
    return getloadavg(&load, 1) == 1 ? load : 0;
}

bool machine_compose_warning_if_overloaded(char *text, size_t capacity, double other_process_load, int core_count,
                                           int thread_count)
{
    if (core_count < 1 || other_process_load + thread_count <= core_count + UNNOTICED) return false;
    snprintf(text, capacity,
             "other programs use %.1f of this machine's %d core%s, so on %d thread%s the run takes about %.2g times as "
             "long as alone; stop them to run faster",
             other_process_load, core_count, core_count > 1 ? "s" : "", thread_count, thread_count > 1 ? "s" : "",
             (other_process_load + thread_count) / core_count);
    return true;
}
