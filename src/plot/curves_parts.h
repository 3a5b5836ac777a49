/* Declares types, constants and functions for the pictures of curves of a run: layout, axes, key (legend), and one
 * function for each kind of picture. */
#ifndef CLEAVE_CURVES_PARTS
#define CLEAVE_CURVES_PARTS

#include "plot/plot.h"

/* History of one run (columns against time or load step) and the properties of the run that its pictures of curves
 * need. history_curves_draw makes it once for all pictures; pointers are borrowed. */
struct series {
    const struct history *h; /* history of the run; borrowed */
    int time;                /* column of the time, or of the number of the load step */
    struct unit second;      /* unit of the time; factor 1 without name for load steps */
    enum picture_format format;
    const char *pictures; /* folder of the pictures */
    bool bar;             /* the run has one dimension */
    bool equilibrium;     /* the run computes one equilibrium */
    double spacing;       /* of the particles; 0: unknown [m] */
};

/* Returns the largest absolute value in the column with index `column_index` of `history`; 0 if the column has no
 * values. */
double history_largest_magnitude(const struct history *history, int column_index);

/* Range of a set of numbers: its smallest and its largest value. */
struct value_range {
    double low, high;
};

/* Returns the smallest and the largest finite value in the columns of `history` whose indices are
 * column_index[column_count]. */
struct value_range history_value_range(const struct history *history, const int *column_index, int column_count);

/* Returns true if one of two curves of `history` hides the other in a picture. column_index[2]: columns of the curves;
 * shift[2]: constants that are subtracted from their values; axis_extent: largest minus smallest value of the axis. Two
 * curves coincide in a row if they differ by at most the width of a line. One hides the other if they coincide in all
 * rows, or, at values away from 0, in more than a quarter of all rows. */
bool history_curves_coincide(const struct history *history, const int column_index[2], const double shift[2],
                             double axis_extent);

/* Dashes of a curve that coincides with one drawn before, which is seen between the dashes, in gnuplot's notation. */
#define DASHES_OVER_CURVE "dt (7,7)"

/* Writes the time and the columns with the indices column_index[column_count] of the history series->h to gnuplot (the
 * stream `gnuplot`) as the data block $data. Values of column_index[k] are divided by factor[k]. Long histories are
 * reduced to a few thousand rows, the last one included. */
void curves_write_gnuplot_data_block(FILE *gnuplot, const struct series *series, const int *column_index,
                                     const double *factor, int column_count);

/* Capacity of a colour in gnuplot's notation, #rrggbb, with its terminator [byte]. */
enum { COLOUR_ROOM = 8 };

/* Writes the colour of curve number curve_index, from 0, of `curve_count` curves that show successive times to `text`,
 * in gnuplot's notation: a shade of the sequential colour scale, dark for the first time. */
void curve_colour_write_by_time_order(char text[COLOUR_ROOM], int curve_index, int curve_count);

/* Layout of a picture of curves: its size, and the distances of its panels from the left, right, upper and lower edge
 * [pixel]; columns and lines of its key, and whether the key is below the panels. */
struct curves_layout {
    int width, height;
    double left, right, above, below;
    int key_columns, key_lines;
    bool key_below;
};

/* Returns the layout (sizes and margins of panels, position of the key) of the picture of curves that `gnuplot` draws.
 * key_entry_count: number of texts of the key (legend), 0 for a picture without key; longest_key_entry: number of
 * letters of the longest text; has_second_axis: true if there is a second vertical axis on the right; panel_count:
 * number of panels of equal height, one above another. The key is beside the panels. In narrow pictures
 * (picture_size_is_too_narrow_for_side_legend), with a second axis, or if it is higher than a panel, it is below them.
 */
struct curves_layout curves_layout_make(const struct gnuplot *gnuplot, int key_entry_count, size_t longest_key_entry,
                                        bool has_second_axis, int panel_count);

/* Returns the least height [pixel] of a panel with a key (legend) of entry_count entries beside it. */
double curves_key_height_beside_panel(int entry_count);

/* Returns the height [pixel] between the upper edge of the first panel of `layout` and the lower edge of the last
 * panel. */
double curves_layout_height_of_all_panels(const struct curves_layout *layout);

/* Writes the gnuplot commands for the margins of a panel of a picture with the given layout. upper_edge, lower_edge:
 * distances of the upper and the lower edge of this panel from the upper edge of the first panel [pixel]. */
void curves_write_panel_margins(FILE *gnuplot, const struct curves_layout *layout, double upper_edge,
                                double lower_edge);

/* Writes the gnuplot command for the position of the key (legend) in the layout to the stream `gnuplot`. */
void curves_write_key_position(FILE *gnuplot, const struct curves_layout *layout);

/* Writes the gnuplot commands for the margins and the key (legend) of a picture with one panel and the given layout to
 * the stream `gnuplot`. */
void curves_write_margins_and_key(FILE *gnuplot, const struct curves_layout *layout);

/* Edges of two panels, one above the other, as distances from the upper edge of the upper panel [pixel]: lower edge of
 * the upper panel, upper and lower edge of the lower panel. The lower panel takes about a fourth of the height. */
struct two_panel_edges {
    double upper_end, lower_from, lower_end;
};

/* Returns the edges of two panels, one above the other, in a picture with the given layout. */
struct two_panel_edges curves_layout_edges_of_two_panels(const struct curves_layout *layout);

/* Chooses the distance between neighbouring tics (labelled marks) of an axis, in the unit of its values: 1, 2 or 5
 * times a power of ten, with at most about ten tics that are at least `least_distance` pixels apart. value_extent:
 * largest minus smallest value at the axis; axis_length: length of the axis [pixel]. Returns the distance. */
double axis_choose_tic_distance(double value_extent, double axis_length, double least_distance);

