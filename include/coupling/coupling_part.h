/* Conversion and the coupling of peridynamic particles and material points, as a part of a run. */
#ifndef CLEAVE_COUPLING_PART
#define CLEAVE_COUPLING_PART

#include "coupling/approach.h"
#include "coupling/conversion.h"
#include "coupling/interface_zone.h"
#include "coupling/notch.h"
#include "run/run.h"

/* Where peridynamic particles and material points meet, and how one becomes the other. */
struct coupling_state {
    bool approaches;                  /* bodies meet: material points near others become peridynamic */
    struct partial_stress partial;
    bool uses_partial;          /* partial stresses and ends of state-based bonds are made */
    uint8_t *bonded;            /* [n] 1: bonds meet this point of the grid (FLIP); NULL: they meet none */
    struct interface_zone zone; /* damped beside peridynamic particles (FLIP, partial stress) */
    real damping_share;         /* of the zone in a step; 0: not at all */
    struct conversion conversion;
    struct notches notches;     /* what stands for pre-cracks */
    struct region start_region; /* peridynamic from the start; no solid: none */
};

#endif
