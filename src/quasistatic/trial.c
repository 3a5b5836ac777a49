/* Load steps: trial equilibria, and the way back from them. */
#include "trial.h"
#include "overload.h"
#include "system.h"
#include "unknowns.h"

#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "quasistatic/load_steps.h"
#include "rigid/rigid_part.h"

/* What a trial changes. */
static status trial_archive(struct run *e, struct archive *a)
{
    for (int k = 0; k < e->scene->rigids; k++) TRY(rigid_archive(&e->rigid->body[k], k, a));
    TRY(contact_archive(e->contact, &e->part, a));
    TRY(loads_archive(&e->loads, a));
    ARCHIVE_VALUE(a, "engine/damped", e->damped);
    ARCHIVE_VALUE(a, "statics/broken", e->statics->record.broken);
    TRY(plastic_archive(&e->bonds, &e->part, e->optional, a));
    return statics_archive(e, a);
}

void trial_begin(struct run *e, struct memory_archive *m)
{
    statics_plastic_keep(e);
    memory_archive_make(m, ARCHIVE_TRIAL);
    const status saved = trial_archive(e, &m->archive);
    INVARIANT(saved == OK);
}

void trial_undo(struct run *e, struct memory_archive *m, const struct break_list *broken)
{
    if (broken) statics_mend(e->statics, &e->bonds, &e->part, broken);
    memory_archive_rewind(m);
    const status restored = trial_archive(e, &m->archive);
    INVARIANT(restored == OK);
    memory_archive_free(m);
    statics_plastic_keep(e); /* as the start of the next solutions: a trial within may have kept its own */
    unknowns_move(e->statics, &e->part, &e->frame->mesh, &e->statics->balance.u);
    frame_sync(e->frame, &e->part, &e->loads);
    loads_mirror(&e->loads, &e->part); /* bonds to images break by where these are */
    reactions_store(e->statics, &e->part, &e->loads);
}
