/* Room `quasistatic` (folder of include/ and src/): load steps, and the solvers of static problems. The room may use
 * the structures of a run and the time step; the engine calls it.
 *
 * Load steps (`solver: static` with the key `steps`): the body follows a sequence of equilibrium states, and bonds
 * break between them. Loads and supports are functions of a pseudo-time; nothing has inertia. */
#ifndef CLEAVE_STATICS
#define CLEAVE_STATICS

#include "base/memory_archive.h"
#include "bonds/family.h"
#include "quasistatic/sif_tips.h"
#include "scene/scene.h"
#include "solver/equilibrium.h"

/* A broken directed bond from particle i to j, with the values that particle i and its row (all bonds of particle i)
 * had before the bond broke. The bond is restored from them after a trial. */
struct broken_bond {
    int32_t i, j;       /* particle of the row; neighbour */
    int64_t row, entry; /* index of the row, and of the bond, in the arrays of struct bonds */
    real w;             /* weight of the bond before it broke [1] */
    real fracture;      /* fracture energy of the row with the bond intact [J] */
    real damage;        /* damage of the particle with the bond intact [1] */
    real plastic;       /* plastic work of the broken bonds of the row, with the bond intact [J] */
    float volume;       /* volume of the broken bonds of the row, with the bond intact [m^3] */
    uint32_t gap;       /* padding, always 0, since checkpoints store the record byte by byte */
    real held;          /* half of the energy that stretches the bond from zero force to its critical stretch [J] */
    uint8_t flag;       /* flags (enum particle_flag) of the particle with the bond intact */
    uint8_t gaps[7];    /* padding, always 0 */
};
_Static_assert(sizeof(struct broken_bond) == 80, "a record without bytes that no member sets");

/* A list of directed bonds, in the order in which they break; a pair of particles has two. `bond` is owned. */
struct break_list {
    int64_t n;
    struct broken_bond *bond; /* [n] */
};

/* Crack area and released energy at one pseudo-time. The energy release rate between two such instants is the
 * difference of the energies divided by the difference of the areas. */
struct release_mark {
    real area;     /* crack area [m^2] */
    real released; /* energy released so far [J] */
};

/* Values of the columns that load steps add to history.csv (steps_record.c). */
struct steps_record {
    struct release_mark mark[2]; /* the release rate is computed from the growth since the first one */
    real released;               /* energy released until the last record [J] */
    real area;                   /* crack area at the last record, halved on planes of symmetry [m^2] */
    real face;                   /* area of one face of the crack at the last record [m^2] */
    real rate;                   /* release rate of the last growth, 0 before any growth [J/m^2] */
    real broken;                 /* crack area by the number of broken bonds [m^2] */
    real load_most;              /* largest load size so far, under energy control [m, N] */
    int64_t step;                /* number of the present or last load step; 0: none yet */
    int64_t directions;          /* search directions of the solver until the last record */
    int64_t solutions;           /* equilibria until the last record */
};

/* A fragment (connected part) of the body with rigid motions that neither supports nor bonds nor contact resist. */
struct unconstrained_fragment {
    int64_t n;
    int32_t *node;        /* [n] its unknowns */
    int motions;          /* number of the free rigid motions, at most 6 */
    real *motion;         /* [n dim][6] orthonormal free motions in the first columns [1] */
    real middle[DIM_MAX]; /* mean reference position of the nodes [m] */
};

/* State of a material point at the start of a load step, from which two changes in the step are measured: the rotation
 * of its direction of plastic flow, and the decrease of its yield stress (flow_turn.h). Tensors have the components xx
 * yy zz xy yz zx, in the axes of the cell of the point. */
struct flow_start {
    real relative[SYM_MAX]; /* deviator of the stress less the back stress [Pa] */
    real elastic[SYM_MAX];  /* deviator of Hooke's stress of the whole strain [Pa] */
    real bound;             /* yield stress [Pa] */
    real strain;            /* accumulated plastic strain [1] */
};

