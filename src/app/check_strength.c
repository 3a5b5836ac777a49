/* Prints the strength of a material for `cleave check`: the stress at which its bonds begin to soften or, for brittle
 * bonds, the stress that follows from their critical stretch. */
#include <math.h>
#include <stdio.h>

#include "check_parts.h"
#include "scene/scene_softening.h"

#define FEW 2.5 /* horizon below which bonds have few directions [spacings] */

/* Energy that a crack driven by loads dissipates beyond the fracture energy G_c, because bonds beside the crack soften
 * as well [% of G_c]. It is tabulated by kappa = (critical stretch/onset stretch of softening)^2, in the first row for
 * 2D and in the second for bonds of the cubic lattice in 3D under plane strain, as measured by a separate program of
 * the same law. n: number of measured kappas. */
enum { EXCESSES = 5 };
static const struct {
    int n;
    real kappa[EXCESSES], excess[EXCESSES];
} measured[2] = {{5, {2.1, 4.2, 8.3, 17, 33}, {2, 3, 5, 4, 7}}, {4, {1.2, 2.4, 4.7, 9.7}, {2, 4, 5.5, 12}}};

/* Prints the horizon of scene s (the input file) [m] and, if the fracture energy G_c of material m is given, the ratio
 * of the horizon to the length E G_c/strength^2, with Young's modulus E and the tensile strength. */
static void say_horizon(const struct scene *s, const struct material *m)
{
    printf("               horizon %.4g m", s->horizon * s->spacing);
    if (!isnan(m->energy_release_rate))
        printf(", %.3g of E G_c/strength^2",
               s->horizon * s->spacing * square(m->tensile_strength) / (m->young * m->energy_release_rate));
}

/* Prints by how many per cent the energy that a crack dissipates exceeds the fracture energy G_c, in 2D or 3D as scene
 * s (the input file). kappa: (critical stretch/onset stretch of softening)^2. Between measured values of kappa the
 * excess is interpolated linearly in log(kappa). Above the largest one it is printed as a lower bound. */
static void say_excess(const struct scene *s, real kappa)
{
    const int of = s->dim == 3, last = measured[of].n - 1;
    const real *const at = measured[of].kappa, *const excess = measured[of].excess;
    int k = 0;
    if (kappa > at[last]) {
        printf("; with this horizon cracks dissipate at least %.0f %% more than G_c", excess[last]);
        return;
    }
    while (k < last - 1 && kappa > at[k + 1]) k++;
    const real share = real_max(0, log(kappa / at[k]) / log(at[k + 1] / at[k]));
    printf("; with this horizon cracks dissipate about %.0f %% more than G_c",
           excess[k] + share * (excess[k + 1] - excess[k]));
}

/* Prints that strength depends on the direction of the lattice if the horizon of scene s (the input file) is below FEW
 * spacings: bonds then have few directions. Prints nothing in 1D. Measured: 43.9 MPa of 40 at 2 spacings in the strip
 * of inputs/strength_strip.yaml, 39.1 at 2.5, 38.5 at 3. */
static void say_few_directions(const struct scene *s)
{
    if (s->dim > 1 && s->horizon < FEW)
        printf("; with a horizon of %.3g spacings bonds have few directions, and the strength depends by some 10 %% on "
               "that of the lattice: use particles.horizon: 3.015",
               s->horizon);
}

/* Prints three lengths for material m in scene s (the input file): the horizon, the horizon below which the stress
 * reaches the strength of the softening law, and the horizon below which the lattice does not impede cracks. Except in
 * 1D also prints the energy that cracks dissipate beyond G_c. kappa: (critical stretch/onset stretch of
 * softening)^2. */
static void say_horizons(const struct scene *s, const struct material *m, real kappa)
{
    say_horizon(s, m);
    printf("; stress reaches this strength with a horizon below %.4g m, and cracks grow unimpeded by the lattice below "
           "%.4g m",
           scene_horizon_for_failure_to_onset_stretch_ratio(s, m, 1),
           scene_horizon_for_failure_to_onset_stretch_ratio(s, m, FREE_OF_TRAPPING));
    if (s->dim > 1) say_excess(s, kappa);
    say_few_directions(s);
    printf("\n");
}

/* Prints the strengths of material m according to its strength surface (failure criterion in stress), and the radius
 * over which strains are averaged to evaluate the surface. Also prints the horizon that the surface requires in scene s
 * (the input file): with a larger horizon, bonds begin to soften before the stress reaches the surface. Prints the
 * stresses in tension and shear for which this happens. */
