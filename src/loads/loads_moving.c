/* Updates loads whose factors per particle (shares) change from step to step: loads with formulas of time, and pressure
 * that follows the surface. The shares of these loads include the time function and the formula; their forces are
 * applied as for other loads (loads_applied.c). */
#include <math.h>
#include <string.h>

#include "loads/loads.h"
#include "loads_surface.h"
#include "base/memory.h"
#include "base/team.h"

/* Returns the formula by which the value of boundary b is multiplied, for component d (0 .. dim - 1); it belongs to b.
 * A pressure has one formula for all components. */
static const struct expression *formula_of(const struct boundary *b, int d)
{
    return &b->formula[b->kind == BOUNDARY_PRESSURE ? 0 : d];
}

/* Returns the value of the formula of boundary b for component d, at the reference position of particle i of p and time
 * t [s], in the unit of the value of the boundary. Returns 1 if there is no formula. */
static real formula_at(const struct boundary *b, int d, const struct particles *p, int32_t i, real t)
{
    real X[DIM_MAX];
    if (formula_of(b, d)->n == 0) return 1;
    particle_reference_position(p, i, X);
    return expression_evaluate(formula_of(b, d), X, p->dim, boundary_time_at_which_formulas_are_evaluated(b, t));
}

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Checks that the formulas of load l have finite values at all of its particles (indices in p) at time t [s]. Returns
 * `fault`, with a message, if a value is not finite, else OK. */
static status formula_finite(const struct load *l, const struct particles *p, real t, status fault)
{
    const struct boundary *b = l->boundary;
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < l->n; k++) {
            const int32_t i = l->particle[k];
            if (isfinite(formula_at(b, d, p, i, t))) continue;
            return status_set(fault,
                              "boundary %s: its formula has no finite value at (%.4g, %.4g, %.4g) m and t = %.4g s; "
                              "check its divisions and powers",
                              b->name, p->X[0][i], p->dim > 1 ? p->X[1][i] : 0, p->dim > 2 ? p->X[2][i] : 0,
                              boundary_time_at_which_formulas_are_evaluated(b, t));
        }
    return OK;
}

status loads_check_formula_values_are_finite(const struct loads *l, const struct particles *p, real t)
{
    for (int b = 0; b < l->n; b++) {
        const struct boundary *by = l->load[b].boundary;
        if (boundary_formula_depends_on_time(by))
            TRY(status_message_prepend_location(by->place, formula_finite(&l->load[b], p, t, FAILED)));
    }
    return OK;
}

/* Allocates an array of shares for each component of load l, in place of arrays that several components have in common.
 * A share is the area, volume or mass of a particle by which the value of the load is multiplied. p: all particles;
 * with: true to multiply the new shares by the formula of the component at time t [s]. */
static void shares_part(struct load *l, const struct particles *p, bool with, real t)
{
    for (int d = p->dim; d-- > 0;) {
        real *own = NEW("loads.share", l->n, real);
        for (int64_t k = 0; k < l->n; k++)
            own[k] = l->share[d][k] * (with ? formula_at(l->boundary, d, p, l->particle[k], t) : 1);
        if (d == 0 || l->share[d] != l->share[0]) memory_free(l->share[d]);
        l->share[d] = own;
    }
}

status load_prepare_particle_load_factors(struct load *l, const struct particles *p)
{
    const struct boundary *b = l->boundary;
    bool any = false;
    for (int d = 0; d < p->dim; d++) any |= b->formula[d].n > 0;
    if (any) TRY(formula_finite(l, p, 0, REFUSED));
    if (!boundary_applies_force(b) || l->n == 0) return OK;
    l->moving = l->surface || (boundary_formula_depends_on_time(b) && !b->frozen);
    if (any) shares_part(l, p, !l->moving, b->frozen_at);
    for (int d = 0; d < p->dim && l->moving; d++) {
        l->base[d] = NEW("loads.base", l->n, real);
        array_copy(l->base[d], l->share[d], l->n, sizeof(real));
    }
    return OK;
}

void load_time_varying_load_factors_free(struct load *l)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(l->base[d]);
    load_surface_free(l->surface);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Updates the array l->share[d] of a load whose formula changes in time, for the velocity update from t - dt to t [s].
 * The new share of a particle of p is its area, volume or mass l->base[d] times the mean, over both times, of the
 * product of time function and formula. half: dimensionless weight of the new shares; the old shares keep the weight 1
 * - half. */
