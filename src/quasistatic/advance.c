/* Advances of a crack.
 *
 * A lattice holds a crack back: bond by bond, the load at which its most overloaded bond passes its limit swings by 30
 * % while the tip goes on by a spacing, and its mean and its envelope stay above what Griffith's balance of energies
 * asks, on any lattice (lattice trapping: Thomson, Hsieh & Rana 1971); with a horizon of 3 spacings by 18 % and 50 % of
 * G_c. A crack therefore advances by some spacings at once: the most overloaded bonds break, first come first, until
 * the area that they cross is two spacings long; each counts by what it costs over the toughness of what it crosses.
 * The advance comes at the load at which the body releases what it costs: Griffith's criterion for finite growth (as in
 * Leguillon 2002, with a stress near the limit as the second condition), with the path left to the bonds.
 *
 * What an advance releases is that of its middle. Between two of them the mean of both counts, and at the tip of a
 * pre-crack that of the first one and one before it, of which the first two tell the release: the load of a state is
 * that of its own crack to the second order of an advance. The advance itself comes where it pays for itself, so that
 * no energy is left over; where loads only grow, at the larger one of both. */
#include <math.h>

#include "advance.h"
#include "balance.h"
#include "led.h"
#include "load_size.h"
#include "overload.h"
#include "pieces.h"
#include "system.h"
#include "trial.h"

#include "fracture/fracture_part.h"

#define STRESSED 0.85        /* overload below which no first advance is looked for */
#define STRESSED_FURTHER 0.5 /* nor one after others: between two, a lattice lets bonds off */
#define LEFT 0.3             /* overload at which an advance ends, whatever it has cost */
#define REMNANT 0.3          /* share of the largest overload within which bonds break that led fronts have left */
#define DUE_ERROR 2e-3       /* of loads at which an advance comes */
enum { ADVANCE_SPACINGS = 2, LOOKS_MOST = 6 };

/* ---- area of a crack increment ----------------------------------------------------------------------------------- */

/* Share of the area of cracks that the body has: half where they all run along planes of symmetry, across axis d (-1:
 * any). */
static real advance_share(const struct tips *t, const struct bond_source *source, int d)
{
    bool on = t->n > 0;
    for (int k = 0; k < t->n && on; k++) {
        bool any = false;
        for (int m = 0; m < source->mirrors; m++)
            any |= (d < 0 || source->mirror[m].axis == d) && tip_on_mirror(t, &t->tip[k], &source->mirror[m], 1);
        on = any;
    }
    return on ? 0.5 : 1;
}

/* Length of the front of a crack in space [m]: of the edges of pre-cracks in the body, no more than the body's shortest
 * side, of which a plane of symmetry along the crack leaves half, and no less than a spacing; 1 in the plane. */
static real front_length(const struct tips *t, const struct bond_source *source, const struct particles *p)
{
    const real h = source->family.spacing;
    real length = INFINITY, edges = 0, low, high;
    if (p->dim < 3) return 1;
    for (int d = 0; d < 3; d++) {
        particles_extent(p, p->n, d, &low, &high);
        length = real_min(length, (high - low + h) / advance_share(t, source, d));
    }
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) edges += 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, 3));
    return edges > 0 ? real_min(length, real_max(edges, h)) : length;
}

/* Area of an advance [m^2]. front: its length [m]. */
static real advance_area(const struct scene *s, const struct tips *t, const struct bond_source *source, real front)
{
    const real ahead = ADVANCE_SPACINGS * (s->dim > 1 ? s->spacing : 1);
    return advance_share(t, source, -1) * ahead * scene_section(s) * front;
}

/* Pairs of bonds that may break between two equilibria: of each spacing along a front of this length [m]. */
static int64_t breaks_most(const struct scene *s, real front)
{
    const real along = s->dim < 3 ? 1 : front / s->spacing;
    return (int64_t)(s->steps.breaks * real_max(1, along));
}

/* ---- advances ---------------------------------------------------------------------------------------------------- */

/* An advance more: bonds break at this pseudo-time, onto the end of the list. What fronts in space have left of a body
 * as they reached its other side tears in larger pieces: no load hangs on its way. */
