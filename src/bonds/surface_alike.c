/* Divides particles near faces into classes with equal surroundings, and their bonds into groups that share one factor
 * on their weight.
 *
 * The surroundings of a particle are its neighbours and theirs, RADIUS neighbourhoods deep, reflected at those axes
 * that give the smallest hash; mirrored surroundings are thus equal. Both directions of a bond, and a bond and its
 * mirror image, are in one group. A factor is therefore a function of the class of a particle and of the reflected
 * lattice offset of its neighbour. Most bodies have few classes, so the cost of the fit depends on shape, not on
 * size. */
#include <string.h>

#include "base/memory.h"
#include "surface_parts.h"

enum { RADIUS = 2 }; /* number of neighbourhoods over which surroundings are compared */

/* Returns `hash` after one more 64-bit `word` has been added to it: a step of the hash of Fowler, Noll and Vo, followed
 * by an exclusive or with the upper bits of the result. */
static uint64_t mixed(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * UINT64_C(0x100000001b3);
    return hash ^ hash >> 29;
}
#define HASH_START UINT64_C(0xcbf29ce484222325) /* initial value of a hash (FNV-1a) */

/* ---- kinds of particles ------------------------------------------------------------------------------------------ */

/* Kinds of particles near faces: particles of one kind have equal surroundings, some neighbourhoods deep, without being
 * mirrored. Each kind has 2^dim consecutive colours: hashes of its surroundings, mirrored across each of the 2^dim sets
 * of axes. Kinds are numbered in the order of their first particle. */
struct kinds {
    int32_t n, *of;   /* number of kinds; [near n] kind of a particle */
    int64_t *first;   /* [n] first particle of a kind */
    uint64_t *colour; /* [n 2^dim] hashes of the surroundings of each kind */
};

static void kinds_free(struct kinds *s)
{
    memory_free(s->of);
    memory_free(s->first);
    memory_free(s->colour);
}

/* Initialises the kinds s of the particles near faces near_faces: all particles are of one kind at first. (Particles of
 * one kind have equal surroundings.) Release s with kinds_free. */
static void kinds_start(struct kinds *s, const struct particles_near_faces *near_faces)
{
    *s = (struct kinds){.n = 1, .of = NEW("surface.kind", near_faces->n, int32_t)};
    s->first = NEW("surface.kind", 1, int64_t);
    s->colour = NEW("surface.kind", 1 << near_faces->offset.dim, uint64_t);
    for (int m = 0; m < 1 << near_faces->offset.dim; m++) s->colour[m] = HASH_START;
}

/* Returns a hash of the kind of a particle and of the kinds of its neighbours (particles of one kind have equal
 * surroundings). It is a sum with one term for each neighbour: its kind and mirrors times factor[k], a random word for
 * its lattice offset k. t: index of the particle among `near_faces`, those near faces; s: kinds of these. */
static uint64_t kinds_around(const struct particles_near_faces *near_faces, const struct kinds *s,
                             const uint64_t *factor, int64_t t)
{
    uint64_t sum = (uint64_t)s->of[t] + 1;
    for (int k = 0; k < near_faces->offset.n; k++) {
        const int32_t j = particles_near_faces_neighbour_at_offset(near_faces, t, k);
        uint64_t word = 0;
        if (j >= 0) {
            const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
            const int32_t near = near_faces->place[seen.particle];
            word = near < 0 ? 1 : 2 + ((uint64_t)s->of[near] << 3) + (uint64_t)seen.mirrors;
        }
        sum += word * factor[k];
    }
    return mixed(HASH_START, sum ^ sum >> 32);
}

/* Returns the hash of the surroundings (colour, from the kinds s) of particle or image j, reflected by the axes in
 * `mirrors` (bit d: axis d). Returns 1 if there is no particle (j < 0), 2 if it is not in `near_faces`, the particles
 * near faces. */
