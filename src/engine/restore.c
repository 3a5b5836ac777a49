/* Restores a run from a checkpoint. */
#include "base/memory.h"
#include "engine_internal.h"
#include "mesh/mesh_part.h"
#include "step/report.h"

/* Creates run e again without the particles of the hollow cells (inside a body, replaced by coarse cells) of a
 * checkpoint; its report, warnings and timers are kept. absent[cells]: 1 for each cell without particles; the run owns
 * this array from now on. Returns REFUSED or FAILED, with a message, if the run cannot be created. */
static status remake(struct run *e, uint8_t *absent)
{
    struct run_report *const report = e->report;
    const struct warnings warnings = e->warnings;
    const struct timers timers = e->timers;
    const struct scene *s = e->scene;
    struct cells_without_particles hollow = e->frame->hollow;
    memory_free(hollow.absent);
    hollow.absent = absent, hollow.restored = true;
    e->frame->hollow = (struct cells_without_particles){0};
    e->report = NULL, e->warnings = (struct warnings){0};
    run_free_memory(e);
    const status made = run_create_and_transfer_from_predecessor(e, s, NULL, hollow, NULL);
    memory_free(e->report->record), memory_free(e->report);
    e->report = report, e->warnings = warnings, e->timers = timers;
    return made;
}

/* Reads from the archive a of a checkpoint which cells are hollow (inside a body, without particles), and creates run e
 * again if there are any. Returns FAILED, with a message, if their number is not that of the cells around the first
 * body of the scene. */
static status hollow_restore(struct run *e, struct archive *a)
{
    struct cells_without_particles *h = &e->frame->hollow;
    int64_t n = h->absent ? h->box.n : 0;
    ARCHIVE_VALUE(a, "hollow/cells", n);
    if (n == 0 && !h->absent) return OK;
    if (n > 0 && n != h->box.n)
        return status_set(FAILED, "cannot resume: the checkpoint was written for a different body; restore the scene "
                                  "it was written with, or start again with --overwrite");
    uint8_t *absent = n > 0 ? NEW("hollow.absent", n, uint8_t) : NULL;
    if (n > 0) TRY(a->exchange(a, "hollow/absent", absent, (size_t)n));
    for (int64_t J = 0; J < n; J++)
        if (absent[J] > h->whole[J])
            return status_set(
                FAILED, "cannot resume: the checkpoint lacks particles; it is damaged, start again with --overwrite");
    return remake(e, absent);
}

status run_load_checkpoint(void *run, struct archive *a)
{
    TRY(hollow_restore(run, a));
    return run_save_or_load_state(run, a);
}
