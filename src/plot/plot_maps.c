/* Maps of damage, kind and fields: panels, colour bar, titles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "curves_parts.h"
#include "maps_parts.h"

/* Margins of the panels, and gaps between the panels [pixel]. RIGHT_MAX: largest right margin, for a key of long names.
 */
enum { LEFT = 104, RIGHT = 136, RIGHT_MAX = 420, ABOVE = 84, BELOW = 70, GAP_X = 34, GAP_Y = 42 };
enum {
    LEFT_NARROW = 74,
    RIGHT_NARROW = 124,
    ABOVE_NARROW = 62,
    KEY_NARROW = 24,
    BELOW_NARROW = 54,
    AXES_NARROW = 24,
    GAP_NARROW = 26
};

/* Least distance of tics of the vertical axis [pixel]. */
enum { TICS_Y = 36, TICS_Y_NARROW = 22 };

/* Position and width of the colour bar [pixel] and number of its colours; its image has two columns because gnuplot
 * draws no image of a single column. */
enum { BAR_FROM = 26, BAR_WIDTH = 16, BAR_STEPS = 256, BAR_COLUMNS = 2 };

/* Size of the whole picture [pixel]: printed on a text page, its letters have the size of the text. */
enum { WIDTH = 1280, WIDTH_SINGLE = 1000, HEIGHT_MAX = 1180, PANEL_MIN = 24 };
enum { KEY_LINE = 22 };                  /* distance of lines of the key [pixel] */
static const double SHAPE_WANTED = 0.72; /* height over width of the picture */

/* Returns the layout of a picture with `panels` panels in `columns` columns. aspect: height over width of a panel;
 * margins: layout in which the margins of the panels are set. */
static struct layout layout_of(int columns, int panels, double aspect, const struct layout *margins)
{
    struct layout l = *margins;
    l.columns = columns, l.rows = (panels + columns - 1) / columns;
    const struct picture_size given = picture_size_get();
    int width = given.width ? given.width : panels == 1 ? WIDTH_SINGLE : WIDTH;
    int between_x = (columns - 1) * l.gap, between_y = (l.rows - 1) * GAP_Y;
    double panel = fmax((width - l.left - l.right - between_x) / columns, PANEL_MIN);
    double highest =
        fmax(((given.width ? given.height : HEIGHT_MAX) - l.above - l.below - between_y) / l.rows, PANEL_MIN);
    panel = fmin(panel, highest / aspect);
    l.panel_width = (int)fmax(lround(panel), PANEL_MIN);
    l.panel_height = (int)fmax(lround(panel * aspect), PANEL_MIN);
    l.width = l.left + l.right + between_x + columns * l.panel_width;
    l.height = l.above + l.below + between_y + l.rows * l.panel_height;
    if (given.width) {
        l.right += given.width - l.width; /* the bar stays beside the panels */
        l.width = given.width, l.height = given.height;
    }
    return l;
}

/* Returns the layout of `panels` panels with the best compromise between large panels, a picture of the shape
 * SHAPE_WANTED (height over width) and few empty positions. aspect: height over width of a panel; margins: layout in
 * which the margins of the panels are set. */
static struct layout layout_choose(int panels, double aspect, const struct layout *margins)
{
    struct layout best = layout_of(1, panels, aspect, margins);
    double best_cost = INFINITY;
    for (int columns = 1; columns <= panels; columns++) {
        struct layout l = layout_of(columns, panels, aspect, margins);
        double area = (double)l.panel_width * l.panel_height;
        const double shape = picture_size_get().width ? 0 : fabs(log((double)l.height / l.width / SHAPE_WANTED));
        double cost = shape - 0.5 * log(area);
        cost += 0.2 * (l.rows * l.columns - panels); /* empty panels */
        if (cost >= best_cost) continue;
        best_cost = cost;
        best = l;
    }
    return best;
}

