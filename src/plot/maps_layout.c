/* Computes the layout of pictures of maps: margins, rows and columns of panels, positions of the colour bar and of the
 * key (legend). */
#include <math.h>
#include <string.h>

#include "curves_parts.h"
#include "maps_parts.h"

/* Margins of the panels and gaps between them [pixel]. *_NARROW: in narrow pictures; *_OUTSIDE: for views of a body
 * from outside, whose panels have no axis on the left, and the directions of the axes below; *_UNTITLED: without a
 * title; EDGE: right margin without colour bar or key (legend); RIGHT_MOST: right margin with a key of long names;
 * BETWEEN_NUMBERS: blank between the numbers at the axes of neighbouring columns. */
enum { LEFT = 104, LEFT_OUTSIDE = 40, RIGHT = 136, RIGHT_MOST = 420, EDGE = 34, ABOVE = 84, UNTITLED = 56, BELOW = 70 };
enum { GAP_X = 34, GAP_NARROW = 26 };
enum { LEFT_NARROW = 74, LEFT_OUTSIDE_NARROW = 14, EDGE_NARROW = 22, ABOVE_NARROW = 62, UNTITLED_NARROW = 40 };
enum { BETWEEN_NUMBERS = 16 };
enum { BELOW_NARROW = 62, BELOW_OUTSIDE_NARROW = 78 };

/* Default sizes of the whole picture and least size of a panel [pixel]. They are chosen such that the letters of a
 * picture as wide as a text page have the size of the text. */
enum { WIDTH = 1280, WIDTH_SINGLE = 1000, HEIGHT_MAX = 1180, PANEL_MIN = 24 };
static const double SHAPE_WANTED = 0.72;  /* height of the picture divided by its width */
static const double TALL_MOST = 1.5;      /* the same of a narrow picture of which the width alone is given */
enum { PAGE_HEIGHT = 1300 };              /* of such a picture whose panels do not fit into this: 230 mm [pixel] */
enum { BAR_UNDER_LEAST = 120 };           /* least length of a colour bar below the panels [pixel] */
enum { PANEL_TITLE = 11 };                /* letters of the title of a panel, as `t = 12.3 µs` */
static const double DOES_NOT_FIT = 1e3;   /* more than any other cost of a layout */
static const double BESIDE_BETTER = 0.03; /* a bar below must make panels larger by 6 % of their area */

bool map_quantity_has_colour_bar(enum map map) { return map != MAP_FRAGMENT && map != MAP_CATEGORY; }

/* Returns a layout for the maps m in which only the margins of the panels are set: above for the title, left for the
 * axis, and right for the colour bar or the key (legend), and the gap between columns of panels. The lower margin is
 * set by strip_set. under: true if the colour bar, or the key of a map of named values, is below the panels; before:
 * layout with the size of the panels, on which the widths of numbers and of the bar depend, or NULL if it is not known
 * yet. */
