/* Stress-intensity factors of a crack at rest from the displacements round its tip, by a least-squares fit of the
 * series of Williams (1957), both modes, with a translation (its term n = 2 of mode II is the rotation):
 *
 *   2 G u_I  = r^(n/2) [(kappa + n/2 + s) cos(n t/2) - n/2 cos((n/2 - 2) t)]      s = (-1)^n
 *   2 G v_I  = r^(n/2) [(kappa - n/2 - s) sin(n t/2) + n/2 sin((n/2 - 2) t)]
 *   2 G u_II = r^(n/2) [(kappa + n/2 - s) sin(n t/2) - n/2 sin((n/2 - 2) t)]
 *   2 G v_II = r^(n/2) [-(kappa - n/2 + s) cos(n t/2) - n/2 cos((n/2 - 2) t)]
 *
 * K_I and K_II are the coefficients of n = 1 times sqrt(2 pi). Up to n = 8, since a ligament of a few radii bends
 * (with n = 5 the direction is 5 degrees off where it is 12 spacings wide, with 8 one degree), and n = -1 for the zone
 * round the tip and along the faces in which bonds are no continuum: without it K_II is 7 to 10 % too large at three
 * to ten spacings, with it 3 to 5 %. Particles that the tip does not see, since a crack lies between, do not count. In
 * space these are the mean factors of a straight front: particles along it are one place of the plane across it.
 */
#ifndef CLEAVE_TIP_FIT
#define CLEAVE_TIP_FIT

#include "data/particles.h"
#include "data/region.h"
#include "sif_fields.h"

struct tip_view {
    struct crack_medium medium;
    real axis[2][DIM_MAX];     /* unit vectors: of the plane across the front, in which all of what follows lies */
    real place[2];             /* of the tip, reference position [m] */
    real along[2], last[2];    /* unit vectors: of the frame, and of the last stretch of the crack */
    real inner, outer;         /* particles between these radii count [m] */
    int body;                  /* of this body */
    const struct crack *crack; /* what hides particles from the tip */
    int cracks;
};

/* Factors in the frame; false, and 0, where the tip sees too few particles. */
bool tip_fit(const struct tip_view *view, const struct particles *p, real K[MODES]);

#endif