/* Writes the gnuplot commands that place a plot in a box of the picture. left, above: upper left corner of the box;
 * width, height: its size. All lengths are in pixels. */
static void set_box(FILE *to, const struct layout *l, double left, double above, double width, double height)
{
    fprintf(to, "set lmargin at screen %.9g\nset rmargin at screen %.9g\n", left / l->width, (left + width) / l->width);
    fprintf(to, "set tmargin at screen %.9g\nset bmargin at screen %.9g\n", 1 - above / l->height,
            1 - (above + height) / l->height);
}

void panel_write_margins(FILE *to, const struct layout *l, double left, double above)
{
    set_box(to, l, left, above, l->panel_width, l->panel_height);
}

void panel_write_image(FILE *to, const struct colour *pixel, int width, int height, const double *from,
                       const double *step, const char *more)
{
    fprintf(to,
            "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,%.12g) format='%%uchar' "
            "with rgbalpha notitle%s\n",
            width, height, step[0], step[1], from[0] + 0.5 * step[0], from[1] + 0.5 * step[1], more);
    fwrite(pixel, sizeof *pixel, (size_t)width * (size_t)height, to);
}

/* Returns the width of the longest number at the tics of an axis from `low` to `high` [pixel]. tics: distance of the
 * tics; format: printf format of the numbers. */
static double numbers_width(double low, double high, double tics, const char *format)
{
    int longest = 0;
    for (double k = ceil(low / tics - 1e-6); k * tics <= high; k++) {
        char number[32];
        const int length = snprintf(number, sizeof number, format, fabs(k) < 0.5 ? 0 : k * tics);
        if (length > longest) longest = length;
    }
    return (gnuplot_is_narrow() ? 7.4 : 9) * longest;
}

/* Returns the number of multiples of `tics` from `low` to `high`. */
static double tics_within(double low, double high, double tics) { return floor(high / tics) - ceil(low / tics) + 1; }

/* Returns the distance of tics of a horizontal axis from `low` to `high` that is `pixels` pixels long. The numbers at
 * the tics do not touch, unless the axis is too short for two tics: it always has at least two, since a single one
 * gives no scale. */
static double tics_across(double low, double high, double pixels)
{
    double apart = 20, tics = tic_distance(high - low, pixels, apart);
    while (apart < pixels && numbers_width(low, high, tics, "%g") + 14 > tics / (high - low) * pixels)
        tics = tic_distance(high - low, pixels, apart *= 1.3);
    if (tics_within(low, high, tics) > 1) return tics;
    while (apart > 1 && tics_within(low, high, tics) < 2) tics = tic_distance(high - low, pixels, apart /= 1.3);
    return tics_within(low, high, 2 * tics) < 2 ? tics : 2 * tics;
}

void panel_write_axes(FILE *to, const struct layout *l, const struct view *view, const struct plotted_particles *c,
                      const struct unit *metre, int column, bool lowest)
{
    const int size[2] = {l->panel_width, l->panel_height};
    for (int k = 0; k < 2; k++) {
        const double low = view->from[k] / metre->factor, high = view->to[k] / metre->factor;
        const bool labelled = k == 0 ? lowest : column == 0;
        const double tics = k == 0 ? tics_across(low, high, size[0])
                                   : tic_distance(high - low, size[1], gnuplot_is_narrow() ? TICS_Y_NARROW : TICS_Y);
        fprintf(to, "set %ctics %.9g format '%s'\nset %clabel '", 'x' + k, tics, labelled ? "%g" : "", 'x' + k);
        if (labelled) fprintf(to, "%c [%s]", 'x' + c->axis[k], metre->name);
        fputs("'\n", to);
    }
}