static uint64_t colour_seen(const struct particles_near_faces *near_faces, const struct kinds *s, int32_t j,
                            int mirrors)
{
    if (j < 0) return 1;
    const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
    const int64_t t = near_faces->place[seen.particle];
    return t < 0 ? 2 : s->colour[((int64_t)s->of[t] << near_faces->offset.dim) + (mirrors ^ seen.mirrors)];
}

/* Returns a hash (colour) of the surroundings of a particle, reflected by the axes in `mirrors` (bit d: axis d). It
 * combines the present colours s->colour of the particle and its neighbours, and so describes surroundings that are
 * larger by one neighbourhood. t: index of the particle among `near_faces`, those near faces. */
static uint64_t colour_around(const struct particles_near_faces *near_faces, const struct kinds *s, int64_t t,
                              int mirrors)
{
    const struct offsets *o = &near_faces->offset;
    uint64_t hash = mixed(HASH_START, s->colour[((int64_t)s->of[t] << o->dim) + mirrors]);
    for (int k = 0; k < o->n; k++)
        hash = mixed(
            hash, colour_seen(near_faces, s,
                              particles_near_faces_neighbour_at_offset(near_faces, t, o->mirrored[mirrors * o->n + k]),
                              mirrors));
    return hash;
}

/* Assigns n elements to kinds by their hashes, hash[n]: those with equal hashes are of one kind. Kinds are numbered
 * from 0 in the order of their first element. Sets s->n, s->of[n] (which must be allocated) and s->first. */
static void kinds_number(struct kinds *s, int64_t n, const uint64_t *hash)
{
    int64_t room = 64;
    while (room < 2 * n) room *= 2;
    int32_t *slot = NEW("surface.slot", room, int32_t);
    for (int64_t t = 0; t < n; t++) {
        int64_t at = (int64_t)(hash[t] & (uint64_t)(room - 1));
        while (slot[at] && hash[s->first[slot[at] - 1]] != hash[t]) at = (at + 1) & (room - 1);
        if (!slot[at]) {
            GROW("surface.kind", s->first, s->n + 1);
            s->first[s->n++] = t, slot[at] = s->n;
        }
        s->of[t] = slot[at] - 1;
    }
    memory_free(slot);
}

/* Divides the kinds s of particles (particles of one kind have equal surroundings) by the kinds of their neighbours:
 * surroundings are then equal one neighbourhood further out. near_faces: particles near faces; colours: true to compute
 * also the colours of the new kinds, the hashes of their surroundings in all mirrors. */
static void kinds_refine(struct kinds *s, const struct particles_near_faces *near_faces, bool colours)
{
    const int dim = near_faces->offset.dim;
    uint64_t *hash = NEW("surface.hash", near_faces->n, uint64_t),
             *factor = NEW("surface.hash", near_faces->offset.n, uint64_t);
    for (int k = 0; k < near_faces->offset.n; k++) factor[k] = hash_add_word(0, (uint64_t)k);
#pragma omp parallel for schedule(static)
    for (int64_t t = 0; t < near_faces->n; t++) hash[t] = kinds_around(near_faces, s, factor, t);
    struct kinds fine = {.of = NEW("surface.kind", near_faces->n, int32_t)};
    kinds_number(&fine, near_faces->n, hash);
    if (colours) fine.colour = NEW("surface.colour", (int64_t)fine.n << dim, uint64_t);
#pragma omp parallel for schedule(static)
    for (int64_t at = 0; at < (colours ? (int64_t)fine.n << dim : 0); at++)
        fine.colour[at] = colour_around(near_faces, s, fine.first[at >> dim], (int)(at & ((1 << dim) - 1)));
    memory_free(hash);
    memory_free(factor);
    kinds_free(s);
    *s = fine;
}

/* ---- classes ----------------------------------------------------------------------------------------------------- */

/* Returns the smallest reflection >= `from` under which the surroundings of the particles of kind number `kind` have
 * the smallest hash (colour) of all reflections; -1 if there is none. A reflection is a set of axes, as a number with
 * bit d for axis d. (The particles of a kind have equal surroundings.) s: kinds, with the hashes; near_faces: particles
 * near faces. */
