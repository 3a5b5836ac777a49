/* Representation of pre-cracks in a body in the reference frame (a mesh fixed to the material). Either a pre-crack cuts
 * bonds along all its length, or the mesh has a slit (free surface) there and bonds are cut round the crack ends
 * alone. */
#ifndef CLEAVE_NOTCH
#define CLEAVE_NOTCH

#include "bonds/bonds.h"

/* Decrease [spacings] of the distance between the two faces of a slit (a pre-crack as free surface of the mesh) at
 * which the material points beside the slit become peridynamic. */
#define NOTCH_GAP 1e-4

/* Representation of one pre-crack. slit: true if it is a slit, i.e. a free surface of the mesh, false if it cuts bonds
 * along all its length; reason: why it is no slit, in words, NULL if it is a slit. */
struct notch {
    bool slit;
    const char *reason;
};

/* The n pre-cracks of a run: which of them are slits (free surfaces of the mesh) and which cut bonds; and the particles
 * beside slits and narrow voids (gaps of a body). */
struct notches {
    int n;
    struct notch *notch; /* [n] for each pre-crack */
    int slits, images, cuts;
    /* owned, except the corners of the cracks. slit: the [slits] slits as given in the scene, then [images] parts of
     * them in the body and mirror images; cut: [cuts] cracks that cut bonds along all their length: parts in the body
     * and mirror images */
    struct crack *slit, *cut;
    real radius; /* radius of the peridynamic zones around the ends of slits [m] */
    real *lost;  /* [particles] fraction of the neighbours of each particle that slits separate from it [1]; NULL: no
                    slits */
    int64_t faces;
    int32_t *face;             /* [faces] particles beside a slit or a narrow void, in ascending order */
    real *depth;               /* [faces] depth of particles beside a void below the surface [m] */
    const struct voids *voids; /* kept by reference; NULL: no voids */
};

/* Decides for each pre-crack of `source` (inputs of the bonds of p) whether it becomes a slit of the mesh, and stores
 * the decisions in n. A pre-crack becomes a slit if it runs through material points of the mesh and ends inside the
 * body; otherwise it cuts bonds along all its length. Also finds the particles beside slits and narrow voids.
 * tip_radius: radius of the peridynamic zones at the ends of slits [m]; reason_against_slits: why no pre-crack may be a
 * slit, NULL if slits are allowed. Release with notches_free. */
void notches_choose_slits_or_cut_bonds(struct notches *n, const struct particles *p, const struct bond_source *source,
                                       real tip_radius, const char *reason_against_slits);

/* Makes peridynamic, before step 0, the particles of p near the ends of slits (pre-cracks as free surfaces of the
 * mesh): those within n->radius of an end that the slit separates from some of their neighbours. source: inputs of the
 * bonds (horizon, materials, cracks, mirrors). */
void notches_make_slit_ends_peridynamic(const struct notches *n, struct particles *p, const struct bond_source *source);

/* Releases all arrays of n, the pre-cracks of a run. The corners of the cracks and the voids stay with their owners. */
void notches_free(struct notches *n);

/* Flags points of p beside slits (pre-cracks as free surfaces of the mesh) and narrow voids whose opposite faces are
 * about to touch: sets FLAG_NEAR, by which they are later converted to peridynamic particles. n: lists these points.
 * Tests the distance of particles on opposite faces after the time `time_ahead` [s], extrapolated from present
 * positions and velocities, which must be up to date. Points are flagged at a slit if this distance is less than
 * spacing (1 - NOTCH_GAP), with NOTCH_GAP = 1e-4; at a notch of width `width`, if it is less than spacing (1 +
 * NOTCH_GAP) - width; at a void, if the faces are close to contact. spacing: of the particles [m]. */
void notches_flag_closing_face_points_for_conversion(const struct notches *n, struct particles *p, real spacing,
                                                     real time_ahead);

#endif
