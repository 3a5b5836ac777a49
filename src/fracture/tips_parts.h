/* What the files of the crack tips share. */
#ifndef CLEAVE_TIPS_PARTS
#define CLEAVE_TIPS_PARTS

#include "fracture/tips.h"

enum { TIP_BEFORE = 255 };               /* label of particles damaged by a pre-crack                 */

struct tip_search {
    const struct particles *p;
    const struct cells *c;
    int32_t *found;                      /* indices of the last search, body and images               */
    int room;
};

/* Particles within `radius` of X into s->found, whose room follows; free s->found at the end. */
int tip_search_near(struct tip_search *s, const real *X, real radius);

/* Vector from the nearest point of the segment centre -+ half to X, and its length. */
real tip_offset(const real *centre, const real *half, const real *X, int dim, real *offset);

/* A tip at `origin` that has not grown; `along` NULL: the x axis. */
struct tip *tip_add(struct tips *t, int body, const real *origin, const real *along);

#endif
