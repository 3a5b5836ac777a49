/* Computes the dynamic release of an unstable crack in load steps (key `steps.then: explicit`). If a crack increment
 * under fixed loads is followed by another one, the motion of the body is integrated in time while loads and supports
 * stay constant. When no bond has broken for the time in which waves cross the body several times, the motion is
 * damped, and the equilibrium is found from there. */
#include <math.h>
#include <string.h>

#include "crack_increment.h"
#include "sif_cracks.h"
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
#include "loads/mirrors.h"

#define CROSSINGS_QUIET 3.0   /* time without breaking bonds before damping, in crossing times of waves */
#define CROSSINGS_DAMPED 40.0 /* longest time of damping, in crossing times */
#define CROSSINGS_MOST 200.0  /* longest time of a release, in crossing times */
#define MOTION_SMALL 1e-5     /* ratio of kinetic to strain energy of a body at rest */
enum { ENERGY_STEPS = 20 };   /* time steps between checks of the energies */
/* Number of time steps of a dynamic release, so large that no output frame or sample of history.csv is written before
 * its end. */
#define RELEASE_STEPS_MOST (INT64_MAX / 4)

/* Sets boundary[scene->boundaries] to copies of the boundaries of the scene with constant values: loads as at
 * pseudo-time t [s], supports at rest. They apply while the motion of the body is integrated in time. */
static void boundaries_freeze(const struct scene *scene, struct boundary *boundary, real t)
{
    for (int b = 0; b < scene->boundaries; b++) {
        const struct boundary *from = &scene->boundary[b];
        struct boundary *to = &boundary[b];
        real factor = 1;
        *to = *from;
        if (boundary_applies_force(from))
            factor = time_function_value(&from->time, t), to->frozen = true, to->frozen_at = t;
        if (from->kind == BOUNDARY_VELOCITY) {
            factor = 0;
            memset(to->formula, 0, sizeof to->formula);
            to->rotates = to->displaces = false;
        }
        if (boundary_applies_force(from) || from->kind == BOUNDARY_VELOCITY)
            to->time = (struct time_function){TIME_CONSTANT};
        for (int d = 0; d < DIM_MAX; d++) to->value[d] = factor * from->value[d];
    }
}

/* Undoes boundaries_freeze: copies the boundaries of the scene, whose loads depend on the pseudo-time, to
 * boundary[scene->boundaries]. */
static void boundaries_restore(struct boundary *boundary, const struct scene *scene)
{
    array_copy(boundary, scene->boundary, scene->boundaries, sizeof *boundary);
}

/* Fixes all rigid bodies of the scene if `hold` is true; else restores the prescribed velocity of those that have one.
 * rigid: the rigid bodies, in the order of the scene. */
static void rigids_freeze(const struct scene *scene, struct rigid_set *rigid, bool hold)
{
    for (int k = 0; k < scene->rigids; k++) {
        struct rigid_body *r = &rigid->body[k];
        const bool driven = dot(r->speed, r->speed, r->dim) > 0;
        r->motion = driven && !hold ? RIGID_DRIVEN : RIGID_FIXED;
    }
}

/* Multiplies all velocities by `share`, dimensionless: those of particles p, of mesh nodes and of mirror images in
 * `loads`. */
static void velocities_scale(struct particles *p, struct mesh *mesh, const struct loads *loads, real share)
{
    const struct grid *g = &mesh->grid;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] *= share;
        for (int64_t I = 0; mesh->points > 0 && I < g->n; I++) g->velocity[d][I] *= share;
    }
    loads_update_mirror_images_of_particles(loads, p);
}

/* Returns the kinetic energy [J] of the particles `part` and of the mesh of the reference frame `frame`. */
static real kinetic_present(const struct particles *part, const struct lagrangian_mesh *frame)
{
    return particles_kinetic_energy(part) + lagrangian_mesh_kinetic_energy(frame);
}

/* Computes the motion of the run after bonds have broken (dynamic release) in explicit time steps: undamped until no
 * bond has broken for CROSSINGS_QUIET times the time in which a wave crosses the body, then damped until the kinetic
 * energy is at most MOTION_SMALL times the elastic energy. Stops at the latest after CROSSINGS_MOST such times,
 * CROSSINGS_DAMPED of them damped. *broken: receives the number of directed bonds that break (each bond counts twice).
 * Returns FAILED, with a message, if the motion diverges. */
static status steps_in_time(struct run *run, int64_t *broken)
{
    const real crossing = (particles_bounding_box_longest_edge(&run->part) + run->scene->spacing) /
                          run->tables.wave_speed; /* time in which a wave crosses the body [s] */
    const real quiet = CROSSINGS_QUIET * crossing, damping = 2 / crossing;
    const int64_t most = (int64_t)ceil(CROSSINGS_MOST * crossing / run->clock.dt);
    const int64_t damped_most = (int64_t)ceil(CROSSINGS_DAMPED * crossing / run->clock.dt);
    int64_t last = 0, damped = 0, had = run->diagnostics->bonds_broken;
    *broken = 0;
    for (int64_t k = 0; k < most && damped < damped_most; k++) {
        TRY(run_advance_by_one_time_step(run));
        TRY(run_check_particles_for_divergence(run, true, true));
        if (run->diagnostics->bonds_broken > had) *broken += run->diagnostics->bonds_broken - had, last = k, damped = 0;
        had = run->diagnostics->bonds_broken;
        if ((real)(k - last) * run->clock.dt < quiet) continue;
        velocities_scale(&run->part, &run->frame->mesh, &run->loads, 1 - damping * run->clock.dt);
        damped++;
        if (k % ENERGY_STEPS == 0 &&
            kinetic_present(&run->part, run->frame) <= MOTION_SMALL * run_compute_elastic_energy(run))
            break;
    }
    return OK;
}

/* Returns the strain, contact and fracture energy of the run minus the work of loads and supports [J]. */
static real energy_budget(struct run *run)
{
    const real held = run_compute_elastic_energy(run) + contact_elastic_energy(run->contact, &run->part) +
                      bonds_fracture_energy(&run->bonds);
    return held - run->loads.work - run->loads.constraint_work;
}

status crack_increment_apply_by_dynamic_release(struct run *run)
{
    struct statics *s = run->statics;
    const struct run_clock clock = run->clock;
    const real before = energy_budget(run), damped = run->damped;
    const int64_t broken = crack_increment_break_bonds_and_move_tips(run);
    int64_t more;
    velocities_scale(&run->part, &run->frame->mesh, &run->loads, 0);
    boundaries_freeze(run->scene, run->boundary, s->t);
    rigids_freeze(run->scene, run->rigid, true);
    contact_discard_linear_springs(run->contact);
    const real dt = clock.dt_bears;
    run->clock.dt = run->grid->transfer.dt = dt;
    run->clock.step = 1, run->clock.steps = RELEASE_STEPS_MOST, run->clock.stride = 1;
    const status moved = steps_in_time(run, &more);
    s->released_time += (real)(run->clock.step - 1) * dt;
    run->clock = clock;
    boundaries_restore(run->boundary, run->scene);
    rigids_freeze(run->scene, run->rigid, false);
    velocities_scale(&run->part, &run->frame->mesh, &run->loads, 0);
    TRY(moved);
    if (more > 0) sif_tips_stop_all(&s->sif);
    const real lost = before - energy_budget(run);
    s->balance.lost += lost, run->damped = damped + lost;
    statics_preconditioner_free(s);
    statics_equation_system_free(s);
    statics_equation_system_make(run);
    return crack_increment_find_new_equilibrium(run, broken + more);
}
