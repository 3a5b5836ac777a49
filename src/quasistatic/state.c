/* Saves and restores the state of load steps, in checkpoints and before trial equilibria, which are undone if they
 * fail. */
#include <stdio.h>

#include "softening.h"
#include "system.h"
#include "unknowns.h"

#include "base/memory.h"

/* Finds the bonds of list l in the rebuilt rows of `bonds` by their two particles, and sets their row, their index in
 * the row and their weight again. */
static void list_find(const struct bonds *bonds, struct break_list *l)
{
    for (int64_t k = 0; k < l->n; k++) {
        struct broken_bond *record = &l->bond[k];
        record->row = bonds->row_of[record->i];
        for (struct bond_iterator it = bond_iterator_of_row(bonds, record->row); bond_iterator_advance(&it);)
            if (it.bond.nbr == record->j && it.bond.w != 0) record->entry = it.bond.entry, record->w = it.bond.w;
    }
}

/* Saves the list l of the bonds of the next crack increment to the archive a if a->saving is true, else restores it and
 * finds the bonds in the present rows of `bonds`. Returns FAILED, with a message, if the archive cannot be written or
 * lacks the list. */
static status statics_list_archive(struct break_list *l, const struct bonds *bonds, struct archive *a)
{
    ARCHIVE_VALUE(a, "statics/next", l->n);
    if (!a->saving) memory_free(l->bond), l->bond = BARE("statics.broken", l->n, struct broken_bond);
    if (l->n > 0) TRY(a->exchange(a, "statics/bonds", l->bond, (size_t)l->n * sizeof *l->bond));
    if (!a->saving) list_find(bonds, l);
    return OK;
}

/* Saves the tips of SIF-driven cracks (directed by stress-intensity factors) and the path of these cracks in `cracks`
 * to the archive a if a->saving is true, else restores them. Returns FAILED, with a message, if the archive cannot be
 * written or lacks them. */
static status sif_archive(struct sif_cracks *cracks, struct archive *a)
{
    ARCHIVE_VALUE(a, "statics/led", cracks->known);
    ARCHIVE_VALUE(a, "statics/led_n", cracks->n);
    ARCHIVE_VALUE(a, "statics/led_tips", cracks->tip);
    ARCHIVE_VALUE(a, "statics/led_tried", cracks->tried);
    ARCHIVE_VALUE(a, "statics/led_stretches", cracks->segments);
    if (!a->saving && cracks->segments > 0) {
        memory_free(cracks->path);
        cracks->path = NEW("led.path", cracks->segments, struct path_segment);
    }
    return cracks->segments > 0
               ? a->exchange(a, "statics/led_path", cracks->path, (size_t)cracks->segments * sizeof *cracks->path)
               : OK;
}

/* Saves the next crack increment of s and the tips of SIF-driven cracks (directed by stress-intensity factors) to the
 * archive a if a->saving is true, else restores them and finds the bonds in the present rows of b. Returns FAILED, with
 * a message, if the archive cannot be written or lacks them. */
static status increment_archive(struct statics *s, struct bonds *b, struct archive *a)
{
    ARCHIVE_VALUE(a, "statics/released_time", s->released_time);
    ARCHIVE_VALUE(a, "statics/due", s->due);
    ARCHIVE_VALUE(a, "statics/advances", s->increment_due);
    ARCHIVE_VALUE(a, "statics/ahead", s->ahead);
    ARCHIVE_VALUE(a, "statics/behind", s->behind);
    TRY(statics_list_archive(&s->next, b, a));
    return sif_archive(&s->sif, a);
}

/* Saves to the archive a if a->saving is true, else restores from it: force scales, round-off level and counters of the
 * solver of s, whether its preconditioner is still valid, and the results of the last load step for history.csv. clock:
 * its load step number is set from these results. Returns FAILED, with a message, if the archive cannot be written or
 * lacks an entry. */
static status search_archive(struct statics *s, struct run_clock *clock, struct archive *a)
{
    struct newton_solver *newton = &s->balance;
    ARCHIVE_VALUE(a, "statics/largest", newton->largest);
    ARCHIVE_VALUE(a, "statics/strain_ratio", newton->strain_ratio);
    ARCHIVE_VALUE(a, "statics/noise", newton->noise);
    s->kept = s->precondition && !s->precondition_stale;
    ARCHIVE_VALUE(a, "statics/kept", s->kept);
    ARCHIVE_VALUE(a, "statics/forces", newton->forces);
    ARCHIVE_VALUE(a, "statics/directions", newton->directions);
    ARCHIVE_VALUE(a, "statics/solutions", s->solutions);
    ARCHIVE_VALUE(a, "statics/record", s->record);
    ARCHIVE_VALUE(a, "statics/turn", s->turn);
    ARCHIVE_VALUE(a, "statics/flow_softening", s->softening);
    clock->load_step = s->record.step;
    return OK;
}

status load_steps_save_or_load_state(struct run *run, struct archive *a)
{
    struct statics *s = run->statics;
    struct newton_solver *newton = &s->balance;
    const bool whole = a->scope == ARCHIVE_ALL;
    if (!scene_has_load_steps(run->scene)) return OK;
    if (whole && (!a->saving || !s->node)) statics_equation_system_free(s), statics_equation_system_make(run);
    for (int d = 0; d < run->part.dim; d++) {
        char name[48];
        snprintf(name, sizeof name, "statics/u%d", d);
        TRY(a->exchange(a, name, newton->u.of[d], (size_t)newton->n * sizeof(real)));
        snprintf(name, sizeof name, "statics/f%d", d);
        TRY(a->exchange(a, name, newton->f.of[d], (size_t)newton->n * sizeof(real)));
    }
    ARCHIVE_VALUE(a, "statics/t", s->t);
    ARCHIVE_VALUE(a, "statics/touches", s->in_contact);
    ARCHIVE_VALUE(a, "statics/overload", s->stretch_ratio);
    if (whole) TRY(increment_archive(s, &run->bonds, a));
    ARCHIVE_VALUE(a, "statics/lost", newton->lost);
    if (whole) TRY(search_archive(s, &run->clock, a));
    if (!a->saving) applied_forces_compute(s, &run->part, &run->loads, s->t);
    if (!a->saving && whole && run->bonds.soft.curve)
        bonds_store_max_stretches_at_last_equilibrium(&run->bonds, &run->part, &run->source.limit);
    if (!a->saving && whole) plastic_state_save(&run->statics->plastic, &run->bonds, &run->part, run->optional);
    return OK;
}
