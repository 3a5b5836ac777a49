/* Manufactured solution: a motion whose body force is chosen such that it solves the equations of motion. */
#include "manufactured.h"

#include <math.h>

/* Returns the spatial part of component a of the manufactured motion at X [m]: sin(k x_a) times cos(k x_b) of all
 * other axes b, with k = 2 pi/L. If slope >= 0, returns its derivative along the axis `slope`, divided by k. */
static real mode(const struct manufactured *m, const real *X, int a, int slope)
{
    const real k = 2 * M_PI / m->length;
    real product = 1;
    for (int b = 0; b < m->dim; b++) {
        const real phase = k * X[b];
        if (b == a)
            product *= b == slope ? cos(phase) : sin(phase);
        else
            product *= b == slope ? -sin(phase) : cos(phase);
    }
    return product;
}

/* Computes the two amplitudes of component a of the body force that the manufactured motion requires [N/m^3]: *steady
 * of its constant part, *beat of its part proportional to sin^2(pi t/T), where T is the period m->period. */
static void manufactured_forces(const struct manufactured *m, int a, real *steady, real *beat)
{
    const real k = 2 * M_PI / m->length, inertia = m->density * m->share[a] * square(M_PI / m->period);
    real sum = 0;
    for (int b = 0; b < m->dim; b++) sum += m->share[b];
    *steady = m->amplitude * 2 * inertia;
    *beat = m->amplitude * (k * k * ((m->c12 + m->shear) * sum + m->shear * m->dim * m->share[a]) - 4 * inertia);
}

struct manufactured_values manufactured_at(const struct manufactured *m, const real *position, real t)
{
    const real k = 2 * M_PI / m->length, grown = square(sin(M_PI * t / m->period));
    const real rate = M_PI / m->period * sin(2 * M_PI * t / m->period);
    struct manufactured_values v = {0};
    for (int a = 0; a < m->dim; a++) {
        const real shape = m->amplitude * m->share[a] * mode(m, position, a, -1);
        real steady, beat;
        manufactured_forces(m, a, &steady, &beat);
        v.displacement[a] = shape * grown, v.velocity[a] = shape * rate;
        v.force[a] = (steady + beat * grown) * mode(m, position, a, -1);
    }
    for (int s = 0; s < symmetric_tensor_component_count(m->dim); s++) {
        int a, b;
        symmetric_tensor_component_axes(m->dim, s, &a, &b);
        v.strain[s] = 0.5 * m->amplitude * grown * k *
                      (m->share[a] * mode(m, position, a, b) + m->share[b] * mode(m, position, b, a));
    }
    return v;
}

/* Writes one plane wave of the body force of m as an entry of `boundary` in a scene. The spatial part of the force, a
 * product of a sine and cosines, is the mean of 2^(dim - 1) such waves. sign[dim]: direction of the wave, 1 or -1 per
 * axis; beats: true for the part proportional to sin^2(pi t/T), false for the constant part. */
static void put_wave(FILE *to, const struct manufactured *m, const int *sign, bool beats)
{
    const int waves = 1 << (m->dim - 1);
    fputs("  - {body_force: [", to);
    for (int a = 0; a < m->dim; a++) {
        real part[2];
        manufactured_forces(m, a, &part[0], &part[1]);
        fprintf(to, "%s%.15g", a ? ", " : "", sign[a] * part[beats] / waves);
    }
    fprintf(to, "], profile: {sine: {wavelength: %.15g, direction: [", m->length / sqrt(m->dim));
    for (int a = 0; a < m->dim; a++) fprintf(to, "%s%d", a ? ", " : "", sign[a]);
    fputs("]}}", to);
    if (beats) fprintf(to, ", time: {pulse: {until: %.15g}}", m->period);
    fputs("}\n", to);
}

void manufactured_write_body_force(FILE *scene_file, const struct manufactured *m)
{
    for (int wave = 0; wave < 1 << (m->dim - 1); wave++) {
        const int sign[DIM_MAX] = {1, wave & 1 ? -1 : 1, wave & 2 ? -1 : 1};
        put_wave(scene_file, m, sign, false);
        put_wave(scene_file, m, sign, true);
    }
}
