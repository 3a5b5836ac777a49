/* Warns of prescribed velocities and displacements that break bonds beside the driven particles. */
#include <math.h>

#include "base/memory.h"
#include "engine_internal.h"

/* Sets body[b] to true for each body b that contains particles of load l (indices in part), and to false for the
 * others. For joined bodies only the one with the lowest index is marked. body: [scene->bodies]. */
static void bodies_mark(const struct scene *scene, const struct particles *part, const struct load *l, bool *body)
{
    for (int b = 0; b < scene->bodies; b++) body[b] = false;
    for (int64_t k = 0; k < l->n; k++) body[scene->body[part->body[l->particle[k]]].joined] = true;
}

/* Returns true if load l has particles (indices in part) in bodies that are marked by body[b] = true. body:
 * [scene->bodies]; for joined bodies only the one with the lowest index is marked. */
static bool load_meets(const struct scene *scene, const struct particles *part, const struct load *l, const bool *body)
{
    bool any = false;
    for (int64_t k = 0; k < l->n && !any; k++) any = body[scene->body[part->body[l->particle[k]]].joined];
    return any;
}

/* A load that drives particles. body: [bodies] true for the bodies that contain these particles; limit: speed at which
 * bonds beside the particles break [m/s]. */
struct driver {
    const struct load *load;
    bool *body;
    real limit;
};

/* Returns true if nothing in scene s prevents the bodies on which the load d->load acts from moving with this load.
 * Obstacles are a mirror across its components, an absorbing face, damping, contact with other bodies, and another load
 * that drives the same components with a velocity that differs by more than d->limit. all: all loads of the run; p:
 * particles. */
static bool moves_freely(const struct driver *d, const struct scene *s, const struct loads *all,
                         const struct particles *p)
{
    const struct load *own = d->load;
    bool freely = s->damping == 0 && !scene_bodies_can_come_into_contact(s);
    for (int b = 0; b < all->n && freely; b++) {
        const struct load *l = &all->load[b];
        const unsigned both = l->boundary->components & own->boundary->components;
        switch (l->boundary->kind) {
        case BOUNDARY_ABSORBING:
            freely = false;
            break;
        case BOUNDARY_MIRROR:
            freely = !boundary_is_mirror_without_tangential_motion(l->boundary, s->dim) &&
                     !(own->boundary->components >> l->boundary->axis & 1);
            break;
        case BOUNDARY_VELOCITY:
            freely = l == own || both == 0 || !load_meets(s, p, l, d->body) ||
                     loads_largest_prescribed_velocity_difference(own, l, p, s->duration) <= d->limit;
            break;
        default:
            break;
        }
    }
    return freely;
}

/* Returns the time in which a wave crosses the bodies with body[b] = true [s]. It follows from the diagonals of the
 * bounding boxes of their particles p and the slowest material of scene s. body: [bodies]; for joined bodies only the
 * one with the lowest index is marked. */
static real body_crossing_time(const struct particles *p, const struct scene *s, const bool *body)
{
    real slowest = INFINITY, most = 0;
    for (int m = 0; m < s->materials; m++) slowest = real_min(slowest, s->material[m].wave_speed);
    for (int b = 0; b < s->bodies; b++) {
        real low[DIM_MAX], high[DIM_MAX], size2 = 0;
        if (!body[b] || !joined_bodies_compute_bounding_box(s, p, b, low, high)) continue;
        for (int d = 0; d < p->dim; d++) size2 += square(high[d] - low[d] + s->spacing);
        most = real_max(most, sqrt(size2));
    }
    return most / slowest;
}

/* Adds a warning to *to if the velocity of the load d->load, which acts on bodies that move freely, changes by more
 * than d->limit within the time in which a wave crosses these bodies. Slower changes strain the bodies little. s, p:
 * scene and particles. */
static void warn_of_change(const struct driver *d, const struct scene *s, const struct particles *p,
                           struct warnings *to)
{
    const real within = body_crossing_time(p, s, d->body);
    const real change = load_largest_prescribed_velocity_change(d->load, p, s->duration, within);
    if (change > d->limit)
        warnings_add_if_new(to,
                            "boundary %s: its velocity changes by up to %.3g m/s within %.3g s, the time a wave takes "
                            "across its body; from %.3g m/s on (critical stretch x wave speed) bonds beside it break; "
                            "change the velocity more slowly; if an impact is intended, add accept: [speed]",
                            d->load->boundary->name, change, within, d->limit);
}

/* Adds warnings to *warnings about boundaries of scene s whose prescribed speed, or change of the velocity at t = 0,
 * exceeds the speed at which bonds beside the boundary break. loads: the loads of these boundaries; p: particles. A
 * face moved at speed v strains the material behind it by v/c at once, c being the wave speed. Adds none with static
 * solvers, for method mpm, or if the input file has accept: [speed]. */
void run_warn_of_supports_moving_too_fast(const struct scene *s, const struct loads *loads, const struct particles *p,
                                          struct warnings *warnings)
{
    real limit = INFINITY;
    if (scene_silences_warning(s, ACCEPT_SPEED)) return;
    bool *body = NEW("warn.bodies", s->bodies, bool);
    for (int m = 0; m < s->materials; m++)
        limit = real_min(limit, s->material[m].critical_stretch * s->material[m].wave_speed);
    for (int b = 0; b < loads->n && s->solver == SOLVER_EXPLICIT && s->method != METHOD_MPM; b++) {
        const struct load *l = &loads->load[b];
        const struct driver driver = {l, body, limit};
        const real speed = load_largest_speed_of_prescribed_displacement(l, p, s->duration);
        const real jump = load_largest_prescribed_minus_initial_velocity(l, p, s->duration);
        if (!(speed > limit || jump > limit)) continue;
        bodies_mark(s, p, l, body);
        if (isfinite(speed) && moves_freely(&driver, s, loads, p))
            warn_of_change(&driver, s, p, warnings);
        else if (speed > limit)
            warnings_add_if_new(
                warnings,
                "boundary %s: its displacement grows by up to %.3g m/s; from %.3g m/s on (critical stretch x wave "
                "speed) bonds beside it break; use a longer time; if an impact is intended, add accept: [speed]",
                s->boundary[b].name, speed, limit);
        else
            warnings_add_if_new(warnings,
                                "boundary %s: its velocity differs by up to %.3g m/s from that of its particles at "
                                "t = 0; from %.3g m/s on (critical stretch x wave speed) bonds beside it break; "
                                "use a lower velocity; if an impact is intended, add accept: [speed]",
                                s->boundary[b].name, jump, limit);
    }
    memory_free(body);
}

void run_warn_of_particles_faster_than_waves(const struct particles *p, real wave_speed, struct warnings *warnings)
{
    const real speed = particles_largest_speed_of_all(p);
    if (speed > wave_speed)
        warnings_add_if_new(warnings,
                            "particles start with %.3g m/s, %.3g times the wave speed, but a run stops when particles "
                            "are faster than waves; check the initial velocities and their units",
                            speed, speed / wave_speed);
}
