/* Pictures of load steps: load against displacement, and energy release rate against crack growth (R-curve). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/pictures.h"
#include "output/summary_read.h"
#include "curves_parts.h"
#include "scene/scene_read.h"

/* The axis of displacements ends where the force stays below this fraction of its largest value: afterwards the broken
 * body only moves apart. */
#define FORCE_LEFT 0.01
#define LINE_WIDE 0.002 /* width of a line, relative to the length of an axis */
enum { REACTIONS_SHOWN = CURVE_COLOURS - 1, TOUGHNESSES_SHOWN = 3, POINTS_SHOWN = 200 };

bool run_has_load_steps(const char *folder)
{
    struct history h;
    if (!run_has_file(folder, "history.csv") || history_read(&h, folder) != OK) return false;
    const bool in_steps = history_find_column(&h, "load_time") >= 0;
    history_free(&h);
    return in_steps;
}

/* Writes the gnuplot command for the tics of a horizontal axis from 0 to `high`, so far apart that their numbers do not
 * touch. l: layout of the picture. */
static void write_horizontal_tics(FILE *to, const struct curves_layout *l, double high)
{
    const double letters = 2 + fmax(floor(log10(high)), 0); /* of the longest number, with a space */
    const double pixels = l->width - l->left - l->right;
    fprintf(to, "set xtics %.9g\n", tic_distance(high, pixels, 12 + 11 * letters));
}

/* ---- load over displacement -------------------------------------------------------------------------------------- */

/* Indices column[n] of the columns of the history with the components of a vector, for example NAME.force_x; n is 0 if
 * the history has no such columns. since: the vector is the difference of the values from those in the first row. */
struct components {
    int n, column[3];
    bool since;
};

/* Returns the columns of the components of a vector quantity of a probe or rigid body; n = 0 if there are none. The
 * name of such a column is `probe`, `by` and `quantity` joined, followed by the axis: for example NAME.force_x for the
 * probe NAME, "." and "force_". */
static struct components components_of(const struct history *h, const char *probe, const char *by, const char *quantity)
{
    struct components c = {0};
    for (int d = 0; d < 3; d++) {
        char name[3 * NAME_MAX_LENGTH];
        snprintf(name, sizeof name, "%.63s%s%.63s%c", probe, by, quantity, 'x' + d);
        const int column = history_find_column(h, name);
        if (column >= 0) c.column[c.n++] = column;
    }
    return c;
}

static double length_at(const struct history *h, int64_t row, const struct components *c)
{
    double sum = 0;
    for (int d = 0; d < c->n; d++)
        sum += square(history_value_at(h, row, c->column[d]) - (c->since ? history_value_at(h, 0, c->column[d]) : 0));
    return sqrt(sum);
}

static double longest_of(const struct history *h, const struct components *c)
{
    double most = 0;
    for (int64_t i = 0; i < h->rows; i++) most = fmax(most, length_at(h, i, c));
    return most;
}

/* A curve: force and displacement of a support or rigid body. A support at rest has no displacement (n = 0). */
struct reaction {
    char name[NAME_MAX_LENGTH];
    struct components force, displacement;
    int64_t peak; /* row of the largest force */
};
struct reactions {
    int n;
    struct reaction of[REACTIONS_SHOWN];
    char over[NAME_MAX_LENGTH]; /* point probe whose displacement all curves use; "": each curve uses its own */
    double force, displacement; /* largest force [N]; largest displacement while there is a force [m] */
};

/* Returns the row of the history h in which the magnitude of the force with the components `force` is largest. */
static int64_t peak_of(const struct history *h, const struct components *force)
{
    int64_t at = 0;
    for (int64_t i = 1; i < h->rows; i++)
        if (length_at(h, i, force) > length_at(h, at, force)) at = i;
    return at;
}

/* Finds the first column, from column `from` on, whose name is the name of a probe followed by `quantity`. Returns its
 * index and stores the name of the probe in `name`. Returns -1 if there is none. */
static int probe_from(const struct history *h, int from, const char *quantity, char name[NAME_MAX_LENGTH])
{
    const size_t tail = strlen(quantity);
    for (int k = from; k < h->columns; k++) {
        const size_t length = strlen(h->name[k]);
        if (length <= tail || length - tail >= NAME_MAX_LENGTH) continue;
        if (strcmp(h->name[k] + length - tail, quantity) != 0) continue;
        snprintf(name, NAME_MAX_LENGTH, "%.*s", (int)(length - tail), h->name[k]);
        return k;
    }
    return -1;
}

