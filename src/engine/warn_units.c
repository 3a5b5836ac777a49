/* Warns of values in the input file that are probably mistakes of units, found by their consequences, such as an
 * implausible wave speed: of materials, bodies and time here, of loads in warn_units_loads.c. The plausible ranges are
 * in warn_units_ranges.c; words of the key `accept` silence the warnings one by one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine_internal.h"
#include "warn_units.h"

#define UNLIKE 30 /* factor between the densities of a rigid body and of materials in other units */
#define STIFF 1e9 /* [Pa] Young's modulus from which on the largest critical stretch holds; rubber lies below */
#define TOUGHNESS_LEAST 5e4 /* [Pa m^0.5] from STIFF on; waxes have 8e4 */
#define ATOMS_LEAST 5e-12   /* [m] from STIFF on: energy release rate over Young's modulus; cleaving salts have 8e-12 */
#define HARDENING_LEAST 1e-6 /* hardening modulus over Young's modulus below which stress hardly grows [1] */

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Adds a warning to *to if the wave speed of material m is implausible. The message blames the units, or Poisson's
 * ratio near 1/2, if that alone makes waves fast. subject: name of the material in messages. */
static void units_of_waves(const struct scene *s, const char *subject, const struct material *m, struct warnings *to)
{
    const real bar = sqrt(m->young / m->density), usual = bar * sqrt(0.6 / (1.4 * 0.2)); /* at 0.4, in 3D */
    if (!(m->wave_speed > units_largest_plausible_value(ACCEPT_WAVES)) ||
        bar > units_largest_plausible_value(ACCEPT_WAVES) || m->poisson <= 0.4)
        units_judge(s, ACCEPT_WAVES, subject, m->wave_speed, "", to);
    else if (!scene_silences_warning(s, ACCEPT_WAVES))
        warnings_add_if_new(to,
                            "%s: its Poisson's ratio of %.6g makes waves as fast as %.3g m/s, %.3g times as fast as at "
                            "0.4; check this value; if this is intended, add accept: [waves]",
                            subject, m->poisson, m->wave_speed, m->wave_speed / usual);
}

/* Adds a warning to *to if a hardening constant of material a is positive, but below HARDENING_LEAST (a millionth)
 * times Young's modulus, so that the material hardly hardens. The usual reason is a value without unit, which is read
 * in Pa, where MPa was meant. subject: name of the material in messages. */
static void units_of_hardening(const struct scene *s, const char *subject, const struct material *a,
                               struct warnings *to)
{
    const struct law *l = &a->law;
    const struct {
        const char *key;
        real value; /* [Pa] */
    } constant[] = {{"linear hardening", l->hardening},
                    {"hardening.voce.saturation", l->voce.saturation},
                    {"hardening.power.coefficient", l->power.coefficient},
                    {"johnson_cook.B", l->johnson_cook.B},
                    {"kinematic.modulus", l->kinematic.modulus}};
    if (!l->given || scene_silences_warning(s, ACCEPT_YIELD)) return;
    for (size_t k = 0; k < COUNT_OF(constant); k++)
        if (constant[k].value > 0 && constant[k].value < HARDENING_LEAST * a->young)
            warnings_add_if_new(
                to,
                "%s: its %s of %.3g Pa is below a millionth of Young's modulus, so the material hardly hardens; check "
                "the unit (Pa if none is written); if this is intended, add accept: [yield]",
                subject, constant[k].key, constant[k].value);
}

/* Adds a warning to *to if material m of scene s is stiff (E of at least STIFF) and has a toughness (E G_c)^(1/2) below
 * that of any solid but foams: below TOUGHNESS_LEAST, or with G_c/E below ATOMS_LEAST, as G_c is at least twice the
 * surface energy, which is about E times a hundredth of the distance between atoms. The usual reason is an energy
 * release rate in kJ/m^2. name: of the material in messages. */
static void units_of_toughness(const struct scene *s, const char *name, const struct material *m, struct warnings *to)
{
    const real toughness = sqrt(m->young * m->energy_release_rate);
    const real least = real_max(TOUGHNESS_LEAST, m->young * sqrt(ATOMS_LEAST));
    const bool known = m->energy_release_rate >= units_least_plausible_value(ACCEPT_ENERGY) &&
                       !scene_silences_warning(s, ACCEPT_ENERGY);
    if (!known || m->young < STIFF || toughness >= least) return;
    warnings_add_if_new(
        to,
        "%s: its toughness of %.3g MPa m^0.5 (%.3g J/m^2, %.3g Pa) is below %.3g (glass: 0.75): check the units of "
        "energy_release_rate (J/m^2) and young; if this is intended, add accept: [energy]",
        name, 1e-6 * toughness, m->energy_release_rate, m->young, 1e-6 * least);
}

