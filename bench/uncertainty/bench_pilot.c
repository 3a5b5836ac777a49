/* `cleave bench pilot`: tests whether `method: auto` reaches the requested accuracy. Each scene has one result in
 * closed form, which is requested within some percent; pilot runs choose the run. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/team.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "study/pilot.h"
#include "uncertainty.h"

enum { TEXT_ROOM = 2048 };
#define BUDGET 30.0 /* allowed duration of the pilot runs of a scene [s] */

struct pilot_tally {
    int asked, answered, kept;
    struct bench_table *table;
};

/* ---- one scene --------------------------------------------------------------------------------------------------- */

/* Writes the scene k with `method: auto` to the file `path`. It requests that the known quantity of the scene has a
 * relative error of at most `within` [1]. Returns FAILED if the file cannot be written. */
static status pilot_scene_write(const char *path, const struct pilot_scene *k, double within)
{
    char text[TEXT_ROOM];
    const int length =
        snprintf(text, sizeof text, "method: auto\naccuracy: {of: %s, within: %g, budget: %g}\n%soutput: {frames: 0}\n",
                 k->figure, within, BUDGET, k->text);
    INVARIANT(length < TEXT_ROOM);
    remove(path); /* written for the previous study, and no longer needed */
    return file_write_whole(path, text, (size_t)length);
}

/* Runs a scene with the method and spacing that the pilot runs p have chosen, as a study with a single case in
 * `folder`. scene: file of the scene; figure: name of a number in summary.json, which is stored in *value. Returns
 * REFUSED or FAILED if the run does. */
static status chosen_run(const struct pilot_choice *p, const char *scene, const char *folder, double *value,
                         const char *figure)
{
    struct study s;
    TRY(study_initialise(&s, scene, folder, "run"));
    study_add_case(&s, "run", p->override, p->overrides);
    status done = study_find_completed_failed_and_equal_cases(&s, false);
    if (done == OK) done = study_execute_waiting_runs(&s, (struct study_options){.quiet = true});
    if (done == OK) done = summary_read_number(study_case_folder(&s, &s.at[0]).text, figure, value);
    study_free(&s);
    return done;
}

static const char *chosen_value(const struct pilot_choice *p, const char *key)
{
    for (int k = p->overrides - 1; k >= 0; k--)
        if (!strcmp(p->override[k].key, key)) return p->override[k].value;
    return "";
}

/* Makes the pilot runs of the scene k and then the run that they choose, in `folder`, prints a line with its error, and
 * counts in *t whether the accuracy is reached. within: requested relative accuracy [1]. */
static void pilot_scene_measure(struct pilot_tally *t, const struct pilot_scene *k, double within, const char *folder)
{
    const struct path scene = path_join(folder, "scene.yaml.in"), into = path_join(folder, "run");
    struct pilot_choice p = {0};
    double value = NAN;
    const double begun = wall_clock_seconds();
    status done = pilot_scene_write(scene.text, k, within);
    struct scene s;
    if (done == OK)
        done = scene_read_and_choose_method_by_pilot_runs(&s, &p, scene.text, NULL, 0, into.text,
                                                          (struct study_options){.quiet = true});
    if (done == OK) scene_free(&s);
    const double pilots = wall_clock_seconds() - begun;
    if (done == OK) done = chosen_run(&p, scene.text, into.text, &value, k->figure);
    const double error = fabs(value / k->exact - 1), spacing = atof(chosen_value(&p, "particles.spacing"));
    t->asked++;
    if (done == OK) {
        const bool kept = error <= within;
        t->answered++;
        t->kept += kept;
        printf("  %-22s %-26s %5.2g %% %8.3f %%  %-8s %-5s %8.4g mm %7.1f s %7.1f s%s\n", k->name, k->figure,
               100 * within, 100 * error, chosen_value(&p, "method"), chosen_value(&p, "model"), 1e3 * spacing, pilots,
               wall_clock_seconds() - begun - pilots, kept ? "" : "  missed");
    } else
        printf("  %-22s %-26s %5.2g %% refused: %s\n", k->name, k->figure, 100 * within, status_message());
    fflush(stdout);
    const double number[] = {within, k->exact, value, error, spacing, pilots, wall_clock_seconds() - begun - pilots};
    bench_table_append_text(t->table, k->name), bench_table_append_text(t->table, k->figure),
        bench_table_append_text(t->table, chosen_value(&p, "method"));
    for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(t->table, number[c]);
    pilot_choice_free(&p);
    bench_folder_remove(into.text);
    bench_folder_remove(path_join(folder, "run_pilot").text);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Tests whether `method: auto` reaches the requested accuracy in all scenes with known results. quick: true for one
 * accuracy only. Returns FAILED if a file cannot be written. */
status bench_pilot(bool quick)
{
    static const double asked[] = {0.05, 0.02, 0.01};
    struct bench_table table;
    struct pilot_tally t = {.table = &table};
    char folder[] = BENCH_FOLDER "/pilot-XXXXXX";
    TRY(bench_create_results_folder());
    printf("pilot\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    if (!mkdtemp(folder)) return file_report_write_failure(folder, errno);
    printf("  %-22s %-26s %7s %10s  %-14s %11s %9s %9s\n", "scene", "figure", "asked", "error", "chosen", "spacing",
           "pilots", "run");
    bench_table_make(&table, "", "scene,figure,method,asked,exact,value,error,spacing,pilot_seconds,run_seconds");
    for (int k = 0; k < pilot_scenes_n; k++)
        for (size_t a = 0; a < (quick ? 1 : COUNT_OF(asked)); a++)
            pilot_scene_measure(&t, &pilot_scenes[k], asked[a], folder);
    bench_folder_remove(folder);
    printf("  %d requests: %d refused; %d of %d answers are as accurate as asked (%.0f %%, asked 90)\n", t.asked,
           t.asked - t.answered, t.kept, t.answered, 100.0 * t.kept / t.answered);
    const status s = bench_write_result_tables("pilot", &table, 1);
    bench_table_free(&table);
    return s;
}