void panel_write_axis_arrows(FILE *to, const struct layout *l, const struct view *view,
                             const struct plotted_particles *c, const struct unit *metre, double left, double above)
{
    const double pixel = (view->to[0] - view->from[0]) / metre->factor / l->panel_width, x = left + 34;
    const double y = l->height - (above + l->panel_height + 46); /* above the lower edge of the picture [pixel] */
    const double length = tic_distance(300 * pixel, 300, 60) / pixel;
    const double end = fmax(left + l->panel_width - 8, x + 60 + length); /* beside the arrows */
    for (int d = 0; d < 3; d++) {
        const double arrow[2] = {26 * c->camera.right[d], 26 * c->camera.up[d]};
        if (hypot(arrow[0], arrow[1]) < 2) continue;
        fprintf(
            to,
            "set arrow from screen %.6g,%.6g to screen %.6g,%.6g size screen 0.006,20 front lw 1.3 lc rgb '#333333'\n"
            "set label %d '%c' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
            x / l->width, y / l->height, (x + arrow[0]) / l->width, (y + arrow[1]) / l->height, 40 + d, 'x' + d,
            (x + 1.45 * arrow[0]) / l->width, (y + 1.45 * arrow[1]) / l->height);
    }
    fprintf(
        to,
        "set arrow from screen %.6g,%.6g to screen %.6g,%.6g heads size screen 0.004,90 front lw 1.3 lc rgb '#333333'\n"
        "set label 43 '%.4g %s' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
        (end - length) / l->width, (y + 10) / l->height, end / l->width, (y + 10) / l->height, length * pixel,
        metre->name, (end - 0.5 * length) / l->width, (y + 22) / l->height);
}

/* Draws panel number `place`, counted row by row from 0: the map `map` of the particles c of one frame, with axes and
 * title. second: unit of the time in the title; lowest: true if no panel is below this one, so that its horizontal axis
 * has labels. */
static void plot_maps_draw_panel(FILE *to, const struct layout *l, const struct view *view,
                                 const struct plotted_particles *c, enum map map, const struct unit *second, int place,
                                 bool lowest)
{
    int column = place % l->columns, row = place / l->columns;
    double from[2], step[2], largest = 0;
    int size[2] = {l->panel_width, l->panel_height};
    for (int k = 0; k < 2; k++) largest = fmax(largest, fmax(fabs(view->from[k]), fabs(view->to[k])));
    struct unit metre = unit_for_length(largest);
    const double left = l->left + column * (l->panel_width + l->gap),
                 above = l->above + row * (l->panel_height + GAP_Y);
    panel_write_margins(to, l, left, above);
    for (int k = 0; k < 2; k++) {
        from[k] = view->from[k] / metre.factor;
        step[k] = (view->to[k] - view->from[k]) / metre.factor / size[k];
        fprintf(to, "set %crange [%.12g:%.12g]\n", 'x' + k, from[k], view->to[k] / metre.factor);
    }
    fputs("set title '", to);
    if (c->equilibrium)
        fputs(c->t > 0 ? "equilibrium" : "without loads", to);
    else if (c->in_steps)
        fprintf(to, "load step %lld", (long long)c->step);
    else
        fprintf(to, "t = %.3g %s", c->t / second->factor, second->name);
    fputs("' font ',13' offset 0,-0.5\n", to);
    if (c->position[2])
        fputs("unset xtics\nunset ytics\nunset xlabel\nunset ylabel\nset border 0\nunset arrow\n", to);
    else
        panel_write_axes(to, l, view, c, &metre, column, lowest);
    if (c->position[2] && row == l->rows - 1 && column == 0)
        panel_write_axis_arrows(to, l, view, c, &metre, left, above);
    const double fine = picture_size_get().dpi / PICTURE_DPI;
    const int fines[2] = {(int)fmax(lround(fine * size[0]), 1), (int)fmax(lround(fine * size[1]), 1)};
    for (int k = 0; k < 2; k++) step[k] *= (double)size[k] / fines[k];
    struct colour *pixel = NEW("plot.pixel", (int64_t)fines[0] * fines[1], struct colour);
    raster_paint_particles(pixel, fines[0], fines[1], view, c, map);
    panel_write_image(to, pixel, fines[0], fines[1], from, step, "");
    memory_free(pixel);
}

