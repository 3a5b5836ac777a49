/* Checks for two errors at large displacements that forces do not show: parts of a body that pass through each other,
 * and pressures that keep the direction normal to the undeformed surface. */
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

/* Adds a warning to `warning_list`, once in a run, if particles of p of one body have moved into each other. Does
 * nothing if the scene has contact within bodies or accepts this by its key `accept`. Only particles whose distance in
 * the reference configuration exceeds `horizon` [m] are compared, since no bond keeps them apart. t: present time [s];
 * m: state of the checks, by which particles are compared at most 25 times per run. */
void large_motion_warn_of_self_penetration(struct large_motion *m, const struct particles *p, const struct scene *s,
                                           real horizon, real t, struct warnings *warning_list);

/* Adds a warning to `warning_list`, once in a run, if a pressure of the loads l that does not follow the deformation
 * acts on a surface of p that has turned by more than 10 degrees. Such a pressure stays normal to the undeformed
 * surface and so does work on the rotation. m: state of the checks; t: present time [s]. */
void large_motion_warn_of_non_follower_pressure(struct large_motion *m, const struct particles *p,
                                                const struct loads *l, real t, struct warnings *warning_list);

#endif
