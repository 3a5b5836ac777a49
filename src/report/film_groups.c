/* Divides the particles of a film into groups. Cells of the lattice are shown as one particle of the same area, so that
 * a picture of the body has no gaps. */
#include <math.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "film.h"

/* KEY_BITS: number of bits for the index of a cell along each axis in the number that identifies the cell; KEY_MOST:
 * largest such index. */
enum { KEY_BITS = 20, KEY_MOST = (1 << KEY_BITS) - 1 };

/* Largest relative difference from one spacing at which the size of a particle counts as one spacing [1]. */
static const double EQUAL = 0.01;

/* A particle during the grouping of particles into cells, for sorting. key: number of its cell (member_of_cell); index:
 * of the particle; part: number of its material and body. Equal keys and parts form one group. */
struct member {
    uint64_t key;
    int32_t index;
    uint16_t part;
};

static int member_compare(const void *a, const void *b)
{
    const struct member *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    if (x->part != y->part) return x->part < y->part ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

static bool are_in_one_cell(const struct member *x, const struct member *y)
{
    return x->key == y->key && x->part == y->part;
}

static double size_of_particle(const struct animation_particle_set *s, const struct run_animation *animation, int64_t i)
{
    return s->size ? s->size[i] : animation->spacing;
}

static double cell_edge_length(const struct run_animation *animation, int level)
{
    return ldexp(animation->spacing, level);
}

/* Returns the index along axis d of the cubic cell of the lattice, with an edge of 2^level spacings of film, that
 * contains particle i of the particle set s (the particles that consecutive output frames have in common). */
static uint64_t cell_index(const struct animation_particle_set *s, const struct run_animation *animation, int level,
                           int64_t i, int d)
{
    const double along = floor((s->X[d][i] - s->corner[d]) / animation->spacing);
    return (uint64_t)fmin(fmax(along, 0), KEY_MOST) >> level;
}

/* Returns particle i of the particle set s of film as a member of the cell that contains it. level: base-2 logarithm of
 * the edge of the cell in spacings. */
static struct member member_of_cell(const struct animation_particle_set *s, const struct run_animation *animation,
                                    int level, int64_t i)
{
    uint64_t key = (uint64_t)level;
    for (int d = 0; d < DIM_MAX; d++)
        key = key << KEY_BITS | (d < animation->dim ? cell_index(s, animation, level, i, d) : 0);
    return (struct member){key, (int32_t)i, (uint16_t)(s->material[i] << 8 | s->body[i])};
}

/* Returns true if particle i of the particle set s of film may be merged with others into a cell with an edge of
 * 2^level spacings. Its size must be one spacing, and it must not be part of a crack in any frame. If level >
 * animation->levels_damaged, it must be neither damaged nor yielding in any frame. */
static bool may_merge(const struct animation_particle_set *s, const struct run_animation *animation, int level,
                      int64_t i)
{
    if (s->state[i] == FILM_CRACKED || (s->state[i] == FILM_DAMAGED && level > animation->levels_damaged)) return false;
    return fabs(size_of_particle(s, animation, i) / animation->spacing - 1) < EQUAL;
}

/* Merges particles of the particle set s (the particles that consecutive output frames have in common) into cubic
 * cells with an edge of 2^level spacings of film animation: sets s->level to `level` for the particles of each cell
 * that they fill completely, if all of them have the same material and body. Above animation->levels_damaged they must
 * also have the same kinds and fragments in all frames. */
static void merge_cells(struct animation_particle_set *s, const struct run_animation *animation, int level)
{
    struct member *m = BARE("report.members", s->n, struct member);
    int64_t n = 0;
    const int64_t full = (int64_t)1 << (level * animation->dim);
    for (int64_t i = 0; i < s->n; i++)
        if (s->level[i] == level - 1 && may_merge(s, animation, level, i))
            m[n++] = member_of_cell(s, animation, level, i);
    array_sort(m, n, sizeof *m, member_compare);
    for (int64_t k = 0, end; k < n; k = end) {
        bool alike = true;
        for (end = k; end < n && are_in_one_cell(&m[end], &m[k]); end++)
            alike &= level <= animation->levels_damaged || s->history[m[end].index] == s->history[m[k].index];
        if (!alike || end - k != full) continue;
        for (int64_t j = k; j < end; j++) s->level[m[j].index] = (uint8_t)level;
    }
    memory_free(m);
}

/* Sets s->level for all particles of the particle set s of film animation: the cell into which particle i is merged has
 * an edge of 2^level[i] spacings; 0: the particle is shown alone. */
static void mesh_levels_set(struct animation_particle_set *s, const struct run_animation *animation)
{
    const double largest = (1 + EQUAL) * cell_edge_length(animation, animation->levels_all);
    for (int64_t i = 0; i < s->n; i++)
        s->level[i] = (uint8_t)(size_of_particle(s, animation, i) <= largest ? animation->levels_all : 0);
    for (int level = animation->levels_all + 1; level <= animation->levels; level++) merge_cells(s, animation, level);
}

/* Sets the lists of particles of each group (particles shown as one) of the set s of film animation: s->groups,
 * s->first and s->member. Particles with s->level > 0 in the same cell of this level, of one material and body, form a
 * group. */
static void film_groups_fill(struct animation_particle_set *s, const struct run_animation *animation)
{
    struct member *m = BARE("report.members", s->n, struct member);
    for (int64_t i = 0; i < s->n; i++)
        m[i] = s->level[i] ? member_of_cell(s, animation, s->level[i], i) : (struct member){(uint64_t)i, (int32_t)i, 0};
    array_sort(m, s->n, sizeof *m, member_compare);
    s->groups = 0;
    for (int64_t k = 0; k < s->n; k++) {
        if (k == 0 || !are_in_one_cell(&m[k], &m[k - 1])) s->first[s->groups++] = (int32_t)k;
        s->member[k] = m[k].index;
    }
    s->first[s->groups] = (int32_t)s->n;
    memory_free(m);
}

void animation_particle_set_merge_into_groups(struct animation_particle_set *particle_set,
                                              const struct run_animation *animation)
{
    struct animation_particle_set *s = particle_set;
    for (int d = 0; d < animation->dim; d++) {
        s->corner[d] = INFINITY;
        for (int64_t i = 0; i < s->n; i++)
            s->corner[d] = fmin(s->corner[d], s->X[d][i] - size_of_particle(s, animation, i) / 2);
    }
    mesh_levels_set(s, animation);
    film_groups_fill(s, animation);
}

double animation_group_drawn_edge_length(const struct animation_particle_set *particle_set,
                                         const struct run_animation *animation, int64_t group)
{
    const int32_t i = particle_set->member[particle_set->first[group]];
    return particle_set->level[i] ? cell_edge_length(animation, particle_set->level[i])
                                  : size_of_particle(particle_set, animation, i);
}

double animation_group_centre_coordinate(const struct animation_particle_set *particle_set,
                                         const struct run_animation *animation, int64_t group, int axis)
{
    const int32_t first = particle_set->first[group], n = particle_set->first[group + 1] - first;
    const int32_t i = particle_set->member[first];
    const int level = particle_set->level[i];
    double sum = 0;
    if (level > 0 && n < (int64_t)1 << (level * animation->dim))
        return particle_set->corner[axis] +
               ((double)cell_index(particle_set, animation, level, i, axis) + 0.5) * cell_edge_length(animation, level);
    for (int32_t k = 0; k < n; k++) sum += particle_set->X[axis][particle_set->member[first + k]];
    return sum / n;
}
