/* The circles: what is asked of each, and with which runs. */
#include "circles.h"

/* Expected values: strengths of glass by the suite; in pure shear the closed form u = sqrt(2 G_c H (1 - nu^2)/E), H 5
 * mm, for the Poisson's ratio of bonds, 1/3 (1.166 um for 0.22); loads of edge notches of 0.5, 1 and 1.5 mm by
 * Griffith, and, for linear softening, by a separate program of the same law. */
#define NOTCH(length, load)                                                                                            \
    {"variables.notch", length}, { "variables.P", load }
#define TORSION                                                                                                        \
    "a wall of 0.15 mm wants a horizon of 0.1 mm: a tube of 1e6 particles and more; shear of a plate stands in"
#define INDENTATION                                                                                                    \
    "rings at 1.1 to 1.2 punch radii want ten spacings in 0.1 radii, and an axis of symmetry that no space has"
#define POKER                                                                                                          \
    "rubber of Poisson's ratio 0.4997, which bonds do not have; a cube of glass in hydrostatic tension stands in"
#define TROUSERS "large strains of rubber and mode III, which no law of bonds here has as an input"

/* clang-format off */
const struct circle_case circle_cases[] = {
    {"1 tension", "strength, softening", "MPa", 40, 1, CIRCLE_STRIP, false, {{0}},
     {0.2, 0.1, 0.05}, {0.2, 0.1, 0.05}, 0, NULL},
    {"1 tension", "strength, surface", "MPa", 40, 1, CIRCLE_STRIP, true, {{0}},
     {0.1, 0.05}, {0.1, 0.05}, 0, NULL},
    {"2 biaxial", "strength, surface", "MPa", 27, 1, CIRCLE_DISC, true, {{0}},
     {0.1, 0.05, 0.025}, {0.1, 0.05, 0.025}, 0, NULL},
    {"3 torsion", "tube", "MPa", 44.4, 2, CIRCLE_SQUARE, true, {{0}}, {0}, {0}, 0, TORSION},
    {"3 torsion", "shear, surface", "MPa", 44.4, 2, CIRCLE_SQUARE, true, {{0}},
     {0.1, 0.05, 0.025}, {0.1, 0.05, 0.025}, 0, NULL},
    {"4 pure shear", "opening, softening", "um", 1.127, 0.0225, CIRCLE_PURE_SHEAR, false, {{0}},
     {0.2, 0.1, 0.05}, {0}, 0, NULL},
    {"5 notch 0.025", "load, surface", "MPa", 40, 1, CIRCLE_SHORT_NOTCH, true, {NOTCH("0.025 mm", "40 MPa")},
     {0.05, 0.025}, {0}, 0, NULL},
    {"5 notch 0.1", "load, surface", "MPa", 35, 5, CIRCLE_NOTCH, true, {NOTCH("0.1 mm", "35 MPa")},
     {0.1, 0.05}, {0.1, 0.05}, 0, NULL},
    {"5 notch 0.5", "load, surface", "MPa", 17.83, 0.89, CIRCLE_NOTCH, true, {NOTCH("0.5 mm", "17.83 MPa")},
     {0.1, 0.05, 0.025}, {0.1, 0.05}, 0.5, NULL},
    {"5 notch 1", "load, surface", "MPa", 10.89, 0.545, CIRCLE_NOTCH, true, {NOTCH("1 mm", "10.89 MPa")},
     {0.1, 0.05, 0.025}, {0.1, 0.05}, 1, NULL},
    {"5 notch 1.5", "load, surface", "MPa", 7.34, 0.367, CIRCLE_NOTCH, true, {NOTCH("1.5 mm", "7.34 MPa")},
     {0.1, 0.05, 0.025}, {0.1, 0.05}, 1.5, NULL},
    {"5 notch 0.5", "load, softening", "MPa", 15.3, 0.765, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "0.5 mm"}},
     {0.2, 0.1, 0.05}, {0}, 0, NULL},
    {"5 notch 1", "load, softening", "MPa", 9.85, 0.493, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1 mm"}},
     {0.2, 0.1, 0.05}, {0}, 0, NULL},
    {"5 notch 1.5", "load, softening", "MPa", 6.7, 0.335, CIRCLE_NOTCH_STEPS, false, {{"variables.notch", "1.5 mm"}},
     {0.2, 0.1, 0.05}, {0}, 0, NULL},
    {"6 indentation", "ring crack", "radii", 1.15, 0.05, CIRCLE_CUBE, true, {{0}}, {0}, {0}, 0, INDENTATION},
    {"7 poker chip", "elastomer", "MPa", 27.8, 1, CIRCLE_CUBE, true, {{0}}, {0}, {0}, 0, POKER},
    {"7 poker chip", "hydrostatic, surface", "MPa", 27.8, 1, CIRCLE_CUBE, true, {{"duration", "11 us"}},
     {1.0 / 15, 0.05}, {0}, 0, NULL},
    {"8 cantilevers", "load, softening", "N", 20, 0.4, CIRCLE_CANTILEVER, false, {{0}}, {0.2, 0.125, 0.1}, {0}, 0,
     NULL},
    {"9 trousers", "mode III", "-", 0, 0, CIRCLE_CUBE, false, {{0}}, {0}, {0}, 0, TROUSERS},
};
/* clang-format on */
const int circle_cases_count = COUNT_OF(circle_cases);
