/* Position and angle of crack branching, from the damage in the last frame of a run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "experiments.h"
#include "output/output_files.h"

#define BRANCH_APART 3.5  /* least distance of branches [spacings] */
#define BRANCH_LASTS 4e-3 /* length over which 9 of 10 columns must have two branches [m] */
#define BRANCH_SHARE 0.9
#define BRANCH_FROM 30e-3 /* all notches are at least so long: start of the search [m] */
#define ANGLE_FROM 2e-3   /* distance beyond the branching from which the angle is measured [m] */
#define ANGLE_TO 10e-3

/* A column of particles across the crack. n: number of its damaged particles; branches: number of branches; low,
 * high, last: coordinates y of the lowest, the highest and the last counted damaged particle [m]. */
struct branch_column {
    int n, branches;
    double low, high, last;
};

struct branch_point {
    double x, y;
};

static int by_y(const void *a, const void *b)
{
    const struct branch_point *p = a, *q = b;
    return (p->y > q->y) - (p->y < q->y);
}

/* Divides frame f into columns, slices one spacing wide from x = 0 on, and returns them as an allocated array with the
 * branches of the crack in each. columns: receives their number; spacing [m]. The caller releases the array with
 * memory_free. */
static struct branch_column *columns_of(const struct output_frame *f, double spacing, int *columns)
{
    struct branch_point *point = NEW("bench.branch", f->n, struct branch_point);
    double longest = 0;
    int64_t n = 0;
    for (int64_t i = 0; i < f->n; i++) {
        longest = fmax(longest, f->X[0][i]);
        if (f->damage[i] > 0.01 * EXPERIMENT_DAMAGED) point[n++] = (struct branch_point){f->X[0][i], f->X[1][i]};
    }
    array_sort(point, n, sizeof *point, by_y);
    *columns = (int)(longest / spacing) + 1;
    struct branch_column *column = NEW("bench.columns", *columns, struct branch_column);
    for (int64_t k = 0; k < n; k++) {
        if (point[k].x < 0) continue;
        struct branch_column *c = &column[(int)(point[k].x / spacing)];
        if (c->n++ == 0)
            c->low = point[k].y, c->branches = 1;
        else
            c->branches += point[k].y - c->last > BRANCH_APART * spacing;
        c->high = c->last = point[k].y;
    }
    memory_free(point);
    return column;
}

/* Returns true if the crack has branched from column k on: over the length BRANCH_LASTS, at least the share
 * BRANCH_SHARE of the columns (slices one spacing wide) has two or more branches. c[columns]; spacing [m]. */
static bool branches_from(const struct branch_column *c, int columns, int k, double spacing)
{
    const int stretch = (int)(BRANCH_LASTS / spacing);
    int held = 0;
    if (c[k].branches < 2 || k + stretch > columns) return false;
    for (int m = k; m < k + stretch; m++) held += c[m].branches >= 2;
    return held >= BRANCH_SHARE * stretch;
}

/* Returns the slope by which the distance between the outermost branches grows along x [1], by least squares over the
 * columns c[first] to c[end - 1], which are slices one spacing wide. Returns NAN for fewer than six columns with two
 * branches. spacing [m]. */
static double opening_slope(const struct branch_column *c, int first, int end, double spacing)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int k = first; k < end; k++) {
        if (c[k].branches < 2) continue;
        const double at = (k - first) * spacing, wide = c[k].high - c[k].low;
        n++, x += at, y += wide, xx += at * at, xy += at * wide;
    }
    return n > 5 ? (n * xy - x * y) / (n * xx - x * x) : NAN;
}

struct branching branching_find_in_frame(const struct output_frame *frame, double spacing)
{
    struct branching b = {NAN, NAN, 0};
    int columns;
    struct branch_column *c = columns_of(frame, spacing, &columns);
    for (int k = (int)(BRANCH_FROM / spacing) + 1; k < columns; k++) {
        b.branches = c[k].branches > b.branches ? c[k].branches : b.branches;
        if (!isnan(b.x) || !branches_from(c, columns, k, spacing)) continue;
        const int first = k + (int)(ANGLE_FROM / spacing), end = k + (int)(ANGLE_TO / spacing);
        b.x = (k + 0.5) * spacing;
        if (end <= columns) b.angle = 2 * atan(0.5 * opening_slope(c, first, end, spacing)) * 180 / M_PI;
    }
    memory_free(c);
    return b;
}

/* ---- folders ----------------------------------------------------------------------------------------------------- */

/* Reads the last frame of the run in `run_folder` into *frame. Returns FAILED if there is none or it cannot be read.
 * Release with frame_free in either case. */
status experiment_read_last_frame(struct output_frame *frame, const char *run_folder)
{
    int n;
    struct listed_frame *list;
    char path[4400];
    TRY(run_list_frames(run_folder, &n, &list));
    if (n > 0) snprintf(path, sizeof path, "%s/frames/%06d.hdf", run_folder, list[n - 1].number);
    memory_free(list);
    return n > 0 ? frame_read(frame, path) : status_set(FAILED, "%s has no frames", run_folder);
}

static struct branching branching_in(const char *folder, double spacing)
{
    struct output_frame f = {0};
    struct branching b = {NAN, NAN, 0};
    if (experiment_read_last_frame(&f, folder) == OK) b = branching_find_in_frame(&f, spacing);
    frame_free(&f);
    return b;
}

double branching_x_coordinate(const char *run_folder, double spacing) { return branching_in(run_folder, spacing).x; }
double branching_angle_in_degrees(const char *run_folder, double spacing)
{
    return branching_in(run_folder, spacing).angle;
}
double branching_largest_branch_count(const char *run_folder, double spacing)
{
    return branching_in(run_folder, spacing).branches;
}
