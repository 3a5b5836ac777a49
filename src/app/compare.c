/* Implements `cleave compare A B`: prints the differences of two runs in fields, energies, cracks and time. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "compare_lammps.h"
#include "output/history.h"
#include "base/memory.h"
#include "output/output.h"
#include "plot/plot.h"
#include "output/summary_read.h"
#include "run/ledger.h"

#define EQUAL_TIMES 0.1 /* relative difference between the times of equal runs on a machine in use [1] */

/* Capacity of the texts of labels and keys [byte]. */
enum { KEY_LENGTH = 64 };

/* Largest difference in time of two frames that are compared, divided by the time between frames [1]. It is not 0
 * because runs with different time steps have no frames at identical times. */
static const double SAME_TIME = 0.05;

/* The two runs that one call of `cleave compare` compares, with their folders. */
struct pair {
    const char *folder[2];
    bool frames_differ; /* the frames have different particles, so that no fields were compared */
    double spacing;     /* spacing of the first run [m]; 0: no frames */
    int dim;
};

/* Returns true if `folder` contains at least one of the files of a run, of Cleave or LAMMPS, that `cleave compare`
 * reads. */
static bool holds_run(const char *folder)
{
    return run_folder_has_file(folder, "summary.json") || run_folder_has_file(folder, "history.csv") ||
           run_folder_has_file(folder, "frames.hdf.series") || lammps_run_exists(folder);
}

/* ---- rows of the table ------------------------------------------------------------------------------------------- */

/* Prints the number a in a column of the table of a comparison; a dash if it is NAN. */
static void print_number(double a)
{
    if (isnan(a))
        printf(" %14s", "-");
    else
        printf(" %14.7g", a);
}

/* Prints a row of the table of a comparison: label, unit ("" for none), the values a and b of the runs A and B, and b -
 * a. A value that is NAN is printed as a dash. Prints nothing if both are NAN. */
static void compare_print_row(const char *label, const char *unit, double a, double b)
{
    char text[KEY_LENGTH];
    if (isnan(a) && isnan(b)) return;
    snprintf(text, sizeof text, "%s%s%s%s", label, *unit ? " [" : "", unit, *unit ? "]" : "");
    printf("  %-28s", text);
    print_number(a);
    print_number(b);
    print_number(b - a);
    putchar('\n');
}

static void print_head(const char *what) { printf("\n%-30s %14s %14s %14s\n", what, "A", "B", "B - A"); }

/* ---- choice of frames -------------------------------------------------------------------------------------------- */

/* The frames of a run, list[n], in ascending order of time. */
struct times {
    int n;
    struct listed_frame *list;
};

/* Returns the mean time between the frames (outputs) of a run, whose times are in t [s]; INFINITY for fewer than two.
 */
static double interval(const struct times *t)
{
    return t->n > 1 ? (t->list[t->n - 1].time - t->list[0].time) / (t->n - 1) : INFINITY;
}

/* Finds the latest frame (output at one time) of the run A for which run B has a frame at the same time. Times are the
 * same if they differ by at most SAME_TIME times the shorter of the mean intervals between frames of A and B. a, b:
 * frames of A and B. Stores the index of the frame of A in *i and of B in *j. Returns false if there is no such pair.
 */
static bool last_common(const struct times *a, const struct times *b, int *i, int *j)
{
    double near = SAME_TIME * fmin(interval(a), interval(b));
    *i = a->n - 1;
    *j = b->n - 1;
    while (*i >= 0 && *j >= 0) {
        double late = a->list[*i].time - b->list[*j].time;
        if (late == 0 || fabs(late) <= near) return true;
        if (late > 0)
            (*i)--;
        else
            (*j)--;
    }
    return false;
}

/* ---- fields ------------------------------------------------------------------------------------------------------ */

/* Difference of a field between both runs, in its unit. */
struct difference {
    double largest, rms, scale; /* largest |a - b|; root mean square of a - b; largest |a| */
    int64_t where;              /* index of the particle with the largest difference */
};

