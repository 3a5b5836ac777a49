/* Warns of values in the input file that are probably mistakes of units, found by their consequences, such as an
 * implausible wave speed. A table contains the plausible ranges; words of the key `accept` silence the warnings one by
 * one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine_internal.h"

enum { MOMENTS_OF_LOADS = 64, PLACES_OF_LOADS = 16 }; /* times, positions at which loads are evaluated */
#define UNLIKE 30  /* factor between the densities of a rigid body and of materials in other units */
#define EARLY 0.01 /* end of a function of time divided by the time step, below which the run does not see it */
#define STIFF 1e9  /* [Pa] Young's modulus from which on the largest critical stretch holds; rubber lies below */
#define TOUGHNESS_LEAST 5e4 /* [Pa m^0.5] from STIFF on; waxes have 8e4 */
#define ATOMS_LEAST 5e-12   /* [m] from STIFF on: energy release rate over Young's modulus; cleaving salts have 8e-12 */
#define HARDENING_LEAST 1e-6 /* hardening modulus over Young's modulus below which stress hardly grows [1] */

enum { RULES = ACCEPT_TIMES + 1 }; /* number of quantities that are checked */

/* Range of plausible values of each quantity that is checked: smallest and largest value, the beginning of the message,
 * the unit, and the input that the user should check.
 *
 * Reasons for the ranges. Waves: 18 km/s in diamond, 20 m/s in gels of 1 MPa. Stretch at which bonds break: a tenth is
 * the strength of crystals without flaws. Stress divided by the strength E s_c: cracks raise it tenfold. Strain: the
 * load divided by Young's modulus. Reach: distance of waves in the duration [spacings]. Density: aerogels have
 * 1 kg/m^3 and more, osmium 22,600. Yield stress divided by Young's modulus: 2e-4 in annealed aluminium, 0.1 in
 * polymers. Passages: of waves across all bodies in the duration. Energy release rate: twice the surface energy of
 * waxes is 0.04 J/m^2, tough steels have 0.2 MJ/m^2. Specific heat at 293 K: uranium 116 J/(kg K), hydrogen 14,300.
 * Growth: energy release rate of a crack as long as the body, divided by that of the material (units_of_growth). Mass
 * divided by volume: foams have 50 kg/m^3, no material more than osmium. Brittleness: E G_c/strength^2 is below 1 m,
 * except for concrete with fibres. Times: largest load of the run divided by the largest load at any time. */
static const struct {
    real least, most;
    const char *what, *unit, *look;
} rule[RULES] = {
    [ACCEPT_WAVES] = {10, 20e3, "the speed of its waves is", " m/s", "young (Pa) and density (kg/m^3)"},
    [ACCEPT_STRETCH] =
        {1e-6, 0.05, "its bonds break at a stretch of", "",
         "critical_stretch (0.01 is 1 %), energy_release_rate (J/m^2) or toughness (MPa m^0.5), young and spacing"},
    [ACCEPT_STRESS] = {1e-2, 1e3,
                       "the largest stress that its loads, speeds and displacements can cause, over the strength, is",
                       "", "loads (Pa), speeds (m/s), displacements (m) and the keys that let bonds break"},
    [ACCEPT_STRAIN] = {0, 0.05, "its load over Young's modulus is", "", "the load and young (Pa)"},
    [ACCEPT_STEPS] = {20, 1e8, "the number of time steps is", "", "duration, spacing (m), young and density"},
    [ACCEPT_REACH] = {1, INFINITY, "in the duration waves travel", " spacings", "duration, lengths (m) and young (Pa)"},
    [ACCEPT_PARTICLES] = {8, INFINITY, "it has a crack, and its least number of particles across is", "",
                          "spacing and lengths (m)"},
    [ACCEPT_DENSITY] = {0.5, 3e4, "its density is", " kg/m^3", "density (kg/m^3; g/cm^3?)"},
    [ACCEPT_YIELD] = {2e-5, 0.3, "its yield stress over Young's modulus is", "", "yield_stress (Pa) and young (Pa)"},
    [ACCEPT_PASSAGES] = {0, 2000, "the number of times that waves cross the bodies in the duration is", "",
                         "duration (s), lengths (m) and young (Pa)"},
    [ACCEPT_THICKNESS] = {0, 2, "in plane stress its thickness over the longest edge of its bodies is", "",
                          "thickness and lengths (m)"},
    [ACCEPT_ENERGY] = {0.03, 1e6, "its energy release rate is", " J/m^2", "energy_release_rate (J/m^2)"},
    [ACCEPT_HEAT] = {50, 2e4, "its specific heat is", " J/(kg K)", "specific_heat (J/(kg K))"},
    [ACCEPT_GROWTH] =
        {0.1, INFINITY,
         "no crack can grow: the energy that one as long as the body could release, over the energy release rate, is",
         "", "energy_release_rate (J/m^2), loads (Pa), lengths (m) and young (Pa)"},
    [ACCEPT_MASS] = {50, 25e3, "its mass over its volume is", " kg/m^3", "mass (kg) and lengths (m)"},
    [ACCEPT_BRITTLENESS] = {0, 30, "its length E G_c/tensile_strength^2 over the longest edge of the bodies is", "",
                            "energy_release_rate (J/m^2), tensile_strength (Pa) and lengths (m)"},
    [ACCEPT_TIMES] = {0.1, INFINITY, "the largest load within the duration, over the largest at any time, is", "",
                      "its times (s) and duration"},
};