/* Adds warnings to *to about implausible wave speeds, densities, energy release rates, specific heats, yield stresses
 * and critical stretches of the materials of scene s. */
static void units_of_materials(const struct scene *s, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[80];
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        const real stretch = a->critical_stretch;
        snprintf(subject, sizeof subject, "material %s", a->name);
        units_of_waves(s, subject, a, to);
        units_judge(s, ACCEPT_DENSITY, subject, a->density, "", to);
        if (isfinite(a->energy_release_rate)) units_judge(s, ACCEPT_ENERGY, subject, a->energy_release_rate, "", to);
        units_of_toughness(s, subject, a, to);
        if (a->law.specific_heat > 0) units_judge(s, ACCEPT_HEAT, subject, a->law.specific_heat, "", to);
        const real yield = material_initial_yield_stress(a);
        snprintf(note, sizeof note, " (%.3g Pa over %.3g Pa)", yield, a->young);
        if (material_yields(a)) units_judge(s, ACCEPT_YIELD, subject, yield / a->young, note, to);
        units_of_hardening(s, subject, a, to);
        snprintf(note, sizeof note, ", at %.3g Pa", stretch * a->young);
        if (isfinite(stretch) && s->method != METHOD_MPM &&
            (a->young >= STIFF || stretch < units_least_plausible_value(ACCEPT_STRETCH)))
            units_judge(s, ACCEPT_STRETCH, subject, stretch, note, to);
    }
}

/* Adds warnings to *to about rigid bodies of scene s with an implausible density, which is mass divided by volume. The
 * plausible range is that of matter, 50 to 25,000 kg/m^3 (plausible_range[ACCEPT_MASS]). If the density of a material
 * is outside that range, because the scene uses other units, the range extends instead from the smallest density of a
 * material divided by UNLIKE (30) to the largest one times UNLIKE. Bodies without mass or with an infinite shape are
 * skipped. */
static void units_of_rigids(const struct scene *s, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[80];
    real least = INFINITY, most = 0, low[DIM_MAX], high[DIM_MAX];
    for (int m = 0; m < s->materials; m++)
        least = real_min(least, s->material[m].density), most = real_max(most, s->material[m].density);
    const bool usual =
        least >= units_least_plausible_value(ACCEPT_MASS) && most <= units_largest_plausible_value(ACCEPT_MASS);
    least = usual ? units_least_plausible_value(ACCEPT_MASS) : least / UNLIKE,
    most = usual ? units_largest_plausible_value(ACCEPT_MASS) : most * UNLIKE;
    for (int b = s->bodies; b < s->bodies + s->rigids; b++) {
        const struct scene_body *body = &s->body[b];
        if (!(body->mass > 0) || !region_compute_bounding_box_if_finite(&body->shape, s->dim, low, high)) continue;
        const real volume =
            region_volume_within_box(&body->shape, s->dim, low, high) * scene_cross_section_or_thickness(s);
        snprintf(subject, sizeof subject, "body %s", body->name);
        snprintf(note, sizeof note, " (%.3g kg over %.3g m^3)", body->mass, volume);
        units_judge_between(s, ACCEPT_MASS, least, most, subject, body->mass / volume, note, to);
    }
}

/* Adds warnings to *to about materials of scene s whose energy release rate does not fit their tensile strength: the
 * length E G_c/strength^2, which a body needs for a crack in it, is many times `longest`. Only for materials with
 * softening bonds of which both are given. longest: longest edge of the box around all particles [m]. */
static void units_of_brittleness(const struct scene *s, real longest, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[80];
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        if (!material_has_softening_bonds(a) || isnan(a->tensile_strength) || isnan(a->energy_release_rate)) continue;
        const real length = a->young * a->energy_release_rate / square(a->tensile_strength);
        snprintf(subject, sizeof subject, "material %s", a->name);
        snprintf(note, sizeof note, " (%.3g m over %.3g m)", length, longest);
        units_judge(s, ACCEPT_BRITTLENESS, subject, length / longest, note, to);
    }
}

