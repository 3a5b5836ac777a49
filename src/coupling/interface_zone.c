/* Finds the interface zone (material points near peridynamic particles, and their neighbours) and damps relative
 * velocities in it. The zone has few particles; each is written by one thread. */
#include "coupling/interface_zone.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

#define NEIGHBOUR_SPACINGS 1.5 /* nearest neighbours along axes and face diagonals */

/* Marks of particles: outside the interface zone; outside the zone, but a neighbour of one of its points; material
 * point of the zone. */
enum mark { OUTSIDE, BESIDE, POINT };

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* Returns true if interface damping may change the velocity of particle j: if j is neither a mirror image (j >= p->n)
 * nor a point of the mesh, and its motion is not prescribed. */
static bool interface_zone_is_free(const struct particles *p, int32_t j)
{
    return j < p->n && !(p->flag[j] & (FLAG_DRIVEN | FLAG_MESHED));
}

/* Sets mark[j] to `as` for the particles j of p that are within `radius` [m] of one of n particles, list[n], of the
 * same body and are still OUTSIDE. Leaves out particles whose velocity must not be changed by damping and, if `as` is
 * POINT, peridynamic particles. s: cells of the neighbour search. Several threads may set one entry, to the same
 * value. */
static void mark_near(uint8_t *mark, const struct particles *p, const struct bond_source *s, const int32_t *list,
                      int64_t n, real radius, enum mark as)
{
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(dynamic, 64)
        for (int64_t k = 0; k < n; k++) {
            particles_list_neighbours_unordered(&near, s->cells, p, list[k], radius, false);
            for (int q = 0; q < near.n; q++) {
                const int32_t j = near.at[q];
                if (!interface_zone_is_free(p, j) || p->body[j] != p->body[list[k]] ||
                    (as == POINT && p->kind[j] != KIND_MPM))
                    continue;
                uint8_t *own = mark + j;
                if (__atomic_load_n(own, __ATOMIC_RELAXED) == OUTSIDE)
                    __atomic_store_n(own, (uint8_t)as, __ATOMIC_RELAXED);
            }
        }
        memory_free(near.at);
    }
}

/* ---- making ------------------------------------------------------------------------------------------------------ */

/* Appends the particles i with mark[i] = `as`, in ascending order, to zone->particle, the list of members of the
 * interface zone (material points near peridynamic particles, and neighbours). slot[i]: receives the index of particle
 * i in the list; n: number of particles, length of mark and slot. */
static void members_add(struct interface_zone *zone, const uint8_t *mark, int32_t *slot, int64_t n, enum mark as)
{
    for (int64_t i = 0; i < n; i++)
        if (mark[i] == as) slot[i] = (int32_t)zone->n, zone->particle[zone->n++] = (int32_t)i;
}

/* Lists in zone->particle the members of the interface zone: first the material points near peridynamic particles, then
 * the nearest neighbours of these points that are not such points themselves. s: cells of the neighbour search;
 * mark[p->n]: 0 before, receives POINT for members of the first group and BESIDE for those of the second; slot[p->n]:
 * receives the index of each member in the list. */
static void members_make(struct interface_zone *zone, const struct particles *p, const struct bond_source *s,
                         uint8_t *mark, int32_t *slot)
{
    const real spacing = s->family.spacing;
    mark_near(mark, p, s, p->list[KIND_PD], p->n_of[KIND_PD], s->family.cutoff + spacing * (1 + 1e-9), POINT);
    members_add(zone, mark, slot, p->n, POINT);
    zone->points = zone->n;
    mark_near(mark, p, s, zone->particle, zone->points, NEIGHBOUR_SPACINGS * spacing, BESIDE);
    members_add(zone, mark, slot, p->n, BESIDE);
}

/* Finds the neighbours with which damping acts on member k of the interface zone (material points near peridynamic
 * particles, and neighbours): members of the zone within NEIGHBOUR_SPACINGS spacings, in the same body, not separated
 * by a pre-crack of s. At least one of the two must be a material point of the zone. p: particles; mark, slot: as
 * computed by members_make; to: receives the indices of these neighbours in the list of members, NULL: they are only
 * counted; near: working memory. Returns their number. */
