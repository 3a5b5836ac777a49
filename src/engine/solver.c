/* Static equilibrium: functions that its solvers share, and the loop round them. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/pd/bond_laws.h"
#include "base/eigenvalue.h"
#include "engine_report.h"
#include "base/memory.h"
#include "solver_parts.h"

/* Largest moment of loads, relative to what they could make, that scattered particles explain. */
#define TURNING_MOST 0.05

/* ---- forces ------------------------------------------------------------------------------------------------------ */

void solver_bond_force(struct engine *e)
{
    loads_mirror(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
}

real solver_largest(const struct field *v, int dim, int64_t n)
{
    real most = 0;
    for (int d = 0; d < dim; d++) {
        const real *a = v->of[d];
#pragma omp parallel for schedule(static) reduction(max : most)
        for (int64_t i = 0; i < n; i++) most = real_max(most, fabs(a[i]));
    }
    return most;
}

/* Bond forces come from positions, whose last bit is a strain of eps |x|/dx, 1e-14 in a body of 100 spacings: at
 * strains of 3e-6 that is 1e-8 of a force. The second-order error of central differences is below 1e-10 there. */
#define TANGENT_STRAIN 3e-6

void solver_tangent(struct engine *e, const struct field *in, struct field *out, real strain_ratio)
{
    struct particles *p = &e->part;
    const real most = solver_largest(in, p->dim, p->n);
    const real s = most > 0 ? TANGENT_STRAIN / (strain_ratio * most) : 0;
    for (int sign = 1; sign >= -1; sign -= 2) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++) p->x[d][i] = p->X[d][i] + sign * s * in->of[d][i];
        solver_bond_force(e);
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++)
                out->of[d][i] = s == 0 ? 0 : sign > 0 ? p->f[d][i] : (p->f[d][i] - out->of[d][i]) / (2 * s);
    }
}

/* Sums of squares of forces on free components, sum[0], and on constrained ones, sum[1]. */
static void solver_force_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct engine *e = context;
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t i = first; i < end; i++) sum[e->solver.held[i] >> d & 1] += square(e->part.f[d][i]);
}

void solver_scale(struct solver *s, real reaction, real left)
{
    s->scale = real_max(s->applied, reaction);
    if (s->scale <= s->noise) s->scale = s->first = real_max(s->first, left);   /* no load: the residual of the start */
    const bool rests = left == 0 || (s->scale == s->first && left <= s->noise);
    s->residual = rests ? 0 : left / s->scale;
}

void solver_measure(struct engine *e)
{
    struct solver *s = &e->solver;
    real sum[2];
    team_sums(e->part.n, 2, solver_force_block, e, sum);
    solver_scale(s, sqrt(sum[1]), sqrt(sum[0]));
}

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

static void field_make(struct field *v, int dim, int64_t n)
{
    for (int d = 0; d < dim; d++) v->of[d] = NEW("solver.field", n, real);
}

static void field_free(struct field *v)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(v->of[d]);
}

/* y = Lambda^-1/2 K Lambda^-1/2 x, both [dim n]; `before` and v are scratch arrays. */
static void solver_scaled_stiffness(void *engine, const real *x, real *y)
{
    struct engine *e = engine;
    struct solver *s = &e->solver;
    struct field out = {{e->part.v[0], e->part.v[1], e->part.v[2]}};
    const int64_t n = e->part.n;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < n; i++) s->before.of[d][i] = x[d * n + i] / sqrt(s->diagonal[i]);
    solver_tangent(e, &s->before, &out, 1 / e->scene->spacing);
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < n; i++) y[d * n + i] = out.of[d][i] / sqrt(s->diagonal[i]);
}

#define MARGIN_OF_EIGENVALUE 1.02        /* the iteration converges from below */

/* Lambda_i >= 1/4 sum |K_ij| for a unit step (Kilic & Madenci 2010), of the bonds as springs; scaled up by the largest
 * eigenvalue where the model is stiffer than its springs. */
