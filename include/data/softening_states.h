/* Strength of bonds that soften (softening.h) in a family of any model: bond-based, or state-based with the share 1 - d
 * of the weight of a bond in all sums (kernels/pd/state_soften.c). */
#ifndef CLEAVE_SOFTENING_STATES
#define CLEAVE_SOFTENING_STATES

#include "data/softening.h"

/* Model of a family: moduli A and B of a state-based model over E' [1], and whether bonds resist the displacement that
 * remains without the rotation of the particle, or only extension. B = 0: bond-based. */
struct softening_model {
    real A, B;
    bool rotates;
};

/* Does what softening_curve_strength does, for a family of the given model. */
struct softening_strength softening_model_strength(const struct softening_curve *c, enum space space,
                                                   real squared_ratio, const struct softening_model *model);

/* Does what softening_onset_from_strength does, for a family of the given model. */
real softening_model_onset(const struct material *m, enum space space, const struct softening_model *model);

/* Computes m->rate.onset, the onset stretches at the strengths of the table over m->onset_stretch. Returns the least
 * kappa = (critical stretch/onset)^2 at any of them [1]. */
real strength_rate_compute_onsets(struct material *m, enum space space, const struct softening_model *model);

#endif
