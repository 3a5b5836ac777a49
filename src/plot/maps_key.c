/* Draws the colour bar and the key (legend) of pictures of maps. */
#include <math.h>
#include <string.h>

#include "curves_parts.h"
#include "maps_parts.h"

/* BAR_STEPS: number of colours of the bar; its image has BAR_ACROSS lines because gnuplot draws no image of a single
 * line. BAR_HIGHEST: greatest length of a vertical bar [pixel]. */
enum { BAR_STEPS = 256, BAR_ACROSS = 2, BAR_HIGHEST = 360 };

/* Distances around the colour bar [pixel]. NUMBERS: width of the tics and blanks beside the numbers of a vertical bar;
 * LABEL_HALF: half height of a line of its label; UNDER_BAR: least blank below it. For a horizontal bar below the
 * panels, BAR_LOW is its height, and UNDER_LABEL the distance from its upper edge to its label. */
enum { BEYOND_WIDE = 84 }; /* width of `0.14 % above` */
enum { NUMBERS = 26, NUMBERS_NARROW = 20, LABEL_HALF = 12, UNDER_LABEL = 50, BAR_LOW = 12, UNDER_BAR = 30 };

static double letter_wide(void) { return picture_size_is_too_narrow_for_side_legend() ? 7.4 : 9; }
static int numbers_from(void) { return picture_size_is_too_narrow_for_side_legend() ? NUMBERS_NARROW : NUMBERS; }
static int bar_from(void) { return picture_size_is_too_narrow_for_side_legend() ? BAR_FROM_NARROW : BAR_FROM; }

/* ---- colour bar -------------------------------------------------------------------------------------------------- */

/* Scale of a colour bar: its label, the values at its ends and the distance of its tics (labelled marks) in the unit of
 * the label, and the printf format of its numbers. */
struct bar_scale {
    char label[64];
    double low, high, tics;
    const char *format;
};

static struct bar_scale bar_scale_of(const struct view *view, enum map map)
{
    struct bar_scale s = {.low = view->bottom, .high = view->top, .format = "%.1f"};
    s.tics = axis_choose_tic_distance(s.high - s.low, 300, 50);
    if (s.tics < 0.099) s.format = "%.9g";
    snprintf(s.label, sizeof s.label, "%s", map == MAP_KIND ? "peridynamic damage" : "damage");
    if (map != MAP_FIELD) return s;
    const struct unit u =
        unit_with_si_prefix_if_unit_allows_it(view->field->unit, fmax(fabs(view->low), fabs(view->high)));
    s.low = view->low / u.factor, s.high = view->high / u.factor;
    s.tics = axis_choose_tic_distance(s.high - s.low, 300, 50);
    s.format = "%.9g";
    plot_field_write_label(s.label, sizeof s.label, view->field);
    const size_t length = strlen(s.label);
    if (*u.name) snprintf(s.label + length, sizeof s.label - length, " [%s]", u.name);
    return s;
}

/* Returns the distance between the tics (labelled marks) of a vertical colour bar with the scale s, in the unit of its
 * label, at least s->tics. length: length of the bar [pixel]. */
static double bar_tics(const struct bar_scale *s, int length)
{
    return fmax(s->tics, axis_choose_tic_distance(s->high - s->low, length,
                                                  picture_size_is_too_narrow_for_side_legend() ? 22 : 28));
}

/* Returns the length [pixel] of the label of a vertical colour bar with the scale s, without the unit. */
static double bar_label_length(const struct bar_scale *s) { return letter_wide() * (double)strcspn(s->label, "["); }

int colour_bar_least_height(const struct maps_content *shown)
{
    const struct bar_scale s = bar_scale_of(shown->view, shown->map);
    return (int)bar_label_length(&s) + UNDER_BAR;
}

/* Returns the length [pixel] of a vertical colour bar with the scale s: the height of the panels, but at most
 * BAR_HIGHEST. The bar is longer than low panels if its label, without the unit, needs this length and the picture has
 * the space. panels: height of all rows of panels [pixel]; room: height of the picture below the upper edge of the bar
 * [pixel]. */
static int bar_length(const struct bar_scale *s, int panels, int room)
{
    const int label = (int)fmin(bar_label_length(s), room - UNDER_BAR);
    return panels >= BAR_HIGHEST ? BAR_HIGHEST : panels > label ? panels : label;
}

/* Returns the part of the label of a vertical colour bar with the scale s, its unit, that is written in a second line
 * because the label is longer than the bar; NULL if the label fits into one line. The result points into s->label.
 * length: length of the bar [pixel]. */
static const char *bar_second_line(const struct bar_scale *s, int length)
{
    return letter_wide() * (double)strlen(s->label) > length ? strstr(s->label, " [") : NULL;
}

int colour_bar_width_beside_panels(const struct maps_content *shown, int panels_height)
{
    const struct bar_scale s = bar_scale_of(shown->view, shown->map);
    double numbers = 0;
    for (int length = 40; length <= BAR_HIGHEST; length *= 2)
        numbers = fmax(numbers, axis_longest_tic_number_width(s.low, s.high, bar_tics(&s, length), s.format));
    const int length = bar_length(&s, panels_height, BAR_HIGHEST);
    const double lines = bar_second_line(&s, length) ? 1 : 0;
    return (int)(bar_from() + BAR_WIDE + numbers_from() + numbers + LABEL_HALF + lines * letter_wide());
}