/* ---- steps and particles ----------------------------------------------------------------------------------------- */

/* Adds warnings to *to if the time of the dynamic scene s is implausible by the ranges of the table in
 * warn_units_ranges.c: if waves cross the bodies too seldom or too often, if they travel too few spacings or, unless
 * that is so, if `clock` has too few or too many time steps. Checks nothing in static scenes. wave_speed: speed of the
 * fastest wave [m/s]; longest: longest edge of the box around all particles [m]. */
static void units_of_time(const struct scene *s, const struct run_clock *clock, real wave_speed, real longest,
                          struct warnings *to)
{
    char note[80];
    if (!scene_is_dynamic(s)) return;
    snprintf(note, sizeof note, " (%.3g s, %.3g m at %.3g m/s)", s->duration, longest, wave_speed);
    units_judge(s, ACCEPT_PASSAGES, "time", wave_speed * s->duration / longest, note, to);
    snprintf(note, sizeof note, " of %.3g s", clock->dt);
    const real reach = wave_speed * s->duration / s->spacing;
    if (reach < units_least_plausible_value(ACCEPT_REACH))
        units_judge(s, ACCEPT_REACH, "time", reach, "", to);
    else
        units_judge(s, ACCEPT_STEPS, "time", (real)clock->steps, note, to);
}

/* Adds a warning to *to if the body in the box low[dim] .. high[dim] [m] has fewer particles along an axis than the 8
 * that the table of plausible ranges, plausible_range[ACCEPT_PARTICLES], requires. s: scene; name: name of the body. */
static void units_of_body(const struct scene *s, const char *name, const real *low, const real *high,
                          struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[80];
    real least = INFINITY;
    for (int d = 0; d < s->dim; d++) {
        const real n = scene_particle_count_along_axis_with_mirrors(s, low[d], high[d], d);
        if (n < least) least = n, snprintf(note, sizeof note, ", along %c", "xyz"[d]);
    }
    snprintf(subject, sizeof subject, "body %s", name);
    units_judge(s, ACCEPT_PARTICLES, subject, least, note, to);
}

/* Adds warnings to *to about bodies of scene s (particles p) with a pre-crack if they have fewer particles along an
 * axis than the 8 that the table of plausible ranges, plausible_range[ACCEPT_PARTICLES], requires. Joined bodies count
 * as one. Does nothing if some particles are not created (p->n < p->n_body). */
static void units_of_particles(const struct scene *s, const struct particles *p, struct warnings *to)
{
    for (int b = 0; b < s->bodies && s->cracks > 0 && p->n == p->n_body; b++) {
        real low[DIM_MAX], high[DIM_MAX];
        bool cracked = false;
        if (!joined_bodies_compute_bounding_box(s, p, b, low, high)) continue;
        for (int k = 0; k < s->cracks; k++)
            cracked = cracked || crack_overlaps_box(&s->crack[k], low, high, s->dim, s->spacing);
        if (cracked) units_of_body(s, s->body[b].name, low, high, to);
    }
}

/* Adds a warning to *to if scene s is a plate in plane stress whose thickness divided by its longest edge exceeds 2,
 * the upper end of the plausible range in the table of warn_units_ranges.c, which suggests a mistake in the units,
 * unless the scene accepts this value. longest: longest edge of the box around all particles [m]. */
static void units_of_thickness(const struct scene *s, real longest, struct warnings *to)
{
    char note[80];
    if (s->space != SPACE_PLANE_STRESS || s->bodies == 0) return;
    snprintf(note, sizeof note, " (%.3g m over %.3g m)", s->thickness, longest);
    units_judge(s, ACCEPT_THICKNESS, "space", s->thickness / longest, note, to);
}

void run_warn_of_mistaken_units(const struct scene *s, const struct particles *p, const struct loads *l,
                                const struct run_clock *clock, real wave_speed, struct warnings *warnings)
{
    units_of_time(s, clock, wave_speed, real_max(particles_bounding_box_longest_edge(p), s->spacing), warnings);
    units_of_thickness(s, particles_bounding_box_longest_edge(p) + s->spacing, warnings);
    units_of_materials(s, warnings);
    units_of_rigids(s, warnings);
    units_of_brittleness(s, particles_bounding_box_longest_edge(p) + s->spacing, warnings);
    units_of_loads(s, p, l, clock->dt, warnings);
    units_of_particles(s, p, warnings);
}
