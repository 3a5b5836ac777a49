/* Draws profiles along a bar: velocity, stress and damage, or a field, against the position. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "curves_parts.h"

/* One particle of a bar in a profile. loose: it belongs to a piece of at most LOOSE_MOST particles, which is drawn as
 * points. */
struct station {
    double x;         /* position [m] */
    float value[3];   /* velocity, stress, damage, or a field in value[0] */
    int32_t fragment; /* index of its fragment; -1: none, or the frame does not have it */
    bool loose;
};

/* Profile of a bar at one output time: its n particles from left to right. Made by profile_make; the caller releases
 * `at` with memory_free. */
struct bar_profile {
    struct station *at;
    int64_t n;
    double t;                    /* time [s] */
    char label[NAME_MAX_LENGTH]; /* load step or equilibrium; "": the time */
};

/* SEPARATED: distance of neighbours above which the bar has separated between them [spacings]. ALL_BONDS: damage above
 * which a particle has no bond left [1]. LOOSE_MOST: largest number of particles of a loose piece, which is drawn as
 * points and does not extend the axes, since such pieces are fast. BESIDE: largest distance from the other particles at
 * which loose ones are shown, divided by the extent of the others [1]. */
static const double SEPARATED = 1.5, BESIDE = 0.2, ALL_BONDS = 0.999;
enum { LOOSE_MOST = 2 };

static int plot_curves_by_place(const void *a, const void *b)
{
    const double x = ((const struct station *)a)->x, y = ((const struct station *)b)->x;
    return (x > y) - (x < y);
}

/* Returns true if the bar has separated between the neighbours a and b: they are farther apart than SEPARATED spacings,
 * belong to different fragments, or one has no bond left. spacing: spacing of the particles [m]. */
static bool stations_are_parted(const struct station *a, const struct station *b, double spacing)
{
    return b->x - a->x > SEPARATED * spacing || (a->fragment >= 0 && b->fragment >= 0 && a->fragment != b->fragment) ||
           fmaxf(a->value[2], b->value[2]) > ALL_BONDS;
}

/* Returns the profile of output frame f along a bar. value: values of a field at its particles, or NULL for velocity,
 * stress and damage; spacing: spacing of the particles [m]; projection: states whether labels name load steps instead
 * of times. Release the member `at` with memory_free. */
static struct bar_profile profile_make(const struct output_frame *f, const float *value, double spacing,
                                       const struct projection *projection)
{
    struct bar_profile p = {NEW("plot.profile", f->n, struct station), f->n, f->t, ""};
    (void)frame_compose_label_if_static(p.label, projection->in_steps,
                                        projection_shows_single_equilibrium_run(projection), f->t, f->step);
    for (int64_t i = 0; i < f->n; i++)
        p.at[i] = (struct station){.x = f->X[0][i] + f->u[0][i],
                                   .value = {value ? value[i] : f->v[0][i], f->stress[0][i], f->damage[i]},
                                   .fragment = f->fragment ? f->fragment[i] : -1};
    array_sort(p.at, p.n, sizeof *p.at, plot_curves_by_place);
    for (int64_t i = 0, from = 0; i < p.n; i++) {
        if (i + 1 < p.n && !stations_are_parted(&p.at[i], &p.at[i + 1], spacing)) continue;
        for (int64_t k = from; k <= i; k++) p.at[k].loose = i + 1 - from <= LOOSE_MOST && p.n > LOOSE_MOST;
        from = i + 1;
    }
    return p;
}

static void profiles_free(struct bar_profile *profile, int profiles)
{
    for (int k = 0; k < profiles; k++) memory_free(profile[k].at);
    memory_free(profile);
}

static double station_number(const struct station *s, int column) { return column < 0 ? s->x : s->value[column]; }

/* Returns the range of one quantity in profile[profiles]: of the position for column -1, else of value number
 * `column`. Loose particles (of pieces of at most LOOSE_MOST particles) count only if there are no others, or if
 * `loose` is true. */
