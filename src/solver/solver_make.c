/* Sets up static solvers (constraints, preconditioner, norm of the loads), and saves and restores their state. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/eigenvalue.h"
#include "base/memory.h"
#include "base/team.h"
#include "solver_parts.h"

/* Largest ratio of the moment of the loads to the sum of |force x distance| that counts as balanced [1]: the
 * irregular arrangement of particles alone may cause it. */
#define TURNING_MOST 0.05

static void field_make(struct field *v, int dim, int64_t n)
{
    for (int d = 0; d < dim; d++) v->of[d] = NEW("solver.field", n, real);
}

static void field_free(struct field *v)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(v->of[d]);
}

/* Context of solver_scaled_stiffness: the solver and the body whose stiffness is scaled. */
struct scaled {
    struct static_solver *solver;
    const struct static_body *body;
};

/* Computes y = Lambda^-1/2 K Lambda^-1/2 x, with the diagonal matrix Lambda = s->diagonal and the stiffness K of the
 * bonds. x, y: [dim][n]. context: solver and body (struct scaled). Called by largest_eigenvalue. Overwrites s->before
 * and the velocities of the particles. */
static void solver_scaled_stiffness(void *context, const real *x, real *y)
{
    const struct scaled *scaled = context;
    struct static_solver *s = scaled->solver;
    struct particles *p = scaled->body->part;
    struct field out = {{p->v[0], p->v[1], p->v[2]}};
    const int64_t n = p->n;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < n; i++) s->before.of[d][i] = x[d * n + i] / sqrt(s->diagonal[i]);
    static_body_compute_tangent_stiffness_product(scaled->body, &s->before, &out, 1 / scaled->body->spacing);
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < n; i++) y[d * n + i] = out.of[d][i] / sqrt(s->diagonal[i]);
}

#define MARGIN_OF_EIGENVALUE 1.02 /* the iteration converges from below */

/* Computes s->diagonal, the diagonal matrix Lambda of fictitious masses for dynamic relaxation of `body`. A unit time
 * step is stable if Lambda_i >= 1/4 sum_j |K_ij| (Kilic & Madenci 2010), with the stiffness K of the bonds as springs.
 * State-based models can be stiffer than these springs; Lambda is then multiplied by the largest eigenvalue of
 * Lambda^-1 K/4, which is computed from the forces of the model. */
static void make_diagonal(struct static_solver *s, const struct static_body *body)
{
    struct particles *p = body->part;
    const struct bonds *b = body->bonds;
    real most = 0;
    struct field kept = {{0}};
    for (int64_t r = 0; r < b->rows; r++) {
        s->diagonal[b->particle[r]] = 0.25 * bonds_row_stiffness_eigenvalue_upper_bound(b, p, r);
        most = real_max(most, s->diagonal[b->particle[r]]);
    }
    for (int64_t i = 0; i < p->n; i++)
        if (s->diagonal[i] < 1e-6 * most || most == 0) s->diagonal[i] = most > 0 ? 1e-6 * most : 1;
    field_make(&kept, p->dim, p->n);
    for (int d = 0; d < p->dim; d++) array_copy(kept.of[d], p->x[d], p->n, sizeof(real));
    struct scaled scaled = {s, body};
    const real stiffer = MARGIN_OF_EIGENVALUE * largest_eigenvalue(p->dim * p->n, solver_scaled_stiffness, &scaled) / 4;
    for (int64_t i = 0; i < p->n; i++) s->diagonal[i] *= real_max(1, stiffer);
    for (int d = 0; d < p->dim; d++) array_copy(p->x[d], kept.of[d], p->n, sizeof(real));
    static_body_compute_bond_forces(body); /* energies of state-based models use the dilatation at X */
    for (int d = 0; d < p->dim; d++) {
        array_fill_bytes(p->v[d], 0, p->n, sizeof(real));
        array_fill_bytes(p->f[d], 0, p->n, sizeof(real));
    }
    field_free(&kept);
}

