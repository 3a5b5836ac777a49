/* Defines the tables of the kernels that transfer between material points and grid nodes, indexed by dimension, shape
 * function and transfer scheme. */
#include "maps.h"

/* MAP_ENTRY(NAME, D, S, T) initialises the entry of a table for dimension D, shape function S and transfer scheme T
 * with the function NAME_Dd_S_T, such as p2g_2d_LINEAR_FLIP. The other macros list the entries of one table each. */
#define MAP_ENTRY(NAME, D, S, T) [D][SHAPE_##S][TRANSFER_##T] = NAME##_##D##d_##S##_##T,
#define P2G_ENTRY(D, S, T) MAP_ENTRY(p2g, D, S, T)
#define P2G_ENTRIES(D, S) TRANSFER_VARIANTS(P2G_ENTRY, D, S)
p2g_fn *const p2g_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(P2G_ENTRIES)};
#define G2P_ENTRY(D, S, T) MAP_ENTRY(g2p, D, S, T)
#define G2P_ENTRIES(D, S) TRANSFER_VARIANTS(G2P_ENTRY, D, S)
g2p_fn *const g2p_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(G2P_ENTRIES)};

#define SHAPE_ENTRY(NAME, D, S) [D][SHAPE_##S] = NAME##_##D##d_##S,
#define REMAP_ENTRY(D, S) SHAPE_ENTRY(remap, D, S)
musl_remap_fn *const remap_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(REMAP_ENTRY)};
#define SPREAD_ENTRY(D, S) SHAPE_ENTRY(spread, D, S)
spread_to_nodes_fn *const spread_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS(SPREAD_ENTRY)};
#define GATHER_ENTRY(D, S) SHAPE_ENTRY(turn_gather, D, S)
rotating_remap_gather_fn *const turn_gather_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS_TURNING(GATHER_ENTRY)};
#define SCATTER_ENTRY(D, S) SHAPE_ENTRY(turn_scatter, D, S)
rotating_remap_scatter_fn *const turn_scatter_table[DIM_MAX + 1][SHAPES] = {SHAPE_VARIANTS_TURNING(SCATTER_ENTRY)};
