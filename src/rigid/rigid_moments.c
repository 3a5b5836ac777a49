/* Computes volume, centre and second moments of regions, by a uniform grid of sampling points and by cells that are
 * divided at the surface of the region. */
#include "rigid_moments.h"

#include <math.h>

/* Numbers of sampling points of the uniform grid along the longest edge of the box, in 2D and in 3D. */
enum { SAMPLES = 200, SAMPLES_SPACE = 80 };

/* Limits of the integration over divided cells. ROOTS: cells along the longest edge of the box before any division.
 * DIVISIONS_FIRST, DIVISIONS_LAST: divisions of a cell in the first and in the last refinement. CELLS_MOST: number of
 * evaluated cells after which no further refinement begins. */
enum { ROOTS = 8, DIVISIONS_FIRST = 3, DIVISIONS_LAST = 20, CELLS_MOST = 4000000 };

/* Relative change of the moments in a refinement at which the refinement of cells ends [1]. */
#define CHANGE_SMALL 1e-3

/* Distance outside a region up to which a sampling point counts as inside, divided by the longest edge of the box of
 * the region [1]. It makes opposite inclined faces count alike in spite of round-off. */
#define ON_FACE 1e-9

/* Division of a box into equal cells. n: number of cells along each axis (1 beyond the dimension of space); edge: edges
 * of a cell [m]. */
struct box_cells {
    int n[DIM_MAX];
    real edge[DIM_MAX], longest; /* longest: longest edge of the box [m] */
};

/* Returns the equal cells into which the box from[dim] .. to[dim] [m] is divided, `samples` along its longest edge. */
static struct box_cells divide_box(const real *from, const real *to, int dim, int samples)
{
    struct box_cells cells = {.n = {1, 1, 1}, .edge = {1, 1, 1}};
    for (int d = 0; d < dim; d++) cells.longest = real_max(cells.longest, to[d] - from[d]);
    for (int d = 0; d < dim; d++) {
        cells.n[d] = (int)ceil((to[d] - from[d]) / cells.longest * samples);
        cells.edge[d] = (to[d] - from[d]) / cells.n[d];
    }
    return cells;
}

/* Computes the middle X[DIM_MAX] [m] of cell number k (from 0) of the box that `cells` divides. from[dim]: lower corner
 * of the box [m]. */
static void box_cell_middle(const struct box_cells *cells, const real *from, int dim, int64_t k, real *X)
{
    const int64_t at[] = {k % cells->n[0], k / cells->n[0] % cells->n[1], k / cells->n[0] / cells->n[1]};
    for (int d = 0; d < dim; d++) X[d] = from[d] + ((real)at[d] + 0.5) * cells->edge[d];
}

/* Computes the moments m of the region `shape`, which must be 0 before, from the cells of a uniform grid whose middle
 * is in the region. from[dim], to[dim]: corners of the box of the region [m]. */
static void moments_of_uniform_grid(const struct region *shape, int dim, const real *from, const real *to,
                                    struct region_moments *m)
{
    const struct box_cells cells = divide_box(from, to, dim, dim < 3 ? SAMPLES : SAMPLES_SPACE);
    real sum = 0, X[DIM_MAX] = {0};
    for (int64_t k = 0; k < (int64_t)cells.n[0] * cells.n[1] * cells.n[2]; k++) {
        box_cell_middle(&cells, from, dim, k, X);
        if (!region_contains(shape, X, dim, ON_FACE * cells.longest)) continue;
        sum++;
        for (int r = 0; r < dim; r++) {
            m->centre[r] += X[r];
            for (int c = 0; c < dim; c++) m->second[r][c] += X[r] * X[c];
        }
    }
    for (int r = 0; r < dim && sum > 0; r++) m->centre[r] /= sum;
    for (int r = 0; r < dim && sum > 0; r++)
        for (int c = 0; c < dim; c++)
            m->second[r][c] =
                m->second[r][c] / sum - m->centre[r] * m->centre[c] + (r == c ? square(cells.edge[r]) / 12 : 0);
    m->volume = sum * cells.edge[0] * cells.edge[1] * cells.edge[2];
}

/* ---- divided cells ----------------------------------------------------------------------------------------------- */

/* State of the integration of a region over cells that are divided at its surface: the region, the limit of divisions,
 * and sums over the cells so far. */
struct division {
    const struct region *shape;
    int dim, divisions;   /* divisions: largest number of divisions of a cell */
    real origin[DIM_MAX]; /* point about which the sums are taken [m] */
    int64_t cells;        /* number of evaluated cells */
    /* integrals of 1 [m^dim], X - origin [m^(dim+1)] and (X - origin)(X - origin)^T [m^(dim+2)] */
    real volume, first[DIM_MAX], second[DIM_MAX][DIM_MAX];
};

/* Adds the part of a cell inside the region to the sums of q. The |level set| at the middle is a lower bound
 * of the distance from the surface, so that a cell with a shorter half diagonal is inside or outside as a
 * whole. Other cells are divided across their longest edges. After the last division the fraction of the cell
 * inside the region is linear in the level set, so that no part of the region is too thin to count.
 * middle[dim], half[dim]: middle of the cell, and half of its edges [m]; depth: number of divisions that have
 * led to the cell. */
