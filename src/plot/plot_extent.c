/* Computes the deformation of the particles of a picture, which are drawn as squares or cubes that deform with the
 * body: a stretched body then has no gaps between its particles, while a crack has. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bonds/bonds.h"
#include "data/cells.h"
#include "plot/plot.h"

/* Constants of the tests which neighbours are drawn as connected. NEAR_REACH: largest lattice distance of neighbours
 * [spacings], diagonal ones included; ACROSS: largest distance from an axis of a neighbour that counts as on that side
 * [spacings]. STRAIN_SEEN: strain below which a deformation is not visible. PARTED, PARTED_MORE: neighbours that have
 * both lost bonds are apart above the elongation PARTED, or PARTED_MORE times that of 99 % of the certainly connected
 * pairs, if larger. LONGEST: largest drawn length of a pair [spacings]. JUMP, JUMP_TIMES: a pair is apart if its
 * elongation exceeds JUMP plus JUMP_TIMES the median of its particle, as material points may separate without damage.
 * LOOSE: fraction of lost bonds above which a particle is loose, and drawn independently of its neighbours. */
#define NEAR_REACH 1.5
#define ACROSS 0.3
#define STRAIN_SEEN 0.02
#define PARTED 0.1
#define PARTED_MORE 1.5
#define LONGEST 4
#define JUMP 0.75
#define JUMP_TIMES 4
#define LOOSE 0.6
/* SURE_MOST: largest number of pairs of certainly connected neighbours that are sampled. NEAR_MOST: largest number of
 * pairs of one particle from which the median of elongations is computed. */
enum { SURE_MOST = 100000, NEAR_MOST = 64 };

/* Data for the tests whether two neighbours in output frame f are drawn as connected. limit: opening (elongation along
 * the axes of the lattice) above which neighbours that have both lost bonds are drawn apart; magnify: factor on
 * displacements in the picture. */
struct pairs {
    const struct output_frame *f;
    struct particles part; /* reference positions alone */
    struct cells cells;
    const struct scene *scene;
    double spacing, limit, magnify;
};

/* Returns the relative elongation |x_j - x_i|/|X_j - X_i| - 1 of the pair of particles i and j of output frame f. */
static double elongation(const struct output_frame *f, int64_t i, int64_t j)
{
    double now = 0, first = 0;
    for (int d = 0; d < f->dim; d++) {
        const double xi = (double)f->X[d][j] - f->X[d][i];
        first += square(xi), now += square(xi + ((double)f->u[d][j] - f->u[d][i]));
    }
    return sqrt(now / first) - 1;
}

/* Returns the elongation of the pair of particles i and j along the axes of the lattice, (|x_j - x_i|/|X_j -
 * X_i| - 1) for a pair along an axis. For a diagonal pair it is multiplied by the squared length of the pair
 * in spacings, so that both kinds of pairs across an opening crack count as apart at equal openings. */
static double opening(const struct pairs *p, int64_t i, int64_t j)
{
    double first = 0;
    for (int d = 0; d < p->f->dim; d++) first += square((double)p->f->X[d][j] - p->f->X[d][i]);
    const double own = p->f->spacing ? fmax(p->f->spacing[i], p->f->spacing[j]) : p->spacing;
    return elongation(p->f, i, j) * fmax(first / square(own), 1);
}

/* Returns true if the particles i and j of the output frame p->f belong to one body, none of them has lost more than
 * the share LOOSE of its bonds, and no pre-crack separates them. */
static bool same_side(const struct pairs *p, int64_t i, int64_t j)
{
    return p->f->body[i] == p->f->body[j] && fmaxf(p->f->damage[i], p->f->damage[j]) <= LOOSE &&
           !(p->scene && precracks_cut_bond_between(p->scene->crack, p->scene->cracks, &p->part, i, j));
}

/* Returns true if the neighbours i and j of the output frame p->f are certainly connected: no pre-crack separates
 * them, they belong to one body, and at least one of them has all its bonds. */
