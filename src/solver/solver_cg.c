/* Solves K u = b by conjugate gradients (Hestenes & Stiefel 1952) without a stored matrix. K, the stiffness of the
 * bonds at the reference positions, is applied by differences of forces; the preconditioner is the diagonal matrix
 * Lambda. K is self-adjoint in the inner product with weight 1/2 for particles on a plane of symmetry, whose other half
 * belongs to the mirror image. */
#include <math.h>

#include "data/extent.h"
#include "base/team.h"
#include "solver_parts.h"

#define CHECK_STEPS 50 /* steps between evaluations of the true residual and of the reactions */

#define STALLS_MOST 5 /* restarts that do not halve the residual after which the rest is round-off */

/* ---- sums -------------------------------------------------------------------------------------------------------- */

/* Returns true if a support or a plane of symmetry constrains component d of particle i (s->held). */
static bool is_constrained(const struct static_solver *s, int64_t i, int d) { return s->held[i] >> d & 1; }

/* Adds to sum[0] the sum of weight d . K d over the free components of the particles first .. end - 1, with the search
 * direction d and K d in s->q. The weight is 1/2 for particles on a plane of symmetry, else 1. context: the solver
 * (struct static_solver). Called by reproducible_sums for each block of particles. */
static void curvature_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct static_solver *s = context;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = first; i < end; i++)
            if (!is_constrained(s, i, d)) sum[0] += s->weight[i] * s->d.of[d][i] * s->q.of[d][i];
}

/* Adds to sum[0] the sum of weight u . K u over all components of the particles first .. end - 1, with the
 * displacements u and K u in s->q. The weight is 1/2 for particles on a plane of symmetry, else 1. context: the solver
 * (struct static_solver). Called by reproducible_sums for each block of particles. */
static void energy_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct static_solver *s = context;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = first; i < end; i++) sum[0] += s->weight[i] * s->u.of[d][i] * s->q.of[d][i];
}

/* Adds the sum of weight r . r/Lambda to sum[0], and the sum of r . r to sum[1], over the particles first .. end - 1,
 * with the residual r and the diagonal preconditioner Lambda. The weight is 1/2 for particles on a plane of symmetry,
 * else 1. context: the solver (struct static_solver). Called by reproducible_sums for each block of particles. */
static void residual_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct static_solver *s = context;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = first; i < end; i++) {
            const real r2 = square(s->r.of[d][i]);
            sum[0] += s->weight[i] * r2 / s->diagonal[i];
            sum[1] += r2;
        }
}

/* Returns the energy scale of the body at unit strain: sum of Young's modulus times volume over the particles [J]. */
static real unit_energy(const struct static_body *body)
{
    const struct particles *p = body->part;
    real sum = 0;
    for (int64_t i = 0; i < p->n; i++) sum += body->material[p->material[i]].young * p->volume0[i];
    return sum;
}

/* ---- parts of a step --------------------------------------------------------------------------------------------- */

/* Computes the residual b - K u of `body` from the displacements u = s->u, with the applied forces b, and stores it in
 * p->f [N]. Unlike the residual that the iteration updates it contains no accumulated round-off. Stores in s the norm
 * of the reactions on constrained components, then sets these components to 0. */
static void true_residual(struct static_solver *s, const struct static_body *body)
{
    struct particles *p = body->part;
    real energy;
    static_body_compute_tangent_stiffness_product(body, &s->u, &s->q, s->u_ratio);
    reproducible_sums(s->n, 1, energy_block, s, &energy);
    if (energy > 0)
        s->u_ratio = sqrt(energy / unit_energy(body)) / field_largest_absolute_component(&s->u, s->dim, s->n);
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->f[d][i] = -s->q.of[d][i];
    loads_add_static_forces(body->loads, p);
    static_solver_compute_residual(s, p);
    loads_extract_static_reactions_from_forces(body->loads, p);
}

/* Sets the residual s->r to the forces p->f, 0 on constrained components, and restarts the search directions from this
 * residual. */
static void restart(struct static_solver *s, const struct particles *p)
{
    real sum[2];
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < s->n; i++) {
            s->r.of[d][i] = is_constrained(s, i, d) ? 0 : p->f[d][i];
            s->d.of[d][i] = s->r.of[d][i] / s->diagonal[i];
        }
    reproducible_sums(s->n, 2, residual_block, s, sum);
    s->rz = sum[0];
}

