/* Load steps: contact in equilibria, and rigid bodies, which are where the pseudo-time has them.
 *
 * Which gaps are closed is found in turns with equilibrium (contact/contact_touch.c). On the way there marks, pairs and
 * the places of rigid bodies change, each of which changes the energy of contact where nothing else moves. What is lost
 * in a solution from what touches is therefore what loads have worked less the change of all energies, not the work of
 * forces on the way. */
#include <math.h>

#include "touch.h"
#include "pieces.h"
#include "springs.h"
#include "unknowns.h"

#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "rigid/rigid_part.h"
#include "step/sample.h"

#define CARRIED 1e-6    /* gap to another body that may carry this one [spacings] */
#define STRIDE_MOST 0.2 /* way of a rigid body between two equilibria [spacings] */
enum { STRIDES_MOST = 10000 };

bool statics_faces_closed(const struct contact *c) { return c->law.between == CONTACT_ALL && c->touching > 0; }

/* Free motions of all pieces. */
static int free_motions(const struct statics *s)
{
    int n = 0;
    for (int64_t q = 0; q < s->pieces; q++) n += s->piece[q].motions;
    return n;
}

/* Pieces as contact holds them now, and springs anew where it holds others. */
static void pieces_follow(struct run *e)
{
    const int before = free_motions(e->statics);
    statics_pieces_make(e);
    if (free_motions(e->statics) != before) statics_precondition_free(e->statics);
}

static int64_t touch_search(struct run *e, real close)
{
    return contact_search(e->contact, &e->part, &e->bonds, &e->loads, &e->source.family, close);
}

void statics_touch_start(struct run *e)
{
    if (!e->statics->meets) return;
    e->contact->marked = true;
    loads_mirror(&e->loads, &e->part);
    if (!e->contact->made || !e->contact->touch) touch_search(e, CARRIED);
}

int statics_strides(const struct scene *s, const struct rigid_set *rigid, real t)
{
    real most = 0;
    for (int k = 0; k < s->rigids; k++) {
        const struct rigid_body *r = &rigid->body[k];
        real way[DIM_MAX];
        rigid_displacement(r, t, way);
        for (int d = 0; d < r->dim; d++) most = real_max(most, fabs(r->centre[d] + way[d] - r->x[d]));
    }
    return (int)real_min(STRIDES_MOST, real_max(1, ceil(most / (STRIDE_MOST * s->spacing))));
}

/* Energy of the body and of contact, and what plastic bonds have taken, where forces have just been asked for [J]. */
static real energy_here(struct run *e)
{
    return sample_strain(e) + contact_energy(e->contact, &e->part) + bond_plastic_work(&e->bonds);
}

bool statics_touched(const struct statics *s, const struct contact *c) { return s->touches || c->touching > 0; }

/* What touches has its energies before the solution; where nothing does, no piece is held by it either. */
void statics_touch_begin(struct run *e, real t)
{
    struct statics *s = e->statics;
    struct equilibrium *q = &s->balance;
    const bool touched = s->touches;
    s->touches = false, q->reach = 0;
    if (!e->statics->meets) return;
    statics_touch_start(e);
    q->force(e, &q->u, &q->f);
    s->energy = energy_here(e) - (touched ? 0 : contact_energy(e->contact, &e->part));
    for (int k = 0; k < e->scene->rigids; k++) rigid_put(&e->rigid->body[k], t);
    s->touches = touch_search(e, CARRIED) > 0 || touched;
    s->largest = q->largest;
    if (!s->touches) return;
    pieces_follow(e);
    q->force(e, &q->u, &q->f);
    q->reach = contact_sight(e->contact);
}

/* Loads are measured by what acts in the end, not by what contact pushes on the way there. */
bool statics_touch_settle(void *engine)
{
    struct run *e = engine;
    struct statics *s = e->statics;
    struct contact *c = e->contact;
    if (!e->statics->meets) return true;
    unknowns_move(s, &e->part, &e->frame->mesh, &s->balance.u);
    loads_mirror(&e->loads, &e->part);
    const int64_t changed = contact_has_come(c, &e->part) ? 1 + touch_search(e, 0) : contact_mark(c, &e->part, 0);
    s->balance.applied = applied_forces_norm(s, &e->part, c);
    s->balance.largest = s->largest;
    if (changed > 0) pieces_follow(e);
    return changed == 0;
}

void statics_touch_laws(void *engine, bool settled)
{
    struct run *e = engine;
    if (e->statics->meets) contact_marks_use(e->contact, settled);
}

real statics_touch_end(struct run *e, real work, real lost)
{
    struct statics *s = e->statics;
    struct equilibrium *q = &s->balance;
    real range = 0;
    if (!e->statics->meets) return 0;
    if (s->touches || e->contact->touching > 0) q->force(e, &q->u, &q->f);
    for (int k = 0; k < e->scene->rigids; k++) {
        const real before = e->rigid->body[k].work;
        for (int d = 0; d < e->part.dim; d++)
            range += 0.5 * fabs((e->rigid->body[k].force[d] - e->rigid->body[k].force_previous[d]) *
                                e->rigid->body[k].increment[d]);
        rigid_book(&e->rigid->body[k]);
        work += e->rigid->body[k].work - before;
    }
    if (statics_touched(s, e->contact)) q->lost = lost + work - (energy_here(e) - s->energy);
    s->touches = e->contact->touching > 0;
    return range;
}
