/* Load steps before they are made: the load times at which loads are worst, and how near bonds come to their limits. */
#include <math.h>

#include "balance.h"
#include "pieces.h"
#include "system.h"

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
        rigid_shift(&e->rigid->body[k], t, x);
        rigid_shift(&e->rigid->body[k], u, y);
        product[WAYS] += dot(x, y, dim);
    }
}

/* Load times at which loads are the largest, are most turned back from those, and most beside them [s]; NAN: never. */
struct worst {
    real largest, back, beside;
};

/* Looks at a load time. found: products of the largest, and of what is found so far beyond it. */
struct search {
    real largest[SORTS], back[SORTS], beside[SORTS];
};

static void largest_try(const struct run *e, real t, struct worst *worst, struct search *found)
{
    real own[SORTS];
    products(e, t, t, own);
    for (int c = 0; c < SORTS; c++)
        if (own[c] > found->largest[c] * (1 + 1e-9)) found->largest[c] = own[c], worst[c].largest = t;
}

static void others_try(const struct run *e, real t, struct worst *worst, struct search *found)
{
    for (int c = 0; c < SORTS; c++) {
        real own[SORTS], with[SORTS];
        const real size = found->largest[c];
        if (!(size > 0)) continue;
        products(e, t, t, own);
        products(e, t, worst[c].largest, with);
        const real back = -with[c], beside = own[c] - square(with[c]) / size;
        if (back > real_max(found->back[c], SIDEWAYS * size)) found->back[c] = back, worst[c].back = t;
        if (beside > real_max(found->beside[c], square(SIDEWAYS) * size))
            found->beside[c] = beside, worst[c].beside = t;
    }
}

typedef void look_fn(const struct run *e, real t, struct worst *worst, struct search *found);

/* Looks at load times that are evenly spread, and at those of tables. */
static void look_all(const struct run *e, look_fn *look, struct worst *worst, struct search *found)
{
    const real end = e->scene->duration;
    for (int k = 1; k <= LOOKS; k++) look(e, end * k / LOOKS, worst, found);
    for (int b = 0; b < e->loads.n; b++) {
        const struct time_function *f = &e->loads.load[b].boundary->time;
        for (int k = 0; k < f->n; k++)
            if (f->t[k] > 0 && f->t[k] < end) look(e, f->t[k], worst, found);
    }
}

status engine_equilibrium_try(struct run *e, real t)
{
    statics_unknowns_make(e);
    TRY(statics_go(e, t));
    return statics_unheld(e);
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
    struct search found = {{0}, {0}, {0}};
    real before[SORTS];
    look_all(e, largest_try, worst, &found);
    look_all(e, others_try, worst, &found);
    products(e, first, first, before);
    *overload = 0, *at = e->scene->duration;
    const int sort = found.largest[WAYS] > 0 ? WAYS : FORCES;
    const bool alone = !(found.largest[WAYS] > 0 && found.largest[FORCES] > 0);
    if (alone && isnan(worst[sort].back) && isnan(worst[sort].beside) && before[sort] > 0) { /* they only grow */
        *overload = e->statics->overload * sqrt(found.largest[sort] / before[sort]), *at = worst[sort].largest;
        return OK;
    }
    for (int c = 0; c < SORTS; c++) {
        TRY(worst_try(e, worst[c].largest, at, overload));
        TRY(worst_try(e, worst[c].back, at, overload));
        TRY(worst_try(e, worst[c].beside, at, overload));
    }
    return OK;
}
