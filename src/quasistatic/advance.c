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
#include <string.h>

#include "base/memory.h"
#include "statics_internal.h"
#include "fracture/fracture_part.h"
#include "step/report.h"
#include "mesh/mesh_part.h"
#include "step/step.h"

#define STRESSED 0.85        /* overload below which no first advance is looked for */
#define STRESSED_FURTHER 0.5 /* nor one after others: between two, a lattice lets bonds off */
#define LEFT 0.3             /* overload at which an advance ends, whatever it has cost */
#define REMNANT 0.3          /* share of the largest overload within which bonds break that led fronts have left */
#define DUE_ERROR 2e-3       /* of loads at which an advance comes */
enum { ADVANCE_SPACINGS = 2, LOOKS_MOST = 6 };

/* ---- what a body releases ---------------------------------------------------------------------------------------- */

real statics_released(const struct run *e) { return bonds_fracture_energy(&e->bonds) + e->statics->balance.lost; }

/* Energy per area that the bonds across a plane of the lattice take to their limits; of state-based models, whose bonds
 * have no energy of their own, G_c as given [J/m^2]. */
real toughness_of(const struct run *e, const struct material *m)
{
    const bool given = e->scene->model != MODEL_BOND && !isnan(m->energy_release_rate);
    if (given) return m->energy_release_rate;
    const real elastic = family_crossing_energy(&e->source.family, m), limit = m->critical_stretch;
    if (!material_yields(m) || !isfinite(limit)) return elastic;
    const real taken = stretch_work(limit, m->yield_stress / m->young, m->yield_hardening / m->young);
    return elastic * taken / (0.5 * square(limit));
}

/* Share of the area of cracks that the body has: half where they all run along planes of symmetry, across axis d (-1:
 * any). */
static real advance_share(const struct run *e, int d)
{
    const struct tips *t = &e->fracture->tips;
    bool on = t->n > 0;
    for (int k = 0; k < t->n && on; k++) {
        bool any = false;
        for (int m = 0; m < e->source.mirrors; m++)
            any |= (d < 0 || e->source.mirror[m].axis == d) && tip_on_mirror(t, &t->tip[k], &e->source.mirror[m], 1);
        on = any;
    }
    return on ? 0.5 : 1;
}

/* Length of the front of a crack in space [m]: of the edges of pre-cracks in the body, no more than the body's shortest
 * side, of which a plane of symmetry along the crack leaves half, and no less than a spacing; 1 in the plane. */
static real front_length(const struct run *e)
{
    const struct tips *t = &e->fracture->tips;
    real length = INFINITY, edges = 0, low, high;
    if (e->part.dim < 3) return 1;
    for (int d = 0; d < 3; d++) {
        particles_extent(&e->part, e->part.n, d, &low, &high);
        length = real_min(length, (high - low + e->scene->spacing) / advance_share(e, d));
    }
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) edges += 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, 3));
    return edges > 0 ? real_min(length, real_max(edges, e->scene->spacing)) : length;
}

/* Of bonds between materials a and b: of an interface as given, in state-based models of the weaker material; of bonds
 * with energies of their own, these at their limit. */
static real toughness_of_pair(const struct run *e, int a, int b)
{
    const struct scene *s = e->scene;
    const struct material *one = &s->material[a], *other = &s->material[b];
    const real least = real_min(toughness_of(e, one), toughness_of(e, other));
    for (int k = 0; k < s->interfaces && s->model != MODEL_BOND; k++) {
        const struct scene_interface *face = &s->interface[k];
        const int m = s->body[face->body[0]].material, n = s->body[face->body[1]].material;
        if (face->energy_release_rate > 0 && ((m == a && n == b) || (m == b && n == a)))
            return face->energy_release_rate;
    }
    const real limit = e->tables.pair_stretch[a * s->materials + b];
    if (a == b || s->model != MODEL_BOND || material_yields(one) || material_yields(other)) return least;
    const real c = family_micro_modulus(&e->source.family, one), d = family_micro_modulus(&e->source.family, other);
    return family_crossing_energy(&e->source.family, one) * 2 * d / (c + d) * square(limit / one->critical_stretch);
}

real toughness_between(const struct run *e, int64_t i, int64_t j)
{
    const struct particles *p = &e->part;
    return toughness_of_pair(e, p->material[i], p->material[j]) * square(bond_strength(p, i, j));
}

/* Area of an advance [m^2]. */
static real advance_area(const struct run *e)
{
    const struct scene *s = e->scene;
    const real ahead = ADVANCE_SPACINGS * (s->dim > 1 ? s->spacing : 1);
    return advance_share(e, -1) * ahead * scene_section(s) * front_length(e);
}

/* Pairs of bonds that may break between two equilibria: along a front, of each spacing of it. */
static int64_t breaks_most(const struct run *e)
{
    const real along = e->part.dim < 3 ? 1 : front_length(e) / e->scene->spacing;
    return (int64_t)(e->scene->steps.breaks * real_max(1, along));
}

/* ---- size of loads ----------------------------------------------------------------------------------------------- */

