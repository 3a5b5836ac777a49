/* Computes stress-intensity factors by the interaction integral over the particles around a crack tip. */
#include "fracture/sif.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

#define AT_THE_TIP 1e-9 /* tolerance of positions at the tip or on the crack [outer radius] */

void sif_contour_weight_and_slope(enum sif_weight form, const struct contour *c, real distance, real *weight,
                                  real *slope)
{
    const real width = c->outer - c->inner, z = real_max(0, real_min(1, (distance - c->inner) / width));
    const bool ramp = distance > c->inner && distance < c->outer;
    switch (form) {
    case SIF_LINEAR:
        *weight = 1 - z, *slope = -1;
        break;
    case SIF_CUBIC:
        *weight = 1 - z * z * (3 - 2 * z), *slope = -6 * z * (1 - z);
        break;
    default:
        *weight = 1 - z * z * z * (10 - 15 * z + 6 * z * z), *slope = -30 * square(z * (1 - z));
        break;
    }
    *slope = ramp ? *slope / width : 0;
}

/* ---- one point --------------------------------------------------------------------------------------------------- */

/* Returns the first integrand of the interaction integral at a point, per area and for a unit gradient along n[2] of
 * the weight function q, by which it is multiplied [Pa]. It is the mutual energy flux of the actual motion a and the
 * auxiliary motion b. density: mass density of the material [kg/m^3]. */
static real ring_density(const struct crack_state *a, const struct crack_state *b, real density, const real n[2])
{
    real flux = 0, energy = 0;
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            flux += n[j] * (a->stress[i][j] * b->gradient[i][0] + b->stress[i][j] * a->gradient[i][0]);
            energy += a->stress[i][j] * b->gradient[i][j];
        }
        energy += density * a->velocity[i] * b->velocity[i];
    }
    return flux - n[0] * energy;
}

/* Returns the second, inertial integrand of the interaction integral at a point, which the weight function q
 * multiplies, per area and for q = 1 [Pa/m]. a: actual motion; b: auxiliary motion; density: mass density of the
 * material [kg/m^3]. */
static real disc_density(const struct crack_state *a, const struct crack_state *b, real density)
{
    real sum = 0;
    for (int i = 0; i < 2; i++) {
        sum += a->acceleration[i] * b->gradient[i][0] + b->acceleration[i] * a->gradient[i][0];
        sum -= a->velocity[i] * b->velocity_along[i] + b->velocity[i] * a->velocity_along[i];
    }
    return density * sum;
}

real sif_interaction_integrand(const struct sif_tip *tip, const struct contour *c, const real x[2],
                               const struct crack_state *actual, const struct crack_state *auxiliary,
                               real inertia_factor)
{
    const real r = hypot(x[0], x[1]), n[2] = {x[0] / r, x[1] / r};
    real q, slope, sum = 0;
    sif_contour_weight_and_slope(tip->weight, c, r, &q, &slope);
    if (slope != 0) sum += slope * ring_density(actual, auxiliary, tip->medium.density, n);
    if (inertia_factor > 0 && q > 0) sum += inertia_factor * q * disc_density(actual, auxiliary, tip->medium.density);
    return sum;
}

/* ---- particles round the tip ------------------------------------------------------------------------------------- */

/* Position relative to the tip [m], area [m^2], and fields of a particle, all in the axes of the crack. */
struct sif_point {
    real x[2], area;
    struct crack_state state;
};

/* The n particles that contribute to the integrals of a crack tip. */
struct sif_points {
    const struct sif_tip *tip;
    const struct contour *contour; /* contour of the present sum */
    bool inner;                    /* the second sum contributes: inertia, or loads inside the contours */
    int64_t n;
    int32_t *particle;       /* [n] indices */
    struct sif_point *point; /* [n] positions, areas and fields */
};

/* Transforms the vector v from the global axes to those of the crack at `tip`: local[0] is the component along the
 * direction of the crack, local[1] the component perpendicular to it. */
static void local_vector(const struct sif_tip *tip, const real v[2], real local[2])
{
    local[0] = v[0] * tip->along[0] + v[1] * tip->along[1];
    local[1] = v[1] * tip->along[0] - v[0] * tip->along[1];
}

/* Transforms the tensor t from the global axes to those of the crack at `tip`: local = R t R^T with the rotation R
 * between both, component 0 along the crack and 1 perpendicular to it. */
