/* `cleave bench steps`: effect of the time step on cracks. Runs scenes with time steps from 0.05 to 0.8 of the critical
 * one, each with nine steps within +-10 % (three for the two smallest, which scatter little), with both methods and all
 * models, and measures start, length, angle and energy of the longest crack. Bonds of full peridynamics are also run
 * with half of their last force (pd.last_force). A result that depends on the step is not a property of the body. */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

#include "bench/common/bench.h"
#include "output/summary_read.h"
#include "scene/scene_read.h"

struct stepped_case {
    const char *name, *file, *key, *value; /* an override; NULL: none */
    bool quick;
};

static const struct stepped_case cases[] = {
    {"kalthoff 16.5 m/s", "inputs/kalthoff_winkler.yaml", "boundary.0.velocity", "[16.5 m/s, free]", true},
    {"kalthoff 22 m/s", "inputs/kalthoff_winkler.yaml", "boundary.0.velocity", "[22 m/s, free]", false},
    {"kalthoff 32 m/s", "inputs/kalthoff_winkler.yaml", "boundary.0.velocity", "[32 m/s, free]", false},
    {"plate_crack", "inputs/plate_crack.yaml", NULL, NULL, true},
    {"plate_hole", "inputs/plate_hole.yaml", NULL, NULL, false},
    {"glass_branching", "inputs/glass_branching.yaml", "particles.spacing", "0.5 mm", false},
    {"kalthoff_3d at 4 mm", "inputs/kalthoff_winkler_3d.yaml", "particles.spacing", "4 mm", false},
};
static const char *const models[] = {"bond", "ospd", "mospd"}, *const methods[] = {"pd", "adaptive"};
static const char *const rules[] = {"moment", "half"};
static const double shares[] = {0.05, 0.1, 0.2, 0.4, 0.5, 0.8}; /* time steps over the critical one */
enum { RUNS_MOST = 9, RUNS_QUICK = 3, SHARES = COUNT_OF(shares), SMALLEST = 0, DEFAULT = 4, LARGEST = 5 };
#define AROUND 0.1 /* relative range of time steps around each */

enum figure { START, LENGTH, ANGLE, FRACTURE, BALANCE, FIGURES };
static const char *const key_of[FIGURES] = {"crack.start_time", "crack.length_end", "crack.angle_deg",
                                            "energy.fracture", "energy.balance_error"};

/* Mean of each result over the runs around one time step, and root-mean-square deviation from it. runs: number of
 * runs. */
struct stepped {
    double mean[FIGURES], scatter[FIGURES];
    int runs;
};

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* A scene with a peridynamic model, a method, and a rule for the last force of a breaking bond: values of the scene
 * keys. */
struct breaking_method {
    const struct stepped_case *scene;
    const char *model, *method, *rule;
};

/* Starts the run of the scene and method w as a separate process, with a time step of `share` times the critical one.
 * child: receives the process. Returns FAILED if it cannot be started. */
static status stepped_start(struct bench_child *child, const struct breaking_method *w, double share)
{
    struct bench_overrides o = {0};
    if (w->scene->key) bench_overrides_append(&o, w->scene->key, "%s", w->scene->value);
    bench_overrides_append(&o, "model", "%s", w->model);
    bench_overrides_append(&o, "method", "%s", w->method);
    bench_overrides_append(&o, "pd.last_force", "%s", w->rule);
    if (strcmp(w->method, "adaptive") == 0)
        bench_overrides_append(&o, "pd.surface", "none"); /* the default of adaptive runs */
    bench_overrides_append(&o, "time.step", "auto");
    bench_overrides_append(&o, "time.safety", "%.6g", share);
    bench_overrides_append(&o, "output.frames", "0");
    return bench_child_start(child, w->scene->file, bench_overrides_as_array(&o), o.n, 1);
}

static status stepped_take(struct bench_child *child, double *figure)
{
    status s = bench_child_wait(child);
    for (int f = 0; f < FIGURES && s == OK; f++) s = summary_read_number(child->folder, key_of[f], &figure[f]);
    return s;
}

/* Runs the scene and method w with `runs` time steps around `share` times the critical one, as many at once as there
 * are cores. Stores means and root-mean-square deviations of the measured results (start time, length, angle and
 * energies of the crack) in *to. Returns FAILED if a run fails. */
