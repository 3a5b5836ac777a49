/* Fields round the tip of a crack in a plane elastic body, and the formulas that go with them (Freund 1990,
 * Dynamic Fracture Mechanics, chapters 4 and 6). Local frame: x1 along the crack, ahead of the tip; x2 across. */
#ifndef CLEAVE_SIF_FIELDS
#define CLEAVE_SIF_FIELDS

#include "data/material.h"

enum crack_mode { MODE_I, MODE_II, MODES };

/* The body round a crack, by its space. */
struct crack_medium {
    real shear, lambda;                       /* G; lambda' of the space: plane stress 2 G nu/(1 - nu) [Pa] */
    real poisson, kappa;                      /* nu; Kolosov's constant [1] */
    real modulus;                             /* E*: E, or E/(1 - nu^2) in plane strain [Pa] */
    real density;                             /*                                                          [kg/m^3] */
    real longitudinal, shear_speed, rayleigh; /* c_d, c_s, c_R [m/s] */
};

struct crack_medium crack_medium_of(const struct material *m, enum space space);

/* What the integral needs to know of a motion at a point, in the local frame. */
struct crack_state {
    real gradient[2][2];    /* du_i/dx_j [1] */
    real stress[2][2];      /*                                                          [Pa] */
    real velocity[2];       /*                                                          [m/s] */
    real velocity_along[2]; /* d velocity_i/dx_1 [1/s] */
    real acceleration[2];   /*                                                          [m/s^2] */
};

struct crack_field {
    real displacement[2];
    struct crack_state state;
}; /* [m] */

/* Hooke's law in the plane. */
void crack_hooke(const struct crack_medium *m, real gradient[2][2], real stress[2][2]);

/* The field of K = 1 Pa m^(1/2) at x: of a crack at rest (Williams 1957); of one that moves at the constant speed v,
 * 0 < v < c_R (Freund 1990), 0/0 as v -> 0; and the one of both that is accurate: at rest below 0.01 c_s, where they
 * differ by 1e-4. On the crack the sign of a zero x[1] tells the face. */
void crack_field_at_rest(const struct crack_medium *m, enum crack_mode mode, const real x[2], struct crack_field *f);
void crack_field_moving(const struct crack_medium *m, enum crack_mode mode, real v, const real x[2],
                        struct crack_field *f);
void crack_field(const struct crack_medium *m, enum crack_mode mode, real v, const real x[2], struct crack_field *f);

/* A_I, A_II: energy release rate = (A_I K_I^2 + A_II K_II^2)/E*; 1 at rest. A_II holds 1 - a_s^2 as A_I does; with
 * 1 - a_d^2, as sometimes printed, it would not tend to 1. */
real crack_universal(const struct crack_medium *m, enum crack_mode mode, real v);

/* k(v) = K_I/K_I at rest of a semi-infinite crack that grows at constant speed under a time-independent load: exact
 * (Freund 1990, eq. 6.4.26), the formula of Rose (1976), and the common approximation (1 - v/c_R)/sqrt(1 - v/c_d). */
enum speed_factor { SPEED_EXACT, SPEED_ROSE, SPEED_APPROXIMATE };
real crack_speed_factor(const struct crack_medium *m, enum speed_factor form, real v);

/* The speed v <= most (below c_R) at which the exact k(v) is `factor`; 0 where factor >= 1 [m/s]. */
real crack_speed_of_factor(const struct crack_medium *m, real factor, real most);

/* K_I of a semi-infinite crack at rest in plane strain, `age` [s] after a plane wave reached it that brings the normal
 * stress `stress` to its plane [Pa m^(1/2)]. */
real crack_suddenly_loaded(const struct crack_medium *m, real stress, real age);

/* Where the circumferential stress is largest (Erdogan & Sih 1963), in a form that is sound as K_II -> 0 [rad]; and
 * the mode-I intensity in that direction [Pa m^(1/2)]. */
real crack_direction(const real K[MODES]);
real crack_equivalent(const real K[MODES]);

#endif
