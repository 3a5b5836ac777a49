/* Conversion and the coupling of peridynamic particles and material points, as a part of a run. */
#ifndef CLEAVE_COUPLING_PART
#define CLEAVE_COUPLING_PART

#include "coupling/approach.h"
#include "coupling/conversion.h"
#include "coupling/interface_zone.h"
#include "coupling/notch.h"
#include "run/run.h"

/* Where peridynamic particles and material points meet, and how one becomes the other. */
struct coupling_state {
    bool approaches; /* bodies meet: material points near others become peridynamic */
    struct partial_stress partial;
    bool flip;                  /* the transfer of the grid is FLIP */
    bool uses_partial;          /* partial stresses and ends of state-based bonds are made */
    uint8_t *bonded;            /* [n] 1: bonds meet this point of the grid (FLIP); NULL: they meet none */
    struct interface_zone zone; /* damped beside peridynamic particles (FLIP, partial stress) */
    real damping_share;         /* of the zone in a step; 0: not at all */
    struct conversion conversion;
    struct notches notches;     /* what stands for pre-cracks */
    struct region start_region; /* peridynamic from the start; no solid: none */
};

/* Which coupling there is; partial stresses and the interface zone for the bonds of now. */
void coupling_partial_make(struct run *e);
/* Makes the mesh of the reference frame (frame_make) with the partial stresses and slits of now; still: the caller sets
 * the motion of its nodes. */
status coupling_frame_make(struct run *e, bool still);
/* Makes the interface zone and the list of material points that have bonds anew. */
void interface_make(struct coupling_state *c, const struct particles *p, const struct bonds *b,
                    const struct bond_source *source);
/* Updates material points at the end of state-based bonds from their cells, or from their stress. */
void ends_update(const struct partial_stress *partial, const struct reference_frame *r, struct particles *p,
                 const struct material *material);

/* Pre-cracks as slits of the mesh or cut bonds, and what is peridynamic from the start. REFUSED where the scene wants
 * what cannot be. */
status notch_convert(struct run *e);
/* What stands for pre-crack number `crack`, in words. */
void notch_text(const struct notches *n, int crack, real spacing, char *text, size_t room);
/* Marks points at faces of slits that meet. False: nothing was looked at in this step. */
bool notch_approach(struct run *e);
/* Marks as peridynamic the particles on both sides of narrow voids that cut no mesh: a grid would close them. */
void voids_convert(struct particles *p, const struct voids *v, bool uncut);
/* Do no voids cut the mesh with nodes of grid g? A cut parts a line; where a mirror lies between nodes there are no
 * extra ones. */
bool mesh_uncut(const struct grid *g, const struct scene *s);
/* Warns of voids that the run closes: narrow ones on the grid of the current frame, and in lists and images. */
void voids_warn(const struct run *e, struct warnings *to);

/* Warns of bodies that pass through each other or stick together, and of voids that are closed. */
void warn_of_bodies(const struct run *e, struct warnings *to);

/* Conversion (step 8 of the algorithm). Marks what bodies and faces have come near, and follows waves in the active
 * set; true: points may have been marked at faces of slits. */
bool conversion_mark(struct run *e);
/* Converts what is marked, with all that follows from it and from `broken` directed bonds; marked: what conversion_mark
 * returned; fades: bonds are fading. Returns the number of particles converted. */
int64_t conversion_pass(struct run *e, int64_t broken, bool marked, bool fades);
/* The mesh, and points at ends of bonds, after so many particles have converted. */
void conversion_follow(struct run *e, int64_t converted);

/* REFUSED for scenes that do not allow reversion. */
status reversion_check(const struct scene *s);
/* Reverts particles that are due, before a step. */
void revert(struct run *e);

#endif
