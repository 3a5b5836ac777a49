/* Computes the interval that contains the true value of a scalar result with a given probability (Bayesian).
 *
 * Model: the means of the spacing levels k (0: finest) with spacings h_k are m_k = v + a (h_k/h_0)^p + noise, with the
 * value v at spacing 0 that is to be found. The noise consists of the error of the mean, with standard deviation e_k/2,
 * and of a misfit with standard deviation t S, because lattices of different spacings fit a body differently; S is the
 * range of the means. Prior: v is nearly unknown; the order p is uniform between 1/2 (fronts) and 2 (smooth fields);
 * the trend from the coarsest to the finest level is normal with standard deviation S; t is log-uniform up to 1. For
 * each (p, t) the posterior of v is normal and follows from linear least squares; its weight is the likelihood of the
 * means. The posterior is thus a mixture of normal distributions. It widens if the means scatter, oscillate or are
 * consistent with several orders.
 *
 * `cleave bench uncertainty` compares these intervals with results whose true values are known. */
#include <math.h>

#include "study/convergence.h"

/* Numbers of orders of convergence p and of misfits t (symbols of the model at the beginning of this file) in the
 * mixture of normal distributions. */
enum { ORDERS = 7, MISFITS = 10 };
#define ORDER_FIRST 0.5   /* range of the order p, sampled in equal steps */
#define ORDER_LAST 2.0    /* end of the range */
#define MISFIT_LEAST 1e-3 /* smallest t; sampled from here to 1 in equal steps of its logarithm */
#define VAGUE 100.0       /* standard deviation of the prior of v, divided by S */

/* Distribution of (v - m_0)/S as a mixture of normal distributions, one for each order and misfit: weight, mean
 * (`centre`), standard deviation, and order p. v: value of a result at spacing 0; m_0: its mean at the finest level; S:
 * range of the means. */
struct mixture {
    struct {
        double weight, centre, deviation, order;
    } part[ORDERS * MISFITS];
};

/* ---- the mixture ------------------------------------------------------------------------------------------------- */

/* Returns the scale S of the means of a scalar result at all spacing levels (runs with one particle spacing each): S =
 * sqrt(range^2 + (error/2)^2), where range is the largest minus the smallest mean and error the largest error of a
 * mean. c: means and errors. */
static double range_scale(const struct convergence *c)
{
    double least = INFINITY, most = -INFINITY, error = 0;
    for (int k = 0; k < c->levels; k++) {
        least = fmin(least, c->level[k].mean), most = fmax(most, c->level[k].mean);
        error = fmax(error, c->level[k].error);
    }
    return hypot(most - least, 0.5 * error);
}

/* Fits m_k = v + a (h_k/h_0)^p to the means m_k of a scalar result at the spacing levels k with spacings h_k (level 0
 * is the finest), by Bayesian linear regression with broad normal priors of v and a. c: means and their errors; scale:
 * scale of the means (range_scale); p: order of convergence; t: standard deviation of the means about this law in
 * addition to their own errors, divided by `scale`. *centre, *deviation: receive mean and standard deviation of the
 * posterior of (v - m_0)/scale. Returns the logarithm of the likelihood of the means for this p and t, up to a
 * constant. */
static double part_fit(const struct convergence *c, double scale, double p, double t, double *centre, double *deviation)
{
    const double trend = pow(c->level[c->levels - 1].spacing / c->level[0].spacing, p) - 1;
    double vv = 1 / square(VAGUE), va = 0, aa = square(trend), v = 0, a = 0, misfit = 0, spread = -2 * log(trend);
    for (int k = 0; k < c->levels; k++) {
        const struct spacing_level_statistics *l = &c->level[k];
        const double x = pow(l->spacing / c->level[0].spacing, p), y = (l->mean - c->level[0].mean) / scale;
        const double variance = square(0.5 * l->error / scale) + square(t);
        vv += 1 / variance, va += x / variance, aa += x * x / variance;
        v += y / variance, a += x * y / variance;
        misfit += y * y / variance, spread += log(variance);
    }
    const double determinant = vv * aa - va * va;
    const double value = (v * aa - a * va) / determinant, slope = (vv * a - va * v) / determinant;
    *centre = value;
    *deviation = sqrt(aa / determinant);
    return -0.5 * (misfit - v * value - a * slope + spread + log(determinant));
}

