/* Softening of bonds: how the force of a bond falls from its largest value to 0, by damage that depends on
 * its largest stretch (Coskun, Damircheli & Lipton 2025); a bilinear curve as of concrete (Petersson 1981).
 *
 * A bond with the stretch s, the largest stretch k so far and the damage d begins to soften at the stretch
 * s_0 and breaks at s_f. Its force divided by stiffness and weight is
 *
 *     s (1 - d(k)) for s > 0,   s for s <= 0,     1 - d(k) = f(k)/k,   f(k) = s_0 G((k - s_0)/(s_f - s_0))
 *
 * The softening curve G(x) falls from 1 at x = 0 to 0 at x = 1. It is the largest of several straight lines:
 * exact for linear and bilinear softening; for exponential softening, (exp(-5 x) - exp(-5))/(1 - exp(-5)), it
 * has eight chords, at most 0.8 % of the strength above the curve. Unloading is along the secant to the
 * origin. The dissipated energy, divided by stiffness, weight and length, has a closed form: the area under f
 * up to k, less f(k) k/2. At k = s_f it is s_c^2/2, the energy of a brittle bond of critical stretch s_c,
 * which determines s_f. */
#ifndef CLEAVE_SOFTENING
#define CLEAVE_SOFTENING

#include <math.h>

#include "base/base.h"
#include "material.h"

#define SOFTENING_LEAST 1e-6   /* least relative distance of onset and critical stretch; closer, a bond is brittle */
enum { SOFTENING_PIECES = 8 }; /* largest number of straight pieces of a curve */

/* A softening curve G(x) from G(0) = 1 to G(1) = 0, the largest of `pieces` straight lines and 0. A bond begins to
 * soften at the stretch s_0 and breaks at s_f; its force at the stretch k, divided by its largest force, is G((k -
 * s_0)/(s_f - s_0)). */
struct softening_curve {
    int pieces;
    real level[SOFTENING_PIECES], slope[SOFTENING_PIECES]; /* piece k: level - slope x [1] */
    real from[SOFTENING_PIECES + 1];                       /* x where piece k begins; 1 behind the last [1] */
    real area;                                             /* integral of G from 0 to 1 [1] */
};

/* Softening of the bonds between two materials. onset: stretch s_0 [1] at which softening begins, INFINITY for brittle
 * bonds; strength_scatters: true if the random strength factor of a bond multiplies s_0 alone, false if the factor
 * multiplies the critical stretch, too; surface: true if a strength surface starts the softening; with
 * strength_scatters the factor then multiplies the strength of the particle instead of s_0; rate: how s_0 increases
 * with the strain rate, NULL if it does not. */
struct softening_pair {
    real onset;
    bool strength_scatters, surface;
    const struct strength_rate *rate;
};

/* Stretches [1] at which a bond begins to soften (onset) and breaks (end); both are equal if the bond is brittle. */
struct softening_range {
    real onset, end;
};

/* Peak stresses of a material whose bonds soften, divided by s_0 E' (dimensionless): under uniaxial tension, equal
 * biaxial tension, and pure shear. s_0: stretch at which bonds begin to soften; E': E, in plane strain E/(1 - nu^2).
 * NAN in 1D, except in tension. */
struct softening_strength {
    real tension, biaxial, shear;
};

/* Returns the softening curve G(x) of the softening law `law`: the force of a bond divided by its force when softening
 * begins. x grows in proportion to the stretch, from 0 where softening begins to 1 where the bond breaks. */
struct softening_curve softening_curve_of_law(enum softening law);

/* Returns the stretch s_f [1] at which a softening bond breaks, such that the bond dissipates the same energy as a
 * brittle bond of critical stretch `critical_stretch` [1]. c: softening curve; onset_stretch: stretch s_0 at which
 * softening begins, at most `critical_stretch` [1]. */
static inline real softening_breaking_stretch_of_equal_energy(const struct softening_curve *c, real onset_stretch,
                                                              real critical_stretch)
{
    return onset_stretch + (square(critical_stretch) - square(onset_stretch)) / (2 * onset_stretch * c->area);
}

/* Returns the stretches [1] at which a bond begins to soften and breaks, such that the bond dissipates the same energy
 * as a brittle bond of critical stretch `critical_stretch` [1]. c: softening curve; onset_stretch: stretch at which the
 * bond begins to soften [1]; if `onset_stretch` is not below `critical_stretch`, the bond is brittle and both stretches
 * are `critical_stretch`. */
