/* Declarations shared by the files of the crack tips. */
#ifndef CLEAVE_TIPS_PARTS
#define CLEAVE_TIPS_PARTS

#include "fracture/tips.h"

enum { TIP_BEFORE = 255 };               /* label of particles damaged by a pre-crack                 */

struct tip_search {
    const struct particles *p;
    const struct cells *c;
    int32_t *found;                      /* indices of the last search, body and images */
    int room;
};

/* Finds the particles and images within `radius` of X [m], into s->found, which grows as needed; the caller frees
 * s->found at the end. Returns their number. */
int tip_search_near(struct tip_search *s, const real *X, real radius);

/* Vector from the nearest point of the segment centre -+ half to X, and its length. */
real tip_offset(const real *centre, const real *half, const real *X, int dim, real *offset);

/* A tip at `origin` that has not grown; `along` NULL: the x axis. */
struct tip *tip_add(struct tips *t, int body, const real *origin, const real *along);

#endif