/* Scale of the colour bar: label, ends and distance of tics in the unit of the label. */
struct bar_scale {
    char label[64];
    double low, high, tics;
};

static struct bar_scale bar_scale_of(const struct view *view, enum map map)
{
    struct bar_scale s = {.high = view->top, .tics = view->top > 0.6 ? 0.2 : 0.1};
    snprintf(s.label, sizeof s.label, "%s", map == MAP_KIND ? "peridynamic damage" : "damage");
    if (map != MAP_FIELD) return s;
    const struct unit u = unit_for_largest_value(fmax(fabs(view->low), fabs(view->high)), view->field->unit);
    const bool plain = !*view->field->unit;
    s.low = view->low / (plain ? 1 : u.factor), s.high = view->high / (plain ? 1 : u.factor);
    s.tics = tic_distance(s.high - s.low, 300, 50);
    plot_field_label(s.label, sizeof s.label, view->field);
    const size_t length = strlen(s.label);
    if (!plain) snprintf(s.label + length, sizeof s.label - length, " [%s]", u.name);
    return s;
}

/* Prints at the ends of the colour bar which share of the particles has values beyond them. particles: number of
 * particles of a frame; height: height of the bar [pixel]. */
static void draw_beyond(FILE *to, const struct layout *l, const struct view *view, int64_t particles, int height)
{
    for (int end = 0; end < 2; end++) {
        const double y = end ? l->above - 12 : l->above + height + 14,
                     share = 100.0 * (double)view->beyond[end] / (double)particles;
        if (view->beyond[end] > 0)
            fprintf(to, "set label '%.2g %% %s' at screen %.6g,%.6g left font ',10' textcolor rgb '#555555'\n", share,
                    end ? "above" : "below", (double)(l->width - l->right + BAR_FROM - 6) / l->width,
                    1 - y / l->height);
    }
}

/* Returns the height of the colour bar [pixel]. It is the height of the panels, but at most 360 pixels, and at least
 * the length of the bar's label if the picture is high enough. letters: number of letters of the label. */
static int bar_height(const struct layout *l, size_t letters)
{
    const int panels = l->rows * l->panel_height + (l->rows - 1) * GAP_Y, room = l->height - l->above - 40;
    const int label = (int)fmin((gnuplot_is_narrow() ? 7.4 : 9) * (double)letters, room);
    return panels < 360 ? (panels > label ? panels : label) : 360;
}

/* Writes the label of the colour bar, and its unit in a second line if the label is higher than the bar. x, y: centre
 * of the first line, from the upper left corner of the picture; height: of the bar [pixel]. */
static void draw_bar_label(FILE *to, const struct layout *l, const char *label, double x, double y, int height)
{
    const double letter = gnuplot_is_narrow() ? 7.4 : 9;
    const char *unit = letter * (double)strlen(label) > height ? strstr(label, " [") : NULL;
    const size_t length = unit ? (size_t)(unit - label) : strlen(label);
    for (int line = 0; line < (unit ? 2 : 1); line++)
        fprintf(to, "set label '%.*s' at screen %.6g,%.6g center rotate by 90 textcolor rgb '#333333'\n",
                line ? (int)strlen(unit + 1) : (int)length, line ? unit + 1 : label,
                (x + letter * (2 * line - 0.2 * !!unit)) / l->width, 1 - y / l->height);
}

/* Draws the colour bar as a narrow panel on the right beside the first row of panels. particles: number of particles of
 * a frame, from which the shares beyond the ends of the bar are computed, which are printed there. */
