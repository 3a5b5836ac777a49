/* Arranges the pictures of a study: composes the texts around the panels and computes the space that they need. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study_picture.h"

enum { COLUMNS_MOST = 3 }; /* largest number of panels side by side */

/* Sizes in the pictures of a study [pixel]. WIDE, HIGH: usual size of a panel; NARROW_PANEL: width below which panels
 * have a row of their own; LEAST: least width; NUMBERS: width of the numbers at an axis; BELOW: height of tics and
 * label below the axis; SAMPLE: width of an entry of the key (legend) without its text. */
enum { WIDE = 320, HIGH = 220, NARROW_PANEL = 150, LEAST = 60, NUMBERS = 100, BELOW = 68, SAMPLE = 50 };

static const double PROPORTION = 0.7; /* height of a panel divided by its width in pictures of a given width */

/* ---- texts ------------------------------------------------------------------------------------------------------- */

/* Writes the title of line number `line` (from 0) of the picture p to text[capacity]: the values of the varied keys
 * (keys of the input file that a study varies) that distinguish lines, separated by commas. Truncates a title that is
 * too long. */
void study_picture_compose_legend_text_of_line(char *text, size_t capacity, const struct study_picture *p, int line)
{
    size_t used = 0;
    int rest = p->lines;
    *text = '\0';
    for (int k = 0; k < p->keys; k++) {
        char value[LABEL_ROOM];
        if (p->role[k] != ROLE_LINES) continue;
        const struct varied_key *key = &p->key[k].shown;
        rest /= key->values;
        varied_key_compose_label_of_value(value, key, line / rest % key->values);
        if (used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, "%s%s", used > 0 ? ", " : "", value);
    }
}

void plotted_key_compose_label_with_unit(char *text, size_t capacity, const struct plotted_key *key)
{
    snprintf(text, capacity, *key->unit ? "%s [%s]" : "%s%s", key->shown.key, key->unit);
}

void study_picture_compose_list_of_keys_with_role(char *text, size_t capacity, const struct study_picture *p,
                                                  enum key_role role, bool with_value)
{
    size_t used = 0;
    *text = '\0';
    for (int k = 0; k < p->keys; k++) {
        char value[LABEL_ROOM], name[NOTE_ROOM];
        if (p->role[k] != role) continue;
        varied_key_compose_label_of_value(value, &p->key[k].shown, 0);
        plotted_key_compose_label_with_unit(name, sizeof name, &p->key[k]);
        if (used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, "%s%s%s%s", used > 0 ? ", " : "", name,
                                     with_value ? " = " : "", with_value ? value : "");
    }
}

/* Composes the notes below the panels of p, at most one for each of these: keys for which the picture shows only the
 * first value; keys over which it shows means, such as random seeds; the lines of the mean over seeds; points without a
 * value. map: true for maps, false for lines with error bars. */
static void notes_find(struct study_picture *p, bool map)
{
    char keys[NOTE_ROOM - 64];
    p->notes = 0;
    study_picture_compose_list_of_keys_with_role(keys, sizeof keys, p, ROLE_HELD, true);
    if (*keys) snprintf(p->note[p->notes++], NOTE_ROOM, "at %s alone", keys);
    study_picture_compose_list_of_keys_with_role(keys, sizeof keys, p, ROLE_CHANCE, false);
    if (*keys)
        snprintf(p->note[p->notes++], NOTE_ROOM,
                 map ? "means over %s" : "points and bars: mean and standard deviation over %s", keys);
    if (p->seeds)
        snprintf(p->note[p->notes++], NOTE_ROOM,
                 "full line: mean; dashed lines: mean plus and minus the standard deviation");
    if (map && !study_picture_every_point_has_value(p)) snprintf(p->note[p->notes++], NOTE_ROOM, "white: no value");
}

static int tics_shown(const struct varied_key *key)
{
    return key->values < STUDY_TICS_MOST ? key->values : STUDY_TICS_MOST;
}

/* Returns true if the labels of the values of a varied key (a key of the input file that a study varies) would overlap
 * when written along the horizontal axis of a panel of p. */
static bool words_touch(const struct study_picture *p, const struct varied_key *key)
{
    return tics_shown(key) * (varied_key_longest_value_label_length(key) + 2) *
               study_picture_character_width_in_pixels() >
           p->wide;
}

/* ---- layout ------------------------------------------------------------------------------------------------------ */

/* Returns the number of rows into which the panels of the picture p are arranged. */
static int panel_rows(const struct study_picture *p) { return (p->panels + p->columns - 1) / p->columns; }

/* Returns the number of characters of the longest number at the axes of all panels: at the horizontal axes if `across`
 * is true, else at the axes of the scalar results, which have at most `most` intervals between tics. p: the picture. */