/* Adds a warning to *to if `value` is outside least .. most, unless the key `accept` of scene s contains the quantity
 * k. subject: name of the object that has this value, such as a material or body; note: text with the numbers from
 * which the value is computed, or "". */
static void units_judge_between(const struct scene *s, enum accept k, real least, real most, const char *subject,
                                real value, const char *note, struct warnings *to)
{
    const char *word = ACCEPT_WORDS;
    const bool low = (value < least), high = (value > most);
    if ((!low && !high) || scene_silences_warning(s, k)) return;
    for (int n = 0; n < (int)k; n++) word += strcspn(word, "|") + 1;
    warnings_add_if_new(to, "%s: %s %.3g%s%s, %s %.3g: check the units of %s; if this is intended, add accept: [%.*s]",
                        subject, rule[k].what, value, rule[k].unit, note, low ? "below" : "above", low ? least : most,
                        rule[k].look, (int)strcspn(word, "|"), word);
}

/* Adds a warning to *to if `value` is outside the plausible range of the quantity k in the table `rule`, unless the key
 * `accept` of scene s contains k. subject: name of the object that has this value, such as a material or body; note:
 * text with the numbers from which the value is computed, or "". */
static void units_judge(const struct scene *s, enum accept k, const char *subject, real value, const char *note,
                        struct warnings *to)
{
    units_judge_between(s, k, rule[k].least, rule[k].most, subject, value, note, to);
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Adds a warning to *to if the wave speed of material m is implausible. The message blames the units, or Poisson's
 * ratio near 1/2, if that alone makes waves fast. subject: name of the material in messages. */
static void units_of_waves(const struct scene *s, const char *subject, const struct material *m, struct warnings *to)
{
    const real bar = sqrt(m->young / m->density), usual = bar * sqrt(0.6 / (1.4 * 0.2)); /* at 0.4, in 3D */
    if (!(m->wave_speed > rule[ACCEPT_WAVES].most) || bar > rule[ACCEPT_WAVES].most || m->poisson <= 0.4)
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
    const bool known = m->energy_release_rate >= rule[ACCEPT_ENERGY].least && !scene_silences_warning(s, ACCEPT_ENERGY);
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
        if (isfinite(stretch) && s->method != METHOD_MPM && (a->young >= STIFF || stretch < rule[ACCEPT_STRETCH].least))
            units_judge(s, ACCEPT_STRETCH, subject, stretch, note, to);
    }
}

/* Adds warnings to *to about rigid bodies of scene s with an implausible density, which is mass divided by volume. The
 * plausible range is that of matter, 50 to 25,000 kg/m^3 (rule[ACCEPT_MASS]). If the density of a material is outside
 * that range, because the scene uses other units, the range extends instead from the smallest density of a material
 * divided by UNLIKE (30) to the largest one times UNLIKE. Bodies without mass or with an infinite shape are skipped. */
