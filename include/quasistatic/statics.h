/* Room `quasistatic`: load steps. It knows every part and the step; the engine calls it.
 *
 * Load steps (`solver: static` with `steps`): the body is led through states of equilibrium, and bonds break between
 * them. Time is a pseudo-time of which loads and supports are functions; nothing has inertia. */
#ifndef CLEAVE_STATICS
#define CLEAVE_STATICS

#include "base/memory_archive.h"
#include "data/region.h"
#include "bonds/family.h"
#include "scene/scene.h"
#include "solver/equilibrium.h"

/* A directed bond that was broken on trial, and what its row and its particle had. */
struct broken_bond {
    int32_t i, j; /* of the row; the other end */
    int64_t row, entry;
    real w, fracture, damage; /* weight; of the row so far [J]; of the particle */
    real plastic;             /* plastic work of bonds that the row has lost [J] */
    float volume;             /* of those [m^3] */
    uint32_t gap;             /* 0: checkpoints hold the record byte by byte */
    real held;                /* half of what the bond takes to its limit [J] */
    uint8_t flag, gaps[7];    /* 0, likewise */
};
_Static_assert(sizeof(struct broken_bond) == 80, "a record without bytes that no member sets");
struct break_list {
    int64_t n;
    struct broken_bond *bond; /* in the order in which they broke */
};

/* An advance of the crack: what its bonds hold at their limits [J], and what the body releases by it over the square
 * of the size of its loads. */
struct advance {
    real cost, release;
};

/* A crack tip that is led (led.c); in space a front, by its place in the plane across it. */
struct led_tip {
    real start[2], place[2];   /* where it started, where it is: reference positions [m] */
    real along[2], heading[2]; /* unit vectors: frame of its factors; where it goes */
    real last[2];              /* unit vector: of the last stretch behind it */
    real hold;                 /* length for which it still goes straight on [m] */
    real sees;                 /* length of the crack behind the tip or its kink [m] */
    real grown;                /* length so far [m] */
    bool reversed;             /* its pre-crack has its first corner here */
    bool ended;                /* it has reached a surface or another crack */
    bool comes;                /* it takes part in the next advance */
    int body;
    real K[2];                    /* factors of the last measurement [Pa m^(1/2)] */
    struct advance ahead, behind; /* the stretch ahead, and the last one; cost 0: none */
    real due;                     /* size of the loads at which the stretch ahead comes */
};
/* The plane in which tips are led: of the body, or in space the one across the fronts of its cracks, which are
 * straight, parallel, and go through the body (led_plane.c). */
struct led_plane {
    bool made;
    int dim;                               /* of the body */
    real spacing, section;                 /* [m]; thickness of a plane body [m] */
    real axis[2][DIM_MAX], front[DIM_MAX]; /* unit vectors: of the plane; along the fronts, 0 in a plane body */
    real middle;                           /* of a front, along it [m] */
    int mirrors;
    struct mirror_plane mirror[2 * DIM_MAX]; /* of the body, by axes of the plane */
    int body_mirrors;
    const struct mirror_plane *body_mirror; /* of the body, by axes of space; borrowed */
};
enum { LED_MAX = 64 };
struct led_stretch {
    real at[2][DIM_MAX];
    int tip;
};
struct led {
    const struct scene *scene; /* borrowed, as the source, from which cracks and bonds are made */
    const struct bond_source *source;
    struct led_plane plane;
    const char *fault; /* why there is none; NULL: there is */
    bool known;        /* tips have been looked for */
    int n;
    struct led_tip tip[LED_MAX];
    real tried; /* size of the loads at which the next advance was tried */
    int64_t stretches;
    struct led_stretch *path; /* [stretches] what they have cut, in its order */
};

/* What history.csv says of a load step beside what it says of all runs (steps_record.c). */
struct release_mark {
    real area, released;
}; /* [m^2], [J] */
struct steps_record {
    struct release_mark mark[2];   /* the release rate is that of the growth since the first one */
    real released, area, rate;     /* at the last record [J], [m^2]; over the last growth, 0 before any [J/m^2] */
    real broken;                   /* area that broken bonds have crossed [m^2] */
    real load_most;                /* largest size of the loads, control energy (statics_load_size) */
    int64_t step;                  /* the load step at hand or just done; 0: none yet */
    int64_t directions, solutions; /* of all load steps before */
};

/* A piece of the body that nothing holds in some rigid motions: its nodes, and these motions there [n dim][6], of which
 * the first `motions` are orthonormal [1]. */
struct free_piece {
    int64_t n;
    int32_t *node;
    int motions;
    real *motion;
    real middle[DIM_MAX]; /* reference position of a node in the middle of the list [m] */
};

/* State of a body between two load steps, and what equilibrium works on. Nodes of the unknowns are the peridynamic
 * particles, then the nodes of the mesh. */
struct statics {
    int64_t particles; /* of the nodes, the first ones */
    int32_t *node;     /* [nodes] particle, or node of the mesh */
    real *weight;      /* [nodes] 1/2 for every plane of symmetry that a particle lies on */
    int16_t *load;     /* [nodes DIM_MAX] boundary that holds a component, -1: none or a mirror */
    struct equilibrium balance;
    struct field way;       /* [nodes] of the next step: supports, and a guess of the rest [m] */
    real *applied[DIM_MAX]; /* [particles of the body] applied forces now [N] */
    int64_t pieces;         /* that nothing holds */
    struct free_piece *piece;
    struct block_matrix *matrix; /* springs of bonds and cells, for the preconditioner */
    struct multigrid *precondition;
    int64_t directions;            /* that the first solution with it took; 0: none yet */
    struct memory_archive plastic; /* plastic state at the last equilibrium (system.c) */
    real t;                        /* pseudo-time of loads and supports [s] */
    real overload;                 /* largest stretch over its limit of the last equilibrium [1] */
    struct break_list next;        /* bonds of the next advance; none: it has not been looked for */
    struct advance ahead, behind;  /* the next advance, and the last; cost 0: none */
    real due;                      /* size of the loads at which the next one comes, INFINITY: at none */
    bool meets;                    /* the scene has contact or rigid bodies */
    bool advances;                 /* the next load step begins with it */
    bool severs;                   /* the next advance would leave a piece that nothing holds: it does not come */
    bool stale;                    /* bonds have broken since the preconditioner was made */
    bool kept;                     /* at a checkpoint: there is one, and the next load step goes on with it */
    bool parted;                   /* and since pieces were looked for */
    real released_time;            /* that releases in time have taken so far [s] */
    struct led led;
    real largest;      /* of the balance, before the solution at hand [N] */
    bool touches;      /* something did after the last solution */
    real energy;       /* before it [J] */
    int64_t opens[2];  /* particles whose distance is the opening */
    int64_t solutions; /* equilibria found so far */
    struct steps_record record;
};

#endif
