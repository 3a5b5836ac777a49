/* Diagonals of a level, their inverses, and the largest eigenvalue of the scaled matrix. */
#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "multigrid_parts.h"

/* Inverse of the symmetric block a [w][w], of components that `held` does not name, by U'DU; a pivot below least x
 * scale becomes `scale`. */
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

void level_invert(struct level *l)
{
    const int size = l->width * l->width;
    l->inverse = NEW("multigrid.inverse", l->n * size, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < l->n; i++)
        if (l->scale[i] > 0)
            block_invert(l->diagonal + i * size, l->inverse + i * size, l->width, l->held ? l->held[i] : 0,
                         pivot_least(l, i), l->scale[i]);
}

/* ---- pieces ------------------------------------------------------------------------------------------------------ */

static bool entry_is_zero(const struct level *l, int64_t q)
{
    const int size = l->width * l->width;
    for (int k = 0; k < size; k++)
        if (l->block[q * size + k] != 0) return false;
    return true;
}

/* Nodes of the piece of node i into list[0..n-1], marked as seen; returns n. */
static int64_t piece_list(const struct level *l, int64_t i, uint8_t *seen, int32_t *list)
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

void level_loose(const struct level *l, struct level *next)
{
    next->loose = NEW("multigrid.loose", next->n, uint8_t);
    memset(next->loose, 1, (size_t)next->n);
    for (int64_t i = 0; i < l->n; i++)
        if (l->aggregate[i] >= 0 && !l->loose[i]) next->loose[l->aggregate[i]] = 0;
    if (!l->single) return;
    uint8_t *seen = NEW("multigrid.pieces", next->n, uint8_t);
    int32_t *list = NEW("multigrid.pieces", next->n, int32_t);
    for (int64_t i = 0; i < next->n; i++) {
        if (seen[i]) continue;
        const int64_t n = piece_list(next, i, seen, list);
        uint8_t loose = 1;
        for (int64_t k = 0; k < n; k++) loose &= next->loose[list[k]];
        for (int64_t k = 0; k < n; k++) next->loose[list[k]] = loose;
    }
    memory_free(seen);
    memory_free(list);
}

/* ---- the largest eigenvalue -------------------------------------------------------------------------------------- */

/* Powers reach a tenth below the largest eigenvalue; the relaxation allows for as much above it. */
enum { POWERS = 8 };
#define POWERS_SHORT 1.1

/* sum[0]: d . t. */
static void power_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct level *l = context;
    for (int64_t k = first; k < end; k++) sum[0] += l->d[k] * l->t[k];
}

/* With b = 0, d = D^-1 (K x) and t = K x, x . K x over x . D x is the quotient of Rayleigh, where x . D x = d . t of
 * the step before. */
void level_largest(struct level *l)
{
    const int w = l->width;
    real quotient = 1, size = 0;
    for (int64_t k = 0; k < l->n * w; k++) {
        const uint32_t mixed = (uint32_t)k * 2654435761u; /* Knuth's multiplicative hash, in place of random numbers */
        l->d[k] = (real)((mixed ^ mixed >> 15) & 0xffff) / 65536 - 0.5;
        l->b[k] = 0;
    }
    for (int step = 0; step <= POWERS; step++) {
        real sum;
        const real scale = size > 0 ? 1 / sqrt(size) : 1;
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < l->n; i++)
            for (int a = 0; a < w; a++)
                l->x[i * w + a] = l->scale[i] > 0 && !(l->held && l->held[i] >> a & 1) ? l->d[i * w + a] * scale : 0;
        level_residual(l);
        if (step > 1) {
            const real *d = l->d;
            l->d = l->x;
            team_sums(l->n * w, 1, power_block, l, &sum);
            l->d = (real *)d;
            quotient = -sum;
        }
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < l->n; i++)
            for (int a = 0; a < w; a++) {
                real d = 0;
                for (int c = 0; c < w; c++) d += l->inverse[(i * w + a) * w + c] * l->t[i * w + c];
                l->d[i * w + a] = d;
            }
        team_sums(l->n * w, 1, power_block, l, &size);
    }
    l->largest = real_max(1, quotient * POWERS_SHORT);
}
