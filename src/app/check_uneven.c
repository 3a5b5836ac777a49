/* Manages the list of the narrow parts that have too many or too few particle rows, and prints it. */
#include "check_uneven.h"

#include <math.h>

#include "check_parts.h"
#include "scene/fill.h"

#define SAME_WIDTH 0.05 /* largest relative difference of widths that are counted together */
#define SAME_PLACE 2    /* largest distance of two measurements of one width [spacings] */
enum { TRIED = 8 };     /* number of row counts for which a spacing is tried */

/* Returns true if a part of a body may be added to `list`, the parts with the largest errors: the list is not full, or
 * |error| exceeds 0.9 times the smallest |error| in it. error: relative error of the width of the part's particles [1].
 * The factor 0.9 allows for errors of equal parts, which differ by up to a tenth because they are estimated from
 * samples. */
bool width_misfit_list_error_is_large_enough_to_add(const struct width_misfit_list *list, real error)
{
    return list->n < UNEVEN_MOST || fabs(error) > 0.9 * fabs(list->part[list->n - 1].off);
}

/* Returns true if the narrow parts a and b differ in width by less than the fraction SAME_WIDTH, and both have too many
 * rows of particles or both have too few. */
static bool same_width(const struct narrow_part *a, const struct narrow_part *b)
{
    return fabs(a->width - b->width) < SAME_WIDTH * b->width && a->off * b->off > 0;
}

/* Returns true if the narrow parts a and b have their widths along the same axis and positions within SAME_PLACE
 * spacings of scene s (the input file). They are then one part that was found twice: in the whole body, and in its
 * piece of one material. */
static bool same_place(const struct narrow_part *a, const struct narrow_part *b, const struct scene *s)
{
    real r2 = 0;
    for (int d = 0; d < s->dim; d++) r2 += square(a->at[d] - b->at[d]);
    return a->axis == b->axis && r2 < square(SAME_PLACE * s->spacing);
}

void width_misfit_list_add_narrow_part(struct width_misfit_list *list, const struct narrow_part *u, bool already_listed)
{
    struct narrow_part *part = list->part, added = *u;
    int place = list->n;
    added.material = list->piece.material;
    for (int k = 0; k < list->n && place == list->n; k++)
        if (same_width(&part[k], u)) place = k;
    if (place < list->n) {
        struct narrow_part *like = &part[place];
        already_listed = already_listed || (like->material != added.material && same_place(like, u, list->piece.scene));
        like->more += !already_listed;
        if (fabs(like->off) >= fabs(u->off)) return;
        added.more = like->more;
    } else if (list->n < UNEVEN_MOST) {
        list->n++;
    } else {
        place = UNEVEN_MOST - 1;
        if (fabs(part[place].off) >= fabs(u->off)) return;
    }
    part[place] = added;
    for (int k = place; k > 0 && fabs(part[k].off) > fabs(part[k - 1].off); k--) {
        const struct narrow_part other = part[k];
        part[k] = part[k - 1], part[k - 1] = other;
    }
}

real body_piece_distance_to_surface_along_axis(const struct body_piece *p, const real *X, int axis, real step,
                                               real max_distance)
{
    enum { HALVINGS = 30 };
    real Y[DIM_MAX], inside = 0;
    for (int d = 0; d < DIM_MAX; d++) Y[d] = X[d];
    for (int k = 1;; k++, inside += step) {
        if (fabs(inside) >= max_distance) return max_distance;
        Y[axis] = X[axis] + k * step;
        if (!body_piece_contains_point(p, Y, 0)) break;
    }
    real outside = inside + step;
    for (int k = 0; k < HALVINGS; k++) {
        const real middle = 0.5 * (inside + outside);
        Y[axis] = X[axis] + middle;
        if (body_piece_contains_point(p, Y, 0))
            inside = middle;
        else
            outside = middle;
    }
    return fabs(inside);
}

/* Computes the coordinates at which the piece p (a body, or its part of one material) ends below and above the point
 * u->at, along the axis u->axis of the width, and stores them in *low and *high [m]. */
static void width_ends(const struct body_piece *p, const struct narrow_part *u, real *low, real *high)
{
    const real h = p->scene->spacing, most = 4000 * h;
    *low = u->at[u->axis] - body_piece_distance_to_surface_along_axis(p, u->at, u->axis, -0.05 * h, most);
    *high = u->at[u->axis] + body_piece_distance_to_surface_along_axis(p, u->at, u->axis, 0.05 * h, most);
}

/* Measures the width of the narrow part u of piece p on the line along u->axis through the point u->at. u->width must
 * contain an estimate from areas. The measured width replaces this estimate, and u->measured is set to true, if two
 * conditions hold: the two widths differ by less than 10 %, and the measured width differs from u->filled, the width of
 * the rows of particles, by more than half the estimated error. */
static void width_measure(struct narrow_part *u, const struct body_piece *p)
{
    real low, high;
    if (u->measured || !body_piece_contains_point(p, u->at, 0)) return;
    width_ends(p, u, &low, &high);
    const real width = high - low;
    u->measured = fabs(width - u->width) < 0.1 * u->width && fabs(u->filled - width) > 0.5 * fabs(u->off) * width;
    if (u->measured) u->width = width;
}

