/* Crack paths in load steps: the first kink of an inclined crack compared with the criterion of the largest hoop
 * stress, and the path from an eccentric notch of a beam compared with finite elements. */
#include <math.h>
#include <string.h>

#include "bench/common/handbook.h"
#include "fracture/sif_fields.h"
#include "output/history.h"
#include "slow.h"

static const double degree = 3.14159265358979323846 / 180;
static const double half = 10e-3;                  /* half length of the inclined crack [m] */
static const double notch[2] = {-31.75e-3, 16e-3}; /* position of the notch tip [m] */

struct path_row {
    double spacing, angle;         /* spacing [m]; angle between crack and normal of the load [degree], NAN for the
                                    * beam */
    double found, expected, apart; /* angles found and expected, and their difference [degree] */
};

/* Finds the next row of history h, from row *from on, in which the columns path_x and path_y, the position of the
 * farthest crack tip, differ from place[2] [m]. Stores this position in place[2] and the row in *from. Returns false if
 * there is none; place[2] is then the last position. */
static bool path_next(const struct history *h, int64_t *from, double place[2])
{
    const int x = history_find_column(h, "path_x"), y = history_find_column(h, "path_y");
    const double was[2] = {place[0], place[1]};
    for (; *from < h->rows; ++*from) {
        place[0] = history_value_at(h, *from, x), place[1] = history_value_at(h, *from, y);
        if (hypot(place[0] - was[0], place[1] - was[1]) > 1e-9) return true;
    }
    return false;
}

/* ---- kinks ------------------------------------------------------------------------------------------------------- */

/* Stores the position of the crack tip in row 1 of history h, before the crack grows, in place[2] [m]. */
static void path_start(const struct history *h, double place[2])
{
    place[0] = history_value_at(h, 1, history_find_column(h, "path_x"));
    place[1] = history_value_at(h, 1, history_find_column(h, "path_y"));
}

/* Reads the first kink of an inclined crack from the results of a run, and compares its angle with the direction of the
 * largest hoop stress for K_II/K_I = tan(angle). This ratio holds in an infinite plate; in the plate of the scene, five
 * times as wide as the crack is long, it holds to 1 %. row: a struct path_row; folder: of the run. Returns FAILED if
 * the history cannot be read. */
static status kink_take(void *row, const char *folder)
{
    struct path_row *r = row;
    struct history h = {0};
    TRY(history_read(&h, folder));
    const double K[MODES] = {cos(r->angle * degree), sin(r->angle * degree)};
    double start[2] = {half * cos(r->angle * degree), half * sin(r->angle * degree)}, place[2];
    int64_t line = 1;
    path_start(&h, place);
    const double side = place[0] * start[0] + place[1] * start[1] > 0 ? 1 : -1;
    start[0] *= side, start[1] *= side;
    place[0] = start[0], place[1] = start[1];
    r->expected = crack_kink_angle_from_sif(K) / degree, r->found = NAN;
    if (path_next(&h, &line, place))
        r->found =
            remainder(atan2(side * (place[1] - start[1]), side * (place[0] - start[0])) / degree - r->angle, 360);
    history_free(&h);
    r->apart = fabs(r->found - r->expected);
    printf("  %-20s %7.0f %9.0f %9.1f %9.1f %8.1f\n", "inclined crack", 2 * half / r->spacing, r->angle, r->found,
           r->expected, r->apart);
    return OK;
}

/* Adds a row called `name` with the results r to the table t. Raises *worst to r->apart, the deviation of the angle
 * [degree], or sets it to NAN if that is NAN. */
static void path_put(struct bench_table *t, const char *name, const struct path_row *r, double *worst)
{
    bench_table_append_text(t, name);
    const double number[] = {r->spacing, r->angle, r->found, r->expected, r->apart};
    for (size_t k = 0; k < COUNT_OF(number); k++) bench_table_append_number(t, number[k]);
    if (!(r->apart <= *worst)) *worst = r->apart;
}

