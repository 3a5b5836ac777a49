/* Plans the runs of a convergence study within its budget and makes them. */
#include "study/convergence_study.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "convergence_units.h"
#include "scene/scene_read.h"

/* RUNS_LEAST: least number of runs per spacing level. FINER_MOST: largest number of refinements of a scene that is
 * invalid. OVERRIDES_OWN: largest number of keys that a study sets itself. VALUE_ROOM: capacity of the text of a value
 * [byte]. */
enum { RUNS_LEAST = 3, FINER_MOST = 2, OVERRIDES_OWN = 6, VALUE_ROOM = 40 };
#define STEP_RANGE 0.1    /* time steps vary from 0.9 to 1.1 of the scene's own */
#define SAFETY_MOST 1.0   /* largest time step divided by the critical time step [1] */
#define MISFIT_MOST 0.1   /* largest misfit of a coarser level than requested: beyond, the body differs [spacings] */
#define HORIZON_MOST 10.5 /* largest horizon that a scene may have [spacings] */

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Returns the factor on the scene's time step for run number `run` (from 0) of the `runs` runs of a spacing level
 * (runs with one particle spacing). Run 0 has the factor 1, or less if the scene's own step is above the critical one.
 * The others have alternately shorter and longer steps, beginning with the largest deviations; steps that would be
 * unstable are excluded. */
static double step_of(const struct convergence_study *s, int run, int runs)
{
    const double most = s->scene.time_step > 0 ? INFINITY : SAFETY_MOST / s->scene.safety;
    const double range = fmin(STEP_RANGE, most - 1 > 0 ? most - 1 : 0), centre = most > 1 ? 1 : most;
    if (run == 0 || runs < 2) return centre;
    const int pairs = runs / 2, pair = (run - 1) / 2;
    return centre * (1 + (run % 2 ? -1 : 1) * range * (pairs - pair) / pairs);
}

/* Returns the spacing [m] of run number `run` (from 0) of a spacing level (0: finest) of the study s. A level has
 * several spacings that differ by a few per cent; its runs use them in turn. */
static double spacing_in_turn(const struct convergence_study *s, int level, int run)
{
    return s->spacings.at[level][run % s->spacings.n[level]];
}

static bool has_bonds(const struct scene *s) { return s->method != METHOD_MPM; }

/* Returns the horizon of runs with the spacing `spacing` [m], as a number of spacings: the number that the input file
 * (scene) gives or, if s->fixed_horizon is true, the number at which the horizon has the same length [m] as at the
 * coarsest level. */
static double horizon_at(const struct convergence_study *s, double spacing)
{
    const double coarsest = s->spacings.at[s->spacings.levels - 1][0];
    return s->scene.horizon * (s->fixed_horizon ? coarsest / spacing : 1);
}

/* Appends the override KEY=NUMBER to the list o, which has *n entries, and increments *n. The text of the number is
 * stored in value[*n]. The override refers to this text and to `key`; both must outlive it. */
static void value_put(struct scene_override *o, int *n, char value[][VALUE_ROOM], const char *key, double number)
{
    snprintf(value[*n], VALUE_ROOM, "%.15g", number);
    o[*n] = (struct scene_override){key, value[*n]};
    ++*n;
}

/* Adds a run with the parameters p (spacing, horizon, time step, level, number) to the study s. Its overrides are those
 * of the user, followed by spacing, horizon, time step and seed of random numbers of this run. */