/* Returns true if the picture of maps m states the shares of particles beyond the ends of its colours: if the colours
 * show the field of its view. */
static bool has_shares(const struct maps_content *m)
{
    return m->map == MAP_FIELD || (m->map == MAP_DAMAGE && colour_map_kind_for_field(m->view->field) == MAP_DAMAGE);
}

/* Writes to gnuplot, beside one end of the colour bar, which percentage of the particles have values beyond this end.
 * Writes nothing if no particle has. l: layout; view: ends of the colours and numbers of particles beyond; end: 0 for
 * the lower end, 1 for the upper; particles: number of particles of an output frame; x, y: position of the text from
 * the upper left corner of the picture [pixel]; adjust: `left` or `right`. */
static void draw_beyond(FILE *to, const struct maps_layout *l, const struct view *view, int64_t particles, int end,
                        double x, double y, const char *adjust)
{
    if (view->beyond[end] == 0) return;
    const double percent = 100.0 * (double)view->beyond[end] / (double)particles;
    fprintf(to, "set label '%.*g %% %s' at screen %.6g,%.6g %s font ',10' textcolor rgb '#555555'\n",
            percent < 99 ? 2 : 3, percent, end ? "above" : "below", x / l->width, 1 - y / l->height, adjust);
}

/* Writes to gnuplot the commands for the label of a vertical colour bar with the scale s, with the unit in a second
 * line if the label is longer than the bar. l: layout; x, y: centre of the first line, from the upper left corner of
 * the picture [pixel]; length: length of the bar [pixel]. */
static void draw_bar_label(FILE *to, const struct maps_layout *l, const struct bar_scale *s, double x, double y,
                           int length)
{
    const char *unit = bar_second_line(s, length);
    const char *second = unit ? unit + 1 : "";
    const size_t first = unit ? (size_t)(unit - s->label) : strlen(s->label);
    for (int line = 0; line < (unit ? 2 : 1); line++)
        fprintf(to, "set label '%.*s' at screen %.6g,%.6g center rotate by 90 textcolor rgb '#333333'\n",
                line ? (int)strlen(second) : (int)first, line ? second : s->label,
                (x + letter_wide() * (2 * line - 0.2 * !!unit)) / l->width, 1 - y / l->height);
}

/* Writes to gnuplot the commands that draw the colour bar of the maps m as a narrow panel on the right of the first
 * row of panels. l: layout; s: scale of the bar; particles: number of particles of an output frame. */
static void draw_bar_beside(FILE *to, const struct maps_layout *l, const struct maps_content *m,
                            const struct bar_scale *s, int64_t particles)
{
    struct colour pixel[BAR_STEPS * BAR_ACROSS];
    const int panels = l->rows * l->panel_height + (l->rows - 1) * GAP_Y;
    const int length = bar_length(s, panels, l->height - l->above);
    const double from[2] = {0, s->low}, step[2] = {1.0 / BAR_ACROSS, (s->high - s->low) / BAR_STEPS};
    const double x = l->width - l->right + bar_from(), tics = bar_tics(s, length);
    for (int k = 0; k < BAR_STEPS * BAR_ACROSS; k++)
        pixel[k] = view_colour_at_scale_position(m->view, m->map, (k / BAR_ACROSS + 0.5) / BAR_STEPS);
    plot_box_write_margins(to, l, x, l->above, BAR_WIDE, length);
    fprintf(to, "set xrange [0:1]\nset yrange [%.9g:%.9g]\nset y2range [%.9g:%.9g]\nset y2tics out %.9g format '%s'\n",
            s->low, s->high, s->low, s->high, tics, s->format);
    draw_bar_label(to, l, s,
                   x + BAR_WIDE + numbers_from() + axis_longest_tic_number_width(s->low, s->high, tics, s->format),
                   l->above + 0.5 * length, length);
    const bool edge = x - 6 + BEYOND_WIDE > l->width;
    for (int end = 0; end < 2 && has_shares(m); end++)
        draw_beyond(to, l, m->view, particles, end, edge ? l->width - 4 : x - 6,
                    end ? l->above - 12 : l->above + length + 14, edge ? "right" : "left");
    panel_write_image(to, pixel, BAR_ACROSS, BAR_STEPS, from, step, "");
}

/* Writes to gnuplot the commands that draw the colour bar of the maps m below the panels and as wide as all of them,
 * with its label below the numbers. l: layout; s: scale of the bar; particles: number of particles of an output frame.
 */
