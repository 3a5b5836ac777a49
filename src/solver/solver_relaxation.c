/* Finds equilibria by adaptive dynamic relaxation (Kilic & Madenci 2010): motion in pseudo-time with unit time steps,
 * fictitious masses and damping, until the body is at rest. */
#include <math.h>

#include "base/team.h"
#include "solver_parts.h"

/* Moves the driven particles of p by 1/s->ramp of their final displacements in step number `step` of the relaxation.
 * Does nothing from step s->ramp on, when the supports have arrived. */
static void supports_move(const struct static_solver *s, struct particles *p, int64_t step)
{
    if (step >= s->ramp) return;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++)
            if (s->held[i] >> d & 1) p->x[d][i] += s->driven.of[d][i] / (real)s->ramp;
}

/* Context of damping_block: the solver and the particles of the body. */
struct relaxing {
    const struct static_solver *solver;
    const struct particles *part;
};

/* Adds three sums over the free components of particles first .. end - 1, from which the damping coefficient follows:
 * u^T k u to sum[0], u^T u to sum[1] and v^T v to sum[2]. u: displacements; v: velocities; k: diagonal estimate of
 * stiffness divided by mass, -(f^n - f^{n-1})/(Lambda v), from the change of the forces in a step. context: solver and
 * particles (struct relaxing). Called by reproducible_sums for each block of particles. */
static void damping_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct relaxing *relaxing = context;
    const struct static_solver *s = relaxing->solver;
    const struct particles *p = relaxing->part;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = first; i < end; i++) {
            if (s->held[i] >> d & 1) continue;
            const real u = p->x[d][i] - p->X[d][i], v = p->v[d][i];
            const real change = (p->f[d][i] - s->before.of[d][i]) / s->diagonal[i];
            if (v != 0) sum[0] -= square(u) * change / v;
            sum[1] += square(u);
            sum[2] += square(v);
        }
}

#define DAMPING_MOST 1.9 /* 2 would stop the motion */

/* Returns the damping coefficient c = 2 sqrt(u^T k u/u^T u), at most DAMPING_MOST [1], with u^T k u in sum[0] and u^T u
 * in sum[1] (damping_block); 0 if one of the sums is not positive. */
static real damping(const real *sum)
{
    const real ratio = sum[1] > 0 ? sum[0] / sum[1] : 0;
    return ratio > 0 ? real_min(2 * sqrt(ratio), DAMPING_MOST) : 0;
}

/* Makes one step of dynamic relaxation of the particles p, with a pseudo-time step of 1: v^{n+1/2} = ((2 - c) v^{n-1/2}
 * + 2 f/Lambda)/(2 + c) and x += v for free components. In the first step, which starts at rest, v = f/(2 Lambda).
 * Lambda: fictitious masses s->diagonal; c: damping coefficient [1]; step: number of the step. Stores the forces in
 * s->before. */
static void particles_move(struct static_solver *s, struct particles *p, int64_t step, real c)
{
    const real kick = step == 0 ? 0.5 : 2 / (2 + c), keep = (2 - c) / (2 + c);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++) {
            const real f = p->f[d][i];
            s->before.of[d][i] = f;
            if (s->held[i] >> d & 1) continue;
            p->v[d][i] = keep * p->v[d][i] + kick * f / s->diagonal[i];
            p->x[d][i] += p->v[d][i];
        }
}

status relaxation_step(struct static_solver *s, const struct static_body *body, int64_t step, bool *done)
{
    struct particles *p = body->part;
    real sum[3];
    supports_move(s, p, step);
    static_body_compute_bond_forces(body);
    loads_add_static_forces(body->loads, p);
    static_solver_compute_residual(s, p);
    loads_extract_static_reactions_from_forces(body->loads, p);
    reproducible_sums(p->n, 3, damping_block, &(struct relaxing){s, p}, sum);
    /* forces are also small when a body oscillates through its equilibrium: the speed must be small, too */
    s->farthest = real_max(s->farthest, sqrt(sum[1]));
    *done = step >= s->ramp && s->residual <= body->tolerance &&
            (s->residual == 0 || sqrt(sum[2]) <= 10 * body->tolerance * s->farthest);
    if (!*done) particles_move(s, p, step, step > 0 ? damping(sum) : 0);
    return OK;
}
