/* Checks for errors of large displacements that no force reveals: bodies that pass through each other, and pressures
 * along normals of the undeformed body. */
#ifndef CLEAVE_LARGE_MOTION
#define CLEAVE_LARGE_MOTION

#include "base/warnings.h"
#include "loads/loads.h"
#include "scene/scene.h"

/* Results of the checks of large displacements. */
struct large_motion {
    int checked; /* number of the last part of the duration at whose beginning particles were compared */
    bool passed; /* the warning that parts of a body pass through each other has been printed */
    bool turned; /* the warning that a pressure does not follow the rotation of its surface has been printed */
};

/* Warns once of particles of one body that have moved into each other, where the scene has contact only between bodies
 * or none, unless it accepts this. Only particles whose reference distance exceeds `horizon` [m] count: no bond holds
 * them apart. t: present time [s];
 * particles are compared at most 25 times per run. */
void large_motion_warn_of_passing_parts(struct large_motion *m, const struct particles *p, const struct scene *s,
                                        real horizon, real t, struct warnings *warning_list);

/* Warns once of a pressure that does not follow the deformation, on a surface that has turned by more than 10 degrees:
 * its direction is that of the reference surface, so that it does work on the rotation. t: present time [s]. */
void large_motion_warn_of_turned_pressure(struct large_motion *m, const struct particles *p, const struct loads *l,
                                          real t, struct warnings *warning_list);

#endif
