/* Evaluates a random field of strength at positions of particles (scatter.h). */
#include "data/scatter.h"

#include <math.h>

/* Returns the quantile of the standard normal distribution for `probability`, 0 < probability < 1, by algorithm AS 241
 * (PPND7) of Wichura 1988, with seven digits. */
real normal_distribution_quantile(real probability)
{
    const real q = probability - 0.5;
    if (fabs(q) <= 0.425) {
        const real r = 0.180625 - q * q;
        return q * (((59.109374720 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
               (((67.187563600 * r + 78.757757664) * r + 17.895169469) * r + 1);
    }
    real r = sqrt(-log(q < 0 ? probability : 1 - probability)), x;
    if (r <= 5) {
        r -= 1.6;
        x = (((0.17023821103 * r + 1.3067284816) * r + 2.7568153900) * r + 1.4234372777) /
            ((0.12021132975 * r + 0.73700164250) * r + 1);
    } else {
        r -= 5;
        x = (((0.017337203997 * r + 0.42868294337) * r + 3.0812263860) * r + 6.6579051150) /
            ((0.012258202635 * r + 0.24197894225) * r + 1);
    }
    return q < 0 ? -x : x;
}

/* Returns a number of the standard normal distribution that depends on `hash` alone: the quantile of a probability
 * formed of its leading 53 bits. */
static real noise_of(uint64_t hash) { return normal_distribution_quantile(((real)(hash >> 11) + 0.5) * 0x1p-53); }

/* Number of lattice nodes along each axis whose random numbers contribute to the field at a point. The nodes are half a
 * correlation length apart; omitted nodes have weights of at most exp(-8) of the largest. */
enum { NODES = 8 };

/* Computes weight[NODES], the Gaussian weights of those NODES nodes of a random field that are nearest to the
 * coordinate `place` along one axis. The nodes are half a correlation length apart, which is the unit of `place`.
 * Returns the index of the first of these nodes. */
static int64_t weights_along(real place, real weight[NODES])
{
    const int64_t first = (int64_t)floor(place) - NODES / 2 + 1;
    for (int k = 0; k < NODES; k++) weight[k] = exp(-0.5 * square(place - (real)(first + k)));
    return first;
}

real scatter_gaussian_field_value(const struct strength_scatter *s, const real *X, int dim, int64_t particle_id)
{
    if (!(s->length > 0)) return noise_of(hash_add_word(hash_add_word(s->seed, 0), (uint64_t)particle_id));
    real weight[DIM_MAX][NODES] = {{1}, {1}, {1}}, sum = 0, squares = 1;
    int64_t first[DIM_MAX] = {0};
    for (int d = 0; d < dim; d++) {
        real own = 0;
        first[d] = weights_along(X[d] / (0.5 * s->length), weight[d]);
        for (int k = 0; k < NODES; k++) own += square(weight[d][k]);
        squares *= own;
    }
    for (int k = 0; k < (dim > 2 ? NODES : 1); k++)
        for (int j = 0; j < (dim > 1 ? NODES : 1); j++) {
            const uint64_t row = hash_add_word(hash_add_word(hash_add_word(s->seed, 0), (uint64_t)(first[2] + k)),
                                               (uint64_t)(first[1] + j));
            for (int i = 0; i < NODES; i++)
                sum +=
                    weight[2][k] * weight[1][j] * weight[0][i] * noise_of(hash_add_word(row, (uint64_t)(first[0] + i)));
        }
    return sum / sqrt(squares);
}

/* Returns F^-1(Phi(g)) for a standard normal number g, where F is Weibull's distribution of modulus m and mean 1:
 * (-ln(1 - Phi(g)))^(1/m)/Gamma(1 + 1/m). */
static real weibull_of(real g, real m)
{
    const real beyond = g > 0 ? -log(0.5 * erfc(g * M_SQRT1_2)) : -log1p(-0.5 * erfc(-g * M_SQRT1_2));
    return pow(beyond, 1 / m) / tgamma(1 + 1 / m);
}

/* Returns F^-1(Phi(g)) for a standard normal number g, where F is the lognormal distribution of mean 1: exp(s g -
 * s^2/2) with s^2 = ln(1 + variation^2). variation: coefficient of variation [1]. */
static real lognormal_of(real g, real variation)
{
    const real spread2 = log1p(square(variation));
    return exp(sqrt(spread2) * g - 0.5 * spread2);
}

real scatter_strength_factor(const struct strength_scatter *s, const real *X, int dim, int64_t particle_id)
{
    if (!s->given) return 1;
    const real g = scatter_gaussian_field_value(s, X, dim, particle_id);
    const real factor = s->form == SCATTER_WEIBULL ? weibull_of(g, s->modulus) : lognormal_of(g, s->variation);
    return s->of == SCATTER_ENERGY ? sqrt(factor) : factor;
}
