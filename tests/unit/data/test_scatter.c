/* Scatter of strength: random numbers, random field and strength of chains, compared with closed forms. */
#include <math.h>
#include <stdlib.h>

#include "tests/support/near.h"
#include "data/scatter.h"

static int test_scatter_ascending(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x > y) - (x < y);
}

static real normal_below(real g) { return 0.5 * erfc(-g * M_SQRT1_2); }

/* Checks that the distribution function of the quantile is the probability, from 1e-15 to 0.9. Tolerance: the formula
 * has seven digits, and the relative error grows with the magnitude, which is at most 8. */
static void test_quantiles(void **state)
{
    (void)state;
    for (int e = 1; e <= 15; e++)
        for (int k = 1; k < 10; k++) {
            const real u = k * pow(10, -e);
            assert_close(normal_below(normal_distribution_quantile(u)), u, 1e-5);
            assert_near(normal_distribution_quantile(1 - u), -normal_distribution_quantile(u), e < 8 ? 1e-5 : 0.2);
        }
    assert_exact(normal_distribution_quantile(0.5), 0);
}

/* Sorts value[n] and returns the largest distance between their empirical distribution and F(value, parameter)
 * (Kolmogorov). It exceeds 1.63/sqrt(n) for 1 % of all samples. */
static real kolmogorov(real *value, int n, real (*F)(real, real), real parameter)
{
    real most = 0;
    qsort(value, (size_t)n, sizeof *value, test_scatter_ascending);
    for (int k = 0; k < n; k++) {
        const real here = F(value[k], parameter);
        most = real_max(most, real_max(here - (real)k / n, (real)(k + 1) / n - here));
    }
    return most;
}

static real weibull(real W, real m) { return 1 - exp(-pow(W * tgamma(1 + 1 / m), m)); }
static real lognormal(real W, real variation)
{
    const real spread2 = log1p(variation * variation);
    return normal_below((log(W) + 0.5 * spread2) / sqrt(spread2));
}
static real weibull_of_square(real s, real m) { return weibull(s * s, m); }

enum { MANY = 20000 };

/* Checks by Kolmogorov's distance that strength factors have the requested distribution (Weibull, lognormal, Weibull of
 * the energy), at distant positions in every dimension and for particles without a correlation length (dim 0). */
static void test_distributions(void **state)
{
    (void)state;
    real *value = calloc(MANY, sizeof *value);
    for (int dim = 0; dim <= DIM_MAX; dim++)
        for (int form = 0; form < 3; form++) {
            struct strength_scatter s = {.given = true, .modulus = 8, .variation = 0.3, .length = dim > 0 ? 0.01 : 0};
            s.seed = (uint64_t)(7 + 10 * dim + form);
            if (form == 1) s.form = SCATTER_LOGNORMAL;
            if (form == 2) s.of = SCATTER_ENERGY;
            for (int i = 0; i < MANY; i++) {
                const real X[DIM_MAX] = {0.0701 * i, 0.0301 * (i % 100), -0.0407 * (i % 77)};
                value[i] = scatter_strength_factor(&s, X, dim, i);
            }
            const real D = form == 0   ? kolmogorov(value, MANY, weibull, 8)
                           : form == 1 ? kolmogorov(value, MANY, lognormal, 0.3)
                                       : kolmogorov(value, MANY, weibull_of_square, 8);
            assert_true(D < 1.63 / sqrt(MANY));
        }
    free(value);
}

/* Checks the correlation of the random field, the mean of g(X) g(X + r) over positions and seeds, against
 * exp(-(r/length)^2). Tolerance: four standard deviations of about 1/sqrt(n) for n pairs, and 1e-3 for the truncation
 * by the lattice. */
static void test_correlation(void **state)
{
    (void)state;
    enum { PAIRS = 10000 };
    const real distance[] = {0, 0.25, 0.5, 1, 1.5, 3};
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        const int pairs = dim < 3 ? PAIRS : PAIRS / 8;
        for (size_t k = 0; k < COUNT_OF(distance); k++) {
            real sum = 0;
            for (int i = 0; i < pairs; i++) {
                struct strength_scatter s = {.given = true, .length = 0.02, .seed = (uint64_t)i};
                real X[DIM_MAX] = {0.0013 * i, 0.0007 * i, -0.0003 * i}, Y[DIM_MAX];
                for (int d = 0; d < DIM_MAX; d++) Y[d] = X[d] + (d < dim ? distance[k] * s.length / sqrt(dim) : 0);
                sum += scatter_gaussian_field_value(&s, X, dim, 0) * scatter_gaussian_field_value(&s, Y, dim, 0);
            }
            const real exact = exp(-square(distance[k]));
            assert_near(sum / pairs, exact, 4 * sqrt((1 + exact * exact) / pairs) + 1e-3);
        }
    }
}

/* Checks that the mean strength of the weakest of n links is n^(-1/m) (Weibull 1951). Tolerance: three standard
 * deviations, the coefficient of variation of about 1.2/m divided by the root of the number of chains. */
static void test_weakest_link(void **state)
{
    (void)state;
    enum { CHAINS = 1000 };
    const real moduli[] = {3, 10, 30};
    for (size_t k = 0; k < COUNT_OF(moduli); k++)
        for (int n = 1; n <= 100; n *= 10) {
            struct strength_scatter s = {.given = true, .modulus = moduli[k]};
            real sum = 0;
            for (int chain = 0; chain < CHAINS; chain++) {
                const real X[DIM_MAX] = {0};
                real least = INFINITY;
                s.seed = (uint64_t)chain * 77 + 5;
                for (int i = 0; i < n; i++) least = real_min(least, scatter_strength_factor(&s, X, 1, i));
                sum += least;
            }
            assert_close(sum / CHAINS, pow(n, -1 / s.modulus), 3 * 1.2 / s.modulus / sqrt(CHAINS));
        }
}

/* Checks that the strength factor depends on the position only, not on the index of the particle, and is smooth (1 um
 * changes it by less than 2e-3). Very far from the origin it must remain between 0 and 2. */
static void test_by_place(void **state)
{
    (void)state;
    const struct strength_scatter s = {.given = true, .modulus = 10, .length = 2e-3, .seed = 3};
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int i = -20; i < 20; i++) {
            const real X[DIM_MAX] = {1e-3 * i, 2e-3 * i, 0.1e-3 * i}, Y[DIM_MAX] = {X[0] + 1e-6, X[1], X[2]};
            const real here = scatter_strength_factor(&s, X, dim, i);
            assert_exact(here, scatter_strength_factor(&s, X, dim, 1000 - i));
            assert_near(here, scatter_strength_factor(&s, Y, dim, i), 2e-3);
            const real away[DIM_MAX] = {1e4 + X[0], -1e4, 1e4};
            assert_true(scatter_strength_factor(&s, away, dim, 0) > 0 && scatter_strength_factor(&s, away, dim, 0) < 2);
        }
    const struct strength_scatter none = {.modulus = 10};
    assert_exact(scatter_strength_factor(&none, (real[DIM_MAX]){1}, 1, 0), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_quantiles), cmocka_unit_test(test_distributions),
                                       cmocka_unit_test(test_correlation), cmocka_unit_test(test_weakest_link),
                                       cmocka_unit_test(test_by_place)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
