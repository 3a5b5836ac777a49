/* Random field of strength over reference positions.
 *
 * A Gaussian field g of mean 0, variance 1 and correlation exp(-(r/length)^2) at the distance r is white
 * noise on a lattice of half a length, smoothed by exp(-2 (r/length)^2) (a moving average; Vanmarcke 1983).
 * The noise of a node is a hash of seed and node, so that the field is a function of the position alone,
 * independent of spacing, order of the particles and number of threads. The strength factor W, of mean 1,
 * follows from W = F^-1(Phi(g)), with the standard normal distribution Phi and the distribution function F of
 * Weibull (1951), with the modulus m,
 *
 *     F(W) = 1 - exp(-(W Gamma(1 + 1/m))^m)          Gamma: gamma function
 *
 * or the lognormal distribution. Without a correlation length every particle has an independent factor. */
#ifndef CLEAVE_SCATTER
#define CLEAVE_SCATTER

#include "base/base.h"

/* Quantity that has a random distribution: strength, critical stretch, toughness K_c, energy release rate G_c. */
enum scatter_of { SCATTER_STRENGTH, SCATTER_STRETCH, SCATTER_TOUGHNESS, SCATTER_ENERGY };

/* Probability distribution of the random quantity (enum scatter_of): Weibull or lognormal. */
enum scatter_form { SCATTER_WEIBULL, SCATTER_LOGNORMAL };

/* Parameters of the random field of strength of one material. given: false if the scene gives none; form: distribution;
 * seed: seed of the random numbers. */
struct strength_scatter {
    bool given;
    enum scatter_of of; /* quantity with this distribution; G_c is proportional to the square of the others */
    enum scatter_form form;
    real modulus;   /* m of Weibull's distribution [1] */
    real variation; /* lognormal: standard deviation divided by mean [1] */
    real length;    /* correlation length, 0: independent particles [m] */
    uint64_t seed;
};

/* Returns the value [1] at the position X (dim components [m]) of a Gaussian random field with mean 0, variance 1 and
 * the correlation length s->length. Without a correlation length the value depends only on the seed and on particle_id,
 * the number of the particle. */
real scatter_gaussian_field_value(const struct strength_scatter *s, const real *X, int dim, int64_t particle_id);

/* Returns the random factor [1] on the critical stretch of a particle at the position X (dim components [m]), drawn
 * from the distribution s; 1 if the scene gives no distribution. particle_id: number of the particle, used only without
 * a correlation length. */
real scatter_strength_factor(const struct strength_scatter *s, const real *X, int dim, int64_t particle_id);

/* Returns the quantile of the standard normal distribution: the number that a standard normal variable does not exceed
 * with the probability `probability`, 0 < probability < 1. */
real normal_distribution_quantile(real probability);

#endif
