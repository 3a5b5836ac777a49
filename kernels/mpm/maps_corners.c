/* Defines the transfers between points and grid for linear shape functions in 3D. A cell has eight corners and usually
 * eight points. */
#ifdef __AVX512F__ /* narrower vectors would keep a row of eight nodes in memory, not in registers */
#define ROW_NODES 8
#endif
#define POINTS_MOST 8
#define MAP_VARIANTS_TURNING(X) X(3, LINEAR)
#define MAP_VARIANTS MAP_VARIANTS_TURNING

#include "g2p.h"
#include "p2g.h"
#include "remap.h"
#include "remap_turn.h"
