/* Draws the pictures of a study: scalar results against each varied key, and against two keys as maps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "plot/plot.h"
#include "scene/words.h"
#include "study/convergence.h"
#include "study_picture.h"

/* LINES_MOST: largest number of lines of a panel. COLOUR_GAP: gap between a map and its colour bar [pixel]. */
enum { LINES_MOST = CURVE_COLOURS, COLOUR_GAP = 8 };

/* Ratio of the smallest to the largest value below which a colour bar of positive values begins at 0 [1]. */
static const double ZERO_NEAR = 0.25;

/* ---- text around the panels -------------------------------------------------------------------------------------- */

/* Writes to gnuplot's stream `to` the command for a label `text` at x, y [pixel] from the lower left corner of the
 * picture p. how: further options of the label, such as its alignment. */
static void screen_label(FILE *to, const struct study_picture *p, const char *text, double x, double y, const char *how)
{
    fputs("set label ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " at screen %.5f,%.5f %s textcolor rgb '#333333'\n", x / p->width, y / p->height, how);
}

/* Sends the labels of the values of a varied key (a key of the input file that a study varies) to gnuplot's stream
 * `to` as tics (labelled marks) of an axis, at the positions 0, 1, 2 and so on. If there are many values, some labels
 * are omitted. axis: "x" or "y"; rotated: true for slanted labels. */
static void send_tics(FILE *to, const char *axis, const struct varied_key *key, bool rotated)
{
    const int each = (key->values + STUDY_TICS_MOST - 1) / STUDY_TICS_MOST;
    fprintf(to, "set %stics %s (", axis, rotated ? "rotate by 40 right" : "norotate");
    for (int v = 0; v < key->values; v += each) {
        char text[LABEL_ROOM];
        varied_key_compose_label_of_value(text, key, v);
        if (v > 0) putc(',', to);
        gnuplot_write_quoted_string(to, text);
        fprintf(to, " %d", v);
    }
    fputs(")\n", to);
}

/* ---- panels -------------------------------------------------------------------------------------------------------
 */

/* Starts gnuplot in *g for the picture p, in the file `name` of the folder `pictures` of the study, and writes the
 * notes of p below its panels. Returns REFUSED or FAILED, with a message, if the folder or gnuplot cannot be used. */
static status picture_open(struct gnuplot *g, const struct study_picture *p, const char *name)
{
    const struct path folder = path_join(p->study->folder, "pictures");
    TRY(folder_create_with_parents(folder.text));
    TRY(gnuplot_open(g, path_join(folder.text, name).text, picture_size_get_process_wide().format, p->width,
                     p->height));
    fputs("set multiplot\nset autoscale fix\n"
          "set offsets graph 0.04, graph 0.04, graph 0.08, graph 0.08\n",
          g->to);
    for (int k = 0; k < p->notes; k++)
        screen_label(g->to, p, p->note[k], study_picture_character_width_in_pixels(), (p->notes - k - 0.4) * STUDY_ROW,
                     "left");
    return OK;
}

/* Sends margins, title and axis labels of panel number `panel` (from 0) to gnuplot's stream `to`. up: label of the
 * vertical axis of a map, which also gets a colour bar; NULL if the vertical axis shows the values of a scalar result.
 * p: the picture. */
static void panel_begin(FILE *to, const struct study_picture *p, int panel, const char *up)
{
    const int column = panel % p->columns, row = panel / p->columns;
    const int x = column * (p->left + p->wide + p->right) + p->left;
    const int y = p->height - row * (STUDY_TITLE + p->high + p->below) - STUDY_TITLE;
    const char *figure = p->table->figure[p->figure[panel]];
    const struct unit unit = p->unit_of_figure[panel];
    char text[512];
    fprintf(to, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", (double)x / p->width,
            (double)(x + p->wide) / p->width);
    fprintf(to, "set tmargin at screen %.5f\nset bmargin at screen %.5f\n", (double)y / p->height,
            (double)(y - p->high) / p->height);
    study_panel_compose_title(text, sizeof text, figure, unit.name);
    const double room = p->left + p->wide + p->right - study_picture_character_width_in_pixels(),
                 wide = 0.95 * study_picture_character_width_in_pixels() * (double)strlen(text);
    fputs("set title ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " font ',%.3g'\n", fmax(13 * fmin(1, room / wide), 7));
    plotted_key_compose_label_with_unit(text, sizeof text, &p->key[p->across]);
    screen_label(to, p, text, x + 0.5 * p->wide, y - p->high - p->below + 0.9 * STUDY_ROW, "center");
    if (!up) return;
    screen_label(to, p, up, x - p->left + 0.8 * STUDY_ROW, y - 0.5 * p->high, "center rotate by 90");
    fprintf(to, "set colorbox user origin screen %.5f,%.5f size screen %.5f,%.5f\n",
            (double)(x + p->wide + COLOUR_GAP) / p->width, (double)(y - p->high) / p->height,
            (double)STUDY_COLOUR_BAR / p->width, (double)p->high / p->height);
}

/* ---- lines with bars --------------------------------------------------------------------------------------------- */

/* Sends the points of each line of panel number `panel` of the picture p to gnuplot's stream `to` as a data block:
 * position along the axis, mean and scatter. A point without a value is NaN, which leaves a gap in the line. */
static void send_points(FILE *to, const struct study_picture *p, int panel)
{
    const struct varied_key *across = &p->key[p->across].shown;
    const struct figure_statistics *point = p->point[panel];
    for (int l = 0; l < p->lines; l++) {
        fprintf(to, "$p%d_%d << EOD\n", panel, l);
        for (int v = 0; v < across->values; v++) {
            const struct figure_statistics *at = &point[l * across->values + v];
            fprintf(to, at->runs > 0 ? "%.15g %.15g %.10g\n" : "%.15g NaN NaN\n",
                    study_picture_horizontal_position_of_value(p, v), at->mean, at->scatter);
        }
        fputs("NaN NaN NaN\nEOD\n", to); /* gnuplot refuses a block without points */
    }
}

/* Appends the mean over all runs, and the mean plus and minus the standard deviation, to the plot command of panel
 * number `panel` of the picture p, as horizontal lines. to: gnuplot's stream. Appends nothing if fewer than two runs
 * have a value. */
static void plot_mean_of_seeds(FILE *to, const struct study_picture *p, int panel)
{
    const double factor = p->unit_of_figure[panel].factor;
    struct spacing_level_statistics all;
    convergence_compute_mean_and_deviation_over_runs(&all, p->table->value[p->figure[panel]], p->table->cases);
    for (int k = -1; k <= 1 && all.runs > 1; k++)
        fprintf(to, ", %.10g with lines lw 1.2 dt %d lc rgb '#333333' notitle", (all.mean + k * all.deviation) / factor,
                k == 0 ? 1 : 2);
}

/* Returns true if line number `line` of panel number `panel` of the picture p coincides with one drawn before: at every
 * value that both have, their means differ by less than the width of a line. */
static bool line_hides_another(const struct study_picture *p, int panel, int line)
{
    static const double LINE_WIDE = 0.004; /* divided by the length of the axis [1] */
    const int values = p->key[p->across].shown.values;
    const struct figure_statistics *point = p->point[panel], *own = point + line * values;
    double low, high;
    study_panel_find_range_of_plotted_values(p, panel, &low, &high);
    for (int l = 0; l < line; l++) {
        int common = 0;
        bool apart = false;
        for (int v = 0; v < values; v++) {
            if (own[v].runs == 0 || point[l * values + v].runs == 0) continue;
            common++;
            apart |= fabs(own[v].mean - point[l * values + v].mean) > LINE_WIDE * (high - low);
        }
        if (common > 0 && !apart) return true;
    }
    return false;
}

/* Sends the gnuplot command that plots the points of panel number `panel` of the picture p to the stream `to`. The
 * points are joined by lines if the values along the horizontal axis are numbers. A line that coincides with one drawn
 * before is dashed, and its points are rings. */
static void plot_panel(FILE *to, const struct study_picture *p, int panel)
{
    fputs("plot ", to);
    for (int l = 0; l < p->lines; l++) {
        const bool over = line_hides_another(p, panel, l);
        const char *ring = over ? "pt 6 ps 1.6" : p->chance ? "pt 7 ps 0.7" : "pt 7 ps 0.9";
        if (l > 0) fputs(", ", to);
        if (p->numbers && !p->seeds)
            fprintf(to, "$p%d_%d using 1:2 smooth unique with lines lw 1.6%s lc rgb '%s' notitle, ", panel, l,
                    over ? " dt (7,7)" : "", curve_colour[l]);
        fprintf(to, "$p%d_%d using %s %s lw 1.4 lc rgb '%s' notitle", panel, l,
                p->chance ? "1:2:3 with yerrorbars" : "1:2 with points", ring, curve_colour[l]);
    }
    if (p->seeds) plot_mean_of_seeds(to, p, panel);
    putc('\n', to);
}

/* Draws the legend of the lines with its heading, the names of the varied keys (keys of the input file that a study
 * varies) that distinguish lines, through gnuplot's stream `to`: on the right of the panels or, in a narrow picture,
 * below them. The legend is drawn as a panel of its own, as large as the picture, because gnuplot makes no legend
 * wider than its panel. p: the picture. */
static void draw_key(FILE *to, const struct study_picture *p)
{
    char text[256];
    const bool below = p->strip > 0;
    const int x = below ? study_picture_character_width_in_pixels()
                        : p->width - p->legend + study_picture_character_width_in_pixels();
    const int y = below ? p->notes * STUDY_ROW + p->strip : p->height - STUDY_TITLE + STUDY_ROW;
    study_picture_compose_list_of_keys_with_role(text, sizeof text, p, ROLE_LINES, false);
    fputs("unset border\nunset tics\nunset title\nunset grid\nunset logscale\nset offsets\nset lmargin at screen 0\n"
          "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n",
          to);
    screen_label(to, p, text, x, y - 0.5 * STUDY_ROW, "left");
    fprintf(to, "set key at screen %.5f,%.5f left top horizontal maxcols %d maxrows %d\nplot [0:1] [0:1] ",
            (double)x / p->width, (double)(y - STUDY_ROW) / p->height, p->key_columns,
            (p->lines + p->key_columns - 1) / p->key_columns);
    for (int l = 0; l < p->lines; l++) {
        study_picture_compose_legend_text_of_line(text, sizeof text, p, l);
        fprintf(to, "%sNaN with %s pt 7 ps 0.9 lc rgb '%s' title ", l ? ", " : "",
                p->numbers ? "linespoints lw 1.6" : "points", curve_colour[l]);
        gnuplot_write_quoted_string(to, text);
    }
    putc('\n', to);
}

/* Sends range and tics of the axis for the scalar result of panel number `panel` of the picture p to gnuplot's stream
 * `to`. name: `y`, or `cb` for the colour bar of a map. */
static void send_figure_axis(FILE *to, const struct study_picture *p, int panel, const char *name)
{
    struct study_axis axis = study_panel_get_vertical_axis(p, panel);
    int most = study_panel_max_vertical_axis_intervals(p);
    if (*name == 'c') {
        if (axis.low > 0 && axis.low < ZERO_NEAR * axis.high && !axis.logarithmic) axis.low = 0;
        most = most < STUDY_COLOUR_STEPS ? most : STUDY_COLOUR_STEPS;
    }
    study_axis_write_to_gnuplot(to, name, &axis, most);
}

static status draw_lines(struct study_picture *p)
{
    char name[PICTURE_NAME_ROOM];
    struct gnuplot g;
    study_picture_assign_roles_to_varied_keys(p, LINES_MOST);
    study_picture_compute_plotted_points(p);
    study_picture_compute_layout(p, NULL);
    study_picture_compose_file_name(name, p->key[p->across].given.key);
    TRY(picture_open(&g, p, name));
    for (int panel = 0; panel < p->panels; panel++) send_points(g.to, p, panel);
    if (!p->numbers) send_tics(g.to, "x", &p->key[p->across].shown, p->slanted);
    for (int panel = 0; panel < p->panels; panel++) {
        const struct study_axis across = study_panel_get_horizontal_axis(p, panel);
        panel_begin(g.to, p, panel, NULL);
        if (p->numbers)
            study_axis_write_to_gnuplot(g.to, "x", &across, study_panel_max_horizontal_axis_intervals(p, &across));
        send_figure_axis(g.to, p, panel, "y");
        plot_panel(g.to, p, panel);
        fputs("unset label\n", g.to);
    }
    if (p->lines > 1) draw_key(g.to, p);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* Draws each chosen scalar result of a study as a map over two varied keys (keys of the input file that a study
 * varies). The key with the index p->across is along the horizontal axis, the key with the index `up` along the
 * vertical axis. Returns FAILED, with a message, if gnuplot fails. */
static status draw_study_map(struct study_picture *p, int up)
{
    const struct varied_key *across = &p->key[p->across].shown, *key_up = &p->key[up].shown;
    struct gnuplot g;
    char name[NOTE_ROOM];
    plotted_key_compose_label_with_unit(name, sizeof name, &p->key[up]);
    study_picture_assign_roles_to_varied_keys(p, across->values * key_up->values);
    if (p->role[up] == ROLE_CHANCE) p->role[up] = ROLE_LINES, p->lines = key_up->values, p->chance = false;
    study_picture_compute_plotted_points(p);
    study_picture_compute_layout(p, key_up);
    char picture[PICTURE_NAME_ROOM];
    study_picture_compose_file_name(picture, "map");
    TRY(picture_open(&g, p, picture));
    send_tics(g.to, "x", across, p->slanted);
    send_tics(g.to, "y", key_up, false);
    fputs("unset grid\nset palette defined (0 '#fff7bc', 0.5 '#41b6c4', 1 '#081d58')\nset offsets\n", g.to);
    fprintf(g.to, "set xrange [-0.5:%g]\nset yrange [-0.5:%g]\n", across->values - 0.5, key_up->values - 0.5);
    for (int panel = 0; panel < p->panels; panel++) {
        fprintf(g.to, "$m%d << EOD\n", panel);
        for (int l = 0; l < key_up->values; l++)
            for (int v = 0; v < across->values; v++)
                fprintf(g.to, "%d %d %.10g\n", v, l, p->point[panel][l * across->values + v].mean);
        fputs("EOD\n", g.to);
        panel_begin(g.to, p, panel, name);
        send_figure_axis(g.to, p, panel, "cb");
        fprintf(g.to, "plot $m%d using 1:2:3 with image notitle\nunset label\n", panel);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Finds the two varied keys (keys of the input file that a study varies) along the axes of a map in the picture p:
 * those with a physical meaning if there are two, else all varied keys. Stores the index of the key along the vertical
 * axis in *up, and of that along the horizontal axis in *across. Returns false if there are not exactly two, so that
 * no map is drawn. */
static bool map_keys(const struct study_picture *p, int *up, int *across)
{
    for (int all = 0; all < 2; all++) {
        int n = 0, last[2] = {0};
        for (int k = 0; k < p->keys; k++)
            if (p->key[k].shown.values > 1 && (all || !key_is_random_seed_or_time_step(p->key[k].given.key))) {
                if (n < 2) last[n] = k;
                n++;
            }
        *up = last[0], *across = last[1];
        if (n == 2) return true;
    }
    return false;
}

static status draw_all(struct study_picture *p)
{
    int up;
    for (int k = 0; k < p->keys; k++) {
        if (p->key[k].shown.values < 2) continue;
        p->across = k;
        p->numbers = p->key[k].numbers;
        TRY(draw_lines(p));
    }
    return map_keys(p, &up, &p->across) ? draw_study_map(p, up) : OK;
}

status study_draw_results_over_keys(const struct study_table *t, const struct study *s, const struct varied_key *key,
                                    int keys, const char *const *result, int results)
{
    char header[HEADER_ROOM];
    struct study_picture p = {.table = t, .study = s, .keys = keys, .header = header};
    p.seeds = study_varies_only_random_seed(key, keys);
    TRY(study_picture_set_results_of_panels_by_name(&p, result, results));
    if (results == 0) study_picture_choose_results_of_panels(&p);
    if (p.panels == 0) return OK;
    study_read_history_header(header, sizeof header, s);
    p.key = plotted_keys_create_from_varied_keys(s, key, keys);
    p.value_at = NEW("study.value_at", keys, int *);
    p.role = NEW("study.roles", keys, enum key_role);
    study_find_value_index_of_each_key_in_each_run(p.value_at, s, p.key, keys);
    const status drawn = draw_all(&p);
    for (int k = 0; k < keys; k++) memory_free(p.value_at[k]);
    study_picture_free_plotted_points(&p);
    plotted_keys_free(p.key, keys);
    memory_free(p.value_at);
    memory_free(p.role);
    return drawn;
}
