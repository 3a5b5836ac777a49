/* Conversion and coupling, as a part of a run. */
#include "coupling/coupling_part.h"
#include "base/memory.h"
#include "run/part.h"

static void coupling_free_all(struct run *e)
{
    struct coupling_state *c = e->coupling;
    partial_stress_free(&c->partial), interface_zone_free(&c->zone), notches_free(&c->notches);
    memory_free(c->bonded), memory_free(c->start_region.solid);
}

const struct part part_coupling = {PART(coupling, coupling_state), .free = coupling_free_all};
