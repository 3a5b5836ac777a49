/* What is drawn over the particles of a scene. */
#ifndef CLEAVE_SCENE_MARKS
#define CLEAVE_SCENE_MARKS

#include "engine/engine.h"
#include "plot/plot.h"

/* Data go to gnuplot at once, the parts of its plot command are collected. */
struct marks {
    FILE *to, *plot;
    const struct run *engine;
    struct camera camera;
    double metre;                 /* [m] of a unit of the axes */
    double from[2], to_corner[2]; /* the rectangle that is shown [m] */
    double arrow;                 /* length of the longest arrow [m] */
    int blocks;                   /* data blocks so far */
};

/* Begins the data block of a mark. */
void mark_begin(struct marks *m);
/* A place X [m], and a second number pair: a vector in space [m], or NULL. */
void mark_place(struct marks *m, const real *X, const double *vector);
/* Ends the block; `how` is the rest of gnuplot's plot element, `text` its line of the key ("": none). */
void mark_end(struct marks *m, const char *how, const char *text);

/* Loads, supports, mirrors, absorbing faces; velocities at the start. */
void marks_loads(struct marks *m);
void marks_motion(struct marks *m);
/* Pre-cracks, cracks that grow, probes, levels of cells, boxes round regions that have names. */
void marks_cracks(struct marks *m);
void marks_probes(struct marks *m);
void marks_levels(struct marks *m);
void marks_regions(struct marks *m);
/* A line of the key for a colour. */
void marks_colour(struct marks *m, struct colour c, const char *text);

#endif
