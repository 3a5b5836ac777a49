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

/* Level 0 is the finest. All but `order` are in units of the figure. */
struct convergence {
    struct level_figures level[LEVELS_MOST];
    int levels;
    enum verdict verdict;
    double order;                       /* observed on the three finest levels; NAN: none */
    double extrapolated;                /* to spacing 0: with order 0.75 where the means allow it within their errors,
                                         * else the nearest that they allow from 0.5 to 2 */
    double discretisation[LEVELS_MOST]; /* of the mean of each level: grid convergence index */
    double uncertainty[LEVELS_MOST];    /* root of the sum of the squares of this and of the error of the mean */
};

/* n runs: value[k] at spacing[k], of level[k] = 0 .. levels - 1; NAN: the run has none. resolution[level]: half of the
 * steps in which the figure comes there; NULL: none. False where a level has no value: nothing is known. The three
 * finest levels decide. The grid convergence index is that of Roache (1998), with the
 * factor of safety 1.5 where
 * the order is seen and bounds where it is not, as ASME V&V 20 (2009) asks. */
bool convergence_find(struct convergence *c, const double *spacing, const double *value, const int *level, int n,
                      int levels, const double *resolution);

/* Quantile 97.5 % of Student's t with n >= 1 degrees of freedom. */
double student_95(int n);

#endif
