/* Caches the bonds of the last blocks of eight bond rows on a lattice. On a uniform lattice the neighbours of most
 * blocks are arranged as those of a recent block, whose stencil, weights and sums are then equal to the last bit and
 * need not be computed again. */
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"
#include "bonds/surface.h"

/* Number of recent blocks of eight rows (the bonds of eight particles) in the cache. It suffices for the different
 * blocks of a few lattice rows, inside and at their ends; empirical. */
enum { REMEMBERED = 32 };

/* Bonds of recent blocks of eight rows, for one thread. map: map of the lattice sites, borrowed. */
struct stencil_cache {
    const struct lattice_site_map *map;
    int n, next, last; /* number of entries of `cached`; index of the oldest; index of the entry found last */
    struct cached {
        int64_t i; /* first of the eight particles */
        struct lattice_bonds bonds;
    } cached[REMEMBERED];
};

struct stencil_cache *stencil_cache_make_for_thread(const struct lattice_site_map *map)
{
    struct stencil_cache *t = NEW("bonds.stencil_cache", 1, struct stencil_cache);
    t->map = map;
    return t;
}

void stencil_cache_free(struct stencil_cache *t)
{
    for (int k = 0; t && k < t->n; k++) {
        memory_free(t->cached[k].bonds.offset);
        memory_free(t->cached[k].bonds.from);
        memory_free(t->cached[k].bonds.to);
    }
    memory_free(t);
}

/* Returns true if two sets of eight consecutive particles have neighbours at the same index distances (neighbour minus
 * particle), and corresponding particles of both sets lack the same neighbours. a, b: bonds of both sets. */
static bool same_sites(const struct lattice_bonds *a, const struct lattice_bonds *b)
{
    return a->n == b->n && arrays_equal(a->offset, b->offset, a->n, sizeof *a->offset) &&
           arrays_equal(a->from, b->from, a->n, 1) && arrays_equal(a->to, b->to, a->n, 1);
}

/* Returns true if the array around[particles] has equal values at i .. i + 7 and j .. j + 7, and at the neighbours of
 * both sets of particles. b: bonds of both, whose index distances (neighbour minus particle) are equal. Consecutive
 * index distances are compared at once. */
static bool same_around(const real *around, const struct lattice_bonds *b, int64_t i, int64_t j)
{
    if (memcmp(around + i, around + j, LANES * sizeof *around) != 0) return false;
    for (int k = 0, run; k < b->n; k += run) {
        const int64_t offset = b->offset[k];
        for (run = 1; k + run < b->n && b->offset[k + run] == offset + run;) run++;
        if (!arrays_equal(around + i + offset, around + j + offset, run + LANES - 1, sizeof *around)) return false;
    }
    return true;
}

/* Stores the bonds b of particles i .. i + 7 in the cache t. If the cache is full, they replace its oldest entry. */
static void remember(struct stencil_cache *t, const struct lattice_bonds *b, int64_t i)
{
    struct cached *to = &t->cached[t->next];
    if (t->n <= t->next) {
        t->n++;
        to->bonds.offset = NEW("bonds.stencil_cache", t->map->most, int32_t);
        to->bonds.from = NEW("bonds.stencil_cache", t->map->most, uint8_t);
        to->bonds.to = NEW("bonds.stencil_cache", t->map->most, uint8_t);
    }
    to->i = i, to->bonds.n = b->n;
    array_copy(to->bonds.offset, b->offset, b->n, sizeof *b->offset);
    array_copy(to->bonds.from, b->from, b->n, 1);
    array_copy(to->bonds.to, b->to, b->n, 1);
    t->last = t->next;
    t->next = (t->next + 1) % REMEMBERED;
}

/* Returns true if all data of s from which the weights of bonds are computed are equal around particles i .. i + 7 and
 * around j .. j + 7. b: bonds of both sets of particles, at equal index distances (neighbour minus particle). */
static bool same_weights(const struct bond_source *s, const struct lattice_bonds *b, int64_t i, int64_t j)
{
    if (s->neighbour_volume && !same_around(s->neighbour_volume, b, i, j)) return false;
    const struct surface_correction *correction = s->surface;
    return !correction ||
           (memcmp(correction->class_of + i, correction->class_of + j, LANES * sizeof *correction->class_of) == 0 &&
            eight_bytes_as_word(correction->mirrors + i) == eight_bytes_as_word(correction->mirrors + j));
}

int64_t stencil_cache_find_or_add_lattice_bonds(const struct lattice_bonds *bonds,
                                                const struct bond_source *weight_inputs, int64_t first_particle)
{
    struct stencil_cache *t = bonds->stencil_cache;
    if (!t->map->uniform) return -1;
    for (int k = 0; k < t->n; k++) {
        const int at = (t->last + k) % t->n;
        const struct cached *other = &t->cached[at];
        if (!same_sites(&other->bonds, bonds)) continue;
        if (weight_inputs && !same_weights(weight_inputs, bonds, first_particle, other->i)) continue;
        t->last = at;
        return other->i;
    }
    remember(t, bonds, first_particle);
    return -1;
}
