/* Collisions of bodies that a scene leads to expect. */
#include "step/shock.h"

#include <math.h>

/* Least collision speed that is reported, divided by the speed at which a front breaks or yields a body [1]. */
#define SHOCK 0.1

/* Returns the strain at which bonds of material m begin to soften or break, or the material yields, whichever is
 * smaller [1]; with method mpm, which has no bonds, only yielding counts. INFINITY if it does neither. s: scene. */
static real strain_limit(const struct scene *s, const struct material *m)
{
    const real strain = s->method == METHOD_MPM ? INFINITY : m->onset_stretch;
    return material_yields(m) ? real_min(strain, material_initial_yield_stress(m) / m->young) : strain;
}

/* Returns the smallest impedance (density times wave speed) of the materials of body b [kg/(m^2 s)]; INFINITY if b >=
 * s->bodies, which is a rigid body. */
static real least_impedance(const struct scene *s, int b)
{
    real least = INFINITY;
    for (int m = 0; m < s->materials && b < s->bodies; m++)
        if (scene_body_can_have_material(&s->body[b], m))
            least = real_min(least, s->material[m].density * s->material[m].wave_speed);
    return least;
}

/* Returns the closing speed of bodies a and b at which the shock wave of their collision breaks or yields body a [m/s];
 * INFINITY if it never does. At a closing speed v, the velocity of body a changes by the share Z_b/(Z_a + Z_b) of v,
 * with the impedances Z = density times wave speed c, because stress and velocity are equal at the common face. The
 * strain of its wave is this change divided by c: v/(2 c) between bodies of one material, v/c beside a rigid body. */
static real speed_limit(const struct scene *s, int a, int b)
{
    const real other = least_impedance(s, b);
    real least = INFINITY;
    for (int m = 0; m < s->materials && a < s->bodies; m++) {
        const struct material *own = &s->material[m];
        if (!scene_body_can_have_material(&s->body[a], m)) continue;
        const real share = 1 / (1 + own->density * own->wave_speed / other);
        least = real_min(least, strain_limit(s, own) * own->wave_speed / share);
    }
    return least;
}

/* Computes the initial velocity of body b at position X[dim] [m], velocity[dim] [m/s]: `bodies.velocity`, or that of
 * the last entry of `initial` that applies to the body at X. */
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

/* Returns the speed at which bodies a and b approach each other along the axis with the largest gap between their
 * bounding boxes [m/s]. Returns 0 if they do not meet within the duration, or if one of the boxes is unknown. */
static real closing_speed(const struct scene *s, int a, int b)
{
    const int body[2] = {a, b};
    real from[2][DIM_MAX], to[2][DIM_MAX], v[2][DIM_MAX], gap = -INFINITY, speed = 0;
    for (int k = 0; k < 2; k++) {
        const struct scene_body *own = &s->body[body[k]];
        real centre[DIM_MAX] = {0};
        if (own->file || !region_compute_bounding_box_if_finite(&own->shape, s->dim, from[k], to[k])) return 0;
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

/* Returns advice, as text, for a scene s whose stress oscillates behind a front: bulk viscosity, or what the input
 * file (scene) must change so that viscosity is possible. */
static const char *remedy_of(const struct scene *s)
{
    if (s->space == SPACE_PLANE_STRESS)
        return "compare with a run that has space: plane strain and material.viscosity: {}";
    if (s->model != MODEL_BOND && s->method != METHOD_MPM)
        return "compare with a run that has model: bond and material.viscosity: {}";
    if (s->levels > 0 && s->levels != LEVELS_AUTO) return "use material.viscosity: {} and mpm.levels: 0";
    return "use material.viscosity: {}, which spreads the front";
}

struct shock scene_find_collision_closest_to_damage(const struct scene *s)
{
    struct shock shock = {0};
    bool viscous = true;
    for (int m = 0; m < s->materials; m++) viscous = viscous && material_has_viscosity(&s->material[m]);
    for (int a = 0; a < s->bodies; a++)
        for (int b = a + 1; b < s->bodies + s->rigids; b++) {
            if (b < s->bodies && s->contact_between == CONTACT_NONE) continue;
            const real speed = closing_speed(s, a, b);
            const real share = speed / real_min(speed_limit(s, a, b), speed_limit(s, b, a));
            if (share > shock.share) shock.speed = speed, shock.share = share;
        }
    if (viscous || !scene_is_dynamic(s) || shock.share <= SHOCK) return (struct shock){0};
    shock.remedy = remedy_of(s);
    return shock;
}