static void units_of_rigids(const struct scene *s, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[80];
    real least = INFINITY, most = 0, low[DIM_MAX], high[DIM_MAX];
    for (int m = 0; m < s->materials; m++)
        least = real_min(least, s->material[m].density), most = real_max(most, s->material[m].density);
    const bool usual = least >= rule[ACCEPT_MASS].least && most <= rule[ACCEPT_MASS].most;
    least = usual ? rule[ACCEPT_MASS].least : least / UNLIKE, most = usual ? rule[ACCEPT_MASS].most : most * UNLIKE;
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

/* ---- times of loads ---------------------------------------------------------------------------------------------- */

/* Returns the largest absolute value of the function of time f, a factor on a load, between the times 0 and t_end [s]
 * [1]. t_end: INFINITY for all times. */
static real factor_largest_until(const struct time_function *f, real t_end)
{
    real most = fabs(time_function_value(f, t_end));
    if (f->kind == TIME_STEP && t_end >= f->from) most = 1;
    if (f->kind == TIME_PULSE && t_end >= 0.5 * (f->from + f->until)) most = 1;
    if (f->kind == TIME_TABLE) most = real_max(most, fabs(time_function_value(f, 0)));
    for (int k = 0; k < f->n && f->t[k] <= t_end; k++) most = real_max(most, fabs(f->value[k]));
    return most;
}

/* Adds warnings to *to about loads and supports that reach only a small part of their largest value by the end of the
 * run, and, in dynamic runs, about those whose function of time ends before EARLY (a hundredth) of the time step dt
 * [s]. Ramps of rigid bodies are judged in the same way. The limits are in the table `rule`. */
static void units_of_times(const struct scene *s, real dt, struct warnings *to)
{
    static const char *const early[] = {[TIME_STEP] = "it never acts",
                                        [TIME_PULSE] = "it never acts",
                                        [TIME_RAMP] = "the load acts in full at once",
                                        [TIME_TABLE] = "the load has its last value at once"};
    char subject[NAME_MAX_LENGTH + 16];
    for (int b = 0; b < s->boundaries; b++) {
        const struct time_function *f = &s->boundary[b].time;
        if (f->kind == TIME_CONSTANT) continue;
        const real end = f->kind == TIME_TABLE ? f->t[f->n - 1] : f->until;
        const real most = factor_largest_until(f, INFINITY);
        snprintf(subject, sizeof subject, "boundary %s", s->boundary[b].name);
        if (most > 0) units_judge(s, ACCEPT_TIMES, subject, factor_largest_until(f, s->duration) / most, "", to);
        if (scene_is_dynamic(s) && end < EARLY * dt && !scene_silences_warning(s, ACCEPT_TIMES))
            warnings_add_if_new(
                to,
                "%s: its time function ends at %.3g s, long before the end of the first time step, %.3g s, so %s: "
                "check the units of its times (s if none is written); if this is intended, add accept: [times]",
                subject, end, dt, early[f->kind]);
    }
    for (int b = s->bodies; b < s->bodies + s->rigids; b++) {
        snprintf(subject, sizeof subject, "body %s", s->body[b].name);
        if (s->body[b].ramp > 0)
            units_judge(s, ACCEPT_TIMES, subject, real_min(1, s->duration / s->body[b].ramp), " (by its ramp)", to);
    }
}

/* ---- stress that loads can make -------------------------------------------------------------------------------- */

/* Largest values over all loads. stress: of tractions, pressures and body forces [Pa]; speed: of driven particles
 * relative to undriven ones [m/s]; least, most: range of prescribed displacements along each axis [m]; supports: number
 * of loads that constrain or drive particles. */
struct load_figures {
    real stress, speed, least[DIM_MAX], most[DIM_MAX];
    int supports;
};

/* Returns the stress that the applied load l causes at time t [s] at particle number k of its list (indices in p) [Pa]:
 * the magnitude of a traction or pressure, or that of a body force times the longest edge of the box around all
 * particles. */
static real load_stress_at(const struct scene *s, const struct particles *p, const struct load *l, int64_t k, real t)
{
    real value[DIM_MAX] = {0}, density = 0;
    load_prescribed_value_at_particle(l, p, k, t, value);
    if (l->boundary->kind == BOUNDARY_PRESSURE) return fabs(value[0]);
    if (l->boundary->kind == BOUNDARY_TRACTION) return sqrt(dot(value, value, s->dim));
    for (int m = 0; m < s->materials; m++) density = real_max(density, s->material[m].density);
    return (l->boundary->by_mass ? density : 1) * sqrt(dot(value, value, s->dim)) *
           particles_bounding_box_longest_edge(p);
}

/* Extends the ranges of stress and displacement in *f by the values that the load l of scene s applies or prescribes at
 * time t [s] at particle number k of its list (indices in p). Rotations are left out, and displacements that are not
 * known. */
static void load_figures_at(const struct scene *s, const struct particles *p, const struct load *l, int64_t k, real t,
                            struct load_figures *f)
{
    const enum boundary_kind kind = l->boundary->kind;
    if (kind == BOUNDARY_TRACTION || kind == BOUNDARY_PRESSURE || kind == BOUNDARY_BODY_FORCE)
        f->stress = real_max(f->stress, load_stress_at(s, p, l, k, t));
    if (kind != BOUNDARY_VELOCITY || l->boundary->rotates ||
        boundary_check_velocity_has_closed_form_integral(l->boundary) != OK)
        return;
    real u[DIM_MAX];
    load_prescribed_displacement_of_particle(l, p, k, l->boundary->frozen ? INFINITY : t,
                                             u); /* frozen: in the pseudo-time of a solver */
    for (int d = 0; d < s->dim; d++) f->least[d] = real_min(f->least[d], u[d]), f->most[d] = real_max(f->most[d], u[d]);
}

/* Raises the largest stress and displacement in *f to those that load l of scene s applies or prescribes, evaluated at
 * sampled times between 0 and the duration and at some of the particles of l (indices in p). Counts supports and planes
 * of symmetry in f->supports. In dynamic scenes also raises the largest prescribed speed. */
static void load_figures_add(const struct scene *s, const struct particles *p, const struct load *l,
                             struct load_figures *f)
{
    const bool drives = l->boundary->kind == BOUNDARY_VELOCITY;
    f->supports += drives || l->boundary->kind == BOUNDARY_MIRROR;
    if (l->n == 0) return;
    for (int m = 0; m <= MOMENTS_OF_LOADS; m++)
        for (int64_t k = 0; k < l->n; k += 1 + l->n / PLACES_OF_LOADS)
            load_figures_at(s, p, l, k, s->duration * m / MOMENTS_OF_LOADS, f);
    if (!drives || !scene_is_dynamic(s)) return;
    const real speed = load_largest_prescribed_speed(l, p, s->duration);
    if (isfinite(speed)) f->speed = real_max(f->speed, speed);
}

/* Returns the largest difference between the initial velocities of the particles p and the rigid bodies of scene s,
 * where a body at rest is included [m/s]. */
static real units_speed_at_start(const struct scene *s, const struct particles *p)
{
    real apart[DIM_MAX] = {0};
    for (int d = 0; d < s->dim; d++) {
        real low = 0, high = 0;
        for (int64_t i = 0; i < p->n; i++) low = real_min(low, p->v[d][i]), high = real_max(high, p->v[d][i]);
        for (int b = s->bodies; b < s->bodies + s->rigids; b++)
            low = real_min(low, s->body[b].velocity[d]), high = real_max(high, s->body[b].velocity[d]);
        apart[d] = high - low;
    }
    return sqrt(dot(apart, apart, s->dim));
}

/* Returns the largest absolute component of the initial stress of the particles p [Pa]; 0 without stress. */
static real units_stress_at_start(const struct particles *p)
{
    real most = 0;
    for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++)
        for (int64_t i = 0; i < p->n && p->stress[c]; i++) most = real_max(most, fabs(p->stress[c][i]));
    return most;
}

