/* Strength of neighbourhoods whose bonds soften (softening.h) in any model: bond-based, or state-based, where the sums
 * of a neighbourhood contain the fraction 1 - d of the weight of a bond with the softening d
 * (kernels/pd/state_soften.c). */
#ifndef CLEAVE_SOFTENING_STATES
#define CLEAVE_SOFTENING_STATES

#include "data/softening.h"

/* Peridynamic model of a neighbourhood (a particle with its neighbours). A, B: moduli of a state-based model divided by
 * the modulus E' of uniaxial tension [1], B = 0 for bond-based models; rotates: bonds resist all of their deformation
 * apart from the rotation of the particle, else only their extension. */
struct softening_model {
    real A, B;
    bool rotates;
};

/* Returns the peak stresses in tension, equal biaxial tension and shear, divided by s_0 E', of a neighbourhood
 * (particle with its neighbours) of softening bonds under growing uniform strain, by quadrature over directions. model:
 * peridynamic model; c: softening curve; s_0: stretch at which bonds begin to soften; E': modulus of uniaxial tension;
 * space: line, plane stress, plane strain or solid; squared_stretch_ratio: (critical stretch/s_0)^2 [1]. */
struct softening_strength softening_model_normalised_peak_stresses(const struct softening_curve *c, enum space space,
                                                                   real squared_stretch_ratio,
                                                                   const struct softening_model *model);

/* Returns the stretch s_0 [1] at which bonds must begin to soften so that material m has the tensile strength
 * m->tensile_strength, for neighbourhoods of the bond-based or state-based model `model`, by fixed-point iteration.
 * space: line, plane stress, plane strain or solid. m->critical_stretch must be set. If the horizon is too large for
 * this strength, the result exceeds m->critical_stretch. */
real softening_model_onset_stretch_from_strength(const struct material *m, enum space space,
                                                 const struct softening_model *model);

/* Computes the onset factors m->rate.onset of material m for the strain rates of the table m->rate. By this factor the
 * stretch at which bonds begin to soften exceeds that in slow loading, m->onset_stretch, so that the material has its
 * strength at the strain rate. space: line, plane stress, plane strain or solid; model: peridynamic model of the bonds.
 * Returns the smallest ratio (critical stretch/onset)^2 over all rates, by which the caller checks the table: below
 * RATE_LEAST_RATIO bonds would break before they reach the strength. */
real strength_rate_compute_softening_onset_factors(struct material *m, enum space space,
                                                   const struct softening_model *model);

#endif
