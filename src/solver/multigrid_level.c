/* Computes the inverse diagonal blocks of a multigrid level and the largest eigenvalue of its scaled matrix, and finds
 * unconstrained fragments. */
#include <math.h>

#include "base/eigenvalue.h"
#include "base/memory.h"
#include "base/team.h"
#include "multigrid_parts.h"

/* Computes the inverse of the symmetric block a[w][w] by a U^T D U factorisation, and stores it in `inverse` row by
 * row. held: components that are left out, one bit each; their rows and columns are 0 in the inverse. A pivot below
 * least * scale is replaced by `scale`. */
static void block_invert(const real *a, real *inverse, int w, unsigned held, real least, real scale)
{
    real u[WIDTH_MOST][WIDTH_MOST], pivot[WIDTH_MOST];
    for (int j = 0; j < w; j++)
        for (int k = 0; k < w; k++) u[j][k] = (held >> j & 1) || (held >> k & 1) ? 0 : a[j * w + k];
    for (int j = 0; j < w; j++) {
        pivot[j] = u[j][j] > least * scale ? u[j][j] : scale;
        for (int i = j + 1; i < w; i++)
            for (int k = w - 1; k >= i; k--) u[i][k] -= u[j][i] / pivot[j] * u[j][k];
        for (int k = j + 1; k < w; k++) u[j][k] /= pivot[j];
    }
    for (int c = 0; c < w; c++) {
        real x[WIDTH_MOST] = {0};
        x[c] = 1;
        for (int j = c; j < w; j++) {
            for (int k = j + 1; k < w; k++) x[k] -= u[j][k] * x[j];
            x[j] /= pivot[j];
        }
        for (int j = w - 1; j >= 0; j--)
            for (int k = j + 1; k < w; k++) x[j] -= u[j][k] * x[k];
        for (int j = 0; j < w; j++) inverse[j * w + c] = (held >> j & 1) || (held >> c & 1) ? 0 : x[j];
    }
    for (int j = 0; j < w; j++)
        for (int k = j + 1; k < w; k++) inverse[j * w + k] = inverse[k * w + j];
}

void multigrid_invert_diagonal_blocks(struct multigrid_level *l)
{
    const int size = l->width * l->width;
    l->inverse = NEW("multigrid.inverse", l->n * size, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        if (l->scale[i] > 0)
            block_invert(l->diagonal + i * size, l->inverse + i * size, l->width, l->held ? l->held[i] : 0,
                         multigrid_relative_zero_pivot_tolerance(l, i), l->scale[i]);
}

/* ---- pieces ------------------------------------------------------------------------------------------------------ */

/* Returns true if all components of matrix entry q of the coarse level l (any but the finest) are 0. */
static bool entry_is_zero(const struct multigrid_level *l, int64_t q)
{
    const int size = l->width * l->width;
    for (int k = 0; k < size; k++)
        if (l->block[q * size + k] != 0) return false;
    return true;
}

/* Lists all nodes of level l that are connected with node i, directly or through other nodes, in list[], including i,
 * and sets seen[] to 1 for them. seen, list: [l->n]; seen is 0 for nodes not listed before. Returns the number of nodes
 * listed. */
static int64_t piece_list(const struct multigrid_level *l, int64_t i, uint8_t *seen, int32_t *list)
{
    int64_t n = 0;
    seen[i] = 1, list[n++] = (int32_t)i;
    for (int64_t k = 0; k < n; k++)
        for (int64_t q = l->first[list[k]]; q < l->first[list[k] + 1]; q++) {
            const int32_t j = l->column[q];
            if (seen[j] || entry_is_zero(l, q)) continue;
            seen[j] = 1, list[n++] = j;
        }
    return n;
}

void multigrid_find_unconstrained_coarse_nodes(const struct multigrid_level *l, struct multigrid_level *coarser_level)
{
    coarser_level->unconstrained = NEW("multigrid.unconstrained", coarser_level->n, uint8_t);
    array_fill_bytes(coarser_level->unconstrained, 1, coarser_level->n, 1);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0 && !l->unconstrained[i]) coarser_level->unconstrained[l->aggregate[i]] = 0;
    if (!l->single) return;
    uint8_t *seen = NEW("multigrid.pieces", coarser_level->n, uint8_t);
    int32_t *list = NEW("multigrid.pieces", coarser_level->n, int32_t);
    for (int64_t i = 0; i < coarser_level->n; i++) {
        if (seen[i]) continue;
        const int64_t n = piece_list(coarser_level, i, seen, list);
        uint8_t unconstrained = 1;
        for (int64_t k = 0; k < n; k++) unconstrained &= coarser_level->unconstrained[list[k]];
        for (int64_t k = 0; k < n; k++) coarser_level->unconstrained[list[k]] = unconstrained;
    }
    memory_free(seen);
    memory_free(list);
}

