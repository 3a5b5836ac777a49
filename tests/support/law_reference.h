/* Reference implementation of law_update (kernels/laws) for tests, simple and slow: one point, functions of the C
 * library, bisection. */
#ifndef CLEAVE_TESTS_LAW_REFERENCE
#define CLEAVE_TESTS_LAW_REFERENCE

#include <math.h>
#include <string.h>

#include "data/law.h"
#include "data/material.h"

/* Plastic state of a point: stress s and back stress [Pa], each with the components xx yy zz xy yz zx, and accumulated
 * plastic strain a [1]. */
struct reference_point {
    real s[SYM_MAX], back[SYM_MAX], a;
};

/* Returns the yield stress [Pa] at plastic strain a on the flow curve c: linear between its points, constant beyond the
 * last. */
static inline real reference_curve(const struct flow_curve *c, real a)
{
    for (int k = 1; k < c->points; k++)
        if (a <= c->strain[k])
            return c->stress[k - 1] +
                   (c->stress[k] - c->stress[k - 1]) * (a - c->strain[k - 1]) / (c->strain[k] - c->strain[k - 1]);
    return c->stress[c->points - 1];
}

/* Returns the yield stress of the flow law m [Pa] at accumulated plastic strain a [1], plastic strain rate `rate` [1/s]
 * and temperature T [K]; NAN, which fails every comparison, for a law that is missing here. */
static inline real reference_stress(const struct law *m, real a, real rate, real T)
{
    const real hot = (T - m->johnson_cook.T_room) / (m->johnson_cook.T_melt - m->johnson_cook.T_room);
    switch (m->flow) {
    case FLOW_LINEAR:
        return m->yield + m->hardening * a;
    case FLOW_VOCE:
        return m->yield + m->voce.saturation * -expm1(-m->voce.rate * a);
    case FLOW_POWER:
        return m->yield + m->power.coefficient * pow(a, m->power.exponent);
    case FLOW_TABLE:
        return reference_curve(&m->table, a);
    case FLOW_JOHNSON_COOK:
        return (m->johnson_cook.A + m->johnson_cook.B * pow(a, m->johnson_cook.n)) *
               (1 + m->johnson_cook.C * log(fmax(rate / m->johnson_cook.eps0, 1))) *
               (1 - pow(fmin(fmax(hot, 0), 1), m->johnson_cook.m));
    case FLOW_LAWS:
        break;
    }
    return NAN;
}

/* Computes the relative stress s' - g X of point p, with the deviator s' of its stress and its back stress X, and
 * stores its components xx yy zz xy yz zx in xi[SYM_MAX] [Pa]. g: fraction of the back stress that recall leaves.
 * Returns the equivalent stress sqrt(3/2 xi:xi) [Pa]. */
static inline real reference_relative(const struct reference_point *p, real g, real *xi)
{
    const real mean = (p->s[0] + p->s[1] + p->s[2]) / 3;
    real sum = 0;
    for (int c = 0; c < SYM_MAX; c++) {
        xi[c] = p->s[c] - (c < 3 ? mean : 0) - g * p->back[c];
        sum += (c < 3 ? 1.5 : 3) * xi[c] * xi[c];
    }
    return sqrt(sum);
}

/* Returns the fraction of the back stress added during an increment `more` of plastic strain that remains at the end of
 * the increment, since recall (the law of Armstrong and Frederick) reduces it meanwhile; 1 without recall. */
static inline real reference_added(const struct law *m, real more)
{
    const real x = m->kinematic.recall * more;
    return x > 0 ? -expm1(-x) / x : 1;
}

/* Returns by how much the equivalent stress exceeds the yield stress after an increment `more` of plastic strain from
 * the trial state p [Pa]; the root of this function is the increment of the step. duration: duration of the step [s],
 * 0: the rate has no effect; T: temperature [K]; stiffness: three times the shear modulus [Pa]. */
static inline real reference_excess(const struct law *m, const struct reference_point *p, real more, real duration,
                                    real T, real stiffness)
{
    const real rate = duration > 0 ? more / duration : 0;
    real xi[SYM_MAX];
    const real g = exp(-m->kinematic.recall * more);
    return reference_relative(p, g, xi) - (stiffness + m->kinematic.modulus * reference_added(m, more)) * more -
           reference_stress(m, p->a + more, rate, T);
}

/* Maps the trial stress of the point p back to the yield surface of the flow law m in 3D, by bisection of the increment
 * of plastic strain, and updates stress, back stress and plastic strain of p. Changes nothing below the yield stress.
 * duration: duration of the step [s], 0: load step, the rate has no effect; T: temperature [K]. */
static inline void reference_return(const struct law *m, struct reference_point *p, real duration, real T)
{
    const real stiffness = 3 * m->shear;
    real xi[SYM_MAX], low = 0, high = reference_relative(p, 1, xi) / stiffness * 2;
    if (!(reference_excess(m, p, 0, duration, T, stiffness) > 0)) return;
    for (int k = 0; k < 200; k++) {
        const real middle = 0.5 * (low + high);
        if (reference_excess(m, p, middle, duration, T, stiffness) > 0)
            low = middle;
        else
            high = middle;
    }
    const real g = exp(-m->kinematic.recall * low), q = reference_relative(p, g, xi);
    for (int c = 0; c < SYM_MAX; c++) {
        const real strain = low * 1.5 * xi[c] / q;
        p->s[c] -= 2 * m->shear * strain;
        p->back[c] = g * p->back[c] + reference_added(m, low) * (2.0 / 3 * m->kinematic.modulus * strain);
    }
    p->a += low;
}

/* Maps the trial stress of the point p in plane stress (zz = 0) back to the yield surface of the flow law m, such that
 * the stress remains plane: finds by bisection the strain zz, beyond the elastic one, with which reference_return
 * leaves no stress zz. duration: duration of the step [s], 0: load step, the rate has no effect; T: temperature [K]. */
static inline void reference_return_plane_stress(const struct law *m, struct reference_point *p, real duration, real T)
{
    const real c12 = m->young * m->poisson / ((1 + m->poisson) * (1 - 2 * m->poisson)), c11 = c12 + 2 * m->shear;
    const real most = 10 * (fabs(p->s[0]) + fabs(p->s[1]) + fabs(p->s[3])) / m->young;
    real low = -most, high = most;
    const struct reference_point trial = *p;
    for (int k = 0; k < 200; k++) {
        const real middle = 0.5 * (low + high);
        *p = trial;
        p->s[0] += c12 * middle, p->s[1] += c12 * middle, p->s[2] += c11 * middle;
        reference_return(m, p, duration, T);
        if (p->s[2] > 0)
            high = middle;
        else
            low = middle;
    }
}

#endif
