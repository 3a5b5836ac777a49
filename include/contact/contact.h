/* Room `contact` (folder of include/ and src/): forces between peridynamic particles that have no bond: crack
 * faces, fragments, different bodies, and rigid bodies. The room uses particles, cells, bonds and loads,
 * neither scenes (input files) nor the time step; the engine uses it.
 *
 * The contact law has two forms. Both push faces apart by k times the overlap, with k = 15 c V_i V_j/delta
 * per particle of a face: the usual short-range stiffness of peridynamics (Silling & Askari 2005), with the
 * micro-modulus c, the volumes V, and delta = 3.015 spacings for any horizon. Contact is thus as stiff as a
 * cell of the material. Both forms derive from the energy 1/2 k overlap^2.
 *
 *     surface  the position of the smooth face beside a particle follows from the density of its particles
 *              (contact_face.c); contact begins one spacing above the first layer of the face
 *     pair     each pair of particles closer than d, one spacing, is pushed apart along its line of centres
 *              (contact_pair.c); sliding faces interlock like gears
 *
 * Bodies and faces thus touch at their true surfaces. If particles are closer than this distance in the
 * reference configuration, or when contact becomes possible (bonds broken under pressure), contact begins at
 * their distance then, until the gap opens. There is no overlap in the reference configuration or when a bond
 * breaks, and no energy appears.
 *
 * Only particles near a face can be in contact: those of the first layer of a body, and those that have lost
 * a bond. */
#ifndef CLEAVE_CONTACT
#define CLEAVE_CONTACT

#include "loads/active_rows.h"
#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"
#include "rigid/rigid.h"
#include "scene/requests.h"

/* Number of entries of the table struct contact_profile. */
enum { PROFILE_NODES = 86 };

/* Table by which contact of the form `surface` finds the face beside a particle: depth of the face below the particle
 * as a function of the density of the particles of the face at this particle (contact_face.c). */
struct contact_profile {
    /* nodes of the table: density [1], depth [spacings], derivative of the depth by the density [spacings] */
    real density[PROFILE_NODES], depth[PROFILE_NODES], slope[PROFILE_NODES];
};

/* Law of contact between particles: which particles can be in contact, form of the law, stiffness, friction, and the
 * geometry on which these depend. Only `stiffness` is owned; the other arrays must outlive the law. */
struct contact_law {
    enum contact_between between;   /* allowed between: no particles, different bodies, all particles */
    enum contact_form form;         /* contact of faces (`surface`) or of pairs of particles (`pair`) */
    enum contact_distance distance; /* form `pair`: rule for the contact distance */
    struct contact_profile profile; /* form `surface`: depth below a face by its density */
    real friction;                  /* coefficient of friction [1] */
    int materials;                  /* number of materials */
    real *stiffness; /* [materials^2] k/(V_i V_j) by pair of materials: contact stiffness k divided by the volumes of
                        both particles [N/m^7] */
    real spacing, section;     /* of the lattice [m]; thickness or cross section (lattice_particle_volume) */
    const struct image *image; /* [n_all - n] origins of the mirror images of particles (loads.image) */
    const struct crack *crack; /* [cracks] pre-cracks; cracks with a width are notches */
    int cracks;
    const struct region *const *shape; /* [bodies] shape of each body, NULL for a body made from a list of particles */
};

/* Friction of a particle in contact, modelled by a spring along the face: the particle stretches the spring until the
 * force of the spring reaches the coefficient of friction times the normal force, and slides from then on. */
struct contact_spring {
    real length[DIM_MAX]; /* elongation [m] */
    real drag[DIM_MAX];   /* force on the particle [N] */
    real density; /* sum of the weights (contact_density_contribution) by which particles of the face share the reaction
                   */
    real stored, lost; /* stored energy [J]; work of friction since the last search [J] */
};

/* Data by which the reaction to the force of a friction spring is distributed over the particles of the face
 * (contact_friction.c): in proportion to their weights, plus a couple that balances the moment. Recomputed from the
 * spring in every step. */
struct contact_reaction {
    real arm[DIM_MAX];  /* from the weighted mean position of the face to the particle [m] */
    real turn[DIM_MAX]; /* moment of the drag about that position, divided by the moment of inertia [N/m] */
};

/* Contact of a particle with the faces of other bodies or fragments beside it. The energy of this contact is 1/4 k
 * gap^2 if gap < 0, else 0, with the stiffness k and the gap in spacings (contact_face.c). */
