/* Load steps: what supports and loads do from one pseudo-time to the next, equilibrium there, and its accounts. */
#include "statics_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "mesh/mesh_part.h"
#include "contact/contact.h"

#define GAIN_MOST 0.01       /* share of what loads may have worked beyond the mean that a solution may gain */
enum { TRIES_MOST = 4, MORE_STRIDES = 4 };

/* ---- loads and supports ------------------------------------------------------------------------------------------ */

/* Applied forces at t, into `applied` [dim][particles of the body]. */
void statics_applied_make(struct run *e, real t)
{
    const struct particles *p = &e->part;
    for (int d = 0; d < p->dim; d++) {
        if (!e->statics->applied[d]) e->statics->applied[d] = NEW("statics.applied", p->n, real);
        array_fill_bytes(e->statics->applied[d], 0, p->n, sizeof(real));
    }
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        for (int64_t k = 0; boundary_is_force(l->boundary) && k < l->n; k++) {
            real force[DIM_MAX];
            load_force_at(l, p, k, t, force);
            for (int d = 0; d < p->dim; d++) e->statics->applied[d][l->particle[k]] += force[d];
        }
    }
}

/* Place of a node of the unknowns [m]. */
void statics_node_place(const struct run *e, int64_t k, real *X)
{
    const struct mesh *mesh = &e->frame->mesh;
    const int32_t i = e->statics->node[k];
    if (k < e->statics->particles) {
        particle_place(&e->part, i, X);
        return;
    }
    const int64_t at = mesh_base(mesh, i);
    for (int d = 0; d < e->part.dim; d++)
        X[d] = grid_position(&mesh->grid, d, at / mesh->grid.stride[d] % mesh->grid.count[d]);
}

/* How much more of the same t makes of supports and loads, of which `before` were there; 0 where it makes others. */
static real growth_to(const struct run *e, real t, real *const *before)
{
    const struct statics *s = e->statics;
    real now = 0, was = 0;
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < e->part.dim; d++) {
            const real u = s->balance.u.of[d][k];
            if (s->load[k * DIM_MAX + d] >= 0) now += u * (u + s->way.of[d][k]), was += u * u;
        }
    for (int d = 0; d < e->part.dim && was == 0; d++)
        for (int64_t i = 0; i < e->part.n; i++) now += s->applied[d][i] * before[d][i], was += square(before[d][i]);
    return was > 0 && t != e->statics->t ? now / was - 1 : 0;
}

/* The way to pseudo-time t: of supports what is prescribed, of the rest what a linear body does under proportional
 * loads. `before`: the applied forces until now. */
static void way_make(struct run *e, real t, real *const *before)
{
    struct statics *s = e->statics;
    struct displacing by[BOUNDARIES_MAX];
    for (int b = 0; b < e->loads.n; b++) by[b] = displacing_make(e->loads.load[b].boundary, e->part.dim, t);
    for (int64_t k = 0; k < s->balance.n; k++) {
        real X[DIM_MAX] = {0};
        if (s->balance.held[k]) statics_node_place(e, k, X);
        for (int d = 0; d < e->part.dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            const real u = s->balance.u.of[d][k];
            if (s->balance.held[k] >> d & 1) s->way.of[d][k] = (load < 0 ? 0 : displacing_at(&by[load], X, d)) - u;
        }
    }
    const real growth = growth_to(e, t, before);
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (!(s->balance.held[k] >> d & 1)) s->way.of[d][k] = growth * s->balance.u.of[d][k];
    statics_pieces_hold(e, &s->way);
}

/* Norm of applied forces on free components of particles, on points of the mesh that nothing drives, and of what rigid
 * bodies push [N]. */
