/* floor 2: the order of the maps between points and nodes, cell by cell, once for every map (struct transfer_order). */
#ifndef CLEAVE_SCATTER_H
#define CLEAVE_SCATTER_H

#include "kernels/kernels.h"

/* Is this the time to fetch what stands in the memory lines of the point AHEAD places further on? The cells of a row read two
 * (in 3D four) lines of many arrays side by side, more than the processor foresees by itself. Once a line. */
static ALWAYS_INLINE bool fetch_now(const int32_t *list, int k, int64_t *i)
{
    *i = list[k + ORDER_AHEAD];
    return *i % LANES == 0;
}

static ALWAYS_INLINE void fetch(const real *at) { __builtin_prefetch(at, 0, 3); }

/* The body of an instance of dimension D: CALL, an expression in `nodes`, `points`, `data`, `list` and `n`, for the n listed
 * points of every cell of TRANSFER's order; blocks of a colour by the team, colour after colour. The parallel region stands
 * in the instance, where the literals of CALL are known; `nodes`, `points` and `data` are copies nobody else writes, so that
 * what they hold stays in registers. */
#define SCATTER(D, TRANSFER, GRID, POINTS, CALL)                                                                \
    _Pragma("omp parallel")                                                                                     \
    {                                                                                                           \
        struct grid nodes = *(GRID);                                                                            \
        struct particles points = *(POINTS);                                                                    \
        const struct transfer_data data = *(TRANSFER);                                                          \
        const struct transfer_order *order = data.order;                                                        \
        for (int colour = 0; colour < 1 << (D); colour++) {                                                     \
            _Pragma("omp for schedule(static)")                                                                 \
            for (int block = order->blocks_of[colour]; block < order->blocks_of[colour + 1]; block++)           \
                for (int32_t c = order->block_cell[block]; c < order->block_cell[block + 1]; c++) {             \
                    const int32_t *list = order->particle + order->cell_start[c];                               \
                    const int n = order->cell_start[c + 1] - order->cell_start[c];                              \
                    CALL;                                                                                       \
                }                                                                                               \
        }                                                                                                       \
    }

#endif
