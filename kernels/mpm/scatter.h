/* Declares the loop over cells in the order of struct transfer_order, which all maps from points to nodes use, and
 * functions that prefetch the data of points. */
#ifndef CLEAVE_KERNELS_SCATTER
#define CLEAVE_KERNELS_SCATTER

#include "kernels/kernels.h"

/* Returns true if the data of the point list[k + ORDER_AHEAD] should be prefetched, which is so for one point per cache
 * line. *i receives the number of this point. The points of a row of cells occupy two (in 3D four) lines in many
 * arrays, more than the hardware prefetcher follows. */
static ALWAYS_INLINE bool point_ahead_starts_new_cache_line(const int32_t *list, int k, int64_t *i)
{
    *i = list[k + ORDER_AHEAD];
    return *i % LANES == 0;
}

/* Prefetches the cache line of the number at the address `at` for reading. */
static ALWAYS_INLINE void prefetch_cache_line(const real *at) { __builtin_prefetch(at, 0, 3); }

/* Prefetches mass, position, velocity and spin of the point list[k + ORDER_AHEAD] of p, once per cache line. spin:
 * spins (angular velocities) of the points (transfer_data.turn); spin[2] NULL: no spins. */
static ALWAYS_INLINE void points_prefetch_mass_position_velocity_and_spin(const struct particles *p, real *const *spin,
                                                                          const int32_t *list, int k, const int dim)
{
    int64_t i;
    if (!point_ahead_starts_new_cache_line(list, k, &i)) return;
    prefetch_cache_line(p->mass + i);
    for (int d = 0; d < dim; d++) prefetch_cache_line(p->x[d] + i), prefetch_cache_line(p->v[d] + i);
    for (int c = dim == 2 ? 2 : 0; c < 3 && spin[2]; c++) prefetch_cache_line(spin[c] + i);
}

/* Body of a map from points to nodes in D dimensions: evaluates CALL for the points list[n] of every cell, in the order
 * of TRANSFER. CALL: expression in `nodes`, `points`, `data`, `list` and `n`; the first three are private copies of
 * GRID, POINTS and TRANSFER, whose members stay in registers. The blocks of one colour are divided among the threads,
 * one colour after the other. The parallel region is inside the macro, where constants in CALL are known to the
 * compiler. */
#define SCATTER(D, TRANSFER, GRID, POINTS, CALL)                                                                       \
    _Pragma("omp parallel")                                                                                            \
    {                                                                                                                  \
        struct grid nodes = *(GRID);                                                                                   \
        struct particles points = *(POINTS);                                                                           \
        const struct transfer_data data = *(TRANSFER);                                                                 \
        const struct transfer_order *order = data.order;                                                               \
        for (int colour = 0; colour < 1 << (D); colour++) {                                                            \
            _Pragma("omp for schedule(static)") for (int block = order->blocks_of[colour];                             \
                                                     block < order->blocks_of[colour + 1];                             \
                                                     block++) for (int32_t c = order->block_cell[block];               \
                                                                   c < order->block_cell[block + 1]; c++)              \
            {                                                                                                          \
                const int32_t *list = order->particle + order->cell_start[c];                                          \
                const int n = order->cell_start[c + 1] - order->cell_start[c];                                         \
                CALL;                                                                                                  \
            }                                                                                                          \
        }                                                                                                              \
    }

#endif
