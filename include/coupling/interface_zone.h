/* The interface zone: material points beside peridynamic particles, and the damping of motion there that the
 * grid cannot see.
 *
 * A wave that crosses from material points to bonds leaves motion behind that FLIP keeps for ever: points of a cell at
 * the edge moving against each other, or a light node at the edge swinging, since forces on single points are not
 * smooth in space. Measured in a bar, that is most of what a short pulse loses to the interface. The remedy is
 * fourth-order viscosity on the interface zone alone:
 *
 *     d_i = s sum_j ((v_j - v_i) . e_ij) e_ij                  for i in the zone, j its nearest neighbours
 *     m_j dv_j = -k sum_i m_i s ((d_i - d_j) . e_ij) e_ij      (d = 0 outside the zone),  dv = -k B^T B v
 *
 * All exchanges are central and in pairs: the exchange itself keeps momentum and angular momentum to the last digits, a
 * rigid motion and in whole neighbourhoods a uniform strain rate are not touched, energy only falls. Long waves lose
 * (wave number x spacing)^4. */
#ifndef CLEAVE_INTERFACE_ZONE
#define CLEAVE_INTERFACE_ZONE

#include "bonds/bonds.h"
#include "data/particles.h"

struct interface_zone {
    int64_t n, points;  /* particles in it or next to it; the points of the interface zone stand first */
    int32_t *particle;  /* [n] */
    int64_t *start;     /* [n + 1] neighbours of member k: neighbour[start[k] .. start[k+1]-1] */
    int32_t *neighbour; /* members, as places in `particle` */
    real *difference;   /* [points dim] d [m/s] */
    real *change;       /* [n dim] of momentum [kg m/s] */
    real scale;         /* s: the largest eigenvalue of B is 4 or less [1] */
};

/* The points within the cutoff and one spacing of a peridynamic particle of their body, and their neighbours within one
 * and a half spacings in the reference configuration; pairs that a pre-crack cuts and driven particles are left out. */
void interface_zone_make(struct interface_zone *r, const struct particles *p, const struct bond_source *source);
void interface_zone_free(struct interface_zone *r);

/* One step of damping of strength k = `share` [1], at most 1/16 (motion that alternates from point to point would
 * then stop in one step). Impulses J that change velocities from v to v' over a leap-frog step, together with the
 * forces in it, take -J . (v + v')/2: returns the first half of that, and interface_damp_end the other once the step
 * has been made [J]. */
real interface_damp_begin(struct interface_zone *r, struct particles *p, real share);
real interface_damp_end(const struct interface_zone *r, const struct particles *p);

#endif
