/* Tables of the transfers between points and grid by dimension, shape function and transfer scheme. */
#include "maps.h"

/* Entries of the tables: the kernel for dimension D and shape function S, which is compiled for the shape function C,
 * and one for each transfer scheme T. */
#define P2G_ENTRY(D, C, T) [TRANSFER_##T] = p2g_##D##d_##C##_##T,
#define P2G_ENTRIES(D, S, C) [D][SHAPE_##S] = {TRANSFER_VARIANTS(P2G_ENTRY, D, C)},
p2g_fn *const p2g_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(P2G_ENTRIES)};
#define G2P_ENTRY(D, C, T) [TRANSFER_##T] = g2p_##D##d_##C##_##T,
#define G2P_ENTRIES(D, S, C) [D][SHAPE_##S] = {TRANSFER_VARIANTS(G2P_ENTRY, D, C)},
g2p_fn *const g2p_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(G2P_ENTRIES)};

#define REMAP_ENTRY(D, S, C) [D][SHAPE_##S] = remap_##D##d_##C,
musl_remap_fn *const remap_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(REMAP_ENTRY)};
#define SPREAD_ENTRY(D, S, C) [D][SHAPE_##S] = spread_##D##d_##C,
spread_to_nodes_fn *const spread_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(SPREAD_ENTRY)};
#define GATHER_ENTRY(D, S, C) [D][SHAPE_##S] = turn_gather_##D##d_##C,
rotating_remap_gather_fn *const turn_gather_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS_TURNING(GATHER_ENTRY)};
#define SCATTER_ENTRY(D, S, C) [D][SHAPE_##S] = turn_scatter_##D##d_##C,
rotating_remap_scatter_fn *const turn_scatter_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS_TURNING(SCATTER_ENTRY)};
