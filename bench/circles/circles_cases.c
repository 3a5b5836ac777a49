/* The circles: what is asked of each, and with which runs. */
#include "circles.h"

/* Expected values: strengths of glass by the suite; loads of edge notches of 0.5, 1 and 1.5 mm by Griffith, and, for
 * linear softening, by a separate program of the same law.
 *
 * Pure shear: far ahead of the crack a strip of height H between clamped faces, opened by u, is strained by u/H across
 * and not along. In plane stress it stores E/(1 - nu^2) (u/H)^2/2 per volume, far behind the crack nothing, so that a
 * crack releases H times that per area (Rivlin & Thomas 1953): u = sqrt(2 G_c H (1 - nu^2)/E), with H 5 mm 1.166 um for
 * nu 0.22, the glass of the suite, and 1.127 um for 1/3, the only Poisson's ratio of bonds in plane stress. (In plane
 * strain it would be 1.119 um for 0.22.) The run has 1/3: the 3.4 % between both values are not an error of a crack,
 * and 1.166 um would hide one.
 *
 * Tolerances of tension and shear are those that each law is asked to hold: bonds that soften 4 % of the strength at
 * 0, 20 and 45 degrees, a surface 3 %, in equal biaxial tension 1.5 MPa, in shear 2 MPa up to a horizon of 0.34 l.
 *
 * Expected values other than the asked ones:
 * - Tension, lattice at 45 degrees, 0.34 l: an endless lattice of 28 bonds, strained uniformly, carries 38.35 MPa at
 *   most, as few of its bonds soften at a time; the continuum, by which the onset is chosen, 40.
 * - Tension, lattice at 20 degrees, 1.38 l: kappa is 1.03, so that the first bond that softens breaks the strip. It is
 *   at a step of a face, at 35.9 MPa by load steps of a separate program on the same particles.
 * - Notches of 3.3 horizons on a lattice at 45 degrees: what the separate program finds on such a lattice, 6 and 10 %
 *   below Griffith.
 * - Load steps at 1.38 l, kappa 1.03: the lattice traps the crack, and loads swing by 20 %. The largest one is that of
 *   the separate program, in steps of 0.004 mm. For the cantilevers that program finds 20.6 N, for pure shear 1.087 um,
 *   both beyond the tolerance: nothing is asked there. */
#define NOTCH(length, load)                                                                                            \
    {"variables.notch", length}, { "variables.P", load }
#define SHEAR_HORIZON 0.345 /* that of a spacing of 0.05 mm, 0.34 l */
#define STEPS_HORIZON 0.87  /* that of a spacing of 0.125 mm; above it, kappa is 1 */
#define TORSION                                                                                                        \
    "a wall of 0.15 mm wants a horizon of 0.1 mm: a tube of 1e6 particles and more; shear of a plate stands in"
#define INDENTATION                                                                                                    \
    "rings at 1.1 to 1.2 punch radii want ten spacings in 0.1 radii, and an axis of symmetry that no space has"
#define POKER                                                                                                          \
    "rubber of Poisson's ratio 0.4997, which bonds do not have; a cube of glass in hydrostatic tension stands in"
#define TROUSERS "large strains of rubber and mode III, which no law of bonds here has as an input"
#define STEPPED "40 is asked, but a step of a face begins at 35.9 in load steps of a separate program"
#define DIAGONAL "40 is asked, but the lattice carries 38.35 at most in uniform strain"
#define COARSE "by a separate program; by Griffith "
#define TRAPPED "by a separate program; from kappa 2 on "
#define FAST                                                                                                           \
    {"variables.rate", "e/(40 us)"}, { "duration", "72 us" }

