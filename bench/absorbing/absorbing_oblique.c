/* Oblique waves at an absorbing face. Between two mirrors half a wavelength apart, two plane waves at +-angle form the
 * field u_x = U(x, t) cos(k y), u_y = V(x, t) sin(k y); each is reflected as a plane wave. The reflected wave is the
 * difference from a body that continues beyond the face; at one frequency it consists of a P and an S wave with known
 * polarisations. */
#include <complex.h>
#undef I /* avoids a conflict of the imaginary unit with other headers */
#include <math.h>
#include <stdio.h>

#include "absorbing_bench.h"
#include "base/memory.h"
#include "step/report.h"
#include "mesh/mesh_part.h"

/* A strip with an oblique wave packet. shear: S wave, else P wave; across: distance of the mirrors, along: position
 * of the absorbing face [spacings]; k: wavenumber along y, wave: wavenumber along x [1/m]; from, radius: centre and
 * radius of the packet, station: position of the observation along x [m]; frequency [1/s]; until: end time [s]. */
struct oblique {
    bool shear;
    int across, along;
    double k, wave, from, radius, station, frequency, until;
};

/* Computes the initial velocity v[2] [m/s] at X[2] [m] of a wave packet with the profile g(x), a Gaussian times
 * cos(wave x): for a P wave the gradient of g(x) cos(k y), for an S wave the curl of g(x) sin(k y). The velocity is
 * scaled to a peak of about 1e-3 m/s. context: a struct oblique. */
static void packet(const void *context, const real *X, real *v)
{
    const struct oblique *o = context;
    const double x = X[0] - o->from, envelope = exp(-(x * x) / (o->radius * o->radius));
    const double g = envelope * cos(o->wave * x);
    const double slope = -2 * x / (o->radius * o->radius) * g - o->wave * envelope * sin(o->wave * x);
    const double scale = 1e-3 / hypot(o->k, o->wave);
    v[0] = scale * (o->shear ? o->k * g : slope) * cos(o->k * X[1]);
    v[1] = scale * (o->shear ? -slope : -o->k * g) * sin(o->k * X[1]);
}

/* Returns the strip and the wave packet for an angle of incidence [rad] and an approximate wavelength [spacings].
 * shear: S wave. The distance of the mirrors is rounded to whole spacings, and the exact wavelength follows from it. */
static struct oblique oblique_of(bool shear, double angle, double wavelength)
{
    const double h = ABSORBING_SPACING, speed = shear ? ABSORBING_SPEED / sqrt(3) : ABSORBING_SPEED;
    struct oblique o = {.shear = shear};
    o.across = 2 * (int)nearbyint(0.25 * wavelength / sin(angle));
    o.k = M_PI / (o.across * h);
    o.wave = o.k / tan(angle);
    o.frequency = hypot(o.k, o.wave) * speed;
    const double length = 2 * M_PI / hypot(o.k, o.wave);
    o.radius = length;
    o.along = (int)ceil(12 * o.radius / h / 2) * 2;
    o.from = o.along * h - 4 * o.radius;
    o.station = (o.along - nearbyint(0.5 * length / h) - 0.5) * h;
    o.until = 10 * o.radius / (speed * cos(angle)); /* before reflections from the other ends arrive */
    return o;
}

/* Runs a strip with an absorbing face that is `along` spacings long. Computes the Fourier amplitudes of the velocity at
 * the observed position, at the frequency of the wave, by summation over time: sum[0] of the component normal to the
 * face, sum[1] of the component along it [m]. o: geometry and wave packet; m: method of the run. Returns FAILED if a
 * step fails. */
static status oblique_run(const struct oblique *o, const struct absorbing_method *m, int along, double complex *sum)
{
    struct run e;
    struct scene s;
    char text[2048];
    const double h = ABSORBING_SPACING;
    snprintf(text, sizeof text,
             "name: oblique\nspace: plane strain\nthickness: 1 m\nduration: %.9g\n%s\nconversion: {criteria: none}\n"
             "material: {young: %.9g, poisson: 1/4, density: 1}\nbody: {box: {from: [0, 0], to: [%.9g, %.9g]}}\n"
             "particles: {spacing: %.9g}\nboundary:\n  - {absorbing: true, face: x+}\n"
             "  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: %.9g}}\noutput: {frames: 0, samples: 2}\n",
             o->until, m->keys, ABSORBING_SPEED * ABSORBING_SPEED / 1.2, along * h, o->across * h, h, o->across * h);
    TRY(bench_engine_make(&e, &s, "absorbing", text, NULL, 0));
    bench_engine_set_velocities(&e, packet, o);
    sum[0] = sum[1] = 0;
    status ran = report_open_history_and_write_first_frame(&e);
    while (ran == OK && e.clock.step < e.clock.steps) {
        ran = run_adapt_mesh_and_advance_one_step(&e);
        lagrangian_mesh_update_point_motion_and_stress(e.frame, &e.part, &e.loads);
        const double complex turn = cexp(_Complex_I * o->frequency * (e.clock.t - 0.5 * e.clock.dt)) * e.clock.dt;
        for (int64_t i = 0; i < e.part.n; i++) {
            if (fabs(e.part.X[0][i] - o->station) > 0.1 * h) continue;
            sum[0] += turn * e.part.v[0][i] * cos(o->k * e.part.X[1][i]);
            sum[1] += turn * e.part.v[1][i] * sin(o->k * e.part.X[1][i]);
        }
    }
    bench_engine_free(&e, &s);
    return ran;
}

status absorbing_measure_oblique_reflection(const struct absorbing_method *m, bool shear, double angle,
                                            double wavelength, struct absorbing_reflection *measured)
{
    const struct oblique o = oblique_of(shear, angle, wavelength);
    const double w = o.frequency, cp = ABSORBING_SPEED, cs = cp / sqrt(3), p = o.k / w;
    const double complex qp = csqrt(1 / (cp * cp) - p * p + 0 * _Complex_I);
    const double complex qs = csqrt(1 / (cs * cs) - p * p + 0 * _Complex_I);
    const double x = o.station - o.along * ABSORBING_SPACING;
    double complex in[2], with[2];
    TRY(oblique_run(&o, m, 2 * o.along, in));
    TRY(oblique_run(&o, m, o.along, with));
    const double complex back[2] = {with[0] - in[0], (with[1] - in[1]) / _Complex_I};
    const double complex came[2] = {in[0], in[1] / _Complex_I};
    const double complex P[2] = {-qp * cp * cexp(-_Complex_I * w * qp * x), p * cp * cexp(-_Complex_I * w * qp * x)};
    const double complex S[2] = {-p * cs * cexp(-_Complex_I * w * qs * x), -qs * cs * cexp(-_Complex_I * w * qs * x)};
    const double complex det = P[0] * S[1] - S[0] * P[1];
    const double amplitude = cabs(shear ? (-p * came[0] + qs * came[1]) * cs : (qp * came[0] + p * came[1]) * cp);
    measured->as_p = cabs((back[0] * S[1] - S[0] * back[1]) / det) / amplitude;
    measured->as_s = cabs((P[0] * back[1] - back[0] * P[1]) / det) / amplitude;
    return OK;
}
