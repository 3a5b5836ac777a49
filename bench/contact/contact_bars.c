/* Bars that collide: equal bars exchange their velocities and separate after 2 L/c, under the force rho c v A. */
#include <math.h>

#include "contact_bench.h"
#include "contact/contact.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "step/stability.h"
#include "step/checks.h"

#define YOUNG 200e9
#define DENSITY (YOUNG / (CONTACT_WAVE * CONTACT_WAVE))

static status bars_make(struct run *run, struct scene *s, const struct contact_case *c, double until)
{
    const double D = CONTACT_SPACING, gap = 0.1 * D;
    return contact_make_run_of_scene(run, s,
                                     "name: bars\nspace: line\nsection: 1 mm^2\nmethod: pd\nduration: %.9g\n"
                                     "material: {young: %.9g, density: %.9g}\nparticles: {spacing: %.9g}\nbodies:\n"
                                     "  - {name: a, shape: {box: {from: [%.9g], to: [0]}}, velocity: [%.9g]}\n"
                                     "  - {name: b, shape: {box: {from: [%.9g], to: [%.9g]}}, velocity: [%.9g]}\n"
                                     "contact: {between: bodies, law: %s}\noutput: {frames: 0, samples: 400}\n",
                                     until, YOUNG, DENSITY, D, -c->given[0] * D, c->given[2] * CONTACT_WAVE, gap,
                                     gap + c->given[1] * D, c->given[3] * CONTACT_WAVE, c->law);
}

/* Course of a contact: first time `from` and last time `until` at which a contact force acts on the first body [s],
 * largest force [N], largest error of the energy balance [1]. */
struct contact_course {
    double from, until, force, error;
};

static status bars_run(struct run *run, struct contact_course *seen)
{
    double before = contact_motion_of_body(run, 0).v[0];
    *seen = (struct contact_course){INFINITY, -INFINITY, 0, 0};
    TRY(report_open_history_and_write_first_frame(run));
    while (run->clock.step < run->clock.steps) {
        TRY(run_adapt_mesh_and_advance_one_step(run));
        TRY(run_check_stability_after_step(run));
        const struct contact_motion a = contact_motion_of_body(run, 0);
        const double force = fabs(a.v[0] - before) * a.mass / run->clock.dt;
        if (force > seen->force) seen->force = force;
        if (run->contact->touching > 0) seen->from = fmin(seen->from, run->clock.t), seen->until = run->clock.t;
        seen->error = fmax(seen->error, fabs(run->diagnostics->now.balance_error));
        before = a.v[0];
    }
    return report_write_last_checkpoint_and_finish(run);
}

/* Runs two equal bars that approach each other with opposite velocities. c->given[]: lengths of the first and the
 * second bar [spacings], speed of each [wave speeds], and again the negative speed. Stores the relative velocity after
 * the collision, the duration of contact and the largest force, each over its exact value, in measured[0] to
 * measured[2], and the largest energy error [1] in measured[3]. Returns FAILED if a step fails. */
status contact_measure_bar_collision(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    struct contact_course seen;
    const double v = c->given[2] * CONTACT_WAVE, L = c->given[0] * CONTACT_SPACING;
    TRY(bars_make(&e, &s, c, 0.1 * CONTACT_SPACING / (2 * v) + 2.6 * L / CONTACT_WAVE));
    const status ran = bars_run(&e, &seen);
    if (ran == OK) {
        measured[0] = (contact_motion_of_body(&e, 1).v[0] - contact_motion_of_body(&e, 0).v[0]) / (2 * v);
        measured[1] = (seen.until - seen.from) / (2 * L / CONTACT_WAVE);
        measured[2] = seen.force / (DENSITY * CONTACT_WAVE * v * 1e-6);
        measured[3] = seen.error;
    }
    bench_engine_free(&e, &s);
    return ran;
}

/* Runs a bar that hits a bar of twice its length at rest. c->given[]: lengths of both [spacings], speed of the first
 * [wave speeds]. Stores the velocities of both bars after the collision over the initial velocity, exactly 0 and 1/2,
 * in measured[0] and measured[1], and the largest energy error [1] in measured[2]. Returns FAILED if a step fails. */
status contact_measure_striker_bar(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    struct contact_course seen;
    const double v = c->given[2] * CONTACT_WAVE, L = c->given[0] * CONTACT_SPACING;
    TRY(bars_make(&e, &s, c, 0.1 * CONTACT_SPACING / v + 2.6 * L / CONTACT_WAVE));
    const status ran = bars_run(&e, &seen);
    if (ran == OK) {
        measured[0] = contact_motion_of_body(&e, 0).v[0] / v;
        measured[1] = contact_motion_of_body(&e, 1).v[0] / v;
        measured[2] = seen.error;
    }
    bench_engine_free(&e, &s);
    return ran;
}

/* Runs a plane bar between two rigid walls, until it has hit them c->given[1] times in total. The gaps at its two ends
 * sum to 5 spacings. given[0]: particles along the bar, with a fifth of this number across it; given[2]: speed [wave
 * speeds]. Stores the largest error of the energy [1] in measured[0], and that of the momentum in measured[1]. Returns
 * FAILED if a step fails. */
status contact_measure_bouncing_bar(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    struct contact_course seen;
    const double D = CONTACT_SPACING, n = c->given[0], v = c->given[2] * CONTACT_WAVE, room = 5 * D;
    TRY(contact_make_run_of_scene(
        &e, &s,
        "name: bounces\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: %.9g\n"
        "material: {young: %.9g, poisson: 1/3, density: %.9g}\nparticles: {spacing: %.9g}\nbodies:\n"
        "  - {name: bar, shape: {box: {from: [0, 0], to: [%.9g, %.9g]}}, velocity: [%.9g, 0]}\n"
        "  - {name: left, rigid: true, shape: {half-space: {point: [%.9g, 0], normal: [1, 0]}}}\n"
        "  - {name: right, rigid: true, shape: {half-space: {point: [%.9g, 0], normal: [-1, 0]}}}\n"
        "contact: {law: %s}\noutput: {frames: 0, samples: 400}\n",
        c->given[1] * (room / v + 2 * n * D / CONTACT_WAVE), YOUNG, DENSITY, D, n * D, 0.2 * n * D, v, -0.5 * room,
        n * D + 0.5 * room, c->law));
    const status ran = bars_run(&e, &seen);
    if (ran == OK) {
        measured[0] = seen.error;
        measured[1] = e.diagnostics->now.momentum_error;
    }
    bench_engine_free(&e, &s);
    return ran;
}