static int64_t pairs_of(const struct interface_zone *zone, const struct particles *p, const struct bond_source *s,
                        const uint8_t *mark, const int32_t *slot, int64_t k, struct neighbour_list *near, int32_t *to)
{
    const int32_t i = zone->particle[k];
    int64_t n = 0;
    particles_list_neighbours_within_radius(near, s->cells, p, i, NEIGHBOUR_SPACINGS * s->family.spacing, false);
    for (int q = 0; q < near->n; q++) {
        const int32_t j = near->at[q];
        if (j >= p->n || p->body[j] != p->body[i] || mark[j] == OUTSIDE || (mark[i] != POINT && mark[j] != POINT))
            continue;
        if (precracks_cut_bond_between(s->crack, s->cracks, p, i, j)) continue;
        if (to) to[n] = slot[j];
        n++;
    }
    return n;
}

/* Counts or lists the neighbours of all members (particles of p) of the interface zone (material points near
 * peridynamic particles, and neighbours). With `count` true, stores the number of neighbours of member k in
 * zone->start[k + 1]. With `count` false, stores their indices in zone->neighbour, from zone->start[k] on. mark, slot:
 * as computed by members_make. s: cells of the neighbour search and pre-cracks. Returns the largest number of
 * neighbours of a member, at least 1. */
static int64_t pairs_pass(struct interface_zone *zone, const struct particles *p, const struct bond_source *s,
                          const uint8_t *mark, const int32_t *slot, bool count)
{
    int64_t most = 1;
#pragma omp parallel reduction(max : most)
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t k = 0; k < zone->n; k++) {
            const int64_t n =
                pairs_of(zone, p, s, mark, slot, k, &near, count ? NULL : zone->neighbour + zone->start[k]);
            if (count) zone->start[k + 1] = n;
            if (n > most) most = n;
        }
        memory_free(near.at);
    }
    return most;
}

/* Lists the neighbours of each member of the interface zone, particles of p, in zone->neighbour, after members_make.
 * Computes zone->scale, the factor on the velocity differences between neighbours, from the largest number of
 * neighbours. mark, slot: as computed by members_make; s: cells of the neighbour search and pre-cracks. */
static void interface_zone_pairs_make(struct interface_zone *zone, const struct particles *p,
                                      const struct bond_source *s, const uint8_t *mark, const int32_t *slot)
{
    const int64_t most = pairs_pass(zone, p, s, mark, slot, true);
    for (int64_t k = 0; k < zone->n; k++) zone->start[k + 1] += zone->start[k];
    zone->neighbour = NEW("interface_zone.neighbour", zone->start[zone->n], int32_t);
    pairs_pass(zone, p, s, mark, slot, false);
    /* the norm of the sum of e e over n neighbours is about n/dim */
    zone->scale = 4 / ((real)most * (1 + 1.0 / p->dim));
}

void interface_zone_list_damped_material_points(struct interface_zone *zone, const struct particles *p,
                                                const struct bond_source *source)
{
    interface_zone_free(zone);
    uint8_t *mark = NEW("interface_zone.mark", p->n, uint8_t);
    int32_t *slot = BARE("interface_zone.slot", p->n, int32_t); /* [n] index among the members */
    zone->particle = NEW("interface_zone.particle", p->n, int32_t);
    members_make(zone, p, source, mark, slot);
    zone->particle = memory_resize("interface_zone.particle", zone->particle, p->n, zone->n, sizeof *zone->particle);
    zone->start = NEW("interface_zone.start", zone->n + 1, int64_t);
    interface_zone_pairs_make(zone, p, source, mark, slot);
    zone->difference = NEW("interface_zone.difference", zone->n * p->dim, real);
    zone->change = NEW("interface_zone.change", zone->n * p->dim, real);
    memory_free(mark);
    memory_free(slot);
}

