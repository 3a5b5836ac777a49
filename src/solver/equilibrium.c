/* Newton's method with conjugate gradients, without a stored matrix (equilibrium.h). */
#include "solver/equilibrium.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "solver_parts.h"

enum { CORRECTIONS_MOST = 80 };  /* largest number of Newton corrections; linear bodies need two or three */
enum { DIRECTIONS_MOST = 2000 }; /* largest number of directions in a correction */
/* Number of search directions without progress after which the iteration for a correction ends: the matrix is then
 * nearly singular, or the residual is round-off. */
enum { DIRECTIONS_IDLE = 100 };
enum { EVALUATIONS_MOST = 10 }; /* largest number of force evaluations of a line search */

/* Largest strain of the displacement increment over which a difference of forces is computed [1]. The relative error by
 * second-order terms is of the size of this strain. The round-off of forces, which corresponds to a strain of 1e-14 in
 * a body of 100 spacings, is 1e-8 of the difference. */
#define DIFFERENCE_STRAIN 1e-6
/* Largest rotation of bonds [rad] in the displacement increment over which a difference of forces is taken. It is the
 * tighter limit for fragments that hang on one or two bonds, which rotate and are hardly strained. */
#define DIFFERENCE_TURN 1e-5
/* Largest rotation of bonds in a correction along a direction of negative stiffness [rad]. */
#define TURN_MOST 0.1

/* Limits of a correction of the displacements. PUSH_LEFT: ratio of the force along the correction to its initial value
 * below which a line search ends [1]. WORK_CURVED: ratio of the residual after the correction to the residual before,
 * above which the work is integrated by Simpson's rule [1]. */
#define PUSH_LEFT 0.8
#define WORK_CURVED 0.01
/* Number of intervals of Simpson's rule for forces that are not smooth along the correction (kinks at contact and
 * yielding). With 2 intervals a 24th of the work beyond a kink would be missed. */
enum { WORK_PARTS = 16 };

/* Largest and smallest fraction of the residual that the conjugate gradient iteration of a correction may leave [1].
 * The smallest one is the accuracy of one-sided differences of forces. */
#define FORCING_MOST 0.1
#define FORCING_LEAST 1e-4

/* Least scale of the residual, relative to the largest loads so far [1]; it applies to a body that has broken and
 * carries no load. */
#define SCALE_LEAST 1e-2

/* ---- vectors ----------------------------------------------------------------------------------------------------- */

/* Stores the addresses of all vectors (struct field) of the solver in list[FIELDS], so that one loop can allocate or
 * free them. */
static void all_fields(struct newton_solver *newton, struct field **list)
{
    struct field *const fields[] = {&newton->u, &newton->f, &newton->d,  &newton->q,      &newton->r,
                                    &newton->z, &newton->x, &newton->at, &newton->before, &newton->grown};
    memcpy(list, fields, sizeof fields);
}
enum { FIELDS = 10 }; /* number of vectors of a solver */

void newton_solver_make(struct newton_solver *newton, int dim, int64_t node_count)
{
    struct field *list[FIELDS];
    newton->dim = dim, newton->n = node_count;
    newton->strain_ratio = 0;
    newton->held = NEW("equilibrium.held", node_count, uint8_t);
    all_fields(newton, list);
    for (int k = 0; k < FIELDS; k++)
        for (int d = 0; d < dim; d++) list[k]->of[d] = NEW("equilibrium.field", node_count, real);
}

void newton_solver_free(struct newton_solver *newton)
{
    struct field *list[FIELDS];
    all_fields(newton, list);
    for (int k = 0; k < FIELDS; k++)
        for (int d = 0; d < DIM_MAX; d++) memory_free(list[k]->of[d]);
    memory_free(newton->held);
    *newton = (struct newton_solver){0};
}

static bool is_held(const struct newton_solver *newton, int64_t i, int d) { return newton->held[i] >> d & 1; }