/* Sets the weights and constraints in s of particles on planes of symmetry: such a particle stays on the plane, and
 * only half of it belongs to the body (weight 1/2 for each plane). All other particles have the weight 1. */
static void make_weights(struct static_solver *s, const struct static_body *body)
{
    const struct particles *p = body->part;
    for (int64_t i = 0; i < p->n; i++) s->weight[i] = 1;
    for (int b = 0; b < body->loads->n; b++) {
        const struct boundary *m = body->loads->load[b].boundary;
        for (int64_t i = 0; m->kind == BOUNDARY_MIRROR && i < p->n; i++) {
            if (fabs(p->X[m->axis][i] - m->at) > ON_SURFACE * body->spacing) continue;
            if (m->body >= 0 && p->body[i] != m->body) continue;
            s->weight[i] *= 0.5;
            s->held[i] |= (uint8_t)(m->hold_tangential ? (1 << DIM_MAX) - 1 : 1 << m->axis);
        }
    }
}

/* Returns the number of relaxation steps in which supports are moved to their final positions; 0 if no support of s
 * moves. The number is the length of `body` in spacings plus 1: motion spreads through the body by at most one spacing
 * per step, so that faster supports would strain the bonds next to them more than the rest. */
static int64_t supports_ramp(const struct static_solver *s, const struct static_body *body)
{
    const real most = field_largest_absolute_component(&s->driven, s->dim, s->n);
    return most > 0 ? 1 + (int64_t)(particles_bounding_box_longest_edge(body->part) / body->spacing) : 0;
}

/* Computes s->applied, the norm of the applied forces on free components, those that no support constrains [N]. Clears
 * p->f of the body. */
static void make_applied(struct static_solver *s, const struct static_body *body)
{
    struct particles *p = body->part;
    real norm[2];
    for (int d = 0; d < p->dim; d++) array_fill_bytes(p->f[d], 0, p->n, sizeof(real));
    loads_add_static_forces(body->loads, p);
    static_solver_compute_free_and_fixed_force_norms(s, p, norm);
    s->applied = norm[0];
    for (int d = 0; d < p->dim; d++) array_fill_bytes(p->f[d], 0, p->n, sizeof(real));
}

/* Computes s->noise: ten times the norm of the forces that round-off of positions causes in the body p at rest [N].
 * Residuals below s->noise have no meaning. */
static void make_noise(struct static_solver *s, const struct particles *p)
{
    real sum = 0;
    for (int64_t i = 0; i < s->n; i++)
        for (int d = 0; d < s->dim; d++) sum += square(s->diagonal[i] * p->X[d][i] * DBL_EPSILON);
    s->noise = 10 * sqrt(sum);
}

/* Returns true if a support or a plane of symmetry of l constrains component d of any particle. */
static bool component_constrained(const struct loads *l, int d)
{
    for (int b = 0; b < l->n; b++) {
        const struct boundary *c = l->load[b].boundary;
        if (c->kind == BOUNDARY_VELOCITY && (c->components >> d & 1)) return true;
        if (c->kind == BOUNDARY_MIRROR && (c->axis == d || c->hold_tangential)) return true;
    }
    return false;
}

/* Returns OK if the applied forces of `loads` along axis d are balanced, or if supports or planes of symmetry constrain
 * the body along d. Returns REFUSED, with a message, if not. */
static status force_balanced(const struct loads *loads, int d)
{
    real sum = 0, size = 0;
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        if (!boundary_applies_force(l->boundary)) continue;
        for (int64_t k = 0; k < l->n; k++) {
            sum += l->share[d][k] * l->boundary->value[d];
            size += fabs(l->share[d][k] * l->boundary->value[d]);
        }
    }
    if (fabs(sum) <= 1e-9 * size || component_constrained(loads, d)) return OK;
    return status_set(REFUSED,
                      "solver: nothing holds the body along %c against an applied force of %.4g N; balance the loads, "
                      "or hold that component somewhere by a boundary `fixed`",
                      "xyz"[d], sum);
}

/* Returns OK if the loads of `body` can have an equilibrium, else REFUSED, with a message. Forces are tested along each
 * axis; moments only for a single plane body without supports. */
