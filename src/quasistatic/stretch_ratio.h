/* Declares the functions that break bonds beyond their critical stretch, and the lists of broken bonds from which a
 * trial equilibrium restores them. */
#ifndef CLEAVE_STRETCH_RATIO
#define CLEAVE_STRETCH_RATIO

#include "bonds/bonds.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the largest ratio [1] of stretch to critical stretch among all intact bonds b of the particles p; bonds must
 * break if it exceeds 1. limit: critical stretches. */
real bonds_largest_stretch_ratio(const struct bonds *b, const struct particles *p, const struct bond_limit *limit);

/* Breaks the intact bonds of the run with the largest ratios of stretch to critical stretch: those whose ratio differs
 * from the largest one by at most the fraction `ratio_tolerance` [1]. No more than `max_pairs` pairs of particles are
 * separated, plus pairs whose ratio equals that of the last one up to round-off. Appends the bonds to the list of the
 * next crack increment (statics.next). Adds their energy at the critical stretch to *added_energy [J], and the crack
 * area that corresponds to it to *added_crack_area [m^2]. Returns the number of directed bonds broken (a bond between
 * two particles counts twice). */
int64_t bonds_break_overstretched(struct run *run, real ratio_tolerance, int64_t max_pairs, real *added_energy,
                                  real *added_crack_area);

/* Breaks all bonds of the list l in the run. Each adds its energy at the critical stretch (member `held` of its record)
 * to the fracture energy, even if its present stretch differs. The difference from its present energy is added to the
 * energy lost by the solver and by the run. */
void bonds_break_listed(struct run *run, const struct break_list *l);

/* Restores the broken bonds in the list l: the bonds in b, energies and damage of their rows (a row: all bonds of one
 * particle), the flags of the particles p, and the energies in s, the state of the load steps. The bonds in l must be
 * those that were broken last. */
void bonds_restore_broken(struct statics *s, struct bonds *b, struct particles *p, const struct break_list *l);

/* Appends a copy of *record to the list l, whose array grows as needed; free l->bond with memory_free. */
void break_list_add(struct break_list *l, const struct broken_bond *record);

/* Returns a record of the intact bond `bond` of b (particles p), from which bonds_restore_broken can restore it after
 * it has been broken. row: index of its row (all bonds of one particle). limit: critical stretches; the member `held`
 * of the record is half of the energy of the bond at its critical stretch [J], since the row of the other particle has
 * the other half. */
struct broken_bond broken_bond_make_record(const struct bonds *b, const struct particles *p,
                                           const struct bond_limit *limit, const struct bond *bond, int64_t row);

#endif
