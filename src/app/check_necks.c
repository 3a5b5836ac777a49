/* Finds necks (ligaments between a hole, a notch or a slot and an edge) whose number of particle rows does not fit
 * their width. A run is a line of consecutive cells with particles along one axis. Runs that follow each other along
 * another axis are compared: a neck is a run that is shorter than the runs on both sides of it. The width of the shape
 * is measured there and compared with the number of particle rows. Both are averaged over a length equal to the width,
 * as the mean of their inverses, on which the compliance of the neck depends. */
#include <math.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "check_parts.h"
#include "check_uneven.h"
#include "scene/fill.h"

#define NARROW 12       /* rows; in wider necks one row is less than the reported errors */
#define COVERED 0.02    /* least share of a covered cell */
#define WITHIN 1e-6     /* least depth of a point that is not on the surface [spacings] */
#define OFF_CURVED 0.05 /* least relative error that is reported if the sides are curved or slanted */
#define GROWTH 0.25     /* least increase of the width on both sides of a neck [spacings] */
#define POINTS_MOST 4e6 /* largest number of points of pieces in 1D; more take too long */
enum {
    LONGEST = 64,   /* largest number of columns with one number of rows; more are a part, not a neck */
    SAMPLES = 5,    /* lines in a column of cells; odd, so that the lattice is one of them */
    FINE = 32,      /* points in a cell inside which the piece ends */
    NECKS_MOST = 64 /* largest number of necks that are measured in a piece */
};

/* State of the search for necks (narrow parts) in one piece, which is a body or all its parts of one material, with the
 * width along one axis. */
struct necks {
    const struct cell_coverage *cover; /* share of each cell that the shape covers; its cells index the arrays below */
    const struct run *engine;
    const struct body_piece *piece;
    int axis;                /* axis of the widths */
    int64_t stride[DIM_MAX]; /* step of the cell index along each axis */
    uint8_t *rows;  /* [cells] 1 + number of particles in the run along the axis through the cell, at most NARROW; 0: no
                       run */
    uint8_t *seen;  /* [cells] 1: the cell belongs to runs that have been compared */
    int64_t *stack; /* [cells] working memory: cells of a neck whose neighbours are not yet visited */
    int measured;   /* number of necks that have been measured */
};

/* The width of a piece (a body, or its part of one material) on one line along an axis: midpoint and length of the part
 * of the line inside the piece [m]. */
struct chord {
    real middle, width;
};

/* Returns true if the run of cells that contains `cell` continues to the next cell in the direction `way` (-1 or 1)
 * along k->axis. A run is a line of consecutive lattice cells that either all contain particles, or contain none
 * although the body partly covers each of them. */
static bool run_goes_on(const struct necks *k, int64_t cell, int way)
{
    const struct cell_coverage *c = k->cover;
    const int64_t next = cell + way * k->stride[k->axis];
    int64_t at[DIM_MAX];
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    if (at[k->axis] + way < 0 || at[k->axis] + way >= c->n[k->axis]) return false;
    return c->filled[next] == c->filled[cell] && (c->filled[next] || c->share[next] > COVERED);
}

/* Returns the number of cells in the run whose first cell is `from`. A run is a line of consecutive lattice cells along
 * k->axis. Either all of its cells contain particles, or none does although the body partly covers each of them. */
static int64_t run_span(const struct necks *k, int64_t from)
{
    int64_t n = 1;
    while (run_goes_on(k, from + (n - 1) * k->stride[k->axis], 1)) n++;
    return n;
}

/* Returns true if one of the two cells next to the ends of a line of n lattice cells contains a particle. The line
 * extends along k->axis and begins with cell number `from` of k->cover. */
static bool run_touches(const struct necks *k, int64_t from, int64_t n)
{
    const struct cell_coverage *c = k->cover;
    int64_t at[DIM_MAX];
    cell_coverage_compute_lattice_indices_of_cell(c, from, at);
    return (at[k->axis] > 0 && c->filled[from - k->stride[k->axis]]) ||
           (at[k->axis] + n < c->n[k->axis] && c->filled[from + n * k->stride[k->axis]]);
}

