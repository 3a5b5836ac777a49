/* Fields round the tip of a crack in a plane elastic body, with their formulas (Freund 1990, Dynamic Fracture
 * Mechanics, chapters 4 and 6). Local frame: x1 in the direction of the crack, ahead of the tip; x2 perpendicular. */
#ifndef CLEAVE_SIF_FIELDS
#define CLEAVE_SIF_FIELDS

#include "data/material.h"

enum crack_mode { MODE_I, MODE_II, MODES };

/* Elastic constants and wave speeds of the material round a crack, for plane stress, plane strain or 3D. */
struct crack_medium {
    /* shear modulus G; Lame constant lambda' of the space, plane stress: 2 G nu/(1 - nu) [Pa] */
    real shear, lambda;
    real poisson, kappa;                      /* Poisson's ratio nu; Kolosov's constant [1] */
    real modulus;                             /* E*: E, in plane strain E/(1 - nu^2) [Pa] */
    real density;                             /* mass density [kg/m^3] */
    real longitudinal, shear_speed, rayleigh; /* c_d, c_s, c_R [m/s] */
};

/* Returns the elastic constants and wave speeds of material m, as crack-tip fields need them. space: plane stress,
 * plane strain or 3D. */
struct crack_medium crack_medium_of_material(const struct material *m, enum space space);

/* Motion and stress at a point, in the frame of the crack tip: x_1 ahead of the tip, x_2 perpendicular to the crack. */
struct crack_state {
    real gradient[2][2];    /* du_i/dx_j [1] */
    real stress[2][2];      /* stress [Pa] */
    real velocity[2];       /* particle velocity [m/s] */
    real velocity_along[2]; /* d velocity_i/dx_1 [1/s] */
    real acceleration[2];   /* particle acceleration [m/s^2] */
};

/* Field of a crack tip at one point, in the frame of the tip (x_1 ahead of the tip): displacement [m]; state:
 * displacement gradient, stress, velocity and acceleration. */
struct crack_field {
    real displacement[2];
    struct crack_state state;
};

/* Computes the stress in the plane from the displacement gradient by Hooke's law. m: elastic constants, which include
 * the choice of plane stress or plane strain; gradient: du_i/dx_j [1]; stress: receives sigma_ij [Pa]. */
void crack_medium_stress_from_displacement_gradient(const struct crack_medium *m, real gradient[2][2],
                                                    real stress[2][2]);

/* Computes the field at x round the tip of a crack at rest in the medium m with K = 1 Pa m^(1/2) in the mode `mode`
 * alone (Williams 1957). x: position in the frame of the tip, x[0] ahead of the tip [m]; on the crack faces the sign of
 * x[1], also of a zero, selects the face. f: receives displacement, its gradient and stress; velocities and
 * accelerations are 0. */
void crack_tip_unit_sif_field_at_rest(const struct crack_medium *m, enum crack_mode mode, const real x[2],
                                      struct crack_field *f);

/* Computes the field round a crack tip that moves at constant speed in the medium m, with K = 1 Pa m^(1/2) in the mode
 * `mode` alone (Freund 1990, chapter 4). speed: 0 < `speed` < c_R, the Rayleigh speed [m/s]; the formulas are
 * ill-conditioned as `speed` -> 0. x: position in the frame of the tip, x[0] ahead of the tip [m]. f: receives
 * displacement and motion at x. */
void crack_tip_unit_sif_field_moving(const struct crack_medium *m, enum crack_mode mode, real speed, const real x[2],
                                     struct crack_field *f);

/* Computes the field round a crack tip at rest or in motion in the medium m, with K = 1 Pa m^(1/2) in the mode `mode`
 * alone. speed: 0 <= `speed` < c_R, the Rayleigh speed [m/s]. Below 1 % of the shear wave speed the field of a crack at
 * rest is used (crack_tip_unit_sif_field_at_rest), which differs there by 1e-4, else that of a moving crack. x:
 * position in the frame of the tip [m]; f: receives the field at x. */
void crack_tip_unit_sif_field_at_any_speed(const struct crack_medium *m, enum crack_mode mode, real speed,
                                           const real x[2], struct crack_field *f);

/* Returns the universal function A_I(v) or A_II(v) [1] of the mode `mode`, with which the energy release rate of a
 * moving crack is G = (A_I K_I^2 + A_II K_II^2)/E* (Freund 1990, chapter 5); both tend to 1 at rest. m: medium round
 * the crack; speed: speed v of the tip [m/s]. Both contain the factor 1 - a_s^2, with a_s = sqrt(1 - v^2/c_s^2). Some
 * prints have 1 - a_d^2 in A_II, with a_d = sqrt(1 - v^2/c_d^2), by which A_II would not tend to 1. */
real crack_tip_speed_universal_function(const struct crack_medium *m, enum crack_mode mode, real speed);

/* Formula for k(v), the ratio of K_I to K_I at rest, of a semi-infinite crack that grows at constant speed under a
 * time-independent load: exact (Freund 1990, eq. 6.4.26), the formula of Rose (1976), or the approximation (1 -
 * v/c_R)/sqrt(1 - v/c_d). */
enum speed_factor { SPEED_EXACT, SPEED_ROSE, SPEED_APPROXIMATE };

/* Returns the ratio k(v) of K_I of a semi-infinite crack that grows at the constant speed v = `speed` [m/s] to K_I of
 * the crack at rest under the same load: 1 at rest, 0 at the Rayleigh speed. m: medium round the crack; form: exact
 * solution or one of two approximations. */
real crack_moving_to_resting_sif_ratio(const struct crack_medium *m, enum speed_factor form, real speed);

/* Returns the crack speed v [m/s] at which the exact ratio k(v) of K_I to K_I at rest
 * (crack_moving_to_resting_sif_ratio) equals `sif_ratio`, limited to `max_speed` [m/s], which must be below the
 * Rayleigh speed. Returns 0 if sif_ratio >= 1. */
real crack_speed_from_sif_ratio(const struct crack_medium *m, real sif_ratio, real max_speed);

/* Returns K_I [Pa m^(1/2)] of a semi-infinite crack at rest in plane strain after the arrival of a plane wave (Freund
 * 1990). m: medium round the crack; wave_stress: normal stress of the wave on the plane of the crack [Pa];
 * time_since_arrival: time since the wave reached the crack [s]. */
real crack_sif_after_plane_wave(const struct crack_medium *m, real wave_stress, real time_since_arrival);

/* Returns the angle [rad] by which a crack kinks: that between the crack and the direction of the largest
 * circumferential stress ahead of its tip, in which it grows (Erdogan & Sih 1963). The formula stays accurate as K_II
 * -> 0. The angle is negative if K_II > 0. K: K_I and K_II [Pa m^(1/2)]. */
real crack_kink_angle_from_sif(const real K[MODES]);

/* Returns the equivalent mode-I stress-intensity factor K_eq [Pa m^(1/2)] in the direction of the largest
 * circumferential stress (crack_kink_angle_from_sif), which is compared with the toughness. K: K_I and K_II [Pa
 * m^(1/2)]. */
real crack_equivalent_sif(const real K[MODES]);

#endif