/* Computes the vector to = a x + b y for all components of all nodes of `newton`, including those with prescribed
 * displacement. `to` may be x or y. */
static void combine(const struct newton_solver *newton, struct field *to, real a, const struct field *x, real b,
                    const struct field *y)
{
    for (int d = 0; d < newton->dim; d++) {
        real *t = to->of[d];
        const real *v = x->of[d], *w = y->of[d];
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < newton->n; i++) t[i] = a * v[i] + b * w[i];
    }
}

/* Parameters of dot_block and plain_block: solver q and two vectors a, b whose scalar product is summed. */
struct product {
    const struct newton_solver *q;
    const struct field *a, *b;
};

/* Adds the scalar product of two vectors over nodes first .. end - 1: the terms of free components to sum[0], those of
 * held components (with prescribed displacement) to sum[1]. context: the vectors (struct product). Called by
 * reproducible_sums for each block of nodes. */
static void dot_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct product *s = context;
    for (int d = 0; d < s->q->dim; d++)
        for (int64_t i = first; i < end; i++) sum[is_held(s->q, i, d)] += s->a->of[d][i] * s->b->of[d][i];
}

/* Computes the scalar product of the vectors a and b: over the free components of `newton` in sum[0], over held
 * components (with prescribed displacement) in sum[1]. */
static void dots(const struct newton_solver *newton, const struct field *a, const struct field *b, real sum[2])
{
    reproducible_sums(newton->n, 2, dot_block, &(struct product){newton, a, b}, sum);
}

static real dot_free(const struct newton_solver *newton, const struct field *a, const struct field *b)
{
    real sum[2];
    dots(newton, a, b, sum);
    return sum[0];
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

/* Computes the forces f [N] at the displacements u [m] by the callback newton->force, and counts the call. */
static void forces_at(struct newton_solver *newton, const struct field *u, struct field *f)
{
    newton->force(newton->context, u, f);
    newton->forces++;
}

/* Adds the products a b of two vectors over all components, free and held, of nodes first .. end - 1 to *sum. context:
 * the vectors (struct product). Called by reproducible_sums for each block of nodes. */
static void plain_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct product *s = context;
    for (int d = 0; d < s->q->dim; d++) {
        const real *a = s->a->of[d], *b = s->b->of[d];
        real part = 0;
#pragma omp simd reduction(+ : part)
        for (int64_t i = first; i < end; i++) part += a[i] * b[i];
        *sum += part;
    }
}

/* Returns the scalar product of vectors a and b over all components of `newton`, free and held (with prescribed
 * displacement). */
static real dot_all(const struct newton_solver *newton, const struct field *a, const struct field *b)
{
    real sum;
    reproducible_sums(newton->n, 1, plain_block, &(struct product){newton, a, b}, &sum);
    return sum;
}

/* Returns the estimated size [m] of the region that moves with the largest component of the displacement `increment`,
 * from the sum of squares of the increment. Bonds at the border of this region rotate by about this component divided
 * by the size. newton: solver, with the size of the body; most: the largest component [m]. */
static real turning_width(const struct newton_solver *newton, const struct field *increment, real most)
{
    return newton->length * pow(real_max(1, dot_all(newton, increment, increment) / square(most)), 1.0 / newton->dim);
}

/* Returns the factor [1] by which the displacement `increment` of `newton` is multiplied when its product with the
 * stiffness is computed from a difference of forces. With this factor, strains of bonds are at most DIFFERENCE_STRAIN
 * and their rotations about DIFFERENCE_TURN. most: largest component of the increment [m]. */
static real difference_step(const struct newton_solver *newton, const struct field *increment, real most)
{
    return real_min(DIFFERENCE_STRAIN / newton->strain_ratio,
                    DIFFERENCE_TURN * turning_width(newton, increment, most)) /
           most;
}

/* Computes out = K in, the product of the tangent stiffness K at the displacements u = newton->u with the displacement
 * vector `in`, by a one-sided difference of forces: (f(u) - f(u + step in))/step. newton->f must contain the forces
 * f(u). Overwrites the vector newton->at. */