/* Returns the largest and the root-mean-square difference |a - b| of the fields a and b over n particles, the particle
 * of the largest difference, and the largest |a|. a[components][n], b[components][n]: fields of the runs A and B. */
static struct difference field_difference(float *const *a, float *const *b, int components, int64_t n)
{
    struct difference d = {0};
    double sum = 0;
    for (int64_t i = 0; i < n; i++) {
        double apart = 0, size = 0;
        for (int k = 0; k < components; k++) {
            apart += square((double)a[k][i] - b[k][i]);
            size += square((double)a[k][i]);
        }
        sum += apart;
        d.scale = fmax(d.scale, sqrt(size));
        if (sqrt(apart) <= d.largest) continue;
        d.largest = sqrt(apart);
        d.where = i;
    }
    d.rms = n > 0 ? sqrt(sum / (double)n) : 0;
    return d;
}

/* Prints a row of the table of fields: label and unit, then from d the largest and the root-mean-square difference, the
 * largest value of the field, and the reference position of the particle with the largest difference. f: output frame
 * (state at one time) of the run A, from which this position is read. */
static void print_field(const char *label, const char *unit, const struct output_frame *f, struct difference d)
{
    char text[KEY_LENGTH];
    snprintf(text, sizeof text, "%s%s%s%s", label, *unit ? " [" : "", unit, *unit ? "]" : "");
    printf("  %-28s %14.7g %14.7g %14.7g", text, d.largest, d.rms, d.scale);
    if (d.largest > 0) {
        real X[DIM_MAX] = {0};
        for (int k = 0; k < f->dim; k++) X[k] = f->X[k][d.where];
        printf("   (%s)", position_text(X, f->dim, 5).text);
    }
    putchar('\n');
}

static void print_fields(const struct output_frame *a, const struct output_frame *b)
{
    int64_t other_kind = 0;
    for (int64_t i = 0; i < a->n; i++) other_kind += a->kind[i] != b->kind[i];
    printf("\n%-30s %14s %14s %14s   %s\n", "differences of fields, |B - A|", "largest", "quadratic mean",
           "largest |A|", "position of the largest [m]");
    print_field("displacement", "m", a, field_difference(a->u, b->u, a->dim, a->n));
    print_field("velocity", "m/s", a, field_difference(a->v, b->v, a->dim, a->n));
    if (a->stress[0] && b->stress[0])
        print_field("stress", "Pa", a,
                    field_difference(a->stress, b->stress, frame_stress_component_count(a->dim), a->n));
    print_field("damage", "", a, field_difference(&a->damage, &b->damage, 1, a->n));
    printf("  %-28s %14lld of %lld\n", "kind differs (bond or point)", (long long)other_kind, (long long)a->n);
}

/* Returns the reason why the frames a and b (outputs of two runs at one time) cannot be compared particle by particle,
 * as a constant text for a message; NULL if they can be compared. */
static const char *particles_differ(const struct output_frame *a, const struct output_frame *b)
{
    if (a->dim != b->dim) return "the dimensions differ";
    if (a->n != b->n) return "the two runs have different numbers of particles";
    if (!arrays_equal(a->id, b->id, a->n, sizeof *a->id)) return "the two runs number their particles differently";
    return NULL;
}

static double frame_step_length(const struct output_frame *f)
{
    return f->step > 0 ? f->t / (double)f->step : INFINITY;
}

/* Prints the difference in time between the compared output frames a and b (states at one time) of the two runs p,
 * unless it is below half a time step. If exactly one of the runs is of LAMMPS, also prints that the velocities of the
 * other run belong to a time half a step before those of LAMMPS, and its damage to one step before. */
static void print_time_apart(const struct pair *p, const struct output_frame *a, const struct output_frame *b)
{
    const double apart = fabs(b->t - a->t), step = fmin(frame_step_length(a), frame_step_length(b));
    const bool lammps[2] = {lammps_run_exists(p->folder[0]), lammps_run_exists(p->folder[1])};
    if (apart > 0.5 * step)
        printf("the times of the frames differ by %.4g s, %.2g steps: differences of fields include their change in "
               "that time\n",
               apart, apart / step);
    if (lammps[0] != lammps[1])
        printf("velocities of %s are taken half a step before those of LAMMPS, and its damage one step before\n",
               lammps[0] ? "B" : "A");
}

