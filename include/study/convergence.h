/* How far a figure is from what it converges to, from runs at several spacings that differ in nothing physical. */
#ifndef CLEAVE_CONVERGENCE
#define CLEAVE_CONVERGENCE

#include "study/study.h"

enum { LEVELS_LEAST = 3, LEVELS_MOST = 6, RUNS_MOST = 15 };

/* Runs at about one spacing. */
struct level_figures {
    double spacing, mean; /* of its runs [m], in units of the figure */
    double deviation;     /* standard, of one run */
    double error;         /* half of the 95 % interval of the mean: by Student, and the resolution */
    int runs;
};

enum verdict {
    VERDICT_CONVERGES,  /* with an observed order of 0.5 or more */
    VERDICT_SCATTERS,   /* differences of spacings, or their order, are hidden in the scatter of runs */
    VERDICT_OSCILLATES, /* the means go up and down */
    VERDICT_SLOW,       /* an order below 0.5 */
    VERDICT_DIVERGES,   /* differences grow as the spacing shrinks */
    VERDICTS
};
extern const char *const verdict_name[VERDICTS];

/* Level 0 is the finest. All but orders are in units of the figure. */
struct convergence {
    struct level_figures level[LEVELS_MOST];
    int levels;
    enum verdict verdict;
    double bias;  /* half-width of what no spacing takes away, as by families of a shaken lattice; 0: none */
    double order; /* observed on the three finest levels; NAN: none */
    double index; /* grid convergence index of the finest level (Roache 1998, factor of safety 1.25); NAN: no order of
                   * 1/2 or more is seen */
    double order_likely, order_error; /* of all levels: mean and standard deviation of the orders that fit */
    double extrapolated;              /* to spacing 0: mean of what they lead to */
    double uncertainty[LEVELS_MOST];  /* half-width of the 95 % interval of the true value round the mean of a level */
    double
        discretisation[LEVELS_MOST]; /* what of it is not the error of the mean (root of the difference of squares) */
};

/* n runs: value[k] at spacing[k], of level[k] = 0 .. levels - 1; NAN: the run has none. resolution[level]: half of the
 * steps in which the figure comes there; NULL: none. False where one of the three finest levels has no value. */
bool convergence_find(struct convergence *c, const double *spacing, const double *value, const int *level, int n,
                      int levels, const double *resolution);

/* Half-width of the interval round the value `about` that holds the true one with probability `share`, from the means
 * of all levels and their errors (convergence_interval.c). */
double convergence_half_width(const struct convergence *c, double about, double share);
/* Sets order_likely, order_error, extrapolated, uncertainty and discretisation of a convergence with levels. */
void convergence_intervals(struct convergence *c);

/* Quantile 97.5 % of Student's t with n >= 1 degrees of freedom. */
double student_95(int n);

#endif