static void print_surface(const struct scene *s, const struct material *m)
{
    const struct softening_curve curve = softening_curve_of_law(m->softening);
    const struct surface_strengths surface = material_strengths_from_strength_surface(m, s->space);
    const real unit = material_uniaxial_tension_modulus(m, s->space) * m->onset_stretch;
    const struct softening_strength own =
        softening_curve_normalised_peak_stresses(&curve, s->space, square(m->critical_stretch / m->onset_stretch));
    const real own_shear = unit * own.shear;
    printf("strength       %s: %.4g Pa in tension, %.4g Pa in equal biaxial tension, %.4g Pa in shear", m->name,
           surface.tension, surface.biaxial, surface.shear);
    if (isfinite(surface.compression)) printf(", %.4g Pa in uniaxial compression", surface.compression);
    if (s->dim == 3) printf(", %.4g Pa in hydrostatic tension", surface.hydrostatic);
    printf(", from a strength surface; strains are averaged over %.4g m (%d means over neighbourhoods)\n",
           scene_strength_surface_averaging_radius(s, m), m->surface_means);
    say_horizon(s, m);
    printf("; with a horizon of %.4g m or more the stress does not reach the surface",
           scene_largest_horizon_for_strength_surface(s, m));
    if (surface.tension > unit)
        printf("; in tension bonds soften at about %.4g Pa already, before the surface is reached", unit);
    if (surface.shear > own_shear)
        printf("; in shear bonds soften at about %.4g Pa already, before the surface is reached", own_shear);
    printf("\n");
}

/* Prints the tensile strength of material m at the lowest and the highest strain rate of its table of strength by
 * strain rate. Prints nothing if m has no such table. */
static void print_rate(const struct material *m)
{
    const struct strength_rate *rate = &m->rate;
    const int last = rate->points - 1;
    if (last < 0) return;
    printf("               %.4g Pa at strain rates up to %.4g 1/s, %.4g Pa from %.4g 1/s on, at the same G_c\n",
           m->tensile_strength * rate->factor[0], rate->rate[0], m->tensile_strength * rate->factor[last],
           rate->rate[last]);
}

void print_softening_and_horizon_limits(const struct scene *s, const struct material *m)
{
    static const char *const law[] = {[SOFTENING_LINEAR] = "linearly",
                                      [SOFTENING_BILINEAR] = "bilinearly",
                                      [SOFTENING_EXPONENTIAL] = "exponentially"};
    if (material_has_strength_surface(m)) print_surface(s, m);
    if (!material_has_softening_bonds(m) || material_has_strength_surface(m)) return;
    const struct softening_curve curve = softening_curve_of_law(m->softening);
    const real kappa = square(m->critical_stretch / m->onset_stretch);
    const real unit = material_uniaxial_tension_modulus(m, s->space) * m->onset_stretch;
    const struct softening_model model = scene_softening_model_of_bonds(s, m);
    const struct softening_strength strength =
        softening_model_normalised_peak_stresses(&curve, s->space, kappa, &model);
    printf("strength       %s: %.4g Pa in tension", m->name, unit * strength.tension);
    if (s->dim > 1)
        printf(", %.4g Pa in equal biaxial tension, %.4g Pa in shear", unit * strength.biaxial, unit * strength.shear);
    printf("; bonds soften %s from a stretch of %.4g to %.4g (kappa %.3g, phi %.3g)\n", law[m->softening],
           m->onset_stretch, softening_breaking_stretch_of_equal_energy(&curve, m->onset_stretch, m->critical_stretch),
           kappa, strength.tension);
    say_horizons(s, m, kappa);
    if (s->surface == SURFACE_VOLUME && s->dim > 1 && s->model == MODEL_BOND)
        printf("               with pd.surface: volume bonds at faces are stronger: a strip without a notch carries "
               "9.5 %% more with 10 layers, 3.5 %% with 20\n");
    print_rate(m);
}

void print_tensile_strength_of_brittle_bonds(const struct scene *s, const struct material *m)
{
    const real nu = s->dim == 2 ? 1.0 / 3 : 0.25; /* of bonds; in plane strain nu/(1 - nu) */
    if (s->model != MODEL_BOND || s->method == METHOD_MPM || material_yields(m)) return;
    printf(", about %.4g Pa in tension at this horizon",
           material_uniaxial_tension_modulus(m, s->space) * m->critical_stretch);
    if (s->dim > 1) printf(" (%.3g times that in equal biaxial tension, %.3g in shear)", 1 / (1 - nu), 1 / (1 + nu));
}