/* The largest rotation of the direction of plastic flow within a load step, over all material points and load steps so
 * far. */
struct plastic_flow_direction_change {
    real angle;             /* angle of the rotation [rad]; 0: no direction has rotated */
    real position[DIM_MAX]; /* reference position of the point [m] */
    int64_t step;           /* number of the load step */
};

/* The largest fall of the yield stress of a point within a load step in which it flows. */
struct plastic_flow_thermal_softening {
    real share;             /* fall divided by the yield stress at the start of the step [1]; 0: none has fallen */
    real position[DIM_MAX]; /* reference position of the point [m] */
    int64_t step;           /* number of the load step */
};

/* State of a body between two load steps, and the storage of the equilibrium solver. The nodes of the system of
 * equations are the peridynamic particles, then the nodes of the mesh that move. Arrays are owned unless noted. */
struct statics {
    int64_t particles;            /* number of peridynamic particles, which are nodes 0 .. particles - 1 */
    int32_t *node;                /* [nodes] index of the particle, or of the node in the mesh */
    real *weight;                 /* [nodes] factor 1/2 for each plane of symmetry on which a particle lies [1] */
    const struct mesh *mesh;      /* mesh whose nodes are unknowns; borrowed from the reference frame */
    int16_t *load;                /* [nodes DIM_MAX] boundary that prescribes a component, -1: none or a mirror */
    struct newton_solver balance; /* solver of the equilibrium; its vectors have one entry for each node */
    struct field increment; /* [nodes] displacement increment to the next equilibrium: prescribed, else predicted [m] */
    real *applied[DIM_MAX]; /* [particles of the body] present applied forces [N] */
    int64_t fragments;      /* number of unconstrained fragments */
    struct unconstrained_fragment *fragment;         /* [fragments] */
    struct block_matrix *matrix;                     /* stiffness of bonds, cells and contact, for the preconditioner */
    struct multigrid *precondition;                  /* preconditioner; NULL until its next use makes it */
    int64_t directions;                              /* search directions of the first solution with it; 0: none yet */
    struct memory_archive plastic;                   /* plastic state at the start of the next solutions (system.c) */
    struct flow_start *flow_start;                   /* [particles of the body] NULL until the first load step */
    struct plastic_flow_direction_change turn;       /* the largest one so far */
    struct plastic_flow_thermal_softening softening; /* the largest one so far */
    real t;                                          /* present pseudo-time [s] */
    real stretch_ratio;            /* largest ratio of stretch to critical stretch in the last equilibrium [1] */
    struct break_list next;        /* bonds of the next crack increment; empty: none has been found */
    struct crack_increment ahead;  /* the next crack increment */
    struct crack_increment behind; /* the last crack increment */
    real due; /* size of the loads (displacement or force) at which the next increment is due, INFINITY: none [m, N] */
    bool has_contact;        /* the scene has contact or rigid bodies */
    bool increment_due;      /* the next load step begins with the crack increment */
    bool severs;             /* the next increment would sever the body and is not made */
    bool precondition_stale; /* bonds have broken since the preconditioner was made */
    bool kept;               /* the checkpoint was written while there was a preconditioner (restored runs) */
    bool fragments_stale;    /* bonds have broken since the fragments were found */
    real released_time;      /* sum of the physical times of all dynamic releases [s] */
    struct sif_cracks sif;   /* cracks that grow by their stress-intensity factors */
    real largest;            /* largest force norm of the balance before the present solution [N] */
    bool in_contact;         /* at least one contact was closed at the end of the last solution */
    real energy;             /* stored energy and plastic work of bonds before the present solution [J] */
    real slid[DIM_MAX]; /* largest mean displacement of a fragment along an axis on which only friction could hold it
                           [m] */
    int64_t gauge[2];   /* indices of both particles whose distance is the opening (control opening) */
    int64_t solutions;  /* number of equilibria found so far */
    struct steps_record record; /* results by load step, for files */
};

#endif
