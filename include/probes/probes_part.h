/* Probes, as a part of a run. */
#ifndef CLEAVE_PROBES_PART
#define CLEAVE_PROBES_PART

#include "probes/diagnostics.h"
#include "probes/probes.h"
#include "run/run.h"

/* Probes and what they compare with. */
struct probing {
    struct probes probes;
    struct wave_pulse *pulse; /* [pulses] of the initial states */
    int pulses;
    struct baseline baseline; /* for pulse probes, made at the end */
    bool has_baseline;
    real residual_step0; /* largest nodal force of the first step, for patch probes [N] */
    real strain_stress;  /* largest component of the initial stress [Pa] */
};

#endif