static void point_add(struct convergence_study *s, struct study_point p)
{
    char value[OVERRIDES_OWN][VALUE_ROOM], name[CASE_NAME_ROOM];
    struct scene_override own[OVERRIDES_OWN];
    int n = 0;
    const struct scene *scene = &s->scene;
    value_put(own, &n, value, "particles.spacing", p.spacing);
    if (has_bonds(scene) && p.horizon != scene->horizon) value_put(own, &n, value, "particles.horizon", p.horizon);
    if (scene->time_step > 0)
        value_put(own, &n, value, "time.step", scene->time_step * p.step * p.spacing / scene->spacing);
    else if (scene_is_dynamic(scene))
        value_put(own, &n, value, "time.safety", scene->safety * p.step);
    if (scene->irregularity > 0) value_put(own, &n, value, "particles.seed", (double)scene->seed + p.run);
    if (scene->times.n == 0 && scene->every == 0) value_put(own, &n, value, "output.frames", 0);
    struct scene_override *all = NEW("study.override", s->overrides + n, struct scene_override);
    for (int k = 0; k < s->overrides; k++) all[k] = s->override[k];
    for (int k = 0; k < n; k++) all[s->overrides + k] = own[k];
    snprintf(name, sizeof name, "spacing=%.5gmm,horizon=%.4g,step=%.3f,run=%d", 1e3 * p.spacing, p.horizon, p.step,
             p.run);
    GROW("study.points", s->point, s->study.n + 1);
    s->point[s->study.n] = p;
    study_add_case(&s->study, name, all, s->overrides + n);
    memory_free(all);
}

static void level_run_add(struct convergence_study *s, int level, int run, int runs)
{
    const double spacing = spacing_in_turn(s, level, run);
    point_add(s, (struct study_point){.level = level,
                                      .spacing = spacing,
                                      .step = step_of(s, run, runs),
                                      .horizon = horizon_at(s, spacing),
                                      .run = run});
}

/* ---- budget ------------------------------------------------------------------------------------------------------ */

/* Returns the predicted duration [s] of a run with the spacing `spacing` [m]: the duration of the first run, scaled by
 * the number of particles and of time steps. If the horizon is a fixed length, it is also scaled by the number of bonds
 * per particle. */
static double cost_beside(const struct convergence_study *s, double spacing)
{
    const double first = s->point[s->first].spacing, finer = first / spacing;
    const double longer = s->fixed_horizon && has_bonds(&s->scene) ? pow(finer, s->scene.dim) : 1;
    return s->spent * pow(finer, s->scene.dim + 1) * longer;
}

/* Returns the predicted duration [s] of all planned runs of the study s together, if `jobs` runs run at a time. */
static double cost_of_all(const struct convergence_study *s, int jobs)
{
    double sum = 0, longest = 0;
    for (int level = 0; level < s->spacings.levels; level++) {
        const double one = cost_beside(s, s->spacings.at[level][0]);
        sum += s->runs[level] * one;
        longest = fmax(longest, one);
    }
    return fmax(sum / jobs, longest);
}

/* Sets the number of runs of the finest spacing level (runs with one particle spacing) to `finest`, and of the other
 * levels to `runs`, in s->runs. Runs of one level differ in random positions of particles, time steps or slightly
 * different spacings. If positions and time steps do not vary, a level has at most as many runs as spacings, since
 * further runs would be equal. */
static void runs_set(struct convergence_study *s, int runs, int finest)
{
    const bool steps = scene_is_dynamic(&s->scene) && step_of(s, 1, 3) != step_of(s, 2, 3);
    const bool differ = steps || s->scene.irregularity > 0;
    for (int level = 0; level < s->spacings.levels; level++) {
        const int wanted = level == 0 ? finest : runs, most = differ ? wanted : s->spacings.n[level];
        s->runs[level] = wanted < most ? wanted : most;
    }
}

/* Chooses the largest number of runs of each spacing level (runs with one particle spacing), at most `runs`, with
 * which the study takes no longer than `left` [s] if `jobs` runs run at a time. If even RUNS_LEAST runs per level take
 * longer, plans only one run at the finest level. Stores the predicted time in s->expected. Returns true if the plan
 * fits into `left`. */
static bool runs_fit(struct convergence_study *s, int runs, int jobs, double left)
{
    for (int k = runs; k >= RUNS_LEAST; k--) {
        runs_set(s, k, k);
        if ((s->expected = cost_of_all(s, jobs)) <= left) return true;
    }
    runs_set(s, runs < RUNS_LEAST ? runs : RUNS_LEAST, 1);
    return (s->expected = cost_of_all(s, jobs)) <= left;
}

