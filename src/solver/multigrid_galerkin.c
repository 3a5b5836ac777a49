/* Computes the matrix of a coarser multigrid level: restriction (`up`) x matrix x prolongation (`down`), in slabs of
 * consecutive rows, so that the product matrix x down is never stored as a whole. Each row of a product is computed by
 * one thread, which adds its terms in ascending order, so that results do not depend on the number of threads. */
#include <omp.h>
#include <stdlib.h>

#include "base/memory.h"
#include "multigrid_parts.h"

enum { SLAB = 4096 };

/* Pattern of a sparse matrix: the columns of row i are column[first[i]] .. column[first[i + 1] - 1]. */
struct pattern {
    int64_t *first;
    int32_t *column;
};

/* Working memory of the threads: for each thread a table where[n] with one entry per column. In general an entry is the
 * position of the column in the list of the present row, valid only for columns of this row. In product_row it is the
 * last row in which the column occurred. */
struct tables {
    int64_t n;
    int32_t *where;
};

/* Returns the calling thread's own table in t, an array of t->n entries. */
static int32_t *table_own(const struct tables *t) { return t->where + omp_get_thread_num() * t->n; }

/* The product of matrix and prolongation (matrix l->down). Its pattern is stored for all rows, its values only for one
 * slab (set of successive rows) at a time. l, next: this and the coarser level; tables: working memory of the
 * threads. */
struct product {
    const struct multigrid_level *l;
    struct multigrid_level *next;
    struct tables tables;
    struct pattern product; /* of matrix x down */
    int64_t *cursor;        /* [coarse] first entry of each row of `up` that is not yet added */
    real *block;            /* blocks of the slab */
    int64_t first, end;     /* rows of the slab */
};

/* ---- patterns ---------------------------------------------------------------------------------------------------- */

/* Compares the numbers *a and *b of columns of a matrix, for sorting: returns -1, 0 or 1. */
static int compare_columns(const void *a, const void *b)
{
    const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

/* Finds the columns of row i of the product of two sparse matrices a and b, given by their patterns: row k of a has the
 * columns a_column[a_first[k]] to a_column[a_first[k + 1] - 1], likewise for b (b_first, b_column). where: table of the
 * calling thread, with entry i for a column that has been found; list: receives the columns in ascending order, NULL:
 * they are only counted. Returns the number of columns. */
static int64_t product_row(const int64_t *a_first, const int32_t *a_column, const int64_t *b_first,
                           const int32_t *b_column, int64_t i, int32_t *where, int32_t *list)
{
    int64_t n = 0;
    for (int64_t q = a_first[i]; q < a_first[i + 1]; q++)
        for (int64_t p = b_first[a_column[q]]; p < b_first[a_column[q] + 1]; p++) {
            const int32_t c = b_column[p];
            if (where[c] == (int32_t)i) continue;
            where[c] = (int32_t)i;
            if (list) list[n] = c;
            n++;
        }
    if (list) array_sort(list, n, sizeof *list, compare_columns);
    return n;
}

/* Computes *out, the pattern of the product of two sparse matrices a (n rows) and b, given by their patterns: row k of
 * a has the columns a_column[a_first[k]] to a_column[a_first[k + 1] - 1], likewise for b (b_first, b_column). The
 * columns of a row are ascending. Allocates the arrays of *out. t: a table for each thread, with one entry for each
 * column of b. */
static void pattern_make(struct pattern *out, int64_t n, const int64_t *a_first, const int32_t *a_column,
                         const int64_t *b_first, const int32_t *b_column, const struct tables *t)
{
    out->first = NEW("multigrid.pattern", n + 1, int64_t);
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t k = 0; k < t->n * omp_get_max_threads(); k++) t->where[k] = -1;
#pragma omp parallel for schedule(dynamic, 256)
        for (int64_t i = 0; i < n; i++) {
            int32_t *list = pass ? out->column + out->first[i] : NULL;
            const int64_t found = product_row(a_first, a_column, b_first, b_column, i, table_own(t), list);
            if (!pass) out->first[i + 1] = found;
        }
        if (pass) break;
        for (int64_t i = 0; i < n; i++) out->first[i + 1] += out->first[i];
        out->column = BARE("multigrid.pattern", out->first[n], int32_t);
    }
}

/* ---- entries ----------------------------------------------------------------------------------------------------- */

/* Computes out += a b for the row-major blocks a[r][k], b[k][c] and out[r][c]. r, k and c must be compile-time
 * constants. */
static ALWAYS_INLINE void block_add(real *restrict out, const real *restrict a, const real *restrict b, const int r,
                                    const int k, const int c)
{
    for (int x = 0; x < r; x++) {
        if (c == 6) {
            pair sum[3];
            for (int z = 0; z < 3; z++) sum[z] = lane_pair_load(out + x * c + 2 * z);
            for (int y = 0; y < k; y++)
                for (int z = 0; z < 3; z++) sum[z] += a[x * k + y] * lane_pair_load(b + y * c + 2 * z);
            for (int z = 0; z < 3; z++) memcpy(out + x * c + 2 * z, &sum[z], sizeof sum[z]);
        } else
            for (int y = 0; y < k; y++)
                for (int z = 0; z < c; z++) out[x * c + z] += a[x * k + y] * b[y * c + z];
    }
}

/* Computes row i of the product A P of the matrix A and the prolongation P of level p->l (from the coarser level to
 * it). Stores it in p->block, which holds some consecutive rows of the product at a time, a slab. w, m: components per
 * node of this and of the coarser level, compile-time constants. */
