/* The interface zone: material points beside peridynamic particles, and the damping of motion there that the
 * grid does not resolve.
 *
 * A wave that passes from material points to bonds leaves motion behind that the FLIP transfer does not damp:
 * points of one cell at the interface move against each other, or a light node there oscillates, since bond
 * forces on single points are not smooth in space. In a bar this motion is most of the energy that a short
 * pulse loses at the interface (measured). Fourth-order viscosity in the interface zone alone removes it:
 *
 *     d_i = s sum_j ((v_j - v_i) . e_ij) e_ij                    i: point of the zone, j: nearest neighbours
 *     m_j dv_j = -k sum_i s ((m_i d_i - m_j d_j) . e_ij) e_ij    d = 0 outside the zone
 *
 * with the velocity v, its change dv and the mass m of a particle, and the unit vector e_ij from i to j. For
 * equal masses dv = -k B^T B v with the operator B of the first line; s limits the eigenvalues of B to 4, and
 * k is the strength.
 *
 * All exchanges are central and in pairs: they conserve momentum and angular momentum to round-off, leave
 * rigid motion and, in full neighbourhoods, uniform strain rates unchanged, and only dissipate. The loss of
 * long waves is proportional to (wave number x spacing)^4. */
#ifndef CLEAVE_INTERFACE_ZONE
#define CLEAVE_INTERFACE_ZONE

#include "bonds/bonds.h"
#include "data/particles.h"

/* The interface zone: material points beside peridynamic particles, whose motion is damped, and their neighbours. All
 * arrays are owned. */
struct interface_zone {
    int64_t n, points;  /* members, i.e. points of the zone, then neighbours of these points outside the zone; number of
                           points of the zone */
    int32_t *particle;  /* [n] particle of each member */
    int64_t *start;     /* [n + 1] neighbours of member k: neighbour[start[k] .. start[k+1]-1] */
    int32_t *neighbour; /* members, as indices in `particle` */
    real *difference;   /* [points][dim] d [m/s] */
    real *change;       /* [n][dim] change of momentum [kg m/s] */
    real scale;         /* s, such that the largest eigenvalue of B is at most 4 [1] */
};

/* Finds those particles of p that are points of the interface zone, in which motion is damped, and their neighbours, in
 * the reference configuration. The zone contains the material points whose distance from a peridynamic particle of
 * their body is at most the cutoff of bonds plus one spacing. Neighbours of a point are particles within 1.5 spacings.
 * Pairs cut by a pre-crack and particles with prescribed motion are left out. Replaces the previous zone in *r. source:
 * inputs of the bonds (horizon, materials, cracks, mirrors). Release with interface_zone_free. */
void interface_zone_list_damped_material_points(struct interface_zone *zone, const struct particles *p,
                                                const struct bond_source *source);

/* Releases all arrays of the interface zone `zone` (material points beside peridynamic particles, whose motion is
 * damped). */
void interface_zone_free(struct interface_zone *zone);

/* Damps the motion in the interface zone (material points beside peridynamic particles) before the forces of a step are
 * computed: changes the momentum of the points of the zone and their neighbours in p by impulses J of fourth-order
 * viscosity. viscosity: strength k of the viscosity [1], at most 1/16; with 1/16, motion that alternates from point to
 * point stops in one step. Returns the first half [J] of the energy removed: the sum of -J . v/2, with the velocities v
 * before the change. interface_zone_second_half_of_damping_loss returns the second half. */
real interface_zone_damp_and_return_first_half_loss(struct interface_zone *zone, struct particles *p, real viscosity);

/* Returns the second half [J] of the energy that interface_zone_damp_and_return_first_half_loss has removed in this
 * step: the sum of -J . v'/2 over the members of the zone, with the impulses J in zone->change and the velocities v' of
 * p after the step. */
real interface_zone_second_half_of_damping_loss(const struct interface_zone *zone, const struct particles *p);

#endif