/* Sum of squares of what supports and rigid bodies go up to t; where they do not move, of applied forces. */
real statics_load_size(const struct run *e, real t)
{
    real sum = 0, forces = 0;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        const struct displacing by = displacing_make(l->boundary, e->part.dim, t);
        for (int64_t k = 0; k < l->n; k++) {
            real X[DIM_MAX], f[DIM_MAX];
            particle_place(&e->part, l->particle[k], X);
            for (int d = 0; d < e->part.dim && l->boundary->kind == BOUNDARY_VELOCITY; d++)
                if (l->boundary->components >> d & 1) sum += square(displacing_at(&by, X, d));
            if (!boundary_is_force(l->boundary)) continue;
            load_force_at(l, &e->part, k, t, f);
            forces += dot(f, f, e->part.dim);
        }
    }
    sum += statics_rigid_way2(e, t);
    return sqrt(sum > 0 ? sum : forces);
}

enum { SECANTS_MOST = 30 };

real statics_time_of_size(const struct run *e, real size)
{
    real from = e->statics->t, at_from = statics_load_size(e, from);
    real t = at_from > 0 ? from * size / at_from : from;
    for (int k = 0; k < SECANTS_MOST; k++) {
        const real at = statics_load_size(e, t), slope = (at - at_from) / (t - from);
        if (fabs(at - size) <= 1e-9 * size || !(slope != 0) || t == from) return t;
        from = t, at_from = at;
        t = real_max(0, from + (size - at) / slope);
    }
    return t;
}

/* ---- advances ---------------------------------------------------------------------------------------------------- */

/* A step that is broken off leaves the checkpoint of the one before it. */
status statics_go(struct run *e, real t)
{
    if (e->report->stop && *e->report->stop)
        return status_set(INTERRUPTED, "interrupted in load step %lld of %lld; go on with --resume",
                          (long long)e->clock.step + 1, (long long)e->clock.steps);
    TRY(statics_solve(e, t));
    e->statics->overload = statics_overload(e);
    return OK;
}

/* An advance more: bonds break at this pseudo-time, onto the end of the list. What fronts in space have left of a body
 * as they reached its other side tears in larger pieces: no load hangs on its way. */
static status advance_try(struct run *e, struct advance *a)
{
    struct statics *s = e->statics;
    const real before = statics_released(e), given = e->scene->steps.energy;
    const real cost = given > 0 ? given * (1 - 1e-3) : INFINITY, wide = advance_area(e) * (1 - 1e-3);
    const int64_t most = breaks_most(e);
    const bool remnant = e->part.dim == 3 && s->led.stretches > 0;
    const real within = remnant ? real_max(REMNANT, e->scene->steps.within) : e->scene->steps.within;
    real area = 0;
    *a = (struct advance){0};
    while ((given > 0 ? a->cost < cost : area < wide) && s->overload > LEFT) {
        if (statics_break(e, within, most, &a->cost, &area) == 0) break;
        if (e->scene->steps.control == CONTROL_ENERGY) {
            statics_pieces_make(e);
            s->severs = statics_unheld(e) != OK;
            if (s->severs) break;
        }
        TRY(statics_go(e, s->t));
    }
    a->release = (statics_released(e) - before) / square(statics_load_size(e, s->t));
    return OK;
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

real size_of_balance(const struct advance *a, const struct advance *b)
{
    const real release = a->release + b->release;
    return a->cost > 0 && release > 0 ? sqrt((a->cost + b->cost) / release) : INFINITY;
}

real size_of_advance(const struct advance *a) { return size_of_balance(a, &(struct advance){0}); }

struct advance advance_before(const struct advance *first, const struct advance *second)
{
    const real rate = first->release / first->cost, growth = second->release / second->cost - rate;
    const real release = first->release - 2 * growth * square(first->cost) / (first->cost + second->cost);
    return (struct advance){first->cost, real_max(0, release)};
}

/* Has nothing advanced yet, and is there a pre-crack? */
static bool pre_crack_stands(const struct run *e)
{
    bool stands = false;
    for (int k = 0; k < e->fracture->tips.n; k++) stands |= e->fracture->tips.tip[k].from_crack;
    return stands && e->statics->behind.cost == 0;
}

/* Looks for the next advance under the loads that there are. */
static status look_here(struct run *e)
{
    struct statics *s = e->statics;
    struct stand stand;
    struct advance second;
    if (led_leads(e)) {
        TRY(led_look_ahead(e));
        if (s->next.n > 0 || s->overload <= 1) return OK;        /* else bonds break where no tip leads to */
    }
    if (s->next.n > 0 || s->overload < (s->behind.cost > 0 ? STRESSED_FURTHER : STRESSED)) return OK;
    stand_take(&stand, e);
    s->next.n = 0;
    status tried = advance_try(e, &s->ahead);
    const int64_t bonds = s->next.n;
    if (tried == OK && bonds > 0 && pre_crack_stands(e)) {
        tried = advance_try(e, &second);
        if (second.cost > 0) s->behind = advance_before(&s->ahead, &second);
    }
    stand_give(&stand, e, &s->next);
    s->next.n = bonds;
    s->due = size_of_balance(&s->ahead, &s->behind);
    return tried;
}

/* Looks under the loads at which it comes, until these are what it says there. What it releases grows with the square
 * of what loads strain, which may be their size less a way on which nothing touches: secants of its root. */
static status look_there(struct run *e)
{
    struct statics *s = e->statics;
    struct stand stand;
    stand_take(&stand, e);
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
    stand_give(&stand, e, NULL);
    return looked;
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
    led_advance(e);
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

status statics_convert(struct run *e, int64_t broken)
{
    while (step_convert(e, broken)) {
        broken = 0;
        statics_precondition_free(e);
        statics_unknowns_free(e);
        statics_unknowns_make(e);
        e->statics->next.n = 0;
        TRY(statics_go(e, e->statics->t));
    }
    return OK;
}