static int mirrors_of(const struct particles_near_faces *near_faces, const struct kinds *s, int32_t kind, int from)
{
    const uint64_t *own = s->colour + ((int64_t)kind << near_faces->offset.dim);
    int least = 0;
    for (int k = 1; k < 1 << near_faces->offset.dim; k++)
        if (own[k] < own[least]) least = k;
    for (int k = from; k < 1 << near_faces->offset.dim; k++)
        if (own[k] == own[least]) return k;
    return -1;
}

/* Assigns kinds of particles to classes. A kind has equal surroundings; two kinds belong to one class if they are
 * mirror images of each other, i.e. if the smallest hashes of their mirrored surroundings are equal. of[kinds]:
 * receives the number of the class of each kind, from 0. Sets a->classes, their number plus 1, and a->member, a
 * particle of each class. s: kinds, with the hashes; near_faces: particles near faces. */
static void classes_of_kinds(struct bond_classes *a, const struct particles_near_faces *near_faces,
                             const struct kinds *s, int32_t *of)
{
    struct kinds least = {.of = of};
    uint64_t *hash = NEW("surface.hash", s->n, uint64_t);
    for (int32_t kind = 0; kind < s->n; kind++)
        hash[kind] = s->colour[((int64_t)kind << near_faces->offset.dim) + mirrors_of(near_faces, s, kind, 0)];
    kinds_number(&least, s->n, hash);
    a->classes = least.n + 1;
    a->member = NEW("surface.member", a->classes, int64_t);
    for (int32_t class = 1; class < a->classes; class ++) a->member[class] = s->first[least.first[class - 1]];
    memory_free(hash);
    memory_free(least.first);
}

/* Divides the particles near faces `near_faces` into classes: surroundings of particles in one class are equal or
 * mirror images of each other. Numbers the classes from 1 in the order of their first particle. Stores in a the class
 * of each particle, the mirrors that map the particle to its class, and for each class the mirrors under which its
 * surroundings do not change. s: kinds of the particles (equal, not mirrored surroundings), with colours. */
static void classes_make(struct bond_classes *a, const struct particles_near_faces *near_faces, const struct kinds *s)
{
    int32_t *of = NEW("surface.class", s->n, int32_t);
    classes_of_kinds(a, near_faces, s, of);
    a->class_of = NEW("surface.class_of", near_faces->n, int32_t);
    a->mirrors = NEW("surface.mirrors", near_faces->n, uint8_t);
    a->members = NEW("surface.members", a->classes, real);
    a->symmetry = NEW("surface.symmetry", a->classes, uint8_t);
    for (int64_t t = 0; t < near_faces->n; t++) {
        a->class_of[t] = of[s->of[t]] + 1;
        a->mirrors[t] = (uint8_t)mirrors_of(near_faces, s, s->of[t], 0);
        a->members[a->class_of[t]]++;
    }
    for (int32_t class = 1; class < a->classes; class ++) {
        const int64_t t = a->member[class];
        for (int m = a->mirrors[t]; m >= 0; m = mirrors_of(near_faces, s, s->of[t], m + 1))
            a->symmetry[class] |= (uint8_t)(1 << (m ^ a->mirrors[t]));
    }
    memory_free(of);
}

/* ---- groups of bonds --------------------------------------------------------------------------------------------- */

/* Returns the root of element k in the union-find forest `parent` (parent[k] is the parent of element k; a root is its
 * own parent). Shortens the path from k to the root. Element k must be in a tree. */
static int64_t root_of(int64_t *parent, int64_t k)
{
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
}

/* Joins the trees of the elements `one` and `other` in the union-find forest `parent`; an element with parent -1, which
 * is in no tree yet, first becomes a tree of its own. */
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

