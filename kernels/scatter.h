/* floor 2: the coloured scatter from points to nodes, once for every map (struct transfer_order). */
#ifndef CLEAVE_SCATTER_H
#define CLEAVE_SCATTER_H

#include "kernels.h"

/* The body of an instance of dimension D: CALL, an expression in `nodes`, `points` and `i`, for every point of ORDER; blocks
 * of a colour by the team, colour after colour. The parallel region stands in the instance, where the literals of CALL
 * are known; `nodes` and `points` are copies nobody else writes, so that what they hold stays in registers. */
#define SCATTER(D, ORDER, GRID, POINTS, CALL)                                                                   \
    _Pragma("omp parallel")                                                                                     \
    {                                                                                                           \
        struct grid nodes = *(GRID);                                                                            \
        struct particles points = *(POINTS);                                                                    \
        for (int colour = 0; colour < 1 << (D); colour++) {                                                     \
            _Pragma("omp for schedule(static)")                                                                 \
            for (int block = (ORDER)->blocks_of[colour]; block < (ORDER)->blocks_of[colour + 1]; block++)       \
                for (int32_t k = (ORDER)->block_start[block]; k < (ORDER)->block_start[block + 1]; k++) {       \
                    const int64_t i = (ORDER)->particle[k];                                                     \
                    CALL;                                                                                       \
                }                                                                                               \
        }                                                                                                       \
    }

#endif