/* Computes k->rows[cells] from the runs of cells along k->axis. A run is a line of consecutive lattice cells that
 * either all contain particles, or contain none although the body partly covers each of them. In a run of n cells with
 * particles, rows is 1 + n, with n limited to NARROW. In a run without particles it is 1, or 0 if a cell with a
 * particle is next to an end of the run. In all other cells it is 0. */
static void rows_count(struct necks *k)
{
    const struct cell_coverage *c = k->cover;
    array_fill_bytes(k->rows, 0, c->cells, sizeof *k->rows);
    for (int64_t cell = 0; cell < c->cells; cell++) {
        if ((!c->filled[cell] && c->share[cell] <= COVERED) || run_goes_on(k, cell, -1)) continue;
        const int64_t n = run_span(k, cell);
        if (!c->filled[cell] && run_touches(k, cell, n)) continue;
        for (int64_t m = 0; m < n; m++)
            k->rows[cell + m * k->stride[k->axis]] = (uint8_t)(1 + (c->filled[cell] ? (n < NARROW ? n : NARROW) : 0));
    }
}

/* Returns the cell with the largest k->rows (1 + number of particle rows) among the cells next to a run, or -1 if
 * k->rows is 0 in all of them. The run is the line of consecutive cells along k->axis that contains `cell`. The cells
 * next to the run are offset by one cell in the direction `way` (-1 or 1) along the axis `across`. */
static int64_t run_beside(const struct necks *k, int64_t cell, int across, int way)
{
    const struct cell_coverage *c = k->cover;
    int64_t at[DIM_MAX], found = -1, from = cell;
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    if (at[across] + way < 0 || at[across] + way >= c->n[across]) return -1;
    while (run_goes_on(k, from, -1)) from -= k->stride[k->axis];
    const int64_t n = run_span(k, from);
    for (int64_t m = 0; m < n; m++) {
        const int64_t beside = from + m * k->stride[k->axis] + way * k->stride[across];
        if (k->rows[beside] > 0 && (found < 0 || k->rows[beside] > k->rows[found])) found = beside;
    }
    return found;
}

/* Returns true if a plane of symmetry of the run k->engine, normal to the axis `across`, adjoins the lattice cell
 * number `cell` in the direction `way` (-1 or 1). */
static bool at_mirror(const struct necks *k, int64_t cell, int across, int way)
{
    const struct run *run = k->engine;
    int64_t at[DIM_MAX];
    bool found = false;
    cell_coverage_compute_lattice_indices_of_cell(k->cover, cell, at);
    const real X = k->cover->first[across] + (real)at[across] * k->cover->spacing;
    for (int m = 0; m < run->source.mirrors; m++)
        found |= run->source.mirror[m].axis == across && run->source.mirror[m].outside == way &&
                 fabs(run->source.mirror[m].at - X) < 0.6 * k->cover->spacing;
    return found;
}

static void cell_point(const struct cell_coverage *c, int64_t cell, real *X)
{
    int64_t at[DIM_MAX];
    cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
    for (int d = 0; d < DIM_MAX; d++) X[d] = d < c->dim ? c->first[d] + (real)at[d] * c->spacing : 0;
}

/* Measures the width of the piece k->piece (a body, or its part of one material) along k->axis on the line through
 * X[dim] [m]. *chord: receives the midpoint and the length of the part of the line inside the piece. Returns false if X
 * is outside the piece or on its surface. */
static bool chord_measure(const struct necks *k, const real *X, struct chord *chord)
{
    const real h = k->cover->spacing, most = 2 * NARROW * h;
    if (!body_piece_contains_point(k->piece, X, -WITHIN * h)) return false;
    const real down = body_piece_distance_to_surface_along_axis(k->piece, X, k->axis, -0.25 * h, most);
    const real up = body_piece_distance_to_surface_along_axis(k->piece, X, k->axis, 0.25 * h, most);
    chord->middle = X[k->axis] + 0.5 * (up - down), chord->width = up + down;
    return true;
}

/* Largest number of chords (widths of a piece on parallel lines) on either side of chord 0. */
enum { CHORDS_MOST = SAMPLES * (LONGEST + 8 * NARROW) };

/* Parallel chords across a neck, from chord `first` to chord `last`, at a distance of 1/SAMPLES spacing. Chord 0 is on
 * a lattice line. */