static void local_tensor(const struct sif_tip *tip, real t[2][2], real local[2][2])
{
    real half[2][2];
    for (int i = 0; i < 2; i++) local_vector(tip, t[i], half[i]);
    for (int j = 0; j < 2; j++) {
        real turned[2];
        local_vector(tip, (real[2]){half[0][j], half[1][j]}, turned);
        local[0][j] = turned[0], local[1][j] = turned[1];
    }
}

/* Computes x[2], the reference position of particle i of p relative to the crack tip, in the axes of the crack [m]:
 * x[0] along its direction, x[1] perpendicular to it. */
static void local_place(const struct sif_tip *tip, const struct particles *p, int64_t i, real x[2])
{
    local_vector(tip, (real[2]){p->X[0][i] - tip->place[0], p->X[1][i] - tip->place[1]}, x);
}

/* Lists in s->particle the particles (of p) of the tip's body within the outer radius of the largest of n contours,
 * contour[n], and allocates s->point for them. Without inertia and loads inside the contours (s->inner is false),
 * particles within the smallest inner radius contribute nothing and are left out. Particles at the tip itself are left
 * out in any case. */
static void points_find(struct sif_points *s, const struct contour *contour, int n, const struct particles *p)
{
    real least = INFINITY, most = 0, x[2];
    for (int k = 0; k < n; k++) least = real_min(least, contour[k].inner), most = real_max(most, contour[k].outer);
    if (s->inner) least = AT_THE_TIP * most;
    s->particle = NEW("sif.particle", p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++) {
        local_place(s->tip, p, i, x);
        const real r = hypot(x[0], x[1]);
        if (r > least && r < most && (s->tip->body < 0 || p->body[i] == s->tip->body)) s->particle[s->n++] = (int32_t)i;
    }
    s->point = memory_new("sif.point", s->n, sizeof *s->point);
}

/* Computes state->stress, the stress of particle i in the axes of the crack at `tip` [Pa]: by Hooke's law from
 * state->gradient, which must be set, if tip->stress is SIF_HOOKE; else by rotating the stress in m, the motion of the
 * particles. */
static void sif_point_stress(const struct sif_tip *tip, const struct sif_motion *m, int64_t i,
                             struct crack_state *state)
{
    if (tip->stress == SIF_HOOKE) {
        crack_medium_stress_from_displacement_gradient(&tip->medium, state->gradient, state->stress);
        return;
    }
    real global[2][2] = {{m->stress[0][i], m->stress[2][i]}, {m->stress[2][i], m->stress[1][i]}};
    local_tensor(tip, global, state->stress);
}

/* Computes s->point[k]: position, area and fields of particle s->particle[k] of p in the axes of the crack. The fields
 * are displacement gradient, stress, acceleration minus that caused by loads and, if m has velocities, the velocity and
 * its derivative along the crack. m: motion of the particles; stencil: weights by which gradients at this particle are
 * computed. */
static void point_make(struct sif_points *s, int64_t k, const struct sif_motion *m,
                       const struct gradient_stencil *stencil, const struct particles *p)
{
    const int32_t i = s->particle[k];
    const struct sif_tip *tip = s->tip;
    struct sif_point *point = &s->point[k];
    real global[2][2], local[2][2];
    point->area = p->volume0[i] / tip->thickness;
    local_place(tip, p, i, point->x);
    if (fabs(point->x[1]) <= AT_THE_TIP * fabs(point->x[0])) point->x[1] = copysign(0, tip->face);
    gradient_stencil_apply(stencil, i, m->displacement, global);
    local_tensor(tip, global, point->state.gradient);
    sif_point_stress(tip, m, i, &point->state);
    if (m->body[0]) {
        real given[2];
        local_vector(tip, (real[2]){m->body[0][i], m->body[1][i]}, given);
        for (int d = 0; d < 2; d++) point->state.acceleration[d] = -given[d];
    }
    if (!m->velocity[0]) return;
    gradient_stencil_apply(stencil, i, m->velocity, global);
    local_tensor(tip, global, local);
    for (int d = 0; d < 2; d++) point->state.velocity_along[d] = local[d][0];
    local_vector(tip, (real[2]){m->velocity[0][i], m->velocity[1][i]}, point->state.velocity);
    real moved[2];
    local_vector(tip, (real[2]){m->acceleration[0][i], m->acceleration[1][i]}, moved);
    for (int d = 0; d < 2; d++) point->state.acceleration[d] += moved[d];
}

/* Computes in parallel s->point, position and fields of all particles of p listed around the tip. m: motion of the
 * particles; rule: how gradients are computed; c: cells of the neighbour search. */
