/* `cleave bench circles`: bonds that soften beside the challenge problems of Kamarei, Zeng, Dolbow & Lopez-Pamies
 * (2025), "Nine circles of elastic brittle fracture". */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "bench/common/bench_goals.h"
#include "circles.h"
#include "output/output_files.h"

#define COLUMNS "circle,figure,specimen,unit,spacing_mm,horizon_l,lattice_deg,expected,tolerance,found,verdict"

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Returns the horizon of the run r over the characteristic length E G_c/strength^2 of the glass [1]. */
static double relative_horizon(const struct circle_run *r)
{
    const double length = CIRCLE_YOUNG * CIRCLE_TOUGHNESS / (CIRCLE_STRENGTH * CIRCLE_STRENGTH);
    return CIRCLE_HORIZON * 1e-3 * r->spacing / length;
}

const char *circle_verdict(const struct circle_run *run)
{
    const struct circle_case *c = run->of;
    if (c->horizon > 0 && relative_horizon(run) > c->horizon) return "-";
    if (c->horizon == 0 && c->crack > 0 && c->crack < 3 * 0.999 * CIRCLE_HORIZON * run->spacing) return "-";
    return fabs(run->found - c->expected) <= c->tolerance ? "holds" : "MISSED";
}

/* Prints the measured value of the run r beside the expected one, and adds a row with both to the table of the run. */
static void circle_report(const struct circle_run *r)
{
    const struct circle_case *c = r->of;
    const char *const verdict = circle_verdict(r);
    const double found = isfinite(r->found) ? r->found : NAN;
    printf("  %-15s %-21s %6.2f l %4d deg %8.4g +- %-6.3g %8.4g %-5s %s%s%s\n", c->circle, c->figure,
           relative_horizon(r), r->degrees, c->expected, c->tolerance, found, c->unit, verdict, c->why ? ": " : "",
           c->why ? c->why : "");
    bench_table_append_text(r->table, c->circle), bench_table_append_text(r->table, c->figure);
    bench_table_append_text(r->table, circle_specimen[c->specimen].name), bench_table_append_text(r->table, c->unit);
    bench_table_append_number(r->table, r->spacing), bench_table_append_number(r->table, relative_horizon(r));
    bench_table_append_number(r->table, r->degrees), bench_table_append_number(r->table, c->expected);
    bench_table_append_number(r->table, c->tolerance), bench_table_append_number(r->table, found),
        bench_table_append_text(r->table, verdict);
}

static status circle_take(void *row, const char *folder)
{
    struct circle_run *r = row;
    r->found = circle_specimen[r->of->specimen].measure(folder, r);
    circle_report(r);
    return OK;
}

/* Returns true if case c is selected by the text `only`: the name of its circle contains this text. NULL selects all
 * cases. */
static bool case_is_asked(const struct circle_case *c, const char *only) { return !only || strstr(c->circle, only); }

/* Returns REFUSED, with a message, unless there is a case with runs whose circle has the text `only` in its name. NULL
 * stands for all cases. */
static status name_check(const char *only)
{
    for (int k = 0; k < circle_cases_count; k++)
        if (circle_has_runs(&circle_cases[k]) && case_is_asked(&circle_cases[k], only)) return OK;
    return status_set(REFUSED,
                      "no circle of the name %s has runs; a part of a name is expected, as tension or notch 1.5", only);
}

/* Prints the cases that have no runs, each with the reason, if the name of their circle contains the text `only`. NULL
 * stands for all cases. */