struct chords {
    int across, first, last;                 /* axis along which chords follow each other; first <= 0 <= last */
    bool mirrored[2];                        /* the piece ends at a plane of symmetry */
    real X[DIM_MAX];                         /* point of chord 0 */
    struct chord chord[2 * CHORDS_MOST + 1]; /* chord m is [CHORDS_MOST + m] */
};

static struct chord *chord_of(struct chords *p, int m) { return &p->chord[CHORDS_MOST + m]; }

/* Measures the widths of the piece (chords) on parallel lines, SAMPLES lines per spacing. The first line, chord 0,
 * passes through p->X. Chords on both sides follow, each on a line through the midpoint of the previous chord.
 * reach[2]: largest number of chords on the lower and on the upper side. A side ends earlier at a line that misses the
 * piece. Returns false if the line through p->X misses the piece. k: the piece and the axis of the widths. */
static bool chords_measure(struct chords *p, const struct necks *k, const int *reach)
{
    real X[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) X[d] = p->X[d];
    real *along = &X[k->axis];
    for (int m = 0; !chord_measure(k, X, chord_of(p, 0)); m++, *along += k->cover->spacing / FINE)
        if (m == 0)
            *along -= 0.5 * k->cover->spacing;
        else if (m > 2 * FINE)
            return false;
    p->first = p->last = 0;
    for (int side = 0; side < 2; side++) {
        const int way = side ? 1 : -1;
        for (int m = way; abs(m) <= reach[side]; m += way) {
            X[k->axis] = chord_of(p, m - way)->middle;
            X[p->across] = p->X[p->across] + m * k->cover->spacing / SAMPLES;
            if (!chord_measure(k, X, chord_of(p, m))) break;
            if (side)
                p->last = m;
            else
                p->first = m;
        }
    }
    return true;
}

/* Returns the number of the narrowest of the chords (widths on parallel lines) number `from` to `to` of p. If several
 * chords have this width to within `tolerance` [m], returns the middle one. */
static int chords_narrowest(struct chords *p, int from, int to, real tolerance)
{
    int best = from, end;
    for (int m = from; m <= to; m++)
        if (chord_of(p, m)->width < chord_of(p, best)->width - tolerance) best = m;
    for (end = best; end < to && chord_of(p, end + 1)->width < chord_of(p, best)->width + tolerance;) end++;
    return (best + end) / 2;
}

/* Returns the number of particle rows across the piece of k (a body, or its part of one material) in the line of
 * lattice cells that contains chord m of p. A chord is the part of a line that is inside the piece. The rows are
 * counted as the lattice lines between the two ends of the chord in the middle of this line of cells. Returns NAN if
 * that chord was not measured. */
static real chord_rows(struct chords *p, const struct necks *k, int m)
{
    const int column = (int)floor((m + 0.5 * SAMPLES) / SAMPLES) * SAMPLES;
    const real h = k->cover->spacing, first = k->cover->first[k->axis];
    if (column < p->first || column > p->last) return NAN;
    const struct chord *c = chord_of(p, column);
    const real low = (c->middle - 0.5 * c->width - first) / h, high = (c->middle + 0.5 * c->width - first) / h;
    return floor(high + ON_SURFACE) - ceil(low - ON_SURFACE) + 1;
}

/* Returns true if the piece, measured on the parallel chords p, is a neck at its narrowest chord (width on one of these
 * lines), number `narrowest`: its width grows by at least GROWTH spacings on both sides. k: the piece and the axis of
 * its width. Bent parts of constant width are excluded by the condition that the midpoint of the chord shifts by less
 * than the width grows. A side that ends at a plane of symmetry is taken as the mirror image of the other side. *even:
 * receives whether the width changes only in steps, each below 0.001 or above 0.5 spacings. */
static bool is_neck(struct chords *p, const struct necks *k, int narrowest, bool *even)
{
    const real h = k->cover->spacing, width = chord_of(p, narrowest)->width;
    real growth[2] = {0}, shift[2] = {0};
    *even = true;
    for (int side = 0; side < 2; side++) {
        const int way = side ? 1 : -1, end = side ? p->last : p->first;
        if (p->mirrored[side]) continue;
        for (int m = narrowest; m != end && growth[side] < GROWTH * h; m += way) {
            growth[side] = chord_of(p, m + way)->width - width;
            shift[side] = chord_of(p, m + way)->middle - chord_of(p, narrowest)->middle;
            *even = *even && (growth[side] < 1e-3 * h || growth[side] > 0.5 * h);
        }
        if (growth[side] < GROWTH * h) return false;
    }
    for (int side = 0; side < 2; side++)
        if (p->mirrored[side]) growth[side] = growth[!side], shift[side] = shift[!side];
    return fabs(shift[0] + shift[1]) < 0.75 * (growth[0] + growth[1]);
}

