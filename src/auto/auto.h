/* floor 4: what the files auto*.c share: `method: auto` finds the problem of the chart (chart.h) that a scene is like,
 * takes from its lines the cheapest point that is accurate enough, and writes it into the scene as a user would.
 *
 * What carries over from the chart to a scene is the number of spacings in the feature that has to be resolved (a pulse's
 * width, a hole's radius, ..): with it fixed, a scene of another size is the same problem in other units. */
#ifndef CLEAVE_AUTO_H
#define CLEAVE_AUTO_H

#include "chart.h"
#include "scene/scene.h"

/* A kind of problem: some cases of a problem of the chart with one feature. */
struct auto_kind {
    const char *problem, *at;            /* in the chart; at NULL: the scene says which cases                 */
    const char *title, *feature;         /* in words                                                          */
    real per_resolution;                 /* spacings in the feature over the chart's resolution               */
    real travel;                         /* duration x wave speed over feature, of the chart's runs; 0: at rest */
    real slow;                           /* at rest: transits of the body in which the reference frame loads it */
    bool smooth;                         /* error is a power of the spacing: lines may be interpolated        */
    real ring;                           /* radius of the rings of sif over the feature; 0: none              */
    real known;                          /* how well the chart knows the solution: smaller errors mean nothing */
    unsigned loads;                      /* kinds of boundaries that move it, as bits                         */
};

/* A scene as a problem of the chart. */
struct auto_match {
    const struct auto_kind *kind;
    int cases;
    const char *at[3];                   /* the worst of these counts                                         */
    real feature;                        /* [m]                                                               */
    real travel;                         /* as that of the kind                                               */
    real growth;                         /* of the error beside the chart's, since waves go farther [1]       */
    real strain;                         /* largest by the loads, about; 0: unknown                           */
    bool at_rest;                        /* a static solver is asked for                                      */
    bool gap;                            /* its crack may be a gap of the lattice: nothing cuts bonds or watches them */
    bool needs_bonds;                    /* cracks, or something that watches bonds                           */
    bool points_only;                    /* the chart's space has fewer dimensions, and lattices of bonds differ */
};
/* REFUSED with what is in the way and what is nearest, to stand behind the scene's name; `at_rest`: it asks for a static
 * solver. */
status auto_match_find(struct auto_match *m, const struct scene *s, bool at_rest);

/* Extent of the first solid of a body along an axis [m]; 0: it has none. */
real auto_extent(const struct scene *s, int body, int axis);
/* Largest spacing <= h that divides the first solid's edges, and those of gaps and cracks along the axes, into whole
 * numbers (`even`: of pairs); h where none is near. */
real auto_spacing_fit(const struct scene *s, real h, bool even);

/* A point on a line of the chart, between its runs or one of them. */
struct auto_point {
    const struct chart_point *of;        /* gives method, keys, horizon and step                              */
    real resolution, error, seconds;     /* as the chart counts                                               */
    real particles, steps;
};
struct auto_wish {
    const struct auto_match *match;
    real accuracy;                       /* of the match's measure, after its growth                          */
    real resolution;                     /* that the user's spacing is; 0: free                               */
    bool (*allows)(const struct chart_point *p, const void *context);
    const void *context;
};
/* The cheapest and the next method after it (`of` NULL: none), and the best that any line allowed reaches at the most. */
struct auto_found { struct auto_point best, second, finest; };
void auto_pick(struct auto_found *f, const struct chart *c, const struct auto_wish *w);

/* Lays method, keys, horizon and step of a point, and a spacing, over the tree of a scene (auto_lay.c); keys that are there
 * stay. */
struct reader;
struct node;
status auto_lay(struct reader *r, struct node *root, const struct auto_match *m, const struct scene *s,
                const struct chart_point *p, real spacing);

#endif
