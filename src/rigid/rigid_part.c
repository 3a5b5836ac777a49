/* Rigid bodies, as a part of a run. */
#include "rigid/rigid_part.h"
#include "base/memory.h"
#include "run/part.h"

static void rigid_free_all(struct run *e)
{
    memory_free(e->rigid->body), memory_free(e->rigid->shape), memory_free(e->rigid->motion);
}

const struct part part_rigid = {PART(rigid, rigid_set), .free = rigid_free_all, .columns = rigids_columns,
                                .record = rigids_record};