/* Returns the smallest strength of the materials and interfaces of scene s that can break [Pa]; INFINITY if none can.
 * The strength is Young's modulus times the critical stretch, or times the onset of softening for bonds that soften. */
static real least_strength(const struct scene *s)
{
    real least = INFINITY, young = INFINITY;
    for (int m = 0; m < s->materials; m++) {
        young = real_min(young, s->material[m].young);
        least = real_min(least, s->material[m].young * s->material[m].onset_stretch);
    }
    for (int k = 0; k < s->interfaces; k++)
        if (s->interface[k].critical_stretch > 0) least = real_min(least, young * s->interface[k].critical_stretch);
    return least;
}

/* Adds a warning to *to if the largest stress of the run is too small to make a crack grow: if the following ratio is
 * below 0.1 (rule[ACCEPT_GROWTH].least). In Griffith's plate (1921) a crack as long as the longest edge a of the body
 * would have the energy release rate pi sigma^2 a/E, which is divided by the smallest one of a material. As bending is
 * not computed, sigma is the stress times the slenderness of the body. Checks nothing if no material has an energy
 * release rate, or with interfaces. p: particles; stress: stress of the loads [Pa]. */
static void units_of_growth(const struct scene *s, const struct particles *p, real stress, struct warnings *to)
{
    real rate = INFINITY, young = INFINITY, longest = 0, least = INFINITY, low, high;
    char note[120];
    for (int m = 0; m < s->materials; m++) {
        rate = real_min(rate, s->material[m].energy_release_rate);
        young = real_min(young, s->material[m].young);
    }
    if (!isfinite(rate) || s->interfaces > 0) return;
    for (int d = 0; d < s->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        longest = real_max(longest, high - low + s->spacing), least = real_min(least, high - low + s->spacing);
    }
    const real most = M_PI * square(stress * longest / least) * longest / young;
    snprintf(note, sizeof note, " (%.3g J/m^2 over %.3g J/m^2)", most, rate);
    units_judge(s, ACCEPT_GROWTH, "loads", most / rate, note, to);
}

