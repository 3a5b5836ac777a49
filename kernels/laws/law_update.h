/* Return mapping of von Mises plasticity with a flow law (data/law.h), kinematic hardening and adiabatic
 * heating, for eight points at once. With the deviator s of the stress, the back stress X, xi = s - X, q =
 * sqrt(3/2 xi:xi), the accumulated plastic strain a, the temperature T and the flow law sigma_y(a, da/dt, T),
 *     f = q - sigma_y <= 0,   d eps_p = da (3/2) xi/q,   da >= 0,   da f = 0
 *     dX = (2/3) C d eps_p - gamma X da   (Armstrong & Frederick 1966; gamma = 0: Prager)
 * with the kinematic modulus C and the recall constant gamma. Steps are implicit Euler steps (Simo & Hughes
 * 1998, chapter 3), with the back stress integrated exactly along the flow direction of the step. The plastic
 * strain rate is the mean of the step, 0 in load steps. In explicit steps the temperature is that at the
 * start; in load steps yield stress and temperature follow the adiabatic curve of the law. */
#ifndef CLEAVE_KERNELS_LAW_UPDATE
#define CLEAVE_KERNELS_LAW_UPDATE

#include "data/law.h"
#include "kernels/simd/kernel.h"
#include "kernels/simd/lanes.h"

/* State of eight material points at the end of a step, input and output of law_update. Tensors have the components xx
 * yy zz xy yz zx in every space. */
struct law_points {
    eight_lanes s[SYM_MAX];      /* trial stress, replaced by the stress [Pa]; in plane stress zz is 0 */
    eight_lanes before[SYM_MAX]; /* stress at the start of the step, rotated by its spin [Pa] */
    /* volume at the start and at the end of the step, divided by the reference volume [1] */
    eight_lanes volume_before, volume;
    real duration;             /* of an explicit step [s]; 0: the rate has no effect */
    eight_lanes a;             /* accumulated equivalent plastic strain, updated [1] */
    eight_lanes back[SYM_MAX]; /* back stress X, deviatoric, rotated by the spin of the step; updated [Pa] */
    eight_lanes temperature;   /* updated [K] */
    eight_lanes work;          /* plastic work per reference volume, updated [J/m^3] */
    bool thins;        /* explicit steps in plane stress and 1D: `volume` is corrected by the change of thickness or
                          cross-section due to plastic strain */
    eight_mask active; /* lanes whose points have this law; the points of other lanes are not changed */
};

/* law_place[dim][c]: index of component c of particles.stress among the six components xx yy zz xy yz zx of struct
 * law_points, in dim dimensions. */
static const int law_place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};

/* Maps the trial stresses p->s of eight material points back to the yield surface of the flow law `law` (not NULL), and
 * updates their plastic state in *p. Only the points set in p->active are changed. space: in plane stress sigma_zz
 * remains 0, in 1D (line) the stress remains uniaxial. mode LAW_EXPLICIT: the plastic work is that of the mean of the
 * stresses at start and end of the step, each times its volume. With the elastic energy 1/2 s : C^-1 : s the energy
 * balance of leap-frog steps then closes to round-off. mode LAW_LOAD_STEP: the plastic work is the integral along the
 * path on which the trial stress grows in proportion, which is a potential of the state if the back stress has no
 * recall term; p->before (stress at the start) and the volumes are not read. Returns a bit for each point, set if the
 * point is active and yields. */
KERNEL(unsigned, law_update, (const struct law *law, struct law_points *p, enum space space, enum law_mode mode));

#endif