static void stiffness(struct newton_solver *newton, const struct field *in, struct field *out)
{
    const real most = field_largest_absolute_component(in, newton->dim, newton->n);
    const real step = most > 0 ? difference_step(newton, in, most) : 0;
    combine(newton, &newton->at, 1, &newton->u, step, in);
    forces_at(newton, &newton->at, out);
    if (most > 0)
        combine(newton, out, -1 / step, out, 1 / step, &newton->f);
    else
        combine(newton, out, 0, out, 0, out);
}

/* Stores in newton->strain_ratio the ratio of the strain that the displacements d cause to their largest component
 * [1/m], which determines the size of the next difference of forces. curvature: d . K d with the tangent stiffness K
 * [J]; does nothing unless it is positive. */
static void strain_note(struct newton_solver *newton, const struct field *d, real curvature)
{
    const real most = field_largest_absolute_component(d, newton->dim, newton->n);
    if (curvature > 0 && most > 0) newton->strain_ratio = sqrt(curvature / newton->unit_energy) / most;
}

/* Measures how far the forces newton->f are from equilibrium. Sets newton->scale to the largest of the norms of applied
 * forces, reactions and round-off and SCALE_LEAST times the largest scale so far [N], newton->residual to the norm of
 * the unbalanced forces, divided by newton->scale [1], and newton->worst to the node with the largest unbalanced force.
 */
static void equilibrium_measure(struct newton_solver *newton)
{
    real sum[2], most = -1;
    dots(newton, &newton->f, &newton->f, sum);
    newton->scale =
        real_max(real_max(newton->applied, sqrt(sum[1])), real_max(newton->noise, SCALE_LEAST * newton->largest));
    newton->largest = real_max(newton->largest, newton->scale);
    newton->residual = newton->scale > 0 ? sqrt(sum[0]) / newton->scale : 0;
    for (int64_t i = 0; i < newton->n; i++) {
        real size = 0;
        for (int d = 0; d < newton->dim; d++) size += is_held(newton, i, d) ? 0 : square(newton->f.of[d][i]);
        if (size > most) most = size, newton->worst = i;
    }
}

/* ---- one correction ---------------------------------------------------------------------------------------------- */

/* Computes the residual newton->r = f - K x of the initial increment x = newton->x, with the present forces f =
 * newton->f and the tangent stiffness K. x may contain the motion of supports. The residual is 0 for components with
 * prescribed displacement. */
static void residual_of_guess(struct newton_solver *newton)
{
    if (field_largest_absolute_component(&newton->x, newton->dim, newton->n) == 0) {
        combine(newton, &newton->r, 1, &newton->f, 0, &newton->f);
    } else {
        stiffness(newton, &newton->x, &newton->q);
        combine(newton, &newton->r, 1, &newton->f, -1, &newton->q);
    }
    for (int d = 0; d < newton->dim; d++)
        for (int64_t i = 0; i < newton->n; i++)
            if (is_held(newton, i, d)) newton->r.of[d][i] = 0;
}

/* Sets the free components of the initial increment newton->x to 0 if the residual is smaller without them. These
 * components were extrapolated in proportion to the loads, which is wrong, for example, for a fragment that has broken
 * off and rotated. Overwrites newton->z; newton->r is the residual of the version tried last. */
static void guess_check(struct newton_solver *newton)
{
    residual_of_guess(newton);
    const real with = dot_free(newton, &newton->r, &newton->r);
    combine(newton, &newton->z, 1, &newton->x, 0, &newton->x);
    for (int d = 0; d < newton->dim; d++)
        for (int64_t i = 0; i < newton->n; i++)
            if (!is_held(newton, i, d)) newton->x.of[d][i] = 0;
    residual_of_guess(newton);
    if (with < dot_free(newton, &newton->r, &newton->r)) combine(newton, &newton->x, 1, &newton->z, 0, &newton->z);
}

