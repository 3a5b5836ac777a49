/* Cracks in a run. */
#ifndef CLEAVE_FRACTURE_PART
#define CLEAVE_FRACTURE_PART

#include "fracture/growth.h"
#include "fracture/tips.h"
#include "run/run.h"

/* Cracks of a run. tips: crack tips, tracked by the damage of particles; growth: cracks whose growth is prescribed or
 * controlled by stress-intensity factors. */
struct fracture_state {
    struct crack_tips tips;
    int growths;
    struct growing_crack *growth; /* [growths] */
};

/* Returns true if f (the cracks of a run) has a growing crack whose bonds lose their weight (factor on their force)
 * gradually while the tip moves on. Other cracks break the bonds at once when the tip crosses them. */
bool any_growing_crack_weakens_bonds_gradually(const struct fracture_state *f);

#endif