/* Returns the largest distance between the reference positions of particles of the same number in the frames a and b
 * (outputs of two runs) [m]. */
static double largest_start_distance(const struct output_frame *a, const struct output_frame *b)
{
    double largest = 0;
    for (int64_t i = 0; i < a->n; i++) {
        double apart = 0;
        for (int d = 0; d < a->dim; d++) apart += square(a->X[d][i] - b->X[d][i]);
        largest = fmax(largest, sqrt(apart));
    }
    return largest;
}

/* Compares the frames a and b (outputs at one time) of the runs p particle by particle and prints the differences, or
 * the reason why they cannot be compared. */
static void compare_particles(struct pair *p, const struct output_frame *a, const struct output_frame *b)
{
    const char *why = particles_differ(a, b);
    p->dim = a->dim;
    p->spacing = frame_particle_spacing(a);
    printf("\nlast common frame: t = %.7g s (A), %.7g s (B); step %lld, %lld; particles %lld, %lld\n", a->t, b->t,
           (long long)a->step, (long long)b->step, (long long)a->n, (long long)b->n);
    print_time_apart(p, a, b);
    p->frames_differ = why != NULL;
    if (why != NULL) {
        printf("fields are not compared: %s\n", why);
        return;
    }
    const double start = largest_start_distance(a, b);
    if (start > 1e-4 * p->spacing)
        printf("particles of the same number have initial positions in the two runs that are up to %.4g m (%.3g "
               "spacings) apart\n",
               start, start / p->spacing);
    print_fields(a, b);
}

/* Compares the runs p particle by particle, in the last frames (outputs at one time) that both have at a common time.
 * Prints the differences, or the reason why frames are not compared. Returns FAILED, with a message, if frames cannot
 * be read. */
