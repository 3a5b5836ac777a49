/* Unstable release in time (steps.then explicit): where an advance under fixed loads is followed by another, the body
 * is let go. It moves by its own inertia, with loads and supports as they are, until no bond has broken for as long as
 * waves need to cross it a few times; then its motion is damped, and equilibrium is found from where it has come. */
#include <math.h>
#include <string.h>

#include "advance.h"
#include "led.h"
#include "springs.h"
#include "system.h"

#include "contact/contact.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"
#include "rigid/rigid_part.h"
#include "step/sample.h"
#include "step/step.h"
#include "step/checks.h"

#define CROSSINGS_QUIET 3.0   /* crossings of the body by waves, without a bond that breaks, to be quiet */
#define CROSSINGS_DAMPED 40.0 /* the same, that damping may take at the most */
#define CROSSINGS_MOST 200.0  /* of all the release */
#define MOTION_SMALL 1e-5     /* kinetic over strain energy of a body that is taken to be at rest */
enum { LOOK_STEPS = 20 };     /* steps between looks at its energies */
/* Steps of the clock of a release, which ends by itself: so many that no frame or sample is due [1]. */
#define RELEASE_STEPS_MOST (INT64_MAX / 4)

/* Loads and supports stay as they are at pseudo-time t. */
static void boundaries_hold(const struct scene *scene, struct boundary *boundary, real t)
{
    for (int b = 0; b < scene->boundaries; b++) {
        const struct boundary *from = &scene->boundary[b];
        struct boundary *to = &boundary[b];
        real factor = 1;
        *to = *from;
        if (boundary_is_force(from)) factor = time_function_at(&from->time, t), to->frozen = true, to->frozen_at = t;
        if (from->kind == BOUNDARY_VELOCITY) {
            factor = 0;
            memset(to->formula, 0, sizeof to->formula);
            to->rotates = to->displaces = false;
        }
        if (boundary_is_force(from) || from->kind == BOUNDARY_VELOCITY)
            to->time = (struct time_function){TIME_CONSTANT};
        for (int d = 0; d < DIM_MAX; d++) to->value[d] = factor * from->value[d];
    }
}

static void boundaries_follow(struct boundary *boundary, const struct scene *scene)
{
    array_copy(boundary, scene->boundary, scene->boundaries, sizeof *boundary);
}

/* Rigid bodies stay where they are; those that are driven go on. */
static void rigids_hold(const struct scene *scene, struct rigid_set *rigid, bool hold)
{
    for (int k = 0; k < scene->rigids; k++) {
        struct rigid_body *r = &rigid->body[k];
        const bool driven = dot(r->speed, r->speed, r->dim) > 0;
        r->motion = driven && !hold ? RIGID_DRIVEN : RIGID_FIXED;
    }
}

/* All that moves keeps this share of its velocity. */
static void velocities_scale(struct particles *p, struct mesh *mesh, const struct loads *loads, real share)
{
    const struct grid *g = &mesh->grid;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] *= share;
        for (int64_t I = 0; mesh->points > 0 && I < g->n; I++) g->velocity[d][I] *= share;
    }
    loads_mirror(loads, p);
}

static real motion_now(const struct particles *part, const struct reference_frame *frame)
{
    return diagnostics_kinetic(part) + frame_kinetic(frame);
}

/* Steps in time until the body is at rest. Its clock is that of the release. */
static status steps_in_time(struct run *e, int64_t *broken)
{
    const real crossing = (particles_longest(&e->part) + e->scene->spacing) / e->tables.wave_speed; /* by waves [s] */
    const real quiet = CROSSINGS_QUIET * crossing, damping = 2 / crossing;
    const int64_t most = (int64_t)ceil(CROSSINGS_MOST * crossing / e->clock.dt);
    const int64_t damped_most = (int64_t)ceil(CROSSINGS_DAMPED * crossing / e->clock.dt);
    int64_t last = 0, damped = 0, had = e->diagnostics->bonds_broken;
    *broken = 0;
    for (int64_t k = 0; k < most && damped < damped_most; k++) {
        TRY(step(e));
        TRY(divergence_check(e, true, true));
        if (e->diagnostics->bonds_broken > had) *broken += e->diagnostics->bonds_broken - had, last = k, damped = 0;
        had = e->diagnostics->bonds_broken;
        if ((real)(k - last) * e->clock.dt < quiet) continue;
        velocities_scale(&e->part, &e->frame->mesh, &e->loads, 1 - damping * e->clock.dt);
        damped++;
        if (k % LOOK_STEPS == 0 && motion_now(&e->part, e->frame) <= MOTION_SMALL * sample_strain(e)) break;
    }
    return OK;
}

/* Energy that the body has and that bonds have taken, less the work of loads [J]. */
static real energy_held(struct run *e)
{
    const real held = sample_strain(e) + contact_energy(e->contact, &e->part) + bonds_fracture_energy(&e->bonds);
    return held - e->loads.work - e->loads.constraint_work;
}

status statics_release(struct run *e)
{
    struct statics *s = e->statics;
    const struct run_clock clock = e->clock;
    const real before = energy_held(e), damped = e->damped;
    const int64_t broken = statics_advance_break(e);
    int64_t more;
    velocities_scale(&e->part, &e->frame->mesh, &e->loads, 0);
    boundaries_hold(e->scene, e->boundary, s->t);
    rigids_hold(e->scene, e->rigid, true);
    contact_unmark(e->contact);
    const real dt = clock.dt_bears;
    e->clock.dt = e->grid->transfer.dt = dt;
    e->clock.step = 1, e->clock.steps = RELEASE_STEPS_MOST, e->clock.stride = 1;
    const status moved = steps_in_time(e, &more);
    s->released_time += (real)(e->clock.step - 1) * dt;
    e->clock = clock;
    boundaries_follow(e->boundary, e->scene);
    rigids_hold(e->scene, e->rigid, false);
    velocities_scale(&e->part, &e->frame->mesh, &e->loads, 0);
    TRY(moved);
    if (more > 0) led_lose(&s->led);
    const real lost = before - energy_held(e);
    s->balance.lost += lost, e->damped = damped + lost;
    statics_precondition_free(s);
    statics_unknowns_free(s);
    statics_unknowns_make(e);
    return statics_advance_settle(e, broken + more);
}