static struct value_range profiles_range(const struct bar_profile *profile, int profiles, int column, bool loose)
{
    struct value_range e = {INFINITY, -INFINITY};
    for (int pass = 0; pass < 2 && !(e.low <= e.high); pass++)
        for (int k = 0; k < profiles; k++)
            for (int64_t i = 0; i < profile[k].n; i++) {
                const double a = station_number(&profile[k].at[i], column);
                if (profile[k].at[i].loose && pass == 0 && !loose) continue;
                e.low = fmin(e.low, a), e.high = fmax(e.high, a);
            }
    return e;
}

/* Returns the range [m] of the axis along the bar for profile[profiles]: it contains, with half a spacing at both ends,
 * all particles that are not loose (in a piece of at most LOOSE_MOST particles), and loose particles whose distance
 * from these is at most BESIDE times the extent of the others. spacing: spacing of the particles [m]. */
static struct value_range profiles_axis(const struct bar_profile *profile, int profiles, double spacing)
{
    const struct value_range bulk = profiles_range(profile, profiles, -1, false);
    const double beside = BESIDE * (bulk.high - bulk.low);
    struct value_range axis = bulk;
    for (int k = 0; k < profiles; k++)
        for (int64_t i = 0; i < profile[k].n; i++) {
            const double x = profile[k].at[i].x;
            if (x < bulk.low - beside || x > bulk.high + beside) continue;
            axis.low = fmin(axis.low, x), axis.high = fmax(axis.high, x);
        }
    const double more = 0.5 * spacing + 1e-3 * (axis.high - axis.low); /* rounding must not remove tics at the ends */
    return (struct value_range){axis.low - more, axis.high + more};
}

/* Writes the gnuplot command for the range of a vertical axis to `to`: the range `of` of the values, divided by
 * `factor`, the unit of the axis, with a margin. If all values are equal, gnuplot chooses the range. */
static void write_value_range(FILE *to, struct value_range of, double factor)
{
    const double margin = 0.06 * (of.high - of.low);
    if (of.high > of.low)
        fprintf(to, "set yrange [%.9g:%.9g]\n", (of.low - margin) / factor, (of.high + margin) / factor);
    else
        fputs("set autoscale y\n", to);
}

/* Returns the largest number of particles of one of profile[profiles] that the picture does not show: their position is
 * outside the range `axis` [m], or a value is outside its range in of[columns] with the margin of write_value_range. */
static int64_t profiles_outside(const struct bar_profile *profile, int profiles, struct value_range axis,
                                const struct value_range *of, int columns)
{
    int64_t most = 0;
    for (int k = 0; k < profiles; k++) {
        int64_t outside = 0;
        for (int64_t i = 0; i < profile[k].n; i++) {
            const struct station *s = &profile[k].at[i];
            bool in = s->x >= axis.low && s->x <= axis.high;
            for (int c = 0; c < columns && of[c].high > of[c].low; c++) {
                const double margin = 0.06 * (of[c].high - of[c].low);
                in = in && s->value[c] >= of[c].low - margin && s->value[c] <= of[c].high + margin;
            }
            outside += !in;
        }
        most = outside > most ? outside : most;
    }
    return most;
}

/* Sends profile[profiles] to gnuplot through `to`: number K as the data block $fK with positions and values of its
 * particles from left to right, an empty line where the bar has separated, and as $lK those of its loose particles (of
 * pieces of at most LOOSE_MOST particles). spacing: spacing of the particles [m]; factor[4]: units of position and
 * values. */
static void profiles_send(FILE *to, const struct bar_profile *profile, int profiles, double spacing,
                          const double *factor)
{
    for (int k = 0; k < profiles; k++)
        for (int loose = 0; loose < 2; loose++) {
            fprintf(to, "$%c%d << EOD\n", "fl"[loose], k);
            for (int64_t i = 0; i < profile[k].n; i++) {
                const struct station *s = &profile[k].at[i];
                if (loose && !s->loose) continue;
                if (!loose && i > 0 && stations_are_parted(s - 1, s, spacing)) putc('\n', to);
                fprintf(to, "%.12g %.7g %.7g %.7g\n", s->x / factor[0], s->value[0] / factor[1],
                        s->value[1] / factor[2], s->value[2] / factor[3]);
            }
            fputs(loose ? "NaN NaN NaN NaN\nEOD\n" : "EOD\n", to); /* gnuplot refuses a block without points */
        }
}

