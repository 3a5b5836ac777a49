/* Layout of pictures of curves: margins, panels one above another, the key. */
#include <math.h>
#include <string.h>

#include "curves_parts.h"

/* Margins of a picture as wide as a text page, and of a narrower one [pixel]. */
enum { LEFT = 100, RIGHT = 24, AXIS = 100, ABOVE = 60, BELOW = 74 };
enum { LEFT_NARROW = 80, RIGHT_NARROW = 18, AXIS_NARROW = 80, ABOVE_NARROW = 42, BELOW_NARROW = 52, UNTITLED = 18 };

/* Sizes in a picture of curves [pixel]. sample: width of an entry of the key without its text; letter: mean width of a
 * letter; row: distance of the lines of the key; tics: least distance of tics of a vertical axis; lower: least height
 * of the lower one of two panels. WIDE: for a picture as wide as a text page; NARROW: for a narrower one. */
static const struct sizes {
    double sample, letter, row, tics, lower;
} WIDE = {58, 9, 24, 30, 96}, NARROW = {48, 7.4, 20, 24, 68};

static const struct sizes *sizes_now(void) { return picture_is_too_narrow_for_key() ? &NARROW : &WIDE; }

struct curves_layout curves_layout_make(const struct gnuplot *g, int entries, size_t longest, bool second_axis)
{
    const bool narrow = picture_is_too_narrow_for_key();
    struct curves_layout l = {.width = g->width,
                              .height = g->height,
                              .left = narrow ? LEFT_NARROW : LEFT,
                              .above = narrow ? ABOVE_NARROW : ABOVE,
                              .below = narrow ? BELOW_NARROW : BELOW};
    if (g->untitled) l.above = UNTITLED;
    const struct sizes *of = sizes_now();
    const double entry = of->sample + of->letter * (double)longest;
    l.key_below = entries > 0 && (narrow || second_axis);
    l.right = second_axis ? (narrow ? AXIS_NARROW : AXIS) : narrow ? RIGHT_NARROW : RIGHT;
    if (entries > 0 && !l.key_below) l.right = fmin(entry, 0.5 * l.width);
    l.key_columns = (int)fmax(fmin(floor((l.width - l.left - RIGHT_NARROW) / entry), entries), 1);
    l.key_lines = (entries + l.key_columns - 1) / l.key_columns;
    if (l.key_below) l.below += of->row * l.key_lines;
    return l;
}

double curves_layout_inner_height(const struct curves_layout *l) { return l->height - l->above - l->below; }

void curves_write_panel(FILE *to, const struct curves_layout *l, double from, double end)
{
    fprintf(to,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
            "set bmargin at screen %.5f\n",
            l->left / l->width, 1 - l->right / l->width, 1 - (l->above + from) / l->height,
            1 - (l->above + end) / l->height);
}

void curves_write_key(FILE *to, const struct curves_layout *l)
{
    if (l->key_below)
        fprintf(to, "set key at screen %.5f,%.5f left top horizontal maxcols %d maxrows %d\n",
                (picture_is_too_narrow_for_key() ? 10 : l->left) / l->width,
                (sizes_now()->row * l->key_lines + 4.0) / l->height, l->key_columns, l->key_lines);
    else
        fprintf(to, "set key at screen %.5f,%.5f left top\n", 1 - (l->right - 12) / l->width,
                1 - (l->above + 2) / l->height);
}

void curves_write_margins(FILE *to, const struct curves_layout *l)
{
    curves_write_panel(to, l, 0, curves_layout_inner_height(l));
    curves_write_key(to, l);
}

struct two_panels curves_two_panels(const struct curves_layout *l)
{
    const double inner = curves_layout_inner_height(l),
                 low = fmin(fmax(0.22 * inner, sizes_now()->lower), 0.33 * inner);
    return (struct two_panels){inner - low - PANEL_GAP, inner - low, inner};
}

void curves_write_title(struct gnuplot *g, const char *title, const char *quantity)
{
    char text[512];
    const size_t length = strlen(title);
    snprintf(text, sizeof text, "%s%s", title, length > 0 && title[length - 1] == ' ' ? quantity : "");
    gnuplot_write_title(g, text, picture_is_too_narrow_for_key() ? LEFT_NARROW : LEFT);
}

double tic_distance(double range, double pixels, double least_distance)
{
    const double least = range * fmax(least_distance, pixels / 10) / pixels, decade = pow(10, floor(log10(least)));
    const double lead = least / decade;
    return decade * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

void curves_write_tics(FILE *to, const char *axis, double low, double high, double pixels)
{
    if (high > low) fprintf(to, "set %stics %.9g\n", axis, tic_distance(high - low, pixels, sizes_now()->tics));
}