static void integrate_cell(struct division *q, const real *middle, const real *half, int depth)
{
    const int dim = q->dim;
    const real level = region_level_set_value(q->shape, middle, dim), reach = sqrt(dot(half, half, dim));
    q->cells++;
    if (fabs(level) < reach && depth < q->divisions) {
        real longest = 0, quarter[DIM_MAX], X[DIM_MAX];
        int uncut = 0; /* bit d: axis d is not divided */
        for (int d = 0; d < dim; d++) longest = real_max(longest, half[d]);
        for (int d = 0; d < dim; d++) uncut |= half[d] < 0.7 * longest ? 1 << d : 0;
        for (int c = 0; c < 1 << dim; c++) {
            if (c & uncut) continue;
            for (int d = 0; d < dim; d++) {
                quarter[d] = uncut >> d & 1 ? half[d] : 0.5 * half[d];
                X[d] = middle[d] + (uncut >> d & 1 ? 0 : c >> d & 1 ? quarter[d] : -quarter[d]);
            }
            integrate_cell(q, X, quarter, depth + 1);
        }
        return;
    }
    real part = real_max(0, real_min(1, 0.5 - 0.5 * level / reach)), arm[DIM_MAX];
    for (int d = 0; d < dim; d++) part *= 2 * half[d], arm[d] = middle[d] - q->origin[d];
    q->volume += part;
    for (int r = 0; r < dim; r++) {
        q->first[r] += part * arm[r];
        for (int c = 0; c < dim; c++) q->second[r][c] += part * (arm[r] * arm[c] + (r == c ? square(half[r]) / 3 : 0));
    }
}

/* Integrates the region q->shape over cells that are divided at its surface at most q->divisions times, into the sums
 * of q. from[dim], to[dim]: corners of the box of the region [m]. In q, shape, dim and divisions must be set, the other
 * members must be 0. */
static void integrate(struct division *q, const real *from, const real *to)
{
    const struct box_cells roots = divide_box(from, to, q->dim, ROOTS);
    real X[DIM_MAX] = {0}, half[DIM_MAX] = {0};
    for (int d = 0; d < q->dim; d++) half[d] = 0.5 * roots.edge[d], q->origin[d] = 0.5 * (from[d] + to[d]);
    for (int64_t k = 0; k < (int64_t)roots.n[0] * roots.n[1] * roots.n[2]; k++) {
        box_cell_middle(&roots, from, q->dim, k, X);
        integrate_cell(q, X, half, 0);
    }
}

/* Computes the moments m of a region from the integrals of two refinements: `coarse`, with one division less, and
 * `fine`. They are extrapolated to cells of size 0 (Richardson), since the error is proportional to the edge of the
 * smallest cells. */
static void moments_extrapolate(const struct division *coarse, const struct division *fine, struct region_moments *m)
{
    const int dim = fine->dim;
    real first[DIM_MAX];
    m->volume = 2 * fine->volume - coarse->volume;
    for (int r = 0; r < dim; r++) first[r] = (2 * fine->first[r] - coarse->first[r]) / m->volume;
    for (int r = 0; r < dim; r++) {
        m->centre[r] = fine->origin[r] + first[r];
        for (int c = 0; c < dim; c++)
            m->second[r][c] = (2 * fine->second[r][c] - coarse->second[r][c]) / m->volume - first[r] * first[c];
    }
}

/* Returns the largest relative difference of the moments a and b in dim dimensions: of the centres, divided by the
 * radius of gyration of b along the axis; of second moments, divided by the square root of the product of the diagonal
 * second moments of b. Returns INFINITY if a or b has no volume, or b no extent along an axis. */
static real moments_distance(const struct region_moments *a, const struct region_moments *b, int dim)
{
    real most = a->volume > 0 && b->volume > 0 ? 0 : INFINITY;
    for (int r = 0; r < dim; r++)
        if (!(b->second[r][r] > 0)) most = INFINITY;
    for (int r = 0; r < dim && most < INFINITY; r++) {
        most = real_max(most, fabs(a->centre[r] - b->centre[r]) / sqrt(b->second[r][r]));
        for (int c = 0; c < dim; c++)
            most = real_max(most, fabs(a->second[r][c] - b->second[r][c]) / sqrt(b->second[r][r] * b->second[c][c]));
    }
    return most;
}

/* Computes the moments `fine` of the region `shape` from cells that are divided further and further, until the moments
 * change by less than CHANGE_SMALL or there are more than CELLS_MOST cells. from[dim], to[dim]: corners of the box of
 * the region [m]. Returns false if the volume has decreased to less than half in the last refinement, as that of an
 * empty region does. */
static bool refine_moments(const struct region *shape, int dim, const real *from, const real *to,
                           struct region_moments *fine)
{
    struct division coarse = {.shape = shape, .dim = dim, .divisions = DIVISIONS_FIRST};
    struct region_moments previous = {0};
    integrate(&coarse, from, to);
    fine->change = INFINITY;
    for (int k = DIVISIONS_FIRST + 1; k <= DIVISIONS_LAST; k++) {
        struct division next = {.shape = shape, .dim = dim, .divisions = k};
        integrate(&next, from, to);
        previous = *fine;
        moments_extrapolate(&coarse, &next, fine);
        fine->change = moments_distance(&previous, fine, dim);
        if (fine->change < CHANGE_SMALL || next.cells > CELLS_MOST) break;
        coarse = next;
    }
    return fine->volume > 0.5 * previous.volume;
}

void region_compute_moments(const struct region *shape, int dim, const real *box_low, const real *box_high,
                            struct region_moments *m)
{
    struct region_moments uniform = {0}, fine = {0};
    *m = (struct region_moments){0};
    for (int d = 0; d < dim; d++)
        if (!(box_high[d] > box_low[d])) return;
    moments_of_uniform_grid(shape, dim, box_low, box_high, &uniform);
    const bool filled = refine_moments(shape, dim, box_low, box_high, &fine);
    const bool enough = moments_distance(&uniform, &fine, dim) < MOMENTS_ACCURATE;
    *m = enough ? uniform : fine;
    m->change = enough ? 0 : fine.change;
    if (uniform.volume == 0 && !filled) m->volume = 0;
}
