/* Load steps: what supports and loads do from one pseudo-time to the next, equilibrium there, and its accounts. */
#include <float.h>
#include <math.h>

#include "balance.h"
#include "overload.h"
#include "pieces.h"
#include "springs.h"
#include "system.h"
#include "touch.h"
#include "trial.h"
#include "unknowns.h"

#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "step/report.h"
#include "step/step.h"

#define GAIN_MOST 0.01 /* share of what loads may have worked beyond the mean that a solution may gain */
enum { TRIES_MOST = 4, MORE_STRIDES = 4 };

/* ---- the way to a pseudo-time ------------------------------------------------------------------------------------ */

/* How much more of the same t makes of supports and loads, of which `before` were there; 0 where it makes others. */
static real growth_to(const struct statics *s, const struct particles *part, real t, real *const *before)
{
    real now = 0, was = 0;
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < part->dim; d++) {
            const real u = s->balance.u.of[d][k];
            if (s->load[k * DIM_MAX + d] >= 0) now += u * (u + s->way.of[d][k]), was += u * u;
        }
    for (int d = 0; d < part->dim && was == 0; d++)
        for (int64_t i = 0; i < part->n; i++) now += s->applied[d][i] * before[d][i], was += square(before[d][i]);
    return was > 0 && t != s->t ? now / was - 1 : 0;
}

/* The way to pseudo-time t: of supports what is prescribed, of the rest what a linear body does under proportional
 * loads. `before`: the applied forces until now. */
static void way_make(struct statics *s, const struct particles *p, const struct mesh *mesh, const struct loads *loads,
                     real t, real *const *before)
{
    struct displacing by[BOUNDARIES_MAX];
    for (int b = 0; b < loads->n; b++) by[b] = displacing_make(loads->load[b].boundary, p->dim, t);
    for (int64_t k = 0; k < s->balance.n; k++) {
        real X[DIM_MAX] = {0};
        if (s->balance.held[k]) unknown_position(s, p, mesh, k, X);
        for (int d = 0; d < p->dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            const real u = s->balance.u.of[d][k];
            if (s->balance.held[k] >> d & 1) s->way.of[d][k] = (load < 0 ? 0 : displacing_at(&by[load], X, d)) - u;
        }
    }
    const real growth = growth_to(s, p, t, before);
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (!(s->balance.held[k] >> d & 1)) s->way.of[d][k] = growth * s->balance.u.of[d][k];
    statics_pieces_hold(s, &s->way);
}

/* Norm of the forces that the round-off of positions makes, with a margin of ten [N]. */
static real round_off_of(const struct bonds *bonds, const struct particles *part)
{
    real sum = 0;
    for (int64_t r = 0; r < bonds->rows; r++) {
        const int32_t i = bonds->particle[r];
        const real spring = 0.25 * bonds_row_bound(bonds, part, r);
        for (int d = 0; d < part->dim; d++) sum += square(spring * part->X[d][i] * DBL_EPSILON);
    }
    return 10 * sqrt(sum);
}

/* ---- accounts ---------------------------------------------------------------------------------------------------- */

/* What the work of a step adds up from: forces before it, and displacements. */
struct account {
    struct field u, f;
    real *applied[DIM_MAX];
};

static void account_begin(struct account *a, const struct statics *s, const struct particles *part)
{
    for (int d = 0; d < part->dim; d++) {
        a->u.of[d] = BARE("statics.account", s->balance.n, real);
        a->f.of[d] = BARE("statics.account", s->balance.n, real);
        a->applied[d] = BARE("statics.account", part->n, real);
        array_copy(a->u.of[d], s->balance.u.of[d], s->balance.n, sizeof(real));
        array_copy(a->f.of[d], s->balance.f.of[d], s->balance.n, sizeof(real));
        if (s->applied[d])
            array_copy(a->applied[d], s->applied[d], part->n, sizeof(real));
        else
            array_fill_bytes(a->applied[d], 0, part->n, sizeof(real));
    }
}

/* Work of supports and of applied forces over the step, each by the mean of its forces at both ends, and what the bend
 * of the way adds; *before holds where loaded particles were. Returns how far that is from the work of loads that are
 * there as in the end, or as in the beginning, on the whole way [J]. */
static real account_end(struct account *a, const struct statics *s, const struct particles *p, struct loads *loads,
                        bool touched, real *const *before)
{
    real range[2] = {0};
    if (!touched) loads->work += s->balance.bent; /* else forces change on the way by what touches */
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->balance.n; k++) {
            const real way = s->balance.u.of[d][k] - a->u.of[d][k], now = s->balance.f.of[d][k], was = a->f.of[d][k];
            if (!(s->balance.held[k] >> d & 1)) continue;
            loads->constraint_work -= 0.5 * (was + now) * way;
            range[0] += 0.5 * (now - was) * way;
        }
        for (int64_t i = 0; i < p->n; i++) {
            const real way = p->x[d][i] - before[d][i], now = s->applied[d][i], was = a->applied[d][i];
            loads->work += 0.5 * (was + now) * way;
            range[1] += 0.5 * (now - was) * way;
        }
        memory_free(a->u.of[d]);
        memory_free(a->f.of[d]);
        memory_free(a->applied[d]);
    }
    return fabs(range[0]) + fabs(range[1]);
}

/* Books what was lost on the way since `lost` [J]. Where points yield or faces close, forces change other than evenly
 * on it, and loads and supports work other than the mean of both ends times it: less by up to `range` [J], or more;
 * where faces touch by as much at the most, as forces grow. Only what is beyond is lost, or comes from nowhere: faces
 * have gone through each other on the way, and hold the body in a state that loads cannot have led to. Returns whether
 * that is so. */
