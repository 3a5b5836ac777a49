/* Groups nodes into aggregates, the nodes of the coarser level, by the strength of their connections, and computes the
 * rigid motions of the aggregates. */
#include <math.h>

#include "base/memory.h"
#include "multigrid_parts.h"

/* Least size of a matrix entry that counts as a connection of two nodes: ratio of its norm to the geometric mean of the
 * largest norms in its two rows [1]. */
#define WEAK 0.1

/* Returns the Frobenius norm of matrix entry q of level l, a block of l->width rows and columns. */
static float entry_norm(const struct multigrid_level *l, int64_t q)
{
    const int size = l->width * l->width;
    real sum = 0;
    if (l->single)
        for (int k = 0; k < size; k++) sum += square((real)l->single[q * size + k]);
    else
        for (int k = 0; k < size; k++) sum += square(l->block[q * size + k]);
    return (float)sqrt(sum);
}

/* Returns the strength of the connection between two nodes for each matrix entry of level l, an array [l->first[l->n]].
 * It is the norm of the entry, but 0 if the norm is below WEAK times the geometric mean of the largest norms of both
 * nodes, if it is a diagonal entry, or if one of the nodes has no stiffness. The caller frees the array. */
static float *strengths_make(const struct multigrid_level *l)
{
    float *strength = BARE("multigrid.strength", l->first[l->n], float), *most = NEW("multigrid.strength", l->n, float);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
            const int64_t j = l->column[q];
            strength[q] = j == i || l->scale[i] <= 0 || l->scale[j] <= 0 ? 0 : entry_norm(l, q);
            if (strength[q] > most[i]) most[i] = strength[q];
        }
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++)
            if (square((real)strength[q]) < square(WEAK) * most[i] * most[l->column[q]]) strength[q] = 0;
    memory_free(most);
    return strength;
}

/* Makes a new aggregate of node i of level l and those of its strongly connected neighbours that belong to no
 * aggregate. An aggregate is a set of nodes that form one node of the coarser level. strength: strengths of the matrix
 * entries, 0 for weak connections. */
static void aggregate_found(struct multigrid_level *l, const float *strength, int64_t i)
{
    const int32_t name = (int32_t)l->coarse++;
    l->aggregate[i] = name;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++)
        if (strength[q] > 0 && l->aggregate[l->column[q]] < 0) l->aggregate[l->column[q]] = name;
}

/* Returns true if node i of level l has strongly connected neighbours and none of them belongs to an aggregate, a set
 * of nodes that form one node of the coarser level. strength: strengths of the matrix entries, 0 for weak
 * connections. */
static bool neighbours_free(const struct multigrid_level *l, const float *strength, int64_t i)
{
    bool any = false;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        if (!(strength[q] > 0)) continue;
        if (l->aggregate[l->column[q]] >= 0) return false;
        any = true;
    }
    return any;
}

/* Returns the number of the aggregate, among the first CANDIDATES that are connected with node i of level l, whose
 * nodes have the largest sum of connection strengths with the node; -1 if no aggregate is connected with it. An
 * aggregate is a set of nodes that form one node of the coarser level. strength: strengths of the matrix entries, 0 for
 * weak connections. */
static int32_t aggregate_nearest(const struct multigrid_level *l, const float *strength, int64_t i)
{
    enum { CANDIDATES = 16 };
    int32_t name[CANDIDATES], best = -1;
    float sum[CANDIDATES], most = 0;
    int n = 0;
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const int32_t a = l->aggregate[l->column[q]];
        if (a < 0 || !(strength[q] > 0)) continue;
        int k = 0;
        while (k < n && name[k] != a) k++;
        if (k == CANDIDATES) continue;
        if (k == n) name[n] = a, sum[n++] = 0;
        sum[k] += strength[q];
    }
    for (int k = 0; k < n; k++)
        if (sum[k] > most) most = sum[k], best = name[k];
    return best;
}

void multigrid_aggregate_nodes(struct multigrid_level *l)
{
    float *strength = strengths_make(l);
    int32_t *joins = BARE("multigrid.joins", l->n, int32_t);
    l->aggregate = BARE("multigrid.aggregate", l->n, int32_t);
    l->coarse = 0;
    for (int64_t i = 0; i < l->n; i++) l->aggregate[i] = -1;
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] < 0 && neighbours_free(l, strength, i)) aggregate_found(l, strength, i);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        joins[i] = l->aggregate[i] < 0 ? aggregate_nearest(l, strength, i) : l->aggregate[i];
    array_copy(l->aggregate, joins, l->n, sizeof *joins);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] < 0 && neighbours_free(l, strength, i)) aggregate_found(l, strength, i);
    memory_free(strength);
    memory_free(joins);
}