struct contact_face {
    real zero;      /* height above the face at which contact begins [spacings] */
    real stiffness; /* stiffness k [J] */
    real far;       /* smallest possible gap at the last search, 0 or more [spacings] */
    /* derivative of the energy by the density of the face [J]; derivative by `mean`, divided by the density [J]; mean
     * height of the surface of the body above the particles of the face, minus 1/2 [spacings] */
    real push, lift, mean;
};

/* Account of the energy errors that leap-frog makes when one contact begins or ends between two time steps. While more
 * energy has been added than removed, a correcting force against the rate of the gap acts (contact_balance.c). */
struct contact_leapfrog_error_account {
    real gap, older; /* gaps of the last two steps [spacings] */
    real drag;       /* correcting force: derivative of the energy by the gap, against the rate of the gap [J] */
    real account;    /* energy added minus energy removed [J] */
};

/* Particles near one rigid body, n in number, that may touch it before the next search; owned by struct contact. row:
 * [n] entries of these particles in the contact list (struct contact), ascending; zero: [n] gap at which contact
 * begins, 0 or less [m]; x, turn: position [m] and rotation matrix of the body at the last search; spring, balance: [n]
 * friction and energy correction; touch: [n] 1 if the contact is selected to act in an equilibrium solution. */
struct contact_near {
    int64_t n;
    int32_t *row;
    real *zero, x[DIM_MAX], turn[DIM_MAX * DIM_MAX];
    struct contact_spring *spring;
    struct contact_leapfrog_error_account *balance;
    uint8_t *touch;
};

/* A contact between n particles that acts as a linear spring of energy 1/2 stiffness gap^2. The gap is in m, but in
 * spacings for contact laws of the form `surface` (smooth faces). The gap changes at the rate sum_k along[k] . v[k],
 * where v[k] is the velocity of particle k. */
struct contact_term {
    int n;
    int32_t *particle;      /* [n] mirror images included */
    real (*along)[DIM_MAX]; /* [n] derivative of the gap by the position [1]; form `surface`: [1/m] */
    real stiffness;         /* [N/m], form `surface`: [J] */
};

/* All contacts of a run, by the law `law`. Pairs of particles that may be in contact before the next search are stored
 * in contact rows, one row for each particle that may be in contact (none for mirror images). A pair is in the rows of
 * both its particles, so that each row is computed by one thread. Arrays are owned unless noted. */
struct contact {
    struct contact_law law;
    bool made;         /* a search has been done, so that the rows exist */
    int64_t n, rows;   /* number of listed particles, mirror images included; number of rows: listed particles of the
                          body,   which are first in the list */
    int32_t *particle; /* [n] indices of the listed particles, ascending */
    int32_t *root;     /* [n] row of a particle; of a mirror image the row of the particle of which it is an image */
    real *size;        /* [n] spacing of each particle [m] */
    real *rise;        /* [n] height of the surface of the body above the particle, minus 1/2 [spacings] */
    real *at[DIM_MAX]; /* [n] positions at the last search [m] */
    int64_t *first;    /* [rows + 1] the pairs of row k are first[k] .. first[k + 1] - 1 */
    int64_t pairs;
    int32_t *other;            /* [pairs] second particle, an index in `particle`, ascending within a row */
    real *distance;            /* form `pair`: [pairs] contact distance d [m] */
    struct contact_face *face; /* form `surface`: [rows] contact of the particle with faces beside it */
    struct contact_leapfrog_error_account
        *balance;                      /* form `surface`: [rows] correction of the energy error of this contact */
    struct contact_spring *spring;     /* [rows] springs of friction; NULL: no friction */
    struct contact_reaction *reaction; /* [rows] how their reaction is distributed; NULL: no friction */
    uint8_t *followed;                 /* [rows] enum row_state (contact_internal.h) */
    bool marked;                       /* equilibria: exactly the marked contacts act, with either sign of the gap */
    uint8_t *touch;                    /* marks: form `surface` [rows], form `pair` [pairs]; NULL: none */
    bool by_overlap;                   /* the marks exist but are ignored at present: contacts act where they overlap */
    int64_t waiting;                   /* number of rows that may come into contact once their particles move */
    real friction_work;                /* work of friction up to the last search [J] */
    int rigids;
    struct rigid_body *rigid;  /* [rigids] rigid bodies, kept by reference */
    struct contact_near *near; /* [rigids] particles near each rigid body; NULL before the first search */
    real moved;                /* largest displacement of a particle since the last search [m] */
    int64_t searched, broken;  /* at the last search: number of the step; number of bonds broken so far, each counted
                                  once for each of its particles */
    int64_t changed;     /* number of conversions and reversions at which the states `followed` were last updated */
    bool due;            /* a search is due regardless of displacements */
    int64_t pairs_most;  /* largest number of pairs in contact at a time */
    real overlap;        /* largest overlap d - r in the last step [m] */
    real overlap_most;   /* largest overlap of the run [m] */
    int32_t deepest;     /* index of a particle of the pair with the largest overlap; -1: none */
    bool overlap_said;   /* the warning of large overlaps has been printed */
    real began, ended;   /* first and last time of contact; NAN: none so far [s] */
    int64_t touching;    /* number of pairs in contact in the last step, each counted once for each of its particles */
    bool recorded;       /* contact forces of the next step are recorded in `push` */
    real *push[DIM_MAX]; /* [particles of the body] recorded contact forces; NULL: not recorded [N] */
};