static void plot_maps_draw_bar(FILE *to, const struct layout *l, const struct view *view, enum map map,
                               int64_t particles)
{
    struct colour pixel[BAR_STEPS * BAR_COLUMNS];
    const struct bar_scale scale = bar_scale_of(view, map);
    double from[2] = {0, scale.low}, step[2] = {1.0 / BAR_COLUMNS, (scale.high - scale.low) / BAR_STEPS};
    for (int k = 0; k < BAR_STEPS * BAR_COLUMNS; k++)
        pixel[k] = map_colour(view, map, (k / BAR_COLUMNS + 0.5) / BAR_STEPS);
    const int shown = bar_height(l, strcspn(scale.label, "["));
    const double tics = fmax(scale.tics, tic_distance(scale.high - scale.low, shown, gnuplot_is_narrow() ? 22 : 28));
    const char *format = map == MAP_FIELD ? "%g" : "%.1f";
    const double beside = l->width - l->right + BAR_FROM + BAR_WIDTH + 26;
    set_box(to, l, l->width - l->right + BAR_FROM, l->above, BAR_WIDTH, shown);
    fprintf(to,
            "unset arrow\nunset title\nunset xlabel\nunset ylabel\nunset xtics\nunset ytics\nset border 15\n"
            "unset grid\nunset label\n"
            "set xrange [0:1]\nset yrange [%.9g:%.9g]\nset y2range [%.9g:%.9g]\nset y2tics out %.9g format '%s'\n",
            scale.low, scale.high, scale.low, scale.high, tics, format);
    draw_bar_label(to, l, scale.label, beside + numbers_width(scale.low, scale.high, tics, format),
                   l->above + 0.5 * shown, shown);
    if (map == MAP_FIELD) draw_beyond(to, l, view, particles, shown);
    panel_write_image(to, pixel, BAR_COLUMNS, BAR_STEPS, from, step, "");
}

/* Draws an entry of the key: a square in colour c, unless c is transparent, and its text. x, y: position from the upper
 * left corner of the picture [pixel]. */
static void key_entry(FILE *to, const struct layout *l, double x, double y, struct colour c, const char *text)
{
    if (c.alpha > 0)
        fprintf(to,
                "set object rectangle from screen %.6g,%.6g to screen %.6g,%.6g fs solid border rgb '#888888' "
                "fc rgb '#%02x%02x%02x'\n",
                x / l->width, 1 - (y + 6) / l->height, (x + 14) / l->width, 1 - (y - 8) / l->height, c.red, c.green,
                c.blue);
    fputs("set label ", to);
    gnuplot_quote(to, text);
    fprintf(to, " at screen %.6g,%.6g left font ',12' textcolor rgb '#333333'\n", (x + 21) / l->width,
            1 - (y - 1) / l->height);
}

/* Draws the key above the panels: the two kinds of particles, or for MAP_FRAGMENT the heaviest fragment and particles
 * without bonds. */
static void draw_key(FILE *to, const struct layout *l, enum map map)
{
    const bool narrow = gnuplot_is_narrow();
    const struct category entry[2][2] = {
        {{colour_of_material_points(), "material points"}, {colour_of_peridynamic_particle(0.25), "peridynamics"}},
        {{fragment_colour(0), "the heaviest"}, {fragment_colour(-1), "no bond left"}}};
    for (int k = 0; k < 2; k++) {
        const struct category *e = &entry[map == MAP_FRAGMENT][k];
        key_entry(to, l, (narrow ? 20 : l->width - RIGHT - 320) + 160 * k, narrow ? ABOVE_NARROW - 20 : 26, e->colour,
                  e->name);
    }
}

/* Draws the entry of rigid bodies in the key: below the colour bar, or at the lower edge of other pictures. */
static void draw_rigid_key(FILE *to, const struct layout *l, const struct view *view, enum map map)
{
    const struct bar_scale scale = bar_scale_of(view, map);
    const double bar = l->above + bar_height(l, strcspn(scale.label, "[")) + 40, lowest = l->height - 12;
    const bool has_bar = map != MAP_FRAGMENT && map != MAP_CATEGORY;
    key_entry(to, l, l->width - l->right + BAR_FROM, has_bar ? fmin(bar, lowest) : l->height - l->below, rigid_colour(),
              "rigid");
}

