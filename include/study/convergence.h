/* Discretisation error of a scalar result, estimated from runs of one scene at several particle spacings. */
#ifndef CLEAVE_CONVERGENCE
#define CLEAVE_CONVERGENCE

#include "study/study.h"

/* LEVELS_LEAST, LEVELS_MOST: smallest and largest number of spacing levels of a convergence study; RUNS_MOST: largest
 * number of runs of one level. */
enum { LEVELS_LEAST = 3, LEVELS_MOST = 6, RUNS_MOST = 15 };

/* Statistics of a scalar result over the runs of one spacing level, which have about the same particle spacing. mean,
 * deviation, error: in the unit of the result. */
struct spacing_level_statistics {
    double spacing, mean; /* mean spacing [m]; mean of the result */
    double deviation;     /* standard deviation of a single run */
    double error;         /* half of the 95 % interval of the mean: Student's t and the resolution of the result */
    int runs;
};

/* Behaviour of a scalar result as the particle spacing decreases. */
enum verdict {
    VERDICT_CONVERGES,  /* converges with an observed order of 0.5 or more */
    VERDICT_SCATTERS,   /* differences between levels, or their order, are smaller than the scatter of the runs */
    VERDICT_OSCILLATES, /* the means increase and decrease */
    VERDICT_SLOW,       /* converges with an order below 0.5 */
    VERDICT_DIVERGES,   /* differences grow as the spacing decreases */
    VERDICTS
};

/* Words for the values of enum verdict, in their order, for tables. */
extern const char *const verdict_name[VERDICTS];

/* Convergence of a scalar result over spacing levels; level 0 is the finest. All members but the orders are in units of
 * the result. */
struct convergence {
    struct spacing_level_statistics level[LEVELS_MOST];
    int levels;
    enum verdict verdict; /* whether the means converge */
    double bias;          /* half-width of an error that does not decrease with the spacing, for example of irregular
                           * lattices; 0: none */
    double order;         /* order observed on the three finest levels; NAN: none */
    double index; /* grid convergence index of the finest level (Roache 1998, factor of safety 1.25); NAN: no order
                   * of 1/2 or more is observed */
    double order_likely, order_error;   /* mean and standard deviation of the orders that are consistent with all
                                         * levels */
    double extrapolated;                /* value extrapolated to spacing 0: mean over the consistent orders */
    double uncertainty[LEVELS_MOST];    /* half-width of the 95 % interval of the true value around the mean of each
                                         * level */
    double discretisation[LEVELS_MOST]; /* part of `uncertainty` that is not the error of the mean: root of the
                                         * difference of squares */
};

/* Determines observed order, verdict and uncertainty intervals of a scalar result from `run_count` runs, and stores
 * them in *c. value[k]: result of run k, NAN if the run has none; spacing[k]: its particle spacing [m];
 * spacing_level_of_run[k] = 0 .. level_count - 1: its spacing level, 0 the finest.
 * half_quantisation_step[level]: half of the step in which the result is quantised at this level; NULL if it is not
 * quantised. Returns false if one of the three finest levels has no value. */
bool convergence_evaluate_scalar_result(struct convergence *c, const double *spacing, const double *value,
                                        const int *spacing_level_of_run, int run_count, int level_count,
                                        const double *half_quantisation_step);

/* Computes mean, standard deviation and error of the mean of a scalar result over runs that differ by chance alone,
 * such as by a random seed, and stores them in *l. value[run_count]: value of the result in each run; values that are
 * not finite are left out. */
void convergence_compute_mean_and_deviation_over_runs(struct spacing_level_statistics *l, const double *value,
                                                      int run_count);

/* Returns the half-width of the interval centred at `interval_centre` that contains the true value of the result with
 * probability `probability` [1], from the means of all spacing levels and their errors (convergence_interval.c).
 * `interval_centre` and the result have the unit of the result. */
double convergence_confidence_interval_half_width(const struct convergence *c, double interval_centre,
                                                  double probability);

/* Fits c->level[c->levels], means and errors at several spacings, by value + constant * spacing^order for many orders,
 * and weights these by how well they fit. Computes from them: order_likely and order_error, mean and standard deviation
 * of the order; extrapolated, the mean value at spacing 0; uncertainty, half the width of the 95 % interval around the
 * mean of each level; discretisation, the part of it that is not the error of the mean (members of *c). If the levels
 * do not allow a fit, the orders are NAN, the extrapolated value is the mean of the finest level, the others 0. */
void convergence_fit_order_and_uncertainty_intervals(struct convergence *c);

/* Returns the 97.5 % quantile of Student's t distribution with `degrees_of_freedom` >= 1 degrees of freedom. */
double student_t_quantile_975(int degrees_of_freedom);

#endif
