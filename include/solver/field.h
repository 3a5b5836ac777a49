/* Vectors of all unknowns of a static solver, each component in an array of its own. */
#ifndef CLEAVE_FIELD
#define CLEAVE_FIELD

#include "base/base.h"

/* One vector for each particle or node of a mesh, in a unit that the user of the field states. of[d][k] is component d,
 * along axis d, of particle or node k; the arrays belong to whoever allocated them. */
struct field {
    real *of[DIM_MAX];
};

#endif