static status loads_balanced(const struct static_body *body)
{
    struct loads *l = body->loads;
    for (int d = 0; d < body->part->dim; d++) TRY(force_balanced(l, d));
    if (body->part->dim != 2 || body->bodies != 1 || component_constrained(l, 0) || component_constrained(l, 1))
        return OK;
    const real turning = loads_add_inertia_relief_and_return_moment_ratio(l, body->part);
    if (turning <= TURNING_MOST) return OK;
    return status_set(REFUSED,
                      "solver: no support keeps the body from turning, but the moment of the loads is %.3g of the "
                      "largest possible one; balance the loads, or hold the body by boundaries `fixed`",
                      turning);
}

status static_solver_make(struct static_solver *s, const struct static_body *body, real ramp_time)
{
    struct particles *p = body->part;
    s->n = p->n, s->dim = p->dim;
    s->residual = INFINITY;
    s->ramp_time = ramp_time;
    s->held = NEW("solver.held", s->n, uint8_t);
    for (int d = 0; d < s->dim; d++) array_fill_bytes(p->v[d], 0, s->n, sizeof(real));
    field_make(&s->driven, s->dim, s->n);
    loads_compute_prescribed_static_displacements(body->loads, p, s->ramp_time, s->driven.of, s->held);
    TRY(loads_balanced(body));
    make_applied(s, body);
    return OK;
}

void static_solver_make_iteration_vectors(struct static_solver *s, const struct static_body *body,
                                          bool conjugate_gradients)
{
    s->weight = NEW("solver.weight", s->n, real);
    s->diagonal = NEW("solver.diagonal", s->n, real);
    field_make(&s->before, s->dim, s->n);
    make_weights(s, body);
    make_diagonal(s, body);
    make_noise(s, body->part);
    s->ramp = supports_ramp(s, body);
    if (!conjugate_gradients) return;
    field_make(&s->u, s->dim, s->n);
    field_make(&s->r, s->dim, s->n);
    field_make(&s->d, s->dim, s->n);
    field_make(&s->q, s->dim, s->n);
}

void static_solver_free(struct static_solver *s)
{
    memory_free(s->held);
    memory_free(s->weight);
    memory_free(s->diagonal);
    field_free(&s->driven);
    field_free(&s->before);
    field_free(&s->u);
    field_free(&s->r);
    field_free(&s->d);
    field_free(&s->q);
    *s = (struct static_solver){0};
}

static status field_archive(const struct field *v, struct archive *a, const char *name, const struct static_solver *s)
{
    for (int d = 0; d < s->dim; d++) {
        char entry[48];
        snprintf(entry, sizeof entry, "solver/%s%d", name, d);
        TRY(a->exchange(a, entry, v->of[d], (size_t)s->n * sizeof(real)));
    }
    return OK;
}

status static_solver_save_or_load(struct static_solver *s, struct archive *a)
{
    if (!s->held) return OK; /* explicit runs have no solver */
    ARCHIVE_VALUE(a, "solver/residual", s->residual);
    ARCHIVE_VALUE(a, "solver/scale", s->scale);
    ARCHIVE_VALUE(a, "solver/first", s->first);
    ARCHIVE_VALUE(a, "solver/way", s->farthest);
    ARCHIVE_VALUE(a, "solver/damping", s->damping);
    ARCHIVE_VALUE(a, "solver/past_limit", s->past_limit);
    if (!s->u.of[0]) return OK;
    ARCHIVE_VALUE(a, "solver/rz", s->rz);
    ARCHIVE_VALUE(a, "solver/strain_ratio", s->strain_ratio);
    ARCHIVE_VALUE(a, "solver/u_ratio", s->u_ratio);
    ARCHIVE_VALUE(a, "solver/least", s->best);
    ARCHIVE_VALUE(a, "solver/stalls", s->stalls);
    TRY(field_archive(&s->u, a, "u", s));
    TRY(field_archive(&s->r, a, "r", s));
    return field_archive(&s->d, a, "d", s);
}