static bool profile_has_loose(const struct bar_profile *p)
{
    bool any = false;
    for (int64_t i = 0; i < p->n; i++) any |= p->at[i].loose;
    return any;
}

/* Returns the largest absolute value in the range `of`. */
static double range_magnitude(struct value_range of) { return fmax(fabs(of.low), fabs(of.high)); }

/* Writes the label of profile p in the key (legend) to label[]: its load step, or its time in the unit `second`. */
static void profile_write_label(char label[NAME_MAX_LENGTH], const struct bar_profile *p, const struct unit *second)
{
    if (p->label[0])
        snprintf(label, NAME_MAX_LENGTH, "%s", p->label);
    else
        snprintf(label, NAME_MAX_LENGTH, "%.3g %s", p->t / second->factor, second->name);
}

/* Returns the number of letters of the longest label in the key (legend) of profile[profiles]. */
static size_t longest_label(const struct bar_profile *profile, int profiles)
{
    size_t longest = TIME_LETTERS;
    for (int k = 0; k < profiles; k++) longest = (size_t)fmax((double)longest, (double)strlen(profile[k].label));
    return longest;
}

/* Writes the gnuplot command that plots value number `column` of profile[profiles] against the position to `to`, each
 * profile with its time in the key (legend). */
static void plot_profiles(FILE *to, const struct bar_profile *profile, int profiles, int column)
{
    struct unit second = unit_with_si_prefix_for_largest_value(profile[profiles - 1].t, "s");
    fputs("plot ", to);
    for (int k = 0; k < profiles; k++) {
        char colour[COLOUR_ROOM], label[NAME_MAX_LENGTH];
        curve_colour_write_by_time_order(colour, k, profiles);
        profile_write_label(label, &profile[k], &second);
        fprintf(to, "%s$f%d using 1:%d with lines lw 1.8 lc rgb '%s' title '%s'", k > 0 ? ", " : "", k, column + 2,
                colour, label);
        if (profile_has_loose(&profile[k]))
            fprintf(to, ", $l%d using 1:%d with points pt 7 ps 0.6 lc rgb '%s' notitle", k, column + 2, colour);
    }
    putc('\n', to);
}

/* Draws velocity, stress and damage of profile[profiles] in panels one above another on the picture `sheet`; velocity
 * and damage only if they are not 0 everywhere. title: title of the picture; spacing: spacing of the particles [m].
 * Returns FAILED, with a message, if gnuplot fails. */