static status advance_try(struct run *e, struct advance *a)
{
    struct statics *s = e->statics;
    const struct tips *t = &e->fracture->tips;
    const real before = statics_released(s, &e->bonds), given = e->scene->steps.energy;
    const real cost = given > 0 ? given * (1 - 1e-3) : INFINITY, front = front_length(t, &e->source, &e->part);
    const real wide = advance_area(e->scene, t, &e->source, front) * (1 - 1e-3);
    const int64_t most = breaks_most(e->scene, front);
    const bool remnant = e->part.dim == 3 && s->led.stretches > 0;
    const real within = remnant ? real_max(REMNANT, e->scene->steps.within) : e->scene->steps.within;
    real area = 0;
    *a = (struct advance){0};
    while ((given > 0 ? a->cost < cost : area < wide) && s->overload > LEFT) {
        if (statics_break(e, within, most, &a->cost, &area) == 0) break;
        if (e->scene->steps.control == CONTROL_ENERGY) {
            statics_pieces_make(e);
            s->severs = statics_unheld(s, &e->part, e->clock.step + 1) != OK;
            if (s->severs) break;
        }
        TRY(statics_go(e, s->t));
    }
    a->release = (statics_released(s, &e->bonds) - before) / square(statics_load_size(e, s->t));
    return OK;
}

/* Has nothing advanced yet, and is there a pre-crack? */
static bool pre_crack_stands(const struct tips *t, const struct statics *statics)
{
    bool stands = false;
    for (int k = 0; k < t->n; k++) stands |= t->tip[k].from_crack;
    return stands && statics->behind.cost == 0;
}

/* Looks for the next advance under the loads that there are. */
static status look_here(struct run *e)
{
    struct statics *s = e->statics;
    struct memory_archive saved;
    struct advance second;
    if (led_leads(e)) {
        TRY(led_look_ahead(e));
        if (s->next.n > 0 || s->overload <= 1) return OK; /* else bonds break where no tip leads to */
    }
    if (s->next.n > 0 || s->overload < (s->behind.cost > 0 ? STRESSED_FURTHER : STRESSED)) return OK;
    trial_begin(e, &saved);
    s->next.n = 0;
    status tried = advance_try(e, &s->ahead);
    const int64_t bonds = s->next.n;
    if (tried == OK && bonds > 0 && pre_crack_stands(&e->fracture->tips, s)) {
        tried = advance_try(e, &second);
        if (second.cost > 0) s->behind = advance_before(&s->ahead, &second);
    }
    trial_undo(e, &saved, &s->next);
    s->next.n = bonds;
    s->due = size_of_balance(&s->ahead, &s->behind);
    return tried;
}

/* Looks under the loads at which it comes, until these are what it says there. What it releases grows with the square
 * of what loads strain, which may be their size less a way on which nothing touches: secants of its root. */
static status look_there(struct run *e)
{
    struct statics *s = e->statics;
    struct memory_archive saved;
    const real from = s->t;
    const int64_t particles = s->particles;
    trial_begin(e, &saved);
    status looked = OK;
    real was = 0, share_was = NAN;
    for (int k = 0; k < LOOKS_MOST && looked == OK && s->next.n > 0; k++) {
        const real size = statics_load_size(e, s->t), share = size / s->due;
        if (fabs(share - 1) <= DUE_ERROR || !isfinite(s->due)) break;
        const real secant = size + (1 - share) * (size - was) / (share - share_was);
        looked = statics_go(e, statics_time_of_size(e, secant > 0 ? secant : s->due));
        was = size, share_was = share;
        s->next.n = 0;
        if (looked == OK) looked = look_here(e);
    }
    if (s->particles == particles) {
        trial_undo(e, &saved, NULL);
        return looked;
    }
    memory_archive_free(&saved); /* points have converted, which cannot be undone */
    return looked == OK ? statics_go(e, from) : looked;
}

/* What a body releases goes with the square of its loads where their size is that of its strains: not where a way is
 * gone before anything touches, or faces close. */
status statics_look_ahead(struct run *e)
{
    TRY(look_here(e));
    return e->statics->touches ? look_there(e) : OK;
}

status statics_advance_balanced(struct run *e)
{
    const real size = size_of_advance(&e->statics->ahead);
    if (isfinite(size)) TRY(statics_go(e, statics_time_of_size(e, size)));
    return statics_advance(e);
}

int64_t statics_advance_break(struct run *e)
{
    struct statics *s = e->statics;
    const int64_t broken = s->next.n;
    statics_break_listed(e, &s->next);
    led_advance(&s->led, &e->part);
    s->behind = s->ahead, s->ahead = (struct advance){0};
    s->next.n = 0;
    return broken;
}

status statics_advance_settle(struct run *e, int64_t broken)
{
    TRY(statics_go(e, e->statics->t));
    statics_plastic_keep(e);
    return statics_convert(e, broken);
}

status statics_advance(struct run *e) { return statics_advance_settle(e, statics_advance_break(e)); }
