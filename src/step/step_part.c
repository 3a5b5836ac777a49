/* Samples, frames and checkpoints, bulk damping and stability, as parts of a run. */
#include "base/memory.h"
#include "run/part.h"
#include "step/damping.h"
#include "step/report.h"
#include "step/stability.h"

static void report_free_all(struct run *e)
{
    struct run_report *r = e->report;
    if (!r) return;
    for (int d = 0; d < DIM_MAX; d++) memory_free(r->sampling.before[d]);
    memory_free(r->record);
}

static void damping_free_all(struct run *e)
{
    for (int k = 0; k < 2; k++)
        for (int d = 0; d < DIM_MAX; d++) memory_free(e->damping->before[k][d]);
}

const struct part part_report = {PART(report, run_report), .free = report_free_all};
const struct part part_damping = {PART(damping, damping_state), .free = damping_free_all};
const struct part part_stability = {PART(stability, stability)};
