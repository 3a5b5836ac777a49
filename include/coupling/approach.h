/* Material points that come near another body: they become peridynamic, and then meet it as particles do. */
#ifndef CLEAVE_APPROACH
#define CLEAVE_APPROACH

#include "data/particles.h"
#include "rigid/rigid.h"

/* Steps between two searches, and how near a foreign particle is then [spacings]: contact begins at one, and faces that
 * meet at a tenth of the wave speed come nearer by a quarter of one in five steps. */
enum { APPROACH_STEPS = 5 };
#define APPROACH_REACH 3.0

/* Sets FLAG_NEAR of the material points within `reach` of a particle of another body or of a rigid body [m], and begins
 * the time anew at which peridynamic ones there may become material points. bodies: numbers of particles are below. */
void approach_mark(struct particles *p, int bodies, const struct rigid_body *rigid, int rigids, real reach);

#endif
