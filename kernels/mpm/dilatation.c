/* Updates stress and volume of material points for the mean dilatation of their cell (dilatation.h), which changes when
 * points move to other cells. */
#include "dilatation.h"
#include "row.h"

/* Adds the fraction `share` [1] of a dilatation to stress and volume of points in one cell: for each point the mean
 * dilatation of the cell in a step minus that of the point. list[n]: indices of the points in p, at most MEAN_POINTS;
 * t: time step, dilatations and elastic constants. */
static ALWAYS_INLINE void cell_add_mean_dilatation(struct particles *p, const struct transfer_data *t,
                                                   const int32_t *list, int n, real share, const int dim)
{
    real change[MEAN_POINTS];
    for (int k = 0; k < n; k++) change[k] = t->dilatation[list[k]];
    points_replace_values_by_cell_mean_minus_value(p, t, list, n, change);
    for (int k = 0; k < n; k++) {
        const struct elastic *m = &t->elastic[p->material[list[k]]];
        const real trace = share * t->dt * change[k], pressure = (m->c11 + (dim - 1) * m->c12) * trace / dim;
        for (int d = 0; d < dim; d++) p->stress[d][list[k]] += pressure;
        p->volume[list[k]] += p->volume[list[k]] * trace;
    }
}

void points_add_mean_dilatation(struct particles *p, const struct transfer_data *t, real share)
{
    const struct transfer_order *o = t->order;
#pragma omp parallel for schedule(static)
    for (int32_t c = 0; c < o->cells; c++)
        for (int32_t k = o->cell_start[c]; k < o->cell_start[c + 1]; k += MEAN_POINTS) {
            const int n = int_min(o->cell_start[c + 1] - k, MEAN_POINTS);
            if (p->dim == 2)
                cell_add_mean_dilatation(p, t, o->particle + k, n, share, 2);
            else
                cell_add_mean_dilatation(p, t, o->particle + k, n, share, 3);
        }
}