void interface_zone_free(struct interface_zone *zone)
{
    memory_free(zone->particle);
    memory_free(zone->start);
    memory_free(zone->neighbour);
    memory_free(zone->difference);
    memory_free(zone->change);
    memset(zone, 0, sizeof *zone);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Adds factor ((b - a) . e) e to sum[dim], where e is the unit vector from the present position of particle i of p to
 * that of particle j. a[dim], b[dim]: vectors of particle i and of particle j, such as their velocities. */
static void add_along(const struct particles *p, int32_t i, int32_t j, const real *a, const real *b, real factor,
                      real *sum)
{
    real y[DIM_MAX], length2 = 0, along = 0;
    for (int d = 0; d < p->dim; d++) {
        y[d] = p->x[d][j] - p->x[d][i];
        length2 += square(y[d]);
        along += (b[d] - a[d]) * y[d];
    }
    for (int d = 0; d < p->dim; d++) sum[d] += factor * along / length2 * y[d];
}

/* Copies the velocity of particle i of p to v[dim] [m/s]. */
static void velocity_of(const struct particles *p, int32_t i, real *v)
{
    for (int d = 0; d < p->dim; d++) v[d] = p->v[d][i];
}

/* Computes zone->difference of member k (a particle of p) of the interface zone (material points near peridynamic
 * particles, and neighbours) [kg m/s]: zone->scale times the mass of the member times a sum over its neighbours. A term
 * of the sum is the velocity of the neighbour relative to the member, projected on the line between both. */
static void difference_make(struct interface_zone *zone, const struct particles *p, int64_t k)
{
    const int32_t i = zone->particle[k];
    real own[DIM_MAX], other[DIM_MAX], sum[DIM_MAX] = {0};
    velocity_of(p, i, own);
    for (int64_t q = zone->start[k]; q < zone->start[k + 1]; q++) {
        const int32_t j = zone->particle[zone->neighbour[q]];
        velocity_of(p, j, other);
        add_along(p, i, j, own, other, zone->scale, sum);
    }
    for (int d = 0; d < p->dim; d++) zone->difference[k * p->dim + d] = p->mass[i] * sum[d];
}

/* Computes zone->change, the change of momentum of member k of the interface zone by damping [kg m/s], from
 * zone->difference of the member and of its neighbours. The changes of the two members of a pair are bitwise opposite,
 * so that momentum is conserved. share: strength of the damping [1]; p: particles. */
static void change_make(struct interface_zone *zone, const struct particles *p, int64_t k, real share)
{
    real *sum = zone->change + k * p->dim;
    for (int d = 0; d < p->dim; d++) sum[d] = 0;
    for (int64_t q = zone->start[k]; q < zone->start[k + 1]; q++) {
        const int32_t m = zone->neighbour[q];
        add_along(p, zone->particle[k], zone->particle[m], zone->difference + k * p->dim, zone->difference + m * p->dim,
                  -share * zone->scale, sum);
    }
}

/* Returns the second half of the energy that damping has removed in this step [J]: -1/2 sum dp . v over the members of
 * the interface zone, with their change of momentum dp and their present velocity v in p. Call it after the change has
 * been applied; the first half is this sum with the velocities before the step. */
real interface_zone_second_half_of_damping_loss(const struct interface_zone *zone, const struct particles *p)
{
    real lost = 0; /* serial: few members, and the sum must not depend on the number of threads */
    for (int64_t k = 0; k < zone->n; k++)
        for (int d = 0; d < p->dim; d++) lost -= 0.5 * zone->change[k * p->dim + d] * p->v[d][zone->particle[k]];
    return lost;
}

real interface_zone_damp_and_return_first_half_loss(struct interface_zone *zone, struct particles *p, real viscosity)
{
#pragma omp parallel
    {
#pragma omp for schedule(static)
        /* 0 for members outside the interface zone */
        for (int64_t k = 0; k < zone->points; k++) difference_make(zone, p, k);
#pragma omp for schedule(static)
        for (int64_t k = 0; k < zone->n; k++) change_make(zone, p, k, viscosity);
    }
    const real lost = interface_zone_second_half_of_damping_loss(zone, p);
    for (int64_t k = 0; k < zone->n; k++)
        for (int d = 0; d < p->dim; d++)
            p->v[d][zone->particle[k]] += zone->change[k * p->dim + d] / p->mass[zone->particle[k]];
    return lost;
}
