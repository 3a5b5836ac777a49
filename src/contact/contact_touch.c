/* Finds the contacts that act in an equilibrium, in alternation with the equilibrium itself (active-set strategy:
 * Hintermueller, Ito & Kunisch 2003). During a solution exactly the contacts with a mark of 1 act, with k times their
 * overlap of either sign; afterwards the marks are set anew by the overlaps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "contact_internal.h"

#define KEPT 1e-10 /* gaps and overlaps that change no mark [spacings] */

/* Allocates the marks that select which contacts of c act in an equilibrium, all 0 (none). There is a mark for each row
 * of the contact list (form `surface`) or for each pair (form `pair`), and one for each particle near a rigid body. */
static void marks_room(struct contact *c)
{
    memory_free(c->touch);
    c->touch = NEW("contact.touch", c->law.form == CONTACT_SURFACE ? c->rows : c->pairs, uint8_t);
    for (int b = 0; b < c->rigids; b++) {
        memory_free(c->near[b].touch);
        c->near[b].touch = NEW("contact.touch", c->near[b].n, uint8_t);
    }
}

void contact_enable_forces_on_all_listed_particles(struct contact *c)
{
    memory_free(c->followed);
    c->followed = BARE("contact.followed", c->rows, uint8_t);
    array_fill_bytes(c->followed, ROW_ACTIVE, c->rows, 1);
    c->waiting = 0;
}

/* Updates *touch, the mark of a contact, from its gap [spacings]: 1 if the contact acts in the equilibrium, else 0. An
 * inactive contact becomes active at gaps below `close`, or below -KEPT if `close` is 0. An active one stays active up
 * to gaps of KEPT or `close`, whichever is larger. Returns true if the mark has changed. */
static bool mark_set(uint8_t *touch, real gap, real close)
{
    const uint8_t was = *touch;
    *touch = gap < (was ? real_max(close, KEPT) : close > 0 ? close : -KEPT);
    return *touch != was;
}

/* Returns the gap below which the contact of two particles becomes active [spacings]: `close` for particles of
 * different bodies, and 0 within one body, because the faces of a crack are in contact without a gap and without force
 * at first. row, l: entries of the particles in the contact list c; p: particles. */
static real close_of(const struct contact *c, const struct particles *p, int64_t row, int64_t l, real close)
{
    return p->body[c->particle[row]] != p->body[mirror_image_source_particle(p, c->law.image, c->particle[l])] ? close
                                                                                                               : 0;
}

/* Updates the marks of the contacts of the particle of p in row `row` of the contact list c, which state whether a
 * contact acts in the equilibrium that is being computed, from the gaps. close: gap below which contacts of different
 * bodies become active [spacings]. Returns the number of marks that have changed. */
static int64_t mark_row(struct contact *c, const struct particles *p, int64_t row, real close)
{
    int64_t changed = 0;
    real most = 0;
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const real apart = close_of(c, p, row, c->other[q], close);
        most = real_max(most, apart);
        if (c->law.form == CONTACT_PAIR)
            changed += mark_set(&c->touch[q], contact_pair_gap(c, p, row, q) / c->law.spacing, apart);
    }
    if (c->law.form == CONTACT_SURFACE && c->first[row + 1] > c->first[row])
        changed += mark_set(&c->touch[row], contact_face_gap_of_particle(c, p, row), most);
    return changed;
}

/* Sets the forces that compensate energy errors of time integration (contact_balance.c) to 0 in all contacts of c,
 * those with rigid bodies included. An equilibrium must not contain such forces. */
static void balances_rest(struct contact *c)
{
    for (int64_t row = 0; row < c->rows && c->balance; row++) c->balance[row].drag = 0;
    for (int b = 0; b < c->rigids; b++)
        for (int64_t q = 0; q < c->near[b].n; q++) c->near[b].balance[q].drag = 0;
}

int64_t contact_select_linear_springs_and_count_changes(struct contact *c, const struct particles *p, real max_gap)
{
    int64_t changed = 0;
    real normal[DIM_MAX];
#pragma omp parallel for schedule(static) reduction(+ : changed)
    for (int64_t row = 0; row < c->rows; row++) changed += mark_row(c, p, row, max_gap);
    for (int b = 0; b < c->rigids; b++)
        for (int64_t q = 0; q < c->near[b].n; q++)
            changed += mark_set(&c->near[b].touch[q],
                                contact_rigid_gap_of_particle(c, p, b, q, normal) / c->law.spacing, max_gap);
    return changed;
}

int64_t contact_search_and_select_linear_springs(struct contact *c, const struct particles *p, struct bonds *b,
                                                 struct loads *l, const struct family *family, real max_gap)
{
    c->due = true;
    contact_update_pair_list_if_outdated(c, p, b, l, family, c->searched, c->broken, c->changed);
    marks_room(c);
    contact_enable_forces_on_all_listed_particles(c);
    balances_rest(c);
    return contact_select_linear_springs_and_count_changes(c, p, max_gap);
}

