/* Draws the load against the displacement of supports and rigid bodies. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "output/pictures.h"
#include "curves_parts.h"

/* Fraction of the largest force below which a body counts as broken. When the force has exceeded it for the last time,
 * later displacements are those of parts that fly apart. */
#define FORCE_LEFT 0.01
#define DRIVEN 0.02      /* least component of a displacement along which a body is driven, as a share of its length */
#define ROUND_OFF 1e-9   /* displacements below this number of spacings are round-off */
#define REST_SHOWN 3     /* motion without force is shown up to this multiple of that with force */
#define LOAD_SHOWN 0.5   /* least peak along the load that is marked, as a share of the largest force */
#define FORCE_SHOWN 5e-4 /* a smaller part of the largest force is not drawn: its curve coincides with the axis */
#define LINE_WIDE 0.002  /* width of a line divided by the length of an axis [1] */
enum { REACTIONS_SHOWN = CURVE_COLOURS - 1, POINTS_SHOWN = 200, LABEL_ROOM = 256, PEAK_ROOM = 128 };

bool run_has_load_steps(const char *folder)
{
    struct history h;
    if (!run_folder_has_file(folder, "history.csv") || history_read(&h, folder) != OK) return false;
    const bool in_steps = history_find_column(&h, "load_time") >= 0;
    history_free(&h);
    return in_steps;
}

/* ---- load over displacement -------------------------------------------------------------------------------------- */

/* One component of a vector quantity in a history, for example the column NAME.force_x. Its values are those of the
 * column, less `from`, times `sign`. */
struct component {
    int column, axis; /* index of the column; axis of the component, 0 .. 2 for x y z */
    double from;      /* the quantity is the difference of the values of the column from this one */
    double sign;      /* -1 or 1 */
};

/* Components of[n] of a vector quantity in a history, one for each axis; n is 0 if the history does not have the
 * quantity. */
struct components {
    int n;
    struct component of[3];
};

/* Returns the components of a vector quantity of a probe or rigid body in the history h; n = 0 if there are none. The
 * name of such a column is `probe`, `by` and `quantity` joined, followed by the axis: for example NAME.force_x for the
 * probe NAME, "." and "force_". since: true if the quantity is the difference of the values from those in the first
 * row. */
static struct components components_of(const struct history *h, const char *probe, const char *by, const char *quantity,
                                       bool since)
{
    struct components c = {0};
    for (int d = 0; d < 3; d++) {
        char name[3 * NAME_MAX_LENGTH];
        snprintf(name, sizeof name, "%.63s%s%.63s%c", probe, by, quantity, 'x' + d);
        const int column = history_find_column(h, name);
        if (column < 0) continue;
        c.of[c.n++] = (struct component){column, d, since ? history_value_at(h, 0, column) : 0, 1};
    }
    return c;
}

static double component_at(const struct history *h, int64_t row, const struct component *c)
{
    return c->sign * (history_value_at(h, row, c->column) - c->from);
}

/* Returns the row of the history h in which the magnitude of component c is largest. */
static int64_t peak_of(const struct history *h, const struct component *c)
{
    int64_t at = 0;
    for (int64_t i = 1; i < h->rows; i++)
        if (fabs(component_at(h, i, c)) > fabs(component_at(h, at, c))) at = i;
    return at;
}

/* Returns the row of the history h in which component c is largest with the sign that counts as positive, if it is
 * there at least LOAD_SHOWN times its largest magnitude; else the row of the largest magnitude. The first is the peak
 * of the load; the force may be larger after the body has broken, when its parts swing back. */
static int64_t peak_of_load(const struct history *h, const struct component *c)
{
    int64_t at = 0;
    for (int64_t i = 1; i < h->rows; i++)
        if (component_at(h, i, c) > component_at(h, at, c)) at = i;
    const int64_t largest = peak_of(h, c);
    return component_at(h, at, c) >= LOAD_SHOWN * fabs(component_at(h, largest, c)) ? at : largest;
}

static double largest_of(const struct history *h, const struct component *c)
{
    return fabs(component_at(h, peak_of(h, c), c));
}

/* Returns the component of c with the largest magnitude in any row of the history h; c->n must not be 0. */
static struct component main_component(const struct history *h, const struct components *c)
{
    int best = 0;
    for (int d = 1; d < c->n; d++)
        if (largest_of(h, &c->of[d]) > largest_of(h, &c->of[best])) best = d;
    return c->of[best];
}

