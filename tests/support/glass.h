/* The glass of Imachi et al. 2019, for tests of crack tips. */
#ifndef CLEAVE_TESTS_GLASS
#define CLEAVE_TESTS_GLASS

#include "fracture/sif_fields.h"

static const real pi = 3.14159265358979323846;

/* Returns the elastic constants and wave speeds of the glass of Imachi et al. 2019 in the space `space`. */
static inline struct crack_medium glass(enum space space)
{
    struct material m = {.young = 75.629e9, .poisson = 0.286, .density = 2456};
    material_compute_derived_constants(&m, space);
    return crack_medium_of_material(&m, space);
}

#endif
