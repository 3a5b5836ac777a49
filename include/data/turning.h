/* Material points that turn together: FLIP that keeps angular momentum.
 *
 * FLIP hands the change dv_I of a node to points round the centre of mass c_I of what the node has of them, while the
 * force acted at the node: at faces and interfaces, where c_I is not x_I, the angular momentum m_I (x_I - c_I) x dv_I
 * is lost, and the second map gives the node the velocity of c_I, so that a body that turns strains at its faces. Two
 * blocks that a collision turned lost 43 % of it in 400 us. Point by point the loss is
 *     lack_p = m_p sum_I N (x_I - x_p) x dv_I.
 * Points are therefore taken in groups of some 6 by 6 (by 6) neighbours of the reference configuration. A group
 * receives what its points lack as a rotation about its centre of mass, and its points give nodes their velocity
 * continued by the spin w of the group; one is the adjoint of the other in the mass, so that energies balance:
 *     v_p += (J^-1 sum lack) x r_p,   w = J^-1 sum m r x v,   P_I = sum m N (v_p + w x (x_I - x_p))
 * Momentum and angular momentum are kept, and no rotation of a group strains it. Groups of fewer than TURNING_FEW
 * points join a neighbour: they have too little inertia J. Points move with the velocities of the second map, but in
 * hand-shake. */
#ifndef CLEAVE_TURNING
#define CLEAVE_TURNING

#include "particles.h"

enum { TURNING_EDGE = 6, TURNING_FEW = 12, TURNING_NEAR = 26 };

struct turning_group {
    int64_t place[DIM_MAX];     /* in group edges */
    int32_t body, points;       /* points: on the grid now */
    int32_t off;                /* how far it is from the middle, along all axes [half edges] */
    int64_t first, end;         /* its particles: member[first] .. member[end - 1] */
    int32_t near[TURNING_NEAR]; /* neighbours of its body, along axes first; -1: none */
    int32_t root;               /* the group that it is part of now */
    bool held;                  /* a support holds points of its body, which is left as FLIP has it */
    real mass, moment[DIM_MAX]; /* [kg], [kg m]; of a root of all its groups, moment then the centre [m] */
    real inertia[3][3];         /* about the centre [kg m^2] */
    real sum[3];                /* what it lacks, then its angular momentum [kg m^2/s] */
    real spin[3];               /* what it gains, then has [1/s] */
};

struct turning_groups {
    int32_t groups;              /* number of them; 0: points do not turn in groups */
    struct turning_group *group; /* ascending by body and place */
    int32_t *member;             /* [n] particles, in a group by their places */
    real *turn[3];               /* [n] what a point lacks [kg m^2/s], then its group's spin [1/s]; 2D: last */
};

/* Groups of all particles, whether they are on the grid now or not. middle: where groups are counted from [m]; one:
 * [bodies] the first body that is one with this one; held: [bodies] supports hold it. */
void turning_make(struct turning_groups *t, const struct particles *p, real spacing, const real *middle, const int *one,
                  const bool *held);
void turning_free(struct turning_groups *t);

/* Before a step on the grid: finds centres and inertias, and sets turn to the spin of each point's group. */
void turning_begin(struct turning_groups *t, struct particles *p, real spacing);
/* Gives the points of each group what they lack (turn), and sets turn to their spin again; positions are those of
 * turning_begin. */
void turning_share(struct turning_groups *t, struct particles *p);

#endif
