/* The background grid of the material point method: a box of nodes round the material points. Nodes
 * are counted from an anchor fixed for the whole run, so a grid that grows keeps its node positions exactly. */
#ifndef CLEAVE_GRID
#define CLEAVE_GRID

#include "base/base.h"

/* Dashpots on a node: force over velocity by component; 0: none, or a wall holds it [kg/s]. */
struct dashpot {
    int32_t node;
    real rate[DIM_MAX];
    real impulse[DIM_MAX]; /* of this step, on the body [N s] */
};

/* What dashpots did in a step: energy that they took, a quarter of their impulse times the change of velocity [J];
 * their impulse on the body [N s]. */
struct absorbed {
    real energy, kick, impulse[DIM_MAX];
};

struct grid {
    int dim;
    int body;                  /* 1 + the only body whose points are on it; 0: any */
    real h;                    /* node distance [m] */
    real anchor[DIM_MAX];      /* position of node 0 [m] */
    int64_t first[DIM_MAX];    /* lowest node of the box, counted from the anchor */
    int64_t count[DIM_MAX], n; /* nodes per direction, in all */
    int64_t stride[DIM_MAX];   /* of the node index; stride[0] = 1 */
    real *mass;                /* nodal mass [kg] */
    real *momentum[DIM_MAX];   /* nodal momentum; after grid_remapped the velocity
                                  of the second map                        [kg m/s], [m/s] */
    real *force[DIM_MAX];      /* nodal force; after grid_move the change of velocity [N], [m/s] */
    real *velocity[DIM_MAX];   /* nodal velocity at the end of the step [m/s] */
    int64_t walls;
    struct wall *wall; /* prescribed velocities of this step, in order */
    int64_t mirror_nodes;
    struct mirror_node *mirror_node; /* nodes beyond planes of symmetry, for this box */
    real light_mass;                 /* nodes below this follow a neighbour (grid_move.c); 0: none [kg] */
    int64_t followers;
    struct follower *follower; /* [n] those of this step, ascending */
    uint8_t *held;             /* [n] not 0: a wall holds it; only while followers are found or bodies meet */
    int64_t dashpots;
    struct dashpot *dashpot;  /* of absorbing faces in this step, ascending by node */
    struct absorbed absorbed; /* what they took in it */
};

/* A node that points have hardly reached, its neighbour and the one behind that, from which its acceleration is
 * extrapolated; where none is behind, the neighbour itself. */
struct follower {
    int32_t node, leader, behind;
};

/* A node beyond a plane of symmetry: it moves as the mirror image of a node on the body's side, which takes what points
 * give to either. */
struct mirror_node {
    int32_t node, image;            /* beyond the plane; on the body's side */
    int8_t sign[DIM_MAX];           /* -1: this component turns round */
    uint8_t load;                   /* whose plane it is */
    real mass, taken[DIM_MAX];      /* of the node itself in this step [kg], [N s] */
    real image_mass, image_inverse; /* of the image alone (frame reference) [kg], [1/kg] */
    real reaction[DIM_MAX];         /* impulse of the plane on the body in this step [N s] */
};

/* One held component of one node; its force is replaced by what the prescribed motion needs. */
struct wall {
    int32_t node;
    int16_t component, load; /* load: the boundary condition that constrains it */
    real velocity, change;   /* in this step; since the step before [m/s] */
    real place;              /* displacement at the end of the step, NAN: what the velocity makes [m] */
    real reaction;           /* impulse of this step, without that of the prescribed change [N s] */
};

/* Sets the box to cover positions from..to with a margin of three cells, rounded outwards to whole steps;
 * grows and never shrinks. Returns true if the box changed (all nodal values are then zero). Fails if it would
 * need more than `most` nodes. */
status grid_cover(struct grid *g, const real *from, const real *to, int64_t most, bool *changed);
void grid_free(struct grid *g);
void grid_add_wall(struct grid *g, const struct wall *wall);
void grid_add_mirror_node(struct grid *g, const struct mirror_node *mirror_node);
void grid_add_dashpot(struct grid *g, const struct dashpot *dashpot);
/* Nothing is on the grid in this step: no node is constrained. */
void grid_idle(struct grid *g);

/* Nodes lighter than this share of a full one are left at rest. 1e-9 is usual; but such a node may carry a force,
 * and what it carries would be lost: momentum is kept to 1e-12 only if just empty nodes are left out, and with the
 * re-map light nodes do no harm (their velocity is that of their particle). */
#define GRID_MASS_SMALLEST 1e-30

/* Nodes lighter than this share of a full one follow a neighbour: below 1e-6 motions of a hundredth of a spacing
 * reach across, above 1e-3 bodies that turn gain more than 1e-3 in four turns. */
#define GRID_MASS_LIGHT 1e-5

/* The same for static solutions, in which the balance of a node that the edge of a point has just reached would set the
 * stress of the point to zero. Left at rest, such nodes hold the body: a cantilever of 15 times its depth bent by a
 * quarter. */
#define GRID_MASS_STATIC 1e-3

/* Place of node k of the box in direction d [m]. */
static inline real grid_position(const struct grid *g, int d, int64_t k)
{
    return g->anchor[d] + g->h * (real)(g->first[d] + k);
}

/* Place of x in direction d, in node distances from the anchor; its floor is the cell. One function, so that all
 * callers round alike. */
static inline real grid_place(const struct grid *g, int d, real x) { return (x - g->anchor[d]) * (1 / g->h); }

/* Its floor, without a call of the library. */
static ALWAYS_INLINE int64_t grid_cell(const struct grid *g, int d, real x)
{
    const real place = grid_place(g, d, x);
    const int64_t k = (int64_t)place;
    return k - (place < (real)k);
}

/* Place along d of the particle next to corner c of cell I, of 2^dim particles at quarters of its edges [m]. */
static inline real grid_quarter(const struct grid *g, int64_t I, int corner, int d)
{
    return grid_position(g, d, I / g->stride[d] % g->count[d]) + (corner >> d & 1 ? 0.75 : 0.25) * g->h;
}

/* Number in the box `to` of cell I of the box `from` with nodes at the same places; -1: it is not in that box. */
static inline int64_t grid_same_cell(const struct grid *from, int64_t I, const struct grid *to)
{
    int64_t J = 0;
    for (int d = 0; d < from->dim; d++) {
        const int64_t k = I / from->stride[d] % from->count[d] + from->first[d] - to->first[d];
        if (k < 0 || k >= to->count[d]) return -1;
        J += k * to->stride[d];
    }
    return J;
}

/* The box of cells round from..to [m], and a node more, for dim, h and anchor as they are; no nodal arrays. False: more
 * than `most` nodes. */
bool grid_box(struct grid *g, const real *from, const real *to, int64_t most);

#endif