static bool surely_connected(const struct pairs *p, int64_t i, int64_t j)
{
    return same_side(p, i, j) && (p->f->damage[i] <= 0 || p->f->damage[j] <= 0);
}

/* Returns the largest elongation |x_j - x_i|/|X_j - X_i| - 1 for which a particle j near particle i of the output frame
 * p->f counts as connected to it: JUMP + JUMP_TIMES * (median elongation of the pairs of i). near: particles near i, of
 * which the first NEAR_MOST are used. */
static double jump_of(const struct pairs *p, const struct neighbour_list *near, int64_t i)
{
    double all[NEAR_MOST];
    int n = 0;
    for (int k = 0; k < near->n && n < NEAR_MOST; k++)
        if (same_side(p, i, near->at[k])) all[n++] = elongation(p->f, i, near->at[k]);
    return n > 0 ? JUMP + JUMP_TIMES * fmax(median_by_sorting(all, n), 0) : JUMP;
}

/* Returns true if the neighbours i and j of the output frame p->f are drawn as connected: they are on one side of all
 * cracks (same_side), and their elongation |x_j - x_i|/|X_j - X_i| - 1 is at most `jump` and at most LONGEST - 1, and,
 * if both have lost bonds, their `opening` is at most p->limit. */
static bool connected(const struct pairs *p, int64_t i, int64_t j, double jump)
{
    const bool whole = p->f->damage[i] <= 0 || p->f->damage[j] <= 0;
    if (elongation(p->f, i, j) > fmin(jump, LONGEST - 1)) return false;
    return (whole || opening(p, i, j) <= p->limit) && same_side(p, i, j);
}

/* Returns the opening above which two neighbours that have both lost bonds are drawn apart. It is PARTED_MORE times the
 * 99th percentile of the openings of neighbours that are certainly connected, and at least PARTED/p->magnify. */
static double parted_limit(const struct pairs *p)
{
    struct neighbour_list near = {0};
    double *sure = NEW("plot.sure", SURE_MOST, double);
    int64_t n = 0;
    const int64_t stride = 8 * p->f->n / SURE_MOST + 1;
    for (int64_t i = 0; i < p->f->n; i += stride) {
        particles_list_neighbours_within_radius(&near, &p->cells, &p->part, i, NEAR_REACH * p->spacing, false);
        for (int k = 0; k < near.n && n < SURE_MOST; k++)
            if (surely_connected(p, i, near.at[k])) sure[n++] = opening(p, i, near.at[k]);
    }
    array_sort(sure, n, sizeof *sure, compare_doubles);
    const double least = PARTED / p->magnify;
    const double limit = n > 0 ? fmax(least, PARTED_MORE * sure[(int64_t)(0.99 * (double)(n - 1))]) : least;
    memory_free(sure);
    memory_free(near.at);
    return limit;
}

/* Returns the bit that denotes the side of a particle on which its neighbour is: 1 << (2 a + b) for axis a, with b = 0
 * towards larger coordinates and b = 1 towards smaller ones; 0 for a diagonal neighbour. xi[3]: reference position of
 * the neighbour relative to the particle [m]; own: spacing of the particle [m]. */
static unsigned side_bit(const double *xi, double own)
{
    unsigned bit = 0;
    int across = 0;
    for (int d = 0; d < 3; d++) {
        if (fabs(xi[d]) < ACROSS * own) continue;
        bit = 1U << (2 * d + (xi[d] < 0)), across++;
    }
    return across == 1 ? bit : 0;
}

/* Returns true if a gap is drawn between the neighbours i and j of output frame p->f, which are not drawn as connected:
 * if none of them has lost more than the fraction LOOSE of its bonds. Between loose particles no gap is drawn. */
static bool gap_between(const struct pairs *p, int64_t i, int64_t j)
{
    return fmaxf(p->f->damage[i], p->f->damage[j]) <= LOOSE;
}

