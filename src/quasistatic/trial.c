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

/* Saves all data of the run that a trial equilibrium changes to the archive a if a->saving is true, else restores them
 * from it. Positions of mirror images and mesh points are left out, since they follow from the other data. Returns
 * FAILED, with a message, if an entry is missing. */
static status trial_archive(struct run *run, struct archive *a)
{
    for (int k = 0; k < run->scene->rigids; k++) TRY(rigid_save_or_load(&run->rigid->body[k], k, a));
    TRY(contact_save_or_load(run->contact, &run->part, a));
    TRY(loads_save_or_load(&run->loads, a));
    ARCHIVE_VALUE(a, "engine/damped", run->damped);
    ARCHIVE_VALUE(a, "statics/broken", run->statics->record.broken);
    TRY(plastic_state_save_or_load(&run->bonds, &run->part, run->optional, a));
    return load_steps_save_or_load_state(run, a);
}

void trial_equilibrium_begin(struct run *run, struct memory_archive *m)
{
    plastic_state_save(&run->statics->plastic, &run->bonds, &run->part, run->optional);
    memory_archive_open_for_saving(m, ARCHIVE_TRIAL);
    const status saved = trial_archive(run, &m->archive);
    INVARIANT(saved == OK);
}

void trial_equilibrium_end(struct run *run, struct memory_archive *m, bool keep_result,
                           const struct break_list *broken_bonds)
{
    if (keep_result) {
        memory_archive_free(m);
        return;
    }
    if (broken_bonds) bonds_restore_broken(run->statics, &run->bonds, &run->part, broken_bonds);
    memory_archive_rewind_for_loading(m);
    const status restored = trial_archive(run, &m->archive);
    INVARIANT(restored == OK);
    memory_archive_free(m);
    plastic_state_save(&run->statics->plastic, &run->bonds, &run->part,
                       run->optional); /* a nested trial may have saved a different one */
    unknowns_apply_displacements(run->statics, &run->part, &run->frame->mesh, &run->statics->balance.u);
    lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    loads_update_mirror_images_of_particles(&run->loads,
                                            &run->part); /* stretches of bonds to mirror images need their positions */
    reactions_compute_and_store(run->statics, &run->part, &run->loads);
}