/* clang-format off */
const struct circle_case circle_cases[] = {
    {"1 tension", "strength, softening", "MPa", 40, 1.6, CIRCLE_STRIP, false, {{0}},
     {0.2, 0.1, 0.05}, {0.1, 0.05}, {20}, 0, 0, NULL},
    {"1 tension", "strength, softening", "MPa", 40, 1.6, CIRCLE_STRIP, false, {{0}}, {0}, {0.2, 0.1}, {45}, 0, 0, NULL},
    {"1 tension", "strength, softening", "MPa", 40, 1.6, CIRCLE_STRIP, false, {FAST},
     {0.025}, {0.025}, {20, 45}, 0, 0, NULL},
    {"1 tension", "strength, softening", "MPa", 35.9, 1.44, CIRCLE_STRIP, false, {{0}},
     {0}, {0.2}, {20}, 0, 0, STEPPED},
    {"1 tension", "strength, softening", "MPa", 38.35, 1.53, CIRCLE_STRIP, false, {{0}},
     {0}, {0.05}, {45}, 0, 0, DIAGONAL},
    {"1 tension", "strength, surface", "MPa", 40, 1.2, CIRCLE_STRIP, true, {{0}},
     {0.1, 0.05}, {0.1, 0.05}, {45}, 0, 0, NULL},
    {"2 biaxial", "strength, surface", "MPa", 27, 1.5, CIRCLE_DISC, true, {{0}},
     {0.1, 0.05, 0.025}, {0.1, 0.05, 0.025}, {45}, 0, 0, NULL},
    {"3 torsion", "tube", "MPa", 44.4, 2, CIRCLE_SQUARE, true, {{0}}, {0}, {0}, {0}, 0, 0, TORSION},
    {"3 torsion", "shear, surface", "MPa", 44.4, 2, CIRCLE_SQUARE, true, {{0}},
     {0.1, 0.05, 0.025}, {0.1, 0.05, 0.025}, {45}, 0, SHEAR_HORIZON, NULL},
    {"4 pure shear", "opening, softening", "um", 1.127, 0.0225, CIRCLE_PURE_SHEAR, false, {{0}},
     {0.2, 0.1, 0.05}, {0}, {0}, 0, STEPS_HORIZON, NULL},
    {"5 notch 0.025", "load, surface", "MPa", 40, 1, CIRCLE_SHORT_NOTCH, true, {NOTCH("0.025 mm", "40 MPa")},
     {0.05, 0.025}, {0}, {0}, 0.025, 0.175, NULL},
    {"5 notch 0.1", "load, surface", "MPa", 35, 5, CIRCLE_NOTCH, true, {NOTCH("0.1 mm", "32 MPa")},
     {0.1, 0.05}, {0.1, 0.05}, {45}, 0.1, SHEAR_HORIZON, NULL},
    {"5 notch 0.5", "load, surface", "MPa", 17.83, 0.89, CIRCLE_NOTCH, true, {NOTCH("0.5 mm", "17.83 MPa")},
     {0.1, 0.05, 0.025}, {0.1}, {45}, 0.5, 0, NULL},
    {"5 notch 0.5", "load, surface", "MPa", 16.11, 0.81, CIRCLE_NOTCH, true, {NOTCH("0.5 mm", "17.83 MPa")},
     {0}, {0.05}, {45}, 0.5, 0, COARSE "17.83"},
    {"5 notch 1", "load, surface", "MPa", 10.89, 0.545, CIRCLE_NOTCH, true, {NOTCH("1 mm", "10.89 MPa")},
     {0.1, 0.05, 0.025}, {0.05}, {45}, 1, 0, NULL},
    {"5 notch 1", "load, surface", "MPa", 10.25, 0.513, CIRCLE_NOTCH, true, {NOTCH("1 mm", "10.89 MPa")},
     {0}, {0.1}, {45}, 1, 0, COARSE "10.89"},
    {"5 notch 1.5", "load, surface", "MPa", 7.34, 0.367, CIRCLE_NOTCH, true, {NOTCH("1.5 mm", "7.34 MPa")},
     {0.1, 0.05, 0.025}, {0.1, 0.05}, {45}, 1.5, 0, NULL},
    {"5 notch 0.5", "load, softening", "MPa", 15.3, 0.765, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "0.5 mm"}},
     {0.1, 0.05}, {0}, {0}, 0, 0, NULL},
    {"5 notch 1", "load, softening", "MPa", 9.85, 0.493, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1 mm"}},
     {0.1, 0.05}, {0}, {0}, 0, 0, NULL},
    {"5 notch 1.5", "load, softening", "MPa", 6.7, 0.335, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1.5 mm"}},
     {0.1, 0.05}, {0}, {0}, 0, 0, NULL},
    {"5 notch 0.5", "load, softening", "MPa", 16.05, 0.803, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "0.5 mm"}},
     {0.2}, {0}, {0}, 0, 0, TRAPPED "15.3"},
    {"5 notch 1", "load, softening", "MPa", 10.33, 0.517, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1 mm"}},
     {0.2}, {0}, {0}, 0, 0, TRAPPED "9.85"},
    {"5 notch 1.5", "load, softening", "MPa", 7.34, 0.367, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1.5 mm"}},
     {0.2}, {0}, {0}, 0, 0, TRAPPED "6.7"},
    {"6 indentation", "ring crack", "radii", 1.15, 0.05, CIRCLE_CUBE, true, {{0}}, {0}, {0}, {0}, 0, 0, INDENTATION},
    {"7 poker chip", "elastomer", "MPa", 27.8, 1, CIRCLE_CUBE, true, {{0}}, {0}, {0}, {0}, 0, 0, POKER},
    {"7 poker chip", "hydrostatic, surface", "MPa", 27.8, 1, CIRCLE_CUBE, true, {{0}},
     {1.0 / 15, 0.05}, {0}, {0}, 0, 0, NULL},
    {"8 cantilevers", "load, softening", "N", 20, 0.4, CIRCLE_CANTILEVER, false, {{0}}, {0.2, 0.125, 0.1}, {0}, {0},
     0, STEPS_HORIZON, NULL},
    {"9 trousers", "mode III", "-", 0, 0, CIRCLE_CUBE, false, {{0}}, {0}, {0}, {0}, 0, 0, TROUSERS},
};
/* clang-format on */
const int circle_cases_count = COUNT_OF(circle_cases);