static void moving_shares(struct load *l, const struct particles *p, int d, real t, real dt, real half)
{
    const struct boundary *b = l->boundary;
    const real from = time_function_value(&b->time, t - dt), to = time_function_value(&b->time, t);
    TEAM_LOOP(
        l->n > SUM_BLOCK, for (int64_t k = 0; k < l->n; k++) {
            const int32_t i = l->particle[k];
            const real kick = 0.5 * (from * formula_at(b, d, p, i, t - dt) + to * formula_at(b, d, p, i, t));
            l->share[d][k] = (1 - half) * l->share[d][k] + half * (l->base[d][k] * kick);
        });
}

/* Updates the shares of all loads of l that change in time, for the velocity update from t - dt to t [s]. A share is
 * the factor by which the value of a load is multiplied for one particle of p: its area, volume or mass times the
 * formula. The areas of pressures that follow the surface are computed anew before. half: dimensionless weight of the
 * new shares; the old shares keep the weight 1 - half. */
static void moving_update(struct loads *l, const struct particles *p, real t, real dt, real half)
{
    for (int b = 0; b < l->n; b++) {
        struct load *load = &l->load[b];
        if (!load->moving) continue;
        if (load->surface) load_surface_compute_area_vectors(load->surface, p, load->base);
        for (int d = 0; d < p->dim; d++)
            if (load->boundary->value[d] != 0) moving_shares(load, p, d, t, dt, half);
    }
}

void loads_update_time_mean_load_factors_for_forces(struct loads *l, const struct particles *p, real t,
                                                    real dt_velocity)
{
    moving_update(l, p, t, dt_velocity, 1);
}

/* Sets the shares of loads of l that change in time to those with which their work over the position update about time
 * t [s] is computed. A share is the factor on the value of a load for one particle of p: its area, volume or mass times
 * the formula. The result is the mean of the present shares, used in the velocity update before, and the shares of the
 * velocity update after it. Call after the position update, since the shares after it depend on the new positions. dt:
 * time step [s]. */
void loads_update_time_mean_load_factors_for_work(struct loads *l, const struct particles *p, real t, real dt)
{
    moving_update(l, p, t + dt, dt, 0.5);
}

/* ---- totals ----------------------------------------------------------------------------------------------------- */

/* Computes the force of load l on its particle number k (of p) at time t [s], from the reference position of the
 * particle, in force[dim] [N]. */
void load_force_on_particle(const struct load *l, const struct particles *p, int64_t index_in_load, real t, real *force)
{
    const struct boundary *b = l->boundary;
    const real factor = b->frozen ? 1 : time_function_value(&b->time, t);
    for (int d = 0; d < p->dim; d++) {
        const real share = l->moving ? l->base[d][index_in_load] * formula_at(b, d, p, l->particle[index_in_load], t)
                                     : l->share[d][index_in_load];
        force[d] = factor * b->value[d] * share;
    }
}

void load_compute_total_force_and_mean_displacement(struct load *l, const struct particles *p, real t)
{
    real force[DIM_MAX], *const *share = l->moving ? l->base : l->share;
    memset(l->reaction, 0, sizeof l->reaction);
    for (int64_t k = 0; k < l->n; k++) {
        load_force_on_particle(l, p, k, t, force);
        for (int d = 0; d < p->dim; d++) l->reaction[d] += force[d];
    }
    for (int d = 0; d < p->dim && l->n > 0; d++) {
        real total = 0, size = 0, moved = 0, mean = 0;
        for (int64_t k = 0; k < l->n; k++) {
            const real u = p->x[d][l->particle[k]] - p->X[d][l->particle[k]];
            total += share[d][k], size += fabs(share[d][k]), moved += share[d][k] * u, mean += u;
        }
        l->displacement[d] = fabs(total) > 1e-6 * size ? moved / total : mean / (real)l->n;
    }
}

void load_prescribed_value_at_particle(const struct load *l, const struct particles *p, int64_t index_in_load, real t,
                                       real *value)
{
    const struct boundary *b = l->boundary;
    const real factor = b->frozen ? 1 : time_function_value(&b->time, t);
    for (int d = 0; d < p->dim; d++)
        value[d] = factor * b->value[d] * formula_at(b, d, p, l->particle[index_in_load], t);
}
