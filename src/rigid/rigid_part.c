/* Registers rigid bodies with the engine: defines their callbacks (struct part in run/part.h). */
#include "rigid/rigid_part.h"
#include "base/memory.h"
#include "rigid/rigid_surface.h"
#include "run/part.h"

static void rigid_free_all(struct run *run)
{
    for (int b = 0; run->rigid->surface && b < run->rigid->n; b++) rigid_surface_free(&run->rigid->surface[b]);
    memory_free(run->rigid->surface);
    memory_free(run->rigid->body), memory_free(run->rigid->shape), memory_free(run->rigid->motion);
}

static status rigid_state(struct run *run, struct archive *a)
{
    for (int k = 0; k < run->rigid->n; k++) TRY(rigid_save_or_load(&run->rigid->body[k], k, a));
    return OK;
}

const struct part part_rigid = {PART(rigid, rigid_set), .free = rigid_free_all, .columns = rigids_list_history_columns,
                                .record = rigids_write_history_values, .state = rigid_state};