static struct maps_layout margins_of(const struct maps_content *m, bool under, const struct maps_layout *before)
{
    const int panels = before ? before->rows * before->panel_height + (before->rows - 1) * GAP_Y : 0;
    const bool narrow = picture_size_is_too_narrow_for_side_legend(), bar = map_quantity_has_colour_bar(m->map),
               titled = m->title[0];
    const double letter = narrow ? KEY_LETTER_NARROW : KEY_LETTER;
    size_t longest = 0;
    for (int k = 0; k < m->key.n; k++)
        longest = strlen(m->key.of[k].name) > longest ? strlen(m->key.of[k].name) : longest;
    struct maps_layout l = {.left = m->outside ? LEFT_OUTSIDE : LEFT,
                            .above = titled ? ABOVE : UNTITLED,
                            .axes = BELOW,
                            .right = bar ? (int)fmax(RIGHT, colour_bar_width_beside_panels(m, panels)) : EDGE,
                            .gap = GAP_X};
    if (narrow)
        l = (struct maps_layout){.left = m->outside ? LEFT_OUTSIDE_NARROW : LEFT_NARROW,
                                 .above = titled ? ABOVE_NARROW : UNTITLED_NARROW,
                                 .axes = m->outside ? BELOW_OUTSIDE_NARROW : BELOW_NARROW,
                                 .right = under || !bar ? EDGE_NARROW : colour_bar_width_beside_panels(m, panels),
                                 .gap = GAP_NARROW};
    if (before) l.gap = (int)fmax(l.gap, PANEL_TITLE * letter - before->panel_width);
    if (before && !m->outside) {
        l.left = (int)fmax(l.left, panel_vertical_axis_labels_width(m->view, before->panel_height));
        l.gap = (int)fmax(l.gap,
                          panel_horizontal_axis_longest_number_width(m->view, before->panel_width) + BETWEEN_NUMBERS);
    }
    l.title = l.left;
    l.entry = (int)(KEY_SQUARE + letter * (double)longest);
    l.bar_under = bar && under;
    l.least = bar && !under ? colour_bar_least_height(m) : 0;
    l.key_beside = m->map == MAP_CATEGORY && !under;
    l.entries = l.key_beside ? 0 : m->key.n;
    if (l.key_beside) l.right = (int)fmin(l.entry + BAR_FROM, RIGHT_MOST);
    return l;
}

/* Computes in l the number of entries in a row of the key (legend) below the panels, for a picture of the given width
 * [pixel], and from it the margin below the panels, in which the axis labels, the colour bar and the key are. */
static void strip_set(struct maps_layout *l, int width)
{
    l->key_columns = (int)fmax((width - KEY_LEFT) / fmax(l->entry, 1), 1);
    const int lines = (l->entries + l->key_columns - 1) / l->key_columns;
    l->below = l->axes + (l->bar_under ? BAR_STRIP : 0) + (lines > 0 ? lines * KEY_ROW + KEY_UNDER : 0);
}

/* Returns the largest height of a picture [pixel]: the height that the user has chosen, if any. If only a width is
 * chosen, it is that of a page if `tall` is true, else at most TALL_MOST times the width. */
static double height_most(bool tall)
{
    const struct picture_size given = picture_size_get_process_wide();
    if (given.height || !given.width) return given.height ? given.height : HEIGHT_MAX;
    return tall ? PAGE_HEIGHT : fmin(HEIGHT_MAX, TALL_MOST * given.width);
}

/* Returns true if the panels of layout l fit into a picture of the size that the user has chosen, with their titles
 * beside one another and beside the colour bar, which is not too short below them. more: width of the picture beyond
 * what the layout needs [pixel]; height: largest height of the picture [pixel]. */
static bool panels_fit(const struct maps_layout *l, int more, double height)
{
    const double letter = picture_size_is_too_narrow_for_side_legend() ? KEY_LETTER_NARROW : KEY_LETTER;
    return more >= 0 && l->above + l->below + (l->rows - 1) * GAP_Y + l->rows * l->panel_height <= height + 1 &&
           (!l->bar_under || l->width - l->left - l->right >= BAR_UNDER_LEAST) &&
           l->panel_width + (l->columns == 1 ? 2 * BAR_FROM_NARROW : l->gap) >= PANEL_TITLE * letter;
}

/* Returns the layout of a picture with the given numbers of columns and of panels. aspect: height of a panel divided by
 * its width; height: largest height of the picture [pixel]; margins: layout with the margins of the panels. */
