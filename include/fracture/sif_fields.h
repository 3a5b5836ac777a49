/* Fields round the tip of a crack in a plane elastic body, with their formulas (Freund 1990, Dynamic Fracture
 * Mechanics, chapters 4 and 6). Local frame: x1 in the direction of the crack, ahead of the tip; x2 perpendicular. */
#ifndef CLEAVE_SIF_FIELDS
#define CLEAVE_SIF_FIELDS

#include "data/material.h"

enum crack_mode { MODE_I, MODE_II, MODES };

/* Elastic constants and wave speeds of the body round a crack, for its space. */
struct crack_medium {
    /* shear modulus G; Lame constant lambda' of the space, plane stress: 2 G nu/(1 - nu) [Pa] */
    real shear, lambda;
    real poisson, kappa;                      /* Poisson's ratio nu; Kolosov's constant [1] */
    real modulus;                             /* E*: E, in plane strain E/(1 - nu^2) [Pa] */
    real density;                             /* mass density [kg/m^3] */
    real longitudinal, shear_speed, rayleigh; /* c_d, c_s, c_R [m/s] */
};

/* Returns the constants of a material in a space. */
struct crack_medium crack_medium_of(const struct material *m, enum space space);

/* Motion at a point as the interaction integral needs it, in the local frame. */
struct crack_state {
    real gradient[2][2];    /* du_i/dx_j [1] */
    real stress[2][2];      /* stress [Pa] */
    real velocity[2];       /* particle velocity [m/s] */
    real velocity_along[2]; /* d velocity_i/dx_1 [1/s] */
    real acceleration[2];   /* particle acceleration [m/s^2] */
};

struct crack_field {
    real displacement[2];
    struct crack_state state;
}; /* [m] */

/* Computes the stress from the displacement gradient by Hooke's law in the plane. */
void crack_hooke(const struct crack_medium *m, real gradient[2][2], real stress[2][2]);

/* Computes the field of a crack at rest with K = 1 Pa m^(1/2) at x (Williams 1957). On the crack the sign of a zero
 * x[1] selects the face. */
void crack_field_at_rest(const struct crack_medium *m, enum crack_mode mode, const real x[2], struct crack_field *f);

/* Computes the field of a crack that moves at the constant speed v with K = 1 Pa m^(1/2), 0 < v < c_R (Freund 1990);
 * ill-conditioned as v -> 0. */
void crack_field_moving(const struct crack_medium *m, enum crack_mode mode, real v, const real x[2],
                        struct crack_field *f);

/* Computes the field at any speed 0 <= v < c_R: that of a crack at rest below 0.01 c_s, where the two fields differ by
 * 1e-4, else the moving one. */
void crack_field(const struct crack_medium *m, enum crack_mode mode, real v, const real x[2], struct crack_field *f);

/* Returns the universal function A_I or A_II of the energy release rate (A_I K_I^2 + A_II K_II^2)/E*; 1 at rest. A_II
 * contains 1 - a_s^2 like A_I; with 1 - a_d^2, as sometimes printed, it would not tend to 1. */
real crack_universal(const struct crack_medium *m, enum crack_mode mode, real v);

/* Form of k(v) = K_I/K_I at rest of a semi-infinite crack that grows at constant speed under a time-independent load:
 * exact (Freund 1990, eq. 6.4.26), the formula of Rose (1976), or the approximation (1 - v/c_R)/sqrt(1 - v/c_d). */
enum speed_factor { SPEED_EXACT, SPEED_ROSE, SPEED_APPROXIMATE };

/* Returns k(v) [1]. */
real crack_speed_factor(const struct crack_medium *m, enum speed_factor form, real v);

/* Returns the speed v <= most (below c_R) at which the exact k(v) equals `factor` [m/s]; 0 if factor >= 1. */
real crack_speed_of_factor(const struct crack_medium *m, real factor, real most);

/* Returns K_I of a semi-infinite crack at rest in plane strain [Pa m^(1/2)], `age` [s] after the arrival of a plane
 * wave with the normal stress `stress` [Pa] on the plane of the crack. */
real crack_suddenly_loaded(const struct crack_medium *m, real stress, real age);

/* Returns the direction of the largest circumferential stress (Erdogan & Sih 1963) relative to the crack, in a form
 * that is accurate as K_II -> 0 [rad]. */
real crack_direction(const real K[MODES]);

/* Returns K_eq, the mode-I intensity in that direction [Pa m^(1/2)]. */
real crack_equivalent(const real K[MODES]);

#endif
