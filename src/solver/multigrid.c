/* Builds, applies and frees the multigrid preconditioner. */
#include "solver/multigrid.h"

#include <math.h>

#include "base/memory.h"
#include "multigrid_parts.h"

/* DENSE: a level with fewer unknowns is solved as a dense matrix. DEGREE: steps of relaxation before and after the
 * correction by coarser levels, on the finest level (0), where products with the matrix take most of the time.
 * DEGREE_COARSE: such steps on other levels. RANGE: ratio of the largest to the smallest eigenvalue that relaxation
 * damps. */
enum { DENSE = 700, DEGREE = 1, DEGREE_COARSE = 2 };
#define RANGE 4.0

/* ---- the finest level -------------------------------------------------------------------------------------------- */

/* Largest sum of the blocks of a matrix row, divided by its diagonal, that counts as round-off. Without round-off the
 * sum is 0 in rows without supports. */
#define ROUND_OFF 1e-6
/* Least ratio of the diagonal entry of a node to the largest one [1]; a node with a smaller ratio has no stiffness. */
#define STIFFNESS_LEAST 1e-12

/* Computes the diagonal block of row i (one node) on the finest level l. A rigid translation causes no bond forces, so
 * the block should equal minus the sum of the other blocks of the row; it is set to this sum if the two differ by at
 * most ROUND_OFF times the trace of the block. A larger difference is the stiffness of supports and foundations and is
 * stored in l->rest. Also sets l->scale (mean diagonal entry) and l->unconstrained of the row. */
static void diagonal_exact(const struct multigrid_level *l, int64_t i)
{
    const int size = l->width * l->width;
    real sum[9] = {0}, own[9] = {0}, trace = 0;
    l->unconstrained[i] = 1;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        if (l->held[l->column[q]] != 0) l->unconstrained[i] = 0;
        for (int k = 0; k < size; k++) *(l->column[q] == i ? own + k : sum + k) += (real)l->single[q * size + k];
    }
    for (int k = 0; k < size; k += l->width + 1) trace += own[k];
    for (int k = 0; k < size; k++) {
        const real rest = own[k] + sum[k];
        const bool rounding = fabs(rest) <= ROUND_OFF * trace;
        l->diagonal[i * size + k] = rounding ? -sum[k] : own[k];
        l->rest[i * size + k] = rounding ? 0 : (float)rest;
        if (!rounding) l->unconstrained[i] = 0;
    }
    l->scale[i] = trace / l->width;
}

/* Initialises the finest level l from the matrix a, which is kept by reference and must outlive l. held[i]: bit d is
 * set if component d of node i is constrained. Returns FAILED, with a message, if a diagonal stiffness is negative or
 * not finite. */
static status finest_make(struct multigrid_level *l, const struct block_matrix *a, const uint8_t *held)
{
    const unsigned all = (1u << a->dim) - 1;
    real most = 0;
    *l = (struct multigrid_level){.width = a->dim, .modes = a->dim * (a->dim + 1) / 2, .n = a->n};
    l->first = a->first, l->column = a->column, l->single = a->block;
    l->diagonal = NEW("multigrid.diagonal", l->n * a->dim * a->dim, real);
    l->rest = NEW("multigrid.rest", l->n * a->dim * a->dim, float);
    l->scale = NEW("multigrid.scale", l->n, real);
    l->unconstrained = NEW("multigrid.unconstrained", l->n, uint8_t);
    l->held = NEW("multigrid.held", l->n, uint8_t);
    array_copy(l->held, held, l->n, 1);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++) diagonal_exact(l, i);
    for (int64_t i = 0; i < l->n; i++) {
        if (!(l->scale[i] >= 0) || isinf(l->scale[i]))
            return status_set(FAILED,
                              "multigrid: the stiffness of node %lld is %g N/m, but must not be negative; check the "
                              "materials, and please report the scene",
                              (long long)i, l->scale[i]);
        most = real_max(most, l->scale[i]);
    }
    for (int64_t i = 0; i < l->n; i++)
        if (l->scale[i] <= STIFFNESS_LEAST * most || (held[i] & all) == all) l->scale[i] = 0;
    multigrid_invert_diagonal_blocks(l);
    return OK;
}

/* Computes l->mode, the rigid-body motions of the nodes of the finest level: the displacement of each node in a unit
 * translation along each axis, then in a rotation by a unit angle about the centre of the nodes. Displacements of
 * constrained components are 0. position[width][n]: positions of the nodes [m]. */
static void finest_modes(struct multigrid_level *l, real *const *position)
{
    const int w = l->width, m = l->modes;
    real middle[DIM_MAX] = {0};
    for (int d = 0; d < w; d++) {
        for (int64_t i = 0; i < l->n; i++) middle[d] += position[d][i];
        middle[d] /= (real)(l->n > 0 ? l->n : 1);
    }
    l->mode = NEW("multigrid.mode", l->n * w * m, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++) {
        real *mode = l->mode + i * w * m;
        for (int d = 0; d < w; d++) mode[d * m + d] = 1;
        for (int r = 0; r < m - w; r++) {
            const int a = w == 2 ? 0 : (r + 1) % 3, b = w == 2 ? 1 : (r + 2) % 3;
            mode[a * m + w + r] = -(position[b][i] - middle[b]);
            mode[b * m + w + r] = position[a][i] - middle[a];
        }
        for (int d = 0; d < w; d++)
            for (int e = 0; e < m; e++)
                if (l->held[i] >> d & 1) mode[d * m + e] = 0;
    }
}

/* ---- all levels -------------------------------------------------------------------------------------------------- */

