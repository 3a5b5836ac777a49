/* Defines the transfers between points and grid in 1D, where a cell usually has two points. */
#define MAP_VARIANTS_TURNING(X)
#define MAP_VARIANTS(X) X(1, LINEAR) X(1, GIMP) X(1, CPGIMP) X(1, CUBIC)

#include "g2p.h"
#include "p2g.h"
#include "remap.h"
#include "remap_turn.h"
