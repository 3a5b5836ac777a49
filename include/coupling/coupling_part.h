/* Conversion and coupling of peridynamic particles and material points in a run. */
#ifndef CLEAVE_COUPLING_PART
#define CLEAVE_COUPLING_PART

#include "coupling/approach.h"
#include "coupling/conversion.h"
#include "coupling/interface_zone.h"
#include "coupling/notch.h"
#include "run/run.h"

/* State of the coupling of peridynamic particles and material points in a run; one instance for each run. A PD-MPM bond
 * connects a peridynamic particle and a material point. */
struct coupling_state {
    bool approaches;               /* bodies may be in contact: material points near another body become peridynamic */
    struct partial_stress partial; /* share of their stress that material points leave to bonds */
    bool flip;                     /* velocities are transferred from the grid by FLIP */
    bool uses_partial;             /* `partial` is filled: partial stresses, or data of state-based PD-MPM bonds */
    uint8_t *bonded;               /* [n] 1: material point with PD-MPM bonds (FLIP); NULL: none */
    struct interface_zone zone;    /* damped zone beside peridynamic particles (FLIP, partial stress) */
    real damping_share; /* strength of the damping in `zone` in a step (interface_zone_damp_and_return_first_half_loss)
                           [1]; 0: none */
    struct conversion conversion; /* numbers, time and position of conversions */
    struct notches notches;       /* representation of pre-cracks: slits or cut bonds */
    struct region start_region;   /* peridynamic from the start; no solids: empty */
};

/* Sets how peridynamic particles and material points of the run are coupled. If material points can convert, this is
 * the method that the input file names (partial stress: material points leave a part of their stress to bonds;
 * hand-shake, Zeng et al. 2022; ...), else hand-shake. Then computes for the present bonds the partial stresses of
 * material points (the parts of their stress that bonds carry) and the interface zone (material points beside
 * peridynamic particles, whose motion is damped). */
void coupling_set_up_pd_mpm_method_and_interface(struct run *run);

/* Makes the mesh of the run for the bodies in the reference frame (shape functions are evaluated in the undeformed
 * state). The mesh includes the present partial stresses (parts of the stress that bonds carry), and pre-cracks as
 * slits (free surfaces). caller_sets_nodal_motion: true if the caller sets displacement and velocity of the nodes
 * afterwards, false to fit them to those of the particles. Returns REFUSED (unsuitable input) or FAILED (too many
 * nodes), with a message, if no mesh is possible (mesh_make). */
status coupling_build_total_lagrangian_mesh(struct run *run, bool caller_sets_nodal_motion);

/* Rebuilds the data of coupling state c that depend on the bonds, after the bonds b have changed. c->bonded[p->n]: 1
 * for material points with bonds to peridynamic particles, for the FLIP transfer only. c->zone: the interface zone,
 * material points beside peridynamic particles whose motion is damped, only for FLIP with partial stress (material
 * points leave a part of their stress to bonds). p: particles; source: inputs of the bonds (horizon, materials, cracks,
 * mirrors). */
void interface_zone_rebuild_after_bond_change(struct coupling_state *c, const struct particles *p,
                                              const struct bonds *b, const struct bond_source *source);

/* Updates p->end_strain [1] of all material points that have state-based bonds to peridynamic particles, which
 * `partial` lists. end_strain is the strain that the cell of a point adds to the mean strain of the neighbourhood of
 * the point. For points of the mesh of `reference` it follows from the strain of the cell; for points on the background
 * grid from the stress of the point, by the elastic law of its material in material[]. Does nothing in bond-based
 * models. */
void bonded_mpm_points_update_cell_strain(const struct partial_stress *partial, const struct lagrangian_mesh *reference,
                                          struct particles *p, const struct material *material);

/* Decides whether each pre-crack of the run becomes a slit, i.e. a free surface of the mesh, or cuts bonds along its
 * length, and makes particles peridynamic that are so from the start: particles near the ends of slits, with bonds cut
 * by a pre-crack, beside narrow voids, or in the region that the input file gives. Returns REFUSED, with a message, if
 * the input file requires slits where they are impossible. */
status precracks_apply_as_slits_or_cut_bonds(struct run *run);

/* Writes to text[capacity], in words, how pre-crack number `crack_number` (from 0) is represented: as a slit of the
 * mesh, with the size of the zones of bonds at its ends, or by cut bonds, with the reason. A longer text is truncated.
 * n: decisions on all pre-cracks; spacing: of the particles [m]. */
void notch_describe_as_slit_or_cut_bonds(const struct notches *n, int crack_number, real spacing, char *text,
                                         size_t capacity);

