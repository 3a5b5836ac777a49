/* Private header of the files of the crack tips. */
#ifndef CLEAVE_TIPS_PARTS
#define CLEAVE_TIPS_PARTS

#include "fracture/tips.h"

enum { TIP_BEFORE = 255 }; /* label of particles damaged by a pre-crack */

#define TIP_TOUCH 1.5       /* distance within which particles of one crack touch [spacings] */
#define TIP_START_REACH 2.5 /* range of the first damaged particles from the end of a pre-crack [spacings] */
#define TIP_EQUAL 1e-6      /* tolerance of equal lengths [spacings] */

/* Particles are tested in pieces of this size: only peridynamic particles lose bonds, and they stay peridynamic
 * afterwards, so that their list suffices; most of them are neither damaged nor part of a crack. */
enum { TIP_PIECE = 64 };

/* Returns the end of the piece of the list that starts at `first`. */
static inline int64_t tip_piece_end(const struct particles *p, int64_t first)
{
    return first + TIP_PIECE < p->n_of[KIND_PD] ? first + TIP_PIECE : p->n_of[KIND_PD];
}

/* Returns true if the n >= 1 particle numbers at[0 .. n - 1], which must be strictly ascending, are consecutive. Flags
 * of consecutive particles are tested eight at a time. */
static inline bool tip_piece_consecutive(const int32_t *at, int64_t n) { return at[n - 1] - at[0] == n - 1; }

/* Extent of a crack from its start [m], position of its end, particles, and groups equally far within a spacing. */
struct tip_reach {
    real farthest, place[DIM_MAX];
    int64_t ends, particles;
};

/* Measures the extents of all cracks. reach: [TIPS_MAX], 0 on entry. */
void tip_reaches(const struct tips *t, const struct particles *p, struct tip_reach *reach);

struct tip_search {
    const struct particles *p;
    const struct cells *c;
    int32_t *found; /* result of the last search, particles and images */
    int room;
};

/* Finds the particles and images within `radius` of X [m]; s->found grows as needed and is freed by the caller at the
 * end. Returns their number. */
int tip_search_near(struct tip_search *s, const real *X, real radius);

/* Computes the vector from the nearest point of the segment centre -+ half to X. Returns its length [m]. */
real tip_offset(const real *centre, const real *half, const real *X, int dim, real *offset);

/* Adds a tip at `origin` without growth. along: direction, NULL: x axis. Returns the tip. */
struct tip *tip_add(struct tips *t, int body, const real *origin, const real *along);

#endif