/* Adds a warning to *to if nothing loads the bodies, or if the largest stress of the run divided by the strength is
 * outside the plausible range 0.01 to 1000 (rule[ACCEPT_STRESS]). Then judges whether a crack can grow
 * (units_of_growth). The stress of `loads` on p is estimated from tractions, as rho c v from speeds v, and as E u/L
 * from displacements u of bodies of length L (rho: density, c: wave speed, E: Young's modulus). Displacements in
 * dynamic runs are not reported as too large, since they may grow after the first bonds have broken. Checks nothing for
 * method mpm, if no bond can break, and with cracks of prescribed growth. */
static void units_of_loads(const struct scene *s, const struct particles *p, const struct loads *loads,
                           struct warnings *to)
{
    struct load_figures f = {0};
    real impedance = 0, young = 0, stretched = 0;
    char note[160];
    const real strength = least_strength(s);
    if (s->method == METHOD_MPM || !isfinite(strength) || s->growths > 0) return;
    for (int b = 0; b < loads->n; b++) load_figures_add(s, p, &loads->load[b], &f);
    for (int m = 0; m < s->materials; m++) {
        impedance = real_max(impedance, s->material[m].density * s->material[m].wave_speed);
        young = real_max(young, s->material[m].young);
    }
    for (int d = 0; d < s->dim && f.supports > 1; d++) {
        real low, high;
        particles_coordinate_range(p, p->n, d, &low, &high);
        stretched = real_max(stretched, young * (f.most[d] - f.least[d]) / (high - low + s->spacing));
    }
    const real enough = rule[ACCEPT_STRESS].least * strength;
    real stress = real_max(f.stress, units_stress_at_start(p));
    stress = real_max(stress, impedance * real_max(f.speed, scene_is_dynamic(s) ? units_speed_at_start(s, p) : 0));
    const real largest = real_max(stress, stretched);
    stress = real_max(stress, scene_is_dynamic(s) ? real_min(stretched, enough) : stretched);
    if (stress == 0 && scene_has_moving_rigid_body(s)) return; /* it loads by contact alone */
    if (stress == 0 && !scene_silences_warning(s, ACCEPT_STRESS)) {
        warnings_add_if_new(to,
                            "nothing loads the body: no load, speed or displacement differs from 0 up to %.3g s; check "
                            "their values and times (s); if this is intended, add accept: [stress]",
                            s->duration);
        return;
    }
    snprintf(note, sizeof note, " (%.3g Pa; E s_c is %.3g Pa)", stress, strength);
    units_judge(s, ACCEPT_STRESS, "loads", stress / strength, note, to);
    if (stress >= enough) units_of_growth(s, p, largest, to);
}

