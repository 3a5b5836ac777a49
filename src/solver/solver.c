/* Computes forces, products with the tangent stiffness, and residuals for the static solvers. */
#include <math.h>

#include "base/team.h"
#include "solver_parts.h"
#include "loads/mirrors.h"

void static_body_compute_bond_forces(const struct static_body *body)
{
    loads_update_mirror_images_of_particles(body->loads, body->part);
    bond_forces(body->force, body->bonds, body->part, &bond_limit_never, NULL);
}

real field_largest_absolute_component(const struct field *vectors, int dim, int64_t vector_count)
{
    real most = 0;
    for (int d = 0; d < dim; d++) {
        const real *a = vectors->of[d];
#pragma omp parallel for schedule(static) reduction(max : most)
        for (int64_t i = 0; i < vector_count; i++) most = real_max(most, fabs(a[i]));
    }
    return most;
}

/* Strain of the displacements over which a difference of forces is computed [1]. The round-off of positions
 * x, a strain of eps |x|/dx with the machine precision eps and the spacing dx, is 1e-14 in a body of 100
 * spacings: 1e-8 of a force at a strain of 3e-6. The second-order error of central differences is below
 * 1e-10. */
#define TANGENT_STRAIN 3e-6

void static_body_compute_tangent_stiffness_product(const struct static_body *body, const struct field *displacement,
                                                   struct field *force, real strain_per_displacement)
{
    struct particles *p = body->part;
    const real most = field_largest_absolute_component(displacement, p->dim, p->n);
    const real s = most > 0 ? TANGENT_STRAIN / (strain_per_displacement * most) : 0;
    for (int sign = 1; sign >= -1; sign -= 2) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++) p->x[d][i] = p->X[d][i] + sign * s * displacement->of[d][i];
        static_body_compute_bond_forces(body);
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++)
                force->of[d][i] = s == 0 ? 0 : sign > 0 ? p->f[d][i] : (p->f[d][i] - force->of[d][i]) / (2 * s);
    }
}

/* Parameters of solver_force_block: particles, and their constrained components, one byte per particle with one bit per
 * axis. */
struct constrained_forces {
    const struct particles *part;
    const uint8_t *held;
};

/* Adds the squares of the forces on particles first .. end - 1 [N^2]: over free components to sum[0], over constrained
 * components to sum[1]. context: particles and constraints (struct constrained_forces). Called by reproducible_sums for
 * each block of particles. */
static void solver_force_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct constrained_forces *f = context;
    for (int d = 0; d < f->part->dim; d++)
        for (int64_t i = first; i < end; i++) sum[f->held[i] >> d & 1] += square(f->part->f[d][i]);
}

void static_solver_compute_free_and_fixed_force_norms(const struct static_solver *s, const struct particles *p,
                                                      real *norm)
{
    reproducible_sums(p->n, 2, solver_force_block, &(struct constrained_forces){p, s->held}, norm);
    norm[0] = sqrt(norm[0]), norm[1] = sqrt(norm[1]);
}

void static_solver_compute_relative_residual(struct static_solver *s, real reaction_norm, real unbalanced_norm)
{
    s->scale = real_max(s->applied, reaction_norm);
    /* without loads the scale is the initial residual */
    if (s->scale <= s->noise) s->scale = s->first = real_max(s->first, unbalanced_norm);
    const bool rests = unbalanced_norm == 0 || (s->scale == s->first && unbalanced_norm <= s->noise);
    s->residual = rests ? 0 : unbalanced_norm / s->scale;
}

void static_solver_compute_residual(struct static_solver *s, const struct particles *p)
{
    real norm[2];
    static_solver_compute_free_and_fixed_force_norms(s, p, norm);
    static_solver_compute_relative_residual(s, norm[1], norm[0]);
}