/* Draws the key k of named values (such as materials) with their colours on the right, in place of the colour bar. */
static void draw_categories(FILE *to, const struct layout *l, const struct categories *k)
{
    const double x = l->width - l->right + BAR_FROM;
    char more[32];
    for (int i = 0; i < k->n; i++) key_entry(to, l, x, l->above + 8 + KEY_LINE * i, k->of[i].colour, k->of[i].name);
    snprintf(more, sizeof more, "and %d more", k->more);
    if (k->more > 0) key_entry(to, l, x, l->above + 8 + KEY_LINE * k->n, (struct colour){0}, more);
}

/* Returns a layout in which only the margins of the panels are set. The right margin has space for the colour bar or
 * for the key of named values. outside: true for a view of a 3D body from outside, whose axes are drawn in the lower
 * margin. */
static struct layout margins_of(const struct view *view, enum map map, bool outside)
{
    const bool narrow = gnuplot_is_narrow(), key = map == MAP_KIND || map == MAP_FRAGMENT;
    struct layout l = {.left = LEFT, .above = ABOVE, .below = BELOW, .right = RIGHT, .gap = GAP_X};
    if (narrow)
        l = (struct layout){.left = LEFT_NARROW,
                            .above = ABOVE_NARROW + (key ? KEY_NARROW : 0),
                            .below = BELOW_NARROW + (outside ? AXES_NARROW : 0),
                            .right = RIGHT_NARROW,
                            .gap = GAP_NARROW};
    size_t longest = 12; /* `and 120 more` */
    for (int k = 0; map == MAP_CATEGORY && k < view->categories->n; k++) {
        const size_t length = strlen(view->categories->of[k].name);
        if (length > longest) longest = length;
    }
    if (map == MAP_CATEGORY) l.right = (int)fmin(fmax(l.right, BAR_FROM + 30 + 9 * (double)longest), RIGHT_MAX);
    return l;
}

/* Draws the title and, unless it is 0, the number `outside` of particles outside the shown rectangle. */
static void draw_title(const struct gnuplot *g, const struct layout *l, const char *title, int64_t outside)
{
    char text[TITLE_LENGTH + 64];
    int length = snprintf(text, sizeof text, "%s", title);
    if (outside > 0)
        snprintf(text + length, sizeof text - (size_t)length, " (%lld particle%s outside the picture)",
                 (long long)outside, outside > 1 ? "s are" : " is");
    gnuplot_write_title(g, text, l->left);
}

status maps_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct plotted_particles *cloud, int clouds)
{
    struct gnuplot g;
    const double aspect = (view->to[1] - view->from[1]) / (view->to[0] - view->from[0]);
    const struct layout margins = margins_of(view, map, cloud[0].position[2]);
    const struct layout l = layout_choose(clouds, aspect, &margins);
    TRY(gnuplot_open(&g, sheet.path, sheet.format, l.width, l.height));
    fputs("set multiplot\nunset grid\n", g.to);
    draw_title(&g, &l, title, view->outside);
    if (map == MAP_KIND || map == MAP_FRAGMENT) draw_key(g.to, &l, map);
    if (map == MAP_CATEGORY) draw_categories(g.to, &l, view->categories);
    bool rigid = false;
    for (int k = 0; k < clouds; k++) rigid = rigid || rigids_are_visible(view, &cloud[k]);
    if (rigid) draw_rigid_key(g.to, &l, view, map);
    struct unit second = unit_for_largest_value(cloud[clouds - 1].t, "s");
    for (int k = 0; k < clouds; k++) {
        plot_maps_draw_panel(g.to, &l, view, &cloud[k], map, &second, k, k + l.columns >= clouds);
        fputs("unset label\nunset object\n", g.to); /* drawn once for all panels */
    }
    if (map != MAP_FRAGMENT && map != MAP_CATEGORY) plot_maps_draw_bar(g.to, &l, view, map, cloud[clouds - 1].n);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}
