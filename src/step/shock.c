/* Collisions of bodies that a scene leads to expect. */
#include "step/shock.h"

#include <math.h>

#define SHOCK 0.1 /* least reported collision speed, over the speed at which a front breaks or yields a body */

/* Returns the smallest particle speed behind a front that breaks or yields a material of the scene: strain limit times
 * wave speed [m/s]; INFINITY without limits. */
static real speed_limit(const struct scene *s)
{
    real least = INFINITY;
    for (int m = 0; m < s->materials; m++) {
        const struct material *own = &s->material[m];
        real strain = s->method == METHOD_MPM ? INFINITY : own->onset_stretch;
        if (material_yields(own)) strain = real_min(strain, material_initial_yield_stress(own) / own->young);
        least = real_min(least, strain * own->wave_speed);
    }
    return least;
}

/* Computes the initial velocity of body b at position X[dim] [m], velocity[dim] [m/s]: `bodies.velocity`, or the last
 * entry of `initial` that sets it there. */
static void start_speed(const struct scene *s, int b, const real *X, real *velocity)
{
    for (int d = 0; d < s->dim; d++) velocity[d] = s->body[b].velocity[d];
    for (const struct scene_initial *k = s->initial; k < s->initial + s->initials; k++) {
        if (b >= s->bodies || !k->sets_velocity || (k->body >= 0 && k->body != b)) continue;
        if (!region_contains(&k->region, X, s->dim, 0)) continue;
        for (int d = 0; d < s->dim; d++) {
            const real factor = k->formula[d].n > 0 ? expression_evaluate(&k->formula[d], X, s->dim, 0) : 1;
            velocity[d] = k->velocity[d] * factor;
            for (int c = 0; c < s->dim; c++)
                velocity[d] += k->velocity_gradient[d * s->dim + c] * (X[c] - k->centre[c]);
        }
    }
}

/* Returns the speed at which bodies a and b approach along the axis with the largest gap between their bounding boxes
 * [m/s]. Returns 0 if they do not meet within the duration, or if the box of one is unknown. */
static real closing_speed(const struct scene *s, int a, int b)
{
    const int body[2] = {a, b};
    real from[2][DIM_MAX], to[2][DIM_MAX], v[2][DIM_MAX], gap = -INFINITY, speed = 0;
    for (int k = 0; k < 2; k++) {
        const struct scene_body *own = &s->body[body[k]];
        real centre[DIM_MAX] = {0};
        if (own->file || !region_bounding_box(&own->shape, s->dim, from[k], to[k])) return 0;
        for (int d = 0; d < s->dim; d++) centre[d] = 0.5 * (from[k][d] + to[k][d]);
        start_speed(s, body[k], centre, v[k]);
    }
    for (int d = 0; d < s->dim; d++) {
        const real above = from[1][d] - to[0][d], below = from[0][d] - to[1][d];
        if (real_max(above, below) <= gap) continue;
        gap = real_max(above, below);
        speed = (above > below ? 1 : -1) * (v[0][d] - v[1][d]);
    }
    return speed > 0 && gap <= speed * s->duration ? speed : 0;
}

/* Returns advice, as text, for a scene whose stress oscillates behind a front: bulk viscosity, or what the scene must
 * change so that viscosity is possible. */
static const char *remedy_of(const struct scene *s)
{
    if (s->space == SPACE_PLANE_STRESS)
        return "viscosity does not act in plane stress: a run in space plane strain with material.viscosity: {} shows "
               "what breaks without oscillations";
    if (s->model != MODEL_BOND && s->method != METHOD_MPM)
        return "viscosity acts with model bond only: a run with model: bond and material.viscosity: {} shows what "
               "breaks without oscillations";
    if (s->levels > 0 && s->levels != LEVELS_AUTO)
        return "material.viscosity: {} with mpm.levels: 0 spreads the front so that it does not oscillate";
    return "material.viscosity: {} spreads the front so that it does not oscillate";
}

struct shock scene_fastest_collision(const struct scene *s)
{
    struct shock shock = {0};
    bool viscous = true;
    for (int m = 0; m < s->materials; m++) viscous = viscous && material_has_viscosity(&s->material[m]);
    for (int a = 0; a < s->bodies; a++)
        for (int b = a + 1; b < s->bodies + s->rigids; b++)
            if (b >= s->bodies || s->contact_between != CONTACT_NONE)
                shock.speed = real_max(shock.speed, closing_speed(s, a, b));
    if (viscous || !scene_is_dynamic(s) || !(shock.speed > SHOCK * speed_limit(s))) return shock;
    shock.share = shock.speed / speed_limit(s), shock.remedy = remedy_of(s);
    return shock;
}