/* Computes in *m the distribution of the value of a scalar result at spacing 0. It is a mixture of normal
 * distributions, one for each pair of an order of convergence and a misfit of the means, with weights of sum 1. c:
 * means of the result; scale: their scale (range_scale). Returns false if it is 0, that is, if all means are equal and
 * have no error. */
static bool mixture_make(struct mixture *m, const struct convergence *c, double scale)
{
    double most = -INFINITY, sum = 0;
    int n = 0;
    if (!(scale > 0)) return false;
    for (int o = 0; o < ORDERS; o++)
        for (int k = 0; k < MISFITS; k++, n++) {
            const double p = ORDER_FIRST + (ORDER_LAST - ORDER_FIRST) * o / (ORDERS - 1);
            const bool at_end = o == 0 || o == ORDERS - 1; /* trapezoidal rule: end points count half */
            const double t = pow(MISFIT_LEAST, 1 - (double)k / (MISFITS - 1));
            m->part[n].order = p;
            m->part[n].weight =
                part_fit(c, scale, p, t, &m->part[n].centre, &m->part[n].deviation) + (at_end ? log(0.5) : 0);
            most = fmax(most, m->part[n].weight);
        }
    for (int k = 0; k < n; k++) sum += m->part[k].weight = exp(m->part[k].weight - most);
    for (int k = 0; k < n; k++) m->part[k].weight /= sum;
    return true;
}

/* ---- intervals --------------------------------------------------------------------------------------------------- */

/* Returns the probability that a standard normal variable is below z. */
static double normal_below(double z) { return 0.5 * erfc(-z * 0.70710678118654752); }

/* Returns the probability that a variable with the mixture distribution m is between about - half_width and about +
 * half_width. */
static double mixture_within(const struct mixture *m, double about, double half_width)
{
    double sum = 0;
    for (int k = 0; k < ORDERS * MISFITS; k++) {
        const double off = m->part[k].centre - about, s = m->part[k].deviation;
        sum += m->part[k].weight * (normal_below((half_width - off) / s) - normal_below((-half_width - off) / s));
    }
    return sum;
}

/* Returns by bisection the half-width w of the interval about - w .. about + w that contains a variable with the
 * mixture distribution m with the probability `share` (0 to 1). */
static double mixture_half_width(const struct mixture *m, double about, double share)
{
    double low = 0, high = 4 * VAGUE;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        if (mixture_within(m, about, middle) < share)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* Returns the half-width of the interval around 0 that contains a normal variable of mean 0 with the probability
 * `share` (0 to 1), divided by the half-width for 95 %. */
static double normal_half_width(double share)
{
    double low = 0, high = 10;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        if (2 * normal_below(1.959964 * middle) - 1 < share)
            low = middle;
        else
            high = middle;
    }
    return high;
}

double convergence_confidence_interval_half_width(const struct convergence *c, double interval_centre,
                                                  double probability)
{
    struct mixture m;
    const double scale = range_scale(c), rest = c->bias > 0 ? c->bias * normal_half_width(probability) : 0;
    if (!mixture_make(&m, c, scale)) return rest;
    return hypot(scale * mixture_half_width(&m, (interval_centre - c->level[0].mean) / scale, probability), rest);
}

void convergence_fit_order_and_uncertainty_intervals(struct convergence *c)
{
    struct mixture m;
    const double scale = range_scale(c);
    double value = 0, order = 0, squares = 0;
    c->order_likely = c->order_error = NAN;
    c->extrapolated = c->level[0].mean;
    for (int k = 0; k < c->levels; k++) c->uncertainty[k] = c->discretisation[k] = 0;
    if (!mixture_make(&m, c, scale)) return;
    for (int k = 0; k < ORDERS * MISFITS; k++) {
        value += m.part[k].weight * m.part[k].centre;
        order += m.part[k].weight * m.part[k].order;
        squares += m.part[k].weight * square(m.part[k].order);
    }
    c->order_likely = order;
    c->order_error = sqrt(fmax(squares - square(order), 0));
    c->extrapolated += scale * value;
    for (int k = 0; k < c->levels; k++) {
        const double error = c->level[k].error;
        c->uncertainty[k] = convergence_confidence_interval_half_width(c, c->level[k].mean, 0.95);
        c->discretisation[k] = sqrt(fmax(square(c->uncertainty[k]) - square(error), 0));
    }
}
