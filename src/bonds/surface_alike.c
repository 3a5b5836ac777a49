/* Classes of particles with equal surroundings, and groups of bonds that share one factor.
 *
 * The surroundings of a particle are its neighbours and theirs, RADIUS families deep, seen through the mirrors across
 * the axes that give the smallest hash. Both directions of a bond, and a bond and its mirror image, are in one group;
 * so a factor is a function of a particle's class and of the offset in its mirrors, and equal from both particles. Most
 * bodies have few classes: the cost of the fit depends on shape, not on size. */
#include <string.h>

#include "base/memory.h"
#include "surface_parts.h"

enum { RADIUS = 2 };

/* Returns the hash of Fowler, Noll and Vo extended by a word. */
static uint64_t mixed(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * UINT64_C(0x100000001b3);
    return hash ^ hash >> 29;
}
#define HASH_START UINT64_C(0xcbf29ce484222325)

/* Returns the hash of the surroundings (colour) of neighbour j, reflected by the axes in `mirrors`. colour: 2^dim
 * consecutive hashes for each particle near a face, one for each set of mirrors. Returns 1 without a particle (j < 0),
 * 2 for a particle near no face. */
static uint64_t colour_seen(const struct near_faces *b, const uint64_t *colour, int32_t j, int mirrors)
{
    if (j < 0) return 1;
    const struct seen seen = mirrored_source_of(b, j);
    const int64_t t = b->place[seen.particle];
    return t < 0 ? 2 : colour[(t << b->offset.dim) + (mirrors ^ seen.mirrors)];
}

/* Computes the hashes of the surroundings (colours) of all particles near faces, in all reflections, in RADIUS rounds,
 * each of which includes the neighbours' hashes of the previous one. */
static void colours(const struct near_faces *b, uint64_t *colour)
{
    const struct offsets *o = &b->offset;
    const int64_t all = b->n << o->dim;
    uint64_t *before = NEW("surface.colour", all, uint64_t);
    for (int64_t k = 0; k < all; k++) colour[k] = HASH_START;
    for (int round = 0; round < RADIUS; round++) {
        array_copy(before, colour, all, sizeof *colour);
#pragma omp parallel for schedule(static)
        for (int64_t at = 0; at < all; at++) {
            const int mirrors = (int)(at & ((1 << o->dim) - 1));
            uint64_t hash = mixed(HASH_START, before[at]);
            for (int k = 0; k < o->n; k++) {
                const int32_t j = neighbour_of(b, at >> o->dim, o->mirrored[mirrors * o->n + k]);
                hash = mixed(hash, colour_seen(b, before, j, mirrors));
            }
            colour[at] = hash;
        }
    }
    memory_free(before);
}

/* Returns the first set of mirrors from number `from` on in which particle t has its smallest hash (colour), -1 if
 * there is none. */
static int mirrors_of(const struct near_faces *b, const uint64_t *colour, int64_t t, int from)
{
    const uint64_t *own = colour + (t << b->offset.dim);
    int least = 0;
    for (int k = 1; k < 1 << b->offset.dim; k++)
        if (own[k] < own[least]) least = k;
    for (int k = from; k < 1 << b->offset.dim; k++)
        if (own[k] == own[least]) return k;
    return -1;
}

/* Assigns particles with equal hashes (colours) to classes, numbered in the order of their first particle from 1 on. */
static void classes_make(struct bond_classes *a, const struct near_faces *b, const uint64_t *colour)
{
    const int dim = b->offset.dim;
    int64_t room = 64;
    while (room < 2 * b->n) room *= 2;
    int32_t *slot = NEW("surface.slot", room, int32_t);
    a->class_of = NEW("surface.class_of", b->n, int32_t);
    a->mirrors = NEW("surface.mirrors", b->n, uint8_t);
    a->member = NEW("surface.member", b->n + 1, int64_t);
    a->members = NEW("surface.members", b->n + 1, real);
    a->classes = 1;
    for (int64_t t = 0; t < b->n; t++) {
        a->mirrors[t] = (uint8_t)mirrors_of(b, colour, t, 0);
        const uint64_t own = colour[(t << dim) + a->mirrors[t]];
        int64_t at = (int64_t)(own & (uint64_t)(room - 1));
        while (slot[at] && colour[(a->member[slot[at]] << dim) + a->mirrors[a->member[slot[at]]]] != own)
            at = (at + 1) & (room - 1);
        if (!slot[at]) slot[at] = a->classes, a->member[a->classes++] = t;
        a->class_of[t] = slot[at];
        a->members[slot[at]]++;
    }
    memory_free(slot);
}