static int numbers_length(const struct study_picture *p, bool across, int most)
{
    int longest = 0;
    for (int panel = 0; panel < p->panels; panel++) {
        const struct study_axis axis =
            across ? study_panel_get_horizontal_axis(p, panel) : study_panel_get_vertical_axis(p, panel);
        const int length = study_axis_longest_tick_label_length(
            &axis, across ? study_panel_max_horizontal_axis_intervals(p, &axis) : most);
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* Computes the size of the picture p from the size of a panel, the margins and the notes. If the user has chosen the
 * size of the picture, computes the size of a panel from the size of the picture instead. */
static void size_settle(struct study_picture *p)
{
    const struct picture_size given = picture_size_get_process_wide();
    const int around = STUDY_TITLE + p->below, rows = panel_rows(p);
    const int under = p->notes * STUDY_ROW + p->strip;
    p->width = p->columns * (p->left + p->wide + p->right) + p->legend;
    if (given.width) {
        p->width = given.width;
        p->wide = (int)fmax((given.width - p->legend) / p->columns - p->left - p->right, LEAST);
        p->high =
            (int)fmax(given.height ? (given.height - under) / rows - around : fmin(PROPORTION * p->wide, HIGH), LEAST);
    }
    p->height = given.height ? given.height : rows * (around + p->high) + under;
    for (int k = 0; k < p->notes && !given.width; k++) {
        const int wide = ((int)strlen(p->note[k]) + 2) * study_picture_character_width_in_pixels();
        p->width = wide > p->width ? wide : p->width;
    }
}

/* Sets the margins of the panels of p such that the texts at the axes fit. up: varied key (a key of the input file
 * that a study varies) along the vertical axis of a map; NULL for a picture with lines. */
static void margins_find(struct study_picture *p, const struct varied_key *up)
{
    const double slope = 0.64, run = 0.77; /* sine and cosine of 40 degrees */
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const int letter = study_picture_character_width_in_pixels(),
              along = varied_key_longest_value_label_length(&p->key[p->across].shown) * letter;
    const int numbers = (numbers_length(p, false, study_panel_max_vertical_axis_intervals(p)) + 3) * letter;
    p->left = up ? (varied_key_longest_value_label_length(up) + 6) * letter
                 : (int)fmax(numbers, narrow ? 9 * letter : NUMBERS);
    p->right = up           ? 2 * STUDY_COLOUR_BAR + (numbers_length(p, false, STUDY_COLOUR_STEPS) + 3) * letter
               : p->numbers ? (int)fmax(3, 2 + 0.5 * numbers_length(p, true, 0)) * letter
               : p->slanted ? 2 * letter
                            : 2 * letter + along / 2;
    p->below = BELOW + (p->slanted ? (int)(slope * along) - STUDY_ROW / 2 : 0);
    if (p->slanted && p->left < (int)(run * along)) p->left = (int)(run * along);
}

/* Computes the space for the legend of the lines: its width beside the panels, or in a narrow picture its number of
 * columns and its height below the panels. p: the picture. */
static void key_space_find(struct study_picture *p)
{
    char text[256];
    study_picture_compose_list_of_keys_with_role(text, sizeof text, p, ROLE_LINES, false);
    int longest = 0;
    const int title = (int)strlen(text);
    for (int l = 0; l < p->lines; l++) {
        study_picture_compose_legend_text_of_line(text, sizeof text, p, l);
        longest = (int)strlen(text) > longest ? (int)strlen(text) : longest;
    }
    if (picture_size_is_too_narrow_for_side_legend()) {
        const int columns = (picture_size_get_process_wide().width - 2 * study_picture_character_width_in_pixels()) /
                            (SAMPLE + longest * study_picture_character_width_in_pixels());
        p->key_columns = columns < 1 ? 1 : columns < p->lines ? columns : p->lines;
        p->strip = (1 + (p->lines + p->key_columns - 1) / p->key_columns) * STUDY_ROW;
    } else {
        p->key_columns = 1;
        p->legend = ((longest + 5 > title ? longest + 5 : title) + 2) * study_picture_character_width_in_pixels();
    }
}

/* Computes the complete layout of the picture p for p->columns columns of panels. up: varied key (a key of the input
 * file that a study varies) along the vertical axis of a map; NULL for a picture with lines. */
static void columns_try(struct study_picture *p, const struct varied_key *up)
{
    p->wide = WIDE, p->high = HIGH;
    p->slanted = false;
    margins_find(p, up);
    size_settle(p);
    if (p->numbers && !up) return;
    p->slanted = words_touch(p, &p->key[p->across].shown);
    margins_find(p, up);
    size_settle(p);
}

void study_picture_compute_layout(struct study_picture *p, const struct varied_key *vertical_key)
{
    const struct picture_size given = picture_size_get_process_wide();
    const int most = p->panels < COLUMNS_MOST ? p->panels : COLUMNS_MOST;
    double largest = 0;
    int best = most;
    p->legend = p->strip = 0;
    if (!vertical_key && p->lines > 1) key_space_find(p);
    notes_find(p, vertical_key != NULL);
    for (p->columns = most; p->columns >= 1; p->columns--) {
        columns_try(p, vertical_key);
        const double size = given.height ? fmin(p->wide, p->high / PROPORTION) : fmin(p->wide, NARROW_PANEL);
        if (size > largest) largest = size, best = p->columns;
    }
    p->columns = best;
    columns_try(p, vertical_key);
}
