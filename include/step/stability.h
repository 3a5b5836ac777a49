#ifndef CLEAVE_STABILITY
#define CLEAVE_STABILITY

#include "base/rise.h"
#include "run/run.h"

/* What stability checks compare (stability.c). */
struct stability {
    struct rise speed, excess; /* of the largest speed^2 [m^2/s^2]; of energy from nowhere [J] */
    real start_speed;          /* largest at t = 0 [m/s] */
    bool diverged;             /* a peridynamic particle moves faster than waves */
    bool lost;                 /* an energy of the last sample is no finite number */
    bool stretched;            /* the run has said that points are stretched past the reach of the law */
};

#endif