real statics_applied_norm(const struct run *e)
{
    const struct statics *s = e->statics;
    const struct particles *p = &e->part;
    real sum = 0;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->particles; k++)
            if (!(s->balance.held[k] >> d & 1)) sum += square(s->weight[k] * s->applied[d][s->node[k]]);
        for (int64_t i = 0; i < p->n; i++)
            if (p->kind[i] != KIND_PD && !(p->flag[i] & FLAG_DRIVEN)) sum += square(s->applied[d][i]);
    }
    return hypot(sqrt(sum), contact_rigid_norm(e->contact, p));
}

/* Norm of the forces that the round-off of positions makes, with a margin of ten [N]. */
static real round_off_of(const struct run *e)
{
    real sum = 0;
    for (int64_t r = 0; r < e->bonds.rows; r++) {
        const int32_t i = e->bonds.particle[r];
        const real spring = 0.25 * bonds_row_bound(&e->bonds, &e->part, r);
        for (int d = 0; d < e->part.dim; d++) sum += square(spring * e->part.X[d][i] * DBL_EPSILON);
    }
    return 10 * sqrt(sum);
}

/* Books the forces of supports and loads, and their displacements. */
void statics_react(struct run *e)
{
    const struct statics *s = e->statics;
    for (int b = 0; b < e->loads.n; b++) {
        struct load *l = &e->loads.load[b];
        if (boundary_is_force(l->boundary)) load_applied_sum(l, &e->part, e->statics->t);
        if (l->boundary->kind != BOUNDARY_VELOCITY) continue;
        const struct displacing by = displacing_make(l->boundary, e->part.dim, e->statics->t);
        memset(l->reaction, 0, sizeof l->reaction);
        for (int d = 0; d < e->part.dim; d++) {
            real sum = 0, X[DIM_MAX] = {0};
            if (!(l->boundary->components >> d & 1)) continue;
            for (int64_t q = 0; q < l->n; q++)
                particle_place(&e->part, l->particle[q], X), sum += displacing_at(&by, X, d);
            l->displacement[d] = l->n > 0 ? sum / (real)l->n : 0;
        }
    }
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < e->part.dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            if (load >= 0) e->loads.load[load].reaction[d] -= s->balance.f.of[d][k] / s->weight[k];
        }
}

/* What the work of a step adds up from: forces before it, and displacements. */
struct account {
    struct field u, f;
    real *applied[DIM_MAX];
};

static void account_begin(struct account *a, const struct run *e)
{
    const struct statics *s = e->statics;
    for (int d = 0; d < e->part.dim; d++) {
        a->u.of[d] = BARE("statics.account", s->balance.n, real);
        a->f.of[d] = BARE("statics.account", s->balance.n, real);
        a->applied[d] = BARE("statics.account", e->part.n, real);
        array_copy(a->u.of[d], s->balance.u.of[d], s->balance.n, sizeof(real));
        array_copy(a->f.of[d], s->balance.f.of[d], s->balance.n, sizeof(real));
        if (s->applied[d])
            array_copy(a->applied[d], s->applied[d], e->part.n, sizeof(real));
        else
            array_fill_bytes(a->applied[d], 0, e->part.n, sizeof(real));
    }
}

/* Work of supports and of applied forces over the step, each by the mean of its forces at both ends, and what the bend
 * of the way adds; *before holds where loaded particles were. Returns how far that is from the work of loads that are
 * there as in the end, or as in the beginning, on the whole way [J]. */