/* Returns the number of lattice rows of the piece p (a body, or its part of one material) between the coordinates `low`
 * and `high` along `axis` [m], if the spacing of its scene were `spacing` [m]; -1 if the lattice of the body cannot be
 * determined for this spacing. */
static int64_t rows_at(const struct body_piece *p, int axis, real low, real high, real spacing)
{
    struct scene other = *p->scene;
    real X[DIM_MAX] = {0};
    other.spacing = spacing;
    if (body_lattice_compute_first_site_position(&other, p->body, X) != OK) return -1;
    const real first = ceil((low - X[axis]) / spacing - ON_SURFACE);
    const real last = floor((high - X[axis]) / spacing + ON_SURFACE);
    return (int64_t)(last - first) + 1;
}

/* A unit of length. */
struct length_unit {
    real size;
    const char *name;
};

/* Returns the largest unit of length (m, mm, ...) in which the number for `spacing` [m] is at least 0.1. */
static struct length_unit unit_of_spacing(real spacing)
{
    static const struct length_unit unit[] = {{1, "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}};
    size_t k = 0;
    while (k + 1 < COUNT_OF(unit) && spacing < 0.0999 * unit[k].size) k++;
    return unit[k];
}

/* Prints to `out` the nearest smaller and the nearest larger spacing with which the narrow part u of piece p gets the
 * right number of lattice rows: its width is then a whole number of spacings. Spacings are truncated to six digits. If
 * the present spacing divides the width already, prints how the part can be moved to fit the lattice. */
static void say_spacings(const struct narrow_part *u, const struct body_piece *p, FILE *out)
{
    const struct length_unit unit = unit_of_spacing(p->scene->spacing);
    const real cells = u->width / p->scene->spacing, more = ceil(cells * (1 - 1e-3));
    real low, high;
    int said = 0;
    if (fabs(cells - nearbyint(cells)) < 1e-3 * cells) {
        fprintf(out, "; particles.spacing divides its width, but its faces are not midway between particles of the "
                     "lattice that begins at the first solid of the body: move this part by half a spacing\n");
        return;
    }
    width_ends(p, u, &low, &high);
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < TRIED; k++) {
            const real rows = side == 0 ? more + k : more - 1 - k;
            if (rows < 1) break;
            char text[32];
            snprintf(text, sizeof text, "%.6g", u->width / rows / unit.size * (1 - 5e-7));
            if (rows_at(p, u->axis, low, high, strtod(text, NULL) * unit.size) != (int64_t)rows) continue;
            fprintf(out, "%s%s %s", said++ ? " or " : "; particles.spacing ", text, unit.name);
            break;
        }
    fprintf(out, said ? " divides it\n" : "; use a smaller particles.spacing to reduce the difference\n");
}

struct length_text length_text_with_unit(real length, int digits, real spacing)
{
    const struct length_unit unit = unit_of_spacing(spacing);
    struct length_text out;
    snprintf(out.text, sizeof out.text, "%.*g %s", digits, length / unit.size, unit.name);
    return out;
}

static void say_place(const real *at, int dim, FILE *out)
{
    fprintf(out, dim > 1 ? "(%s) m" : "%s m", position_text(at, dim, 4).text);
}

/* Prints the beginning of a remark on the narrow part u of the piece p (a body, or its part of one material) to `out`:
 * the name of the body and, if the piece is of one material, the name of the material. */
static void say_owner(const struct narrow_part *u, const struct body_piece *p, FILE *out)
{
    fprintf(out, "accuracy       body %s: ", p->scene->body[p->body].name);
    if (u->material != ANY_MATERIAL) fprintf(out, "material %s: ", p->scene->material[u->material].name);
}

void print_parts_whose_width_misfits_spacing(struct width_misfit_list *list, FILE *out)
{
    const int dim = list->piece.scene->dim;
    int measured = 0;
    for (int k = 0; k < list->n; k++) {
        struct narrow_part *u = &list->part[k];
        const struct body_piece p = {list->piece.scene, list->piece.body, u->material};
        width_measure(u, &p);
        if (!u->measured) continue;
        say_owner(u, &p, out);
        fprintf(out, "a part %.4g m ", u->width);
        if (dim > 1)
            fprintf(out, "wide along %c, at ", "xyz"[u->axis]);
        else
            fprintf(out, "long, at ");
        say_place(u->at, dim, out);
        if (u->more > 0) fprintf(out, " (and %d more like it)", u->more);
        fprintf(out, ", is represented by %.4g m of particles: %s %.1f %% too %s", u->filled,
                dim > 1 ? "its sections are" : "it is", 100 * fabs(u->off),
                dim == 1     ? u->off > 0 ? "long" : "short"
                : u->off > 0 ? "large"
                             : "small");
        say_spacings(u, &p, out);
        measured++;
    }
    if (measured > 0 || list->n == 0) return;
    const struct narrow_part *worst = &list->part[0];
    say_owner(worst, &list->piece, out);
    fprintf(out, "its section across %c at ", "xyz"[worst->across]);
    say_place(worst->at, dim, out);
    fprintf(out,
            " is %.1f %% too %s, because a staircase of particles represents it; use a smaller particles.spacing to "
            "reduce this\n",
            100 * fabs(worst->off), worst->off > 0 ? "large" : "small");
}
