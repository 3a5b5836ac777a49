/* Chooses the rectangle and the range of values that maps show. Both are determined by most of the particles, so that a
 * few distant particles or extreme values do not matter. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "maps_parts.h"
#include "scene/words.h"

enum { SAMPLE_MOST = 100000 }; /* number of values of which quantiles are computed */

static int plot_view_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Copies the finite values among value[n], at most SAMPLE_MOST of them evenly spaced by index, into
 * sample[SAMPLE_MOST]. Returns their number. */
static int64_t sample_values(double *sample, const float *value, int64_t n)
{
    const int64_t stride = n / SAMPLE_MOST + 1;
    int64_t kept = 0;
    for (int64_t i = 0; i < n; i += stride)
        if (isfinite(value[i])) sample[kept++] = value[i];
    return kept;
}

/* Copies the finite positions among position[n] [m], at most SAMPLE_MOST of them evenly spaced by index, to
 * sample[SAMPLE_MOST]. Returns their number. */
static int64_t sample_positions(double *sample, const double *position, int64_t n)
{
    const int64_t stride = n / SAMPLE_MOST + 1;
    int64_t kept = 0;
    for (int64_t i = 0; i < n; i += stride)
        if (isfinite(position[i])) sample[kept++] = position[i];
    return kept;
}

/* A range of values. */
struct span {
    double from, to;
};

/* Returns the range of sample[kept] without outliers: omits at each end the share `share` of the values or, if that is
 * more, `few` values, but at most 1/20 of all. Returns an empty range if there are no values. Sorts the sample. */
static struct span bulk_of(double *sample, int64_t kept, double share, int64_t few)
{
    array_sort(sample, kept, sizeof *sample, plot_view_ascending);
    const int64_t part = (int64_t)(share * (double)(kept - 1));
    const int64_t least = few < kept / 20 ? few : kept / 20, k = part > least ? part : least;
    return kept ? (struct span){sample[k], sample[kept - 1 - k]} : (struct span){INFINITY, -INFINITY};
}

static struct span positions_extent(const double *value, int64_t n)
{
    struct span s = {INFINITY, -INFINITY};
    for (int64_t i = 0; i < n; i++) s.from = fmin(s.from, value[i]), s.to = fmax(s.to, value[i]);
    return s;
}

/* Returns the range to be shown [m] along axis k (0 or 1) of the map. It contains the initial body. For each of the
 * output frames cloud[clouds] it contains the range of the particles without the outermost 1 % at each end, extended
 * by 20 % at both ends. It is limited to the extent of all particles. */
static struct span span_along(const struct plotted_particles *cloud, int clouds, int k)
{
    static const double SHARE = 0.01, BESIDE = 0.2;
    double *sample = NEW("plot.sample", SAMPLE_MOST, double);
    struct span shown = {INFINITY, -INFINITY}, all = shown;
    for (int c = 0; c < clouds; c++) {
        const struct span here = positions_extent(cloud[c].position[k], cloud[c].n);
        struct span bulk = bulk_of(sample, sample_positions(sample, cloud[c].position[k], cloud[c].n), SHARE, 0);
        const double beside = BESIDE * (bulk.to - bulk.from);
        all.from = fmin(all.from, here.from), all.to = fmax(all.to, here.to);
        shown.from = fmin(shown.from, fmin(bulk.from - beside, cloud[c].from[k]));
        shown.to = fmax(shown.to, fmax(bulk.to + beside, cloud[c].to[k]));
    }
    memory_free(sample);
    return (struct span){fmax(shown.from, all.from), fmin(shown.to, all.to)};
}

/* Returns the number of particles of `plotted` that are outside the rectangle of the view v. */
static int64_t count_outside(const struct view *v, const struct plotted_particles *plotted)
{
    int64_t outside = 0;
    for (int64_t i = 0; i < plotted->n; i++) {
        bool in = true;
        for (int k = 0; k < 2; k++)
            in = in && plotted->position[k][i] >= v->from[k] && plotted->position[k][i] <= v->to[k];
        outside += !in;
    }
    return outside;
}

/* Largest ratio of height to width (UPRIGHT_MOST) and of width to height (FLAT_MOST) of the rectangle of a map. The
 * rectangle around a more slender body is widened, so that there is space for the numbers at the axis across the
 * body. */
static const double UPRIGHT_MOST = 8, FLAT_MOST = 20;