/* Appends to r the curves of force against displacement of the rigid bodies that carry a force and move. If `resting`
 * is true, also appends those of bodies that carry a force and do not move. Returns true if one of the appended bodies
 * moves. */
static bool reactions_add_rigids(struct reactions *r, const struct history *h, bool resting)
{
    char name[NAME_MAX_LENGTH];
    bool moving = false;
    for (int k = 0; (k = probe_from(h, k, "_force_x", name)) >= 0 && r->n < REACTIONS_SHOWN; k++) {
        struct reaction a = {.force = components_of(h, name, "_", "force_"),
                             .displacement = components_of(h, name, "_", "")};
        a.displacement.since = true;
        const bool moves = longest_of(h, &a.displacement) > 0;
        if (a.displacement.n == 0 || !(longest_of(h, &a.force) > 0) || !(moves || resting)) continue;
        moving |= moves;
        memcpy(a.name, name, sizeof name);
        a.peak = peak_of(h, &a.force);
        r->of[r->n++] = a;
    }
    return moving;
}

/* Finds the curves of force against displacement: those of supports that move, and of rigid bodies that move under a
 * force. If none moves, uses all supports and rigid bodies with a force, against the displacement of the first point
 * probe that moves. Stores in *r the curves, the largest force, and the largest displacement while there is a force. */
static void reactions_find(struct reactions *r, const struct history *h)
{
    char name[NAME_MAX_LENGTH];
    bool moving = false;
    *r = (struct reactions){0};
    for (int pass = 0; pass < 2 && r->n == 0; pass++) {
        moving |= reactions_add_rigids(r, h, pass > 0);
        for (int k = 0; (k = probe_from(h, k, ".force_x", name)) >= 0 && r->n < REACTIONS_SHOWN; k++) {
            struct reaction a = {.force = components_of(h, name, ".", "force_"),
                                 .displacement = components_of(h, name, ".", "displacement_")};
            const bool moves = longest_of(h, &a.displacement) > 0;
            moving |= moves;
            if (!(longest_of(h, &a.force) > 0) || (pass == 0 && !moves)) continue;
            memcpy(a.name, name, sizeof name);
            a.peak = peak_of(h, &a.force);
            r->of[r->n++] = a;
        }
    }
    for (int k = 0; !moving && (k = probe_from(h, k, ".displacement_x", name)) >= 0 && !r->over[0]; k++) {
        const struct components displacement = components_of(h, name, ".", "displacement_");
        if (!(longest_of(h, &displacement) > 0)) continue;
        memcpy(r->over, name, sizeof name);
        for (int m = 0; m < r->n; m++) r->of[m].displacement = displacement;
    }
    for (int m = 0; m < r->n; m++) {
        const double most = longest_of(h, &r->of[m].force);
        r->force = fmax(r->force, most);
        for (int64_t i = 0; i < h->rows; i++)
            if (length_at(h, i, &r->of[m].force) > FORCE_LEFT * most)
                r->displacement = fmax(r->displacement, length_at(h, i, &r->of[m].displacement));
    }
}

/* Returns true if the curves a and b (force against displacement) are nowhere further apart than the width of a line.
 * r: all curves, for the ends of the axes; h: history with the values. */
static bool curves_coincide(const struct reactions *r, const struct history *h, const struct reaction *a,
                            const struct reaction *b)
{
    for (int64_t i = 0; i < h->rows; i++) {
        const double newton = length_at(h, i, &a->force) - length_at(h, i, &b->force);
        const double metre = length_at(h, i, &a->displacement) - length_at(h, i, &b->displacement);
        if (!(fabs(newton) <= LINE_WIDE * r->force && fabs(metre) <= LINE_WIDE * r->displacement)) return false;
    }
    return true;
}

/* Merges curves that coincide into one that has the names of both. Curves coincide, for example, if two probes measure
 * the same support or opposite supports. */
static void reactions_join(struct reactions *r, const struct history *h)
{
    int kept = 0;
    for (int m = 0; m < r->n; m++) {
        int same = 0;
        while (same < kept && !curves_coincide(r, h, &r->of[same], &r->of[m])) same++;
        if (same == kept) {
            r->of[kept++] = r->of[m];
            continue;
        }
        char *name = r->of[same].name;
        const size_t length = strlen(name);
        if (length + strlen(r->of[m].name) + 2 < NAME_MAX_LENGTH)
            snprintf(name + length, NAME_MAX_LENGTH - length, ", %s", r->of[m].name);
    }
    r->n = kept;
}