/* ---- the study --------------------------------------------------------------------------------------------------- */

/* Returns the reason why the convergence of the scene s cannot be studied as the request demands, as a text for a
 * message, or NULL if it can be studied. The text is static. */
static const char *study_refusal(const struct scene *s, const struct convergence_request *request)
{
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].file)
            return "the particles of a body come from a list, whose spacing cannot be refined; give the body a shape";
    if (request->fixed_horizon && !has_bonds(s)) return "--horizon: method mpm has no horizon; remove --horizon";
    return NULL;
}

/* Makes the first run of the study s that the request demands, at the coarsest spacing level (runs with one particle
 * spacing), and stores its duration in s->spent. The durations of the other runs are predicted from it. Sets *refused
 * to true if the input file (scene) is invalid at this spacing, for example because the integration rings of probes
 * become too narrow. Returns REFUSED, with a message, if the run exceeds the budget, FAILED if it fails. */
static status first_run(struct convergence_study *s, const struct convergence_request *request, bool *refused)
{
    struct study_options options = request->options;
    s->first = s->study.n;
    options.jobs = 1;
    if (options.threads <= 0) options.threads = 1;
    options.quiet = true;
    options.until = s->begun + s->budget;
    level_run_add(s, s->spacings.levels - 1, 0, request->runs);
    TRY(study_find_completed_failed_and_equal_cases(&s->study, false));
    TRY(study_execute_waiting_runs(&s->study, options));
    const struct study_case *run = &s->study.at[s->first];
    *refused = run->state == CASE_FAILED && run->ended == REFUSED;
    const double coarsest = s->point[s->first].spacing;
    const struct unit metre = unit_choose_for_particle_spacings(coarsest);
    if (run->state == CASE_STOPPED || run->state == CASE_WAITING)
        return status_set(REFUSED,
                          "--budget %.3g s is too small: one run at %.4g %s, the coarsest spacing, takes longer; give "
                          "a larger budget",
                          s->budget, coarsest / metre.factor, metre.name);
    if (run->state == CASE_FAILED)
        return status_set(FAILED, "the coarsest run has failed; read its message in %s/logs", s->study.folder);
    return summary_read_number(study_case_folder(&s->study, run).text, "wall_seconds", &s->spent);
}

/* Prints a warning for each result that `request` requests (a number in summary.json) and the first run of the study s
 * lacks, because its name may be wrong. It is no error, since cracks and tips may still appear at finer spacings. */
static void wanted_warn(const struct convergence_study *s, const struct convergence_request *request)
{
    const struct path folder = study_case_folder(&s->study, &s->study.at[s->first]);
    double value;
    for (int k = 0; k < request->wanteds; k++)
        if (summary_read_number(folder.text, request->wanted[k], &value) != OK)
            fprintf(
                stderr,
                "warning: the summary of the first run has no value named %s; choose one listed in %s/summary.json\n",
                request->wanted[k], printable_name(folder.text).text);
}

/* Makes the first run of the study s, which the request demands, at the coarsest spacing level (first_run). If the
 * input file (scene) is invalid at that spacing, refines all levels and tries again, at most FINER_MOST times. Stores
 * the largest spacing that was invalid in s->refused, INFINITY if none was. Returns the status of the last try: OK,
 * REFUSED, FAILED or INTERRUPTED. */
static status first_run_sound(struct convergence_study *s, const struct convergence_request *request)
{
    bool refused = false;
    status done = FAILED;
    s->refused = INFINITY;
    for (int finer = 0; finer <= FINER_MOST; finer++) {
        spacings_choose_for_convergence_study(&s->spacings, &s->scene, request->levels,
                                              s->scene.spacing * pow(2, -0.5 * finer));
        done = first_run(s, request, &refused);
        if (!refused) break;
        s->refused = s->point[s->first].spacing;
        s->point[s->first].level = -2;
    }
    return done;
}