static void points_make(struct sif_points *s, const struct sif_motion *m, const struct gradient_rule *rule,
                        const struct particles *p, const struct cells *c)
{
#pragma omp parallel
    {
        struct gradient_stencil stencil = {0};
#pragma omp for schedule(static)
        for (int64_t k = 0; k < s->n; k++) {
            gradient_stencil_compute_weights(&stencil, rule, p, c, s->particle[k]);
            point_make(s, k, m, &stencil, p);
        }
        gradient_stencil_free(&stencil);
    }
}

/* Returns the weight of the inertial part of the interaction integral at the distance r [m] from the tip [1]. It
 * increases gradually from 0 to 1 around r = tip->core, the radius of a core around a moving tip, and is 1 everywhere
 * for a tip at rest or without a core. A sharp edge would let particles enter and leave the sum as the tip moves, and
 * the stress-intensity factors would oscillate with the period of a spacing. */
static real core_share(const struct sif_tip *tip, real r)
{
    const struct contour edge = {tip->core / 3, tip->core * 5 / 3};
    real q, slope;
    if (tip->speed == 0 || tip->core == 0) return 1;
    sif_contour_weight_and_slope(SIF_QUINTIC, &edge, r, &q, &slope);
    return 1 - q;
}

/* Adds the terms of the particles first .. end - 1 of the list s->particle to the interaction integrals sum[3]: of the
 * actual motion with the auxiliary fields of modes I and II, and with itself. context: the points around the tip
 * (struct sif_points). reproducible_sums calls it for each block of particles. */
static void points_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct sif_points *s = context;
    const struct sif_tip *tip = s->tip;
    for (int64_t k = first; k < end; k++) {
        const struct sif_point *point = &s->point[k];
        const real r = hypot(point->x[0], point->x[1]);
        if (r >= s->contour->outer || (!s->inner && r <= s->contour->inner)) continue;
        const real inside = s->inner ? core_share(tip, r) : 0;
        struct crack_field field;
        for (int mode = 0; mode < MODES; mode++) {
            crack_tip_unit_sif_field_at_any_speed(&tip->medium, mode, tip->speed, point->x, &field);
            sum[mode] +=
                point->area * sif_interaction_integrand(tip, s->contour, point->x, &point->state, &field.state, inside);
        }
        sum[MODES] +=
            point->area * sif_interaction_integrand(tip, s->contour, point->x, &point->state, &point->state, inside);
    }
}

void sif_compute_by_interaction_integral(const struct sif_tip *tip, const struct contour *contour, int contour_count,
                                         const struct sif_motion *motion, const struct gradient_rule *rule,
                                         const struct particles *p, const struct cells *c, struct sif *result)
{
    struct sif_points s = {.tip = tip, .inner = motion->velocity[0] || motion->body[0]};
    points_find(&s, contour, contour_count, p);
    points_make(&s, motion, rule, p, c);
    for (int k = 0; k < contour_count; k++) {
        real sum[MODES + 1];
        s.contour = &contour[k];
        reproducible_sums(s.n, MODES + 1, points_block, &s, sum);
        for (int mode = 0; mode < MODES; mode++)
            result[k].K[mode] = tip->medium.modulus * sum[mode] /
                                (2 * crack_tip_speed_universal_function(&tip->medium, mode, tip->speed));
        result[k].J = 0.5 * sum[MODES];
    }
    memory_free(s.particle);
    memory_free(s.point);
}

/* ---- path independence ------------------------------------------------------------------------------------------- */

/* Returns the largest relative difference between the results of several contours, a measure of their error [1]: of K_I
 * or K_II, divided by the mean of |K| = sqrt(K_I^2 + K_II^2), or of J, divided by the mean of J; NAN if a denominator
 * is 0. result[contour_count]: stress-intensity factors and J of each contour. */
real sif_relative_spread_over_contours(const struct sif *result, int contour_count)
{
    real low[MODES + 1], high[MODES + 1], mean[MODES + 1] = {0}, range[MODES + 1];
    for (int m = 0; m <= MODES; m++) {
        low[m] = INFINITY, high[m] = -INFINITY;
        for (int k = 0; k < contour_count; k++) {
            const real value = m < MODES ? result[k].K[m] : result[k].J;
            low[m] = real_min(low[m], value), high[m] = real_max(high[m], value);
            mean[m] += value / contour_count;
        }
        range[m] = high[m] - low[m];
    }
    const real intensity = hypot(mean[MODE_I], mean[MODE_II]), release = fabs(mean[MODES]);
    if (!(intensity > 0) || !(release > 0)) return NAN;
    return real_max(real_max(range[MODE_I], range[MODE_II]) / intensity, range[MODES] / release);
}
