/* Draws the profiles that an EXACT probe writes: a bar beside its closed-form solution. */
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output/history.h"
#include "base/memory.h"
#include "curves_parts.h"

/* PATH_LENGTH: capacity of a path [byte]; QUANTITIES: number of panels, one for each quantity; DIGITS: significant
 * digits of the numbers at axes. */
enum { PATH_LENGTH = 4096, QUANTITIES = 4, DIGITS = 6 };

#define TINT "#e8f1f9" /* background of peridynamic parts of a bar with both kinds */

/* Panels from top to bottom: names of the columns with computed and with exact values in the profiles of the EXACT
 * probe, label and unit. */
static const struct {
    const char *computed, *exact, *label, *unit;
} quantity[QUANTITIES] = {
    {"stress", "exact_stress", "stress", "Pa"},
    {"strain", "exact_strain", "strain", ""},
    {"velocity", "exact_velocity", "velocity x", "m/s"},
    {"damage", NULL, "damage", ""},
};

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Reads into *h the profile, a CSV table of the bar and its closed-form solution, that the probe of kind EXACT
 * (closed-form solution of a bar) called `probe` wrote with frame (output) `number` of the run in `folder`. Returns
 * FAILED, with a message, if the file is missing or cannot be read. Release *h with history_free. */
static status profile_read(struct history *h, const char *folder, const char *probe, int number)
{
    char path[PATH_LENGTH];
    if (snprintf(path, sizeof path, "%s/%s_%06d.csv", folder, probe, number) >= (int)sizeof path)
        return status_set(FAILED, "%s: the name is too long; choose a shorter one", folder);
    return history_read_file(h, path);
}

/* Returns true if `file` in `folder` is the profile of a probe at the first output frame and has the columns of a
 * closed-form solution. Stores the name of the probe in `name`. */
static bool is_profile(const char *folder, const char *file, char name[NAME_MAX_LENGTH])
{
    const char ending[] = "_000000.csv";
    size_t length = strlen(file), end = sizeof ending - 1;
    struct history h;
    if (length <= end || length - end >= NAME_MAX_LENGTH || strcmp(file + length - end, ending) != 0) return false;
    memcpy(name, file, length - end);
    name[length - end] = '\0';
    if (profile_read(&h, folder, name, 0) != OK) return false;
    bool has = history_find_column(&h, "x") >= 0 && history_find_column(&h, "exact_stress") >= 0;
    history_free(&h);
    return has;
}

/* Finds the first probe of kind EXACT (comparison of a bar with a closed-form solution), in alphabetical order, of
 * which a profile is in the folder of a run, and stores its name in `probe_name`. Returns false if there is none. */
bool run_find_exact_solution_probe(const char *folder, char probe_name[NAME_MAX_LENGTH])
{
    char here[NAME_MAX_LENGTH];
    bool found = false;
    DIR *d = opendir(folder);
    if (!d) return false;
    for (struct dirent *e; (e = readdir(d));) {
        if (!is_profile(folder, e->d_name, here)) continue;
        if (!found || strcmp(here, probe_name) < 0) strcpy(probe_name, here);
        found = true;
    }
    closedir(d);
    return found;
}

/* ---- scales ------------------------------------------------------------------------------------------------------ */

/* Scale of the vertical axis of one panel. factor: unit of the axis [SI unit of the quantity]; low, high: ends of the
 * axis in this unit; zero: true if all values are 0; label: text of the axis. */
struct scale {
    double factor, low, high;
    bool zero;
    char label[64];
};

/* Extends the range s->low..s->high by the finite values in the column of the history h with the name `column`. Adds
 * nothing if `column` is NULL. */
static void extend(struct scale *s, const struct history *h, const char *column)
{
    int at = column ? history_find_column(h, column) : -1;
    for (int64_t i = 0; i < h->rows; i++) {
        double a = history_value_at(h, i, at);
        if (isfinite(a)) s->low = fmin(s->low, a), s->high = fmax(s->high, a);
    }
}

/* Writes ten to the power `power` with superscript digits in UTF-8, as 10⁻³, to text[capacity]. */
static void power_text(char *text, size_t capacity, int power)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    int size = power < 0 ? -power : power;
    snprintf(text, capacity, "10%s%s%s", power < 0 ? "⁻" : "", size > 9 ? raised[size / 10 % 10] : "",
             raised[size % 10]);
}