/* Plans the spacing levels (runs with one particle spacing each) of a study as the request demands, in s->spacings. The
 * finest level has the spacing that the input file (scene) gives times 2^(shift/2), so that the scene's own spacing is
 * among the levels if shift is at most 0. Omits levels at which the scene is invalid. Returns false if no valid plan
 * results. */
static bool mesh_levels_plan(struct convergence_study *s, const struct convergence_request *request, int shift)
{
    int levels = request->levels - (shift < 0 ? shift : 0);
    if (levels > LEVELS_MOST) return false;
    spacings_choose_for_convergence_study(&s->spacings, &s->scene, levels, s->scene.spacing * pow(2, 0.5 * shift));
    while (levels > LEVELS_LEAST && s->spacings.at[levels - 1][0] > 0.999 * s->refused) levels--;
    s->spacings.levels = levels;
    for (int k = 0; k < levels && shift > 0; k++)
        if (s->spacings.misfit[k] > MISFIT_MOST) return false;
    return s->spacings.at[levels - 1][0] < 0.999 * s->refused;
}

/* Chooses spacing levels (runs with one particle spacing each) and numbers of runs with which the study fits into its
 * budget. Levels are coarsened until the predicted time fits. request: request; jobs: number of runs at a time. Returns
 * REFUSED, with a message, if no plan fits. s: the study. */
static status plan_fit(struct convergence_study *s, const struct convergence_request *request, int jobs)
{
    static const int finer_first[] = {-2, -1, 0, 1, 2, 3, 4, 5, 6}, own_first[] = {0, -1, -2, 1, 2, 3, 4, 5, 6};
    const double left = s->budget - (wall_clock_seconds() - s->begun);
    double need = 0;
    bool planned = false;
    for (size_t k = 0; k < COUNT_OF(own_first); k++) {
        const int shift = request->finer ? finer_first[k] : own_first[k];
        if (!mesh_levels_plan(s, request, shift) || (shift < 0 && !request->finer && !isfinite(s->refused))) continue;
        const bool fits = runs_fit(s, request->runs, jobs, left) && horizon_at(s, s->spacings.at[0][0]) <= HORIZON_MOST;
        if (shift <= 0) need = s->expected, planned = true;
        if (!fits) continue;
        s->own = shift > 0 ? -1 : -shift;
        struct study_point *first = &s->point[s->first];
        first->level = -2; /* changed below if a level has its spacing */
        for (int l = 0; l < s->spacings.levels; l++)
            if (fabs(s->spacings.at[l][0] / first->spacing - 1) < 1e-9) first->level = l;
        return OK;
    }
    if (!planned)
        return status_set(REFUSED,
                          "--levels: fewer than %d different spacings, equal to that of the scene or larger, are "
                          "possible: use fewer --levels, or a smaller particles.spacing",
                          request->levels);
    return status_set(
        REFUSED,
        "--budget %.3g s is too small: three runs at each spacing would take about %.3g s; give a larger budget",
        s->budget, need + s->spent);
}

/* Adds all planned runs to the study s. The first runs are one run of each spacing level (runs with one particle
 * spacing), so that there are results even if the budget ends early. The last run, marked by level -1, has a horizon
 * one spacing longer; it is left out if the horizon cannot be varied. */
static void runs_add_all(struct convergence_study *s)
{
    const int first = s->point[s->first].level;
    for (int run = 0; run < RUNS_MOST; run++)
        for (int level = s->spacings.levels - 1; level >= 0; level--)
            if (run < s->runs[level] && !(level == first && run == 0)) level_run_add(s, level, run, s->runs[level]);
    if (!has_bonds(&s->scene) || s->fixed_horizon || s->scene.horizon + 1 > HORIZON_MOST) return;
    point_add(s, (struct study_point){.level = -1,
                                      .spacing = s->spacings.at[1][0],
                                      .step = step_of(s, 0, 1),
                                      .horizon = s->scene.horizon + 1});
}

