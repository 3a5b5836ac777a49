/* floor 5: a front of conversion that runs past a corner of the interface between bonds and material points. */
#include <math.h>

#include "failing_scenes.h"

/* A plane wave of tension between mirrors, 32 spacings long. Below, bonds reach to x = 50 from the start; above, what the wave
 * tightens to half its peak becomes peridynamic, so that the front comes from x = 30 along the interface y = 20, passes the corner,
 * and goes on to x = 65 with the wave. It stays what it was: v = V exp(-(4 xi/w)^2), c^2 = E/(rho (1 - nu^2)). */
#define START 30e-3
#define WIDTH 32e-3
#define SPEED 0.1

static double exact(double x, double c, double t) { return -SPEED * exp(-square(4 * (x - START - c * t) / WIDTH)); }

static status corner(const struct failing_row *r, double *to)
{
    struct engine e;
    struct scene s;
    const double c = sqrt(72e9 * 9 / 8 / 2440), peak = 2440 * c * SPEED;
    TRY(failing_make(&e, &s, r, "space: plane stress\nthickness: 1e-3\nduration: %.9g\nmaterial: {young: 72e9, density: 2440}\n"
                     "body: {box: {from: [0, 0], to: [100e-3, 40e-3]}}\nparticles: {spacing: 1e-3}\n"
                     "pd: {weights: isotropic, surface: none, region: {box: {from: [0, 0], to: [50e-3, 20e-3]}}}\n"
                     "conversion: {stress: %.9g, alpha: 0.5}\n"
                     "boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 40e-3}}\n"
                     "initial: [{pulse: {at: [%g, 0], direction: [1, 0], width: %g, velocity: %g}}]\n"
                     "output: {frames: 0, samples: 1}\n", 35e-3 / c, peak, START, WIDTH, -SPEED));
    const status ran = engine_run(&e);
    const struct particles *p = &e.part;
    const double t = (e.step - 0.5) * e.dt;      /* of the velocities */
    const bool converts = e.conversion.converted > 0 || e.scene->method != METHOD_ADAPTIVE;
    if (e.mesh.points > 0) engine_mesh_show(&e);
    to[0] = converts ? 0 : INFINITY;
    for (int64_t i = 0; i < p->n; i++) to[0] = fmax(to[0], hypot(p->v[0][i] - exact(p->x[0][i], c, t), p->v[1][i]) / SPEED);
    to[1] = fabs(e.watch.now.balance_error);
    to[2] = e.watch.now.momentum_error;
    bench_engine_free(&e, &s);
    return ran;
}

static const struct failing_row corners[] = {
    {.method = "bonds alone", .set = {"method", "pd"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "gimp flip alone", .set = {"method", "mpm"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "partial stress, flip", .set = {"method", "adaptive"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "partial stress, undamped", .set = {"method", "adaptive", "mpm.rim_damping", "0"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "partial stress, apic", .set = {"method", "adaptive", "mpm.transfer", "apic"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "handshake, flip", .set = {"method", "adaptive", "coupling", "handshake"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "handshake, apic", .set = {"method", "adaptive", "coupling", "handshake", "mpm.transfer", "apic"},
     .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
    {.method = "reference frame", .set = {"method", "adaptive", "mpm.frame", "reference"}, .known = {{0, 1}, {0, 1}, {0, 1e-12}}},
};
const struct failing_scene failing_corner = {
    "a conversion front passes a corner of the interface",
    {{"error of the wave [of its peak]", 0.05}, {"error of energy", 0.02}, {"error of momentum", 1e-12}}, ROWS(corners), corner};
