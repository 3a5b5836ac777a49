/* Sweeps over the rows of a level: residuals, relaxation, motion to the next level and back. A row has one writer. */
#include "multigrid_parts.h"

/* sum[0..w-1] -= (K x) of row i. */
static ALWAYS_INLINE void row_times(const struct level *l, int64_t i, const real *x, real *sum, const int w,
                                    const bool single)
{
    const real *own = x + i * w;
    for (int a = 0; a < w && single; a++)
        for (int c = 0; c < w; c++) sum[a] -= (real)l->rounding[(i * w + a) * w + c] * own[c];
    for (int64_t q = l->first[i]; q < l->first[i + 1]; q++) {
        const real *v = x + (int64_t)l->column[q] * w;
        for (int a = 0; a < w; a++)
            for (int c = 0; c < w; c++)
                sum[a] -= (single ? (real)l->single[q * w * w + a * w + c] : l->block[q * w * w + a * w + c]) * v[c];
    }
}

static ALWAYS_INLINE void row_residual(const struct level *l, int64_t i, const int w, const bool single)
{
    real sum[WIDTH_MOST];
    for (int a = 0; a < w; a++) sum[a] = l->b[i * w + a];
    row_times(l, i, l->x, sum, w, single);
    for (int a = 0; a < w; a++) l->t[i * w + a] = sum[a];
}

static ALWAYS_INLINE void row_relax(const struct level *l, int64_t i, real keep, real step, bool zero, const int w,
                                    const bool single)
{
    real sum[WIDTH_MOST];
    for (int a = 0; a < w; a++) sum[a] = l->b[i * w + a];
    if (!zero) row_times(l, i, l->x, sum, w, single);
    for (int a = 0; a < w; a++) {
        real d = zero ? 0 : keep * l->d[i * w + a];
        for (int c = 0; c < w; c++) d += step * l->inverse[(i * w + a) * w + c] * sum[c];
        l->d[i * w + a] = d;
        l->y[i * w + a] = zero ? d : l->x[i * w + a] + d;
    }
}

static ALWAYS_INLINE void row_restrict(const struct level *l, struct level *next, int64_t i, const int w, const int m)
{
    real sum[WIDTH_MOST] = {0};
    for (int64_t q = l->up.first[i]; q < l->up.first[i + 1]; q++) {
        const float *p = l->up.block + q * m * w;
        const real *t = l->t + (int64_t)l->up.column[q] * w;
        for (int a = 0; a < m; a++)
            for (int c = 0; c < w; c++) sum[a] += (real)p[a * w + c] * t[c];
    }
    for (int a = 0; a < m; a++) next->b[i * m + a] = sum[a];
}

static ALWAYS_INLINE void row_prolong(struct level *l, const struct level *next, int64_t i, const int w, const int m)
{
    real sum[WIDTH_MOST] = {0};
    for (int64_t q = l->down.first[i]; q < l->down.first[i + 1]; q++) {
        const float *p = l->down.block + q * w * m;
        const real *x = next->x + (int64_t)l->down.column[q] * m;
        for (int a = 0; a < w; a++)
            for (int c = 0; c < m; c++) sum[a] += (real)p[a * m + c] * x[c];
    }
    for (int a = 0; a < w; a++) l->x[i * w + a] += sum[a];
}

/* Rows from which on calling a team takes less time than it saves. */
enum { ROWS_MANY = 200 };

/* The loop over rows stands in the instance, so that widths are literals there. */
#define ROWS(N, CALL)                                                                                                  \
    do {                                                                                                               \
        TEAM_LOOP((N) > ROWS_MANY, for (int64_t i = 0; i < (N); i++) CALL;);                                           \
    } while (0)

#define BY_WIDTH(N, NAME, ...)                                                                                         \
    do {                                                                                                               \
        const int kind_ = l->width + (l->single ? 10 : 0);                                                             \
        if (kind_ == 11)                                                                                               \
            ROWS(N, NAME(__VA_ARGS__, 1, true));                                                                       \
        else if (kind_ == 12)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 2, true));                                                                       \
        else if (kind_ == 13)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, true));                                                                       \
        else if (kind_ == 1)                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 1, false));                                                                      \
        else if (kind_ == 3)                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 3, false));                                                                      \
        else                                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 6, false));                                                                      \
    } while (0)

#define BY_WIDTHS(N, NAME, ...)                                                                                        \
    do {                                                                                                               \
        const int kind_ = 10 * l->width + l->modes;                                                                    \
        if (kind_ == 11)                                                                                               \
            ROWS(N, NAME(__VA_ARGS__, 1, 1));                                                                          \
        else if (kind_ == 23)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 2, 3));                                                                          \
        else if (kind_ == 36)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, 6));                                                                          \
        else if (kind_ == 33)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, 3));                                                                          \
        else                                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 6, 6));                                                                          \
    } while (0)

void level_residual(struct level *l) { BY_WIDTH(l->n, row_residual, l, i); }

void level_relax(struct level *l, real keep, real step, bool zero)
{
    BY_WIDTH(l->n, row_relax, l, i, keep, step, zero);
    real *x = l->x;
    l->x = l->y, l->y = x;
}

void level_restrict(const struct level *l, struct level *next) { BY_WIDTHS(next->n, row_restrict, l, next, i); }
void level_prolong(struct level *l, const struct level *next) { BY_WIDTHS(l->n, row_prolong, l, next, i); }