static ALWAYS_INLINE void slab_row(const struct product *p, int64_t i, const int w, const int m)
{
    const struct multigrid_level *l = p->l;
    const struct transfer *down = &l->down;
    const struct pattern *to = &p->product;
    int32_t *where = table_own(&p->tables);
    real *row = p->block + (to->first[i] - to->first[p->first]) * w * m;
    for (int64_t k = to->first[i]; k < to->first[i + 1]; k++) where[to->column[k]] = (int32_t)(k - to->first[i]);
    array_fill_bytes(row, 0, (to->first[i + 1] - to->first[i]) * w * m, sizeof *row);
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const int64_t j = l->column[q];
        real a[WIDTH_MOST * WIDTH_MOST];
        multigrid_copy_matrix_block(l, i, q, w, a);
        for (int64_t s = down->first[j]; s < down->first[j + 1]; s++) {
            real motion[WIDTH_MOST * WIDTH_MOST];
            for (int k = 0; k < w * m; k++) motion[k] = down->block[s * w * m + k];
            block_add(row + where[down->column[s]] * w * m, a, motion, w, w, m);
        }
    }
}

/* Adds to row c of the coarser matrix P^T A P the contributions of the rows p->first .. p->end - 1 of the product A P
 * of matrix and prolongation, which are in p->block. w, m: components per node of this and of the coarser level,
 * compile-time constants. */
static ALWAYS_INLINE void slab_add(const struct product *p, int64_t c, const int w, const int m)
{
    const struct transfer *up = &p->l->up;
    const struct multigrid_level *next = p->next;
    int32_t *where = table_own(&p->tables);
    int64_t q = p->cursor[c];
    if (q >= up->first[c + 1] || up->column[q] >= p->end) return;
    for (int64_t k = next->first[c]; k < next->first[c + 1]; k++)
        where[next->column[k]] = (int32_t)(k - next->first[c]);
    for (; q < up->first[c + 1] && up->column[q] < p->end; q++) {
        const int64_t i = up->column[q], base = p->product.first[p->first];
        real t[WIDTH_MOST * WIDTH_MOST];
        for (int k = 0; k < m * w; k++) t[k] = up->block[q * m * w + k];
        for (int64_t s = p->product.first[i]; s < p->product.first[i + 1]; s++) {
            real *out = next->block + (next->first[c] + where[p->product.column[s]]) * m * m;
            block_add(out, t, p->block + (s - base) * w * m, m, w, m);
        }
    }
    p->cursor[c] = q;
}

#define SLABS(W, M)                                                                                                    \
    do {                                                                                                               \
        _Pragma("omp parallel")                                                                                        \
        {                                                                                                              \
            _Pragma("omp for schedule(dynamic, 64)") for (int64_t i = p->first; i < p->end; i++) slab_row(p, i, W, M); \
            _Pragma("omp for schedule(dynamic, 64)") for (int64_t c = 0; c < p->next->n; c++) slab_add(p, c, W, M);    \
        }                                                                                                              \
    } while (0)

/* Computes the rows p->first .. p->end - 1 of the product A P of matrix and prolongation, and adds their contributions
 * to the coarser matrix P^T A P. For speed there is a copy of the code for each combination of components per node. */
static void slab_product(const struct product *p)
{
    const int kind = 10 * p->l->width + p->l->modes;
    if (kind == 11)
        SLABS(1, 1);
    else if (kind == 23)
        SLABS(2, 3);
    else if (kind == 36)
        SLABS(3, 6);
    else if (kind == 33)
        SLABS(3, 3);
    else
        SLABS(6, 6);
}

/* Returns the largest number of blocks in SLAB consecutive rows of the product A P of matrix and prolongation of p. As
 * many blocks must fit into the memory for these rows. */
static int64_t slab_largest(const struct product *p)
{
    int64_t most = 0;
    for (int64_t i = 0; i < p->l->n; i += SLAB) {
        const int64_t end = i + SLAB < p->l->n ? i + SLAB : p->l->n;
        const int64_t entries = p->product.first[end] - p->product.first[i];
        if (entries > most) most = entries;
    }
    return most;
}

void multigrid_compute_coarse_matrix(const struct multigrid_level *l, struct multigrid_level *coarser_level)
{
    struct product p = {.l = l, .next = coarser_level};
    struct pattern coarse;
    p.tables = (struct tables){l->coarse, BARE("multigrid.tables", l->coarse * omp_get_max_threads(), int32_t)};
    pattern_make(&p.product, l->n, l->first, l->column, l->down.first, l->down.column, &p.tables);
    pattern_make(&coarse, l->coarse, l->up.first, l->up.column, p.product.first, p.product.column, &p.tables);
    coarser_level->first = coarse.first, coarser_level->column = coarse.column;
    coarser_level->block = NEW("multigrid.block", coarse.first[l->coarse] * l->modes * l->modes, real);
    p.block = BARE("multigrid.slab", slab_largest(&p) * l->width * l->modes, real);
    p.cursor = BARE("multigrid.cursor", l->coarse, int64_t);
    array_copy(p.cursor, l->up.first, l->coarse, sizeof *p.cursor);
    for (p.first = 0; p.first < l->n; p.first = p.end) {
        p.end = p.first + SLAB < l->n ? p.first + SLAB : l->n;
        slab_product(&p);
    }
    memory_free(p.tables.where);
    memory_free(p.product.first);
    memory_free(p.product.column);
    memory_free(p.cursor);
    memory_free(p.block);
}