/* Marks (FLAG_NEAR) material points beside slits (pre-cracks as free surfaces of the mesh) and narrow voids whose faces
 * approach each other, so that they become peridynamic particles before the faces touch. n: the slits, with points
 * beside slits and voids; reference: the mesh, whose motion particles receive first; spacing: of the particles [m];
 * time_ahead: time until the next call [s]; p, loads: particles and loads. Returns true if n has such slits or voids,
 * whether or not points were marked. */
bool mark_points_at_closing_slits_to_become_peridynamic(const struct notches *n, struct lagrangian_mesh *reference,
                                                        struct particles *p, const struct loads *loads, real spacing,
                                                        real time_ahead);

/* Makes the particles on both sides of narrow voids peridynamic, so that common nodes of a grid do not join the two
 * sides. p: the particles; v: voids (narrow gaps of a body); NULL: nothing is done. include_mesh_particles: true to
 * include particles of the mesh of the reference frame (undeformed state), needed if this mesh has no free surfaces at
 * voids (mesh_cannot_have_free_surfaces_at_voids). */
void convert_particles_beside_voids_to_peridynamic(struct particles *p, const struct voids *v,
                                                   bool include_mesh_particles);

/* Returns true if a mesh with the nodes of grid g has no free surfaces at voids (narrow gaps of a body): in 1D, and if
 * a mirror plane of scene s (the input file) does not pass through nodes of g, because doubled nodes are not possible
 * then. */
bool mesh_cannot_have_free_surfaces_at_voids(const struct grid *g, const struct scene *s);

/* Adds warnings to `warning_list` for voids of bodies of the run that are too narrow, so that the run treats them as
 * closed. These are voids whose two sides share nodes of the background grid, and such gaps between a body and a plane
 * of symmetry. In bodies made from particle lists or images, whose surfaces are not known, they are gaps of one or two
 * particles. total_lagrangian_possible: true if the body can be in the reference frame (shape functions in the
 * undeformed state), which is then named as a remedy. */
void warn_of_voids_treated_as_closed(const struct run *run, bool total_lagrangian_possible,
                                     struct warnings *warning_list);

/* Adds warnings to `warning_list` for bodies of the run that will pass through each other or stick together, and for
 * voids that are too narrow to stay open (warn_of_voids_treated_as_closed). */
void warn_of_bodies_that_penetrate_or_stick_together(const struct run *run, struct warnings *warning_list);

/* Marks the material points of the run that are to become peridynamic particles because contact is near (FLAG_NEAR):
 * those near other bodies, and those beside crack faces that approach each other. Searches for such points in each load
 * step (static equilibrium), or once in APPROACH_STEPS time steps. In every step first updates the list of the blocks
 * of eight rows (the bonds of eight particles each) whose particles may move. Returns true if points beside crack faces
 * were searched for in this step, so that some may be marked. */
bool conversion_flag_points_near_contact(struct run *run);

/* Converts those material points of the run whose flags require it (FLAG_LOST_BOND, FLAG_NEAR, FLAG_STRESSED) to
 * peridynamic particles, and updates all that depends on it: bonds, contact, partial stresses (the parts of stresses
 * that bonds carry), interface zone (damped material points beside peridynamic particles) and mesh. broken_bond_count:
 * number of bonds broken in this step, each counted once for each of its particles; crack_faces_examined: value that
 * conversion_flag_points_near_contact returned in this step; bonds_weaken_gradually: true if bonds of growing cracks
 * lose strength gradually. Returns the number of particles converted. */
int64_t run_convert_flagged_points_to_peridynamic(struct run *run, int64_t broken_bond_count, bool crack_faces_examined,
                                                  bool bonds_weaken_gradually);

/* Updates the mesh of the run, and the strains of material points with state-based bonds to peridynamic particles,
 * after conversion. converted_count: number of particles that have become peridynamic; 0 if at most partial stresses
 * (the parts of stresses that bonds carry) have changed. Energy lost by removing points from the mesh is added to
 * run->damped.
 */
void conversion_update_mesh_after_conversion(struct run *run, int64_t converted_count);

/* Checks that the other settings of scene s (the input file) allow reversion (`conversion.reversion: true`), in which
 * peridynamic particles become material points again. Reversion requires conversion by stress, and partial stress or
 * hand-shake as coupling. It excludes growing cracks, a solver of a single equilibrium, and materials that yield.
 * Returns REFUSED, with a message, if one of these conditions is violated. Returns OK if the scene has no reversion. */
status reversion_check_scene_allows_return_to_mpm(const struct scene *s);

/* Turns peridynamic particles of the run back into material points if their stress has been low for long enough and no
 * bond near them was ever cut (reversion_select_particles_to_become_mpm). Called before each step; examines the
 * particles only in step numbers that are multiples of a period. Does nothing if the input file has no reversion. */
void reversion_convert_relaxed_particles_to_mpm(struct run *run);

#endif