/* ---- the largest eigenvalue -------------------------------------------------------------------------------------- */

/* Number of Lanczos iterations for the largest eigenvalue. They find isolated stiff nodes, for which power iterations
 * would need many more. They underestimate the largest eigenvalue of a lattice by a few percent, which is within the
 * margin of a quarter that relaxation has (RANGE in multigrid.c). */
enum { LANCZOS = 8 };
#define LANCZOS_SHORT 1.05

/* Three vectors a, b, c, of which the scalar products a . b and b . c are computed. */
struct three_vectors {
    const real *a, *b, *c;
};

/* Adds to sum[0] the scalar product a . b and to sum[1] the scalar product b . c of three vectors, over their entries
 * first .. end - 1. context: the vectors (struct three_vectors). Called by reproducible_sums for each block of
 * entries. */
static void three_vectors_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct three_vectors *v = context;
    for (int64_t k = first; k < end; k++) {
        sum[0] += v->a[k] * v->b[k];
        sum[1] += v->b[k] * v->c[k];
    }
}

/* Computes l->d = D^-1 l->t, where D are the diagonal blocks of the matrix of level l. Stores two scalar products of
 * vectors of l: x . t in sum[0] and t . d in sum[1]. */
static void lanczos_scale(struct multigrid_level *l, real *sum)
{
    const int w = l->width;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int a = 0; a < w; a++) {
            real d = 0;
            for (int c = 0; c < w; c++) d += l->inverse[(i * w + a) * w + c] * l->t[i * w + c];
            l->d[i * w + a] = d;
        }
    reproducible_sums(l->n * w, 2, three_vectors_block, &(struct three_vectors){l->x, l->t, l->d}, sum);
}

/* Computes the next Lanczos vector -(d + a x + b y)/length from the vectors d, x and y of level l. It becomes l->x, and
 * the former l->x becomes l->y. a, b: coefficients of the recurrence; length: norm by which the vector is divided. */
static void lanczos_turn(struct multigrid_level *l, real a, real b, real length)
{
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < l->n * l->width; k++) l->y[k] = -(l->d[k] + a * l->x[k] + b * l->y[k]) / length;
    real *x = l->x;
    l->x = l->y, l->y = x;
}

/* Estimates the largest eigenvalue of D^-1 K by LANCZOS steps of the Lanczos method and stores it, multiplied by
 * LANCZOS_SHORT and at least 1, in l->largest. K: matrix of level l; D: its diagonal blocks. The Lanczos vectors x are
 * orthonormal in the product with D, in which D^-1 K is symmetric: x . D D^-1 K x = x . t with t = K x. */
void multigrid_estimate_largest_eigenvalue(struct multigrid_level *l)
{
    real a[LANCZOS], b[LANCZOS + 1] = {0}, sum[2];
    int n = 0;
    for (int64_t k = 0; k < l->n * l->width; k++) {
        const uint32_t mixed = (uint32_t)k * 2654435761u; /* Knuth's multiplicative hash instead of random numbers */
        l->t[k] = (real)((mixed ^ mixed >> 15) & 0xffff) / 65536 - 0.5;
        l->b[k] = l->x[k] = l->y[k] = 0;
    }
    lanczos_scale(l, sum);
    real length = sqrt(sum[1]);
    for (real along = 0; n < LANCZOS && length > 1e-6; n++) {
        lanczos_turn(l, along, n > 1 ? b[n - 2] : 0, length);
        multigrid_compute_residual(l); /* t = -K x, since b is 0 */
        lanczos_scale(l, sum);
        a[n] = along = -sum[0];
        b[n] = length = sqrt(real_max(0, sum[1] - square(a[n]) - (n > 0 ? square(b[n - 1]) : 0)));
    }
    l->largest = n > 0 ? real_max(1, LANCZOS_SHORT * tridiagonal_largest_eigenvalue(a, b, n)) : 1;
}