static void reactions_send(FILE *to, const struct history *h, const struct reactions *r, struct unit newton,
                           struct unit metre)
{
    for (int m = 0; m < r->n; m++) {
        fprintf(to, "$f%d << EOD\n", m);
        for (int64_t i = 0; i < h->rows; i++)
            fprintf(to, "%.9g %.9g\n", length_at(h, i, &r->of[m].displacement) / metre.factor,
                    length_at(h, i, &r->of[m].force) / newton.factor);
        fputs("EOD\n", to);
    }
}

/* Plots the curves r of force against displacement, each with a ring at its largest force. newton, metre: units of the
 * vertical and the horizontal axis. */
static void reactions_plot(FILE *to, const struct history *h, const struct reactions *r, struct unit newton,
                           struct unit metre)
{
    for (int m = 0; m < r->n; m++) {
        const struct reaction *a = &r->of[m];
        char text[3 * NAME_MAX_LENGTH];
        fprintf(to, "%s$f%d with %s lw 2 lc rgb '%s' title ", m == 0 ? "plot " : ", ", m,
                h->rows > POINTS_SHOWN ? "lines" : "linespoints pt 7 ps 0.5", curve_colour[m]);
        gnuplot_write_quoted_string(to, a->name);
        snprintf(text, sizeof text, "%.4g %s at %.4g %s", length_at(h, a->peak, &a->force) / newton.factor, newton.name,
                 length_at(h, a->peak, &a->displacement) / metre.factor, metre.name);
        fprintf(to, ", $f%d every ::%lld::%lld with points pt 6 ps 2 lw 2 lc rgb '%s' title ", m, (long long)a->peak,
                (long long)a->peak, curve_colour[CURVE_COLOURS - 1]);
        gnuplot_write_quoted_string(to, text);
    }
    putc('\n', to);
}

/* Prints the reason why the picture `path` of load against displacement is not drawn. r: the curves that were found.
 * Returns FAILED if standard output cannot be written. */
static status say_missing_load(const char *path, const struct reactions *r)
{
    if (r->n > 0)
        return report_picture_not_drawn(path, "the boundary that carries the load does not move; a point probe where "
                                              "the body moves adds the displacement: probes: [{point: {at: [...]}}]");
    return report_picture_not_drawn(path, "neither a support nor a rigid body has a force");
}

status load_displacement_draw(struct sheet sheet, const char *title, const struct history *history)
{
    struct reactions r;
    struct gnuplot g;
    reactions_find(&r, history);
    if (!(r.n > 0 && r.displacement > 0)) return say_missing_load(sheet.path, &r);
    reactions_join(&r, history);
    const struct unit newton = unit_for_largest_value(r.force, "N"), metre = unit_for_length(r.displacement);
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1000, 640));
    reactions_send(g.to, history, &r, newton, metre);
    size_t longest = 24; /* 123.4 kN at 123.4 mm */
    for (int m = 0; m < r.n; m++) longest = strlen(r.of[m].name) > longest ? strlen(r.of[m].name) : longest;
    curves_write_title(&g, title, "load and displacement");
    const struct curves_layout l = curves_layout_make(&g, 2 * r.n, longest, false);
    curves_write_margins_and_key(g.to, &l);
    write_horizontal_tics(g.to, &l, 1.15 * r.displacement / metre.factor);
    curves_write_tics(g.to, "y", 0, r.force / newton.factor, curves_layout_height_of_all_panels(&l));
    fprintf(g.to, "set xrange [0:%.9g]\nset yrange [0:%.9g]\nset ylabel 'force [%s]'\nset xlabel ",
            1.15 * r.displacement / metre.factor, r.force > 0 ? 1.08 * r.force / newton.factor : 1, newton.name);
    char label[3 * NAME_MAX_LENGTH];
    snprintf(label, sizeof label, "displacement%s%.63s [%s]", r.over[0] ? " of " : "", r.over, metre.name);
    gnuplot_write_quoted_string(g.to, label);
    putc('\n', g.to);
    reactions_plot(g.to, history, &r, newton, metre);
    return gnuplot_close(&g);
}

