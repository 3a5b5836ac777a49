/* Prescribed velocities and displacements: numbers and formulas times a function of time, and rotations.
 *
 * What rotates moves on circles: its velocity in a step is the difference of its places at both ends over the step, so
 * that no step leaves the circle, however long it is. */
#include <math.h>

#include "loads/loads.h"

/* Rotation by `angle` about the axis of a boundary: Rodrigues. */
static void rotation_matrix(const struct boundary *b, int dim, real angle, real *R)
{
    const real plane[DIM_MAX] = {0, 0, 1}, *n = dim == 3 ? b->axis_of : plane;
    const real length = sqrt(dot(n, n, DIM_MAX)), c = cos(angle), s = sin(angle);
    const real x = n[0] / length, y = n[1] / length, z = n[2] / length;
    const real all[DIM_MAX][DIM_MAX] = {{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s},
                                        {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s},
                                        {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)}};
    for (int r = 0; r < dim; r++)
        for (int k = 0; k < dim; k++) R[r * dim + k] = all[r][k];
}

struct driving driving_make(const struct boundary *b, int dim, real t, real dt)
{
    struct driving s = {.boundary = b, .dim = dim, .t = t, .dt = dt, .factor = time_function_at(&b->time, t)};
    if (!b->rotates) return s;
    const real before = real_max(0, t - 0.5 * dt), after = t + 0.5 * dt;
    rotation_matrix(b, dim, b->rate * time_function_integral(&b->time, before), s.from);
    rotation_matrix(b, dim, b->rate * time_function_integral(&b->time, after), s.to);
    return s;
}

/* Component d of the rotation from the first end of the step to the second, minus one, of an arm. */
static real turned_further(const struct driving *s, const real *arm, int d)
{
    real own[DIM_MAX] = {0}, sum = -arm[d];
    for (int k = 0; k < s->dim; k++)                     /* back to the reference, then on */
        for (int m = 0; m < s->dim; m++) own[k] += s->from[m * s->dim + k] * arm[m];
    for (int k = 0; k < s->dim; k++) sum += s->to[d * s->dim + k] * own[k];
    return sum;
}

real driving_at(const struct driving *s, const real *X, int d, bool placed)
{
    const struct boundary *b = s->boundary;
    real arm[DIM_MAX] = {0}, way = 0;
    if (!b->rotates)
        return s->factor * b->value[d] * (b->formula[d].n > 0 ? expression_at(&b->formula[d], X, s->dim, s->t) : 1);
    for (int k = 0; k < s->dim; k++) arm[k] = X[k] - b->centre[k];
    if (placed) return turned_further(s, arm, d) / s->dt;
    for (int k = 0; k < s->dim; k++) way += (s->to[d * s->dim + k] - s->from[d * s->dim + k]) * arm[k];
    return way / s->dt;
}

/* ---- displacements ----------------------------------------------------------------------------------------------- */

struct displacing displacing_make(const struct boundary *b, int dim, real t)
{
    struct displacing s = {.boundary = b, .dim = dim, .t = b->frozen ? b->frozen_at : t};
    s.factor = b->displaces ? time_function_at(&b->time, t) : time_function_integral(&b->time, t);
    if (b->rotates) rotation_matrix(b, dim, b->rate * s.factor, s.turned);
    return s;
}

real displacing_at(const struct displacing *s, const real *X, int d)
{
    const struct boundary *b = s->boundary;
    const struct expression *formula = &b->formula[d];
    if (!b->rotates)
        return s->factor * b->value[d] * (formula->n > 0 ? expression_at(formula, X, s->dim, s->t) : 1);
    real sum = b->centre[d] - X[d];
    for (int k = 0; k < s->dim; k++) sum += s->turned[d * s->dim + k] * (X[k] - b->centre[k]);
    return sum;
}

void load_displacement_at(const struct load *l, const struct particles *p, int64_t k, real t, real *u)
{
    const struct displacing by = displacing_make(l->boundary, p->dim, t);
    real X[DIM_MAX];
    particle_place(p, l->particle[k], X);
    for (int d = 0; d < p->dim; d++) u[d] = l->boundary->components >> d & 1 ? displacing_at(&by, X, d) : 0;
}

status load_displacement_known(const struct boundary *b)
{
    bool in_time = false;
    for (int d = 0; d < DIM_MAX; d++) in_time |= b->formula[d].in_time;
    if (b->kind != BOUNDARY_VELOCITY || b->displaces || b->frozen || !in_time) return OK;
    return status_set(REFUSED,
                      "boundary %s: a velocity by a formula of t does not tell how far it goes; displacement by a "
                      "formula of t, or velocity times a function of time, is expected",
                      b->name);
}