/* Widens the rectangle of the view v of a slender body at both sides. */
static void view_widen_slender(struct view *v)
{
    const double size[2] = {v->to[0] - v->from[0], v->to[1] - v->from[1]};
    for (int k = 0; k < 2; k++) {
        const double more = fmax(0.5 * (size[1 - k] / (k == 0 ? UPRIGHT_MOST : FLAT_MOST) - size[k]), 0);
        v->from[k] -= more, v->to[k] += more;
    }
}

struct view view_make_around_particles(const struct plotted_particles *frame_particles, int frame_count)
{
    struct view v = {.top = 0.5};
    double longest = 0, reach = 0;
    for (int k = 0; k < 2; k++) {
        const struct span s = span_along(frame_particles, frame_count, k);
        v.from[k] = s.from, v.to[k] = s.to;
        longest = fmax(longest, s.to - s.from);
    }
    for (int c = 0; c < frame_count; c++)
        for (int64_t i = 0; i < frame_particles[c].n; i++) {
            v.top = fmax(v.top, fmin(frame_particles[c].damage[i], 1));
            if (frame_particles[c].size) reach = fmax(reach, 0.5 * frame_particles[c].size[i]);
        }
    v.top = ceil(10 * v.top - 1e-3) / 10; /* the colour bar ends at a multiple of 0.1, at least 0.5 */
    double margin = fmax(fmax(frame_particles[0].spacing, reach), 0.02 * longest);
    if (!(margin > 0)) margin = 1e-3; /* a single particle: 1 mm around it */
    for (int k = 0; k < 2; k++) {
        const double beside = k == 1 && frame_particles[0].tall > 0 ? 1.5 * frame_particles[0].tall : margin;
        v.from[k] -= beside, v.to[k] += beside;
    }
    view_extend_to_rigid_bodies(&v, frame_particles, frame_count);
    view_widen_slender(&v);
    for (int c = 0; c < frame_count; c++)
        v.outside = (int64_t)fmax((double)v.outside, (double)count_outside(&v, &frame_particles[c]));
    return v;
}

/* Constants of the upper end of a colour scale (magnitude_of). EXTREME: fraction of the values that may be above the
 * end; at least EXTREMES_LEAST values. HOT, HOT_TIMES: the end is at most HOT_TIMES the value that the fraction HOT of
 * all values exceeds, so that a small region of high values, such as a contact, does not determine it. */
static const double EXTREME = 0.002, HOT = 0.01, HOT_TIMES = 1.5;
enum { EXTREMES_LEAST = 3 };

/* Returns the largest magnitude of a value of the field of `plotted` that its colour scale has to cover. The magnitude
 * is the distance above `low`, or the absolute value if `scale` is that of a field of both signs. Only magnitudes above
 * 0 count, because most of a body can be at rest or elastic. The share EXTREME of the largest ones, or EXTREMES_LEAST
 * of them (at most a twentieth), is omitted as outliers, and the result is limited to HOT_TIMES the magnitude that the
 * share HOT of them exceeds. Returns 0 if none is above 0. sample[SAMPLE_MOST]: work array. */
static double magnitude_of(double *sample, const struct plotted_particles *plotted, enum field_scale scale, double low)
{
    const int64_t stride = plotted->n / SAMPLE_MOST + 1;
    int64_t n = 0;
    for (int64_t i = 0; i < plotted->n; i += stride) {
        const double w = scale == BOTH_SIGNS ? fabs(plotted->value[i]) : plotted->value[i] - low;
        if (isfinite(w) && w > 0) sample[n++] = w;
    }
    if (n == 0) return 0;
    array_sort(sample, n, sizeof *sample, plot_view_ascending);
    const int64_t least = EXTREMES_LEAST < n / 20 ? EXTREMES_LEAST : n / 20,
                  part = (int64_t)(EXTREME * (double)(n - 1));
    const double end = sample[n - 1 - (part > least ? part : least)],
                 hot = sample[n - 1 - (int64_t)(HOT * (double)(n - 1))];
    return fmin(end, HOT_TIMES * hot);
}

