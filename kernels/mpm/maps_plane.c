/* Defines the transfers between points and grid in 1D and 2D, where a cell usually has two and four points. */
#define MAP_VARIANTS_TURNING(X) X(2, LINEAR) X(2, GIMP) X(2, CPGIMP) X(2, QUADRATIC) X(2, CUBIC)
#define MAP_VARIANTS(X) X(1, LINEAR) X(1, GIMP) X(1, CPGIMP) X(1, QUADRATIC) X(1, CUBIC) MAP_VARIANTS_TURNING(X)

#include "g2p.h"
#include "p2g.h"
#include "remap.h"
#include "remap_turn.h"
