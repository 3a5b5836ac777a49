#ifndef CLEAVE_STABILITY
#define CLEAVE_STABILITY

#include "base/rise.h"
#include "run/run.h"
#include "step/large_motion.h"
#include "step/parted.h"

/* State of the checks for runs that become unstable (stability.c). */
struct stability {
    struct quantity_samples speed, excess; /* records of the largest squared speed of a particle [m^2/s^2], and of the
                                            energy that no load has supplied [J] */
    real start_speed;                      /* largest speed of particles at t = 0 [m/s] */
    bool diverged;                         /* a peridynamic particle is faster than the fastest wave */
    bool lost;                             /* an energy of the last sample is not finite */
    bool stretched;                        /* the warning that points are stretched or flow too far has been printed */
    bool parted;                           /* the warning that metal has come apart has been printed */
    bool released;            /* the warning that broken bonds release more energy than they stored has been printed */
    struct point_pairs pairs; /* neighbouring points of metal, for the search for gaps (parted.h) */
    struct large_motion motion; /* state of the checks for large motion */
};

#endif
