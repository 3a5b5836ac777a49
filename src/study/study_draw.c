/* Pictures of a study: figures over each varied key, and over two keys as maps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "plot/plot.h"
#include "scene/words.h"
#include "study_picture.h"

enum { LINES_MOST = CURVE_COLOURS, COLUMNS_MOST = 3, TICS_MOST = 12, STEPS_MOST = 4 };

/* Sizes in the pictures of a study [pixel]: usual and least width and height of a panel; height of a line of text;
 * width of the numbers at an axis; height of a title; height of tics and label below the axis; width of a colour bar.
 */
enum { WIDE = 320, HIGH = 220, LEAST = 60, ROW = 24, NUMBERS = 115, TITLE = 45, BELOW = 70, COLOURS = 150 };
enum {
    COLOURS_NARROW = 88,
    SAMPLE = 50,
    TICS_UP = 26
}; /* of an entry of the key without its text; least distance of
    * tics of a vertical axis */

/* Returns the width of a character in the pictures of a study [pixel]. */
static int character(void) { return picture_is_too_narrow_for_key() ? 8 : 10; }

/* ---- text around the panels -------------------------------------------------------------------------------------- */

/* Writes the title of line number `line`, its values of the keys that distinguish lines, as `60GPa, 1mm`. */
static void line_title(char *text, size_t capacity, const struct study_picture *p, int line)
{
    size_t used = 0;
    int rest = p->lines;
    *text = '\0';
    for (int k = 0; k < p->keys; k++) {
        char value[LABEL_ROOM];
        if (p->role[k] != ROLE_LINES) continue;
        rest /= p->key[k].values;
        study_value_label(value, &p->key[k], line / rest % p->key[k].values);
        if (used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, "%s%s", used > 0 ? ", " : "", value);
    }
}

/* Returns the SI unit that numbers without a unit have as values of the key. Returns "" if the values of the key have
 * units or are no numbers. */
static const char *unit_unsaid(const struct varied_key *key)
{
    const char *unit = "";
    return varied_key_values_are_numbers(key, &unit) && !*unit ? scene_key_unit(key->key) : "";
}

/* Writes the name of a key to text[capacity], with the unit of its values if they have none themselves. */
static void key_text(char *text, size_t capacity, const struct varied_key *key)
{
    const char *unit = unit_unsaid(key);
    snprintf(text, capacity, *unit ? "%s [%s]" : "%s%s", key->key, unit);
}

/* Writes the names of the varied keys that have the role `role` in the picture (on the axis, as lines, held at one
 * value, or averaged over) to text[capacity], separated by commas: `material.young, load`. with_value: true to add the
 * first value of each key. */
static void keys_text(char *text, size_t capacity, const struct study_picture *p, enum key_role role, bool with_value)
{
    size_t used = 0;
    *text = '\0';
    for (int k = 0; k < p->keys; k++) {
        char value[LABEL_ROOM], name[NOTE_ROOM];
        if (p->role[k] != role) continue;
        study_value_label(value, &p->key[k], 0);
        key_text(name, sizeof name, &p->key[k]);
        if (used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, "%s%s%s%s", used > 0 ? ", " : "", name,
                                     with_value ? " = " : "", with_value ? value : "");
    }
}

