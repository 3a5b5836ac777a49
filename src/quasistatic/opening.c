/* Control of load steps by the opening of a crack: computes the opening, the increase of the distance between two gauge
 * particles on both sides of the crack, and searches for the loads that result in a prescribed opening. */
#include "opening.h"

#include <math.h>

#include "balance.h"
#include "trial.h"

#include "data/particles.h"
#include "quasistatic/load_steps.h"

#define OPENING_ERROR 1e-4 /* relative error of a prescribed opening */
#define OPENING_FAR 1e-2   /* relative error of a prescribed opening that ends the run */
#define FAR_OFF 2.0        /* largest distance of a gauge position from the body [spacings] */

/* Largest numbers of iterations in the search for the loads of an opening. SECANTS_MOST: steps of the secant method;
 * BRACKETS_MOST: steps for bodies that yield, within a bracket. */
enum { SECANTS_MOST = 12, BRACKETS_MOST = 60 };

status crack_gauge_check_positions(const struct scene *scene, const struct particles *part)
{
    const struct scene_steps *s = &scene->steps;
    const real *const at[] = {s->from, s->to};
    const int64_t nearest[] = {particles_index_nearest_to_position(part, s->from),
                               particles_index_nearest_to_position(part, s->to)};
    for (int k = 0; k < 2; k++) {
        real X[DIM_MAX], away = 0;
        particle_reference_position(part, nearest[k], X);
        for (int d = 0; d < part->dim; d++) away += square(X[d] - at[k][d]);
        if (sqrt(away) > FAR_OFF * scene->spacing)
            return status_set(REFUSED,
                              "steps.%s: this position is %.3g m away from the body; give a position on the body, "
                              "where the gauge is mounted",
                              k ? "to" : "from", sqrt(away));
    }
    if (nearest[0] != nearest[1]) return OK;
    return status_set(
        REFUSED,
        "steps.from and steps.to are nearest to the same particle; give two positions, one on each side of the crack");
}

real crack_gauge_opening(const struct particles *part, const struct statics *statics)
{
    real now = 0, initial = 0;
    for (int d = 0; d < part->dim; d++) {
        const int64_t a = statics->gauge[0], b = statics->gauge[1];
        now += square(part->x[d][b] - part->x[d][a]);
        initial += square(part->X[d][b] - part->X[d][a]);
    }
    return sqrt(now) - sqrt(initial);
}

bool particles_or_bonds_may_yield(const struct particles *part, const struct bonds *bonds)
{
    return part->plastic_correction[0] || bonds->plastic_stretch;
}

/* State of one search for the pseudo-time at which the opening of a yielding body equals a prescribed opening. Since
 * the slope of the opening over the pseudo-time changes by a factor of hundreds where points yield, the secant method
 * is confined to a bracket as soon as there is one. */
struct opening_search {
    real t[2];      /* the last two pseudo-times, or the ends of the bracket: opening too small, too large [s] */
    real differ[2]; /* opening at these times minus the wanted opening [m] */
    bool bracket;   /* t[] and differ[] are the ends of a bracket */
    int last;       /* end of the bracket that was replaced last, 0 or 1 */
};

/* Adds a result to the search r for the pseudo-time at which the opening of a yielding body equals the wanted one: in
 * the equilibrium at pseudo-time t [s] the opening exceeds the wanted one by `differ` [m], which is negative if it is
 * smaller. Returns the next pseudo-time to try [s]: by the secant method, limited to 0 .. 2 t, or within a bracket by
 * its Illinois variant, which halves the difference of an end that was kept twice. Returns t if the opening has not
 * changed since the last call. */
static real opening_search_next(struct opening_search *r, real t, real differ)
{
    const int end = differ > 0;
    if (r->bracket && end == r->last) r->differ[!end] *= 0.5;
    if (!r->bracket && (r->differ[0] > 0) != end) {
        r->bracket = true;
        r->t[!end] = r->t[0], r->differ[!end] = r->differ[0];
    } else if (!r->bracket) {
        const real rise = differ - r->differ[0], next = t - differ * (t - r->t[0]) / rise;
        const bool constant = fabs(rise) <= OPENING_ERROR * fabs(differ);
        r->t[0] = t, r->differ[0] = differ;
        return constant ? t : real_min(real_max(next, 0), 2 * t);
    }
    r->t[end] = t, r->differ[end] = differ, r->last = end;
    return r->t[0] - r->differ[0] * (r->t[1] - r->t[0]) / (r->differ[1] - r->differ[0]);
}

/* Returns true if the opening `at` equals the opening `wanted` (both [m]) within the relative error `error`. */
static bool opening_is_near(real at, real wanted, real error) { return fabs(at - wanted) <= error * fabs(wanted); }

/* Finds the equilibrium of the run, whose body yields, at which the opening (change of distance between two gauge
 * particles) equals `wanted` [m]. Each attempt starts from the state at the call, since plastic strains depend on the
 * path; that state is restored after an attempt that fails. t: first pseudo-time tried [s]. *at: receives the opening
 * of the last attempt [m], which the caller compares. Returns FAILED, with a message, if an equilibrium is not found.
 */
static status find_opening_of_yielding_body(struct run *run, real wanted, real t, real *at)
{
    const struct statics *s = run->statics;
    *at = crack_gauge_opening(&run->part, s);
    struct opening_search search = {.t = {s->t}, .differ = {*at - wanted}};
    bool ends = opening_is_near(*at, wanted, OPENING_ERROR);
    for (int k = 0; k < BRACKETS_MOST && !ends; k++) {
        struct memory_archive saved;
        trial_equilibrium_begin(run, &saved);
        const status found = equilibrium_find_at_time(run, real_max(t, 0));
        *at = crack_gauge_opening(&run->part, s);
        const real tried = s->t;
        t = found == OK ? opening_search_next(&search, tried, *at - wanted) : tried;
        ends = k + 1 == BRACKETS_MOST || t == tried;
        const bool kept = opening_is_near(*at, wanted, ends ? OPENING_FAR : OPENING_ERROR);
        trial_equilibrium_end(run, &saved, found != OK || kept, NULL);
        TRY(found);
        ends |= kept;
    }
    return OK;
}

status equilibrium_find_at_crack_opening(struct run *run, real wanted_opening, real pseudo_time_guess)
{
    const bool yields = particles_or_bonds_may_yield(&run->part, &run->bonds);
    real at = crack_gauge_opening(&run->part, run->statics);
    if (yields) TRY(find_opening_of_yielding_body(run, wanted_opening, pseudo_time_guess, &at));
    for (int k = 0; k < SECANTS_MOST && !yields; k++) { /* secant method */
        const real from = run->statics->t, before = at;
        TRY(equilibrium_find_at_time(run, real_max(pseudo_time_guess, 0)));
        at = crack_gauge_opening(&run->part, run->statics);
        const real change = run->statics->t - from, slope = (at - before) / change;
        if (opening_is_near(at, wanted_opening, OPENING_ERROR) || change == 0 || !(slope != 0)) break;
        pseudo_time_guess = run->statics->t + (wanted_opening - at) / slope;
    }
    if (opening_is_near(at, wanted_opening, OPENING_FAR)) return OK;
    return status_set(
        FAILED,
        "load step %lld: no load opens the gauge (steps.from to steps.to) by %.6g m, and the last one tried opens it "
        "by %.6g m; use larger loads or more steps, or a displacement with steps.control: load",
        (long long)run->clock.step + 1, wanted_opening, at);
}
