/* Finds fragments by joining both particles of every intact bond (union-find). The particle with the lowest index
 * represents a fragment. */
#include "fracture/fragments.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Returns the root of the tree of particle i in the union-find structure leader[particles], where leader[i] is the
 * parent of particle i and a root is its own parent. Shortens the path from i to the root. */
static int32_t fragment_leader(int32_t *leader, int32_t i)
{
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
}

/* Joins both particles of every intact bond of b in the union-find structure leader[p->n], in which initially leader[i]
 * = i. Of the roots of both particles, that with the lower index becomes the root of both trees. Bonds to mirror images
 * are left out. */
static void join_ends(int32_t *leader, const struct bonds *b, const struct particles *p)
{
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        int32_t own = fragment_leader(leader, i);
        for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);) {
            const int32_t j = it.bond.nbr;
            if (it.bond.w == 0 || j >= p->n || leader[j] == own) continue; /* mirror images belong to other particles */
            const int32_t other = fragment_leader(leader, j);
            if (own < other)
                leader[other] = own;
            else
                own = leader[own] = other;
        }
    }
}

/* Compares two fragments a and b (struct fragment) for qsort: by mass, the heavier first; those of equal mass by the
 * index of their first particle. */
static int heavier_first(const void *a, const void *b)
{
    const struct fragment *x = a, *y = b;
    if (x->mass != y->mass) return x->mass > y->mass ? -1 : 1;
    return x->first < y->first ? -1 : 1;
}

/* Adds particle i of p to fragment f: increments the number of particles, and adds the mass, mass times position and
 * mass times velocity of the particle to the sums of the fragment. */
static void add_particle(struct fragment *f, const struct particles *p, int32_t i)
{
    f->particles++, f->mass += p->mass[i];
    for (int d = 0; d < p->dim; d++) f->x[d] += p->mass[i] * p->x[d][i], f->v[d] += p->mass[i] * p->v[d][i];
}

/* Divides the sums of position and velocity of each fragment in f by the mass of the fragment, which gives means.
 * Removes fragments of a single particle from the list; their number is added to f->singles and their mass to
 * f->mass_singles [kg]. */
static void leave_singles(struct fragments *f)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < f->n; k++) {
        struct fragment *g = &f->fragment[k];
        if (g->particles < 2) {
            f->singles++, f->mass_singles += g->mass;
            continue;
        }
        for (int d = 0; d < DIM_MAX; d++) g->x[d] /= g->mass, g->v[d] /= g->mass;
        f->fragment[kept++] = *g;
    }
    f->n = kept;
}

/* Allocates f->of[n] and stores in it the number of the fragment of each particle, or -1 for a particle in none of the
 * listed fragments. leader[n]: union-find structure of the n particles, as made by join_ends. */
static void number_particles(struct fragments *f, int32_t *leader, int64_t n)
{
    int32_t *number = BARE("fragments.number", n, int32_t);
    f->of = BARE("fragments.of", n, int32_t);
    for (int64_t i = 0; i < n; i++) number[i] = -1;
    for (int64_t k = 0; k < f->n; k++) number[f->fragment[k].first] = (int32_t)k;
    for (int64_t i = 0; i < n; i++) f->of[i] = number[fragment_leader(leader, (int32_t)i)];
    memory_free(number);
}

void fragments_find_by_intact_bonds(struct fragments *f, const struct bonds *b, const struct particles *p)
{
    /* slot[i]: index of the fragment whose first particle is i */
    int32_t *leader = BARE("fragments.leader", p->n, int32_t), *slot = BARE("fragments.slot", p->n, int32_t);
    memset(f, 0, sizeof *f);
    for (int64_t i = 0; i < p->n; i++) leader[i] = (int32_t)i;
    join_ends(leader, b, p);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        if (fragment_leader(leader, i) == i) slot[i] = (int32_t)f->n++;
    }
    f->fragment = NEW("fragments", f->n, struct fragment);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k], first = fragment_leader(leader, i);
        struct fragment *g = &f->fragment[slot[first]];
        g->first = first, g->body = p->body[i];
        add_particle(g, p, i);
    }
    leave_singles(f);
    array_sort(f->fragment, f->n, sizeof *f->fragment, heavier_first);
    number_particles(f, leader, p->n);
    memory_free(leader);
    memory_free(slot);
}

void fragments_free(struct fragments *f)
{
    memory_free(f->fragment);
    memory_free(f->of);
    *f = (struct fragments){0};
}