static status compare_frames(struct pair *p)
{
    struct times t[2] = {{0}};
    struct output_frame f[2] = {{0}};
    int at[2];
    status s = OK;
    p->frames_differ = true;
    for (int k = 0; k < 2 && s == OK; k++)
        if (lammps_run_exists(p->folder[k]))
            s = lammps_run_list_frames(p->folder[k], &t[k].n, &t[k].list);
        else if (run_folder_has_file(p->folder[k], "frames.hdf.series"))
            s = run_list_frames(p->folder[k], &t[k].n, &t[k].list);
    if (s == OK && (t[0].n == 0 || t[1].n == 0)) {
        printf("\nfields are not compared: %s has no frames\n", printable_name(p->folder[t[0].n == 0 ? 0 : 1]).text);
    } else if (s == OK && !last_common(&t[0], &t[1], &at[0], &at[1])) {
        printf("\nfields are not compared: no frames of the same time\n");
    } else if (s == OK) {
        for (int k = 0; k < 2 && s == OK; k++)
            s = (lammps_run_exists(p->folder[k]) ? lammps_run_read_frame : run_read_frame)(&f[k], p->folder[k],
                                                                                           t[k].list[at[k]].number);
        if (s == OK) compare_particles(p, &f[0], &f[1]);
        for (int k = 0; k < 2; k++) frame_free(&f[k]);
    }
    for (int k = 0; k < 2; k++) memory_free(t[k].list);
    return s;
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

/* Returns the value of the column called `name` in the last row of the history h of a run; NAN if there is no such
 * column or row. */
static double last_of(const struct history *h, const char *name)
{
    return h->rows > 0 ? history_value_at(h, h->rows - 1, history_find_column(h, name)) : NAN;
}

/* Prints the energies and errors in the last lines of history.csv of both runs p, with their differences. Prints a
 * message if a run has no such file. Returns FAILED, with a message, if a file cannot be read. */
static status compare_energies(const struct pair *p)
{
    static const struct {
        const char *name, *label;
    } figure[] = {
        {"balance_error", "balance error"},
        {"momentum_error", "momentum error"},
        {"pd_share", "peridynamic share"},
    };
    struct history h[2];
    for (int k = 0; k < 2; k++) {
        if (run_folder_has_file(p->folder[k], "history.csv")) continue;
        printf("\nenergies are not compared: %s has no history.csv\n", printable_name(p->folder[k]).text);
        return OK;
    }
    TRY(history_read(&h[0], p->folder[0]));
    status s = history_read(&h[1], p->folder[1]);
    if (s != OK) {
        history_free(&h[0]);
        return s;
    }
    print_head("last line of history.csv");
    compare_print_row("time", "s", last_of(&h[0], "time"), last_of(&h[1], "time"));
    for (int k = 0; k < LEDGER_ROWS; k++)
        compare_print_row(ledger[k].label, "J", last_of(&h[0], ledger[k].name), last_of(&h[1], ledger[k].name));
    for (int k = 0; k < (int)COUNT_OF(figure); k++)
        compare_print_row(figure[k].label, "", last_of(&h[0], figure[k].name), last_of(&h[1], figure[k].name));
    for (int k = 0; k < 2; k++) history_free(&h[k]);
    return OK;
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Returns the number called `key` (names joined by dots) in summary.json of the run in `folder`; NAN if there is
 * none. */
static double compare_figure_of(const char *folder, const char *key)
{
    double value;
    return summary_read_number(folder, key, &value) == OK ? value : NAN;
}

/* Reads the position of crack tip number k, from 0, from the summary of the run in `folder` to place[DIM_MAX] [m].
 * Returns false if the run has no such tip. */
static bool tip_place(const char *folder, int k, double place[DIM_MAX])
{
    bool found = false;
    for (int d = 0; d < DIM_MAX; d++) {
        char key[KEY_LENGTH];
        snprintf(key, sizeof key, "crack.tips.%d.%c", k, 'x' + d);
        place[d] = compare_figure_of(folder, key);
        found = found || isfinite(place[d]);
        if (!isfinite(place[d])) place[d] = 0; /* a component the space does not have */
    }
    return found;
}

/* Prints the position of every crack tip in the summary of the first run of p, with the distance to the nearest tip of
 * the second run. */
static void print_tips(const struct pair *p)
{
    double a[DIM_MAX], b[DIM_MAX];
    for (int i = 0; tip_place(p->folder[0], i, a); i++) {
        double least = INFINITY;
        for (int j = 0; tip_place(p->folder[1], j, b); j++)
            least = fmin(least, sqrt(square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2])));
        printf("  tip %d at (%.5g, %.5g, %.5g) m: ", i, a[0], a[1], a[2]);
        if (!isfinite(least))
            printf("run B has no tip\n");
        else if (p->spacing > 0)
            printf("nearest tip of run B is %.4g m away (%.3g spacings)\n", least, least / p->spacing);
        else
            printf("nearest tip of run B is %.4g m away\n", least);
    }
}

static void compare_cracks(const struct pair *p)
{
    static const struct {
        const char *key, *label, *unit;
    } figure[] = {{"crack.start_time", "first bond broken at", "s"},
                  {"crack.tip_start_time", "tip moves first at", "s"},
                  {"crack.arrest_time", "tip moves last at", "s"},
                  {"crack.angle_deg", "angle to the pre-crack", "degree"},
                  {"crack.length_end", "growth", "m"},
                  {"crack.tip_speed_mean", "mean speed of its tip", "m/s"},
                  {"crack.tip_speed_max", "largest speed of its tip", "m/s"}};
    print_head("longest crack");
    for (int k = 0; k < (int)COUNT_OF(figure); k++)
        compare_print_row(figure[k].label, figure[k].unit, compare_figure_of(p->folder[0], figure[k].key),
                          compare_figure_of(p->folder[1], figure[k].key));
    print_tips(p);
}