static real account_end(struct account *a, struct run *e, real *const *before)
{
    struct statics *s = e->statics;
    real range[2] = {0};
    if (!statics_touched(e)) e->loads.work += s->balance.bent;      /* else forces change on the way by what touches */
    for (int d = 0; d < e->part.dim; d++) {
        for (int64_t k = 0; k < s->balance.n; k++) {
            const real way = s->balance.u.of[d][k] - a->u.of[d][k], now = s->balance.f.of[d][k], was = a->f.of[d][k];
            if (!(s->balance.held[k] >> d & 1)) continue;
            e->loads.constraint_work -= 0.5 * (was + now) * way;
            range[0] += 0.5 * (now - was) * way;
        }
        for (int64_t i = 0; i < e->part.n; i++) {
            const real way = e->part.x[d][i] - before[d][i], now = s->applied[d][i], was = a->applied[d][i];
            e->loads.work += 0.5 * (was + now) * way;
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
static bool lost_book(struct run *e, real lost, real range, bool touches)
{
    real *now = &e->statics->balance.lost;
    real uneven = e->part.relief[0] || touches ? real_min(*now - lost, range) : 0;
    if (touches && !e->part.relief[0]) uneven = real_max(uneven, -range);
    e->loads.work -= uneven, *now -= uneven;
    e->damped += *now - lost;
    return touches && !e->part.relief[0] && lost - *now > GAIN_MOST * range;
}

static status unbalanced(const struct run *e);

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
    account_begin(&account, e);
    for (int d = 0; d < e->part.dim; d++) {
        before[d] = BARE("statics.before", e->part.n, real);
        array_copy(before[d], e->part.x[d], e->part.n, sizeof(real));
    }
    statics_applied_make(e, t);
    if (s->parted) statics_pieces_make(e);
    way_make(e, t, account.applied);
    s->balance.applied = statics_applied_norm(e);
    if (!s->precondition) s->balance.noise = round_off_of(e);
    const status found = equilibrium_find(&s->balance, &s->way, t != s->t);
    statics_flow(e);
    frame_sync(e);
    loads_mirror(&e->loads, &e->part);
    e->statics->t = t;
    const real worked = e->loads.work + e->loads.constraint_work, range = account_end(&account, e, before);
    const bool touched = statics_touched(e);
    const real rigids = statics_touch_end(e, e->loads.work + e->loads.constraint_work - worked, lost);
    *crossed = lost_book(e, lost, range + rigids, touched || s->touches);
    for (int d = 0; d < e->part.dim; d++) memory_free(before[d]);
    statics_react(e);
    s->solutions++;
    statics_precondition_watch(e, s->balance.directions - asked);
    return found == OK ? OK : unbalanced(e);
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

/* In more strides where faces have gone through each other; what yields has no way back, and makes its way once. */
status statics_solve(struct run *e, real t)
{
    int strides = statics_strides(e, t);
    bool crossed = false;
    if (!statics_meets(e) || e->part.relief[0] || e->bonds.plastic_stretch) return solve_in(e, t, strides, &crossed);
    for (int k = 0; k < TRIES_MOST; k++, strides *= MORE_STRIDES) {
        struct stand stand;
        stand_take(&stand, e);
        const status solved = solve_in(e, t, strides, &crossed);
        if (solved != OK || !crossed || t == stand.t) {
            stand_free(&stand, e);
            return solved;
        }
        stand_give(&stand, e, NULL);
    }
    return status_set(FAILED, "load step %lld, t = %.6g s: faces go through each other on the way to equilibrium; more "
                      "load steps, or a larger spacing, are expected", (long long)e->clock.step + 1, t);
}

/* FAILED, with the place of the largest residual and what helps. */
static status unbalanced(const struct run *e)
{
    const struct statics *s = e->statics;
    real X[DIM_MAX] = {0};
    if (s->balance.n > 0) statics_node_place(e, s->balance.worst, X);
    return status_set(FAILED,
                      "load step %lld, t = %.6g s: no equilibrium, the residual stays at %.3g of the load (%.3g is "
                      "wanted), most of it near x = %.6g, y = %.6g, z = %.6g m; see whether every part is held and "
                      "loads are what the body bears, or choose %ssteps.control energy, more steps, or a larger "
                      "solver_tolerance",
                      (long long)e->clock.step + 1, e->statics->t, s->balance.residual, e->scene->solver_tolerance,
                      X[0], X[1], X[2], e->part.relief[0] ? "a yield_tangent of a thousandth of young, " : "");
}
