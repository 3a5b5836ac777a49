/* Marks drawn over the particles of a scene. */
#ifndef CLEAVE_SCENE_MARKS
#define CLEAVE_SCENE_MARKS

#include "engine/engine.h"
#include "plot/plot.h"

/* State of the marks. Data are sent to gnuplot at once; the elements of its plot command are collected in `plot`. */
struct marks {
    FILE *to, *plot;
    const struct run *engine;
    struct camera camera;
    double metre;                 /* length of one unit of the axes [m] */
    double from[2], to_corner[2]; /* visible rectangle [m] */
    double arrow;                 /* length of the longest arrow [m] */
    int blocks;                   /* number of data blocks so far */
};

/* Begins the data block of a mark. */
void mark_begin(struct marks *m);

/* Adds a line with the projected position X [m] and a projected vector [m]; vector: NULL for none. */
void mark_place(struct marks *m, const real *X, const double *vector);

/* Ends the data block and adds its element to the plot command. how: the style in that element; text: the line of the
 * key, "" for none. */
void mark_end(struct marks *m, const char *how, const char *text);

/* Draws loads, supports, mirrors and absorbing faces. */
void marks_loads(struct marks *m);

/* Draws the initial velocities. */
void marks_motion(struct marks *m);

/* Draws pre-cracks and growing cracks. */
void marks_cracks(struct marks *m);

/* Draws the positions of probes. */
void marks_probes(struct marks *m);

/* Draws the coarse cells of the levels. */
void marks_levels(struct marks *m);

/* Draws boxes around named regions. */
void marks_regions(struct marks *m);

/* Adds a line with a coloured square to the key. */
void marks_colour(struct marks *m, struct colour c, const char *text);

#endif
