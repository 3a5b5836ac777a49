/* Pre-cracks of a scene in a body whose points are in the reference frame: either bonds are cut along all of a crack,
 * or the mesh has a slit there and bonds are cut round its ends only. */
#ifndef CLEAVE_NOTCH
#define CLEAVE_NOTCH

#include "bonds/bonds.h"

/* Faces of a slit become peridynamic before they are so much nearer than at the start [spacings]. */
#define NOTCH_GAP 1e-4

struct notch {
    bool slit;
    const char *reason;
}; /* reason: why it is none; NULL of slits */

struct notches {
    int n;
    struct notch *notch; /* [n] of each pre-crack */
    int slits, images, cuts;
    struct crack *slit, *cut; /* borrowed: [slits] of the scene, [images] behind them these in the body with
                               * their mirror images; [cuts] those that cut bonds all along, likewise */
    real radius;              /* of the zones round the ends of slits [m] */
    real *lost;               /* [particles] share of its family from which slits part a particle; NULL: no
                               * slits */
    int64_t faces;
    int32_t *face;             /* [faces] particles beside a slit or a narrow void, ascending */
    real *depth;               /* [faces] of those beside a void, how deep they are in the body [m] */
    const struct voids *voids; /* borrowed; NULL: there are none */
};

/* Decides for each pre-crack of the source: slits where it runs through material points of the mesh and ends in the
 * body. `obstacle`: what keeps all of them from being slits; NULL: nothing. */
void notches_make(struct notches *n, const struct particles *p, const struct bond_source *source, real radius,
                  const char *obstacle);
/* Marks particles as peridynamic round the ends of slits, before step 0. */
void notches_convert(const struct notches *n, struct particles *p, const struct bond_source *source);
void notches_free(struct notches *n);

/* Sets FLAG_NEAR of the material points beside slits whose faces come together within the time `ahead` [s]: nearer by
 * more than NOTCH_GAP, or by the width of the notch less that. Positions of the faces are up to date. */
void notches_approach(const struct notches *n, struct particles *p, real spacing, real ahead);

#endif
