/* Applies the initial states of an input file (scene) to particles: velocities, uniform strains and wave pulses. */
#include <math.h>

#include "data/expression.h"
#include "fill_draft.h"
#include "scene/fill.h"

/* Returns REFUSED, with a message, if the displacement gradient H of an initial state of the scene s inverts the body:
 * 1 + tr H <= 0, or a stretch 1 + H_aa <= 0. */
static status check_initial(const struct scene *s, const struct scene_initial *initial)
{
    real growth = 1;
    bool inverted = false;
    for (int a = 0; a < s->dim && initial->sets_strain; a++) {
        real stretch = 1 + initial->displacement_gradient[a * s->dim + a];
        growth += stretch - 1;
        inverted |= !(stretch > 0);
    }
    if (growth > 0 && !inverted) return OK;
    return status_message_prepend_location(
        initial->place,
        status_set(REFUSED, "has a displacement gradient that turns the body inside out; use strains near 1e-3"));
}

status initial_states_check_no_body_inverts(const struct scene *s)
{
    for (int k = 0; k < s->initials; k++) TRY(check_initial(s, &s->initial[k]));
    return OK;
}

/* Returns the derivative of velocity component a of the initial state s along axis b at the position X[dim] [1/s], as a
 * central difference of the component's formula over the length `spacing` [m]. Returns 0 if component a has no formula,
 * or if the formula has no finite value on both sides of X. */
static real start_slope(const struct scene_initial *s, int a, int b, const real *X, int dim, real spacing)
{
    real before[DIM_MAX] = {0}, after[DIM_MAX] = {0};
    if (s->formula[a].n == 0) return 0;
    for (int d = 0; d < dim; d++) before[d] = after[d] = X[d];
    before[b] -= 0.5 * spacing, after[b] += 0.5 * spacing;
    const real slope =
        (expression_evaluate(&s->formula[a], after, dim, 0) - expression_evaluate(&s->formula[a], before, dim, 0)) /
        spacing;
    return isfinite(slope) ? slope : 0;
}

/* Sets the velocity of particle i to v0 f(X) + G arm, and stores the velocity gradient G + grad f if particles have
 * one (APIC). s: initial state with velocity v0, formulas f and gradient G [1/s]; X[dim]: position of the particle
 * [m]; arm[dim]: X minus the centre of s [m]; spacing: distance of particles [m]. p: all particles. */
static void start_velocity(struct particles *p, int64_t i, const struct scene_initial *s, const real *X,
                           const real *arm, real spacing)
{
    const int dim = p->dim;
    for (int a = 0; a < dim; a++) {
        const real here = s->formula[a].n > 0 ? expression_evaluate(&s->formula[a], X, dim, 0) : 1;
        p->v[a][i] = s->velocity[a] * here + dot(&s->velocity_gradient[a * dim], arm, dim);
        for (int b = 0; b < dim; b++) {
            real *gradient = p->gradient[a * dim + b];
            if (gradient == NULL) continue;
            gradient[i] = s->velocity_gradient[a * dim + b] + start_slope(s, a, b, X, dim, spacing);
        }
    }
}

/* Sets position, stress and volume of particle i for the uniform displacement gradient H of the initial state s (small
 * strain): x = X + H arm, stress = C : sym H, volume = volume0 (1 + tr H). m: material of the particle, for the
 * stiffness C; arm[dim]: its reference position X minus the centre of s [m]. p: all particles. */
static void fill_start_strain(struct particles *p, int64_t i, const struct scene_initial *s, const struct material *m,
                              const real *arm)
{
    const real *H = s->displacement_gradient;
    int dim = p->dim, count = symmetric_tensor_component_count(dim);
    real strain[SYM_MAX], stiffness[SYM_MAX * SYM_MAX], growth = 1;
    for (int k = 0; k < count; k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        strain[k] = 0.5 * (H[a * dim + b] + H[b * dim + a]);
    }
    material_stiffness_matrix(m, dim, stiffness);
    for (int k = 0; k < count; k++) p->stress[k][i] = dot(&stiffness[k * count], strain, count);
    for (int a = 0; a < dim; a++) {
        p->x[a][i] = p->X[a][i] + dot(&H[a * dim], arm, dim);
        if (p->stretch[a] != NULL) p->stretch[a][i] = 1 + H[a * dim + a];
        growth += H[a * dim + a];
    }
    p->volume[i] = p->volume0[i] * growth;
}

/* Adds the plane wave pulse w to velocity, position, stress, stretch and volume of particle i (small strain). m:
 * material of the particle, for wave speed and stiffness; X[dim]: reference position of the particle [m]. p: all
 * particles. */
static void start_pulse(struct particles *p, int64_t i, const struct wave_pulse *w, const struct material *m,
                        const real *X)
{
    const struct wave_state wave =
        wave_pulse_initial_state(w, X, w->transverse ? m->shear_speed : m->wave_speed, p->dim);
    const real *along = w->direction, *moved = w->polarisation;
    const int dim = p->dim, count = symmetric_tensor_component_count(dim);
    real strain[SYM_MAX], stiffness[SYM_MAX * SYM_MAX];
    for (int k = 0; k < count; k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        strain[k] = 0.5 * wave.strain * (along[a] * moved[b] + along[b] * moved[a]);
    }
    material_stiffness_matrix(m, dim, stiffness);
    for (int k = 0; k < count; k++) p->stress[k][i] += dot(&stiffness[k * count], strain, count);
    for (int a = 0; a < dim; a++) {
        p->v[a][i] += wave.velocity * moved[a];
        p->x[a][i] += wave.displacement * moved[a];
        if (p->stretch[a] != NULL) p->stretch[a][i] += strain[a];
    }
    p->volume[i] *= 1 + wave.strain * dot(along, moved, dim);
}

/* Applies to particle i every initial state of the scene s whose body and region contain the particle, in the order of
 * the scene. spacing: distance of particles [m]; a particle within ON_SURFACE spacings of the boundary of a region is
 * inside. p: all particles. */
static void start_particle(struct particles *p, int64_t i, const struct scene *s, real spacing)
{
    const real tolerance = ON_SURFACE * spacing;
    real X[DIM_MAX], arm[DIM_MAX];
    particle_reference_position(p, i, X);
    for (const struct scene_initial *k = s->initial; k < s->initial + s->initials; k++) {
        if ((k->body >= 0 && k->body != p->body[i]) || !region_contains(&k->region, X, p->dim, tolerance)) continue;
        for (int a = 0; a < p->dim; a++) arm[a] = X[a] - k->centre[a];
        if (k->sets_velocity) start_velocity(p, i, k, X, arm, spacing);
        if (k->sets_strain) fill_start_strain(p, i, k, &s->material[p->material[i]], arm);
        if (k->sets_pulse) start_pulse(p, i, &k->pulse, &s->material[p->material[i]], X);
    }
}

/* Sets the velocity of particle i, and its velocity gradient if it has one (APIC), to 0: the start of a static
 * equilibrium. p: all particles. */
static void start_at_rest(struct particles *p, int64_t i)
{
    for (int a = 0; a < p->dim; a++) p->v[a][i] = 0;
    for (int k = 0; k < p->dim * p->dim && p->gradient[k] != NULL; k++) p->gradient[k][i] = 0;
}

void initial_states_apply_to_particles(struct particles *p, const struct scene *s, real spacing)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        start_particle(p, i, s, spacing);
        if (!scene_is_dynamic(s)) start_at_rest(p, i);
    }
}