/* Returns the sign (1 or -1) of component c where it first exceeds the share DRIVEN of its largest magnitude in the
 * history h. Returns 1 if it never does. */
static double first_sign(const struct history *h, const struct component *c)
{
    const double least = DRIVEN * largest_of(h, c);
    for (int64_t i = 0; i < h->rows; i++)
        if (fabs(component_at(h, i, c)) > least) return component_at(h, i, c) < 0 ? -1 : 1;
    return 1;
}

/* One curve of the picture: a component of the force on a support or rigid body against a component of the
 * displacement. */
struct reaction {
    char name[NAME_MAX_LENGTH];
    bool rigid; /* the force is that on a rigid body, else that of a support on the body */
    struct component force, displacement;
    int64_t peak; /* row of the largest load */
};
/* All curves of[n] of a picture of load against displacement, and the ends of its axes. */
struct reactions {
    int n;
    bool moving; /* a support or rigid body moves */
    struct reaction of[REACTIONS_SHOWN];
    char over[NAME_MAX_LENGTH];             /* point probe whose displacement all curves use; "": each its own */
    struct value_range force, displacement; /* ends of the axes [N] [m], 0 included */
    double dropped; /* displacement without force up to which the history goes beyond the axis [m]; 0: none */
};

/* Finds the first column of the history h, from column `from` on, whose name is the name of a probe followed by
 * `quantity`. Returns its index and stores the name of the probe in `name`. Returns -1 if there is none. */
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

static void reaction_append(struct reactions *r, const struct history *h, const char *name, bool rigid,
                            const struct component *force, const struct component *displacement)
{
    if (r->n == REACTIONS_SHOWN || !(largest_of(h, force) > 0)) return;
    struct reaction *a = &r->of[r->n++];
    *a = (struct reaction){.rigid = rigid, .force = *force, .displacement = *displacement, .peak = peak_of(h, force)};
    snprintf(a->name, sizeof a->name, "%s", name);
}

/* Appends to r the curves of the support or rigid body `name` in the history h: one for each component of its
 * displacement that reaches at least the fraction DRIVEN of the largest component. A body that moves by `still` [m] or
 * less gets a curve only if `resting` is true: the largest component of its force, without a displacement. Appends
 * nothing if there is no force. rigid: true for a rigid body. */
static void reactions_add_body(struct reactions *r, const struct history *h, const char *name, bool rigid, double still,
                               bool resting)
{
    const struct components force = components_of(h, name, rigid ? "_" : ".", "force_", false);
    const struct components displacement =
        components_of(h, name, rigid ? "_" : ".", rigid ? "" : "displacement_", rigid);
    if (force.n == 0 || (rigid && displacement.n == 0)) return;
    const struct component most = main_component(h, &force);
    if (!(largest_of(h, &most) > 0)) return;
    double length = 0;
    for (int d = 0; d < displacement.n; d++) length = fmax(length, largest_of(h, &displacement.of[d]));
    if (length > still) {
        r->moving = true;
        for (int d = 0; d < displacement.n && d < force.n; d++)
            if (largest_of(h, &displacement.of[d]) >= DRIVEN * length)
                reaction_append(r, h, name, rigid, &force.of[d], &displacement.of[d]);
    } else if (resting) {
        reaction_append(r, h, name, rigid, &most, &most);
    }
}

/* Finds the first point probe in the history h that moves by more than `still` [m], stores its name in r->over, and
 * makes the largest component of its displacement that of all curves of r. Leaves r unchanged, with r->over empty, if
 * there is no such probe. */
static void reactions_use_point(struct reactions *r, const struct history *h, double still)
{
    char name[NAME_MAX_LENGTH];
    for (int k = 0; (k = probe_from(h, k, ".displacement_x", name)) >= 0 && !r->over[0]; k++) {
        const struct components all = components_of(h, name, ".", "displacement_", false);
        const struct component displacement = main_component(h, &all);
        if (!(largest_of(h, &displacement) > still)) continue;
        memcpy(r->over, name, sizeof name);
        for (int m = 0; m < r->n; m++) r->of[m].displacement = displacement;
    }
}

/* Removes from r the curves whose largest force is below the share FORCE_SHOWN of the largest one of all. h: history
 * with the values. */
