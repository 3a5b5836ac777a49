/* Declares one picture of a study: its scalar results, varied keys, points and layout. */
#ifndef CLEAVE_STUDY_PICTURE
#define CLEAVE_STUDY_PICTURE

#include "plot/plot.h"
#include "study_axis.h"
#include "study_internal.h"

/* PANELS_MOST: largest number of panels of a picture. NOTE_ROOM: capacity of a line of text below the panels [byte]. */
enum { PANELS_MOST = 6, NOTE_ROOM = 200 };

/* Sizes in the pictures of a study. STUDY_ROW: height of a line of text; STUDY_TITLE: height of the title of a panel;
 * STUDY_COLOUR_BAR: width of a colour bar [pixel]. STUDY_TICS_MOST: largest number of labels along an axis;
 * STUDY_COLOUR_STEPS: largest number of intervals of a colour bar. */
enum { STUDY_ROW = 24, STUDY_TITLE = 45, STUDY_COLOUR_BAR = 14, STUDY_TICS_MOST = 12, STUDY_COLOUR_STEPS = 5 };

/* Role of a varied key in a picture. NONE: it has a single value. ACROSS: its values are along the horizontal axis.
 * LINES: each of its values has a line. HELD: the picture shows only the runs with its first value. CHANCE: it has no
 * physical meaning, such as a random seed, and runs that differ in it alone are combined to one point with a bar. */
enum key_role { ROLE_NONE, ROLE_ACROSS, ROLE_LINES, ROLE_HELD, ROLE_CHANCE };

/* A key that a study varies, as one picture shows it. given: key and values in the form of the option -s, in the order
 * of the picture; shown: the key in words, and the values without the parts that all of them have in common. If all
 * values are numbers with one unit, they are in ascending order and without the unit. */
struct plotted_key {
    struct varied_key given, shown;
    char unit[UNIT_ROOM]; /* of the shown values; "": none, or each value has its own */
    bool numbers;         /* the shown values are numbers with one unit or without unit */
};

/* Returns an allocated array [key_count] with label, unit and values by which pictures show the keys key[key_count]
 * that a study varies. The label of a key names the material, load or body of the input file to which the key belongs,
 * as in `traction on y+`. If the values are vectors that differ in a single component, this component is shown. Release
 * the array with plotted_keys_free. */
struct plotted_key *plotted_keys_create_from_varied_keys(const struct study *study, const struct varied_key *key,
                                                         int key_count);

/* Frees the array shown[key_count], which plotted_keys_create_from_varied_keys has allocated, and its texts; `shown`
 * may be NULL. */
void plotted_keys_free(struct plotted_key *shown, int key_count);

/* Mean and standard deviation (`scatter`) of one result, in the unit of its panel, over the `runs` runs that are
 * combined to one point of a line. The mean of a point without runs is NAN. */
struct figure_statistics {
    double mean, scatter;
    int runs;
};

/* One picture of a study: scalar results (one per panel), roles of the varied keys, points and layout. It exists while
 * the picture is drawn; the study and its table are borrowed. */
struct study_picture {
    const struct study_table *table;
    const struct study *study;
    struct plotted_key *key; /* [keys] varied keys, owned */
    int keys;
    int **value_at;      /* [keys][runs] index of the value of a key in a run; -1: a value that is not shown */
    enum key_role *role; /* [keys] */
    int across, lines;   /* index of the key along the horizontal axis; number of lines, at least 1 */
    int figure[PANELS_MOST], panels;         /* [panels] index of the result of each panel in `table`; their number */
    struct unit unit_of_figure[PANELS_MOST]; /* [panels] unit in which the result is drawn */
    /* [panels][lines][values of the key along the horizontal axis], set by study_picture_compute_plotted_points, owned
     */
    struct figure_statistics *point[PANELS_MOST];
    bool numbers, chance; /* positions along the axis are the values, else 0, 1, 2 ...; a key of ROLE_CHANCE varies */
    bool seeds;           /* a random seed is the only varied key */
    const char *header;   /* first line of history.csv, which has the units of results; borrowed */
    int columns, wide, high;        /* number of columns of panels; width and height of a panel [pixel] */
    int left, right, below, height; /* margins of a panel; height of the picture [pixel] */
    int legend, strip, key_columns; /* width of the key right of all panels, or its height below them [pixel]; number of
                                     * its columns */
    bool slanted;                   /* the labels of values at the horizontal axis are slanted */
    int width, notes;               /* width of the picture [pixel]; number of notes */
    char note[4][NOTE_ROOM];        /* [notes] lines of text below the panels */
};

/* Chooses the results (numbers in summary.json) that the panels of the picture show: results of cracks first, then of
 * probes, energies, and the duration. Results that are equal in all runs are left out. Stores them in picture->figure
 * and their number in picture->panels. */
void study_picture_choose_results_of_panels(struct study_picture *picture);