/* Returns the root of k in a union-find forest, with path halving. */
static int64_t root_of(int64_t *parent, int64_t k)
{
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
}

/* Joins the groups of two entries, one of which may have none yet. */
static void groups_join(int64_t *parent, int64_t one, int64_t other)
{
    if (parent[one] < 0) parent[one] = one;
    if (parent[other] < 0) parent[other] = other;
    const int64_t x = root_of(parent, one), y = root_of(parent, other);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

/* Returns the entry of bond k of particle t in the tables by class and offset: the offset is reflected by the mirrors
 * that the particle has in its class. */
static int64_t entry_of(const struct bond_classes *a, const struct near_faces *b, int64_t t, int k)
{
    return (int64_t)a->class_of[t] * b->offset.n + b->offset.mirrored[a->mirrors[t] * b->offset.n + k];
}

/* Joins the entries of both directions of every bond, unless both particles have whole families: such bonds keep factor
 * 1. */
static void bonds_join(const struct bond_classes *a, const struct near_faces *b, int64_t *parent)
{
    for (int64_t t = 0; t < b->n; t++)
        for (int k = 0; k < b->offset.n; k++) {
            const int32_t j = neighbour_of(b, t, k);
            if (j < 0 || (b->whole[b->particle[t]] && is_whole(b, j))) continue;
            const struct seen seen = mirrored_source_of(b, j);
            const int64_t other = entry_of(a, b, b->place[seen.particle], reverse_offset(b, &seen, k));
            groups_join(parent, entry_of(a, b, t, k), other);
        }
}

/* Joins the entries of bonds of a class that are mirror images of each other. */
static void twins_join(const struct bond_classes *a, const struct near_faces *b, int64_t *parent)
{
    const struct offsets *o = &b->offset;
    for (int32_t class = 1; class < a->classes; class ++)
        for (int m = 1; m < 1 << o->dim; m++)
            for (int k = 0; k < o->n && a->symmetry[class] >> m & 1; k++) {
                const int64_t first = (int64_t) class * o->n, other = first + o->mirrored[m * o->n + k];
                if (parent[first + k] >= 0) groups_join(parent, first + k, other);
            }
}

/* Finds for each class the sets of mirrors under which it is its own image, one bit each in a->symmetry. */
static void symmetries_find(struct bond_classes *a, const struct near_faces *b, const uint64_t *colour)
{
    a->symmetry = NEW("surface.symmetry", a->classes, uint8_t);
    for (int32_t class = 1; class < a->classes; class ++) {
        const int64_t t = a->member[class];
        for (int m = a->mirrors[t]; m >= 0; m = mirrors_of(b, colour, t, m + 1))
            a->symmetry[class] |= (uint8_t)(1 << (m ^ a->mirrors[t]));
    }
}

void bond_classes_make(struct bond_classes *a, const struct near_faces *b)
{
    uint64_t *colour = NEW("surface.colour", b->n << b->offset.dim, uint64_t);
    *a = (struct bond_classes){0};
    colours(b, colour);
    classes_make(a, b, colour);
    symmetries_find(a, b, colour);
    const int64_t entries = (int64_t)a->classes * b->offset.n;
    a->group_of = NEW("surface.group_of", entries, int64_t);
    for (int64_t k = 0; k < entries; k++) a->group_of[k] = -1;
    bonds_join(a, b, a->group_of);
    twins_join(a, b, a->group_of);
    memory_free(colour);
    for (int64_t k = 0; k < entries; k++) { /* a root precedes its members */
        if (a->group_of[k] < 0) continue;
        a->group_of[k] = a->group_of[k] == k ? a->groups++ : a->group_of[a->group_of[k]];
    }
}

void bond_classes_free(struct bond_classes *a)
{
    memory_free(a->class_of);
    memory_free(a->mirrors);
    memory_free(a->member);
    memory_free(a->members);
    memory_free(a->symmetry);
    memory_free(a->group_of);
}
