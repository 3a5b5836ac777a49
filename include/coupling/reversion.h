/* Reversion: peridynamic particles become material points where no bond was ever cut and the stress has stayed low. */
#ifndef CLEAVE_REVERSION
#define CLEAVE_REVERSION

#include "conversion.h"

/* Conditions under which peridynamic particles become material points again. source: inputs of the bonds. */
struct reversion_rule {
    const struct bond_source *source;
    const struct elastic *elastic; /* [materials] with the stress at which points convert */
    const struct region *kept;     /* region whose particles always stay peridynamic; NULL: none */
    real low_stress;               /* largest stress for reversion, divided by the stress at which points convert [1] */
    real hold_time;                /* time for which the stress must have been low [s] */
};

/* Selects the peridynamic particles of p that may become material points at time t [s], by their present stress (call
 * bonds_compute_particle_stress before). b: the bonds. Also updates p->low_since, the time since which the stress of
 * each particle is low. *selected receives the indices of the selected particles in ascending order, an array that the
 * caller frees. Returns the number of selected particles. A particle is selected if three conditions hold. The particle
 * is outside the region rule->kept, and its stress and that of all peridynamic particles of its neighbourhood have been
 * low for rule->hold_time. No bond of the particle or of a particle within two horizons was ever cut, by load or by a
 * pre-crack. The particle is inside a ball with the radius of one horizon that will contain material points only. By
 * the third condition the remaining peridynamic regions consist of full neighbourhoods, as when material points are
 * converted, and regions that become material points are at least two horizons wide. */
int64_t reversion_select_particles_to_become_mpm(const struct reversion_rule *rule, struct particles *p,
                                                 const struct bonds *b, real t, int32_t **selected);

/* Turns the peridynamic particles of p in particle_list[particle_count] (indices) into material points. Their stress
 * follows from the bonds that cross their cells (state-based models: from the virial of the neighbourhood), their
 * volume from the determinant of the deformation gradient of the family. The velocity gradient becomes 0; positions and
 * velocities are unchanged. Beside a surface the stress is that of a full neighbourhood under the same strain. Rebuilds
 * the bonds b and, if `partial` is not NULL, the partial stresses (parts of stresses that bonds carry) around the
 * particles. Counts the reversion in c. source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void reversion_convert_listed_particles_to_mpm(struct conversion *c, struct particles *p, struct bonds *b,
                                               const struct bond_source *source, struct partial_stress *partial,
                                               const int32_t *particle_list, int64_t particle_count);

#endif
