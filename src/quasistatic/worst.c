/* Finds, before the first load step, the times at which the loads are largest or have other directions, and estimates
 * the largest ratio of bond stretch to critical stretch at these times. */
#include <math.h>

#include "balance.h"
#include "unconstrained.h"
#include "system.h"

#include "base/memory.h"
#include "quasistatic/load_steps.h"
#include "rigid/rigid_part.h"

#define SIDEWAYS 1e-3 /* share of the largest loads above which a different load is not round-off */
enum { LOAD_TIMES = 64, LOAD_PARTICLES = 1024 }; /* load times, and particles of each load, that are sampled */

/* The two sorts of loads: prescribed displacements of supports and rigid bodies [m], applied forces [N]. */
enum { DISPLACEMENTS, FORCES, SORTS };

/* Computes the scalar products of the loads of the run at time t with its loads at time u [s]: product[DISPLACEMENTS]
 * for the prescribed displacements [m^2], product[FORCES] for the applied forces [N^2]. Of each load about
 * LOAD_PARTICLES particles, evenly spaced, represent all. */
static void products(const struct run *run, real t, real u, real *product)
{
    const int dim = run->part.dim;
    product[DISPLACEMENTS] = product[FORCES] = 0;
    for (int b = 0; b < run->loads.n; b++) {
        const struct load *l = &run->loads.load[b];
        const int64_t stride = 1 + l->n / LOAD_PARTICLES;
        for (int64_t k = 0; k < l->n && l->boundary->kind == BOUNDARY_VELOCITY; k += stride) {
            real x[DIM_MAX], y[DIM_MAX];
            load_prescribed_displacement_of_particle(l, &run->part, k, t, x);
            load_prescribed_displacement_of_particle(l, &run->part, k, u, y);
            product[DISPLACEMENTS] += (real)stride * dot(x, y, dim);
        }
        for (int64_t k = 0; k < l->n && boundary_applies_force(l->boundary); k += stride) {
            real f[DIM_MAX], g[DIM_MAX];
            load_force_on_particle(l, &run->part, k, t, f);
            load_force_on_particle(l, &run->part, k, u, g);
            product[FORCES] += (real)stride * dot(f, g, dim);
        }
    }
    for (int k = 0; k < run->scene->rigids; k++) {
        real x[DIM_MAX], y[DIM_MAX];
        rigid_compute_prescribed_displacement(&run->rigid->body[k], t, x);
        rigid_compute_prescribed_displacement(&run->rigid->body[k], u, y);
        product[DISPLACEMENTS] += dot(x, y, dim);
    }
}

/* Times at which the loads of one sort have extreme values [s]; NAN: never. largest: the loads are largest; back: they
 * point most against the largest loads; beside: their component perpendicular to the largest loads is largest. */
struct worst {
    real largest, back, beside;
};

/* Largest scalar products of the loads found so far, for the times in struct worst [m^2 or N^2]. largest: of the
 * largest loads with themselves; back: minus the product of opposing loads with the largest loads; beside: square of
 * the component of loads perpendicular to the largest loads. */
struct found {
    real largest, back, beside;
};

/* Sets worst->largest, the time at which the loads are largest, to t [s] if the loads at t are larger than all before.
 * own: scalar product of the loads at t with themselves; found->largest: largest such product so far, updated. */
static void largest_update(real t, real own, struct worst *worst, struct found *found)
{
    if (own > found->largest * (1 + 1e-9)) found->largest = own, worst->largest = t;
}

/* Compares the loads at time t [s] with the largest loads. Sets worst->back to t if the loads at t point against the
 * largest ones more than at all earlier times; sets worst->beside to t if their part perpendicular to the largest ones
 * is larger than at all earlier times. own, with: scalar products of the loads at t with themselves and with the
 * largest loads; found: largest values so far, updated. Parts smaller than SIDEWAYS times the largest loads are
 * ignored. */
static void others_update(real t, real own, real with, struct worst *worst, struct found *found)
{
    const real size = found->largest, back = -with, beside = own - square(with) / size;
    if (back > real_max(found->back, SIDEWAYS * size)) found->back = back, worst->back = t;
    if (beside > real_max(found->beside, square(SIDEWAYS) * size)) found->beside = beside, worst->beside = t;
}

