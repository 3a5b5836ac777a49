/* Peridynamic particle -> material point, where nothing was ever cut and the stress has stayed low. */
#ifndef CLEAVE_REVERSION
#define CLEAVE_REVERSION

#include "conversion.h"

/* The rule of reversion. */
struct reversion_rule {
    const struct bond_source *source;
    const struct elastic *elastic; /* [materials] with the stress that converts */
    const struct region *kept;     /* stays peridynamic; NULL: nothing */
    real low_stress;               /* share of that stress below which its stress is low */
    real hold_time;                /* how long it must have been [s] */
};

/* Checks every peridynamic particle, by its present stress (run_stress before), at intervals of the caller. Returns
 * how many may become material points, and the ascending list of them, which the caller frees. A
 * particle may if
 *     it and all peridynamic particles of its family have had a low stress for the hold time, outside `kept`;
 *     no bond of it or of a particle within two horizons was ever cut, by load or by a pre-crack;
 *     it lies in a ball of one horizon that holds, then, material points only.
 * So what stays is made of whole families, as conversion makes them, and what reverts is no thinner. */
int64_t reversion_choose(const struct reversion_rule *rule, struct particles *p, const struct bonds *b, real t,
                         int32_t **list);

/* The listed particles become material points: stress from the bonds that cross their cells (state-based models: the
 * virial of the family), volume from det F of the family, velocity gradient 0; places and velocities stay. Where a
 * surface leaves bonds out, stress is that of full families under the same strain. Rows of bonds are made anew, and
 * partial stresses (NULL: none) round them. */
void reversion_apply(struct conversion *c, struct particles *p, struct bonds *b, const struct bond_source *source,
                     struct partial_stress *partial, const int32_t *list, int64_t n);

#endif
