/* Plausible ranges of the quantities in input files, and the warning about a value outside its range. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine_internal.h"
#include "warn_units.h"

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
} plausible_range[RULES] = {
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
    [ACCEPT_DENSITY] = {0.5, 3e4, "its density is", " kg/m^3", "density (kg/m^3; g/cm^3? t/mm^3?)"},
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

void units_judge_between(const struct scene *s, enum accept k, real least, real most, const char *subject, real value,
                         const char *note, struct warnings *to)
{
    const char *word = ACCEPT_WORDS;
    const bool low = (value < least), high = (value > most);
    if ((!low && !high) || scene_silences_warning(s, k)) return;
    for (int n = 0; n < (int)k; n++) word += strcspn(word, "|") + 1;
    warnings_add_if_new(to, "%s: %s %.3g%s%s, %s %.3g: check the units of %s; if this is intended, add accept: [%.*s]",
                        subject, plausible_range[k].what, value, plausible_range[k].unit, note, low ? "below" : "above",
                        low ? least : most, plausible_range[k].look, (int)strcspn(word, "|"), word);
}

void units_judge(const struct scene *s, enum accept k, const char *subject, real value, const char *note,
                 struct warnings *to)
{
    units_judge_between(s, k, plausible_range[k].least, plausible_range[k].most, subject, value, note, to);
}

real units_least_plausible_value(enum accept k) { return plausible_range[k].least; }

real units_largest_plausible_value(enum accept k) { return plausible_range[k].most; }