/* Stores the times at which loads are sampled in t[] [s]: LOAD_TIMES evenly distributed times up to `end`, then the
 * times in the tables of the loads before `end`. t = NULL: the times are only counted. Returns their number. */
static int64_t load_times(const struct loads *loads, real end, real *t)
{
    int64_t n = 0;
    for (int k = 1; k <= LOAD_TIMES; k++, n++)
        if (t) t[n] = end * k / LOAD_TIMES;
    for (int b = 0; b < loads->n; b++) {
        const struct time_function *f = &loads->load[b].boundary->time;
        for (int k = 0; k < f->n; k++) {
            if (!(f->t[k] > 0 && f->t[k] < end)) continue;
            if (t) t[n] = f->t[k];
            n++;
        }
    }
    return n;
}

/* Finds the times at which the loads of the run are largest, point most against the largest loads, and are most
 * perpendicular to them. Stores the times [s] in worst[SORTS] and scalar products of the loads in found[SORTS],
 * separately for prescribed displacements and for applied forces. */
static void worst_times_find(const struct run *run, struct worst *worst, struct found *found)
{
    const int64_t n = load_times(&run->loads, run->scene->duration, NULL);
    real *t = BARE("worst.times", n, real), own[SORTS], with[SORTS];
    load_times(&run->loads, run->scene->duration, t);
    for (int64_t k = 0; k < n; k++) {
        products(run, t[k], t[k], own);
        for (int c = 0; c < SORTS; c++) largest_update(t[k], own[c], &worst[c], &found[c]);
    }
    for (int64_t k = 0; k < n; k++) {
        products(run, t[k], t[k], own);
        for (int c = 0; c < SORTS; c++) {
            if (!(found[c].largest > 0)) continue;
            products(run, t[k], worst[c].largest, with);
            others_update(t[k], own[c], with[c], &worst[c], &found[c]);
        }
    }
    memory_free(t);
}

status run_find_equilibrium_for_cost_estimate(struct run *run, real t)
{
    statics_equation_system_make(run);
    TRY(equilibrium_find_at_time(run, t));
    return unconstrained_fragments_check_force_balance(run->statics, &run->part, true, run->clock.step + 1);
}

/* Finds the equilibrium of the run at time t [s]; does nothing if t is NAN. If the largest ratio of stretch to critical
 * stretch there exceeds *ratio, stores it in *ratio and t in *at. Returns FAILED, with a message, if there is no
 * equilibrium. */
static status worst_try(struct run *run, real t, real *at, real *ratio)
{
    if (isnan(t)) return OK;
    TRY(equilibrium_find_at_time(run, t));
    if (run->statics->stretch_ratio > *ratio) *ratio = run->statics->stretch_ratio, *at = t;
    return OK;
}

status run_predict_largest_ratio_to_critical_stretch(struct run *run, real first_load_time, real *load_time,
                                                     real *ratio)
{
    struct worst worst[SORTS] = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    struct found found[SORTS] = {{0}};
    real before[SORTS];
    worst_times_find(run, worst, found);
    products(run, first_load_time, first_load_time, before);
    *ratio = 0, *load_time = run->scene->duration;
    const int sort = found[DISPLACEMENTS].largest > 0 ? DISPLACEMENTS : FORCES;
    const bool alone = !(found[DISPLACEMENTS].largest > 0 && found[FORCES].largest > 0);
    if (alone && isnan(worst[sort].back) && isnan(worst[sort].beside) &&
        before[sort] > 0) { /* loads only grow in proportion */
        *ratio = run->statics->stretch_ratio * sqrt(found[sort].largest / before[sort]),
        *load_time = worst[sort].largest;
        return OK;
    }
    for (int c = 0; c < SORTS; c++) {
        TRY(worst_try(run, worst[c].largest, load_time, ratio));
        TRY(worst_try(run, worst[c].back, load_time, ratio));
        TRY(worst_try(run, worst[c].beside, load_time, ratio));
    }
    return OK;
}
