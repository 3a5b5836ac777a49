/* Rigid bodies, as a part of a run. */
#ifndef CLEAVE_RIGID_PART
#define CLEAVE_RIGID_PART

#include "rigid/rigid.h"
#include "run/run.h"

/* Rigid bodies, and what they and others are shaped like. */
struct rigid_set {
    struct rigid_body *body;     /* [scene->rigids] */
    const struct region **shape; /* [scene->bodies] of bodies that are not lists, for contact */
    bool met;                    /* a warning of two that are inside each other has been given */
};

#endif
