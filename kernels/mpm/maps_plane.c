/* Defines the transfers between points and grid in 2D, where a cell usually has four points. */
#define MAP_VARIANTS_TURNING(X) X(2, LINEAR) X(2, GIMP) X(2, CPGIMP) X(2, CUBIC)
#define MAP_VARIANTS MAP_VARIANTS_TURNING

#include "g2p.h"
#include "p2g.h"
#include "remap.h"
#include "remap_turn.h"
