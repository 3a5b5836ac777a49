/* Declares the layout, the key (legend), the colour bar and the panels of pictures of maps: coloured images of a
 * quantity over the body. */
#ifndef CLEAVE_MAPS_PARTS
#define CLEAVE_MAPS_PARTS

#include "plot/plot.h"

/* Key (legend) of one picture of maps (coloured images of a quantity): n entries, each a colour and its name. An entry
 * with a transparent colour is a line of text without a coloured square. */
struct map_key {
    int n;
    struct category of[CATEGORIES_MOST + 2];
};

/* Content of a picture of maps (coloured pictures of a quantity over the body, one panel each): quantity, view, key
 * (legend) and heading. title: "" for no heading. */
struct maps_content {
    enum map map;            /* quantity */
    const struct view *view; /* rectangle and colours */
    const char *title;
    struct map_key key; /* key (legend) */
    enum picture_format format;
    bool outside; /* panels are outside views, without axes at their left */
};

/* Size of a picture with panels in rows and columns, and positions of panels, colour bar and key (legend) in it. */
struct maps_layout {
    int columns, rows;             /* number of columns and of rows of panels */
    int panel_width, panel_height; /* size of a panel [pixel] */
    int width, height;             /* size of the picture [pixel] */
    int left, above, below, gap;   /* margins of the panels; distance of columns [pixel] */
    int title;                     /* distance of the title from the left edge [pixel] */
    int right;                     /* width of the colour bar or key on the right [pixel] */
    bool fits;                     /* the panels and their titles have room in the picture */
    int spare;                     /* blank beside panels that fill the height before the width [pixel] */
    bool bar_under, key_beside; /* the colour bar is below the panels, else on the right; the key is on the right, else
                                   below */
    int least;                  /* least height below the upper margin, for a colour bar on the right [pixel] */
    int axes;                   /* height of tics and label below the panels [pixel] */
    int entries, entry;         /* number of entries of the key below the panels; width of an entry [pixel] */
    int key_columns;            /* number of entries in a row of the key */
};

/* Sizes in pictures of maps [pixel]. GAP_Y: distance between rows of panels; BAR_FROM: distance of the colour bar from
 * the panels; BAR_WIDE: width of the bar; BAR_STRIP: height of a bar below the panels, with its numbers and label.
 * KEY_SQUARE: width of an entry of the key (legend) without its text; KEY_ROW: distance between rows of the key;
 * KEY_LEFT, KEY_UNDER: margins beside and below the key; KEY_LETTER: mean width of a letter of the key. Names that end
 * in NARROW: values for narrow pictures. */
enum { GAP_Y = 42, BAR_FROM = 26, BAR_FROM_NARROW = 16, BAR_WIDE = 16, BAR_STRIP = 62 };
enum { KEY_SQUARE = 40, KEY_ROW = 22, KEY_LEFT = 14, KEY_UNDER = 6 };
static const double KEY_LETTER = 8.2, KEY_LETTER_NARROW = 6.6;

/* Returns the layout of a picture of maps (coloured pictures of a quantity over the body, one panel each) with the best
 * compromise between large panels, a picture of pleasant shape and few empty positions. In narrow pictures
 * (picture_size_is_too_narrow_for_side_legend) the colour bar, or the key (legend) of named values, is below the panels
 * if the panels are larger then. shown: content of the picture; panel_count: number of panels; height_over_width:
 * height of a panel divided by its width. */
struct maps_layout maps_layout_choose(const struct maps_content *shown, int panel_count, double height_over_width);

/* Returns REFUSED, with a message that has the number of panels that fit, if `panel_count` panels have no room in a
 * picture of the size that the user has chosen; else OK. A single panel is not refused. shown: what the map shows;
 * height_over_width: height of a panel divided by its width. */
status maps_layout_check_panels_fit(const struct maps_content *shown, int panel_count, double height_over_width);

/* Returns true if a map (coloured picture) of the quantity `map` has a colour bar; maps of fragments and of named
 * values have none. */
bool map_quantity_has_colour_bar(enum map map);

/* Returns the width [pixel] of the longest number at the tics (labelled marks) of an axis. low, high: values at the
 * ends of the axis; tics: distance between tics, in the unit of the values; format: format of the numbers as in printf.
 */
double axis_longest_tic_number_width(double low, double high, double tics, const char *format);

/* Chooses the distance between neighbouring tics (labelled marks) of a horizontal axis, in the unit of its values, such
 * that their numbers do not touch and there are at least two tics, or one if there is no space for two. low, high:
 * values at the ends of the axis; axis_width: length of the axis [pixel]. Returns the distance. */