static void reactions_drop_small(struct reactions *r, const struct history *h)
{
    double largest = 0;
    int kept = 0;
    for (int m = 0; m < r->n; m++) largest = fmax(largest, largest_of(h, &r->of[m].force));
    for (int m = 0; m < r->n; m++)
        if (largest_of(h, &r->of[m].force) >= FORCE_SHOWN * largest) r->of[kept++] = r->of[m];
    r->n = kept;
}

/* Returns true if all curves of r show components along one axis: of forces if `force` is true, else of
 * displacements. */
static bool one_axis(const struct reactions *r, bool force)
{
    bool one = true;
    for (int m = 1; m < r->n; m++)
        one &= force ? r->of[m].force.axis == r->of[0].force.axis
                     : r->of[m].displacement.axis == r->of[0].displacement.axis;
    return one;
}

/* Chooses the signs of the curves r such that they begin with positive force and displacement, and their peaks. The
 * force on a rigid body is opposite to that of a support, which acts along the motion. If curves have different axes,
 * keeps the signs of the history h and adds the axis to their names. */
static void reactions_choose_signs(struct reactions *r, const struct history *h)
{
    const bool one = one_axis(r, true) && one_axis(r, false);
    for (int m = 0; m < r->n; m++) {
        struct reaction *a = &r->of[m];
        if (one) {
            a->displacement.sign = first_sign(h, &a->displacement);
            a->force.sign = r->over[0] ? first_sign(h, &a->force)
                            : a->rigid ? -a->displacement.sign
                                       : a->displacement.sign;
            a->peak = peak_of_load(h, &a->force);
        } else {
            const size_t length = strlen(a->name);
            if (length + 3 <= sizeof a->name) snprintf(a->name + length, 3, " %c", 'x' + a->force.axis);
        }
    }
}

static void range_extend(struct value_range *range, double value)
{
    range->low = fmin(range->low, value), range->high = fmax(range->high, value);
}

/* Computes the ends of the axes of force and displacement in r from the values of its curves in the history h.
 * Displacements after the force has last exceeded FORCE_LEFT times its largest value are left out if they would make
 * the axis longer than REST_SHOWN times; r->dropped then receives the end of these displacements. */
static void reactions_set_ranges(struct reactions *r, const struct history *h)
{
    struct value_range whole = {0, 0};
    r->force = r->displacement = (struct value_range){0, 0};
    for (int m = 0; m < r->n; m++) {
        const struct reaction *a = &r->of[m];
        int64_t last = 0;
        for (int64_t i = 0; i < h->rows; i++)
            if (fabs(component_at(h, i, &a->force)) > FORCE_LEFT * largest_of(h, &a->force)) last = i;
        for (int64_t i = 0; i < h->rows; i++) {
            const double metre = component_at(h, i, &a->displacement);
            range_extend(&r->force, component_at(h, i, &a->force));
            range_extend(&whole, metre);
            if (i <= last + 1) range_extend(&r->displacement, metre);
        }
    }
    if (whole.high - whole.low <= REST_SHOWN * (r->displacement.high - r->displacement.low))
        r->displacement = whole;
    else
        r->dropped = whole.high > r->displacement.high ? whole.high : whole.low;
}

/* Finds the curves of force against displacement in the history h: those of supports that move, and of rigid bodies
 * that move under a force. If none moves, uses all supports and rigid bodies with a force, against the displacement of
 * the first point probe that moves. still: largest displacement that is round-off [m]. Stores in *r the curves and the
 * ends of the axes. */
static void reactions_find(struct reactions *r, const struct history *h, double still)
{
    char name[NAME_MAX_LENGTH];
    *r = (struct reactions){0};
    for (int pass = 0; pass < 2 && r->n == 0; pass++) {
        for (int k = 0; (k = probe_from(h, k, "_force_x", name)) >= 0; k++)
            reactions_add_body(r, h, name, true, still, pass > 0);
        for (int k = 0; (k = probe_from(h, k, ".force_x", name)) >= 0; k++)
            reactions_add_body(r, h, name, false, still, pass > 0);
    }
    if (!r->moving) reactions_use_point(r, h, still);
    if (!r->moving && !r->over[0]) return;
    reactions_drop_small(r, h);
    reactions_choose_signs(r, h);
    reactions_set_ranges(r, h);
}

