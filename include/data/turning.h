/* Groups of material points that rotate together: FLIP with conservation of angular momentum.
 *
 * FLIP transfers the change dv_I of a node to points around the centre of mass c_I of their contributions to the node,
 * while the force acted at the node: at faces and interfaces, where c_I is not x_I, the angular momentum m_I (x_I -
 * c_I) x dv_I is lost, and the second map gives the node the velocity of c_I, so that a rotating body strains at its
 * faces. Two blocks set rotating by a collision lost 43 % of it in 400 us. The loss of point p is
 *     lack_p = m_p sum_I N (x_I - x_p) x dv_I.
 * Points are therefore grouped by about 6 by 6 (by 6) neighbours of the reference configuration. A group receives the
 * lack of its points as a rotation about its centre of mass, and its points extrapolate their velocity to nodes with
 * the spin w of the group; one is the adjoint of the other in the mass, so that energies balance:
 *     v_p += (J^-1 sum lack) x r_p,   w = J^-1 sum m r x v,   P_I = sum m N (v_p + w x (x_I - x_p))
 * Momentum and angular momentum are conserved, and no rotation of a group strains it. Groups of fewer than TURNING_FEW
 * points join a neighbour: their inertia J is too small. Points move with the velocities of the second map, except for
 * the coupling `handshake`. */
#ifndef CLEAVE_TURNING
#define CLEAVE_TURNING

#include "particles.h"

enum { TURNING_EDGE = 6, TURNING_FEW = 12, TURNING_NEAR = 26 };

/* One group of particles. */
struct turning_group {
    int64_t place[DIM_MAX];     /* position of the group [group edges] */
    int32_t body, points;       /* body; points on the grid now */
    int32_t off;                /* distance from the middle, summed over the axes [half edges] */
    int64_t first, end;         /* its particles: member[first] .. member[end - 1] */
    int32_t near[TURNING_NEAR]; /* neighbours in its body, first along axes; -1: none */
    int32_t root;               /* the group that it has joined, itself if none */
    bool held;                  /* a support acts on points of its body, which then moves as in plain FLIP */
    real mass, moment[DIM_MAX]; /* [kg], [kg m]; of a root: of all its groups, with moment replaced by the centre [m] */
    real inertia[3][3];         /* about the centre [kg m^2] */
    real sum[3];                /* lack of its points, then its angular momentum [kg m^2/s] */
    real spin[3];               /* gain of spin, then its spin [1/s] */
};

/* All groups. All arrays are owned. */
struct rotation_groups {
    int32_t groups;              /* number of groups; 0: points do not rotate in groups */
    struct turning_group *group; /* ascending by body and position */
    int32_t *member;             /* [n] particles, within a group by position */
    real *turn[3]; /* [n] lack of a point [kg m^2/s], then the spin of its group [1/s]; 2D: only turn[2] */
};

/* Divides all particles into groups of about 6 by 6 (by 6) neighbours of the reference configuration, which later
 * rotate together; joined bodies share groups, others do not. spacing: of the particles [m]; origin: origin of the
 * division [m]; joined_to: for each body the first body that is joined to it; supported: for each body, true if
 * supports act on it, so that its points do not rotate in groups. Replaces previous groups; release with
 * rotation_groups_free. */
void rotation_groups_make(struct rotation_groups *t, const struct particles *p, real spacing, const real *origin,
                          const int *joined_to, const bool *supported);

/* Releases all arrays. */
void rotation_groups_free(struct rotation_groups *t);

/* Computes mass, centre, inertia and angular velocity (spin) of each group from its points on the grid, before a step,
 * and stores in t->turn, for each point, the angular velocity of its group [1/s]. spacing: of the particles [m]. */
void rotation_groups_compute_spins(struct rotation_groups *t, struct particles *p, real spacing);

/* Gives each group the angular momentum that its points have not received from the grid (t->turn [kg m^2/s]), as a
 * rotation about its centre of mass: adds it to the velocities of the points. Then stores in t->turn, for each point,
 * the new angular velocity of its group [1/s]. Positions must be those of rotation_groups_compute_spins. */
void rotation_groups_restore_spins(struct rotation_groups *t, struct particles *p);

#endif
