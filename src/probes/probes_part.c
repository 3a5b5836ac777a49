/* Probes and the balance of energy, as parts of a run. */
#include "probes/probes_part.h"
#include "base/memory.h"
#include "run/part.h"

static void probing_free_all(struct run *e)
{
    struct probing *q = e->probing;
    probes_free(&q->probes);
    for (int d = 0; d < DIM_MAX; d++) memory_free(q->baseline.v[d]);
    memory_free(q->pulse);
}

const struct part part_probing = {PART(probing, probing), .free = probing_free_all};
const struct part part_diagnostics = {PART(diagnostics, diagnostics)};