static status profiles_draw(struct output_picture sheet, const char *title, const struct bar_profile *profile,
                            int profiles, double spacing)
{
    struct gnuplot g;
    struct value_range of[3];
    char label[3][64] = {"", "", "damage"}, text[TITLE_LENGTH];
    for (int c = 0; c < 3; c++) of[c] = profiles_range(profile, profiles, c, false);
    const struct value_range x = profiles_axis(profile, profiles, spacing);
    const struct unit metre = unit_for_length(x.high - x.low),
                      speed = unit_with_si_prefix_for_largest_value(range_magnitude(of[0]), "m/s"),
                      pascal = unit_with_si_prefix_for_largest_value(range_magnitude(of[1]), "Pa");
    const double factor[4] = {metre.factor, speed.factor, pascal.factor, 1};
    int shown[3], panels = 0;
    for (int c = 0; c < 3; c++)
        if (c == 1 || range_magnitude(of[c]) > 0) shown[panels++] = c;
    of[2] = (struct value_range){0, 1};
    snprintf(label[0], sizeof label[0], "velocity x [%s]", speed.name);
    snprintf(label[1], sizeof label[1], "stress [%s]", pascal.name);
    title_append_count_of_particles_outside_view(text, title, profiles_outside(profile, profiles, x, of, 2));
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1080, 130 + 263 * panels));
    profiles_send(g.to, profile, profiles, spacing, factor);
    curves_write_title(&g, text, "");
    const struct curves_layout l = curves_layout_make(&g, profiles, longest_label(profile, profiles), false, panels);
    const double each = (curves_layout_height_of_all_panels(&l) - PANEL_GAP * (panels - 1)) / panels;
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to, "set multiplot\nset format x ''\nset xrange [%.9g:%.9g]\n", x.low / metre.factor,
            x.high / metre.factor);
    for (int k = 0; k < panels; k++) {
        const int c = shown[k];
        const double from = k * (each + PANEL_GAP);
        curves_write_panel_margins(g.to, &l, from, from + each);
        curves_write_vertical_tics(g.to, "y", of[c].low / factor[c + 1], of[c].high / factor[c + 1], each);
        fprintf(g.to, "set ylabel '%s'\n", label[c]);
        if (k == panels - 1) fprintf(g.to, "set format x '%%g'\nset xlabel 'x [%s]'\n", metre.name);
        if (c == 2)
            fputs("set yrange [0:1.04]\n", g.to);
        else
            write_value_range(g.to, of[c], factor[c + 1]);
        plot_profiles(g.to, profile, profiles, c);
        fputs("unset label\nunset key\n", g.to);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

status bar_profiles_draw(struct output_picture picture, const char *title, const struct projection *projection,
                         const struct output_frame *frame, int frame_count)
{
    const double spacing = frame_particle_spacing(&frame[0]);
    struct bar_profile *profile = NEW("plot.profiles", frame_count, struct bar_profile);
    for (int k = 0; k < frame_count; k++) profile[k] = profile_make(&frame[k], NULL, spacing, projection);
    const status s = profiles_draw(picture, title, profile, frame_count, spacing);
    profiles_free(profile, frame_count);
    return s;
}

/* Draws a field along a bar, value[0] of profile[profiles], on the picture `sheet`. title: title of the picture; field:
 * name, unit and colour scale of the field; spacing: spacing of the particles [m]. Returns FAILED, with a message, if
 * gnuplot fails. */
static status field_profile_draw(struct output_picture sheet, const char *title, const struct plot_field *field,
                                 const struct bar_profile *profile, int profiles, double spacing)
{
    struct gnuplot g;
    char label[64], name[NAME_MAX_LENGTH], text[TITLE_LENGTH];
    const bool moves = strcmp(field->unit, "m/s") == 0 || strcmp(field->unit, "m") == 0; /* far apart for loose ones */
    const struct value_range of = profiles_range(profile, profiles, 0, !moves),
                             x = profiles_axis(profile, profiles, spacing);
    const struct unit metre = unit_for_length(x.high - x.low),
                      own = unit_with_si_prefix_if_unit_allows_it(field->unit, range_magnitude(of));
    const double factor[4] = {metre.factor, own.factor, 1, 1};
    plot_field_write_label(name, sizeof name, field);
    snprintf(label, sizeof label, *own.name ? "%.40s [%s]" : "%.40s", name, own.name);
    title_append_count_of_particles_outside_view(text, title, profiles_outside(profile, profiles, x, &of, 1));
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1000, 560));
    profiles_send(g.to, profile, profiles, spacing, factor);
    curves_write_title(&g, text, "");
    const struct curves_layout l = curves_layout_make(&g, profiles, longest_label(profile, profiles), false, 1);
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to, "set xlabel 'x [%s]'\nset ylabel '%s'\nset xrange [%.9g:%.9g]\n", metre.name, label,
            x.low / metre.factor, x.high / metre.factor);
    write_value_range(g.to, of, factor[1]);
    if (field->scale == CATEGORY && range_magnitude(of) < 12) fputs("set ytics 1\n", g.to);
    plot_profiles(g.to, profile, profiles, 0);
    return gnuplot_close(&g);
}

status field_profiles_draw(struct output_picture picture, const char *title, const struct projection *projection,
                           float *const *value_of_frame, const struct output_frame *frame, int frame_count)
{
    const double spacing = frame_particle_spacing(&frame[0]);
    struct bar_profile *profile = NEW("plot.profiles", frame_count, struct bar_profile);
    for (int k = 0; k < frame_count; k++) profile[k] = profile_make(&frame[k], value_of_frame[k], spacing, projection);
    const status s = field_profile_draw(picture, title, projection->field, profile, frame_count, spacing);
    profiles_free(profile, frame_count);
    return s;
}