/* Allocates the vectors (load, solution, residual and working memory) of level l; level_free frees them. */
static void level_vectors(struct multigrid_level *l)
{
    real **vector[] = {&l->b, &l->x, &l->y, &l->d, &l->t};
    for (size_t k = 0; k < COUNT_OF(vector); k++) *vector[k] = NEW("multigrid.vector", l->n * l->width, real);
}

/* Copies the diagonal blocks of coarse level l (any but the finest) from its matrix to l->diagonal, and inverts
 * them. */
static void coarse_diagonal(struct multigrid_level *l)
{
    const int size = l->width * l->width;
    l->diagonal = NEW("multigrid.diagonal", l->n * size, real);
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++)
            if (l->column[q] == i) array_copy(l->diagonal + i * size, l->block + q * size, size, sizeof(real));
    multigrid_invert_diagonal_blocks(l);
}

/* Builds the next coarser level of m. Returns false, and builds none, if it would have no node, or more than 0.7 times
 * as many as the coarsest level so far. */
static bool coarsen(struct multigrid *m)
{
    struct multigrid_level *l = &m->level[m->levels - 1], *next = l + 1;
    multigrid_aggregate_nodes(l);
    if (l->coarse == 0 || l->coarse > 0.7 * (real)l->n) return false;
    *next = (struct multigrid_level){0};
    multigrid_compute_coarse_rigid_motions(l, next);
    multigrid_compute_prolongation_and_restriction(l);
    multigrid_compute_coarse_matrix(l, next);
    multigrid_find_unconstrained_coarse_nodes(l, next);
    coarse_diagonal(next);
    level_vectors(next);
    multigrid_estimate_largest_eigenvalue(next);
    m->levels++;
    return true;
}

status multigrid_make(struct multigrid **out, const struct block_matrix *matrix, real *const *position,
                      const uint8_t *constrained)
{
    struct multigrid *m = *out = NEW("multigrid", 1, struct multigrid);
    m->levels = 1;
    const status made = finest_make(&m->level[0], matrix, constrained);
    if (made != OK) {
        multigrid_free(m);
        *out = NULL;
        return made;
    }
    finest_modes(&m->level[0], position);
    level_vectors(&m->level[0]);
    multigrid_estimate_largest_eigenvalue(&m->level[0]);
    while (m->levels < MULTIGRID_LEVELS_MOST) {
        const struct multigrid_level *l = &m->level[m->levels - 1];
        if (m->levels > 1 && l->n * l->width <= DENSE) break;
        if (!coarsen(m)) break;
    }
    const struct multigrid_level *last = &m->level[m->levels - 1];
    if (m->levels > 1 && last->n * last->width <= 4 * DENSE) multigrid_factorise_coarsest_matrix(&m->dense, last);
    return OK;
}

/* Frees the arrays of level l, except the matrix that the finest level has by reference. */
static void level_free(struct multigrid_level *l)
{
    void *owned[] = {
        l->rest,      l->unconstrained, l->block,     l->diagonal,   l->inverse,     l->scale,      l->held,
        l->mode,      l->aggregate,     l->tentative, l->down.first, l->down.column, l->down.block, l->up.first,
        l->up.column, l->up.block,      l->b,         l->x,          l->y,           l->d,          l->t};
    for (size_t k = 0; k < COUNT_OF(owned); k++) memory_free(owned[k]);
    if (l->single) return;
    memory_free((void *)l->first);
    memory_free((void *)l->column);
}

void multigrid_free(struct multigrid *m)
{
    if (m == NULL) return;
    for (int k = 0; k < m->levels; k++) level_free(&m->level[k]);
    multigrid_free_coarsest_factorisation(&m->dense);
    memory_free(m);
}

/* ---- the cycle --------------------------------------------------------------------------------------------------- */

/* Relaxes K x = b on level l by `degree` steps with the Chebyshev polynomial that is small between l->largest/RANGE and
 * l->largest, the largest eigenvalue (Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1). K, b, x:
 * matrix, load and solution of the level. zero: true if x is 0 on entry. */
static void level_smooth(struct multigrid_level *l, int degree, bool zero)
{
    const real theta = 0.5 * l->largest * (1 + 1 / RANGE), delta = 0.5 * l->largest * (1 - 1 / RANGE);
    const real sigma = theta / delta;
    real rho = 1 / sigma;
    multigrid_apply_polynomial_smoother_step(l, 0, 1 / theta, zero);
    for (int k = 1; k < degree; k++) {
        const real next = 1 / (2 * sigma - rho);
        multigrid_apply_polynomial_smoother_step(l, next * rho, 2 * next / delta, false);
        rho = next;
    }
}

/* Solves K x = b on level k of m (0: finest) approximately by a V-cycle over this and the coarser levels. b and x are
 * the load and the solution of the level; x is overwritten. */
static void cycle(struct multigrid *m, int k)
{
    struct multigrid_level *l = &m->level[k];
    if (k == m->levels - 1 && m->dense.n > 0) {
        multigrid_solve_coarsest_level(&m->dense, l->b, l->x);
        return;
    }
    const int degree = k == 0 ? DEGREE : DEGREE_COARSE;
    level_smooth(l, degree, true);
    if (k < m->levels - 1) {
        multigrid_compute_residual(l);
        multigrid_restrict_residual(l, l + 1);
        cycle(m, k + 1);
        multigrid_prolong_correction(l, l + 1);
    }
    level_smooth(l, degree, false);
}

void multigrid_apply_v_cycle(struct multigrid *m, real *const *residual, real *const *result)
{
    struct multigrid_level *l = &m->level[0];
    const int w = l->width;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int d = 0; d < w; d++) l->b[i * w + d] = residual[d][i];
    cycle(m, 0);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int d = 0; d < w; d++) result[d][i] = l->x[i * w + d];
}
