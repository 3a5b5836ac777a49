/* Prints means and error bars of the results of a study that varies a random seed alone. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/plot.h"
#include "study/convergence.h"
#include "study_picture.h"

/* Prints mean, standard deviation and half of the 95 % interval of the mean of a scalar result in the runs of a study
 * to `to`. name: name of the result; value[cases]: its value in each run; header: header line of history.csv, for its
 * unit. Prints nothing for fewer than two values. */
static void mean_print(FILE *to, const char *header, const char *name, const double *value, int cases)
{
    char text[UNIT_ROOM];
    struct spacing_level_statistics all;
    convergence_compute_mean_and_deviation_over_runs(&all, value, cases);
    if (all.runs < 2) return;
    study_determine_unit_of_result(text, sizeof text, header, name);
    const struct unit unit = unit_with_si_prefix_if_unit_allows_it(text, fabs(all.mean));
    fprintf(to, "%s: mean %.4g +- %.2g%s%s (95 %% interval), standard deviation %.2g%s%s, %d runs\n", name,
            all.mean / unit.factor, all.error / unit.factor, *unit.name ? " " : "", unit.name,
            all.deviation / unit.factor, *unit.name ? " " : "", unit.name, all.runs);
}

status study_print_means_over_seeds(FILE *out, const struct study_table *t, const struct study *s,
                                    const struct varied_key *key, int keys, const char *const *result, int results)
{
    char header[HEADER_ROOM];
    struct study_picture p = {.table = t, .study = s};
    if (!study_varies_only_random_seed(key, keys)) return OK;
    TRY(study_picture_set_results_of_panels_by_name(&p, result, results));
    if (results == 0) study_picture_choose_results_of_panels(&p);
    study_read_history_header(header, sizeof header, s);
    for (int k = 0; k < p.panels; k++) {
        const char *name = t->figure[p.figure[k]];
        if (results > 0 || !result_describes_computation_instead_of_body(name))
            mean_print(out, header, name, t->value[p.figure[k]], t->cases);
    }
    return OK;
}