/* Initialises the contact c of a run, without a search for pairs. between: which bodies can be in contact; law: form,
 * contact distance and friction, of which a copy is kept. The stiffness of contacts is computed here from the elastic
 * constants of the bonds times `stiffness_factor` [1]. source: bond law with spacing and pre-cracks; body_shapes:
 * region of each body; rigid: `rigid_body_count` rigid bodies. `body_shapes` and `rigid` are kept by reference and must
 * outlive c. Release with contact_free. */
void contact_make(struct contact *c, enum contact_between between, struct contact_law law, real stiffness_factor,
                  const struct bond_source *source, const struct region *const *body_shapes, struct rigid_body *rigid,
                  int rigid_body_count);

/* Frees the arrays of the contact c. The rigid bodies and shapes that were passed to contact_make stay with the
 * caller. */
void contact_free(struct contact *c);

/* Returns the critical time step [s] of particles of p that are pushed by forces of the contact c on one side and held
 * by bonds on the other. materials: array of the materials; bonds_time_step: critical time step of the bonds alone [s].
 * Returns INFINITY if contact is not possible in the run. */
real contact_critical_time_step(const struct contact *c, const struct particles *p, const struct material *materials,
                                real bonds_time_step);

/* Updates the list of pairs of particles of p that may come into contact, before time step number `step_number`. A new
 * search is done in three cases: particles have moved farther than contact_pair_list_safe_displacement since the last
 * search; bonds have been broken since then, and that search was made at least 32 steps before; or a search was
 * requested (c->due). Marks in `loads` the particles on which contact forces may act, and in b their bonds as active,
 * i.e. to be computed. family: horizon and lattice; broken_bond_count: number of bonds broken so far, each counted once
 * for each of its particles; conversion_count: number of changes so far between material points and peridynamic
 * particles. */
void contact_update_pair_list_if_outdated(struct contact *c, const struct particles *p, struct bonds *b,
                                          struct loads *loads, const struct family *family, int64_t step_number,
                                          int64_t broken_bond_count, int64_t conversion_count);

/* Requests a search for pairs of the contact c before the next time step, if particles at the surface of a body have
 * become peridynamic. particle_list[particle_count]: indices of the particles that have become peridynamic. A particle
 * is at the surface if it has fewer bonds in b than a particle inside a body. family: horizon and lattice. Does nothing
 * if contact is not possible in this run. */
void contact_request_search_if_particles_at_surface(struct contact *c, const struct bonds *b,
                                                    const struct family *family, const int32_t *particle_list,
                                                    int64_t particle_count);

/* Marks in `loads` the particles of p on which forces of the contact c may act, and in b the bonds of these particles
 * as active, i.e. to be computed. Needed after a restart only; contact_update_pair_list_if_outdated does this, too. */
void contact_restore_active_particles_after_restart(struct contact *c, const struct particles *p, struct bonds *b,
                                                    struct loads *loads);

/* Computes the contact forces at the present positions, adds them to p->f and to the forces on rigid bodies, and
 * updates the largest overlap c->overlap. To be called after the forces of bonds and before those of loads. dt: time
 * [s] for which particles have moved with p->v since the last call, by which friction springs are stretched. */
void contact_compute_forces(struct contact *c, struct particles *p, real dt);

/* Allocates c->push, in which contact_compute_forces stores the contact force on each particle of p while c->recorded
 * is true. Does nothing if contact is not possible in this run, or if the array exists. contact_free releases it. */