static void make_diagonal(struct engine *e)
{
    struct solver *s = &e->solver;
    struct particles *p = &e->part;
    real most = 0;
    struct field kept = {{0}};
    for (int64_t r = 0; r < e->bonds.rows; r++) {
        s->diagonal[e->bonds.particle[r]] = 0.25 * bonds_row_bound(&e->bonds, p, r);
        most = real_max(most, s->diagonal[e->bonds.particle[r]]);
    }
    for (int64_t i = 0; i < p->n; i++)
        if (s->diagonal[i] < 1e-6 * most || most == 0) s->diagonal[i] = most > 0 ? 1e-6 * most : 1;
    field_make(&kept, p->dim, p->n);
    for (int d = 0; d < p->dim; d++) memcpy(kept.of[d], p->x[d], (size_t)p->n * sizeof(real));
    const real stiffer = MARGIN_OF_EIGENVALUE * largest_eigenvalue(p->dim * p->n, solver_scaled_stiffness, e) / 4;
    for (int64_t i = 0; i < p->n; i++) s->diagonal[i] *= real_max(1, stiffer);
    for (int d = 0; d < p->dim; d++) memcpy(p->x[d], kept.of[d], (size_t)p->n * sizeof(real));
    solver_bond_force(e);                /* energies of state-based models use it */
    for (int d = 0; d < p->dim; d++) {
        memset(p->v[d], 0, (size_t)p->n * sizeof(real));
        memset(p->f[d], 0, (size_t)p->n * sizeof(real));
    }
    field_free(&kept);
}

/* Weights and constraints of particles on planes of symmetry: no force takes them off the plane, and only half of each
 * belongs to the body. */
static void make_weights(struct engine *e)
{
    struct solver *s = &e->solver;
    for (int64_t i = 0; i < e->part.n; i++) s->weight[i] = 1;
    for (int b = 0; b < e->loads.n; b++) {
        const struct boundary *m = e->loads.load[b].boundary;
        for (int64_t i = 0; m->kind == BOUNDARY_MIRROR && i < e->part.n; i++) {
            if (fabs(e->part.X[m->axis][i] - m->at) > ON_SURFACE * e->scene->spacing) continue;
            if (m->body >= 0 && e->part.body[i] != m->body) continue;
            s->weight[i] *= 0.5;
            s->held[i] |= (uint8_t)(m->hold_tangential ? (1 << DIM_MAX) - 1 : 1 << m->axis);
        }
    }
}

/* Steps in which supports reach their place. Relaxation spreads by one spacing per step at the most: over as many steps
 * as the body has spacings, supports strain bonds about as much as the body. */
static int64_t supports_ramp(const struct engine *e)
{
    const struct particles *p = &e->part;
    const real most = solver_largest(&e->solver.driven, p->dim, p->n);
    return most > 0 ? 1 + (int64_t)(particles_longest(p) / e->scene->spacing) : 0;
}

/* Norm of the applied forces on free components, s->applied [N]. */
static void make_applied(struct engine *e)
{
    struct particles *p = &e->part;
    for (int d = 0; d < p->dim; d++) memset(p->f[d], 0, (size_t)p->n * sizeof(real));
    loads_static_force(&e->loads, p);
    real sum[2];
    team_sums(p->n, 2, solver_force_block, e, sum);
    e->solver.applied = sqrt(sum[0]);
    for (int d = 0; d < p->dim; d++) memset(p->f[d], 0, (size_t)p->n * sizeof(real));
}

/* Norm of the forces that the round-off of positions makes in a body at rest [N], with a margin of ten. */
static void make_noise(struct engine *e)
{
    struct solver *s = &e->solver;
    real sum = 0;
    for (int64_t i = 0; i < s->n; i++)
        for (int d = 0; d < s->dim; d++) sum += square(s->diagonal[i] * e->part.X[d][i] * DBL_EPSILON);
    s->noise = 10 * sqrt(sum);
}

/* True if a support or a plane of symmetry constrains component d of any particle. */
static bool component_constrained(const struct engine *e, int d)
{
    for (int b = 0; b < e->loads.n; b++) {
        const struct boundary *c = e->loads.load[b].boundary;
        if (c->kind == BOUNDARY_VELOCITY && (c->components >> d & 1)) return true;
        if (c->kind == BOUNDARY_MIRROR && (c->axis == d || c->hold_tangential)) return true;
    }
    return false;
}

