/* Stress-intensity factors of a crack at rest from the displacements round its tip, by a least-squares fit of
 * the series of Williams (1957), both modes, with a translation. Polar coordinates r, t at the tip; shear
 * modulus G; kappa: Kolosov constant; each line times the coefficient of term n:
 *
 *     2 G u_I  = r^(n/2) [(kappa + n/2 + s) cos(n t/2) - n/2 cos((n/2 - 2) t)]      s = (-1)^n
 *     2 G v_I  = r^(n/2) [(kappa - n/2 - s) sin(n t/2) + n/2 sin((n/2 - 2) t)]
 *     2 G u_II = r^(n/2) [(kappa + n/2 - s) sin(n t/2) - n/2 sin((n/2 - 2) t)]
 *     2 G v_II = r^(n/2) [-(kappa - n/2 + s) cos(n t/2) - n/2 cos((n/2 - 2) t)]
 *
 * K_I and K_II are the coefficients of n = 1 times sqrt(2 pi); term n = 2 of mode II is the rotation. Terms
 * up to n = 8 describe the bending of a ligament of a few radii: in a ligament of 12 spacings the error of
 * the direction is 5 degrees with n = 5, one degree with n = 8. The term n = -1 describes the zone round the
 * tip and along the faces where bonds are no continuum. Without it K_II is 7 to 10 % too large at three to
 * ten spacings, with it 3 to 5 %. Particles hidden from the tip by a crack do not count. In 3D the factors
 * are means along a straight front: particles along the front are projected on the plane perpendicular to it.
 */
#ifndef CLEAVE_TIP_FIT
#define CLEAVE_TIP_FIT

#include "data/particles.h"
#include "data/region.h"
#include "sif_fields.h"

/* A crack tip in an elastic medium, and the particles round the tip to whose displacements stress-intensity factors are
 * fitted. */
struct tip_view {
    struct crack_medium medium;
    /* unit vectors of the plane perpendicular to the front, in which all following vectors are */
    real axis[2][DIM_MAX];
    real place[2];          /* reference position of the tip [m] */
    real along[2], last[2]; /* unit vectors: direction of the crack in whose frame K is computed; direction of the last
                               part of the crack */
    real inner, outer;      /* particles between these radii are fitted [m] */
    int body;               /* particles of this body are fitted */
    const struct crack *crack; /* [cracks] that hide particles from the tip */
    int cracks;
};

/* Computes K_I and K_II of a crack tip by a least-squares fit of the series of Williams to the displacements of
 * particles of p round the tip. view: position and direction of the tip, radii between which particles are fitted, and
 * cracks that hide particles. K: receives the two factors [Pa m^(1/2)], in the frame with the x axis view->along.
 * Returns true, or false with K = 0 if too few particles are visible from the tip. */
bool crack_tip_fit_sif_to_displacements(const struct tip_view *view, const struct particles *p, real K[MODES]);

#endif
