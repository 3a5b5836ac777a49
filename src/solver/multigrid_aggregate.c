/* Aggregates of nodes, by the strength of their connections, and their rigid motions. */
#include <math.h>

#include "base/memory.h"
#include "multigrid_parts.h"

/* An entry counts as a connection if its norm is this part of the largest of its two rows, of their geometric mean. */
#define WEAK 0.1

/* Square of the norm of entry q. */
static real entry_square(const struct level *l, int64_t q)
{
    const int size = l->width * l->width;
    real sum = 0;
    if (l->single)
        for (int k = 0; k < size; k++) sum += square((real)l->single[q * size + k]);
    else
        for (int k = 0; k < size; k++) sum += square(l->block[q * size + k]);
    return sum;
}

/* What is to be aggregated. */
struct graph {
    int64_t *first;  /* [n + 1] */
    int32_t *column; /* strong connections, without the node itself */
    float *strength; /* squares of norms */
};

/* Strong connections of free nodes. */
static void graph_make(struct graph *g, const struct level *l)
{
    real *most = NEW("multigrid.strength", l->n, real);
    int32_t *count = NEW("multigrid.strength", l->n, int32_t);
    float *all = BARE("multigrid.strength", l->first[l->n], float);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
            all[q] = (float)entry_square(l, q);
            if (l->column[q] != i) most[i] = real_max(most[i], all[q]);
        }
    for (int pass = 0; pass < 2; pass++) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < l->n; i++) {
            int64_t at = pass ? g->first[i] : 0;
            for (int64_t q = l->first[i]; q < l->first[i + 1] && l->scale[i] > 0; q++) {
                const int64_t j = l->column[q];
                if (j == i || l->scale[j] <= 0 || !(all[q] > 0)) continue;
                if ((real)all[q] < WEAK * WEAK * sqrt(most[i]) * sqrt(most[j])) continue;
                if (pass) g->column[at] = (int32_t)j, g->strength[at] = all[q];
                at++;
            }
            if (!pass) count[i] = (int32_t)at;
        }
        if (pass) break;
        g->first = NEW("multigrid.graph", l->n + 1, int64_t);
        for (int64_t i = 0; i < l->n; i++) g->first[i + 1] = g->first[i] + count[i];
        g->column = BARE("multigrid.graph", g->first[l->n], int32_t);
        g->strength = BARE("multigrid.graph", g->first[l->n], float);
    }
    memory_free(most);
    memory_free(count);
    memory_free(all);
}

static void graph_free(struct graph *g)
{
    memory_free(g->first);
    memory_free(g->column);
    memory_free(g->strength);
}

/* Takes node i and those of its neighbours that are free into a new aggregate. */
static void aggregate_found(struct level *l, const struct graph *g, int64_t i)
{
    const int32_t name = (int32_t)l->coarse++;
    l->aggregate[i] = name;
    for (int64_t q = g->first[i]; q < g->first[i + 1]; q++)
        if (l->aggregate[g->column[q]] < 0) l->aggregate[g->column[q]] = name;
}

static bool neighbours_free(const struct level *l, const struct graph *g, int64_t i)
{
    for (int64_t q = g->first[i]; q < g->first[i + 1]; q++)
        if (l->aggregate[g->column[q]] >= 0) return false;
    return true;
}

/* The aggregate of the neighbours of node i to which it is most strongly connected; -1: there is none. */
static int32_t aggregate_nearest(const struct level *l, const struct graph *g, int64_t i)
{
    enum { CANDIDATES = 16 };
    int32_t name[CANDIDATES], best = -1;
    float sum[CANDIDATES], most = 0;
    int n = 0;
    for (int64_t q = g->first[i]; q < g->first[i + 1]; q++) {
        const int32_t a = l->aggregate[g->column[q]];
        if (a < 0) continue;
        int k = 0;
        while (k < n && name[k] != a) k++;
        if (k == CANDIDATES) continue;
        if (k == n) name[n] = a, sum[n++] = 0;
        sum[k] += g->strength[q];
    }
    for (int k = 0; k < n; k++)
        if (sum[k] > most) most = sum[k], best = name[k];
    return best;
}

void level_aggregate(struct level *l)
{
    struct graph g;
    int32_t *joins = NEW("multigrid.joins", l->n, int32_t);
    graph_make(&g, l);
    l->aggregate = BARE("multigrid.aggregate", l->n, int32_t);
    l->coarse = 0;
    for (int64_t i = 0; i < l->n; i++) l->aggregate[i] = -1;
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] < 0 && g.first[i + 1] > g.first[i] && neighbours_free(l, &g, i)) aggregate_found(l, &g, i);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++) joins[i] = l->aggregate[i] < 0 ? aggregate_nearest(l, &g, i) : l->aggregate[i];
    memcpy(l->aggregate, joins, (size_t)l->n * sizeof *joins);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] < 0 && g.first[i + 1] > g.first[i]) aggregate_found(l, &g, i);
    graph_free(&g);
    memory_free(joins);
}

/* ---- rigid motions ----------------------------------------------------------------------------------------------- */

/* A column of which less than this is left beside the columns before it is dropped: aggregates in a line or of one
 * node have fewer motions. Round-off leaves 1e-16 of it times the size of the body over that of the aggregate. */
#define DROPPED 1e-9

/* Product of columns a and c of the nodes `member`. */
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

/* Orthonormal columns in place of those of an aggregate (Gram-Schmidt, twice); r [m][m]: v = q r. */
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

/* Members of every aggregate: member[first[a]] .. */
static void members_list(const struct level *l, int64_t *first, int32_t *member)
{
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0) first[l->aggregate[i] + 1]++;
    for (int64_t a = 0; a < l->coarse; a++) first[a + 1] += first[a];
    int64_t *at = NEW("multigrid.members", l->coarse + 1, int64_t);
    memcpy(at, first, (size_t)l->coarse * sizeof *at);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0) member[at[l->aggregate[i]]++] = (int32_t)i;
    memory_free(at);
}

void level_modes(struct level *l, struct level *next)
{
    const int w = l->width, m = l->modes;
    int64_t *first = NEW("multigrid.members", l->coarse + 1, int64_t);
    int32_t *member = NEW("multigrid.members", l->n, int32_t);
    members_list(l, first, member);
    next->n = l->coarse, next->width = next->modes = m;
    next->mode = NEW("multigrid.mode", next->n * m * m, real);
    next->scale = NEW("multigrid.scale", next->n, real);
    l->tentative = l->mode, l->mode = NULL;
#pragma omp parallel for schedule(static)
    for (int64_t a = 0; a < next->n; a++) {
        const int64_t n = first[a + 1] - first[a];
        columns_orthonormal(l->tentative, member + first[a], n, w, m, next->mode + a * m * m);
        for (int64_t k = first[a]; k < first[a + 1]; k++) next->scale[a] += l->scale[member[k]] / (real)n;
    }
    memory_free(first);
    memory_free(member);
}