/* Returns the relative error of the width of a neck [1]: number of its particle rows times the spacing, divided by its
 * width, minus 1. p: chords (widths on parallel lines) across the neck; narrowest: number of the narrowest one; k: has
 * the spacing. Both widths are averaged over a length of the neck equal to its width, as 1/mean(1/width), since the
 * compliance of the neck depends on this mean. */
static real neck_off(struct chords *p, const struct necks *k, int narrowest)
{
    const real h = k->cover->spacing, width = chord_of(p, narrowest)->width;
    const int half = (int)real_max(SAMPLES / 2, 0.5 * SAMPLES * width / h);
    real exact = 0, filled = 0;
    for (int m = narrowest - half; m <= narrowest + half; m++) {
        if (m < p->first || m > p->last) continue;
        exact += 1 / chord_of(p, m)->width, filled += 1 / (h * chord_rows(p, k, m));
    }
    return exact / filled - 1;
}

/* Returns the number of the lattice cell of k that contains u->at, the centre of a neck; -1 if the centre is outside
 * all cells, or if the cell contains no particle (its k->rows is 0). */
static int64_t neck_cell(const struct necks *k, const struct narrow_part *u)
{
    int64_t cell = 0;
    for (int d = 0; d < k->cover->dim; d++) {
        const int64_t at = llround((u->at[d] - k->cover->first[d]) / k->cover->spacing);
        if (at < 0 || at >= k->cover->n[d]) return -1;
        cell += at * k->stride[d];
    }
    return k->rows[cell] > 0 ? cell : -1;
}

/* Tests whether a neck (narrow part of a body) of k is narrower beside the point X[dim] [m]: moves X along `axis` in
 * the direction `way` (-1 or 1) in steps of 1/FINE spacing, until the piece ends or X has moved two spacings. Returns
 * true if the width of the piece at the last point inside is less than 0.95 times `width`, the width of the neck [m].
 */
static bool narrows_to(const struct necks *k, real *X, int axis, int way, real width)
{
    struct chord chord = {X[k->axis], width};
    for (int m = 0; m < 2 * FINE; m++) {
        X[axis] += way * k->cover->spacing / FINE, X[k->axis] = chord.middle;
        if (!chord_measure(k, X, &chord)) break;
    }
    return chord.width < 0.95 * width;
}

/* Returns true if a neck of k in 3D is not narrower elsewhere along the axis `third`, which is normal to both its width
 * and its length. The width at `cell`, a cell of the neck, is `width` [m]. Cells are followed along `third` in both
 * directions while they have as many particle rows as `cell`. Returns false if the next cells have fewer rows, or if
 * the width decreases towards a surface where the piece ends. This is so for round rods, which check_sections.c
 * examines. */
static bool is_least_across(const struct necks *k, int64_t cell, int third, real width)
{
    for (int way = -1; way <= 1; way += 2) {
        int64_t at = cell, next;
        real X[DIM_MAX];
        while ((next = run_beside(k, at, third, way)) >= 0 && k->rows[next] == k->rows[cell]) at = next;
        if (next >= 0 && k->rows[next] < k->rows[cell]) return false;
        cell_point(k->cover, at, X);
        if (next < 0 && narrows_to(k, X, third, way, width)) return false;
    }
    return true;
}

/* Returns the description of a neck of k: its position, its width at the chord number `narrowest`, and the error of
 * this width. The width is reduced if a parabola through the widths of this chord and its two neighbours has its
 * minimum between them, and the piece is narrower there. p: chords (widths on parallel lines) across the neck; rows:
 * number of particle rows across the neck. */