/* Returns range, unit and label of the vertical axis of panel q (a row of the table `quantity`), for the values of
 * this quantity in h[frames], the profiles of all output frames. The range has a margin at both ends. The unit of
 * strains is a power of ten, that of other quantities has an SI prefix. */
static struct scale scale_of(const struct history *h, int frames, int q)
{
    struct scale s = {.factor = 1};
    for (int k = 0; k < frames; k++) {
        extend(&s, &h[k], quantity[q].computed);
        extend(&s, &h[k], quantity[q].exact);
    }
    double largest = fmax(-s.low, s.high);
    snprintf(s.label, sizeof s.label, "%s", quantity[q].label);
    if (*quantity[q].unit) {
        struct unit u = unit_with_si_prefix_for_largest_value(largest, quantity[q].unit);
        s.factor = u.factor;
        snprintf(s.label, sizeof s.label, "%s [%s]", quantity[q].label, u.name);
    } else if (largest > 0 && strcmp(quantity[q].label, "strain") == 0) {
        char text[24];
        int power = (int)floor(log10(largest) + 1e-9);
        s.factor = pow(10, power);
        power_text(text, sizeof text, power);
        snprintf(s.label, sizeof s.label, "strain [%s]", text);
    }
    double margin = largest > 0 ? 0.07 * (s.high - s.low) : s.factor;
    s.zero = !(largest > 0);
    s.low = (s.low - margin) / s.factor, s.high = (s.high + margin) / s.factor;
    return s;
}

/* ---- the picture ------------------------------------------------------------------------------------------------- */

/* Writes the number a to the stream `to` of gnuplot; NaN if a is not finite, which leaves a gap in a curve. */
static void send_number(FILE *to, double a)
{
    if (isfinite(a))
        fprintf(to, " %.7g", a);
    else
        fputs(" NaN", to);
}

/* Sends the profile h of the drawn output frame number k (from 0) to gnuplot through `to` as the data block $fK (K is
 * the number k): the columns are x, then the computed and the exact value of every panel. metre: unit of x [m];
 * scale[QUANTITIES]: units of the panels. */
static void send_frame(FILE *to, const struct history *h, int k, double metre, const struct scale *scale)
{
    fprintf(to, "$f%d << EOD\n", k);
    for (int64_t i = 0; i < h->rows; i++) {
        fprintf(to, "%.9g", history_value_at(h, i, history_find_column(h, "x")) / metre);
        for (int q = 0; q < QUANTITIES; q++) {
            send_number(to, history_value_at(h, i, history_find_column(h, quantity[q].computed)) / scale[q].factor);
            int exact = quantity[q].exact ? history_find_column(h, quantity[q].exact) : -1;
            send_number(to, history_value_at(h, i, exact) / scale[q].factor);
        }
        putc('\n', to);
    }
    fputs("EOD\n", to);
}

/* Writes to gnuplot the commands that colour the background of a panel where the bar consists of peridynamic particles
 * in the profile h. metre: unit of x [m]; half: half a spacing [m]. Returns false, and colours nothing, if the profile
 * has particles of one kind only. */
static bool tint_kinds(FILE *to, const struct history *h, double metre, double half)
{
    int x = history_find_column(h, "x"), kind = history_find_column(h, "kind"), parts = 0;
    int64_t from = 0, n = 0;
    for (int64_t i = 0; i < h->rows; i++) n += history_value_at(h, i, kind) == KIND_PD;
    if (n == 0 || n == h->rows) return false;
    for (int64_t i = 0; i < h->rows; i++) {
        bool here = history_value_at(h, i, kind) == KIND_PD;
        if (!here || i == 0 || history_value_at(h, i - 1, kind) != KIND_PD) from = i;
        if (here && (i + 1 == h->rows || history_value_at(h, i + 1, kind) != KIND_PD))
            fprintf(to,
                    "set object %d rectangle from %.9g,graph 0 to %.9g,graph 1 behind fs solid noborder "
                    "fc rgb '" TINT "'\n",
                    ++parts, (history_value_at(h, from, x) - half) / metre, (history_value_at(h, i, x) + half) / metre);
    }
    return true;
}

/* Writes to gnuplot the commands that plot the curves of panel q (a row of the table `quantity`) for the output frames
 * show[frames], with the exact solution dashed. tinted: true if the background shows the peridynamic parts of the bar,
 * so that the key (legend) has an entry for them. */
