/* Divides the particles of a film into groups. Full cells of the lattice with equal, undamaged particles are shown as
 * one particle of the same area, so that a picture of the body has no gaps. */
#include <math.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "film.h"

/* KEY_BITS: number of bits for the index of a cell along each axis in the number that identifies the cell; KEY_MOST:
 * largest such index. */
enum { KEY_BITS = 20, KEY_MOST = (1 << KEY_BITS) - 1 };

/* A particle, and the number of the cell in which it is (cell_key). */
struct member {
    uint64_t key;
    int32_t index;
};

static int member_compare(const void *a, const void *b)
{
    const struct member *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

/* Returns a number that identifies the cubic cell of the lattice, with an edge of 2^level spacings of film f, that
 * contains particle i of the particle set s (the particles that consecutive output frames have in common). from[dim]:
 * lower corner of the lattice [m]. */
static uint64_t cell_key(const struct film_set *s, const struct film *f, const double *from, int level, int64_t i)
{
    uint64_t key = (uint64_t)level;
    for (int d = 0; d < DIM_MAX; d++) {
        const double along = d < f->dim ? floor((s->X[d][i] - from[d]) / f->spacing + 0.25) : 0;
        key = key << KEY_BITS | ((uint64_t)fmin(fmax(along, 0), KEY_MOST) >> level);
    }
    return key;
}

static bool particles_are_alike(const struct film_set *s, int64_t i, int64_t j)
{
    return s->history[i] == s->history[j] && s->material[i] == s->material[j] && s->body[i] == s->body[j];
}

/* Returns true if particle i of the particle set s (the particles that consecutive output frames have in common) may
 * be merged with others into a cubic cell of the lattice: it must be undamaged and elastic in all frames, and its
 * spacing must be that of the film f. */
static bool is_of_lattice(const struct film_set *s, const struct film *f, int64_t i)
{
    return !s->busy[i] && (!s->size || fabs(s->size[i] / f->spacing - 1) < 0.01);
}

/* Merges particles of the particle set s (the particles that consecutive output frames have in common) into cubic
 * cells with an edge of 2^level spacings of film f: sets s->level to `level` for the particles of each cell that they
 * fill completely, if all of them have the same material and body, and the same kinds and fragments in all frames.
 * from[dim]: lower corner of the lattice [m]. */
static void merge_cells(struct film_set *s, const struct film *f, const double *from, int level)
{
    struct member *m = BARE("report.members", s->n, struct member);
    int64_t n = 0;
    const int64_t full = (int64_t)1 << (level * f->dim);
    for (int64_t i = 0; i < s->n; i++)
        if (s->level[i] == level - 1 && is_of_lattice(s, f, i))
            m[n++] = (struct member){cell_key(s, f, from, level, i), (int32_t)i};
    array_sort(m, n, sizeof *m, member_compare);
    for (int64_t k = 0, end; k < n; k = end) {
        bool alike = true;
        for (end = k; end < n && m[end].key == m[k].key; end++)
            alike &= particles_are_alike(s, m[k].index, m[end].index);
        if (!alike || end - k != full) continue;
        for (int64_t j = k; j < end; j++) s->level[m[j].index] = (uint8_t)level;
    }
    memory_free(m);
}

/* Sets the lists of particles of each group (particles shown as one) of the set s: s->groups, s->first and s->member.
 * Particles with s->level > 0 in the same cell of this level form a group. f: film, with the spacing; from[dim]: lower
 * corner of the lattice [m]. */
static void film_groups_fill(struct film_set *s, const struct film *f, const double *from)
{
    struct member *m = BARE("report.members", s->n, struct member);
    for (int64_t i = 0; i < s->n; i++)
        m[i] = (struct member){s->level[i] ? cell_key(s, f, from, s->level[i], i) : (uint64_t)i, (int32_t)i};
    array_sort(m, s->n, sizeof *m, member_compare);
    s->groups = 0;
    for (int64_t k = 0; k < s->n; k++) {
        if (k == 0 || m[k].key != m[k - 1].key) s->first[s->groups++] = (int32_t)k;
        s->member[k] = m[k].index;
    }
    s->first[s->groups] = (int32_t)s->n;
    memory_free(m);
}

void film_particle_set_form_groups(struct film_set *particle_set, const struct film *f)
{
    double from[DIM_MAX] = {0};
    for (int d = 0; d < f->dim; d++) {
        from[d] = INFINITY;
        for (int64_t i = 0; i < particle_set->n; i++) from[d] = fmin(from[d], particle_set->X[d][i]);
    }
    array_fill_bytes(particle_set->level, 0, particle_set->n, sizeof *particle_set->level);
    for (int level = 1; level <= f->levels; level++) merge_cells(particle_set, f, from, level);
    film_groups_fill(particle_set, f, from);
    particle_set->shown = 0;
    for (int64_t g = 0; g < particle_set->groups; g++) {
        particle_set->hidden[g] =
            g % f->every != 0 && (f->thins_busy || !particle_set->busy[particle_set->member[particle_set->first[g]]]);
        particle_set->shown += !particle_set->hidden[g];
    }
}

double film_edge_length_of_group(const struct film_set *particle_set, const struct film *f, int64_t group)
{
    const int32_t i = particle_set->member[particle_set->first[group]];
    const bool thins = f->thins_busy || !particle_set->busy[i];
    const double own = particle_set->size ? particle_set->size[i] : f->spacing,
                 thinned = thins ? pow(f->every, 1.0 / f->dim) : 1;
    return own * (1 << particle_set->level[i]) * thinned;
}