/* REFUSED for loads without equilibrium: neither balanced nor carried by supports. */
static status balance_checked(struct engine *e)
{
    for (int d = 0; d < e->part.dim; d++) {
        real sum = 0, size = 0;
        for (int b = 0; b < e->loads.n; b++) {
            const struct load *l = &e->loads.load[b];
            if (l->boundary->kind != BOUNDARY_TRACTION && l->boundary->kind != BOUNDARY_BODY_FORCE) continue;
            for (int64_t k = 0; k < l->n; k++) {
                sum += l->share[d][k] * l->boundary->value[d];
                size += fabs(l->share[d][k] * l->boundary->value[d]);
            }
        }
        if (fabs(sum) > 1e-9 * size && !component_constrained(e, d))
            return status_set(REFUSED,
                              "nothing holds the body along %c against an applied force of %.4g N; balance the "
                              "loads, or hold that component somewhere",
                              "xyz"[d], sum);
    }
    if (e->part.dim != 2 || e->scene->bodies != 1 || component_constrained(e, 0) || component_constrained(e, 1))
        return OK;
    const real turning = loads_static_balance(&e->loads, &e->part);
    if (turning > TURNING_MOST)
        return status_set(REFUSED,
                          "nothing keeps the body from turning under loads whose moment is %.3g of what they could "
                          "make; balance the loads, or hold the body somewhere",
                          turning);
    return OK;
}

status solver_make(struct engine *e)
{
    struct solver *s = &e->solver;
    const struct scene *c = e->scene;
    s->n = e->part.n, s->dim = e->part.dim;
    s->residual = INFINITY;
    s->held = NEW("solver.held", s->n, uint8_t);
    for (int d = 0; d < s->dim; d++) memset(e->part.v[d], 0, (size_t)s->n * sizeof(real));
    field_make(&s->driven, s->dim, s->n);
    grid_relaxation_make(e);
    loads_static_boundaries(e->boundary, c->boundary, c->boundaries, c->duration, s->ramp_time);
    loads_static_driven(&e->loads, &e->part, s->ramp_time, s->driven.of, s->held);
    TRY(balance_checked(e));
    make_applied(e);
    if (c->method != METHOD_PD) {
        for (int b = 0; b < e->loads.n; b++)     /* the steps of these solvers add it up */
            memset(e->loads.load[b].displacement, 0, sizeof e->loads.load[b].displacement);
        return OK;
    }
    s->weight = NEW("solver.weight", s->n, real);
    s->diagonal = NEW("solver.diagonal", s->n, real);
    field_make(&s->before, s->dim, s->n);
    make_weights(e);
    make_diagonal(e);
    make_noise(e);
    s->ramp = supports_ramp(e);
    if (c->solver != SOLVER_CG) return OK;
    field_make(&s->u, s->dim, s->n);
    field_make(&s->r, s->dim, s->n);
    field_make(&s->d, s->dim, s->n);
    field_make(&s->q, s->dim, s->n);
    return OK;
}

void solver_free(struct solver *s)
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
    *s = (struct solver){0};
}

static status field_archive(const struct field *v, struct archive *a, const char *name, const struct solver *s)
{
    for (int d = 0; d < s->dim; d++) {
        char entry[48];
        snprintf(entry, sizeof entry, "solver/%s%d", name, d);
        TRY(a->exchange(a, entry, v->of[d], (size_t)s->n * sizeof(real)));
    }
    return OK;
}

status solver_archive(struct solver *s, struct archive *a)
{
    if (!s->held) return OK;             /* an explicit run */
    ARCHIVE_VALUE(a, "solver/residual", s->residual);
    ARCHIVE_VALUE(a, "solver/scale", s->scale);
    ARCHIVE_VALUE(a, "solver/first", s->first);
    ARCHIVE_VALUE(a, "solver/way", s->way);
    ARCHIVE_VALUE(a, "solver/damping", s->damping);
    ARCHIVE_VALUE(a, "solver/past_limit", s->past_limit);
    if (!s->u.of[0]) return OK;
    ARCHIVE_VALUE(a, "solver/rz", s->rz);
    ARCHIVE_VALUE(a, "solver/strain_ratio", s->strain_ratio);
    ARCHIVE_VALUE(a, "solver/u_ratio", s->u_ratio);
    ARCHIVE_VALUE(a, "solver/least", s->least);
    ARCHIVE_VALUE(a, "solver/stalls", s->stalls);
    TRY(field_archive(&s->u, a, "u", s));
    TRY(field_archive(&s->r, a, "r", s));
    return field_archive(&s->d, a, "d", s);
}

/* ---- the loop ---------------------------------------------------------------------------------------------------- */

