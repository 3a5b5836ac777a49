/* Bonds whose factors are given, not fitted: those of thin parts and at the ends of cracks. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bonds_parts.h"
#include "surface_parts.h"

/* Is the particle beside the end of a crack: cut from one that a neighbour of its still reaches? */
static bool at_crack_end(const struct near_faces *b, int64_t t)
{
    const struct offsets *o = &b->offset;
    const struct particles *p = b->p;
    if (!cracks_near(b->source, p, b->particle[t])) return false;
    for (int k = 0; k < o->n; k++) {
        const int32_t j = neighbour_of(b, t, k);
        if (j < 0) continue;
        const struct seen seen = seen_of(b, j);
        for (int l = 0; l < o->n && b->place[seen.particle] >= 0; l++) {
            int place = 0;
            bool within = seen_beyond(b, &seen, l).particle >= 0;
            for (int d = o->dim - 1; d >= 0; d--) {
                const int at = o->at[k][d] + o->at[l][d];
                within = within && abs(at) <= o->reach;
                place = place * (2 * o->reach + 1) + o->reach + at;
            }
            if (within && o->number[place] >= 0 && neighbour_of(b, t, o->number[place]) < 0) return true;
        }
    }
    return false;
}

static int neighbours(const struct near_faces *b, int64_t t)
{
    int n = 0;
    for (int k = 0; k < b->offset.n; k++) n += neighbour_of(b, t, k) >= 0;
    return n;
}

static bool may_break(const struct bond_limit *limit)
{
    bool breaks = false;
    for (int k = 0; k < limit->materials * limit->materials; k++) breaks |= isfinite(limit->critical_stretch[k]);
    return breaks;
}

/* Bonds of thin parts, for which there are too few layers, and at the ends of cracks take the factor of the volume
 * method (Le & Bobaru 2018), in models with rotations none. Where bonds may break those at the ends of cracks are next:
 * they keep their weights, for which G_c is calibrated (else Kalthoff's crack turns to 61 degrees at 1 mm). */
void surface_plain(real *x, uint8_t *fixed, const struct near_faces *b, const struct faces *f, const struct alike *a,
                   bool rotates)
{
    const int n = b->offset.n;
    const bool breaks = may_break(&b->source->limit);
    for (int32_t class = 1; class < a->classes; class++) {
        const int64_t t = a->member[class];
        const bool end = at_crack_end(b, t), plain = f->thin[t] || end;
        for (int k = 0; k < n && plain; k++) {
            const int64_t g = a->group_of[(int64_t)class * n + k];
            if (g < 0) continue;
            const int64_t other = b->place[seen_of(b, alike_neighbour(a, b, class, k)).particle];
            const real both = neighbours(b, t) + neighbours(b, other);
            const real volume = fmin(fmax(2.0 * n / both, SURFACE_LEAST), SURFACE_MOST);
            x[g] = rotates || (end && breaks) ? 1 : volume, fixed[g] = 1;
        }
    }
}