static struct narrow_part neck_at(struct chords *p, const struct necks *k, int narrowest, real rows)
{
    const real h = k->cover->spacing;
    struct chord best = *chord_of(p, narrowest), other;
    struct narrow_part u = {.filled = rows * h, .axis = k->axis, .across = p->across, .measured = true};
    for (int d = 0; d < DIM_MAX; d++) u.at[d] = p->X[d];
    u.at[p->across] += narrowest * h / SAMPLES, u.at[k->axis] = best.middle;
    if (narrowest > p->first && narrowest < p->last) {
        const real before = chord_of(p, narrowest - 1)->width, after = chord_of(p, narrowest + 1)->width;
        const real bend = before - 2 * best.width + after;
        real X[DIM_MAX];
        for (int d = 0; d < DIM_MAX; d++) X[d] = u.at[d];
        X[p->across] += bend > 0 ? 0.5 * (before - after) / bend * h / SAMPLES : 0;
        if (chord_measure(k, X, &other) && other.width < best.width) {
            best = other, u.at[p->across] = X[p->across], u.at[k->axis] = best.middle;
        }
    }
    u.width = best.width, u.off = u.filled / u.width - 1;
    return u;
}

/* Measures a neck of k and adds it to the list if the number of its particle rows times the spacing differs from its
 * width by more than OFF_LEAST, or OFF_CURVED between curved sides (relative errors). cell: a cell of the first line of
 * cells across the neck; columns: number of consecutive lines of cells with the same number of rows. p: memory for the
 * chords across the neck, in which p->across and p->mirrored are set. */
static void neck_judge(struct width_misfit_list *list, const struct necks *k, struct chords *p, int64_t cell,
                       int columns)
{
    const real h = k->cover->spacing, rows = k->rows[cell] - 1;
    const int reach = SAMPLES * (int)(2 * rows + 4), past = (columns - 1) * SAMPLES;
    bool even;
    cell_point(k->cover, cell, p->X);
    const int ends[2] = {p->mirrored[0] ? SAMPLES / 2 : reach, past + (p->mirrored[1] ? SAMPLES / 2 : reach)};
    if (!chords_measure(p, k, ends)) return;
    const int from = p->first > -SAMPLES ? p->first : -SAMPLES;
    const int to = p->last < past + SAMPLES ? p->last : past + SAMPLES;
    const int narrowest = chords_narrowest(p, from, to, 1e-3 * h);
    const struct narrow_part u = neck_at(p, k, narrowest, rows);
    if (!(u.width < NARROW * h) || !is_neck(p, k, narrowest, &even)) return;
    const real least = even ? OFF_LEAST : OFF_CURVED, mean = neck_off(p, k, narrowest);
    if (!(u.off * mean > 0 && fabs(u.off) > least && fabs(mean) > OFF_LEAST)) return;
    const int64_t middle = neck_cell(k, &u);
    for (int d = 0; d < k->cover->dim; d++)
        if (d != p->across && d != k->axis && (middle < 0 || !is_least_across(k, middle, d, u.width))) return;
    width_misfit_list_add_narrow_part(list, &u, false);
}

/* Marks a neck as examined: sets k->seen to 1 for the lattice cell number `cell` and all cells that are connected to it
 * through cells with the same number of particle rows, k->rows. */
static void neck_mark(struct necks *k, int64_t cell)
{
    int64_t top = 0;
    k->stack[top++] = cell, k->seen[cell] = 1;
    while (top > 0) {
        const int64_t here = k->stack[--top];
        int64_t at[DIM_MAX];
        cell_coverage_compute_lattice_indices_of_cell(k->cover, here, at);
        for (int way = -1; way <= 1; way += 2)
            for (int d = 0; d < k->cover->dim; d++) {
                const int64_t next = here + way * k->stride[d];
                if (at[d] + way < 0 || at[d] + way >= k->cover->n[d]) continue;
                if (k->seen[next] || k->rows[next] != k->rows[cell]) continue;
                k->seen[next] = 1, k->stack[top++] = next;
            }
    }
}

/* Finds out whether a neck begins at `cell`: consecutive lines of lattice cells along k->axis, the axis of the width,
 * that follow each other along the axis `across` and have equally many particle rows. On each side of a neck a line
 * with more rows must follow, or on one side a plane of symmetry. Adds the neck to `list` if its width differs from its
 * number of particle rows times the spacing by more than neck_judge tolerates. k: cells of the piece (a body, or its
 * part of one material). */