static void compare_time(const struct pair *p)
{
    static const struct {
        const char *key, *label, *unit;
    } figure[] = {{"steps", "steps", ""},
                  {"time_step", "time step", "s"},
                  {"threads", "threads", ""},
                  {"memory_peak_bytes", "peak memory", "byte"},
                  {"loop_seconds", "time of the steps", "s"}};
    print_head("steps, memory and time");
    for (int k = 0; k < (int)COUNT_OF(figure); k++)
        compare_print_row(figure[k].label, figure[k].unit, compare_figure_of(p->folder[0], figure[k].key),
                          compare_figure_of(p->folder[1], figure[k].key));
    double a = compare_figure_of(p->folder[0], "loop_seconds"), b = compare_figure_of(p->folder[1], "loop_seconds");
    if (!(a > 0 && b > 0)) return;
    const char *equal = fabs(1 - a / b) < EQUAL_TIMES ? "; times of equal runs differ as much" : "";
    if (a > b)
        printf("  A/B = %.4g, A takes %.3g %% longer than B%s\n", a / b, 100 * (a / b - 1), equal);
    else
        printf("  A/B = %.4g, A saves the share t_r = 1 - A/B = %.4g of the time of B%s\n", a / b, 1 - a / b, equal);
}

/* ---- the command ------------------------------------------------------------------------------------------------- */

/* Reads the two folders of the runs from the words of the command line, argv[argc], into p->folder. Returns REFUSED if
 * there are options or not exactly two words, or if a folder contains no run. */
static status read_words(struct pair *p, int argc, char **argv)
{
    for (int k = 1; k < argc; k++)
        if (argv[k][0] == '-')
            return status_set(REFUSED, "compare: unknown option %s; usage: cleave compare DIR DIR", argv[k]);
    if (argc != 3)
        return status_set(REFUSED, "compare: %d folders are given; give two; usage: cleave compare DIR DIR", argc - 1);
    for (int k = 0; k < 2; k++) {
        p->folder[k] = argv[k + 1];
        if (holds_run(p->folder[k])) continue;
        return status_set(REFUSED,
                          "%s contains no run (neither summary.json, history.csv nor frames); give the folder that "
                          "cleave run prints at its end",
                          p->folder[k]);
    }
    return OK;
}

/* Prints name, method and state of the run in `folder`, after `letter`, A or B, by which the tables denote the run.
 * Returns FAILED, with a message, if the summary of the run exists but cannot be read. */
static status print_run(const char *letter, const char *folder)
{
    char name[NAME_MAX_LENGTH], method[NAME_MAX_LENGTH], state[NAME_MAX_LENGTH];
    if (!run_folder_has_file(folder, "summary.json")) {
        printf("%s  %s: %s\n", letter, printable_name(folder).text,
               lammps_run_exists(folder) ? "a run of LAMMPS" : "no summary.json yet");
        return OK;
    }
    TRY(summary_read_string(folder, "name", name, sizeof name));
    if (summary_read_string(folder, "method", method, sizeof method) != OK)
        snprintf(method, sizeof method, "unknown method");
    if (summary_read_string(folder, "status", state, sizeof state) != OK)
        snprintf(state, sizeof state, "unknown state");
    printf("%s  %s: %s, %s, %s\n", letter, printable_name(folder).text, name, method, state);
    return OK;
}

status command_compare_main(int argc, char **argv)
{
    struct pair p = {.dim = 0};
    TRY(read_words(&p, argc, argv));
    TRY(print_run("A", p.folder[0]));
    TRY(print_run("B", p.folder[1]));
    for (int k = 0; k < 2; k++) TRY(lammps_print_differences_from_export(p.folder[k]));
    TRY(compare_frames(&p));
    TRY(compare_energies(&p));
    compare_cracks(&p);
    compare_time(&p);
    printf("\ncomparable particle by particle: %s\n", p.frames_differ ? "no" : "yes");
    if (fflush(stdout) != 0 || ferror(stdout)) return status_set(FAILED, "standard output: %s", strerror(errno));
    return OK;
}
