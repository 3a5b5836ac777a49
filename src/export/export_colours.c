/* Assigns colours to the particles at cut bonds. They become particle types of LAMMPS, which can omit bonds only by
 * excluding pairs of types while its first neighbour list is built.
 *
 * On a lattice, the key of a particle consists of its position modulo the reach of bonds and of its cut bonds: two
 * neighbours with given keys have a unique offset, and all such pairs are cut or none. The number of colours then does
 * not grow with the length of a crack. Elsewhere keys are not unique; a particle to which the colour of its key does
 * not apply gets another colour of this key, or a new one. */
#include "export_parts.h"

#include "base/memory.h"

void particles_at_cut_bonds_free(struct particles_at_cut_bonds *touched)
{
    memory_free(touched->particle);
    memory_free(touched->first);
    memory_free(touched->near);
    memory_free(touched->cut);
    memory_free(touched->key);
    *touched = (struct particles_at_cut_bonds){0};
}

/* Colours assigned so far to the particles at cut bonds. of[k]: colour of particle k in the list of these particles,
 * -1: none yet; n: number of colours; key[c]: key that all particles with colour c have; pair[COLOURS_MOST * a + b]:
 * kind (bonded or cut) of pairs of particles with the colours a and b. */
struct colouring {
    const struct particles_at_cut_bonds *t;
    int32_t *of;
    int n;
    uint64_t *key;
    uint8_t *pair;
};

static uint8_t pair_kind(const struct particles_at_cut_bonds *t, int64_t q)
{
    return t->cut[q] ? PAIR_CUT : PAIR_BONDED;
}

/* Returns true if particle k in the list a->t of particles at cut bonds can have colour c. LAMMPS excludes bonds by
 * pairs of particle types, and colours become types: all pairs of particles with the same two colours must be of one
 * kind, bonded or cut. For each neighbour of the particle, the pair of c and the neighbour's colour must be unused so
 * far, or already have the kind of this pair of particles. */
static bool colour_fits(const struct colouring *a, int64_t k, int32_t c)
{
    for (int64_t q = a->t->first[k]; q < a->t->first[k + 1]; q++) {
        const int32_t other = a->of[a->t->near[q]];
        const uint8_t known = other < 0 ? PAIR_UNKNOWN : a->pair[(int64_t)c * COLOURS_MOST + other];
        if (known != PAIR_UNKNOWN && known != pair_kind(a->t, q)) return false;
    }
    return true;
}

/* Assigns colour c to particle k in the list a->t of particles at cut bonds. Records in a->pair the kind, bonded or
 * cut, of the pairs of c with the colours of its neighbours. Colours become particle types, by which LAMMPS excludes
 * bonds. Returns false if a pair of colours would need both kinds. */
static bool colour_take(struct colouring *a, int64_t k, int32_t c)
{
    a->of[k] = c;
    for (int64_t q = a->t->first[k]; q < a->t->first[k + 1]; q++) {
        const int32_t other = a->of[a->t->near[q]];
        if (other < 0) continue;
        uint8_t *known = &a->pair[(int64_t)c * COLOURS_MOST + other];
        if (*known != PAIR_UNKNOWN && *known != pair_kind(a->t, q)) return false;
        *known = a->pair[(int64_t)other * COLOURS_MOST + c] = pair_kind(a->t, q);
    }
    return true;
}

/* Assigns a colour, which becomes a particle type of LAMMPS, to each particle listed in a->t (particles with cut
 * bonds). All pairs of particles with the same two colours must be of one kind, bonded or cut. A particle gets the
 * first colour that fulfils this and belongs to its key (a hash of its material, loads, lattice position and cut
 * bonds), or a new colour. Returns false if more than COLOURS_MOST colours are needed, or if a pair of colours needs
 * both kinds. */
static bool colours_share(struct colouring *a)
{
    for (int64_t k = 0; k < a->t->n; k++) {
        int32_t c = 0;
        while (c < a->n && !(a->key[c] == a->t->key[k] && colour_fits(a, k, c))) c++;
        if (c == COLOURS_MOST) return false;
        if (c == a->n) a->key[a->n++] = a->t->key[k];
        if (!colour_take(a, k, c)) return false;
    }
    return true;
}

int particles_at_cut_bonds_assign_and_count_colours(int32_t *colour, const struct particles_at_cut_bonds *t)
{
    struct colouring a = {t, colour, 0, NEW("colours.key", COLOURS_MOST, uint64_t),
                          NEW("colours.pair", (int64_t)COLOURS_MOST * COLOURS_MOST, uint8_t)};
    for (int64_t k = 0; k < t->n; k++) colour[k] = -1;
    if (!colours_share(&a)) {
        a.n = t->n <= COLOURS_MOST ? (int)t->n : 0;
        for (int64_t k = 0; k < t->n; k++) colour[k] = (int32_t)k;
    }
    memory_free(a.key);
    memory_free(a.pair);
    return a.n;
}

uint8_t *colour_pairs_classify_as_bonded_or_cut(const int32_t *colour, int colour_count,
                                                const struct particles_at_cut_bonds *t)
{
    uint8_t *pair = NEW("colours.pairs", (int64_t)colour_count * colour_count, uint8_t);
    for (int64_t k = 0; k < t->n; k++)
        for (int64_t q = t->first[k]; q < t->first[k + 1]; q++) {
            uint8_t *known = &pair[(int64_t)colour[k] * colour_count + colour[t->near[q]]];
            if (*known == PAIR_UNKNOWN || *known == pair_kind(t, q))
                *known = pair_kind(t, q);
            else {
                memory_free(pair);
                return NULL;
            }
        }
    return pair;
}
