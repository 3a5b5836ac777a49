/* Computes prescribed velocities and displacements: values and formulas times a function of time, and rotations.
 *
 * The prescribed velocity in a step is the difference of the prescribed positions at its start and end, divided by the
 * step. Rotating particles thus stay on their circles however long a step is. Positions of displaced particles are also
 * set exactly at the end of a step (loads_impose_prescribed_motion_on_particles, walls of the mesh), so that round-off
 * does not accumulate. */
#include <math.h>

#include "loads/loads.h"

/* Computes the rotation matrix R [dim][dim] for the angle `angle` [rad] about the axis of boundary b (Rodrigues'
 * formula). In 2D the axis is z. */
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

/* ---- displacements ----------------------------------------------------------------------------------------------- */

/* Returns the displacements that boundary b prescribes at time t [s], prepared for evaluation at many positions by
 * prescribed_displacement_component_at_position: evaluates the function of time and the rotation once. dim: dimension
 * of the body. */
struct prescribed_displacement boundary_prescribed_displacement_at_time(const struct boundary *b, int dim, real t)
{
    struct prescribed_displacement s = {
        .boundary = b, .dim = dim, .t = boundary_time_at_which_formulas_are_evaluated(b, t)};
    s.factor = b->displaces ? time_function_value(&b->time, t) : time_function_integral(&b->time, t);
    if (b->rotates) rotation_matrix(b, dim, b->rate * s.factor, s.turned);
    return s;
}

real prescribed_displacement_component_at_position(const struct prescribed_displacement *prescribed, const real *X,
                                                   int component)
{
    const struct boundary *b = prescribed->boundary;
    const struct expression *formula = &b->formula[component];
    if (!b->rotates)
        return prescribed->factor * b->value[component] *
               (formula->n > 0 ? expression_evaluate(formula, X, prescribed->dim, prescribed->t) : 1);
    real sum = b->centre[component] - X[component];
    for (int k = 0; k < prescribed->dim; k++)
        sum += prescribed->turned[component * prescribed->dim + k] * (X[k] - b->centre[k]);
    return sum;
}

void load_prescribed_displacement_of_particle(const struct load *l, const struct particles *p, int64_t index_in_load,
                                              real t, real *displacement)
{
    const struct prescribed_displacement by = boundary_prescribed_displacement_at_time(l->boundary, p->dim, t);
    real X[DIM_MAX];
    particle_reference_position(p, l->particle[index_in_load], X);
    for (int d = 0; d < p->dim; d++)
        displacement[d] =
            l->boundary->components >> d & 1 ? prescribed_displacement_component_at_position(&by, X, d) : 0;
}

