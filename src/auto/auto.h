/* Shared by the files auto*.c. `method: auto` finds the problem of the cost-accuracy table (cost_accuracy.h) that a
 * scene resembles, takes the cheapest point of its lines that is accurate enough, and writes it into the scene as a
 * user would.
 *
 * The number of spacings in the feature that has to be resolved (width of a pulse, radius of a hole, ..) carries over
 * from the table to a scene: at equal numbers a scene of another size is the problem of the table in other units. */
#ifndef CLEAVE_AUTO
#define CLEAVE_AUTO

#include "cost_accuracy.h"
#include "scene/scene.h"

/* A kind of problem: cases of a problem of the table that share a feature. */
struct auto_kind {
    const char *problem, *at;            /* in the table; at NULL: the scene gives the cases */
    const char *title, *feature;         /* in words */
    real per_resolution;                 /* spacings in the feature over the table's resolution */
    real travel;                         /* duration x wave speed over feature, in the table's runs; 0: at rest */
    real slow;                           /* at rest: transits of the body in which loads grow (reference frame) */
    bool smooth;                         /* error is a power of the spacing: lines may be interpolated */
    real ring;                           /* radius of the rings of sif probes over the feature; 0: none */
    real known;                          /* accuracy of the reference solution: smaller errors have no meaning */
    unsigned loads;                      /* kinds of boundaries that load it, as bits */
};

/* A scene as a problem of the table. */
struct auto_match {
    const struct auto_kind *kind;
    int cases;
    const char *at[3];                   /* cases, of which the worst counts */
    real feature;                        /* size of the feature [m] */
    real travel;                         /* as in struct auto_kind */
    real growth;                         /* factor on the error of the table, by distance and material [1] */
    real strain;                         /* largest strain by the loads, about; 0: unknown */
    bool at_rest;                        /* the scene has a static solver */
    bool gap;                            /* its crack may be a gap of the lattice: no bond is cut or probed */
    bool needs_bonds;                    /* has cracks, breaking bonds or probes of bonds */
    bool points_only;                    /* the problem has fewer dimensions, where families of bonds differ */
};
/* Finds the problem that a scene resembles. REFUSED with the obstacle and the nearest problem, to follow the name of
 * the scene in a message. `at_rest`: the scene has a static solver. */
status auto_match_find(struct auto_match *m, const struct scene *s, bool at_rest);

/* Extent of the first solid of a body along an axis [m]; 0: it has none. */
real auto_extent(const struct scene *s, int body, int axis);

/* Largest spacing at which the rings of sif probes are wide enough [m]. */
real auto_spacing_rings(const struct scene *s);

/* A point on a line of the table: one of its runs or between two. */
struct auto_point {
    const struct cost_point *of;         /* gives method, keys, horizon and step */
    real resolution, error, seconds;     /* as in the table */
    real particles, steps;
};
struct auto_wish {
    const struct auto_match *match;
    real accuracy;                       /* largest error of a point of the table [1] */
    real resolution;                     /* resolution of the user's spacing; 0: free */
    bool (*allows)(const struct cost_point *p, const void *context);
    const void *context;
};
/* best: the cheapest point; second: the cheapest of another method; finest: the smallest error that an allowed line
 * reaches. `of` NULL: none. */
struct auto_found { struct auto_point best, second, finest; };
void auto_pick(struct auto_found *f, const struct cost_accuracy *c, const struct auto_wish *w);

/* Writes method, keys, horizon and step of a point, and a spacing, into the tree of a scene (auto_lay.c); keys of the
 * user stay. */
struct reader;
struct node;
status auto_lay(struct reader *r, struct node *root, const struct auto_match *m, const struct scene *s,
                const struct cost_point *p, real spacing);

/* Reads `accuracy`, a share or {of, within, budget}, into `figure`, `within` and `budget` (auto_accuracy.c). */
struct pilot_wish;
status auto_accuracy_read(struct reader *r, const struct node *root, struct pilot_wish *w);

/* With `method: auto` writes the choice into the tree; does nothing with other methods (auto.c). Where the table does
 * not answer: REFUSED, and `pilot` (NULL: not asked for) says what is wanted then, with the scene. */
status auto_resolve(struct reader *r, struct node *root, const char *text, size_t length, struct pilot_wish *pilot);

#endif
