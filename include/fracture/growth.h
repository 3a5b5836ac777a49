/* Cracks that grow at a prescribed speed, or as the stress-intensity factors (SIF) of a probe require. The
 * tip moves on a straight line between changes of direction. The weight of a bond that the tip crosses is
 * reduced by the factor f_b while the crack grows on by the length da (transition bonds, Imachi et al. 2019),
 * with the constants `damping` and `exponent` of struct growth_rule:
 *
 *     f_b = (1 - da/damping)^exponent,  0 <= da <= damping,  then 0;   damping = 0: 0 at once
 *
 * A SIF-driven crack turns by theta_c(K), the direction of the largest hoop stress, relative to the x axis
 * `along` of the frame in which K was computed. This axis is the mean of the directions of growth, `heading`,
 * over the length `smoothing`:
 *
 *     d(along)/da = (heading - along)/smoothing
 *
 * If a tip turned at once and K were computed in its new frame, on a ring that the kink has not crossed, K_II
 * would change its sign: theta_c = -2 K_II/K_I for small K_II is twice the rotation that removes K_II, and
 * the path would oscillate from sample to sample.
 *
 * A crack may be driven by its toughness K_Ic. It moves at the speed at which the equivalent factor K_eq,
 * computed with the fields of a moving tip, equals K_Ic; it is at rest while K_eq at rest is smaller. This is
 * the crack-tip equation of motion (Freund 1990, chapter 7). For any body and load, K responds to a change of
 * the speed v at once as K = k(v) K*(t, length). The universal function k decreases from 1 at rest to 0 at
 * the Rayleigh speed c_R (Freund 1990, chapters 6 and 7). Each new set of factors gives one secant step along
 * this curve, with the upper bound `fastest` of the speed:
 *
 *     k(v_wanted) = k(v_filtered) K_Ic/K_eq,   0 <= v_wanted <= fastest,
 *     v += (v_wanted - v) (1 - exp(-dt_sample/(0.3 T))),
 *     dv_filtered/dt = (v - v_filtered)/T,     T = horizon/c_R
 *
 * with the fixed point K_eq = K_Ic for any k. v_filtered is the speed to which the factors belong: the
 * process zone, about a horizon wide, transmits a change of speed to the field from which K is computed
 * within about T. With v in place of v_filtered the speed oscillates (283 m/s rms about the closed form in
 * place of 61, inputs/running_crack.yaml). The mean over 0.3 T limits the change in a step: K is noisy as the
 * tip moves from particle to particle.
 *
 * Both directed bonds of a pair of particles lose equal weight, so that momentum is conserved; the energy
 * that bonds lose counts as fracture energy. Bonds of a crack at rest keep their weights. */
#ifndef CLEAVE_GROWTH
#define CLEAVE_GROWTH

#include "base/archive.h"
#include "bonds/bonds.h"
#include "data/cells.h"
#include "scene/requests.h"
#include "sif.h"

/* Stress-intensity factors that drive a crack. along: unit vector of the direction of the tip in whose frame the
 * factors were computed; the crack turns relative to this direction until new factors are available. */
struct growth_control {
    struct sif factors;
    real along[2];
    real time;                  /* time at which the factors were computed [s] */
    struct crack_medium medium; /* elastic body round the tip */
};

/* A bond between the particles i and j that a growing crack has crossed and that loses its weight gradually. whole,
 * before, now: weight of the bond when it was crossed, in the previous step and at present [1]; length: length by which
 * the crack had grown when it crossed the bond [m]. */
struct fading {
    int32_t i, j;
    real whole, before, now;
    real length;
};

/* State of a crack whose growth is prescribed or driven by stress-intensity factors. The list of fading bonds is
 * owned. */
struct growing_crack {
    const struct growth_rule *rule; /* kept by reference */
    /* present reference position of the tip [m]; unit vector: x axis of the frame in which stress-intensity factors are
     * computed; speed in the last step, 0 at rest [m/s] */
    real place[2], along[2], speed;
    /* unit vector of the present direction of growth; `along` is its mean over the smoothing length */
    real heading[2];
    real grown;                        /* length of growth so far [m] */
    real start_time;                   /* time of the first growth [s]; NAN: none so far */
    real intensity;                    /* K_eq at the last sample [Pa m^(1/2)]; NAN: unknown */
    real target_speed, filtered_speed; /* toughness-driven cracks: speed of the tip; its filtered value [m/s] */
    real control_time;                 /* time of the last sample that changed the speed [s] */
    int64_t n;
    struct fading *fading; /* [n] bonds that the crack has crossed and whose weight decreases */
};

/* Initialises the growing crack g at its start position, without growth. rule: start, direction, speed or toughness of
 * the crack; kept by reference and must outlive g. */
void growing_crack_make(struct growing_crack *g, const struct growth_rule *rule);

/* Frees g->fading, the list of bonds that the growing crack g has crossed and whose forces decrease gradually, and sets
 * all members of g to 0. */
void growing_crack_free(struct growing_crack *g);

/* Advances the growing crack g from the time t by the time step dt (both [s]). Moves the tip by its speed times dt and
 * adds the bonds that the tip crosses to g->fading. Reduces the weights (factors on the forces) of all bonds in this
 * list, which become 0 as the crack grows on. b, p: bonds and particles; source: inputs of the bonds, with the
 * neighbour search. control: present stress-intensity factors, which turn the tip to the direction of the largest hoop
 * stress and may set its speed; NULL if the factors are not known. Returns the number of directed bonds (bond i-j
 * counts twice) whose weight became 0. */
int64_t growing_crack_advance_and_count_cut_bonds(struct growing_crack *g, struct bonds *b, struct particles *p,
                                                  const struct bond_source *source,
                                                  const struct growth_control *control, real t, real dt);

/* Returns the angle [degree], 0 to 180, between the initial direction of the growing crack g and the straight line from
 * its start to its tip; NAN if the crack has not grown. */
real growing_crack_deflection_angle(const struct growing_crack *g);

/* Saves the state of the growing crack g and its fading bonds (crossed bonds that lose their weight gradually) to the
 * archive `a` (checkpoint file or memory) if a->saving, else restores them from it. crack_number: number of the crack,
 * part of the names of its entries in the archive. Returns FAILED if the archive cannot be read or written or a stored
 * size differs. */
status growing_crack_save_or_load(struct growing_crack *g, int crack_number, struct archive *a);

#endif