static status kinks(struct bench_table *t, struct bench_goals *asked, bool quick)
{
    double worst = 0;
    printf("\n  %-20s %7s %9s %9s %9s %8s\n", "path", "across", "angle", "found", "expected", "apart");
    for (int fine = 1; fine <= (quick ? 1 : 4); fine *= 2) {
        worst = 0;
        for (int angle = quick ? 45 : 15; angle <= 75; angle += quick ? 45 : 15) {
            struct path_row r = {.spacing = 1e-3 / fine, .angle = angle};
            struct bench_job job = {.path = "inputs/mixed_mode.yaml", .row = &r, .take = kink_take};
            bench_overrides_append(&job.overrides, "variables.angle", "%d deg", angle);
            bench_overrides_append(&job.overrides, "particles.spacing", "%.9g mm", 1.0 / fine);
            bench_overrides_append(&job.overrides, "steps.number", "6");
            bench_overrides_append(&job.overrides, "probes", "[]");
            bench_overrides_append(&job.overrides, "output.frames", "0");
            TRY(bench_jobs_run(&job, 1, 1));
            path_put(t, "inclined crack", &r, &worst);
        }
    }
    bench_add_goal(asked, "degrees", worst, 3, "inclined crack, kinks at 15 to 75 degrees, worst");
    return OK;
}

/* ---- eccentric notch of a beam ----------------------------------------------------------------------------------- */

/* Reads the path of a crack in a beam from the results of a run. Compares the angle of the straight line from the
 * initial to the current tip with finite-element results, as far as these go, and stores the largest difference. row: a
 * struct path_row; folder: of the run. Returns FAILED if the history cannot be read. */
static status bend_take(void *row, const char *folder)
{
    struct path_row *r = row;
    struct history h = {0};
    double start[2], place[2];
    TRY(history_read(&h, folder));
    path_start(&h, start);
    memcpy(place, start, sizeof place);
    r->apart = 0;
    for (int64_t line = 1; path_next(&h, &line, place);) {
        const double along[2] = {place[0] - start[0], place[1] - start[1]}, length = hypot(along[0], along[1]);
        const double expected = bend_crack_chord_angle(length), found = atan2(along[0], along[1]) / degree;
        if (isnan(expected)) break;
        if (fabs(found - expected) >= r->apart)
            r->found = found, r->expected = expected, r->apart = fabs(found - expected);
    }
    history_free(&h);
    printf("  %-20s %7.0f %9s %9.1f %9.1f %8.1f\n", "notch beside middle", 40e-3 / r->spacing, "", r->found,
           r->expected, r->apart);
    return OK;
}

static status bends(struct bench_table *t, struct bench_goals *asked, bool quick)
{
    double worst = 0;
    for (int fine = 1; fine <= (quick ? 1 : 4); fine *= 2) {
        struct path_row r = {.spacing = 1e-3 / fine, .angle = NAN};
        struct bench_job job = {.path = "inputs/bend_offset_notch.yaml", .row = &r, .take = bend_take};
        bench_overrides_append(&job.overrides, "variables.h", "%.9g mm", 1.0 / fine);
        bench_overrides_append(&job.overrides, "cracks.0", "{from: [%g mm, -1 mm], to: [%g mm, %g mm]}", 1e3 * notch[0],
                               1e3 * notch[0], 1e3 * notch[1]);
        bench_overrides_append(&job.overrides, "steps.number", "%d", 12 * fine);
        bench_overrides_append(&job.overrides, "output.frames", "0");
        TRY(bench_jobs_run(&job, 1, 1));
        worst = 0;
        path_put(t, "notch beside middle", &r, &worst);
    }
    bench_add_goal(asked, "degrees", worst, 3, "notch beside the middle of a beam, worst chord");
    return OK;
}

status slow_compare_crack_paths(struct bench_goals *goals, bool quick)
{
    struct bench_table t;
    bench_table_make(&t, "", "case,spacing,angle,found,expected,apart");
    status s = kinks(&t, goals, quick);
    if (s == OK) s = bends(&t, goals, quick);
    if (s == OK) s = bench_write_result_tables("slow_paths", &t, 1);
    bench_table_free(&t);
    return s;
}