/* ---- R-curve ----------------------------------------------------------------------------------------------------- */

/* Reads the critical energy release rates of the materials in the scene of the run in `folder` into value[] [J/m^2],
 * each value once. Returns their number; 0 if the scene cannot be read. */
static int toughnesses_of(const char *folder, double value[TOUGHNESSES_SHOWN])
{
    struct scene s;
    int n = 0;
    if (scene_read(&s, path_join(folder, "scene.yaml").text, NULL, 0) != OK) return 0;
    for (int m = 0; m < s.materials && n < TOUGHNESSES_SHOWN; m++) {
        const double own = s.material[m].energy_release_rate;
        bool known = !(own > 0) || !isfinite(own);
        for (int k = 0; k < n; k++) known |= value[k] == own;
        if (!known) value[n++] = own;
    }
    scene_free(&s);
    return n;
}

/* Sends the data block $data to gnuplot: crack area and energy release rate of each load step in which the crack has
 * grown. area, rate: columns of the history h; square: unit of area; factor: unit of the rate [J/m^2]. */
static void release_send(FILE *to, const struct history *h, int area, int rate, struct unit square, double factor)
{
    double before = 0;
    fputs("$data << EOD\n", to);
    for (int64_t i = 0; i < h->rows; i++) {
        const double now = history_value_at(h, i, area);
        if (now > before && isfinite(history_value_at(h, i, rate)))
            fprintf(to, "%.9g %.9g\n", now / square.factor, history_value_at(h, i, rate) / factor);
        before = fmax(before, now);
    }
    fputs("EOD\n", to);
}

/* Plots the energy release rate against the crack area. Also plots as horizontal lines the mean rate `mean` [J/m^2]
 * unless it is NAN, and the critical rates toughness[n] [J/m^2] of the materials. rate: unit of the axis of rates. */
static void release_plot(FILE *to, const double *toughness, int n, double mean, struct unit rate)
{
    fprintf(to, "plot $data with linespoints lw 2 pt 7 ps 0.7 lc rgb '%s' title 'release rate'", curve_colour[0]);
    if (isfinite(mean))
        fprintf(to, ", %.9g with lines lw 1.6 dt (3,4) lc rgb '%s' title 'mean %.4g %s'", mean / rate.factor,
                curve_colour[0], mean / rate.factor, rate.name);
    for (int k = 0; k < n; k++)
        fprintf(to, ", %.9g with lines lw 1.8 dt (10,6) lc rgb '%s' title 'G_c = %.4g %s'", toughness[k] / rate.factor,
                curve_colour[1 + k], toughness[k] / rate.factor, rate.name);
    putc('\n', to);
}

status r_curve_draw(struct sheet sheet, const char *folder, const char *title, const struct history *history)
{
    const int area = history_find_column(history, "crack_area"), rate = history_find_column(history, "release_rate");
    const double grown = history_largest_magnitude(history, area);
    double toughness[TOUGHNESSES_SHOWN] = {0}, top = history_largest_magnitude(history, rate);
    struct gnuplot g;
    if (!(grown > 0)) return report_picture_not_drawn(sheet.path, "no crack has grown");
    const int n = toughnesses_of(folder, toughness);
    for (int k = 0; k < n; k++) top = fmax(top, toughness[k]);
    double mean; /* NAN before the run has ended */
    (void)summary_read_number(folder, "load_steps.release_rate", &mean);
    top = fmax(top, mean);
    const struct unit square = unit_for_area(grown), joule = unit_for_largest_value(top, "J/m²");
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1000, 640));
    release_send(g.to, history, area, rate, square, joule.factor);
    curves_write_title(&g, title, "energy released by the growing crack");
    const struct curves_layout l = curves_layout_make(&g, 2 + n, strlen("mean 123.4 kJ/m²"), false);
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to,
            "set xrange [0:%.9g]\nset yrange [0:%.9g]\nset ylabel 'released over new area [%s]'\nset xlabel 'new crack "
            "area [%s]'\n",
            1.03 * grown / square.factor, 1.15 * top / joule.factor, joule.name, square.name);
    write_horizontal_tics(g.to, &l, 1.03 * grown / square.factor);
    curves_write_tics(g.to, "y", 0, top / joule.factor, curves_layout_height_of_all_panels(&l));
    release_plot(g.to, toughness, n, mean, joule);
    return gnuplot_close(&g);
}