status boundary_check_velocity_has_closed_form_integral(const struct boundary *b)
{
    if (b->kind != BOUNDARY_VELOCITY || b->displaces || b->frozen || !boundary_formula_depends_on_time(b)) return OK;
    return status_set(
        REFUSED,
        "boundary %s: a velocity that is a formula of t cannot be used with this solver or mpm.frame, which need the "
        "displacement; give a displacement as a formula of t, or a velocity with the key time",
        b->name);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Returns the motion that boundary b prescribes in a step: the step from t - dt/2 to t + dt/2 [s]. It is prepared for
 * evaluation at many positions by prescribed_velocity_component_at_position. dim: dimension of the body. */
struct prescribed_motion boundary_prescribed_motion_in_step(const struct boundary *b, int dim, real t, real dt)
{
    struct prescribed_motion s = {
        .boundary = b, .dim = dim, .t = t, .dt = dt, .factor = time_function_value(&b->time, t)};
    if (!b->rotates && !b->displaces) return s;
    s.from = boundary_prescribed_displacement_at_time(b, dim, real_max(0, t - 0.5 * dt));
    s.to = boundary_prescribed_displacement_at_time(b, dim, t + 0.5 * dt);
    return s;
}

struct prescribed_motion loads_prescribed_motion_of_boundary_in_step(const struct loads *l, int boundary_number,
                                                                     int dim, real t, real dt)
{
    const struct boundary *b = l->load[boundary_number].boundary;
    return boundary_prescribed_motion_in_step(b, dim, l->ended && b->displaces && t > dt ? t - dt : t, dt);
}

/* Returns component d of the displacement in a step with prescribed rotation: (R_to R_from^T - 1) arm [m]. arm[dim]:
 * present position relative to the centre of rotation [m]; s: motion, with the rotations R_from and R_to at start and
 * end of the step. */
static real rotation_increment(const struct prescribed_motion *s, const real *arm, int d)
{
    real own[DIM_MAX] = {0}, sum = -arm[d];
    for (int k = 0; k < s->dim; k++) /* back to the reference, then on */
        for (int m = 0; m < s->dim; m++) own[k] += s->from.turned[m * s->dim + k] * arm[m];
    for (int k = 0; k < s->dim; k++) sum += s->to.turned[d * s->dim + k] * own[k];
    return sum;
}

real prescribed_velocity_component_at_position(const struct prescribed_motion *motion, const real *X, int component,
                                               bool at_present_position)
{
    const struct boundary *b = motion->boundary;
    real arm[DIM_MAX] = {0}, increment = 0;
    if (b->displaces)
        return (prescribed_displacement_component_at_position(&motion->to, X, component) -
                prescribed_displacement_component_at_position(&motion->from, X, component)) /
               motion->dt;
    if (!b->rotates)
        return motion->factor * b->value[component] *
               (b->formula[component].n > 0
                    ? expression_evaluate(&b->formula[component], X, motion->dim,
                                          boundary_time_at_which_formulas_are_evaluated(b, motion->t))
                    : 1);
    for (int k = 0; k < motion->dim; k++) arm[k] = X[k] - b->centre[k];
    if (at_present_position) return rotation_increment(motion, arm, component) / motion->dt;
    for (int k = 0; k < motion->dim; k++)
        increment +=
            (motion->to.turned[component * motion->dim + k] - motion->from.turned[component * motion->dim + k]) *
            arm[k];
    return increment / motion->dt;
}

/* ---- speeds ------------------------------------------------------------------------------------------------------ */

enum { MOMENTS = 1000, PLACES = 64 }; /* numbers of times and of particles at which motions are evaluated */

/* Returns the largest speed [m/s] that load l prescribes for its particle number k (of p) between times 0 and t [s],
 * from differences between MOMENTS + 1 equidistant times. */
static real formula_speed(const struct load *l, const struct particles *p, int64_t k, real t)
{
    real before[DIM_MAX], u[DIM_MAX], most = 0;
    load_prescribed_displacement_of_particle(l, p, k, 0, before);
    for (int m = 1; m <= MOMENTS; m++) {
        real increment2 = 0;
        load_prescribed_displacement_of_particle(l, p, k, t * m / MOMENTS, u);
        for (int d = 0; d < p->dim; d++) increment2 += square(u[d] - before[d]), before[d] = u[d];
        most = real_max(most, sqrt(increment2) / (t / MOMENTS));
    }
    return most;
}

real load_largest_speed_of_prescribed_displacement(const struct load *l, const struct particles *p, real t_end)
{
    const struct boundary *b = l->boundary;
    const bool formula = b->formula[0].n + b->formula[1].n + b->formula[2].n > 0;
    const real slope = time_function_largest_slope_until(&b->time, t_end), size = sqrt(dot(b->value, b->value, p->dim));
    real most = 0;
    if (!b->displaces || size == 0) return 0;
    if (!formula || isinf(slope)) return slope * size;
    for (int64_t k = 0; k < l->n; k += 1 + l->n / PLACES) most = real_max(most, formula_speed(l, p, k, t_end));
    return most;
}

/* Returns the magnitude of the difference between the velocity that load l prescribes for its particle number k and the
 * present velocity of that particle in p [m/s]. Only the components that l prescribes count. For a rotation, whose
 * velocity changes direction, returns the difference of the two speeds instead. by: motion that l prescribes in this
 * step. */
static real velocity_jump_at(const struct load *l, const struct particles *p, int64_t k,
                             const struct prescribed_motion *by)
{
    const int32_t i = l->particle[k];
    real X[DIM_MAX], jump2 = 0, driven2 = 0, own2 = 0;
    particle_reference_position(p, i, X);
    for (int d = 0; d < p->dim; d++) {
        if (!(l->boundary->components >> d & 1)) continue;
        const real v = prescribed_velocity_component_at_position(by, X, d, false);
        jump2 += square(v - p->v[d][i]), driven2 += square(v), own2 += square(p->v[d][i]);
    }
    return l->boundary->rotates ? fabs(sqrt(driven2) - sqrt(own2)) : sqrt(jump2);
}

real load_largest_prescribed_minus_initial_velocity(const struct load *l, const struct particles *p, real t_end)
{
    const struct boundary *b = l->boundary;
    real most = 0;
    if (b->kind != BOUNDARY_VELOCITY || b->displaces) return 0;
    for (int m = 0; m < MOMENTS + b->time.n; m++) {
        const real at = m < MOMENTS ? t_end * m / (MOMENTS - 1) : b->time.t[m - MOMENTS];
        if (!(at >= 0 && at <= t_end)) continue;
        const struct prescribed_motion by = boundary_prescribed_motion_in_step(b, p->dim, at, t_end / MOMENTS);
        for (int64_t k = 0; k < l->n; k += 1 + l->n / PLACES) most = real_max(most, velocity_jump_at(l, p, k, &by));
    }
    return most;
}

real load_largest_prescribed_speed(const struct load *l, const struct particles *p, real t_end)
{
    return l->boundary->displaces ? load_largest_speed_of_prescribed_displacement(l, p, t_end)
                                  : load_largest_prescribed_minus_initial_velocity(l, p, t_end);
}

enum { LAGS = 9 }; /* number of time spans, each 0.6 of the previous one, so that no period is missed */

/* Returns the magnitude of the change of the velocity that load l prescribes for its particle number k (of p) between
 * two times [m/s]. For a rotation, whose velocity changes direction, returns the change of the speed instead. by[0],
 * by[1]: prescribed motion at the earlier and the later time; at times <= 0 the velocity is the initial velocity of the
 * particle. */
static real velocity_change_at(const struct load *l, const struct particles *p, int64_t k,
                               const struct prescribed_motion by[2])
{
    const bool own = by[0].t <= 0;
    real X[DIM_MAX], change2 = 0, now2 = 0, then2 = 0;
    particle_reference_position(p, l->particle[k], X);
    for (int d = 0; d < p->dim; d++) {
        if (!(l->boundary->components >> d & 1)) continue;
        const real now = prescribed_velocity_component_at_position(&by[1], X, d, false);
        const real then =
            own ? p->v[d][l->particle[k]] : prescribed_velocity_component_at_position(&by[0], X, d, false);
        change2 += square(now - then), now2 += square(now), then2 += square(then);
    }
    return l->boundary->rotates ? fabs(sqrt(now2) - sqrt(then2)) : sqrt(change2);
}

real load_largest_prescribed_velocity_change(const struct load *l, const struct particles *p, real t_end,
                                             real time_span)
{
    const struct boundary *b = l->boundary;
    const real step = t_end / (MOMENTS - 1), dt = 0.02 * real_max(time_span, step);
    real most = 0;
    for (int m = 0; m < MOMENTS + b->time.n; m++) {
        const real moment = m < MOMENTS ? step * m : b->time.t[m - MOMENTS];
        const real at = real_min(moment, t_end - 0.5 * dt); /* displacements by formulas stay constant after the end */
        if (!(moment >= 0 && moment <= t_end)) continue;
        real lag = real_max(time_span, step);
        for (int n = 0; n < LAGS; n++, lag *= 0.6) {
            const struct prescribed_motion by[] = {boundary_prescribed_motion_in_step(b, p->dim, at - lag, dt),
                                                   boundary_prescribed_motion_in_step(b, p->dim, at, dt)};
            for (int64_t k = 0; k < l->n; k += boundary_motion_varies_in_space(b) ? 1 + l->n / PLACES : l->n)
                most = real_max(most, velocity_change_at(l, p, k, by));
        }
    }
    return most;
}

real loads_largest_prescribed_velocity_difference(const struct load *load, const struct load *other_load,
                                                  const struct particles *p, real t_end)
{
    const unsigned both = load->boundary->components & other_load->boundary->components;
    real most = 0;
    if (both == 0 || load->n == 0 || other_load->n == 0) return 0;
    if (boundary_motion_varies_in_space(load->boundary) || boundary_motion_varies_in_space(other_load->boundary))
        return INFINITY;
    for (int m = 0; m < MOMENTS; m++) {
        const real at = t_end * m / (MOMENTS - 1), dt = t_end / MOMENTS;
        const struct prescribed_motion by[] = {
            boundary_prescribed_motion_in_step(load->boundary, p->dim, at, dt),
            boundary_prescribed_motion_in_step(other_load->boundary, p->dim, at, dt)};
        real X[2][DIM_MAX], apart2 = 0;
        particle_reference_position(p, load->particle[0], X[0]),
            particle_reference_position(p, other_load->particle[0], X[1]);
        for (int d = 0; d < p->dim; d++)
            if (both >> d & 1)
                apart2 += square(prescribed_velocity_component_at_position(&by[0], X[0], d, false) -
                                 p->v[d][load->particle[0]] -
                                 prescribed_velocity_component_at_position(&by[1], X[1], d, false) +
                                 p->v[d][other_load->particle[0]]);
        most = real_max(most, sqrt(apart2));
    }
    return most;
}