static inline struct softening_range softening_range_from_onset(const struct softening_curve *c, real onset_stretch,
                                                                real critical_stretch)
{
    if (!(onset_stretch < critical_stretch * (1 - SOFTENING_LEAST)))
        return (struct softening_range){critical_stretch, critical_stretch};
    return (struct softening_range){onset_stretch,
                                    softening_breaking_stretch_of_equal_energy(c, onset_stretch, critical_stretch)};
}

/* Returns the value G(x) [1] of the softening curve c: the force of a bond divided by its force when softening begins.
 * x >= 0: (k - s_0)/(s_f - s_0) [1], with the stretch k of the bond and the stretches s_0 and s_f at which it begins to
 * soften and breaks. */
static inline real softening_curve_normalised_force(const struct softening_curve *c, real x)
{
    real level = 0;
    for (int k = 0; k < c->pieces; k++) level = real_max(level, c->level[k] - c->slope[k] * x);
    return level;
}

/* Returns the fraction (0 to 1) of its initial stiffness that a softening bond has left in tension. c: softening curve;
 * onset_stretch, breaking_stretch: stretches at which the bond begins to soften and breaks [1]; largest_stretch:
 * largest stretch of the bond so far, at least `onset_stretch` [1]. */
static inline real softening_remaining_stiffness_fraction(const struct softening_curve *c, real onset_stretch,
                                                          real breaking_stretch, real largest_stretch)
{
    return onset_stretch *
           softening_curve_normalised_force(c, (largest_stretch - onset_stretch) / (breaking_stretch - onset_stretch)) /
           largest_stretch;
}

/* Returns the energy that a softening bond has dissipated, divided by stiffness, weight (factor on its force, such as
 * the share of the neighbour within the horizon) and length of the bond (dimensionless). c: softening curve;
 * onset_stretch, breaking_stretch: stretches at which the bond begins to soften and breaks [1]; largest_stretch:
 * largest stretch of the bond so far, at least `onset_stretch` [1]. */
real softening_normalised_dissipated_energy(const struct softening_curve *c, real onset_stretch, real breaking_stretch,
                                            real largest_stretch);

/* Returns the peak stresses in tension, equal biaxial tension and shear, divided by s_0 E', of bonds of all directions
 * with the softening curve c under growing uniform strain, by quadrature over directions. s_0: stretch at which bonds
 * begin to soften; E': modulus of uniaxial tension (material_uniaxial_tension_modulus); space: line, plane stress,
 * plane strain or solid; squared_stretch_ratio: (critical stretch/s_0)^2 [1]. */
struct softening_strength softening_curve_normalised_peak_stresses(const struct softening_curve *c, enum space space,
                                                                   real squared_stretch_ratio);

/* Returns the stretch s_0 [1] at which bonds must begin to soften so that material m has the tensile strength
 * m->tensile_strength. Solves s_0 = strength/(E' tension(kappa)) by fixed-point iteration, where kappa = (critical
 * stretch/s_0)^2, E' is the modulus of uniaxial tension, and tension is the result of
 * softening_curve_normalised_peak_stresses. m->critical_stretch must be set; if the horizon is too large for this
 * strength, the result exceeds m->critical_stretch. space: line, plane stress, plane strain or solid. */
real softening_onset_stretch_from_strength(const struct material *m, enum space space);

/* Strain rates of bonds are measured from this fraction [1] of the onset stretch on (stretch at which a bond begins to
 * soften in slow loading). */
#define RATE_FROM 0.5

/* Smallest ratio kappa = (critical stretch/onset)^2 of a bond, dimensionless. The strain rate increases the onset, the
 * stretch at which the bond begins to soften, up to this limit only. */
#define RATE_LEAST_RATIO 1.2

/* Interpolates a quantity that is table_values[k] at the strain rate r->rate[k], k = 0 .. r->points - 1, to the
 * strain rate `strain_rate` [1/s] and returns the value: linear in the logarithm of the rate, constant beyond
 * the table. */
real strength_rate_table_interpolate_in_log_rate(const struct strength_rate *r, const real *table_values,
                                                 real strain_rate);

/* Returns the modulus E' [Pa] of material m in the space `space`: the elastic stress divided by the strain in uniaxial
 * tension, i.e. Young's modulus E, in plane strain E/(1 - nu^2) with Poisson's ratio nu. */
static inline real material_uniaxial_tension_modulus(const struct material *m, enum space space)
{
    return space == SPACE_PLANE_STRAIN ? m->young / (1 - square(m->poisson)) : m->young;
}

#endif
