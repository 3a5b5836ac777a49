/* A block that is cut through and compressed: its faces transmit the force of the intact block; and Hertz contact. */
#include <math.h>

#include "base/memory.h"
#include "contact_bench.h"
#include "contact/contact.h"
#include "rigid/rigid_part.h"
#include "probes/diagnostics.h"
#include "step/report.h"

/* Mean forces on the upper end of a block over the second half of the run, while the ends are at rest: normal and along
 * the end [N]; overlap of the faces of the cut. */
struct block_force {
    double normal, along, overlap;
};

static status block_run(const struct contact_case *c, bool cut, struct block_force *f)
{
    struct run e;
    struct scene s;
    const double D = CONTACT_SPACING, edge = c->given[0] * D, time = 60 * edge / CONTACT_WAVE;
    const double ramp = 0.5 * time, shift = c->given[1] * edge / ramp, slip = c->given[2] * D / ramp;
    char crack[128] = "";
    if (cut)
        snprintf(crack, sizeof crack, "cracks: [{from: [%.9g, %.9g], to: [%.9g, %.9g]}]\n", -D, 0.5 * edge, edge + D,
                 0.5 * edge);
    *f = (struct block_force){0};
    TRY(contact_make_run_of_scene(
        &e, &s,
        "name: block\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: %.9g\n"
        "material: {young: 200e9, poisson: 1/3, density: 8000}\nparticles: {spacing: %.9g}\n"
        "body: {box: {from: [0, 0], to: [%.9g, %.9g]}}\n%sboundary:\n"
        "  - {name: low, fixed: all, region: {box: {from: [-inf, -inf], to: [inf, %.9g]}}}\n"
        "  - {name: high, velocity: [%.9g, %.9g], region: {box: {from: [-inf, %.9g], to: [inf, inf]}}, "
        "time: {step: {until: %.9g}}}\n"
        "contact: {between: all, law: %s}\noutput: {frames: 0, samples: 10}\n",
        time, D, edge, edge, crack, 2 * D, slip, -shift, edge - 2 * D, ramp, c->law));
    int64_t n = 0;
    status ran = report_open_history_and_write_first_frame(&e);
    while (ran == OK && e.clock.step < e.clock.steps) {
        ran = run_adapt_mesh_and_advance_one_step(&e);
        if (e.clock.t < ramp) continue;
        f->normal += e.loads.load[1].reaction[1], f->along += e.loads.load[1].reaction[0], n++;
    }
    f->normal /= (double)n, f->along /= (double)n;
    f->overlap = e.contact->overlap_most / D;
    bench_engine_free(&e, &s);
    return ran;
}

/* Compares a block that is cut in two and compressed with an intact one. Stores normal and tangential force on its ends
 * over those of the intact block in measured[0] and measured[1], and the overlap of the cut faces [spacings] in
 * measured[2]. c: case with its parameters. Returns FAILED if a run fails. */
status contact_measure_cut_block(const struct contact_case *c, double *measured)
{
    struct block_force whole, cut;
    TRY(block_run(c, false, &whole));
    TRY(block_run(c, true, &cut));
    measured[0] = cut.normal / whole.normal;
    measured[1] = fabs(cut.along / whole.along);
    measured[2] = cut.overlap;
    return OK;
}

/* ---- Hertz ------------------------------------------------------------------------------------------------------- */

/* Runs a ball of radius R = c->given[0] spacings that hits a rigid plane at the speed v = c->given[1] wave speeds.
 * measured[0]: exponent of the force over the approach (Hertz: 3/2), fitted above a tenth of the largest force;
 * measured[1]: duration over that of Hertz, 2.87 (m^2/(R E*^2 v))^(1/5) with the mass m and E* = E/(1 - nu^2);
 * measured[2]: speed afterwards over v; measured[3]: energy error [1]. Returns FAILED if a step fails. */
status contact_measure_ball_on_plane(const struct contact_case *c, double *measured)
{
    struct run e;
    struct scene s;
    const double D = CONTACT_SPACING, R = c->given[0] * D, v = c->given[1] * CONTACT_WAVE, E = 200e9, nu = 0.25;
    const double density = E / (CONTACT_WAVE * CONTACT_WAVE), mass = density * 4 / 3. * acos(-1) * R * R * R;
    const double star = E / (1 - nu * nu), time = 2.87 * pow(mass * mass / (R * star * star * v), 0.2);
    TRY(contact_make_run_of_scene(
        &e, &s,
        "name: hertz\nspace: solid\nmethod: pd\nduration: %.9g\n"
        "material: {young: %.9g, density: %.9g}\nparticles: {spacing: %.9g}\nbodies:\n"
        "  - {name: ball, shape: {ball: {centre: [0, 0, %.9g], radius: %.9g}}, velocity: [0, 0, %.9g]}\n"
        "  - {name: floor, rigid: true, shape: {half-space: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
        "contact: {between: bodies}\noutput: {frames: 0, samples: 10}\n",
        1.3 * time, E, density, D, R, R, -v));
    double sum[5] = {0}, from = INFINITY, until = 0, largest = 0, start = 0;
    const int64_t steps = e.clock.steps;
    double *force = NEW("bench.force", steps, double), *approach = NEW("bench.way", steps, double);
    status ran = report_open_history_and_write_first_frame(&e);
    while (ran == OK && e.clock.step < steps) {
        const int64_t n = e.clock.step;
        approach[n] = start - contact_motion_of_body(&e, 0).x[2];
        if (n == 0) start = contact_motion_of_body(&e, 0).x[2], approach[n] = 0;
        ran = run_adapt_mesh_and_advance_one_step(&e);
        force[n] = -e.rigid->body[0].force[2];
        if (force[n] > 0) from = fmin(from, e.clock.t), until = e.clock.t;
        if (force[n] > largest) largest = force[n];
    }
    for (int64_t n = 0; n < steps && force[n] < largest; n++) {
        if (force[n] < 0.1 * largest) continue;
        const double x = log(approach[n]), y = log(force[n]);
        sum[0]++, sum[1] += x, sum[2] += y, sum[3] += x * x, sum[4] += x * y;
    }
    measured[0] = (sum[0] * sum[4] - sum[1] * sum[2]) / (sum[0] * sum[3] - sum[1] * sum[1]);
    measured[1] = (until - from) / time;
    measured[2] = contact_motion_of_body(&e, 0).v[2] / v;
    measured[3] = fabs(e.diagnostics->now.balance_error);
    memory_free(force), memory_free(approach);
    bench_engine_free(&e, &s);
    return ran;
}
