/* A front of conversion that passes a corner of the interface between bonds and material points. */
#include <math.h>

#include "limits_scenes.h"
#include "coupling/coupling_part.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"

/* A plane tensile wave, 32 spacings long, between mirrors. In the lower half, bonds initially extend to x = 50. In the
 * upper half, particles become peridynamic at half the peak stress of the wave, so that the front starts at x = 30,
 * moves along the interface y = 20, passes the corner, and continues with the wave to x = 65. The exact solution has no
 * transverse motion: all that occurs is caused by the corner. */
#define START 30e-3 /* position of the front at the start [m] */
#define WIDTH 32e-3 /* length of the wave [m] */
#define SPEED 0.1   /* peak velocity of the wave [m/s] */

/* Runs a plane wave past the corner of an interface between bonds and material points. r->given: y up to which the
 * initial bonds extend [mm]; at 40, the height of the plate, the interface is flat. Stores in to[0] the largest
 * transverse velocity over the velocity of the wave, INFINITY if an adaptive run converts no particle; in to[1] the
 * energy error and in to[2] the momentum error [1]. Returns FAILED if a step fails. */
static status corner(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    const double c = sqrt(72e9 * 9 / 8 / 2440), peak = 2440 * c * SPEED;
    TRY(limits_make_run_of_scene(
        &e, &s, r,
        "space: plane stress\nthickness: 1e-3\nduration: %.9g\nmaterial: {young: 72e9, density: 2440}\n"
        "body: {box: {from: [0, 0], to: [100e-3, 40e-3]}}\nparticles: {spacing: 1e-3}\n"
        "pd: {weights: isotropic, surface: none, region: {box: {from: [0, 0], to: [50e-3, %ge-3]}}}\n"
        "conversion: {stress: %.9g, alpha: 0.5}\n"
        "boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 40e-3}}\n"
        "initial: [{pulse: {at: [%g, 0], direction: [1, 0], width: %g, velocity: %g}}]\n"
        "output: {frames: 0, samples: 1}\n",
        35e-3 / c, r->given, peak, START, WIDTH, -SPEED));
    const status ran = run_advance_to_end_time(&e);
    const struct particles *p = &e.part;
    const bool converts = e.coupling->conversion.converted > 0 || e.scene->method != METHOD_ADAPTIVE;
    if (e.frame->mesh.points > 0) lagrangian_mesh_update_point_motion_and_stress(e.frame, &e.part, &e.loads);
    to[0] = converts ? 0 : INFINITY;
    for (int64_t i = 0; i < p->n; i++) to[0] = fmax(to[0], fabs(p->v[1][i]) / SPEED);
    to[1] = fabs(e.diagnostics->now.balance_error);
    to[2] = e.diagnostics->now.momentum_error;
    bench_engine_free(&e, &s);
    return ran;
}

#define ADAPTIVE(...) .set = {"method", "adaptive", __VA_ARGS__}
#define APIC "mpm.transfer", "apic"
#define HANDSHAKE "coupling", "handshake"
/* Methods and their expected results. In the reference frame the energy is constant to 1e-8. The errors of 1.1 and 1.4
 * % are between the sample at t = 0, which has the prescribed velocities, and all others, whose kinetic energy is that
 * conserved by leap-frog integration, smaller by a quarter of a velocity increment. */
#define CALM "partial stress with apic or frame: reference"
static const struct limits_row corners[] = {
    {.method = "partial stress, flip, no corner",
     ADAPTIVE(NULL),
     .given = 40,
     .known = {{0, 0.02}, {0, 0.02}, {0, 1e-13}}},
    {.method = "partial stress, flip",
     ADAPTIVE(NULL),
     .given = 20,
     .known = {{0.055, 0.11}, {0, 0.02}, {0, 1e-13}},
     .remedy = CALM},
    {.method = "partial stress, apic", ADAPTIVE(APIC), .given = 20, .known = {{0.02, 0.045}, {0, 0.02}, {0, 1e-13}}},
    {.method = "handshake, flip",
     ADAPTIVE(HANDSHAKE),
     .given = 20,
     .known = {{0.13, 0.26}, {0, 0.04}, {0, 1e-13}},
     .remedy = CALM},
    {.method = "handshake, apic",
     ADAPTIVE(HANDSHAKE, APIC),
     .given = 20,
     .known = {{0.15, 0.3}, {0, 0.04}, {0, 1e-13}},
     .remedy = CALM},
    {.method = "reference frame",
     ADAPTIVE("mpm.frame", "reference"),
     .given = 20,
     .known = {{0.015, 0.035}, {0, 0.015}, {0, 1e-13}}},
    {.method = "reference frame, handshake",
     ADAPTIVE("mpm.frame", "reference", HANDSHAKE),
     .given = 20,
     .known = {{0.11, 0.22}, {0, 0.015}, {0, 1e-13}},
     .remedy = CALM},
};
const struct limits_scene limits_corner_figure = {
    "a conversion front passes a corner of the interface",
    NULL,
    {{"motion across the wave [of its peak]", 0.05}, {"error of energy", 0.02}, {"error of momentum", 1e-12}},
    ROWS(corners),
    corner};
