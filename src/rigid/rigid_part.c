/* Registers rigid bodies with the engine: defines their callbacks (struct part in run/part.h). */
#include "rigid/rigid_part.h"
#include "base/memory.h"
#include "rigid/rigid_surface.h"
#include "run/part.h"

static void rigid_free_all(struct run *e)
{
    for (int b = 0; e->rigid->surface && b < e->rigid->n; b++) rigid_surface_free(&e->rigid->surface[b]);
    memory_free(e->rigid->surface);
    memory_free(e->rigid->body), memory_free(e->rigid->shape), memory_free(e->rigid->motion);
}

static status rigid_state(struct run *e, struct archive *a)
{
    for (int k = 0; k < e->rigid->n; k++) TRY(rigid_save_or_load(&e->rigid->body[k], k, a));
    return OK;
}

const struct part part_rigid = {PART(rigid, rigid_set), .free = rigid_free_all, .columns = rigids_list_history_columns,
                                .record = rigids_write_history_values, .state = rigid_state};