static void plot_bar_panel(FILE *to, int q, const struct listed_frame *show, int frames, bool tinted)
{
    struct unit second = unit_with_si_prefix_for_largest_value(show[frames - 1].time, "s");
    for (int k = 0; k < frames; k++) {
        char colour[COLOUR_ROOM];
        curve_colour_write_by_time_order(colour, k, frames);
        fprintf(to, "%s$f%d using 1:%d with lines lw 2.2 lc rgb '%s' title '%.4g %s'", k ? ", " : "plot ", k, 2 * q + 2,
                colour, show[k].time / second.factor, second.name);
    }
    for (int k = 0; k < frames && quantity[q].exact; k++)
        fprintf(to, ", $f%d using 1:%d with lines lw 1.1 dt (9,5) lc rgb '#222222' %s", k, 2 * q + 3,
                k ? "notitle" : "title 'exact'");
    if (tinted) fputs(", NaN with boxes fs solid noborder fc rgb '" TINT "' title 'peridynamic'", to);
    putc('\n', to);
}

/* Draws all panels of a bar with its closed-form solution on the picture `sheet` with the title `title`. h[frames]:
 * profiles of the output frames show[frames]. Returns FAILED, with a message, if gnuplot fails. The last panel, damage,
 * is left out if damage is 0 everywhere. */
static status plot_bar_draw(struct output_picture sheet, const char *title, const struct history *h,
                            const struct listed_frame *show, int frames)
{
    struct gnuplot g;
    struct scale scale[QUANTITIES], x = {.low = INFINITY, .high = -INFINITY};
    for (int q = 0; q < QUANTITIES; q++) scale[q] = scale_of(h, frames, q);
    int panels = QUANTITIES - scale[QUANTITIES - 1].zero; /* the last panel, damage, is left out if damage is zero
                                                           * everywhere */
    for (int k = 0; k < frames; k++) extend(&x, &h[k], "x");
    int at = history_find_column(&h[0], "x");
    double half = h[0].rows > 1 ? 0.5 * fabs(history_value_at(&h[0], 1, at) - history_value_at(&h[0], 0, at)) : 0;
    struct unit metre = unit_for_length(x.high - x.low);
    int height = 110 + 250 * panels;
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1080, height));
    for (int k = 0; k < frames; k++) send_frame(g.to, &h[k], k, metre.factor, scale);
    curves_write_title(&g, title, "");
    fprintf(g.to, "set multiplot\nset format x ''\nset xrange [%.9g:%.9g]\n", (x.low - half) / metre.factor,
            (x.high + half) / metre.factor);
    bool tinted = tint_kinds(g.to, &h[frames - 1], metre.factor, half);
    const struct curves_layout l = curves_layout_make(&g, frames + 1 + tinted, strlen("peridynamic"), false, panels);
    const double each = (curves_layout_height_of_all_panels(&l) - PANEL_GAP * (panels - 1)) / panels;
    curves_write_margins_and_key(g.to, &l);
    for (int q = 0; q < panels; q++) {
        const double from = q * (each + PANEL_GAP);
        curves_write_panel_margins(g.to, &l, from, from + each);
        curves_write_vertical_tics(g.to, "y", scale[q].low, scale[q].high, each);
        fprintf(g.to, "set ylabel '%s'\nset yrange [%.9g:%.9g]\n", scale[q].label, scale[q].low, scale[q].high);
        if (q == panels - 1) fprintf(g.to, "set format x '%%g'\nset xlabel 'x [%s]'\n", metre.name);
        plot_bar_panel(g.to, q, show, frames, tinted);
        fputs("unset label\nunset key\n", g.to);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

status bar_profiles_draw_with_exact_solution(struct output_picture picture, const char *title, const char *folder,
                                             const char *probe_name, const struct listed_frame *shown_frame,
                                             int frame_count)
{
    struct history *h = NEW("plot.profiles", frame_count, struct history);
    status s = OK;
    int read = 0;
    while (s == OK && read < frame_count) {
        s = profile_read(&h[read], folder, probe_name, shown_frame[read].number);
        if (s == OK) read++;
    }
    if (s == OK) s = plot_bar_draw(picture, title, h, shown_frame, frame_count);
    for (int k = 0; k < read; k++) history_free(&h[k]);
    memory_free(h);
    return s;
}