void view_set_field_and_colour_range(struct view *v, const struct plot_field *field,
                                     const struct plotted_particles *frame_particles, int frame_count)
{
    double *sample = NEW("plot.sample", SAMPLE_MOST, double);
    double low = field->scale == FROM_LEAST ? INFINITY : 0, high = 0;
    for (int c = 0; c < frame_count && field->scale == FROM_LEAST; c++)
        low = fmin(low, bulk_of(sample, sample_values(sample, frame_particles[c].value, frame_particles[c].n), EXTREME,
                                EXTREMES_LEAST)
                            .from);
    for (int c = 0; c < frame_count; c++)
        high = fmax(high, magnitude_of(sample, &frame_particles[c], field->scale, low));
    memory_free(sample);
    if (!isfinite(low)) low = 0;
    if (!(high > 0)) high = 1; /* all values are equal */
    v->field = field, v->low = field->scale == BOTH_SIGNS ? -high : low, v->high = low + high;
}

/* Reads an end of the colour scale of a field, a number with a unit of the field, from the request r into *value, in SI
 * units. end: 0 for the lower end, 1 for the upper end; an end without a unit has the unit of the other end. Returns
 * REFUSED, with a message, for other texts. */
static status range_end_read(real *value, const struct plot_request *r, int end, const struct plot_field *field)
{
    char what[256], text[128];
    number_text_append_unit_if_missing(text, sizeof text, r->range[end], r->range[1 - end]);
    if (value_parse_with_unit_symbol(value, text, field->unit, what, sizeof what)) return OK;
    return status_set(REFUSED, "plot: --range %s:%s: %s: %s", printable_name(r->range[0]).text,
                      printable_name(r->range[1]).text, printable_name(r->range[end]).text, what);
}

/* Counts in each of the output frames cloud[clouds] the particles whose values are below and above the ends of the
 * colour scale of view v, and stores the largest numbers in v->beyond. */
static void count_beyond(struct view *v, const struct plotted_particles *cloud, int clouds)
{
    const bool damage = colour_map_kind_for_field(v->field) == MAP_DAMAGE;
    const float low = (float)(damage ? v->bottom : v->low), high = (float)(damage ? v->top : v->high);
    const float slack = 1e-5F * (high - low); /* round-off of frames: a damage of 1 may be 1.000001 */
    v->beyond[0] = v->beyond[1] = 0;
    for (int c = 0; c < clouds && cloud[c].value; c++) {
        int64_t below = 0, above = 0;
        for (int64_t i = 0; i < cloud[c].n; i++) {
            below += cloud[c].value[i] < low - slack;
            above += cloud[c].value[i] > high + slack;
        }
        if (below > v->beyond[0]) v->beyond[0] = below;
        if (above > v->beyond[1]) v->beyond[1] = above;
    }
}

/* Sets the rectangle of the view v, and the ends and the table of its colours, to the options of the request r. Returns
 * REFUSED, with a message, if an end of the colours is no number with a unit of the field, or if the ends are in the
 * wrong order. */
static status view_set_options(struct view *v, const struct plot_request *r)
{
    v->table = r->table;
    if (r->range[0]) {
        real low, high;
        TRY(range_end_read(&high, r, 1, v->field));
        TRY(range_end_read(&low, r, 0, v->field));
        if (!(high > low))
            return status_set(REFUSED, "plot: --range %s:%s: give the lower end first",
                              printable_name(r->range[0]).text, printable_name(r->range[1]).text);
        v->low = v->bottom = low, v->high = v->top = high;
    }
    for (int a = 0; a < 2 && r->cropped; a++) v->from[a] = r->crop[a][0], v->to[a] = r->crop[a][1];
    if (r->cropped) v->outside = 0;
    return OK;
}

/* Returns true if the rectangle of view v shows a part of one of the output frames cloud[clouds]: a particle in the
 * rectangle or at most two spacings outside it, or a part of a rigid body. */
static bool view_shows_any(const struct view *v, const struct plotted_particles *cloud, int clouds)
{
    bool any = false;
    for (int c = 0; c < clouds && !any; c++) {
        struct view wider = *v;
        for (int a = 0; a < 2; a++) wider.from[a] -= 2 * cloud[c].spacing, wider.to[a] += 2 * cloud[c].spacing;
        any = count_outside(&wider, &cloud[c]) < cloud[c].n || view_shows_any_rigid_body(v, &cloud[c]);
    }
    return any;
}

/* Largest side of a rectangle that the option --crop may request, divided by that of the rectangle around
 * everything. */
static const double CROP_MOST = 200;

