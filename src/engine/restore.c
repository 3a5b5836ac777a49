/* Restores a run from a checkpoint. */
#include "base/memory.h"
#include "engine_internal.h"
#include "mesh/mesh_part.h"
#include "step/report.h"

/* Creates run again without the particles of the hollow cells (inside a body, replaced by coarse cells) of a
 * checkpoint; its report, warnings and timers are kept. absent[cells]: 1 for each cell without particles; the run owns
 * this array from now on. Returns REFUSED or FAILED, with a message, if the run cannot be created. */
static status remake(struct run *run, uint8_t *absent)
{
    struct run_report *const report = run->report;
    const struct warnings warnings = run->warnings;
    const struct timers timers = run->timers;
    const struct scene *s = run->scene;
    struct cells_without_particles hollow = run->frame->hollow;
    memory_free(hollow.absent);
    hollow.absent = absent, hollow.restored = true;
    run->frame->hollow = (struct cells_without_particles){0};
    run->report = NULL, run->warnings = (struct warnings){0};
    run_free_memory(run);
    const status made = run_create_and_transfer_from_predecessor(run, s, NULL, hollow, NULL);
    memory_free(run->report->record), memory_free(run->report);
    run->report = report, run->warnings = warnings, run->timers = timers;
    return made;
}

/* Reads from the archive a of a checkpoint which cells are hollow (inside a body, without particles), and creates run
 * again if there are any. Returns FAILED, with a message, if their number is not that of the cells around the first
 * body of the scene. */
static status hollow_restore(struct run *run, struct archive *a)
{
    struct cells_without_particles *hollow = &run->frame->hollow;
    int64_t n = hollow->absent ? hollow->box.n : 0;
    ARCHIVE_VALUE(a, "hollow/cells", n);
    if (n == 0 && !hollow->absent) return OK;
    if (n > 0 && n != hollow->box.n)
        return status_set(FAILED, "cannot resume: the checkpoint was written for a different body; restore the scene "
                                  "it was written with, or start again with --overwrite");
    uint8_t *absent = n > 0 ? NEW("hollow.absent", n, uint8_t) : NULL;
    if (n > 0) TRY(a->exchange(a, "hollow/absent", absent, (size_t)n));
    for (int64_t J = 0; J < n; J++)
        if (absent[J] > hollow->whole[J])
            return status_set(
                FAILED, "cannot resume: the checkpoint lacks particles; it is damaged, start again with --overwrite");
    return remake(run, absent);
}

status run_load_checkpoint(void *run, struct archive *a)
{
    TRY(hollow_restore(run, a));
    return run_save_or_load_state(run, a);
}
