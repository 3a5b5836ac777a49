/* Computes observed order, grid convergence index and verdict of a scalar result; convergence_interval.c computes its
 * intervals. */
#include "study/convergence.h"

#include <math.h>

/* Factor of the grid convergence index with three spacings and an observed order (Roache 1998). */
#define SAFETY 1.25
#define ORDER_LEAST 0.5 /* order below which convergence counts as slow */
#define ORDER_MOST 2.0  /* formal order of the methods, which an observed order may exceed by chance */

const char *const verdict_name[VERDICTS] = {
    [VERDICT_CONVERGES] = "converges", [VERDICT_SCATTERS] = "scatters",          [VERDICT_OSCILLATES] = "oscillates",
    [VERDICT_SLOW] = "slow",           [VERDICT_DIVERGES] = "does not converge",
};

double student_t_quantile_975(int degrees_of_freedom)
{
    static const double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                   2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086};
    const double normal = 1.95996;
    INVARIANT(degrees_of_freedom >= 1);
    return degrees_of_freedom <= (int)COUNT_OF(table) ? table[degrees_of_freedom - 1]
                                                      : normal + 2.5 / degrees_of_freedom; /* accurate to 0.2 % */
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* Summarises the runs of one spacing level (runs with one particle spacing) in *l: mean, standard deviation, mean
 * spacing and number. k: the level, 0 the finest; n: number of all runs. Run i has the spacing spacing[i] [m] (NULL:
 * not summarised), the level level[i] (NULL: all runs count) and the value value[i]. Runs whose value is not finite
 * are left out. The deviation is NAN for a single run. */
static void level_find(struct spacing_level_statistics *l, const double *spacing, const double *value, const int *level,
                       int n, int k)
{
    *l = (struct spacing_level_statistics){0};
    for (int r = 0; r < n; r++)
        if ((!level || level[r] == k) && isfinite(value[r])) {
            l->spacing += spacing ? spacing[r] : 0, l->mean += value[r];
            l->runs++;
        }
    if (l->runs == 0) return;
    l->spacing /= l->runs, l->mean /= l->runs;
    double sum = 0;
    for (int r = 0; r < n; r++)
        if ((!level || level[r] == k) && isfinite(value[r])) sum += square(value[r] - l->mean);
    l->deviation = l->runs > 1 ? sqrt(sum / (l->runs - 1)) : NAN;
}

/* Returns half of the 95 % interval of the mean of `runs` runs (Student's t distribution). deviation: standard
 * deviation of one run, estimated with `freedom` degrees of freedom. Returns 0 if freedom is 0. */
static double error_of_mean(double deviation, int freedom, int runs)
{
    return freedom > 0 ? student_t_quantile_975(freedom) * deviation / sqrt(runs) : 0;
}

void convergence_compute_mean_and_deviation_over_runs(struct spacing_level_statistics *l, const double *value,
                                                      int run_count)
{
    level_find(l, NULL, value, NULL, run_count, 0);
    l->error = error_of_mean(l->deviation, l->runs - 1, l->runs);
}

/* Computes the error of the mean of each spacing level (runs with one particle spacing) of c, half of its 95 %
 * interval, from the scatter of its runs (Student's t distribution). A level with a single run uses the pooled scatter
 * of the other levels. resolution[levels]: further error of each level, combined as the root of the sum of squares;
 * NULL if there is none. */
