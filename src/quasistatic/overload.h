/* Bonds whose stretch exceeds the critical stretch, and lists of broken bonds. */
#ifndef CLEAVE_OVERLOAD
#define CLEAVE_OVERLOAD

#include "bonds/bonds.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the largest ratio of stretch to critical stretch of all intact bonds [1]. */
real largest_stretch_ratio(const struct bonds *b, const struct particles *p, const struct bond_limit *limit);

/* Breaks the intact bonds with the largest ratios of stretch to critical stretch: those within `share` of the largest
 * ratio, but at most `most` pairs and further pairs whose ratio equals that of the last one to round-off. Appends the
 * bonds to the list of the next crack increment, and adds their energy at the critical stretch to *cost [J] and the
 * crack area that corresponds to it to *area [m^2]. Returns the number of directed bonds broken. */
int64_t bonds_break_overstretched(struct run *e, real share, int64_t most, real *cost, real *area);

/* Breaks the bonds of a list. The energy that exceeds the cost of a bond (`held`) is added to the losses of the solver
 * and of the run. */
void bonds_break_listed(struct run *e, const struct break_list *l);

/* Restores the bonds of a list, which must be the bonds broken last, and the energies, damage and flags of their rows
 * and particles. */
void bonds_mend(struct statics *s, struct bonds *b, struct particles *p, const struct break_list *l);

/* Appends a copy of a record to a list. */
void break_list_add(struct break_list *l, const struct broken_bond *record);

/* Returns the record of an intact bond of row `row`, with half of its energy at the critical stretch [J]. */
struct broken_bond bond_record(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                               const struct bond *bond, int64_t row);

#endif
