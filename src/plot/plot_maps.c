/* Damage and kind maps: panels, colour bar, titles. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "plot/plot.h"

/* Room round the panels [pixel]. */
enum { LEFT = 92, RIGHT = 122, ABOVE = 84, BELOW = 70, GAP_X = 26, GAP_Y = 42 };
/* Least distance of tics: the width and twice the height of their numbers [pixel]. */
enum { TICS_X = 50, TICS_Y = 36 };
/* The colour bar; its image is two pixels wide because gnuplot draws none of a single one. */
enum { BAR_FROM = 26, BAR_WIDTH = 16, BAR_STEPS = 256, BAR_COLUMNS = 2 };
/* Size of the whole picture [pixel]; a single panel needs less. */
enum { WIDTH = 1640, WIDTH_SINGLE = 1180, HEIGHT_MAX = 1500, PANEL_MIN = 24 };
static const double SHAPE_WANTED = 0.72;             /* height over width of the picture */

struct layout {
    int columns, rows;
    int panel_width, panel_height;       /* [pixel] */
    int width, height;
};

/* Layout with this number of columns; aspect: height over width of a panel. */
static struct layout layout_of(int columns, int panels, double aspect)
{
    struct layout l = {.columns = columns, .rows = (panels + columns - 1) / columns};
    int width = panels == 1 ? WIDTH_SINGLE : WIDTH;
    int between_x = (columns - 1) * GAP_X, between_y = (l.rows - 1) * GAP_Y;
    double panel = fmax((width - LEFT - RIGHT - between_x) / columns, PANEL_MIN);
    double highest = fmax((HEIGHT_MAX - ABOVE - BELOW - between_y) / l.rows, PANEL_MIN);
    panel = fmin(panel, highest / aspect);
    l.panel_width = (int)fmax(lround(panel), PANEL_MIN);
    l.panel_height = (int)fmax(lround(panel * aspect), PANEL_MIN);
    l.width = LEFT + RIGHT + between_x + columns * l.panel_width;
    l.height = ABOVE + BELOW + between_y + l.rows * l.panel_height;
    return l;
}

/* The arrangement with the largest panels among those not far from the wanted shape. */
static struct layout layout_choose(int panels, double aspect)
{
    struct layout best = layout_of(1, panels, aspect);
    double best_cost = INFINITY;
    for (int columns = 1; columns <= panels; columns++) {
        struct layout l = layout_of(columns, panels, aspect);
        double area = (double)l.panel_width * l.panel_height;
        double cost = fabs(log((double)l.height / l.width / SHAPE_WANTED)) - 0.5 * log(area);
        cost += 0.2 * (l.rows * l.columns - panels);             /* empty places */
        if (cost >= best_cost) continue;
        best_cost = cost;
        best = l;
    }
    return best;
}

/* Margins of a box given in pixels from the upper left corner. */
static void set_box(FILE *to, const struct layout *l, double left, double above, double width, double height)
{
    fprintf(to, "set lmargin at screen %.9g\nset rmargin at screen %.9g\n", left / l->width, (left + width) / l->width);
    fprintf(to, "set tmargin at screen %.9g\nset bmargin at screen %.9g\n", 1 - above / l->height,
            1 - (above + height) / l->height);
}