static void screen_label(FILE *to, const struct study_picture *p, const char *text, double x, double y, const char *how)
{
    fputs("set label ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " at screen %.5f,%.5f %s textcolor rgb '#333333'\n", x / p->width, y / p->height, how);
}

/* Composes the notes below the panels. The first lists the keys for which the picture shows only the first value, the
 * second those over which it shows means, such as random seeds. map: true for maps, false for lines with error bars. */
static void notes_find(struct study_picture *p, bool map)
{
    char keys[NOTE_ROOM - 64];
    p->notes = 0;
    keys_text(keys, sizeof keys, p, ROLE_HELD, true);
    if (*keys) snprintf(p->note[p->notes++], NOTE_ROOM, "at %s alone", keys);
    keys_text(keys, sizeof keys, p, ROLE_CHANCE, false);
    if (*keys)
        snprintf(p->note[p->notes++], NOTE_ROOM,
                 map ? "means over %s" : "points and bars: mean and standard deviation over %s", keys);
}

/* Sends the labels of a key's values as tics of an axis, at the positions 0, 1, 2 and so on. If there are many values,
 * some labels are omitted. axis: "x" or "y"; rotated: labels are slanted. */
static void send_tics(FILE *to, const char *axis, const struct varied_key *key, bool rotated)
{
    const int each = (key->values + TICS_MOST - 1) / TICS_MOST;
    fprintf(to, "set %stics %s (", axis, rotated ? "rotate by 40 right" : "norotate");
    for (int v = 0; v < key->values; v += each) {
        char text[LABEL_ROOM];
        study_value_label(text, key, v);
        if (v > 0) putc(',', to);
        gnuplot_write_quoted_string(to, text);
        fprintf(to, " %d", v);
    }
    fputs(")\n", to);
}

static int tics_shown(const struct varied_key *key) { return key->values < TICS_MOST ? key->values : TICS_MOST; }

/* Returns true if the labels of a key's values, written along the horizontal axis of a panel, would overlap. */
static bool words_touch(const struct study_picture *p, const struct varied_key *key)
{
    return tics_shown(key) * (study_longest_label_length(key) + 2) * character() > p->wide;
}

/* ---- layout ------------------------------------------------------------------------------------------------------ */

static int panel_rows(const struct study_picture *p) { return (p->panels + p->columns - 1) / p->columns; }

/* Sets the columns of panels, and the size of a panel before its margins are known. */
static void panels_arrange(struct study_picture *p)
{
    const struct picture_size given = picture_size_get();
    const int most = picture_is_too_narrow_for_key() ? 1 + (p->panels > 2) : COLUMNS_MOST;
    p->columns = p->panels < most ? p->panels : most;
    p->wide = WIDE, p->high = HIGH;
    if (given.width) p->wide = given.width / p->columns - NUMBERS;
}

/* Computes the size of the picture from the size of a panel, its margins and the notes. If the user has chosen the size
 * of the picture, computes the size of a panel from it instead. */
static void size_settle(struct study_picture *p)
{
    const struct picture_size given = picture_size_get();
    const int around = TITLE + p->below, rows = panel_rows(p);
    const int under = p->notes * ROW + p->strip;
    p->width = p->columns * (p->left + p->wide + p->right) + p->legend;
    if (given.width) {
        p->width = given.width;
        p->wide = (int)fmax((given.width - p->legend) / p->columns - p->left - p->right, LEAST);
        p->high = (int)fmax(given.height ? (given.height - under) / rows - around : 0.7 * p->wide, LEAST);
    }
    p->height = given.height ? given.height : rows * (around + p->high) + under;
    for (int k = 0; k < p->notes && !given.width; k++) {
        const int wide = ((int)strlen(p->note[k]) + 2) * character();
        p->width = wide > p->width ? wide : p->width;
    }
}

/* Sets the margins of the panels for the texts at their axes. up: key along the vertical axis of a map; NULL for a
 * picture with lines. */
static void margins_find(struct study_picture *p, const struct varied_key *up)
{
    const double slope = 0.64, run = 0.77; /* sine and cosine of 40 degrees */
    const bool narrow = picture_is_too_narrow_for_key();
    const int along = study_longest_label_length(&p->key[p->across]) * character();
    p->left = up       ? (study_longest_label_length(up) + (narrow ? 6 : 7)) * character()
              : narrow ? 8 * character()
                       : NUMBERS;
    p->right = up           ? (narrow ? COLOURS_NARROW : COLOURS)
               : p->numbers ? 3 * character()
               : p->slanted ? 2 * character()
                            : 2 * character() + along / 2;
    p->below = BELOW + (p->slanted ? (int)(slope * along) - ROW / 2 : 0);
    if (p->slanted && p->left < (int)(run * along)) p->left = (int)(run * along);
}

/* Computes the space of the key of the lines: its width beside the panels, or in a narrow picture its columns and its
 * height below them. */
static void key_space_find(struct study_picture *p)
{
    char text[256];
    keys_text(text, sizeof text, p, ROLE_LINES, false);
    int longest = 0;
    const int title = (int)strlen(text);
    for (int l = 0; l < p->lines; l++) {
        line_title(text, sizeof text, p, l);
        longest = (int)strlen(text) > longest ? (int)strlen(text) : longest;
    }
    if (picture_is_too_narrow_for_key()) {
        const int columns = (picture_size_get().width - 2 * character()) / (SAMPLE + longest * character());
        p->key_columns = columns < 1 ? 1 : columns < p->lines ? columns : p->lines;
        p->strip = (1 + (p->lines + p->key_columns - 1) / p->key_columns) * ROW;
    } else {
        p->key_columns = 1;
        p->legend = ((longest + 5 > title ? longest + 5 : title) + 2) * character();
    }
}

/* Computes the margins of the panels, the space of the key and the size of the picture from the lengths of their texts.
 * up: key along the vertical axis of a map; NULL for a picture with lines. */
static void room_find(struct study_picture *p, const struct varied_key *up)
{
    p->legend = p->strip = 0;
    p->slanted = false;
    panels_arrange(p);
    if (!up && p->lines > 1) key_space_find(p);
    notes_find(p, up != NULL);
    margins_find(p, up);
    size_settle(p);
    if (p->numbers && !up) return;
    p->slanted = words_touch(p, &p->key[p->across]);
    margins_find(p, up);
    size_settle(p);
}

static status picture_open(struct gnuplot *g, const struct study_picture *p, const char *name)
{
    const struct path folder = path_join(p->study->folder, "pictures");
    TRY(folder_make(folder.text));
    TRY(gnuplot_open(g, path_join(folder.text, name).text, picture_size_get().format, p->width, p->height));
    fputs("set multiplot\nset format y '%.4g'\nset format x '%.4g'\nset format cb '%.4g'\nset autoscale fix\n"
          "set offsets graph 0.04, graph 0.04, graph 0.08, graph 0.08\n",
          g->to);
    for (int k = 0; k < p->notes; k++)
        screen_label(g->to, p, p->note[k], character(), (p->notes - k - 0.4) * ROW, "left");
    return OK;
}

/* Sends margins, title and axis labels of panel number `panel` to gnuplot. up: label of the vertical axis; NULL if this
 * axis shows the values of the figure. */
static void panel_begin(FILE *to, const struct study_picture *p, int panel, const char *up)
{
    const int column = panel % p->columns, row = panel / p->columns;
    const int x = column * (p->left + p->wide + p->right) + p->left;
    const int y = p->height - row * (TITLE + p->high + p->below) - TITLE;
    const char *figure = p->table->figure[p->figure[panel]];
    const struct unit unit = p->unit_of_figure[panel];
    char text[512];
    fprintf(to, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", (double)x / p->width,
            (double)(x + p->wide) / p->width);
    fprintf(to, "set tmargin at screen %.5f\nset bmargin at screen %.5f\n", (double)y / p->height,
            (double)(y - p->high) / p->height);
    snprintf(text, sizeof text, *unit.name ? "%s [%s]" : "%s%s", figure, unit.name);
    const double room = p->left + p->wide + p->right - character(), wide = 0.95 * character() * (double)strlen(text);
    fputs("set title ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " font ',%.3g'\n", fmax(13 * fmin(1, room / wide), 7));
    if (*p->unit)
        snprintf(text, sizeof text, "%s [%s]", p->key[p->across].key, p->unit);
    else
        key_text(text, sizeof text, &p->key[p->across]);
    screen_label(to, p, text, x + 0.5 * p->wide, y - p->high - p->below + 0.9 * ROW, "center");
    if (up) screen_label(to, p, up, x - p->left + 0.8 * ROW, y - 0.5 * p->high, "center rotate by 90");
}

/* ---- lines with bars --------------------------------------------------------------------------------------------- */

/* Sends the points of each line of panel number `panel` as a data block: position along the axis, mean and scatter. */
static void send_points(FILE *to, const struct study_picture *p, int panel)
{
    const struct varied_key *across = &p->key[p->across];
    const struct study_point *point = p->point[panel];
    const char *unit;
    for (int l = 0; l < p->lines; l++) {
        fprintf(to, "$p%d_%d << EOD\n", panel, l);
        for (int v = 0; v < across->values; v++) {
            const struct study_point *at = &point[l * across->values + v];
            const double x = p->numbers ? value_read_number_and_unit(across->value[v], &unit) : v;
            if (at->runs > 0) fprintf(to, "%.10g %.10g %.10g\n", x, at->mean, at->scatter);
        }
        fputs("NaN NaN NaN\nEOD\n", to); /* gnuplot refuses a block without points */
    }
}

static void plot_panel(FILE *to, const struct study_picture *p, int panel)
{
    fputs("plot ", to);
    for (int l = 0; l < p->lines; l++) {
        fprintf(to, "%s$p%d_%d using 1:2 smooth unique with lines lw 1.6 lc rgb '%s' notitle, $p%d_%d using ",
                l > 0 ? ", " : "", panel, l, curve_colour[l], panel, l);
        fprintf(to,
                p->chance ? "1:2:3 with yerrorbars pt 7 ps 0.7 lw 1.4 lc rgb '%s' notitle"
                          : "1:2 with points pt 7 ps 0.9 lc rgb '%s' notitle",
                curve_colour[l]);
    }
    putc('\n', to);
}

/* Draws the key of the lines and its heading, the names of their keys: on the right of the panels or, in a narrow
 * picture, below them. It is a panel of its own, as large as the picture, because gnuplot makes no key wider than its
 * panel. */
static void draw_key(FILE *to, const struct study_picture *p)
{
    char text[256];
    const bool below = p->strip > 0;
    const int x = below ? character() : p->width - p->legend + character();
    const int y = below ? p->notes * ROW + p->strip : p->height - TITLE + ROW;
    keys_text(text, sizeof text, p, ROLE_LINES, false);
    fputs("unset border\nunset tics\nunset title\nunset grid\nset offsets\nset lmargin at screen 0\n"
          "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n",
          to);
    screen_label(to, p, text, x, y - 0.5 * ROW, "left");
    fprintf(to, "set key at screen %.5f,%.5f left top horizontal maxcols %d maxrows %d\nplot [0:1] [0:1] ",
            (double)x / p->width, (double)(y - ROW) / p->height, p->key_columns,
            (p->lines + p->key_columns - 1) / p->key_columns);
    for (int l = 0; l < p->lines; l++) {
        line_title(text, sizeof text, p, l);
        fprintf(to, "%sNaN with linespoints lw 1.6 pt 7 ps 0.9 lc rgb '%s' title ", l ? ", " : "", curve_colour[l]);
        gnuplot_write_quoted_string(to, text);
    }
    putc('\n', to);
}

/* Sends the distance of the tics of the vertical axis of panel number `panel`, so that their numbers do not touch. */
static void send_figure_tics(FILE *to, const struct study_picture *p, int panel)
{
    double low, high;
    study_points_range(p, panel, &low, &high);
    if (high > low)
        fprintf(to, "set ytics %.10g\n", axis_tick_distance(1.2 * (high - low), (int)fmax(p->high / TICS_UP, 2)));
    else
        fputs("set ytics autofreq\n", to);
}

/* Sends the distance of the tics of a horizontal axis with the values of the key across. */
static void send_number_tics(FILE *to, const struct study_picture *p)
{
    const struct varied_key *key = &p->key[p->across];
    const int most = (int)fmin(fmax(p->wide / (7 * character()), 1), STEPS_MOST);
    double low = INFINITY, high = -INFINITY;
    const char *unit;
    for (int v = 0; v < key->values; v++) {
        low = fmin(low, value_read_number_and_unit(key->value[v], &unit));
        high = fmax(high, value_read_number_and_unit(key->value[v], &unit));
    }
    if (high > low)
        fprintf(to, "set xtics norotate %.10g\n", axis_tick_distance(high - low, most));
    else
        fputs("set xtics norotate autofreq\n", to);
}

static status draw_lines(struct study_picture *p)
{
    char name[PICTURE_NAME_ROOM];
    struct gnuplot g;
    roles_assign_to_keys(p, LINES_MOST);
    study_points_compute(p);
    room_find(p, NULL);
    study_picture_name(name, p->key[p->across].key);
    TRY(picture_open(&g, p, name));
    for (int panel = 0; panel < p->panels; panel++) send_points(g.to, p, panel);
    if (p->numbers)
        send_number_tics(g.to, p);
    else
        send_tics(g.to, "x", &p->key[p->across], p->slanted);
    for (int panel = 0; panel < p->panels; panel++) {
        panel_begin(g.to, p, panel, NULL);
        send_figure_tics(g.to, p, panel);
        plot_panel(g.to, p, panel);
        fputs("unset label\n", g.to);
    }
    if (p->lines > 1) draw_key(g.to, p);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* Draws each chosen figure of a study as a map over two varied keys. The key with the index p->across is along the
 * horizontal axis, the one with the index `up` along the vertical axis. Returns FAILED if gnuplot fails. */
static status draw_study_map(struct study_picture *p, int up)
{
    const struct varied_key *across = &p->key[p->across], *key_up = &p->key[up];
    struct gnuplot g;
    char name[NOTE_ROOM];
    key_text(name, sizeof name, key_up);
    roles_assign_to_keys(p, across->values * key_up->values);
    if (p->role[up] == ROLE_CHANCE) p->role[up] = ROLE_LINES, p->lines = key_up->values, p->chance = false;
    study_points_compute(p);
    room_find(p, key_up);
    p->unit = "";
    char picture[PICTURE_NAME_ROOM];
    study_picture_name(picture, "map");
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
        fprintf(g.to, "plot $m%d using 1:2:3 with image notitle\nunset label\n", panel);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Finds the two keys of a map: the varied keys with a physical meaning if they are two, else all varied keys. Stores
 * the index of the key along the vertical axis in *up, along the horizontal axis in *across. Returns false if there are
 * not two. */
static bool map_keys(const struct study_picture *p, int *up, int *across)
{
    for (int all = 0; all < 2; all++) {
        int n = 0, last[2] = {0};
        for (int k = 0; k < p->keys; k++)
            if (p->key[k].values > 1 && (all || !key_has_no_physical_meaning(p->key[k].key))) {
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
        if (p->key[k].values < 2) continue;
        p->across = k;
        p->unit = "";
        p->numbers = varied_key_values_are_numbers(&p->key[k], &p->unit);
        if (!p->numbers) p->unit = "";
        TRY(draw_lines(p));
    }
    return map_keys(p, &up, &p->across) ? draw_study_map(p, up) : OK;
}

status study_draw_results_over_keys(const struct study_table *t, const struct study *s, const struct varied_key *key,
                                    int keys, const char *const *result, int results)
{
    char header[HEADER_ROOM];
    struct study_picture p = {.table = t, .study = s, .key = key, .keys = keys, .header = header};
    TRY(panels_show_named_figures(&p, result, results));
    if (results == 0) panels_choose_figures(&p);
    if (p.panels == 0) return OK;
    study_read_history_header(header, sizeof header, s);
    p.value_at = NEW("study.value_at", keys, int *);
    p.role = NEW("study.roles", keys, enum key_role);
    values_find_indices_in_runs(p.value_at, s, key, keys);
    const status drawn = draw_all(&p);
    for (int k = 0; k < keys; k++) memory_free(p.value_at[k]);
    study_points_free(&p);
    memory_free(p.value_at);
    memory_free(p.role);
    return drawn;
}