static void draw_bar_under(FILE *to, const struct maps_layout *l, const struct maps_content *m,
                           const struct bar_scale *s, int64_t particles)
{
    struct colour pixel[BAR_ACROSS * BAR_STEPS];
    const double x = l->left, wide = l->width - l->left - l->right;
    const double y = l->above + l->rows * l->panel_height + (l->rows - 1) * GAP_Y + l->axes;
    const double from[2] = {s->low, 0}, step[2] = {(s->high - s->low) / BAR_STEPS, 1.0 / BAR_ACROSS};
    for (int k = 0; k < BAR_ACROSS * BAR_STEPS; k++)
        pixel[k] = view_colour_at_scale_position(m->view, m->map, (k % BAR_STEPS + 0.5) / BAR_STEPS);
    plot_box_write_margins(to, l, x, y, wide, BAR_LOW);
    fprintf(to, "set yrange [0:1]\nset xrange [%.9g:%.9g]\nset xtics out %.9g format '%s' offset 0,0.5\n", s->low,
            s->high, fmax(s->tics, horizontal_axis_choose_tic_distance(s->low, s->high, wide)), s->format);
    fprintf(to, "set label '%s' at screen %.6g,%.6g center textcolor rgb '#333333'\n", s->label,
            (x + 0.5 * wide) / l->width, 1 - (y + UNDER_LABEL) / l->height);
    for (int end = 0; end < 2 && has_shares(m); end++)
        draw_beyond(to, l, m->view, particles, end, end ? x + wide + 4 : x - 4, y + UNDER_LABEL,
                    end ? "right" : "left");
    panel_write_image(to, pixel, BAR_STEPS, BAR_ACROSS, from, step, "");
}

void map_colour_bar_draw(FILE *gnuplot, const struct maps_layout *l, const struct maps_content *shown,
                         int64_t particle_count)
{
    const struct bar_scale s = bar_scale_of(shown->view, shown->map);
    fputs("unset arrow\nunset title\nunset xlabel\nunset ylabel\nunset xtics\nunset ytics\nset border 15\n"
          "unset grid\nunset label\n",
          gnuplot);
    (l->bar_under ? draw_bar_under : draw_bar_beside)(gnuplot, l, shown, &s, particle_count);
}

/* ---- key --------------------------------------------------------------------------------------------------------- */

/* Appends an entry to the key (legend): a sample of `colour` with the text `name`, which is truncated if too long. */
static void map_key_add(struct map_key *key, struct colour colour, const char *name)
{
    struct category *of = &key->of[key->n++];
    of->colour = colour;
    snprintf(of->name, sizeof of->name, "%s", name);
}

void map_key_collect_entries(struct map_key *key, enum map map, const struct view *view, bool has_rigid_bodies)
{
    const struct categories *named = view->categories;
    char more[32];
    key->n = 0;
    if (map == MAP_KIND) {
        map_key_add(key, colour_of_material_points(), "material points");
        map_key_add(key, colour_on_peridynamic_particle_scale(0.25), "peridynamics");
    } else if (map == MAP_FRAGMENT) {
        map_key_add(key, fragment_colour(0), "the heaviest");
        map_key_add(key, fragment_colour(-1), "no bond left");
    } else if (map == MAP_CATEGORY) {
        for (int k = 0; k < named->n; k++) map_key_add(key, named->of[k].colour, named->of[k].name);
        snprintf(more, sizeof more, "and %d more", named->more);
        if (named->more > 0) map_key_add(key, (struct colour){0}, more);
    }
    if (has_rigid_bodies) map_key_add(key, rigid_body_colour(map), "rigid");
}

/* Writes to gnuplot the commands that draw the entry e of the key (legend): a square in the colour of the entry, unless
 * that is transparent, and its text. l: layout; x, y: position of the entry from the upper left corner of the picture
 * [pixel]. */
static void key_entry(FILE *to, const struct maps_layout *l, double x, double y, const struct category *e)
{
    if (e->colour.alpha > 0)
        fprintf(to,
                "set object rectangle from screen %.6g,%.6g to screen %.6g,%.6g fs solid border rgb '#888888' "
                "fc rgb '#%02x%02x%02x'\n",
                x / l->width, 1 - (y + 6) / l->height, (x + 14) / l->width, 1 - (y - 8) / l->height, e->colour.red,
                e->colour.green, e->colour.blue);
    fputs("set label ", to);
    gnuplot_write_quoted_string(to, e->name);
    fprintf(to, " at screen %.6g,%.6g left font ',12' textcolor rgb '#333333'\n", (x + 21) / l->width,
            1 - (y - 1) / l->height);
}

void map_key_draw(FILE *gnuplot, const struct maps_layout *l, const struct map_key *key)
{
    const double below = l->above + l->rows * l->panel_height + (l->rows - 1) * GAP_Y + l->axes;
    const double y = l->key_beside ? l->above + 8 : below + (l->bar_under ? BAR_STRIP : 0) + KEY_UNDER + 2;
    const double x = l->key_beside                                  ? l->width - l->right + bar_from()
                     : picture_size_is_too_narrow_for_side_legend() ? KEY_LEFT
                                                                    : l->left;
    const int columns = l->key_beside ? 1 : l->key_columns;
    for (int k = 0; k < key->n; k++)
        key_entry(gnuplot, l, x + k % columns * l->entry, y + k / columns * KEY_ROW, &key->of[k]);
}
