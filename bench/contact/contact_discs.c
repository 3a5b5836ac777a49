/* Discs that collide obliquely without friction: only the normal component of their velocity may change, and no
 * rotation may arise. */
#include <math.h>

#include "contact_bench.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "step/stability.h"
#include "step/checks.h"

/* Runs the collision of two discs to the end. normal[2]: receives the unit vector between their centres at the time
 * when these are nearest to each other, since this direction rotates during contact. Returns FAILED if a step fails. */
static status discs_run(struct run *run, double *normal)
{
    double least = INFINITY;
    TRY(report_open_history_and_write_first_frame(run));
    while (run->clock.step < run->clock.steps) {
        TRY(run_adapt_mesh_and_advance_one_step(run));
        TRY(run_check_stability_after_step(run));
        const struct contact_motion a = contact_motion_of_body(run, 0), b = contact_motion_of_body(run, 1);
        const double x = b.x[0] - a.x[0], y = b.x[1] - a.x[1], far = hypot(x, y);
        if (far < least) least = far, normal[0] = x / far, normal[1] = y / far;
    }
    return report_write_last_checkpoint_and_finish(run);
}

status contact_measure_disc_collision(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    const double D = CONTACT_SPACING, R = c->given[0] * D, v = c->given[1] * CONTACT_WAVE, turn = c->given[3];
    const double angle = asin(0.5 * c->given[2]), gap = 0.3 * D, far = R + 0.5 * gap;
    /* Line of centres at the angle `turn`, velocities at turn - angle. */
    const double nx = cos(turn), ny = sin(turn), vx = v * cos(turn - angle), vy = v * sin(turn - angle);
    TRY(contact_make_run_of_scene(
        &e, &s,
        "name: discs\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: %.9g\n"
        "material: {young: 200 GPa, poisson: 1/3, density: 8000}\nparticles: {spacing: 1 mm}\nbodies:\n"
        "  - {name: a, shape: {ball: {centre: [%.9g, %.9g], radius: %.9g}}, velocity: [%.9g, %.9g]}\n"
        "  - {name: b, shape: {ball: {centre: [%.9g, %.9g], radius: %.9g}}, velocity: [%.9g, %.9g]}\n"
        "contact: {between: bodies, law: %s}\noutput: {frames: 0, samples: 100}\n",
        gap / (2 * v * cos(angle)) + 20 * R / CONTACT_WAVE, -far * nx, -far * ny, R, vx, vy, far * nx, far * ny, R, -vx,
        -vy, c->law));
    double normal[2] = {1, 0};
    const status ran = discs_run(&e, normal);
    if (ran == OK) {
        const struct contact_motion a = contact_motion_of_body(&e, 0), b = contact_motion_of_body(&e, 1);
        const double wx = b.v[0] - a.v[0], wy = b.v[1] - a.v[1], mx = normal[0], my = normal[1];
        measured[0] = (wx * mx + wy * my) / (2 * (vx * mx + vy * my));
        measured[1] = angle > 0 ? (wy * mx - wx * my) / (2 * (vx * my - vy * mx)) : 1;
        measured[2] = 0.5 * (a.spin + b.spin) * R / v;
        measured[3] = fabs(e.diagnostics->now.balance_error);
    }
    bench_engine_free(&e, &s);
    return ran;
}
