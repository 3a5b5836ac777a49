/* Computes the smoothed prolongation from a coarser multigrid level, and its transpose, the restriction. */
#include "base/memory.h"
#include "multigrid_parts.h"

/* ---- pattern ----------------------------------------------------------------------------------------------------- */

/* Inserts `value` into list[], which has *n ascending values, and counts it in *n, unless the list contains it. The
 * list must have room for one more value. */
static void sorted_add(int32_t *list, int *n, int32_t value)
{
    int k = *n;
    while (k > 0 && list[k - 1] > value) k--;
    if (k > 0 && list[k - 1] == value) return;
    array_copy(list + k + 1, list + k, *n - k, sizeof *list);
    list[k] = value, ++*n;
}

/* Stores in list[], ascending, the numbers of the aggregates to which node i of level l and its neighbours belong. An
 * aggregate is a set of nodes that form one node of the coarser level. Returns the number of entries, 0 if node i has
 * no stiffness. list must have room for the node and its neighbours. */
static int row_aggregates(const struct multigrid_level *l, int64_t i, int32_t *list)
{
    int n = 0;
    if (l->scale[i] > 0)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++)
            if (l->aggregate[l->column[q]] >= 0) sorted_add(list, &n, l->aggregate[l->column[q]]);
    return n;
}

/* Determines which nodes of the coarser level, aggregates of nodes of level l, each node of level l depends on:
 * computes the arrays `first` and `column` of the prolongation l->down. Its blocks are not allocated. */
static void down_pattern(struct multigrid_level *l)
{
    int32_t *list = BARE("multigrid.pattern", l->first[l->n], int32_t);
    struct transfer *p = &l->down;
    p->first = NEW("multigrid.down", l->n + 1, int64_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++) p->first[i + 1] = row_aggregates(l, i, list + l->first[i]);
    for (int64_t i = 0; i < l->n; i++) p->first[i + 1] += p->first[i];
    p->column = BARE("multigrid.down", p->first[l->n], int32_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        array_copy(p->column + p->first[i], list + l->first[i], p->first[i + 1] - p->first[i], sizeof *list);
    memory_free(list);
}

/* ---- entries ----------------------------------------------------------------------------------------------------- */

enum { BLOCK_MOST = WIDTH_MOST * WIDTH_MOST, AT_ONCE = 16 };

/* Computes force[k][w][m]: the product of row i of the matrix of level l with the rigid motions of the aggregate
 * name[k], for k < n. An aggregate is a set of nodes that form one node of the coarser level; its m rigid motions are
 * columns of the prolongation before smoothing. w, m: components per node of this and of the coarser level,
 * compile-time constants. */
static ALWAYS_INLINE void down_forces(const struct multigrid_level *l, int64_t i, const int32_t *name, int n,
                                      real *force, const int w, const int m)
{
    array_fill_bytes(force, 0, n * w * m, sizeof *force);
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const int64_t j = l->column[q];
        int k = 0;
        while (k < n && name[k] != l->aggregate[j]) k++;
        if (k == n) continue;
        real entry[BLOCK_MOST];
        multigrid_copy_matrix_block(l, i, q, w, entry);
        const real *motion = l->tentative + j * w * m;
        for (int a = 0; a < w; a++)
            for (int c = 0; c < w; c++)
                for (int e = 0; e < m; e++) force[(k * w + a) * m + e] += entry[a * w + c] * motion[c * m + e];
    }
}

/* Computes row i of the prolongation l->down = R - step D^-1 K R, in which the rigid motions R of the aggregates are
 * smoothed. An aggregate is a set of nodes that form one node of the coarser level. K, D: matrix of level l and its
 * diagonal blocks. w, m: components per node of this and of the coarser level, compile-time constants. */
static ALWAYS_INLINE void down_row(const struct multigrid_level *l, int64_t i, real step, const int w, const int m)
{
    const struct transfer *p = &l->down;
    real force[AT_ONCE * BLOCK_MOST];
    for (int64_t q = p->first[i]; q < p->first[i + 1]; q += AT_ONCE) {
        const int n = (int)(p->first[i + 1] - q < AT_ONCE ? p->first[i + 1] - q : AT_ONCE);
        down_forces(l, i, p->column + q, n, force, w, m);
        for (int k = 0; k < n; k++)
            for (int a = 0; a < w; a++)
                for (int e = 0; e < m; e++) {
                    real v = l->aggregate[i] == p->column[q + k] ? l->tentative[(i * w + a) * m + e] : 0;
                    for (int c = 0; c < w; c++)
                        v -= step * l->inverse[(i * w + a) * w + c] * force[(k * w + c) * m + e];
                    p->block[((q + k) * w + a) * m + e] = (float)v;
                }
    }
}

/* Computes *up, the transpose of the prolongation p of level l (from the coarser level to l), and allocates its
 * arrays. */
static void transfer_transpose(const struct multigrid_level *l, const struct transfer *p, struct transfer *up)
{
    const int w = l->width, m = l->modes;
    up->first = NEW("multigrid.up", l->coarse + 1, int64_t);
    up->column = BARE("multigrid.up", p->first[l->n], int32_t);
    up->block = BARE("multigrid.up", p->first[l->n] * w * m, float);
    int64_t *at = NEW("multigrid.up", l->coarse + 1, int64_t);
    int64_t *from = BARE("multigrid.up", p->first[l->n], int64_t);
    for (int64_t q = 0; q < p->first[l->n]; q++) up->first[p->column[q] + 1]++;
    for (int64_t a = 0; a < l->coarse; a++) up->first[a + 1] += up->first[a];
    array_copy(at, up->first, l->coarse, sizeof *at);
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = p->first[i]; q < p->first[i + 1]; q++) {
            const int64_t k = at[p->column[q]]++;
            up->column[k] = (int32_t)i, from[k] = q;
        }
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < p->first[l->n]; k++)
        for (int a = 0; a < w; a++)
            for (int e = 0; e < m; e++) up->block[(k * m + e) * w + a] = p->block[(from[k] * w + a) * m + e];
    memory_free(at);
    memory_free(from);
}

void multigrid_compute_prolongation_and_restriction(struct multigrid_level *l)
{
    const real step = 4 / (3 * l->largest);
    down_pattern(l);
    l->down.block = BARE("multigrid.down", l->down.first[l->n] * l->width * l->modes, float);
    BY_WIDTHS(l->n, down_row, l, i, step);
    transfer_transpose(l, &l->down, &l->up);
}
