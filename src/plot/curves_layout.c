/* Computes the layout of pictures of curves: margins, panels one above another, and the key (legend). */
#include <math.h>
#include <string.h>

#include "curves_parts.h"

/* Margins of a picture as wide as a text page, and of a narrower one [pixel]. */
enum { LEFT = 100, RIGHT = 24, AXIS = 100, ABOVE = 60, BELOW = 74 };
enum { LEFT_NARROW = 80, RIGHT_NARROW = 18, AXIS_NARROW = 80, ABOVE_NARROW = 42, BELOW_NARROW = 60, UNTITLED = 18 };

/* Sizes in a picture of curves [pixel]. sample: width of an entry of the key (legend) without its text; letter: mean
 * width of a letter; row: distance between the lines of the key; tics: least distance between tics of a vertical axis;
 * lower: least height of the lower one of two panels. WIDE: for a picture as wide as a text page; NARROW: for a
 * narrower picture. */
static const struct sizes {
    double sample, letter, row, tics, lower;
} WIDE = {58, 9, 24, 30, 96}, NARROW = {48, 7.4, 20, 24, 68};

static const struct sizes *sizes_now(void) { return picture_size_is_too_narrow_for_side_legend() ? &NARROW : &WIDE; }

double curves_key_height_beside_panel(int entry_count) { return (entry_count + 0.5) * sizes_now()->row; }

/* Returns true if the key (legend) with `entries` entries is no higher than the uppermost of `panels` panels with the
 * layout l: gnuplot breaks a higher one into columns, for which there is no space beside the panels. */
static bool key_fits_beside_panel(const struct curves_layout *l, int entries, int panels)
{
    const double panel = (curves_layout_height_of_all_panels(l) - PANEL_GAP * (panels - 1)) / panels;
    return curves_key_height_beside_panel(entries) <= panel;
}

struct curves_layout curves_layout_make(const struct gnuplot *gnuplot, int key_entry_count, size_t longest_key_entry,
                                        bool has_second_axis, int panel_count)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    struct curves_layout l = {.width = gnuplot->width,
                              .height = gnuplot->height,
                              .left = narrow ? LEFT_NARROW : LEFT,
                              .above = narrow ? ABOVE_NARROW : ABOVE,
                              .below = narrow ? BELOW_NARROW : BELOW};
    if (gnuplot->untitled) l.above = UNTITLED;
    const struct sizes *of = sizes_now();
    const double entry = of->sample + of->letter * (double)longest_key_entry;
    l.key_below =
        key_entry_count > 0 && (narrow || has_second_axis || !key_fits_beside_panel(&l, key_entry_count, panel_count));
    l.right = has_second_axis ? (narrow ? AXIS_NARROW : AXIS) : narrow ? RIGHT_NARROW : RIGHT;
    if (key_entry_count > 0 && !l.key_below) l.right = fmin(entry, 0.5 * l.width);
    l.key_columns = (int)fmax(fmin(floor((l.width - l.left - RIGHT_NARROW) / entry), key_entry_count), 1);
    l.key_lines = (key_entry_count + l.key_columns - 1) / l.key_columns;
    if (l.key_below) l.below += of->row * l.key_lines;
    return l;
}

double curves_layout_height_of_all_panels(const struct curves_layout *l) { return l->height - l->above - l->below; }

void curves_write_panel_margins(FILE *gnuplot, const struct curves_layout *l, double upper_edge, double lower_edge)
{
    fprintf(gnuplot,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
            "set bmargin at screen %.5f\n",
            l->left / l->width, 1 - l->right / l->width, 1 - (l->above + upper_edge) / l->height,
            1 - (l->above + lower_edge) / l->height);
}

void curves_write_key_position(FILE *gnuplot, const struct curves_layout *l)
{
    if (l->key_below)
        fprintf(gnuplot, "set key at screen %.5f,%.5f left top horizontal maxcols %d maxrows %d\n",
                (picture_size_is_too_narrow_for_side_legend() ? 10 : l->left) / l->width,
                (sizes_now()->row * l->key_lines + 4.0) / l->height, l->key_columns, l->key_lines);
    else
        fprintf(gnuplot, "set key at screen %.5f,%.5f left top\n", 1 - (l->right - 12) / l->width,
                1 - (l->above + 2) / l->height);
}

void curves_write_margins_and_key(FILE *gnuplot, const struct curves_layout *l)
{
    curves_write_panel_margins(gnuplot, l, 0, curves_layout_height_of_all_panels(l));
    curves_write_key_position(gnuplot, l);
}

struct two_panel_edges curves_layout_edges_of_two_panels(const struct curves_layout *l)
{
    const double inner = curves_layout_height_of_all_panels(l),
                 low = fmin(fmax(0.22 * inner, sizes_now()->lower), 0.33 * inner);
    return (struct two_panel_edges){inner - low - PANEL_GAP, inner - low, inner};
}

void curves_write_title(struct gnuplot *gnuplot, const char *title, const char *quantity)
{
    char text[512];
    const size_t length = strlen(title);
    snprintf(text, sizeof text, "%s%s", title, length > 0 && title[length - 1] == ' ' ? quantity : "");
    gnuplot_write_title(gnuplot, text, picture_size_is_too_narrow_for_side_legend() ? LEFT_NARROW : LEFT);
}

double axis_choose_tic_distance(double value_extent, double axis_length, double least_distance)
{
    const double least = value_extent * fmax(least_distance, axis_length / 10) / axis_length,
                 decade = pow(10, floor(log10(least)));
    const double lead = least / decade;
    return decade * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

void curves_write_vertical_tics(FILE *gnuplot, const char *vertical_axis, double low, double high, double panel_height)
{
    if (high > low)
        fprintf(gnuplot, "set %stics %.9g\n", vertical_axis,
                axis_choose_tic_distance(high - low, panel_height, sizes_now()->tics));
}

void curves_write_horizontal_tics(FILE *to, const struct curves_layout *l, double low, double high)
{
    const double most = fmax(fabs(low), fabs(high));
    const double letters = 2 + (low < 0) + fmax(floor(log10(most)), 0); /* of the longest number, with a space */
    const double pixels = l->width - l->left - l->right;
    fprintf(to, "set xtics %.9g\n", axis_choose_tic_distance(high - low, pixels, 12 + 11 * letters));
}

void title_append_count_of_particles_outside_view(char *text, const char *title, int64_t outside_count)
{
    int length = snprintf(text, TITLE_LENGTH, "%.*s", TITLE_LENGTH - 64, title);
    if (outside_count > 0)
        snprintf(text + length, TITLE_LENGTH - (size_t)length, "%s(%lld particle%s outside the picture)",
                 length > 0 ? " " : "", (long long)outside_count, outside_count > 1 ? "s are" : " is");
}
