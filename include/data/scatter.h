/* Strength that scatters from place to place: a random field over reference positions.
 *
 * A Gaussian field g of mean 0, variance 1 and correlation exp(-(r/length)^2): white noise on a lattice of half a
 * length, smoothed by exp(-2 (r/length)^2) (a moving average; Vanmarcke 1983). The noise of a node is a hash of seed
 * and node: the field is a function of the place alone, the same for every spacing, order and number of threads.
 * A factor W of mean 1 follows through the distribution's quantiles, W = F^-1(Phi(g)), with Weibull's (1951)
 *
 *     F(W) = 1 - exp(-(W Gamma(1 + 1/m))^m)
 *
 * or the lognormal one. Without a length every particle has a factor of its own. */
#ifndef CLEAVE_SCATTER
#define CLEAVE_SCATTER

#include "base/base.h"

enum scatter_of { SCATTER_STRENGTH, SCATTER_STRETCH, SCATTER_TOUGHNESS, SCATTER_ENERGY };
enum scatter_form { SCATTER_WEIBULL, SCATTER_LOGNORMAL };

struct strength_scatter {
    bool given;
    enum scatter_of of; /* what has the distribution: G_c goes with the square of the others */
    enum scatter_form form;
    real modulus;   /* m of Weibull's distribution [1] */
    real variation; /* of the lognormal one: standard deviation over mean [1] */
    real length;    /* 0: each particle by itself [m] */
    uint64_t seed;
};

/* g at X [m]; `id` numbers particles where there is no length. */
real scatter_gaussian(const struct strength_scatter *s, const real *X, int dim, int64_t id);
/* Factor on the critical stretch there; 1 where nothing scatters. */
real scatter_factor(const struct strength_scatter *s, const real *X, int dim, int64_t id);
/* Number below which a standard normal one lies with probability u, 0 < u < 1. */
real normal_quantile(real u);

#endif
