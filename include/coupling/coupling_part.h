/* Conversion and coupling of peridynamic particles and material points in a run. */
#ifndef CLEAVE_COUPLING_PART
#define CLEAVE_COUPLING_PART

#include "coupling/approach.h"
#include "coupling/conversion.h"
#include "coupling/interface_zone.h"
#include "coupling/notch.h"
#include "run/run.h"

/* State of the coupling. */
struct coupling_state {
    bool approaches; /* bodies may be in contact: material points near another body convert */
    struct partial_stress partial;
    bool flip;                  /* the transfer of the grid is FLIP */
    bool uses_partial;          /* partial stresses, or entries of state-based PD-MPM bonds, are made */
    uint8_t *bonded;            /* [n] 1: material point with PD-MPM bonds (FLIP); NULL: none */
    struct interface_zone zone; /* damped zone beside peridynamic particles (FLIP, partial stress) */
    real damping_share;         /* strength of the damping of the zone in a step [1]; 0: none */
    struct conversion conversion;
    struct notches notches;     /* representation of pre-cracks: slits or cut bonds */
    struct region start_region; /* peridynamic from the start; no solids: empty */
};

/* Sets the kind of coupling, and makes partial stresses and the interface zone for the present bonds. */
void coupling_partial_make(struct run *e);

/* Makes the mesh of the reference frame (frame_make) with the present partial stresses and slits. still: the caller
 * sets the motion of the nodes. */
status coupling_frame_make(struct run *e, bool still);

/* Rebuilds the interface zone and the marks of material points with PD-MPM bonds. */
void interface_make(struct coupling_state *c, const struct particles *p, const struct bonds *b,
                    const struct bond_source *source);

/* Updates the material points of state-based PD-MPM bonds from the strain of their cells or, on the grid, from their
 * stress. material: [materials]. */
void bonded_points_update(const struct partial_stress *partial, const struct reference_frame *r, struct particles *p,
                          const struct material *material);

/* Represents the pre-cracks by slits of the mesh or cut bonds, and converts the particles that are peridynamic from the
 * start. REFUSED if the scene requires slits where they are impossible. */
status precracks_apply(struct run *e);

/* Writes the representation of pre-crack number `crack` in words to text [room]. */
void notch_describe(const struct notches *n, int crack, real spacing, char *text, size_t room);

/* Marks material points beside slits whose faces approach each other (FLAG_NEAR). Returns false if faces are not
 * evaluated in this step. */
bool slits_flag_approaching(struct run *e);

/* Makes the particles on both sides of narrow voids peridynamic where a grid would join them. v: NULL, no voids; uncut:
 * voids do not cut the mesh (mesh_ignores_voids). */
void voids_convert_beside(struct particles *p, const struct voids *v, bool uncut);

/* Returns true if voids do not cut the mesh with the nodes of grid g: in 1D, where a cut separates a line by itself,
 * and with mirrors between nodes, for which extra nodes of cuts are not made. */
bool mesh_ignores_voids(const struct grid *g, const struct scene *s);

/* Warns of voids that the run joins: narrow ones on the grid of the current frame, and in bodies made from lists and
 * images. */
void voids_warn(const struct run *e, struct warnings *to);

/* Warns of bodies that pass through each other or stick together, and of voids that are joined. */
void warn_of_joined_bodies(const struct run *e, struct warnings *to);

/* Prepares conversion (step 8 of the algorithm): marks material points near other bodies and slits, and extends the
 * active rows. Returns true if points beside slits may have been marked. */
bool conversion_prepare(struct run *e);

/* Converts the marked material points, with all consequences of conversion and of `broken` directed bonds. marked:
 * result of conversion_prepare; fades: bonds of growing cracks fade. Returns the number of particles converted. */
int64_t conversion_apply(struct run *e, int64_t broken, bool marked, bool fades);

/* Updates the mesh and the material points of PD-MPM bonds after `converted` particles have changed their kind. */
void conversion_update_mesh(struct run *e, int64_t converted);

/* Returns REFUSED if a scene with reversion has settings that exclude it. */
status reversion_check(const struct scene *s);

/* Reverts the particles that are due to material points, before a step. */
void reversion_apply_due(struct run *e);

#endif
