/* Load steps: state that a trial equilibrium changes, and how it is restored. */
#include "trial.h"
#include "system.h"
#include "overload.h"
#include "touch.h"
#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "rigid/rigid_part.h"

static status touch_archive(struct run *e, struct archive *a)
{
    for (int k = 0; k < e->scene->rigids; k++) TRY(rigid_archive(&e->rigid->body[k], k, a));
    return contact_archive(e->contact, &e->part, a);
}

static void statics_touch_take(struct run *e, struct memory_archive *m)
{
    memory_archive_make(m, ARCHIVE_TRIAL);
    if (statics_meets(e)) touch_archive(e, &m->archive);
}

static void statics_touch_give(struct run *e, struct memory_archive *m)
{
    memory_archive_rewind(m);
    if (statics_meets(e)) touch_archive(e, &m->archive);
}

void stand_take(struct stand *k, struct run *e)
{
    const struct equilibrium *q = &e->statics->balance;
    statics_plastic_keep(e);
    *k = (struct stand){.t = e->statics->t,
                        .overload = e->statics->overload,
                        .lost = q->lost,
                        .damped = e->damped,
                        .touches = e->statics->touches,
                        .work = e->loads.work,
                        .constraint_work = e->loads.constraint_work};
    statics_touch_take(e, &k->touch);
    for (int d = 0; d < q->dim; d++) {
        k->u.of[d] = BARE("advance.stand", q->n, real);
        k->f.of[d] = BARE("advance.stand", q->n, real);
        array_copy(k->u.of[d], q->u.of[d], q->n, sizeof(real));
        array_copy(k->f.of[d], q->f.of[d], q->n, sizeof(real));
    }
}

void stand_free(struct stand *k, const struct run *e)
{
    memory_archive_free(&k->touch);
    for (int d = 0; d < e->part.dim; d++) memory_free(k->u.of[d]), memory_free(k->f.of[d]);
}

void stand_give(struct stand *k, struct run *e, const struct break_list *broken)
{
    struct equilibrium *q = &e->statics->balance;
    if (broken) statics_mend(e, broken);
    statics_touch_give(e, &k->touch);
    statics_plastic_restore(e);
    if (e->statics->t != k->t) statics_applied_make(e, k->t);
    e->statics->t = k->t;
    e->statics->overload = k->overload, e->statics->touches = k->touches;
    q->lost = k->lost, e->damped = k->damped;
    e->loads.work = k->work, e->loads.constraint_work = k->constraint_work;
    for (int d = 0; d < q->dim; d++) {
        array_copy(q->u.of[d], k->u.of[d], q->n, sizeof(real));
        array_copy(q->f.of[d], k->f.of[d], q->n, sizeof(real));
    }
    stand_free(k, e);
    statics_place(e, &q->u);
    frame_sync(e);
    loads_mirror(&e->loads, &e->part);       /* bonds to images break by where these are */
    statics_react(e);
}