static bool lost_book(struct equilibrium *q, struct loads *loads, real lost, real range, bool touches, bool yields)
{
    real uneven = yields || touches ? real_min(q->lost - lost, range) : 0;
    if (touches && !yields) uneven = real_max(uneven, -range);
    loads->work -= uneven, q->lost -= uneven;
    return touches && !yields && lost - q->lost > GAIN_MOST * range;
}

/* ---- equilibrium ------------------------------------------------------------------------------------------------- */

/* FAILED, with the place of the largest residual and what helps. */
static status unbalanced(const struct statics *s, const struct particles *p, const struct mesh *mesh, int64_t step)
{
    real X[DIM_MAX] = {0};
    if (s->balance.n > 0) unknown_position(s, p, mesh, s->balance.worst, X);
    return status_set(
        FAILED,
        "load step %lld, t = %.6g s: no equilibrium, the residual stays at %.3g of the load (at most %.3g is "
        "required), most of it near x = %.6g, y = %.6g, z = %.6g m: check that every part is held and that the body "
        "can carry the loads, or use %ssteps.control: energy, more steps or a larger solver_tolerance",
        (long long)step, s->t, s->balance.residual, s->balance.tolerance, X[0], X[1], X[2],
        p->plastic_correction[0] ? "a yield_tangent of a thousandth of young, " : "");
}

/* *crossed: faces have gone through each other. */
static status solve_at(struct run *e, real t, bool *crossed)
{
    struct statics *s = e->statics;
    struct account account;
    real *before[DIM_MAX] = {0};
    const int64_t asked = s->balance.directions;
    const real lost = s->balance.lost;
    TRY(loads_finite(&e->loads, &e->part, t));
    statics_touch_begin(e, t);
    account_begin(&account, s, &e->part);
    for (int d = 0; d < e->part.dim; d++) {
        before[d] = BARE("statics.before", e->part.n, real);
        array_copy(before[d], e->part.x[d], e->part.n, sizeof(real));
    }
    applied_forces_make(s, &e->part, &e->loads, t);
    if (s->parted) statics_pieces_make(e);
    way_make(s, &e->part, &e->frame->mesh, &e->loads, t, account.applied);
    s->balance.applied = applied_forces_norm(s, &e->part, e->contact);
    if (!s->precondition) s->balance.noise = round_off_of(&e->bonds, &e->part);
    const status found = equilibrium_find(&s->balance, &s->way, t != s->t);
    statics_flow(e);
    frame_sync(e->frame, &e->part, &e->loads);
    loads_mirror(&e->loads, &e->part);
    s->t = t;
    const bool touched = statics_touched(s, e->contact);
    const real worked = e->loads.work + e->loads.constraint_work,
               range = account_end(&account, s, &e->part, &e->loads, touched, before);
    const real rigids = statics_touch_end(e, e->loads.work + e->loads.constraint_work - worked, lost);
    *crossed = lost_book(&s->balance, &e->loads, lost, range + rigids, touched || s->touches,
                         e->part.plastic_correction[0] != NULL);
    e->damped += s->balance.lost - lost;
    for (int d = 0; d < e->part.dim; d++) memory_free(before[d]);
    reactions_store(s, &e->part, &e->loads);
    s->solutions++;
    statics_precondition_watch(s, s->balance.directions - asked);
    return found == OK ? OK : unbalanced(s, &e->part, &e->frame->mesh, e->clock.step + 1);
}

/* The way to t in strides. */
static status solve_in(struct run *e, real t, int strides, bool *crossed)
{
    const real from = e->statics->t;
    *crossed = false;
    for (int k = 1; k <= strides && !*crossed; k++)
        TRY(solve_at(e, k == strides ? t : from + (t - from) * k / strides, crossed));
    return OK;
}

/* Divides the increment to t into more solutions if faces have gone through each other; once only where something
 * yields, as that cannot be undone. */
static status solve_whole(struct run *e, real t)
{
    const real from = e->statics->t;
    int strides = statics_strides(e->scene, e->rigid, t);
    bool crossed = false;
    if (!e->statics->meets || e->part.plastic_correction[0] || e->bonds.plastic_stretch)
        return solve_in(e, t, strides, &crossed);
    for (int k = 0; k < TRIES_MOST; k++, strides *= MORE_STRIDES) {
        struct memory_archive saved;
        trial_begin(e, &saved);
        const status solved = solve_in(e, t, strides, &crossed);
        if (solved != OK || !crossed || t == from) {
            memory_archive_free(&saved);
            return solved;
        }
        trial_undo(e, &saved, NULL);
    }
    return status_set(FAILED,
                      "load step %lld, t = %.6g s: crack faces pass through each other before equilibrium is reached: "
                      "use more load steps or a larger spacing",
                      (long long)e->clock.step + 1, t);
}

/* A step that is broken off leaves the checkpoint of the one before it. */
status statics_go(struct run *e, real t)
{
    if (e->report->stop && *e->report->stop)
        return status_set(INTERRUPTED, "interrupted in load step %lld of %lld; go on with --resume",
                          (long long)e->clock.step + 1, (long long)e->clock.steps);
    TRY(solve_whole(e, t));
    e->statics->overload = statics_overload(&e->bonds, &e->part, &e->source.limit);
    return OK;
}

status statics_convert(struct run *e, int64_t broken)
{
    while (step_convert(e, broken)) {
        broken = 0;
        statics_precondition_free(e->statics);
        statics_unknowns_free(e->statics);
        statics_unknowns_make(e);
        e->statics->next.n = 0;
        TRY(statics_go(e, e->statics->t));
    }
    return OK;
}