/* Returns REFUSED, with a message, if the view v is cropped to a rectangle that shows no particle and no rigid body, or
 * that is CROP_MOST times as large as the view of everything; else OK. around: view of everything, whose rectangle the
 * message states; r: request with the crop; cloud[clouds]: drawn particles of the output frames. */
static status view_check_crop(const struct view *v, const struct view *around, const struct plot_request *r,
                              const struct plotted_particles *cloud, int clouds)
{
    bool huge = r->cropped;
    for (int a = 0; a < 2; a++) huge = huge && v->to[a] - v->from[a] > CROP_MOST * (around->to[a] - around->from[a]);
    if (!r->cropped || (!huge && view_shows_any(v, cloud, clouds))) return OK;
    const struct unit metre = panel_choose_length_unit_of_axes(around);
    const double f = metre.factor;
    return status_set(REFUSED, "plot: --crop: %s; give a part of %.6g%s:%.6g%s,%.6g%s:%.6g%s",
                      huge ? "the body would be a point in this rectangle (its unit is m if none is given)"
                           : "no particle is in this rectangle",
                      around->from[0] / f, metre.name, around->to[0] / f, metre.name, around->from[1] / f, metre.name,
                      around->to[1] / f, metre.name);
}

status view_make_for_request(struct view *v, const struct plot_request *r,
                             const struct plotted_particles *frame_particles, int frame_count)
{
    *v = view_make_around_particles(frame_particles, frame_count);
    view_set_field_and_colour_range(v, r->projection.field, frame_particles, frame_count);
    const struct scene *scene = r->projection.scene;
    if (scene && scene->dim == 2) v->notches = scene->cracks, v->notch = scene->crack;
    const struct view around = *v;
    TRY(view_set_options(v, r));
    TRY(view_check_crop(v, &around, r, frame_particles, frame_count));
    count_beyond(v, frame_particles, frame_count);
    if (isfinite(v->to[0] - v->from[0]) && isfinite(v->to[1] - v->from[1])) return OK;
    return status_set(
        FAILED,
        "%s: the frames have no particles, or positions that are not numbers; run the scene again with --overwrite",
        r->folder);
}

bool matrix_invert_3x3(const double matrix[3][3], double inverse[3][3])
{
    double determinant = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            const int m = (c + 1) % 3, n = (c + 2) % 3, o = (r + 1) % 3, q = (r + 2) % 3;
            inverse[r][c] = matrix[m][o] * matrix[n][q] - matrix[m][q] * matrix[n][o];
        }
    for (int c = 0; c < 3; c++) determinant += matrix[0][c] * inverse[c][0];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) inverse[r][c] /= determinant;
    return fabs(determinant) > 0;
}

struct colour view_colour_at_scale_position(const struct view *v, enum map map, double a)
{
    if (map == MAP_KIND) return colour_on_peridynamic_particle_scale(a);
    const bool signs =
        map == MAP_FIELD && v->field && v->field->scale == BOTH_SIGNS && (!v->table || v->table == COLOURS_DIVERGING);
    if (signs && v->low <= 0 && v->high >= 0) /* the middle colour is that of 0 */
        a = 0.5 + 0.5 * (v->low + a * (v->high - v->low)) / fmax(-v->low, v->high);
    if (v->table) return colour_from_table(v->table, a);
    if (map == MAP_FIELD && v->field)
        return colour_from_table(v->field->scale == BOTH_SIGNS ? COLOURS_DIVERGING : COLOURS_VIRIDIS, a);
    return colour_on_damage_scale(a);
}

struct colour plotted_particle_colour(const struct view *v, const struct plotted_particles *plotted, int64_t i,
                                      enum map map)
{
    if (plotted->colour) return plotted->colour[i];
    if (map == MAP_FRAGMENT && plotted->fragment) return fragment_colour(plotted->fragment[i]);
    if (map == MAP_CATEGORY && plotted->value) return category_colour(v->field, plotted->value[i]);
    if (map == MAP_KIND && plotted->kind[i] == KIND_MPM) return colour_of_material_points();
    if (map == MAP_FIELD && plotted->value)
        return view_colour_at_scale_position(v, map, (plotted->value[i] - v->low) / (v->high - v->low));
    return view_colour_at_scale_position(v, map, (plotted->damage[i] - v->bottom) / (v->top - v->bottom));
}
