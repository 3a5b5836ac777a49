/* Estimates the sizes in which particles of bodies that were read from particle lists are drawn. Output frames do not
 * store these sizes, and in a list with fine and coarse zones they differ. */
#include <math.h>

#include "base/memory.h"
#include "data/cells.h"
#include "plot/plot.h"

/* REACH: largest distance within which the neighbours of a particle are searched [spacings]. SAME: only neighbours up
 * to this multiple of the distance of the nearest one determine the size of a particle, since beside a zone of half the
 * spacing the other neighbours are farther. GRADED: least ratio of the largest size to the smallest at which particles
 * are drawn in sizes of their own. */
static const double REACH = 4, SAME = 1.3, GRADED = 1.5;
enum { NEAREST_MOST = 2 * DIM_MAX };

/* Returns the size [m] of particle i of the output frame f: the distance from the farthest of its 2 dim nearest
 * neighbours in the same body that are at most SAME times as far as the nearest one. Returns `none` without neighbours.
 * near: indices of the particles around i. */
static double size_of(const struct output_frame *f, int64_t i, const struct neighbour_list *near, double none)
{
    double nearest[NEAREST_MOST];
    for (int k = 0; k < 2 * f->dim; k++) nearest[k] = INFINITY;
    for (int j = 0; j < near->n; j++) {
        double r = 0;
        for (int d = 0; d < f->dim; d++) r += square(f->X[d][near->at[j]] - f->X[d][i]);
        if (f->body[near->at[j]] != f->body[i]) continue;
        for (int k = 0; k < 2 * f->dim; k++) { /* insert in ascending order */
            const double low = fmin(r, nearest[k]);
            r = fmax(r, nearest[k]), nearest[k] = low;
        }
    }
    double size = isfinite(nearest[0]) ? sqrt(nearest[0]) : none;
    for (int k = 1; k < 2 * f->dim; k++)
        if (nearest[k] <= square(SAME) * nearest[0] && isfinite(nearest[0])) size = sqrt(nearest[k]);
    return size;
}

float *frame_estimate_particle_sizes_if_graded(const struct output_frame *f, double spacing)
{
    if (f->dim < 2 || f->spacing || !(spacing > 0)) return NULL;
    const struct particles part = {.n = f->n, .n_all = f->n, .dim = f->dim, .X = {f->X[0], f->X[1], f->X[2]}};
    float *size = NEW("plot.sizes", f->n, float), least = INFINITY, largest = 0;
    struct neighbour_list near = {0};
    struct cells cells;
    cells_make_for_neighbour_search(&cells, &part, REACH * spacing);
    for (int64_t i = 0; i < f->n; i++) {
        particles_list_neighbours_unordered(&near, &cells, &part, i, REACH * spacing, false);
        size[i] = (float)size_of(f, i, &near, spacing);
        least = fminf(least, size[i]), largest = fmaxf(largest, size[i]);
    }
    cells_free(&cells);
    memory_free(near.at);
    if (largest > GRADED * least) return size;
    memory_free(size);
    return NULL;
}
