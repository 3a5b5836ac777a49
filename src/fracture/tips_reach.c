/* Computes the extent of each crack and the position of its tip. */
#include <math.h>

#include "base/memory.h"
#include "fracture/places.h"
#include "tips_parts.h"

/* Returns true if `label`, the crack number of a particle plus 1, stands for a crack: it is neither 0 (undamaged) nor
 * TIP_BEFORE (damaged by a pre-crack). */
static bool is_of_crack(uint8_t label) { return label != 0 && label != TIP_BEFORE; }

/* Finds the next particles of cracks in the list of peridynamic particles, p->list[KIND_PD], which is searched in
 * pieces of TIP_PIECE entries. first: entry at which the search starts, the first of a piece. Returns the first entry
 * of the first piece that contains a particle of a crack of t; the length of the list if there is none. */
static int64_t next_of_crack(const struct crack_tips *t, const struct particles *p, int64_t first)
{
    for (; first < p->n_of[KIND_PD]; first += TIP_PIECE) {
        const int32_t *at = p->list[KIND_PD] + first;
        const int64_t n = peridynamic_particle_list_chunk_end_index(p, first) - first;
        uint8_t any = 0;
        if (particles_have_consecutive_numbers(at, n))
            for (int64_t k = 0; k < n; k++) any |= is_of_crack(t->label[at[0] + k]);
        else
            for (int64_t k = 0; k < n; k++) any |= is_of_crack(t->label[at[k]]);
        if (any) return first;
    }
    return p->n_of[KIND_PD];
}

/* Returns the distance of particle i of p from the start of its crack [m]; -1 if the particle is beside the end of the
 * pre-crack, behind the start. The particle must belong to a crack of t. */
static real tips_reach_of(const struct crack_tips *t, const struct particles *p, int64_t i)
{
    const struct crack_tip *tip = &t->tip[t->label[i] - 1];
    real X[DIM_MAX], offset[DIM_MAX];
    particle_reference_position(p, i, X);
    real distance = segment_distance_and_offset_to_point(tip->origin, tip->edge, X, t->dim, offset);
    bool behind = tip->from_crack && dot(offset, tip->along, t->dim) < -TIP_EQUAL * t->spacing;
    return behind && distance <= (TIP_START_REACH + TIP_EQUAL) * t->spacing ? -1 : distance;
}

/* Extents of all cracks, and for each crack the n[k] particles that are up to one spacing less far from its start
 * than the farthest one. */
struct ahead {
    const struct crack_tips *t;
    const struct particles *p;
    struct crack_extent *reach; /* [tips] extent of each crack */
    int64_t n[TIPS_MAX];
    struct place *place[TIPS_MAX]; /* positions of the particles; NULL: counted only */
};

typedef void of_crack_fn(struct ahead *a, int32_t i, int tip);

/* Calls visit(a, i, tip) for every particle i that belongs to a crack, where `tip` is the number of the crack, from 0,
 * in the order of the list of peridynamic particles. */
static void each_of_crack(struct ahead *a, of_crack_fn *visit)
{
    const int32_t *list = a->p->list[KIND_PD];
    const int64_t n = a->p->n_of[KIND_PD];
    for (int64_t b = next_of_crack(a->t, a->p, 0); b < n; b = next_of_crack(a->t, a->p, b + TIP_PIECE))
        for (int64_t k = b; k < peridynamic_particle_list_chunk_end_index(a->p, b); k++)
            if (is_of_crack(a->t->label[list[k]])) visit(a, list[k], a->t->label[list[k]] - 1);
}

/* Adds particle i to the extent of crack number `tip`, a->reach[tip]: increments the number of particles, and increases
 * the largest distance from the start of the crack to that of the particle. */
static void extent_find(struct ahead *a, int32_t i, int tip)
{
    struct crack_extent *r = &a->reach[tip];
    r->particles++;
    r->farthest = real_max(r->farthest, tips_reach_of(a->t, a->p, i));
}

/* Counts particle i in a->n[tip] if it is the farthest one from the start of crack number `tip`, or at most one spacing
 * nearer, and stores its reference position in a->place[tip], unless that is NULL. a->reach must be complete
 * (extent_find). */
static void farthest_collect(struct ahead *a, int32_t i, int tip)
{
    const real farthest = a->reach[tip].farthest, equal = TIP_EQUAL * a->t->spacing;
    const real reach = farthest > 0 ? tips_reach_of(a->t, a->p, i) : -1;
    if (reach < 0 || reach < farthest - a->t->spacing - equal) return;
    if (a->place[tip]) {
        struct place *own = &a->place[tip][a->n[tip]];
        particle_reference_position(a->p, i, own->X);
        own->beside = reach < farthest - equal;
    }
    a->n[tip]++;
}

void tips_compute_crack_extents(const struct crack_tips *t, const struct particles *p, struct crack_extent *extent)
{
    struct ahead a = {.t = t, .p = p, .reach = extent};
    each_of_crack(&a, extent_find);
    each_of_crack(&a, farthest_collect);
    for (int k = 0; k < t->n; k++)
        if (a.n[k] > 0) a.place[k] = NEW("tips.ahead", a.n[k], struct place), a.n[k] = 0;
    each_of_crack(&a, farthest_collect);
    for (int k = 0; k < t->n; k++) {
        const real touch = (TIP_TOUCH + TIP_EQUAL) * t->spacing;
        if (a.n[k] > 0)
            extent[k].ends = position_clusters_count_and_centre_at_largest_x(a.place[k], a.n[k], t->dim, touch,
                                                                             t->tip[k].edge, extent[k].place);
        memory_free(a.place[k]);
    }
}