/* Returns the index in tables [classes, offsets] of the bond from particle t to its neighbour at lattice offset number
 * k. A class contains particles with equal surroundings up to reflections; the offset is reflected like the particle to
 * the axes of its class. t: index of the particle among `near_faces`, those near faces; a: classes. */
static int64_t entry_of(const struct bond_classes *a, const struct particles_near_faces *near_faces, int64_t t, int k)
{
    return (int64_t)a->class_of[t] * near_faces->offset.n +
           near_faces->offset.mirrored[a->mirrors[t] * near_faces->offset.n + k];
}

/* Joins the entries i-j and j-i of every bond near faces in tables [classes, offsets], so that both get one factor. (A
 * class contains particles with equal surroundings up to reflections.) near_faces: particles near faces; first[n]:
 * first particle of each of n kinds, which represents all particles with equal, not reflected surroundings; parent:
 * union-find forest of the table entries. Bonds between particles with complete neighbourhoods are left out; their
 * factor is 1. */
static void bonds_join(const struct bond_classes *a, const struct particles_near_faces *near_faces,
                       const int64_t *first, int32_t n, int64_t *parent)
{
    for (int32_t kind = 0; kind < n; kind++)
        for (int k = 0; k < near_faces->offset.n; k++) {
            const int64_t t = first[kind];
            const int32_t j = particles_near_faces_neighbour_at_offset(near_faces, t, k);
            if (j < 0 || (near_faces->whole[near_faces->particle[t]] && particle_family_is_complete(near_faces, j)))
                continue;
            const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
            const int64_t other = entry_of(a, near_faces, near_faces->place[seen.particle],
                                           bond_offset_seen_from_other_particle(near_faces, &seen, k));
            groups_join(parent, entry_of(a, near_faces, t, k), other);
        }
}

/* Joins the table entries of bonds of one class that are mirror images of each other, so that they get one factor. A
 * class consists of particles with equal surroundings up to mirrors. a: classes; near_faces: particles near faces, with
 * the lattice offsets; parent: union-find forest of the entries. */
static void twins_join(const struct bond_classes *a, const struct particles_near_faces *near_faces, int64_t *parent)
{
    const struct offsets *o = &near_faces->offset;
    for (int32_t class = 1; class < a->classes; class ++)
        for (int m = 1; m < 1 << o->dim; m++)
            for (int k = 0; k < o->n && a->symmetry[class] >> m & 1; k++) {
                const int64_t first = (int64_t) class * o->n, other = first + o->mirrored[m * o->n + k];
                if (parent[first + k] >= 0) groups_join(parent, first + k, other);
            }
}

void bond_classes_group_bonds_near_faces(struct bond_classes *classes, const struct particles_near_faces *near_faces)
{
    struct kinds kinds;
    *classes = (struct bond_classes){0};
    kinds_start(&kinds, near_faces);
    for (int round = 0; round < RADIUS; round++) kinds_refine(&kinds, near_faces, true);
    classes_make(classes, near_faces, &kinds);
    kinds_refine(&kinds, near_faces, false);
    const int64_t entries = (int64_t)classes->classes * near_faces->offset.n;
    classes->group_of = NEW("surface.group_of", entries, int64_t);
    for (int64_t k = 0; k < entries; k++) classes->group_of[k] = -1;
    bonds_join(classes, near_faces, kinds.first, kinds.n, classes->group_of);
    twins_join(classes, near_faces, classes->group_of);
    kinds_free(&kinds);
    for (int64_t k = 0; k < entries; k++) { /* a root precedes its members */
        if (classes->group_of[k] < 0) continue;
        classes->group_of[k] = classes->group_of[k] == k ? classes->groups++ : classes->group_of[classes->group_of[k]];
    }
}

void bond_classes_free(struct bond_classes *classes)
{
    memory_free(classes->class_of);
    memory_free(classes->mirrors);
    memory_free(classes->member);
    memory_free(classes->members);
    memory_free(classes->symmetry);
    memory_free(classes->group_of);
}
