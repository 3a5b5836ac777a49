/* Cracks, as a part of a run. */
#ifndef CLEAVE_FRACTURE_PART
#define CLEAVE_FRACTURE_PART

#include "fracture/growth.h"
#include "fracture/tips.h"
#include "run/run.h"

/* Cracks: where their tips are, and those whose growth is prescribed or SIF-controlled. */
struct fracture_state {
    struct tips tips;
    int growths;
    struct growth *growth; /* [growths] */
};

/* Do bonds fade along growing cracks? */
bool cracks_fade(const struct fracture_state *f);

#endif
