/* Solves the coarsest level of the multigrid preconditioner by a U^T D U factorisation of its dense matrix. */
#include "base/memory.h"
#include "multigrid_parts.h"

/* Eliminates column j below row j of the symmetric matrix u[n][n]: subtracts multiples of row j from the rows below it.
 * Only the upper triangle is used. inverse: reciprocal of the pivot u[j][j]. */
static void dense_eliminate(real *u, int64_t n, int64_t j, real inverse)
{
    const real *restrict pivot = u + j * n;
    for (int64_t i = j + 1; i < n; i++) {
        const real part = pivot[i] * inverse;
        real *restrict row = u + i * n;
        if (part == 0) continue;
        for (int64_t k = i; k < n; k++) row[k] -= part * pivot[k];
    }
}

void multigrid_factorise_coarsest_matrix(struct dense_factorisation *d, const struct multigrid_level *l)
{
    const int w = l->width;
    const int64_t n = l->n * w;
    *d = (struct dense_factorisation){n, NEW("multigrid.dense", n * n, real), NEW("multigrid.dense", n, real)};
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++)
            for (int k = 0; k < w * w; k++)
                d->upper[(i * w + k / w) * n + l->column[q] * w + k % w] =
                    l->column[q] == i ? l->diagonal[i * w * w + k] : l->block[q * w * w + k];
    for (int64_t j = 0; j < n; j++) {
        const real pivot = d->upper[j * n + j], scale = l->scale[j / w];
        d->inverse[j] =
            scale <= 0 ? 0 : 1 / (pivot > multigrid_relative_zero_pivot_tolerance(l, j / w) * scale ? pivot : scale);
        dense_eliminate(d->upper, n, j, d->inverse[j]);
    }
    for (int64_t j = 0; j < n; j++)
        for (int64_t k = j + 1; k < n; k++) d->upper[j * n + k] *= d->inverse[j];
}

void multigrid_solve_coarsest_level(const struct dense_factorisation *d, const real *load, real *solution)
{
    const int64_t n = d->n;
    array_copy(solution, load, n, sizeof *solution);
    for (int64_t j = 0; j < n; j++) {
        const real *restrict row = d->upper + j * n;
        const real y = solution[j];
        if (y != 0)
            for (int64_t k = j + 1; k < n; k++) solution[k] -= row[k] * y;
        solution[j] = y * d->inverse[j];
    }
    for (int64_t j = n - 1; j >= 0; j--) {
        const real *row = d->upper + j * n;
        real sum[4] = {0};
        int64_t k = j + 1;
        for (; k + 4 <= n; k += 4)
            for (int s = 0; s < 4; s++) sum[s] += row[k + s] * solution[k + s];
        for (; k < n; k++) sum[0] += row[k] * solution[k];
        solution[j] -= (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
}

void multigrid_free_coarsest_factorisation(struct dense_factorisation *d)
{
    memory_free(d->upper);
    memory_free(d->inverse);
}