void contact_allocate_particle_forces(struct contact *c, const struct particles *p);

/* Records the times of first and last contact of the run: if particles were in contact at the last call of
 * contact_compute_forces, c->ended becomes t [s], and c->began, too, if it is still NAN. */
void contact_record_first_and_last_contact_time(struct contact *c, real t);

/* Returns the elastic energy [J] of all contacts c at the present positions of the particles p, including contacts with
 * rigid bodies and friction springs. A pair with a mirror image of a particle (copy beyond a plane of symmetry) counts
 * half. */
real contact_elastic_energy(const struct contact *c, const struct particles *p);

/* Returns the diagonal [m] of the bounding box of all particles of p that touch rigid body number `rigid_body` (from 0)
 * of c at present; 0 if none does. */
real contact_patch_bounding_box_diagonal(const struct contact *c, const struct particles *p, int rigid_body);

/* Returns the energy [J] that friction in the contact c has dissipated since the start of the run. */
real contact_friction_dissipated_energy(const struct contact *c);

/* Searches for the pairs of particles of p that may come into contact, and selects those contacts of c that act in an
 * equilibrium solution: contacts that overlap, and contacts between different bodies whose gap is less than `max_gap`
 * [spacings]. Marks in `loads` the particles on which contact forces may act, and in b their bonds as active, i.e. to
 * be computed. Selected contacts act as linear springs, also with a positive gap, until the next selection, so that
 * forces are smooth. An equilibrium satisfies the contact law if exactly the overlapping contacts are selected. Forces
 * that correct the energy error of earlier time steps (struct contact_leapfrog_error_account) are set to 0. family:
 * horizon and lattice. Returns the number of contacts whose selection changed. */
int64_t contact_search_and_select_linear_springs(struct contact *c, const struct particles *p, struct bonds *b,
                                                 struct loads *loads, const struct family *family, real max_gap);

/* Selects the contacts of particles p that act in an equilibrium solution, from the existing list of pairs in c:
 * contacts that overlap, and contacts between different bodies whose gap is less than `max_gap` [spacings]. Selected
 * contacts act as linear springs, also with a positive gap, until the next selection. A contact whose gap is 0 within
 * round-off stays as it was. Returns the number of contacts whose selection changed. */
int64_t contact_select_linear_springs_and_count_changes(struct contact *c, const struct particles *p, real max_gap);

/* Chooses which contacts of c act when forces are computed next. springs_only: true for the contacts that
 * contact_select_linear_springs_and_count_changes has selected for an equilibrium, which act as linear springs with
 * either sign of the gap; false for all contacts that overlap. */
void contact_restrict_forces_to_linear_springs(struct contact *c, bool springs_only);

/* Ends the selection of contacts of c for an equilibrium: from now on all contacts that overlap act again. Requests a
 * search for pairs before the next time step. */
void contact_discard_linear_springs(struct contact *c);

/* Returns true if a search for pairs of the contact c is necessary: none has been done, or particles of p or rigid
 * bodies have moved so far since the last one that pairs missing in the list could be in contact. Updates c->moved, the
 * largest displacement since the last search. */
bool contact_search_is_needed(struct contact *c, const struct particles *p);

/* Returns the largest distance [m] that each particle may move before a new search for pairs of the contact c is due.
 * As long as no particle has moved farther, no pair that is missing in the list can come into contact. */
real contact_pair_list_safe_displacement(const struct contact *c);

/* Calls visit(context, term) for each contact of c selected by contact_select_linear_springs_and_count_changes, for the
 * assembly of a stiffness matrix or similar. term: the contact between particles of p as a linear spring, valid during
 * the call only. Does nothing if no selection has been made. */
void contact_visit_linear_springs(const struct contact *c, const struct particles *p,
                                  void (*visit)(void *context, const struct contact_term *term), void *context);

/* Returns the root of the sum of squares [N] of those forces of the contact c that rigid bodies exert on particles of
 * p. Serves as a scale for the residual of an equilibrium. */
real contact_rigid_body_force_norm(const struct contact *c, const struct particles *p);

/* Saves the list of pairs of c with contact distances, friction springs and energies to the archive `a` if a->saving,
 * else restores all of these. p: the particles. Returns FAILED, with a message, if the archive cannot be read or
 * written, or if a restored list has indices or counts that do not fit the particles. */
status contact_save_or_load(struct contact *c, const struct particles *p, struct archive *a);

#endif
