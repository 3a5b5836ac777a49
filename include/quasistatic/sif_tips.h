/* Crack increments of load steps, and tips of cracks whose direction follows from their stress-intensity factors. */
#ifndef CLEAVE_SIF_TIPS
#define CLEAVE_SIF_TIPS

#include "data/region.h"
#include "scene/scene.h"

/* Energies of a crack increment, a set of bonds that break together. The energy that the body releases grows with the
 * square of the load size L, a measure proportional to the loads: prescribed displacements [m] or else forces [N]
 * (statics_norm_of_prescribed_loads). */
struct crack_increment {
    real cost;    /* energy of its bonds at their critical stretch [J]; 0: there is no increment */
    real release; /* energy that the body releases, divided by the square of the load size [J/m^2, J/N^2] */
};

/* The tip of a SIF-driven crack: the direction of its growth follows from its stress-intensity factors. In space the
 * struct describes a straight front by its intersection with the plane across it. Positions are reference positions in
 * that plane. */
struct sif_crack_tip {
    real start[2];                 /* position before any growth [m] */
    real position[2];              /* present position [m] */
    real along[2];                 /* unit vector: x axis of the frame of the stress-intensity factors */
    real heading[2];               /* unit vector: direction of the next increment */
    real last[2];                  /* unit vector: direction of the segment that ends at the tip */
    real straight;                 /* length of growth for which the direction still stays constant [m] */
    real length_behind;            /* length of the crack behind the tip, from its start or its last kink [m] */
    real grown;                    /* growth so far [m] */
    bool reversed;                 /* the first corner of the pre-crack lies at this tip, not the second one */
    bool ended;                    /* the tip has reached a surface or another crack and grows no more */
    bool selected;                 /* the tip takes part in the next crack increment */
    int body;                      /* index of the body in which the tip is */
    real K[2];                     /* K_I and K_II of the last evaluation [Pa m^(1/2)] */
    struct crack_increment ahead;  /* the next increment of the tip */
    struct crack_increment behind; /* the last increment of the tip */
    real due;                      /* load size at which the next increment is due, INFINITY: at no load [m, N] */
};

/* The plane in which the tips move: the plane of a plane body, or in space the plane across the fronts, which must be
 * straight and parallel and run through the whole body (sif_plane.c). */
struct crack_tip_plane {
    bool made;             /* the plane has been found */
    int dim;               /* of the body */
    real spacing;          /* of the particles [m] */
    real section;          /* thickness of a plane body [m] */
    real axis[2][DIM_MAX]; /* unit vectors that span the plane */
    real front[DIM_MAX];   /* unit vector along the fronts; 0 for a plane body */
    real middle;           /* position of the middle of a front along `front` [m] */
    int mirrors;
    /* [mirrors] symmetry planes parallel to the fronts; the member `axis` is 0 or 1, an axis of the plane */
    struct mirror_plane mirror[2 * DIM_MAX];
    int body_mirrors;
    /* [body_mirrors] symmetry planes of the body; the member `axis` is a coordinate axis; borrowed */
    const struct mirror_plane *body_mirror;
};

/* Largest number of tips of SIF-driven cracks. */
enum { SIF_TIPS_MAX = 64 };

/* A straight segment of the path along which a crack tip has grown; the bonds that crossed it are broken. */
struct path_segment {
    real at[2][DIM_MAX]; /* its ends, in the plane of the tips [m] */
    int tip;             /* number of the tip */
};

/* The SIF-driven cracks of a run: the direction of their growth follows from their stress-intensity factors. */
struct sif_cracks {
    const struct scene *scene;        /* borrowed */
    const struct bond_source *source; /* borrowed: pre-cracks, neighbourhood and critical stretches */
    struct crack_tip_plane plane;     /* plane in which the tips move */
    const char *fault;                /* why no crack of the scene is SIF-driven; NULL: cracks are */
    bool known;                       /* the tips of the pre-cracks have been found */
    int n;
    struct sif_crack_tip tip[SIF_TIPS_MAX]; /* [n] */
    real tried;                             /* load size at which the next increment was last determined [m, N] */
    int64_t segments;
    struct path_segment *path; /* [segments] cut so far, in the order of growth */
};

#endif