/* Parameters of advance_block: the solver, and the factor of the step [1]. */
struct step {
    struct newton_solver *q;
    real scale;
};

/* Advances the nodes first .. end - 1 by a step of conjugate gradients: x += scale d for all components; r -= scale K d
 * for free components; r = 0 for components with prescribed displacement. K d is in newton->q. Adds r . r to *sum.
 * context: solver and scale (struct step). Called by reproducible_sums for each block of nodes. */
static void advance_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct step *s = context;
    const struct newton_solver *newton = s->q;
    for (int d = 0; d < newton->dim; d++) {
        real *x = newton->x.of[d], *r = newton->r.of[d], part = 0;
        const real *increment = newton->d.of[d], *force = newton->q.of[d];
#pragma omp simd reduction(+ : part)
        for (int64_t i = first; i < end; i++) {
            x[i] += s->scale * increment[i];
            r[i] = newton->held[i] >> d & 1 ? 0 : r[i] - s->scale * force[i];
            part += r[i] * r[i];
        }
        *sum += part;
    }
}

/* Extends the correction newton->x of the displacements along newton->d, a direction in which the stiffness is
 * negative. The factor of newton->d is such that bonds rotate by about TURN_MOST [rad]. */
static void follow_negative(struct newton_solver *newton)
{
    const real most = field_largest_absolute_component(&newton->d, newton->dim, newton->n);
    if (most > 0)
        combine(newton, &newton->x, 1, &newton->x, TURN_MOST * turning_width(newton, &newton->d, most) / most,
                &newton->d);
}

/* Solves K x = f for the free components of the correction x = newton->x by preconditioned conjugate gradients,
 * starting from the given x. Components with prescribed displacement do not change. Stops when the residual is `wanted`
 * [N] or FORCING_LEAST times its initial value, whichever is larger, when it has not decreased for DIRECTIONS_IDLE
 * directions, or after DIRECTIONS_MOST directions. If a direction with negative stiffness is found, x is extended along
 * it (Steihaug 1983), unless `prescribed` is true, which means that supports move. */
static void correction(struct newton_solver *newton, real wanted, bool prescribed)
{
    real rz = 0, left2, best2 = INFINITY;
    int best = 0;
    residual_of_guess(newton);
    left2 = dot_free(newton, &newton->r, &newton->r);
    wanted = real_max(wanted, FORCING_LEAST * sqrt(left2));
    for (int k = 0; k < DIRECTIONS_MOST && left2 > square(wanted) && k - best < DIRECTIONS_IDLE; k++) {
        if (left2 < 0.5 * best2) best2 = left2, best = k;
        newton->precondition(newton->context, &newton->r, &newton->z);
        const real next = dot_all(newton, &newton->r, &newton->z);
        if (!(next > 0)) break;
        combine(newton, &newton->d, 1, &newton->z, k > 0 ? next / rz : 0, &newton->d);
        rz = next;
        stiffness(newton, &newton->d, &newton->q);
        const real curvature = dot_all(newton, &newton->d, &newton->q);
        newton->directions++;
        if (!(curvature > 0)) {
            if (!prescribed) follow_negative(newton);
            break;
        }
        strain_note(newton, &newton->d, curvature);
        reproducible_sums(newton->n, 1, advance_block, &(struct step){newton, rz / curvature}, &left2);
    }
}

/* ---- its length -------------------------------------------------------------------------------------------------- */

/* Computes the displacements newton->z = newton->u + share newton->x, with a share [1] of the correction newton->x
 * added to the present displacements, and stores the forces at newton->z in newton->q. */
static void forces_along(struct newton_solver *newton, real share)
{
    combine(newton, &newton->z, 1, &newton->u, share, &newton->x);
    forces_at(newton, &newton->z, &newton->q);
}

