/* Load steps before they are made: the load times at which loads are worst, and how near bonds come to their limits. */
#include <math.h>

#include "balance.h"
#include "pieces.h"
#include "system.h"

#include "base/memory.h"
#include "quasistatic/load_steps.h"
#include "quasistatic/statics.h"
#include "rigid/rigid_part.h"

#define SIDEWAYS 1e-3               /* share of the largest loads from which others are no round-off */
enum { LOOKS = 64, PLACES = 1024 }; /* load times, and particles of each load, that are looked at */

/* Prescribed displacements of supports and rigid bodies at two load times, multiplied [m^2]; applied forces [N^2]. */
enum { WAYS, FORCES, SORTS };

static void products(const struct run *e, real t, real u, real *product)
{
    const int dim = e->part.dim;
    product[WAYS] = product[FORCES] = 0;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        const int64_t stride = 1 + l->n / PLACES;
        for (int64_t k = 0; k < l->n && l->boundary->kind == BOUNDARY_VELOCITY; k += stride) {
            real x[DIM_MAX], y[DIM_MAX];
            load_displacement_at(l, &e->part, k, t, x);
            load_displacement_at(l, &e->part, k, u, y);
            product[WAYS] += (real)stride * dot(x, y, dim);
        }
        for (int64_t k = 0; k < l->n && boundary_is_force(l->boundary); k += stride) {
            real f[DIM_MAX], g[DIM_MAX];
            load_force_at(l, &e->part, k, t, f);
            load_force_at(l, &e->part, k, u, g);
            product[FORCES] += (real)stride * dot(f, g, dim);
        }
    }
    for (int k = 0; k < e->scene->rigids; k++) {
        real x[DIM_MAX], y[DIM_MAX];
        rigid_displacement(&e->rigid->body[k], t, x);
        rigid_displacement(&e->rigid->body[k], u, y);
        product[WAYS] += dot(x, y, dim);
    }
}

/* Load times at which loads are the largest, are most turned back from those, and most beside them [s]; NAN: never. */
struct worst {
    real largest, back, beside;
};

/* The products so far: of the largest loads, and of what is found beyond them. */
struct found {
    real largest, back, beside;
};

static void largest_try(real t, real own, struct worst *worst, struct found *found)
{
    if (own > found->largest * (1 + 1e-9)) found->largest = own, worst->largest = t;
}

/* own: product of the loads at t with themselves; with: with the largest ones. */
static void others_try(real t, real own, real with, struct worst *worst, struct found *found)
{
    const real size = found->largest, back = -with, beside = own - square(with) / size;
    if (back > real_max(found->back, SIDEWAYS * size)) found->back = back, worst->back = t;
    if (beside > real_max(found->beside, square(SIDEWAYS) * size)) found->beside = beside, worst->beside = t;
}

/* Lists load times that are evenly spread, and those of tables [s] (t NULL: none is stored). Returns their number. */
static int64_t look_times(const struct loads *loads, real end, real *t)
{
    int64_t n = 0;
    for (int k = 1; k <= LOOKS; k++, n++)
        if (t) t[n] = end * k / LOOKS;
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

static void worst_find(const struct run *e, struct worst *worst, struct found *found)
{
    const int64_t n = look_times(&e->loads, e->scene->duration, NULL);
    real *t = BARE("worst.times", n, real), own[SORTS], with[SORTS];
    look_times(&e->loads, e->scene->duration, t);
    for (int64_t k = 0; k < n; k++) {
        products(e, t[k], t[k], own);
        for (int c = 0; c < SORTS; c++) largest_try(t[k], own[c], &worst[c], &found[c]);
    }
    for (int64_t k = 0; k < n; k++) {
        products(e, t[k], t[k], own);
        for (int c = 0; c < SORTS; c++) {
            if (!(found[c].largest > 0)) continue;
            products(e, t[k], worst[c].largest, with);
            others_try(t[k], own[c], with[c], &worst[c], &found[c]);
        }
    }
    memory_free(t);
}

status engine_equilibrium_try(struct run *e, real t)
{
    statics_unknowns_make(e);
    TRY(statics_go(e, t));
    return statics_unheld(e->statics, &e->part, e->clock.step + 1);
}

/* The equilibrium at load time t: keeps it if bonds are nearer to their limits than so far. */
static status worst_try(struct run *e, real t, real *at, real *overload)
{
    if (isnan(t)) return OK;
    TRY(statics_go(e, t));
    if (e->statics->overload > *overload) *overload = e->statics->overload, *at = t;
    return OK;
}

status engine_overload_worst(struct run *e, real first, real *at, real *overload)
{
    struct worst worst[SORTS] = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    struct found found[SORTS] = {{0}};
    real before[SORTS];
    worst_find(e, worst, found);
    products(e, first, first, before);
    *overload = 0, *at = e->scene->duration;
    const int sort = found[WAYS].largest > 0 ? WAYS : FORCES;
    const bool alone = !(found[WAYS].largest > 0 && found[FORCES].largest > 0);
    if (alone && isnan(worst[sort].back) && isnan(worst[sort].beside) && before[sort] > 0) { /* they only grow */
        *overload = e->statics->overload * sqrt(found[sort].largest / before[sort]), *at = worst[sort].largest;
        return OK;
    }
    for (int c = 0; c < SORTS; c++) {
        TRY(worst_try(e, worst[c].largest, at, overload));
        TRY(worst_try(e, worst[c].back, at, overload));
        TRY(worst_try(e, worst[c].beside, at, overload));
    }
    return OK;
}