/* Returns true if the curves a and b (force against displacement) differ in no sample by more than LINE_WIDE times the
 * length of the axis of force or of displacement. r: all curves, for the ends of the axes; h: history with the values.
 */
static bool curves_coincide(const struct reactions *r, const struct history *h, const struct reaction *a,
                            const struct reaction *b)
{
    for (int64_t i = 0; i < h->rows; i++) {
        const double newton = component_at(h, i, &a->force) - component_at(h, i, &b->force);
        const double metre = component_at(h, i, &a->displacement) - component_at(h, i, &b->displacement);
        if (!(fabs(newton) <= LINE_WIDE * (r->force.high - r->force.low) &&
              fabs(metre) <= LINE_WIDE * (r->displacement.high - r->displacement.low)))
            return false;
    }
    return true;
}

/* Merges curves of r that coincide into one curve that has the names of both. Curves coincide, for example, if two
 * probes of the history h measure the same support or opposite supports. */
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
            fprintf(to, "%.9g %.9g\n", component_at(h, i, &r->of[m].displacement) / metre.factor,
                    component_at(h, i, &r->of[m].force) / newton.factor);
        fputs("EOD\n", to);
    }
}

/* Writes to text[capacity], for the key (legend), the largest sampled load of the curve a and the displacement at
 * that sample. The text names the axis of this component, since summary.json has the magnitude of the force vector
 * instead. h: history with the values; newton, metre: units of force and displacement. */
static void write_peak(char *text, size_t capacity, const struct history *h, const struct reaction *a,
                       struct unit newton, struct unit metre)
{
    snprintf(text, capacity, "sampled along %s%c: %.4g %s at %.4g %s", a->force.sign < 0 ? "−" : "",
             'x' + a->force.axis, component_at(h, a->peak, &a->force) / newton.factor, newton.name,
             component_at(h, a->peak, &a->displacement) / metre.factor, metre.name);
}

/* Returns the number of letters of the longest entry in the key (legend) of the curves r: a name or a peak. h, newton,
 * metre: as for write_peak. */
static size_t longest_key_entry(const struct history *h, const struct reactions *r, struct unit newton,
                                struct unit metre)
{
    size_t longest = 0;
    for (int m = 0; m < r->n; m++) {
        char peak[PEAK_ROOM];
        write_peak(peak, sizeof peak, h, &r->of[m], newton, metre);
        const size_t name = strlen(r->of[m].name), own = strlen(peak) > name ? strlen(peak) : name;
        longest = own > longest ? own : longest;
    }
    return longest;
}

/* Writes to gnuplot the command that plots the curves r of force against displacement, each with a ring at its largest
 * load. h: history with the values; newton, metre: units of the vertical and the horizontal axis. */
static void reactions_plot(FILE *to, const struct history *h, const struct reactions *r, struct unit newton,
                           struct unit metre)
{
    for (int m = 0; m < r->n; m++) {
        const struct reaction *a = &r->of[m];
        char text[PEAK_ROOM];
        fprintf(to, "%s$f%d with %s lw 2 lc rgb '%s' title ", m == 0 ? "plot " : ", ", m,
                h->rows > POINTS_SHOWN ? "lines" : "linespoints pt 7 ps 0.5", curve_colour[m]);
        gnuplot_write_quoted_string(to, a->name);
        write_peak(text, sizeof text, h, a, newton, metre);
        fprintf(to, ", $f%d every ::%lld::%lld with points pt 6 ps 2 lw 2 lc rgb '%s' title ", m, (long long)a->peak,
                (long long)a->peak, curve_colour[CURVE_COLOURS - 1]);
        gnuplot_write_quoted_string(to, text);
    }
    putc('\n', to);
}

/* Prints the reason why the picture `path` of load against displacement is not drawn. r: the curves that were found in
 * the history h. Returns FAILED if standard output cannot be written. */
static status say_missing_load(const char *path, const struct reactions *r, const struct history *h)
{
    char text[320], name[NAME_MAX_LENGTH];
    if (r->n > 0) {
        snprintf(text, sizeof text,
                 "the %s that carries the load does not move, or only turns, so that its mean displacement is 0; add "
                 "a point probe where the body moves: probes: [{point: {at: [...]}}]",
                 r->of[0].rigid ? "rigid body" : "boundary");
        return picture_report_not_drawn_and_remove_old(path, text);
    }
    const bool rigid = probe_from(h, 0, "_force_x", name) >= 0, support = probe_from(h, 0, ".force_x", name) >= 0;
    if (rigid || support)
        return picture_report_not_drawn_and_remove_old(
            path, rigid ? support ? "boundaries and rigid bodies bear no load" : "the rigid bodies bear no load"
                        : "the boundaries bear no load");
    return picture_report_not_drawn_and_remove_old(
        path, "no force to draw: give a boundary a displacement or velocity, or add a rigid body");
}