/* Returns the factor of the correction x = newton->x at which the force along x is at most PUSH_LEFT of its initial
 * value, or the norm of the forces has halved, after at most EVALUATIONS_MOST evaluations; it is 1 for linear bodies.
 * The energy decreases up to that point: the factor is reduced if the force there points against x, and increased if it
 * still points along x. left: norm of the residual before the correction [N]; prescribed: true if supports move, so
 * that the increment is made in full. Stores the displacements at the factor in newton->z and the forces there in
 * newton->q. */
static real line_search(struct newton_solver *newton, real left, bool prescribed)
{
    const real push = dot_free(newton, &newton->f, &newton->x),
               most = field_largest_absolute_component(&newton->x, newton->dim, newton->n);
    real share = newton->reach > 0 && !prescribed && most > newton->reach ? newton->reach / most : 1, low = 0, high = 0,
         at_low = push;
    for (int k = 0; k < EVALUATIONS_MOST; k++) {
        forces_along(newton, share);
        const real after = sqrt(dot_free(newton, &newton->q, &newton->q)),
                   at = dot_free(newton, &newton->q, &newton->x);
        if (prescribed || !(push > 0) || after <= 0.5 * left) break;
        if (fabs(at) <= PUSH_LEFT * push) break;
        if (at > 0) {
            if (high == 0 && k == EVALUATIONS_MOST / 2) break;
            low = share, at_low = at;
            share = high > 0 ? 0.5 * (low + high) : 2 * share;
        } else {
            high = share;
            const real zero = isfinite(at) ? low + (share - low) * at_low / (at_low - at) : low;
            share = real_max(real_min(zero, low + 0.9 * (high - low)), low + 0.1 * (high - low));
        }
    }
    return share;
}

/* Returns the work of all forces over the displacement increment share newton->x [J]. It is computed by the trapezoidal
 * rule, or if the forces may not be linear along the increment by Simpson's rule. The loads grow linearly along it,
 * from their values in newton->before. share: factor of the line search [1]; left: norm of the residual before the
 * increment [N]; prescribed: true if supports move, so that a body that yields evenly may have no residual after the
 * increment. Overwrites the vectors newton->at and newton->r. */
static real work_along(struct newton_solver *newton, real share, real left, bool prescribed)
{
    real ends[2], after[2], middle[2], grown[2], sum = 0;
    dots(newton, &newton->before, &newton->x, ends);
    dots(newton, &newton->q, &newton->x, after);
    const real even = 0.5 * share * (ends[0] + ends[1] + after[0] + after[1]);
    if (!(newton->kinked && prescribed) && sqrt(dot_free(newton, &newton->q, &newton->q)) <= WORK_CURVED * left)
        return even;
    const int parts = newton->kinked ? WORK_PARTS : 2;
    dots(newton, &newton->f, &newton->x, grown);
    for (int k = 1; k < parts; k++) {
        const real part = (real)k / parts;
        combine(newton, &newton->at, 1, &newton->u, part * share, &newton->x);
        forces_at(newton, &newton->at, &newton->r);
        dots(newton, &newton->r, &newton->x, middle);
        sum += (k % 2 ? 4 : 2) * (middle[0] + middle[1] - (1 - part) * (grown[0] + grown[1] - ends[0] - ends[1]));
    }
    return (2 * even + share * sum) / (3 * parts);
}

/* Adds the correction newton->x, multiplied by the factor of the line search, to the displacements newton->u, and
 * updates the forces newton->f. left: norm of the residual before the correction [N]; prescribed: true if supports
 * move. During the line search material laws follow the state at which forces are evaluated (newton->laws, if laws
 * change); afterwards those fixed before hold again. Returns the work of all forces along the increment [J]. */
static real advance(struct newton_solver *newton, real left, bool prescribed)
{
    if (newton->laws) newton->laws(newton->context, false);
    const real share = line_search(newton, left, prescribed), work = work_along(newton, share, left, prescribed);
    if (newton->laws) newton->laws(newton->context, true);
    combine(newton, &newton->u, 1, &newton->z, 0, &newton->z);
    combine(newton, &newton->f, 1, &newton->q, 0, &newton->q);
    combine(newton, &newton->before, 1, &newton->q, 0, &newton->q);
    return work;
}

