/* Declares the storage of softening bonds in load steps (successive static equilibria). Between two equilibria such a
 * bond is a spring. Its secant stiffness belongs to a largest stretch k, which the search for the next equilibrium
 * chooses (softening_step.c). In state-based models k determines the weight of the bond (kernels/pd/state_soften.c). */
#ifndef CLEAVE_QUASISTATIC_SOFTENING
#define CLEAVE_QUASISTATIC_SOFTENING

#include "bonds/bonds.h"

/* A directed bond that softens or may begin to soften in load steps. settled: its largest stretch at the last
 * equilibrium, at least `onset`; onset, end: stretches at which the bond begins to soften and at which it breaks [1].
 * energy: factor [J] by which the normalised dissipation of its softening is multiplied; in bond-based models half of
 * stiffness times weight times length, since the other row of the bond has the other half. */
struct softening_bond {
    int64_t entry, row;               /* in the bond storage */
    real stretch;                     /* of the body at a factor of 1 [1] */
    real settled, onset, end, energy; /* k of the last equilibrium, at least the onset [1] */
};

/* List of the bonds of a run that soften or may begin to soften, for one load step. curve: shape of the softening law,
 * kept by reference. */
struct softening_bond_list {
    int64_t n;
    struct softening_bond *bond; /* [n] owned */
    const struct softening_curve *curve;
};

/* Lists in *l the intact bonds of b that soften or may begin to, in the order of rows, with their stretches at the
 * present displacements of p divided by `stretch_divisor` [1], the load factor of these displacements; the stretches at
 * another load factor follow by multiplication. Replaces the former contents of *l; free l->bond with memory_free. */
void softening_bond_list_collect(struct softening_bond_list *l, const struct bonds *b, const struct particles *p,
                                 real stretch_divisor);

/* Returns the energy [J] that the bonds of the list l would have dissipated by softening since the last equilibrium if
 * their stretches were `stretch_factor` times the stretches stored in the list. */
real softening_bond_list_dissipated_energy(const struct softening_bond_list *l, real stretch_factor);

/* Returns the smallest factor on the stretches of the list l, between 0 and `max_factor`, at which the bonds have
 * dissipated the energy `energy` since the last equilibrium [J] (softening_bond_list_dissipated_energy). At the factor
 * `max_factor` they must have dissipated at least `energy`. */
real softening_bond_list_stretch_factor_at_energy(const struct softening_bond_list *l, real energy, real max_factor);

/* Sets the largest stretch in b of each bond of the list l to that of the last equilibrium or, if larger, to
 * `stretch_factor` times the stretch stored in the list. */
void softening_bond_list_store_largest_stretches(const struct softening_bond_list *l, struct bonds *b,
                                                 real stretch_factor);

/* Stores the present largest stretches of the bonds b of the particles p as those of the last equilibrium, from which
 * later equilibrium solutions start. Bonds whose stretch has not exceeded their onset of softening are stored as not
 * yet softening, so that the stress across them is compared with the strength again. limit: critical stretches and
 * softening of bonds. The first call allocates storage in b->soft; from then on forces are computed from the stored
 * largest stretches. */
void bonds_store_max_stretches_at_last_equilibrium(struct bonds *b, const struct particles *p,
                                                   const struct bond_limit *limit);

/* For state-based models, computes the energy that the neighbourhood of each particle (all its neighbours) loses over a
 * part of a load step because bonds of b soften, and adds it to the fracture energy of the row of the particle (its
 * bonds). The largest stretches of the last equilibrium in b->soft.settled are raised to those at the end of the part,
 * but not above those at the end of the step. midway, end: particles at the positions in the middle and at the end of
 * the part; the loss is that at `midway`, so that its error is of second order in the size of the part. is_last_part:
 * the part is the last one of the step. */
void bonds_add_softening_losses_to_fracture_energy(struct bonds *b, const struct particles *midway,
                                                   const struct particles *end, bool is_last_part);

/* Returns the largest growth of the stretch of a bond of b that has softened in the present load step, divided by the
 * difference of the stretches between which it softens [1]. before, now: particles at the last and at the present
 * equilibrium. */
real bonds_largest_stretch_growth_per_softening_range(const struct bonds *b, const struct particles *before,
                                                      const struct particles *now);

/* Resets the largest stretches of all softening bonds of b to those of the last equilibrium, which
 * bonds_store_max_stretches_at_last_equilibrium has stored, so that another solution can start from there. */
void bonds_restore_max_stretches_at_last_equilibrium(struct bonds *b);

#endif
