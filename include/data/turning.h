/* Groups of material points that rotate together, by which the FLIP transfer conserves angular momentum.
 *
 * FLIP transfers the velocity change dv_I of node I to points around the centre of mass c_I of their
 * contributions to the node, while the force acted at the node, x_I. At faces and interfaces, where c_I is
 * not x_I, the angular momentum m_I (x_I - c_I) x dv_I is lost. The second map (from points with new
 * velocities back to nodes) then gives the node the velocity of c_I, so that a rotating body strains at its
 * faces. Two blocks set rotating by a collision lost 43 % of their rotation in 400 us. The angular momentum
 * that point p, of mass m_p and position x_p, loses is
 *     lack_p = m_p sum_I N (x_I - x_p) x dv_I               N: shape function of node I at the point
 * Points are therefore grouped by about 6 by 6 (by 6) neighbours of the reference configuration. A group, of
 * inertia J, receives the lack of its points as a rotation about its centre of mass, and its points
 * extrapolate their velocity to nodes with the spin w of the group. One map is the adjoint of the other in
 * the mass, so that energies balance:
 *     v_p += (J^-1 sum lack) x r_p,   w = J^-1 sum m r x v,   P_I = sum m N (v_p + w x (x_I - x_p))
 * with the position r_p of a point relative to the centre of mass and the momentum P_I of a node. Momentum
 * and angular momentum are conserved, and no rotation of a group strains it. Groups of fewer than TURNING_FEW
 * points join a neighbouring group, since their inertia is too small. Points move with the velocities of the
 * second map, except for the coupling `handshake`. A thin outermost layer of groups belongs to the layer inside
 * it, so that groups of a box are boxes, which a pure strain gives no spin. */
#ifndef CLEAVE_TURNING
#define CLEAVE_TURNING

#include "particles.h"

/* Sizes of the groups of points that rotate together. TURNING_EDGE: edge of a group [points]; TURNING_FEW: number of
 * points below which a group joins a neighbouring group; TURNING_NEAR: largest number of neighbouring groups. */
enum { TURNING_EDGE = 6, TURNING_FEW = 12, TURNING_NEAR = 26 };

/* Particles of one rotation group (neighbours that rotate together) that are consecutive in memory, with the indices
 * first .. first + n - 1; n is at most LANES. */
struct turning_run {
    int32_t first, n;
};

/* One group of neighbouring particles that rotate together. Sums are over its material points on the grid. A small
 * group has joined another group, its root; other groups are their own root. */
struct turning_group {
    int64_t place[DIM_MAX];     /* position of the group in the lattice of groups of its body [group edges] */
    int32_t body, points;       /* index of the body; number of points on the grid now */
    int32_t off;                /* distance from the middle of the body, summed over the axes [half edges] */
    int64_t first, end;         /* particles of the group: run[first] .. run[end - 1] of struct corotating_groups */
    int32_t near[TURNING_NEAR]; /* indices of neighbouring groups of the body, first those along an axis; -1: none */
    int32_t root;               /* index of the group that it has joined; its own index if none */
    bool held;                  /* a support acts on points of the body, which then moves as in plain FLIP */
    real mass;                  /* mass of its points [kg] */
    real about[DIM_MAX];        /* position about which the moments of mass are computed [m] */
    real first_moment[DIM_MAX], second_moment[DIM_MAX][DIM_MAX]; /* moments of mass about `about`: [kg m]; lower
                                                                    triangle [kg m^2] */
    real momentum[DIM_MAX];                                      /* momentum of its points [kg m/s] */
    real joined, moment[DIM_MAX]; /* of a root: mass of all its groups [kg]; their centre of mass [m] */
    real inertia[3][3];           /* lower triangle of the inertia about the centre of mass of the root; of a root: sum
                                     over all its groups [kg m^2] */
    real added;                   /* of a root: inertia that is added so that thin groups are not singular [kg m^2] */
    real sum[3];                  /* angular momentum, then the lack of its points [kg m^2/s] */
    real angular[3];       /* angular momentum about the centre of the root before the lack is added [kg m^2/s] */
    real gain[3], spin[3]; /* of a root: change of the spin by the lack of its points; spin [1/s] */
};

/* All groups of particles that rotate together. All arrays are owned. */
struct corotating_groups {
    int32_t groups;              /* number of groups; 0: points do not rotate in groups */
    struct turning_group *group; /* ascending by body and position */
    struct turning_run *run;     /* all particles, within a group by position */
    real *turn[3]; /* [n + LANES] lack of a point [kg m^2/s], then the spin of its group [1/s]; 2D: only turn[2] */
};

/* Divides all particles of p into the groups of about 6 by 6 (by 6) neighbours in the reference configuration, which
 * later rotate together, so that the FLIP transfer conserves angular momentum. Bodies that interfaces join are divided
 * like one body; other bodies have groups of their own, which do not depend on other bodies. Groups are counted from
 * the middle of the bounding box of the joined bodies. If a plane of symmetry cuts or touches them, groups are counted
 * from this plane, so that mirrored bodies have mirrored groups. spacing: of the particles [m]; symmetry_plane[dim]:
 * position of the plane of symmetry across each axis [m], NAN if there is none; first_joined_body[bodies]: for each
 * body the first body that is joined to it; body_is_supported[bodies]: for each body, true if supports act on it, so
 * that its points do not rotate in groups. Replaces previous groups; release with corotating_groups_free. */
void corotating_groups_make(struct corotating_groups *groups, const struct particles *p, real spacing,
                            const real *symmetry_plane, const int *first_joined_body, const bool *body_is_supported,
                            int body_count);

/* Releases all arrays of the rotation groups t. */
void corotating_groups_free(struct corotating_groups *groups);

#endif