/* Returns the work [J] of the present forces newton->f along `increment` on held components, those with prescribed
 * displacement. */
static real dot_held(const struct newton_solver *newton, const struct field *increment)
{
    real sum[2];
    dots(newton, &newton->f, increment, sum);
    return sum[1];
}

/* Corrects in `newton` the work of the loads and the lost energy after a step from one equilibrium to the next. Their
 * sums assume straight paths: the loads grow linearly along the first correction of the displacements, and are constant
 * along the later ones. The actual path is approximated by the curve c s + d s^2, with loads linear in s, 0 to 1. Along
 * it no energy is lost, and the work exceeds the mean of the loads at both ends times the displacement by more/6. more:
 * growth of the loads times the displacement of all corrections but the first [J]. */
static void loads_bend(struct newton_solver *newton, real more)
{
    newton->bent = more / 6;
    newton->lost -= more / 3;
}

static bool is_balanced(const struct newton_solver *newton)
{
    return newton->residual <= newton->tolerance || newton->residual * newton->scale <= newton->noise;
}

/* Calls newton->settle, which updates whatever the forces depend on besides displacements (branches of material laws,
 * active contacts) to the present state. Returns true if this has changed nothing, so that the solution is valid.
 * Otherwise recomputes the forces and returns false. */
static bool laws_settle(struct newton_solver *newton)
{
    if (!newton->settle || newton->settle(newton->context)) return true;
    forces_at(newton, &newton->u, &newton->f);
    combine(newton, &newton->before, 1, &newton->f, 0, &newton->f);
    return false;
}

status newton_solver_find_equilibrium(struct newton_solver *newton, const struct field *increment, bool loads_changed)
{
    bool prescribed = loads_changed && field_largest_absolute_component(increment, newton->dim, newton->n) > 0;
    combine(newton, &newton->x, prescribed, increment, 0, increment);
    combine(newton, &newton->before, 1, &newton->f, 0, &newton->f);
    real supports = prescribed ? 0.5 * dot_held(newton, increment) : 0;
    forces_at(newton, &newton->u, &newton->f);
    if (!loads_changed) combine(newton, &newton->before, 1, &newton->f, 0, &newton->f);
    combine(newton, &newton->grown, 1, &newton->f, -1, &newton->before);
    newton->bent = 0;
    if (!(newton->strain_ratio > 0)) newton->strain_ratio = 1 / newton->length;
    const bool driven = prescribed;
    bool settled = false; /* the laws are those of u */
    real straight = NAN;  /* growth of loads times the first correction [J] */
    if (prescribed) guess_check(newton);
    for (int k = 0; k < CORRECTIONS_MOST; k++) {
        equilibrium_measure(newton);
        const real left = newton->residual * newton->scale, goal = 0.5 * newton->tolerance * newton->scale;
        if (!isfinite(left)) break;
        if (!prescribed && is_balanced(newton)) {
            if (!settled) {
                settled = true;
                laws_settle(newton);
                continue; /* with these laws and the present norm of loads */
            }
            if (driven) supports += 0.5 * dot_held(newton, increment);
            if (!isnan(straight)) loads_bend(newton, dot_free(newton, &newton->grown, &newton->u) - straight);
            newton->lost -= supports;
            return OK;
        }
        correction(newton, prescribed ? goal : real_min(FORCING_MOST * left, real_max(goal, FORCING_LEAST * left)),
                   prescribed);
        newton->lost += advance(newton, left, prescribed);
        laws_settle(newton);
        settled = true;
        if (isnan(straight)) straight = dot_free(newton, &newton->grown, &newton->u);
        combine(newton, &newton->x, 0, &newton->x, 0, &newton->x);
        prescribed = false;
    }
    return status_set(
        FAILED, "no equilibrium within %d corrections; use more load steps (steps.number) or a larger solver_tolerance",
        CORRECTIONS_MOST);
}