/* Starts conjugate gradients for `body`: computes the initial displacements, their residual and the first search
 * direction in s. */
static void solver_cg_start(struct static_solver *s, const struct static_body *body)
{
    const struct particles *p = body->part;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < s->n; i++) s->u.of[d][i] = p->x[d][i] - p->X[d][i] + s->driven.of[d][i];
    s->strain_ratio = s->u_ratio = 1 / body->spacing;
    s->best = INFINITY;
    true_residual(s, body);
    restart(s, p);
}

/* Advances conjugate gradients by a step: u += alpha d and r -= alpha K d, with K d in s->q; then computes the next
 * search direction d. alpha: factor of the search direction [1]. Returns r . r [N^2]. */
static real solver_cg_advance(struct static_solver *s, real alpha)
{
    real sum[2];
    for (int d = 0; d < s->dim; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < s->n; i++) {
            s->u.of[d][i] += alpha * s->d.of[d][i];
            if (!is_constrained(s, i, d)) s->r.of[d][i] -= alpha * s->q.of[d][i];
        }
    }
    reproducible_sums(s->n, 2, residual_block, s, sum);
    const real beta = sum[0] / s->rz;
    s->rz = sum[0];
    for (int d = 0; d < s->dim; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < s->n; i++) s->d.of[d][i] = s->r.of[d][i] / s->diagonal[i] + beta * s->d.of[d][i];
    }
    return sum[1];
}

/* Sets the positions of the particles of `body` to x = X + u, with the reference positions X and the displacements u =
 * s->u, and computes the bond forces there. Energies and stresses of state-based models follow from these forces. */
static void solver_cg_displace(const struct static_solver *s, const struct static_body *body)
{
    struct particles *p = body->part;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->x[d][i] = p->X[d][i] + s->u.of[d][i];
    static_body_compute_bond_forces(body);
}

/* Computes the residual of `body` from the displacements in s, and sets *done to true if it is at most body->tolerance,
 * else to false. Restarts the iteration if, by round-off, the residual exceeds twice by_recurrence, the value that the
 * iteration itself has updated [N]. step: number of the iteration. Returns FAILED, with a message, after STALLS_MOST
 * restarts without progress. */
static status check(struct static_solver *s, const struct static_body *body, int64_t step, real by_recurrence,
                    bool *done)
{
    true_residual(s, body);
    *done = s->residual <= body->tolerance;
    if (*done) solver_cg_displace(s, body);
    if (*done || s->residual * s->scale <= 2 * by_recurrence) return OK;
    s->stalls = s->residual < 0.5 * s->best ? 0 : s->stalls + 1;
    s->best = real_min(s->best, s->residual);
    restart(s, body->part);
    if (s->stalls < STALLS_MOST) return OK;
    solver_cg_displace(s, body); /* the last accepted state replaces the trial motion */
    return status_set(
        FAILED,
        "conjugate gradients at step %lld: the out-of-balance force stays at %.3g of the load, but %.3g is required; "
        "use a larger solver_tolerance (round-off limits it to 1e-8 for compact bodies, 1e-6 for slender "
        "ones), or check that the moments of the loads are balanced and every part has stiffness: a "
        "single row of particles has no bending stiffness%s",
        (long long)step, s->best, body->tolerance, particles_warning_text_if_far_from_origin(body->part).text);
}

status cg_step(struct static_solver *s, const struct static_body *body, int64_t step, bool *done)
{
    real curvature;
    if (step == 0) {
        solver_cg_start(s, body);
        if (s->rz == 0) return check(s, body, step, 0, done);
    }
    static_body_compute_tangent_stiffness_product(body, &s->d, &s->q, s->strain_ratio);
    reproducible_sums(s->n, 1, curvature_block, s, &curvature);
    if (!(curvature > 0))
        return status_set(FAILED,
                          "conjugate gradients at step %lld: a part of the body can move without resistance; hold "
                          "every part by a boundary `fixed`, or join it by bonds to a part that is held",
                          (long long)step);
    s->strain_ratio = sqrt(curvature / unit_energy(body)) / field_largest_absolute_component(&s->d, s->dim, s->n);
    const real left = sqrt(solver_cg_advance(s, s->rz / curvature));
    s->residual = left / s->scale;
    const bool claimed = left <= 0.9 * body->tolerance * s->scale;
    if (claimed || step % CHECK_STEPS == CHECK_STEPS - 1) return check(s, body, step, left, done);
    return OK;
}