/* Writes the label of an axis to text[LABEL_ROOM]: force or displacement, the direction if all curves of r are along
 * one axis, and the unit. force: true for the axis of forces; u: unit of the axis. Also names the displacement up to
 * which there is no force if the axis leaves it out. */
static void write_axis_label(char text[LABEL_ROOM], const struct reactions *r, bool force, const struct unit *u)
{
    bool same = true;
    char direction[8] = "";
    const struct component *first = force ? &r->of[0].force : &r->of[0].displacement;
    for (int m = 1; m < r->n; m++) same &= (force ? &r->of[m].force : &r->of[m].displacement)->sign == first->sign;
    if (one_axis(r, force))
        snprintf(direction, sizeof direction, " %s%c", !same ? "±" : first->sign < 0 ? "−" : "", 'x' + first->axis);
    if (force)
        snprintf(text, LABEL_ROOM, "force%s [%s]", direction, u->name);
    else
        snprintf(text, LABEL_ROOM, "displacement%s%s%.63s [%s]", direction, r->over[0] ? " of " : "", r->over, u->name);
    const size_t length = strlen(text);
    if (!force && r->dropped != 0)
        snprintf(text + length, LABEL_ROOM - length, ", without force up to %.3g %s", r->dropped / u->factor, u->name);
}

/* Writes to gnuplot the commands for the axes of the curves r. l: layout of the picture; newton, metre: units of the
 * vertical and the horizontal axis. */
static void reactions_write_axes(FILE *to, const struct curves_layout *l, const struct reactions *r, struct unit newton,
                                 struct unit metre)
{
    const struct value_range f = r->force, u = r->displacement;
    const double wide = 0.08 * (u.high - u.low), tall = 0.08 * (f.high - f.low);
    const double left = (u.low < 0 ? u.low - wide : 0) / metre.factor, right = (u.high + wide) / metre.factor,
                 bottom = (f.low < 0 ? f.low - tall : 0) / newton.factor, top = (f.high + tall) / newton.factor;
    char label[LABEL_ROOM];
    curves_write_horizontal_tics(to, l, left, right);
    curves_write_vertical_tics(to, "y", f.low / newton.factor, f.high / newton.factor,
                               curves_layout_height_of_all_panels(l));
    fprintf(to,
            "set zeroaxis lt 1 lw 0.8 lc rgb '#999999'\nset xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\nset ylabel ",
            left, right, bottom, top > bottom ? top : 1);
    write_axis_label(label, r, true, &newton);
    gnuplot_write_quoted_string(to, label);
    fputs("\nset xlabel ", to);
    write_axis_label(label, r, false, &metre);
    gnuplot_write_quoted_string(to, label);
    putc('\n', to);
}

static double largest_end(struct value_range range) { return fmax(fabs(range.low), fabs(range.high)); }

status load_displacement_draw(struct output_picture picture, const char *title, const struct history *history,
                              double spacing)
{
    struct reactions r;
    struct gnuplot g;
    reactions_find(&r, history, ROUND_OFF * spacing);
    if (!(r.n > 0 && r.displacement.high > r.displacement.low)) return say_missing_load(picture.path, &r, history);
    reactions_join(&r, history);
    const struct unit newton = unit_with_si_prefix_for_largest_value(largest_end(r.force), "N"),
                      metre = unit_for_length(largest_end(r.displacement));
    TRY(gnuplot_open(&g, picture.path, picture.format, 1000, 640));
    reactions_send(g.to, history, &r, newton, metre);
    curves_write_title(&g, title, "load and displacement");
    const struct curves_layout l =
        curves_layout_make(&g, 2 * r.n, longest_key_entry(history, &r, newton, metre), false, 1);
    curves_write_margins_and_key(g.to, &l);
    reactions_write_axes(g.to, &l, &r, newton, metre);
    reactions_plot(g.to, history, &r, newton, metre);
    return gnuplot_close(&g);
}