real contact_pair_list_safe_displacement(const struct contact *c) { return 0.5 * contact_pair_list_margin(c); }

void contact_restrict_forces_to_linear_springs(struct contact *c, bool springs_only) { c->by_overlap = !springs_only; }

void contact_discard_linear_springs(struct contact *c)
{
    memory_free(c->touch);
    c->touch = NULL;
    for (int b = 0; b < c->rigids && c->near; b++) {
        memory_free(c->near[b].touch);
        c->near[b].touch = NULL;
    }
    c->due = true;
}

/* ---- terms ------------------------------------------------------------------------------------------------------- */

/* Data of a loop over all active contacts: the function that is called for each of them, its context, and the contact
 * that is passed to it. */
struct visit {
    const struct contact *c;
    const struct particles *p;
    void (*visit)(void *context, const struct contact_term *term);
    void *context;
    struct contact_term term;
};

/* Calls v->visit for each active contact of the particle of row `row` of the contact list with another particle, and
 * passes the contact as a linear spring (v->term). Only for laws of the form `pair`. */
static void pair_terms(struct visit *v, int64_t row)
{
    const struct contact *c = v->c;
    struct contact_term *t = &v->term;
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const int64_t l = c->other[q];
        real apart[DIM_MAX] = {0};
        const real r = sqrt(contact_pair_vector_and_squared_distance(c, v->p, row, l, apart));
        if (!c->touch[q] || !(r > 0)) continue;
        t->n = 2, t->stiffness = 0.5 * contact_pair_stiffness(c, v->p, row, l);
        t->particle[0] = c->particle[row], t->particle[1] = c->particle[l];
        for (int d = 0; d < DIM_MAX; d++) t->along[0][d] = apart[d] / r, t->along[1][d] = -apart[d] / r;
        v->visit(v->context, t);
    }
}

/* Calls v->visit for each particle with an active contact with rigid body number `body`, and passes the contact as a
 * linear spring (v->term). */
static void rigid_terms(struct visit *v, int body)
{
    const struct contact *c = v->c;
    const struct contact_near *near = &c->near[body];
    for (int64_t q = 0; q < near->n; q++) {
        if (!near->touch[q]) continue;
        v->term.n = 1, v->term.stiffness = 2 * contact_pair_stiffness(c, v->p, near->row[q], near->row[q]);
        v->term.particle[0] = c->particle[near->row[q]];
        contact_rigid_gap_of_particle(c, v->p, body, q, v->term.along[0]);
        v->visit(v->context, &v->term);
    }
}

void contact_visit_linear_springs(const struct contact *c, const struct particles *p,
                                  void (*visit)(void *context, const struct contact_term *term), void *context)
{
    int64_t most = 1;
    if (!c->touch) return;
    for (int64_t row = 0; row < c->rows; row++)
        most = c->first[row + 1] - c->first[row] > most ? c->first[row + 1] - c->first[row] : most;
    struct visit v = {c, p, visit, context, {0}};
    v.term.particle = BARE("contact.term", most + 1, int32_t);
    v.term.along = memory_new("contact.term", most + 1, sizeof *v.term.along);
    for (int64_t row = 0; row < c->rows; row++) {
        if (c->law.form == CONTACT_PAIR) pair_terms(&v, row);
        if (c->law.form == CONTACT_PAIR || !c->touch[row]) continue;
        contact_face_linearise_as_spring(c, p, row, &v.term);
        visit(context, &v.term);
    }
    for (int b = 0; b < c->rigids; b++) rigid_terms(&v, b);
    memory_free(v.term.particle);
    memory_free(v.term.along);
}

/* ---- state ------------------------------------------------------------------------------------------------------- */

/* Saves the marks of the contacts of c that act in the equilibrium (contact_select_linear_springs_and_count_changes) to
 * the archive a if a->saving, else restores them. Does nothing if contacts are not selected by marks (c->marked).
 * Returns FAILED if the archive cannot be read or written or a stored size differs. */
status contact_active_set_save_or_load(struct contact *c, struct archive *a)
{
    bool marks = c->touch != NULL;
    if (!c->marked) return OK;
    ARCHIVE_VALUE(a, "contact/marks", marks);
    if (!a->saving) memory_free(c->touch), c->touch = NULL;
    if (!marks) return OK;
    TRY(contact_array_save_or_load(a, "contact/touch", (void **)&c->touch,
                                   c->law.form == CONTACT_SURFACE ? c->rows : c->pairs, 1));
    for (int b = 0; b < c->rigids; b++) {
        char name[64];
        snprintf(name, sizeof name, "contact/near_touch_%d", b);
        TRY(contact_array_save_or_load(a, name, (void **)&c->near[b].touch, c->near[b].n, 1));
    }
    return OK;
}