/* Chooses the results (numbers in summary.json) with the names figure_name[figure_count] for the panels of the picture.
 * Returns REFUSED, with a message, if a name is not in picture->table. */
status study_picture_set_results_of_panels_by_name(struct study_picture *picture, const char *const *figure_name,
                                                   int figure_count);

/* Returns true if `key`, the path of a key of the input file, is the seed of random numbers, such as
 * material.scatter.seed. */
bool key_is_random_seed(const char *key);

/* Returns true if a seed is the only one of the keys key[key_count] with several values. */
bool study_varies_only_random_seed(const struct varied_key *key, int key_count);

/* Returns true for a key without physical meaning, such as a random seed. Runs that differ only in such keys are
 * combined to one point with a bar. */
bool key_is_random_seed_or_time_step(const char *key);

/* Fills value_at[key_count][study->n] with the index of the value that each of the keys key[key_count] has in each run
 * of `study`; -1 if the run has none of the values of the key. The caller frees each value_at[k]. */
void study_find_value_index_of_each_key_in_each_run(int **value_at, const struct study *study,
                                                    const struct plotted_key *key, int key_count);

/* Assigns a role (enum key_role) to each key of the picture and sets the number of lines per panel. Keys with several
 * values, in their order, distinguish lines as long as there are at most max_lines lines. Of further keys only the runs
 * with the first value are shown. */
void study_picture_assign_roles_to_varied_keys(struct study_picture *picture, int max_lines);

/* Computes the unit of the result of each panel and the points of its lines, p->unit_of_figure and p->point, from the
 * roles of the keys (along the axis, as lines, held at one value). Replaces points computed before. Release them with
 * study_picture_free_plotted_points. */
void study_picture_compute_plotted_points(struct study_picture *p);

/* Frees the points p->point that study_picture_compute_plotted_points has allocated. */
void study_picture_free_plotted_points(struct study_picture *p);

/* Finds the smallest and the largest value of the points of panel number `panel` of the picture p, error bars included,
 * in the unit of the panel, and stores them in *low and *high; INFINITY and -INFINITY if there are no points. */
void study_panel_find_range_of_plotted_values(const struct study_picture *p, int panel, double *low, double *high);

/* Returns the horizontal axis of panel number `panel` for the key along it (p->across). Its kind follows from all
 * values of the key; it is not logarithmic if they are evenly spaced. A logarithmic axis has the range of all values, a
 * linear one of those that have points in the panel. */
struct study_axis study_panel_get_horizontal_axis(const struct study_picture *p, int panel);

/* Returns the vertical axis of panel number `panel` of the picture p: range and kind for the values of the result that
 * the panel shows, in the unit of the panel. */
struct study_axis study_panel_get_vertical_axis(const struct study_picture *p, int panel);

/* Returns the position on the horizontal axis of the picture p of value number `value_index` of the key along this
 * axis: the value, or value_index if the values are no numbers. */
double study_picture_horizontal_position_of_value(const struct study_picture *p, int value_index);

/* Returns the largest number of intervals between tics of the vertical axis at which the numbers do not touch, in
 * panels of the present size of the picture p. */
int study_panel_max_vertical_axis_intervals(const struct study_picture *p);

/* Returns the largest number of intervals between tics of the horizontal axis `axis` at which the numbers do not touch,
 * in panels of the present size of the picture p. */
int study_panel_max_horizontal_axis_intervals(const struct study_picture *p, const struct study_axis *axis);

/* Returns true if every point of every panel of the picture p has a value, i.e. if at least one of the runs combined to
 * the point has the result that the panel shows. */
bool study_picture_every_point_has_value(const struct study_picture *p);

/* Writes the title of line number `line` of the picture p to text[capacity], such as `60, 1`: the values of those keys
 * that distinguish lines. */
void study_picture_compose_legend_text_of_line(char *text, size_t capacity, const struct study_picture *p, int line);

/* Writes the words of the varied key `key` and the unit of its values to text[capacity], as `traction on y+ [MPa]`. */
void plotted_key_compose_label_with_unit(char *text, size_t capacity, const struct plotted_key *key);

/* Writes the words of the varied keys that have the role `role` in the picture p (on the axis, as lines, held at one
 * value, or averaged over) to text[capacity], separated by commas: `Young's modulus of glass [GPa], spacing of
 * particles [mm]`. with_value: true to add the first value of each key. */
void study_picture_compose_list_of_keys_with_role(char *text, size_t capacity, const struct study_picture *p,
                                                  enum key_role role, bool with_value);

/* Composes the notes below the panels of p, and computes columns, sizes and margins of the panels, the space of the key
 * (legend) and the size of the picture from the lengths of the texts. If the user has chosen the size of the picture,
 * the number of columns is the one that makes the panels largest. The points of p must have been computed
 * (study_picture_compute_plotted_points). vertical_key: varied key along the vertical axis of a map; NULL for a picture
 * with lines. */
void study_picture_compute_layout(struct study_picture *p, const struct varied_key *vertical_key);

#endif
