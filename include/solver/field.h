/* Vectors of all unknowns of a static solver, one component per array. */
#ifndef CLEAVE_FIELD
#define CLEAVE_FIELD

#include "base/base.h"

/* A vector for each particle or node: of[d][k] is component d of node k. */
struct field {
    real *of[DIM_MAX];
};

#endif