/* ---- rigid motions ----------------------------------------------------------------------------------------------- */

/* Smallest share of its length that a column must retain in orthogonalisation [1]; otherwise the column is set to 0.
 * Columns are the rigid motions of an aggregate (nodes that form one coarser node), which has fewer independent ones if
 * it is a line or a single node. Round-off leaves 1e-16 times the ratio of the size of the body to that of the
 * aggregate. */
#define DROPPED 1e-9

/* Returns the scalar product of columns a and c of the matrix v over the n nodes in `member`. w: rows of v for each
 * node of the level; m: columns of v. */
static real column_dot(const real *v, const int32_t *member, int64_t n, int w, int m, int a, int c)
{
    real sum = 0;
    for (int64_t k = 0; k < n; k++)
        for (int d = 0; d < w; d++) {
            const real *row = v + ((int64_t)member[k] * w + d) * m;
            sum += row[a] * row[c];
        }
    return sum;
}

/* Makes the m columns of the matrix v over the n nodes in `member` orthonormal, in place (Gram-Schmidt, twice). Columns
 * that depend linearly on others, of which a part of at most DROPPED remains, become 0. w: rows of v for each node;
 * r[m][m]: must be 0, receives the factors such that the old v is the new v times r. */
static void columns_orthonormal(real *v, const int32_t *member, int64_t n, int w, int m, real *r)
{
    for (int c = 0; c < m; c++) {
        const real before = sqrt(column_dot(v, member, n, w, m, c, c));
        for (int twice = 0; twice < 2; twice++)
            for (int a = 0; a < c; a++) {
                const real part = column_dot(v, member, n, w, m, a, c);
                r[a * m + c] += part;
                for (int64_t k = 0; k < n; k++)
                    for (int d = 0; d < w; d++) {
                        real *row = v + ((int64_t)member[k] * w + d) * m;
                        row[c] -= part * row[a];
                    }
            }
        const real left = sqrt(column_dot(v, member, n, w, m, c, c));
        const bool kept = left > DROPPED * before;
        if (kept) r[c * m + c] = left;
        for (int64_t k = 0; k < n; k++)
            for (int d = 0; d < w; d++) {
                real *entry = v + ((int64_t)member[k] * w + d) * m + c;
                *entry = kept ? *entry / left : 0;
            }
    }
}

/* Lists the nodes of every aggregate a (set of nodes that form one node of the coarser level) of level l, ascending:
 * member[first[a]] .. member[first[a + 1] - 1]. first: [coarse + 1], 0 on entry; member: [n]. */
static void members_list(const struct multigrid_level *l, int64_t *first, int32_t *member)
{
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0) first[l->aggregate[i] + 1]++;
    for (int64_t a = 0; a < l->coarse; a++) first[a + 1] += first[a];
    int64_t *at = NEW("multigrid.members", l->coarse + 1, int64_t);
    array_copy(at, first, l->coarse, sizeof *at);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0) member[at[l->aggregate[i]]++] = (int32_t)i;
    memory_free(at);
}

void multigrid_compute_coarse_rigid_motions(struct multigrid_level *l, struct multigrid_level *coarser_level)
{
    const int w = l->width, m = l->modes;
    int64_t *first = NEW("multigrid.members", l->coarse + 1, int64_t);
    int32_t *member = NEW("multigrid.members", l->n, int32_t);
    members_list(l, first, member);
    coarser_level->n = l->coarse, coarser_level->width = coarser_level->modes = m;
    coarser_level->mode = NEW("multigrid.mode", coarser_level->n * m * m, real);
    coarser_level->scale = NEW("multigrid.scale", coarser_level->n, real);
    l->tentative = l->mode, l->mode = NULL;
#pragma omp parallel for schedule(static)
    for (int64_t a = 0; a < coarser_level->n; a++) {
        const int64_t n = first[a + 1] - first[a];
        columns_orthonormal(l->tentative, member + first[a], n, w, m, coarser_level->mode + a * m * m);
        for (int64_t k = first[a]; k < first[a + 1]; k++) coarser_level->scale[a] += l->scale[member[k]] / (real)n;
    }
    memory_free(first);
    memory_free(member);
}
