/* Declarations shared by the files of the crack tips. */
#ifndef CLEAVE_TIPS_PARTS
#define CLEAVE_TIPS_PARTS

#include "fracture/tips.h"

enum { TIP_BEFORE = 255 }; /* label of particles damaged by a pre-crack                 */

#define TIP_TOUCH 1.5       /* particles of one crack touch within this      [spacings]  */
#define TIP_START_REACH 2.5 /* first damaged particles from the crack's end  [spacings]  */
#define TIP_EQUAL 1e-6      /* lengths that differ by less are equal         [spacings]  */

/* Peridynamic particles alone lose bonds, and stay peridynamic once they have: only their list is looked at. Most of
 * them are neither damaged nor part of a crack, and are skipped a piece of the list at a time. */
enum { TIP_PIECE = 64 };

static inline int64_t tip_piece_end(const struct particles *p, int64_t first)
{
    return first + TIP_PIECE < p->n_of[KIND_PD] ? first + TIP_PIECE : p->n_of[KIND_PD];
}

/* Are n listed particles consecutive, as most are? Then eight are looked at at a time. */
static inline bool tip_piece_consecutive(const int32_t *at, int64_t n) { return at[n - 1] - at[0] == n - 1; }

/* How far a crack reaches from its start [m], the place, its particles, ends that are as far within a spacing. */
struct tip_reach {
    real farthest, place[DIM_MAX];
    int64_t ends, particles;
};

/* Measures all cracks, into reach [TIPS_MAX], which is 0 before. */
void tip_reaches(const struct tips *t, const struct particles *p, struct tip_reach *reach);

struct tip_search {
    const struct particles *p;
    const struct cells *c;
    int32_t *found; /* indices of the last search, body and images */
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
