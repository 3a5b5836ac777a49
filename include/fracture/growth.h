/* Cracks that grow at a prescribed speed, or as the stress-intensity factors of a probe require. The tip runs on a
 * straight line between changes of direction; a bond that it crosses fades out over the length that the crack grows
 * from then on (transition bonds, Imachi et al. 2019):
 *
 *     f_b = (1 - da/damping)^exponent,  0 <= da <= damping,  then 0;   damping = 0: released at once
 *
 * A SIF-controlled crack turns by theta_c(K), the direction of the largest hoop stress, away from the direction in
 * whose frame K was taken. That direction is the mean of where the tip headed, over the `smoothing` length of growth:
 *
 *     d(along)/da = (heading - along)/smoothing
 *
 * A tip that turns at once and is measured in its new frame, round a ring that its kink has not crossed, finds K_II
 * reversed: theta_c = -2 K_II/K_I for small K_II is twice the turn that removes it, and the path swings at every
 * sample.
 *
 * A crack may follow its toughness: it runs at the speed at which K_eq, taken with the fields of a moving tip, stays
 * equal to K_Ic, and rests while K_eq at rest is less (crack-tip equation of motion, Freund 1990, chapter 7).
 * Whatever body and load, K follows a change of speed at once as K = k(v) K*(t, length), and k, which falls from 1
 * at rest to 0 at the Rayleigh speed c_R, is the same for all (Freund 1990, chapters 6 and 7). Each new set of
 * factors makes one secant step along that curve,
 *
 *     k(v_wanted) = k(v_filtered) K_Ic/K_eq,   0 <= v_wanted <= fastest,
 *     v += (v_wanted - v) (1 - exp(-dt_sample/(0.3 T))),
 *     dv_filtered/dt = (v - v_filtered)/T,     T = horizon/c_R
 *
 * with the fixed point K_eq = K_Ic, whatever k is. v_filtered is the speed to which the factors belong: the process
 * zone, about a horizon, passes a change of speed on to the field that K is taken from in about T. A law that takes
 * v for it swings (283 m/s rms about the closed form instead of 61, inputs/running_crack.yaml). The mean over 0.3 T
 * bounds the change in a step: K is noisy as the tip goes from particle to particle.
 *
 * Both entries of a bond fade alike, so momentum stays exact; the energy that fading takes is fracture energy. A
 * crack that comes to rest keeps its bonds as they are. */
#ifndef CLEAVE_GROWTH
#define CLEAVE_GROWTH

#include "base/archive.h"
#include "bonds/bonds.h"
#include "data/cells.h"
#include "scene/requests.h"
#include "sif.h"

/* Factors that control a crack, when they were taken, and the direction of the tip in whose frame: the crack turns
 * away from that direction until new factors are taken. */
struct control {
    struct sif factors;
    real along[2];
    real time;                  /* [s] */
    struct crack_medium medium; /* the body round the tip */
};

/* One fading entry of the rows: bond i-j, its weight when whole, one step ago and now, and the crack's length when
 * it was crossed. */
struct fading {
    int32_t i, j;
    real whole, before, now;
    real length;
};

struct growth {
    const struct growth_rule *rule;    /* borrowed */
    real place[2], along[2], speed;    /* now; speed 0 while it rests [m] [m/s] */
    real heading[2];                   /* unit vector: where it goes; `along` is the mean of where it came from */
    real grown;                        /* length so far [m] */
    real start_time;                   /* of the first growth; NAN before [s] */
    real intensity;                    /* K_eq of the factors       ; NAN: none known [Pa m^(1/2)] */
    real target_speed, filtered_speed; /* of a crack that follows: its speed; v_filtered [m/s] */
    real control_time;                 /* time of the factors that controlled last [s] */
    int64_t n;
    struct fading *fading;
};

void growth_make(struct growth *g, const struct growth_rule *rule);
void growth_free(struct growth *g);

/* One step: the tip advances, what it crosses begins to fade, what fades goes on. `control` NULL: no factors known;
 * they turn the crack to the direction of the largest hoop stress once it grows. Returns directed bonds that were
 * released. */
int64_t growth_step(struct growth *g, struct bonds *b, struct particles *p, const struct bond_source *source,
                    const struct control *control, real t, real dt);

/* Angle of the chord from where it started against the direction then, 0..180 [degree]; NAN before it has grown. */
real growth_angle(const struct growth *g);

status growth_archive(struct growth *g, int which, struct archive *a);

#endif