static void neck_follow(struct width_misfit_list *list, struct necks *k, int64_t cell, int across)
{
    const int64_t before = run_beside(k, cell, across, -1);
    bool mirrored[2] = {before < 0 && at_mirror(k, cell, across, -1)};
    int columns = 1;
    if (!mirrored[0] && (before < 0 || k->rows[before] <= k->rows[cell])) return;
    int64_t last = cell, next;
    while ((next = run_beside(k, last, across, 1)) >= 0 && k->rows[next] == k->rows[cell] && columns < LONGEST)
        last = next, columns++;
    mirrored[1] = next < 0 && at_mirror(k, last, across, 1);
    if (mirrored[0] && mirrored[1]) return;
    if (!mirrored[1] && (next < 0 || k->rows[next] <= k->rows[cell])) return;
    struct chords *p = NEW("check.chords", 1, struct chords);
    p->across = across, p->mirrored[0] = mirrored[0], p->mirrored[1] = mirrored[1];
    k->measured++;
    neck_judge(list, k, p, cell, columns);
    neck_mark(k, cell);
    memory_free(p);
}

void width_misfit_list_add_necks_of_piece(struct width_misfit_list *list, const struct run *run,
                                          const struct cell_coverage *c, uint8_t *listed_axes)
{
    struct necks k = {.cover = c, .engine = run, .piece = &list->piece};
    k.stride[0] = 1, k.stride[1] = c->n[0], k.stride[2] = c->n[0] * c->n[1];
    k.rows = NEW("check.rows", c->cells, uint8_t);
    k.seen = NEW("check.seen", c->cells, uint8_t);
    k.stack = NEW("check.stack", c->cells, int64_t);
    for (k.axis = 0; k.axis < c->dim; k.axis++) {
        rows_count(&k);
        array_fill_bytes(k.seen, 0, c->cells, sizeof *k.seen);
        for (int64_t cell = 0; cell < c->cells && k.measured < NECKS_MOST; cell++) {
            if (k.rows[cell] == 0 || k.rows[cell] > NARROW || k.seen[cell] || listed_axes[cell] & 1 << k.axis) continue;
            if (run_goes_on(&k, cell, -1)) continue;
            for (int d = 0; d < c->dim && !k.seen[cell]; d++)
                if (d != k.axis) neck_follow(list, &k, cell, d);
        }
    }
    memory_free(k.rows);
    memory_free(k.seen);
    memory_free(k.stack);
}

/* Compares the length of a part of a 1D body, from `low` to `high` [m], with the length that its particles represent:
 * their number times the spacing. Appends the part to `list` if the relative difference exceeds OFF_LEAST. first:
 * coordinate of a particle of the body's lattice [m]. */
static void length_judge(struct width_misfit_list *list, real low, real high, real first)
{
    const real h = list->piece.scene->spacing;
    const real rows = floor((high - first) / h + ON_SURFACE) - ceil((low - first) / h - ON_SURFACE) + 1;
    const struct narrow_part u = {.off = rows * h / (high - low) - 1,
                                  .width = high - low,
                                  .filled = rows * h,
                                  .at = {0.5 * (low + high)},
                                  .measured = true};
    if (fabs(u.off) > OFF_LEAST) width_misfit_list_add_narrow_part(list, &u, false);
}

void width_misfit_list_add_parts_of_1d_body(struct width_misfit_list *list)
{
    const struct body_piece *p = &list->piece;
    const struct scene *s = p->scene;
    real from[DIM_MAX], to[DIM_MAX], first[DIM_MAX], X[DIM_MAX] = {0};
    if (s->body[p->body].file || !(s->spacing > 0) || !body_piece_compute_bounding_box(p, from, to)) return;
    const real step = 0.25 * s->spacing, steps = (to[0] - from[0]) / step;
    if (!(steps < POINTS_MOST) || body_lattice_compute_first_site_position(s, p->body, first) != OK) return;
    for (real m = 0.5; m < steps; m++) {
        X[0] = from[0] + m * step;
        if (!body_piece_contains_point(p, X, 0)) continue;
        const real low = X[0] - body_piece_distance_to_surface_along_axis(p, X, 0, -step, INFINITY),
                   high = X[0] + body_piece_distance_to_surface_along_axis(p, X, 0, step, INFINITY);
        length_judge(list, low, high, first[0]);
        while (m < steps && from[0] + m * step < high) m++;
    }
}
