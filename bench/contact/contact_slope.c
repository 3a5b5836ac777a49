/* A block on a slope under its weight: it slides with acceleration g (sin - mu cos), or sticks. */
#include <math.h>

#include "contact_bench.h"
#include "probes/diagnostics.h"
#include "step/report.h"

/* Runs a block of 12 x 8 particles on a slope with the tangent c->given[0] and the coefficient of friction given[1], on
 * a rigid floor if given[2] > 0, else on a deformable one. measured[0]: its acceleration over g sin(slope);
 * measured[1]: distance it has moved [spacings]; measured[2]: energy error [1]. Returns FAILED if a step fails. */
status contact_measure_sliding_block(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    const double D = CONTACT_SPACING, slope = atan(c->given[0]), friction = c->given[1], E = 200e9, density = 8000;
    const double g = 1e-4 * E / (density * 8 * D), settle = 100e-6, slide = sqrt(2 * 20 * D / (g * sin(slope)));
    const bool rigid = c->given[2] > 0;
    char floor[256], held[256] = "";
    if (rigid)
        snprintf(floor, sizeof floor,
                 "  - {name: floor, rigid: true, shape: {half-space: {point: [0, 0], normal: [0, 1]}}}\n");
    else {
        snprintf(floor, sizeof floor, "  - {name: floor, shape: {box: {from: [%.9g, %.9g], to: [%.9g, 0]}}}\n", -6 * D,
                 -4 * D, 54 * D);
        snprintf(held, sizeof held, "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, %.9g]}}}\n", -2 * D);
    }
    TRY(contact_make_run_of_scene(
        &e, &s,
        "name: slope\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: %.9g\n"
        "material: {young: %.9g, poisson: 1/3, density: %.9g}\nparticles: {spacing: %.9g}\nbodies:\n"
        "  - {name: block, shape: {box: {from: [0, 0], to: [%.9g, %.9g]}}}\n%s"
        "boundary:\n%s"
        "  - {body_force: [0, %.9g], body: block, time: {ramp: {until: %.9g}}}\n"
        "  - {body_force: [%.9g, 0], body: block, time: {ramp: {from: %.9g, until: %.9g}}}\n"
        "contact: {between: bodies, friction: %.9g}\noutput: {frames: 0, samples: 100}\n",
        2 * settle + slide, E, density, D, 12 * D, 8 * D, floor, held, -density * g * cos(slope), settle,
        density * g * sin(slope), settle, 1.001 * settle, friction));
    double from = 0, at = 0, then = 0;
    status ran = report_open_history_and_write_first_frame(&e);
    while (ran == OK && e.clock.step < e.clock.steps) {
        ran = run_adapt_mesh_and_advance_one_step(&e);
        const struct contact_motion m = contact_motion_of_body(&e, 0);
        if (e.clock.t < 2 * settle) from = m.x[0], at = m.v[0], then = e.clock.t;
    }
    if (ran == OK) ran = report_write_last_checkpoint_and_finish(&e);
    const struct contact_motion m = contact_motion_of_body(&e, 0);
    measured[0] = (m.v[0] - at) / (e.clock.t - then) / (g * sin(slope));
    measured[1] = (m.x[0] - from) / D;
    measured[2] = fabs(e.diagnostics->now.balance_error);
    bench_engine_free(&e, &s);
    return ran;
}
