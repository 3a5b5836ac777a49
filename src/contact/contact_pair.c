/* Computes contact between pairs of particles, which act as spheres or discs (contact laws of the form `pair`). */
#include <math.h>

#include "contact_internal.h"

/* A pair of particles: overlap d - r [m], with the contact distance d and the distance r, negative without contact;
 * stiffness k [N/m]; vector between both [m]. The numbers are bitwise equal from both particles. */
struct contact_pair {
    real overlap, r, k, apart[DIM_MAX];
};

/* Returns the state of pair q (index in c->other) of row `row` of the contact list c: the vector between both particles
 * of p, its length, the overlap and the stiffness of the contact. All but the vector are 0 if the pair is not in
 * contact. */
static struct contact_pair contact_pair(const struct contact *c, const struct particles *p, int64_t row, int64_t q)
{
    struct contact_pair pair = {0};
    const real r2 = contact_pair_vector_and_squared_distance(c, p, row, c->other[q], pair.apart);
    if (!contact_is_in_active_set(contact_active_set_flags(c), q, r2 < square(c->distance[q]))) return pair;
    pair.r = sqrt(r2);
    pair.overlap = c->distance[q] - pair.r;
    pair.k = contact_pair_stiffness(c, p, row, c->other[q]);
    return pair;
}

void contact_pair_add_forces_on_particle(const struct contact *c, struct particles *p, int64_t list_index,
                                         struct contact_summary *found)
{
    const int32_t i = c->particle[list_index];
    real f[DIM_MAX] = {0};
    for (int64_t q = c->first[list_index]; q < c->first[list_index + 1]; q++) {
        const struct contact_pair pair = contact_pair(c, p, list_index, q);
        if (pair.overlap == 0 || !(pair.r > 0)) continue;
        for (int d = 0; d < p->dim; d++) f[d] += pair.k * pair.overlap / pair.r * pair.apart[d];
        contact_summary_add_overlap(found, pair.overlap, i);
    }
    for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
}

real contact_pair_half_energy_of_particle(const struct contact *c, const struct particles *p, int64_t list_index)
{
    real energy = 0;
    for (int64_t q = c->first[list_index]; q < c->first[list_index + 1]; q++) {
        const struct contact_pair pair = contact_pair(c, p, list_index, q);
        energy += 0.25 * pair.k * square(pair.overlap);
    }
    return energy;
}

real contact_pair_gap(const struct contact *c, const struct particles *p, int64_t list_index, int64_t q)
{
    real apart[DIM_MAX];
    return sqrt(contact_pair_vector_and_squared_distance(c, p, list_index, c->other[q], apart)) - c->distance[q];
}

/* Returns the distance at which contact between two particles of p begins [m]. It is their distance in the reference
 * configuration or their mean spacing, whichever is smaller, minus the width of a notch between them. A new pair that
 * is closer than that begins contact at its present distance, without a force; when the pair opens, this distance grows
 * with it up to the first value. k, l: entries of the particles in the contact list c; previous_onset_distance: result
 * for this pair at the search before [m], NAN for a new pair. The results for (k, l) and (l, k) are bitwise equal. */
real contact_pair_onset_distance(const struct contact *c, const struct particles *p, int64_t k, int64_t l,
                                 real previous_onset_distance)
{
    const int32_t i = c->particle[k], j = c->particle[l];
    real reference2 = 0, apart[DIM_MAX];
    for (int d = 0; d < p->dim; d++) reference2 += square(p->X[d][i] - p->X[d][j]);
    const real mean = 0.5 * (c->size[k] + c->size[l]);
    if (c->law.distance == DISTANCE_LAMMPS) return real_min(NEAR_LAMMPS * sqrt(reference2), FAR_LAMMPS * mean);
    const real nominal = real_min(sqrt(reference2), mean) - contact_width_of_widest_notch_between_particles(c, p, k, l);
    const real r = sqrt(contact_pair_vector_and_squared_distance(c, p, k, l, apart));
    return real_min(nominal, isnan(previous_onset_distance) ? r : real_max(previous_onset_distance, r));
}
