/* Declares the functions that draw symbols over the picture of an input file: for loads, pre-cracks, probes and
 * regions. */
#ifndef CLEAVE_SCENE_MARKS
#define CLEAVE_SCENE_MARKS

#include "engine/engine.h"
#include "plot/plot.h"

/* Symbols over the picture of one input file while they are written to gnuplot, and the view of the picture. to: stream
 * that receives gnuplot commands and data blocks; plot: stream that collects the elements of the plot command, which is
 * written after all data blocks; engine: run in its initial state, whose input file is drawn. */
struct scene_overlay {
    FILE *to, *plot;
    const struct run *engine;
    struct camera camera;
    double metre;                 /* length of one unit of the axes [m] */
    double from[2], to_corner[2]; /* visible rectangle [m] */
    double arrow;                 /* length of the longest arrow [m] */
    const char *title;            /* title of the picture; NULL: the usual one */
    bool plain;                   /* the key has no numbers of particles */
    int blocks;                   /* number of data blocks so far */
    int keys, letters;            /* number of lines of the key (legend) so far; letters of its longest line */
    double widest;                /* width of its widest line [pixel] divided by the size of the letters [point] */
};

/* Begins a gnuplot data block in `overlay`, the symbols over the picture of an input file. The block contains the
 * points or arrows of one kind of symbol. Add its lines with scene_overlay_add_point and end the block with
 * scene_overlay_end_data_block. */
void scene_overlay_begin_data_block(struct scene_overlay *overlay);

/* Adds a line to the current data block of `overlay` (symbols over a picture): the point with the coordinates
 * `position` [m], projected onto the picture, and the projection of the arrow `arrow` [m]. arrow: NULL for a point
 * without an arrow. */
void scene_overlay_add_point(struct scene_overlay *overlay, const real *position, const double *arrow);

/* Ends the current data block of `overlay` and adds the element that draws it to the plot command. plot_style: text of
 * this element after the name of the block, such as "using 1:2 with points"; key_entry: text of its entry in the key
 * (legend), "" for no entry. */
void scene_overlay_end_data_block(struct scene_overlay *overlay, const char *plot_style, const char *key_entry);

/* Adds symbols for loads, supports, mirrors and absorbing faces of the input file to its picture m. */
void scene_overlay_draw_load_symbols(struct scene_overlay *overlay);

/* Draws arrows in the picture for the initial velocities of bodies and rigid bodies. Draws nothing if all are 0. */
void scene_overlay_draw_velocity_arrows(struct scene_overlay *overlay);

/* Draws the pre-cracks of the input file in the picture as lines, and an arrow where each crack with prescribed growth
 * starts. */
void scene_overlay_draw_precracks(struct scene_overlay *overlay);

/* Adds symbols at the positions of the probes (measurements during the run) of the input file to its picture m. */
void scene_overlay_draw_probe_symbols(struct scene_overlay *overlay);

/* Draws in the picture the outlines of the coarse mesh cells of a plane body, in one shade of grey for each size of
 * cells. */
void scene_overlay_draw_coarse_cell_outlines(struct scene_overlay *overlay);

/* Adds boxes around the named regions of the input file to its picture m. */
void scene_overlay_draw_region_boxes(struct scene_overlay *overlay);

/* Adds an entry to the key (legend) of the picture overlay: a square in the colour `colour` and the text `text`. */
void scene_overlay_add_colour_to_key(struct scene_overlay *overlay, struct colour colour, const char *text);

#endif
