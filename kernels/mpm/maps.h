/* Declares the maps between points and grid, one function for each combination of dimension, shape function and
 * transfer scheme in simd/variants.h. Their code is in headers (p2g.h, remap.h, remap_turn.h, g2p.h). Four files
 * compile it, with vectors of different widths: maps_line.c, maps_plane.c, maps_solid.c, maps_corners.c. */
#ifndef CLEAVE_KERNELS_MAPS
#define CLEAVE_KERNELS_MAPS

#include "kernels/kernels.h"
#include "kernels/simd/variants.h"

#define DECLARE(D, S, T)                                                                                               \
    KERNEL(void, p2g_##D##d_##S##_##T,                                                                                 \
           (struct grid *g, const struct particles *p, const struct transfer_data *t));    \
    KERNEL(int64_t, g2p_##D##d_##S##_##T,                                                                              \
           (const struct grid *g, struct particles *p, const struct transfer_data *t));
/* S: shape function; C: shape function that the kernel is compiled for. */
#define DECLARE_SHAPE(D, S, C)                                                                                         \
    TRANSFER_VARIANTS(DECLARE, D, C)                                                                                   \
    KERNEL(void, remap_##D##d_##C, (struct grid *g, struct particles *p, const struct transfer_data *t));              \
    KERNEL(void, spread_##D##d_##C,                                                                                    \
           (const struct grid *g, const struct particles *p, real half_width, const int32_t *list, int64_t n,          \
            const real *value, real *field));
#define DECLARE_TURNING(D, S, C)                                                                                       \
    KERNEL(void, turn_gather_##D##d_##C,                                                                               \
           (const struct grid *g, struct particles *p, const struct transfer_data *t));  \
    KERNEL(void, turn_scatter_##D##d_##C,                                                                              \
           (struct grid *g, const struct particles *p, const struct transfer_data *t));
SHAPE_VARIANTS(DECLARE_SHAPE)
SHAPE_VARIANTS_TURNING(DECLARE_TURNING)
#undef DECLARE
#undef DECLARE_SHAPE
#undef DECLARE_TURNING

#endif