/* Computes the deformation gradient F[9] of particle i of the output frame p->f, rows along x, y, z, as the
 * least-squares fit to its connected neighbours (Silling et al. 2007 with unit weights). Displacements are magnified
 * by p->magnify. In directions that the neighbours do not span, F is the identity. near: work list for neighbours.
 * Returns the bits of the sides on which the neighbour is drawn apart (deformation_gradients_fit_to_displacements). */
static unsigned gradient_of(const struct pairs *p, struct neighbour_list *near, int64_t i, float *F)
{
    unsigned apart = 0;
    const struct output_frame *f = p->f;
    const double own = f->spacing ? f->spacing[i] : p->spacing, open = 0.02 * square(own);
    double K[3][3] = {{open, 0, 0}, {0, open, 0}, {0, 0, open}}, M[3][3] = {{0}}, inverted[3][3];
    particles_list_neighbours_within_radius(near, &p->cells, &p->part, i, fmin(NEAR_REACH * own, p->cells.edge), false);
    const double jump = jump_of(p, near, i);
    for (int k = 0; k < near->n; k++) {
        const int64_t j = near->at[k];
        double xi[3] = {0}, u[3] = {0};
        for (int d = 0; d < f->dim; d++)
            xi[d] = (double)f->X[d][j] - f->X[d][i], u[d] = (double)f->u[d][j] - f->u[d][i];
        if (!connected(p, i, j, jump)) {
            if (gap_between(p, i, j)) apart |= side_bit(xi, own);
            continue;
        }
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) K[a][b] += xi[a] * xi[b], M[a][b] += u[a] * xi[b];
    }
    const bool fits = matrix_invert_3x3((const double(*)[3])K, inverted);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double sum = a == b;
            for (int k = 0; k < 3 && fits; k++) sum += p->magnify * M[a][k] * inverted[k][b];
            F[3 * a + b] = isfinite(sum) ? (float)sum : (float)(a == b);
        }
    return apart;
}

/* Returns true if the displacements in the output frame f differ along one axis by more than STRAIN_SEEN spacings, so
 * that a deformation may be visible. spacing: spacing of the particles [m]. */
static bool may_be_deformed(const struct output_frame *f, double spacing)
{
    double most = 0;
    for (int d = 0; d < f->dim; d++) {
        double least = INFINITY, largest = -INFINITY;
        for (int64_t i = 0; i < f->n; i++) least = fmin(least, f->u[d][i]), largest = fmax(largest, f->u[d][i]);
        most = fmax(most, largest - least);
    }
    return most > STRAIN_SEEN * spacing;
}

float *deformation_gradients_fit_to_displacements(const struct output_frame *f, double spacing,
                                                  double displacement_factor, const struct scene *scene,
                                                  uint8_t *separated_sides)
{
    if (f->dim < 2 || !(spacing > 0) || !may_be_deformed(f, spacing / displacement_factor)) return NULL;
    struct pairs p = {.f = f,
                      .spacing = spacing,
                      .magnify = displacement_factor,
                      .scene = scene,
                      .part = {.n = f->n, .n_all = f->n, .dim = f->dim}};
    float *F = NEW("plot.gradient", 9 * f->n, float);
    for (int d = 0; d < f->dim; d++) {
        p.part.X[d] = NEW("plot.X", f->n, real);
        for (int64_t i = 0; i < f->n; i++) p.part.X[d][i] = f->X[d][i];
    }
    cells_make_for_neighbour_search(&p.cells, &p.part, 2 * NEAR_REACH * spacing);
    p.limit = parted_limit(&p);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t i = 0; i < f->n; i++) separated_sides[i] = (uint8_t)gradient_of(&p, &near, i, F + 9 * i);
        memory_free(near.at);
    }
    cells_free(&p.cells);
    for (int d = 0; d < f->dim; d++) memory_free(p.part.X[d]);
    return F;
}