static void reasons_print(const char *only)
{
    for (int k = 0; k < circle_cases_count; k++) {
        const struct circle_case *c = &circle_cases[k];
        if (!circle_has_runs(c) && case_is_asked(c, only))
            printf("  %-15s %-21s not run: %s\n", c->circle, c->figure, c->why);
    }
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

enum { RUNS_MOST = 96, PATH_LENGTH = 96 };

/* All runs, their jobs and files. */
struct circles {
    int n;
    char folder[64];
    struct circle_run run[RUNS_MOST];
    struct bench_job job[RUNS_MOST];
    char scene[RUNS_MOST][PATH_LENGTH];
};

/* Stores the path of the scene file of specimen s in path[PATH_LENGTH]. If the specimen has no file of its own in
 * inputs/, writes its scene to the folder of c. Returns FAILED if the file cannot be written. */
static status scene_prepare(const struct circles *c, const struct circle_specimen *s, char *path)
{
    if (s->path) return snprintf(path, PATH_LENGTH, "%s", s->path), OK;
    snprintf(path, PATH_LENGTH, "%s/%s.yaml", c->folder, s->name);
    return file_write_whole(path, s->text, strlen(s->text));
}

/* Returns the coordinate x [m] at which the lattice of run r that is turned by 45 degrees has a row of particles.
 * Without a pre-crack it is 0. With one it is such that the tip is a quarter of the distance of rows away from a row.
 * All tips between two rows cut the same bonds, and this one is in the middle of them. */
static double lattice_middle(const struct circle_run *r)
{
    const double crack = r->of->crack;
    return crack > 0 ? 1e-3 * (crack + 0.25 * r->spacing / sqrt(2)) : 0;
}

/* Writes the particles of run r on a turned lattice to a file in the folder of c as a list, and appends overrides to *o
 * that replace the body of the scene by this list. Bonds then have uniform weights, because isotropic weights are made
 * for lattices along the axes. The load is scaled to the cross-section that the list has, which differs from that of
 * the specimen. Returns FAILED if the list cannot be written. */
static status body_turn(const struct circles *c, struct circle_run *r, struct bench_overrides *o)
{
    const struct circle_specimen *s = &circle_specimen[r->of->specimen];
    char file[PATH_LENGTH / 2], path[PATH_LENGTH + 32];
    struct circle_list list;
    snprintf(file, sizeof file, "%s_%.4g_%.4g_%d.csv", s->name, r->of->crack, r->spacing, r->degrees);
    snprintf(path, sizeof path, "%s/%s", c->folder, file);
    TRY(circle_write_particle_list(path, s, 1e-3 * r->spacing, r->degrees, lattice_middle(r), &list));
    r->section = list.section;
    bench_overrides_append(o, "bodies.0.shape", "%s", "");
    bench_overrides_append(o, "bodies.0.particles", "%s", file);
    bench_overrides_append(o, "pd.surface", "volume");
    bench_overrides_append(o, "pd.weights", "uniform");
    if (s->turned.key) bench_overrides_append(o, s->turned.key, "%s", s->turned.value);
    const struct scene_override load = r->of->set[CIRCLE_LOAD];
    if (s->loaded > 0) bench_overrides_append(o, load.key, "%.12g*(%s)", list.section / list.layer, load.value);
    return OK;
}

/* Adds a run of the case `of` to c at a spacing [mm], on a lattice rotated by `degrees`. table: receives a row after
 * the run. Returns FAILED if a file cannot be written. */
static status circle_add(struct circles *c, const struct circle_case *of, double spacing, int degrees,
                         struct bench_table *table)
{
    INVARIANT(c->n < RUNS_MOST);
    const struct circle_specimen *s = &circle_specimen[of->specimen];
    const int k = c->n++;
    struct bench_overrides *o = &c->job[k].overrides;
    c->run[k] = (struct circle_run){of, spacing, 1, NAN, degrees, table};
    c->job[k].path = c->scene[k], c->job[k].row = &c->run[k], c->job[k].take = circle_take;
    TRY(scene_prepare(c, s, c->scene[k]));
    bench_overrides_append(o, s->path ? "particles.spacing" : "variables.h", "%.12g mm", spacing);
    if (of->surface) bench_overrides_append(o, "materials.0.compressive_strength", "1 GPa");
    for (int j = 0; j < CIRCLE_OVERRIDES && of->set[j].key; j++)
        bench_overrides_append(o, of->set[j].key, "%s", of->set[j].value);
    return degrees ? body_turn(c, &c->run[k], o) : OK;
}

/* With --quick: smallest spacing, spacing of cubes, shortest notch [mm]. */
#define QUICK_LEAST 0.06
#define QUICK_CUBE (1.0 / 13)
#define QUICK_NOTCH 0.25

/* Returns the spacing j of a case [mm], 0 if it has none. quick: with --quick it has at most the first. */
static double case_spacing(const struct circle_case *of, int j, bool quick)
{
    if (!quick || of->spacing[j] == 0) return of->spacing[j];
    if (j > 0 || of->spacing[0] < QUICK_LEAST || (of->crack > 0 && of->crack < QUICK_NOTCH)) return 0;
    return of->specimen == CIRCLE_CUBE ? QUICK_CUBE : of->spacing[0];
}

/* Returns the spacing j of a case on turned lattices [mm], 0 if it has none. quick: with --quick it has at most the
 * first, and a notch only if it has no other run. */
static double case_turned_spacing(const struct circle_case *of, int j, bool quick)
{
    if (!quick) return of->turned[j];
    const bool repeats = of->specimen == CIRCLE_NOTCH && of->spacing[0] > 0;
    return j == 0 && !repeats && of->turned[0] > QUICK_LEAST ? of->turned[0] : 0;
}

/* Adds the runs of the cases whose circle has the text `only` in its name (NULL: all) to c. quick: only those of
 * --quick; table: receives a row for each run. Returns FAILED if a file cannot be written. */
static status circles_add(struct circles *c, const char *only, bool quick, struct bench_table *table)
{
    for (int k = 0; k < circle_cases_count; k++)
        for (int j = 0; j < CIRCLE_SPACINGS; j++) {
            const struct circle_case *of = &circle_cases[k];
            if (!case_is_asked(of, only)) continue;
            const double spacing = case_spacing(of, j, quick), turned = case_turned_spacing(of, j, quick);
            if (spacing > 0) TRY(circle_add(c, of, spacing, 0, table));
            for (int a = 0; a < CIRCLE_LATTICES && turned > 0 && of->degrees[a] > 0; a++)
                TRY(circle_add(c, of, turned, of->degrees[a], table));
        }
    return OK;
}

/* Prints how many of the values measured in c to which an expected value applies are outside their tolerances. */
static void missed_print(const struct circles *c)
{
    int asked = 0, missed = 0;
    for (int k = 0; k < c->n; k++) {
        const char *const verdict = circle_verdict(&c->run[k]);
        asked += strcmp(verdict, "-") != 0, missed += strcmp(verdict, "MISSED") == 0;
    }
    printf("\n  %d of %d figures are MISSED; nothing is asked (-) of notches shorter than three horizons (0.1 mm: two "
           "thirds; 0.025 mm: a spacing), of shear above 0.34 l, of cracks in load steps above 0.87 l\n",
           missed, asked);
}

/* Runs all cases whose circle has the text `only` in its name and prints their results. If `only` is NULL, runs all
 * cases and also writes the table of results. quick: true for coarse runs only. */
static status circles_measure(const char *only, bool quick)
{
    static const char *const needed[] = {"inputs/strength_notch.yaml"};
    struct bench_table rows;
    TRY(name_check(only));
    TRY(bench_check_scenes_exist("circles", needed, COUNT_OF(needed)));
    struct circles *c = NEW("bench.circles", 1, struct circles);
    printf("nine circles of elastic brittle fracture (Kamarei et al. 2025): glass, l = E G_c/strength^2 = 0.4375 mm\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    printf("  %-15s %-21s %8s %8s %19s %14s\n", "circle", "figure", "horizon", "lattice", "expected", "found");
    bench_table_make(&rows, "", COLUMNS);
    status s = bench_create_results_folder();
    strcpy(c->folder, BENCH_FOLDER "/circles-XXXXXX");
    if (s == OK && !mkdtemp(c->folder)) s = file_report_write_failure(c->folder, errno), c->folder[0] = 0;
    if (s == OK) s = circles_add(c, only, quick, &rows);
    if (s == OK) s = bench_jobs_run(c->job, c->n, 2);
    if (s == OK) reasons_print(only), missed_print(c);
    if (s == OK && !only) s = bench_write_result_tables("circles", &rows, 1);
    if (c->folder[0]) bench_folder_remove(c->folder);
    bench_table_free(&rows);
    memory_free(c);
    return s;
}

status bench_circles(bool quick) { return circles_measure(NULL, quick); }

status bench_circles_of_name(const char *circle_name_part, bool quick)
{
    return circles_measure(circle_name_part, quick);
}
