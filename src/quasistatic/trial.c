/* Computes trial equilibria of load steps, and restores the state before them if they are rejected. */
#include "trial.h"
#include "stretch_ratio.h"
#include "system.h"
#include "unknowns.h"

#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "quasistatic/load_steps.h"
#include "rigid/rigid_part.h"
#include "loads/mirrors.h"

/* Saves all data of run e that a trial equilibrium changes to the archive a if a->saving is true, else restores them
 * from it. Positions of mirror images and mesh points are left out, since they follow from the other data. Returns
 * FAILED, with a message, if an entry is missing. */
static status trial_archive(struct run *e, struct archive *a)
{
    for (int k = 0; k < e->scene->rigids; k++) TRY(rigid_save_or_load(&e->rigid->body[k], k, a));
    TRY(contact_save_or_load(e->contact, &e->part, a));
    TRY(loads_save_or_load(&e->loads, a));
    ARCHIVE_VALUE(a, "engine/damped", e->damped);
    ARCHIVE_VALUE(a, "statics/broken", e->statics->record.broken);
    TRY(plastic_state_save_or_load(&e->bonds, &e->part, e->optional, a));
    return load_steps_save_or_load_state(e, a);
}

void trial_equilibrium_begin(struct run *e, struct memory_archive *m)
{
    plastic_state_save(&e->statics->plastic, &e->bonds, &e->part, e->optional);
    memory_archive_open_for_saving(m, ARCHIVE_TRIAL);
    const status saved = trial_archive(e, &m->archive);
    INVARIANT(saved == OK);
}

void trial_equilibrium_end(struct run *e, struct memory_archive *m, bool keep_result,
                           const struct break_list *broken_bonds)
{
    if (keep_result) {
        memory_archive_free(m);
        return;
    }
    if (broken_bonds) bonds_restore_broken(e->statics, &e->bonds, &e->part, broken_bonds);
    memory_archive_rewind_for_loading(m);
    const status restored = trial_archive(e, &m->archive);
    INVARIANT(restored == OK);
    memory_archive_free(m);
    plastic_state_save(&e->statics->plastic, &e->bonds, &e->part,
                       e->optional); /* a nested trial may have saved a different one */
    unknowns_apply_displacements(e->statics, &e->part, &e->frame->mesh, &e->statics->balance.u);
    lagrangian_mesh_update_point_motion_and_stress(e->frame, &e->part, &e->loads);
    loads_update_mirror_images(&e->loads, &e->part); /* stretches of bonds to mirror images need their positions */
    reactions_compute_and_store(e->statics, &e->part, &e->loads);
}