/* Writes the gnuplot command for the tics (labelled marks) of the vertical axis `vertical_axis` ("y" or "y2") of a
 * panel. low, high: values at the ends of the axis; panel_height: height of the panel [pixel]. */
void curves_write_vertical_tics(FILE *gnuplot, const char *vertical_axis, double low, double high, double panel_height);

/* Writes the gnuplot command for the tics of a horizontal axis from `low` to `high`, so far apart that their numbers do
 * not touch. layout: layout of the picture. */
void curves_write_horizontal_tics(FILE *gnuplot, const struct curves_layout *layout, double low, double high);

/* PANEL_GAP: distance of panels one above another [pixel]; TIME_LETTERS: number of letters of a time in a key, as
 * `123.4 µs`. */
enum { PANEL_GAP = 26, TIME_LETTERS = 9 };

/* Writes the gnuplot commands for the heading of a picture to the stream of `gnuplot`. The heading is `title` or, if
 * `title` ends in a space, `title` followed by `quantity`, the name of the quantity that is shown. */
void curves_write_title(struct gnuplot *gnuplot, const char *title, const char *quantity);

/* Writes the heading of a picture to text[TITLE_LENGTH]: `title`, followed by a note on the number of particles outside
 * the picture, `outside_count`, unless this number is 0. */
void title_append_count_of_particles_outside_view(char *text, const char *title, int64_t outside_count);

/* Writes the gnuplot commands for the horizontal axis of a picture, with its range and label, to the stream `gnuplot`.
 * The axis shows the time or the number of the load step. series: history that is drawn. */
void curves_write_time_axis(FILE *gnuplot, const struct series *series);

/* Draws the stress-intensity factors of all SIF probes against time and, in a panel below, the relative differences
 * between their integration contours, as the picture `sif` in the folder series->pictures. title: heading of the
 * picture; series: history of the run. Returns OK without a picture if the run has no SIF probe, FAILED if gnuplot
 * fails. */
status sif_curves_draw(const char *title, const struct series *series);

/* Draws the paths of the crack tips that GROWTH probes follow as the picture `path` in the folder series->pictures,
 * with the angle measured in an experiment if the input file states one. folder: folder of the run; title: heading of
 * the picture; series: history of the run. Returns OK without a picture if the run has no GROWTH probe, FAILED if
 * gnuplot fails. */
status crack_paths_draw(const char *folder, const char *title, const struct series *series);

/* Returns true if the run in `folder` consists of load steps (successive static equilibria), not of steps in time. */
bool run_has_load_steps(const char *folder);

/* Draws the force over the displacement of each support and rigid body that carries a force to the picture file
 * `picture`, for each component along which it is driven, with the largest force marked. title: heading of the picture;
 * history: history of the run; spacing: particle spacing [m], by which round-off is distinguished from motion; 0 if
 * unknown. If no support or body carries a force or moves, prints this instead of drawing, and names the probe that
 * would record it. Returns FAILED if gnuplot fails. */
status load_displacement_draw(struct output_picture picture, const char *title, const struct history *history,
                              double spacing);

/* Draws, for a run with load steps (successive static equilibria), the energy release rate against the new crack area
 * (R-curve) to the picture file `picture`, with lines at the fracture energies G_c of the materials. folder: folder of
 * the run; title: heading of the picture; history: history of the run. If no crack has grown, prints this instead of
 * drawing. Returns FAILED if gnuplot fails. */
status r_curve_draw(struct output_picture picture, const char *folder, const char *title,
                    const struct history *history);

/* Draws all pictures of the history of the run in request->folder into the folder request->pictures: crack, energy,
 * sif, path and load_displacement, for load steps also r_curve (names in output/pictures.h). title: heading of each
 * picture. Returns FAILED if history.csv cannot be read or gnuplot fails. */
status history_curves_draw(const struct plot_request *request, const char *title);

/* Draws velocity, stress and damage over the position along a one-dimensional bar to the picture file `picture`, one
 * curve for each of the output frames frame[frame_count] of a run (states at one time or load step). title: heading of
 * the picture; projection: options of the picture, of which only one is used: whether the frames belong to load steps
 * (static equilibria) or to times. Returns FAILED if gnuplot fails. */
status bar_profiles_draw(struct output_picture picture, const char *title, const struct projection *projection,
                         const struct output_frame *frame, int frame_count);

/* Draws the field projection->field over the position along a one-dimensional bar to the picture file `picture`, one
 * curve for each of the output frames frame[frame_count] of a run (states at one time or load step). title: heading of
 * the picture; projection: options of the picture, of which the field is used, and whether the frames belong to load
 * steps (static equilibria) or to times; value_of_frame[k][i]: value of the field at particle i of frame k. Returns
 * FAILED if gnuplot fails. */
status field_profiles_draw(struct output_picture picture, const char *title, const struct projection *projection,
                           float *const *value_of_frame, const struct output_frame *frame, int frame_count);

/* Finds an EXACT probe, which compares a bar with a closed-form solution, by its profiles in the folder of a run.
 * Stores the name of the probe in `probe_name`. Returns false if there is none. */
bool run_find_exact_solution_probe(const char *folder, char probe_name[NAME_MAX_LENGTH]);

/* Draws stress, strain, velocity and, if there is any, damage along the bar of the EXACT probe called `probe_name`,
 * with the closed-form solution, to the picture file `picture`. title: heading of the picture;
 * shown_frame[frame_count]: output frames of the run in `folder` that are drawn. Returns FAILED if a profile cannot be
 * read or gnuplot fails. */
status bar_profiles_draw_with_exact_solution(struct output_picture picture, const char *title, const char *folder,
                                             const char *probe_name, const struct listed_frame *shown_frame,
                                             int frame_count);

#endif
