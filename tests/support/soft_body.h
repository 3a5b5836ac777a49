/* A body of cloud.h whose bonds soften, for tests. */
#ifndef CLEAVE_TESTS_SOFT_BODY
#define CLEAVE_TESTS_SOFT_BODY

#include "kernels/kernels.h"
#include "tests/support/cloud.h"

/* A body (cloud.h) together with the softening law of its bonds, the same for each pair of materials. */
struct soft_body {
    struct particle_cloud c;
    struct softening_curve curve;
    struct softening_pair pair[CLOUD_MATERIALS * CLOUD_MATERIALS];
};

/* Creates the bonds of the body s->c, which soften by the law `law`, for all pairs of materials. onset: stretch at
 * which softening begins [1]; critical: critical stretch of a brittle bond with the same fracture energy [1]. Call this
 * function after particle_cloud_make, in place of cloud_bonds. */
static inline void soft_bonds(struct soft_body *s, enum softening law, real onset, real critical)
{
    s->curve = softening_curve_of_law(law);
    cloud_source(&s->c);
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++)
        s->pair[k] = (struct softening_pair){.onset = onset}, s->c.limit[k] = critical;
    s->c.source.yield.stretch = NULL;
    s->c.source.limit.softening = s->pair, s->c.source.limit.curve = &s->curve;
    s->c.source.limit.last_force = LAST_FORCE_NONE;
    s->c.source.limit.retries = true;
    bonds_make(&s->c.bonds, NULL, &s->c.p, &s->c.source);
}

#endif