static void plan_print(const struct convergence_study *s)
{
    const struct unit metre = convergence_study_choose_spacing_unit(s);
    fprintf(stderr, "spacings");
    for (int k = s->spacings.levels - 1; k >= 0; k--)
        fprintf(stderr, " %.4g %s (%d runs)%s", s->spacings.at[k][0] / metre.factor, metre.name, s->runs[k],
                k > 0 ? "," : "");
    fprintf(stderr, ": about %.3g s of a budget of %.3g s\n", s->expected + s->spent, s->budget);
    if (s->own < 0)
        fprintf(stderr,
                "warning: runs at the scene's own spacing, %.4g %s, would take longer than the budget, so the results "
                "are for %.4g %s; use a larger --budget\n",
                s->scene.spacing / metre.factor, metre.name, s->spacings.at[0][0] / metre.factor, metre.name);
}

/* Plans the runs of a convergence study such that they fit into the budget of the request, makes them, and reads their
 * results into s->table. Returns REFUSED or FAILED, with a message, if the study cannot be planned, its first run
 * fails, or a summary cannot be read. Returns INTERRUPTED after a stop signal. */
static status study_go(struct convergence_study *s, const struct convergence_request *request)
{
    struct study_options options = request->options;
    const int cores = machine_physical_core_count();
    TRY(study_initialise(&s->study, request->scene, request->folder, "converge"));
    s->study.options = request->words;
    spacings_choose_for_convergence_study(&s->spacings, &s->scene, request->levels, s->scene.spacing);
    if (horizon_at(s, s->spacings.at[0][0]) > HORIZON_MOST)
        return status_set(REFUSED,
                          "--horizon: the finest spacing would have a horizon of %.3g spacings, more than %g; use "
                          "fewer --levels or a smaller particles.horizon",
                          horizon_at(s, s->spacings.at[0][0]), HORIZON_MOST);
    TRY(first_run_sound(s, request));
    wanted_warn(s, request);
    if (options.threads <= 0) options.threads = 1;
    if (options.jobs <= 0) options.jobs = cores > options.threads ? cores / options.threads : 1;
    TRY(plan_fit(s, request, options.jobs));
    if (!options.quiet) plan_print(s);
    runs_add_all(s);
    if (!options.quiet)
        fprintf(stderr, "[1/%d] %s: done in %.3g s\n", s->study.n, s->study.at[s->first].name, s->spent);
    TRY(study_find_completed_failed_and_equal_cases(&s->study, false));
    options.until = s->begun + s->budget;
    TRY(study_execute_waiting_runs(&s->study, options));
    int failed = 0;
    for (int k = s->first; k < s->study.n; k++) failed += s->study.at[k].state == CASE_FAILED;
    if (failed > 0)
        fprintf(stderr, "warning: %d of %d runs failed and are left out; their messages are in %s/logs\n", failed,
                s->study.n, s->study.folder);
    return study_table_read(&s->table, &s->study);
}

status convergence_study_run(struct convergence_study *s, const struct convergence_request *request)
{
    *s = (struct convergence_study){.override = request->override,
                                    .overrides = request->overrides,
                                    .budget = request->budget,
                                    .begun = wall_clock_seconds(),
                                    .fixed_horizon = request->fixed_horizon,
                                    .study.lock.fd = -1};
    TRY(scene_read(&s->scene, request->scene, request->override, request->overrides));
    const char *refusal = study_refusal(&s->scene, request);
    status done = refusal ? status_set(REFUSED, "%s: %s", request->scene, refusal) : OK;
    for (int k = 0; k < request->wanteds && done == OK; k++)
        done = result_name_check_is_known(&s->scene, request->wanted[k]);
    if (done == OK) done = study_go(s, request);
    if (done != OK) convergence_study_free(s);
    return done;
}

void convergence_study_free(struct convergence_study *s)
{
    study_table_free(&s->table);
    study_free(&s->study);
    memory_free(s->point);
    scene_free(&s->scene);
    s->point = NULL;
}