static struct maps_layout layout_of(int columns, int panels, double aspect, double height,
                                    const struct maps_layout *margins)
{
    struct maps_layout l = *margins;
    l.columns = columns, l.rows = (panels + columns - 1) / columns;
    const struct picture_size given = picture_size_get_process_wide();
    const int width = given.width ? given.width : panels == 1 ? WIDTH_SINGLE : WIDTH;
    const int between_x = (columns - 1) * l.gap, between_y = (l.rows - 1) * GAP_Y;
    strip_set(&l, width);
    double panel = fmax((width - l.left - l.right - between_x) / columns, PANEL_MIN);
    panel = fmin(panel, fmax((height - l.above - l.below - between_y) / l.rows, PANEL_MIN) / aspect);
    l.panel_width = (int)fmax(lround(panel), PANEL_MIN);
    l.panel_height = (int)fmax(lround(panel * aspect), PANEL_MIN);
    l.width = l.left + l.right + between_x + columns * l.panel_width;
    const int more = given.width ? given.width - l.width : 0;
    if (given.width) l.width = given.width, l.left += more / 2, l.right += more - more / 2; /* centred */
    l.spare = more;
    strip_set(&l, l.width);
    l.fits = panels_fit(&l, more, height);
    const int panels_end = between_y + l.rows * l.panel_height;
    l.height = given.height ? given.height : l.above + (int)fmax(l.below + panels_end, l.least);
    return l;
}

/* Returns the layout of a picture of the maps m in `panels` panels and `columns` columns. It is computed twice, because
 * the width of a colour bar on the right depends on the height of the panels: beside low panels its unit needs a second
 * line. under: the colour bar or key is below the panels; aspect: height of a panel divided by its width; height:
 * largest height of the picture [pixel]. */
static struct maps_layout layout_settled(const struct maps_content *m, bool under, int columns, int panels,
                                         double aspect, double height)
{
    struct maps_layout margins = margins_of(m, under, NULL), l = layout_of(columns, panels, aspect, height, &margins);
    margins = margins_of(m, under, &l);
    return layout_of(columns, panels, aspect, height, &margins);
}

/* Returns the best layout of panel_count panels of the maps `shown`, at most `height` [pixel] high. It is the layout,
 * over all numbers of columns, with the smallest cost: large panels, a good ratio of height to width and few empty
 * panels are wanted, and a layout whose panels do not fit is chosen only if no other does. height_over_width: ratio for
 * a panel. */
static struct maps_layout layout_best(const struct maps_content *shown, int panel_count, double height_over_width,
                                      double height)
{
    const bool choice = picture_size_is_too_narrow_for_side_legend() &&
                        (map_quantity_has_colour_bar(shown->map) || shown->map == MAP_CATEGORY);
    const bool fixed = picture_size_get_process_wide().height ||
                       picture_size_is_too_narrow_for_side_legend(); /* columns of journals may be tall */
    struct maps_layout best = {0};
    double best_cost = INFINITY;
    for (int under = 0; under < 1 + choice; under++)
        for (int columns = 1; columns <= panel_count; columns++) {
            const struct maps_layout l = layout_settled(shown, under, columns, panel_count, height_over_width, height);
            const double area = (double)l.panel_width * l.panel_height;
            const double tall = log((double)l.height / l.width / SHAPE_WANTED);
            const double shape = fixed ? 0 : picture_size_get_process_wide().width ? fmax(tall, 0) : fabs(tall);
            double cost = shape - 0.5 * log(area) + under * BESIDE_BETTER + (fixed ? (double)l.spare / l.width : 0);
            cost += 0.2 * (l.rows * l.columns - panel_count); /* empty panels */
            cost += l.fits ? 0 : DOES_NOT_FIT;
            if (cost >= best_cost) continue;
            best_cost = cost;
            best = l;
        }
    return best;
}

struct maps_layout maps_layout_choose(const struct maps_content *shown, int panel_count, double height_over_width)
{
    const struct maps_layout l = layout_best(shown, panel_count, height_over_width, height_most(false));
    return l.fits ? l : layout_best(shown, panel_count, height_over_width, height_most(true));
}

status maps_layout_check_panels_fit(const struct maps_content *shown, int panel_count, double height_over_width)
{
    int fit = panel_count;
    if (!picture_size_get_process_wide().width) return OK;
    while (fit > 1 && !maps_layout_choose(shown, fit, height_over_width).fits) fit--;
    if (fit == panel_count || panel_count == 1) return OK;
    return status_set(REFUSED,
                      "plot: --size: %d panels do not fit into a picture of this size, %d do; choose fewer frames "
                      "(--frames) or a larger size",
                      panel_count, fit);
}