static void errors_find(struct convergence *c, const double *resolution)
{
    double sum = 0;
    int freedom = 0;
    for (int k = 0; k < c->levels; k++)
        if (c->level[k].runs > 1) {
            sum += (c->level[k].runs - 1) * square(c->level[k].deviation);
            freedom += c->level[k].runs - 1;
        }
    for (int k = 0; k < c->levels; k++) {
        struct spacing_level_statistics *l = &c->level[k];
        const bool alone = l->runs == 1;
        if (alone) l->deviation = freedom > 0 ? sqrt(sum / freedom) : 0;
        const int own = alone ? freedom : l->runs - 1;
        l->error = error_of_mean(l->deviation, own, l->runs);
        if (resolution) l->error = hypot(l->error, resolution[k]);
    }
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

/* Returns the ratio (m2 - m1)/(m1 - m0) of the means m0, m1, m2 of a scalar result at the three finest spacing levels
 * l[3] (runs with one particle spacing each; l[0] the finest) that would result if the error were proportional to h^p,
 * with the spacing h. */
static double ratio_at(const struct spacing_level_statistics *l, double p)
{
    const double h0 = l[0].spacing, h1 = l[1].spacing / h0, h2 = l[2].spacing / h0;
    if (fabs(p) < 1e-9) return log(h2 / h1) / log(h1);
    return (pow(h2, p) - pow(h1, p)) / (pow(h1, p) - 1);
}

/* Returns the order p for which the means m of a result at the three finest spacing levels l[3] (runs with one
 * particle spacing each; l[0] the finest) are linear in h^p, with the spacing h. It is found by bisection between -10
 * and 20. ratio: measured (m2 - m1)/(m1 - m0). */
static double order_find(const struct spacing_level_statistics *l, double ratio)
{
    double low = -10, high = 20;
    for (int k = 0; k < 80; k++) {
        const double middle = 0.5 * (low + high);
        if (ratio_at(l, middle) < ratio)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Orders of convergence. low, high: smallest and largest order that are consistent with the means of the levels and the
 * errors of these means; seen: observed order, NAN if the means oscillate. */
struct orders {
    double low, seen, high;
};

/* Computes the observed order of convergence of a scalar result from its means at the three finest spacing levels l[3]
 * (runs with one particle spacing each; l[0] the finest), and the range of orders that the errors of the means allow,
 * into *o. Returns false if the means oscillate by more than their errors. */
static bool orders_find(struct orders *o, const struct spacing_level_statistics *l)
{
    const double sign =
        fabs(l[2].mean - l[1].mean) > fabs(l[1].mean - l[0].mean) ? l[2].mean - l[1].mean : l[1].mean - l[0].mean;
    const double near = copysign(1, sign) * (l[1].mean - l[0].mean), near_error = hypot(l[0].error, l[1].error);
    const double far = copysign(1, sign) * (l[2].mean - l[1].mean), far_error = hypot(l[1].error, l[2].error);
    *o = (struct orders){-INFINITY, NAN, INFINITY};
    if (near + near_error <= 0 || far + far_error <= 0) return false;
    if (far - far_error > 0) o->low = order_find(l, (far - far_error) / (near + near_error));
    if (near - near_error > 0) o->high = order_find(l, (far + far_error) / (near - near_error));
    if (near > 0 && far > 0) o->seen = order_find(l, far / near);
    return true;
}

/* Determines verdict, observed order and grid convergence index (Roache 1998) of a result (a scalar result of the
 * runs) from its means at the three finest spacing levels (runs with one particle spacing each) in c, and stores them
 * in *c. The order is NAN if the means oscillate or differ by no more than their errors; the index is NAN if the order
 * is NAN or below 1/2. */
static void convergence_judge(struct convergence *c)
{
    const struct spacing_level_statistics *l = c->level;
    const double near = fabs(l[1].mean - l[0].mean), far = fabs(l[2].mean - l[1].mean);
    struct orders o;
    c->order = c->index = NAN;
    c->verdict = VERDICT_SCATTERS;
    if (near <= hypot(l[0].error, l[1].error) && far <= hypot(l[1].error, l[2].error)) return;
    if (!orders_find(&o, l)) {
        c->verdict = VERDICT_OSCILLATES;
        return;
    }
    c->order = o.seen;
    if (o.high <= 0 || (o.high < ORDER_LEAST && o.seen <= 0))
        c->verdict = VERDICT_DIVERGES;
    else if (o.high < ORDER_LEAST - 1e-6)
        c->verdict = VERDICT_SLOW;
    else if (o.seen > ORDER_LEAST - 1e-6)
        c->verdict = VERDICT_CONVERGES;
    if (!(o.seen > ORDER_LEAST - 1e-6)) return;
    c->index = SAFETY * near / (pow(l[1].spacing / l[0].spacing, fmin(o.seen, ORDER_MOST)) - 1);
}

bool convergence_evaluate_scalar_result(struct convergence *c, const double *spacing, const double *value,
                                        const int *spacing_level_of_run, int run_count, int level_count,
                                        const double *half_quantisation_step)
{
    INVARIANT(level_count >= LEVELS_LEAST && level_count <= LEVELS_MOST);
    *c = (struct convergence){.levels = level_count};
    for (int k = 0; k < level_count; k++) {
        level_find(&c->level[k], spacing, value, spacing_level_of_run, run_count, k);
        if (c->level[k].runs > 0) continue;
        if (k < LEVELS_LEAST) return false;
        c->levels = k; /* levels coarser than a gap are ignored */
        break;
    }
    errors_find(c, half_quantisation_step);
    convergence_judge(c);
    convergence_fit_order_and_uncertainty_intervals(c);
    return true;
}
