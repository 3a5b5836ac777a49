/* Computes the points of the pictures of a study: means and scatter of a result over the runs of each point, in the
 * unit of its panel. */
#include <math.h>

#include "base/memory.h"
#include "study_picture.h"

/* Returns the index of the line of the picture p to which run number `run` belongs, computed from its values of the
 * keys that distinguish lines. Returns -1 if the run is not in the picture. */
static int line_of(const struct study_picture *p, int run)
{
    int line = 0;
    for (int k = 0; k < p->keys; k++) {
        const int at = p->value_at[k][run];
        if (at < 0 || (p->role[k] == ROLE_HELD && at > 0)) return -1;
        if (p->role[k] == ROLE_LINES) line = line * p->key[k].shown.values + at;
    }
    return line;
}

/* Computes the points of a panel of p: mean and scatter over the runs of each point. value[runs]: scalar result of the
 * panel in each run, in SI units; factor: unit of the panel in SI units. Returns an array [lines][values of the key
 * along the horizontal axis], which the caller releases with memory_free. */
static struct figure_statistics *means_find(const struct study_picture *p, const double *value, double factor)
{
    const int across = p->key[p->across].shown.values;
    struct figure_statistics *point = NEW("study.points", (int64_t)p->lines * across, struct figure_statistics);
    for (int pass = 0; pass < 2; pass++) {
        for (int c = 0; c < p->study->n; c++) {
            const int line = line_of(p, c);
            if (line < 0 || isnan(value[c])) continue;
            struct figure_statistics *to = &point[line * across + p->value_at[p->across][c]];
            if (pass == 0)
                to->mean += value[c] / factor, to->runs++;
            else
                to->scatter += square(value[c] / factor - to->mean);
        }
        for (int k = 0; k < p->lines * across && pass == 0; k++)
            point[k].mean = point[k].runs > 0 ? point[k].mean / point[k].runs : NAN;
    }
    for (int k = 0; k < p->lines * across; k++)
        point[k].scatter = point[k].runs > 1 ? sqrt(point[k].scatter / (point[k].runs - 1)) : 0;
    return point;
}

/* Returns the unit in which the picture p shows the scalar result with the index `figure` in p->table. */
static struct unit figure_unit(const struct study_picture *p, int figure)
{
    const double *value = p->table->value[figure];
    char unit[UNIT_ROOM];
    double largest = 0;
    for (int c = 0; c < p->table->cases; c++)
        if (isfinite(value[c])) largest = fmax(largest, fabs(value[c]));
    study_determine_unit_of_result(unit, sizeof unit, p->header, p->table->figure[figure]);
    return unit_with_si_prefix_if_unit_allows_it(unit, largest);
}

void study_picture_compute_plotted_points(struct study_picture *p)
{
    study_picture_free_plotted_points(p);
    for (int panel = 0; panel < p->panels; panel++) {
        p->unit_of_figure[panel] = figure_unit(p, p->figure[panel]);
        p->point[panel] = means_find(p, p->table->value[p->figure[panel]], p->unit_of_figure[panel].factor);
    }
}

void study_picture_free_plotted_points(struct study_picture *p)
{
    for (int panel = 0; panel < p->panels; panel++) {
        memory_free(p->point[panel]);
        p->point[panel] = NULL;
    }
}

void study_panel_find_range_of_plotted_values(const struct study_picture *p, int panel, double *low, double *high)
{
    *low = INFINITY, *high = -INFINITY;
    for (int k = 0; k < p->lines * p->key[p->across].shown.values; k++) {
        const struct figure_statistics *at = &p->point[panel][k];
        if (at->runs == 0) continue;
        *low = fmin(*low, at->mean - at->scatter), *high = fmax(*high, at->mean + at->scatter);
    }
}

bool study_picture_every_point_has_value(const struct study_picture *p)
{
    for (int panel = 0; panel < p->panels; panel++)
        for (int k = 0; k < p->lines * p->key[p->across].shown.values; k++)
            if (p->point[panel][k].runs == 0) return false;
    return true;
}