/* A round distance of tics over `range`: at least `apart` pixels, and about ten tics at most. */
static double plot_maps_tic_distance(double range, int pixels, int apart)
{
    double least = range * fmax(apart, pixels / 10.0) / pixels, decade = pow(10, floor(log10(least)));
    double lead = least / decade;
    return decade * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

/* Plots an image whose lower left corner is `from`, with pixels of size `step`. */
static void send_image(FILE *to, const struct colour *pixel, int width, int height, const double *from,
                       const double *step)
{
    fprintf(to, "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,%.12g) format='%%uchar' "
                "with rgbalpha notitle\n",
            width, height, step[0], step[1], from[0] + 0.5 * step[0], from[1] + 0.5 * step[1]);
    fwrite(pixel, sizeof *pixel, (size_t)width * (size_t)height, to);
}

/* Draws the panel at a place of the grid of panels; `second`: unit of time of all panels; `lowest`: no panel below. */
/* Pre-cracks as thin lines over the next panel: slits of a mesh have no damage that would show them. */
static void draw_notches(FILE *to, const struct view *view, double metre)
{
    fputs("unset arrow\n", to);
    for (int k = 0; k < view->notches; k++) {
        const struct crack *c = &view->notch[k];
        if (c->n != 2) continue;
        fprintf(to, "set arrow from %.9g,%.9g to %.9g,%.9g nohead front lw 1.2 lc rgb '#7a1020'\n",
                c->corner[0][0] / metre, c->corner[0][1] / metre, c->corner[1][0] / metre, c->corner[1][1] / metre);
    }
}

static void plot_maps_draw_panel(FILE *to, const struct layout *l, const struct view *view, const struct cloud *c,
                                 enum map map, const struct unit *second, int place, bool lowest)
{
    int column = place % l->columns, row = place / l->columns;
    double from[2], step[2], largest = 0;
    int size[2] = {l->panel_width, l->panel_height};
    for (int k = 0; k < 2; k++) largest = fmax(largest, fmax(fabs(view->from[k]), fabs(view->to[k])));
    struct unit metre = unit_for_length(largest);
    set_box(to, l, LEFT + column * (l->panel_width + GAP_X), ABOVE + row * (l->panel_height + GAP_Y), l->panel_width,
            l->panel_height);
    for (int k = 0; k < 2; k++) {
        from[k] = view->from[k] / metre.factor;
        step[k] = (view->to[k] - view->from[k]) / metre.factor / size[k];
        fprintf(to, "set %crange [%.12g:%.12g]\n", 'x' + k, from[k], view->to[k] / metre.factor);
        bool labelled = k == 0 ? lowest : column == 0;
        double range = view->to[k] / metre.factor - from[k];
        fprintf(to, "set %ctics %.9g format '%s'\n", 'x' + k,
                plot_maps_tic_distance(range, size[k], k == 0 ? TICS_X : TICS_Y), labelled ? "%g" : "");
        fprintf(to, "set %clabel '", 'x' + k);
        if (labelled) fprintf(to, "%c [%s]", 'x' + c->axis[k], metre.name);
        fputs("'\n", to);
    }
    fprintf(to, "set title 't = %.3g %s' font ',13' offset 0,-0.5\n", c->t / second->factor, second->name);
    if (map == MAP_DAMAGE) draw_notches(to, view, metre.factor);
    struct colour *pixel = NEW("plot.pixel", (int64_t)size[0] * size[1], struct colour);
    raster_paint(pixel, size[0], size[1], view, c, map);
    send_image(to, pixel, size[0], size[1], from, step);
    memory_free(pixel);
}

/* Colours of damage as a narrow panel on the right, at most a panel's height, beside the first row. */
static void plot_maps_draw_bar(FILE *to, const struct layout *l, const struct view *view, enum map map)
{
    struct colour pixel[BAR_STEPS * BAR_COLUMNS];
    double from[2] = {0, 0}, step[2] = {1.0 / BAR_COLUMNS, view->top / BAR_STEPS};
    int height = l->rows * l->panel_height + (l->rows - 1) * GAP_Y;
    for (int k = 0; k < BAR_STEPS * BAR_COLUMNS; k++)
        pixel[k] = map_colour(map, KIND_PD, (k / BAR_COLUMNS + 0.5) * step[1], view->top);
    int shown = height < 360 ? height : 360;
    set_box(to, l, l->width - RIGHT + BAR_FROM, ABOVE, BAR_WIDTH, shown);
    fprintf(to, "unset arrow\nunset title\nunset xlabel\nunset ylabel\nunset xtics\nunset ytics\nset border 15\n"
                "unset grid\n"
                "set xrange [0:1]\nset yrange [0:%.9g]\nset y2range [0:%.9g]\nset y2tics out %.9g format '%%.1f'\n"
                "set y2label '%s' offset -1,0\n",
            view->top, view->top, view->top > 0.6 ? 0.2 : 0.1, map == MAP_KIND ? "peridynamic damage" : "damage");
    send_image(to, pixel, BAR_COLUMNS, BAR_STEPS, from, step);
}

/* What colours mean, above the panels: the two kinds of particles, or fragments. */
static void draw_key(FILE *to, const struct layout *l, enum map map)
{
    const struct { struct colour colour; const char *text; } entry[2][2] = {
        {{map_colour(MAP_KIND, KIND_MPM, 0.25, 1), "material points"},
         {map_colour(MAP_KIND, KIND_PD, 0.25, 1), "peridynamics"}},
        {{fragment_colour(0), "the heaviest"}, {fragment_colour(-1), "no bond left"}}};
    for (int k = 0; k < 2; k++) {
        const struct colour c = entry[map == MAP_FRAGMENT][k].colour;
        double x = l->width - RIGHT - 320 + 160 * k, y = 26;
        fprintf(to, "set object rectangle from screen %.6g,%.6g to screen %.6g,%.6g fs solid border rgb '#888888' "
                    "fc rgb '#%02x%02x%02x'\n", x / l->width, 1 - (y + 6) / l->height, (x + 14) / l->width,
                1 - (y - 8) / l->height, c.red, c.green, c.blue);
        fprintf(to, "set label '%s' at screen %.6g,%.6g left font ',12' textcolor rgb '#333333'\n",
                entry[map == MAP_FRAGMENT][k].text, (x + 21) / l->width, 1 - (y - 1) / l->height);
    }
}

status maps_draw(const char *path, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds)
{
    struct gnuplot g;
    struct layout l = layout_choose(clouds, (view->to[1] - view->from[1]) / (view->to[0] - view->from[0]));
    TRY(gnuplot_open(&g, path, PICTURE_PNG, l.width, l.height));
    fputs("set multiplot\nunset grid\nset label 1 ", g.to);
    gnuplot_quote(g.to, title);
    fprintf(g.to, " at screen %.6g,%.6g left font ',16' textcolor rgb '#111111'\n", (double)LEFT / l.width,
            1 - 26.0 / l.height);
    if (map != MAP_DAMAGE) draw_key(g.to, &l, map);
    struct unit second = unit_for(cloud[clouds - 1].t, "s");
    for (int k = 0; k < clouds; k++) {
        plot_maps_draw_panel(g.to, &l, view, &cloud[k], map, &second, k, k + l.columns >= clouds);
        fputs("unset label\nunset object\n", g.to);  /* drawn once for all panels */
    }
    if (map != MAP_FRAGMENT) plot_maps_draw_bar(g.to, &l, view, map);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}