static status stepped_run(const struct breaking_method *w, double share, int runs, struct stepped *to)
{
    double figure[RUNS_MOST][FIGURES];
    struct bench_child child[RUNS_MOST] = {{0}};
    const int together = omp_get_num_procs();
    status s = OK;
    for (int first = 0; first < runs && s == OK; first += together) {
        const int end = first + together < runs ? first + together : runs;
        for (int r = first; r < end && s == OK; r++)
            s = stepped_start(&child[r], w, share * (1 + AROUND * (2.0 * r / (runs - 1) - 1)));
        for (int r = first; r < end && s == OK; r++) s = stepped_take(&child[r], figure[r]);
        for (int r = first; r < end; r++) bench_child_wait_and_remove_output(&child[r]);
    }
    if (s != OK) return s;
    *to = (struct stepped){.runs = runs};
    for (int f = 0; f < FIGURES; f++) {
        for (int r = 0; r < runs; r++) to->mean[f] += figure[r][f] / runs;
        for (int r = 0; r < runs; r++) to->scatter[f] += square(figure[r][f] - to->mean[f]) / runs;
        to->scatter[f] = sqrt(to->scatter[f]);
    }
    return OK;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Prints how the results of the crack change from the smallest time step to the default one and to the largest one:
 * start time [%], length [spacings], angle [degree], fracture energy [%]. x[SHARES]: results at all time steps; spacing
 * [m]. */
static void print_change(const struct stepped *x, double spacing)
{
    const struct stepped *to = &x[SMALLEST];
    const int shown[] = {DEFAULT, LARGEST};
    for (size_t k = 0; k < COUNT_OF(shown); k++) {
        const struct stepped *of = &x[shown[k]];
        printf("  | %5.1f %6.1f+-%-4.1f %6.1f+-%-4.1f %6.1f %8.1e", 100 * (of->mean[START] / to->mean[START] - 1),
               (of->mean[LENGTH] - to->mean[LENGTH]) / spacing, of->scatter[LENGTH] / spacing,
               of->mean[ANGLE] - to->mean[ANGLE], of->scatter[ANGLE],
               100 * (of->mean[FRACTURE] / to->mean[FRACTURE] - 1), of->mean[BALANCE]);
    }
    printf("\n");
    fflush(stdout);
}

static void stepped_print(const struct breaking_method *w, const struct stepped *x, double spacing)
{
    const struct stepped *to = &x[SMALLEST];
    printf("  %-20s %-5s %-8s %-6s %6.2f %6.2f+-%-4.1f %5.1f+-%-4.1f", w->scene->name, w->model, w->method, w->rule,
           1e6 * to->mean[START], 1e3 * to->mean[LENGTH], to->scatter[LENGTH] / spacing, to->mean[ANGLE],
           to->scatter[ANGLE]);
    print_change(x, spacing);
}

static void stepped_add(struct bench_table *t, const struct breaking_method *w, const struct stepped *x)
{
    for (int k = 0; k < SHARES; k++) {
        bench_table_append_text(t, w->scene->name);
        bench_table_append_text(t, w->model);
        bench_table_append_text(t, w->method);
        bench_table_append_text(t, w->rule);
        bench_table_append_number(t, shares[k]);
        bench_table_append_number(t, x[k].runs);
        for (int f = 0; f < FIGURES; f++)
            bench_table_append_number(t, x[k].mean[f]), bench_table_append_number(t, x[k].scatter[f]);
    }
}

static status stepped_method(struct bench_table *t, const struct breaking_method *w, int runs)
{
    struct stepped x[SHARES] = {0};
    struct bench_overrides o = {0};
    struct scene s;
    if (w->scene->key) bench_overrides_append(&o, w->scene->key, "%s", w->scene->value);
    TRY(scene_read(&s, w->scene->file, bench_overrides_as_array(&o), o.n));
    const double spacing = s.spacing;
    scene_free(&s);
    for (int k = 0; k < SHARES; k++) TRY(stepped_run(w, shares[k], shares[k] < 0.2 ? RUNS_QUICK : runs, &x[k]));
    stepped_print(w, x, spacing);
    stepped_add(t, w, x);
    return OK;
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Runs all scenes, peridynamic models, methods and rules for the last force of a breaking bond, and adds their results
 * to the table t. quick: short scenes and one model only. Returns REFUSED if no scene exists, FAILED if a run fails. */
static status stepped_all(struct bench_table *t, bool quick)
{
    int done = 0;
    for (size_t c = 0; c < COUNT_OF(cases); c++) {
        if (!bench_scene_exists(cases[c].file) || (quick && !cases[c].quick)) continue;
        for (size_t m = 0; m < (quick ? 1 : COUNT_OF(models)); m++)
            for (size_t variant = 0; variant < (quick ? 1 : COUNT_OF(methods)); variant++)
                for (size_t r = 0; r < (m + variant == 0 ? COUNT_OF(rules) : 1); r++) {
                    const struct breaking_method w = {&cases[c], models[m], methods[variant], rules[r]};
                    TRY(stepped_method(t, &w, quick ? RUNS_QUICK : RUNS_MOST));
                    done++;
                }
    }
    if (done > 0) return OK;
    return status_set(REFUSED, "bench steps: its scenes are not here; start it where the folder inputs is");
}

status bench_steps(bool quick)
{
    struct bench_table table;
    bench_table_make(&table, "",
                     "scene,model,method,last_force,step_over_critical,runs,start,start_scatter,length,length_scatter,"
                     "angle_deg,angle_scatter_deg,fracture,fracture_scatter,balance_error,balance_scatter");
    printf("steps\n");
    bench_print_machine(1);
    printf("  %d runs of each (%d below 0.2), within %g of the step;\n"
           "  at %g of the critical step, then what %g and %g of it change:\n"
           "  start [%%], length [spacings], angle [degrees], energy of fracture [%%]; balance of energy\n",
           quick ? RUNS_QUICK : RUNS_MOST, RUNS_QUICK, AROUND, shares[SMALLEST], shares[DEFAULT], shares[LARGEST]);
    printf("  %-20s %-5s %-8s %-6s %6s %12s %11s  | %5s %12s %12s %6s %8s\n", "", "model", "method", "force", "us",
           "mm", "degrees", "start", "length", "angle", "energy", "balance");
    status s = stepped_all(&table, quick);
    if (s == OK) s = bench_write_result_tables("steps", &table, 1);
    bench_table_free(&table);
    return s;
}