/* Adds a warning to *to if the largest traction or pressure of the boundaries exceeds 0.05 (rule[ACCEPT_STRAIN].most)
 * times the smallest Young's modulus of the materials. The warning counts the other boundaries of which this is
 * true. */
static void units_of_tractions(const struct scene *s, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[120];
    real young = INFINITY, largest = 0;
    int others = -1; /* implausible loads but the largest */
    for (int m = 0; m < s->materials; m++) young = real_min(young, s->material[m].young);
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *a = &s->boundary[b];
        if (a->kind != BOUNDARY_TRACTION && a->kind != BOUNDARY_PRESSURE) continue;
        const real load = a->kind == BOUNDARY_PRESSURE ? fabs(a->value[0]) : sqrt(dot(a->value, a->value, s->dim));
        others += load > rule[ACCEPT_STRAIN].most * young;
        if (load <= largest) continue;
        largest = load;
        snprintf(subject, sizeof subject, "boundary %s", a->name);
    }
    if (others < 0) return;
    const int used = snprintf(note, sizeof note, " (%.3g Pa over %.3g Pa", largest, young);
    snprintf(note + used, sizeof note - (size_t)used, others > 0 ? "; also of %d other boundar%s)" : ")", others,
             others == 1 ? "y" : "ies");
    units_judge(s, ACCEPT_STRAIN, subject, largest / young, note, to);
}

/* ---- steps and particles ----------------------------------------------------------------------------------------- */

/* Adds warnings to *to if the time of the dynamic scene s is implausible by the ranges of the table `rule`: if waves
 * cross the bodies too seldom or too often, if they travel too few spacings or, unless that is so, if `clock` has too
 * few or too many time steps. Checks nothing in static scenes. wave_speed: speed of the fastest wave [m/s]; longest:
 * longest edge of the box around all particles [m]. */
static void units_of_time(const struct scene *s, const struct run_clock *clock, real wave_speed, real longest,
                          struct warnings *to)
{
    char note[80];
    if (!scene_is_dynamic(s)) return;
    snprintf(note, sizeof note, " (%.3g s, %.3g m at %.3g m/s)", s->duration, longest, wave_speed);
    units_judge(s, ACCEPT_PASSAGES, "time", wave_speed * s->duration / longest, note, to);
    snprintf(note, sizeof note, " of %.3g s", clock->dt);
    const real reach = wave_speed * s->duration / s->spacing;
    if (reach < rule[ACCEPT_REACH].least)
        units_judge(s, ACCEPT_REACH, "time", reach, "", to);
    else
        units_judge(s, ACCEPT_STEPS, "time", (real)clock->steps, note, to);
}

/* Adds a warning to *to if the body in the box low[dim] .. high[dim] [m] has fewer particles along an axis than the 8
 * that the table of plausible ranges, rule[ACCEPT_PARTICLES], requires. s: scene; name: name of the body. */
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
 * axis than the 8 that the table of plausible ranges, rule[ACCEPT_PARTICLES], requires. Joined bodies count as one.
 * Does nothing if some particles are not created (p->n < p->n_body). */
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
 * the upper end of the plausible range in the table `rule`, which suggests a mistake in the units, unless the scene
 * accepts this value. longest: longest edge of the box around all particles [m]. */
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
    units_of_times(s, clock->dt, warnings);
    units_of_tractions(s, warnings);
    units_of_loads(s, p, l, warnings);
    units_of_particles(s, p, warnings);
}