double horizontal_axis_choose_tic_distance(double low, double high, double axis_width);

/* Returns the width [pixel] that a colour bar with its numbers and its label takes on the right of panels with the
 * content `shown`. panels_height: height of all rows of panels [pixel]. */
int colour_bar_width_beside_panels(const struct maps_content *shown, int panels_height);

/* Returns the height [pixel] that a picture with the content `shown` needs below the upper edge of a colour bar on the
 * right, so that the bar is as long as its label. */
int colour_bar_least_height(const struct maps_content *shown);

/* Collects the entries of the key (legend) of a picture in *key: kinds of particles, fragments or named values, as the
 * quantity `map` requires, and rigid bodies if `has_rigid_bodies` is true. view: view with the named values. */
void map_key_collect_entries(struct map_key *key, enum map map, const struct view *view, bool has_rigid_bodies);

/* Writes the gnuplot commands that draw the key (legend) of a picture at its position in the layout. */
void map_key_draw(FILE *gnuplot, const struct maps_layout *layout, const struct map_key *key);

/* Writes the gnuplot commands that draw the colour bar of a picture at its position in the layout, with the percentages
 * of the particles whose values are below and above the range of the bar. shown: content of the picture;
 * particle_count: number of particles of an output frame. */
void map_colour_bar_draw(FILE *gnuplot, const struct maps_layout *layout, const struct maps_content *shown,
                         int64_t particle_count);

/* Writes the gnuplot commands that set the margins such that the next plot fills a box of the given width and height
 * [pixel] in the picture with `layout`. left_edge, upper_edge: distances of the upper left corner of the box from the
 * left and upper edge of the picture [pixel]. */
void plot_box_write_margins(FILE *gnuplot, const struct maps_layout *layout, double left_edge, double upper_edge,
                            double width, double height);

/* Writes the gnuplot commands that set the margins of a panel with the panel size of the layout. left_edge, upper_edge:
 * distances of the upper left corner of the panel from the left and upper edge of the picture [pixel]. */
void panel_write_margins(FILE *gnuplot, const struct maps_layout *layout, double left_edge, double upper_edge);

/* Returns the unit of length of the axes of all panels (one for each output frame) of a picture. It is chosen by the
 * longer edge of the rectangle that `view` shows, regardless of the coordinates of the body: millimetres from 0.5 mm to
 * 1 m, else metres with the SI prefix that gives one to three digits. */
struct unit panel_choose_length_unit_of_axes(const struct view *view);

/* Returns the width [pixel] of the longest number at the tics of the horizontal axis of a panel. view: rectangle of the
 * panel; width: width of the panel [pixel]. */
double panel_horizontal_axis_longest_number_width(const struct view *view, double width);

/* Returns the width [pixel] that the numbers and the label at the vertical axis of a panel take. view: rectangle of the
 * panel; height: height of the panel [pixel]. */
double panel_vertical_axis_labels_width(const struct view *view, double height);

/* Writes the gnuplot commands for tics and labels of a panel that shows a plane body or a slice. layout: layout of the
 * picture; view: rectangle of the panel; particles: particles of the panel; axis_unit: unit of the axes; column: column
 * of the panel, from 0 (the vertical axis has labels in column 0 only); is_lowest: true if no panel is below it, so
 * that its lower axis has labels. */
void panel_write_axes(FILE *gnuplot, const struct maps_layout *layout, const struct view *view,
                      const struct plotted_particles *particles, const struct unit *axis_unit, int column,
                      bool is_lowest);

/* Writes the gnuplot commands that draw, below a panel with a view of a three-dimensional body from outside, its
 * coordinate axes as arrows and a bar of known length. layout: layout of the picture; view: rectangle of the panel;
 * particles: particles of the panel; axis_unit: unit of length; left_edge, upper_edge: distances of the upper left
 * corner of the panel from the left and upper edge of the picture [pixel]. */
void panel_write_axis_arrows(FILE *gnuplot, const struct maps_layout *layout, const struct view *view,
                             const struct plotted_particles *particles, const struct unit *axis_unit, double left_edge,
                             double upper_edge);

/* Writes the gnuplot commands and data that plot the image pixel[pixel_rows * pixel_columns], rows from bottom to top.
 * lower_left_corner[2]: lower left corner of the image; pixel_size[2]: width and height of a pixel, both in units of
 * the axes. further_plot_elements: further elements of the plot command, each preceded by a comma, or "". */
void panel_write_image(FILE *gnuplot, const struct colour *pixel, int pixel_columns, int pixel_rows,
                       const double *lower_left_corner, const double *pixel_size, const char *further_plot_elements);

#endif
