/* Defines the transfers between points and grid in 3D for shape functions that extend beyond the cell of a point. A
 * cell usually has eight points. */
#define POINTS_MOST 8
#define ONE_LOOP_OVER_CELLS
#define MAP_VARIANTS_TURNING(X) X(3, GIMP) X(3, CPGIMP) X(3, CUBIC)
#define MAP_VARIANTS MAP_VARIANTS_TURNING

#include "g2p.h"
#include "p2g.h"
#include "remap.h"
#include "remap_turn.h"