/* Intact bonds beyond the stretch at which a run in time would break them. */
static int64_t bonds_past_limit(const struct engine *e)
{
    const struct bonds *b = &e->bonds;
    const struct particles *p = &e->part;
    int64_t past = 0;
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bonds_of_row(b, r); bond_next(&it);) {
            const int32_t i = b->particle[r], j = it.bond.nbr;
            const real limit = e->pair_stretch[p->material[i] * e->scene->materials + p->material[j]];
            past += it.bond.w != 0 && j > i && bond_elastic_of(b, p, &it.bond, i) > limit;
        }
    return past;
}

static void say_past_limit(struct engine *e)
{
    char text[160];
    snprintf(text, sizeof text,
             "%lld bonds are beyond their critical stretch in the solution, and none broke: smaller loads, or "
             "solver explicit",
             (long long)e->solver.past_limit);
    if (e->solver.past_limit > 0) engine_say(e, text);
}

#define STRAIN_LARGE 0.1                 /* beyond it neither straight bonds nor Hooke's law describe a solid */

/* Warns of stresses that no solid bears: Hooke's law has an equilibrium under any load. */
static void say_large_strain(struct engine *e)
{
    const struct particles *p = &e->part;
    real most = 0;
    char text[200];
    engine_stress(e);
    for (int64_t i = 0; i < p->n; i++)
        for (int k = 0; k < symmetric_count(p->dim); k++)
            most = real_max(most, fabs(p->stress[k][i]) / e->scene->material[p->material[i]].young);
    snprintf(text, sizeof text,
             "stresses of the solution reach %.2g times Young's modulus: no solid bears that, and elasticity of small "
             "strains does not describe it; see whether loads are meant, and in which unit",
             most);
    if (!(most <= STRAIN_LARGE)) engine_say(e, text);
}

/* Completes a solution: the body at rest at the end of the duration. */
static void solver_finish(struct engine *e)
{
    struct particles *p = &e->part;
    for (int d = 0; d < p->dim; d++) memset(p->v[d], 0, (size_t)p->n_all * sizeof(real));
    for (int k = 0; k < p->dim * p->dim && (e->optional & WITH_GRADIENT); k++)
        memset(p->gradient[k], 0, (size_t)p->n_all * sizeof(real));
    loads_mirror(&e->loads, p);
    loads_static_work(&e->loads, p);
    memset(e->loads.impulse, 0, sizeof e->loads.impulse);
    e->t = e->scene->duration;
    e->steps = e->step;
    e->sampling.due = false;
    e->sampling.kinetic = 0, e->sampling.constraint_work = e->loads.constraint_work;
    engine_breaks(e, 0);
    e->solver.past_limit = bonds_past_limit(e);
    say_past_limit(e);
    say_large_strain(e);
}

/* FAILED with the reason why no equilibrium was found. */
static status not_converged(const struct engine *e)
{
    const struct solver *s = &e->solver;
    if (!(s->residual < INFINITY))
        return status_set(FAILED,
                          "the solver diverged at step %lld; smaller loads are expected, or solver relaxation in "
                          "place of cg, or explicit",
                          (long long)e->step);
    if (s->residual * s->scale <= s->noise)
        return status_set(FAILED,
                          "the residual stays at %.3g of the load, %.3g is wanted: strains are so small that the "
                          "round-off of positions shows; a larger solver_tolerance is expected",
                          s->residual, e->scene->solver_tolerance);
    return status_set(FAILED,
                      "no equilibrium after %lld steps: the residual is %.3g of the load, %.3g is wanted; raise "
                      "solver_steps, or see whether every part of the body is held and its loads are balanced",
                      (long long)e->step, s->residual, e->scene->solver_tolerance);
}

status engine_solve(struct engine *e)
{
    const struct scene *s = e->scene;
    solver_step_fn *step = s->method != METHOD_PD ? grid_relaxation_step : s->solver == SOLVER_CG ? cg_step
                                                                                                    : relaxation_step;
    TRY(engine_report_start(e));
    laps_start(&e->laps);
    if (e->step == 0 && s->method == METHOD_PD) engine_sample_rest(e);
    if (s->method == METHOD_PD)
        for (int d = 0; d < s->dim; d++) memcpy(e->solver.before.of[d], e->part.f[d], (size_t)e->part.n * sizeof(real));
    while (e->step < e->steps) {
        bool done = false;
        TRY(step(e, &done));
        if (s->method == METHOD_PD) e->step++;
        if (done) solver_finish(e);
        else if (e->step >= e->steps || isnan(e->solver.residual)) return not_converged(e);
        TRY(engine_report(e));
    }
    return engine_report_end(e);
}
