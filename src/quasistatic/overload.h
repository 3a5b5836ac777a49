/* Bonds whose stretch is beyond their critical stretch, and lists of broken bonds. */
#ifndef CLEAVE_OVERLOAD
#define CLEAVE_OVERLOAD

#include "bonds/bonds.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the largest ratio of stretch to critical stretch of all intact bonds [1]. */
real statics_overload(const struct bonds *b, const struct particles *p, const struct bond_limit *limit);

/* Breaks the bonds whose ratio of stretch to critical stretch is within `share` of the largest, `most` pairs and those
 * with the ratio of the last one, and adds them to the list of the next crack increment. Adds the energy that they hold
 * at their limits to *cost [J] and the area that they cross to *area [m^2]. Returns the number of directed bonds
 * broken. */
int64_t statics_break(struct run *e, real share, int64_t most, real *cost, real *area);

/* Breaks the bonds of a list. */
void statics_break_listed(struct run *e, const struct break_list *l);

/* Restores the bonds of a list, with energies and damage as they were before these bonds broke. */
void statics_mend(struct statics *s, struct bonds *b, struct particles *p, const struct break_list *l);

/* Appends a record to a list. */
void break_list_add(struct break_list *l, const struct broken_bond *record);

/* Returns the record of a bond of `row`, with half of the energy that the bond takes to its limit [J]. */
struct broken_bond statics_bond_record(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                       const struct bond *bond, int64_t row);

#endif
